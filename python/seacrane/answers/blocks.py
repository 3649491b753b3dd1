"""Parts that several sections are made of."""

from __future__ import annotations

import base64
import io
from collections.abc import Mapping
from html import escape
from typing import TYPE_CHECKING

from seacrane.plotting.panel import DOTS_PER_INCH, Picture

if TYPE_CHECKING:
    from matplotlib.figure import Figure


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
