"""The summary of what matters, and statistics of everything else that was recorded."""

from __future__ import annotations

from html import escape

from seacrane.answers.blocks import note, verdict
from seacrane.answers.measures import stated_traces, statistics_of
from seacrane.answers.reported_curves import reported_curves
from seacrane.answers.section import Section
from seacrane.answers.summary import summary
from seacrane.plotting.html import table
from seacrane.result import Result
from seacrane.result.traces import NO_MOTION
from seacrane.result.utilisation import HEAD

COLUMNS = ("quantity", "unit", "max", "at [s]", "min", "at [s]", "mean", "std")


def _html(result: Result) -> str:
    told = summary(result)
    used = f"<h3>Utilisation of limit states</h3>{_used(result)}" if told.utilisation else ""
    return told.html() + "".join(map(note, told.notes())) + used


def _used(result: Result) -> str:
    head = "".join(f"<th>{name}</th>" for name in HEAD)
    rows = "".join(
        "<tr>" + "".join(f"<td>{escape(text)}</td>" for text in texts[:-1])
        + f"<td>{verdict(state.kept, texts[-1])}</td></tr>"
        for state, texts in zip(result.utilisation, result.utilisation.cells(), strict=True)
    )  # fmt: skip
    return f"<table><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table>"


SUMMARY: Section[Result] = Section(
    title="Summary", applies=lambda one: bool(reported_curves(one) or one.utilisation), html=_html
)


def _shown(value: float) -> float:
    """With four digits, no quantity of a lift is known to more; zero where it is so up to rounding."""
    return 0.0 if abs(value) < NO_MOTION else float(f"{value:.4g}")


def _statistics(result: Result) -> str:
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
    return table(COLUMNS, rows) + note(words)


STATISTICS: Section[Result] = Section(
    title="Statistics", applies=lambda result: bool(stated_traces(result)), html=_statistics
)
