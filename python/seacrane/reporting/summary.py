"""The summary: static value, mean, standard deviation, extremes and dynamic factor of what matters."""

from __future__ import annotations

from seacrane.answers.curves import reported_curves
from seacrane.answers.summary import summary
from seacrane.reporting.blocks import note
from seacrane.reporting.section import Section
from seacrane.result import Result


def _html(result: Result) -> str:
    told = summary(result)
    return told.html() + "".join(map(note, told.notes()))


SUMMARY: Section[Result] = Section(
    title="Summary", applies=lambda result: bool(reported_curves(result)), html=_html
)
