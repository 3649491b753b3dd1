"""Sections of the project itself: what an edit costs, the wheel, the jobs."""

from __future__ import annotations

import csv
import os
import resource
import subprocess
import sys
import time
import uuid
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import jobs
from measure.section import ROOT, Section
from measure.sources import ENGINE

FILES = {
    "Python": "python/seacrane/run/outputs.py",
    "load": "cpp/seacrane/elements/loads/friction.hpp",
    "integrator": "cpp/seacrane/integrate/rk_low_storage.cpp",
}


def edits() -> Iterator[list[Any]]:
    """Of each kind one file is changed in earnest, built and imported; then it is restored."""
    _build_and_import()
    try:
        for kind, name in FILES.items():
            yield [f"{kind} ({Path(name).name})", *_edited(ROOT / name), os.getloadavg()[0]]
    finally:
        _build_and_import()


def _build_and_import() -> tuple[float, float]:
    """s of processor time and of the wall."""
    began, before = time.perf_counter(), resource.getrusage(resource.RUSAGE_CHILDREN)
    for command in (["make", "--silent", "build"], [sys.executable, "-c", "import seacrane"]):
        subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return cpu, time.perf_counter() - began


def _edited(file: Path) -> tuple[float, float]:
    """What an edit of the file costs; a comment alone ccache would recognise."""
    kept, name = file.read_text(encoding="utf-8"), f"edited_{uuid.uuid4().hex}"
    cpp = f"namespace seacrane {{ inline constexpr int {name} = 0; }}\n"
    try:
        file.write_text(kept + (f"{name} = 0\n" if file.suffix == ".py" else cpp), encoding="utf-8")
        return _build_and_import()
    finally:
        file.write_text(kept, encoding="utf-8")


def _wheel() -> Path | None:
    """The newest wheel that `make wheel` left."""
    found = sorted((ROOT / "dist").glob("*.whl"), key=lambda path: path.stat().st_mtime)
    return found[-1] if found else None


def wheel() -> Iterator[list[str]]:
    """Facts of the wheel, tried where no compiler is."""
    made = _wheel()
    assert made is not None
    subprocess.run([sys.executable, ROOT / "tools" / "wheel" / "check.py", made], check=True)
    with made.with_name("wheel-facts.csv").open(newline="", encoding="utf-8") as file:
        yield from list(csv.reader(file))[1:]


EDITS = Section(
    title="Edit loops",
    text="From save to import, `make build` in between: what a contributor waits for.",
    head=["edit of a", "CPU, s", "wall, s", "load of the machine"],
    rows=edits,
    sources=("CMakeLists.txt", "cpp/CMakeLists.txt", "cmake", "pyproject.toml", *FILES.values()),
)
WHEEL = Section(
    title="Wheel",
    text="What `make wheel` made, installed and tried where no compiler is found (`tools/wheel/check.py`).",
    head=["fact", "value"],
    rows=wheel,
    sources=(*ENGINE, "tools/wheel/*.py", "pyproject.toml"),
    needs=lambda: "" if _wheel() else "a wheel in dist: make wheel",
)
JOBS = Section(
    title="Jobs",
    text=(
        "Every script of [`examples/jobs`](../examples/jobs/README.md), run as its user would, the start of "
        "Python included: lines that are not empty, now and in version 0.2, and times of the whole call."
    ),
    head=jobs.HEAD,
    rows=jobs.rows,
    sources=(*ENGINE, "python/seacrane/**/*.py", "examples/jobs/*.py"),
)
