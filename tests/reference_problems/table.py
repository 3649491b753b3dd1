"""Writes the tables of README.md to benchmarks/results.

Usage, from the repository: PYTHONPATH=tests python -m reference_problems.table
"""

from __future__ import annotations

import csv
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

# Every room of tests, as pytest has it.
sys.path[:0] = [str(room) for room in sorted(Path(__file__).resolve().parents[1].glob("*/"))]

from . import problems as p  # noqa: E402


def mechanisms() -> Iterator[p.Comparison]:
    for formulation in ("redundant", "recursive"):
        for problem, settings in (
            (p.simple_pendulum, {"rtol": 1e-10}),
            (p.four_bar_row, {"integrator": "dop853", "rtol": 1e-10}),
            (p.squeezer, {"integrator": "verner76", "rtol": 1e-8}),
            (p.squeezer, {"published": True, "integrator": "verner76", "rtol": 1e-8}),
            (p.bricard_loop, {"integrator": "dop853", "rtol": 1e-9}),
            (p.flyball_governor, {"integrator": "dopri5", "rtol": 1e-6}),
            (p.heavy_top, {"integrator": "dop853", "rtol": 1e-9}),
            (p.heavy_top, {"published": True, "integrator": "dop853", "rtol": 1e-9}),
            (p.wing_nut, {"rtol": 1e-10}),
            (p.spatial_slider_crank, {"integrator": "dop853", "rtol": 1e-10}),
        ):
            yield problem(formulation=formulation, **settings)


def default_setting() -> Iterator[p.Comparison]:
    for problem in (
        p.simple_pendulum, p.four_bar_row, p.squeezer, p.bricard_loop, p.flyball_governor, p.heavy_top,
        p.wing_nut, p.spatial_slider_crank,
    ):  # fmt: skip
        yield problem()


def ships() -> Iterator[p.Comparison]:
    for memory in ("states", "convolution"):
        yield p.ship_in_a_wave(memory, integrator="dop853", rtol=1e-11)
    for motion in ("heave", "roll", "pitch"):
        yield from p.decays(f"vessel {motion}")
    yield from p.regular_wave_response()


RESULTS = Path(__file__).resolve().parents[2] / "benchmarks" / "results"
TABLES = {"tight": mechanisms, "default": default_setting, "ships": ships}

if __name__ == "__main__":
    for name, comparisons in TABLES.items():
        path = RESULTS / f"reference-problems-{name}.csv"
        with path.open("w", newline="", encoding="utf-8") as file:
            rows = (comparison.row() for comparison in comparisons())
            csv.writer(file, lineterminator="\n").writerows([p.HEAD, *rows])
        subprocess.run([sys.executable, RESULTS.parent / "documents.py", "--measured", path], check=True)
