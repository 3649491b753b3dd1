"""Runs of hours: joints stay closed, energy balances, and nothing grows that should not."""

from __future__ import annotations

import warnings

import numpy as np
import pytest

from seacrane import cases, simulate
from stability_atlas.duration_axes import HOUR
from stability_atlas.mechanism_axes import AXES as MECHANISMS
from stability_atlas.points import POINTS
from stability_atlas.vessel_axes import AXES as VESSELS

# Assembly makes consistent what some scenes describe roughly, on purpose.
pytestmark = pytest.mark.filterwarnings("ignore::seacrane.warnings.AssemblyWarning")

TUMBLE = next(axis for axis in MECHANISMS if axis.name == "tumble")
FOUR_BAR = next(axis for axis in MECHANISMS if axis.name == "four-bar")
HEEL = next(axis for axis in VESSELS if axis.name == "heel")
TIME_ORIGIN = next(axis for axis in VESSELS if axis.name == "time-origin")
CHECKS = ["constraint_error", "constraint_rate_error", "energy_balance", "absolute_work"]


@pytest.mark.slow("hours of motion")
def test_three_hours_of_case_2_keep_their_joints_closed() -> None:
    for formulation in ("auto", "redundant"):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # its sea repeats itself before the end
            result = simulate(cases.case2(), t_end=3.0 * HOUR, dt_out=5.0, channels=CHECKS,
                              formulation=formulation)  # fmt: skip
        assert np.max(result["constraint_error"]) < 1e-9
        assert np.max(result["constraint_rate_error"]) < 1e-9


def test_energy_of_case_2_balances_at_a_tight_tolerance() -> None:
    result = simulate(cases.case2(), t_end=60.0, dt_out=1.0, rtol=1e-8, channels=CHECKS)
    assert np.max(np.abs(result["energy_balance"])) < 1e-8 * result["absolute_work"][-1]


@pytest.mark.parametrize("formulation", ["recursive", "redundant"])
def test_conservative_scenes_keep_their_energy(formulation: str) -> None:
    """Below 1e-9 of the kinetic energy over 100 s at rtol 1e-10."""
    for axis, value in ((TUMBLE, 1.0), (FOUR_BAR, 0.1)):
        scene = axis.case(value).scene
        result = simulate(
            scene, t_end=100.0, dt_out=0.5, rtol=1e-10, formulation=formulation, integrator="dop853",
            channels=["velocity", "angular_velocity", "quaternion", "energy_balance", "absolute_work"],
        )  # fmt: skip
        assert result["absolute_work"][-1] == 0.0
        mass = np.array([body.mass for body in scene.bodies.values()])
        kinetic = 0.5 * np.einsum("k,nki,nki->n", mass, result["velocity"], result["velocity"])
        assert np.max(np.abs(result["energy_balance"])) < 1e-9 * np.max(kinetic)


@pytest.mark.slow("hours of motion")
@pytest.mark.parametrize("memory", ["passive", "per-pair"])
def test_a_day_of_the_vessel_in_waves_does_not_grow(memory: str) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        result = simulate(cases.vessel(memory=memory), t_end=24.0 * HOUR, dt_out=2.0,
                          channels=["vessel_motion"])  # fmt: skip
    motion = result["vessel_motion"]
    part = len(motion) // 24
    size = [np.std(motion[k * part : (k + 1) * part], axis=0) for k in range(1, 24)]
    swell = np.array(size)[:, 2:5]  # heave, roll, pitch: surge, sway and yaw drift slowly in their mooring
    assert np.max(swell[-6:].mean(axis=0) / swell[:6].mean(axis=0)) < 1.2
    assert np.max(swell.max(axis=0) / swell.min(axis=0)) < 2.0


def test_a_heeled_vessel_loses_energy_and_never_gains_any() -> None:
    """Memory and damping are passive: from rest at any heel it comes no further than it started."""
    for degrees in (20.0, 89.0, 120.0):
        scene = HEEL.case(degrees).scene
        result = simulate(scene, t_end=120.0, dt_out=0.5, channels=["quaternion"])
        w, x = result["quaternion"][:, 0, 0], result["quaternion"][:, 0, 1]
        heel = np.degrees(2.0 * np.arctan2(x, w))
        assert np.max(np.abs(heel)) <= degrees * (1.0 + 1e-9)
        assert np.max(np.abs(heel[-40:])) < 0.9 * degrees


@pytest.mark.parametrize("integrator", ["cvode-bdf", "cvode-adams", "ida", "ark-dirk", "dop853"])
def test_methods_start_30_years_from_zero(integrator: str) -> None:
    """Solvers of SUNDIALS begin with steps of few roundings of the time there, and may."""
    case = TIME_ORIGIN.case(1e9)
    run = simulate(case.scene, t_end=case.t_end, dt_out=case.dt_out, start=case.start, integrator=integrator,
                   channels=["position"])  # fmt: skip
    assert case.truth is not None
    points = case.truth[POINTS.name].reshape(run.time.size, -1, 4, 3)  # the first of each body is its centre
    np.testing.assert_allclose(run["position"], points[:, :, 0], atol=1e-4)
