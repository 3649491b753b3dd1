"""Hook loads of links, wires and lines alike, with falls, as a channel, a limit state and a condition."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from seacrane import Scene, simulate, summary

G, MASS = 9.80665, 1e4


def hung(points: list[tuple[float, float, float]], bodies: list[str], *, length: float) -> Scene:
    """A load on a line with its falls, at rest."""
    scene = Scene(name="hung", gravity=G)
    scene.add_body(name="load", mass=MASS, inertia=(1e4, 1e4, 1e4), position=(0.0, 0.0, -20.0))
    scene.add_line(name="hoist", bodies=bodies, points=points, EA=1e8, length=length, damping_ratio=0.1)
    scene.add_winch(line="hoist")
    return scene


def falls_of(falls: int) -> Scene:
    """From the tip to the block and back, at one point each."""
    stretch = 1.0 + MASS * G / falls / 1e8
    bodies = ["ground", "load"] * 2
    return hung([(0.0, 0.0, 0.0)] * (falls + 1), bodies[: falls + 1], length=20.0 * falls / stretch)


@pytest.mark.parametrize("falls", [1, 3])
def test_a_line_carries_the_weight_by_all_its_falls(falls: int) -> None:
    """And has a dynamic factor and a slack margin over the weight, whatever the run began with."""
    scene = falls_of(falls)
    result = simulate(scene, 1.0, dt_out=0.25, channels=["hook_load", "line_tension"])
    assert result.coords["suspension"] == ("hoist",)
    assert_allclose(result["hook_load"], MASS * G, rtol=1e-4)
    assert_allclose(result["hook_load"][:, 0], falls * result["line_tension"][:, 0], rtol=1e-12)
    scene.replace("load", position=(0.0, 0.0, -19.995))
    scene.add_limit_state(channel="hook_load", maximum=1e6)
    table = summary(simulate(scene, 2.0, dt_out=0.01))
    tension, hook = table["hoist tension hoist"], table["hook load hoist"]
    assert tension.static_known and tension.static == pytest.approx(MASS * G / falls)
    assert hook.static == pytest.approx(MASS * G)
    for row in (tension, hook):
        assert row.factor == pytest.approx(row.maximum / row.static) and row.factor > 1.01
        assert row.slack_margin == pytest.approx(row.minimum / row.static) and row.slack_margin < 0.99


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
    scene = falls_of(1)
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
