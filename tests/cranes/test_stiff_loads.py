"""Explicit steps whose stiff directions are implicit: orders, steps, ledger and what it leaves alone."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hydraulic_scenes import SET, lifted, raised
from multibody_runs import record
from numpy.testing import assert_allclose

from seacrane import Curve, Run, Scene, cases, simulate

STIFF = "dopri5-stiff"
FORMULATIONS = ("redundant", "recursive")


def moved(**settings: Any) -> Scene:
    """The spool is open from the start, and opens further."""
    opens = Curve.quintic(start_time=-0.5, end_time=1.5, start=0.2, end=0.6)
    return raised(command=opens, velocity=0.02, **settings)


def end_of(scene: Scene, **settings: Any) -> np.ndarray:
    out = record(scene, 0.4, dt_out=0.4, **settings)
    return np.array([out["hydraulic_stroke"][-1, 0], 1e-7 * out["hydraulic_pressure"][-1, 0, 0]])


@pytest.mark.warns("AssemblyWarning")
@pytest.mark.parametrize("formulation", FORMULATIONS)
def test_its_order_is_four_in_stiff_directions(formulation: str) -> None:
    scene = moved(spool_lag=0.02)
    truth = end_of(scene, rtol=1e-11, formulation=formulation)
    errors = [
        np.linalg.norm(
            end_of(scene, rtol=0.1, maximum_step=h, integrator=STIFF, formulation=formulation) - truth
        )
        for h in (2e-3, 1e-3, 5e-4)
    ]
    slopes = np.log2(np.array(errors[:-1]) / np.array(errors[1:]))
    assert errors[0] < 1e-4
    assert slopes[-1] > 3.6


def test_both_formulations_agree() -> None:
    runs = [record(lifted(), 1.7, rtol=1e-5, integrator=STIFF, formulation=f) for f in FORMULATIONS]
    assert_allclose(runs[0]["hydraulic_stroke"], runs[1]["hydraulic_stroke"], atol=3e-6)


@pytest.mark.warns("AssemblyWarning", sometimes=["UnitWarning"])
@pytest.mark.parametrize("lag", [1e-3, 1e-4, 1e-5])
def test_a_quick_spool_costs_no_steps(lag: float) -> None:
    scene = moved(spool_lag=lag)
    truth = record(moved(spool_lag=0.0), 0.5, rtol=1e-9)
    out = record(scene, 0.5, rtol=1e-3, integrator=STIFF)
    explicit = record(scene, 0.5, rtol=1e-3, integrator="dopri5") if lag > 1e-5 else None
    assert_allclose(out["hydraulic_stroke"], truth["hydraulic_stroke"], atol=2.0 * lag * 0.1 + 1e-4)
    assert out["stats"]["steps"] < 150
    if explicit is not None:
        assert explicit["stats"]["steps"] > 0.25 * 0.5 / lag


def test_it_follows_the_tight_reference_and_its_ledger_closes() -> None:
    scene = lifted()
    truth = record(scene, 1.7, dt_out=0.02, rtol=1e-9)
    for rtol, limit in ((1e-3, 2e-4), (1e-5, 3e-6)):
        out = record(scene, 1.7, dt_out=0.02, rtol=rtol, integrator=STIFF)
        assert np.max(np.abs(out["hydraulic_stroke"] - truth["hydraulic_stroke"])) < limit
    tight = record(scene, 1.7, rtol=1e-8, integrator=STIFF)
    assert np.max(np.abs(tight["energy_balance"])) < 1e-6 * tight["absolute_work"][-1]


def test_without_stiff_loads_it_is_the_pair_itself() -> None:
    settings: dict[str, Any] = {"t_end": 3.0, "dt_out": 0.1, "rtol": 1e-4}
    runs = [Run(cases.case2(), integrator=name, **settings) for name in ("dopri5", STIFF)]
    for run in runs:
        run.advance(3.0)
    one, other = runs
    assert one.core.statistics()["evaluations"] == other.core.statistics()["evaluations"]
    assert other.core.statistics()["jacobians"] == 0
    assert_allclose(other.core.state.values, one.core.state.values, rtol=1e-11, atol=1e-10)


def test_it_linearises_once_in_some_steps() -> None:
    stats = record(lifted(), 1.7, rtol=1e-4, integrator=STIFF)["stats"]
    assert 0 < stats["jacobians"] < 0.5 * stats["steps"]
    assert SET["spool_lag"] * stats["steps"] < 1.7


@pytest.mark.warns("AssemblyWarning")
def test_accuracy_takes_it_where_a_scene_has_stiff_loads() -> None:
    result = simulate(moved(), t_end=0.5, dt_out=0.05, accuracy={"hydraulic_stroke": 1e-4})
    truth = simulate(moved(), t_end=0.5, dt_out=0.05, rtol=1e-10)
    assert result.stats["integrator"] == STIFF
    assert np.max(np.abs(result["hydraulic_stroke"] - truth["hydraulic_stroke"])) < 1e-4
