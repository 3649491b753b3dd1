"""Random scenes with limits that stop, are saved, and go on: every channel bit for bit."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

import numpy as np
import pytest
from limit_scenes import limited
from numpy.typing import NDArray

from seacrane import Run, Scene, SeacraneError, State, cases

pytestmark = pytest.mark.filterwarnings("ignore::UserWarning")
OF_SUNDIALS = ("ida", "cvode-bdf")  # restart from a state


def differences(scene: Scene, path: Path, stop: float, end: float, **method: object) -> dict[str, float]:
    """By channel, the largest difference between a run that went on from a file and one that did not stop."""
    names = scene.compile().channel_names(defaults_only=False)
    settings = {"t_end": end, "dt_out": 0.05, "channels": list(names), **method}
    whole = Run(scene, **settings)
    whole.advance(stop)
    whole.state.save(path)
    later = Run(scene, start=State.load(path, scene=scene), outputs_from=0.0, **settings)
    for run in (whole, later):
        run.advance(end)
    straight, resumed = whole.result(), later.result()
    count = resumed.time.size
    assert np.array_equal(straight.time[-count:], resumed.time)
    out = {}
    for name in names:
        a: NDArray[np.float64] = np.asarray(straight[name])[-count:]
        b: NDArray[np.float64] = np.asarray(resumed[name])
        if not np.array_equal(a, b, equal_nan=True):
            out[name] = float(np.nanmax(np.abs(a - b)))
    if [event for event in straight.events if event.time > stop] != list(resumed.events):
        out["events"] = np.inf
    if not np.array_equal(whole.state.values, later.state.values):
        out["state"] = float(np.abs(np.array(whole.state.values) - later.state.values).max())
    return out


@pytest.mark.parametrize(
    "seeds",
    [[*range(24), 794], pytest.param(range(2000, 2400), marks=pytest.mark.slow("many random scenes"))],
)
def test_random_scenes_with_limits_go_on_bit_for_bit(seeds: Iterable[int], tmp_path: Path) -> None:
    for seed in seeds:
        scene, method = limited(seed)
        if method.get("integrator") in OF_SUNDIALS:
            continue
        try:
            told = differences(scene, tmp_path / "run.state", 0.31 if seed % 2 else 0.3, 0.5, **method)
        except SeacraneError:
            continue  # ended, as tests/run/test_random_limits.py tells
        assert told == {}, seed


@pytest.mark.parametrize("stop", [0.75, 1.0])  # an output; an output at a sample of the history
def test_a_convolution_goes_on_to_the_bit_in_every_channel(
    formulation: str, stop: float, tmp_path: Path
) -> None:
    scene = cases.case2(memory="convolution")
    assert differences(scene, tmp_path / "run.state", stop, 1.6, formulation=formulation) == {}


def test_a_look_at_a_run_changes_none_of_its_channels() -> None:
    channels = ["constraint_error_before_projection", "position"]
    results = []
    for looks in (False, True):
        run = Run(cases.case2(), t_end=2.0, formulation="redundant", channels=channels)
        for t in (0.55, 0.97, 1.33):
            run.advance(t)
            if looks:
                run.measure()
        run.advance(2.0)
        results.append(run.result())
    for name in channels:
        np.testing.assert_array_equal(results[0][name], results[1][name])
