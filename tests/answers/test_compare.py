"""A run beside a record: the shift, bias and noise of made-up records are found; a measured roll decay."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from seacrane import MotionHistory, Result, Scene, SceneError, simulate
from seacrane.statistics import MeasuredSeries, compare
from seacrane.warnings import UncertainShiftWarning

# Ships that are led start where they are led to.
pytestmark = pytest.mark.filterwarnings("ignore::seacrane.warnings.AssemblyWarning")
Array = np.ndarray
Curve, END = Callable[[Array], Array], 200.0
RANDOM = np.random.default_rng(11)
OMEGA, PHASE = np.linspace(0.4, 1.1, 50), RANDOM.uniform(0.0, 2.0 * np.pi, 50)
SIZE = 0.1


def heave(time: Array) -> Array:
    return np.asarray(SIZE * np.cos(np.outer(time, OMEGA) + PHASE).sum(axis=1))


def led(motion: Curve, *, dt_out: float = 0.25) -> Result:
    """A ship that heaves as it is told."""
    time = np.arange(0.0, END + 1.0, 0.2)
    six = np.zeros((time.size, 6))
    six[:, 2] = motion(time)
    scene = Scene(name="led")
    scene.add_vessel(motion=MotionHistory(time=time, motion=six), ramp=0.0)
    return simulate(scene, t_end=END, dt_out=dt_out)


@pytest.fixture(scope="module")
def result() -> Result:
    return led(heave)


def record(values: Curve, time: Array, unit: str = "m", name: str = "heave") -> MeasuredSeries:
    return MeasuredSeries(time=time, columns={name: values(time)}, units={name: unit})


@pytest.mark.parametrize("late", [1.234, -4.5])
def test_the_shift_of_a_record_is_found_between_samples(result: Result, late: float) -> None:
    """Without noise: to the error of the splines through run and record."""
    time = np.arange(10.0, 180.0, 0.2)
    found = compare(result, record(lambda t: heave(t - late), time))
    assert found.shift == pytest.approx(late, abs=2e-4) and found.rms < 2e-4
    assert found.correlation == pytest.approx(1.0, abs=1e-6)
    # A record of another clock is found where the longest shift allows it.
    made = record(lambda t: heave(t - 6990.0 - late), np.arange(7000.0, 7120.0, 0.2))
    with pytest.raises(SceneError, match="7000 s"):
        compare(result, made)
    assert compare(result, made, maximum_shift=7100.0).shift == pytest.approx(6990.0 + late, abs=2e-4)


def test_bias_and_noise_are_found_with_their_scatter(result: Result) -> None:
    """By many records: sigma of the shift is noise / (sqrt(n) rms rate), of the bias noise / sqrt(n)."""
    time, noise, bias, late = np.arange(10.0, 180.0, 0.5), 0.05, 0.3, 0.8
    rate = np.sqrt(0.5 * np.sum((SIZE * OMEGA) ** 2))
    expected = noise / (np.sqrt(time.size) * rate)
    shifts, biases, scatters = [], [], []
    for seed in range(30):
        random = np.random.default_rng(seed)
        made = record(lambda t: heave(t - late) + bias + random.normal(0.0, noise, t.size), time)  # noqa: B023
        found = compare(result, made)
        shifts.append(found.shift - late)
        biases.append(found.bias + bias)
        scatters.append(found.scatter)
    assert np.std(shifts) == pytest.approx(expected, rel=0.35)
    assert abs(np.mean(shifts)) < 3.0 * expected / np.sqrt(30)
    assert abs(np.mean(biases)) < 3.0 * noise / np.sqrt(30 * time.size) + 2e-4
    assert np.mean(scatters) == pytest.approx(noise, rel=0.02)
    assert found.rms == pytest.approx(np.hypot(found.bias, found.scatter), rel=1e-12)


def test_differences_are_run_minus_record_and_signed(result: Result) -> None:
    made = record(lambda t: 0.5 * heave(t) - 2.0, np.arange(0.0, END, 0.2))
    found = compare(result, made, maximum_shift=0.0)
    np.testing.assert_allclose(found.difference, 0.5 * heave(found.time) + 2.0, atol=2e-4)
    assert (found.shift, found.gain) == (0.0, pytest.approx(2.0, rel=1e-3))
    assert found.bias == pytest.approx(found.difference.mean(), rel=1e-9)


def test_a_shift_that_is_not_sure_is_told(result: Result) -> None:
    time = np.arange(0.0, END, 0.2)
    periodic = led(lambda t: np.cos(0.8 * t))
    with pytest.warns(UncertainShiftWarning, match="correlation"):
        compare(result, record(lambda t: np.random.default_rng(2).normal(size=t.size), time))
    with pytest.warns(UncertainShiftWarning, match=r"still grows at [+]1 s"):
        compare(result, record(lambda t: heave(t - 1.6), time), maximum_shift=1.0)
    with pytest.warns(UncertainShiftWarning, match=r"[+-]7.8 s is as good"):
        compare(periodic, record(lambda t: np.cos(0.8 * t), time))
    found = compare(periodic, record(lambda t: np.cos(0.8 * (t - 1.0)), time), maximum_shift=3.0)
    assert found.shift == pytest.approx(1.0, abs=1e-4)


def test_what_cannot_be_compared_is_refused(result: Result) -> None:
    time = np.arange(0.0, END, 0.2)
    made, still = record(heave, time), record(np.ones_like, time)
    two = MeasuredSeries(time=time, columns={"a": time, "b": time}, units={"a": "m", "b": "m"})
    refused: list[tuple[Any, dict[str, Any], str]] = [
        (made, {"channel": "position"}, "several curves"),
        (record(heave, time, unit="rad"), {}, "in m, and column 'heave' in rad"),
        (still, {}, "does not vary"), (two, {"channel": "heave"}, "column=, a, b"),
    ]  # fmt: skip
    for measured, given, words in refused:
        with pytest.raises(SceneError, match=words):
            compare(result, measured, **given)
    both = MeasuredSeries(
        time=time, columns={"roll": time, "heave": heave(time)}, units={"roll": "rad", "heave": "m"}
    )
    assert compare(result, both, channel="heave").column == "heave", "the column of the channel's name"
    assert compare(result, still, maximum_shift=0.0).bias == pytest.approx(heave(time).mean() - 1.0, abs=1e-3)


def test_tables_and_pictures(result: Result) -> None:
    late = record(lambda t: 2.0 * heave(t - 0.5), np.arange(0.0, END, 0.2))
    found = compare(result, late)
    np.testing.assert_array_equal(found.to_dataframe()["difference"], found.difference)
    upper, lower = found.plot().axes
    np.testing.assert_array_equal(upper.lines[1].get_ydata(), found.record)
    np.testing.assert_array_equal(lower.lines[0].get_ydata(), found.difference)
