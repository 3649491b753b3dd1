"""State files: runs go on in a new process bit for bit; what is damaged or of another scene is refused."""

from __future__ import annotations

import os
import pickle
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from test_restart import SCENES

from seacrane import FileFormatError, Result, Run, Scene, SceneError, State, _core, cases, simulate
from seacrane.arrays import Array

# Assembly makes consistent what some scenes describe roughly, on purpose.
pytestmark = pytest.mark.filterwarnings("ignore::seacrane.warnings.AssemblyWarning")

STOP, END = 0.43, 0.9
CHANNELS = ["position", "quaternion", "energy_balance", "constraint_error_before_projection"]
STEPS = {1: 1e-3, 2: 5e-3, 4: 0.02}  # s, by order


def scenes(name: str) -> Scene:
    return cases.case2(memory="convolution") if name == "convolution" else SCENES[name]()


def all_runs() -> list[tuple[str, str, str]]:
    """Scene, integrator, formulation."""
    out = []
    for method in _core.integrators():
        for formulation in ["redundant", *(["recursive"] if not method.residual_form else [])]:
            out.append(("chain", method.name, formulation))
            out.append(("crank", method.name, formulation))
    for integrator in ("dopri5", "rk4"):
        for formulation in ("redundant", "recursive"):
            out += [(scene, integrator, formulation) for scene in ("case2", "convolution")]
    return out


def begin(one: tuple[str, str, str], start: State | None = None) -> Run:
    name, integrator, formulation = one
    method = _core.integrator(integrator)
    settings = {"dt": STEPS[method.order]} if method.setting == "dt" else {}
    settings |= {"integrator": integrator, "formulation": formulation, "rtol": 1e-7, "channels": CHANNELS}
    return Run(scenes(name), t_end=END, dt_out=0.1, start=start, outputs_from=0.0, **settings)


def told(run: Run) -> dict[str, Array]:
    """Where a run stands, and what it has recorded from the checkpoint on."""
    recorded = run.core.channels()
    late = recorded["time"] > STOP
    return {"end": np.array(run.state.values)} | {name: values[late] for name, values in recorded.items()}


def go_on(folder: str) -> None:
    """What the new process does."""
    for path in Path(folder).glob("*.state"):
        run = begin(tuple(path.stem.split("!")), State.load(path))
        run.advance(END)
        np.savez(path.with_suffix(".npz"), **told(run))


def test_a_run_goes_on_in_a_new_process_bit_for_bit(tmp_path: Path) -> None:
    """Own methods as if never stopped, those of SUNDIALS as a run that restarts them at the same time."""
    runs = {}
    for one in all_runs():
        run = begin(one)
        run.advance(STOP)
        run.state.save(tmp_path / f"{'!'.join(one)}.state")
        method = _core.integrator(one[1])
        if method.restarts and not method.residual_form:  # by a reset of the solver
            run.set_inputs({})
        elif method.restarts:  # by a solver made anew
            run = begin(one, run.state)
        run.advance(END)
        runs[one] = told(run)
    code = f"import test_state_file as t; t.go_on({str(tmp_path)!r})"
    subprocess.run([sys.executable, "-c", code], check=True, cwd=Path(__file__).parent)
    for one, whole in runs.items():
        later = np.load(tmp_path / f"{'!'.join(one)}.npz")
        for name, values in whole.items():
            assert np.array_equal(later[name], values), (one, name)
        assert len(whole["time"]) == 5


class _Stop(Exception):
    pass


SLOW = pytest.param({"integrator": "rk4", "dt": 1e-3}, marks=pytest.mark.slow("thousands of steps"))


@pytest.mark.parametrize("method", [{"rtol": 1e-11}, SLOW])
def test_a_run_stopped_at_any_step_goes_on(method: Any, formulation: str, tmp_path: Any) -> None:
    """Nothing lands on the checkpoint; long enough for the loop to ask on any machine."""
    scene = cases.case2()
    settings = {"t_end": 60.0, "formulation": formulation, "outputs_from": 0.0, **method}
    whole, stopped = Run(scene, **settings), Run(scene, **settings)
    whole.advance(60.0)

    def stop(now: float) -> None:
        raise _Stop

    with pytest.raises(_Stop):
        stopped.advance(60.0, stop)
    stopped.state.save(tmp_path / "state")
    later = Run(scene, start=State.load(tmp_path / "state", scene=scene), **settings)
    assert 0.0 < later.state.time < 60.0
    later.advance(60.0)
    assert np.array_equal(later.state.values, whole.state.values)
    first, second, all_of_it = stopped.result(), later.result(), whole.result()
    for name in all_of_it.channels:
        joined = np.concatenate([first[name], second[name]])
        np.testing.assert_array_equal(joined, all_of_it[name], err_msg=name)


@pytest.fixture
def saved(tmp_path: Path) -> Path:
    run = Run(cases.case2(memory="convolution"), t_end=1.0)
    run.advance(0.5)
    run.state.save(tmp_path / "run.state")
    return tmp_path / "run.state"


def test_damaged_files_are_refused_by_name(saved: Path) -> None:
    data = saved.read_bytes()
    cut = [data[:n] for n in (0, 5, 20, 200, len(data) // 2, len(data) - 1)]
    flipped = [bytes([*data[:n], data[n] ^ 1, *data[n + 1 :]]) for n in (3, 30, 500, len(data) - 40)]
    for damaged in [*cut, *flipped, data + b"\0", b"\x89HDF\r\n"]:
        saved.write_bytes(damaged)
        with pytest.raises(FileFormatError, match=r"run\.state: .*; (give|go on from|save)") as caught:
            State.load(saved)
        assert str(saved) in str(caught.value)


def test_a_state_of_another_scene_is_refused(saved: Path) -> None:
    other = cases.case2()
    with pytest.raises(FileFormatError, match=r"run\.state: .*memory of 0 .*memory of \d+"):
        State.load(saved, scene=other)
    for scene, words in ((other, "another scene: .*memory of 0"), (SCENES["chain"](), "'vessel'.* 'body 0'")):
        with pytest.raises(SceneError, match=words):
            simulate(scene, t_end=1.0, start=State.load(saved))


def test_a_state_does_not_replace_a_result(saved: Path, tmp_path: Path) -> None:
    result = simulate(SCENES["chain"](), t_end=0.5)
    path = result.save(tmp_path / "chain.nc")
    with pytest.raises(FileExistsError, match=r"chain\.nc is there and is not a state file"):
        result.state.save(path)
    assert Result.load(path).time.size == result.time.size
    result.state.save(saved)
    assert State.load(saved) == result.state


def test_devices_and_protected_files_are_not_replaced_and_links_are_followed(tmp_path: Path) -> None:
    state = Run(SCENES["chain"](), t_end=1.0).state
    with pytest.raises(OSError, match="is a device"):
        state.save(os.devnull)
    path, link = tmp_path / "a.state", tmp_path / "link.state"
    link.symlink_to(path)
    state.save(link)
    assert link.is_symlink() and State.load(path) == state
    path.chmod(0o444)
    with pytest.raises(OSError, match="is write-protected"):
        state.save(path)


def test_the_kink_at_which_a_step_is_to_end_is_kept(tmp_path: Path) -> None:
    run = begin(("crank", "dopri5", "recursive"))
    run.advance(STOP)
    state, names = run.state, ("formulation", "integrator", "values", "rate")
    steps = _core.StepHistory(**{name: getattr(state.steps, name) for name in names}, kink=0.75)
    names = ("time", "values", "inputs", "record", "parts")
    left = State(**{name: getattr(state, name) for name in names}, steps=steps)
    left.save(tmp_path / "run.state")
    assert State.load(tmp_path / "run.state") == left
    assert pickle.loads(pickle.dumps(left)) == left and left.steps.kink == 0.75
