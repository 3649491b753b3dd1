"""Hook loads of links, wires and lines alike, with falls, as a channel, a limit state and a condition."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose
from stage_scenes import on_deck

from seacrane import Scene, SceneError, Stage, Until, simulate, simulate_stages, summary

G, MASS = 9.80665, 1e4


def hung(points: list[tuple[float, float, float]], bodies: list[str], *, length: float) -> Scene:
    """A load on a line with its falls, at rest."""
    scene = Scene(name="hung", gravity=G)
    scene.add_body(name="load", mass=MASS, inertia=(1e4, 1e4, 1e4), position=(0.0, 0.0, -20.0))
    scene.add_line(name="hoist", bodies=bodies, points=points, EA=1e8, length=length, damping_ratio=0.1)
    scene.add_winch(line="hoist")
    return scene


def single() -> Scene:
    stretch = 1.0 + MASS * G / 1e8
    return hung([(0.0, 0.0, 0.0), (0.0, 0.0, 0.0)], ["ground", "load"], length=20.0 / stretch)


def reeved() -> Scene:
    """Three falls: from the tip to the block, to the tip, to the block, at one point each."""
    stretch = 1.0 + MASS * G / 3.0 / 1e8
    points = [(0.0, 0.0, 0.0)] * 4
    return hung(points, ["ground", "load", "ground", "load"], length=60.0 / stretch)


@pytest.mark.parametrize(("scene", "falls"), [(single(), 1), (reeved(), 3)])
def test_a_line_carries_the_weight_by_all_its_falls(scene: Scene, falls: int) -> None:
    result = simulate(scene, 1.0, dt_out=0.25, channels=["hook_load", "line_tension"])
    assert result.coords["suspension"] == ("hoist",)
    assert_allclose(result["hook_load"], MASS * G, rtol=1e-4)
    assert_allclose(result["hook_load"][:, 0], falls * result["line_tension"][:, 0], rtol=1e-12)


def test_a_drum_on_deck_does_not_count_as_the_hook() -> None:
    """From a drum over the tip to the load: the load is reached last, though it is named in the middle."""
    points = [(30.0, 0.0, -20.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)]
    scene = hung(points, ["ground", "ground", "load", "ground"], length=1.0)
    length = float(np.hypot(30.0, 20.0)) + 40.0
    scene.replace("hoist", kind="load", length=length / (1.0 + 0.5 * MASS * G / 1e8))
    result = simulate(scene, 0.5, dt_out=0.25, channels=["hook_load", "line_tension"])
    assert_allclose(result["hook_load"][:, 0], 2.0 * result["line_tension"][:, 0], rtol=1e-12)
    assert_allclose(result["hook_load"], MASS * G, rtol=1e-3)


def test_a_link_carries_its_tension_and_it_is_recorded_by_itself() -> None:
    scene = single()
    scene.add_body(name="weight", mass=2.0, inertia=(1.0, 1.0, 1.0), position=(5.0, 0.0, -1.0))
    scene.add_joint(
        kind="distance", name="sling", first="ground", second="weight", point=(5.0, 0.0, 0.0),
        second_point=(5.0, 0.0, -1.0), length=1.0,
    )  # fmt: skip
    assert "hook_load" in simulate(scene, 0.1, dt_out=0.1)
    scene.add_limit_state(channel="hook_load", maximum=1.2 * MASS * G, minimum=0.5 * MASS * G,
                          names={"suspension": "hoist"})  # fmt: skip
    result = simulate(scene, 0.5, dt_out=0.1)
    assert result.coords["suspension"] == ("sling", "hoist")
    assert_allclose(result["hook_load"][:, 0], result["tension"][:, 0])
    assert result.select("hook_load", suspension="sling")[-1] == pytest.approx(2.0 * G, rel=1e-6)
    (used,) = result.utilisation
    assert used.utilisation == pytest.approx(1.0 / 1.2, rel=1e-3)


def test_a_stage_ends_at_a_hook_load() -> None:
    until = Until.channel("hook_load", suspension="hoist", minimum=5e4)
    stages = [Stage(name="take up", until=until, maximum_duration=20.0, commands={"hoist.rate": -0.05})]
    result = simulate_stages(on_deck(), stages, dt_out=0.2)
    assert result["line_tension"][-1, 0] == pytest.approx(5e4, rel=1e-6)


def test_where_there_is_none_it_is_refused() -> None:
    scene = Scene()
    scene.add_body(name="alone", mass=1.0, inertia=(1.0, 1.0, 1.0), position=(0.0, 0.0, 0.0))
    with pytest.raises(
        SceneError, match="channel 'hook_load' is unknown to this scene; it needs a link, a wire"
    ):
        simulate(scene, 0.1, channels=["hook_load"])
    scene.add_limit_state(channel="cylinder_pressure", maximum=1e7)
    with pytest.raises(SceneError, match=r"limit state 'cylinder pressure': channel 'cylinder_pressure'"):
        simulate(scene, 0.1)


@pytest.mark.parametrize(("scene", "falls"), [(single(), 1), (reeved(), 3)])
def test_lines_have_a_dynamic_factor_and_a_slack_margin(scene: Scene, falls: int) -> None:
    """The weight is static, whatever the run began with: the load starts 5 mm too high."""
    scene.replace("load", position=(0.0, 0.0, -19.995))
    scene.add_limit_state(channel="hook_load", maximum=1e6)
    table = summary(simulate(scene, 2.0, dt_out=0.01))
    tension, hook = table["hoist tension hoist"], table["hook load hoist"]
    assert tension.static_known and tension.static == pytest.approx(MASS * G / falls)
    assert hook.static == pytest.approx(MASS * G)
    for row in (tension, hook):
        assert row.factor == pytest.approx(row.maximum / row.static) and row.factor > 1.01
        assert row.slack_margin == pytest.approx(row.minimum / row.static) and row.slack_margin < 0.99
    assert "min/static" in str(table)
