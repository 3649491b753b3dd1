"""report(): one page about a run, and the object that holds it."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from html import escape
from pathlib import Path
from typing import Any

from seacrane.answers.checks import (
    constraint_rows,
    counter_rows,
    energy_rows,
    findings_of,
    headed,
    settings_block,
    side_by_side,
    versions_block,
)
from seacrane.answers.sections import SECTIONS, Section, compose, picture_block
from seacrane.errors import SceneError
from seacrane.inputs.atomic import atomic_write
from seacrane.inputs.frames import AXES_NOTE
from seacrane.inputs.keywords import named
from seacrane.inputs.replaceable import GENERATOR, check_replaceable
from seacrane.pictures.findings import Finding
from seacrane.plotting.panel import Picture
from seacrane.plotting.table import Answer, table_of
from seacrane.result import Result

HEIGHT = 640  # pixels of the frame in a notebook
SceneReport = Mapping[str, Sequence[tuple[str, Any]]]


@dataclass(frozen=True, kw_only=True, repr=False)
class Report:
    """A page about one or several runs. Made by `report`.

    Attributes
    ----------
    html : str
        The whole page; nothing outside it is needed.
    """

    title: str
    html: str

    def __repr__(self) -> str:
        return f"<Report {self.title!r}: {len(self.html) / 1e3:.0f} kB>"

    def _repr_html_(self) -> str:
        """In a frame of its own: the notebook's looks and the page's do not mix."""
        return (
            f'<iframe srcdoc="{escape(self.html)}" title="{escape(self.title)}" sandbox="allow-scripts" '
            f'style="width:100%;height:{HEIGHT}px;border:1px solid #bbb"></iframe>'
        )

    def save(self, path: str | os.PathLike[str], *, overwrite: bool | None = None) -> Path:
        """Write the page: complete under its name, or not at all.

        Parameters
        ----------
        path : path
            Target file; its folder must exist.
        overwrite : bool, optional
            By default an earlier page of seacrane is replaced, and no other file. True: any file of that
            name. False: none.

        Returns
        -------
        Path
            The file written.

        Raises
        ------
        FileExistsError
            If there is a file of that name that is to stay.
        OSError
            If it cannot be written; an older file stays.
        """
        path = Path(path)
        check_replaceable(path, overwrite, mark=GENERATOR)
        with atomic_write(path) as draft:
            draft.write_text(self.html, encoding="utf-8")
        return path


@named
def report(result: Result, *, title: str | None = None, requires: Answer | None = None) -> Report:
    """One page about a run: what was lifted and how, the loads, the limits, the numbers, and the checks.

    Parameters
    ----------
    result : Result
        Of any scene; what it has not recorded is left out.
    title : str, optional
        Heading; default: the scene's name.
    requires : Requirements, optional
        What `seacrane.required` found of the scene: the page ends with it.

    Returns
    -------
    Report
        ``save("lift.html")`` writes it, a notebook shows it.

    Raises
    ------
    SceneError
        If what is given is no result.
    """
    if not isinstance(result, Result):
        raise SceneError(
            f"result is a {type(result).__name__}; give what simulate() or Result.load() returns"
        )
    heading = str(result.stats["scene"]) if title is None else title
    stopped = (
        f'<p class="bad">Interrupted: the run ended at {result.time[-1]:g} s, before its end.</p>'
        if result.interrupted
        else ""
    )
    lead = f'{stopped}<p class="note">{escape(AXES_NOTE)}</p>'
    needs = "" if requires is None else requires.html()
    sections = (*SECTIONS, Section[Result]("What the scene requires", lambda _: needs))
    return Report(title=heading, html=compose(title=heading, lead=lead, sections=sections, subject=result))


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
    page = compose(title=study.title, lead=lead, sections=OF_STUDY, subject=study)
    return Report(title=study.title, html=page)


def _findings(study: Study) -> str:
    rows = [(item.finding, item.number, item.expected, item.verdict) for item in study.findings]
    return table_of(("finding", "measured", "expected", "verdict"), rows).html() if rows else ""


def _accuracy(study: Study) -> str:
    told = {"Worst constraint errors": constraint_rows, "Energy balance": energy_rows}
    return headed({name: side_by_side(study.runs, rows) for name, rows in told.items()})


def _scene(study: Study) -> str:
    return headed({name: table_of(("item", "value"), rows).html() for name, rows in study.scene.items()})


OF_STUDY: tuple[Section[Study], ...] = (
    Section("Findings", _findings),
    Section("Figures", lambda study: "\n".join(map(picture_block, study.pictures))),
    Section("Accuracy", _accuracy),
    Section("Cost", lambda study: side_by_side(study.runs, counter_rows)),
    Section("Scene", _scene),
    Section(
        "Settings", lambda study: headed({name: settings_block(run) for name, run in study.runs.items()})
    ),
    Section("Versions", lambda _: versions_block()),
)
