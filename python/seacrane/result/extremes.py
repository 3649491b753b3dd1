"""What curves reached between outputs: least and largest values from the steps of a run."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from seacrane.description.channels import LARGEST, LEAST
from seacrane.result.about import StageSpan

Array = NDArray[np.float64]
Extremes = Mapping[str, tuple[Array, Array]]  # least and largest values by channel


class Timed(Protocol):
    """A `Result`."""

    @property
    def time(self) -> Array: ...
    @property
    def stages(self) -> tuple[StageSpan, ...]: ...


def as_arrays(extremes: Extremes) -> dict[str, Array]:
    """As arrays with names of their own, which files hold beside the channels."""
    return {
        name + ending: array
        for name, both in extremes.items()
        for ending, array in zip((LEAST, LARGEST), both, strict=True)
    }


def parted(arrays: Mapping[str, Array]) -> tuple[dict[str, Array], dict[str, tuple[Array, Array]]]:
    """Channels, and their least and largest values, of `as_arrays` beside channels."""
    extremes = {name: (arrays[name + LEAST], arrays[name + LARGEST])
                for name in arrays if name + LEAST in arrays and name + LARGEST in arrays}  # fmt: skip
    own = as_arrays(extremes)
    return {name: array for name, array in arrays.items() if name not in own}, extremes


def inside(result: Timed, part: slice, values: Array, bound: Array) -> Array:
    """Least or largest values (n,) of a part of the outputs, whose values are `values`.

    What was before the first output of the part counts if the part begins at the output before it: at the
    start of a stage.
    """
    out = bound[part]
    if not len(out) or part.start == 0:
        return out
    before = float(result.time[part.start - 1])
    if any(span.start == before for span in result.stages):
        return out
    return np.concatenate([values[part][:1], out[1:]])
