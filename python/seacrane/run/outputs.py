"""Outputs: what a run records, and how often."""

from __future__ import annotations

import os
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from seacrane.arrays import Array
from seacrane.errors import OutputMemoryError, SceneError
from seacrane.inputs.checked import number_of
from seacrane.inputs.keywords import named

DEFAULT_INTERVAL = 0.1  # s
MOST_OUTPUTS = 1e8
FARTHEST_TIME = 1e12  # s; doubles tell 1e-4 s apart there
COPIES = 2  # of the outputs: the rows of the loop, and the arrays of the result


@named
@dataclass(frozen=True, kw_only=True)
class Outputs:
    """What a run records, and how often.

    Attributes
    ----------
    dt_out : float
        Output interval, s. Outputs are interpolated, projected, then evaluated; they never shorten steps.
    channels : sequence of str, optional
        What to record, kept as a tuple; default: all default channels of the scene.

    Raises
    ------
    SceneError
        For an interval that is no number, or channels that are no list of names. Whether a scene has the
        channels is known when it is run.
    """

    dt_out: float = DEFAULT_INTERVAL
    channels: Iterable[str] | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "dt_out", number_of("dt_out", self.dt_out))
        if self.channels is None:
            return
        if isinstance(self.channels, str) or not isinstance(self.channels, Iterable):
            raise SceneError(f"channels is {self.channels!r}; give a list of channel names")
        object.__setattr__(self, "channels", tuple(self.channels))


def output_times(t_start: float, t_end: float, dt_out: float, *, first: float, values: int) -> Array:
    """Times from `first` in steps of dt_out to t_end, which is always among them.

    Parameters
    ----------
    t_start, t_end, dt_out, first : s; the core leaves out times before t_start.
    values : Numbers kept in memory of each; 0 where outputs leave memory.

    Raises
    ------
    SceneError
        Times that make no sense, or that doubles do not tell apart.
    OutputMemoryError
        More outputs than memory holds, before any is allocated.
    """
    given = {"start time": t_start, "t_end": t_end, "dt_out": dt_out, "outputs_from": first}
    for name, value in given.items():
        if not np.isfinite(value):
            raise SceneError(f"{name} is {value}; give a finite number of seconds")
    if t_end < t_start:
        raise SceneError(f"t_end is {t_end} s, before the start at {t_start} s")
    if first > t_start:
        raise SceneError(f"outputs_from is {first} s, after the start at {t_start} s")
    if dt_out <= 0.0:
        raise SceneError(f"dt_out is {dt_out} s; make it positive")
    if (t_end - first) / dt_out > MOST_OUTPUTS:
        raise SceneError(
            f"dt_out is {dt_out} s: more than {MOST_OUTPUTS:.0e} outputs until {t_end} s; make it longer"
        )
    count = int(np.floor((t_end - first) / dt_out * (1.0 + 1e-12))) + 1
    last = max(abs(first), abs(t_end))
    if last > FARTHEST_TIME:
        raise SceneError(
            f"t_end or the start time is {last:.6g} s, beyond {FARTHEST_TIME:.0e} s, where doubles no longer "
            "resolve a step; start nearer to 0"
        )
    if np.spacing(last) > 1e-3 * dt_out:
        raise SceneError(
            f"dt_out is {dt_out} s, which time does not resolve at {last:.6g} s (it is exact to "
            f"{np.spacing(last):.2g} s); make it longer, or start nearer to 0"
        )
    needed, memory = COPIES * 8 * count * (values + 1), _physical_memory()
    if needed > memory:
        raise OutputMemoryError(
            f"outputs: {count} times {values} values need {needed:.3g} bytes, this computer has "
            f"{memory:.3g}; make dt_out longer, or record fewer channels (channels=[...])"
        )
    times = first + dt_out * np.arange(count)
    return np.append(times, t_end) if t_end - times[-1] > 1e-9 * dt_out else np.minimum(times, t_end)


def _physical_memory() -> float:
    """Bytes; infinity where the system does not tell."""
    try:
        return float(os.sysconf("SC_PAGE_SIZE")) * float(os.sysconf("SC_PHYS_PAGES"))
    except (AttributeError, ValueError, OSError):
        return float("inf")
