"""Values from outside as they appear in messages: short, whatever they are."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

LONGEST = 60  # characters
MOST_NAMES = 12


def shown(value: Any) -> str:
    """The value as Python writes it, cut after 60 characters; integers of thousands of digits included."""
    try:
        text = repr(value)
    except (ValueError, RecursionError):  # too many digits, too deeply nested
        text = f"a {type(value).__name__}"
    return text if len(text) <= LONGEST else text[:LONGEST] + "..."


def listed(names: Sequence[str]) -> str:
    """Names for a message, of which there may be many."""
    more = f" and {len(names) - MOST_NAMES} more" if len(names) > MOST_NAMES else ""
    return f"{', '.join(name[:LONGEST] for name in names[:MOST_NAMES])}{more}"
