"""Whether ensembles that stop when it is enough cover the truth, and what control variates save.

``python benchmarks/measure/certainty.py [--publish]`` writes ``until-enough.csv`` to ``out/bench/results``; with
``--publish`` to ``benchmarks/results``.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "benchmarks"))

from measure.table import write  # noqa: E402
from seacrane.ensembles.growing import BATCH  # noqa: E402
from seacrane.ensembles.targets import WIDENED, Target  # noqa: E402
from seacrane.statistics.estimate import P90_REDUCED  # noqa: E402

ENSEMBLES, MOST = 2000, 2000
GROWING = (
    ("mpm", 0.05, 0.02), ("mpm", 0.07, 0.02), ("mpm", 0.15, 0.02), ("mpm", 0.15, 0.05), ("mpm", 0.3, 0.05),
    ("mean", 0.07, 0.02), ("p90", 0.07, 0.02),
)  # fmt: skip
TRUTH = {"mpm": 0.0, "mean": float(np.euler_gamma), "p90": P90_REDUCED}


def until_enough() -> Iterator[tuple[str, ...]]:
    """Coverage of stopped ensembles of Gumbel maxima, with the intervals as they are and widened."""
    for number, scale, asked in GROWING:
        cells = [number, f"{scale:g}", f"{100.0 * asked:g}"]
        truth = 1.0 + scale * TRUTH[number]
        for widened in (1.0, WIDENED):
            random, inside, seeds = np.random.default_rng(7), [], []
            target = Target(variable="x", number=number, half_width=asked, gumbel=True)
            for _ in range(ENSEMBLES):
                maxima = random.gumbel(1.0, scale, MOST)
                for count in range(BATCH, MOST + 1, BATCH):
                    found = target.estimate(maxima[:count])
                    half = found.half_width * widened / WIDENED
                    if half <= asked * found.value:
                        break
                middle = 0.5 * (found.high + found.low)
                inside.append(abs(truth - middle) <= half)
                seeds.append(count)
            cells += [f"{100.0 * np.mean(inside):.1f}", f"{np.mean(seeds):.0f}"]
        yield tuple(cells)


def main() -> None:
    """Write the tables."""
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--publish", action="store_true")
    publish = arguments.parse_args().publish
    folder = ROOT / "benchmarks" / "results" if publish else ROOT / "out" / "bench" / "results"
    head = ("number", "scatter", "asked, %", "covered, %", "seeds", "widened: covered, %", "widened: seeds")
    write(folder / "until-enough.csv", head, list(until_enough()))


if __name__ == "__main__":
    main()
