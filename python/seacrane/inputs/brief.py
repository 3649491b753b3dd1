"""A line about a dataclass that holds arrays: their shapes, never their numbers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from typing import Any

import numpy as np

FEW = 6  # entries that are shown themselves
LETTERS = 40  # of a text or of what an object says of itself


def brief(self: Any) -> str:
    """For ``__repr__ = brief`` in the body of a dataclass."""
    values = {one.name: getattr(self, one.name) for one in fields(self) if one.repr}
    told = (f"{name}={_in_short(value)}" for name, value in values.items() if value is not None)
    return f"<{type(self).__name__} {', '.join(told)}>"


def _in_short(value: Any) -> str:
    if isinstance(value, np.ndarray):
        small = value.ndim < 2 and value.size <= FEW
        return f"({', '.join(map(_number, value.ravel()))})" if small else f"array {value.shape}"
    if isinstance(value, (int, float, complex, np.number)):
        return _number(value)
    if isinstance(value, Mapping):
        return f"{len(value)} entries"
    if isinstance(value, (list, tuple)):
        whole = repr(value)
        return whole if len(whole) <= LETTERS else f"{len(value)} entries"
    whole = repr(value)
    return (
        whole
        if len(whole) <= LETTERS
        else type(value).__name__
        if whole[0] == "<"
        else f"{whole[:LETTERS]}..."
    )


def _number(value: Any) -> str:
    return str(value) if isinstance(value, (bool, np.bool_, int, np.integer)) else f"{value:.6g}"
