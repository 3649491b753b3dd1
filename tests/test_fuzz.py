"""The readers on hostile files: the committed corpus again, a short seeded run, and the lines it reaches.

Long runs, guided by coverage: `make fuzz`.
"""

from __future__ import annotations

import random
import subprocess
import sys
import time
from collections import Counter
from pathlib import Path

import pytest
from fuzz.limits import Hang
from fuzz.mutate import mutate_text
from fuzz.targets import TARGETS, Target, cases, quiet

SHORT_RUN = 0.4  # s of processor time for each target
MOST_CASES = 400


def needs(target: Target) -> None:
    if target.reader == "orcaflex":
        pytest.importorskip("yaml", reason="needs the extra 'orcaflex'")


@pytest.mark.parametrize("name", TARGETS)
def test_corpus(name: str, tmp_path: Path) -> None:
    """Each case is read or refused by name; the seeds are read."""
    target = TARGETS[name]
    needs(target)
    target.place(tmp_path)
    found: Counter[str] = Counter()
    with quiet():
        for path in cases(target):
            found[target.run(path.read_bytes(), tmp_path)] += 1
    assert found["value"] >= 1
    assert found["no case"] == 0


@pytest.mark.parametrize("name", TARGETS)
def test_short_run(name: str, tmp_path: Path) -> None:
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
                target.run(case, tmp_path)
            except (Exception, Hang):
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
