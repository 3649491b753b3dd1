"""What is drawn of a result or a scene: the one source of pages, models and pictures."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from seacrane.arrays import Array
from seacrane.crane import Crane
from seacrane.description import crane_parts
from seacrane.description.compilation import compile_scene
from seacrane.description.description import Description
from seacrane.description.places import start_pose
from seacrane.description.suspension import hung_loads
from seacrane.errors import SceneError
from seacrane.hydro import Hull
from seacrane.inputs.frames import quaternion_of, rotation_matrix
from seacrane.inputs.shown import shown
from seacrane.pictures.drawn_bodies import Look, looks
from seacrane.pictures.pose_curves import Motion, motion_of
from seacrane.pictures.wheels import Wheel, end_of, surfaces_of_contacts, wheels_of, wires_of
from seacrane.result import Result
from seacrane.result.about import NOT_KEPT

Spans = list[list[float]]


@dataclass(frozen=True, kw_only=True, eq=False)
class Drawing:
    """Bodies with their looks, in the order of their motion; without a result they stand at their start."""

    title: str
    scene: Description
    result: Result | None
    motion: Motion
    looks: Mapping[str, Look]

    @cached_property
    def wires(self) -> list[dict[str, Any]]:
        """As `wires_of`, with the times at which each is absent."""
        gone, wires = absences(self.result), wires_of(self.scene, self.motion.bodies)
        return [wire | {"absent": gone.get(wire["element"], [])} for wire in wires]

    @cached_property
    def wheels(self) -> list[Wheel]:
        """Sheaves and drums, and what contacts press on."""
        turning = wheels_of(self.scene, self.result, self.motion)
        return [*turning, *surfaces_of_contacts(self.scene, self.motion)]

    @cached_property
    def tracks(self) -> list[dict[str, Any]]:
        """Points whose paths are drawn: tips of cranes, and what hangs on them."""
        bodies = self.motion.bodies
        tips = [
            {"kind": "tip", "name": label, "at": end_of(self.scene, bodies, body, point)}
            for label, (body, point) in crane_parts.tips(self.scene).items()
        ]
        hung = dict.fromkeys(one.load for one in hung_loads(self.scene))
        labels = {body: label for label, body in crane_parts.payloads(self.scene).items()}
        places = {body: [list(bodies).index(body), 0.0, 0.0, 0.0] for body in hung}
        return [*tips, *({"kind": "payload", "name": labels.get(b, b), "at": at} for b, at in places.items())]

    @cached_property
    def box(self) -> Array:
        """(2, 3): what bodies, wheels and cylinders reach at the start, midway and at the end, m."""
        times = self.motion.start + np.array([0.0, 0.5, 1.0]) * (self.motion.end - self.motion.start)
        position, quaternion = self.motion.at(np.minimum(times, self.motion.end))
        reached = [
            centre + self.looks[name].points @ rotation_matrix(turn).T
            for i, name in enumerate(self.motion.bodies)
            for centre, turn in zip(position[:, i], quaternion[:, i], strict=True)
        ]
        for wheel in self.wheels:
            centres = self.place(wheel.at, position, quaternion)
            reached += [centres - wheel.reach, centres + wheel.reach]
        for wire in self.wires:
            reached += self.ends_of(wire, position, quaternion) if wire["radius"] else ()
        every = np.concatenate(reached)
        return np.array([every.min(axis=0), every.max(axis=0)])

    def absent(self, wire: Mapping[str, Any], times: Array) -> Array:
        """Whether a wire is absent at times, s."""
        spans = [(start <= times) & (times < end) for start, end in wire["absent"]]
        return np.any(spans, axis=0) if spans else np.zeros(np.shape(times), dtype=bool)

    def ends_of(self, wire: Mapping[str, Any], position: Array, quaternion: Array) -> tuple[Array, Array]:
        """Where a wire begins and ends at poses, as `place`; one of limited reach ends there."""
        start, end = (self.place(wire[key], position, quaternion) for key in ("from", "to"))
        if not wire["reach"]:
            return start, end
        away = np.maximum(np.linalg.norm(end - start, axis=1), wire["reach"])[:, None]
        return start, start + wire["reach"] / away * (end - start)

    def place(self, end: list[float], position: Array, quaternion: Array) -> Array:
        """Where the end of a wire is at poses (frames, bodies, 3 or 4): (frames, 3), m."""
        number, point = int(end[0]), np.array(end[1:])
        if number < 0:
            return np.tile(point, (len(position), 1))
        turn = rotation_matrix(quaternion[:, number])
        return np.asarray(position[:, number] + turn @ point)


def drawing_of(
    what: Any, *, scene: Any = None, hulls: Mapping[str, Hull] | None = None, crane: Crane | None = None
) -> Drawing:
    """The drawing of a result or a scene; arguments and errors as of `view`."""
    described = _scene_of(what, scene)
    result = what if isinstance(what, Result) else None
    motion = _at_start(described) if result is None else motion_of(result)
    apart = sorted(set(described.bodies) ^ set(motion.bodies))
    if apart:
        raise SceneError(
            f"view: scene {described.name!r} is not the one of the result: {', '.join(map(repr, apart[:5]))} "
            f"{'is' if len(apart) == 1 else 'are'} only in one of them; give the scene that was run"
        )
    found = looks(described, hulls=hulls, crane=crane)
    there = {name: found[name] for name in motion.bodies}
    return Drawing(title=described.name, scene=described, result=result, motion=motion, looks=there)


def _scene_of(what: Any, scene: Any) -> Description:
    """The scene that is shown."""
    if isinstance(what, Description):
        if scene is not None:
            raise SceneError("view: scene= is given beside a scene; give a result, or leave it out")
        return what
    if not isinstance(what, Result):
        raise SceneError(f"view: {shown(what)} is neither a Result nor a Scene")
    found = what.scene if scene is None else scene
    if found is None:
        lacks = what.stats.get(NOT_KEPT)
        why = f" ({shown(lacks)})" if lacks else ""
        raise SceneError(
            f"view: result of {what.stats['scene']!r} is a copy or of a file that holds no scene{why}; "
            "give its scene with view(result, scene=scene)"
        )
    if not isinstance(found, Description):
        raise SceneError(f"view: scene is {shown(found)}; give a Scene")
    return found


def _at_start(scene: Description) -> Motion:
    """One frame: the assembled start."""
    names = tuple(scene.bodies)
    if not names:
        raise SceneError(f"view: scene {scene.name!r} has no bodies; add some first")
    model = compile_scene(scene)
    poses = [start_pose(scene, model, name) for name in names]
    still = np.zeros((1, len(names), 3))
    return Motion(
        start=0.0, interval=1.0, bodies=names, position=np.array([[centre[0] for centre, _ in poses]]),
        quaternion=np.array([[quaternion_of(turn[0]) for _, turn in poses]]), velocity=still,
        angular_velocity=still,
    )  # fmt: skip


def absences(result: Result | None) -> dict[str, Spans]:
    """Times from which and up to which elements are absent, s, by name; only those that ever are.

    What a lift connects first is absent from the start; what stages that were not run released is not known.
    """
    found: dict[str, Spans] = {}
    if result is None:
        return found
    start, end = float(result.time[0]), float(result.time[-1])
    beyond = end + max(1.0, end - start)  # the last output is within
    for event in result.events:
        if event.kind == "connection":
            spans = found.setdefault(event.name, [[start, beyond]])
            spans[-1][1] = event.time
        elif event.kind == "release" and any(span.start == event.time for span in result.stages):
            found.setdefault(event.name, []).append([event.time, beyond])  # limits have such events too
    return found
