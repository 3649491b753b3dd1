"""A section of a report, and how sections make a page."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from html import escape
from typing import Generic, TypeVar

from seacrane.errors import FileFormatError
from seacrane.files.earlier import GENERATOR
from seacrane.reporting.style import STYLE

Subject = TypeVar("Subject")


@dataclass(frozen=True, kw_only=True)
class Section(Generic[Subject]):
    """One block of a page.

    Attributes
    ----------
    title : str
        Its heading.
    applies : callable
        Whether a subject has anything for it; sections that do not apply are left out.
    html : callable
        Its content as HTML, in which all text of users is escaped.
    """

    title: str
    applies: Callable[[Subject], bool]
    html: Callable[[Subject], str]


def _block(section: Section[Subject], subject: Subject) -> str:
    try:
        if not section.applies(subject):
            return ""
        content = section.html(subject)
    except (LookupError, TypeError, ValueError, ArithmeticError, AttributeError) as error:
        raise FileFormatError(
            f"section {section.title!r} cannot be made: {type(error).__name__}: {error}; the result holds "
            "notes that no run writes"
        ) from error
    return f"<section><h2>{escape(section.title)}</h2>\n{content}</section>"


def compose(*, title: str, lead: str, sections: Iterable[Section[Subject]], subject: Subject) -> str:
    """A page with everything inside: no file, script or address outside it is needed.

    Parameters
    ----------
    title : str
        Heading, escaped here.
    lead : str
        HTML below it.
    sections : iterable of Section
    subject
        What they are about.

    Raises
    ------
    FileFormatError
        If a subject holds what its own program never writes, such as notes that are no JSON.
    """
    body = [f"<h1>{escape(title)}</h1>", lead, *(_block(section, subject) for section in sections)]
    head = (
        f'<meta charset="utf-8">{GENERATOR}<meta name="viewport" content="width=device-width">'
        f"<title>{escape(title)}</title><style>{STYLE}</style>"
    )
    content = "\n".join(part for part in body if part)
    return f'<!DOCTYPE html>\n<html lang="en"><head>{head}</head>\n<body>\n{content}\n</body></html>\n'
