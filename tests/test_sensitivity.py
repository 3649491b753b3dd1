"""Gradients of statistics by common random numbers, against closed forms."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from seacrane import Kept, Scene, SceneError, sensitivity

STIFFNESS, MASS = 400.0, 4.0  # N/m, kg
PERIOD = 2.0 * np.pi * np.sqrt(MASS / STIFFNESS)


def force(seed: int) -> float:
    return float(np.random.default_rng(seed).gumbel(100.0, 10.0))


def pushed(*, seed: int, stiffness: float = STIFFNESS, mass: float = MASS) -> Scene:
    """A mass on a spring that a constant force moves from rest: its largest way is 2 F / k."""
    scene = Scene(name="pushed", gravity=0.0)
    scene.add_body(name="mass", mass=mass, inertia=(1.0, 1.0, 1.0))
    scene.add_joint(
        kind="prismatic", name="rail", first="ground", second="mass", point=(0, 0, 0), axis=(1, 0, 0)
    )
    scene.add_actuator(
        name="spring", joint="rail", stiffness=stiffness, damping=0.0, feed_forward=force(seed)
    )
    return scene


def fails_for_some(*, seed: int, stiffness: float) -> Scene:
    if seed == 3 and stiffness > STIFFNESS:
        raise ValueError("too stiff")
    return pushed(seed=seed, stiffness=stiffness)


REACH = Kept(channel="position", what="maximum", names={"body": "mass", "axis": "x"})
GIVEN: dict[str, Any] = {
    "keep": REACH, "seeds": range(1, 31), "t_end": 1.2 * PERIOD, "dt_out": PERIOD / 100.0, "rtol": 1e-7,
}  # fmt: skip
FORCES = np.array([force(seed) for seed in range(1, 31)])


@pytest.fixture(scope="module")
def by_mean() -> Any:
    return sensitivity(pushed, parameters={"stiffness": (STIFFNESS, 4.0), "mass": (MASS, 0.04)}, **GIVEN)


def test_the_gradient_of_a_mean_is_that_of_the_closed_form(by_mean: Any) -> None:
    assert by_mean.value.value == pytest.approx(2.0 * FORCES.mean() / STIFFNESS, rel=1e-4)
    found = by_mean.gradients["stiffness"]
    assert found.value == pytest.approx(-2.0 * FORCES.mean() / STIFFNESS**2, rel=2e-3)
    truth = -2.0 * (100.0 + 10.0 * np.euler_gamma) / STIFFNESS**2
    assert found.low < truth < found.high
    assert found.half_width == pytest.approx(
        2.045 * 2.0 * FORCES.std(ddof=1) / STIFFNESS**2 / 30**0.5, rel=0.01
    )


def test_what_does_not_matter_has_no_gradient(by_mean: Any) -> None:
    """The mass sets when the largest way is reached, not how far it is."""
    assert abs(by_mean.gradients["mass"].value) * MASS < 2e-3 * by_mean.value.value


def test_the_same_seeds_on_both_sides_save_runs(by_mean: Any) -> None:
    """Values of both sides differ by 2 % of themselves, and scatter by a tenth."""
    assert by_mean.saved["stiffness"] == pytest.approx(2.0 / 0.02**2, rel=0.05)
    assert "stiffness" in str(by_mean)
    assert "30 seeds" in str(by_mean)


@pytest.mark.parametrize(("number", "reduced"), [("mpm", 0.0), ("p90", -np.log(-np.log(0.9)))])
def test_the_gradient_of_a_gumbel_number(number: str, reduced: float) -> None:
    found = sensitivity(pushed, parameters={"stiffness": (STIFFNESS, 4.0)}, number=number, **GIVEN)
    one = found.gradients["stiffness"]
    truth = -2.0 * (100.0 + 10.0 * reduced) / STIFFNESS**2
    assert one.low < truth < one.high
    assert one.value == pytest.approx(-found.value.value / STIFFNESS, rel=1e-3)
    assert one.half_width < 0.15 * abs(truth)


@pytest.mark.warns("FailedMembersWarning")
def test_a_seed_with_a_failure_is_left_out() -> None:
    found = sensitivity(fails_for_some, parameters={"stiffness": (STIFFNESS, 4.0)}, **GIVEN)
    assert found.seeds == 29
    assert found.failures == ("ValueError: too stiff",)


@pytest.mark.warns(sometimes=["FailedMembersWarning"])
@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"parameters": {}}, "parameters is {}"),
        ({"parameters": {"stiffness": 3.0}}, r"stiffness is 3.0; give \(value, step\)"),
        ({"parameters": {"stiffness": (3.0, 0.0)}}, "give a step above zero"),
        ({"parameters": {"seed": (3, 1)}}, "of all but the seed"),
        ({"seeds": range(9)}, "seeds: 9 different of 9"),
        ({"seeds": [1] * 12}, "seeds: 1 different of 12"),
        ({"number": "p99"}, "number is 'p99'"),
        ({"keep": Kept(channel="posture")}, "every run failed .*posture"),
        ({"keep": Kept(channel="position", what="maximum")}, "several numbers, over body, axis"),
    ],
)
def test_bad_input_is_named(given: dict[str, Any], message: str) -> None:
    usual: dict[str, Any] = {"parameters": {"stiffness": (STIFFNESS, 4.0)}, **GIVEN, "t_end": 0.1}
    with pytest.raises(SceneError, match=message):
        sensitivity(pushed, **{**usual, **given})
