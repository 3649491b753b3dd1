"""The keywords of a table of a lift, in SI, with its curves, and the call that they make."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np

from seacrane import _core
from seacrane._core import Curve
from seacrane.analysis.tanks import Tank
from seacrane.crane import Payload, load_crane
from seacrane.description import hydraulic_cylinders
from seacrane.description.channels import CHANNELS, OWN, unit_of
from seacrane.description.curves import spline_curve
from seacrane.description.databases import source_of
from seacrane.description.description import coordinate_of
from seacrane.description.pick import pick_of
from seacrane.errors import SceneError
from seacrane.hydro import Compartment, HydroDatabase, load_hull, shipped_database
from seacrane.hydro.data.motion_raos import MotionRaos
from seacrane.inputs.shown import shown
from seacrane.inputs.units import into_si
from seacrane.lift.inner_keys import COORDINATE, CURVES, FROM, READING, SHIPPED
from seacrane.lift.keys import EITHER, Key, require_unit
from seacrane.lift.tables import LEFT, Table
from seacrane.scene import heave, springs
from seacrane.scene.mooring import MooringSpring
from seacrane.scene.motion_history import MotionHistory
from seacrane.scene.realised_sea import spectrum_named
from seacrane.scene.scene import Scene
from seacrane.scene.wind_current import FlowCoefficients, gust_curve
from seacrane.sea import Current, SeaState, WaveSystem, cos_2s

Keywords = dict[str, Any]
Scale = Callable[[Any], Any]
LONGEST_GUST = 1e7  # s times components: fourteen hours of the usual 200
ANGLES = ("angle", "roll", "pitch", "yaw")
SEA_OF_SYSTEMS = ("depth", "placement")
MOORINGS = ("mooring", "mooring_period", "mooring_springs")
SHIPS = ("database", "raos", "history", "motion")  # what tells which vessel it is
_MADE: Mapping[str, Callable[..., Any]] = {
    "payload": Payload,
    "coefficients": FlowCoefficients,
    "current": Current,
    "first_frame": _core.Frame,
    "second_frame": _core.Frame,
    "frame": _core.Frame,
    "tip": lambda body, point: (body, point),
    "history": MotionHistory,
    "raos": lambda **table: _raos(**table),
    "mooring_springs": MooringSpring,
    "inside": Compartment,
    "systems": lambda **table: _system(table),
    **hydraulic_cylinders.VALUES,
    **heave.VALUES,
    **springs.VALUES,
}


def keywords(keys: Iterable[Key], values: Mapping[str, Any], scene: Scene | None = None) -> Keywords:
    """A checked table, by spelling, as keywords of the API.

    SceneError for a value that makes no sense, or a unit that the coordinate of a joint of `scene` has not.
    """
    found = {}
    for key in keys:
        for spelling, unit in key.spellings.items():
            if spelling not in values:
                continue
            if scene is not None and EITHER in key.unit:
                _require_unit_of_joint(scene, key, values)
            found[key.name] = _converted(key, values[spelling], unit)
    return found


def _converted(key: Key, value: Any, unit: str) -> Any:
    match key.type:
        case "table":
            inside = keywords(key.keys, value)
            return _MADE[key.name](**inside) if key.name in _MADE else inside
        case "tables":
            return [_MADE.get(key.name, dict)(**keywords(key.keys, one)) for one in value]
        case "curve":
            return curve_from(value, unit)
        case "number":
            return value if isinstance(value, str) else float(into_si(unit)(value))
        case "array":
            return into_si(unit)(value)
    return value


def _require_unit_of_joint(scene: Scene, key: Key, values: Mapping[str, Any]) -> None:
    """Refuse N/m of an angle, and the like."""
    joint = values.get("joint")
    if joint in scene.joints:  # else the call says so
        coordinate = coordinate_of(scene, key.name, joint, values.get("coordinate"))
        own = key.unit.split(EITHER)[coordinate in ANGLES]
        require_unit([key], values, own, f"{key.name} along {coordinate!r} of joint {joint!r}")


def require_unit_of_channel(
    keys: Iterable[Key], values: Mapping[str, Any], channel: str, names: Mapping[str, str], unit: str = ""
) -> None:
    """Refuse a limit in another unit than that of the channel, as far as that is known here."""
    if channel in CHANNELS or unit:  # else the run says so
        own = unit or unit_of(channel, list(names.values()))
        require_unit(keys, values, own, f"channel {channel!r}", "name one of its curves in channel")


def _unit_of_own(scene: Scene, channel: str, names: Mapping[str, str]) -> str:
    """The unit of a channel of one's own, which its expression says; no text for others."""
    if channel.partition("[")[0].strip() != OWN:
        return ""
    name = pick_of("limit state", channel, names).names.get("expression", "")
    return f"{scene.channels[name].unit}{EITHER}SI" if name in scene.channels else ""


class Caller:
    """Makes the calls of one scene; what is read from other files is read once."""

    def __init__(self) -> None:
        self.read: dict[tuple[str, str], HydroDatabase] = {}

    def call(self, scene: Scene, table: Table, values: Mapping[str, Any], *, at_rest: bool = False) -> None:
        """Add to a scene what a table describes; at rest, without what only moves it."""
        given = keywords(table.keys, values, scene)
        if table.name == "limit_state":
            channel, names = values["channel"], values.get("names", {})
            require_unit_of_channel(table.keys, values, channel, names, _unit_of_own(scene, channel, names))
        match table.name:
            case "vessel":
                self._vessel(scene, given, at_rest=at_rest)
            case "sea":
                if not at_rest:
                    self._sea(scene, given)
            case "crane":
                self.crane(scene, table, values, {})
            case "ballast":
                given |= {key: None for key, value in given.items() if value in LEFT}
                if "tanks" in given:
                    tanks = by_name("ballast: tanks", given["tanks"])
                    given["tanks"] = {name: Tank(**tank) for name, tank in tanks.items()}
                scene.add_ballast(**given)
            case "roles":
                if "areas" in given:
                    rows = given["areas"]
                    given["areas"] = {one["cylinder"]: (one["full"], one["rod_side"]) for one in rows}
                scene.add_roles(**given)
            case _:
                assert table.add is not None
                table.add(scene, **given)

    def crane(self, scene: Scene, table: Table, values: Mapping[str, Any], changes: Keywords) -> None:
        """Add a crane, with keywords that are not those of its table."""
        given = keywords(table.keys, values) | changes
        file = given.pop("crane", None)
        crane = load_crane() if file is None else load_crane(file)
        if "coordinates" in given:
            for row in values.get("coordinates", ()):
                unit = "m" if crane.data.led_by(str(row["name"])).kind == "prismatic" else "rad"
                require_unit(COORDINATE, row, unit, f"coordinate {row['name']!r}")
            given["coordinates"] = {row["name"]: row["value"] for row in given["coordinates"]}
        scene.add_crane(crane, **given)

    def _vessel(self, scene: Scene, given: Keywords, *, at_rest: bool) -> None:
        led = given.get("motion") == "raos"
        found = [key for key in SHIPS if key in given and not (led and key == "motion")]
        if len(found) != 1 or (led and found != ["database"]):
            raise SceneError(
                f"vessel: has {' and '.join(key for key in SHIPS if key in given) or 'no database'}; give a "
                "database, with motion = 'raos' to be led by its RAOs, or raos, history, or motion = 'rest'"
            )
        source = given.pop(found[0])
        if found == ["database"]:
            source = self._database(source, **{name: given.pop(name) for name in READING if name in given})
        given.pop("motion", None)
        if led or found != ["database"]:
            scene.add_vessel(motion="rest" if at_rest else source, **given)
            return
        held = [key for key in MOORINGS if key in given]
        if len(held) > 1:
            raise SceneError(f"vessel: has {' and '.join(held)}; give one of them")
        if "mooring_period" in given:
            period = given.pop("mooring_period")
            given["mooring"] = None if period == float("inf") else period
        if "mooring_springs" in given:
            given["mooring"] = given.pop("mooring_springs")
        if at_rest:  # neither fluid memory nor kinematics matter
            given = {key: value for key, value in given.items() if key != "kinematics"} | {"memory": "none"}
        scene.add_vessel(source, **given)

    def _database(self, file: str, **given: Any) -> HydroDatabase:
        """Read once; what is ``given`` beside a file is an argument of `load_hull`."""
        for name, value in given.items() if file in SHIPPED else ():
            if name != "depth" or np.isfinite(value):
                own = "has its own mass, zero speed and deep water"
                raise SceneError.of(f"vessel: {name}", f"is {shown(value)}, and {file} {own}; leave it out")
        key = (file, repr(given))
        if key not in self.read:
            self.read[key] = shipped_database() if file in SHIPPED else load_hull(file, **given)
        return self.read[key]

    def _sea(self, scene: Scene, given: Keywords) -> None:
        database = source_of(scene, given.get("vessel", "vessel"))
        systems = given.pop("systems", None)
        if systems is not None:
            of_state = {key: given.pop(key) for key in (*SEA_OF_SYSTEMS, "seed") if key in given}
            depth = ({} if database is None else {"depth": database.depth}) | of_state
            given["sea"] = SeaState(systems=systems, **depth)
        for key in SEA_OF_SYSTEMS:
            if key in given:
                text = "is given without systems, whose sea is as deep as the database"
                raise SceneError.of(f"sea: {key}", text)
        scene.add_sea(**given)


def by_name(what: str, rows: Iterable[Keywords]) -> dict[str, Keywords]:
    """Tables of a list by their names, without these; SceneError where two have one name."""
    found: dict[str, Keywords] = {}
    for row in rows:
        if row["name"] in found:
            raise SceneError.of(what, f"has {row['name']!r} twice; names must differ")
        found[row["name"]] = {key: value for key, value in row.items() if key != "name"}
    return found


def _raos(headings: list[Keywords], **table: Any) -> MotionRaos:
    """From amplitudes and phases, heading by heading."""
    for one in headings:
        rows = [len(one[key]) for key in ("amplitude", "phase")]
        if rows != 2 * [len(table["omega"])]:
            raise SceneError(
                f"raos: amplitude has {rows[0]} rows and phase {rows[1]} at heading {one['heading']:.6g} "
                f"rad, and omega {len(table['omega'])} values; give one row for each frequency"
            )
    values = [np.array(one["amplitude"]) * np.exp(1j * np.array(one["phase"])) for one in headings]
    return MotionRaos(heading=[one["heading"] for one in headings], values=values, **table)


def _system(given: Keywords) -> WaveSystem:
    name, hs, tp, gamma = (given.pop(key, None) for key in ("spectrum", "hs", "tp", "gamma"))
    if gamma is not None and name != "jonswap":
        raise SceneError(f"gamma: {name!r} has no free peak enhancement; leave gamma out")
    spectrum = spectrum_named(name, hs, tp, 3.3 if gamma is None else gamma)
    if "spreading" in given:
        given["spreading"] = cos_2s(given["spreading"])
    return WaveSystem(spectrum=spectrum, **given)


def curve_from(given: Any, unit: str) -> float | Curve:
    """A curve in SI from what a file holds, checked: a number, which stays one, a piece, or several.

    SceneError for a curve that makes no sense.
    """
    scale = into_si(unit)
    if isinstance(given, float):
        return float(scale(given))
    first, *others = (given,) if isinstance(given, Mapping) else given
    curve = _piece(first, scale)
    for piece in others:
        curve = curve.then(time=keywords([FROM], piece)["from"], curve=_piece(piece, scale))
    return curve


def _piece(piece: Mapping[str, Any], scale: Scale) -> Curve:
    arguments: dict[str, Any] = {}
    for key in CURVES[piece["kind"]]:
        for spelling, unit in key.spellings.items():
            if spelling in piece:
                own = into_si(unit) if unit else scale
                plain = key.type in ("text", "whole")
                arguments[key.name] = piece[spelling] if plain else own(piece[spelling])
    return _CURVE_OF[piece["kind"]](**arguments)


def _harmonic(*, period: float, **others: float) -> Curve:
    if not period > 0.0:
        raise SceneError(f"curve: period_s is {period:g}; give a period above zero")
    return Curve.harmonic(omega=2.0 * np.pi / period, **others)


def _spline(*, times: Any, values: Any) -> Curve:
    try:
        return spline_curve(times=times, values=values)
    except np.linalg.LinAlgError as error:
        raise SceneError(f"curve: no spline leads through its samples ({error}); space them out") from error


def _gust(*, duration: float, count: int = 200, **others: Any) -> Curve:
    if duration * count > LONGEST_GUST:
        raise SceneError(
            f"curve: duration_s is {duration:g} with count {count}; their product may be {LONGEST_GUST:g} s"
        )
    return gust_curve(duration=duration, count=count, **others)


_CURVE_OF: Mapping[str, Callable[..., Curve]] = {
    "constant": Curve.constant,
    "quintic": Curve.quintic,
    "harmonic": _harmonic,
    "spline": _spline,
    "gust": _gust,
    "table": Curve.table,
}
