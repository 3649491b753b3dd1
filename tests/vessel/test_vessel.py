"""The vessel alone against closed forms, its frequency-domain solution and the motions in ships' files."""

from __future__ import annotations

import warnings
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.optimize import fsolve

from seacrane import Result, Scene, State, _core, balance, cases, equilibrium, load_database, simulate
from seacrane.arrays import Array, Complex
from seacrane.hydro import HydroDatabase, fit_memory, rigid_mass_matrix, shipped_database, vessel_parameters
from seacrane.hydro.data.hydro_data import RollDamping
from seacrane.hydro.data.motion import motion_response
from seacrane.scene import HullLoads, Waves
from seacrane.warnings import InfiniteFrequencyWarning, RollDampingWarning

G = 9.80665


def moored(
    database: HydroDatabase, *, period: float | None = 60.0, damping: float = 0.5, memory: str = "per-pair"
) -> Scene:
    """Vessel alone in calm water; short, well damped station keeping lets transients die soon."""
    scene = Scene(name="vessel alone")
    scene.add_vessel(database, mooring=period, mooring_damping=damping, memory=memory)
    return scene


def damped(database: HydroDatabase, share: float) -> HydroDatabase:
    """The database with `share` of critical damping (dry mass) in heave, roll and pitch."""
    linear = database.linear_damping.copy()
    for i in (2, 3, 4):
        linear[i, i] += 2.0 * share * np.sqrt(database.restoring[i, i] * database.mass_matrix[i, i])
    return replace(database, linear_damping=linear)


def impedance(database: HydroDatabase, scene: Scene, omega: Array) -> Complex:
    """-w^2 (M + A(w)) + i w B(w) + C, fitted A and B, station keeping and linear damping (n, 6, 6)."""
    p, vessel = vessel_parameters(database), scene.vessels["vessel"]
    added_mass, damping = p.memory.frequency_response(omega)
    more_mass, more_damping = p.memory.additional_response(omega)
    restoring, linear = p.restoring - p.memory.additional_stiffness, p.linear_damping.copy()
    for k, i in enumerate((0, 1, 5)):
        restoring[i, i] += vessel.mooring_stiffness[k]
        linear[i, i] += vessel.mooring_damping[k]
    # `additional_response` counts the static stiffness as added mass: C + stiffness - w^2 (- stiffness / w^2)
    restoring = restoring + p.memory.additional_stiffness
    more_mass = more_mass + p.memory.additional_stiffness / omega[:, None, None] ** 2
    mass = rigid_mass_matrix(p.mass, p.center_of_mass, p.inertia)
    w = omega[:, None, None]
    return -(w**2) * (mass + added_mass + more_mass) + 1j * w * (damping + more_damping + linear) + restoring


def regular_wave(
    database: HydroDatabase, *, omega: float, heading_deg: float, amplitude: float, phase: float
) -> Waves:
    direction = np.radians(heading_deg)
    return Waves(
        omega=np.array([omega]), amplitude=np.array([amplitude]), phase=np.array([phase]),
        direction=np.array([direction]),
        hulls={"vessel": HullLoads(transfer=database.force_at([omega], direction).reshape(1, 6))},
        evaluation="exact",
    )  # fmt: skip


def complex_amplitude(result: Result, omega: float, *, start: float) -> Complex:
    """Complex amplitude (6) of the motions from `start` on: eta = Re X exp(i w t), by least squares.

    A cubic beside it takes what is left of slow motions of surge, sway and yaw.
    """
    late = result.time >= start
    phase, share = omega * result.time[late], result.time[late] / result.time[-1] - 1.0
    columns = np.column_stack([np.cos(phase), -np.sin(phase), share[:, None] ** np.arange(4)])
    cosine, sine = np.linalg.lstsq(columns, result["vessel_motion"][late], rcond=None)[0][:2]
    return np.asarray(cosine + 1j * sine)


def steady_state(database: HydroDatabase, scene: Scene, waves: Waves) -> tuple[Complex, Complex]:
    """Simulated and expected complex motions in one regular wave."""
    omega, scene.waves, t_end = waves.omega[0], waves, 500.0
    period = 2.0 * np.pi / omega
    result = simulate(scene, t_end=t_end, dt_out=period / 16.0, rtol=1e-10, channels=["vessel_motion"])
    found = complex_amplitude(result, omega, start=t_end - 4.0 * period)
    force = waves.hull().transfer[0] * waves.amplitude[0] * np.exp(1j * waves.phase[0])
    return found, np.linalg.solve(impedance(database, scene, waves.omega)[0], force)


@pytest.mark.parametrize(
    ("omega", "heading_deg"), [(0.35, 135.0), (0.5, 60.0), (0.8, -100.0), (1.2, 135.0), (1.8, 60.0)]
)
def test_steady_state_in_a_regular_wave(omega: float, heading_deg: float) -> None:
    """All six motions, 1e-3 of amplitude asked for; measured below 1e-6."""
    database = shipped_database()
    waves = regular_wave(database, omega=omega, heading_deg=heading_deg, amplitude=1e-3, phase=0.4)
    found, expected = steady_state(database, moored(database), waves)
    assert np.all(np.abs(expected) > 1e-4 * waves.amplitude[0])
    np.testing.assert_array_less(np.abs(found - expected) / np.abs(expected), 1e-5)


def rest_under_vertical_force(database: HydroDatabase, point: Array, force: float) -> Array:
    """Heave, roll, pitch where restoring balances an upward force at a point of the vessel; any angle.

    The generalised loads of the force are the derivatives of its point's height.
    """
    c = database.restoring[2:5, 2:5]
    x, y, z = point

    def residual(eta: Array) -> Array:
        _, roll, pitch = eta
        across, up = np.sin(roll) * y + np.cos(roll) * z, np.cos(roll) * y - np.sin(roll) * z
        height = np.array([1.0, np.cos(pitch) * up, -np.cos(pitch) * x - np.sin(pitch) * across])
        return np.asarray(c @ eta - force * height)

    return np.asarray(fsolve(residual, np.linalg.solve(c, force * np.array([1.0, y, -x])), xtol=1e-10))


@pytest.mark.parametrize("kinematics", ["yaw_following", "paper"])
def test_a_vessel_described_above_its_rest_starts_there_and_heaves_about_it(kinematics: str) -> None:
    """The same motion as from a state 1 m above rest, and back at rest on still water."""
    still = Scene()
    still.add_vessel(damped(shipped_database(), 0.3), memory="none", kinematics=kinematics)
    above = still.copy()
    above.replace("vessel", kind="body", position=(0.0, 0.0, 1.0))
    first = _core.initial_state(still.compile())
    lifted = np.array(first.values)
    lifted[2] += 1.0
    start = State(time=0.0, values=lifted, inputs=first.inputs)
    motion, twin = (
        simulate(scene, t_end=60.0, rtol=1e-9, start=begin)["vessel_motion"]
        for scene, begin in ((above, None), (still, start))
    )
    heave = motion[:, 2]
    assert heave[0] == 1.0 and heave.min() < -0.1
    assert abs(heave[-1]) < 1e-3
    np.testing.assert_allclose(motion, twin, atol=1e-9)


@pytest.mark.parametrize(("y", "z"), [(-8.0, 0.0), (12.0, 15.0)])
def test_heel_from_a_known_moment(y: float, z: float) -> None:
    """200 t pushing down off the centre line: C44 phi = moment, exactly with the height's part."""
    database = damped(shipped_database(), 0.5)
    scene = moored(database)
    force, point = -200e3 * G, np.array([0.0, y, z])
    scene.add_force("vessel", name="weight", point=point, force=(0.0, 0.0, force))
    rest = simulate(scene, t_end=400.0, dt_out=400.0, rtol=1e-9)["vessel_motion"][-1]
    expected = rest_under_vertical_force(database, point, force)
    np.testing.assert_allclose(rest[2:5], expected, rtol=1e-6, atol=1e-9)
    c44 = database.restoring[3, 3]
    small = force * y / (c44 + force * z)
    assert rest[3] == pytest.approx(small, rel=5e-3)
    assert abs(np.degrees(rest[3])) > 2.0
    np.testing.assert_allclose(rest[[0, 1, 5]], 0.0, atol=1e-4)


def test_restoring_makes_no_energy_in_a_loop_of_finite_angles() -> None:
    """Free undamped motion with 10/3/5 deg swings keeps its energy (PITFALLS: fixed axes made 54 MJ)."""
    database = replace(shipped_database(), linear_damping=np.zeros((6, 6)))
    scene = Scene(name="undamped")
    with pytest.warns(RollDampingWarning, match="no roll damping"):
        scene.add_vessel(database, memory="none", mooring=60.0, mooring_damping=0.0)
    model = scene.compile()
    values = np.array(model.initial_state)
    at = model.twist_index(0)
    values[at : at + 6] = [0.5, -0.3, 0.4, np.radians(5.0), np.radians(3.0), np.radians(1.5)]
    start = State(time=0.0, values=values, inputs=np.zeros(model.slots))
    result = simulate(scene, t_end=200.0, rtol=1e-10, start=start)
    roll, pitch, yaw = np.degrees(np.ptp(result["vessel_motion"][:, 3:], axis=0))
    assert roll > 15.0 and pitch > 2.0 and yaw > 5.0
    kinetic = 0.5 * database.mass_matrix[3, 3] * np.radians(5.0) ** 2
    assert np.max(np.abs(result["energy_balance"])) < 1e-6 * kinetic
    assert np.max(result["absolute_work"]) == 0.0


LOAD, DEPTH, EA = 100e3, 500.0, 4e8
WATER = np.diag([80e3] * 3 + [1e5] * 3)
DRAG = np.diag([0, 0, 2e5, 0, 0, 0])


def submerged(**hydrodynamics: object) -> Scene:
    scene = Scene(name="submerged load")
    scene.add_body(name="load", mass=LOAD, inertia=(4e5, 4e5, 4e5), position=(0, 0, -DEPTH))
    scene.add_vessel(body="load", **{"added_mass": WATER, "linear_damping": DRAG} | hydrodynamics)
    scene.add_line(name="wire", bodies=["ground", "load"], points=np.zeros((2, 3)), EA=EA, length=DEPTH)
    return scene


@pytest.mark.parametrize("floats", [None, True, False])
def test_statics_and_balance_know_its_weight_and_files_it(floats: bool | None, tmp_path: Path) -> None:
    scene = submerged() if floats is None else submerged(floats=floats)
    weight = 0.0 if floats else LOAD * scene.gravity
    rest = simulate(scene, t_end=0.01, start=equilibrium(scene))
    assert rest.select("line_tension", line="wire")[0] == pytest.approx(weight, rel=1e-6, abs=1e-3 * LOAD)
    scene.save(tmp_path / "scene.json")
    assert Scene.load(tmp_path / "scene.json").vessels["load"].floats == bool(floats)
    scene.remove("wire")
    scene.add_joint(
        kind="distance", name="rod", first="ground", second="load", point=(0, 0, 0),
        second_point=(0, 0, -DEPTH),
    )  # fmt: skip
    if not floats:
        assert balance(scene).weight == pytest.approx(weight)


@pytest.fixture(scope="module")
def supply(shared: Path) -> HydroDatabase:
    """With its memory per pair, as `cases` take it."""
    database = load_database(shared / "veres" / "supply")
    with warnings.catch_warnings(action="ignore", category=InfiniteFrequencyWarning):
        return replace(database, memory=fit_memory(database=database, kind="per-pair"))


def simulated_rao(database: HydroDatabase, scene: Scene, heading: int, frequency: int, **run: Any) -> Complex:
    """By VERES's or WAMIT's headings and frequencies; adrift the heading wanders with the amplitude."""
    omega, amplitude = float(database.omega[frequency]), 1e-4  # rad/s, m
    period, heading_deg = 2.0 * np.pi / omega, float(np.degrees(database.heading[heading]))
    scene.waves = regular_wave(database, omega=omega, heading_deg=heading_deg, amplitude=amplitude, phase=0.3)
    result = simulate(scene, dt_out=period / 16.0, channels=["vessel_motion"], **run)
    return complex_amplitude(result, omega, start=run["t_end"] - 6.0 * period) / (amplitude * np.exp(0.3j))


@pytest.mark.parametrize(
    "at",
    [
        (7, 26),
        *(pytest.param(at, marks=pytest.mark.slow("a long regular wave")) for at in ((5, 10), (13, 14))),
    ],
)
def test_regular_wave_returns_the_files_motion(supply: HydroDatabase, at: tuple[int, int]) -> None:
    """The run is on the fitted frequency-domain solution; its distance from the file is the fit's. Linear and
    linearised roll damping are those that the file's motions hold at that heading and frequency."""
    damping = supply.roll_damping.linear[at[1]] + supply.roll_damping.linearised[at]
    n, m = len(supply.omega), len(supply.heading)
    roll = RollDamping(linear=np.full(n, damping), quadratic=np.zeros(n), linearised=np.zeros((m, n)))
    database = replace(supply, roll_damping=roll)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        warnings.simplefilter("ignore", InfiniteFrequencyWarning)
        scene = cases.vessel(database=database, hs=0.0, mooring=None)
    found = simulated_rao(database, scene, *at, t_end=800.0, rtol=1e-11)
    memory = vessel_parameters(database).memory
    parts = (memory.frequency_response(database.omega), memory.additional_response(database.omega))
    fitted = dict(zip(("added_mass", "damping"), map(np.add, *parts), strict=True))
    source, fit = supply.motion_rao[at], motion_response(database, **fitted)[at]
    np.testing.assert_array_less(np.abs(found - fit), 1e-3 * np.abs(fit) + 1e-9)
    np.testing.assert_array_less(np.abs(found - source), np.abs(fit - source) + 1e-3 * np.abs(source) + 1e-9)
    # The fit was asked for R2 = 0.99, 10 % of rms; roll, with its tanks, shows most of it.
    np.testing.assert_array_less(np.abs(fit - source) / np.abs(source), [0.01, 0.02, 0.09, 0.12, 0.02, 0.03])


@pytest.mark.parametrize(("deg", "omega"), [(135.0, 0.45), (90.0, 0.70)])
def test_regular_wave_returns_wamits_motion(shared: Path, deg: float, omega: float) -> None:
    """Of the tanker, by convolution, which has no fit, so that what is left is the files' own 1 %."""
    with warnings.catch_warnings(action="ignore"):
        tanker = load_database(shared / "wamit")
        scene = cases.vessel(database=tanker, hs=0.0, mooring=None, memory="convolution")
    heading = int(np.argmin(np.abs(np.degrees(tanker.heading) - deg)))
    frequency = int(np.argmin(np.abs(tanker.omega - omega)))
    # Its slowest memory and motions decay in 1500 s.
    found = simulated_rao(tanker, scene, heading, frequency, t_end=1500.0, rtol=1e-9)
    largest = np.abs(tanker.motion_rao[:, frequency]).max(axis=0)
    np.testing.assert_array_less(np.abs(found - tanker.motion_rao[heading, frequency]), 0.01 * largest)
