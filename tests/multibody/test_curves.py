"""Curves of time: through samples, before their start, beyond their end (docs/conventions.md), at kinks."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
import pytest
from kink_scenes import cart
from numpy.testing import assert_allclose, assert_array_equal
from scipy.interpolate import CubicSpline

from seacrane import Curve, SceneError, simulate
from seacrane.scene import spline_curve
from seacrane.warnings import DriverImpulseWarning

RANDOM = np.random.default_rng(5)
TIMES = np.cumsum(RANDOM.uniform(0.05, 2.0, 40))
VALUES = RANDOM.normal(0.0, 3.0, 40)
WITHIN = RANDOM.uniform(TIMES[0], TIMES[-1], 2000)
SWING_TIMES = np.linspace(0.0, 45.0, 91)
SWING = -0.5 * np.pi * np.sin(0.5 * np.pi * SWING_TIMES / 45.0)  # ends at -90 deg, not at rest


def at(curve: Curve, time: float) -> list[float]:
    return list(curve.evaluate(np.array([time]))[0])


def test_tables_are_those_of_numpy_within_and_beyond_them_and_of_scipy() -> None:
    curve = Curve.table(TIMES, VALUES)
    everywhere = np.concatenate([WITHIN, [-50.0, 0.0, TIMES[-1] + 1e-9, 1e6]])
    found = curve.evaluate(everywhere)
    assert_allclose(found[:, 0], np.interp(everywhere, TIMES, VALUES), atol=1e-13)
    slopes = np.diff(VALUES) / np.diff(TIMES)
    assert_allclose(found[: WITHIN.size, 1], slopes[np.searchsorted(TIMES, WITHIN) - 1], rtol=1e-12)
    assert_array_equal(found[WITHIN.size :, 1:], 0.0)
    assert_array_equal(found[:, 2], 0.0)
    found = Curve.table(TIMES, VALUES, between="cubic").evaluate(WITHIN)
    spline = CubicSpline(TIMES, VALUES, bc_type="clamped")
    for order, size in ((0, 1.0), (1, 10.0), (2, 1e3)):
        assert_allclose(found[:, order], spline(WITHIN, order), atol=1e-12 * size)
    curve = spline_curve(times=SWING_TIMES, values=SWING)
    assert_allclose(curve.evaluate(SWING_TIMES)[:, 0], SWING, atol=1e-12)


REST = 0.5 * (1.0 - np.cos(np.pi * SWING_TIMES / 45.0))  # at rest at both ends, but for its acceleration


@pytest.mark.parametrize(
    ("curve", "kinks"),
    [
        (Curve.table([0.0, 1.0, 2.0, 3.0], [0.0, 1.0, 2.0, 2.0]), [0.0, 2.0]),
        (Curve.table(TIMES, VALUES, between="cubic"), [TIMES[0], TIMES[-1]]),
        (spline_curve(times=SWING_TIMES, values=SWING), [0.0, 45.0]),
        (spline_curve(times=SWING_TIMES + 2.0, values=REST), [2.0, 47.0]),
        (Curve.constant(value=1.0).then(time=1.0, curve=Curve.constant(value=1.0 + 1e-9)), [1.0]),
        (Curve.constant(value=1.0).then(time=1.0, curve=Curve.constant(value=1.0 + 1e-15)), []),
        (Curve.constant(value=0.0).then(time=1.0, curve=Curve.constant(value=1e-9)), [1.0]),
    ],
)
def test_breakpoints_are_where_the_slope_changes_and_jumps_beyond_rounding(
    curve: Curve, kinks: list[float]
) -> None:
    assert curve.breakpoints == kinks


@pytest.mark.parametrize(
    ("curve", "first", "late"),
    [
        (Curve.quintic(start_time=2.0, end_time=5.0, start=0.4, end=3.0), 0.4, [3.0, 0.0, 0.0]),
        (Curve.harmonic(start_time=2.0, offset=1.0, amplitude=0.5, omega=2.0), 1.5,
         [1.0 + 0.5 * np.cos(196.0), -np.sin(196.0), -2.0 * np.cos(196.0)]),
        # The last piece goes on as the polynomial that it is.
        (Curve.pieces(starts=[2.0], coefficients=[[0.7, 1.0, 2.0, 0, 0, 0]]), 0.7, [19306.7, 393.0, 4.0]),
        (spline_curve(times=SWING_TIMES + 2.0, values=SWING + 0.1), 0.1, [0.1 - 0.5 * np.pi, 0.0, 0.0]),
        (Curve.quintic(start_time=2.0, end_time=5.0, start=0.4, end=3.0).then(
            time=4.0, curve=Curve.constant(value=9.0)), 0.4, [9.0, 0.0, 0.0]),
        (Curve.constant(value=2.0), 2.0, [2.0, 0.0, 0.0]),
    ],
)  # fmt: skip
def test_curves_are_at_rest_before_they_start_and_what_they_do_beyond_their_end(
    curve: Curve, first: float, late: list[float]
) -> None:
    for time in (-50.0, 0.0, 1.999):
        assert at(curve, time) == pytest.approx([first, 0.0, 0.0], abs=1e-12)
    assert at(curve, 100.0) == pytest.approx(late, rel=1e-12, abs=1e-12)


@pytest.mark.parametrize(
    ("times", "values", "told"),
    [
        ([0.0, 2.0, 1.0], [0.0, 1.0, 2.0], r"times\[2\] is 1.0* s, not after 2.0* s"),
        ([0.0, 1.0], [0.0, 1.0, 2.0], "2 times and 3 values"),
        ([0.0, 1.0], [0.0, np.inf], r"values\[1\] is inf"),
    ],
)
def test_a_table_that_is_none_is_refused_by_its_sample(times: Any, values: Any, told: str) -> None:
    with pytest.raises(SceneError, match=told):
        Curve.table(times, values)


def test_a_driver_follows_tables_and_the_jumps_of_a_linear_ones_rate_are_told() -> None:
    for between, values in (("linear", [0.0, 0.0, 2.0]), ("cubic", [0.0, 0.5, 2.0])):
        scene, curve = cart(), Curve.table([0.0, 1.0, 3.0], values, between=between)
        scene.add_driver("rail", curve=curve)
        with warnings.catch_warnings(record=True, action="always") as caught:
            result = simulate(scene, 4.0, dt_out=0.1)
        told = {one.category for one in caught}
        assert (DriverImpulseWarning in told) == (between == "linear")
        assert_allclose(result["position"][:, 0, 0], curve.evaluate(result.time)[:, 0], atol=1e-12)
