"""report(): one page about a run, and the object that holds it."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from html import escape
from pathlib import Path
from typing import Any

from seacrane.answers.sections import page_of
from seacrane.errors import SceneError
from seacrane.inputs.atomic import atomic_write
from seacrane.inputs.keywords import named
from seacrane.inputs.replaceable import GENERATOR, check_replaceable
from seacrane.pictures.findings import Finding
from seacrane.plotting.panel import Picture
from seacrane.plotting.table import Answer
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
    return Report(title=heading, html=page_of("report.html", title=heading, run=result, requires=requires))


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
    return Report(title=study.title, html=page_of("study.html", title=study.title, study=study))
