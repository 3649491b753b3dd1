"""The vessel alone against closed forms and against the frequency-domain solution with the fitted memory."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from seacrane import Curve, Result, Scene, State, _core, simulate
from seacrane.hydro import HydroDatabase, rigid_mass_matrix, shipped_database, vessel_parameters
from seacrane.scene import HullLoads, Waves
from seacrane.warnings import RollDampingWarning

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
G = 9.80665


def moored(
    database: HydroDatabase, *, period: float | None = 60.0, damping: float = 0.5, memory: str = "per-pair"
) -> Scene:
    """Vessel alone in calm water; short, well damped station keeping lets transients die soon."""
    scene = Scene(name="vessel alone")
    scene.add_vessel(database, mooring_period=period, mooring_damping=damping, memory=memory)
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
        omega=np.array([omega]),
        amplitude=np.array([amplitude]),
        phase=np.array([phase]),
        direction=np.array([direction]),
        hulls={"vessel": HullLoads(transfer=database.force_at([omega], direction).reshape(1, 6))},
        evaluation="exact",
    )


def complex_amplitude(result: Result, omega: float, *, start: float) -> Complex:
    """Complex amplitude (6) of the motions from `start` on: eta = Re X exp(i w t), by least squares.

    A cubic beside it takes what is left of slow motions of surge, sway and yaw.
    """
    late = result.time >= start
    phase, share = omega * result.time[late], result.time[late] / result.time[-1] - 1.0
    columns = np.column_stack([np.cos(phase), -np.sin(phase), share[:, None] ** np.arange(4)])
    cosine, sine = np.linalg.lstsq(columns, result["vessel_motion"][late], rcond=None)[0][:2]
    return np.asarray(cosine + 1j * sine)


def steady_state(
    database: HydroDatabase, scene: Scene, waves: Waves, *, t_end: float
) -> tuple[Complex, Complex]:
    """Simulated and expected complex motions in one regular wave."""
    omega = waves.omega[0]
    period = 2.0 * np.pi / omega
    scene.waves = waves
    result = simulate(scene, t_end=t_end, dt_out=period / 16.0, rtol=1e-10, channels=["vessel_motion"])
    found = complex_amplitude(result, omega, start=t_end - 4.0 * period)
    force = waves.hull().transfer[0] * waves.amplitude[0] * np.exp(1j * waves.phase[0])
    return found, np.linalg.solve(impedance(database, scene, waves.omega)[0], force)


@pytest.mark.parametrize("heading_deg", [135.0, 60.0, -100.0])
@pytest.mark.parametrize("omega", [0.35, 0.5, 0.8, 1.2, 1.8])
def test_steady_state_in_a_regular_wave(omega: float, heading_deg: float) -> None:
    """All six motions, 1e-3 of amplitude asked for; measured below 1e-6."""
    database = shipped_database()
    waves = regular_wave(database, omega=omega, heading_deg=heading_deg, amplitude=1e-3, phase=0.4)
    found, expected = steady_state(database, moored(database), waves, t_end=500.0)
    assert np.all(np.abs(expected) > 1e-4 * waves.amplitude[0])
    np.testing.assert_array_less(np.abs(found - expected) / np.abs(expected), 1e-5)


def test_steady_state_with_the_default_station_keeping() -> None:
    database = shipped_database()
    waves = regular_wave(database, omega=0.7, heading_deg=135.0, amplitude=1e-3, phase=-1.1)
    found, expected = steady_state(database, moored(database, period=200.0, damping=0.1), waves, t_end=6000.0)
    np.testing.assert_array_less(np.abs(found - expected) / np.abs(expected), 1e-4)


def test_response_stops_being_linear_at_finite_amplitude() -> None:
    """The comparison can fail: at 3 m amplitude the finite rotations show."""
    database = shipped_database()
    waves = regular_wave(database, omega=0.5, heading_deg=135.0, amplitude=3.0, phase=0.4)
    found, expected = steady_state(database, moored(database), waves, t_end=500.0)
    error = np.abs(found - expected) / np.abs(expected)
    assert np.max(error) > 1e-3
    assert np.max(error[[2, 4]]) < 0.1


def impulse_response(database: HydroDatabase, scene: Scene, times: Array) -> Array:
    """Motions (n, 6 motions, 6 started) after a start at rest pose with unit rates, by frequency domain.

    eta(t) = 2/pi int_0^inf Re[Z(i w)^-1 (M + A_inf) v0] cos(w t) dw; beyond the last frequency the integrand
    is -v0 / w^2 and its integral closed.
    """
    from scipy.special import sici

    p = vessel_parameters(database)
    mass = rigid_mass_matrix(p.mass, p.center_of_mass, p.inertia) + p.added_mass
    last, step = 40.0, 2e-3
    omega = step * np.arange(0.5, last / step)  # midpoints
    response = (np.linalg.inv(impedance(database, scene, omega)) @ mass).real
    out = step * np.einsum("tw,wij->tij", np.cos(np.outer(times, omega)), response, optimize=True)
    sine_integral, _ = sici(last * times)
    tail = np.cos(last * times) / last - times * (0.5 * np.pi - sine_integral)
    return np.asarray(2.0 / np.pi * (out - tail[:, None, None] * np.eye(6)))


def test_free_decay_in_every_motion() -> None:
    """1e-3 of the amplitude of every motion that a start in one motion excites."""
    database = shipped_database()
    scene = moored(database)
    model = scene.compile()
    times = np.arange(0.0, 120.5, 1.0)
    expected = impulse_response(database, scene, times)
    for motion in range(6):
        rate = 1e-3 if motion < 3 else 1e-5
        values = np.array(model.initial_state)
        values[model.twist_index(0) + motion] = rate
        start = State(time=0.0, values=values, inputs=np.zeros(model.slots))
        result = simulate(scene, t_end=120.0, dt_out=1.0, rtol=1e-11, start=start, channels=["vessel_motion"])
        wanted = rate * expected[:, :, motion]
        size = np.max(np.abs(wanted), axis=0)
        excited = size > 1e-8
        assert excited[motion]
        error = np.max(np.abs(result["vessel_motion"] - wanted), axis=0)[excited] / size[excited]
        np.testing.assert_array_less(error, 1e-3)


def rest_under_vertical_force(database: HydroDatabase, point: Array, force: float) -> Array:
    """Heave, roll, pitch where restoring balances an upward force at a point of the vessel; any angle.

    The generalised loads of the force are the derivatives of its point's height.
    """
    from scipy.optimize import fsolve

    c = database.restoring[2:5, 2:5]
    x, y, z = point

    def residual(eta: Array) -> Array:
        _, roll, pitch = eta
        across, up = np.sin(roll) * y + np.cos(roll) * z, np.cos(roll) * y - np.sin(roll) * z
        height = np.array([1.0, np.cos(pitch) * up, -np.cos(pitch) * x - np.sin(pitch) * across])
        return np.asarray(c @ eta - force * height)

    return np.asarray(fsolve(residual, np.linalg.solve(c, force * np.array([1.0, y, -x])), xtol=1e-10))


def described_at(scene: Scene, height: float) -> Scene:
    """The scene with its vessel described above the water's rest, m."""
    old = scene.bodies["vessel"]
    scene.bodies["vessel"] = _core.Body(
        name="vessel", mass=old.mass, inertia=old.inertia, center_of_mass=old.center_of_mass,
        position=(0.0, 0.0, height),
    )  # fmt: skip
    return scene


@pytest.mark.parametrize("kinematics", ["yaw_following", "paper"])
def test_a_vessel_described_above_its_rest_starts_there_and_heaves_about_it(kinematics: str) -> None:
    """The same motion as from a state 1 m above rest, and back at rest on still water."""
    database = damped(shipped_database(), 0.3)

    def still() -> Scene:
        scene = Scene()
        scene.add_vessel(database, memory="none", kinematics=kinematics)
        return scene

    result = simulate(described_at(still(), 1.0), t_end=60.0, rtol=1e-9)
    heave = result["vessel_motion"][:, 2]
    first = _core.initial_state(still().compile())
    lifted = np.array(first.values)
    lifted[2] += 1.0
    twin = simulate(still(), t_end=60.0, rtol=1e-9, start=State(time=0.0, values=lifted, inputs=first.inputs))
    assert heave[0] == 1.0
    assert heave.min() < -0.1
    assert abs(heave[-1]) < 1e-3
    np.testing.assert_allclose(result["vessel_motion"], twin["vessel_motion"], atol=1e-9)


@pytest.mark.parametrize(("y", "z"), [(10.0, 0.0), (-8.0, 0.0), (12.0, 15.0)])
def test_heel_from_a_known_moment(y: float, z: float) -> None:
    """200 t pushing down off the centre line: C44 phi = moment, exactly with the height's part."""
    database = damped(shipped_database(), 0.5)
    scene = moored(database)
    force, point = -200e3 * G, np.array([0.0, y, z])
    scene.add_point_force(name="weight", body="vessel", point=point, force=(0.0, 0.0, force))
    rest = simulate(scene, t_end=400.0, dt_out=400.0, rtol=1e-9)["vessel_motion"][-1]
    expected = rest_under_vertical_force(database, point, force)
    np.testing.assert_allclose(rest[2:5], expected, rtol=1e-6, atol=1e-9)
    c44 = database.restoring[3, 3]
    small = force * y / (c44 + force * z)
    assert rest[3] == pytest.approx(small, rel=5e-3)
    assert abs(np.degrees(rest[3])) > 2.0
    np.testing.assert_allclose(rest[[0, 1, 5]], 0.0, atol=1e-4)


def test_heel_from_a_weight_that_moves() -> None:
    """A body of 100 t drawn 10 m to port heels the vessel by its moment over the effective C44."""
    database = damped(shipped_database(), 0.5)
    scene = moored(database)
    mass, height = 100e3, 12.0
    scene.add_body(name="weight", mass=mass, inertia=(1e5, 1e5, 1e5), position=(0.0, 0.0, height))
    scene.add_joint(kind="prismatic", name="rail", first="vessel", second="weight", axis=(0.0, 1.0, 0.0))
    scene.add_driver(joint="rail", curve=Curve.quintic(start_time=0.0, end_time=20.0, start=0.0, end=10.0))
    result = simulate(scene, t_end=400.0, dt_out=100.0, rtol=1e-9)
    expected = rest_under_vertical_force(database, np.array([0.0, 10.0, height]), -mass * G)
    np.testing.assert_allclose(result["vessel_motion"][-1, 2:5], expected, rtol=1e-5, atol=1e-9)
    effective = database.restoring[3, 3] - mass * G * height
    assert result["vessel_motion"][-1, 3] == pytest.approx(-mass * G * 10.0 / effective, rel=5e-3)


def test_restoring_makes_no_energy_in_a_loop_of_finite_angles() -> None:
    """Free undamped motion with 10/3/5 deg swings keeps its energy (PITFALLS: fixed axes made 54 MJ)."""
    database = replace(shipped_database(), linear_damping=np.zeros((6, 6)))
    scene = Scene(name="undamped")
    with pytest.warns(RollDampingWarning, match="no roll damping"):
        scene.add_vessel(database, memory="none", mooring_period=60.0, mooring_damping=0.0)
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


@pytest.mark.warns("MeanHeadingWarning")
def test_response_does_not_depend_on_the_heading() -> None:
    """The same vessel at a yaw of 40 deg in waves turned by 40 deg moves the same, seen from itself."""
    database = shipped_database()
    turn = np.radians(40.0)
    rests: list[Any] = []
    for yaw in (0.0, turn):
        scene = moored(database)
        scene.waves = regular_wave(database, omega=0.6, heading_deg=135.0, amplitude=1.0, phase=0.2)
        if yaw:
            body = scene.bodies.pop("vessel")
            scene.add_body(
                name="vessel", mass=body.mass, inertia=body.inertia, center_of_mass=body.center_of_mass,
                quaternion=(np.cos(yaw / 2.0), 0.0, 0.0, np.sin(yaw / 2.0)),
            )  # fmt: skip
        rests.append(simulate(scene, t_end=100.0, rtol=1e-10)["vessel_motion"])
    assert np.max(np.abs(rests[0][:, 3])) > np.radians(1.0)
    np.testing.assert_allclose(rests[1], rests[0], atol=1e-7)
