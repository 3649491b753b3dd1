"""Allowable Hs of a linear scene: every response is proportional to Hs, so one spectrum answers for all."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.analysis.linear_system import linear_model
from seacrane.analysis.response_quadrature import quadrature_frequencies
from seacrane.description.databases import database_of
from seacrane.description.waves import Waves
from seacrane.errors import SceneError
from seacrane.operability.criterion import Criterion
from seacrane.operability.levels import gaussian_level
from seacrane.operability.linear_channels import LinearChannels, linear_channels
from seacrane.scene.realised_sea import spectrum_named
from seacrane.scene.scene import Scene
from seacrane.sea import Spreading

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
DIRECTIONS = 36  # of equal energy, of a spread sea
SCALING = ("jonswap", "pierson-moskowitz")  # spectra that keep their shape over Hs


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
        angles = np.radians(direction_deg) - self._heading + self._spread()
        found = np.zeros(self._transfer.shape[:2])
        for angle in angles:
            force = self._database.force_at(self._omega, angle)
            found += np.abs(np.einsum("kmi,ki->km", self._transfer, force) + self._by_parts(angle)) ** 2
        return np.asarray(found / angles.size)

    def _by_parts(self, angle: float) -> Complex | float:
        """What waves on parts under water add, per metre of wave amplitude."""
        parts = self.channels.parts
        if not parts:
            return 0.0
        flow = parts.flow(parts.waves(self._omega, angle, self._database.depth))
        return self.channels.by_flow(self._omega, flow)[0]

    def _spread(self) -> Array:
        if self._known.spreading is None:
            return np.zeros(1)
        return Spreading(**self._known.spreading).quantile((np.arange(DIRECTIONS) + 0.5) / DIRECTIONS)

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
