"""A section of a report, and how sections make a page."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from html import escape
from importlib.resources import files
from string import Template
from typing import Generic, TypeVar

from seacrane.errors import FileFormatError
from seacrane.inputs.replaceable import GENERATOR

Subject = TypeVar("Subject")
PAGE = Template((files("seacrane") / "answers" / "page.html").read_text(encoding="utf-8"))


@dataclass(frozen=True)
class Section(Generic[Subject]):
    """One block of a page.

    Attributes
    ----------
    title : Its heading.
    html : Its content as HTML, in which all text of users is escaped; where there is none it is left out.
    """

    title: str
    html: Callable[[Subject], str]


def _block(section: Section[Subject], subject: Subject) -> str:
    try:
        content = section.html(subject)
    except (LookupError, TypeError, ValueError, ArithmeticError, AttributeError) as error:
        raise FileFormatError(
            f"section {section.title!r} cannot be made: {type(error).__name__}: {error}; the result holds "
            "notes that no run writes"
        ) from error
    return f"<section><h2>{escape(section.title)}</h2>\n{content}</section>" if content else ""


def compose(*, title: str, lead: str, sections: Iterable[Section[Subject]], subject: Subject) -> str:
    """A page as `page.html` lays it out, with everything inside: nothing outside it is needed.

    Parameters
    ----------
    title : Heading, escaped here.
    lead : HTML below it.
    subject
        What they are about.

    Raises FileFormatError if a subject holds what its own program never writes, such as notes that are no
    JSON.
    """
    parts = [lead, *(_block(section, subject) for section in sections)]
    content = "\n".join(part for part in parts if part)
    return PAGE.substitute(title=escape(title), generator=GENERATOR, content=content)
