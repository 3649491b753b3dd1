"""What limits refuse, and what scene files and results keep of them."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from event_scenes import ball, lift, pendulum, pushed

from seacrane import Result, Run, Scene, SceneError, cases, simulate
from seacrane.cli.run_command import costs


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda s: s.add_end_stop(joint="air", coordinate="x"), "neither minimum nor maximum"),
        (
            lambda s: s.add_end_stop(joint="air", coordinate="x", minimum=1.0, maximum=0.0),
            "minimum must be below",
        ),
        (lambda s: s.add_end_stop(joint="air", coordinate="x", minimum=1.0), "starts 1 m or rad beyond"),
        (
            lambda s: s.add_end_stop(joint="air", coordinate="yaw", minimum=-1.0),
            "give both, between -pi and pi",
        ),
        (
            lambda s: s.add_end_stop(joint="air", coordinate="z", minimum=-3.0, name="b"),
            "'floor' limits already",
        ),
        (lambda s: s.add_end_stop(joint="nowhere"), "there is no joint 'nowhere'"),
        (lambda s: s.add_end_stop(joint="air", coordinate="x", minimum=float("nan")), "nan"),
        (
            lambda s: s.add_end_stop(joint="air", coordinate="x", minimum=-1.0, restitution=1.5),
            "give 0 to 1",
        ),
        (lambda s: s.add_line(joint="air", rung="rigid"), "a wire takes a distance joint"),
        (lambda s: s.add_seat(joint="air"), "a seat takes a weld joint"),
        (
            lambda s: s.add_friction(joint="air", coordinate="x", load=-1.0, speed=1.0),
            "load is -1 N or N m; it must not be negative",
        ),
        (
            lambda s: s.add_friction(joint="air", coordinate="x", load=1.0, speed=0.0),
            "speed is 0 m/s or rad/s; it must be positive",
        ),
        (
            lambda s: s.add_soft_stop(joint="air", coordinate="x", maximum=1.0, stiffness=0.0),
            "stiffness is 0 N/m or N m/rad; it must be positive",
        ),
    ],
)
def test_contradictions_are_refused_by_name(change: Any, message: str) -> None:
    scene = ball()
    with pytest.raises(SceneError, match=message):
        change(scene)
        scene.compile()


def test_a_driver_and_a_stop_on_one_coordinate_are_refused() -> None:
    scene = lift()
    scene.add_end_stop(joint="hoist", maximum=3.0)
    with pytest.raises(SceneError, match=r"driver 'hoist\.displacement' prescribes hoist\.displacement"):
        scene.compile()


def test_a_run_without_limits_says_nothing_of_them() -> None:
    result = simulate(cases.case1(), t_end=0.2, dt_out=0.1)
    assert result.events == ()
    assert "events" not in result.stats
    assert not {"limit_force", "impact_loss"} & set(result.channels)


def test_events_survive_a_file(tmp_path: Path) -> None:
    result = simulate(ball(), t_end=1.5, dt_out=0.1)
    loaded = Result.load(result.save(tmp_path / "ball.nc"))
    assert loaded.events == result.events
    assert len(result.events) == result.stats["events"]
    assert f"events of limits {len(result.events)}, energy lost in impacts" in costs(result)
    assert loaded.coords["limit"] == ("floor",)
    dataset = result.to_xarray()
    assert list(dataset["event_name"].values) == ["floor"] * len(result.events)
    np.testing.assert_array_equal(dataset["event_time"], [e.time for e in result.events])


def test_limits_survive_a_scene_file(tmp_path: Path) -> None:
    scene = pushed(restitution=0.3)
    scene.add_friction(joint="rail", load=2.0, speed=1e-3)
    scene.add_soft_stop(joint="rail", maximum=1.0, stiffness=1e4, damping=0.2)
    scene.save(tmp_path / "pushed.json")
    read = Scene.load(tmp_path / "pushed.json")
    again, once = (simulate(s, t_end=1.5, dt_out=0.1) for s in (read, scene))
    np.testing.assert_array_equal(again["coordinate"], once["coordinate"])
    assert again.events == once.events
    assert len(once.events) > 1
    assert "rail soft stop (rail displacement)" in dict(scene.report()["elements"])["limits and friction"]


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


def test_a_method_that_cannot_project_takes_the_redundant_form_with_limits() -> None:
    scene = Scene(name="two wires")
    scene.add_body(name="ball", mass=2.0, inertia=(0.1, 0.1, 0.1), position=(0.0, 0.0, -1.0))
    for name, x in (("left", -1.0), ("right", 1.2)):
        scene.add_joint(
            kind="distance", name=name, first="ground", second="ball", point=(x, 0.3 * x, 0.0),
            second_point=(0.0, 0.0, -1.0), length=2.5,
        )  # fmt: skip
        scene.add_line(joint=name, rung="rigid")
    result = simulate(scene, t_end=3.0, dt_out=0.1, integrator="cvode-adams", rtol=1e-8)
    reference = simulate(scene, t_end=3.0, dt_out=0.1, rtol=1e-10)
    assert result.stats["formulation"] == "redundant"
    assert [e.name for e in result.events] == [e.name for e in reference.events]
    assert {e.name for e in result.events} == {"left", "right"}
    np.testing.assert_allclose(result["position"], reference["position"], atol=1e-5)
    with pytest.raises(SceneError, match="cannot project, and this scene keeps constraints or limits"):
        simulate(scene, t_end=1.0, integrator="cvode-adams", formulation="recursive")
