"""statics(): a lift at rest in every pose asked for."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from seacrane import _core
from seacrane.analysis.inverse import crane_of, path_through, places_in, places_of, posed, values_of
from seacrane.analysis.left_range import LARGEST_HEEL
from seacrane.analysis.rest_state import rest_states
from seacrane.analysis.stability import Growing, growing
from seacrane.answers.rest_columns import HOOK_STIFFNESS, AtRest, columns_of, pulls_of
from seacrane.arrays import Array
from seacrane.description.compilation import compile_scene
from seacrane.description.crane_parts import tip_radius
from seacrane.description.description import Description
from seacrane.description.elements import add_driver
from seacrane.description.places import ANGLES
from seacrane.description.roles import CraneRoles
from seacrane.description.suspension import hung_loads
from seacrane.description.waves import calm_water
from seacrane.errors import SceneError, SeacraneError
from seacrane.inputs.caller import silently, warn_caller
from seacrane.inputs.frames import rotation_matrix
from seacrane.inputs.keywords import named
from seacrane.inputs.plausible import angle_of
from seacrane.one_thread import one_thread
from seacrane.plotting.table import Answer, Column, Table
from seacrane.result import Result
from seacrane.warnings import LargeHeelWarning, UnstableRestWarning

NOTHING = 1e-8  # m, deg, kN, t: as printed
HOOK = "hook load"  # printed in t
Columns = dict[str, tuple[str, float]]
Pose = Mapping[str, float]
STEP = 0.25  # s of the path between two projections: 0.05 m
CLOSE = 1e-10  # s of the path
LOADS = ("loads", "point_forces", "springs", "force_tables", "function_forces")


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Statics(Answer):
    """A lift at rest in every pose asked for. Made by `statics`; prints as a table.

    Attributes
    ----------
    scene : str
        Its name.
    poses : mapping of str to ndarray or float
        Values along each axis of the grid: "slew" (rad), "radius" (m), strokes (m) and luffs (rad) by their
        labels; a number that was given as one makes no axis. Empty for the pose described.
    columns : mapping of str to ndarray or float
        Values over the grid, numbers where it has no axis, SI; ``statics["GM"]`` is one of them.
    units : mapping of str to str
        Of each column, SI. It prints in deg, kN, kN m, bar, hook loads in t and stiffness in mm/kN.
    pose_units : Of each axis of the grid: rad or m.
    gravity : m/s2, by which hook loads are printed in t.
    """

    scene: str
    poses: Mapping[str, Any]
    columns: Mapping[str, Any]
    units: Mapping[str, str]
    pose_units: Mapping[str, str]
    gravity: float

    def __getitem__(self, name: str) -> Any:
        """A column over the grid; KeyError names those that are there."""
        if name not in self.columns:
            raise KeyError(f"there is no column {name!r}; statics has {', '.join(self.columns)}")
        return self.columns[name]

    def __repr__(self) -> str:
        grid = " x ".join(f"{np.size(v)} {name}" for name, v in self.poses.items()) or "as described"
        return f"<Statics of {self.scene!r}: {grid}; {', '.join(self.columns)}>"

    def _shown(self) -> Table:
        return Table(
            columns=[self._column(name) for name in self.columns],
            axes=[Column(name=name, values=v, unit=self.pose_units[name]) for name, v in self.poses.items()],
            title=f"{self.scene}, at rest", attributes={"scene": self.scene},
        )  # fmt: skip

    def _column(self, name: str) -> Column:
        values, read = np.asarray(self.columns[name]), None
        if name.startswith(HOOK):
            read = "t", values * 1e-3 / self.gravity
        elif name.startswith(HOOK_STIFFNESS):
            read = "mm/kN", 1e6 / values
        return Column(name=name, values=values, unit=self.units[name], read=read, least=NOTHING)


@named
@one_thread
def statics(
    scene: Description,
    *,
    slew: Any = None,
    radius: Any = None,
    coordinates: Mapping[str, Any] | None = None,
    luff: str | None = None,
    crane: str | None = None,
) -> Statics:
    """Heel, trim, draught, GM, hook load, cylinder forces and slew torque at rest, in every pose asked for.

    The whole scene rests in each pose, without waves: vessels heel and trim, loads hang, and drives hold the
    cranes' coordinates. Arrays make a grid, in the order slew, radius or coordinates; numbers make no axis.

    Parameters
    ----------
    scene : Scene
        Whether its cranes are driven or have actuators does not matter.
    slew : float or array_like, optional
        Coordinate of the slew drive, rad, from the described pose as the channel "slew_angle".
    radius : float or array_like, optional
        From the slew axis to the tip, m: reached by one cylinder, `luff`, within its range.
    coordinates : mapping of str to float or array_like, optional
        Strokes by the cylinders' labels, m, from the described pose as the channel "stroke".
    luff : str, optional
        Label of the cylinder that sets the radius; default: the first.
    crane : str, optional
        Prefix of the crane that is posed; default: the only one.

    Returns
    -------
    Statics
        heel (rad; positive lifts port), trim (rad; positive lowers the bow), draught change (m, of the
        reference point from its place at rest in the database), GM (m), GM solid and GM spread (m, where
        tanks are slack), tip radius (m), tip height (m, above z = 0), hook load (N), hoist tension (N), hook
        stiffness (N/m: vertical force over sag of the hook, of rope and crane in series, vessels and drives
        held; infinite on a rod and a rigid wire, NaN of a slack line), cylinder forces (N, positive pushes),
        slew torque (N m).
        GM is the heeling moment for each radian over the displaced weight, with loads free to swing: a load
        that hangs counts at its tip, and so does the free surface of tanks. GM solid is without free
        surfaces; GM spread is the largest less the smallest GM over the fits of the database's tanks.

    Raises
    ------
    SceneError
        For a pose that the crane does not reach, or where there is no rest state.

    Warns
    -----
    UnstableRestWarning
        Where the scene does not stay at rest in a pose, as with a GM below zero.
    LargeHeelWarning
        Where a vessel heels or trims by more than 20 deg, beyond which restoring is not linear.
    """
    axes = _axes(slew, radius, coordinates)
    roles = crane_of(scene, crane) if axes else None
    places = {} if roles is None else places_of(roles)
    values = [np.atleast_1d(one) for one in axes.values()]
    grid = [dict(zip(axes, one, strict=True)) for one in itertools.product(*values)]
    shape = tuple(len(values) for values in axes.values() if np.ndim(values))
    rows = _judged(scene, zip(resting(scene, roles, grid, luff), grid, strict=True))
    return Statics(
        scene=scene.name, poses=axes, units={name: unit for name, (unit, _) in rows[0].items()},
        columns={name: np.array([row[name][1] for row in rows]).reshape(shape)[()] + 0.0 for name in rows[0]},
        pose_units={name: "rad" if places.get(name, ("", ""))[1] in ANGLES else "m" for name in axes},
        gravity=scene.gravity,
    )  # fmt: skip


def _axes(slew: Any, radius: Any, coordinates: Mapping[str, Any] | None) -> dict[str, Any]:
    """Rows of numbers by axis, or a number where one was given."""
    given = {"slew": ("slew", slew), "radius": ("radius", radius)}
    given |= {label: (f"coordinate {label!r}", values) for label, values in (coordinates or {}).items()}
    read = {name: values_of(f"statics: {what}", v) for name, (what, v) in given.items() if v is not None}
    for angle in read.get("slew", ()):
        angle_of("statics: slew", float(angle))
    return {name: values if np.ndim(given[name][1]) else values[0] for name, values in read.items()}


def resting(
    scene: Description, roles: CraneRoles | None, grid: list[dict[str, float]], luff: str | None
) -> Iterator[AtRest]:
    """The scene at rest in each pose of a grid, by the names of its axes."""
    places = places_in(scene)
    poses = [] if roles is None else _strokes(scene, roles, grid, luff)
    path, times = path_through(places, poses) if poses else ({}, np.zeros(1))
    out = posed(scene.copy(orientation="quaternion"), places, path)
    for state in rest_states(out, times=times.tolist()):
        yield AtRest.of(out, state)


def _strokes(
    scene: Description, roles: CraneRoles, grid: list[dict[str, float]], luff: str | None
) -> list[dict[str, float]]:
    """Poses by the labels of coordinates, radii turned into the stroke that gives them."""
    known = places_of(roles)
    found, reaches = [], {}
    for pose in grid:
        values = {label: value for label, value in pose.items() if label != "radius"}
        for label in values:
            if label not in known:
                raise SceneError(
                    f"statics: coordinate {label!r} is none of crane {roles.prefix!r}, which has "
                    f"{', '.join(known) or 'none'}"
                )
            _require_range(scene, known[label], label, values[label])
        if "radius" in pose:
            label = luffing(scene, roles, luff)
            if label in values:
                raise SceneError(
                    f"statics: cylinder {label!r} is given a stroke and sets the radius too; name another "
                    "one as luff, or leave its stroke out"
                )
            others = {name: value for name, value in values.items() if name != "slew"}
            key = tuple(others.values())
            if key not in reaches:
                reaches[key] = Reach(scene, roles, label, others)
            values[label] = reaches[key].stroke(pose["radius"])
        found.append({f"{roles.prefix}{label}": value for label, value in values.items()})
    return found


def _require_range(scene: Description, place: tuple[str, str], label: str, value: float) -> None:
    for limit in scene.ranges.values():
        if (limit.joint, limit.coordinate) == place and not limit.minimum <= value <= limit.maximum:
            unit = "rad" if place[1] in ANGLES else "m"
            raise SceneError(
                f"statics: {label} is {value:g} {unit}, outside its range of {limit.minimum:g} to "
                f"{limit.maximum:g} {unit} from the described pose; give one within"
            )


def _judged(scene: Description, poses: Iterable[tuple[AtRest, Pose]]) -> list[Columns]:
    """Columns of each pose; warns of that in which most grows fastest, and of that with the largest heel."""
    rows: list[Columns] = []
    falling: list[tuple[Growing, str]] = []
    heeled: list[tuple[float, str]] = []
    for at_rest, pose in poses:
        rows.append(columns := columns_of(at_rest))
        where = f"at {', '.join(f'{name} {value:.4g}' for name, value in pose.items())} " if pose else ""
        kinds = {name: name.split(" ")[0] for name in columns}
        gm = [f"{n} {value:.3g} {unit}" for n, (unit, value) in columns.items() if kinds[n] == "GM"]
        if grows := growing(at_rest.scene, at_rest.model, at_rest.state):
            falling.append((grows[0], f"{where}{', '.join(gm)}"))
        for name, (_, value) in columns.items():
            if kinds[name] in ("heel", "trim") and abs(value) > LARGEST_HEEL:
                heeled.append((abs(value), f"{where}{name} is {np.degrees(value):.3g} deg"))
    if falling:
        worst, told = max(falling, key=lambda one: one[0].value.real)
        warn_caller(
            f"statics: scene {scene.name!r} does not stay at rest in {len(falling)} of {len(rows)} poses; "
            f"{told or 'as described'}: {worst.label} {worst.words}. Lower the weights, take less on the "
            "hook, or hold what tips over",
            UnstableRestWarning,
        )
    if heeled:
        _, told = max(heeled)
        warn_caller(
            f"statics: {told}, beyond {np.degrees(LARGEST_HEEL):.0f} deg in {len(heeled)} of {len(rows)} "
            "poses: restoring is linear, so that heel, GM and all that follows from them are not those of "
            "the ship there. Take less on the hook or nearer, add ballast (Scene.add_ballast), or look at "
            "righting_arms",
            LargeHeelWarning,
        )
    return rows


@one_thread
def hanging_rest(scene: Description) -> AtRest:
    """Its state at rest with every load off its deck, calm and held as at the start; SceneError for none."""
    seats = {name: load.joint for name, load in scene.loads.items() if getattr(load, "kind", "") == "seat"}
    hung = {one.load for one in hung_loads(scene)}
    touched = {
        name for name, load in scene.loads.items()
        if isinstance(load, _core.Contact) and hung & {load.body, load.on}
    }  # fmt: skip
    out = scene.copy(
        loads={name: load for name, load in scene.loads.items() if name not in seats.keys() | touched},
        joints={name: joint for name, joint in scene.joints.items() if name not in seats.values()},
        waves=calm_water(scene.waves),
    )
    return next(resting(out, None, [{}], None))


def static_pulls(result: Result) -> dict[str, float] | str:
    """Static load of each rod, wire and line, N, by the rows of a summary; or why none is known."""
    try:
        if result.scene is None:
            return {}
        with silently():  # the run told them
            return {name: value for name, (_, value) in pulls_of(hanging_rest(result.scene)).items()}
    except SeacraneError as error:
        return str(error)


def luffing(scene: Description, roles: CraneRoles, luff: str | None) -> str:
    """Label of the coordinate that changes the radius; SceneError where there is none."""
    known = {label: place for label, place in places_of(roles).items() if label != "slew"}
    label = next(iter(known), None) if luff is None else luff
    if label is None or label not in known:
        there = ", ".join(map(repr, known)) or "none"
        raise SceneError(
            f"luff is {luff!r}; name the cylinder or hinge that sets the radius; there are {there}"
        )
    joint, coordinate = known[label]
    if not any((one.joint, one.coordinate) == (joint, coordinate) for one in scene.ranges.values()):
        raise SceneError(
            f"coordinate {label!r}: it has no range, within which a radius is looked for; give one by "
            f"add_channel(joint={joint!r}, minimum=..., maximum=...)"
        )
    return label


class Reach:
    """Radius of the tip over one stroke or luff, the other coordinates at values of their own."""

    def __init__(self, scene: Description, roles: CraneRoles, label: str, others: Mapping[str, float]):
        self._scene, self._roles, self._label = scene, roles, label
        places = places_of(roles)
        limits = [one for one in scene.ranges.values() if (one.joint, one.coordinate) == places[label]]
        low, high = max(one.minimum for one in limits), min(one.maximum for one in limits)
        ends = [{**others, label: value} for value in (0.0, low, high)]
        path, times = path_through(places, ends)
        none: dict[str, Any] = {name: {} for name in LOADS}  # do not matter to where a tip is
        led = posed(scene.copy(**none), places, path).copy(orientation="quaternion")
        for one in scene.roles.values():
            if one.structure is not None:  # upright: what the crane gives is told by the rest state
                add_driver(led, joint=one.structure, curve=0.0)
        self._model = compile_scene(led)
        self._evaluator = _core.Evaluator(self._model)
        self._low, self._begin, self._span = low, float(times[1]), float(times[2] - times[1])
        self._rate = (high - low) / self._span
        state = self._led(np.array(self._model.initial_state), 0.0, self._begin)
        self._times = self._begin + np.linspace(0.0, self._span, int(np.ceil(self._span / STEP)) + 1)
        self._states, self.radii = [state], [self._radius(state)]
        for before, after in zip(self._times[:-1], self._times[1:], strict=True):
            self._states.append(self._led(self._states[-1], float(before), float(after)))
            self.radii.append(self._radius(self._states[-1]))

    def stroke(self, radius: float) -> float:
        """The stroke, from its described value, that is nearest to it and gives a radius (m)."""
        from scipy.optimize import brentq

        over = np.array(self.radii) - radius
        crossed = np.flatnonzero((over[:-1] <= 0.0) != (over[1:] <= 0.0))
        if not crossed.size:
            raise SceneError(
                f"radius {radius:g} m: {self._label!r} brings the tip from {min(self.radii):.4g} to "
                f"{max(self.radii):.4g} m with the other coordinates as they are; give one between, or "
                "another pose of these (coordinates=)"
            )
        i = int(min(crossed, key=lambda k: abs(self._value(float(self._times[k])))))

        def off(time: float) -> float:
            return self._radius(self._evaluator.project(time, self._states[i])) - radius

        return self._value(brentq(off, self._times[i], self._times[i + 1], xtol=CLOSE))

    def _value(self, time: float) -> float:
        return float(self._low + self._rate * (time - self._begin))

    def _led(self, state: Array, start: float, end: float) -> Array:
        for time in np.linspace(start, end, int(np.ceil((end - start) / STEP)) + 1)[1:]:
            state = self._evaluator.project(float(time), state)
        return state

    def _radius(self, state: Array) -> float:
        poses = np.array(state[: 7 * len(self._scene.bodies)]).reshape(-1, 7)
        centres = poses[:, :3].copy()  # the state holds those of bodies, and the reference points of vessels
        floating = {vessel.body for vessel in self._scene.vessels.values()}
        for i, (name, body) in enumerate(self._scene.bodies.items()):
            if name in floating:
                centres[i] += rotation_matrix(poses[i, 3:]) @ body.center_of_mass
        return float(tip_radius(self._scene, self._roles, centres, poses[:, 3:]))
