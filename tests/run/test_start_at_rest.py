"""start="rest": the word for the state at rest, wherever a run begins."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import seacrane as sc
from seacrane.run.stages_to_file import simulate_stages_to_file
from seacrane.run.to_file import simulate_to_file

WAIT = [sc.Stage(name="wait", duration=2.0)]
LIFT = """format = "seacrane lift"
version = 2
scene = { name = "hung" }
body = { name = "load", mass_kg = 20e3, size_m = [2, 2, 2], position_m = [0, 0, -10] }
line = { name = "hoist", first = "ground", second = "load", EA_N = 3e7, length_m = 8.5 }
"""


def hung() -> sc.Scene:
    """20 t on a line that is half a metre shorter than its path."""
    scene = sc.Scene(name="hung")
    scene.add_body(name="load", mass=20e3, size=(2, 2, 2), position=(0, 0, -10))
    scene.add_line(name="hoist", first="ground", second="load", EA=3e7, length=8.5)
    return scene


def height(result: Any) -> Any:
    return result.select("position", body="load", axis="z")


def test_every_run_takes_the_word_and_begins_as_from_equilibrium(tmp_path: Path) -> None:
    scene = hung()
    state = sc.equilibrium(scene)
    by_state = height(sc.simulate(scene, 2.0, start=state))
    stretched = 8.5 * (1.0 + 20e3 * scene.gravity / 3e7)
    assert by_state == pytest.approx(-1.0 - stretched, abs=1e-6)
    assert np.array_equal(sc.Run(scene, 2.0, start="rest").start.values, state.values)
    for told in (
        sc.simulate(scene, 2.0, start="rest"),
        simulate_to_file(scene, tmp_path / "a.nc", 2.0, start="rest").load(),
        sc.simulate_stages(scene, WAIT, start="rest"),
        simulate_stages_to_file(scene, WAIT, tmp_path / "b.nc", start="rest"),
    ):
        assert np.array_equal(height(told), by_state)
    over, keep = {"bodies.load.mass": [20e3, 30e3]}, {"range": "line_tension[hoist].std"}
    kept = sc.ensemble(scene, over=over, keep=keep, t_end=2.0, start="rest")
    assert np.all(kept.dataset["range"].to_numpy() < 1.0)


@pytest.mark.warns("LineLengthWarning")
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
    with pytest.raises(sc.SceneError, match=r"start is 'calm'.*rest"):
        sc.simulate(hung(), 1.0, start="calm")
