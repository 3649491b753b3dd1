"""Largest, smallest, mean and standard deviation of what was recorded and is not in the summary."""

from __future__ import annotations

from seacrane.plotting.html import table
from seacrane.reporting.blocks import note
from seacrane.reporting.measures import stated_traces, statistics_of
from seacrane.reporting.section import Section
from seacrane.result import Result
from seacrane.result.traces import NO_MOTION

HEAD = ("quantity", "unit", "max", "at [s]", "min", "at [s]", "mean", "std")


def _shown(value: float) -> float:
    """With four digits, no quantity of a lift is known to more; zero where it is so up to rounding."""
    return 0.0 if abs(value) < NO_MOTION else float(f"{value:.4g}")


def _html(result: Result) -> str:
    found, left_out = statistics_of(result)
    rows = [
        (
            one.title,
            one.unit,
            *map(_shown, (one.largest, one.largest_at, one.smallest, one.smallest_at)),
            *map(_shown, (one.mean, one.std)),
        )
        for one in found
    ]
    start, end = result.time[0], result.time[-1]
    words = (
        f"Over the outputs from {start:g} to {end:g} s. Reactions are sizes of the joint's force and moment."
    )
    if left_out:
        words += f" {left_out} curves that are zero up to rounding are left out."
    return table(HEAD, rows) + note(words)


STATISTICS: Section[Result] = Section(
    title="Statistics", applies=lambda result: bool(stated_traces(result)), html=_html
)
