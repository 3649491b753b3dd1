"""Lines with mass in a result: what their segments tell together."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from seacrane.errors import SceneError
from seacrane.inputs.checked import name_of

if TYPE_CHECKING:
    from seacrane.result.result import Result

Array = NDArray[np.float64]


def heavy_line_tension(result: Result, *, line: str) -> Array:
    """Tension at both ends of a line with mass, of `Scene.add_line`.

    Extrapolated from the two segments next to each end, whose tension is that of their middle.

    Parameters
    ----------
    result : Result
        With the channel `line_tension`.
    line : str
        Its name.

    Returns
    -------
    ndarray, shape (n, 2)
        N, at the first end and at the last, over the outputs.

    Raises
    ------
    SceneError
        For a line that is not in the result, or a result without that channel.
    """
    name = name_of("heavy line", line)
    if "line_tension" not in result:
        raise SceneError(
            f"heavy line {name!r}: the result has no channel 'line_tension'; leave it in channels"
        )
    every = result.coords["line"]
    own = [i for i, one in enumerate(every) if re.fullmatch(re.escape(name) + r"\.\d+", one)]
    if not own:
        raise SceneError(f"heavy line {name!r}: is not in the result, which has the lines {', '.join(every)}")
    tension = np.asarray(result["line_tension"]).reshape(result.time.size, len(every))[:, own]
    if len(own) == 1:
        return np.repeat(tension, 2, axis=1)
    near, far = tension[:, [0, -1]], tension[:, [1, -2]]
    return np.asarray(1.5 * near - 0.5 * far)
