"""Lines with mass: point masses between elastic segments, and the rest shape of their chain."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from itertools import pairwise
from typing import Any, cast

import numpy as np

from seacrane import _core
from seacrane.arrays import Array
from seacrane.description.description import GROUND, Description, require
from seacrane.description.elements import add_joint, put_load
from seacrane.description.loads import changed, lines_of, whole_of
from seacrane.errors import SceneError
from seacrane.inputs.checked import positive_of, shaped_of, texts_of
from seacrane.inputs.frames import rotation_matrix
from seacrane.one_thread import one_thread
from seacrane.scene.bodies import add_body
from seacrane.scene.line_fluid import Seabed, Wire

LARGEST_ERROR = 1e-12  # of the chain's length
LARGEST_COUNT = 500  # of iterations
SOFTEST = 1e-9  # of the reference force: below it a segment has no direction
LEAST_GAIN = 1e-4  # share of the expected fall that a step must bring
GYRATION = 0.005  # radius of gyration of a mass over its segment: nothing turns it, pictures draw it
MOST_SEGMENTS = 1000
STRAIGHT = 0.01  # of the span: a line that hangs slack by less starts straight where it has no rest shape
SUNK = 10.0  # times what a line sinks in at rest: no end of it begins deeper in a seabed
MOST_SHAPES, SAME_SHAPE = 30, 1e-9  # of which the last differ by less than this share of a segment


@dataclass(frozen=True, eq=False, kw_only=True)
class Chain:
    """A chain of equal segments between two points.

    Attributes
    ----------
    span : (3,) From the first end to the second, m.
    segment : Unstretched length of each segment, m.
    stiffness : EA, N.
    weights : (n - 1,) Of the masses between the n segments, N, along -z; below zero in water: they float up.
    bed : Height of a level seabed over the first end, m; None: there is none.
    bed_stiffness : Of it under each mass, N/m.
    """

    span: Array
    segment: float
    stiffness: float
    weights: Array
    bed: float | None = None
    bed_stiffness: float = 1.0

    @property
    def count(self) -> int:
        """The number of the segments."""
        return int(self.weights.size) + 1

    @one_thread
    def forces(self) -> Array | None:
        """Tension of each segment as a vector, (n, 3), N, from the first end on; None where there is no rest.

        The complementary energy, the sum of segment (|T|^2 / (2 EA) + |T|) less T . span, is convex in the
        force at the first end: Newton's method with a line search finds its minimum. A seabed bears the
        masses by further forces N >= 0, each with N^2 / (2 k) and N times the height of the second end: it is
        convex in all of them.
        """
        hung = np.zeros((self.count, 3))
        hung[1:, 2] = np.cumsum(self.weights)
        force = self._start(float(hung[-1, 2]))
        scale = max(float(np.linalg.norm(force)), abs(float(hung[-1, 2])))
        borne = 0 if self.bed is None else self.count - 1
        forces = np.concatenate([force, np.zeros(borne)])
        for _ in range(LARGEST_COUNT):
            tension = self._tension(forces, hung)
            gap = self._gap(tension, forces)
            free = np.ones(gap.size, dtype=bool)
            free[3:] = (forces[3:] > 0.0) | (gap[3:] < 0.0)
            if np.abs(gap[free]).max() <= LARGEST_ERROR * self.segment * self.count:
                return tension
            step = np.zeros(gap.size)
            step[free] = -np.linalg.solve(self._slope(tension, scale)[np.ix_(free, free)], gap[free])
            forces = self._moved(forces, hung, step, gap)
        return None

    def points(self, forces: Array) -> Array:
        """The places of the masses, (n - 1, 3), m from the first end."""
        return np.asarray(np.cumsum(self._spans(forces), axis=0)[:-1])

    def _start(self, weight: float) -> Array:
        """By the parabola of a shallow chain; along the span where it is taut."""
        length, span = self.segment * self.count, float(np.linalg.norm(self.span))
        flat = float(np.hypot(self.span[0], self.span[1]))
        size = abs(weight)  # below zero it floats up
        if span >= length or size == 0.0:
            pull = max(self.stiffness * (span / length - 1.0), 0.1 * size, 1e-6 * self.stiffness)
            return np.asarray(pull * self.span / span) - [0.0, 0.0, 0.5 * weight]
        sag = np.sqrt(3.0 * max((length**2 - self.span[2] ** 2) / max(flat, 0.01 * length) ** 2 - 1.0, 1e-6))
        level = 0.5 * size * max(flat, 0.01 * length) / length / sag
        rise = 0.5 * (size * self.span[2] / length / np.tanh(sag) - weight)
        ahead = self.span[:2] / flat if flat > 0.0 else np.array([1.0, 0.0])
        return np.array([*(level * ahead), rise])

    def _spans(self, tension: Array) -> Array:
        size = np.linalg.norm(tension, axis=1, keepdims=True)
        return np.asarray(self.segment * tension * (1.0 / self.stiffness + 1.0 / np.maximum(size, 1e-300)))

    def _tension(self, forces: Array, hung: Array) -> Array:
        tension = forces[:3] + hung
        if forces.size > 3:
            tension[1:, 2] -= np.cumsum(forces[3:])
        return np.asarray(tension)

    def _gap(self, tension: Array, forces: Array) -> Array:
        """Of the second end from its place, and of each mass over where the seabed bears its force, m."""
        spans = self._spans(tension)
        gap = spans.sum(axis=0) - self.span
        if self.bed is None:
            return np.asarray(gap)
        beyond = np.cumsum(spans[:0:-1, 2])[::-1]  # from each mass up to the second end
        return np.concatenate([gap, forces[3:] / self.bed_stiffness + self.span[2] - self.bed - beyond])

    def _slope(self, tension: Array, scale: float) -> Array:
        size = np.maximum(np.linalg.norm(tension, axis=1), SOFTEST * scale)[:, None, None]
        along = tension[:, :, None] / size
        across = (np.eye(3) - along * np.swapaxes(along, 1, 2)) / size
        each = np.eye(3) / self.stiffness + across
        whole = np.asarray(self.segment * each.sum(axis=0))
        if self.bed is None:
            return whole
        beyond = self.segment * np.cumsum(each[:0:-1, :, 2], axis=0)[::-1]
        later = np.maximum.outer(*[np.arange(len(beyond))] * 2)
        borne = beyond[later, 2] + np.eye(len(beyond)) / self.bed_stiffness
        return np.block([[whole, -beyond.T], [-beyond, borne]])

    def _energy(self, forces: Array, hung: Array) -> float:
        size = np.linalg.norm(self._tension(forces, hung), axis=1)
        stored = self.segment * (size**2 / (2.0 * self.stiffness) + size)
        energy = float(stored.sum() - forces[:3] @ self.span)
        if self.bed is None:
            return energy
        sunk = forces[3:] ** 2 / (2.0 * self.bed_stiffness) + forces[3:] * (self.span[2] - self.bed)
        return energy + float(sunk.sum())

    def _moved(self, forces: Array, hung: Array, step: Array, gap: Array) -> Array:
        """By a share of a step, halved until the energy falls as it should, as far as rounding shows it."""
        now, share = self._energy(forces, hung), 1.0
        rounding = 1e-13 * abs(now)
        while True:
            moved = forces + share * step
            moved[3:] = np.maximum(moved[3:], 0.0)
            fall = float(gap @ (moved - forces))
            if share < 1e-12 or self._energy(moved, hung) <= now + LEAST_GAIN * fall + rounding:
                return np.asarray(moved)
            share *= 0.5


@dataclass(frozen=True, kw_only=True)
class _End:
    """An end of a line: body and point (m) in its coordinates, and place (m) and velocity (m/s) of it."""

    body: str
    point: Array
    place: Array
    velocity: Array


def chain_of_segments(
    scene: Description, name: str, bodies: Any, points: Any, wire: Wire, *, EA: float | None, length: Any,
    damping_ratio: float, rung: str, settling: float,
) -> list[_core.Line]:  # fmt: skip
    """A line with mass between two points, in its rest shape; keywords as of `Scene.add_line`.

    Lines and bodies are "<name>.1", ... from the first end on; half a segment's mass sits at either end, on
    bodies "<name>.first" and "<name>.last" that are welded to what is not the ground. With a curve for its
    length the masses stay at equal shares of it, and what moves past them is "<name>.1 winding", ...
    """
    what = f"line {name!r}"
    first, last = _ends(scene, what, bodies, points)
    count = wire.segments
    if isinstance(count, bool) or not isinstance(count, int | np.integer) or not 1 <= count <= MOST_SEGMENTS:
        raise SceneError.of(
            f"{what}: segments", f"is {count!r}; give a whole number from 1 to {MOST_SEGMENTS}"
        )
    span = float(np.linalg.norm(last.place - first.place))
    wound = length if isinstance(length, _core.Curve) else None
    given = float(wound.evaluate([0.0])[0, 0]) if wound is not None else length
    whole = positive_of(f"{what}: length", span if given is None else given)
    per_length = positive_of(f"{what}: mass_per_length", wire.mass_per_length)
    step, mass = whole / count, per_length * whole / count
    wire = wire.checked(what, wound=wound is not None)
    weight = mass * scene.gravity - wire.displaced(step, scene.gravity)
    bed = cast(Seabed | None, wire.seabed)
    if bed is not None:
        _require_over(what, bed, (first, last), weight / step, wound=wound is not None)
    chain = Chain(
        span=last.place - first.place, segment=step, stiffness=positive_of(f"{what}: EA", EA),
        weights=np.full(count - 1, mass * scene.gravity),
        bed=None if bed is None else -bed.depth - float(first.place[2]),
        bed_stiffness=1.0 if bed is None else bed.stiffness * step,
    )  # fmt: skip
    lengths = step if wound is None else scaled(wound, 1.0 / count)
    places = _at_rest(what, chain, first.place, last.place, partial(wire.lifts, gravity=scene.gravity))
    inertia = np.full(3, mass * (GYRATION * step) ** 2)
    for i, place in enumerate(places, start=1):
        velocity = first.velocity + (last.velocity - first.velocity) * (i / count)
        add_body(scene, name=f"{name}.{i}", mass=mass, inertia=inertia, position=place, velocity=velocity)
    nodes = [(f"{name}.{i}", np.zeros(3)) for i in range(1, count)]
    path = [_tied(scene, f"{name}.first", first, 0.5 * mass, 0.5 * inertia), *nodes]
    path.append(_tied(scene, f"{name}.last", last, 0.5 * mass, 0.5 * inertia))
    lines = []
    for i, (one, two) in enumerate(pairwise(path), start=1):
        segment = _core.Line(
            name=f"{name}.{i}", bodies=[one[0], two[0]], points=[one[1], two[1]], EA=cast(float, EA),
            length=lengths, damping_ratio=damping_ratio, mass=mass, rung=rung, settling=settling,
        )  # fmt: skip
        lines.append(put_load(scene, segment))
        if wire.diameter > 0.0:
            put_load(scene, wire.along(f"{name}.{i}", (one, two), lengths))
        if wound is not None:
            put_load(scene, _winding(segment, per_length, (i, count)))
    if bed is not None:
        shares = [0.5, *[1.0] * (count - 1), 0.5]
        for node, place, share in zip(path, [first.place, *places, last.place], shares, strict=True):
            if node[0] != GROUND:
                under = bed.under(node, place, length=share * step, mass=share * mass, weight=share * weight)
                put_load(scene, under)
    return lines


def on_a_winch(scene: Description, name: str, winch: Mapping[str, Any]) -> _core.Line:
    """Put the first segment of a line with mass on a winch that pays out all of it, and tell that segment.

    Every segment, and the water about it, has its share of what is paid out, a state "<name>.length".
    """
    segments = [one for own, one in lines_of(scene.loads).items() if whole_of(own, one) == name]
    by = {"paid_out_by": name, "share": 1.0 / len(segments)}
    kinds = {
        "winding": "a Curve for its length, and the winch changes it; give the length at the start",
        "drag": "drag in a steady flow, which takes no winch; leave out its diameter, or choose medium 'sea'",
    }
    for kind, text in kinds.items():
        if f"{segments[0].name} {kind}" in scene.loads:
            raise SceneError(f"line {name!r}: has {text}")
    if any(f"{body} seabed" in scene.loads for one in segments for body in one.bodies):
        raise SceneError(f"line {name!r}: lies on a seabed and has a winch; leave one of them out")
    for i, segment in enumerate(segments, start=1):
        scene.loads[segment.name] = changed(segment, **by, **(winch if i == 1 else {}))
        if f"{segment.name} water" in scene.loads:
            scene.loads[f"{segment.name} water"] = changed(scene.loads[f"{segment.name} water"], **by)
        per_length = segment.mass / float(segment.length.evaluate([0.0])[0, 0])
        put_load(scene, _winding(segment, per_length, (i, len(segments)), paid_out_by=name))
    return cast(_core.Line, scene.loads[segments[0].name])


def _winding(segment: _core.Line, mass_per_length: float, place: tuple[int, int], **given: Any) -> Any:
    """What the ends of a segment gain, and what moves past them: the one of so many at a place from 1 on."""
    i, count = place
    return _core.WoundSpan(
        name=f"{segment.name} winding", first=segment.bodies[0], second=segment.bodies[1],
        first_point=segment.points[0], second_point=segment.points[1], mass_per_length=mass_per_length,
        length=segment.length, below_first=(count - i + 1) / count, below_second=(count - i) / count, **given,
    )  # fmt: skip


def _require_over(what: str, bed: Seabed, ends: tuple[_End, _End], weight: float, *, wound: bool) -> None:
    """Refuse a line that does not lie on a seabed; its weight in N/m."""
    if wound:
        raise SceneError(
            f"{what}: has a length that changes and a seabed; give a number for its length, or no seabed"
        )
    if not weight > 0.0:
        raise SceneError(
            f"{what}: weighs {weight:.4g} N/m less the water that it displaces, and would not lie on its "
            "seabed; give more mass_per_length, or no seabed"
        )
    for end in ends:
        sunk = -bed.depth - float(end.place[2])
        if end.body != GROUND and sunk > SUNK * weight / bed.stiffness:
            raise SceneError(
                f"{what}: its end on {end.body!r} is {sunk:.4g} m in the seabed, where it sinks in by "
                f"{weight / bed.stiffness:.4g} m at rest; lift it, or tie it to the ground, which may be an "
                "anchor in the seabed"
            )


def scaled(curve: _core.Curve, factor: float) -> _core.Curve:
    """A curve times a factor."""
    pieces = curve.to_pieces()
    cosines = np.array(pieces["cosines"], dtype=float).reshape(-1, 3) * [factor, 1.0, 1.0]
    return _core.Curve.pieces(
        starts=pieces["starts"],
        coefficients=(np.array(pieces["coefficients"], dtype=float) * factor).tolist(),
        cosines=cosines.tolist(),
    )


def _at_rest(
    what: str, chain: Chain, first: Array, last: Array, lifts: Callable[[Array, float], Array]
) -> Array:
    """Places of the masses, (n - 1, 3), m: in water, where what it lifts fits the shape that it makes."""
    places = first + _shape(what, chain)
    for _ in range(MOST_SHAPES):
        lift = lifts(np.vstack([first, places, last]), chain.segment)
        if not np.any(lift):
            break
        before, places = places, first + _shape(what, replace(chain, weights=chain.weights - lift))
        if np.abs(places - before).max(initial=0.0) < SAME_SHAPE * chain.segment:
            break
    return places


def _ends(scene: Description, what: str, bodies: Any, points: Any) -> tuple[_End, _End]:
    names = texts_of(f"{what}: bodies", bodies)
    if len(names) != 2:
        raise SceneError.of(f"{what}: bodies", f"has {len(names)} names; give those of its two ends")
    if names[0] == names[1]:
        raise SceneError(f"{what}: both ends are on {names[0]!r}; name two bodies")
    rows = shaped_of(f"{what}: points", points, (2, 3))
    if not np.all(np.isfinite(rows)):
        raise SceneError.of(f"{what}: points", f"holds {rows.tolist()}; give finite numbers")
    first, last = (_end(scene, what, *end) for end in zip(names, rows, strict=True))
    if not np.any(last.place - first.place):
        raise SceneError.of(f"{what}: points", f"are both at {first.place.tolist()} m; give two places")
    return first, last


def _end(scene: Description, what: str, name: str, point: Array) -> _End:
    if name == GROUND:
        return _End(body=name, point=point, place=point, velocity=np.zeros(3))
    body = scene.bodies[require(scene, what, "bodies", name)]
    lever = rotation_matrix(body.quaternion) @ point
    velocity = body.velocity + np.cross(body.angular_velocity, lever)
    return _End(body=name, point=point, place=body.position + lever, velocity=velocity)


def _tied(scene: Description, name: str, end: _End, mass: float, inertia: Array) -> tuple[str, Array]:
    """Half a segment's mass on what an end is tied to, and where the line begins."""
    if end.body == GROUND:
        return end.body, end.point
    add_body(
        scene, name=name, mass=mass, inertia=inertia, position=end.place,
        quaternion=scene.bodies[end.body].quaternion, velocity=end.velocity,
        angular_velocity=scene.bodies[end.body].angular_velocity,
    )  # fmt: skip
    add_joint(scene, kind="weld", name=name, first=end.body, second=name)
    return name, np.zeros(3)


def _shape(what: str, chain: Chain) -> Array:
    """Places of the masses from the first end, (n - 1, 3), m."""
    if chain.count == 1:
        return np.zeros((0, 3))
    forces = chain.forces()
    if forces is not None:
        return chain.points(forces)
    if not chain.segment * chain.count < (1.0 + STRAIGHT) * np.linalg.norm(chain.span):
        raise SceneError.of(
            f"{what}: length",
            f"is {chain.segment * chain.count:.6g} m over a span of "
            f"{np.linalg.norm(chain.span):.6g} m, and it has no rest shape; give it less length, ends that "
            "are not one above the other, or gravity",
        )
    return np.arange(1, chain.count)[:, None] / chain.count * chain.span
