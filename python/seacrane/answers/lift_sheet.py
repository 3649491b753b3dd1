"""lift_sheet(): what a signed lift calculation states, number by number, with formulas and sources."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from seacrane.answers.rest_columns import AtRest, pulls_of
from seacrane.answers.statics import hanging_rest
from seacrane.answers.summary import summary
from seacrane.description.description import Description
from seacrane.description.loads import changed
from seacrane.description.suspension import Hung, Suspension, hung_loads, suspensions
from seacrane.errors import SceneError
from seacrane.inputs.shown import shown
from seacrane.one_thread import one_thread
from seacrane.plotting.table import Rows, Table, Verdict, read_as
from seacrane.result import Result
from seacrane.scene.lift_factors import LiftFactors, Rating

UNVERIFIED = "unverified"
SCENE, STATICS, RUN = "the scene", "the scene at rest", "this run"
WORST = "worst corner of the envelope"


@dataclass(frozen=True)
class SheetRow:
    """One number of a lift sheet.

    Attributes
    ----------
    value, unit : SI.
    formula, inputs : How it comes about, in symbols and in numbers.
    source : Of what was given: "unverified" where nobody said where it is from.
    required : What it has to reach, or None.
    """

    name: str
    value: float
    unit: str = ""
    formula: str = ""
    inputs: str = ""
    source: str = ""
    required: float | None = None

    @property
    def kept(self) -> bool | None:
        """Whether it reaches what is required; None where nothing is."""
        return None if self.required is None else self.value >= self.required


@dataclass(frozen=True, kw_only=True, repr=False)
class LiftSheet(Rows[SheetRow]):
    """The numbers of a lift calculation. Made by `lift_sheet`; prints as a table, forces in kN.

    Attributes
    ----------
    scene, load : str
    rows : tuple of SheetRow
    """

    scene: str
    load: str

    @property
    def kept(self) -> bool:
        """Whether every number reaches what is required of it."""
        return all(row.kept is not False for row in self.rows)

    def __repr__(self) -> str:
        return f"<LiftSheet of {self.load!r} in {self.scene!r}: {len(self.rows)} rows>"

    def _shown(self) -> Table:
        units = [read_as(row.unit)[1] for row in self.rows]
        return Table(
            axes=[self.names("row", head="")],
            columns=[
                self.column("value", read=("", [_told(row) for row in self.rows])),
                self.column("unit", read=("", units)),
                self.column("formula"), self.column("inputs", head="with"), self.column("source"),
                self.column("required", printed=False),
            ],
            title=f"{self.scene}: lift of {self.load}", attributes={"scene": self.scene, "load": self.load},
        )  # fmt: skip


def _told(row: SheetRow) -> Verdict:
    factor = read_as(row.unit)[0]
    told = f"{factor * row.value:.4g}"
    if row.required is not None:
        told += f" {'>=' if row.kept else 'below'} {row.required:.4g}"
    return Verdict(told, row.kept)


@one_thread
def lift_sheet(subject: Result | Description, *, load: str | None = None) -> LiftSheet:
    """Design weight, hook load, forces in slings and ropes and their safety factors, each with its source.

    Static forces are those of the scene at rest with the load off any deck, its mass times the weight
    contingency factor, its centre of gravity in the corner of its envelope that is worst for each. The
    dynamic factor multiplies all of them, the skew load factor the slings besides. The steps are those of GL
    Noble Denton 0027/ND Rev. 11, 6.2 and 7.2; against DNV-ST-N001, which took its place, they are
    unverified. Factors are the user's: `Scene.add_lift_factors`.

    Parameters
    ----------
    subject : Result or Scene
        Of a run, whose dynamic factor counts where none was given; of a scene alone the factor is 1.
    load : str, optional
        The body; default: the only one with lift factors, or the only one that hangs on a crane.

    Returns
    -------
    LiftSheet

    Raises
    ------
    SceneError
        For a result without its scene, a load that hangs on nothing, a scene without rest.
    """
    scene = subject.scene if isinstance(subject, Result) else subject
    if not isinstance(scene, Description):
        raise SceneError(f"lift sheet: subject is {shown(subject)}; give a Scene, or a Result that holds its")
    body = _load_of(scene, load)
    hung = [one for one in hung_loads(scene) if one.load == body]
    if not hung:
        raise SceneError(f"lift sheet: load {body!r} hangs on nothing; hang it by add_hoist or a link")
    factors = scene.lift_factors.get(body) or LiftFactors(name=body)
    rows = list(_Sheet(scene, factors, hung, subject if isinstance(subject, Result) else None).rows())
    return LiftSheet(scene=scene.name, load=body, rows=tuple(rows))


def _load_of(scene: Description, load: str | None) -> str:
    hung = hung_loads(scene)
    on_cranes = [one.load for one in hung if one.crane is not None]
    known = list(dict.fromkeys(list(scene.lift_factors) or on_cranes or [one.load for one in hung]))
    if load is None and len(known) == 1:
        return known[0]
    if load not in scene.bodies:
        loads = ", ".join(map(repr, known)) or "none"
        raise SceneError(f"lift sheet: load is {shown(load)}; name one, the scene has {loads}")
    return str(load)


class _Sheet:
    """The rows, one after another."""

    def __init__(self, scene: Description, factors: LiftFactors, hung: list[Hung], run: Result | None):
        self._scene, self._factors, self._hung, self._run = scene, factors, hung, run
        self._told = summary(run) if run is not None and factors.dynamic_factor is None else None
        self._at_rest = [pulls_of(one) for one in _corners(scene, factors)]
        several = sum(one.crane is not None for one in hung_loads(scene)) > 1
        self._labels = [f" {one.label}" if several or one.crane is None else "" for one in hung]

    def rows(self) -> Iterator[SheetRow]:
        """All rows of the sheet, in its order."""
        factors = self._factors
        weight = self._scene.bodies[factors.name].mass * self._scene.gravity
        design = factors.weight_contingency * weight
        yield SheetRow("weight", weight, "N", "W = m g", f"m {weight / self._scene.gravity:.6g} kg", SCENE)
        yield self._given("weight contingency", "weight_contingency", "gamma")
        inputs = f"{factors.weight_contingency:g} x {weight / 1e3:.4g} kN"
        yield SheetRow("design weight", design, "N", "gamma W", inputs)
        x, y, z = factors.center_of_gravity
        if any(factors.center_of_gravity):
            yield SheetRow("envelope of the centre of gravity", max(x, y, z), "m", "half its edges",
                           f"{x:g}, {y:g}, {z:g} m", self._source("center_of_gravity"))  # fmt: skip
        for one, label in zip(self._hung, self._labels, strict=True):
            yield from self._of_hook(one, label)
        slings = self._slings()
        if len(factors.skew_load) not in (1, len(slings)):
            raise SceneError(
                f"lift factors of {factors.name!r}: skew_load has {len(factors.skew_load)} numbers, and it "
                f"hangs on {len(slings)} slings; give one for all, or one for each"
            )
        for i, sling in enumerate(slings):
            yield from self._of_sling(i, sling)
        if factors.alpha != 1.0:
            yield from self._of_sea()

    def _of_hook(self, one: Hung, label: str) -> Iterator[SheetRow]:
        static = self._worst(f"hook load{label}")
        yield SheetRow(f"static hook load{label}", static, "N", "gamma W + rigging", WORST, STATICS)
        dynamic, source = self._dynamic(label)
        yield SheetRow(f"dynamic factor{label}", dynamic, formula="DAF", source=source)
        inputs = f"{dynamic:.4g} x {static / 1e3:.4g} kN"
        yield SheetRow(f"dynamic hook load{label}", static * dynamic, "N", "DAF x static", inputs)
        rating = self._scene.ratings.get(one.suspension.name)
        if rating is not None:
            pull = self._worst(f"hoist tension{label}")
            force = pull * dynamic
            yield SheetRow(f"rope tension {rating.name}", force, "N", "DAF x tension of a fall",
                           f"{dynamic:.4g} x {pull / 1e3:.4g} kN", STATICS)  # fmt: skip
            yield self._safety(f"safety factor {rating.name}", rating.breaking_load, force,
                               rating.safety_factor, "")  # fmt: skip

    def _of_sling(self, number: int, sling: Suspension) -> Iterator[SheetRow]:
        factors = self._factors
        dynamic = max(self._dynamic(label)[0] for label in self._labels)
        skew = factors.skew_load[number if len(factors.skew_load) > 1 else 0]
        static = self._worst(f"line tension {sling.name}", f"tension {sling.name}")
        force = static * dynamic * skew
        inputs = f"{dynamic:.4g} x {skew:g} x {static / 1e3:.4g} kN"
        source = f"SKL: {self._source('skew_load')}"
        yield SheetRow(f"force {sling.name}", force, "N", f"DAF SKL x static, {WORST}", inputs, source)
        rating: Rating | None = self._scene.ratings.get(sling.name)
        if rating is not None:
            asked, key = rating.safety_factor, ""
            if asked is None:
                asked, key = factors.sling_safety_factor, "sling_safety_factor"
            yield self._safety(f"safety factor {sling.name}", rating.breaking_load, force, asked, key)
        if factors.shackle_breaking_load is not None:
            yield self._safety(f"safety factor of the shackle, {sling.name}", factors.shackle_breaking_load,
                               force, factors.shackle_safety_factor, "shackle_safety_factor")  # fmt: skip

    def _of_sea(self) -> Iterator[SheetRow]:
        yield self._given("alpha factor", "alpha", "alpha")
        hs = None if self._run is None else self._run.settings.get("hs")
        if isinstance(hs, int | float):
            alpha = self._factors.alpha
            yield SheetRow("operational Hs", alpha * hs, "m", "alpha Hs", f"{alpha:g} x {hs:g} m")

    def _safety(
        self, name: str, breaking_load: float, force: float, asked: float | None, key: str
    ) -> SheetRow:
        source = "" if asked is None else self._source(key) if key else "given with the rope"
        inputs = f"{breaking_load / 1e3:.4g} / {force / 1e3:.4g} kN"
        return SheetRow(name, breaking_load / force, "", "MBL / force", inputs, source, asked)

    def _given(self, name: str, key: str, formula: str) -> SheetRow:
        return SheetRow(name, getattr(self._factors, key), formula=formula, source=self._source(key))

    def _source(self, key: str) -> str:
        return self._factors.sources.get(key, UNVERIFIED)

    def _dynamic(self, label: str) -> tuple[float, str]:
        """The factor of one hook, and where it is from."""
        given = self._factors.dynamic_factor
        if given is not None:
            return given, self._source("dynamic_factor")
        if self._told is None:
            return 1.0, "none: statics alone"
        factor = next((row.factor for row in self._told if row.name == f"hook load{label}"), None)
        if factor is None:
            return 1.0, "none: the run knows no factor"
        return factor, f"{RUN}: largest over static hook load"

    def _slings(self) -> list[Suspension]:
        """What holds the load itself, below a block."""
        above = {one.suspension.name for one in self._hung}
        hooks = {one.suspension.lower[0] for one in self._hung}  # from which no tagline comes
        return [
            one for one in suspensions(self._scene)
            if one.lower[0] == self._factors.name and one.name not in above and one.upper[0] in hooks
        ]  # fmt: skip

    def _worst(self, *names: str) -> float:
        found = [corner[name][1] for corner in self._at_rest for name in names if name in corner]
        if not found:
            raise SceneError(
                f"lift sheet: {names[-1]} has no static force: rigid lines share it as statics do not tell; "
                "let it hang on lines of rung 'elastic'"
            )
        return max(found)


def _corners(scene: Description, factors: LiftFactors) -> Iterator[AtRest]:
    """At rest with the design weight, its centre of gravity in each corner of its envelope."""
    body = scene.bodies[factors.name]
    gamma = factors.weight_contingency
    sides = [(-edge, edge) if edge else (0.0,) for edge in factors.center_of_gravity]
    for corner in itertools.product(*sides):
        out = scene.copy()
        out.bodies[factors.name] = changed(
            body, mass=gamma * body.mass, inertia=gamma * np.asarray(body.inertia),
            center_of_mass=np.asarray(body.center_of_mass) + corner,
        )  # fmt: skip
        yield hanging_rest(out)
