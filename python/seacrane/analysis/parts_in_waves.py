"""Waves on what is under water in a linear model: inertia of the water, and drag."""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from seacrane.analysis.linear_system import LinearModel
from seacrane.analysis.wet_at_rest import PlaneWaves, wet_at_rest
from seacrane.description.waves import Waves
from seacrane.errors import SceneError
from seacrane.inputs.frames import heading_of

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


class PartsInWaves:
    """The parts and lines of a linear model that are under water at rest.

    Raises SceneError for parts that cross the surface, compartments, and a current: their loads in waves have
    no linear part that this knows.
    """

    def __init__(self, linear: LinearModel) -> None:
        self.linear, scene = linear, linear.scene
        self.parts = wet_at_rest(linear)
        if self.parts and scene.waves is not None and scene.waves.current is not None:
            raise SceneError(
                f"{self.parts[0].what}: is in a current, and a linear model knows no waves on a current for "
                "what is in water; take the current out, or simulate the scene"
            )
        if self.parts and linear.speed != 0.0:
            raise SceneError(
                f"{self.parts[0].what}: its ship goes at {linear.speed:g} m/s, and it is at rest in the "
                "water; take matrices of zero speed"
            )
        dof = linear.degrees_of_freedom
        self.along = np.concatenate([np.zeros((0, dof)), *(part.along for part in self.parts)])
        reduced = linear.basis.T @ linear.mass @ linear.basis
        self._load = np.linalg.solve(reduced, self.along.T)
        self._inertia = blocks([part.inertia for part in self.parts])

    def __bool__(self) -> bool:
        return bool(self.parts)

    @property
    def water_depth(self) -> float:
        """Of the scene's sea, m; deep without one."""
        scene = self.linear.scene
        return np.inf if scene.waves is None else scene.waves.depth

    def waves(self, omega: Array, direction: Array | float, depth: float) -> PlaneWaves:
        """Waves in water of a depth (m), their directions seen from the vessel, phase zero at its origin.

        Without a vessel both are of the inertial frame.
        """
        linear = self.linear
        origin, heading = np.zeros(2), 0.0
        if linear.vessel is not None:
            at = linear.model.pose_index(linear.bodies.index(linear.vessel))
            pose = np.array(linear.state.values)[at : at + 7]
            origin, heading = pose[:2], heading_of(pose[3:])
        over = np.broadcast_to(np.asarray(direction, dtype=float) + heading, omega.shape)
        gravity = linear.scene.gravity
        return PlaneWaves(omega=omega, direction=over, origin=origin, depth=depth, gravity=gravity)

    def flow(self, waves: PlaneWaves) -> Complex:
        """Velocities of the water at all parts, (k, 3 p), 1/s."""
        none: Complex = np.zeros((waves.omega.size, 0), dtype=complex)
        return np.concatenate([none, *(part.flow(waves) for part in self.parts)], axis=1)

    def flow_of(self, sea: Waves) -> Complex:
        """Velocities of the water at all parts by the components of a sea, (k, 3 p), m/s."""
        components = sea.components()
        waves = PlaneWaves(
            omega=np.array(components.omega), direction=np.array(components.direction), origin=np.zeros(2),
            depth=sea.depth, gravity=self.linear.scene.gravity,
        )  # fmt: skip
        wave = np.array(components.amplitude) * np.exp(1j * np.array(components.phase))
        return np.asarray(wave[:, None] * self.flow(waves))

    def forces(self, omega: Array, flow: Complex) -> Complex:
        """On the parts in a flow, (k, 3 p), N: by its inertia, and by drag that is linear."""
        return np.asarray(1j * omega[:, None] * (flow @ self._inertia.T) + flow @ self._damping().T)

    def rates(self, omega: Array, flow: Complex) -> Complex:
        """Rates of x of the linear model in a flow (k, 3 p)."""
        dof = self.linear.degrees_of_freedom
        out: Complex = np.zeros((omega.size, len(self.linear.a)), dtype=complex)
        out[:, dof : 2 * dof] = self.forces(omega, flow) @ self._load.T
        return out

    def damped(self, damping: Sequence[Array]) -> PartsInWaves:
        """The same with the drag of each part as damping, (3, 3), N s/m, inertial axes; in the model too."""
        linear, dof = self.linear, self.linear.degrees_of_freedom
        out, a = copy(self), linear.a.copy()
        more = blocks(list(damping)) - self._damping()
        a[dof : 2 * dof, dof : 2 * dof] -= self._load @ more @ self.along
        named = {part.name: each for part, each in zip(self.parts, damping, strict=True)}
        out.linear = replace(linear, a=a, drag_damping=named)
        return out

    def _damping(self) -> Array:
        known, none = self.linear.drag_damping, np.zeros((3, 3))
        return blocks([known.get(part.name, none) for part in self.parts])


def blocks(each: list[Array]) -> Array:
    """Block diagonal (3 p, 3 p)."""
    out = np.zeros((3 * len(each), 3 * len(each)))
    for i, block in enumerate(each):
        out[3 * i : 3 * i + 3, 3 * i : 3 * i + 3] = block
    return out
