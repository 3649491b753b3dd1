"""What an axis of the atlas is: one quantity driven far beyond use, and the scene at each of its values."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from seacrane import Scene, _core

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class Case:
    """One scene to run.

    Attributes
    ----------
    scene : Scene
    t_end, dt_out : float
        s.
    start : State, optional
        Where to begin; default: the assembled start.
    truth : tuple of ndarray, optional
        Positions (n, bodies, 3) and quaternions (n, bodies, 4) at the outputs, known otherwise than by tight
        runs of the same scene.
    """

    scene: Scene
    t_end: float
    dt_out: float
    start: _core.State | None = None
    truth: tuple[Array, Array] | None = None


@dataclass(frozen=True, kw_only=True, eq=False)
class Axis:
    """One axis of the atlas.

    Attributes
    ----------
    name, title : str
        In tables and file names; in words.
    label : str
        Of the values, with their unit.
    values : tuple of float
        Those of the full atlas.
    quick : tuple of float
        Those of a quick one.
    case : callable
        The case at a value.
    limit_s : float
        Processor time that one run may take, s.
    long : tuple of float
        Values of the full atlas that only the default setting runs, within `long_limit_s` each.
    long_limit_s : float
        s.
    """

    name: str
    title: str
    label: str
    values: tuple[float, ...]
    quick: tuple[float, ...]
    case: Callable[[float], Case]
    limit_s: float = 1.0
    long: tuple[float, ...] = ()
    long_limit_s: float = 120.0
