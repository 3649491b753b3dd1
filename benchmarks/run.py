"""Measures the tables that somebody decides by: ``python benchmarks/run.py`` (``make bench``).

A table whose sources are those that it was measured with stays as it is; the others are measured one by
one and written at once, so that a call that was stopped goes on where it was. ``--check`` (``make
release-check``) only names them, and ends with status 1 where there are any; ``--only NAME ...`` takes
these, ``--again`` also what is fresh. At last it writes README.md and fills the documents. One thread;
measure on an idle machine.
"""

from __future__ import annotations

import argparse
import os
import resource
import sys
import time
import traceback
from pathlib import Path

import documents
import evidence
import facts
import project
from measure import (
    contact_cost,
    events,
    executors,
    extreme_values,
    feeder,
    footprint,
    hours,
    hydraulic_cost,
    integrators,
    lifts,
    linear,
    lines_in_water,
    memory_fits,
    memory_kinds,
    operability,
    pages,
    paper_form,
    promises,
    scaling,
    snatch_cost,
    speed,
    stiff_lines,
    strip,
    trade_physics,
    wave_loads,
    wet_parts,
)
from measure.section import RESULTS, ROOT, Section
from measure.sources import measured
from measure.table import read
from peers import run as peers

from seacrane.inputs.atomic import atomic_write

README = Path(__file__).resolve().parent / "README.md"
MOST = 40  # tables: for one that comes, one goes
INTRODUCTION = """# Benchmarks

The tables that somebody decides by, at most {most}. `make bench` measures those again whose sources have
changed since, and writes this page; `make release-check` names them. The line below a table tells which
engine and which machine measured it: an engine is a digest of the C++ sources without comments. Each table
is also a file of [`results`](results).

Times depend on the machine and on what else runs on it, so read the ratios first. One thread throughout;
times are CPU times of that thread unless they say wall. C++ tests, not these tables, count that the loop
allocates nothing on the heap after its start: `cpp/tests/test_allocations_core.cpp`, and
`cpp/tests/test_integrate_allocations.cpp` for each integrator.
"""
GROUPS: dict[str, tuple[Section, ...]] = {
    "Speed": (speed.SPEED, speed.PARTS, scaling.SECTION, hours.STORM, hours.HOOK_LOAD, linear.SECTION),
    "Methods and accuracy": (
        integrators.SECTION, promises.TAKE_THIS, promises.COST, promises.OF_STAGES, trade_physics.SECTION,
        paper_form.SECTION,
    ),
    "Lines, events, cylinders, contact": (
        events.SECTION, stiff_lines.SECTION, snatch_cost.SECTION, lines_in_water.SECTION,
        hydraulic_cost.SECTION, contact_cost.SECTION,
    ),
    "Water and waves": (
        wave_loads.SECTION, memory_kinds.SECTION, memory_fits.SECTION, strip.SECTION, wet_parts.SECTION,
        feeder.SECTION,
    ),
    "Many runs": (
        lifts.SECTION, executors.SECTION, extreme_values.SECTION, operability.SECTION,
    ),
    "Other engines": (peers.SECTION,),
    "The package": (footprint.SECTION, pages.SECTION, project.WHEEL, project.EDITS, project.JOBS),
    "Evidence": (evidence.VALIDATION, evidence.MEASUREMENTS, evidence.ATLAS, facts.SECTION),
}  # fmt: skip
SECTIONS = [section for group in GROUPS.values() for section in group]


def cpu() -> float:
    """Processor time of this process and of those that it started, s."""
    every = (resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return sum(one.ru_utime + one.ru_stime for one in every)


def readme() -> str:
    """The page: every table with its words."""
    texts = [INTRODUCTION.format(most=MOST)]
    for group, sections in GROUPS.items():
        texts.append(f"## {group}\n")
        texts += [section.marked for section in sections if section.path.is_file()]
    return documents.filled("\n".join(texts))


def measure(sections: list[Section], *, again: bool) -> list[str]:
    """Measure and write one after the other what is stale; those that failed or lack something, and why."""
    left = []
    for number, section in enumerate(sections, 1):
        if not again and not section.stale:
            continue
        missing, begun = section.needs(), time.perf_counter()
        if missing:
            left.append(f"{section.path.name}: needs {missing}")
            continue
        print(f"{number} of {len(sections)}: {section.title} ...", flush=True)
        try:
            section.measure(cpu=cpu)
        except (Exception, SystemExit) as error:
            traceback.print_exc()
            left.append(f"{section.path.name}: {error}")
            continue
        told = (measured(section.path) or {}).get("cpu_s", 0.0)
        print(f"{told:.0f} s of CPU, {time.perf_counter() - begun:.0f} s", flush=True)
        head, rows = read(section.path)
        print("\n".join(", ".join(row) for row in (head, *rows)), flush=True)
    return left


def publish() -> None:
    """Write the page and fill the documents."""
    with atomic_write(README) as draft:
        draft.write_text(readme(), encoding="utf-8")
    documents.fill()


def main() -> int:
    """Measure what is missing or stale, or name it; the status is 1 where something is left."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    names = {section.path.stem: section for section in SECTIONS}
    parser.add_argument("--check", action="store_true", help="only name what is stale")
    parser.add_argument("--again", action="store_true", help="measure what is fresh as well")
    parser.add_argument("--only", nargs="+", metavar="NAME", choices=list(names), help=", ".join(names))
    options = parser.parse_args()
    if (ROOT.parent / "shared").is_dir():  # foreign data, unless SEACRANE_SHARED names another folder
        os.environ.setdefault("SEACRANE_SHARED", str(ROOT.parent / "shared"))
    chosen = [names[name] for name in options.only or names]
    if options.check:
        stale = {section.path: section.stale for section in chosen}
        left = [f"{path.relative_to(ROOT)}: {why}" for path, why in stale.items() if why]
        others = sorted(path.name for path in RESULTS.glob("*.csv") if path.stem not in names)
        left += [f"benchmarks/results/{name}: no section measures it" for name in others]
    else:
        try:
            left = measure(chosen, again=options.again)
        finally:
            publish()
    print(*left, f"{len(SECTIONS)} tables, {len(left)} left", sep="\n", file=sys.stderr)
    return int(bool(left))


if __name__ == "__main__":
    raise SystemExit(main())
