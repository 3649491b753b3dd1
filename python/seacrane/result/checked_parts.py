"""What a result may be made of: arrays, times, names and counters, checked as they come."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.inputs.checked import is_finite
from seacrane.result.about import NAMES

Array = NDArray[np.float64]
Stat = str | int | float


ALWAYS_STATED = [
    "seacrane_version",
    "scene",
    "formulation",
    "integrator",
    "simulated_s",
    "wall_s",
    "evaluations",
    "steps",
    "rejected_steps",
    "states",
    "coordinates",
    "constraints",
    "degrees_of_freedom",
    "compiled_coordinates",
    "compiled_constraints",
]


def checked_array(name: str, values: Any, shape: tuple[int, ...], gaps: bool) -> Array:
    """The values as a read-only float64 array of the stated shape; `gaps`: some may be no numbers."""
    array = np.asarray(values, dtype=np.float64)
    if array.shape != shape:
        raise ValueError(f"channel {name!r} has shape {array.shape}; its dimensions ask for {shape}")
    if not gaps and not is_finite(array):
        first = int(np.argwhere(~np.isfinite(array.reshape(len(array), -1)).all(axis=1))[0, 0])
        raise ValueError(
            f"channel {name!r} is not finite at output {first} of a finished run; "
            "leave out a channel that is not defined for the scene"
        )
    array.setflags(write=False)
    return array


def checked_time(values: Any) -> Array:
    time = np.asarray(values, dtype=np.float64)
    if time.ndim != 1 or not time.size:
        raise ValueError(f"time has shape {time.shape}; a result needs a vector of at least one output time")
    if not np.isfinite(time).all() or np.any(np.diff(time) <= 0):
        raise ValueError("time must be finite and strictly increasing")
    time.setflags(write=False)
    return time


def checked_names(dim: str, names: Sequence[str]) -> tuple[str, ...]:
    names = tuple(str(name) for name in names)
    if len(set(names)) != len(names):
        twice = sorted(name for name, count in Counter(names).items() if count > 1)
        raise ValueError(f"{dim} names must differ; given more than once: {', '.join(twice)}")
    return names


def checked_stats(stats: Mapping[str, Any]) -> dict[str, Stat]:
    """Plain strings, integers and floats, none missing that every result states; what is None is left out."""
    plain = plain_stats(stats)
    missing = [name for name in ALWAYS_STATED if name not in plain]
    if missing:
        raise ValueError(f"stats lack {', '.join(missing)}; every result states them")
    return plain


def plain_stats(stats: Mapping[str, Any]) -> dict[str, Stat]:
    """Plain strings, integers and floats; what is None is left out."""
    plain: dict[str, Stat] = {}
    for name, value in stats.items():
        if name in NAMES:
            raise ValueError(f"stats hold numbers and words; give {name!r} in about=About({name}=...)")
        if value is None:
            continue
        if type(value) is str or type(value) is int:
            plain[name] = value
            continue
        if isinstance(value, np.generic):
            value = value.item()
        if isinstance(value, bool):
            value = int(value)
        if not isinstance(value, (str, int, float)):
            raise ValueError(f"stat {name!r} is a {type(value).__name__}; give a string or a number")
        if isinstance(value, float) and math.isnan(value):
            raise ValueError(f"stat {name!r} is not a number; leave out what is not defined")
        plain[name] = value
    return plain
