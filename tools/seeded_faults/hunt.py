"""A tree of its own in which one fault after the other is looked for; the engine's are compiled together."""

from __future__ import annotations

import os
import re
import shlex
import shutil
import subprocess
from collections.abc import Iterator
from pathlib import Path

from seeded_faults.fault import Fault, faults
from seeded_faults.reached import commands, tests_of
from seeded_faults.switched import PRELUDE, VARIABLE, switched

ALIKE = "-p no:cacheprovider --no-header --hypothesis-seed=1"
PYTEST = f".venv/bin/python -m pytest -qx -n 2 --dist loadfile {ALIKE}"
FAILED = re.compile(r"^(?:FAILED|ERROR) (\S+)", re.MULTILINE)
PROGRAM = re.compile(r"^\s*\d+ - (\S+) \(", re.MULTILINE)
LONGEST = 3600.0  # s: a test that does not end has found it too
NEAREST, FILES = 30, 12


class Hunt:
    """A clone of the repository, built.

    Parameters
    ----------
    root : the tree whose last commit is cloned.
    home : folder of the clone, kept for the next time.
    """

    def __init__(self, root: Path, home: Path) -> None:
        self.tree = home / "tree"
        self.log, self._said, self._flags, self._awake = home / "log", "", "", ""
        if not self.tree.exists():
            home.mkdir(parents=True, exist_ok=True)
            subprocess.run(["git", "clone", "-q", root, self.tree], check=True)
            (home / "shared").symlink_to((root.parent / "shared").resolve())
        self._require("git fetch -q origin")
        self._require("git reset -q --hard origin/HEAD")
        self._numbers = self._switch(home / "seeded_fault.hpp")
        for command in (
            "make build", "make .venv/.installed-dev", "cmake --build build/package --target seacrane_tests"
        ):  # fmt: skip
            self._require(command)
        self._lines = home / "reached"

    def finder(self, fault: Fault, *, first: str = "", by_night: bool = False) -> tuple[str, str]:
        """Who finds a fault first, and the name of a test; ("nobody", "").

        The engine's own tests, the file of the test that found it another time (`first`), the tests that name
        the fault's file, the rest of the day; by night the slow ones too.
        """
        shutil.rmtree(
            self.tree / ".hypothesis", ignore_errors=True
        )  # what another fault made fail is no news
        file = self.tree / fault.file
        sound = self._sound = file.read_text(encoding="utf-8")
        if fault.in_engine:
            self._awake = str(self._numbers[fault.name])
        else:
            for command in commands(PYTEST.replace(" -qx ", " -q "), self._lines):
                self._require(command)
            file.write_text(fault.seeded(sound), encoding="utf-8")
        try:
            for who, command in self._ways(fault, first, by_night=by_night):
                if not self._succeeds(command):
                    names = FAILED.findall(self._said) or PROGRAM.findall(self._said)
                    return who, names[0] if names else ""
            return "nobody", ""
        finally:
            self._awake = ""
            if not fault.in_engine:
                file.write_text(sound, encoding="utf-8")

    def _switch(self, prelude: Path) -> dict[str, int]:
        """Put all faults of the engine into the tree, asleep; their numbers."""
        prelude.write_text(PRELUDE, encoding="utf-8")
        numbers = {fault.name: i for i, fault in enumerate(filter(lambda one: one.in_engine, faults()), 1)}
        for fault in faults():
            if fault.in_engine:
                file = self.tree / fault.file
                text = switched(file.read_text(encoding="utf-8"), fault, numbers[fault.name])
                file.write_text(text, encoding="utf-8")
        self._flags = f"-include {prelude}"
        return numbers

    def _ways(self, fault: Fault, first: str, *, by_night: bool) -> Iterator[tuple[str, str]]:
        if fault.in_engine:
            yield "engine's tests", "ctest --test-dir build/package --stop-on-failure -j 2"
        else:
            yield "compiler", "make build"
        known = sorted(
            str(path) for path in (self.tree / "tests").rglob(Path(first.partition("::")[0]).name or "-")
        )
        if known:
            yield "the same test", f"{PYTEST} {shlex.join(known)}"
        near, elsewhere = self._near(fault)
        if near:
            yield "near tests", f"{PYTEST} {shlex.join(near[:NEAREST])}"
        if near[NEAREST:]:
            yield "near tests", f"{PYTEST} {shlex.join(near[NEAREST:])}"
        if elsewhere:
            yield "other tests", PYTEST
        if by_night:
            yield "slow tests", f"{PYTEST} -m slow"

    def _near(self, fault: Fault) -> tuple[list[str], bool]:
        """Tests that reach the fault's line, and whether others may; of the engine, files after its name."""
        if not fault.in_engine:
            line = self._sound.partition(fault.old)[0].count("\n") + 1
            return tests_of(self._lines, fault.file, line)
        stem = Path(fault.file).stem
        words, scores = [word for word in stem.split("_") if len(word) > 3] or [stem], {}
        for path in (self.tree / "tests").rglob("test_*.py"):
            alike = 100 * sum(word.rstrip("s") in path.stem for word in words)
            scores[str(path.relative_to(self.tree))] = alike + path.read_text(encoding="utf-8").count(stem)
        return sorted(filter(scores.get, scores), key=lambda path: -scores[path])[:FILES], True

    def _require(self, command: str) -> None:
        if not self._succeeds(command):
            raise RuntimeError(f"{command} fails without a fault; see {self.log}")

    def _succeeds(self, command: str) -> bool:
        try:
            done = subprocess.run(
                shlex.split(command), cwd=self.tree, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT, text=True, errors="replace", timeout=LONGEST, check=False,
                env=os.environ | {"CXXFLAGS": self._flags, VARIABLE: self._awake},
            )  # fmt: skip
        except subprocess.TimeoutExpired:
            self._said = f"it did not end in {LONGEST:g} s"
            return False
        self._said = done.stdout
        self.log.write_text(f"$ {command}\n{done.stdout}", encoding="utf-8")
        return done.returncode == 0
