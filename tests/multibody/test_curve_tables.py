"""Curves through samples: against NumPy, SciPy and closed forms, beside their table, and at their kinks."""

from __future__ import annotations

import warnings

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from scipy.interpolate import CubicSpline

from seacrane import Curve, Scene, SceneError, simulate

RANDOM = np.random.default_rng(5)
TIMES = np.cumsum(RANDOM.uniform(0.05, 2.0, 40))
VALUES = RANDOM.normal(0.0, 3.0, 40)
WITHIN = RANDOM.uniform(TIMES[0], TIMES[-1], 2000)


def test_a_linear_table_is_what_numpy_interpolates_within_and_beyond_it() -> None:
    curve = Curve.table(TIMES, VALUES)
    everywhere = np.concatenate([WITHIN, [-50.0, 0.0, TIMES[-1] + 1e-9, 1e6]])
    found = curve.evaluate(everywhere)
    assert_allclose(found[:, 0], np.interp(everywhere, TIMES, VALUES), atol=1e-13)
    slopes = np.diff(VALUES) / np.diff(TIMES)
    assert_allclose(found[: WITHIN.size, 1], slopes[np.searchsorted(TIMES, WITHIN) - 1], rtol=1e-12)
    assert_array_equal(found[WITHIN.size :, 1:], 0.0)
    assert_array_equal(found[:, 2], 0.0)


def test_a_cubic_table_is_the_spline_that_is_at_rest_at_both_ends() -> None:
    found = Curve.table(TIMES, VALUES, between="cubic").evaluate(WITHIN)
    spline = CubicSpline(TIMES, VALUES, bc_type="clamped")
    for order, size in ((0, 1.0), (1, 10.0), (2, 1e3)):
        assert_allclose(found[:, order], spline(WITHIN, order), atol=1e-12 * size)


def test_two_samples_of_a_cubic_table_make_the_smooth_step() -> None:
    s = np.linspace(0.0, 1.0, 11)
    found = Curve.table([2.0, 6.0], [1.0, 4.0], between="cubic").evaluate(2.0 + 4.0 * s)
    assert_allclose(found[:, 0], 1.0 + 3.0 * (3.0 * s**2 - 2.0 * s**3), atol=1e-14)


def test_a_cubic_table_converges_with_the_fourth_power_of_its_spacing() -> None:
    fine = np.linspace(0.0, 2.0 * np.pi, 2001)
    errors = []
    for count in (21, 41, 81):
        times = np.linspace(0.0, 2.0 * np.pi, count)
        curve = Curve.table(times, np.cos(times), between="cubic")
        errors.append(np.abs(curve.evaluate(fine)[:, 0] - np.cos(fine)).max())
    assert np.log2(np.array(errors[:-1]) / errors[1:]) == pytest.approx([4.0, 4.0], abs=0.15)


def test_breakpoints_are_the_samples_at_which_the_slope_changes() -> None:
    assert Curve.table([0.0, 1.0, 2.0, 3.0], [0.0, 1.0, 2.0, 2.0]).breakpoints == [0.0, 2.0]
    assert Curve.table([0.0, 1.0, 2.0], [5.0, 5.0, 5.0]).breakpoints == []
    assert Curve.table(TIMES, VALUES, between="cubic").breakpoints == [TIMES[0], TIMES[-1]]


@pytest.mark.parametrize(
    ("times", "values", "told"),
    [
        ([0.0, 1.0, 1.0], [0.0, 1.0, 2.0], r"times\[2\] is 1.0* s, not after 1.0* s before it"),
        ([0.0, 2.0, 1.0], [0.0, 1.0, 2.0], r"times\[2\] is 1.0* s, not after 2.0* s before it"),
        ([0.0, 1.0], [0.0, 1.0, 2.0], "there are 2 times and 3 values; give one value for each time"),
        ([0.0], [1.0], "has two samples at least"),
        ([0.0, np.nan], [0.0, 1.0], r"times\[1\] is nan; give finite ones"),
        ([0.0, 1.0], [0.0, np.inf], r"values\[1\] is inf; give finite ones"),
        ([[0.0, 1.0]], [[0.0, 1.0]], r"(times|values) has shape \(1, 2\); give one row"),
        (["0", "1"], [0.0, 1.0], "give numbers"),
    ],
)
def test_a_table_that_is_none_is_refused_by_its_sample(times: object, values: object, told: str) -> None:
    with pytest.raises(SceneError, match=told):
        Curve.table(times, values)  # type: ignore[arg-type]


def test_another_word_than_linear_or_cubic_is_refused() -> None:
    with pytest.raises(SceneError, match="between is 'quadratic'; choose 'linear' or 'cubic'"):
        Curve.table([0.0, 1.0], [0.0, 1.0], between="quadratic")


def slider(**drive: object) -> Scene:
    scene = Scene(gravity=0.0)
    scene.add_body("block", mass=2.0, size=(1, 1, 1))
    scene.add_joint("rail", kind="prismatic", first="ground", second="block", axis=(1, 0, 0))
    return scene


FORCE = ([0.31, 1.27, 1.9, 3.3], [0.0, 40.0, -25.0, 5.0])


def pushed(t: np.ndarray) -> np.ndarray:
    """Where a force by `FORCE` brings 2 kg from rest: its double integral, piece by piece, over the mass."""
    fine = np.unique(np.concatenate([FORCE[0], t]))
    force = np.interp(fine, *FORCE)
    place = speed = 0.0
    found = {fine[0]: 0.0}
    for i, h in enumerate(np.diff(fine)):
        rise = (force[i + 1] - force[i]) / h
        place += speed * h + (force[i] * h**2 / 2.0 + rise * h**3 / 6.0) / 2.0
        speed += (force[i] * h + rise * h**2 / 2.0) / 2.0
        found[fine[i + 1]] = place
    return np.array([found[one] for one in t])


@pytest.mark.warns("MassUnitWarning")
@pytest.mark.parametrize("integrator", ["dopri5", "tsit5", "verner65", "rk4"])
def test_a_force_by_a_linear_table_is_integrated_as_exactly_as_one_without_kinks(integrator: str) -> None:
    """The motion is a cubic between kinks, which each of these methods steps exactly if it meets them."""
    scene = slider()
    scene.add_actuator("rail", feed_forward=Curve.table(*FORCE))
    step = {"dt": 0.1} if integrator == "rk4" else {"rtol": 1e-9}
    result = simulate(scene, 4.0, dt_out=0.05, integrator=integrator, **step)  # type: ignore[arg-type]
    assert_allclose(result["position"][:, 0, 0], pushed(result.time), atol=2e-12)


@pytest.mark.warns("EnergyErrorWarning", "MassUnitWarning")
def test_a_driver_follows_a_linear_table_and_the_jumps_of_its_rate_are_told() -> None:
    from seacrane.warnings import DriverImpulseWarning

    scene = slider()
    scene.add_driver("rail", curve=Curve.table([0.0, 1.0, 3.0], [0.0, 0.0, 2.0]))
    with pytest.warns(DriverImpulseWarning):
        result = simulate(scene, 4.0, dt_out=0.1)
    where = np.interp(result.time, [0.0, 1.0, 3.0], [0.0, 0.0, 2.0])
    assert_allclose(result["position"][:, 0, 0], where, atol=1e-12)


@pytest.mark.warns("MassUnitWarning")
def test_a_driver_follows_a_cubic_table_without_an_impulse() -> None:
    scene = slider()
    curve = Curve.table([0.0, 1.0, 3.0], [0.0, 0.5, 2.0], between="cubic")
    scene.add_driver("rail", curve=curve)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        result = simulate(scene, 4.0, dt_out=0.1)
    assert_allclose(result["position"][:, 0, 0], curve.evaluate(result.time)[:, 0], atol=1e-12)


@pytest.mark.warns("MassUnitWarning")
def test_a_record_of_a_run_drives_another_one() -> None:
    scene = slider()
    scene.add_actuator("rail", feed_forward=Curve.table(*FORCE))
    record = simulate(scene, 4.0, dt_out=0.05)
    again = slider()
    again.add_driver("rail", curve=Curve.table(record.time, record["position"][:, 0, 0], between="cubic"))
    result = simulate(again, 4.0, dt_out=0.05)
    assert_allclose(result["position"][:, 0, 0], record["position"][:, 0, 0], atol=1e-12)


@pytest.mark.warns("MassUnitWarning")
def test_a_scene_with_a_table_is_read_back_from_its_file(tmp_path: object) -> None:
    scene = slider()
    scene.add_actuator("rail", feed_forward=Curve.table(TIMES, VALUES, between="cubic"))
    scene.save(f"{tmp_path}/scene.json")
    assert Scene.load(f"{tmp_path}/scene.json") == scene
