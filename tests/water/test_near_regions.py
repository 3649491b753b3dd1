"""A load that is drawn from region to region of the sea near it: restarts and lanes see the same waves."""

from __future__ import annotations

import numpy as np
import pytest
from marks import needs_lanes

from seacrane import Run, Scene, _core
from seacrane.hydro import BoxPart
from seacrane.run.lanes import INSTRUCTIONS, module_of
from seacrane.sea import SeaState, WaveSystem, jonswap

END = 5.0  # s
DEPTHS = (np.inf, 25.0)  # m


def towed(depth: float, seed: int = 5) -> Scene:
    """Strips at the surface of a sea of 200 components, drawn along it."""
    scene = Scene(name="towed")
    scene.add_body(
        "load", mass=40e3, inertia=(3e5, 4e5, 5e5), position=(0.0, 0.0, 0.3), velocity=(9.0, 3.0, 0.0)
    )
    waves = WaveSystem(spectrum=jonswap(hs=1.5, tp=6.0), direction_deg=20.0)
    scene.add_sea(vessel=None, sea=SeaState(systems=[waves], seed=seed, depth=depth))
    scene.add_immersed("load", parts=[BoxPart(size=(8.0, 3.0, 2.0), strips=(6, 1), drag=0.1)])
    return scene


@pytest.mark.parametrize("depth", DEPTHS)
def test_runs_go_on_within_and_between_regions(depth: float) -> None:
    scene = towed(depth)
    stops, left = [*np.linspace(0.7, 4.7, 6), END], []
    whole = Run(scene, t_end=END, channels=["position"])
    for stop in stops:
        whole.advance(stop)
        left.append(whole.core.state)
    assert np.ptp([state.values[0] for state in left]) > 20.0
    for after, state in enumerate(left[:-1], start=1):
        again = Run(scene, t_end=END, start=state, channels=["position"])
        for stop in stops[after:]:
            again.advance(stop)
        assert np.array_equal(again.core.state.values, left[-1].values)


@needs_lanes
@pytest.mark.parametrize("depth", DEPTHS)
def test_lanes_in_regions_of_their_own_are_as_alone(depth: float) -> None:
    lanes = next(one for one in INSTRUCTIONS if module_of(one) is not None)
    models = [towed(depth, seed).compile() for seed in range(1, lanes + 1)]
    evaluator = _core.LaneEvaluator(module_of(lanes), models)
    for place in np.random.default_rng(2).uniform(-60.0, 60.0, size=(20, lanes)):
        state = evaluator.start()
        state[:, 0] += place
        alone = evaluator.scalar_derivative(4.2, state)
        np.testing.assert_allclose(evaluator.derivative(4.2, state), alone, rtol=1e-11, atol=1e-9)
