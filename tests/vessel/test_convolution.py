"""Fluid memory by direct convolution: retardation functions, the loop's quadrature, histories, physics."""

from __future__ import annotations

import warnings
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.linalg import expm

from seacrane import Curve, Result, Run, Scene, SceneError, State, cases, simulate
from seacrane.arrays import Array
from seacrane.hydro import (
    HydroDatabase,
    RetardationFunctions,
    TwistHistory,
    retardation_functions,
    shipped_database,
    vessel_parameters,
)
from seacrane.hydro.memory.retardation import cosine_transform

# Assembly makes consistent what some scenes describe roughly, on purpose.
pytestmark = pytest.mark.filterwarnings("ignore::seacrane.warnings.AssemblyWarning")

CHANNELS = ["vessel_motion", "energy_balance", "absolute_work"]


@cache
def fitted_kernel(step: float, duration: float = 200.0) -> Array:
    """K of the shipped hull's per-pair models, C exp(A t) B."""
    out = np.zeros((round(duration / step) + 1, 6, 6))
    for block in vessel_parameters(shipped_database()).memory.blocks:
        ahead, states = expm(block.A * step), block.B.copy()
        for sample in out:
            sample[np.ix_(block.outputs, block.inputs)] += block.C @ states
            states = ahead @ states
    return out


def with_kernel(scene: Scene, functions: RetardationFunctions) -> Scene:
    """The scene with its vessel's memory replaced."""
    names = ("added_mass", "linear_damping", "quadratic_damping", "restoring", "mooring_stiffness")
    out, vessel = scene.copy(vessels={}), scene.vessels["vessel"]
    kept: dict[str, Any] = {name: getattr(vessel, name) for name in (*names, "mooring_damping")}
    out.add_vessel(body="vessel", memory=functions, **kept)
    return out


def convolved(step: float, **sea: Any) -> Scene:
    scene = cases.vessel(**sea)
    return with_kernel(scene, RetardationFunctions(step=step, kernel=fitted_kernel(step)))


def run(scene: Scene, t_end: float = 30.0, **more: Any) -> Result:
    return simulate(scene, t_end, **{"dt_out": 0.25, "rtol": 1e-10, "channels": CHANNELS, **more})


def distance(found: Array, expected: Array) -> float:
    """Largest difference of any motion, by that motion's largest value."""
    return float(np.max(np.abs(found - expected).max(axis=0) / np.abs(expected).max(axis=0)))


@pytest.fixture(scope="module")
def by_states() -> Array:
    return run(cases.vessel())["vessel_motion"]


def test_same_motion_as_states_of_the_same_kernel_to_fourth_order(by_states: Array) -> None:
    errors = [distance(run(convolved(step))["vessel_motion"], by_states) for step in (0.2, 0.1, 0.05)]
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert orders[-1] > 3.5, (errors, orders)
    assert errors[-1] < 3e-6


def started(scene: Scene) -> Scene:
    """The scene with its vessel under way at the start."""
    out = scene.copy()
    out.replace("vessel", kind="body", velocity=(0.0, 0.2, 0.3), angular_velocity=(0.02, 0.01, 0.0))
    return out


def test_a_sudden_start_keeps_the_order() -> None:
    """Speed and acceleration jump at the start, where the past is rest."""
    expected = run(started(cases.vessel(hs=0.0)), 15.0)["vessel_motion"]
    errors = [
        distance(run(started(convolved(h, hs=0.0)), 15.0)["vessel_motion"], expected) for h in (0.1, 0.05)
    ]
    assert np.log2(errors[0] / errors[1]) > 3.5, errors
    assert errors[1] < 1e-5


@pytest.mark.parametrize("integrator", ["rk4", "cvode-bdf", "ida"])
def test_every_integrator_takes_it(integrator: str, by_states: Array) -> None:
    """At the distance that the quadrature leaves, landing on the samples without a restart."""
    settings = {"dt": 0.01} if integrator == "rk4" else {"rtol": 1e-8}
    found = run(convolved(0.1), integrator=integrator, **settings)
    assert distance(found["vessel_motion"], by_states) < 4e-5
    assert found.stats["restarts"] == 0


def test_outputs_within_a_step_use_the_history_of_that_step() -> None:
    """Accelerations at times off the samples, and on them, against those of the states."""
    settings: dict[str, Any] = {"dt_out": 0.07, "channels": ["acceleration"]}
    expected = run(cases.vessel(), 12.6, **settings)["acceleration"][:, 0]
    found = run(convolved(0.1), 12.6, **settings)["acceleration"][:, 0]
    np.testing.assert_allclose(found, expected, atol=1e-5 * np.abs(expected).max())


def test_books_balance_and_files_keep_it(tmp_path: Path) -> None:
    scene = cases.vessel(memory="convolution")
    scene.save(tmp_path / "ship.json")
    again = Scene.load(tmp_path / "ship.json")
    np.testing.assert_array_equal(
        again.vessels["vessel"].memory.kernel, scene.vessels["vessel"].memory.kernel
    )
    found = run(again, 40.0)
    assert np.max(np.abs(found["energy_balance"])) < 1e-9 * found["absolute_work"][-1]


def test_two_vessels_with_steps_of_their_own() -> None:
    """Far from each other each moves as it does alone."""
    alone = run(started(convolved(0.1, hs=0.0)), 10.0)["vessel_motion"]
    scene = started(convolved(0.1, hs=0.0))
    ship, hydro = scene.bodies["vessel"], scene.vessels["vessel"]
    scene.add_body(name="second", mass=ship.mass, inertia=ship.inertia, center_of_mass=ship.center_of_mass)
    scene.add_vessel(
        body="second", added_mass=hydro.added_mass, restoring=hydro.restoring,
        memory=RetardationFunctions(step=0.07, kernel=fitted_kernel(0.07, 60.0)),
    )  # fmt: skip
    assert scene.compile().history_samples == 2 * (2000 + round(60.0 / 0.07))
    both = run(scene, 10.0)["vessel_motion"][:, 0]
    assert distance(both, alone) < 1e-8


@pytest.mark.parametrize("stop", [0.06, 0.14, 10.0, 10.04])
def test_a_run_goes_on_from_its_state(stop: float) -> None:
    """Within the first two steps of the convolution, on a sample and between samples."""
    scene = cases.vessel(memory="convolution")
    settings: dict[str, Any] = {"integrator": "rk4", "dt": 0.02, "dt_out": 1.0, "channels": CHANNELS[:1]}
    whole = simulate(scene, t_end=20.0, **settings)["vessel_motion"]
    first = Run(scene, t_end=stop, **settings)
    first.advance(stop)
    left = first.core.state
    history = left.histories[0]
    copied = TwistHistory(
        start=history.start, intervals=history.intervals, recent=history.recent, quadrature=history.quadrature
    )
    state = State(time=left.time, values=left.values, inputs=left.inputs, histories=[copied])
    rest = simulate(scene, t_end=20.0, start=state, **settings)["vessel_motion"]
    np.testing.assert_allclose(rest[-1], whole[-1], atol=1e-10)


def test_histories_are_checked() -> None:
    scene = cases.vessel(memory="convolution")
    run = Run(scene, t_end=1.0)
    run.advance(1.0)
    left = run.core.state
    good = left.histories[0]
    parts = {name: getattr(good, name) for name in ("start", "intervals", "recent", "quadrature")}
    for changes, text in (
        ({"quadrature": np.zeros((3, 6))}, "points of the past"), ({}, "2 histories"),
        ({"recent": np.full((3, 6), np.nan)}, "not finite"), ({"start": 5.0}, "not within one step"),
    ):  # fmt: skip
        histories = [TwistHistory(**parts | changes), *([] if changes else [good])]
        state = State(time=left.time, values=left.values, inputs=left.inputs, histories=histories)
        with pytest.raises(ValueError, match=text):
            Run(scene, t_end=2.0, start=state)


def driven_heave(database: HydroDatabase, omega: float) -> complex:
    """Force of a driver per metre of the heave that it prescribes, in the steady state, less inertia and
    restoring: i omega B - omega^2 A."""
    scene = Scene()
    with warnings.catch_warnings(action="ignore"):
        scene.add_vessel(database, memory="convolution", mooring=None)
    scene.add_joint(kind="free", name="motion", first="ground", second="vessel")
    for motion in ("x", "y", "z", "roll", "pitch", "yaw"):
        curve = Curve.harmonic(amplitude=1.0 if motion == "z" else 0.0, omega=omega)
        scene.add_driver(joint="motion", coordinate=motion, curve=curve, name=motion)
    period = 2.0 * np.pi / omega
    t_end = period * np.ceil(80.0 / period)
    out = simulate(scene, t_end=t_end, dt_out=period / 64.0, channels=["driver_force"], rtol=1e-10)
    last = slice(-64, None)
    force = 2.0 * np.mean(out["driver_force"][last, 2] * np.exp(-1j * omega * out.time[last]))
    mass, stiffness = scene.bodies["vessel"].mass, scene.vessels["vessel"].restoring[2, 2]
    return complex(force + omega**2 * mass - stiffness)


@pytest.mark.parametrize("omega", [0.5, 1.5])
def test_a_driven_vessel_feels_the_databases_added_mass_and_damping(omega: float) -> None:
    database, model = shipped_database(), retardation_functions(database=shipped_database())
    found = driven_heave(database, omega)
    added_mass, damping = (x[0, 2, 2] for x in model.frequency_response([omega]))
    size = omega * np.ptp(database.damping[:, 2, 2])
    assert abs(found - complex(-(omega**2) * added_mass, omega * damping)) < 1e-4 * size
    index = int(np.argmin(np.abs(database.omega - omega)))
    assert database.omega[index] == pytest.approx(omega)
    assert found.imag == pytest.approx(omega * database.damping[index, 2, 2], abs=1e-3 * size)
    assert -found.real / omega**2 == pytest.approx(database.added_mass[index, 2, 2], rel=0.01)


def test_what_it_cannot_do_is_refused_by_name() -> None:
    def functions(step: float, kernel: Array) -> Scene:
        return with_kernel(cases.vessel(), RetardationFunctions(step=step, kernel=kernel))

    for make, text in (
        (lambda: cases.vessel(memory="convolution", kinematics="paper"), "'paper'.*state-space"),
        (lambda: functions(0.1, np.full((20, 6, 6), np.nan)), "not finite"),
    ):
        with pytest.raises(SceneError, match=f"vessel 'vessel': .*{text}"):
            make().compile()
    with pytest.raises(ValueError, match="half a period"):
        retardation_functions(database=shipped_database(), step=1.2)


def test_kernel_of_sampled_damping_converges_to_the_closed_form() -> None:
    """exp(-a t) (cos b t - a/b sin b t), whose transform is s / ((s + a)^2 + b^2), sampled finer and to
    higher frequencies: at the limit what is left is rounding."""
    tau, a, b = np.linspace(0.0, 25.0, 251), 0.35, 0.9
    exact = np.exp(-a * tau) * (np.cos(b * tau) - a / b * np.sin(b * tau))
    errors = []
    for spacing, end in ((0.1, 6.0), (0.05, 12.0), (0.025, 24.0)):
        omega = spacing * np.arange(1, round(end / spacing) + 1)
        damping = (1j * omega / ((1j * omega + a) ** 2 + b**2)).real[:, None, None]
        errors.append(np.abs(cosine_transform(omega, damping, tau)[:, 0, 0] - exact).max())
    assert errors[0] < 1e-2
    assert errors[1] < errors[0] / 4.0
    assert errors[2] < errors[1] / 4.0


def test_database_comes_back_from_its_retardation_functions() -> None:
    """Damping to 0.1 %; added mass as far as the data obey Kramers-Kronig; A_inf near the panel code's."""
    database = shipped_database()
    model = retardation_functions(database=database)
    assert model.error_damping.max() < 1e-3
    inside = (database.omega >= model.band[0]) & (database.omega <= model.band[1])
    added_mass, damping = model.frequency_response(database.omega)
    for j in range(1, 6):
        truth, error = database.damping[inside, j, j], (damping - database.damping)[inside, j, j]
        told = model.error_damping[j, j]
        assert np.sqrt(np.mean(error**2)) / np.std(truth) == pytest.approx(told, rel=1e-9)
        true = database.added_mass[inside, j, j]
        assert np.abs(added_mass[inside, j, j] - true).max() < 0.05 * np.ptp(true)
    ratio = np.diag(model.added_mass) / np.diag(database.infinite_frequency_added_mass)
    np.testing.assert_allclose(ratio[1:], 1.0, atol=0.02)
