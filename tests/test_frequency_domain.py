"""The linearised scene against closed forms, the vessel's matrices, and runs in the time domain."""

from __future__ import annotations

import warnings
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from reference.linear_vessel import LinearVessel
from reference.vessel import MemoryModel

from seacrane import (
    LinearModel,
    Scene,
    SceneError,
    State,
    cases,
    equilibrium,
    linear_model,
    motion_rao,
    natural_modes,
    response_statistics,
    response_summed,
    simulate,
)
from seacrane.crane import KnuckleBoomCrane, Payload
from seacrane.hydro import shipped_database, vessel_parameters
from seacrane.hydro.vessel import rigid_mass_matrix
from seacrane.rest_state import held
from seacrane.sea import jonswap
from seacrane.vessel import add_sea

Array = NDArray[np.float64]
G = 9.80665
OMEGA = np.array([0.35, 0.45, 0.6, 0.8, 1.0, 1.3, 1.8])
TIP = (10.0, -4.0, 12.0)


@pytest.fixture(scope="module")
def lift() -> LinearModel:
    """Case 2 in a low sea, linearised at its start."""
    return linear_model(cases.case2(hs=0.05, count=60))


def reference_vessel(scene: Scene) -> LinearVessel:
    """The vessel alone from its matrices, without any linearisation."""
    p, element = vessel_parameters(shipped_database()), scene.vessels["vessel"]
    damping, restoring = np.array(element.linear_damping), np.array(element.restoring)
    for k, i in enumerate((0, 1, 5)):
        damping[i, i] += element.mooring_damping[k]
        restoring[i, i] += element.mooring_stiffness[k]
    blocks = [
        {"inputs": b.inputs, "outputs": b.outputs, "A": b.a, "B": b.b, "C": b.c, "D": b.d}
        for b in element.memory
    ]
    mass = rigid_mass_matrix(p.mass, p.centre_of_mass, p.inertia) + np.array(element.added_mass)
    return LinearVessel(mass, damping, restoring, MemoryModel.from_record({"blocks": blocks}))


def moved_by(rao: Array, lever: Any) -> Array:
    out = np.array(rao)
    out[..., :3] += np.cross(rao[..., 3:], lever)
    return out


@pytest.mark.parametrize("heading_deg", [135.0, 40.0, -100.0])
def test_vessel_alone_moves_as_its_matrices_say(heading_deg: float) -> None:
    """Every motion, and a point on deck, to 1e-6 of A, B, C and F solved directly."""
    database, scene = shipped_database(), cases.vessel(hs=0.0)
    heading = np.radians(heading_deg)
    force = database.force_at(OMEGA, heading)
    expected = reference_vessel(scene).response(OMEGA, force)
    linear = linear_model(scene)
    for point in ((0.0, 0.0, 0.0), TIP):
        rao = motion_rao(linear, database=database, omega=OMEGA, heading=heading, body="vessel", point=point)
        np.testing.assert_array_less(np.abs(rao / moved_by(expected, point) - 1.0), 1e-6)


def test_vessel_alone_has_the_eigenvalues_of_its_matrices() -> None:
    scene = cases.vessel(hs=0.0)
    found = np.linalg.eigvals(linear_model(scene).a)
    expected = reference_vessel(scene).eigenvalues()
    assert len(found) == len(expected)
    for value in expected:
        assert np.min(np.abs(found - value)) < 1e-6 * max(1.0, abs(value))


def test_heading_is_seen_from_a_turned_vessel() -> None:
    """A vessel at a yaw of 40 deg moves, in its own axes, as one without yaw."""
    database, yaw = shipped_database(), np.radians(40.0)
    straight = cases.vessel(hs=0.0)
    turned = straight.copy()
    body = turned.bodies.pop("vessel")
    turned.add_body(
        name="vessel", mass=body.mass, inertia=body.inertia, center_of_mass=body.center_of_mass,
        quaternion=(np.cos(yaw / 2.0), 0.0, 0.0, np.sin(yaw / 2.0)),
    )  # fmt: skip
    raos = [
        motion_rao(s, database=database, omega=OMEGA, heading=2.0, body="vessel") for s in (straight, turned)
    ]
    turn = np.array([[np.cos(yaw), -np.sin(yaw), 0.0], [np.sin(yaw), np.cos(yaw), 0.0], [0.0, 0.0, 1.0]])
    expected = raos[0] @ np.kron(np.eye(2), turn).T
    np.testing.assert_allclose(raos[1], expected, atol=1e-6 * np.max(np.abs(expected)))


def test_neutral_directions_of_a_vessel_without_mooring() -> None:
    modes = natural_modes(cases.vessel(hs=0.0, mooring_period=None))
    assert modes.neutral == 3
    assert np.max(modes.real_eigenvalues) < 1e-6
    assert {modes.label(i) for i in range(len(modes.eigenvalues)) if modes.mechanical_share[i] > 0.5} == {
        "vessel heave", "vessel roll", "vessel pitch",
    }  # fmt: skip


def rod(scene: Scene, name: str, first: str, top: float, *, angle: float = 0.0, damping: float = 0.0) -> None:
    """A uniform rod of 2 m and 3 kg hanging from a hinge about y at height `top`."""
    direction = np.array([-np.sin(angle), 0.0, -np.cos(angle)])
    scene.add_body(
        name=name, mass=3.0, inertia=(1.0, 1.0, 0.01), position=np.array([0.0, 0.0, top]) + direction,
        quaternion=(np.cos(angle / 2.0), 0.0, np.sin(angle / 2.0), 0.0),
    )  # fmt: skip
    point = (0.0, 0.0, top)
    scene.add_joint(
        kind="revolute", name=f"{name}.hinge", first=first, second=name, point=point, axis=(0, 1, 0)
    )
    if damping:
        scene.add_actuator(joint=f"{name}.hinge", damping=damping)


def test_pendulum() -> None:
    """omega^2 = m g l / I and 2 zeta omega I = damping, I = 4 kg m2 about the hinge."""
    scene = Scene()
    rod(scene, "rod", "ground", 0.0, damping=0.8)
    modes = natural_modes(scene)
    omega = np.sqrt(3.0 * G / 4.0)
    assert len(modes.eigenvalues) == 1
    assert modes.natural_period[0] == pytest.approx(2.0 * np.pi / omega, rel=1e-8)
    assert modes.damping_ratio[0] == pytest.approx(0.8 / (2.0 * omega * 4.0), rel=1e-7)
    assert modes.damped_period[0] > modes.natural_period[0]
    # At the centre of mass, 1 m below the hinge: turning by 1 rad about y shifts it by 1 m along -x.
    np.testing.assert_allclose(np.abs(modes.shapes[0, 0]), [1, 0, 0, 0, 1, 0], atol=1e-8)
    assert modes.mechanical_share[0] == pytest.approx(1.0)


def test_two_rods_in_a_row() -> None:
    """Lagrange: [[16, 6], [6, 4]] (kg m2) and m g l diag(3, 1) for the absolute angles."""
    scene = Scene()
    rod(scene, "upper", "ground", 0.0)
    rod(scene, "lower", "upper", -2.0)
    modes = natural_modes(scene)
    inertia, stiffness = np.array([[16.0, 6.0], [6.0, 4.0]]), 3.0 * G * np.diag([3.0, 1.0])
    squares, shapes = np.linalg.eig(np.linalg.solve(inertia, stiffness))
    order = np.argsort(squares)
    np.testing.assert_allclose(modes.eigenvalues.imag, np.sqrt(squares[order]), rtol=1e-7)
    np.testing.assert_allclose(modes.eigenvalues.real, 0.0, atol=1e-6)
    for mode, i in enumerate(order):
        turned = modes.shapes[mode, :, 4]
        assert turned[1] / turned[0] == pytest.approx(shapes[1, i] / shapes[0, i], rel=1e-6)
    np.testing.assert_allclose(modes.energy_share.sum(axis=(1, 2)), 1.0)


def test_equilibrium_of_a_pendulum_held_aside() -> None:
    """m g l sin(angle) = moment, from a start 0.4 rad away; and the frequency there, omega^2 cos(angle)."""
    scene = Scene()
    rod(scene, "rod", "ground", 0.0, angle=0.4)
    scene.add_actuator(joint="rod.hinge", feed_forward=0.6 * 3.0 * G)
    rest = equilibrium(scene)
    angle = 2.0 * np.arcsin(rest.values[5])
    assert np.sin(angle) == pytest.approx(0.6, abs=1e-9)
    period = natural_modes(scene, state=rest).natural_period[0]
    assert period == pytest.approx(2.0 * np.pi / np.sqrt(3.0 * G / 4.0 * 0.8), rel=1e-7)


def test_hanging_payload_on_a_fixed_crane_top() -> None:
    """A box on a link of 8 m: a double pendulum in each plane; free to turn about the link."""
    scene = Scene()
    box = (10e3 / 12.0) * np.array([52.0, 52.0, 72.0])
    scene.add_body(name="payload", mass=10e3, inertia=box, position=(0.0, 0.0, -10.0))
    scene.add_joint(
        kind="distance",
        name="link",
        first="ground",
        second="payload",
        point=(0, 0, 0),
        second_point=(0, 0, -8),
    )
    modes = natural_modes(scene)
    mass, inertia = 10e3, box[0]
    matrix = np.array([[mass * 64.0, mass * 16.0], [mass * 16.0, mass * 4.0 + inertia]])
    stiffness = mass * G * np.diag([8.0, 2.0])
    expected = np.sqrt(np.linalg.eigvals(np.linalg.solve(matrix, stiffness)).real)
    np.testing.assert_allclose(modes.eigenvalues.imag, np.sort(np.repeat(expected, 2)), rtol=1e-6)
    assert modes.neutral == 1
    assert modes.table().count("payload") == 4


def crane_with_payload() -> Scene:
    """The crane on the ground with its payload, held by the controllers of the cases."""
    scene = Scene(name="crane on the ground")
    KnuckleBoomCrane.load().add_to(scene, base="ground", payload=Payload())
    scene.actuators.update(held(cases.case2(hs=0.0)).actuators)
    return scene


@pytest.mark.parametrize("label", ["payload sway", "payload surge", "payload pitch", "stiffest"])
def test_free_decay_of_crane_and_payload(label: str) -> None:
    """A run started in a mode shape decays as exp(eigenvalue t) in every pose, to 1 % of its size."""
    scene = crane_with_payload()
    linear = linear_model(scene)
    modes = natural_modes(linear)
    mode = int(np.argmax(np.abs(modes.eigenvalues))) if label == "stiffest" else modes.find(label)
    value = modes.eigenvalues[mode]
    size = 1e-4
    start = linear.full_state(size * modes.state_vectors[mode].real)
    t_end = 2.5 * 2.0 * np.pi / value.imag
    result = simulate(scene, t_end=t_end, dt_out=t_end / 50.0, rtol=1e-10, start=start, channels=["position"])
    rest = simulate(scene, t_end=0.0, start=linear.state, channels=["position"])["position"][0]
    decay = np.exp(value * result.time)[:, None, None]
    expected = size * (decay * modes.shapes[mode][:, :3]).real
    found = result["position"] - rest
    assert np.max(np.abs(expected)) > 1e-5
    np.testing.assert_allclose(found, expected, atol=0.01 * np.max(np.abs(expected)))


def test_case2_has_14_degrees_of_freedom_and_its_memory(lift: LinearModel) -> None:
    memory = lift.scene.compile().memory_states
    assert lift.degrees_of_freedom == 14
    assert lift.memory_states == memory > 20
    assert lift.a.shape == (28 + memory, 28 + memory)
    assert lift.b.shape == (28 + memory, 6)
    modes = natural_modes(lift)
    assert modes.neutral == 1  # the payload turns freely about its link
    assert np.max(modes.eigenvalues.real) < 0.0
    assert modes.natural_period[modes.find("payload sway")] == pytest.approx(6.5, abs=0.1)


def relative_difference(found: Array, expected: Array) -> Array:
    """Standard deviation of the difference over that of the expected, by column."""
    return np.asarray(np.std(found - expected, axis=0) / np.std(expected, axis=0))


def test_vessel_in_a_low_sea_follows_the_summed_response() -> None:
    scene = cases.vessel(hs=0.05)
    linear = linear_model(scene)
    summed = response_summed(linear, body="vessel")
    start = linear.full_state(summed.state_at(0.0))
    result = simulate(scene, t_end=100.0, dt_out=0.5, start=start, channels=["vessel_motion"])
    np.testing.assert_array_less(relative_difference(result["vessel_motion"], summed.at(result.time)), 0.01)


def low_sea_differences(hs: float) -> tuple[Array, Array]:
    """Time against frequency domain: vessel's six motions and payload's position, 60 s of case 2 held.

    The run starts in the steady state of the linear model, so there is no transient in either.
    """
    linear = linear_model(cases.case2(hs=hs, count=60))
    scene = held(linear.scene)
    scene.waves = linear.scene.waves
    vessel, payload = (response_summed(linear, body=body) for body in ("vessel", "payload"))
    start = linear.full_state(vessel.state_at(0.0))
    channels = ["vessel_motion", "position"]
    result = simulate(scene, t_end=60.0, dt_out=0.5, rtol=1e-9, start=start, channels=channels)
    position = result["position"][:, list(scene.bodies).index("payload")]
    return (
        relative_difference(result["vessel_motion"], vessel.at(result.time)),
        relative_difference(position, payload.at(result.time)[:, :3]),
    )


def test_crane_and_payload_in_low_seas_follow_the_summed_response() -> None:
    """Within 1 % in Hs 0.02 m and, but for roll, 0.05 m; what differs is of second order in the waves.

    Roll is small in waves, and the payload's swing (0.15 m at Hs 0.05 m) acts on it with its square; the
    payload rises with the square of its swing, too.
    """
    vessel, payload = low_sea_differences(0.05)
    assert np.all(vessel[[0, 1, 2, 4, 5]] < 0.01)
    assert np.all(payload[:2] < 0.01)
    lower_vessel, lower_payload = low_sea_differences(0.02)
    assert np.all(lower_vessel < 0.01)
    assert np.all(lower_payload[:2] < 0.001)
    assert vessel[3] / lower_vessel[3] == pytest.approx(2.5, rel=0.02)
    assert payload[2] / lower_payload[2] == pytest.approx(2.5, rel=0.02)


def test_phase_and_place_of_the_waves() -> None:
    """A vessel whose waves have their phase elsewhere: the summed response shifts as the exact load does."""
    scene = cases.vessel(hs=0.05, count=20)
    assert scene.waves is not None
    scene.waves = replace(scene.waves, position=(30.0, -20.0), relative_bound=0.0)
    linear = linear_model(scene)
    summed = response_summed(linear, body="vessel")
    start = linear.full_state(summed.state_at(0.0))
    result = simulate(scene, t_end=40.0, dt_out=0.5, start=start, channels=["vessel_motion"])
    np.testing.assert_array_less(relative_difference(result["vessel_motion"], summed.at(result.time)), 0.01)


def test_statistics_are_those_of_the_components() -> None:
    """Quadrature against the sum over many fine components, heave and roll of the vessel's deck."""
    database, heading = shipped_database(), np.radians(135.0)
    scene = cases.vessel(hs=0.0)
    linear = linear_model(scene)
    add_sea(scene, database, hs=2.0, tp=8.0, direction_deg=135.0, count=4000)
    summed = response_summed(linear, body="vessel", point=TIP, waves=scene.waves)
    statistics = response_statistics(
        linear, database=database, spectrum=jonswap(hs=2.0, tp=8.0), heading=heading, body="vessel", point=TIP
    )
    np.testing.assert_allclose(statistics.std[2:5], summed.std[2:5], rtol=0.01)
    assert 0.98 < statistics.wave_energy_share <= 1.0 + 1e-9
    np.testing.assert_allclose(statistics.significant_double_amplitude, 4.0 * statistics.std)
    np.testing.assert_allclose(statistics.significant_amplitude, 2.0 * statistics.std)


def test_most_probable_largest_value_in_simulated_storms() -> None:
    """The largest heave of 400 Gaussian records of half an hour with the response spectrum."""
    database = shipped_database()
    statistics = response_statistics(
        cases.vessel(hs=0.0), database=database, spectrum=jonswap(hs=2.0, tp=8.0), heading=np.pi,
        body="vessel", duration=1800.0,
    )  # fmt: skip
    cycles = 1800.0 / statistics.mean_period[2]
    expected = statistics.std[2] * np.sqrt(2.0 * np.log(cycles))
    assert statistics.most_probable_largest[2] == pytest.approx(expected)
    rng = np.random.default_rng(3)
    omega = np.arange(1, 800) * 2.0 * np.pi / 1800.0
    density = np.interp(omega, statistics.omega, statistics.spectrum[:, 2], left=0.0, right=0.0)
    size = np.sqrt(density * (omega[1] - omega[0]))
    phases = rng.normal(size=(400, 2, len(omega)))
    spectrum = np.zeros((400, 2049), dtype=complex)
    spectrum[:, 1:800] = 4096 / 2.0 * size * (phases[:, 0] + 1j * phases[:, 1])
    largest = np.fft.irfft(spectrum, axis=1).max(axis=1)
    # Gumbel: mean = mode + 0.5772 std / sqrt(2 ln N).
    mean = expected + 0.5772 * statistics.std[2] / np.sqrt(2.0 * np.log(cycles))
    assert largest.mean() == pytest.approx(mean, rel=0.03)


def test_undamped_resonance_is_named() -> None:
    """A payload hung on the ground beside the vessel swings without any damping."""
    scene = cases.vessel(hs=0.0)
    scene.add_body(name="pendulum", mass=1e3, inertia=(1e3, 1e3, 1e3), position=(0.0, 60.0, 0.0))
    scene.add_joint(kind="spherical", name="hook", first="ground", second="pendulum", point=(0.0, 60.0, 9.0))
    with pytest.warns(UserWarning, match=r"mode 'pendulum .*no finite value"):
        response_statistics(
            scene, database=shipped_database(), spectrum=jonswap(hs=2.0, tp=8.0), heading=0.0, body="vessel"
        )
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        natural_modes(scene)


def test_later_poses_are_reached_along_the_references() -> None:
    """Rest after the swing-out of case 1 equals where a damped run of it comes to rest."""
    scene = cases.case1(hs=0.0)
    rest = equilibrium(scene, time=50.0)
    run = simulate(scene, t_end=400.0, dt_out=400.0, channels=["vessel_motion", "slew_angle"])
    at_rest = simulate(scene, t_end=50.0, start=rest, dt_out=1.0, channels=["vessel_motion", "slew_angle"])
    np.testing.assert_allclose(at_rest["vessel_motion"][0, 3], run["vessel_motion"][-1, 3], rtol=0.01)
    assert abs(at_rest["vessel_motion"][0, 3]) > np.radians(2.0)
    np.testing.assert_allclose(at_rest["slew_angle"][0], run["slew_angle"][-1], rtol=1e-3)


def test_what_cannot_be_linearised_says_why(lift: LinearModel) -> None:
    scene = Scene(name="fall")
    scene.add_body(name="stone", mass=1.0, inertia=(1.0, 1.0, 1.0))
    with pytest.raises(SceneError, match=r"no rest state found; body 'stone' still accelerates by -9\.81"):
        equilibrium(scene)
    swinging = Scene(name="swing")
    rod(swinging, "rod", "ground", 0.0, angle=0.4)
    state = State(time=0.0, values=swinging.compile().initial_state, inputs=np.zeros(0))
    with pytest.raises(SceneError, match=r"body 'rod': accelerates by .* seacrane\.equilibrium first"):
        linear_model(swinging, state=state)
    with pytest.raises(SceneError, match=r"values, scene .* finite ones"):
        linear_model(lift.scene, state=state)
    database = shipped_database()
    with pytest.raises(SceneError, match="body 'hook' does not exist"):
        motion_rao(lift, database=database, omega=0.5, heading=0.0, body="hook")
    with pytest.raises(SceneError, match="has no vessel"):
        motion_rao(crane_with_payload(), database=database, omega=0.5, heading=0.0, body="payload")
    with pytest.raises(ValueError, match="outside"):
        motion_rao(lift, database=database, omega=50.0, heading=0.0, body="vessel")
    with pytest.raises(SceneError, match="has no waves"):
        response_summed(cases.vessel(hs=0.0), body="vessel")
    with pytest.raises(SceneError, match="duration is -1"):
        response_statistics(
            lift,
            database=database,
            spectrum=jonswap(hs=1.0, tp=8.0),
            heading=0.0,
            body="vessel",
            duration=-1.0,
        )
