"""Lines with mass: point masses between elastic segments."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from itertools import pairwise
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.description.bodies import add_body
from seacrane.description.description import GROUND, Description
from seacrane.description.forces import add_load
from seacrane.description.joints import add_joint
from seacrane.description.loads import changed, lines_of, whole_of
from seacrane.errors import SceneError
from seacrane.inputs.checked import positive_of, shaped_of, text_of, texts_of
from seacrane.inputs.frames import rotation_matrix
from seacrane.scene.chain_shape import Chain
from seacrane.scene.line_fluid import Fluid
from seacrane.scene.line_seabed import Seabed

Array = NDArray[np.float64]
GYRATION = 0.005  # radius of gyration of a mass over its segment: nothing turns it, pictures draw it
MOST_SEGMENTS = 1000
STRAIGHT = 0.01  # of the span: a line that hangs slack by less starts straight where it has no rest shape
SUNK = 10.0  # times what a line sinks in at rest: no end of it begins deeper in a seabed
MOST_SHAPES, SAME_SHAPE = 30, 1e-9  # of which the last differ by less than this share of a segment


@dataclass(frozen=True, kw_only=True)
class _End:
    """An end of a line: body and point (m) in its coordinates, and place (m) and velocity (m/s) of it."""

    body: str
    point: Array
    place: Array
    velocity: Array


def chain_of_segments(
    scene: Description,
    name: str,
    bodies: Any,
    points: Any,
    *,
    EA: float | None,
    length: Any,
    mass_per_length: float,
    segments: int,
    damping_ratio: float,
    rung: str,
    settling: float,
    fluid: Fluid,
    seabed: Seabed | Mapping[str, Any] | None,
) -> list[_core.Line]:
    """A line with mass between two points: equal elastic segments with point masses between them.

    Adds the lines and bodies "<name>.1", "<name>.2", ... from the first end on, segments and one body less;
    half a segment's mass sits at either end, on bodies "<name>.first" and "<name>.last" that are welded to
    what is not the ground. It starts in its rest shape. Keywords as of `Scene.add_line`; `rung` is that of
    every segment. With a curve for its length the masses stay at equal shares of it, and what they gain and
    what moves past them is "<name>.1 winding", ...; so they do on a winch (`on_a_winch`).
    """
    what = f"line {name!r}"
    first, last = _ends(scene, what, bodies, points)
    count = _count(what, segments)
    span = float(np.linalg.norm(last.place - first.place))
    wound = length if isinstance(length, _core.Curve) else None
    given = float(wound.evaluate([0.0])[0, 0]) if wound is not None else length
    whole = positive_of(f"{what}: length", span if given is None else given)
    step, mass = whole / count, positive_of(f"{what}: mass_per_length", mass_per_length) * whole / count
    fluid = fluid.checked(what, wound=wound is not None)
    weight = mass * scene.gravity - fluid.displaced(step, scene.gravity)
    bed = None if seabed is None else Seabed.of(what, seabed)
    if bed is not None:
        _require_over(what, bed, (first, last), weight / step, wound=wound is not None)
    chain = Chain(
        span=last.place - first.place,
        segment=step,
        stiffness=positive_of(f"{what}: EA", EA),
        weights=np.full(count - 1, mass * scene.gravity),
        bed=None if bed is None else -bed.depth - float(first.place[2]),
        bed_stiffness=1.0 if bed is None else bed.stiffness * step,
    )
    lengths = step if wound is None else scaled(wound, 1.0 / count)
    places = _at_rest(what, chain, first.place, last.place, partial(fluid.lifts, gravity=scene.gravity))
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
        lines.append(add_load(scene, segment))
        if fluid.diameter > 0.0:
            add_load(scene, fluid.along(f"{name}.{i}", (one, two), lengths))
        if wound is not None:
            add_load(scene, _winding(segment, mass_per_length, (i, count)))
    if bed is not None:
        shares = [0.5, *[1.0] * (count - 1), 0.5]
        for node, place, share in zip(path, [first.place, *places, last.place], shares, strict=True):
            if node[0] != GROUND:
                under = bed.under(node, place, length=share * step, mass=share * mass, weight=share * weight)
                add_load(scene, under)
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
        add_load(scene, _winding(segment, per_length, (i, len(segments)), paid_out_by=name))
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
        raise SceneError(f"{what}: bodies has {len(names)} names; give those of its two ends")
    if names[0] == names[1]:
        raise SceneError(f"{what}: both ends are on {names[0]!r}; name two bodies")
    rows = shaped_of(f"{what}: points", points, (2, 3))
    first, last = (_end(scene, what, *end) for end in zip(names, rows, strict=True))
    if not np.any(last.place - first.place):
        raise SceneError(f"{what}: points are both at {first.place.tolist()} m; give two places")
    return first, last


def _end(scene: Description, what: str, name: str, point: Array) -> _End:
    if not np.all(np.isfinite(point)):
        raise SceneError(f"{what}: points holds {point.tolist()}; give finite numbers")
    if name == GROUND:
        return _End(body=name, point=point, place=point, velocity=np.zeros(3))
    if text_of(f"{what}: bodies", name) not in scene.bodies:
        raise SceneError(f"{what}: there is no body {name!r}; add it first")
    body = scene.bodies[name]
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
        raise SceneError(
            f"{what}: length is {chain.segment * chain.count:.6g} m over a span of "
            f"{np.linalg.norm(chain.span):.6g} m, and it has no rest shape; give it less length, ends that "
            "are not one above the other, or gravity"
        )
    return np.arange(1, chain.count)[:, None] / chain.count * chain.span


def _count(what: str, segments: Any) -> int:
    if isinstance(segments, bool) or not isinstance(segments, (int, np.integer)):
        raise SceneError(f"{what}: segments is {segments!r}; give a whole number")
    if not 1 <= segments <= MOST_SEGMENTS:
        raise SceneError(f"{what}: segments is {segments}; give 1 to {MOST_SEGMENTS}")
    return int(segments)
