"""Where a run in waves begins, so that it has little of a transient: in the linear steady state."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from seacrane import _core
from seacrane.analysis.frequency_domain import response_summed
from seacrane.analysis.linear_system import LinearModel, linear_model
from seacrane.ensembles.study import Start
from seacrane.errors import SceneError
from seacrane.scene.scene import Scene

LARGEST_TURN = 0.2  # rad, of a body: what the linear model says of more is no state to start from


@dataclass(frozen=True, kw_only=True, eq=False)
class SteadyStart:
    """The steady response of a linear model to the waves of a scene, at the time of its state at rest.

    Attributes
    ----------
    model : LinearModel
    """

    model: LinearModel

    def __call__(self, scene: Scene) -> _core.State:
        """Where a run of this scene begins; scaled down where a body would turn by more than 0.2 rad."""
        model = self.model
        found = response_summed(model, body=model.bodies[0], waves=scene.waves)
        x = found.state_at(model.state.time)
        turns = (model.basis @ x[: model.degrees_of_freedom]).reshape(-1, 2, 3)[:, 1]
        return model.full_state(x * min(1.0, LARGEST_TURN / max(float(np.abs(turns).max()), 1e-300)))


def steady_start(scene: Scene, rest: _core.State) -> Start:
    """A `SteadyStart`, or the state at rest of a scene whose linear model has no such state."""
    assert scene.waves is not None
    try:
        model = linear_model(scene, state=rest, vessel=next(iter(scene.waves.hulls)))
    except SceneError:
        return rest
    return rest if model.memories else SteadyStart(model=model)
