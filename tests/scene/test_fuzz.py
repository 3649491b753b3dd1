"""The readers on hostile files: the committed corpus again, damage and its answers, files without their end,
a short seeded run, and the lines that all these reach.

Long runs, guided by coverage: `make fuzz`.
"""

from __future__ import annotations

import random
import re
import subprocess
import sys
import time
import warnings
from collections import Counter
from pathlib import Path

import pytest
from fuzz.damage import Damage, damages, sound_case
from fuzz.grow import grown
from fuzz.limits import Hang
from fuzz.mutate import mutate_text
from fuzz.targets import TARGETS, Target, cases, quiet
from where import at

from seacrane.errors import FileFormatError
from seacrane.warnings import PartialSetWarning

SHORT_RUN = 0.4  # s of processor time for each target
MOST_CASES = 400
LARGE = 100_000  # bytes
TABLES = "re7 re8 re1 re2", "1 3 4 hst frc out"  # files of VERES and WAMIT that have to be whole
WHOLE = [
    f"{name}-{kind}" for name, kinds in zip(("veres", "wamit"), TABLES, strict=True) for kind in kinds.split()
]
OTHER_DAMPING = 3  # last lines of the OrcaFlex model, which it may lack


def placed(name: str, folder: Path) -> Target:
    target = TARGETS[name]
    if target.reader == "orcaflex":
        pytest.importorskip("yaml", reason="needs the extra 'orcaflex'")
    target.place(folder)
    return target


@pytest.mark.parametrize("name", TARGETS)
def test_corpus(name: str, tmp_path: Path) -> None:
    """Each case is read or refused by name; the seeds are read."""
    target, found = placed(name, tmp_path), Counter[str]()
    with quiet():
        for path in cases(target):
            found[target.run(path.read_bytes(), tmp_path)] += 1
    place = at("tests/fuzz/targets.py", "TARGETS = ")
    assert found["value"], f"{place}: no seed in tests/fuzz/corpus/{name} is read; add one of its own program"
    assert found["no case"] == 0


@pytest.mark.parametrize("damage", damages(), ids=lambda damage: damage.target)
def test_damage_is_answered(damage: Damage, tmp_path: Path) -> None:
    target = placed(damage.target, tmp_path)
    (tmp_path / target.file).write_bytes(damage.case())
    with quiet(), pytest.raises(FileFormatError, match=damage.answer) as caught:
        target.read(tmp_path / target.file)
    assert Path(target.file).stem in str(caught.value)


@pytest.mark.parametrize("name", [*WHOLE, "orcaflex-text"])
def test_every_truncation_is_noticed(name: str, tmp_path: Path) -> None:
    """Refused with the file and the line, or, where only whole frequencies are gone, read with a warning."""
    target = placed(name, tmp_path)
    lines = sound_case(name).splitlines(keepends=True)
    place = re.escape(target.file) + (r", line \d+" if name in WHOLE else "")
    for kept in range(len(lines) - (0 if name in WHOLE else OTHER_DAMPING)):
        (tmp_path / target.file).write_bytes(b"".join(lines[:kept]))
        with warnings.catch_warnings(record=True, action="always") as caught:
            try:
                target.read(tmp_path / target.file)
            except FileFormatError as error:
                assert re.search(place, str(error)), str(error)
            else:
                assert PartialSetWarning in {warning.category for warning in caught}, kept


@pytest.mark.parametrize("name", TARGETS)
def test_short_run(name: str, tmp_path: Path) -> None:
    """Seeded mutations of the corpus, the same each time, as many as the time allows."""
    target, generator = placed(name, tmp_path), random.Random(name)
    pool = [path.read_bytes() for path in cases(target)] + [damage.case() for damage in damages(name)]
    mutate, start = target.mutate or mutate_text, time.process_time()
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


@pytest.mark.parametrize("name", [name for name, target in TARGETS.items() if not target.netcdf])
def test_cost_of_files_made_large(name: str, tmp_path: Path) -> None:
    """One line, word or run of blanks repeated: no more time and memory per byte than the limits."""
    target, generator = placed(name, tmp_path), random.Random(name)
    pool = [path.read_bytes() for path in cases(target)]
    with quiet():
        for _ in range(6):
            target.run(grown(generator.choice(pool), LARGE, generator), tmp_path)


@pytest.mark.slow("counts lines of readers")
def test_the_corpus_reaches_the_readers_lines() -> None:
    """At least 90 % of the lines of every reader; prints the table."""
    pytest.importorskip("coverage", reason="needs the package 'coverage'")
    pytest.importorskip("yaml", reason="needs the extra 'orcaflex'")
    script = Path(__file__).parents[2] / "tools" / "fuzzing" / "line_coverage.py"
    done = subprocess.run([sys.executable, str(script)], capture_output=True, text=True, check=False)
    print(done.stdout)
    assert done.returncode == 0, done.stdout + done.stderr[-2000:]
