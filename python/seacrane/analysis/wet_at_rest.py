"""What of a linear model is under water at rest: parts of loads, and lines."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.analysis.linear_system import LinearModel
from seacrane.analysis.reduced_coordinates import Terms
from seacrane.description.compilation import compile_scene
from seacrane.description.description import GROUND, Description
from seacrane.description.loads import changed
from seacrane.description.wet_parts import displaced_volume, half_height, immersed_parts, waters_in
from seacrane.errors import SceneError
from seacrane.inputs.frames import rotation_matrix
from seacrane.sea.dispersion import wavenumber

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
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
    inertia : (3, 3)
        kg: of the water that it displaces, and its added mass. Times the acceleration of the water it is the
        force of a wave.
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
    """Waves of one metre, their phase zero at a place.

    Attributes
    ----------
    omega, direction : (k,) rad/s; rad, of travel, inertial frame.
    origin : (2,) m.
    depth, gravity : m, m/s2.
    """

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
    """Parts and halves of spans that are under water.

    Raises SceneError for parts that cross the surface, and compartments.
    """
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
    body = linear.scene.bodies[name]
    at = linear.model.pose_index(linear.bodies.index(name))
    pose = np.array(linear.state.values)[at : at + 7]
    floating = {vessel.body for vessel in linear.scene.vessels.values()}
    start = np.zeros(3) if name in floating else np.asarray(body.center_of_mass)
    turn = rotation_matrix(pose[3:])
    origin = pose[:3] - turn @ start
    return origin, pose[3:], origin + turn @ np.asarray(point)


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
    """The halves of a span of wire that are wet at rest, each at its end; see ImmersedSpan of the engine.

    What waves change of the share of a half that is below the surface is left out.
    """
    named = {"first": (span.first, span.first_point), "second": (span.second, span.second_point)}
    first, second = (_place(linear, *one)[2] for one in named.values())
    apart = second - first
    if not np.any(apart):
        return
    direction = apart / np.linalg.norm(apart)
    across = np.linalg.svd(direction[None, :])[2][1:].T
    length = float(span.length.evaluate([linear.state.time])[0, 0])
    for (end, (body, point)), place, up in zip(
        named.items(), (first, second), (0.5 * apart[2], -0.5 * apart[2]), strict=True
    ):
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
    body = changed(
        scene.bodies[element.body], position=position, quaternion=quaternion, velocity=np.zeros(3),
        angular_velocity=np.zeros(3),
    )  # fmt: skip
    alone = Description(name=element.name, gravity=scene.gravity)
    alone.bodies[body.name] = body
    alone.loads[element.name] = changed(element, row="", place=0.0, count=1.0, step=np.zeros(3))
    model = compile_scene(alone)
    mass = np.asarray(Terms(model, time=0.0).evaluator.terms(0.0, np.array(model.initial_state))["mass"])
    return np.asarray(mass[:3, :3] - body.mass * np.eye(3))
