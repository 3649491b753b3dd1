"""What seacrane 0.1.0 and 0.2.0 wrote is read, and runs continue from it."""

from __future__ import annotations

import json
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import event_scenes
import numpy as np
import pytest
import test_restart

from seacrane import Lift, Result, Run, Scene, State, cases
from seacrane.cli.command_line import main
from seacrane.ensembles import Ensemble
from seacrane.inputs.state import state_to_bytes
from seacrane.warnings import RenamedKeysWarning

# Assembly makes consistent what some scenes describe roughly, on purpose.
pytestmark = pytest.mark.filterwarnings("ignore::seacrane.warnings.AssemblyWarning")

FILES = Path(__file__).with_name("files_0_1")
STOP, END = 0.73, 1.5
SCENES: dict[str, tuple[Callable[[], Scene], str]] = {
    "chain": (test_restart.chain, "recursive"),
    "crank": (test_restart.crank, "redundant"),
    "pendulum": (event_scenes.pendulum, "recursive"),
}


def run_of(name: str, start: State | None = None) -> Run:
    make, formulation = SCENES[name]
    return Run(make(), t_end=END, dt_out=0.1, formulation=formulation, rtol=1e-7, outputs_from=0.0,
               channels=["position", "quaternion", "energy_balance"], start=start)  # fmt: skip


@pytest.mark.parametrize("name", SCENES)
def test_a_state_is_read_with_all_that_it_holds(name: str) -> None:
    path = FILES / f"{name}.state"
    state = State.load(path, scene=SCENES[name][0]())
    assert state_to_bytes(state) == path.read_bytes()
    assert state.time >= STOP and state.record is not None
    assert state.steps.formulation == SCENES[name][1]


@pytest.mark.parametrize("name", SCENES)
def test_a_run_continues_from_a_state(name: str) -> None:
    """As a run that was not stopped, but for what another compiler rounds otherwise."""
    whole, later = run_of(name), run_of(name, State.load(FILES / f"{name}.state"))
    whole.advance(END)
    later.advance(END)
    assert later.start.time >= STOP
    outputs = whole.result(), later.result()
    count = outputs[1].time.size
    assert count == np.sum(outputs[0].time >= later.start.time)
    for channel in outputs[0]:
        expected = outputs[0][channel][-count:]
        if channel == "quaternion":  # q and -q are one attitude; rounding chooses
            same = np.sign(np.sum(outputs[1][channel] * expected, axis=-1, keepdims=True))
            expected = same * expected
        np.testing.assert_allclose(outputs[1][channel], expected, rtol=1e-6, atol=1e-6, err_msg=channel)


@pytest.mark.parametrize("name", ["chain.nc", "chain.nc.partial"])
def test_a_result_is_read_with_its_names(name: str) -> None:
    scene = test_restart.chain()
    result = Result.load(FILES / name)
    assert result.coords["body"] == tuple(scene.bodies)
    assert result.coords["wxyz"] == ("w", "x", "y", "z")
    assert result["quaternion"].shape == (result.time.size, len(scene.bodies), 4)
    assert result.state is not None and result.stats["seacrane_version"] == "0.1.0"


def test_a_bound_of_zero_was_an_exact_sum(tmp_path: Path) -> None:
    path = tmp_path / "older.json"
    cases.vessel().save(path)
    data = json.loads(path.read_text())
    data["waves"]["relative_bound"] = 0.0
    path.write_text(json.dumps(data))
    waves = Scene.load(path).waves
    assert waves is not None and waves.evaluation == "exact" and waves.relative_bound == 1e-9


HEAVE_OF_0_2 = [0.007208, 0.010812, 0.002182, 0.003273]
OF_0_2 = Path(__file__).with_name("files_0_2")


@pytest.mark.parametrize("name", ["words", "case2"])
def test_a_scene_of_0_2_is_read_and_saved_again(name: str, tmp_path: Path) -> None:
    scene = Scene.load(OF_0_2 / f"{name}.json")
    scene.save(tmp_path / "now.json")
    assert Scene.load(tmp_path / "now.json") == scene and scene.limit_states


def test_the_limit_states_of_a_scene_of_0_2_are_what_they_were() -> None:
    states = Scene.load(OF_0_2 / "words.json").limit_states
    assert list(states) == ["hoist is strong enough", "height", "any line"]
    assert (states["hoist is strong enough"].maximum, states["hoist is strong enough"].minimum) == (4e4, 1e3)


@pytest.mark.parametrize("name", ["words", "case2"])
def test_a_result_of_0_2_is_read_with_its_limit_states(name: str) -> None:
    result = Result.load(OF_0_2 / f"{name}.nc")
    assert result.stats["seacrane_version"] == "0.2.0" and result.scene is not None
    assert list(result.scene.limit_states) == [state.name for state in result.utilisation]
    if name == "words":
        assert result.utilisation["any line"].utilisation == pytest.approx(0.4228, abs=1e-3)
        assert [span.name for span in result.stages] == ["wait", "lift", "lower"]


def test_a_run_continues_from_a_state_of_0_2() -> None:
    scene = Scene.load(OF_0_2 / "case2.json")
    start = State.load(OF_0_2 / "case2.state", scene=scene)
    run = Run(scene, t_end=0.6, dt_out=0.1, channels=["position"], start=start)
    run.advance(0.6)
    assert start.time == pytest.approx(0.5) and run.result().time[-1] == pytest.approx(0.6)


def test_a_store_of_0_2_is_read() -> None:
    members = Ensemble.load(OF_0_2 / "pendulum.zarr").dataset
    assert members["track"].dims == ("mass", "time", "axis")
    assert np.all(np.isfinite(members["highest"].values))


def of_0_2(make: Callable[[], Any]) -> Any:
    """What is made of a file of 0.2, whose old keys are told in one warning, if it has any."""
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always", RenamedKeysWarning)
        made = make()
    assert len({str(one.message) for one in told if one.category is RenamedKeysWarning}) <= 1
    return made


def test_a_lift_of_0_2_is_the_scene_that_it_was() -> None:
    """Of the same lift with the scene that 0.2 saved from it, but for what was added by hand there."""
    scene = of_0_2(lambda: Lift.load(OF_0_2 / "lift.toml").scene())
    scene.add_limit_state(channel="line_tension", maximum=5e4, name="any line")
    older = Scene.load(OF_0_2 / "words.json")
    for one in (scene, older):  # since 0.3 a wire is made with the lines
        one.loads["sling"] = one.loads.pop("sling")
    assert scene == older


def test_the_stages_of_a_lift_of_0_2_end_when_they_did() -> None:
    result = of_0_2(lambda: Lift.load(OF_0_2 / "lift.toml").simulate())
    ends = [span.end for span in result.stages]
    np.testing.assert_allclose(ends, [0.5, 1.346747647381496, 2.8959696093170733], rtol=1e-6)


def test_a_study_of_0_2_keeps_what_it_kept(tmp_path: Path) -> None:
    assert of_0_2(lambda: main(["study", str(OF_0_2 / "study.toml"), "--out", str(tmp_path)])) == 0
    kept = Ensemble.load(tmp_path / "members").dataset
    np.testing.assert_allclose(np.ravel(kept["heave"].values), HEAVE_OF_0_2, rtol=3e-4)
    assert dict(kept["track"].sizes) == {"seed": 2, "hs": 2, "direction_deg": 1, "time": 7}
