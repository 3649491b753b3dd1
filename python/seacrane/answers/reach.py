"""How far out a crane's tip is, and the stroke or the luff that brings it to a radius."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.analysis.crane_poses import Place, path_through, places_of, posed
from seacrane.description.compilation import compile_scene
from seacrane.description.crane_parts import tip_radius
from seacrane.description.description import Description
from seacrane.description.elements import add_driver
from seacrane.description.roles import CraneRoles
from seacrane.errors import SceneError
from seacrane.inputs.frames import rotation_matrix

Array = NDArray[np.float64]
STEP = 0.25  # s of the path between two projections: 0.05 m
CLOSE = 1e-10  # s of the path


def luffing(scene: Description, roles: CraneRoles, luff: str | None) -> str:
    """Label of the coordinate that changes the radius; SceneError where there is none."""
    known = {label: place for label, place in places_of(roles).items() if label != "slew"}
    label = next(iter(known), None) if luff is None else luff
    if label is None or label not in known:
        which = ", ".join(map(repr, known)) or "none"
        raise SceneError(
            f"luff is {luff!r}; name the cylinder or hinge that sets the radius; there are {which}"
        )
    joint, coordinate = known[label]
    if not any((one.joint, one.coordinate) == (joint, coordinate) for one in scene.ranges.values()):
        raise SceneError(
            f"coordinate {label!r}: it has no range, within which a radius is looked for; give one by "
            f"add_range(joint={joint!r}, minimum=..., maximum=...)"
        )
    return label


class Reach:
    """Radius of the tip over one stroke or luff, the other coordinates at values of their own."""

    def __init__(
        self, scene: Description, roles: CraneRoles, label: str, others: Mapping[str, float]
    ) -> None:
        self._scene, self._roles, self._label = scene, roles, label
        places = places_of(roles)
        low, high = self._range(places[label])
        ends = [{**others, label: value} for value in (0.0, low, high)]
        path, times = path_through(places, ends)
        led = posed(_bare(scene), places, path).copy(orientation="quaternion")
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

    def _range(self, place: Place) -> tuple[float, float]:
        limits = [one for one in self._scene.ranges.values() if (one.joint, one.coordinate) == place]
        return max(one.minimum for one in limits), min(one.maximum for one in limits)

    def _led(self, state: Array, start: float, end: float) -> Array:
        for time in np.linspace(start, end, int(np.ceil((end - start) / STEP)) + 1)[1:]:
            state = self._evaluator.project(float(time), state)
        return state

    def _radius(self, state: Array) -> float:
        poses = np.array(state[: 7 * len(self._scene.bodies)]).reshape(-1, 7)
        return float(tip_radius(self._scene, self._roles, self._centres(poses), poses[:, 3:]))

    def _centres(self, poses: Array) -> Array:
        """Centres of mass: the state holds those of bodies, and the reference points of vessels."""
        out = poses[:, :3].copy()
        floating = {vessel.body for vessel in self._scene.vessels.values()}
        for i, (name, body) in enumerate(self._scene.bodies.items()):
            if name in floating:
                out[i] += rotation_matrix(poses[i, 3:]) @ body.center_of_mass
        return out


def _bare(scene: Description) -> Description:
    """Without loads, which do not matter to where a tip is."""
    return scene.copy(loads={}, point_forces={}, springs={}, force_tables={}, function_forces={})
