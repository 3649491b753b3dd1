"""Every script of examples/jobs, run as its user would: ``python benchmarks/run.py --only jobs``.

Takes what each prints, its lines and its time, and writes ``examples/jobs/README.md`` from that. A script
that fails or warns ends the call, and nothing is written.
"""

from __future__ import annotations

import ast
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from measure.section import significant

from seacrane.inputs.atomic import atomic_write

ROOT = Path(__file__).resolve().parents[1]
SCRIPTS = ROOT / "examples" / "jobs"
TABLE = "benchmarks/results/jobs.csv"
HEAD = ("job", "lines", "in 0.2", "wall, s", "CPU, s")
BEFORE = {  # lines in version 0.2, by hand among them
    "barge_moorings": 66, "deepwater_wire": 59, "feeder_lift": 32, "feeder_two_ships": 69,
    "heave_compensation_cylinder": 32, "heave_compensation_winch": 28, "hose_burst": 40,
    "hypercube": 52, "load_chart": 27, "loss_of_load": 64, "mru_record": 45, "nacelle_rigging": 87,
    "ring_crane": 37, "short_sling": 42, "subsea_lowering": 34,
    "three_hours": 33, "tip_rao": 48, "tugger": 31, "two_cranes": 31, "upending": 51, "wire_snatch": 25,
}  # fmt: skip
LONGEST = 300.0  # s
INTRODUCTION = """# Jobs

Ordinary work of an offshore lift, each in a script that fits on a page and prints its numbers beside those by
hand. `python benchmarks/run.py --only jobs` runs the scripts of this folder, and writes this page from them
and from what they printed. Lines are those that are not empty, about half of them by hand. Times are of the
whole call, with the start of Python; other work may share the machine.

"""


@dataclass(frozen=True, kw_only=True)
class Job:
    """A script, and what came of one run of it."""

    path: Path
    printed: str
    wall: float
    cpu: float

    @property
    def source(self) -> str:
        return self.path.read_text(encoding="utf-8")

    @property
    def title(self) -> str:
        """Of its file, in words."""
        return self.path.stem.replace("_", " ").capitalize()

    @property
    def cells(self) -> tuple[str, ...]:
        lines = sum(bool(line.strip()) for line in self.source.splitlines())
        before = str(BEFORE.get(self.path.stem, ""))
        return self.title, str(lines), before, significant(self.wall, 2), significant(self.cpu, 2)

    def section(self) -> str:
        """Its idea, where it is, and what it printed."""
        idea = (ast.get_docstring(ast.parse(self.source)) or "").strip()
        script = f"[{self.path.name}]({self.path.name})"
        return f"## {self.title}\n\n{idea} Script: {script}.\n\n```text\n{self.printed.rstrip()}\n```\n"


def run(path: Path) -> Job:
    """Run a script in a process of its own, in an empty folder."""
    before, begun = os.times(), time.perf_counter()
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run(
            [sys.executable, str(path)], cwd=folder, capture_output=True, text=True, timeout=LONGEST
        )
    wall, after = time.perf_counter() - begun, os.times()
    if done.returncode or done.stderr:
        raise SystemExit(f"{path.name} ended with {done.returncode}:\n{done.stderr}")
    cpu = after.children_user + after.children_system - before.children_user - before.children_system
    return Job(path=path, printed=done.stdout, wall=wall, cpu=cpu)


def document(jobs: Sequence[Job]) -> str:
    """All jobs as one Markdown text."""
    head = f"{INTRODUCTION}<!-- table {TABLE} -->\n<!-- end of table -->\n"
    return "\n".join([head, *(job.section() for job in jobs)])


def rows() -> list[tuple[str, ...]]:
    """Of every script; the page of the folder is written from what they printed."""
    jobs = []
    for path in sorted(SCRIPTS.glob("*.py")):
        jobs.append(run(path))
        print(f"{path.name}: {jobs[-1].wall:.1f} s\n{jobs[-1].printed}", flush=True)
    with atomic_write(SCRIPTS / "README.md") as draft:
        draft.write_text(document(jobs), encoding="utf-8")
    return [job.cells for job in jobs]
