"""Values from outside turned into what the core takes, or a SceneError that names object, value and fix."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.errors import SceneError
from seacrane.inputs.shown import shown

Array = NDArray[np.float64]
FEW = 2000  # numbers, which are looked at one by one sooner than they are added


def text_of(what: str, value: Any, usual: str = "") -> str:
    """A printable text; None and the empty text stand for the usual one."""
    if value is None or (isinstance(value, str) and not value):
        value = usual or value
    if not isinstance(value, str) or not value.isprintable():
        raise SceneError.of(what, f"is {shown(value)}; give a name, a printable text")
    return str(value)


def name_of(kind: str, value: Any, usual: str = "") -> str:
    """A printable text that is not empty; None and the empty text stand for the usual one."""
    name = text_of(f"{kind}: name", value, usual)
    if not name:
        raise SceneError.of(f"{kind}: name", "is empty; give every element a name")
    return name


def texts_of(what: str, value: Any) -> list[str]:
    """A list of printable texts."""
    no_list = isinstance(value, (str, bytes, Mapping)) or not isinstance(value, Iterable)
    texts = [] if no_list else list(value)
    if no_list or not all(isinstance(text, str) for text in texts):
        raise SceneError.of(what, f"is {shown(value)}; give a list of texts")
    return [text_of(f"{what}[{i}]", text) for i, text in enumerate(texts)]


def flag_of(what: str, value: Any) -> bool:
    """A truth value, nothing that merely counts as one."""
    if not isinstance(value, (bool, np.bool_)):
        raise SceneError.of(what, f"is {shown(value)}; give True or False")
    return bool(value)


def number_of(what: str, value: Any) -> float:
    """A float; not a text that reads like one, nor a row of one number."""
    if getattr(value, "ndim", 0):
        kind, shape = type(value).__name__, getattr(value, "shape", "")
        raise SceneError.of(
            what, f"is a {kind} of shape {shape}; give a number: one of its values, not a row"
        )
    try:
        if isinstance(value, (str, bytes)):
            raise TypeError
        return float(value)
    except (TypeError, ValueError, OverflowError) as error:
        raise SceneError.of(what, f"is {shown(value)}; give a number") from error


def finite_of(what: str, value: Any, unit: str = "") -> float:
    """A number that is neither infinite nor none; the unit is for the error."""
    return _within(what, value, unit, -math.inf, "give a finite number")


def positive_of(what: str, value: Any, unit: str = "") -> float:
    """A finite number above zero."""
    return _within(what, value, unit, math.ulp(0.0), "give a finite number above zero")


def not_negative_of(what: str, value: Any, unit: str = "") -> float:
    """A finite number of zero or more."""
    return _within(what, value, unit, 0.0, "give a finite number, zero or more")


def _within(what: str, value: Any, unit: str, least: float, fix: str) -> float:
    number = number_of(what, value)
    if not (math.isfinite(number) and number >= least):
        raise SceneError.of(what, f"is {number}{unit and f' {unit}'}; {fix}")
    return number


def vector_of(what: str, value: Any) -> list[float]:
    """A list of floats from a one-dimensional array_like."""
    return [float(v) for v in shaped_of(what, value, (-1,), "one row of numbers")]


def numbers_of(what: str, value: Any) -> Array:
    """An array of floats of any shape; no texts that read like numbers, no dates."""
    require_unmasked(what, value)
    try:
        array = np.asarray(value)
        objects = array.flat if array.dtype.kind == "O" else ()
        if array.dtype.kind not in "biufO" or any(isinstance(item, (str, bytes)) for item in objects):
            raise TypeError
        return np.asarray(array, dtype=float)
    except (TypeError, ValueError, OverflowError) as error:
        raise SceneError.of(what, f"is {shown(value)}; give numbers") from error


def require_unmasked(what: str, value: Any) -> None:
    """Refuse NumPy's masked values, below which anything may stand."""
    if isinstance(value, np.ma.MaskedArray) and np.ma.is_masked(value):
        mask = np.ma.getmaskarray(value)
        place = ", ".join(str(int(i)) for i in np.argwhere(mask)[0])
        raise SceneError.of(
            what,
            f"has {int(mask.sum())} masked values, the first at [{place}]; leave such samples out, or "
            "fill them by seacrane.statistics.interpolated(time, values)",
        )


def shaped_of(what: str, value: Any, shape: tuple[int, ...], told: str = "") -> Array:
    """An array of floats of one shape, of which -1 is any length; `told`: how the error says it.

    An empty list is no rows.
    """
    array = numbers_of(what, value)
    if array.shape == (0,) and shape[:1] == (-1,):
        array = array.reshape(0, *(max(length, 0) for length in shape[1:]))
    fits = zip(array.shape, shape, strict=False)
    if array.ndim != len(shape) or any(length not in (-1, own) for own, length in fits):
        raise SceneError.of(what, f"has shape {array.shape}; give {told or shape}")
    return array


def rows_of(what: str, value: Any, width: int) -> Array:
    """Rows of so many numbers; an empty list is no rows."""
    return shaped_of(what, value, (-1, width), f"(n, {width})")


def matrix_of(what: str, value: Any) -> Array:
    """Rows of numbers, of any length; an empty list is none."""
    return shaped_of(what, value, (-1, -1), "rows of numbers")


def address_of(what: str, value: Any) -> int:
    """The address of a C function."""
    if not isinstance(value, int) or not 0 < value < 2**64:
        raise SceneError.of(what, f"is {value!r}; give the address of a C function")
    return value


def curve_of(what: str, value: Any) -> _core.Curve:
    """A curve, or a number as a constant one."""
    if isinstance(value, _core.Curve):
        return value
    return _core.Curve.constant(value=_within(what, value, "", -math.inf, "give a finite number or a curve"))


def is_finite(array: NDArray[Any]) -> bool:
    """A finite sum has finite terms; one that is not may be too large."""
    if array.size > FEW:
        with np.errstate(over="ignore", invalid="ignore"):
            if np.isfinite(array.sum()):
                return True
    return bool(np.isfinite(array).all())
