"""ida where its steps stay at order 1 and fail for ever: refused by name, what was reached is kept."""

from __future__ import annotations

import numpy as np
import pytest
from trade_scenes import pendulum

from seacrane import SimulationError, simulate


def test_a_run_that_only_creeps_ends_by_name() -> None:
    with pytest.raises(SimulationError, match=r"stay at order 1 and keep failing.*take dopri5") as caught:
        simulate(pendulum(), 100.0, integrator="ida", rtol=1e-8)
    reached = caught.value.result
    assert reached is not None and 1.0 < reached.time[-1] < 100.0
    right = simulate(pendulum(), float(reached.time[-1]), integrator="dop853", rtol=1e-12)
    held = len(reached.time)
    np.testing.assert_allclose(reached["position"], right["position"][:held], atol=1e-3)


def test_it_stays_a_check_of_the_others_where_it_can() -> None:
    scene = pendulum()
    one = simulate(scene, 2.0, integrator="ida", rtol=1e-7)
    other = simulate(scene, 2.0, integrator="dop853", rtol=1e-12)
    np.testing.assert_allclose(one["position"], other["position"], atol=1e-5)
