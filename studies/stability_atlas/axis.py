"""What an axis of the atlas is: one quantity driven far beyond use, and the scene at each of its values."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from seacrane.accuracy.case import Case


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
