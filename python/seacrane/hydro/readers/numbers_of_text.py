"""Numbers as Fortran writes them: D exponents, exponents without their letter, and stars."""

from __future__ import annotations

import math
import re

NUMBER = r"[-+]?(?:\d+(?:\.\d*)?|\.\d+)(?:[EeDd][-+]?\d+|[-+]\d{2,4})?"
LETTERLESS = re.compile(r"([-+]?(?:\d+(?:\.\d*)?|\.\d+))([-+]\d{2,4})")  # 1.2-101: no room for the E


def number_of_word(word: str) -> float:
    """The finite number that a word of a file stands for.

    Raises ValueError: the word, and what to do; the caller names file and line.
    """
    if "*" in word:
        raise ValueError(
            f"{word[:40]!r} stands for a number that did not fit its column; write the file again in wider "
            "columns, or correct the line"
        )
    plain = LETTERLESS.fullmatch(word)
    text = f"{plain[1]}E{plain[2]}" if plain else word.replace("D", "E").replace("d", "e")
    try:
        if "_" in text:
            raise ValueError
        value = float(text)
    except ValueError:
        raise ValueError(f"{word[:40]!r} is not a number") from None
    if not math.isfinite(value):
        raise ValueError(f"{word[:40]!r} is not a finite number")
    return value


def is_number(word: str) -> bool:
    """Whether a word stands for a number, or for one that did not fit its column."""
    return re.fullmatch(rf"{NUMBER}|\*+", word) is not None or word.lower().lstrip("+-") in ("nan", "inf")
