"""Gas springs against the gas law, their small-amplitude stiffness, SciPy, and energy."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from element_runs import both_forms
from multibody_runs import record
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

from seacrane import Scene, SceneError, natural_modes, simulate
from seacrane.scene import Gas, Stops

G = 9.80665
MASS, AREA, LENGTH = 20e3, 0.02, 8.0  # kg, m2, m
VOLUME = 0.15  # m3
GAS = Gas(area=AREA, pressure=MASS * G / AREA, volume=VOLUME)


def hung(*, height: float = -LENGTH, velocity: float = 0.0, **settings: Any) -> Scene:
    """A load below a gas spring that carries its weight."""
    scene, state = Scene(name="passive"), {"position": (0, 0, height), "velocity": (0, 0, velocity)}
    scene.add_body(name="load", mass=MASS, inertia=(1e4, 1e4, 1e4), **state)
    scene.add_spring("phc", first="ground", second="load", **{"gas": GAS} | settings)
    return scene


@pytest.mark.parametrize("exponent", [1.0, 1.67])
def test_the_natural_period_is_that_of_kappa_p_a2_over_v(exponent: float) -> None:
    stiffness = exponent * MASS * G / AREA * AREA**2 / VOLUME
    modes = natural_modes(hung(gas=replace(GAS, exponent=exponent)))
    expected = 2.0 * np.pi * np.sqrt(MASS / stiffness)
    assert np.min(np.abs(modes.natural_period / expected - 1.0)) < 1e-6


def test_force_and_stiffness_give_the_same_gas() -> None:
    k = 1.4 * MASS * G * AREA / VOLUME
    by_force = hung(gas=Gas(area=AREA, force=MASS * G, stiffness=k)).loads["phc"]
    by_gas = hung().loads["phc"]
    assert by_force.pressure == pytest.approx(by_gas.pressure, rel=1e-14)
    assert by_force.volume == pytest.approx(by_gas.volume, rel=1e-14)
    assert by_gas.length == LENGTH


@pytest.mark.parametrize(("exponent", "pushes"), [(1.0, True), (1.4, False)])
def test_large_strokes_follow_the_gas_law(exponent: float, pushes: bool) -> None:
    damping, quadratic = 2e3, 3e3
    gas = replace(GAS, exponent=exponent, pushes=pushes)
    oil = {"gas": gas, "damping": damping, "quadratic_damping": quadratic}
    scene = hung(velocity=-2.0, **oil)
    if pushes:
        scene = hung(height=LENGTH, velocity=-2.0, stops=Stops(minimum=1.0), **oil)
        scene.add_joint(kind="prismatic", name="guide", first="ground", second="load", axis=(0, 0, 1))
    out = record(scene, 8.0, rtol=1e-10)
    length = out["gas_spring_length"][:, 0]
    assert np.ptp(length) > 2.0

    def motion(t: float, x: Any) -> list[float]:
        used = AREA * (x[0] - LENGTH) * (-1.0 if pushes else 1.0)
        gas = MASS * G * (VOLUME / (VOLUME - used)) ** exponent
        oil = damping * x[1] + quadratic * x[1] * abs(x[1])
        pull = (-gas if pushes else gas) + oil
        weight = -MASS * G if pushes else MASS * G
        return [x[1], (weight - pull) / MASS]

    start = [LENGTH, -2.0 if pushes else 2.0]
    expected = solve_ivp(motion, (0.0, 8.0), start, t_eval=out["time"], rtol=1e-11, atol=1e-12).y
    assert_allclose(length, expected[0], atol=1e-7)
    used = AREA * (length - LENGTH) * (-1.0 if pushes else 1.0)
    assert_allclose(
        out["gas_spring_pressure"][:, 0], MASS * G / AREA * (VOLUME / (VOLUME - used)) ** exponent, rtol=1e-12
    )
    assert np.max(np.abs(out["energy_balance"])) < 1e-6 * out["absolute_work"][-1]


def test_end_stops_are_located_told_and_give_back_what_they_take() -> None:
    """With gas alone and stops alone energy is kept; a stop adds its stiffness beyond the length."""
    scene = hung(velocity=-3.0, stops=Stops(maximum=9.0, minimum=7.2, stiffness=5e6))
    result = simulate(scene, 6.0, dt_out=0.01, rtol=1e-9)
    length = result["gas_spring_length"][:, 0]
    beyond = np.clip(length - 9.0, 0.0, None) + np.clip(length - 7.2, None, 0.0)
    gas = result["gas_spring_pressure"][:, 0] * AREA
    assert_allclose(result["gas_spring_tension"][:, 0], gas + 5e6 * beyond, rtol=1e-12)
    assert np.max(np.abs(beyond)) > 0.1
    told = [(event.kind, event.name) for event in result.events]
    assert set(told) == {("limit", "phc.maximum"), ("limit", "phc.minimum")}
    reached = np.diff((length > 9.0).astype(int)) == 1
    assert told.count(("limit", "phc.maximum")) == int(np.sum(reached))
    assert np.max(np.abs(result["energy_balance"])) < 1e-6 * 0.5 * MASS * 9.0
    at = [event.time for event in result.events if event.name == "phc.maximum"]
    assert_allclose(np.interp(at, result.time, length), 9.0, atol=2e-3)


def test_both_formulations_agree_and_energy_closes() -> None:
    scene = hung(damping=5e3, quadratic_damping=1e3, stops=Stops(maximum=8.5))
    scene.add_body(name="hook", mass=2e3, inertia=(100, 100, 100), position=(1.0, 0.2, -LENGTH - 3.0))
    scene.add_joint("eye", kind="spherical", first="load", second="hook", point=(0.0, 0.0, -LENGTH - 1.0))
    scene.add_spring(name="side", first="ground", second="hook", first_point=(9, 0, -9), stiffness=8e4)
    both_forms(scene, 3.0, {"position": 1e-7}, rtol=1e-9)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"gas": replace(GAS, force=1e5)}, "give pressure and volume, or force and stiffness"),
        ({"stops": Stops(maximum=7.0)}, "length is 8 m, and its stops are at 0 and 7 m"),
        ({"stops": Stops(maximum=16.0)}, "would have -0.01 m3 at the end of its stroke"),
    ],
)
def test_gas_springs_that_cannot_be_are_told(given: dict[str, Any], message: str) -> None:
    with pytest.raises(SceneError, match=f"gas spring 'phc': .*{message}"):
        hung(**given).compile()
