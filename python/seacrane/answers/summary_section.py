"""The summary of what matters, and statistics of everything else that was recorded."""

from __future__ import annotations

from dataclasses import replace

from seacrane.answers.measures import statistics_of
from seacrane.answers.section import Section
from seacrane.answers.summary import summary
from seacrane.plotting.table import table_of
from seacrane.result import Result
from seacrane.result.contact_loads import NO_CONTACTS

HEAD = ("quantity", "unit", "max", "at [s]", "min", "at [s]", "mean", "std")


def _summary(result: Result) -> str:
    told = replace(summary(result), contacts=NO_CONTACTS)
    return told.html() if told or told.utilisation else ""


def _statistics(result: Result) -> str:
    found, left_out = statistics_of(result)
    if not found and not left_out:
        return ""
    start, end = result.time[0], result.time[-1]
    words = (
        f"Over the outputs from {start:g} to {end:g} s. Reactions are sizes of the joint's force and moment."
    )
    if left_out:
        words += f" {left_out} curves that are zero up to rounding are left out."
    return table_of(HEAD, found, form=".4g", remarks=[words]).html()


SUMMARY: Section[Result] = Section("Summary", _summary)
STATISTICS: Section[Result] = Section("Statistics", _statistics)
