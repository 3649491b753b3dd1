"""Values from outside turned into what the core takes, or a SceneError that names object, value and fix: the
checks of the core itself."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane._core import (
    curve_of,
    finite_of,
    flag_of,
    matrix_of,
    name_of,
    not_negative_of,
    number_of,
    numbers_of,
    positive_of,
    require_unmasked,
    rows_of,
    shaped_of,
    text_of,
    texts_of,
    vector_of,
)

__all__ = [
    "curve_of", "finite_of", "flag_of", "is_finite", "matrix_of", "name_of", "not_negative_of", "number_of",
    "numbers_of", "positive_of", "require_unmasked", "rows_of", "shaped_of", "text_of", "texts_of",
    "vector_of",
]  # fmt: skip
FEW = 2000  # numbers, whose squares are added sooner than a sum is asked not to warn


def is_finite(array: NDArray[Any]) -> bool:
    """A finite sum, of terms or of their squares, has finite terms; one that is not may be too large."""
    if array.size > FEW:
        with np.errstate(over="ignore", invalid="ignore"):
            found = array.sum()
    else:
        found = np.vdot(array, array)
    return bool(np.isfinite(found) or np.isfinite(array).all())
