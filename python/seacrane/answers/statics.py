"""statics(): a lift at rest in every pose asked for."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.analysis.crane_poses import crane_of, path_through, places_of, posed, values_of
from seacrane.analysis.rest_state import rest_states
from seacrane.analysis.stability import Growing, growing
from seacrane.answers.reach import Reach, luffing
from seacrane.answers.rest_columns import HOOK_STIFFNESS, AtRest, columns_of
from seacrane.description.description import Description
from seacrane.description.places import ANGLES
from seacrane.description.roles import CraneRoles
from seacrane.errors import SceneError
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.keywords import named
from seacrane.inputs.plausible import angle_of
from seacrane.one_thread import one_thread
from seacrane.plotting.table import Answer, Column, Table
from seacrane.validity.left_range import LARGEST_HEEL
from seacrane.warnings import LargeHeelWarning, UnstableRestWarning

Array = NDArray[np.float64]
NOTHING = 1e-8  # m, deg, kN, t: as printed
HOOK = "hook load"  # printed in t
Columns = dict[str, tuple[str, float]]
Pose = Mapping[str, float]


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Statics(Answer):
    """A lift at rest in every pose asked for. Made by `statics`; prints as a table.

    Attributes
    ----------
    scene : str
        Its name.
    poses : mapping of str to ndarray or float
        Values along each axis of the grid: "slew" (rad), "radius" (m), strokes (m) and luffs
        (rad) by their labels;
        a number that was given as one makes no axis. Empty for the pose described.
    columns : mapping of str to ndarray or float
        Values over the grid, numbers where it has no axis, SI; ``statics["GM"]`` is one of them.
    units : mapping of str to str
        Of each column: rad, m, N, N/m, N m, Pa. It prints in deg, kN, kN m, bar, hook loads
        in t and stiffness in mm/kN.
    pose_units : mapping of str to str
        Of each axis of the grid: rad or m.
    gravity : float
        m/s2, by which hook loads are printed in t.
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


def _unit(roles: CraneRoles | None, name: str) -> str:
    place = None if roles is None else places_of(roles).get(name)
    return "rad" if place is not None and place[1] in ANGLES else "m"


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
    axes, roles = _axes(slew, radius, coordinates), None
    if axes:
        roles = crane_of(scene, crane)
    every = [np.atleast_1d(values) for values in axes.values()]
    grid = [dict(zip(axes, one, strict=True)) for one in itertools.product(*every)]
    shape = tuple(len(values) for values in axes.values() if np.ndim(values))
    judge = RestJudge(scene)
    rows = [judge.seen(one, pose) for pose, one in zip(grid, resting(scene, roles, grid, luff), strict=True)]
    judge.warn()
    return Statics(
        scene=scene.name,
        poses=axes,
        columns={name: _over(shape, [row[name][1] for row in rows]) for name in rows[0]},
        units={name: unit for name, (unit, _) in rows[0].items()},
        pose_units={name: _unit(roles, name) for name in axes},
        gravity=scene.gravity,
    )


def _over(shape: tuple[int, ...], values: list[float]) -> Any:
    """Values over a grid; one number where it has no axis."""
    return np.array(values).reshape(shape)[()] + 0.0


def _axes(slew: Any, radius: Any, coordinates: Mapping[str, Any] | None) -> dict[str, Any]:
    given = {"slew": slew, "radius": radius}
    axes = {name: _axis(f"statics: {name}", v) for name, v in given.items() if v is not None}
    for label, values in (coordinates or {}).items():
        axes[label] = _axis(f"statics: coordinate {label!r}", values)
    for angle in np.atleast_1d(axes.get("slew", ())):
        angle_of("statics: slew", float(angle))
    return axes


def _axis(what: str, given: Any) -> Any:
    """A row of numbers, or a number where one was given."""
    values = values_of(what, given)
    return values if np.ndim(given) else values[0]


def resting(
    scene: Description,
    roles: CraneRoles | None,
    grid: list[dict[str, float]],
    luff: str | None,
) -> Iterator[AtRest]:
    """The scene at rest in each pose of a grid, by the names of its axes."""
    places = {
        f"{one.prefix}{label}": place
        for one in scene.roles.values()
        for label, place in places_of(one).items()
    }
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
        outside = (limit.joint, limit.coordinate) == place and not limit.minimum <= value <= limit.maximum
        if outside:
            unit = "rad" if place[1] in ANGLES else "m"
            raise SceneError(
                f"statics: {label} is {value:g} {unit}, outside its range of {limit.minimum:g} to "
                f"{limit.maximum:g} {unit} from the described pose; give one within"
            )


class RestJudge:
    """Looks at rest states one after another, and tells the worst of them at the end."""

    def __init__(self, scene: Description) -> None:
        self._name, self._poses = scene.name, 0
        self._falling: list[tuple[Growing, str]] = []
        self._heeled: list[tuple[float, str]] = []

    def seen(self, at_rest: AtRest, pose: Pose) -> Columns:
        """The columns of a state at rest."""
        columns, where = columns_of(at_rest), _where(pose)
        self._poses += 1
        grows = growing(at_rest.scene, at_rest.model, at_rest.state)
        stability = [f"{name} {value:.3g} {unit}" for name, (unit, value) in columns.items() if _is_gm(name)]
        if grows:
            self._falling.append((grows[0], f"{where}{', '.join(stability)}"))
        for name, (_, value) in columns.items():
            if name.split(" ")[0] in ("heel", "trim") and abs(value) > LARGEST_HEEL:
                self._heeled.append((abs(value), f"{where}{name} is {np.degrees(value):.3g} deg"))
        return columns

    def warn(self) -> None:
        """Warn of the pose in which most grows fastest, and of that with the largest heel."""
        if self._falling:
            worst, told = max(self._falling, key=lambda one: one[0].value.real)
            warn_caller(
                f"statics: scene {self._name!r} does not stay at rest in {len(self._falling)} of "
                f"{self._poses} poses; {told or 'as described'}: {worst.label} {worst.words}. Lower "
                "the weights, take less on the hook, or hold what tips over",
                UnstableRestWarning,
            )
        if self._heeled:
            _, told = max(self._heeled)
            warn_caller(
                f"statics: {told}, beyond {np.degrees(LARGEST_HEEL):.0f} deg in {len(self._heeled)} of "
                f"{self._poses} poses: restoring is linear, so that heel, GM and all that follows from them "
                "are not those of the ship there. Take less on the hook or nearer, add ballast "
                "(Scene.add_ballast), or look at righting_arms",
                LargeHeelWarning,
            )


def _is_gm(name: str) -> bool:
    return name == "GM" or name.startswith("GM ")


def _where(pose: Pose) -> str:
    if not pose:
        return ""
    return f"at {', '.join(f'{name} {value:.4g}' for name, value in pose.items())} "
