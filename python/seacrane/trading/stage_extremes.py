"""What errors of a lift in stages are taken of: the extremes of each stage, whenever they are."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from seacrane.accuracy.quantities import Quantity
from seacrane.errors import SceneError
from seacrane.result.result import Result

Array = NDArray[np.float64]


def of_stages(quantity: Quantity) -> Quantity:
    """The least and the largest of each part in each stage: an event that moves by a moment moves none."""

    def values(result: Result) -> Array:
        found = quantity.values(result)
        spans = [found[result.stage(span.name)] for span in result.stages]
        if not all(len(span) for span in spans):
            raise SceneError(f"quantity {quantity.name!r}: a stage has no output; give a smaller dt_out")
        return np.stack([extreme for span in spans for extreme in (span.min(axis=0), span.max(axis=0))])

    return replace(quantity, values=values)
