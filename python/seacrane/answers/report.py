"""report(): one page about a run, and the object that holds it."""

from __future__ import annotations

import os
from dataclasses import dataclass
from html import escape
from pathlib import Path

from seacrane.answers.section import Section, compose
from seacrane.answers.sections import SECTIONS
from seacrane.errors import SceneError
from seacrane.inputs.atomic import atomic_write
from seacrane.inputs.frames import AXES_NOTE
from seacrane.inputs.keywords import named
from seacrane.inputs.replaceable import GENERATOR, check_replaceable
from seacrane.plotting.table import Answer
from seacrane.result import Result

HEIGHT = 640  # pixels of the frame in a notebook


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
