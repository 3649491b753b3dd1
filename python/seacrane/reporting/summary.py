"""The summary: static value, mean, standard deviation, extremes and dynamic factor of what matters."""

from __future__ import annotations

from html import escape

from seacrane.answers.curves import reported_curves
from seacrane.answers.summary import summary
from seacrane.reporting.blocks import note, verdict
from seacrane.reporting.section import Section
from seacrane.result import Result
from seacrane.result.utilisation import HEAD


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
