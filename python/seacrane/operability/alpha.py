"""The alpha factor: what a forecast must stay below, over what the lift can bear."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from seacrane.arrays import Array
from seacrane.errors import SceneError
from seacrane.inputs.checked import number_of, numbers_of, text_of
from seacrane.inputs.shown import shown

NO_SOURCE = "none: forecasts are taken as certain"


@dataclass(frozen=True, kw_only=True)
class AlphaFactor:
    """Forecast Hs over allowable Hs, for the uncertainty of forecasts.

    Attributes
    ----------
    values : float or array_like, shape (periods, heights)
        Above 0, up to 1.
    source : str
        Where they come from, such as the edition and the table of a standard. Not empty, unless the value
        is 1.
    hours : array_like, shape (periods,), optional
        Of a table: longest planned period of the operation of each row, ascending. A period between two takes
        the longer one's row.
    hs : array_like, shape (heights,), optional
        Of a table: allowable Hs of each column, m, ascending; linear in between, held outside.

    Raises
    ------
    SceneError
        For a value that makes no sense, a table of another shape, or no source.
    """

    values: Any = 1.0
    source: str = ""
    hours: Any = ()
    hs: Any = ()

    def __post_init__(self) -> None:
        values = numbers_of("alpha factor: values", self.values)
        hours, hs = (ascending(f"alpha factor: {name}", getattr(self, name)) for name in ("hours", "hs"))
        if values.shape != ((len(hours), len(hs)) if hours or hs else ()):
            raise SceneError(
                f"alpha factor: values have shape {values.shape}, hours {len(hours)} and hs {len(hs)} "
                "entries; give one number, or a row for each of the hours and a column for each hs"
            )
        if not np.all((values > 0.0) & (values <= 1.0)):
            raise SceneError(f"alpha factor: values are {values.tolist()}; give numbers above 0, up to 1")
        source = text_of("alpha factor: source", self.source or NO_SOURCE)
        if source == NO_SOURCE and not np.all(values == 1.0):
            raise SceneError(
                f"alpha factor: {values.tolist()} has no source; name the standard, its edition and its table"
            )
        plain = tuple(map(tuple, values.tolist())) if hours else float(values)
        for name, value in (("values", plain), ("source", source), ("hours", hours), ("hs", hs)):
            object.__setattr__(self, name, value)

    def at(self, hs: Any, *, hours: float) -> Array:
        """The factor for allowable Hs (m), any shape, and a planned period of operation (h).

        Raises
        ------
        SceneError
            For a period longer than all of a table.
        """
        heights = np.asarray(hs, dtype=float)
        if not self.hours:
            return np.full(heights.shape, self.values)
        row = int(np.searchsorted(self.hours, hours))
        if row == len(self.hours):
            raise SceneError(
                f"alpha factor: the operation takes {hours:g} h, the table ends at {self.hours[-1]:g} h; "
                "longer ones are planned by the statistics of the season"
            )
        return np.asarray(np.interp(heights, self.hs, self.values[row]))

    def told(self, *, hours: float) -> str:
        """The factor in words."""
        if not self.hours:
            return f"alpha factor {self.values:g} (source: {self.source})"
        return f"alpha factor of {hours:g} h by a table (source: {self.source})"


def ascending(what: str, given: Any, *, fewest: int = 0, above_zero: bool = False) -> tuple[float, ...]:
    """One row of ascending finite numbers, at least so many, or a SceneError."""
    values = np.atleast_1d(numbers_of(what, given))
    sound = values.ndim == 1 and values.size >= fewest and np.all(np.isfinite(values))
    if not sound or np.any(np.diff(values) <= 0.0):
        least = f"at least {fewest} " if fewest > 1 else ""
        raise SceneError(f"{what} is {shown(given)}; give {least}ascending finite numbers")
    if above_zero and values[0] <= 0.0:
        raise SceneError(f"{what} begins with {values[0]:g}; give numbers above zero")
    return tuple(values.tolist())


def alpha_of(given: Any) -> AlphaFactor:
    """An AlphaFactor; 1 is one without a source."""
    if isinstance(given, AlphaFactor):
        return given
    value = number_of("alpha", given)
    if value != 1.0:
        raise SceneError(
            f"alpha is {value:g}; give AlphaFactor(values={value:g}, source='...'), which tells its source"
        )
    return AlphaFactor()
