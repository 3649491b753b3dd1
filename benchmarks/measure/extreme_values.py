"""What statistics of extremes tell of one record and of several, on Gaussian records of three hours."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from seacrane.statistics import record_extremes, seed_extremes
from seacrane.statistics.estimate import Maximum
from seacrane.statistics.seeds import gumbel_fit

from .section import Section

Array = NDArray[np.float64]
RECORDS, JUDGED, SAMPLES = 400, 100, 2000  # samples: of seeds, drawn from all records
SEEDS = (5, 10, 20, 40)


def extremes() -> Iterator[list[str]]:
    """The truth is the Gumbel mode and the P90 of the maxima of all records."""
    sys.path.extend(str(Path(__file__).resolve().parents[2] / "tests" / room) for room in ("scenes", "many"))
    from test_statistics import NARROW, THREE_HOURS, records

    warnings.simplefilter("ignore")
    runs = records(RECORDS, NARROW)
    maxima = runs.max(axis=1)
    truth = seed_extremes(maxima, duration=THREE_HOURS)
    mode, ninety = truth.gumbel.mpm.value, truth.empirical.p90.value
    yield [f"maxima of {RECORDS} records", f"{mode:.2f}", "", "", f"{ninety:.2f}", "", ""]
    yield from _of_one_record(runs[:JUDGED], mode, ninety)
    random = np.random.default_rng(11)
    for count in SEEDS:
        draws = np.array([random.choice(maxima, count, replace=False) for _ in range(SAMPLES)])
        location, scale = gumbel_fit(draws)
        cells = []
        for value in (location, location - np.log(-np.log(0.9)) * scale):
            cells += [f"{value.mean():.2f}", f"{value.std():.2f}", ""]
        yield [f"maxima of {count} records, Gumbel", *cells]


def _of_one_record(runs: Array, mode: float, ninety: float) -> Iterator[list[str]]:
    from test_statistics import STEP

    found: dict[str, list[Maximum]] = {}
    for values in runs:
        for tail in ("pareto", "exponential"):
            one = record_extremes(values, interval=STEP, tail=tail)
            if one.over_threshold is not None:
                found.setdefault(f"peaks over threshold, {tail}", []).append(one.over_threshold)
        found.setdefault("Gaussian, sqrt(2 ln N)", []).append(one.gaussian)
        found.setdefault("Gaussian, clumped", []).append(one.clumped)
    for name, several in found.items():
        cells = [name]
        for number, true in (("mpm", mode), ("p90", ninety)):
            estimates = [getattr(one, number) for one in several]
            values = np.array([one.value for one in estimates])
            inside = np.mean([one.low < true < one.high for one in estimates])
            cells += [f"{values.mean():.2f}", f"{values.std():.2f}", f"{100.0 * inside:.0f}"]
        yield cells


SECTION = Section(
    title="Extremes by method",
    text=(
        "Gaussian records of three hours at 0.8 +- 0.06 rad/s with unit standard deviation. What one record "
        f"tells by each method, over {JUDGED} of them, and what the maxima of a few tell: the most probable "
        "largest value and the one that 10 % exceed, their scatter, and how many of the 95 % intervals hold "
        "the truth of the first row."
    ),
    head=["method", "mode", "its scatter", "covered, %", "P90", "its scatter ", "covered, % "],
    rows=extremes,
    sources=("python/seacrane/statistics",),
)
