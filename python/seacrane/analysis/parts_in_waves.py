"""Waves on what is under water in a linear model: inertia of the water, and drag."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from copy import copy
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from seacrane import _core
from seacrane.analysis.frequency_memory import block_diagonal
from seacrane.analysis.linear_system import LinearModel
from seacrane.analysis.reduced_coordinates import Terms
from seacrane.analysis.taut_lines import pose_of
from seacrane.arrays import Array, Complex
from seacrane.description.compilation import compile_scene
from seacrane.description.description import GROUND, Description
from seacrane.description.loads import changed
from seacrane.description.waves import Waves
from seacrane.description.wet_parts import displaced_volume, half_height, immersed_parts, waters_in
from seacrane.errors import SceneError
from seacrane.inputs.frames import heading_of, rotation_matrix
from seacrane.sea.dispersion import wavenumber

# Of a box with the second moments of a disc and a ball, as in the engine, over the diameter.
DISC, BALL = np.sqrt(0.75), np.sqrt(0.6)
SIZES = {"cylinder": (1.0, DISC, DISC), "disc": (0.0, DISC, DISC), "sphere": (BALL, BALL, BALL)}
SHALLOW = 20.0  # of k d, beyond which water is deep


@dataclass(frozen=True, kw_only=True, eq=False)
class WetPart:
    """A part under water at rest, or half of a span of wire, with its axes and forces in inertial axes.

    Attributes
    ----------
    name, what : With its kind, for messages.
    body, point : Its carrier; body coordinates, m.
    center : (3,) m.
    axes : (3, 3) In columns.
    extents : (3, 3) Columns: over which the flow is averaged, m.
    drag, shape : (3,) N s2/m2 along its axes; which of them go by a common speed.
    inertia : (3, 3) kg: of the water that it displaces, and its added mass. Times the acceleration of the
        water it is the force of a wave.
    along : (3, degrees of freedom) Velocity of its centre by the speeds of the model.
    """

    name: str
    what: str
    body: str
    point: Any
    center: Array
    axes: Array
    extents: Array
    drag: Array
    shape: str
    inertia: Array
    along: Array
    wave_factor: float = 1.0

    def flow(self, waves: PlaneWaves) -> Complex:
        """Velocity of the water per metre of wave amplitude, mean over the part, (k, 3), 1/s."""
        k, turn = waves.wavenumber, waves.along
        mean = np.ones(k.size)
        for extent in self.extents.T:
            half = 0.5 * k * (turn @ extent[:2])
            mean *= np.where(np.abs(half) < np.pi, np.sinc(half / np.pi), 0.0)
        half = 0.5 * k * np.linalg.norm(self.extents[2])
        mean *= np.where(half > 0.0, np.sinh(half) / np.where(half > 0.0, half, 1.0), 1.0)
        level = k * self.center[2]
        floor = np.where(waves.floor < SHALLOW, np.exp(-2.0 * np.minimum(waves.floor, SHALLOW) - level), 0.0)
        bottom = 1.0 - np.where(waves.floor < SHALLOW, np.exp(-2.0 * np.minimum(waves.floor, SHALLOW)), 0.0)
        across, up = ((np.exp(level) + sign * floor) / bottom for sign in (1.0, -1.0))
        phase = np.exp(-1j * k * (turn @ (self.center[:2] - waves.origin)))
        wave = self.wave_factor * waves.omega * mean * phase
        return np.stack([turn[:, 0] * across * wave, turn[:, 1] * across * wave, 1j * up * wave], axis=1)


@dataclass(frozen=True, kw_only=True, eq=False)
class PlaneWaves:
    """Waves of one metre, their phase zero at an origin (2,), m; frequencies (rad/s) and directions of travel
    (rad, inertial frame) are (k,)."""

    omega: Array
    direction: Array
    origin: Array
    depth: float
    gravity: float

    @cached_property
    def wavenumber(self) -> Array:
        """1/m."""
        return wavenumber(self.omega, g=self.gravity, depth=self.depth)

    @cached_property
    def along(self) -> Array:
        """Unit vectors, (k, 2)."""
        return np.stack([np.cos(self.direction), np.sin(self.direction)], axis=1)

    @property
    def floor(self) -> Array:
        """Wavenumber times depth."""
        return self.wavenumber * self.depth


def wet_at_rest(linear: LinearModel) -> list[WetPart]:
    """Parts and halves of spans that are under water; SceneError as of `PartsInWaves`."""
    for water in waters_in(linear.scene):
        _, _, bottom = _place(linear, water.body, water.point)
        if bottom[2] < 0.0:
            raise SceneError(
                f"entrapped water {water.name!r}: flows by the root of a head, and linear models have no "
                "waves on it; take it as filled, with its mass on the body, or simulate the scene"
            )
    parts = (_part(linear, element) for element in immersed_parts(linear.scene).values())
    spans = [load for load in linear.scene.loads.values() if isinstance(load, _core.ImmersedSpan)]
    halves = (half for span in spans for half in _halves(linear, span))
    return [*(part for part in parts if part is not None), *halves]


def _place(linear: LinearModel, name: str, point: Any) -> tuple[Array, Array, Array]:
    """Where a body's origin is at rest, m, its quaternion, and where a point of it is, m."""
    if name == GROUND:
        return np.zeros(3), np.array([1.0, 0.0, 0.0, 0.0]), np.asarray(point)
    values = np.array(linear.state.values)
    at = linear.model.pose_index(linear.bodies.index(name))
    origin, turn = pose_of(linear.scene, linear.model, name, values)
    return origin, values[at + 3 : at + 7], origin + turn @ np.asarray(point)


def _part(linear: LinearModel, element: _core.ImmersedPart) -> WetPart | None:
    """None in air."""
    origin, quaternion, center = _place(linear, element.body, element.point)
    turn = rotation_matrix(quaternion)
    axes = turn @ np.asarray(element.axes)
    half = float(half_height(element, axes))
    if center[2] - half >= 0.0:
        return None
    if center[2] + half > 0.0:
        raise SceneError(
            f"immersed part {element.name!r}: crosses the surface at rest, {half - center[2]:.3g} m deep of "
            f"{2.0 * half:.3g} m: its loads in waves are not linear. Simulate the scene in its sea, or lower "
            "the load until all of it is under water"
        )
    added = _added_mass(linear.scene, element, origin, quaternion)
    extents = axes * (np.asarray(element.size) * np.array(SIZES.get(element.shape, (1.0, 1.0, 1.0))))
    return WetPart(
        name=element.name, what=f"immersed part {element.name!r}", body=element.body, point=element.point,
        center=center, axes=axes, extents=extents, drag=np.asarray(element.drag), shape=element.shape,
        inertia=element.density * displaced_volume(element) * np.eye(3) + added,
        along=_along(linear, element.body, element.point), wave_factor=element.wave_factor,
    )  # fmt: skip


def _along(linear: LinearModel, body: str, point: Any) -> Array:
    return linear.output(body=body, point=point)[:3, : linear.degrees_of_freedom]


def _halves(linear: LinearModel, span: _core.ImmersedSpan) -> Iterator[WetPart]:
    """The halves of a span of wire that are wet at rest, each at its end; see ImmersedSpan of the engine."""
    named = {"first": (span.first, span.first_point), "second": (span.second, span.second_point)}
    first, second = (_place(linear, *one)[2] for one in named.values())
    apart = second - first
    if not np.any(apart):
        return
    direction = apart / np.linalg.norm(apart)
    across = np.linalg.svd(direction[None, :])[2][1:].T
    length = float(span.length.evaluate([linear.state.time])[0, 0])
    rises = (0.5 * apart[2], -0.5 * apart[2])
    for (end, (body, point)), place, up in zip(named.items(), (first, second), rises, strict=True):
        share = np.clip(0.5 - (place[2] + 0.5 * up) / np.hypot(up, span.diameter), 0.0, 1.0)
        wet = share**3 * (10.0 + share * (6.0 * share - 15.0)) * length
        if body == GROUND or wet == 0.0:
            continue
        water = span.density * np.pi / 8.0 * span.diameter**2 * wet
        side, skin = span.drag_coefficient, np.pi * span.drag_coefficient_along
        turned = across @ across.T
        yield WetPart(
            name=f"{span.name}.{end}", what=f"immersed span {span.name!r}", body=body, point=point,
            center=np.minimum(place, [np.inf, np.inf, 0.0]), axes=np.column_stack([direction, across]),
            extents=np.zeros((3, 3)), shape="cylinder",
            drag=0.25 * span.density * span.diameter * wet * np.array([skin, side, side]),
            inertia=water * (np.eye(3) + span.added_mass_coefficient * turned),
            along=_along(linear, body, point),
        )  # fmt: skip


def _added_mass(scene: Description, element: _core.ImmersedPart, position: Array, quaternion: Array) -> Array:
    """Of one part as the engine has it in a pose of its body, (3, 3), kg: by a scene of nothing else."""
    still = {"velocity": np.zeros(3), "angular_velocity": np.zeros(3)}
    body = changed(scene.bodies[element.body], position=position, quaternion=quaternion, **still)
    alone = Description(name=element.name, gravity=scene.gravity)
    alone.bodies[body.name] = body
    alone.loads[element.name] = changed(element, row="", place=0.0, count=1.0, step=np.zeros(3))
    model = compile_scene(alone)
    mass = np.asarray(Terms(model, time=0.0).evaluator.terms(0.0, np.array(model.initial_state))["mass"])
    return np.asarray(mass[:3, :3] - body.mass * np.eye(3))


class PartsInWaves:
    """The parts and lines of a linear model that are under water at rest.

    Raises SceneError for parts that cross the surface, compartments, and a current: they have no linear part.
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
        self._inertia = block_diagonal([part.inertia for part in self.parts])

    def __bool__(self) -> bool:
        return bool(self.parts)

    @property
    def water_depth(self) -> float:
        """Of the scene's sea, m; deep without one."""
        scene = self.linear.scene
        return np.inf if scene.waves is None else scene.waves.depth

    def waves(self, omega: Array, direction: Array | float, depth: float) -> PlaneWaves:
        """Waves in water of a depth (m), as seen from the vessel: directions, and zero phase at its place."""
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
        more = block_diagonal(damping) - self._damping()
        a[dof : 2 * dof, dof : 2 * dof] -= self._load @ more @ self.along
        named = {part.name: each for part, each in zip(self.parts, damping, strict=True)}
        out.linear = replace(linear, a=a, drag_damping=named)
        return out

    def _damping(self) -> Array:
        known, none = self.linear.drag_damping, np.zeros((3, 3))
        return block_diagonal([known.get(part.name, none) for part in self.parts])
