"""The figures that the engine keeps: joints, energy, drift and growth over long runs."""

from __future__ import annotations

import itertools
import warnings
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from multibody_runs import CRANK, slider_crank
from reference_problems import bricard, four_bars, pendulums, tops

from seacrane import Result, Scene, cases, simulate
from seacrane.arrays import Array
from seacrane.crane import Payload
from seacrane.inputs.frames import rotation_matrix


def thrown_crane() -> Scene:
    """The crane, nothing driving it, on a vessel that turns in empty space."""
    scene = Scene(name="thrown crane", gravity=0.0)
    scene.add_body(name="vessel", mass=4.0e6, inertia=(4e8, 3e9, 3e9), angular_velocity=(0.05, 0.02, 0.1))
    scene.add_crane(base="vessel", payload=Payload(), damping=False)
    return scene


CONSERVATIVE: dict[str, Callable[[], Scene]] = {
    "pendulum": pendulums.scene, "double pendulum": pendulums.double_scene,
    "slider-crank": lambda: slider_crank(CRANK, 0.4, 6.0), "bricard": bricard.scene, "heavy top": tops.scene,
    "wing nut": tops.wing_nut, "thrown crane": thrown_crane
}  # fmt: skip


def kinetic_energy(scene: Scene, result: Result) -> Array:
    """J, (k)."""
    bodies = list(scene.bodies.values())
    mass, inertia = np.array([b.mass for b in bodies]), np.array([b.inertia for b in bodies])
    spin = np.einsum("knji,knj->kni", rotation_matrix(result["quaternion"]), result["angular_velocity"])
    turning = np.einsum("kni,nij,knj->k", spin, inertia, spin)
    return np.asarray(0.5 * (np.sum(mass * np.sum(result["velocity"] ** 2, axis=2), axis=1) + turning))


def drift(scene: Scene, t_end: float, **settings: Any) -> float:
    """Largest change of energy over the largest kinetic energy."""
    channels = [
        "velocity", "angular_velocity", "quaternion", "energy_balance", "absolute_work", "constraint_error"
    ]  # fmt: skip
    with warnings.catch_warnings(action="ignore", category=UserWarning):
        result = simulate(scene, t_end=t_end, dt_out=0.5, channels=channels, rtol=1e-10, **settings)
    assert np.max(result["absolute_work"]) == 0.0
    assert np.max(result["constraint_error"]) < 1e-9
    return float(np.max(np.abs(result["energy_balance"])) / np.max(kinetic_energy(scene, result)))


QUICK = [(name, "auto", "dopri5") for name in ("pendulum", "heavy top", "wing nut", "thrown crane")]
ALL = itertools.product([*CONSERVATIVE, "four-bars"], ("redundant", "recursive"), ("dopri5", "dop853"))


@pytest.mark.parametrize(
    ("name", "formulation", "integrator"),
    [*QUICK, *(pytest.param(*one, marks=pytest.mark.slow("long runs")) for one in ALL
               if one[::2] != ("four-bars", "dopri5"))],
)  # fmt: skip
def test_energy_of_conservative_scenes_drifts_below_1e_9_in_100_s(
    name: str, formulation: str, integrator: str
) -> None:
    """Four-bars pass 100 flat positions in which loops move freely for 1e-4 rad: they do not keep 1e-9."""
    flat = name == "four-bars"
    scene = four_bars.scene(2, planar=False) if flat else CONSERVATIVE[name]()
    limit = 2e-8 if flat else 1e-9
    assert drift(scene, 100.0, formulation=formulation, integrator=integrator) < limit


@pytest.mark.parametrize(
    ("case", "formulation", "t_end"),
    [
        *((case, form, 30.0) for case in (cases.case1, cases.case2, cases.case3)
          for form in ("redundant", "recursive")),
        (cases.vessel, "auto", 100.0),
    ],
)  # fmt: skip
def test_energy_balance_is_1e_8_of_the_absolute_work(
    case: Callable[[], Scene], formulation: str, t_end: float
) -> None:
    """After 0.5 s, the first output, hardly any work is done yet."""
    result = simulate(case(), t_end=t_end, dt_out=0.5, rtol=1e-8, formulation=formulation)
    balance, work = np.abs(result["energy_balance"][1:]), result["absolute_work"][1:]
    assert np.max(balance / work) < 1e-8
    assert np.max(result["constraint_error"]) < 1e-9


@pytest.mark.slow("long runs")
def test_case2_keeps_its_joints_and_energy_for_three_hours(formulation: str) -> None:
    result = simulate(cases.case2(), t_end=10800.0, dt_out=1.0, formulation=formulation)
    assert np.max(result["constraint_error"]) < 1e-9
    assert np.max(result["constraint_error_before_projection"]) < 1e-5
    assert np.abs(result["energy_balance"][-1]) < 1e-8 * result["absolute_work"][-1]


@pytest.mark.slow("long runs")
def test_a_vessel_does_not_grow_in_a_day() -> None:

    def motion(**settings: Any) -> Result:
        channels = ["vessel_motion", "energy_balance", "absolute_work"]
        return simulate(cases.vessel(), t_end=86400.0, dt_out=5.0, channels=channels, **settings)

    result = motion()
    tight = motion(integrator="dop853", rtol=1e-9)["vessel_motion"]
    error = np.abs(result["vessel_motion"] - tight) / tight.std(axis=0)
    windows = np.array([part.max(axis=0) for part in np.array_split(error, 8)])
    assert np.max(windows) < 1e-5
    assert np.max(windows[-2:].max(axis=0) / windows[:2].max(axis=0)) < 1.5
    assert np.abs(result["energy_balance"][-1]) < 1e-6 * result["absolute_work"][-1]  # rtol 1e-6
