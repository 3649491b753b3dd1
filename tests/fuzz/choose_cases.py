"""Adds to the corpus what reaches more lines: choose_cases.py SECONDS [TARGET ...] [--from FOLDER of a run].

Cases come from a run's grown corpus, else from seeded mutations for that many seconds of processor time.
"""

from __future__ import annotations

import argparse
import hashlib
import random
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from types import FrameType
from typing import Any

sys.path.extend(map(str, Path(__file__).resolve().parents[1].glob("*/")))
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

import seacrane
from fuzz.mutate import mutate_text
from fuzz.targets import CORPUS, TARGETS, Target, cases, quiet

PACKAGE = Path(seacrane.__file__).parent
LARGEST = 16_000  # bytes of a case that is kept


class Lines:
    """Lines that a call reaches in some files."""

    def __init__(self, modules: tuple[str, ...]) -> None:
        self.files = {str(PACKAGE / module) for module in modules}
        self.reached: set[tuple[str, int]] = set()

    def __enter__(self) -> Lines:
        sys.settrace(self._call)
        return self

    def __exit__(self, *_: Any) -> None:
        sys.settrace(None)

    def _call(self, frame: FrameType, _event: str, _argument: Any) -> Any:
        return self._line if frame.f_code.co_filename in self.files else None

    def _line(self, frame: FrameType, event: str, _argument: Any) -> Any:
        if event == "line":
            self.reached.add((frame.f_code.co_filename, frame.f_lineno))
        return self._line


def main() -> None:
    """Targets one after another; those of one reader share what is reached."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("seconds", type=float)
    parser.add_argument("targets", nargs="*")
    parser.add_argument("--from", dest="run", type=Path)
    options = parser.parse_args()
    reached: dict[str, set[tuple[str, int]]] = {}
    for target in TARGETS.values():  # what is there already
        reached.setdefault(target.reader, set()).update(*_each(target, iter(_bytes(target))))
    for name in options.targets or list(TARGETS):
        target = TARGETS[name]
        source = _grown(target, options.run) if options.run else _mutated(target, options.seconds)
        _extend(target, source, reached[target.reader])


def _bytes(target: Target) -> list[bytes]:
    return [path.read_bytes() for path in cases(target)]


def _grown(target: Target, run: Path) -> Iterator[bytes]:
    yield from sorted((path.read_bytes() for path in (run / target.name / "corpus").glob("*")), key=len)


def _mutated(target: Target, seconds: float) -> Iterator[bytes]:
    generator, end = random.Random(target.name + "corpus"), time.process_time() + seconds
    mutate, pool = target.mutate or mutate_text, _bytes(target)
    while time.process_time() < end:
        yield mutate(generator.choice(pool), generator)


def _each(target: Target, source: Iterator[bytes]) -> Iterator[set[tuple[str, int]]]:
    with quiet(), tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        target.place(folder)
        for case in source:
            lines = Lines(target.modules)
            try:
                with lines:
                    answer = target.run(case, folder)
            except Exception as error:
                print(f"{target.name}: {type(error).__name__}: {str(error)[:200]}", flush=True)
                answer = "unsound"
            yield lines.reached if answer in ("value", "refused") else set()


def _extend(target: Target, source: Iterator[bytes], reached: set[tuple[str, int]]) -> None:
    held: list[bytes] = []

    def remembered() -> Iterator[bytes]:
        for case in source:
            held[:] = [case]
            yield case

    kept = 0
    for lines in _each(target, remembered()):
        if lines - reached and len(held[0]) <= LARGEST:
            reached |= lines
            folder = CORPUS / target.name
            folder.mkdir(exist_ok=True)
            (folder / hashlib.sha1(held[0]).hexdigest()[:12]).write_bytes(held[0])
            kept += 1
    print(f"{target.name}: {kept} cases added", flush=True)


if __name__ == "__main__":
    main()
