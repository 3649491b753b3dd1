"""Statistics of extremes: what `benchmarks/measure/extreme_values.py` wrote."""

from __future__ import annotations

from collections.abc import Iterator

from .files import RESULTS, records
from .row import Row

SUBJECT = "Statistics of extremes"
TEST = "many/test_statistics.py"


def judges() -> Iterator[Row]:
    """The same numbers from the same record or maxima by other programs; their clusters differ from ours."""
    for row in records(RESULTS / "extremes-against-judges.csv"):
        if row["quantity"].startswith("clusters"):
            continue
        clustered = row["judge"] == "pyextremes"
        yield Row(
            subject=SUBJECT, compared=row["quantity"],
            reference=f"{row['judge']}, its own clusters" if clustered else row["judge"],
            difference=abs(float(row["difference, %"])) / 100.0, unit="", limit=0.03 if clustered else 1e-3,
            test=TEST,
        )  # fmt: skip


def narrow_band() -> Iterator[Row]:
    """The closed form with clumps, at the mean of what single records give."""
    several, *methods = records(RESULTS / "extremes-by-method.csv")
    clumped = next(row for row in methods if row["method"] == "Gaussian, clumped")
    for number in ("mode", "P90"):
        yield Row(
            subject=SUBJECT, compared=f"narrow-band Gaussian record of 3 h: {number} by clumps of crossings",
            reference=several["method"],
            difference=abs(float(clumped[number]) / float(several[number]) - 1.0), unit="",
            limit=0.02, test=TEST,
        )  # fmt: skip
