"""Measures what hydraulic cylinders cost: ``python benchmarks/hydraulics.py [--publish]``.

A part of ``run.py``. Prints the table and writes it to ``out/bench/results``; with ``--publish`` to
``benchmarks/results``, from which ``benchmarks/documents.py`` fills docs/hydraulics.md.
"""

from __future__ import annotations

import argparse
from pathlib import Path

from measure import hydraulic_cost

HERE = Path(__file__).resolve().parent


def main() -> int:
    """Measure, print, write."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--publish", action="store_true", help="write into benchmarks/ instead of out/bench")
    options = parser.parse_args()
    folder = HERE if options.publish else HERE.parent / "out" / "bench"
    section = hydraulic_cost.hydraulic_cost(repeats=3)
    section.save(folder / "results")
    print(section.markdown(), flush=True)
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
