"""The paper's report: findings and figures of its five runs, then the numbers of case 2 and of all runs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from html import escape
from typing import Any

from seacrane.answers.checks import constraint_rows, counter_rows, energy_rows, findings_of, side_by_side
from seacrane.answers.provenance_section import settings_block, versions_block
from seacrane.answers.report import Report
from seacrane.answers.section import Section, compose, picture_block
from seacrane.inputs.frames import AXES_NOTE
from seacrane.pictures.findings import Finding
from seacrane.plotting.panel import Picture
from seacrane.plotting.table import table_of
from seacrane.result import Result

SceneReport = Mapping[str, Sequence[tuple[str, Any]]]


@dataclass(frozen=True, kw_only=True)
class Study:
    """Several runs that a report compares.

    Attributes
    ----------
    title : Heading.
    summary : What was computed, one paragraph each.
    runs : mapping of str to Result
        Runs by the names that heads of columns show.
    pictures : Figures on disk; their images are embedded.
    scene : mapping of str to sequence of (name, value)
        What the compiled model holds, as ``scene.report()`` gives it.
    findings : The paper's findings, measured.
    """

    title: str
    runs: Mapping[str, Result]
    summary: Sequence[str] = ()
    pictures: Sequence[Picture] = ()
    scene: SceneReport = field(default_factory=dict)
    findings: Sequence[Finding] = ()


def study_report(study: Study) -> Report:
    """The page about several runs.

    Raises OSError if the image of a picture cannot be read.
    """
    paragraphs = [escape(text) for text in (*study.summary, AXES_NOTE)]
    runs = [(escape(name), run) for name, run in study.runs.items()]
    paragraphs += [
        f"<strong>Interrupted:</strong> run {name} ended at {run.time[-1]:g} s."
        for name, run in runs if run.interrupted
    ]  # fmt: skip
    paragraphs += [
        f"<strong>Out of range:</strong> run {name}: {escape(text)}."
        for name, run in runs for text in findings_of(run)
    ]  # fmt: skip
    lead = "\n".join(f"<p>{text}</p>" for text in paragraphs)
    page = compose(title=study.title, lead=lead, sections=SECTIONS, subject=study)
    return Report(title=study.title, html=page)


def _findings(study: Study) -> str:
    rows = [(item.finding, item.number, item.expected, item.verdict) for item in study.findings]
    return table_of(("finding", "measured", "expected", "verdict"), rows).html() if rows else ""


def _accuracy(study: Study) -> str:
    return (
        f"<h3>Worst constraint errors</h3>{side_by_side(study.runs, constraint_rows)}"
        f"<h3>Energy balance</h3>{side_by_side(study.runs, energy_rows)}"
    )


def _scene(study: Study) -> str:
    return "\n".join(
        f"<h3>{escape(section)}</h3>{table_of(('item', 'value'), rows).html()}"
        for section, rows in study.scene.items()
    )


def _settings(study: Study) -> str:
    return "\n".join(f"<h3>{escape(name)}</h3>{settings_block(run)}" for name, run in study.runs.items())


SECTIONS: tuple[Section[Study], ...] = (
    Section("Findings", _findings),
    Section("Figures", lambda study: "\n".join(map(picture_block, study.pictures))),
    Section("Accuracy", _accuracy),
    Section("Cost", lambda study: side_by_side(study.runs, counter_rows)),
    Section("Scene", _scene),
    Section("Settings", _settings),
    Section("Versions", lambda _: versions_block()),
)
