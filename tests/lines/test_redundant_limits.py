"""More wires than hold a body: they share the load, or go slack where not all of them can be taut."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from seacrane import Result, Scene, simulate

pytestmark = [
    pytest.mark.filterwarnings("ignore:.*are redundant:UserWarning"),
    pytest.mark.filterwarnings(
        "ignore::seacrane.warnings.AssemblyWarning"
    ),  # it makes rough velocities consistent
]
Array = NDArray[np.float64]
MASS, GRAVITY = 2e4, 9.81
INERTIA = np.array([3e4, 6e4, 8e4])
CORNERS = np.array([(3.0, 2.0, -7.0), (-3.0, 2.0, -7.0), (-3.0, -2.0, -7.0), (3.0, -2.0, -7.0)])
START, VELOCITY = np.array([0.0, 0.0, -8.0]), np.array([0.5, 0.3, 0.0])


def hooks(top: float) -> Array:
    return CORNERS * [top, top, 0.0]


def payload(top: float, yaw_rate: float) -> Scene:
    """On four rigid wires, to hooks `top` times as far apart as its own corners."""
    scene = Scene(name="payload", gravity=GRAVITY)
    scene.add_body(
        name="load", mass=MASS, inertia=INERTIA, position=START, velocity=VELOCITY,
        angular_velocity=(0.0, 0.0, yaw_rate),
    )  # fmt: skip
    for i, (corner, hook) in enumerate(zip(CORNERS, hooks(top), strict=True)):
        scene.add_joint(
            kind="distance", name=f"wire {i}", first="ground", second="load", point=hook, second_point=corner
        )
        scene.add_line(joint=f"wire {i}", rung="rigid")
    return scene


def gaps(result: Result, top: float) -> Array:
    """How much shorter than its wire each way from hook to corner is."""
    turned = Rotation.from_quat(np.roll(result["quaternion"][:, 0], -1, axis=1)).as_matrix()
    ends = result["position"][:, 0, None] + np.einsum("tij,kj->tki", turned, CORNERS - START)
    lengths = np.linalg.norm(CORNERS - hooks(top), axis=1)
    return np.asarray(lengths - np.linalg.norm(ends - hooks(top), axis=2))


@pytest.mark.parametrize("formulation", ["redundant", "recursive"])
@pytest.mark.parametrize(("top", "yaw_rate"), [(1.0, 0.2), (1.0, 1e-3), (0.5, 1e-3), (0.5, 0.2)])
def test_a_payload_on_four_wires_turns_and_swings(top: float, yaw_rate: float, formulation: str) -> None:
    result = simulate(payload(top, yaw_rate), t_end=6.0, dt_out=0.05, formulation=formulation)
    open_by = gaps(result, top)
    assert open_by.min() > -1e-8
    assert open_by.max() < 0.05
    tension = result["tension"]
    assert tension.min() >= 0.0
    assert np.all(tension[open_by > 1e-8] == 0.0)
    swing = 0.5 * MASS * float(VELOCITY @ VELOCITY)
    assert np.abs(result["energy_balance"]).max() < 1e-4 * swing
    assert result["impact_loss"][-1] < 0.1 * swing


def test_four_wires_of_a_payload_that_only_swings_share_its_weight() -> None:
    result = simulate(payload(1.0, 0.0), t_end=6.0)
    assert result.events == ()
    assert np.all(result["tension"] > 0.2 * MASS * GRAVITY)


@pytest.mark.slow("long run")
def test_four_rigid_wires_follow_four_stiff_springs_that_only_pull() -> None:
    """SciPy's answer differs by about the stretch under twice the load that one spring may carry."""
    top, yaw_rate, stiffness, end = 1.0, 0.2, 1e8, 4.0
    result = simulate(payload(top, yaw_rate), t_end=end, rtol=1e-8)
    arms = CORNERS - START
    lengths = np.linalg.norm(CORNERS - hooks(top), axis=1)

    def slopes(_: float, y: Array) -> Array:
        turned = Rotation.from_quat(y[3:7]).as_matrix()
        velocity, spin = y[7:10], y[10:13]
        levers = arms @ turned.T
        ways = hooks(top) - y[:3] - levers
        now = np.linalg.norm(ways, axis=1)
        forces = (stiffness * np.maximum(now - lengths, 0.0) / now)[:, None] * ways
        moment = np.cross(levers, forces).sum(axis=0)
        inertia = turned @ np.diag(INERTIA) @ turned.T
        turning = np.linalg.solve(inertia, moment - np.cross(spin, inertia @ spin))
        vector, scalar = y[3:6], y[6]
        rate = 0.5 * np.append(scalar * spin + np.cross(spin, vector), -spin @ vector)
        return np.concatenate([velocity, rate, forces.sum(axis=0) / MASS - [0.0, 0.0, GRAVITY], turning])

    start = np.concatenate([START, [0.0, 0.0, 0.0, 1.0], VELOCITY, [0.0, 0.0, yaw_rate]])
    told = solve_ivp(slopes, (0.0, end), start, method="DOP853", rtol=1e-8, atol=1e-9, t_eval=result.time)
    np.testing.assert_allclose(result["position"][:, 0], told.y[:3].T, atol=2e-3)
