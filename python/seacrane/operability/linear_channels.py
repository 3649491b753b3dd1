"""Allowable Hs of a linear scene, whose channels, y = rest + C x + D f + E g, are proportional to Hs."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from seacrane import _core
from seacrane.analysis.after_run import require_finite
from seacrane.analysis.linear_system import LinearModel, linear_model
from seacrane.analysis.modal_analysis import quadrature_frequencies
from seacrane.analysis.parts_in_waves import PartsInWaves
from seacrane.analysis.rest_state import held
from seacrane.arrays import Array, Complex
from seacrane.description.databases import database_of
from seacrane.description.waves import Waves
from seacrane.errors import SceneError
from seacrane.inputs.caller import silently
from seacrane.operability.criterion import Criterion, gaussian_level
from seacrane.run.outputs import Outputs
from seacrane.run.run import Run
from seacrane.scene.realised_sea import spectrum_named
from seacrane.scene.scene import Scene
from seacrane.sea import Spreading

MOVE = 1e-4  # m and rad, m/s and rad/s
PUSH = 1e-3  # m/s2 and rad/s2, of states of the fluid and of loads on the vessel
DIRECTIONS = 36  # of equal energy, of a spread sea
SCALING = ("jonswap", "pierson-moskowitz")  # spectra that keep their shape over Hs


@dataclass(frozen=True, kw_only=True, eq=False)
class LinearChannels:
    """y = rest + c x + d f + e g of small motions x under loads f on the vessel, g on parts under water.

    Attributes
    ----------
    rest : (m,) Values at rest, in the units of the channels.
    c : (m, n) Per x of the model.
    d : (m, 6) Per load on the vessel (N, N m) about its origin, in axes that follow its yaw.
    e : (m, 3 p) Per force (N) at the centre of each part, inertial axes.
    parts : PartsInWaves
        Their drag has no part in it: it is of second order.
    """

    model: LinearModel
    rest: Array
    c: Array
    d: Array
    e: Array
    parts: PartsInWaves

    def by_flow(self, omega: Array, flow: Complex) -> tuple[Complex, Complex]:
        """Channels (k, m), and x (k, n), by water that flows at the parts, (k, 3 p)."""
        x = self.model.response_to_rates(omega, self.parts.rates(omega, flow))
        return np.asarray(x @ self.c.T + self.parts.forces(omega, flow) @ self.e.T), x

    def transfer(self, omega: Array) -> Complex:
        """Channels per load on the vessel, (k, m, 6), at frequencies (k,) in rad/s."""
        out = np.empty((omega.size, self.rest.size, 6), dtype=complex)
        for i, unit in enumerate(np.eye(6)):
            x = self.model.response(omega=omega, force=np.broadcast_to(unit, (omega.size, 6)))
            out[..., i] = x @ self.c.T + self.d[:, i]
        return out


def linear_channels(model: LinearModel, criteria: Sequence[Criterion]) -> LinearChannels:
    """The channels of criteria, by differences of what a run records where it begins.

    Raises SceneError for a channel or a name that the scene does not have, memory by frequency, or a model
    without vessel.
    """
    if model.memories:
        raise SceneError(
            f"scene {model.scene.name!r}: its fluid memory is a convolution, which has no states; add the "
            "vessel with memory='per-pair', or take domain='time'"
        )
    if model.vessel is None or not isinstance(model.scene, Scene):
        raise SceneError(f"scene {model.scene.name!r}: has no vessel on which waves act")
    dof = model.degrees_of_freedom
    sizes = np.full(len(model.a), MOVE)
    pushes = np.abs(model.a[dof : 2 * dof, 2 * dof :]).max(axis=0, initial=0.0)
    sizes[2 * dof :] = PUSH / np.where(pushes > 0.0, pushes, PUSH)
    look = _look(held(model.scene, time=model.state.time), criteria)
    rest, columns = look(model.state), []
    for i, size in enumerate(sizes):
        step = np.zeros(sizes.size)
        step[i] = size
        above = look(model.full_state(step))
        # States of the fluid add loads in proportion: one side is enough.
        below = look(model.full_state(-step)) if i < 2 * dof else 2.0 * rest - above
        columns.append((above - below) / (2.0 * size))
    parts, axes = PartsInWaves(model), model.yaw_axes()
    pushed = PUSH / np.abs(model.b[dof : 2 * dof]).max(axis=0)
    by_load = [_slope(model, criteria, model.vessel, one, axes[:, i]) for i, one in enumerate(pushed)]
    return LinearChannels(
        model=model, rest=rest, c=np.stack(columns, axis=1), d=np.stack(by_load, axis=1),
        e=_by_part(model, criteria, parts), parts=parts,
    )  # fmt: skip


def _by_part(model: LinearModel, criteria: Sequence[Criterion], parts: PartsInWaves) -> Array:
    """Channels per force at the centre of each part, inertial axes."""
    columns = [np.zeros((len(criteria), 0))]
    known: dict[tuple[str, tuple[float, ...]], Array] = {}  # halves of spans meet at points
    for part in parts.parts:
        place = (part.body, tuple(map(float, part.point)))
        if place not in known:
            size = PUSH * model.scene.bodies[part.body].mass
            slopes = [_slope(model, criteria, part.body, size, along, place[1]) for along in np.eye(3, 6)]
            known[place] = np.stack(slopes, axis=1)
        columns.append(known[place])
    return np.concatenate(columns, axis=1)


def _slope(
    model: LinearModel, criteria: Sequence[Criterion], body: str, size: float, along: Array,
    point: Any = (0.0, 0.0, 0.0),
) -> Array:  # fmt: skip
    """Channels per load `along` (6,) about a point of a body, by so much of it to either side."""
    found = []
    for sign in (1.0, -1.0):
        scene: Scene = held(model.scene, time=model.state.time)  # type: ignore[assignment]
        name = "operability"
        while name in scene.force_tables:
            name += "'"
        wrench = [sign * size * along] * 2
        scene.add_force(body, name=name, times=[0.0, 1.0], force=np.array(wrench), point=point)
        found.append(_look(scene, criteria)(model.state))
    return (found[0] - found[1]) / (2.0 * size)


def _look(scene: Scene, criteria: Sequence[Criterion]) -> Callable[[_core.State], Array]:
    """What a scene records of the channels of criteria at states, (m,)."""
    model = scene.compile()
    channels = Outputs(channels=tuple(dict.fromkeys(one.channel for one in criteria)))

    def at(state: _core.State) -> Array:
        with silently():  # of the scene as it would be in a run
            run = Run(scene, state.time, start=state, outputs=channels, model=model)
            run.advance(state.time)
            result = require_finite(run.result())
        return np.array([result.curve(one.channel, **one.names)[0] for one in criteria])

    return at


class LinearSeas:
    """Responses of a scene at rest in seas of its own spectrum and spreading.

    Parameters
    ----------
    scene : Scene
        With a sea of one wave system on one vessel.
    state : State
        At rest.
    criteria : sequence of Criterion

    Raises SceneError where the scene has no linear model, its spectrum changes shape with Hs, or a part of a
    load crosses the surface. Drag of parts under water is left out: it is not proportional to Hs.
    """

    def __init__(self, scene: Scene, state: _core.State, criteria: Sequence[Criterion]) -> None:
        assert scene.waves is not None
        self._known, self._criteria = scene.waves.provenance, tuple(criteria)
        if self._known.spectrum not in SCALING:
            raise SceneError(
                f"spectrum {self._known.spectrum!r} changes its shape with Hs; take one of "
                f"{', '.join(SCALING)}, or domain='time'"
            )
        if len(scene.waves.hulls) != 1:
            raise SceneError(f"the sea is on {len(scene.waves.hulls)} vessels; domain='time' takes several")
        self._vessel = scene.waves.body_of()
        self._heading = scene.waves.hull().heading
        self._database = database_of(scene, self._vessel, "its linear model in waves")
        model = linear_model(scene, state=state, vessel=self._vessel)
        self.channels: LinearChannels = linear_channels(model, criteria)
        low, high = float(self._database.omega[0]), float(self._database.omega[-1])
        self._omega = quadrature_frequencies(model, low, high)
        self._transfer = self.channels.transfer(self._omega)
        steps = np.diff(self._omega)
        self._weights = 0.5 * (np.append(steps, 0.0) + np.append(0.0, steps))

    def gains(self, direction_deg: float) -> Array:
        """Squared amplitude of each channel per metre of wave amplitude, (k, m), over the spreading."""
        spread = np.zeros(1)
        if self._known.spreading is not None:
            shares = (np.arange(DIRECTIONS) + 0.5) / DIRECTIONS
            spread = Spreading(**self._known.spreading).quantile(shares)
        angles = np.radians(direction_deg) - self._heading + spread
        found = np.zeros(self._transfer.shape[:2])
        for angle in angles:
            channels = np.einsum("kmi,ki->km", self._transfer, self._database.force_at(self._omega, angle))
            if parts := self.channels.parts:
                flow = parts.flow(parts.waves(self._omega, angle, self._database.depth))
                channels = channels + self.channels.by_flow(self._omega, flow)[0]
            found += np.abs(channels) ** 2
        return np.asarray(found / angles.size)

    def moments(self, gains: Array, tp: float) -> Array:
        """m0, m1, m2 of each channel at Hs 1 m, (m, 3)."""
        density = gains * np.asarray(self._spectrum(tp).density(self._omega))[:, None]
        return np.stack([(self._weights * self._omega**order) @ density for order in (0, 1, 2)], axis=1)

    def energy_share(self, tp: float) -> float:
        """Share of the energy of the waves within the database; the rest is left out."""
        spectrum = self._spectrum(tp)
        return float(
            spectrum.energy(minimum_omega=self._omega[0], maximum_omega=self._omega[-1]) / spectrum.moment(0)
        )

    def allowable(self, gains: Array, tp: float) -> Array:
        """Hs (m) at which each criterion is reached, (m,); infinite where nothing moves, 0 beyond it at rest.

        The statistic is level x standard deviation, and the latter is proportional to Hs.
        """
        found = []
        for criterion, rest, moments in zip(
            self._criteria, self.channels.rest, self.moments(gains, tp), strict=True
        ):
            allowance = criterion.allowance(float(rest))
            if allowance <= 0.0:
                found.append(0.0)
            elif moments[0] <= 0.0:
                found.append(np.inf)
            else:
                found.append(allowance / (gaussian_level(criterion, moments) * float(np.sqrt(moments[0]))))
        return np.array(found)

    def in_waves(self, waves: Waves, start: float, times: Array) -> tuple[_core.State, Array]:
        """State in the steady response to a realised sea at `start` (s), and the channels (n, m) at times."""
        parts, hull = waves.components(), waves.hulls[self._vessel]
        omega, direction = np.array(parts.omega), np.array(parts.direction)
        along = np.cos(direction) * hull.position[0] + np.sin(direction) * hull.position[1]
        phase = np.array(parts.phase) - np.array(parts.wavenumber) * along
        wave = np.array(parts.amplitude) * np.exp(1j * phase)
        force = wave[:, None] * np.asarray(hull.transfer).reshape(-1, 6)
        x = self.channels.model.response(omega=omega, force=force)
        y = x @ self.channels.c.T + force @ self.channels.d.T
        if self.channels.parts:
            more, moved = self.channels.by_flow(omega, self.channels.parts.flow_of(waves))
            x, y = x + moved, y + more
        first = (np.exp(1j * start * omega) @ x).real
        turns = np.exp(1j * times[:, None] * omega)
        return self.channels.model.full_state(first), self.channels.rest + (turns @ y).real

    def _spectrum(self, tp: float) -> _core.Spectrum:
        assert self._known.spectrum is not None
        gamma = self._known.gamma if self._known.spectrum == "jonswap" else 3.3
        assert gamma is not None
        return spectrum_named(self._known.spectrum, 1.0, tp, gamma)
