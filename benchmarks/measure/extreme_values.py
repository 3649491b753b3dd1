"""Statistics of extremes on Gaussian records, and against pyextremes and qats.

``python benchmarks/measure/extreme_values.py [--publish]`` needs both programs (``pip install pyextremes
pymatreader``, ``pip install --no-deps qats``). It writes ``extremes-by-method.csv``,
``extremes-over-seeds.csv`` and ``extremes-against-judges.csv`` to ``out/bench/results``; with ``--publish``
to ``benchmarks/results``.
"""

from __future__ import annotations

import argparse
import sys
import warnings
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "benchmarks"))
sys.path.extend(map(str, [ROOT / "tests", *(ROOT / "tests").glob("*/")]))

from test_statistics import NARROW, STEP, THREE_HOURS, records  # noqa: E402

from measure.table import write  # noqa: E402
from seacrane.statistics import record_extremes, seed_extremes  # noqa: E402
from seacrane.statistics.estimate import Maximum  # noqa: E402
from seacrane.statistics.gumbel import gumbel_fit  # noqa: E402

Array = NDArray[np.float64]
RECORDS, JUDGED = 400, 100
SEEDS = (5, 10, 20, 40)
YEAR = 31_556_952.0  # s, the unit of return periods in pyextremes
SAMPLES = 2000  # of seeds, drawn from all records


def by_method(runs: Array) -> Iterator[tuple[str, ...]]:
    """What one record of three hours tells, over many; truth is the Gumbel mode and the P90 of all maxima."""
    maxima = runs.max(axis=1)
    truth = seed_extremes(maxima, duration=THREE_HOURS)
    mode, ninety = truth.gumbel.mpm.value, truth.empirical.p90.value
    yield (f"maxima of {RECORDS} records", f"{mode:.2f}", "", "", f"{ninety:.2f}", "", "")
    found: dict[str, list[Maximum]] = {}
    for values in runs[:JUDGED]:
        for tail in ("pareto", "exponential"):
            one = record_extremes(values, interval=STEP, tail=tail)
            if one.over_threshold is not None:
                found.setdefault(f"peaks over threshold, {tail}", []).append(one.over_threshold)
        found.setdefault("Gaussian, sqrt(2 ln N)", []).append(one.gaussian)
        found.setdefault("Gaussian, clumped", []).append(one.clumped)
    for name, several in found.items():
        cells = [name]
        for estimates, true in (
            ([one.mpm for one in several], mode),
            ([one.p90 for one in several], ninety),
        ):
            values = np.array([one.value for one in estimates])
            inside = np.mean([one.low < true < one.high for one in estimates])
            cells += [f"{values.mean():.2f}", f"{values.std():.2f}", f"{100.0 * inside:.0f}"]
        yield tuple(cells)


def over_seeds(runs: Array) -> Iterator[tuple[str, ...]]:
    """Scatter of the Gumbel mode and of P90 over the number of seeds."""
    maxima, random = runs.max(axis=1), np.random.default_rng(11)
    for count in SEEDS:
        draws = np.array([random.choice(maxima, count, replace=False) for _ in range(SAMPLES)])
        location, scale = gumbel_fit(draws)
        ninety = location - np.log(-np.log(0.9)) * scale
        yield str(count), f"{location.std():.3f}", f"{ninety.std():.3f}"


def against_judges(runs: Array) -> Iterator[tuple[str, ...]]:
    """The same numbers from the same data by pyextremes and qats."""
    import pandas
    from pyextremes import EVA
    from qats.signal import average_frequency
    from qats.stats import gumbel as judge

    values, maxima = runs[0], runs.max(axis=1)[:40]
    ours, seeds = record_extremes(values, interval=STEP), seed_extremes(maxima, duration=THREE_HOURS)
    location, scale = judge.mle(maxima)
    yield _row("Gumbel location, 40 maxima", seeds.location, "qats", float(location))
    yield _row("Gumbel scale, 40 maxima", seeds.scale, "qats", float(scale))
    time = STEP * np.arange(values.size)
    yield _row(
        "up-crossings of the mean, 1/s", ours.crossing_rate, "qats",
        float(average_frequency(time, values - values.mean())),
    )  # fmt: skip
    assert ours.tail is not None
    threshold = ours.tail.threshold
    series = pandas.Series(values, index=pandas.Timestamp("2000-01-01") + pandas.to_timedelta(time, unit="s"))
    for tail, distribution in (("exponential", "expon"), ("pareto", "genpareto")):
        mine = record_extremes(values, interval=STEP, tail=tail, threshold=threshold)
        assert mine.tail is not None
        assert mine.over_threshold is not None
        eva = EVA(series)
        eva.get_extremes("POT", threshold=threshold, r="40s")
        eva.fit_model("MLE", distribution=distribution)
        clusters, name = mine.tail.peaks.size, f"clusters above {threshold:.3f}, {tail}"
        yield _row(name, clusters, "pyextremes", len(eva.extremes))
        level = float(eva.get_return_value(THREE_HOURS / YEAR, alpha=None)[0])
        once = np.interp(0.0, *_once(mine.tail.crossings, threshold))
        yield _row(f"level exceeded once in 3 h, {tail}", float(once), "pyextremes", level)


def _once(crossings: object, threshold: float) -> tuple[Array, Array]:
    levels = np.linspace(threshold, 3.0 * threshold, 4000)
    counts = crossings(levels, THREE_HOURS)  # type: ignore[operator]
    return -np.log(np.maximum(counts, 1e-12)), levels


def _row(name: str, ours: float, judge: str, theirs: float) -> tuple[str, ...]:
    return name, f"{ours:.4g}", judge, f"{theirs:.4g}", f"{100.0 * (ours / theirs - 1.0):.2g}"


def main() -> None:
    """Write the tables."""
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--publish", action="store_true")
    publish = arguments.parse_args().publish
    folder = ROOT / "benchmarks" / "results" if publish else ROOT / "out" / "bench" / "results"
    warnings.simplefilter("ignore")
    runs = records(RECORDS, NARROW)
    head = ("method", "mode", "its scatter", "covered, %", "P90", "its scatter ", "covered, % ")
    write(folder / "extremes-by-method.csv", head, list(by_method(runs)))
    head = ("seeds", "scatter of the mode", "scatter of P90")
    write(folder / "extremes-over-seeds.csv", head, list(over_seeds(runs)))
    head = ("quantity", "ours", "judge", "theirs", "difference, %")
    write(folder / "extremes-against-judges.csv", head, list(against_judges(runs)))


if __name__ == "__main__":
    main()
