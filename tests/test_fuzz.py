"""The readers on hostile files: the committed corpus again, a short seeded run, and the lines it reaches.

Long runs, guided by coverage: `make fuzz`.
"""

from __future__ import annotations

import random
import signal
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from fuzz.mutate import mutate_text
from fuzz.targets import TARGETS, Target, cases, quiet

SHORT_RUN = 0.4  # s of processor time for each target
LONGEST = 2.0  # s of processor time for one case
MOST_CASES = 400


@pytest.fixture
def alarm() -> Iterator[None]:
    """A case that takes longer than two seconds of processor time fails."""

    def hang(*_: Any) -> None:
        raise TimeoutError(f"a case took more than {LONGEST} s of processor time")

    before = signal.signal(signal.SIGVTALRM, hang)
    yield
    signal.setitimer(signal.ITIMER_VIRTUAL, 0.0)
    signal.signal(signal.SIGVTALRM, before)


def run(target: Target, case: bytes, folder: Path) -> str:
    signal.setitimer(signal.ITIMER_VIRTUAL, LONGEST)
    return target.run(case, folder)


def needs(target: Target) -> None:
    if target.reader == "orcaflex":
        pytest.importorskip("yaml", reason="needs the extra 'orcaflex'")


@pytest.mark.parametrize("name", TARGETS)
def test_corpus(name: str, tmp_path: Path, alarm: None) -> None:
    """Each case is read or refused by name; the seeds are read."""
    target = TARGETS[name]
    needs(target)
    target.place(tmp_path)
    found: Counter[str] = Counter()
    with quiet():
        for path in cases(target):
            found[run(target, path.read_bytes(), tmp_path)] += 1
    assert found["value"] >= 1
    assert found["no case"] == 0


@pytest.mark.parametrize("name", TARGETS)
def test_short_run(name: str, tmp_path: Path, alarm: None) -> None:
    """Seeded mutations of the corpus: the same cases each time, as many as the time allows."""
    target = TARGETS[name]
    needs(target)
    target.place(tmp_path)
    pool = [path.read_bytes() for path in cases(target)]
    generator = random.Random(name)
    mutate = target.mutate or mutate_text
    start = time.process_time()
    with quiet():
        for _ in range(MOST_CASES):
            case = mutate(generator.choice(pool), generator)
            try:
                run(target, case, tmp_path)
            except Exception:
                (tmp_path / "unsound").write_bytes(case)
                print(f"the case is in {tmp_path / 'unsound'}")
                raise
            if time.process_time() - start > SHORT_RUN:
                break


def test_the_corpus_reaches_the_readers_lines() -> None:
    """At least 90 % of the lines of every reader; prints the table."""
    pytest.importorskip("coverage", reason="needs the package 'coverage'")
    pytest.importorskip("yaml", reason="needs the extra 'orcaflex'")
    script = Path(__file__).parent / "fuzz" / "line_coverage.py"
    done = subprocess.run([sys.executable, str(script)], capture_output=True, text=True, check=False)
    print(done.stdout)
    assert done.returncode == 0, done.stdout + done.stderr[-2000:]
