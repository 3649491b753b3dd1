"""Statistics of extremes by pyextremes and qats; run where both are installed: ``extreme_values.py [FILE]``.

(``pip install pyextremes pymatreader``, ``pip install --no-deps qats``.) Writes each number to FILE, by
default ``references/extremes.csv``, which benchmarks/compared/extreme_values.py compares with. pyextremes
gathers peaks that are less than 40 s apart, so its clusters and levels differ by that.
"""

from __future__ import annotations

import csv
import sys
from pathlib import Path

import pandas
from pyextremes import EVA
from qats.signal import average_frequency
from qats.stats import gumbel

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parents[1] / "tests" / room) for room in ("many", "scenes")]
sys.path.insert(0, str(HERE.parent))

from compared.extreme_values import LEVEL, RATE, data, ours  # noqa: E402
from test_statistics import STEP, THREE_HOURS  # noqa: E402

RESULT = HERE / "references" / "extremes.csv"
YEAR = 31_556_952.0  # s, the unit of return periods in pyextremes


def main(file: Path = RESULT) -> None:
    """The same data, the same threshold."""
    values, maxima = data()
    threshold = ours()["threshold"]
    location, scale = gumbel.mle(maxima)
    time = STEP * pandas.RangeIndex(values.size).to_numpy()
    rows = [
        ("Gumbel location, 40 maxima", "qats", location),
        ("Gumbel scale, 40 maxima", "qats", scale),
        (RATE, "qats", average_frequency(time, values - values.mean())),
    ]
    series = pandas.Series(values, index=pandas.Timestamp("2000-01-01") + pandas.to_timedelta(time, unit="s"))
    for tail, distribution in (("exponential", "expon"), ("pareto", "genpareto")):
        eva = EVA(series)
        eva.get_extremes("POT", threshold=threshold, r="40s")
        eva.fit_model("MLE", distribution=distribution)
        level = eva.get_return_value(THREE_HOURS / YEAR, alpha=None)[0]
        rows.append((LEVEL.format(tail), "pyextremes", level))
    with file.open("w", newline="", encoding="utf-8") as out:
        table = [(name, judge, f"{float(value):.12g}") for name, judge, value in rows]
        csv.writer(out, lineterminator="\n").writerows([("quantity", "judge", "theirs"), *table])


if __name__ == "__main__":
    main(*map(Path, sys.argv[1:]))
