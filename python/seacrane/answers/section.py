"""A section of a report, and how sections make a page."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from html import escape
from typing import Generic, TypeVar

from seacrane.errors import FileFormatError
from seacrane.inputs.replaceable import GENERATOR

Subject = TypeVar("Subject")
STYLE = """
body { font: 15px/1.45 Georgia, serif; max-width: 62rem; margin: 2rem auto; padding: 0 1rem; color: #111; }
h1, h2, h3, th, .card { font-family: Helvetica, Arial, sans-serif; line-height: 1.2; }
h2 { margin: 1.8rem 0 0.6rem; padding-bottom: 0.2rem; border-bottom: 2px solid #0072b2; }
table { border-collapse: collapse; margin: 0.8rem 0; font-size: 0.86em; }
th, td { border: 1px solid #bbb; padding: 0.2rem 0.5rem; text-align: left; vertical-align: top; }
th { background: #eee; }
td { overflow-wrap: break-word; }
td.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
.facts td:first-child { color: #333; }
.columns { display: flex; flex-wrap: wrap; gap: 0 2rem; }
figure { margin: 1.2rem 0; }
img { max-width: 100%; height: auto; }
figcaption, .note { font-size: 0.86em; color: #333; }
pre { white-space: pre-wrap; overflow-wrap: anywhere; font-size: 0.8em; background: #f5f5f5; padding: 0.5em; }
.cards { display: flex; flex-wrap: wrap; gap: 0.6rem; margin: 1rem 0; }
.card { border: 1px solid #bbb; border-left: 5px solid #0072b2; padding: 0.5rem 0.8rem; min-width: 9rem; }
.card strong { display: block; font-size: 1.25em; }
.card.bad { border-left-color: #d55e00; }
.card.good { border-left-color: #009e73; }
.good { color: #00694d; }
.bad { color: #a83f00; font-weight: bold; }
@page { size: A4; margin: 16mm; }
@media print {
  .screen { display: none; }
  body { margin: 0; padding: 0; max-width: none; font-size: 10pt; }
  figure, tr, .card { break-inside: avoid; }
  h2, h3 { break-after: avoid; }
  thead { display: table-header-group; }
  * { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
}
"""


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
    """A page with everything inside: no file, script or address outside it is needed.

    Parameters
    ----------
    title : Heading, escaped here.
    lead : HTML below it.
    subject
        What they are about.

    Raises FileFormatError if a subject holds what its own program never writes, such as notes that are no
    JSON.
    """
    body = [f"<h1>{escape(title)}</h1>", lead, *(_block(section, subject) for section in sections)]
    head = (
        f'<meta charset="utf-8">{GENERATOR}<meta name="viewport" content="width=device-width">'
        f"<title>{escape(title)}</title><style>{STYLE}</style>"
    )
    content = "\n".join(part for part in body if part)
    return f'<!DOCTYPE html>\n<html lang="en"><head>{head}</head>\n<body>\n{content}\n</body></html>\n'
