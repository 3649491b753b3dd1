"""summary(): the table of a run that an engineer puts into a report."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from seacrane.analysis.least_pulls import least_pulls
from seacrane.answers.reported_curves import Curve, in_si, reported_curves
from seacrane.answers.statics import Statics, static_pulls
from seacrane.arrays import Array
from seacrane.description.rungs import RIGID
from seacrane.description.suspension import ROD, suspensions
from seacrane.description.wet_parts import wet_bodies
from seacrane.errors import SceneError, SeacraneError
from seacrane.inputs.checked import number_of
from seacrane.inputs.keywords import named
from seacrane.plotting.table import Column, Rows, Table
from seacrane.result import Result
from seacrane.result.contact_loads import NO_CONTACTS, ContactLoads, contact_loads
from seacrane.result.record import inside
from seacrane.result.utilisation import Utilisation

DASHED = (
    "- it went slack on a rod or a rigid wire, which knows no snap, lift-off or landing: no factor. Let it "
    "hang on a line of rung 'elastic' or 'auto'."
)
NOTHING = 1e-9  # as printed
BLIND = (ROD, RIGID)  # a quasi-static line ends the run where it goes slack
SLACK = 0.02  # of the static load: less is slack, or stands on something
STARRED = "* at the first output told of: no static value is known."
WET = (
    "min/static is over the least static load of each line: with parts in water below, that with all of them "
    "under water."
)
OUTPUTS = "min and max of {} are those of the outputs; of all else, those of the run between them too."
ATTITUDE = {"heel": "roll", "trim": "pitch"}
NO_LIMITS = Utilisation(())
LEAST_STATIC = 1e-3  # of the largest value: a smaller static load makes no factor
ENOUGH_WAVES = 100  # peak periods: fewer tell of an extreme no more than what happened once
FIRST, LAST = 0.2, 0.5  # parts of the record that are compared
FEWEST_OUTPUTS = 20
DRIFTED = 2.0  # standard deviations of the last part, between the means
CALMED = 2.0  # times the standard deviation of the last part


@dataclass(frozen=True, kw_only=True)
class SummaryRow:
    """One curve of a run in numbers.

    Attributes
    ----------
    name, unit : The unit is SI.
    static, static_known : Value at rest; where that is not known, at the first output summarised.
    minimum_at, maximum_at : s.
    factor : Dynamic factor of a load: the largest in the sense of the static load, over that, or None.
    slack_margin : Smallest tension over the least static one, of what pulls; zero and below is slack. The
        least is `static` but with parts in water below, as of the channel `slack_margin`.
    blind : Whether it went slack on a rung that knows no lift-off, landing or snap: there is no factor.
    printed : The unit in which the row is printed.
    """

    name: str
    unit: str
    static: float
    static_known: bool
    mean: float
    std: float
    minimum: float
    minimum_at: float
    maximum: float
    maximum_at: float
    factor: float | None
    slack_margin: float | None = None
    blind: bool = False
    printed: str = ""


@dataclass(frozen=True, kw_only=True, repr=False)
class Summary(Rows[SummaryRow]):
    """The numbers of a run. Made by `summary`; prints as a table, in the units in which they are read.

    Attributes
    ----------
    scene : Its name.
    start, end : Of the part of the run that is summarised, s.
    rows : tuple of SummaryRow
        In SI units. They print with forces in kN, moments in kN m, hook loads in t, angles in deg.
    remarks : What limits the numbers: a short record, a transient inside.
    of_outputs : Rows whose least and largest values are those of the outputs; of all others, of the run.
    utilisation, contacts : Of the scene's limit states and contacts, over the whole run.
    """

    scene: str
    start: float
    end: float
    remarks: tuple[str, ...] = ()
    of_outputs: tuple[str, ...] = ()
    utilisation: Utilisation = NO_LIMITS
    contacts: ContactLoads = NO_CONTACTS

    def __repr__(self) -> str:
        return f"<Summary of {self.scene!r}: {len(self.rows)} rows, {self.start:g} to {self.end:g} s>"

    def _shown(self) -> Table:
        static = zip(self._numbers("static").texts(), self.rows, strict=True)
        stars = [text if row.static_known else f"{text}*" for text, row in static]
        blind = [np.nan if row.blind else row.factor for row in self.rows]
        return Table(
            axes=[self.names("row", head="")],
            columns=[
                self.column("unit", read=("", [row.printed for row in self.rows])),
                self.column("static", read=("", stars)), self.column("static_known", printed=False),
                self._numbers("mean"), self._numbers("std"),
                self._numbers("minimum", head="min"), self.column("minimum_at", unit="s", head="at"),
                self._numbers("maximum", head="max"), self.column("maximum_at", unit="s", head="at"),
                self.column("factor", read=("", blind), form=".2f"),
                self.column("slack_margin", head="min/static", form=".2f"),
                self.column("blind", printed=False),
            ],
            title=f"{self.scene}, {self.start:g} to {self.end:g} s", remarks=self._notes(),
            below=[one._shown() for one in (self.contacts, self.utilisation) if one],
            attributes={"scene": self.scene, "start": self.start, "end": self.end,
                        "remarks": "\n".join(self.remarks)},
        )  # fmt: skip

    def _numbers(self, name: str, head: str | None = None) -> Column:
        """In SI units, and in the unit in which each row is printed."""
        read = [in_si(row.printed)[1] * getattr(row, name) for row in self.rows]
        return self.column(name, head=head, read=("", read), least=NOTHING)

    def _notes(self) -> list[str]:
        """What a star means, and the remarks."""
        starred = any(not row.static_known for row in self.rows)
        blind = any(row.blind for row in self.rows)
        outputs = [OUTPUTS.format(", ".join(self.of_outputs))] if 0 < len(self.of_outputs) < len(self) else []
        return [*([STARRED] if starred else []), *([DASHED] if blind else []), *outputs, *self.remarks]


def require_result(result: object) -> None:
    """SceneError for what is no result in memory."""
    if not isinstance(result, Result):
        fix = "its load()" if hasattr(result, "load") else "what simulate() or Result.load() returns"
        raise SceneError(f"result is a {type(result).__name__}; give {fix}")


@named
def summary(
    result: Result,
    *,
    after: float | None = None,
    before: float | None = None,
    static: Statics | None = None,
) -> Summary:
    """Static value, mean, standard deviation, extremes and dynamic factor of what matters in a run.

    Rows: tension of links and wires, hook load, cylinder forces, slew torque, offset and swing of what hangs,
    heave, roll and pitch of vessels; as far as the run recorded them, without what is zero up to rounding.
    The static tension of a link is the weight that hangs on it. Where something else carries that too, as of
    slings, taglines, two cranes and in water, it is that of the scene at rest, off any deck, its references
    held as at the start. Of all else the value at the first output from `after` on takes its place, marked
    by a star.

    Parameters
    ----------
    result : Result
        Of any run.
    after, before : float, optional
        Part of it that mean, standard deviation, extremes and starred values are taken from, s; default: all.
    static : Statics, optional
        In one pose, as `statics` tells it: the static values of its tensions, cylinder forces, slew torque,
        heel and trim.

    Raises
    ------
    SceneError
        For what is no result, a part of it that holds no output, or statics of several poses.
    """
    require_result(result)
    known = _static(static)
    part = _part(result, after, before)
    time = result.time[part]
    curves = [one for one in reported_curves(result) if np.isfinite(one.values[part]).any()]
    unknown = [one.name for one in curves if one.pulls and one.static is None and one.name not in known]
    told = static_pulls(result) if unknown else {}
    if not isinstance(told, str):
        known = {name: told[name] for name in unknown if name in told} | known
    every = [
        replace(one, static=known[one.name] * in_si(one.unit)[1] if one.name in known else one.static)
        for one in curves
    ]
    least, kept = _least_pulls(result), []
    for one in every:
        low, high = (inside(result, part, one.values, bound) for bound in (one.least, one.largest))
        kept.append(replace(one, values=one.values[part], bounds=(low, high)))
    stopped = [f"The run was interrupted: the record ends at {time[-1]:g} s."] if result.interrupted else []
    restless = [f"No factor of what is starred: {told}."] if isinstance(told, str) else []
    remarks = (*stopped, *_calm(result), *_short(result, time), *_transient(time, kept), *restless)
    return Summary(
        scene=str(result.stats["scene"]), start=float(time[0]), end=float(time[-1]),
        rows=tuple(_row(one, time, least) for one in kept),
        remarks=(*remarks, *([WET] if least else [])),
        of_outputs=tuple(one.name for one in every if one.bounds is None), utilisation=result.utilisation,
        contacts=contact_loads(result),
    )  # fmt: skip


def _least_pulls(result: Result) -> dict[str, tuple[float, int]]:
    """Least static load (N) of each suspension of a scene with parts in water, and on how many falls."""
    if result.scene is None or not wet_bodies(result.scene):
        return {}
    try:
        falls = {name: one.falls for one in suspensions(result.scene) for name in (one.channel, one.top)}
        return {name: (pull, falls.get(name, 1)) for name, pull in least_pulls(result.scene).items()}
    except SeacraneError:  # what comes to no rest has no margin
        return {}


def _static(given: Statics | None) -> dict[str, float]:
    """Static values by the names of rows."""
    if given is None:
        return {}
    if not isinstance(given, Statics):
        raise SceneError(f"summary: static is a {type(given).__name__}; give what statics(scene) returns")
    found = {}
    for name, values in given.columns.items():
        if values.size != 1:
            raise SceneError(f"summary: static is of {values.size} poses; give statics of one")
        what, _, of = name.partition(" ")
        found[f"{ATTITUDE.get(what, what)} {of}".rstrip()] = float(values.item())
    return found


def _part(result: Result, after: float | None, before: float | None) -> slice:
    """Outputs from `after` to `before`, both included."""
    first = result.time[0] if after is None else number_of("summary: after", after)
    last = result.time[-1] if before is None else number_of("summary: before", before)
    begin, end = (int(np.searchsorted(result.time, *one)) for one in ((first, "left"), (last, "right")))
    if begin >= end:
        raise SceneError(
            f"summary: no output is between after = {first:g} and before = {last:g} s; the result has "
            f"{result.time[0]:g} to {result.time[-1]:g} s"
        )
    return slice(begin, end)


def _row(curve: Curve, time: Array, least: Mapping[str, tuple[float, int]]) -> SummaryRow:
    known, values = curve.static is not None, curve.values
    first = values[np.isfinite(values)][0]
    static = float(first if curve.static is None else curve.static)
    low, high = int(np.nanargmin(curve.least)), int(np.nanargmax(curve.largest))
    minimum, maximum = float(curve.least[low]), float(curve.largest[high])
    unit, per = in_si(curve.unit)
    blind = known and curve.rung in BLIND and minimum < SLACK * static
    pull, falls = least.get(curve.suspension, (0.0, 1))
    over = pull * per / (falls if curve.of_one_fall else 1) or (static if known else 0.0)
    has_factor = curve.load and known and not blind
    return SummaryRow(
        name=curve.name, unit=unit, printed=curve.unit,
        static=static / per, static_known=known,
        mean=float(np.nanmean(values)) / per, std=float(np.nanstd(values)) / per,
        minimum=minimum / per, minimum_at=float(time[low]),
        maximum=maximum / per, maximum_at=float(time[high]),
        factor=_factor(static, minimum, maximum) if has_factor else None,
        blind=blind,
        slack_margin=minimum / over if curve.pulls and over > 0.0 else None,
    )  # fmt: skip


def _factor(static: float, low: float, high: float) -> float | None:
    """None beside a static load that is nothing, or of the other sense."""
    if abs(static) <= LEAST_STATIC * max(abs(low), abs(high)):
        return None
    factor = (high if static > 0.0 else low) / static
    return factor if factor > 0.0 else None


def _calm(result: Result) -> list[str]:
    """That nothing of a lift is by waves: of what floats or is wet, and has no sea."""
    scene = result.scene
    dry = scene is None or not (scene.vessels or wet_bodies(scene))
    if scene is None or dry or (scene.waves is not None and np.any(scene.waves.amplitude)):
        return []
    return ["Still water: the scene has no sea (add_sea), and nothing here is by waves."]


def _short(result: Result, time: Array) -> list[str]:
    period, span = result.settings.get("tp"), float(time[-1] - time[0])
    if not isinstance(period, (int, float)) or not period or span >= ENOUGH_WAVES * period:
        return []
    return [
        f"Too short for statistics: {span:g} s are {span / period:.0f} peak periods. Largest and smallest "
        f"are those of these waves alone; run {ENOUGH_WAVES * period:g} s or more, or several seeds."
    ]


def _transient(time: Array, curves: Sequence[Curve]) -> list[str]:
    """The curve whose first part is most unlike its last part."""
    if time.size < FEWEST_OUTPUTS or not curves:
        return []
    excess = [_unlike(one.values) for one in curves]
    worst = int(np.argmax(excess))
    if excess[worst] <= 1.0:
        return []
    return [
        f"A starting transient or a move is inside: {curves[worst].name} does not behave in the first fifth "
        f"of {time[0]:g} to {time[-1]:g} s as in the second half. Pass after= to leave the beginning out."
    ]


def _unlike(values: Array) -> float:
    """How much a record's beginning differs from its end, over what is allowed."""
    finite = values[np.isfinite(values)]
    first, last = finite[: int(FIRST * finite.size)], finite[finite.size - int(LAST * finite.size) :]
    if not first.size or np.ptp(finite) <= 1e-9 * np.abs(finite).max():
        return 0.0
    spread = max(float(last.std()), 1e-9 * float(np.ptp(finite)))
    drift = abs(float(first.mean() - last.mean())) / (DRIFTED * spread)
    return max(drift, float(first.std()) / (CALMED * spread))
