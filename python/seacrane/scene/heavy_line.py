"""Lines with mass: point masses between elastic segments."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Any, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seacrane import _core
from seacrane.description.bodies import add_body
from seacrane.description.damping import AIR
from seacrane.description.description import GROUND, Description
from seacrane.description.forces import add_load
from seacrane.description.joints import add_joint
from seacrane.errors import SceneError
from seacrane.inputs.checked import number_of, positive_of, shaped_of, text_of, texts_of
from seacrane.inputs.frames import rotation_matrix
from seacrane.scene.chain_shape import Chain
from seacrane.water.density import SEA_WATER

Array = NDArray[np.float64]
MEDIA = {"air": AIR, "sea": SEA_WATER}  # kg/m3
CYLINDER_DRAG = 1.2  # C_D of a cylinder across the flow, below its critical Reynolds number: DNV-RP-C205
GYRATION = 0.005  # radius of gyration of a mass over its segment: nothing turns it, pictures draw it
MOST_SEGMENTS = 1000
STRAIGHT = 0.01  # of the span: a line that hangs slack by less starts straight where it has no rest shape


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
    diameter: float,
    drag_coefficient: float,
    density: float | None,
    flow: ArrayLike,
    medium: str,
) -> list[_core.Line]:
    """A line with mass between two points: equal elastic segments with point masses between them.

    Adds the lines and bodies "<name>.1", "<name>.2", ... from the first end on, segments and one body less;
    half a segment's mass sits at either end, on bodies "<name>.first" and "<name>.last" that are welded to
    what is not the ground. It starts in its rest shape. Keywords as of `Scene.add_line`; `rung` is that of
    every segment.
    """
    what = f"line {name!r}"
    first, last = _ends(scene, what, bodies, points)
    count = _count(what, segments)
    span = float(np.linalg.norm(last.place - first.place))
    whole = positive_of(f"{what}: length", span if length is None else length)
    step, mass = whole / count, positive_of(f"{what}: mass_per_length", mass_per_length) * whole / count
    chain = Chain(
        span=last.place - first.place,
        segment=step,
        stiffness=positive_of(f"{what}: EA", EA),
        weights=np.full(count - 1, mass * scene.gravity),
    )
    if text_of(f"{what}: medium", medium) not in MEDIA:
        raise SceneError(f"{what}: medium is {medium!r}; choose {' or '.join(map(repr, MEDIA))}")
    fluid = MEDIA[medium] if density is None else density
    places = first.place + _shape(what, chain)
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
            length=step, damping_ratio=damping_ratio, mass=mass, rung=rung, settling=settling,
        )  # fmt: skip
        lines.append(add_load(scene, segment))
        if number_of(f"{what}: diameter", diameter) == 0.0:
            continue
        add_load(
            scene,
            _core.SpanDrag(
                name=f"{name}.{i} drag", first=one[0], second=two[0], first_point=one[1], second_point=two[1],
                density=fluid, diameter=diameter, length=step, coefficient=drag_coefficient, flow=flow,
                in_sea=medium == "sea",
            ),
        )  # fmt: skip
    return lines


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
