"""What a comparison with a measured set is: where the set is from, and rows of it."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
Series = tuple[ArrayLike, ArrayLike]
HEAD = (
    "set",
    "compared",
    "by",
    "largest, %",
    "where",
    "mean, %",
    "of the",
    "repeats within, %",
    "expected, %",
)


@dataclass(frozen=True, kw_only=True)
class Source:
    """Where a reader finds the set: title, repository, commit, licence, who measured it.

    `quoted`: its few numbers stand in its module, and it needs no folder of data.
    """

    title: str
    repository: str
    commit: str
    licence: str
    about: str
    quoted: bool = False


@dataclass(frozen=True, kw_only=True)
class MeasuredRow:
    """One quantity of a set, as measured and as computed in one way.

    Attributes
    ----------
    picture, panel : str
        The file of its picture, without ending, and the panel there. Rows of a panel share its measurement.
    compared, by : str
        What, and how it was computed.
    x, y : str
        Names of the axes.
    at, measured, ours : (n,)
        The points that are compared.
    of : {"value", "range"}
        What differences count over: the measured value, or the largest less the smallest of `points`.
    points : (x, y)
        All that was measured, for the picture; `spread` (low, high) of each point or None.
    line : (x, y)
        What was computed, for the picture.
    others : dict
        Further curves (x, y) by name.
    repeats : float or None
        Within which share repetitions of the measurement agree; None: not repeated.
    expected : float or None
        Largest difference that the theory should have; None: shown, not judged.
    joined : bool
        Whether the points of `line` are joined.
    logarithmic : bool
        Whether y is.
    told : str
        What `points` are, for the picture.
    """

    picture: str
    panel: str
    compared: str
    by: str
    x: str
    y: str
    at: ArrayLike
    measured: ArrayLike
    ours: ArrayLike
    of: str
    points: Series
    line: Series
    spread: Series | None = None
    others: dict[str, Series] = field(default_factory=dict)
    repeats: float | None = None
    expected: float | None = None
    joined: bool = True
    logarithmic: bool = False
    told: str = "measured"

    @property
    def differences(self) -> Array:
        """Ours less measured, over what `of` says."""
        measured = np.asarray(self.measured, dtype=float)
        every = np.asarray(self.points[1], dtype=float)
        scale = np.abs(measured) if self.of == "value" else np.ptp(every)
        return np.asarray((np.asarray(self.ours) - measured) / scale)

    @property
    def largest(self) -> float:
        """The largest difference, signed."""
        return float(self.differences[np.abs(self.differences).argmax()])

    @property
    def where(self) -> float:
        """At which it is."""
        return float(np.asarray(self.at)[np.abs(self.differences).argmax()])

    def cells(self, name: str) -> tuple[str, ...]:
        """In the order of HEAD."""
        unit = self.x.partition(", ")[2]
        return (
            name,
            self.compared,
            self.by,
            f"{100.0 * self.largest:+.1f}",
            f"{self.where:.4g} {unit}".strip(),
            f"{100.0 * float(self.differences.mean()):+.1f}",
            self.of,
            "" if self.repeats is None else f"{100.0 * self.repeats:.1f}",
            "" if self.expected is None else f"{100.0 * self.expected:.0f}",
        )
