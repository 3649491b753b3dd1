"""A section of a report, the parts that sections are made of, and how they make a page."""

from __future__ import annotations

import base64
import io
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from html import escape
from importlib.resources import files
from string import Template
from typing import TYPE_CHECKING, Generic, TypeVar

from seacrane.errors import FileFormatError
from seacrane.inputs.replaceable import GENERATOR
from seacrane.plotting.panel import DOTS_PER_INCH, Picture

if TYPE_CHECKING:
    from matplotlib.figure import Figure

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


def embedded(data: bytes, title: str, caption: str) -> str:
    """A PNG with a caption; its bytes become part of the page."""
    coded, head = base64.b64encode(data).decode("ascii"), escape(title)
    words = f"<figcaption><strong>{head}.</strong> {escape(caption)}</figcaption>"
    return f'<figure><img alt="{head}" src="data:image/png;base64,{coded}">{words}</figure>'


def drawn(figure: Figure, title: str, caption: str) -> str:
    """A Matplotlib figure with a caption."""
    image = io.BytesIO()
    figure.savefig(image, format="png", dpi=DOTS_PER_INCH)
    return embedded(image.getvalue(), title, caption)


def picture_block(picture: Picture) -> str:
    """A figure that is on disk.

    Raises OSError if its image cannot be read.
    """
    source = "" if picture.data is None else f" Data: {picture.data.name}."
    return embedded(picture.image.read_bytes(), picture.title, f"{picture.caption}{source}")


def cards(values: Mapping[str, tuple[str, bool | None]]) -> str:
    """Large numbers by what they are, each good, bad or neither."""
    colour = {None: "", True: " good", False: " bad"}
    boxes = "".join(
        f'<div class="card{colour[good]}">{escape(name)}<strong>{escape(text)}</strong></div>'
        for name, (text, good) in values.items()
    )
    return f'<div class="cards">{boxes}</div>'


def note(text: str) -> str:
    """A small remark."""
    return f'<p class="note">{escape(text)}</p>'
