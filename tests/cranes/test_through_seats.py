"""Loads that come back to the seat they left: told, and nothing else."""

from __future__ import annotations

import warnings

import numpy as np
import pytest

import seacrane
from seacrane import Curve, Result, Scene, simulate
from seacrane.warnings import ThroughSeatWarning

HEAVE, OMEGA, DECK = 0.8, 0.8, 2.0
INERTIA = 5e4  # of 30 t: half a diagonal of 2.7 m


def lifted(rate: float = -0.05, heave: float = HEAVE, aside: float = 0.0) -> Scene:
    """A load on a barge that heaves, hauled up by a winch; `aside`: N that draw it off the deck."""
    scene = Scene(name="re-hit")
    scene.add_body(name="barge", mass=1e6, inertia=(1e8,) * 3)
    scene.add_joint(kind="prismatic", name="heave", first="ground", second="barge", axis=(0, 0, 1))
    wave = Curve.harmonic(start_time=0.0, offset=0.0, amplitude=heave, omega=OMEGA, phase=-np.pi / 2)
    scene.add_driver(joint="heave", curve=wave)
    scene.add_body(name="load", mass=30e3, inertia=(INERTIA,) * 3, position=(0, 0, DECK))
    scene.add_joint(kind="weld", name="on deck", first="barge", second="load")
    scene.add_seat(joint="on deck")
    scene.add_line(name="hoist", bodies=["ground", "load"], points=[(0, 0, 40.0), (0, 0, 0)], EA=1e8,
                   length=38.1)  # fmt: skip
    scene.add_winch(line="hoist", lag=0.2, rate=rate)
    if aside:
        scene.add_point_force(name="tug", body="load", force=(aside, 0, 0))
    return scene


def run(scene: Scene, **options: object) -> Result:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return simulate(scene, **{"t_end": 20.0, "dt_out": 0.01} | options)


def height(result: Result) -> np.ndarray:
    rise = result.select("position", body="load", axis="z") - result.select(
        "position", body="barge", axis="z"
    )
    return np.asarray(rise) - DECK


def through(result: Result) -> list[float]:
    return [event.time for event in result.events if event.kind == "through"]


@pytest.mark.parametrize("integrator", ["dopri5", "rk4", "cvode-bdf"])
@pytest.mark.parametrize("formulation", ["redundant", "recursive"])
def test_each_passage_is_an_event_where_the_load_passes(integrator: str, formulation: str) -> None:
    step = {"dt": 0.01} if integrator == "rk4" else {"rtol": 1e-6}
    result = run(lifted(), integrator=integrator, formulation=formulation, **step)
    gap = height(result) + 1e-3
    left = result.time > next(event.time for event in result.events if event.kind == "release")
    passed = np.flatnonzero((gap[:-1] >= 0.0) & (gap[1:] < 0.0) & left[1:])
    times = through(result)
    assert len(times) == passed.size >= 2
    for at, time in zip(passed, times, strict=True):
        assert result.time[at] - 1e-9 <= time <= result.time[at + 1] + 1e-9


def test_beside_the_seat_nothing_is_told() -> None:
    """The load is drawn aside by more than its own size before it sinks below the deck's height."""
    result = run(lifted(aside=2e4), t_end=12.0)
    away = np.hypot(*(result.select("position", body="load", axis=axis) for axis in "xy"))
    under = height(result) < -0.1
    assert under.any() and away[under].min() > 4.0
    assert through(result) == []


def test_a_run_that_goes_on_tells_each_passage_once() -> None:
    assert through(run(lifted(rate=-1.0))) == []  # fast enough
    with pytest.warns(ThroughSeatWarning, match=r"seat 'on deck'.*'load' .*at t = [0-9.]+ s"):
        result = simulate(lifted(), t_end=20.0, dt_out=0.01)
    whole = through(result)
    assert "through it" in seacrane.report(result).html
    cut = 0.5 * (whole[0] + whole[1])
    first = run(lifted(), t_end=cut)
    second = run(lifted(), start=first.state)
    assert len(through(first)) == 1
    np.testing.assert_allclose([*through(first), *through(second)], whole, atol=1e-6)
