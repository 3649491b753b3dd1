"""Channels of a scene as its linear model has them: y = rest + C x + D f + E g, by differences of outputs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.analysis.linear_system import LinearModel
from seacrane.analysis.parts_in_waves import PartsInWaves
from seacrane.analysis.rest_state import held
from seacrane.errors import SceneError
from seacrane.inputs.caller import silently
from seacrane.operability.criterion import Criterion
from seacrane.run.outputs import Outputs
from seacrane.run.run import Run
from seacrane.scene.scene import Scene
from seacrane.validity.after_run import require_finite

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
MOVE = 1e-4  # m and rad, m/s and rad/s
PUSH = 1e-3  # m/s2 and rad/s2, of states of the fluid and of loads on the vessel


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
    look = _Look(held(model.scene, time=model.state.time), criteria)
    rest, columns = look.at(model.state), []
    for i, size in enumerate(sizes):
        step = np.zeros(sizes.size)
        step[i] = size
        above = look.at(model.full_state(step))
        # States of the fluid add loads in proportion: one side is enough.
        below = look.at(model.full_state(-step)) if i < 2 * dof else 2.0 * rest - above
        columns.append((above - below) / (2.0 * size))
    parts = PartsInWaves(model)
    return LinearChannels(
        model=model, rest=rest, c=np.stack(columns, axis=1), d=_by_load(model, criteria),
        e=_by_part(model, criteria, parts), parts=parts,
    )  # fmt: skip


def _by_part(model: LinearModel, criteria: Sequence[Criterion], parts: PartsInWaves) -> Array:
    columns = [np.zeros((len(criteria), 0))]
    known: dict[tuple[str, tuple[float, ...]], Array] = {}  # halves of spans meet at points
    for part in parts.parts:
        place = (part.body, tuple(map(float, part.point)))
        if place not in known:
            known[place] = _by_force_at(model, criteria, *place)
        columns.append(known[place])
    return np.concatenate(columns, axis=1)


def _by_force_at(
    model: LinearModel, criteria: Sequence[Criterion], body: str, point: tuple[float, ...]
) -> Array:
    """Channels per force at a point of a body, inertial axes, (m, 3)."""
    size = PUSH * model.scene.bodies[body].mass
    columns = []
    for axis in np.eye(3):
        pushed = [
            _Look(_pushed(model, body, point, sign * size * axis), criteria).at(model.state)
            for sign in (1.0, -1.0)
        ]
        columns.append((pushed[0] - pushed[1]) / (2.0 * size))
    return np.stack(columns, axis=1)


def _by_load(model: LinearModel, criteria: Sequence[Criterion]) -> Array:
    dof, columns = model.degrees_of_freedom, []
    axes = model.yaw_axes()
    for i, accelerations in enumerate(np.abs(model.b[dof : 2 * dof]).max(axis=0)):
        size = PUSH / accelerations
        assert model.vessel is not None
        pushed = [
            _Look(_loaded(model, model.vessel, sign * size * axes[:, i]), criteria).at(model.state)
            for sign in (1.0, -1.0)
        ]
        columns.append((pushed[0] - pushed[1]) / (2.0 * size))
    return np.stack(columns, axis=1)


def _pushed(model: LinearModel, body: str, point: Any, force: Array) -> Scene:
    return _loaded(model, body, np.concatenate([force, np.zeros(3)]), point)


def _loaded(model: LinearModel, body: str, wrench: Array, point: Any = (0.0, 0.0, 0.0)) -> Scene:
    """The scene held as at the model's time, with one more load (6,) about a point of a body."""
    scene: Scene = held(model.scene, time=model.state.time)  # type: ignore[assignment]
    name = "operability"
    while name in scene.force_tables:
        name += "'"
    scene.add_force(body, name=name, times=[0.0, 1.0], force=np.array([wrench] * 2), point=point)
    return scene


class _Look:
    """What a scene records at states."""

    def __init__(self, scene: Scene, criteria: Sequence[Criterion]) -> None:
        self._scene, self._criteria = scene, criteria
        self._model = scene.compile()
        self._channels = Outputs(channels=tuple(dict.fromkeys(one.channel for one in criteria)))

    def at(self, state: _core.State) -> Array:
        """The channels of the criteria (m,)."""
        with silently():  # of the scene as it would be in a run
            run = Run(self._scene, state.time, start=state, outputs=self._channels, model=self._model)
            run.advance(state.time)
            result = require_finite(run.result())
        return np.array([result.curve(one.channel, **one.names)[0] for one in self._criteria])
