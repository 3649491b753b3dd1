"""Ctrl-C returns what was recorded; the loop runs without the interpreter's lock."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from named import pendulum

from seacrane import Result, SampledController, Scene, SceneError, SimulationError, simulate

GENEROUS = 60.0  # s, far above what a return takes, far below what the run would
LONG = 1e6  # s of simulated time: hours

SETUP = """
import json, os, signal, sys, threading, time
from named import pendulum
from seacrane import SampledController, cases, simulate

def interrupt_soon():
    started.wait()
    time.sleep(0.5)  # the run is far past its compilation then, and far from its end
    os.kill(os.getpid(), signal.SIGINT)

started, more = threading.Event(), None
scene, waves = pendulum(), cases.case2()
scene.add_actuator(name="motor", joint="pin")
threading.Thread(target=interrupt_soon, daemon=True).start()
"""
REPORT = """
print(json.dumps({
    "interrupted": result.interrupted, "outputs": result.time.size, "last": float(result.time[-1]),
    "rows": len(result["position"]), "more": more,
}))
"""
RUNS = {
    "with waves": "started.set()\nresult = simulate(waves, t_end=1e6, dt_out=1.0)",
    "implicit": "started.set()\nresult = simulate(scene, t_end=1e6, dt_out=10.0, integrator='cvode-bdf')",
    "inside a controller": (
        "def tick(now, measured):\n"
        "    if now > 1.0:\n"
        "        os.kill(os.getpid(), signal.SIGINT)\n"
        "        time.sleep(10.0)\n"
        "    return {}\n"
        "tick = SampledController(period=0.05, function=tick)\n"
        "result = simulate(scene, t_end=1e6, dt_out=0.1, controllers=[tick])"
    ),
    "progress, and a run after it": (
        "started.set()\nresult = simulate(scene, t_end=1e6, dt_out=10.0, progress=True)\n"
        "after = simulate(scene, t_end=2.0)\nmore = [after.interrupted, float(after.time[-1])]"
    ),
}


@pytest.mark.parametrize("name", RUNS)
def test_ctrl_c_returns_what_was_recorded(name: str) -> None:
    command = [sys.executable, "-c", "\n".join([SETUP, RUNS[name], REPORT])]
    finished = subprocess.run(command, capture_output=True, text=True, timeout=GENEROUS, check=False)
    assert finished.returncode == 0, finished.stderr
    told = json.loads(finished.stdout.splitlines()[-1])
    assert told["interrupted"] and 0.0 < told["last"] < LONG
    assert told["outputs"] == told["rows"] > 1
    assert told["more"] in (None, [False, 2.0])


def test_an_exception_of_another_signal_is_not_taken_for_ctrl_c() -> None:
    """It carries what was recorded, and the next run is its own."""

    def alarm(number: int, frame: Any) -> None:
        raise TimeoutError("time is up")

    def soon(now: float, measured: Any) -> dict[str, float]:
        signal.setitimer(signal.ITIMER_REAL, 0.05)
        return {}

    before = signal.signal(signal.SIGALRM, alarm)
    try:
        with pytest.raises(TimeoutError) as caught:
            ticks = [SampledController(period=1e5, function=soon)]
            simulate(ball_on_a_pin(), t_end=1e6, dt_out=10.0, controllers=ticks)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)
    assert caught.value.result.interrupted
    assert not simulate(ball_on_a_pin(), t_end=1.0).interrupted


@pytest.mark.slow("a process")
def test_the_command_line_saves_what_it_has(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "seacrane", "run", "case1", "--out", str(tmp_path), "--t-end"]
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.PIPE}
    process = subprocess.Popen([*command, "1e5", "--progress"], **quiet)
    said = b""
    while b"simulated" not in said:  # the bar appears when the loop is about to start
        piece = process.stderr.read1(4096)
        assert piece, said
        said += piece
    time.sleep(0.5)
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=GENEROUS)
    assert process.returncode == 130
    result = Result.load(tmp_path / "case1.nc")
    assert result.interrupted and 0.0 < result.time[-1] < 1e5
    t_end = result.time[-1] + 20.0
    subprocess.run([*command, f"{t_end}", "--resume"], check=True, timeout=GENEROUS)
    whole = Result.load(tmp_path / "case1.nc")
    assert not whole.interrupted and whole.time[-1] == pytest.approx(t_end, rel=1e-12)
    assert np.array_equal(whole["position"][: result.time.size], result["position"])


def ball_on_a_pin() -> Scene:
    scene = Scene()
    scene.add_body(name="bob", mass=1.0, inertia=[0.1, 0.1, 0.1], position=(1.0, 0.0, 0.0))
    scene.add_joint(kind="spherical", name="pin", first="ground", second="bob", point=(0, 0, 0))
    return scene


def diverging() -> Scene:
    """A hinge on a spring that one step of rk4 cannot resolve."""
    scene = pendulum()
    scene.add_actuator(name="motor", joint="pin", stiffness=60.0)
    return scene


def after(limit: float, error: BaseException | None = None, **inputs: Any) -> SampledController:
    """Raises, or sets inputs that there are not, from a time on."""

    def function(now: float, measured: Any) -> dict[str, Any]:
        if now >= limit - 1e-9 and error is not None:
            raise error
        return inputs if now >= limit - 1e-9 else {"motor.force": 1.0}

    return SampledController(period=0.1, function=function)


ENDS: dict[str, tuple[type[Exception], dict[str, Any]]] = {
    "integration": (SimulationError, {"integrator": "rk4", "dt": 0.41}),
    "controller": (SimulationError, {"controllers": [after(1.0, KeyError("wire"))]}),
    "inputs": (SceneError, {"controllers": [after(1.0, **{"engine.force": 1.0})]}),
}


@pytest.mark.parametrize("name", ENDS)
def test_what_was_recorded_before_an_error_is_kept(name: str, tmp_path: Path) -> None:
    kind, settings = ENDS[name]
    with pytest.raises(kind) as caught:
        simulate(diverging(), t_end=1e3, **settings)
    partial = caught.value.result
    assert partial is not None and partial.interrupted
    assert 1 < partial.time.size < 9000
    assert all(np.isfinite(values).all() for values in partial.channels.values())
    assert partial.state is not None and partial.state.time >= partial.time[-1]
    again = Result.load(partial.save(tmp_path / "partial.nc"))
    assert np.array_equal(again["position"], partial["position"])
    if name != "integration":
        assert partial.state.time == pytest.approx(1.0)
        rest = simulate(diverging(), t_end=2.0, start=partial.state)
        np.testing.assert_array_equal(rest["position"][0], partial["position"][-1])
