"""Channels that Python makes of what the core records: strokes, loads, motions, angles, expressions."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seacrane.analysis.least_pulls import least_pulls
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
from seacrane.run.channel_names import (
    has_slew,
    is_rated,
    lowest_segments,
    missing_names,
    on_cranes,
    with_sources,
)
from seacrane.scene.recorded import Clearance, distance_from_box, picked, programs

Array = NDArray[np.float64]
Places = Mapping[str, tuple[str, str]]  # joint coordinates by label
CHEAP = frozenset(
    ["stroke", "stroke_rate", "cylinder_force", "cylinder_pressure", "slew_angle", "slew_torque",
     "link_tension", "hook_load", "clearance"]
)  # fmt: skip
# Made of those of their parts that are recorded; the others need all of them.
OF_SOME = frozenset(
    ["cylinder_force", "cylinder_pressure", "slew_torque", "hook_load", "slack_margin", "utilisation"]
)


def named_channels(
    scene: Description, arrays: Mapping[str, Array], asked: Collection[str] | None = None
) -> dict[str, Array]:
    """Channels of the core, and those that are made of them.

    `asked`: which of those that cost most are wanted; None: all.
    """
    wanted = [name for name in MADE if asked is None or name in asked or name in CHEAP]
    out = {**arrays, **derived_channels(scene, arrays, wanted)}
    return {name: np.ascontiguousarray(values) for name, values in out.items()}


def derived_channels(
    scene: Description, arrays: Mapping[str, Array], wanted: Iterable[str]
) -> dict[str, Array]:
    """Those of `MADE` that are wanted, that the scene has and whose parts are recorded."""
    made = _Made(scene, arrays)
    parts = {name: DERIVED[name].made_of for name in wanted}
    found = [name for name in parts if name in OF_SOME or all(part in arrays for part in parts[name])]
    missing = missing_names(scene, found)
    values = {name: getattr(made, name)() for name in found if name not in missing}
    return {name: squeezed(name, array) for name, array in values.items() if array is not None}


def squeezed(name: str, array: Array) -> Array:
    """Without the axis that only several vessels, slews or hooks have, where there is one of them."""
    kind = CHANNELS[channel_of(name)]
    several = len(kind.dims_of_several) > len(kind.dims) and array.ndim == len(kind.dims_of_several)
    return array[:, 0] if several and array.shape[1] == 1 else array


class _Made:
    """A method for each channel, by its name; None where its parts are not recorded."""

    def __init__(self, scene: Description, arrays: Mapping[str, Array]) -> None:
        self.scene, self.arrays = scene, arrays

    def stroke(self) -> Array | None:
        return self._recorded("coordinate", self._strokes)

    def stroke_rate(self) -> Array | None:
        return self._recorded("coordinate_rate", self._strokes)

    def cylinder_force(self) -> Array | None:
        return self._driven(self._strokes)

    def cylinder_pressure(self) -> Array | None:
        """In the loaded chambers of the cylinders whose areas are known."""
        areas = piston_areas(self.scene)
        forces = self._driven({label: self._strokes[label] for label in areas})
        if forces is None:
            return None
        return np.column_stack([pressure(forces[:, i], pair) for i, pair in enumerate(areas.values())])

    def slew_angle(self) -> Array | None:
        """Counted on over whole turns."""
        angles = self._recorded("coordinate", slews(self.scene))
        return None if angles is None else np.unwrap(angles, axis=0)

    def slew_torque(self) -> Array | None:
        return self._driven(slews(self.scene))

    def link_tension(self) -> Array:
        """Of a line in the place of a link its hook load."""
        names = names_of_suspensions(self.scene)
        known = self.arrays["tension"] if self._loads is None else self._loads
        unknown = np.full(len(known), np.nan)
        columns = [names.index(one.suspension.channel) for one in on_cranes(self.scene)]
        return np.stack([known[:, i] if i < known.shape[1] else unknown for i in columns], axis=1)

    def hook_load(self) -> Array | None:
        return self._loads

    def slack_margin(self) -> Array | None:
        """Zero of a sling that carries nothing at rest."""
        if self._loads is None:
            return None
        loads, names = self._loads, names_of_suspensions(self.scene)
        columns = [
            loads[:, names.index(name)] / pull if pull > 0.0 else np.zeros(len(loads))
            for name, pull in least_pulls(self.scene).items()
        ]
        return np.stack(columns, axis=1) if columns else None

    def utilisation(self) -> Array | None:
        """NaN of a crane without a table; infinite beyond its last radius."""
        if self._loads is None or not all(name in self.arrays for name in POSE):
            return None
        loads, names = self._loads, names_of_suspensions(self.scene)
        columns = [self._used(one, loads[:, names.index(one.suspension.channel)])
                   for one in on_cranes(self.scene)]  # fmt: skip
        return np.stack(columns, axis=1)

    def clearance(self) -> Array:
        return np.stack([self._clearance(one) for one in self.scene.clearances.values()], axis=1)

    def immersed_depth(self) -> Array | None:
        return immersed_depths(self.scene, self.arrays)

    def tip_velocity(self) -> Array:
        every = tips(self.scene).values()
        return np.stack([velocity_of(self.scene, self.arrays, *place) for place in every], axis=1)

    def swing(self) -> Array:
        hangs = [self._at(one.load, one.point) - self._at(*one.hangs_from) for one in on_cranes(self.scene)]
        return np.stack([swing_of(hang) for hang in hangs], axis=1)

    def sling_angle(self) -> Array:
        found: dict[str, Array] = {}
        for one in suspensions(self.scene):
            up = self._at(*one.upper) - self._at(*one.lower)
            angle = np.arctan2(up[:, 2], np.hypot(up[:, 0], up[:, 1]))
            found |= dict.fromkeys((one.channel, *one.parts), angle)
        return np.stack([found[name] for name in names_of_suspensions(self.scene)], axis=1)

    def offlead(self) -> Array:
        return self._leads[0]

    def sidelead(self) -> Array:
        return self._leads[1]

    def heel(self) -> Array:
        turn = rotation_matrix(self.arrays["quaternion"])
        return np.asarray(np.arctan2(turn[..., 2, 1], turn[..., 2, 2]))

    def trim(self) -> Array:
        turn = rotation_matrix(self.arrays["quaternion"])
        return np.asarray(np.arcsin(np.clip(-turn[..., 2, 0], -1.0, 1.0)))

    def yaw(self) -> Array:
        turn = rotation_matrix(self.arrays["quaternion"])
        return np.asarray(np.arctan2(turn[..., 1, 0], turn[..., 0, 0]))

    def hook_speed(self) -> Array:
        ends = lower_ends(self.scene)
        return np.stack([velocity_of(self.scene, self.arrays, *end)[:, 2] for end in ends], axis=1)

    def wire_paid_out(self) -> Array:
        wound = winches_of(self.scene.loads).values()
        return self._lengths([float(one.length.evaluate([0.0])[0, 0]) / one.share for one in wound])

    def wire_spare(self) -> Array:
        return self._lengths([one.minimum_length for one in winches_of(self.scene.loads).values()])

    @property
    def _strokes(self) -> Places:
        return {label: (joint, "displacement") for label, joint in cylinders(self.scene).items()}

    @cached_property
    def _loads(self) -> Array | None:
        return hook_loads(self.scene, self.arrays)

    @cached_property
    def _leads(self) -> tuple[Array, Array]:
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
        tip, hook = self._at(*one.hangs_from), self._at(*one.suspension.lower)
        out = tip - self._at(slew.first, slew.first_frame.point)
        out[:, 2] = 0.0
        with np.errstate(invalid="ignore"):  # a tip on the slew axis has no plane: NaN
            out /= np.linalg.norm(out, axis=1, keepdims=True)
        across = np.stack([-out[:, 1], out[:, 0], np.zeros(len(out))], axis=1)
        hang = hook - tip
        down = -hang[:, 2]
        return (
            np.arctan2(np.einsum("ij,ij->i", hang, out), down),
            np.arctan2(np.einsum("ij,ij->i", hang, across), down),
        )

    def _used(self, one: Hung, load: Array) -> Array:
        """Hook load over what the crane's table allows there with its design factor, (time,)."""
        if one.crane is None or not is_rated(one.crane):
            return np.full(len(load), np.nan)
        radius = tip_radius(self.scene, one.crane, self.arrays["position"], self.arrays["quaternion"])
        allowed = allowed_at(one.crane.capacity, radius) * one.crane.design_factor * self.scene.gravity
        with np.errstate(divide="ignore"):
            return np.asarray(load / allowed)

    def _at(self, body: str, point: ArrayLike) -> Array:
        return position_of(self.scene, self.arrays, body, point)

    def _recorded(self, channel: str, wanted: Places) -> Array | None:
        """Columns of joint coordinates; None unless all of them are recorded."""
        recorded = list(self.scene.recorded.values())
        if not all(place in recorded for place in wanted.values()):
            return None
        return self.arrays[channel][:, [recorded.index(place) for place in wanted.values()]]

    def _driven(self, wanted: Places) -> Array | None:
        """Loads along joint coordinates; None unless something is known to act along all of them."""
        columns = [self._drive_load(place) for place in wanted.values()]
        known = [column for column in columns if column is not None]
        return np.column_stack(known) if known and len(known) == len(columns) else None

    def _drive_load(self, wanted: tuple[str, str]) -> Array | None:
        """What actuators, the driver and hydraulic cylinders apply along a joint coordinate together."""
        slides = [slide_of(self.scene, one) for one in hydraulic_cylinders(self.scene).values()]
        acting: dict[str, list[tuple[str, str] | None]] = {
            "actuator_force": [(one.joint, one.coordinate) for one in self.scene.actuators.values()],
            "driver_force": [(one.joint, one.coordinate) for one in self.scene.drivers.values()],
            "hydraulic_force": [None if slide is None else (slide, "displacement") for slide in slides],
        }
        loads = [
            self.arrays[channel][:, i]
            for channel, places in acting.items()
            for i, place in enumerate(places)
            if place == wanted and channel in self.arrays
        ]
        return sum(loads[1:], loads[0].copy()) if loads else None

    def _clearance(self, gap: Clearance) -> Array:
        center, turn = self._at(gap.body, gap.center), np.eye(3)[None]
        if gap.body in self.scene.bodies:
            turn = rotation_matrix(self.arrays["quaternion"][:, list(self.scene.bodies).index(gap.body)])
        found = []
        for point in (self.scene.points[name] for name in gap.points):
            away = self._at(point.body, point.point) - center
            found.append(distance_from_box((away[:, None, :] @ turn)[:, 0], gap.size))
        return np.asarray(np.min(found, axis=0))

    def _lengths(self, over: list[float]) -> Array:
        """Unstretched lengths of the lines on winches over given ones, m."""
        lines, wound = list(lines_of(self.scene.loads)), winches_of(self.scene.loads).values()
        lengths = self.arrays["line_unstretched_length"][:, [lines.index(one.name) for one in wound]]
        return np.asarray(lengths / [one.share for one in wound] - over)


MADE = tuple(name for name in vars(_Made) if name in DERIVED)


def hook_loads(scene: Description, arrays: Mapping[str, Array]) -> Array | None:
    """Loads (time, suspension), N; None where there is none, or the core recorded too little.

    Of a rod or wire its tension. Of a line the resultant of all its sections on the body that it reaches
    last, from its first point on: of n falls n times the tension where they are parallel. Of the lowest
    segment of a line with mass, with the tension at the line's end.
    """
    lines = list(lines_of(scene.loads).values())
    lowest = lowest_segments(scene)
    parts = [arrays["tension"]] if "tension" in arrays else []
    if lines:
        needed = ("line_tension", *POSE, *(["end_tension"] if lowest else []))
        if not all(name in arrays for name in needed):
            return None
        for i, line in enumerate(lines):
            whole = lowest.get(line.name)
            pull = arrays["line_tension"][:, i] if whole is None else arrays["end_tension"][:, whole, 1]
            parts.append((pull * _falls(scene, arrays, line))[:, None])
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
