"""Vessel type of an OrcaFlex text model (``.yml``): its numbers in SI, in the file's axes, which are ours.

Axes are x forward, y port, z up; directions are those of travel. Phases are lags or leads relative to a
crest, a trough or a zero crossing at the phase origin. te and kN; load RAOs per metre of wave amplitude. The
sign conventions of motions and the wave unit can be changed in OrcaFlex; only its defaults are read.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.arrays import Array
from seacrane.errors import FileFormatError
from seacrane.hydro.readers.as_read import left_out, omega_of
from seacrane.inputs.shown import shown
from seacrane.inputs.whole_file import decoded, read_whole

KILO = 1000.0  # te to kg, kN to N
LARGEST_FILE = 64 * 2**20  # bytes; YAML is read at about 1 MiB/s
DEEPEST = 40  # levels of a text model; OrcaFlex writes about ten
DEFAULTS = {
    "RAOWaveUnit": "amplitude",
    "SurgePositive": "forward",
    "SwayPositive": "port",
    "HeavePositive": "up",
    "RollPositiveStarboard": "down",
    "PitchPositiveBow": "down",
    "YawPositiveBow": "port",
}
UNITS = {"period (s)": "s", "frequency (rad/s)": "rad/s", "frequency (Hz)": "Hz"}
LAG_OF_EVENT = {"crest": 0.0, "zero down-crossing": 0.5, "trough": 1.0, "zero up-crossing": 1.5}  # pi
UNREAD = ("SumFrequencyQTFs", "DifferenceFrequencyQTFs", "SeaStateRAOs", "CurrentCoeff", "WindCoeff")
ADDED_MASS = ", ".join(f"AddedMassMatrix{axis}" for axis in ("X", "Y", "Z", "Rx", "Ry", "Rz"))
DAMPING = ", ".join(f"Damping{axis}" for axis in ("X", "Y", "Z", "Rx", "Ry", "Rz"))
STIFFNESS = "HydrostaticStiffnessz, HydrostaticStiffnessRx, HydrostaticStiffnessRy"
INERTIA = "MomentOfInertiaTensorX, MomentOfInertiaTensorY, MomentOfInertiaTensorZ"
AMPLITUDES = tuple(f"RAO{motion}Amp" for motion in ("Surge", "Sway", "Heave", "Roll", "Pitch", "Yaw"))
RAO_ROWS = ", ".join(["RAOPeriodOrFrequency", *(f"{one}, {one[:-3]}Phase" for one in AMPLITUDES)])
DRIFT_ROWS = ", ".join(["RAOPeriodOrFrequency", *AMPLITUDES])


@dataclass(frozen=True, eq=False)
class Raos:
    """``values`` (m, n, 6) complex, exp(+i omega t), about ``origin`` with zero phase at ``phase_origin``;
    of mean drift real, per squared amplitude."""

    heading_deg: Array
    omega: Array
    values: NDArray[Any]
    origin: Array
    phase_origin: Array


@dataclass(frozen=True, eq=False)
class VesselType:
    """One draught of a vessel type, SI; matrices about ``origin``; what is not in the file is None.

    ``omega`` (n,) of the matrices may hold 0 and infinity. ``mass``, ``centre`` and ``inertia`` (about the
    centre) are of the structure; points are from the origin of the vessel's axes. ``place`` says what the
    origin is.
    """

    name: str
    source: str
    place: str
    symmetry: str
    omega: Array
    added_mass: Array
    damping: Array
    loads: Raos
    origin: Array = field(default_factory=lambda: np.zeros(3))
    length: float | None = None
    motions: Raos | None = None
    drift: Raos | None = None
    mass: float | None = None
    centre: Array = field(default_factory=lambda: np.zeros(3))
    inertia: Array = field(default_factory=lambda: np.zeros((3, 3)))
    stiffness: Array | None = None
    volume: float | None = None
    other_origin: Array = field(default_factory=lambda: np.zeros(3))
    other_linear: Array = field(default_factory=lambda: np.zeros(6))
    other_quadratic: Array = field(default_factory=lambda: np.zeros(6))
    rho: float | None = None
    depth: float = np.inf


@dataclass(frozen=True)
class _Node:
    """A place in the document, which its messages name."""

    path: Path
    place: str
    value: Any

    def error(self, message: str) -> FileFormatError:
        return FileFormatError(f"{self.path}, {self.place or 'document'}: {message}")

    def has(self, key: str) -> bool:
        return isinstance(self.value, dict) and self.value.get(key) is not None

    def at(self, key: str) -> _Node:
        if not self.has(key):
            raise self.error(f"{key} is missing; save the whole model as a text data file")
        return _Node(self.path, f"{self.place}/{key}".lstrip("/"), self.value[key])

    def items(self) -> list[_Node]:
        if not isinstance(self.value, list):
            raise self.error("a list is expected")
        return [_Node(self.path, f"{self.place}[{i + 1}]", value) for i, value in enumerate(self.value)]

    def text(self) -> str:
        return str(self.value)

    def number(self) -> float:
        """A number, which YAML 1.1 takes for text when its exponent has no sign (``1e3``)."""
        try:
            if isinstance(self.value, bool) or not isinstance(self.value, (int, float, str)):
                raise ValueError
            value = float(self.value)
        except (ValueError, OverflowError):
            raise self.error(f"{str(self.value)[:40]!r} is not a number") from None
        if math.isnan(value):
            raise self.error("not a number (nan)")
        return value

    def finite(self) -> float:
        value = self.number()
        if not math.isfinite(value):
            raise self.error(f"{value} is not finite")
        return value

    def table(self, rows: int | None, columns: int) -> Array:
        """Rows of finite numbers; any number of rows where ``rows`` is None, which begin with a period."""
        lines = self.items()
        if not lines or (rows is not None and len(lines) != rows):
            raise self.error(f"{rows or 'some'} rows are expected, found {len(lines)}")
        return np.array([line.vector(columns, period=rows is None) for line in lines])

    def vector(self, count: int, *, period: bool = False) -> Array:
        """Finite numbers; the first may be a period, which is infinite in the program's default tables."""
        found = self.items()
        if len(found) != count:
            raise self.error(f"{count} numbers are expected, found {len(found)}")
        first = [found[0].number()] if period else []
        return np.array([*first, *(entry.finite() for entry in found[len(first) :])])


def read_vessel_type(path: Path, *, vessel_type: str | None, draught: str | None) -> VesselType:
    """Read one draught of one vessel type.

    Raises FileFormatError: the document is no OrcaFlex model in SI units, holds several vessel types or
    draughts and none was chosen, uses conventions other than the defaults, or lacks something.
    """
    model = _Node(path, "", _document(path))
    units = model.at("General").at("UnitsSystem").text() if model.has("General") else "SI"
    if units != "SI":
        raise model.error(f"units system {shown(units)}: save the model in SI units")
    kind = _named(model.at("VesselTypes"), vessel_type, "vessel_type")
    for key, usual in DEFAULTS.items():
        if kind.has(key) and kind.at(key).text() != usual:
            raise kind.error(
                f"{key} is {shown(kind.at(key).text())}; only {usual!r} is read: change the conventions"
            )
    state = _named(kind.at("Draughts"), draught, "draught")
    origin = _vector(state, "ReferenceOrigin", np.zeros(3))
    omega, added_mass, damping = _matrices(kind, state)
    sea = _Node(path, "Environment", model.value.get("Environment") or {})
    name = f"{kind.at('Name').text()}, {state.at('Name').text()}"
    unread = [
        one for one in UNREAD if any(_has_rows(state.value[key]) for key in state.value if one in str(key))
    ]
    x, y, z = origin
    return VesselType(
        name=name, source=f"OrcaFlex model {path.name}, {name}" + left_out(unread), origin=origin,
        place=f"reference origin of the OrcaFlex vessel type, ({x:g}, {y:g}, {z:g}) m in its axes",
        symmetry=kind.at("Symmetry").text() if kind.has("Symmetry") else "None",
        length=kind.at("Length").finite() if kind.has("Length") else None,
        omega=omega, added_mass=added_mass * KILO, damping=damping * KILO,
        loads=_raos(kind, state.at("LoadRAOs"), np.full(6, KILO)),
        motions=_if_rows(_motion_raos, kind, state, "DisplacementRAOs"),
        drift=_if_rows(_drift, kind, state, "WaveDrift"),
        mass=state.at("Mass").finite() * KILO if state.has("Mass") else None,
        centre=_vector(state, f"CentreOf{'Mass' if state.has('CentreOfMass') else 'Gravity'}", np.zeros(3)),
        inertia=state.at(INERTIA).table(3, 3) * KILO if state.has(INERTIA) else np.zeros((3, 3)),
        stiffness=state.at(STIFFNESS).table(3, 3) * KILO if state.has(STIFFNESS) else None,
        volume=state.at("DisplacedVolume").finite() if state.has("DisplacedVolume") else None,
        other_origin=_vector(state, "OtherDampingOrigin", np.zeros(3)),
        other_linear=_vector(state, "OtherLinearDamping", np.zeros(6)) * KILO,
        other_quadratic=_vector(state, "OtherQuadraticDamping", np.zeros(6)) * KILO,
        rho=sea.at("Density").finite() * KILO if sea.has("Density") else None,
        depth=sea.at("WaterDepth").number() if sea.has("WaterDepth") else math.inf,
    )  # fmt: skip


def _has_rows(value: Any) -> bool:
    """Whether there is a list of lists, or of tables."""
    if isinstance(value, dict):
        return any(map(_has_rows, value.values()))
    return isinstance(value, list) and bool(value) and isinstance(value[0], list | dict)


def _document(path: Path) -> dict[str, Any]:
    """The one document of the file; nesting and aliases are looked at before anything is built."""
    try:
        import yaml
    except ImportError:
        raise FileFormatError(
            f"{path}: OrcaFlex models need PyYAML; install it with pip install 'seacrane[orcaflex]'"
        ) from None
    loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    try:
        data = read_whole(path, LARGEST_FILE, "save the vessel type alone")
        text = decoded(data)
        if b"\0" in data and "\0" not in text:
            raise FileFormatError(f"{path}: no UTF-8 text; save the model again")
        depth = 0
        for event in yaml.parse(text, Loader=loader):
            depth += isinstance(event, yaml.CollectionStartEvent) - isinstance(event, yaml.CollectionEndEvent)
            if depth > DEEPEST or isinstance(event, yaml.AliasEvent):
                line = event.start_mark.line + 1
                raise FileFormatError(f"{path}, line {line}: nested too deeply or aliased; no OrcaFlex model")
        found = yaml.load(text, Loader=loader)
    except OSError as error:
        raise FileFormatError(f"{path}: cannot be read ({error.strerror}); check the path") from error
    except (yaml.YAMLError, ValueError, TypeError) as error:
        if isinstance(error, FileFormatError):
            raise
        mark = getattr(error, "problem_mark", None)
        line = "" if mark is None else f", line {mark.line + 1}"
        reason = getattr(error, "problem", None) or str(error).partition("\n")[0]
        raise FileFormatError(f"{path}{line}: no YAML document ({reason}); save the model again") from error
    if not isinstance(found, dict):
        raise FileFormatError(f"{path}, line 1: no OrcaFlex model; save the model as a text data file")
    return found


def _named(nodes: _Node, name: str | None, argument: str) -> _Node:
    """The entry of a list with that ``Name``, or the only one."""
    names = [entry.at("Name").text() for entry in nodes.items()]
    if name is None and len(names) == 1:
        name = names[0]
    if name not in names:
        raise nodes.error(f"holds {', '.join(names)[:200] or 'nothing'}; pass {argument}= with one of these")
    return _Node(nodes.path, f"{nodes.place}/{name[:60]}", nodes.value[names.index(name)])


def _to_omega(kind: _Node, values: Sequence[float]) -> Array:
    """Frequencies in rad/s of what the file refers to waves by; a period of 0 is infinity."""
    unit = kind.at("WavesReferredToBy").text()
    if unit not in UNITS:
        raise kind.error(f"WavesReferredToBy is {shown(unit)}; {', '.join(UNITS)} are known")
    return omega_of(np.array(values, dtype=float), UNITS[unit])


def _matrices(kind: _Node, state: _Node) -> tuple[Array, Array, Array]:
    """Frequencies, added mass in te and damping in kN s, in the order of the file."""
    key = "FrequencyDependentAddedMassAndDamping"
    if not state.has(key):
        raise state.error(f"{key} is missing; one body with the method 'Frequency dependent' is read")
    entries = state.at(key).items()
    omega = _to_omega(kind, [entry.at("AMDPeriodOrFrequency").number() for entry in entries])
    tables = [[entry.at(name).table(6, 6) for entry in entries] for name in (ADDED_MASS, DAMPING)]
    return omega, np.array(tables[0]).reshape(-1, 6, 6), np.array(tables[1]).reshape(-1, 6, 6)


def _if_rows(read: Callable[[_Node, _Node], Raos], kind: _Node, state: _Node, key: str) -> Raos | None:
    """A table that may have no rows: the program writes ``RAOs: []`` then."""
    if not state.has(key) or not state.at(key).has("RAOs") or state.at(key).at("RAOs").value == []:
        return None
    return read(kind, state.at(key))


def _raos(kind: _Node, node: _Node, scale: Array) -> Raos:
    """A table of amplitudes and phases as complex numbers."""
    found = _table(kind, node, RAO_ROWS)
    values = found.values[:, :, ::2] * scale * np.exp(-1j * _lag(kind, found.values[:, :, 1::2]))
    return replace(found, values=values)


def _drift(kind: _Node, node: _Node) -> Raos:
    """Mean drift of the wave frequencies that are neither 0 nor infinite, rising."""
    found = _table(kind, node, DRIFT_ROWS)
    order = np.argsort(found.omega)
    order = order[(found.omega[order] > 0.0) & np.isfinite(found.omega[order])]
    return replace(found, omega=found.omega[order], values=found.values[:, order] * KILO)


def _table(kind: _Node, node: _Node, columns: str) -> Raos:
    """The numbers of a table by direction and period, with its origins."""
    headings = node.at("RAOs").items()
    if not headings:
        raise node.error("RAOs is empty; give the load RAOs of the vessel type")
    tables = [entry.at(columns).table(None, columns.count(",") + 1) for entry in headings]
    for entry, table in zip(headings, tables, strict=True):
        if table.shape != tables[0].shape or np.any(table[:, 0] != tables[0][:, 0]):
            raise entry.error("periods or frequencies differ from those of the first direction")
    rows = np.array(tables)
    origin = _vector(node, "RAOOrigin", np.zeros(3))
    return Raos(
        heading_deg=np.array([entry.at("RAODirection").finite() for entry in headings]),
        omega=_to_omega(kind, rows[0, :, 0].tolist()),
        values=rows[:, :, 1:],
        origin=origin,
        phase_origin=_vector(node, "PhaseOrigin", origin),
    )


def _lag(kind: _Node, phase: Array) -> Array:
    """Phases as lags behind the crest, rad."""
    unit, sense = kind.at("RAOPhaseUnitsConvention").text(), kind.at("RAOPhaseConvention").text()
    event = kind.at("RAOPhaseRelativeToConvention").text()
    if unit not in ("degrees", "radians") or sense not in ("lags", "leads") or event not in LAG_OF_EVENT:
        raise kind.error(
            f"RAO phases as {shown(sense)} in {shown(unit)} relative to {shown(event)}; lags or leads in "
            f"degrees or radians relative to {', '.join(LAG_OF_EVENT)} are known"
        )
    radians = np.radians(phase) if unit == "degrees" else phase
    return np.asarray((radians if sense == "lags" else -radians) + np.pi * LAG_OF_EVENT[event])


def _motion_raos(kind: _Node, node: _Node) -> Raos:
    """Displacement RAOs; the unit of rotations is a convention of these alone."""
    unit = kind.at("RAOResponseUnits").text()
    if unit not in ("degrees", "radians"):
        raise kind.error(f"RAOResponseUnits is {shown(unit)}; degrees or radians are known")
    turn = np.pi / 180.0 if unit == "degrees" else 1.0
    return _raos(kind, node, np.array([1.0, 1.0, 1.0, turn, turn, turn]))


def _vector(node: _Node, key: str, default: Array) -> Array:
    """A point in vessel axes or six numbers; where it is missing or ``~``, the default."""
    given = node.at(key).value if node.has(key) else None
    if given is None or (isinstance(given, list) and all(value is None for value in given)):
        return default
    return node.at(key).vector(len(default))
