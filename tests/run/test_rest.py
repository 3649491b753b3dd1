"""Rest states: loads on wires are hung first, and what a search finds stays or is told not to."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from named import on_wire
from random_rests import Builder

import seacrane as sc
from seacrane import Scene, SceneError, equilibrium, simulate
from seacrane.hydro import shipped_database
from seacrane.warnings import CreepingRestWarning, LargeHeelWarning, UnstableRestWarning, UnsteadyOilWarning

STILL = 1e-3  # m, and m at 1 m from the centre of mass, in a minute
REPORTED = (UnstableRestWarning, CreepingRestWarning, UnsteadyOilWarning)
EVERY, USUAL = 200, 10  # scenes, and every how many of them on every commit
G = 9.80665


def hung(*, slack: float, driven: float) -> Scene:
    scene = Scene(name="hung")
    scene.add_body(name="tip", mass=1e3, inertia=(1e3,) * 3, gravity=False)
    scene.add_joint(kind="prismatic", name="up", first="ground", second="tip", axis=(0, 0, 1))
    scene.add_driver(joint="up", curve=driven)
    scene.add_body(name="load", mass=1e5, inertia=(1e5,) * 3, position=(0, 0, -100))
    scene.add_line("hoist", bodies=["tip", "load"], points=np.zeros((2, 3)), EA=4e8, length=99.9 + slack)
    return scene


def moved(scene: Scene, duration: float = 60.0) -> float:
    """How far a body, or a point 1 m from it, comes in a run from rest, m."""
    result = simulate(scene, duration, start=equilibrium(scene), dt_out=1.0)
    place, turn = np.asarray(result["position"]), np.asarray(result["quaternion"])
    turned = 2.0 * np.linalg.norm(turn - turn[0], axis=-1)
    return float(max(np.abs(place - place[0]).max(), turned.max()))


MANY = pytest.mark.slow("hundreds of random rests")


@pytest.mark.parametrize("seed", [pytest.param(n, marks=MANY if n % USUAL else []) for n in range(EVERY)])
def test_a_rest_lasts_or_is_told_not_to(seed: int) -> None:
    """A scene without rest, as of winches that chase each other, is refused and still moves after minutes."""
    with warnings.catch_warnings(record=True, action="always") as caught:
        try:
            far = moved(Builder(seed).scene)
        except SceneError as refused:
            assert "no rest state found" in str(refused), refused
            late = simulate(Builder(seed).scene, t_end=180.0, dt_out=0.5, channels=["position"])["position"]
            assert np.ptp(late[-60:], axis=0).max() > STILL
            return
    assert far < STILL or any(issubclass(one.category, REPORTED) for one in caught), far


@pytest.mark.warns(sometimes=["AssemblyWarning"])
@pytest.mark.parametrize(("driven", "slack"), [(-1.0, 0.0), (0.0, 1.0), (0.0, 20.0), (-0.5, 0.3)])
def test_a_load_on_a_slack_line_is_hung_first(driven: float, slack: float) -> None:
    scene = hung(driven=driven, slack=slack)
    state = equilibrium(scene)
    below = (99.9 + slack) * (1.0 + 1e5 * G / 4e8) - driven
    assert state.values[7 + 2] == pytest.approx(-below, abs=1e-6)


def test_ballast_heels_a_ship_with_a_load_on_a_line() -> None:
    scene = Scene(name="heeled")
    scene.add_vessel(shipped_database(), memory="none")
    roles = scene.add_crane(slew=-np.pi / 2, s1=2.0, s2=2.0, held=True)
    body, head = roles.tip
    x, y, z = scene.place_of(body=body, point=head)
    scene.add_body(name="load", mass=50e3, inertia=(1e5,) * 3, position=(x, y, z - 15))
    scene.add_line("hoist", first=body, first_point=head, second="load", EA=1e9, tension_at_start=50e3 * G)
    scene.add_ballast(heel_deg=-6.0)
    w, x, y, z = equilibrium(scene).values[3:7]
    assert np.degrees(np.arctan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))) == pytest.approx(-6, abs=1e-5)


@pytest.mark.parametrize("slack", [-0.01, 0.01, 0.5])
@pytest.mark.parametrize("lag", [0.0, 0.2])
def test_a_tugger_holds_its_tension_at_rest(slack: float, lag: float) -> None:
    scene = on_wire(mass=1e4, EA=1e7)
    scene.add_line("tug", first="ground", first_point=(8, 0, -10), second="load", EA=2e5, length=8.0 + slack)
    scene.add_winch(line="tug", tension=10e3, tension_gain=1e-5, maximum_rate=1.0, lag=lag)
    result = simulate(scene, 5.0, start=equilibrium(scene))
    assert result["line_tension"][:, 1] == pytest.approx(10e3, abs=1e-2)
    assert np.ptp(result["position"], axis=0).max() < 1e-5


def test_a_rest_that_grows_is_told_of_and_how_fast() -> None:
    """Two parallel taglines of constant tension turn a load away: k = -2 T arm (1 + arm / length)."""
    arm, tension, length, inertia = 1.0, 500.0, 20.0, 5e4
    scene = on_wire(mass=1e4, EA=1e7)
    scene.replace("load", kind="body", inertia=np.diag((inertia,) * 3))
    for i, side in enumerate((-1.0, 1.0)):
        ends = {"first_point": (-side * length, 0, -10), "second_point": (side * arm, 0, 0)}
        scene.add_line(f"tag {i}", "ground", "load", EA=1e5, tension_at_start=tension, **ends)
        scene.add_winch(line=f"tag {i}", tension=tension, tension_gain=1.0)
    with pytest.warns(UnstableRestWarning, match=r"load yaw grows, doubling in (\S+) s") as caught:
        equilibrium(scene)
    across = length + arm
    expected = np.log(2.0) / np.sqrt(2.0 * tension * arm * length / across / inertia)
    told = float(str(caught[0].message).split("doubling in ")[1].split(" s")[0])
    assert told == pytest.approx(expected, rel=0.05)


def test_a_rest_beyond_linear_restoring_is_told_of() -> None:
    scene = Scene(name="no ballast")
    scene.add_vessel(shipped_database(), memory="none")
    scene.add_crane(slew=-np.pi / 2, held=True)
    scene.add_body(name="deck load", mass=2e6, inertia=(1e7,) * 3, position=(0, 9, 2))
    scene.add_joint(kind="weld", name="lashing", first="vessel", second="deck load", point=(0, 9, 2))
    with pytest.warns(LargeHeelWarning, match="rests with a vessel that leans by"):
        equilibrium(scene)


WAIT = [sc.Stage(name="wait", duration=2.0)]
LIFT = """format = "seacrane lift"
version = 2
scene = { name = "hung" }
body = { name = "load", mass_kg = 20e3, size_m = [2, 2, 2], position_m = [0, 0, -10] }
line = { name = "hoist", first = "ground", second = "load", EA_N = 3e7, length_m = 8.5 }
"""


def short() -> Scene:
    """20 t on a line that is half a metre shorter than its path."""
    scene = Scene(name="hung")
    scene.add_body(name="load", mass=20e3, size=(2, 2, 2), position=(0, 0, -10))
    scene.add_line(name="hoist", first="ground", second="load", EA=3e7, length=8.5)
    return scene


def height(result: Any) -> Any:
    return result.select("position", body="load", axis="z")


def test_every_run_takes_the_word_and_begins_as_from_equilibrium(tmp_path: Path) -> None:
    scene = short()
    state = equilibrium(scene)
    by_state = height(simulate(scene, 2.0, start=state))
    stretched = 8.5 * (1.0 + 20e3 * scene.gravity / 3e7)
    assert by_state == pytest.approx(-1.0 - stretched, abs=1e-6)
    assert np.array_equal(sc.Run(scene, 2.0, start="rest").start.values, state.values)
    for told in (
        simulate(scene, 2.0, start="rest"),
        simulate(scene, 2.0, to=tmp_path / "a.nc", start="rest").load(),
        simulate(scene, WAIT, start="rest"),
        simulate(scene, WAIT, to=tmp_path / "b.nc", start="rest").load(),
    ):
        assert np.array_equal(height(told), by_state)
    over, keep = {"bodies.load.mass": [20e3, 30e3]}, {"range": "line_tension[hoist].std"}
    kept = sc.ensemble(scene, over=over, keep=keep, t_end=2.0, start="rest")
    assert np.all(kept.dataset["range"].to_numpy() < 1.0)


def test_a_lift_file_begins_at_rest_with_and_without_stages(tmp_path: Path) -> None:
    for end in (
        '[run]\nstart = "rest"\nt_end_s = 2\n',
        '[run]\nstart = "rest"\n[[stage]]\nname = "wait"\nduration_s = 2\n',
    ):
        (tmp_path / "lift.toml").write_text(LIFT + end)
        lift = sc.Lift.load(tmp_path / "lift.toml")
        assert lift.start == "rest"
        assert np.ptp(height(lift.simulate())) < 1e-6


def test_another_word_is_refused() -> None:
    with pytest.raises(SceneError, match=r"start is 'calm'.*rest"):
        simulate(short(), 1.0, start="calm")
