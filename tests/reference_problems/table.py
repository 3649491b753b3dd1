"""Writes the tables of README.md to benchmarks/results.

Usage, from the repository: PYTHONPATH=tests python -m reference_problems.table
"""

from __future__ import annotations

import csv
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

from .comparison import HEAD, Comparison
from .problems import (
    bricard_loop,
    decays,
    flyball_governor,
    four_bar_row,
    heavy_top,
    regular_wave_response,
    ship_in_a_wave,
    simple_pendulum,
    spatial_slider_crank,
    squeezer,
    wing_nut,
)


def mechanisms() -> Iterator[Comparison]:
    for formulation in ("redundant", "recursive"):
        yield simple_pendulum(formulation=formulation, rtol=1e-10)
        yield four_bar_row(formulation=formulation, integrator="dop853", rtol=1e-10)
        yield squeezer(formulation=formulation, integrator="verner76", rtol=1e-8)
        yield squeezer(published=True, formulation=formulation, integrator="verner76", rtol=1e-8)
        yield bricard_loop(formulation=formulation, integrator="dop853", rtol=1e-9)
        yield flyball_governor(formulation=formulation, integrator="dopri5", rtol=1e-6)
        yield heavy_top(formulation=formulation, integrator="dop853", rtol=1e-9)
        yield heavy_top(published=True, formulation=formulation, integrator="dop853", rtol=1e-9)
        yield wing_nut(formulation=formulation, rtol=1e-10)
        yield spatial_slider_crank(formulation=formulation, integrator="dop853", rtol=1e-10)


def default_setting() -> Iterator[Comparison]:
    for problem in (
        simple_pendulum, four_bar_row, squeezer, bricard_loop, flyball_governor, heavy_top, wing_nut,
        spatial_slider_crank,
    ):  # fmt: skip
        yield problem()


def ships() -> Iterator[Comparison]:
    for memory in ("states", "convolution"):
        yield ship_in_a_wave(memory, integrator="dop853", rtol=1e-11)
    for motion in ("heave", "roll", "pitch"):
        yield from decays(f"vessel {motion}")
    yield from regular_wave_response()


RESULTS = Path(__file__).resolve().parents[2] / "benchmarks" / "results"
TABLES = {"tight": mechanisms, "default": default_setting, "ships": ships}

if __name__ == "__main__":
    for name, comparisons in TABLES.items():
        path = RESULTS / f"reference-problems-{name}.csv"
        with path.open("w", newline="", encoding="utf-8") as file:
            rows = (comparison.row() for comparison in comparisons())
            csv.writer(file, lineterminator="\n").writerows([HEAD, *rows])
        subprocess.run([sys.executable, RESULTS.parent / "documents.py", "--measured", path], check=True)
