"""How a cost grows with a size."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np


def exponent(sizes: Sequence[float], costs: Sequence[float], smallest: float) -> float:
    """Slope of the cost over the size in logarithms, from the smallest size that counts on."""
    x, y = np.array(sizes, dtype=float), np.array(costs, dtype=float)
    large = x >= smallest
    return float(np.polyfit(np.log(x[large]), np.log(y[large]), 1)[0])
