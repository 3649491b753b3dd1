"""Measures speed, precision, memory and import time: ``python benchmarks/run.py`` (``make bench``).

Prints the tables and writes them, with the work-precision diagram, to ``out/bench``; with ``--publish`` to
``benchmarks/README.md`` and its picture. Each table is also a file in ``results``, from which
``benchmarks/documents.py`` fills the tables of the documents; ``--publish`` does this too. One thread; every
time is the best of several equal runs.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import facts
from measure import (
    contact_cost,
    crane,
    ensemble,
    ensemble_overhead,
    evaluation,
    events,
    feeder,
    footprint,
    formulations,
    hours,
    hydraulic_cost,
    integrators,
    lanes,
    lifts,
    line_methods,
    linear,
    lines_in_water,
    memory_by_motion,
    memory_cost,
    memory_fits,
    memory_kinds,
    memory_models,
    memory_speed,
    moving_points,
    pages,
    paper_form,
    rival,
    scaling,
    scenes,
    seas,
    snatch_cost,
    speed,
    stiff_lines,
    storm,
    strip_cost,
    two_cores,
    w_method,
    wave_loads,
    wet_parts,
)
from measure.machine import machine
from measure.section import Section

from seacrane.inputs.atomic import atomic_write

HERE = Path(__file__).resolve().parent
INTRODUCTION = """# Benchmarks

Written by `benchmarks/run.py --publish`; `make bench` measures again and writes to `out/bench`. Each table is
a file of [`results`](results). The line with its link names the machine and the engine that measured it, this
by a digest of the C++ sources without comments. `make release-check` lists the tables of another engine.

Times depend on the machine and on what else runs on it, so read the ratios first. One thread throughout;
times are CPU times of that thread unless they say wall. C++ tests, not these tables, count that the loop
allocates nothing on the heap after its start: `cpp/tests/test_allocations_core.cpp`, and
`cpp/tests/test_integrate_allocations.cpp` for each integrator.

"""
PICTURE = "work_precision.png"


def sections(folder: Path, *, repeats: int, quick: bool) -> Iterator[Section]:
    """Every table in turn; draws the work-precision diagram into the folder on the way."""
    yield speed.speed(repeats=repeats)
    yield evaluation.whole(repeats=repeats)
    yield evaluation.parts(repeats=repeats)
    yield evaluation.parts(repeats=repeats, formulation="recursive")
    yield formulations.formulations(repeats=repeats)
    yield formulations.throughput(repeats=repeats)
    yield storm.storm(repeats=min(repeats, 3))
    yield hours.hours()
    yield scaling.growth(repeats=min(repeats, 3))
    yield scaling.loop_rows(repeats=repeats)
    yield memory_cost.memory_cost(repeats=repeats)
    yield memory_kinds.memory_kinds(repeats=repeats)
    yield memory_speed.memory_speed(repeats=repeats)
    yield wave_loads.wave_loads(repeats=repeats)
    yield moving_points.moving_points(repeats=repeats)
    yield lines_in_water.lines_in_water(repeats=repeats)
    yield wet_parts.wet_parts(repeats=repeats)
    yield feeder.feeder(repeats=min(repeats, 3))
    yield contact_cost.contact_cost(repeats=repeats)
    tried = 1 if quick else min(repeats, 3)
    rows, truth = integrators.work_precision(repeats=tried)
    integrators.figure(rows, folder / PICTURE)
    yield integrators.table(rows, truth, repeats=tried)
    yield events.slack_wire()
    yield stiff_lines.stiff_lines(repeats=tried)
    yield hydraulic_cost.hydraulic_cost(repeats=tried)
    yield line_methods.line_methods()
    yield snatch_cost.snatch_cost()
    yield w_method.w_method()
    yield w_method.stiff_direction()
    yield linear.natural_periods()
    yield linear.linear_against_runs()
    yield linear.cost(repeats=min(repeats, 3))
    yield from paper_form.paper_form(t_end=5.0 if quick else 100.0)
    yield crane.shipped_crane()
    yield memory_by_motion.roll_by_cause()
    yield memory_fits.memory_fits()
    yield memory_models.self_check()
    yield memory_models.fits()
    yield memory_models.trade()
    yield seas.seas(repeats=min(repeats, 3))
    yield ensemble.one_member(repeats=repeats)
    yield ensemble_overhead.overhead(members=4 if quick else 16, t_end=100.0 if quick else 10_800.0)
    yield two_cores.two_cores(
        members=8 if quick else 64, t_end=100.0 if quick else 10_800.0, repeats=1 if quick else 3
    )
    yield lanes.lanes(repeats=repeats)
    yield lifts.lifts(repeats=min(repeats, 3))
    yield ensemble.workers(repeats=min(repeats, 3), t_end=100.0 if quick else 1000.0)
    yield strip_cost.strip_cost(repeats=min(repeats, 3))
    yield rival.rival(repeats=repeats, t_end=5.0 if quick else 100.0)
    yield footprint.memory(repeats=min(repeats, 3))
    yield footprint.imports(repeats=repeats)
    yield pages.pages()
    yield scenes.sizes()


def document(folder: Path, *, repeats: int, quick: bool, say: Callable[[str], None]) -> str:
    """Where all tables are, as one Markdown text; each is said, and saved, as soon as it is there."""
    say(machine())
    texts = [INTRODUCTION]
    for section in sections(folder, repeats=repeats, quick=quick):
        section.save(folder / "results")
        say(section.markdown() + "\n")
        texts.append(section.marked(shown=False) + "\n")
        if section.title.startswith("Integrators"):
            texts.append(f"![Payload error over evaluations and over CPU time, per integrator]({PICTURE})\n")
    return "\n".join(texts)


def main() -> int:
    """Measure, print, write; returns the exit status."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--publish", action="store_true", help="write into benchmarks/ instead of out/bench")
    parser.add_argument("--quick", action="store_true", help="fewer repeats, short run of the rival")
    parser.add_argument("--repeats", type=int, default=9, help="equal runs per measurement, default 9")
    options = parser.parse_args()
    repeats = 2 if options.quick else options.repeats
    if repeats < 1:
        parser.error(f"--repeats is {options.repeats}; give at least 1")
    folder = HERE if options.publish else HERE.parent / "out" / "bench"
    folder.mkdir(parents=True, exist_ok=True)
    text = document(folder, repeats=repeats, quick=options.quick, say=lambda part: print(part, flush=True))
    target = folder / "README.md"
    with atomic_write(target) as draft:
        draft.write_text(text, encoding="utf-8")
    print(f"written to {target}", file=sys.stderr)
    if options.publish:
        facts.publish()
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
