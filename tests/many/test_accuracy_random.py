"""simulate(accuracy=...) on random lifts, each judged by two other methods at tighter tolerances."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
import pytest
from accuracy_scenes import KINDS, OTHERS, scene_of, told, word

from seacrane import Scene, simulate
from seacrane.accuracy.expected import STIFF, method_for, probe_of

SEED = 2031
SAMPLE, ALL = 20, 400


def test_accuracies_hold_on_a_sample_of_random_lifts() -> None:
    words = [word(number, seed=SEED) for number in range(SAMPLE)]
    assert {number % len(KINDS) for number in range(SAMPLE)} == set(range(len(KINDS)))
    assert all(one.end in ("held", "refused") for one in words), told(words)
    assert sum(one.end == "held" for one in words) >= SAMPLE - 2, told(words)


@pytest.mark.slow("hundreds of random lifts")
def test_accuracies_hold_on_400_random_lifts(capsys: Any) -> None:
    words = [word(number, seed=SEED) for number in range(ALL)]
    with capsys.disabled():
        print("\n" + told(words))
    assert sum(one.end == "beyond" for one in words) <= 1, told(words)
    assert sum(one.end == "not judgeable" for one in words) <= 0.05 * ALL, told(words)
    assert sum(one.end == "refused" for one in words) <= 0.05 * ALL, told(words)


@pytest.mark.parametrize("number", [165, 337, 345])
def test_a_rough_run_goes_on_where_a_void_opens(number: int) -> None:
    """A step up to the kink turned back before it: its last stages saw the rate of the other side."""
    scene, _ = scene_of(number, seed=SEED)
    span = {"t_end": 8.0, "dt_out": 0.1, "channels": ["position"]}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        rough = simulate(scene, integrator="tsit5", rtol=1e-3, **span)
        truth = simulate(scene, integrator="dop853", rtol=1e-8, **span)
    apart = np.abs(rough["position"] - truth["position"]).max()
    assert apart < 0.01 * np.ptp(truth["position"])


@pytest.mark.parametrize(
    ("time", "area", "friction"),
    [(2.0768, 4.649e-4, 26278.6), (0.96193, 4.1886e-4, 24993.2), (1.5, 3e-4, 25e3)],
)
def test_a_burst_to_the_pistons_end_is_as_accurate_as_told(time: float, area: float, friction: float) -> None:
    """Air has a few kPa here: at a tolerance of the highest pressure the piston bounced by centimetres."""
    bore, mass = 0.02, 18e3
    scene = Scene(name="burst")
    scene.add_body(name="load", mass=mass, inertia=(mass, mass, mass), position=(0, 0, 1.5))
    scene.add_joint("guide", kind="prismatic", first="ground", second="load", axis=(0, 0, 1), point=(0, 0, 0))
    scene.add_hydraulic_cylinder(
        name="ram", first="ground", second="load", full_area=bore, rod_side_area=0.6 * bore,
        retracted_length=1.0, stroke=1.0, pump_pressure=20e6, rated_flow=2e-3, rated_drop=1e6,
        viscous_friction=friction, spool_lag=0.05, air=0.01, makeup_flow=0.01, rupture_time=time,
        rupture_area=area,
    )  # fmt: skip
    span = {"t_end": 5.0, "dt_out": 0.1, "channels": ["position"]}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
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
