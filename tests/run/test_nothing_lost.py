"""What was written is never lost or mixed: random kills, two writers, stale states and full disks."""

from __future__ import annotations

import os
import random
import resource
import signal
import time
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import named
import numpy as np
import pytest

from seacrane import Result, Scene, simulate
from seacrane.result.stream import partial_path

SETTINGS = {"t_end": 40.0, "dt_out": 0.05}
SAMPLE, MANY = 5, 200
REFUSED, FULL = 3, 4  # how a writer ends


def pendulum(stiffness: float = 0.0) -> Scene:
    scene = named.pendulum(mass=2.0)
    scene.add_actuator(name="motor", joint="pin", stiffness=stiffness)
    return scene


@cache
def reference(stiffness: float = 0.0, t_end: float = SETTINGS["t_end"]) -> Result:
    return simulate(pendulum(stiffness), **{**SETTINGS, "t_end": t_end})


def process(work: Callable[[], object], room: int | None = None) -> int:
    """The number of a process that does this, with room for so many bytes in a file."""
    if number := os.fork():
        return number
    ends = 1
    try:
        os.dup2(os.open(os.devnull, os.O_WRONLY), 2)
        if room is not None:
            resource.setrlimit(resource.RLIMIT_FSIZE, (room, room))
        work()
        ends = 0
    except FileExistsError:
        ends = REFUSED
    except OSError as error:
        ends = FULL if "could not write" in str(error) else ends
    finally:
        os._exit(ends)


def writer(path: Path, stiffness: float = 0.0, room: int | None = None, **settings: Any) -> int:
    """The number of a process that runs a pendulum to a file."""
    given = {**SETTINGS, "checkpoint_every": 0.5, **settings}
    return process(lambda: simulate(pendulum(stiffness), to=path, **given), room)


def ended(number: int) -> int:
    """How a writer ended; -9 where it was killed."""
    return os.waitstatus_to_exitcode(os.waitpid(number, 0)[1])


def killed_somewhere(path: Path, rng: random.Random, **given: Any) -> None:
    """A writer, killed while it writes or as it ends."""
    number = writer(path, **given)
    until = time.monotonic() + 20.0
    while time.monotonic() < until and not (path.exists() or list(path.parent.glob("*.partial*"))):
        time.sleep(1e-4)
    time.sleep(rng.uniform(0.0, 0.25))
    os.kill(number, signal.SIGKILL)
    ended(number)


def is_start_of(result: Result, whole: Result) -> bool:
    """Whether a result holds the first outputs of another, bit for bit."""
    n = result.time.size
    return np.array_equal(result.time, whole.time[:n]) and all(
        np.array_equal(values, whole[name][:n]) for name, values in result.channels.items()
    )


def left_at(path: Path) -> list[Result]:
    """All that is there, read."""
    return [Result.load(one) for one in (path, partial_path(path)) if one.exists()]


def kill(seed: int, path: Path) -> None:
    """Whenever a run is killed, its outputs can be read, and it goes on as if it had not been."""
    rng = random.Random(seed)
    killed_somewhere(path, rng)
    if not left_at_once(path):
        return
    for result in left_at(path):
        assert is_start_of(result, reference())
        assert result.state is None or result.state.time >= result.time[-1]
    told = simulate(pendulum(), to=path, resume=True, **SETTINGS)
    assert told.outputs == reference().time.size
    assert is_start_of(told.load(), reference())


def left_at_once(path: Path) -> bool:
    """Whether the writer came as far as its first piece."""
    left = partial_path(path)
    return path.exists() or (left.exists() and left.stat().st_size > 100)


def two_writers(seed: int, path: Path) -> None:
    """Only one of two processes writes a file; the other is refused, whatever it runs."""
    rng = random.Random(seed)
    stiffness = [0.0, rng.choice([0.0, 5.0])]
    numbers = [writer(path, stiffness[0])]
    time.sleep(rng.uniform(0.0, 0.1))
    numbers.append(writer(path, stiffness[1]))
    ends = [ended(number) for number in numbers]
    assert set(ends) <= {0, REFUSED}
    assert 0 in ends
    if stiffness[0] != stiffness[1]:
        assert REFUSED in ends
    written = [one for one, end in zip(stiffness, ends, strict=True) if end == 0]
    result = Result.load(path)
    assert result.time.size == reference().time.size
    assert any(is_start_of(result, reference(one)) for one in written)
    assert not partial_path(path).exists()


def stale(seed: int, path: Path) -> None:
    """Several scenes and settings under one name, some killed, some resumed: each is whole or refused."""
    rng = random.Random(seed)
    for _ in range(4):
        stiffness, t_end = rng.choice([0.0, 5.0]), rng.choice([20.0, SETTINGS["t_end"]])
        killed = rng.random() < 0.4
        before, whole = contents(path), reference(stiffness, t_end)
        if killed:
            killed_somewhere(path, rng, stiffness=stiffness, t_end=t_end)
            if contents(path).get(path.name) != before.get(path.name):  # it had reached its end
                assert is_start_of(Result.load(path), whole)
                assert Result.load(path).time.size == whole.time.size
            continue
        resume, overwrite = rng.random() < 0.5, rng.random() < 0.3
        given = {"resume": resume, "overwrite": overwrite, **SETTINGS, "t_end": t_end}
        try:
            told = simulate(pendulum(stiffness), to=path, **given)
        except (OSError, ValueError):
            assert contents(path) == before
            continue
        result = told.load()
        assert result.time.size == told.outputs
        assert np.diff(result.time).max() < 1.5 * SETTINGS["dt_out"]
        assert result.time[-1] == t_end
        # Where a finished run went on to a later end, it landed on its first one.
        np.testing.assert_allclose(result["position"], whole["position"], atol=1e-3)


def contents(path: Path) -> dict[str, bytes]:
    """What holds outputs: no draft, and no file of a run that was killed before its first piece."""
    found = {one.name: one.read_bytes() for one in path.parent.iterdir() if not one.name.endswith(".tmp")}
    return {name: data for name, data in found.items() if name == path.name or len(data) > 100}


def full_disk(seed: int, path: Path) -> None:
    """Where room ends, what had room can be read, and the run goes on when there is more."""
    room = random.Random(seed).randrange(0, 900_000)
    assert ended(writer(path, room=room)) in (0, FULL)
    whole_there = left_at_once(path)
    for result in left_at(path) if whole_there else []:
        assert is_start_of(result, reference()) and result.state is not None
    told = simulate(pendulum(), to=path, resume=whole_there, **SETTINGS)
    assert is_start_of(told.load(), reference())
    assert [one.name for one in path.parent.iterdir()] == [path.name]


def test_a_result_that_finds_no_room_leaves_the_older_file(tmp_path: Path) -> None:
    path = tmp_path / "run.nc"
    path.write_text("an older file", encoding="utf-8")
    whole = reference()
    assert ended(process(lambda: whole.save(path), room=20_000)) == FULL
    assert path.read_text(encoding="utf-8") == "an older file" and list(tmp_path.iterdir()) == [path]


CHECKS = {check.__name__: check for check in (kill, two_writers, stale, full_disk)}


@pytest.mark.parametrize(
    "seeds",
    [range(SAMPLE), pytest.param(range(SAMPLE, SAMPLE + MANY), marks=pytest.mark.slow("many kills"))],
    ids=["sample", "many"],
)
@pytest.mark.parametrize("name", CHECKS)
def test_whatever_happens_to_a_file_it_is_whole_and_unmixed(name: str, seeds: range, tmp_path: Path) -> None:
    reference()
    for seed in seeds:
        (tmp_path / str(seed)).mkdir()
        CHECKS[name](seed, tmp_path / str(seed) / "run.nc")
