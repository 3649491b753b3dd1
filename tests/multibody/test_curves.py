"""Curves of time before their start and beyond their end: docs/conventions.md, tried."""

from __future__ import annotations

import numpy as np
import pytest

from seacrane import Curve
from seacrane.scene import gust_curve, spline_curve

TIMES = np.linspace(0.0, 45.0, 91)
SWING = -0.5 * np.pi * np.sin(0.5 * np.pi * TIMES / 45.0)  # ends at -90 deg, not at rest


def at(curve: Curve, time: float) -> list[float]:
    return list(curve.evaluate(np.array([time]))[0])


def test_a_spline_holds_its_last_value() -> None:
    curve = spline_curve(times=TIMES, values=SWING)
    np.testing.assert_allclose(curve.evaluate(TIMES)[:, 0], SWING, atol=1e-12)
    for time in (45.0, 46.0, 100.0, 1e6):
        assert at(curve, time) == pytest.approx([-0.5 * np.pi, 0.0, 0.0], abs=1e-12)


def test_a_splines_ends_are_its_breakpoints_and_its_samples_are_not() -> None:
    assert spline_curve(times=TIMES, values=SWING).breakpoints == [0.0, 45.0]
    rest = 0.5 * (1.0 - np.cos(np.pi * TIMES / 45.0))  # at rest at both ends, but for its acceleration
    assert spline_curve(times=TIMES + 2.0, values=rest).breakpoints == [2.0, 47.0]
    assert spline_curve(times=TIMES, values=np.full(91, 0.3)).breakpoints == []


def test_every_curve_is_at_rest_at_its_first_value_before_it_starts() -> None:
    curves = {
        "quintic": (Curve.quintic(start_time=2.0, end_time=5.0, start=0.4, end=3.0), 0.4),
        "harmonic": (Curve.harmonic(start_time=2.0, offset=1.0, amplitude=0.5, omega=2.0), 1.5),
        "pieces": (Curve.pieces(starts=[2.0], coefficients=[[0.7, 1.0, 2.0, 0.0, 0.0, 0.0]]), 0.7),
        "spline": (spline_curve(times=TIMES + 2.0, values=SWING + 0.1), 0.1),
        "then": (Curve.quintic(start_time=2.0, end_time=5.0, start=0.4, end=3.0).then(
            time=4.0, curve=Curve.constant(value=9.0)), 0.4),
    }  # fmt: skip
    for name, (curve, first) in curves.items():
        for time in (-50.0, 0.0, 1.999):
            assert at(curve, time) == pytest.approx([first, 0.0, 0.0], abs=1e-12), name


def test_what_curves_do_beyond_their_end() -> None:
    assert at(Curve.quintic(start_time=0.0, end_time=5.0, start=0.4, end=3.0), 1e4) == [3.0, 0.0, 0.0]
    assert at(Curve.constant(value=2.0), 1e4) == [2.0, 0.0, 0.0]
    swing = Curve.harmonic(offset=1.0, amplitude=0.5, omega=2.0)
    assert at(swing, 100.0)[0] == pytest.approx(1.0 + 0.5 * np.cos(200.0))
    ramp = Curve.pieces(starts=[0.0], coefficients=[[0.0, 2.0, 0.0, 0.0, 0.0, 0.0]])
    assert at(ramp, 100.0) == [200.0, 2.0, 0.0]  # the last piece goes on as the polynomial that it is
    assert at(ramp.then(time=3.0, curve=Curve.constant(value=6.0)), 100.0) == [6.0, 0.0, 0.0]
    gust = gust_curve(mean_speed=10.0, duration=20.0, count=20)
    assert at(gust, 20.0) == at(gust, 500.0)
    assert at(gust, 500.0)[1:] == [0.0, 0.0]


def test_a_jump_of_any_size_beyond_rounding_is_a_breakpoint() -> None:
    for size, kinks in ((1e-9, [1.0]), (1e-15, [])):
        step = Curve.constant(value=1.0).then(time=1.0, curve=Curve.constant(value=1.0 + size))
        assert step.breakpoints == kinks, size
    small = Curve.constant(value=0.0).then(time=1.0, curve=Curve.constant(value=1e-9))
    assert small.breakpoints == [1.0]
