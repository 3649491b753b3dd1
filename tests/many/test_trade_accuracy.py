"""simulate(accuracy=...): what it promises against tight runs, on random scenes and lifts, and refuses."""

from __future__ import annotations

import warnings
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from accuracy_scenes import KINDS, OTHERS, scene_of, told, word
from reference_problems import four_bars
from trade_scenes import pendulum, promise, shares, summary, thrown

from seacrane import SampledController, Scene, SceneError, cases, simulate
from seacrane.accuracy.expected import STIFF, method_for, probe_of, scale_of
from seacrane.accuracy.quantities import quantities_of
from seacrane.inputs.frames import rotation_matrix
from seacrane.scene import Oil, Piston, Pump, Rupture, Valve


@pytest.mark.warns("CompassDirectionWarning", "ModelErrorWarning")
def test_errors_stay_within_limit_and_estimate() -> None:
    rng = np.random.default_rng(20)
    found = [promise(rng, t_end=10.0, grid=False) for _ in range(5)]
    assert all(p.error <= p.estimate <= p.limit for p in found), found


@pytest.mark.slow("hundreds of random scenes")
def test_promises_hold_on_200_random_scenes(capsys: Any) -> None:
    rng = np.random.default_rng(2027)  # none of the scenes that set the constants
    found = [promise(rng, t_end=40.0) for _ in range(200)]
    with capsys.disabled():
        print("\n" + summary(found))
    held = shares(found)
    del held["all runs within twice the cheapest"]  # is printed, not judged
    assert held.pop("returned run within twice the cheapest") >= 0.9
    assert len(held) == 2 and min(held.values()) >= 0.95, held


@pytest.mark.warns("ModelErrorWarning")
def test_a_roll_has_the_scale_of_an_angle() -> None:
    """By the unit of its channel, "m or rad", it had that of a force, and was run at 1e-12 at any limit."""
    scene = cases.case1()
    named = quantities_of(scene, scene.compile(), ["roll", "vessel_motion[roll].max", "vessel_motion"])
    assert [one.unit for one in named.values()][:2] == ["rad", "rad"]
    assert [scale_of(one) for one in named.values()] == ["rad", "rad", "m"]
    result = simulate(scene, 20.0, accuracy={"roll": 1e-5})
    assert float(result.settings["rtol"]) >= 1e-4


def four_bar_error(limit: float) -> tuple[float, float]:
    """True and estimated error of two four-bars through their singular positions, m."""
    result = simulate(four_bars.scene(2, planar=False), t_end=10.0, dt_out=0.05, accuracy={"position": limit})
    angle, _ = four_bars.turned(2, result.time)
    middle = 0.5 * np.column_stack([np.sin(angle), np.cos(angle)])
    post, coupler = (result.select("position", body=name)[:, [0, 2]] for name in ("post 0", "coupler 1"))
    parts = (post - middle, coupler - [1.5, 0.0] - 2.0 * middle)
    error = max(np.linalg.norm(part, axis=1).max() for part in parts)
    return float(error), float(result.stats["error_estimate_position"])


@pytest.mark.filterwarnings("ignore::seacrane.warnings.NearSingularWarning")
def test_errors_that_are_alike_by_chance_do_not_hide_each_other() -> None:
    """The errors of tsit5 at 3e-4 and 3e-5 are alike here: their difference tells a third of them."""
    for limit in (1e-2, 1e-3, 1e-4):
        error, estimate = four_bar_error(limit)
        assert error <= estimate <= limit, (error, estimate, limit)


@pytest.mark.filterwarnings("ignore::seacrane.warnings.NearSingularWarning")
@pytest.mark.slow("measures many methods")
def test_what_a_singular_position_costs_is_told_and_not_promised_away() -> None:
    """Rows left out there shift the motion by 1e-7 m at every tolerance alike, so that runs agree."""
    with pytest.raises(
        SceneError, match=r"cannot be reached: .* set by a singular position of the mechanism"
    ):
        four_bar_error(1e-8)


def test_a_tighter_limit_gives_a_smaller_error_and_states_its_estimate() -> None:
    scene = pendulum()
    truth = simulate(scene, t_end=10.0, integrator="verner76", rtol=1e-12)
    errors = []
    for limit in (1e-2, 1e-5, 1e-8):
        result = simulate(scene, t_end=10.0, accuracy={"position": limit})
        errors.append(float(np.linalg.norm(result["position"] - truth["position"], axis=-1).max()))
        assert errors[-1] <= float(result.stats["error_estimate_position"]) <= limit
        assert result.stats["accuracy_position"] == limit and int(result.stats["accuracy_runs"]) >= 2
    assert errors[0] > errors[1] > errors[2] > 0.0


@pytest.mark.parametrize(
    ("accuracy", "also", "says"),
    [({"roll": 0.1}, {}, "'roll' is unknown"), ({"position": 1e-17}, {}, "set by rounding"),
     ({"position": 1e-3}, {"rtol": 1e-6}, "rtol=1e-06"),  # the default itself is a choice where written
     ({"position": 1e-3}, {"controllers": [SampledController(period=0.1, function=dict)]}, "controllers")],
)  # fmt: skip
def test_impossible_accuracies_are_refused(accuracy: Any, also: dict[str, Any], says: str) -> None:
    with pytest.raises(SceneError, match=says):
        simulate(pendulum(), t_end=2.0, accuracy=accuracy, **also)


def test_a_chaotic_motion_is_named_as_the_limit() -> None:
    with pytest.raises(SceneError, match="set by the motion itself"):
        simulate(thrown(), t_end=60.0, accuracy={"position": 1e-6})


def test_a_coarse_wave_table_is_named_as_the_limit() -> None:
    scene = cases.vessel()
    coarse = scene.copy(waves=replace(scene.waves, relative_bound=1e-2))
    with pytest.raises(SceneError, match=r"set by the wave table, whose relative_bound is 0\.01"):
        simulate(coarse, t_end=10.0, accuracy={"roll": 1e-9})
    result = simulate(coarse, t_end=10.0, accuracy={"roll": 1e-3})
    assert float(result.stats["error_estimate_roll"]) <= 1e-3


def test_the_tip_velocity_is_the_velocity_of_the_links_upper_end() -> None:
    scene = cases.case2()
    result = simulate(scene, t_end=5.0, dt_out=0.01, integrator="dop853", rtol=1e-10)
    velocity = quantities_of(scene, scene.compile(), ["tip_velocity"])["tip_velocity"].values(result)[:, 0]
    joint, body = scene.joints["link"], scene.bodies["knuckle_jib"]
    lever = np.asarray(joint.first_frame.point) - np.asarray(body.center_of_mass)
    turn = rotation_matrix(result.select("quaternion", body="knuckle_jib"))
    tip = result.select("position", body="knuckle_jib") + turn @ lever
    differences = (tip[2:] - tip[:-2]) / 0.02
    assert np.abs(differences - velocity[1:-1]).max() < 1e-3 * np.abs(velocity).max()


SEED = 2031
SAMPLE = 20


def test_accuracies_hold_on_a_sample_of_random_lifts() -> None:
    words = [word(number, seed=SEED) for number in range(SAMPLE)]
    assert {number % len(KINDS) for number in range(SAMPLE)} == set(range(len(KINDS)))
    assert all(one.end in ("held", "refused") for one in words), told(words)
    assert sum(one.end == "held" for one in words) >= SAMPLE - 2, told(words)


@pytest.mark.parametrize("number", [165, 345])
def test_a_rough_run_goes_on_where_a_void_opens(number: int) -> None:
    """A step up to the kink turned back before it: its last stages saw the rate of the other side."""
    scene, _ = scene_of(number, seed=SEED)
    span = {"t_end": 8.0, "dt_out": 0.1, "channels": ["position"]}
    with warnings.catch_warnings(action="ignore"):
        rough = simulate(scene, integrator="tsit5", rtol=1e-3, **span)
        truth = simulate(scene, integrator="dop853", rtol=1e-8, **span)
    apart = np.abs(rough["position"] - truth["position"]).max()
    assert apart < 0.01 * np.ptp(truth["position"])


@pytest.mark.parametrize(("time", "area", "friction"), [(2.0768, 4.649e-4, 26278.6), (1.5, 3e-4, 25e3)])
def test_a_burst_to_the_pistons_end_is_as_accurate_as_told(time: float, area: float, friction: float) -> None:
    """Air has a few kPa here: at a tolerance of the highest pressure the piston bounced by centimetres."""
    bore, mass = 0.02, 18e3
    scene = Scene(name="burst")
    scene.add_body(name="load", mass=mass, inertia=(mass, mass, mass), position=(0, 0, 1.5))
    scene.add_joint("guide", kind="prismatic", first="ground", second="load", axis=(0, 0, 1), point=(0, 0, 0))
    scene.add_hydraulic_cylinder(
        name="ram", first="ground", second="load", full_area=bore, rod_side_area=0.6 * bore,
        retracted_length=1.0, stroke=1.0, pump=Pump(pressure=20e6, makeup_flow=0.01), oil=Oil(air=0.01),
        valve=Valve(rated_flow=2e-3, rated_drop=1e6, spool_lag=0.05), rupture=Rupture(time=time, area=area),
        piston=Piston(viscous_friction=friction),
    )  # fmt: skip
    span = {"t_end": 5.0, "dt_out": 0.1, "channels": ["position"]}
    with warnings.catch_warnings(action="ignore"):
        truth, other = (
            simulate(scene, integrator=name, rtol=1e-11, **span)["position"] for name in OTHERS[:3:2]
        )
        result = simulate(scene, accuracy={"position": 2e-4}, **span)
    assert np.abs(truth - other).max() < 2e-6
    error = float(np.abs(np.asarray(result["position"]) - truth).max())
    assert error <= float(result.stats["error_estimate_position"]) <= 2e-4


def test_what_tells_an_error_is_another_method() -> None:
    """At every limit and for every family of scenes: one that shares a method shares its errors."""
    for stiff in (False, True):
        for error in 10.0 ** np.arange(-9.0, 0.0):
            method = method_for(float(error), stiff=stiff)
            probes = [probe_of(method, stiffest=stiffest) for stiffest in (False, True)]
            assert all(probe.integrator != method.integrator for probe in probes)
            if method.integrator == STIFF:
                assert all(probe.used_rtol <= method.used_rtol for probe in probes)
