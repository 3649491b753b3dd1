"""Runs that are written to a file as they go: the same numbers, bounded memory, nothing lost at a stop."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from event_scenes import ball

import seacrane as sc
from seacrane import cases
from seacrane.result import stream
from seacrane.result.partial_file import PartialFile, Piece
from seacrane.run import to_file
from seacrane.warnings import LargeHeelWarning

GENEROUS = 60.0  # s


@pytest.fixture(autouse=True)
def small_pieces(monkeypatch: Any) -> None:
    for module in (stream, to_file):
        monkeypatch.setattr(module, "rows_of_piece", lambda width: 16)


def spinner() -> sc.Scene:
    """A crane's slew joint that turns round and round, with a motor."""
    scene = sc.Scene(name="spinner", gravity=0.0)
    scene.add_body(name="king", mass=1.0, inertia=(1.0, 1.0, 1.0), angular_velocity=(0.0, 0.0, 3.0))
    scene.add_joint(kind="revolute", name="A", first="ground", second="king", point=(0.0, 0.0, 0.0))
    scene.add_channel(joint="A")
    scene.add_actuator(name="motor", joint="A", damping=0.01)
    scene.add_roles(slew="A")
    return scene


def same(one: sc.Result, two: sc.Result) -> None:
    assert set(one.channels) == set(two.channels)
    assert np.array_equal(one.time, two.time)
    for name, values in one.channels.items():
        if name == "slew_angle":  # turns are added to the pieces, to rounding
            np.testing.assert_allclose(values, two[name], rtol=1e-14)
        else:
            assert np.array_equal(values, two[name]), name
    assert one.coords == two.coords
    assert one.events == two.events


def stopping_after(pieces: int, monkeypatch: Any, error: type[BaseException] | None = None) -> None:
    """Ctrl-C, or an error, while a piece is on its way to the disk."""
    append = stream.ResultFile.append
    done = []

    def counted(file: stream.ResultFile, piece: Piece) -> None:
        done.append(piece)
        if len(done) == pieces:
            if error is not None:
                raise error
            signal.raise_signal(signal.SIGINT)
        append(file, piece)

    monkeypatch.setattr(stream.ResultFile, "append", counted)


@pytest.mark.parametrize("outputs", [1, 16, 17, 200])
def test_a_file_holds_what_simulate_returns(outputs: int, tmp_path: Path) -> None:
    settings = {"t_end": 0.1 * (outputs - 1), "dt_out": 0.1}
    told = sc.simulate(cases.case2(), to=tmp_path / "run.nc", **settings)
    assert (told.outputs, told.interrupted) == (outputs, False)
    whole, read = sc.simulate(cases.case2(), **settings), told.load()
    same(whole, read)
    assert not read.interrupted and read.state == whole.state
    for name in set(whole.stats) - {"wall_s"}:
        assert whole.stats[name] == read.stats[name] == told.stats[name]
    assert [p.name for p in tmp_path.iterdir()] == ["run.nc"]


@pytest.mark.warns("FullTurnWarning")
@pytest.mark.slow("long runs")
def test_whole_turns_go_on_from_piece_to_piece_and_over_a_stop(tmp_path: Path) -> None:
    whole = sc.simulate(spinner(), t_end=4000.0, dt_out=0.2)
    assert whole["slew_angle"][-1] > 250.0
    for t_end in (2000.0, 4000.0):
        path, resume = tmp_path / "run.nc", t_end > 3000.0
        told = sc.simulate(spinner(), to=path, t_end=t_end, dt_out=0.2, resume=resume)
    np.testing.assert_allclose(told.load()["slew_angle"], whole["slew_angle"], atol=1e-3)


@pytest.mark.warns("LargeSwingWarning")
@pytest.mark.parametrize("memory", ["per-pair", "convolution"])
@pytest.mark.slow("long runs")
def test_a_stopped_run_goes_on_to_the_same_file(memory: str, tmp_path: Path, monkeypatch: Any) -> None:
    scene = cases.case2(memory=memory)
    # Long enough for the loop to ask Python several times, also on a machine ten times as fast.
    settings = {"t_end": 300.0, "dt_out": 0.1, "rtol": 1e-11}
    for pieces in (2, 3):
        with monkeypatch.context() as patch:
            stopping_after(pieces, patch)
            told = sc.simulate(scene, to=tmp_path / "run.nc", resume=pieces > 2, **settings)
        assert told.interrupted and told.load().interrupted
        assert 0 < told.load().time.size < 3001
    whole = sc.simulate(scene, **settings)
    rest = sc.simulate(scene, to=tmp_path / "run.nc", resume=True, **settings)
    assert not rest.interrupted
    same(whole, rest.load())
    assert rest.load().stats["simulated_s"] == pytest.approx(300.0)
    assert rest.load().stats["steps"] == whole.stats["steps"]


def test_events_are_in_the_file_and_go_on_after_a_stop(tmp_path: Path) -> None:
    """A ball that bounces 16 times; the run stops in the air, and once more when the ball lies still."""
    scene, path = ball(restitution=0.9), tmp_path / "run.nc"
    whole = sc.simulate(scene, t_end=20.0)
    assert len(whole.events) > 10
    for t_end in (3.0, 15.0, 20.0):
        told = sc.simulate(scene, to=path, t_end=t_end, resume=t_end > 3.0)
    joined = told.load()
    assert joined.stats["events"] == len(joined.events)
    assert [event.kind for event in joined.events] == [event.kind for event in whole.events]
    times = ([event.time for event in run.events] for run in (joined, whole))
    np.testing.assert_allclose(*times, atol=1e-5)
    np.testing.assert_allclose(joined["impact_loss"], whole["impact_loss"], atol=1e-3)
    np.testing.assert_allclose(joined["energy_balance"], 0.0, atol=1e-3)


@pytest.mark.warns(sometimes=["LargeSwingWarning"])  # runs go as far as the machine brings them
def test_a_write_that_fails_once_is_made_up_for_at_the_end(tmp_path: Path, monkeypatch: Any) -> None:
    stopping_after(3, monkeypatch, MemoryError)
    with pytest.raises(sc.SimulationError, match="memory ran out"):
        sc.simulate(cases.case2(), to=tmp_path / "run.nc", t_end=10000.0, dt_out=0.5)
    partial = sc.Result.load(tmp_path / "run.nc")
    same_piece = sc.simulate(cases.case2(), t_end=float(partial.time[-1]), dt_out=0.5)
    assert partial.time.size > 32  # the output at the start, and two pieces of at least 16
    assert np.array_equal(partial["position"][:-2], same_piece["position"][:-2])


def test_ctrl_c_while_a_piece_is_written_waits_for_it(tmp_path: Path, monkeypatch: Any) -> None:
    """Pressed before and after every write of it, and while the result's file is made."""
    append, finish, seen = PartialFile.append, stream.ResultFile.finish, []

    def pressed(file: PartialFile, piece: Piece) -> None:
        seen.append(piece)
        signal.raise_signal(signal.SIGINT)
        append(file, piece)
        signal.raise_signal(signal.SIGINT)

    def pressed_again(file: stream.ResultFile, *, reached_end: bool) -> Path:
        signal.raise_signal(signal.SIGINT)
        return finish(file, reached_end=reached_end)

    monkeypatch.setattr(PartialFile, "append", pressed)
    monkeypatch.setattr(stream.ResultFile, "finish", pressed_again)
    told = sc.simulate(spinner(), to=tmp_path / "run.nc", t_end=100000.0, dt_out=1.0)
    assert told.interrupted
    assert told.outputs == told.load().time.size == sum(piece.outputs for piece in seen) >= 1
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


@pytest.mark.parametrize("cut", [1, 18, 103, 188])
def test_a_record_that_was_broken_off_does_not_count(cut: int, tmp_path: Path) -> None:
    left = left_behind(tmp_path)
    whole, data = sc.Result.load(left), left.read_bytes()
    for room in (b"", bytes(cut)):  # also room that was given and not filled
        left.write_bytes(data[:-cut] + room)
        partial = sc.Result.load(left)
        assert 0 < partial.time.size < whole.time.size
        assert partial.interrupted and partial.state is not None
        assert partial.time[-1] <= partial.state.time < whole.time[-1]
        assert np.array_equal(partial["velocity"], whole["velocity"][: partial.time.size])
    with pytest.raises(FileExistsError, match=r"run\.nc\.partial .*resume=True"):
        sc.simulate(spinner(), to=tmp_path / "run.nc", t_end=20.0)


def left_behind(folder: Path) -> Path:
    """What a killed run of the spinner leaves."""
    code = (
        "import os, sys\nfrom test_streaming import sc, spinner\n"
        "def look(now, measured):\n    if now > 9.0:\n        os._exit(1)\n    return {}\n"
        "sc.simulate(spinner(), 20.0, to=sys.argv[1], checkpoint_every=1.0,"
        " controllers=[sc.SampledController(period=0.5, function=look)])"
    )
    subprocess.run([sys.executable, "-c", code, str(folder / "run.nc")], check=False)
    return stream.partial_path(folder / "run.nc")


@pytest.mark.warns("FullTurnWarning")
def test_two_runs_of_one_process_do_not_write_one_file(tmp_path: Path) -> None:
    def second(now: float, measured: Any) -> dict[str, float]:
        with pytest.raises(FileExistsError, match=r"run\.nc\.partial is being written by another run"):
            sc.simulate(spinner(), to=tmp_path / "run.nc", t_end=1.0, overwrite=True)
        return {}

    ticks = [sc.SampledController(period=5.0, function=second)]
    assert sc.simulate(spinner(), to=tmp_path / "run.nc", t_end=10.0, controllers=ticks).outputs == 101


RESUME = {"resume": True, "t_end": 3.0}
TICKS = [sc.SampledController(period=1.0, function=lambda now, measured: {})]
OTHERS: list[tuple[dict[str, Any], type[Exception], str]] = [
    ({"t_end": 1.0}, FileExistsError, "t_end 2.0, this run 1.0"),
    ({"rtol": 1e-8}, FileExistsError, "rtol 1e-06, this run 1e-08"),
    ({"channels": ["velocity"]}, FileExistsError, "channels"),
    ({"controllers": TICKS}, FileExistsError, "controllers"),
    ({"scene": cases.case2}, FileExistsError, "another scene"),
    ({**RESUME, "rtol": 1e-3}, sc.FileFormatError, "rtol 1e-06, this run 0.001"),
    ({**RESUME, "channels": ["velocity"]}, sc.FileFormatError, "channels"),
    ({**RESUME, "scene": cases.case2}, sc.FileFormatError, r"run\.nc is of another scene"),
    ({**RESUME, "t_end": 1.0}, sc.SceneError, "before the start"),
]


@pytest.mark.warns("FullTurnWarning")
def test_only_the_same_run_replaces_a_result_unasked(tmp_path: Path) -> None:
    """Nor does another go on with it: it is refused and leaves the file alone."""
    path = tmp_path / "run.nc"
    sc.simulate(spinner(), to=path, t_end=2.0)
    before = path.read_bytes()
    for change, kind, words in OTHERS:
        given = {"t_end": 2.0, **change}
        scene = given.pop("scene", spinner)()
        with pytest.raises(kind, match=words):
            sc.simulate(scene, to=path, **given)
        assert path.read_bytes() == before and [p.name for p in tmp_path.iterdir()] == ["run.nc"], words
    for given in ({}, {"t_end": 3.0}, {"t_end": 1.0, "overwrite": True}):  # the same, a later end, asked
        given = {"t_end": 2.0, **given}
        assert sc.simulate(spinner(), to=path, **given).load().time[-1] == given["t_end"]
    path.write_text("a letter")
    for given in ({}, {"resume": True}):
        with pytest.raises((FileExistsError, sc.FileFormatError), match=r"is there and|is not a result"):
            sc.simulate(spinner(), to=path, t_end=2.0, **given)
    sc.simulate(spinner(), t_end=1.0).save(path)
    with pytest.raises(FileExistsError, match="is there and"):
        sc.simulate(spinner(), to=path, t_end=2.0)


@pytest.mark.warns("FullTurnWarning")
def test_a_run_that_stops_early_leaves_an_older_result_alone(tmp_path: Path) -> None:
    path = tmp_path / "run.nc"
    sc.simulate(spinner(), to=path, t_end=20.0)
    before = path.read_bytes()

    def fail(now: float, measured: Any) -> dict[str, float]:
        if now > 5.0:
            raise KeyboardInterrupt
        return {}

    ticks = [sc.SampledController(period=0.5, function=fail)]
    told = sc.simulate(spinner(), to=path, t_end=20.0, controllers=ticks, overwrite=True)
    assert told.interrupted
    assert path.read_bytes() == before
    assert told.path == stream.partial_path(path)
    assert told.load().time[-1] == pytest.approx(5.5)
    told = sc.simulate(spinner(), to=path, t_end=20.0, resume=True)
    assert told.load().time.size == 201
    assert [p.name for p in tmp_path.iterdir()] == ["run.nc"]


MEMORY = """
import re, sys
from pathlib import Path
from seacrane import cases, simulate
path = Path(sys.argv[1]) / "run.nc"
peak = []
for dt_out in (0.02, 0.005):
    simulate(cases.case2(), 400.0, to=path, dt_out=dt_out, overwrite=True)
    status = Path("/proc/self/status").read_text()  # getrusage would count what the parent once had
    peak.append(int(re.search(r"VmHWM:\\s+([0-9]+) kB", status)[1]))
print(peak[1] - peak[0])
"""


@pytest.mark.slow("long files")
def test_memory_does_not_grow_with_the_outputs(tmp_path: Path) -> None:
    """60,000 outputs more of 2 kB are 120 MB."""
    run = subprocess.run([sys.executable, "-c", MEMORY, str(tmp_path)], capture_output=True, text=True,
                         check=True, timeout=GENEROUS)  # fmt: skip
    assert os.path.getsize(tmp_path / "run.nc") > 1e7
    assert float(run.stdout) < 25e3  # kB


@pytest.mark.warns("MeanHeadingWarning", "MeanPositionWarning", "SteepSeaWarning")
def test_a_file_tells_what_left_the_range_of_its_models(tmp_path: Path) -> None:
    """Once for the run, however many pieces it has, and of what was before a stop too."""
    scene, settings = cases.vessel(hs=24.0), {"dt_out": 0.01, "channels": ["vessel_motion"]}
    with pytest.warns(LargeHeelWarning) as caught:
        told = sc.simulate(scene, to=tmp_path / "storm.nc", t_end=100.0, **settings)
    assert len([w for w in caught if w.category is LargeHeelWarning]) <= 2  # roll, pitch
    assert told.load().stats["validity"] == told.stats["validity"]
    sc.simulate(scene, to=tmp_path / "storm.nc", t_end=101.0, resume=True, **settings)
    assert told.load().stats["validity"].startswith(told.stats["validity"])


@pytest.mark.parametrize(
    "word",
    [
        {"first": "lift"}, {"resume": True}, {"overwrite": True}, {"checkpoint_every": 1.0}, {"to": [1.0]},
        {"stages": [sc.Stage(name="lift", duration=1.0)]},
    ],
)  # fmt: skip
def test_words_that_a_run_has_no_use_for_are_refused(word: dict[str, Any]) -> None:
    with pytest.raises(sc.SceneError, match=next(iter(word))):
        sc.simulate(spinner(), 1.0, **word)
