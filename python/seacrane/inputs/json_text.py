"""JSON from outside, parsed in bounded memory."""

from __future__ import annotations

import json
from typing import Any

from seacrane.errors import FileFormatError

# Bytes that Python takes for an empty list, an empty object and a text, beside what is in them.
LIST, OBJECT, TEXT = 88, 288, 88
LOOSEST = 16  # times its bytes, which lists, objects and texts of a document may take
SMALL = 2**20  # bytes that they may take in any document


def json_of(data: bytes, place: str, **hooks: Any) -> Any:
    """The document in some bytes, by `json.loads` and its hooks; `place` is where they are, for messages.

    Raises FileFormatError, with line and column, for what is no JSON, nested too deeply, or only brackets.
    """
    taken = LIST * data.count(b"[") + OBJECT * data.count(b"{") + TEXT * data.count(b'"') // 2
    if taken > LOOSEST * len(data) + SMALL:
        raise FileFormatError(
            f"{place}: its lists, objects and texts would take {taken / 2**20:.4g} MiB of memory, far above "
            f"its {len(data) / 2**20:.3g} MiB; it holds too little else"
        )
    try:
        return json.loads(data.decode("utf-8"), **hooks)
    except json.JSONDecodeError as error:
        raise FileFormatError(
            f"{place} line {error.lineno}, column {error.colno}: {error.msg}; truncated or malformed JSON"
        ) from error
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        raise FileFormatError(f"{place} line {line}: byte {error.start} is not UTF-8 text") from error
    except RecursionError as error:
        raise FileFormatError(f"{place}: is nested too deeply") from error
    except ValueError as error:
        raise FileFormatError(f"{place}: {error}") from error
