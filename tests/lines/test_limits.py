"""Limits: what they refuse, what files keep of them, and more wires than hold a body."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from event_scenes import ball, lift, pendulum, pushed
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from seacrane import Result, Run, Scene, SceneError, _core, simulate
from seacrane.arrays import Array

SEAT = _core.Limit(name="seat", kind="seat", joint="air")
CONTRADICTIONS: list[tuple[str, dict[str, Any], str]] = [
    ("stop", {}, "neither minimum nor maximum"),
    ("stop", {"minimum": 1.0, "maximum": 0.0}, "minimum must be below"),
    ("stop", {"minimum": 1.0}, "starts 1 m or rad beyond"),
    ("stop", {"coordinate": "yaw", "minimum": -1.0}, "give both, between -pi and pi"),
    ("stop", {"coordinate": "z", "minimum": -3.0, "name": "b"}, "'floor' limits already"),
    ("line", {"coordinate": None, "rung": "rigid"}, "a wire takes a distance joint"),
    ("load", {"joint": None, "coordinate": None, "element": SEAT}, "a seat takes a weld joint"),
    ("stop", {"minimum": -1.0, "damping": 0.2}, "stop of joint 'air': damping is given; a stop takes coord"),
    ("stop", {"stiffness": 1e4, "restitution": 0.2}, "restitution is given; a soft stop takes coordinate"),
]


@pytest.mark.parametrize(("what", "given", "message"), CONTRADICTIONS)
def test_contradictions_are_refused_by_name(what: str, given: dict[str, Any], message: str) -> None:
    scene = ball()
    words = {"joint": "air", "coordinate": "x"} | given
    with pytest.raises(SceneError, match=message):
        getattr(scene, f"add_{what}")(**{key: value for key, value in words.items() if value is not None})
        scene.compile()
    driven = lift()
    driven.add_stop(joint="hoist", maximum=3.0)
    with pytest.raises(SceneError, match=r"driver 'hoist\.displacement' prescribes hoist\.displacement"):
        driven.compile()


def test_limits_and_events_survive_files(tmp_path: Path) -> None:
    scene = pushed(restitution=0.3)
    scene.add_friction(joint="rail", load=2.0, speed=1e-3)
    scene.add_stop(joint="rail", maximum=1.0, stiffness=1e4, damping=0.2)
    scene.save(tmp_path / "pushed.json")
    again, once = (simulate(s, t_end=1.5, dt_out=0.1) for s in (Scene.load(tmp_path / "pushed.json"), scene))
    np.testing.assert_array_equal(again["coordinate"], once["coordinate"])
    assert again.events == once.events and len(once.events) == once.stats["events"] > 1
    assert Result.load(once.save(tmp_path / "pushed.nc")).events == once.events
    np.testing.assert_array_equal(once.to_xarray()["event_time"], [event.time for event in once.events])


def test_threads_that_share_a_model_compile_their_sets_apart() -> None:
    scene = pendulum()
    model = scene.compile()

    def positions(_: int) -> Any:
        run = Run(scene, t_end=3.0, model=model)
        run.advance(3.0)
        assert len(run.core.events()) == 2
        return run.result()["position"]

    with ThreadPoolExecutor(4) as pool:
        first, *others = pool.map(positions, range(8))
    for other in others:
        np.testing.assert_array_equal(other, first)


# Redundant wires, and rough velocities that assembly makes consistent.
RIGGED = pytest.mark.filterwarnings("ignore::UserWarning")
MASS, GRAVITY = 2e4, 9.81
INERTIA = np.array([3e4, 6e4, 8e4])
CORNERS = np.array([(3.0, 2.0, -7.0), (-3.0, 2.0, -7.0), (-3.0, -2.0, -7.0), (3.0, -2.0, -7.0)])
START, VELOCITY = np.array([0.0, 0.0, -8.0]), np.array([0.5, 0.3, 0.0])


def hooks(top: float) -> Array:
    return CORNERS * [top, top, 0.0]


def payload(top: float, yaw_rate: float) -> Scene:
    """On four rigid wires, to hooks `top` times as far apart as its own corners."""
    scene = Scene(name="payload", gravity=GRAVITY)
    scene.add_body(name="load", mass=MASS, inertia=INERTIA, position=START, velocity=VELOCITY,
                   angular_velocity=(0.0, 0.0, yaw_rate))  # fmt: skip
    for i, (corner, hook) in enumerate(zip(CORNERS, hooks(top), strict=True)):
        ends: dict[str, Any] = {"first": "ground", "second": "load", "point": hook, "second_point": corner}
        scene.add_joint(f"wire {i}", kind="distance", **ends)
        scene.add_line(joint=f"wire {i}", rung="rigid")
    return scene


def gaps(result: Result, top: float) -> Array:
    """How much shorter than its wire each way from hook to corner is."""
    turned = Rotation.from_quat(np.roll(result["quaternion"][:, 0], -1, axis=1)).as_matrix()
    ends = result["position"][:, 0, None] + np.einsum("tij,kj->tki", turned, CORNERS - START)
    lengths = np.linalg.norm(CORNERS - hooks(top), axis=1)
    return np.asarray(lengths - np.linalg.norm(ends - hooks(top), axis=2))


@RIGGED
@pytest.mark.parametrize(("top", "yaw_rate"), [(1.0, 0.2), (0.5, 1e-3)])
def test_a_payload_on_four_wires_turns_and_swings(top: float, yaw_rate: float, formulation: str) -> None:
    result = simulate(payload(top, yaw_rate), t_end=6.0, dt_out=0.05, formulation=formulation)
    open_by, tension = gaps(result, top), result["tension"]
    assert open_by.min() > -1e-8 and open_by.max() < 0.05
    assert tension.min() >= 0.0 and np.all(tension[open_by > 1e-8] == 0.0)
    swing = 0.5 * MASS * float(VELOCITY @ VELOCITY)
    assert np.abs(result["energy_balance"]).max() < 1e-4 * swing
    assert result["impact_loss"][-1] < 0.1 * swing


@RIGGED
def test_four_wires_of_a_payload_that_only_swings_share_its_weight() -> None:
    result = simulate(payload(1.0, 0.0), t_end=6.0)
    assert result.events == () and np.all(result["tension"] > 0.2 * MASS * GRAVITY)


@RIGGED
@pytest.mark.slow("long run")
def test_four_rigid_wires_follow_four_stiff_springs_that_only_pull() -> None:
    """SciPy's answer differs by about the stretch under twice the load that one spring may carry."""
    top, yaw_rate, stiffness, end = 1.0, 0.2, 1e8, 4.0
    result = simulate(payload(top, yaw_rate), t_end=end, rtol=1e-8)
    arms = CORNERS - START
    lengths = np.linalg.norm(CORNERS - hooks(top), axis=1)

    def slopes(_: float, y: Array) -> Array:
        turned, velocity, spin = Rotation.from_quat(y[3:7]).as_matrix(), y[7:10], y[10:13]
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
