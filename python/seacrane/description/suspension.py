"""What hangs on what: rods, wires and lines by the bodies that they carry, whatever their rung."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations, pairwise
from typing import Any

from seacrane import _core
from seacrane.description.description import Description, all_loads
from seacrane.description.given import floating_bodies
from seacrane.description.loads import holding_loads, joint_ends, lines_of, path_of, whole_of
from seacrane.description.once import once_in_any_sea
from seacrane.description.roles import CraneRoles
from seacrane.description.rungs import RIGID, WITH_MASS
from seacrane.description.wet_parts import buoyancy_of, water_in, wet_bodies

ROD = "rod"
Point = tuple[float, float, float]
Place = tuple[str, Point]  # a body, or the ground, and a point in its coordinates, m


@dataclass(frozen=True, kw_only=True)
class Suspension:
    """One rod, wire or line, by what it holds at its lower end."""

    name: str  # of the joint, or of the line; of a line with mass the whole of it
    channel: str  # its name, or that of its lowest segment, in the channels over `suspension`
    top: str  # that of its uppermost segment
    rung: str  # "rod", which pushes too, or that of a line
    first: Place  # where it begins
    upper: Place  # both ends of its last straight part
    lower: Place
    falls: int  # straight parts that hold the lower body
    parts: frozenset[str]  # the elements that it is made of

    @property
    def held_at(self) -> Place:
        """On what carries it: the upper end of its last straight part, or of all of a line with mass."""
        return self.first if self.rung == WITH_MASS else self.upper


@dataclass(frozen=True, kw_only=True)
class Hung:
    """A load that hangs on a crane, or on something else by itself."""

    label: str  # "hook" after the crane's prefix; without a crane the name of the suspension
    crane: CraneRoles | None
    suspension: Suspension  # on which it hangs, with block and slings where it has them
    load: str
    point: Point  # of it: where it is held, in the middle of its slings
    weight: float | None  # N, of all that the suspension carries; None where something else carries it too

    @property
    def hangs_from(self) -> Place:
        """The tip of its crane, or the upper end of what holds it."""
        if self.crane is None or self.crane.tip is None:
            return self.suspension.upper
        return self.crane.tip


@once_in_any_sea
def suspensions(scene: Description) -> tuple[Suspension, ...]:
    """Rods and wires, then lines, in the order of the scene."""
    wires = {load.joint for load in scene.loads.values() if getattr(load, "kind", None) == "wire"}
    found = []
    for name, joint in _distances(scene).items():
        first, second = map(_place, joint_ends(joint))
        found.append(Suspension(
            name=name, channel=name, top=name, rung=RIGID if name in wires else ROD, first=first, upper=first,
            lower=second, falls=1, parts=frozenset([name]),
        ))  # fmt: skip
    whole: dict[str, dict[str, _core.Line]] = {}
    for name, line in lines_of(scene.loads).items():
        whole.setdefault(whole_of(name, line), {})[name] = line
    joints = [one.name for one in found]
    return (*found, *(_of_lines(name, segments, joints) for name, segments in whole.items()))


@once_in_any_sea
def names_of_suspensions(scene: Description) -> Sequence[str]:
    """Along `suspension`: rods, wires, then lines; a line with the name of a joint is "<name> line"."""
    joints = list(_distances(scene))
    return [*joints, *(_beside(name, joints) for name in lines_of(scene.loads))]


def lower_ends(scene: Description) -> list[Place]:
    """Where each of `names_of_suspensions` ends: of a line the last of its points on what hangs."""
    ends = [_place(joint_ends(joint)[1]) for joint in _distances(scene).values()]
    for line in lines_of(scene.loads).values():
        hooked = hooked_body(line)
        ends.append([_place(end) for end in path_of(line) if end[0] == hooked][-1])
    return ends


def _distances(scene: Description) -> dict[str, _core.Joint]:
    return {name: joint for name, joint in scene.joints.items() if joint.kind == "distance"}


@once_in_any_sea
def weights_on(scene: Description) -> Mapping[str, tuple[float, int]]:
    """Weight (N) on every suspension that alone carries it, and on how many falls, by its `channel`."""
    ties = _ties_of(scene)
    held = [(one, ties.weight_of(ties.below(one))) for one in suspensions(scene)]
    return {end: (weight, one.falls) for one, own in held for end, weight in _ends(scene, one, own)}


@once_in_any_sea
def static_weights(scene: Description) -> Mapping[str, tuple[float, int]]:
    """`weights_on`, without what hangs in water: that carries too, by how deep it is."""
    wet, ties = wet_bodies(scene), _ties_of(scene)
    held = [one for one in suspensions(scene) if wet & set(ties.below(one))]
    left_out = {name for one in held for name in (one.channel, one.top)}
    return {channel: pair for channel, pair in weights_on(scene).items() if channel not in left_out}


@once_in_any_sea
def least_weights(scene: Description) -> Mapping[str, float]:
    """Least weight (N) at rest on every suspension that alone carries it, by its `channel`; none of what
    floats: the lesser of that in air, compartments empty, and that with all parts in water, compartments
    full."""
    ties = _ties_of(scene)
    held = [(one, _least_weight(scene, ties.below(one))) for one in suspensions(scene)]
    return {end: weight for one, own in held for end, weight in _ends(scene, one, own)}


def _ends(scene: Description, one: Suspension, weight: float) -> Iterator[tuple[str, float]]:
    """Channels of the lower and the upper end, with the weights (N) there; none without a weight."""
    if weight > 0.0:
        yield one.channel, weight
        yield one.top, weight + _ties_of(scene).weight_of(_inside(scene, one))


def _least_weight(scene: Description, bodies: Sequence[str]) -> float:
    """N, of bodies that hang; below zero: they float."""
    in_water = water_in(scene, bodies) - buoyancy_of(scene, bodies)
    return _ties_of(scene).weight_of(bodies) + min(in_water, 0.0)


@dataclass(frozen=True, kw_only=True)
class Rig:
    """What hangs on one suspension, or on several between the same two bodies, as slings do."""

    held: tuple[Suspension, ...]  # by which it hangs
    bodies: tuple[str, ...]  # that it is made of, that at the lower end of `held` first
    inner: tuple[Suspension, ...]  # what hangs on what inside it, such as slings below a block


@once_in_any_sea
def rigs(scene: Description) -> Sequence[Rig]:
    """All that hang on nothing else, are part of no larger one, and sink."""
    ties = _ties_of(scene)
    between: dict[tuple[str, str], list[Suspension]] = {}
    for one in suspensions(scene):
        between.setdefault((one.held_at[0], one.lower[0]), []).append(one)
    found = [(tuple(held), ties.below(*held)) for held in between.values()]
    out: list[Rig] = []
    for held, bodies in sorted(found, key=lambda pair: -len(pair[1])):
        if bodies and not any(set(bodies) <= set(other.bodies) for other in out):
            inner = [one for one in suspensions(scene) if one not in held and one.lower[0] in bodies]
            out.append(Rig(held=held, bodies=tuple(bodies), inner=tuple(inner)))
    return [rig for rig in out if _least_weight(scene, rig.bodies) > 0.0]


@once_in_any_sea
def line_weights(scene: Description) -> Mapping[str, tuple[float, int]]:
    """`weights_on` the lines without mass that stretch, by the name of the line."""
    stretching = [one for one in suspensions(scene) if one.rung not in (ROD, RIGID, WITH_MASS)]
    held = [(one, _ties_of(scene).weight(one)) for one in stretching]
    return {one.name: (weight, one.falls) for one, weight in held if weight is not None}


@once_in_any_sea
def bodies_below(scene: Description) -> Sequence[tuple[Suspension, Sequence[str]]]:
    """What hangs on each suspension and on nothing else, its own masses too; the uppermost one first."""
    held = [(one, _ties_of(scene).below(one)) for one in suspensions(scene)]
    found = [(one, [*below, *sorted(_inside(scene, one))]) for one, below in held if below]
    return sorted(found, key=lambda pair: -len(pair[1]))


@once_in_any_sea
def hung_loads(scene: Description) -> tuple[Hung, ...]:
    """What hangs on the cranes, then what hangs by itself on something else."""
    every, ties = suspensions(scene), _ties_of(scene)
    found: list[Hung] = []
    carried = set[str]()
    for roles in scene.roles.values():
        on_crane = _of_crane(roles, every, ties)
        if on_crane is not None:
            load = roles.payload if roles.payload in scene.bodies else _lowest(scene, on_crane)
            if load in scene.bodies:
                found.append(_hung(scene, f"{roles.prefix}hook", roles, on_crane, str(load)))
                carried |= {str(load), *ties.below(on_crane)}
    for one in every:
        if ties.weight(one) is not None and one.lower[0] not in carried:
            found.append(_hung(scene, one.name, None, one, _lowest(scene, one)))
            carried |= {found[-1].load, *ties.below(one)}
    return tuple(found)


def _of_crane(roles: CraneRoles, every: Sequence[Suspension], ties: _Ties) -> Suspension | None:
    """On what the load of a crane hangs, by its role, or from its tip."""
    if roles.link or roles.line:
        return next((one for one in every if one.name == (roles.link or roles.line)), None)
    tip = roles.tip and roles.tip[0]
    from_tip = [one for one in every if one.upper[0] == tip and ties.below(one)]
    return from_tip[0] if len(from_tip) == 1 else None


def _lowest(scene: Description, one: Suspension) -> str:
    """Among the bodies on a suspension, the heaviest that carries none of the others."""
    below = _ties_of(scene).below(one) or [one.lower[0]]
    carrying = {other.upper[0] for other in suspensions(scene) if other.name != one.name}
    lowest = [body for body in below if body not in carrying] or below
    return max(lowest, key=lambda body: scene.bodies[body].mass if body in scene.bodies else 0.0)


def _hung(scene: Description, label: str, crane: CraneRoles | None, one: Suspension, load: str) -> Hung:
    """With the middle of the points by which slings and hooks hold the load."""
    points = [one.lower[1]]
    if one.lower[0] != load:
        points = [other.lower[1] for other in suspensions(scene) if other.lower[0] == load]
        points += [
            _place(joint_ends(joint)[1])[1]
            for joint in scene.joints.values()
            if joint.kind == "spherical" and joint.second == load
        ]
    x, y, z = [sum(axis) / len(points) for axis in zip(*points, strict=True)] or (0.0, 0.0, 0.0)
    weight = _ties_of(scene).weight(one)
    return Hung(label=label, crane=crane, suspension=one, load=load, point=(x, y, z), weight=weight)


def hooked_body(line: Any) -> str:
    """The body that a line reaches last."""
    return str(list(dict.fromkeys(line.bodies))[-1])


def _of_lines(name: str, segments: Mapping[str, _core.Line], joints: Iterable[str]) -> Suspension:
    """What hangs on the ends of a line, or of the segments of one with mass from its first end on."""
    (highest, highest_line), (lowest, last) = next(iter(segments.items())), list(segments.items())[-1]
    path, hooked = path_of(last), hooked_body(last)
    spans = [pair for pair in pairwise(path) if (pair[0][0] == hooked) != (pair[1][0] == hooked)]
    upper, lower = sorted(spans[-1] if spans else path[-2:], key=lambda end: end[0] == hooked)
    return Suspension(
        name=name, channel=_beside(lowest, joints), top=_beside(highest, joints),
        rung=WITH_MASS if len(segments) > 1 or name != lowest else last.rung,
        first=_place(path_of(highest_line)[0]), upper=_place(upper), lower=_place(lower), falls=len(spans),
        parts=frozenset(segments),
    )  # fmt: skip


def _inside(scene: Description, one: Suspension) -> set[str]:
    """The masses between the segments of a line."""
    lines = lines_of(scene.loads)
    on = {body for part in one.parts if part in lines for body in lines[part].bodies}
    return {body for body in on if one.rung == WITH_MASS and body not in (one.first[0], one.lower[0])}


def _beside(name: str, joints: Iterable[str]) -> str:
    return f"{name} line" if name in joints else name


def _place(end: tuple[str, Any]) -> Place:
    x, y, z = map(float, end[1])
    return end[0], (x, y, z)


class _Ties:
    """Which bodies hold together by what carries weight: a graph of bodies, and its elements by name."""

    def __init__(self, scene: Description) -> None:
        self._bodies, self._gravity = dict(scene.bodies), scene.gravity
        self._held, self._ties = floating_bodies(scene), list(_ties(scene))
        self._below: dict[tuple[Suspension, ...], list[str]] = {}

    def weight(self, suspension: Suspension) -> float | None:
        """Weight of what hangs on it, N; None where that hangs on something else too."""
        return self.weight_of(self.below(suspension)) or None

    def weight_of(self, bodies: Iterable[str]) -> float:
        """N; of what feels no gravity nothing."""
        heavy = [self._bodies[body] for body in bodies if self._bodies[body].gravity]
        return sum(body.mass for body in heavy) * self._gravity

    def below(self, *held: Suspension) -> Sequence[str]:
        """The bodies that these alone carry, that at their end first; none where something else does too."""
        if held not in self._below:
            self._below[held] = self._reached(held)
        return self._below[held]

    def _reached(self, held: Sequence[Suspension]) -> list[str]:
        parts = frozenset[str]().union(*(one.parts for one in held))
        neighbours: dict[str, list[str]] = {}
        for name, first, second in self._ties:
            if name not in parts:
                neighbours.setdefault(first, []).append(second)
                neighbours.setdefault(second, []).append(first)
        found, ahead = [], [held[0].lower[0]]
        ends = {*(end[0] for one in held for end in (one.upper, one.first)), *self._held}
        while ahead:
            body = ahead.pop()
            if body in ends or body not in self._bodies:
                return []
            if body not in found:
                found.append(body)
                ahead += neighbours.get(body, [])
        return found


_ties_of = once_in_any_sea(_Ties)


def _ties(scene: Description) -> Iterator[tuple[str, str, str]]:
    """Name, first and second body of everything that may carry a weight."""
    seats = {load.joint for load in scene.loads.values() if getattr(load, "kind", None) == "seat"}
    for name, joint in scene.joints.items():
        if name not in seats and joint.kind != "free":
            yield name, joint.first, joint.second
    for name, line in lines_of(scene.loads).items():
        for first, second in combinations(dict.fromkeys(line.bodies), 2):
            yield name, first, second
    for load in holding_loads(all_loads(scene)):
        yield load.name, load.first, load.second
