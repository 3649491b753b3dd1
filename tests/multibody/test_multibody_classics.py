"""The core against classic motions whose solutions owe nothing to it."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from multibody_runs import (
    CRANK,
    add_crane,
    add_moving_bodies,
    momentum,
    quaternion_about,
    record,
    slider_crank,
    swing_out,
)
from reference.classic import Link, spherical_pendulum
from reference.jets import Jet
from reference.mechanisms import ChangePointFourBar

from seacrane import Scene, SimulationError
from seacrane.inputs.frames import rotation_matrix

# Assembly makes consistent what some scenes describe roughly, on purpose.
pytestmark = pytest.mark.filterwarnings("ignore::seacrane.warnings.AssemblyWarning")

INERTIA = (3.0, 2.0, 1.0)
CHANGE_POINT = ChangePointFourBar(
    Link(1.0, 0.1, 0.5, 0.2), Link(2.0, 0.3, 1.0, 0.5), Link(1.5, 0.2, 0.9, 0.4), 1.4
)


def tumbling(rates: tuple[float, float, float], orientation: str = "quaternion") -> Scene:
    q = quaternion_about((1.0, 2.0, -0.5), 0.6)
    scene = Scene(gravity=0.0, orientation=orientation)
    scene.add_body(
        name="block", mass=2.0, inertia=INERTIA, quaternion=q, center_of_mass=(0.1, -0.2, 0.3),
        angular_velocity=rotation_matrix(q) @ rates
    )  # fmt: skip
    return scene


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
    scene.record_coordinate(joint="shaft")
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


def four_bar(bar: ChangePointFourBar, q: float, rate: float, kinds: dict[str, str]) -> Scene:
    """Planar in x-y, weight along -y as a point force on each body."""
    scene = Scene(gravity=0.0)
    add_moving_bodies(scene, bar.mechanism(), ["crank", "coupler", "rocker"], q, rate)
    along = [np.array([c.f for c in m.axes[0]]) for m in bar.kinematics(Jet(q, 1.0))]
    pin = bar.crank.length * along[0]
    places: dict[str, tuple[str, str, Any]] = {
        "O": ("ground", "crank", np.zeros(3)), "A": ("crank", "coupler", pin),
        "B": ("coupler", "rocker", pin + bar.coupler.length * along[1]),
        "C": ("ground", "rocker", np.array([bar.ground, 0.0, 0.0]))
    }  # fmt: skip
    for name, (first, second, point) in places.items():
        axis = {} if kinds[name] == "spherical" else {"axis": (0, 0, 1)}
        scene.add_joint(kind=kinds[name], name=name, first=first, second=second, point=point, **axis)
    for body in list(scene.bodies.values()):
        scene.add_point_force(name=body.name, body=body.name, force=(0.0, -9.81 * body.mass, 0.0))
    return scene


def check_four_bar(out: dict[str, Any]) -> None:
    """Error of an order-4 or order-5 method over a quarter second, magnified where both branches meet."""
    mechanism = CHANGE_POINT.mechanism((0.0, -9.81, 0.0))
    q, _ = mechanism.simulate(out["time"], 1.0, 8.0)
    assert q[0] < np.pi < q[-1] < 2.0 * np.pi
    positions, _ = mechanism.poses(q)
    np.testing.assert_allclose(out["position"], positions, atol=1e-6)
    assert np.max(out["constraint_error"]) < 1e-9


def test_four_bar_passes_its_change_point_on_planar_and_on_spatial_joints() -> None:
    scene = four_bar(CHANGE_POINT, 1.0, 8.0, dict.fromkeys("OABC", "revolute"))
    with pytest.warns(UserWarning, match="O, A, B, C"):
        check_four_bar(record(scene, 0.45, rtol=1e-9, dt_out=0.025))
    # 5 + 5 + 3 + 4 rows hold each motion once; their rank falls to 16 in the flat position only.
    kinds = {"O": "revolute", "A": "revolute", "B": "spherical", "C": "cylindrical"}
    scene = four_bar(CHANGE_POINT, 1.0, 8.0, kinds)
    assert scene.compile().assembly["rank"] == 17
    for settings in ({"rtol": 1e-6}, {"integrator": "tsit5"}, {"integrator": "rk4", "dt": 0.001}):
        check_four_bar(record(scene, 0.45, dt_out=0.025, **settings))


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
    free = [record(tumbling((0.3, 0.1, 0.4), kind), 2.0, rtol=1e-10) for kind in ("quaternion", "euler_xyz")]
    np.testing.assert_allclose(free[0]["quaternion"], free[1]["quaternion"], atol=1e-8)


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
    """Every body starts with the twist of one rigid body; actuators swing the crane out."""
    scene = Scene(gravity=0.0)
    twist = {"velocity": (1.0, -2.0, 0.5), "angular_velocity": (0.0, 0.0, 0.05)}
    scene.add_body(
        name="vessel", mass=4.0e6, inertia=(4e8, 3e9, 3e9), center_of_mass=(0.0, 0.0, -2.0), **twist
    )
    add_crane(scene, base="vessel", payload=True, references=swing_out(6.0))
    out = record(scene, 8.0, rtol=1e-9, dt_out=0.5)
    reach = out["position"][:, out["bodies"].index("knuckle_jib")] - out["position"][:, 0]
    assert np.ptp(np.linalg.norm(reach, axis=1)) > 5.0
    linear, angular = momentum(scene, out)
    for value in (linear, angular):
        np.testing.assert_allclose(
            value, np.broadcast_to(value[0], value.shape), atol=1e-7 * np.linalg.norm(value[0])
        )
    assert np.linalg.norm(angular[0]) > 1e7
