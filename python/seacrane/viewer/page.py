"""The page as text: the template with its style, script, caption and numbers filled in."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from functools import cache
from html import escape
from importlib.resources import files
from typing import Any

SLOT = re.compile(r"@@(\w+)@@")
INSIDE_SCRIPT = {"<": "\\u003c", ">": "\\u003e", "&": "\\u0026", "\u2028": "\\u2028", "\u2029": "\\u2029"}


def page(*, title: str, caption: Sequence[tuple[str, str]], data: Mapping[str, Any], blob: str) -> str:
    """One page with everything inside; all names in it appear as text.

    Parameters
    ----------
    title : str
    caption : sequence of (str, str)
        Rows of what and its words.
    data : mapping
        Plain data for the script.
    blob : str
        Its arrays, base64.
    """
    rows = "".join(f"<tr><th>{escape(what)}</th><td>{escape(words)}</td></tr>" for what, words in caption)
    filled = {
        "title": escape(title),
        "style": _asset("page.css"),
        "caption": rows,
        "data": json_text(data),
        "blob": blob,
        "script": script(),
    }
    return SLOT.sub(lambda slot: filled[slot[1]], _asset("page.html"))


def json_text(data: Any) -> str:
    """JSON that no HTML parser takes for markup, wherever it stands."""
    text = json.dumps(data, allow_nan=False, separators=(",", ":"))
    return re.sub("[<>&\u2028\u2029]", lambda found: INSIDE_SCRIPT[found[0]], text)


def script() -> str:
    """The bundle, with what would end its element escaped."""
    return re.sub(r"</(script)", r"<\\/\1", _asset("viewer.js"), flags=re.IGNORECASE).replace(
        "<!--", "<\\!--"
    )


@cache
def _asset(name: str) -> str:
    return (files("seacrane") / "viewer" / "assets" / name).read_text(encoding="utf-8")
