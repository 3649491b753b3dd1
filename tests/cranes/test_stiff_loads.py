"""Stiff loads: explicit steps whose stiff directions are implicit, and stops through which none may leap."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from hydraulic_scenes import VALVE, raised
from multibody_runs import record
from numpy.testing import assert_allclose

from seacrane import Curve, Run, Scene, _core, cases, simulate
from seacrane.arrays import Array

STIFF = "dopri5-stiff"


def moved(lag: float = VALVE.spool_lag) -> Scene:
    """The spool is open from the start, and opens further."""
    opens = Curve.quintic(start_time=-0.5, end_time=1.5, start=0.2, end=0.6)
    return raised(command=opens, velocity=0.02, valve=replace(VALVE, spool_lag=lag))


def end_of(scene: Scene, **settings: Any) -> np.ndarray:
    out = record(scene, 0.4, dt_out=0.4, **settings)
    return np.array([out["hydraulic_stroke"][-1, 0], 1e-7 * out["hydraulic_pressure"][-1, 0, 0]])


@pytest.mark.warns("AssemblyWarning")
def test_its_order_is_four_in_stiff_directions(formulation: str) -> None:
    scene = moved(lag=0.02)
    truth = end_of(scene, rtol=1e-11, formulation=formulation)
    how: dict[str, Any] = {"rtol": 0.1, "integrator": STIFF, "formulation": formulation}
    errors = [np.linalg.norm(end_of(scene, maximum_step=h, **how) - truth) for h in (1e-3, 5e-4)]
    assert errors[0] < 1e-4 and np.log2(errors[0] / errors[1]) > 3.6


@pytest.mark.warns("AssemblyWarning", sometimes=["UnitWarning"])
@pytest.mark.parametrize("lag", [1e-3, 1e-5])
def test_a_quick_spool_costs_no_steps(lag: float) -> None:
    truth = record(moved(lag=0.0), 0.5, rtol=1e-9)
    out = record(moved(lag), 0.5, rtol=1e-3, integrator=STIFF)
    assert_allclose(out["hydraulic_stroke"], truth["hydraulic_stroke"], atol=2.0 * lag * 0.1 + 1e-4)
    assert out["stats"]["steps"] < 150  # an explicit pair takes 0.25 * 0.5 / lag or more


def test_without_stiff_loads_it_is_the_pair_itself() -> None:
    settings: dict[str, Any] = {"t_end": 3.0, "dt_out": 0.1, "rtol": 1e-4}
    runs = [Run(cases.case2(), integrator=name, **settings) for name in ("dopri5", STIFF)]
    for run in runs:
        run.advance(3.0)
    one, other = runs
    assert one.core.statistics()["evaluations"] == other.core.statistics()["evaluations"]
    assert other.core.statistics()["jacobians"] == 0
    assert_allclose(other.core.state.values, one.core.state.values, rtol=1e-11, atol=1e-10)


@pytest.mark.warns("AssemblyWarning")
def test_accuracy_takes_it_where_a_scene_has_stiff_loads() -> None:
    result = simulate(moved(), t_end=0.5, dt_out=0.05, accuracy={"hydraulic_stroke": 1e-4})
    truth = simulate(moved(), t_end=0.5, dt_out=0.05, rtol=1e-10)
    assert result.stats["integrator"] == STIFF
    assert np.max(np.abs(result["hydraulic_stroke"] - truth["hydraulic_stroke"])) < 1e-4


DROP, MASS, G = 1.0, 1e4, 9.80665


def falling(stiffness: float) -> Scene:
    """A load 1 m above a spring that only pushes: a table of force over its length from far above."""
    scene = Scene(name="stop")
    scene.add_body(name="load", mass=MASS, inertia=(1e3, 1e3, 1e3), position=(0.0, 0.0, DROP))
    scene.add_joint(kind="prismatic", name="guide", first="ground", second="load", point=(0, 0, DROP))
    far = 100.0
    scene.add_spring(
        name="stop", first="ground", second="load", first_point=(0.0, 0.0, -far),
        lengths=[far - 50.0, far, far + 50.0], forces=[-50.0 * stiffness, 0.0, 0.0],
    )  # fmt: skip
    return scene


@cache
def exact(stiffness: float) -> Array:
    """Height at every 0.02 s: parabolas, and half a swing on the spring about its static deflection."""
    speed, omega = np.sqrt(2.0 * G * DROP), np.sqrt(stiffness / MASS)
    sag = G / omega**2
    contact = (2.0 / omega) * (np.pi - np.arctan2(speed, sag * omega))
    flight = 2.0 * speed / G
    t = np.arange(0.0, 2.0 + 1e-9, 0.02)
    since = np.mod(t - 0.5 * flight, contact + flight)
    on = since < contact
    swing = -sag + sag * np.cos(omega * since) - speed / omega * np.sin(omega * since)
    airborne = since - contact
    return np.asarray(
        np.where(t < 0.5 * flight, DROP - 0.5 * G * t**2,
                 np.where(on, swing, speed * airborne - 0.5 * G * airborne**2))
    )  # fmt: skip


def deepest(stiffness: float) -> float:
    """All of the fall's energy in the spring, m."""
    sag = MASS * G / stiffness
    return float(sag + np.sqrt(sag**2 + 2.0 * sag * DROP))


@pytest.mark.warns("UnitWarning")
@pytest.mark.parametrize("stiffness", [1e6, 1e10])
@pytest.mark.parametrize(
    "integrator", [m.name for m in _core.integrators() if m.setting == "rtol" and not m.restarts]
)
def test_a_method_does_not_leap_through_a_stop(integrator: str, stiffness: float) -> None:
    for rtol in (1e-3, 1e-5, 1e-7):
        how: dict[str, Any] = {"dt_out": 0.02, "integrator": integrator, "channels": ["position"]}
        result = simulate(falling(stiffness), 2.0, rtol=rtol, **how)
        height = result["position"][:, 0, 2]
        assert height.min() > -1.1 * deepest(stiffness)
        error = np.abs(height - exact(stiffness)).max()
        assert error < 0.3, (rtol, error)
    assert error < 1e-2


def test_a_stiff_line_that_swings_is_no_stop_left_behind() -> None:
    """It stretches by the square of what it turns, which its Jacobian does not tell."""
    scene = Scene(name="swing")
    scene.add_body(name="load", mass=2e4, inertia=(2e4, 2e4, 2e4), position=(6.0, 0.0, -8.0))
    scene.add_line("wire", "ground", "load", EA=1e8, tension_at_start=160e3)
    how: dict[str, Any] = {"dt_out": 0.1, "channels": ["position"]}
    rough = simulate(scene, 10.0, integrator="rosenbrock", rtol=1e-3, **how)
    truth = simulate(scene, 10.0, rtol=1e-8, **how)
    assert rough.stats["rejected_steps"] < 0.2 * rough.stats["steps"]
    assert np.abs(rough["position"] - truth["position"]).max() < 0.02
