"""What a sea loads or moves a vessel by, as bytes and back, and the digest that tells one from another."""

from __future__ import annotations

import hashlib
import json
import math
from dataclasses import fields, is_dataclass
from functools import lru_cache
from types import NoneType, UnionType
from typing import Any, get_args, get_origin, get_type_hints

import numpy as np

from seacrane.errors import SceneError
from seacrane.hydro.data.hydro_data import AdditionalMatrices, DriftCoefficients, RollDamping
from seacrane.hydro.data.hydro_group_data import GroupBody
from seacrane.hydro.data.memory_model import (
    FitRow,
    MemoryBlock,
    MemoryModel,
    MotionError,
    MotionFit,
    Passivity,
)

KIND, ARRAY = "$kind", "$array"
STORED = {"f": "<f8", "c": "<c16", "i": "<i8"}  # types of arrays, by the kind that NumPy calls them
NOT_PACKED = (ValueError, TypeError, LookupError, AttributeError, RecursionError, SceneError)
PARTS: tuple[type, ...] = (
    AdditionalMatrices, RollDamping, GroupBody, DriftCoefficients, MemoryModel, MemoryBlock, FitRow,
    Passivity, MotionFit, MotionError,
)  # fmt: skip


_hints = lru_cache(get_type_hints)


@lru_cache(maxsize=16)
def digest_of(source: Any) -> str:
    """SHA-256 of all that a database or a table of motions holds."""
    return hashlib.sha256(packed(source)).hexdigest()


def packed(source: Any) -> bytes:
    """A line of JSON, and after it the numbers of its arrays; an entry that is None is left out."""
    arrays: list[bytes] = []
    told = json.dumps(_told(source, arrays))
    return b"".join([told.encode("ascii"), b"\n", *arrays])


def _told(value: Any, arrays: list[bytes]) -> Any:
    if is_dataclass(value) and not isinstance(value, type):
        hints = _hints(type(value))
        parts = {entry.name: getattr(value, entry.name) for entry in fields(value)}
        numbers = {name: float(part) for name, part in parts.items() if hints[name] is float}
        known = {name: part for name, part in (parts | numbers).items() if part is not None}
        return {KIND: type(value).__name__} | {name: _told(part, arrays) for name, part in known.items()}
    if isinstance(value, np.ndarray):
        kept = np.ascontiguousarray(value, dtype=STORED[value.dtype.kind])
        arrays.append(kept.tobytes())
        return {ARRAY: STORED[value.dtype.kind], "shape": list(kept.shape)}
    if isinstance(value, np.generic):
        return value.item()
    return [_told(part, arrays) for part in value] if isinstance(value, tuple | list) else value


def unpacked(data: bytes, roots: tuple[type, ...]) -> Any:
    """What `packed` wrote, which is one of `roots`; runs no code but the constructors of these.

    Raises One of NOT_PACKED for anything else.
    """
    told, _, rest = data.partition(b"\n")
    kinds = {kind.__name__: kind for kind in (*roots, *PARTS)}
    at = 0

    def array(kind: str, shape: list[int]) -> np.ndarray[Any, Any]:
        """The next of the arrays, which stand one after another."""
        nonlocal at
        if kind not in STORED.values() or not all(type(size) is int and size >= 0 for size in shape):
            raise ValueError(f"it holds an array of {kind!r} and shape {shape}")
        count, first = math.prod(shape), at
        at += count * np.dtype(kind).itemsize
        if at > len(rest):
            raise ValueError("it ends within an array")
        return np.frombuffer(rest, kind, count, first).reshape(shape)

    def made(told: Any) -> Any:
        if isinstance(told, list):
            return tuple(map(made, told))
        if not isinstance(told, dict):
            return told
        if ARRAY in told:
            return array(told[ARRAY], told["shape"])
        kind = kinds[told[KIND]]
        parts = {name: made(part) for name, part in told.items() if name != KIND}
        for name, part in parts.items():
            if not _fits(part, _hints(kind)[name]):
                raise ValueError(f"its {name} is a {type(part).__name__}")
        return kind(**parts)

    found = made(json.loads(told))
    if not isinstance(found, roots):
        raise ValueError(f"it holds a {type(found).__name__}")
    return found


def _fits(value: Any, hint: Any) -> bool:
    """Whether a value is of a type as annotated."""
    origin, arguments = get_origin(hint), get_args(hint)
    if hint is Any:
        return True
    if origin is UnionType:
        return any(_fits(value, one) for one in arguments if one is not NoneType)
    if origin is np.ndarray:
        return isinstance(value, np.ndarray) and value.dtype == get_args(arguments[1])[0]
    if origin is tuple:
        if not isinstance(value, tuple):
            return False
        every = [arguments[0]] * len(value) if arguments[-1] is Ellipsis else arguments
        return all(_fits(*pair) for pair in zip(value, every, strict=True))
    whole = hint is float and isinstance(value, int)
    return (isinstance(value, hint) or whole) and (hint is bool or not isinstance(value, bool))
