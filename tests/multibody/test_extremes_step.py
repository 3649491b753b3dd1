"""Stability polynomials of the tableaus, and the step limits that follow from them."""

from __future__ import annotations

from math import factorial, inf, isnan

import numpy as np
import pytest
from kink_scenes import CART, cart
from numpy.polynomial import Polynomial

from seacrane import Scene, _core, integrator_names
from seacrane.analysis.linear_system import linear_model
from stability_atlas.step_limit import found_limit, predicted_limit


@pytest.mark.parametrize("name", [name for name in integrator_names() if _core.stability_polynomial(name)])
def test_a_stability_polynomial_is_the_exponential_up_to_its_order(name: str) -> None:
    coefficients = _core.stability_polynomial(name)
    order = _core.integrator(name).order
    exact = [1.0 / factorial(k) for k in range(order + 2)]
    np.testing.assert_allclose(coefficients[: order + 1], exact[:-1], rtol=1e-12)
    if len(coefficients) > order + 1:
        assert coefficients[order + 1] != pytest.approx(exact[-1], rel=1e-3)


def test_known_intervals_of_stability() -> None:
    """Real axis: 2.785 for order 4 in four stages, 3.307 for dopri5 [Hairer, Wanner II, IV.2]."""
    for name, limit in (("rk4", 2.7853), ("bs32", 2.5127), ("dopri5", 3.3066)):
        polynomial = Polynomial(_core.stability_polynomial(name))
        assert abs(polynomial(-limit * 0.999)) < 1.0 < abs(polynomial(-limit * 1.001))
    assert _core.stability_polynomial("cvode-bdf") == []
    assert _core.stability_polynomial("ark-dirk") == []


def oscillator() -> Scene:
    """A cart on a spring, 20 rad/s and a fifth of critical damping."""
    scene = cart()
    scene.add_actuator(joint="rail", stiffness=CART * 20.0**2, damping=0.4 * CART * 20.0, reference=0.0)
    return scene


@pytest.mark.parametrize("name", ["semi-implicit-euler", "rk4", "rk-low-storage", "bs32", "tsit5", "dop853"])
@pytest.mark.parametrize("formulation", ["recursive", "redundant"])
def test_the_longest_stable_step_of_an_oscillator(name: str, formulation: str) -> None:
    scene = oscillator()
    linear = linear_model(scene)
    predicted = predicted_limit(name, linear, np.asarray(np.linalg.eigvals(linear.a), dtype=complex))
    if name == "semi-implicit-euler":  # h w = 2 sqrt(1 + z^2) - 2 z, by the characteristic polynomial
        assert predicted == pytest.approx((2.0 * np.sqrt(1.04) - 0.4) / 20.0, rel=0.03)
    assert found_limit(scene, linear, formulation, name, predicted) == pytest.approx(predicted, rel=0.01)


def test_methods_that_have_no_limit_or_no_prediction() -> None:
    scene = oscillator()
    linear = linear_model(scene)
    eigenvalues = np.asarray(np.linalg.eigvals(linear.a), dtype=complex)
    assert isnan(predicted_limit("generalized-alpha", linear, eigenvalues))
    assert found_limit(scene, linear, "redundant", "generalized-alpha", float("nan")) == inf
