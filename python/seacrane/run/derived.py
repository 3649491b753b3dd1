"""Channels that Python makes of what the core records: strokes, loads, motions, angles, expressions."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from functools import cached_property, reduce
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from seacrane import _core
from seacrane.analysis.least_pulls import least_pulls
from seacrane.arrays import Array
from seacrane.description.channels import CHANNELS, DERIVED, OWN, channel_of
from seacrane.description.crane_parts import cylinders, piston_areas, slews, tip_radius, tips
from seacrane.description.description import Description
from seacrane.description.expression import Curve, Number, values_of, worked_out
from seacrane.description.hydraulic_cylinders import hydraulic_cylinders, slide_of
from seacrane.description.loads import lines_of, path_of, winches_of
from seacrane.description.places import POSE, place_along, position_of, velocity_of
from seacrane.description.roles import allowed_at, pressure
from seacrane.description.suspension import (
    Hung,
    hooked_body,
    lower_ends,
    names_of_suspensions,
    suspensions,
)
from seacrane.description.wet_parts import immersed_depths
from seacrane.inputs.frames import rotation_matrix
from seacrane.result.record import Extremes
from seacrane.run.channel_names import (
    MONOTONE,
    has_slew,
    is_rated,
    lowest_segments,
    missing_names,
    on_cranes,
    sources_of,
    with_sources,
)
from seacrane.scene.recorded import distance_from_box, picked, programs

Places = Mapping[str, tuple[str, str]]  # joint coordinates by label
Falls = dict[str, Array]  # the resultant of unit tensions by line
CHEAP = frozenset(
    ["stroke", "stroke_rate", "cylinder_force", "cylinder_pressure", "slew_angle", "slew_torque",
     "link_tension", "hook_load", "clearance"]
)  # fmt: skip
# Made of those of their parts that are recorded; the others need all of them.
OF_SOME = frozenset(
    ["cylinder_force", "cylinder_pressure", "slew_torque", "hook_load", "slack_margin", "utilisation"]
)


def named_channels(
    scene: Description, arrays: Mapping[str, Array], asked: Collection[str] | None, falls: Falls | None
) -> dict[str, Array]:
    """Channels of the core, and those that are made of them.

    `asked`: which of those that are made are wanted; None: all. `falls`: as of `derived_channels`.
    """
    wanted = [name for name in MADE if asked is None or name in asked]
    out = {**arrays, **derived_channels(scene, arrays, wanted, falls)}
    return {name: np.ascontiguousarray(values) for name, values in out.items()}


def derived_channels(
    scene: Description, arrays: Mapping[str, Array], wanted: Iterable[str], falls: Falls | None = None
) -> dict[str, Array]:
    """Those of `MADE` that are wanted, that the scene has and whose parts are recorded.

    `falls` are what `hook_loads` found in these poses.
    """
    parts = {name: DERIVED[name].made_of for name in wanted}
    found = [name for name in parts if name in OF_SOME or all(part in arrays for part in parts[name])]
    missing = missing_names(scene, found)
    return _made(scene, arrays, [name for name in found if name not in missing], falls)


def _made(
    scene: Description, arrays: Mapping[str, Array], names: Iterable[str], falls: Falls | None
) -> dict[str, Array]:
    """Channels that the scene has."""
    made = _Made(scene, arrays, falls)
    values = {name: MADE[name](made) for name in names}
    return {name: squeezed(name, array) for name, array in values.items() if array is not None}


def squeezed(name: str, array: Array) -> Array:
    """Without the axis that only several vessels, slews or hooks have, where there is one of them."""
    kind = CHANNELS[channel_of(name)]
    several = len(kind.dims_of_several) > len(kind.dims) and array.ndim == len(kind.dims_of_several)
    return array[:, 0] if several and array.shape[1] == 1 else array


class _Made:
    """What channels of one scene are made of, by `MADE`; None where it is not recorded."""

    def __init__(self, scene: Description, arrays: Mapping[str, Array], falls: Falls | None = None) -> None:
        self.scene, self.arrays, self.falls = scene, arrays, falls

    @cached_property
    def strokes(self) -> Places:
        return {label: (joint, "displacement") for label, joint in cylinders(self.scene).items()}

    @cached_property
    def turns(self) -> Array:
        return np.asarray(rotation_matrix(self.arrays["quaternion"]))

    @cached_property
    def loads(self) -> Array | None:
        return hook_loads(self.scene, self.arrays, self.falls)

    def at(self, body: str, point: ArrayLike) -> Array:
        return position_of(self.scene, self.arrays, body, point)

    def velocities(self, places: Iterable[tuple[str, Any]]) -> Array:
        return np.stack([velocity_of(self.scene, self.arrays, *place) for place in places], axis=1)

    def coordinates(self, channel: str, wanted: Places) -> Array | None:
        """Columns of joint coordinates; None unless all of them are recorded."""
        recorded = list(self.scene.recorded.values())
        if not all(place in recorded for place in wanted.values()):
            return None
        return self.arrays[channel][:, [recorded.index(place) for place in wanted.values()]]

    @cached_property
    def drives(self) -> Mapping[tuple[str, str] | None, list[Array]]:
        """What actuators, drivers and cylinders apply, by the joint coordinate along which they do."""
        slides = [slide_of(self.scene, one) for one in hydraulic_cylinders(self.scene).values()]
        acting: dict[str, list[tuple[str, str] | None]] = {
            "actuator_force": [(one.joint, one.coordinate) for one in self.scene.actuators.values()],
            "driver_force": [(one.joint, one.coordinate) for one in self.scene.drivers.values()],
            "hydraulic_force": [None if slide is None else (slide, "displacement") for slide in slides],
        }
        found = defaultdict(list)
        for channel, places in acting.items():
            for i, place in enumerate(places if channel in self.arrays else ()):
                found[place].append(self.arrays[channel][:, i])
        return found

    def driven(self, wanted: Places) -> Array | None:
        """The same along some coordinates; None unless known of all."""
        columns = [self.drives.get(place, []) for place in wanted.values()]
        known = columns and all(columns)
        return np.column_stack([sum(loads[1:], loads[0]) for loads in columns]) if known else None

    def pressures(self) -> Array | None:
        """In the loaded chambers of the cylinders whose areas are known."""
        areas = piston_areas(self.scene)
        forces = self.driven({label: self.strokes[label] for label in areas})
        if forces is None:
            return None
        return np.column_stack([pressure(forces[:, i], pair) for i, pair in enumerate(areas.values())])

    def slew_angles(self) -> Array | None:
        """Counted on over whole turns."""
        angles = self.coordinates("coordinate", slews(self.scene))
        if angles is None or (np.abs(np.diff(angles, axis=0)) < np.pi).all():
            return angles
        return np.unwrap(angles, axis=0)

    def link_tensions(self) -> Array:
        """Of a line in the place of a link its hook load."""
        names = names_of_suspensions(self.scene)
        known = self.arrays["tension"] if self.loads is None else self.loads
        unknown = np.full(len(known), np.nan)
        columns = [names.index(one.suspension.channel) for one in on_cranes(self.scene)]
        return np.stack([known[:, i] if i < known.shape[1] else unknown for i in columns], axis=1)

    def slack_margins(self) -> Array | None:
        """Zero of a sling that carries nothing at rest."""
        if self.loads is None:
            return None
        loads, names = self.loads, names_of_suspensions(self.scene)
        columns = [
            loads[:, names.index(name)] / pull if pull > 0.0 else np.zeros(len(loads))
            for name, pull in least_pulls(self.scene).items()
        ]
        return np.stack(columns, axis=1) if columns else None

    def utilisation(self) -> Array | None:
        """Hook load over what the crane's table allows there with its design factor.

        NaN of a crane without a table; infinite beyond its last radius.
        """
        if self.loads is None or not all(name in self.arrays for name in POSE):
            return None
        names, columns = names_of_suspensions(self.scene), []
        for one in on_cranes(self.scene):
            if one.crane is None or not is_rated(one.crane):
                columns.append(np.full(len(self.loads), np.nan))
                continue
            radius = tip_radius(self.scene, one.crane, self.arrays["position"], self.arrays["quaternion"])
            allowed = allowed_at(one.crane.capacity, radius) * one.crane.design_factor * self.scene.gravity
            with np.errstate(divide="ignore"):
                columns.append(self.loads[:, names.index(one.suspension.channel)] / allowed)
        return np.stack(columns, axis=1)

    def swings(self) -> Array:
        hangs = [self.at(one.load, one.point) - self.at(*one.hangs_from) for one in on_cranes(self.scene)]
        return np.stack([swing_of(hang) for hang in hangs], axis=1)

    def sling_angles(self) -> Array:
        found: dict[str, Array] = {}
        for one in suspensions(self.scene):
            up = self.at(*one.upper) - self.at(*one.lower)
            angle = np.arctan2(up[:, 2], np.hypot(up[:, 0], up[:, 1]))
            found |= dict.fromkeys((one.channel, *one.parts), angle)
        return np.stack([found[name] for name in names_of_suspensions(self.scene)], axis=1)

    @cached_property
    def leads(self) -> tuple[Array, Array]:
        """Offlead and sidelead of what hangs on cranes, rad, (time, hook) each.

        Both are angles from the vertical, of the line from the tip to where the rod or wire ends: offlead in
        the vertical plane through slew axis and tip, positive away from the crane; sidelead across it,
        positive towards increasing slew angles about a vertical axis that points up. NaN for a crane without
        a slew drive, and while the tip is on the slew axis.
        """
        unknown = np.full(len(self.arrays["position"]), np.nan)
        angles = [
            self._angles(one) if has_slew(self.scene, one.crane) else (unknown, unknown)
            for one in on_cranes(self.scene)
        ]
        offlead, sidelead = (np.stack(both, axis=1) for both in zip(*angles, strict=True))
        return offlead, sidelead

    def _angles(self, one: Hung) -> tuple[Array, Array]:
        assert one.crane is not None and one.crane.slew is not None
        slew = self.scene.joints[one.crane.slew[0]]
        tip, hook = self.at(*one.hangs_from), self.at(*one.suspension.lower)
        out = tip - self.at(slew.first, slew.first_frame.point)
        out[:, 2] = 0.0
        with np.errstate(invalid="ignore"):  # a tip on the slew axis has no plane: NaN
            out /= np.linalg.norm(out, axis=1, keepdims=True)
        across = np.stack([-out[:, 1], out[:, 0], np.zeros(len(out))], axis=1)
        hang = hook - tip
        return (
            np.arctan2(np.einsum("ij,ij->i", hang, out), -hang[:, 2]),
            np.arctan2(np.einsum("ij,ij->i", hang, across), -hang[:, 2]),
        )

    def clearances(self) -> Array:
        columns = []
        for gap in self.scene.clearances.values():
            center, turn = self.at(gap.body, gap.center), np.eye(3)[None]
            if gap.body in self.scene.bodies:
                index = list(self.scene.bodies).index(gap.body)
                turn = rotation_matrix(self.arrays["quaternion"][:, index])
            found = []
            for point in (self.scene.points[name] for name in gap.points):
                away = self.at(point.body, point.point) - center
                found.append(distance_from_box((away[:, None, :] @ turn)[:, 0], gap.size))
            columns.append(np.min(found, axis=0))
        return np.stack(columns, axis=1)

    def lengths_over(self, length: Callable[[_core.Line], float]) -> Array:
        """Unstretched lengths of the lines on winches over given ones, m."""
        lines, wound = list(lines_of(self.scene.loads)), winches_of(self.scene.loads).values()
        lengths = self.arrays["line_unstretched_length"][:, [lines.index(one.name) for one in wound]]
        return np.asarray(lengths / [one.share for one in wound] - [length(one) for one in wound])


MADE: Mapping[str, Callable[[_Made], Array | None]] = {
    "stroke": lambda made: made.coordinates("coordinate", made.strokes),
    "stroke_rate": lambda made: made.coordinates("coordinate_rate", made.strokes),
    "cylinder_force": lambda made: made.driven(made.strokes),
    "cylinder_pressure": _Made.pressures,
    "slew_angle": _Made.slew_angles,
    "slew_torque": lambda made: made.driven(slews(made.scene)),
    "link_tension": _Made.link_tensions,
    "hook_load": lambda made: made.loads,
    "slack_margin": _Made.slack_margins,
    "utilisation": _Made.utilisation,
    "clearance": _Made.clearances,
    "immersed_depth": lambda made: immersed_depths(made.scene, made.arrays),
    "tip_velocity": lambda made: made.velocities(tips(made.scene).values()),
    "swing": _Made.swings,
    "sling_angle": _Made.sling_angles,
    "offlead": lambda made: made.leads[0],
    "sidelead": lambda made: made.leads[1],
    "heel": lambda made: np.arctan2(made.turns[..., 2, 1], made.turns[..., 2, 2]),
    "trim": lambda made: np.arcsin(np.clip(-made.turns[..., 2, 0], -1.0, 1.0)),
    "yaw": lambda made: np.arctan2(made.turns[..., 1, 0], made.turns[..., 0, 0]),
    "hook_speed": lambda made: made.velocities(lower_ends(made.scene))[:, :, 2],
    "wire_paid_out": lambda made: made.lengths_over(lambda one: one.length.evaluate([0.0])[0, 0] / one.share),
    "wire_spare": lambda made: made.lengths_over(lambda one: one.minimum_length),
}


def hook_loads(scene: Description, arrays: Mapping[str, Array], falls: Falls | None = None) -> Array | None:
    """Loads (time, suspension), N; None where there is none, or the core recorded too little.

    Of a rod or wire its tension. Of a line the resultant of all its sections on the body that it reaches
    last, from its first point on: of n falls n times the tension where they are parallel. Of the lowest
    segment of a line with mass, with the tension at the line's end. `falls` are known of these poses.
    """
    lines, known = list(lines_of(scene.loads).values()), {} if falls is None else falls
    lowest = lowest_segments(scene)
    parts = [arrays["tension"]] if "tension" in arrays else []
    if lines:
        needed = ("line_tension", *POSE, *(["end_tension"] if lowest else []))
        if not all(name in arrays for name in needed):
            return None
        for i, line in enumerate(lines):
            whole, fall = lowest.get(line.name), known.get(line.name)
            if fall is None:
                fall = known[line.name] = _falls(scene, arrays, line)
            pull = arrays["line_tension"][:, i] if whole is None else arrays["end_tension"][:, whole, 1]
            parts.append((pull * fall)[:, None])
    return np.concatenate(parts, axis=1) if parts else None


def _falls(scene: Description, arrays: Mapping[str, Array], line: Any) -> Array:
    """The resultant of unit tensions on the hooked body, (time,)."""
    hooked = hooked_body(line)
    pull = np.zeros((len(arrays["position"]), 3))
    for (first, start), (second, end) in pairwise(path_of(line)):
        if (first == hooked) == (second == hooked):
            continue
        along = position_of(scene, arrays, second, end) - position_of(scene, arrays, first, start)
        unit = along / np.linalg.norm(along, axis=1, keepdims=True)
        pull += unit if first == hooked else -unit
    return np.asarray(np.linalg.norm(pull, axis=1))


def swing_of(hang: Array) -> Array:
    """Angle (n,) of hanging vectors (n, 3) from straight down, rad."""
    return np.asarray(np.arctan2(np.hypot(hang[:, 0], hang[:, 1]), -hang[:, 2]))


def followed_extremes(
    trail: Mapping[str, Array],
    outputs: Mapping[str, Array],
    made_of: Mapping[str, set[str]],
    named: Callable[[Mapping[str, Array], set[str]], Mapping[str, Array]],
) -> dict[str, tuple[Array, Array]]:
    """Least and largest values of derived channels, from what the core kept of every step (`trail`).

    `named` makes channels of those of the core; `made_of` is that of `followed`.
    """
    names = {
        name for name, sources in made_of.items() if name in outputs and sources and sources <= trail.keys()
    }
    if not names:
        return {}
    at = np.searchsorted(outputs["time"], trail["time"])
    seen = at < len(outputs["time"])
    found = {}
    for name, values in named(trail, names).items():
        if name in names:
            least, largest = outputs[name].copy(), outputs[name].copy()
            np.fmin.at(least, at[seen], values[seen])
            np.fmax.at(largest, at[seen], values[seen])
            found[name] = least, largest
    return found


def derived_extremes(
    scene: Description, arrays: Mapping[str, Array], extremes: Extremes, channels: Mapping[str, Array],
    falls: Falls | None,
) -> dict[str, tuple[Array, Array]]:  # fmt: skip
    """Least and largest values of derived channels, from those of what they rise or fall with.

    `channels` has their values at the outputs, `falls` those of their poses.
    """
    names = [one for one in MONOTONE if one in channels and any(part in extremes for part in sources_of(one))]
    if not names:
        return {}
    known, found = {name: values for name, values in arrays.items() if name != "time"}, {}
    falls = None if extremes.keys() & set(POSE) else falls  # else in the same poses
    ends = [
        _made(scene, known | {name: both[i] for name, both in extremes.items()}, names, falls) for i in (0, 1)
    ]
    for name in names:
        if all(name in one for one in ends):
            every = [*(one[name] for one in ends), channels[name]]
            found[name] = reduce(np.minimum, every), reduce(np.maximum, every)
    return found


def own_values(
    scene: Description, arrays: Mapping[str, Array], names: Mapping[str, Sequence[str]], count: int
) -> Array | None:
    """Values of expressions, (count, expression); None where there is none or a part was not recorded."""
    if not scene.channels or not all(name in arrays for name in with_sources(scene, [OWN])):
        return None

    def leaf(step: Number | Curve) -> Array:
        if isinstance(step, Number):
            return np.asarray(step.value)
        if step.along:
            return place_along(scene, arrays, step)
        pick = picked(scene, "channel", step)
        array = arrays[pick.channel]
        for dim in reversed(CHANNELS[pick.channel].dims_of(array.ndim)[1:]):
            array = array[..., names[dim].index(pick.names[dim]) if dim in pick.names else 0]
        return array

    columns = [worked_out(program, leaf, values_of) for program in programs(scene).values()]
    return np.stack([np.broadcast_to(column, count) for column in columns], axis=1)
