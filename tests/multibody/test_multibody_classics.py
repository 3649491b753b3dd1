"""The core against classic motions whose solutions owe nothing to it."""

from __future__ import annotations

import numpy as np
import pytest
from multibody_runs import CRANK, add_crane, momentum, record, slider_crank, swing_out
from reference.classic import spherical_pendulum

from seacrane import Scene, SimulationError
from seacrane.inputs.frames import rotation_matrix

# Assembly makes consistent what some scenes describe roughly, on purpose.
pytestmark = pytest.mark.filterwarnings("ignore::seacrane.warnings.AssemblyWarning")

INERTIA = (3.0, 2.0, 1.0)


@pytest.mark.parametrize("kind", ["spherical", "distance"])
def test_spherical_pendulum(kind: str) -> None:
    start, mass, inertia, length = np.array([1.2, 0.0, -1.6]), 2.0, 0.5, 2.0
    velocity = np.array([0.8, 2.0, 0.6])
    turning = kind == "spherical"
    scene = Scene(gravity=9.81)
    # On a spherical joint the ball turns with its arm; on a link through its centre it does not turn at all.
    spin = np.cross(start, velocity) / length**2 if turning else np.zeros(3)
    scene.add_body(
        name="ball", mass=mass, inertia=[inertia] * 3, position=start, velocity=velocity,
        angular_velocity=spin
    )  # fmt: skip
    second = {} if turning else {"second_point": start}
    scene.add_joint(kind=kind, name="pivot", first="ground", second="ball", point=(0, 0, 0), **second)
    out = record(scene, 5.0, rtol=1e-10)
    share = mass * length**2 / (mass * length**2 + inertia) if turning else 1.0
    x, v = spherical_pendulum(out["time"], start, velocity, 9.81 * share)
    np.testing.assert_allclose(out["position"][:, 0], x, atol=1e-8)
    np.testing.assert_allclose(out["velocity"][:, 0], v, atol=3e-8)


def test_spatial_slider_crank_under_a_constant_torque() -> None:
    q0, rate0, load = 0.4, 6.0, 2.0
    scene = slider_crank(CRANK, q0, rate0)
    scene.add_actuator(joint="shaft", feed_forward=load)
    scene.add_channel(joint="shaft")
    assert scene.compile().degrees_of_freedom == 1
    out = record(scene, 3.0, rtol=1e-10)
    mechanism = CRANK.mechanism(load=load)
    q, rate = mechanism.simulate(out["time"], q0, rate0)
    np.testing.assert_allclose(np.unwrap(out["coordinate"][:, 0]), q - q0, atol=1e-7)  # zero as described
    np.testing.assert_allclose(out["coordinate_rate"][:, 0], rate, atol=1e-6)
    assert q[-1] - q0 > 4.0 * np.pi
    positions, rotations = mechanism.poses(q)
    np.testing.assert_allclose(out["position"], positions, atol=1e-7)
    np.testing.assert_allclose(rotation_matrix(out["quaternion"]), rotations, atol=1e-7)


def test_euler_angles_and_quaternions_agree_away_from_the_singularity() -> None:
    runs = []
    for orientation in ("quaternion", "euler_xyz"):
        scene = slider_crank(CRANK, 0.4, 2.0)
        scene.orientation = orientation
        runs.append(record(scene, 1.0, rtol=1e-10))
    a, b = runs
    assert a["stats"]["states"] == b["stats"]["states"] + 3
    for name in ("position", "velocity", "angular_velocity", "quaternion"):
        np.testing.assert_allclose(a[name], b[name], atol=1e-7)


@pytest.mark.parametrize("integrator", ["dopri5", "rk4", "cvode-bdf"])
def test_euler_angles_stop_at_their_singularity_and_name_the_body(integrator: str) -> None:
    scene = Scene(gravity=0.0, orientation="euler_xyz")
    scene.add_body(name="anchor", mass=1.0, inertia=INERTIA)
    scene.add_body(name="buoy", mass=1.0, inertia=INERTIA, angular_velocity=(0.0, 1.0, 0.0))
    out = record(scene, 1.5, integrator=integrator)
    np.testing.assert_allclose(out["euler_xyz"][:, 1, 1], out["time"], atol=1e-5)
    with pytest.raises(SimulationError, match=r"'buoy'.*singular.*quaternion"):
        record(scene, 1.7, integrator=integrator)
    scene.orientation = "quaternion"
    record(scene, 1.7, integrator=integrator)


def test_momentum_of_a_thrown_crane_is_that_of_its_start() -> None:
    scene, hull = Scene(gravity=0.0), {"mass": 4.0e6, "inertia": (4e8, 3e9, 3e9)}
    twist = {"velocity": (1.0, -2.0, 0.5), "angular_velocity": (0.0, 0.0, 0.05)}
    scene.add_body(name="vessel", center_of_mass=(0.0, 0.0, -2.0), **hull, **twist)
    add_crane(scene, base="vessel", payload=True, references=swing_out(6.0))
    out = record(scene, 8.0, rtol=1e-9, dt_out=0.5)
    reach = out["position"][:, out["bodies"].index("knuckle_jib")] - out["position"][:, 0]
    assert np.ptp(np.linalg.norm(reach, axis=1)) > 5.0
    linear, angular = momentum(scene, out)
    for value in (linear, angular):
        assert np.abs(value - value[0]).max() < 1e-7 * np.linalg.norm(value[0])
    assert np.linalg.norm(angular[0]) > 1e7
