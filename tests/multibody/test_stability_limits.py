"""Stability polynomials, the step limits that follow from them, and modes that a method feeds."""

from __future__ import annotations

import re
from math import factorial
from typing import Any

import numpy as np
import pytest
from kink_scenes import sprung
from numpy.polynomial import Polynomial

from seacrane import Scene, _core, integrator_names, simulate
from seacrane.analysis.linear_system import linear_model
from seacrane.warnings import GrowingModeWarning
from stability_atlas.step_limit import found_limit, predicted_limit


@pytest.mark.parametrize("name", [name for name in integrator_names() if _core.stability_polynomial(name)])
def test_a_stability_polynomial_is_the_exponential_up_to_its_order(name: str) -> None:
    coefficients = _core.stability_polynomial(name)
    order = _core.integrator(name).order
    exact = [1.0 / factorial(k) for k in range(order + 2)]
    np.testing.assert_allclose(coefficients[: order + 1], exact[:-1], rtol=1e-12)
    if len(coefficients) > order + 1:
        assert coefficients[order + 1] != pytest.approx(exact[-1], rel=1e-3)


@pytest.mark.parametrize("name", ["semi-implicit-euler", "rk4", "rk-low-storage", "bs32", "tsit5", "dop853"])
def test_the_longest_stable_step_of_an_oscillator(name: str) -> None:
    scene = sprung(20.0, 0.2)
    linear = linear_model(scene)
    predicted = predicted_limit(name, linear, np.asarray(np.linalg.eigvals(linear.a), dtype=complex))
    if name == "semi-implicit-euler":  # h w = 2 sqrt(1 + z^2) - 2 z, by the characteristic polynomial
        assert predicted == pytest.approx((2.0 * np.sqrt(1.04) - 0.4) / 20.0, rel=0.03)
    assert found_limit(scene, linear, "recursive", name, predicted) == pytest.approx(predicted, rel=0.01)


MODE, STEP = 2.2, 0.5  # rad/s, s
AMPLITUDE = 1e-6  # m


def run(scene: Scene, integrator: str = "tsit5", **settings: Any) -> Any:
    given = {"t_end": 6000.0, "dt_out": 1.0, "maximum_step": STEP, "rtol": 1e-2} | settings
    return simulate(scene, integrator=integrator, **given)


@pytest.mark.parametrize("integrator", ["tsit5", "dopri5"])
def test_the_growth_told_is_that_of_the_motion_and_of_the_stability_polynomial(integrator: str) -> None:
    with pytest.warns(GrowingModeWarning, match=f"{integrator} makes .* body 'cart' grow") as caught:
        result = run(sprung(MODE, speed=AMPLITUDE * MODE), integrator)
    told = re.search(r"factor of (\S+) an hour: a mode of (\S+) rad/s", str(caught[0].message))
    assert told is not None
    assert float(told[2]) == pytest.approx(MODE, rel=1e-3)
    in_one_step = abs(Polynomial(_core.stability_polynomial(integrator))(1j * STEP * MODE))
    assert float(told[1]) == pytest.approx(in_one_step ** (3600.0 / STEP), rel=2e-3)
    position = np.abs(result["position"][:, 0, 0])
    hours = (result.time[-1] - 20.0) / 3600.0
    assert position[-20:].max() / position[:20].max() == pytest.approx(float(told[1]) ** hours, rel=0.05)


@pytest.mark.parametrize(
    ("damping_ratio", "integrator", "settings"),
    [
        (0.0, "verner65", {}),  # damps up to 2.5
        (0.0, "dopri5", {"maximum_step": 0.4}),
        (0.001, "tsit5", {}),  # outweighs the growth
        (0.0, "tsit5", {"t_end": 1000.0, "rtol": 1e-4}),  # too short for the growth to matter
    ],
)
def test_what_does_not_grow_is_not_told(damping_ratio: float, integrator: str, settings: Any) -> None:
    result = run(sprung(MODE, damping_ratio, speed=AMPLITUDE * MODE), integrator, **settings)
    start, end = np.abs(result["position"][:20, 0, 0]).max(), np.abs(result["position"][-20:, 0, 0]).max()
    assert end < 2.0 * start
