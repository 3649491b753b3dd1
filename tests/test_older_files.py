"""States and results that seacrane 0.1.0 wrote are read, and runs continue from them."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import event_scenes
import numpy as np
import pytest
import test_restart

from seacrane import Result, Run, Scene, State, cases
from seacrane.files.state import state_to_bytes

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
