"""Whether arrays hold finite numbers alone."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

FEW = 2000  # numbers, which are looked at one by one sooner than they are added


def is_finite(array: NDArray[Any]) -> bool:
    """A finite sum has finite terms; one that is not may be too large."""
    if array.size > FEW:
        with np.errstate(over="ignore", invalid="ignore"):
            if np.isfinite(array.sum()):
                return True
    return bool(np.isfinite(array).all())
