"""Measures what stiff lines and snatches cost: ``python benchmarks/lines.py`` (a part of ``run.py``).

Prints the tables and writes them to ``benchmarks/results`` with ``--publish``, from which
``benchmarks/documents.py`` fills the documents; else to ``out/bench/results``.
``--counts`` leaves out the table of CPU times, for a machine that does other work too.
"""

from __future__ import annotations

import argparse
from pathlib import Path

from measure import line_methods, snatch_cost, stiff_lines

HERE = Path(__file__).resolve().parent


def main() -> int:
    """Measure, print, write."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--publish", action="store_true", help="write into benchmarks/ instead of out/bench")
    parser.add_argument("--counts", action="store_true", help="no CPU times, which need an idle machine")
    options = parser.parse_args()
    folder = HERE if options.publish else HERE.parent / "out" / "bench"
    timed = [] if options.counts else [stiff_lines.stiff_lines(repeats=3)]
    for section in (*timed, line_methods.line_methods(), snatch_cost.snatch_cost()):
        section.save(folder / "results")
        print(section.markdown(), flush=True)
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
