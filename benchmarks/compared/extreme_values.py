"""Statistics of extremes beside other programs, and on a narrow band."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray
from test_statistics import NARROW, STEP, THREE_HOURS, records

from seacrane.statistics import record_extremes, seed_extremes

from . import files
from .row import Row

Array = NDArray[np.float64]
SUBJECT = "Statistics of extremes"
TEST = "many/test_statistics.py"
RATE, LEVEL = "up-crossings of the mean, 1/s", "level exceeded once in 3 h, {}"


def data() -> tuple[Array, Array]:
    """One record, and the maxima of forty."""
    runs = records(400, NARROW)
    return runs[0], runs.max(axis=1)[:40]


def ours() -> dict[str, float]:
    """Each number that other programs give, and the threshold that both take."""
    values, maxima = data()
    seeds, record = seed_extremes(maxima, duration=THREE_HOURS), record_extremes(values, interval=STEP)
    assert record.tail is not None
    threshold = record.tail.threshold
    found = {
        "Gumbel location, 40 maxima": float(seeds.location),
        "Gumbel scale, 40 maxima": float(seeds.scale),
        RATE: float(record.crossing_rate),
        "threshold": float(threshold),
    }
    for tail in ("exponential", "pareto"):
        mine = record_extremes(values, interval=STEP, tail=tail, threshold=threshold).tail
        assert mine is not None
        levels = np.linspace(threshold, 3.0 * threshold, 4000)
        counts = np.maximum(mine.crossings(levels, THREE_HOURS), 1e-12)
        found[LEVEL.format(tail)] = float(np.interp(0.0, -np.log(counts), levels))
    return found


def judges() -> Iterator[Row]:
    """The same numbers from the same data by other programs, whose clusters differ from ours."""
    mine = ours()
    for row in files.records(files.REFERENCES / "extremes.csv"):
        clustered = row["judge"] == "pyextremes"
        yield Row(
            subject=SUBJECT, compared=row["quantity"],
            reference=f"{row['judge']}, its own clusters" if clustered else row["judge"],
            difference=abs(mine[row["quantity"]] / float(row["theirs"]) - 1.0), unit="",
            limit=0.03 if clustered else 1e-3, test=TEST,
        )  # fmt: skip


def narrow_band() -> Iterator[Row]:
    """The closed form with clumps, at the mean of what single records give."""
    several, *methods = files.records(files.RESULTS / "extremes-by-method.csv")
    clumped = next(row for row in methods if row["method"] == "Gaussian, clumped")
    for number in ("mode", "P90"):
        yield Row(
            subject=SUBJECT, compared=f"narrow-band Gaussian record of 3 h: {number} by clumps of crossings",
            reference=several["method"],
            difference=abs(float(clumped[number]) / float(several[number]) - 1.0), unit="",
            limit=0.02, test=TEST,
        )  # fmt: skip
