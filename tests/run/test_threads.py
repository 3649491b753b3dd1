"""Threads that share a run, that the interpreter's end finds in the loop, or that are silent alone."""

from __future__ import annotations

import subprocess
import sys
import threading
import warnings

import numpy as np
import pytest

from seacrane import Run, SimulationError, cases
from seacrane.inputs.caller import keeping, recorded, silently, warn_caller
from seacrane.warnings import AssemblyWarning, SteepSeaWarning

GENEROUS = 120.0  # s


def test_a_run_is_read_while_another_thread_advances_it() -> None:
    """Every reading is of one instant between two steps, and the run ends in the bits of one left alone."""
    scene = cases.case2()
    settings = {"t_end": 400.0, "dt_out": 1.0}
    alone, run = Run(scene, **settings), Run(scene, **settings)
    alone.advance(400.0)
    thread = threading.Thread(target=run.advance, args=(400.0,))
    thread.start()
    readings = 0
    while thread.is_alive():
        with run.core:
            state, measured, result = run.state, run.measure(), run.result()
        assert measured["constraint_error"] < 1e-9
        assert state.time >= result.time[-1] > state.time - 1.5
        assert result.state == state
        readings += 1
    thread.join()
    assert readings > 0
    assert np.array_equal(run.state.values, alone.state.values)
    whole = alone.result()
    for name, values in run.result().channels.items():
        assert np.array_equal(values, whole[name]), name


def test_a_run_that_is_advanced_already_says_so() -> None:
    run = Run(cases.case2(), t_end=1e6, dt_out=10.0)

    def look(now: float) -> None:
        assert run.state.time == now
        with pytest.raises(SimulationError, match="is advanced already"):
            run.advance(2e6)
        raise InterruptedError

    with pytest.raises(InterruptedError):
        run.advance(1e6, look)
    assert run.advance(run.core.time + 1.0)


EXIT = """
import threading, time
from seacrane import SampledController, cases, simulate
scene = cases.case2()
ticks = [SampledController(period=0.1, function=lambda now, measured: {})]
def work(number):
    while True:
        simulate(scene, t_end=[0.5, 1e7, 50.0][number], dt_out=0.1 if number != 1 else 1e3,
                 controllers=ticks if number else [])
for number in range(3):
    threading.Thread(target=work, args=(number,), daemon=True).start()
time.sleep(0.3)
"""


@pytest.mark.parametrize("times", [2, pytest.param(24, marks=pytest.mark.slow("many interpreters"))])
def test_the_interpreter_ends_while_threads_are_in_the_loop(times: int) -> None:
    for _ in range(times):
        command = [sys.executable, "-W", "ignore", "-c", EXIT]
        ended = subprocess.run(command, capture_output=True, text=True, timeout=GENEROUS)
        assert ended.returncode == 0, ended.stderr
        assert ended.stderr == ""


FORK = """
import os, threading, time
from seacrane import cases, simulate
threading.Thread(target=simulate, args=(cases.case2(),), kwargs={"t_end": 1e7}, daemon=True).start()
time.sleep(0.3)
child = os.fork()
if child:
    assert os.waitpid(child, 0)[1] == 0
else:
    simulate(cases.vessel(), t_end=1.0)
"""


def test_a_forked_process_does_not_wait_for_its_parents_threads() -> None:
    command = [sys.executable, "-W", "ignore", "-c", FORK]
    ended = subprocess.run(command, capture_output=True, text=True, timeout=GENEROUS)
    assert ended.returncode == 0, ended.stderr


def test_a_thread_is_silent_by_itself_alone() -> None:
    """While another thread is silent, and after it, filters are as they were."""
    inside, over = threading.Event(), threading.Event()
    before = list(warnings.filters)

    def silent() -> None:
        with silently():
            inside.set()
            over.wait()
            warn_caller("not shown", SteepSeaWarning)

    other = threading.Thread(target=silent)
    other.start()
    inside.wait()
    try:
        with pytest.warns(SteepSeaWarning, match="shown"):
            warn_caller("shown", SteepSeaWarning)
        assert list(warnings.filters) == before
    finally:
        over.set()
        other.join()


def test_one_category_is_silenced() -> None:
    """Others are shown; who listens hears both, and who repeats repeats what was aloud."""
    told: dict[str, None] = {}
    with keeping(told), recorded() as said, pytest.warns(SteepSeaWarning) as seen, silently(AssemblyWarning):
        warn_caller("moved", AssemblyWarning)
        warn_caller("breaks", SteepSeaWarning)
    assert [str(one.message) for one in seen] == ["breaks"]
    assert list(told) == ["moved", "breaks"]
    assert [(message, aloud) for message, _, aloud in said] == [("moved", False), ("breaks", True)]
