"""What a user sees of an object at a prompt: its class, its name, and the numbers and texts it holds."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from seacrane.inputs.shown import shown

SHORT = 4  # numbers of an array that are written out
MEMBERS = {  # of objects whose other properties are long, or take time to find
    "Model": ("coordinates", "constraints", "degrees_of_freedom", "states"),
    "Frame": ("point",),
    "TwistHistory": ("start", "intervals"),
    "StepHistory": ("formulation", "integrator"),
}


SPECIAL: dict[str, Callable[[Any], str]] = {
    "Curve": lambda curve: (
        f"{curve.evaluate([0.0])[0, 0]:g} at 0 s, pieces {len(curve.to_pieces()['starts'])}"
    ),
    "State": lambda state: f"time {state.time:g} s, {len(state.values)} values, {len(state.inputs)} inputs",
}


def described(thing: Any) -> str:
    """One line, such as "<Body 'payload': mass 20000, position (0, 0, 5), gravity True>"."""
    kind = type(thing)
    if kind.__name__ in SPECIAL:
        return f"<{kind.__name__}: {SPECIAL[kind.__name__](thing)}>"
    names = MEMBERS.get(kind.__name__) or [
        name for name, member in vars(kind).items() if isinstance(member, property) and name != "name"
    ]
    told = [(name, _short(getattr(thing, name))) for name in names]
    title = " ".join([kind.__name__, *([repr(thing.name)] if hasattr(thing, "name") else [])])
    inside = ", ".join(f"{name} {value}" for name, value in told if value)
    return f"<{title}: {inside}>" if inside else f"<{title}>"


def _short(value: Any) -> str:
    """A number, a text, or a row of few numbers; nothing for what is longer."""
    if isinstance(value, str):
        return shown(value) if value else ""
    if isinstance(value, bool | np.bool_):
        return str(bool(value))
    if isinstance(value, int | float):
        return f"{value:g}"
    try:
        row = np.asarray(value, dtype=float)
    except (TypeError, ValueError):
        return ""
    if row.ndim != 1 or not 0 < row.size <= SHORT:
        return ""
    return f"({', '.join(f'{number:g}' for number in row)})"
