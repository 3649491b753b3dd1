"""The summary that README.md shows, from all runs of an atlas: `benchmarks/run.py --only stability-atlas`."""

from __future__ import annotations

from collections.abc import Iterable
from math import isfinite

VERDICTS = ("completed", "refused", "stopped", "slow")
HEAD = ("axis", "values", "runs", *VERDICTS, "default: error", "default: energy", "known within")


def summary(rows: Iterable[dict[str, str]]) -> list[list[str]]:
    """A row for each axis, in order, and one for all of them.

    Errors are over the motion and energies over the work, the largest of the default's completed runs;
    "known within" is the largest uncertainty of their references.
    """
    axes: dict[str, list[dict[str, str]]] = {}
    for row in rows:
        axes.setdefault(row["axis"], []).append(row)
    out = [[f"`{axis}`", *_of_axis(runs)] for axis, runs in axes.items()]
    everything = [row for runs in axes.values() for row in runs]
    return [*out, ["all", "", *_counts(everything), "", "", ""]]


def _of_axis(runs: list[dict[str, str]]) -> list[str]:
    values = sorted({float(row["value"]) for row in runs})
    default = [row for row in runs if row["formulation"] == "auto" and row["verdict"] == "completed"]
    largest = [_largest(default, column) for column in ("error", "energy", "uncertainty")]
    return [f"{values[0]:g} to {values[-1]:g}", *_counts(runs), *largest]


def _counts(runs: list[dict[str, str]]) -> list[str]:
    return [str(len(runs)), *(str(sum(row["verdict"] == verdict for row in runs)) for verdict in VERDICTS)]


def _largest(runs: list[dict[str, str]], column: str) -> str:
    values = [float(row[column]) for row in runs if row[column] and isfinite(float(row[column]))]
    return f"{max(values):.0e}" if values else ""
