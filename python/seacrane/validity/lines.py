"""Elastic lines whose length contradicts their path, and winches that met their limits."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.description.loads import lines_of
from seacrane.description.stretch import QUASI_STATIC

if TYPE_CHECKING:
    from seacrane.description.scene import Description

Array = NDArray[np.float64]
Finding = tuple[type[Warning], str]
LARGEST_CONTRADICTION = 0.01  # of the line's length, at the start
AT_END = 1e-6  # m


class LineLengthWarning(UserWarning):
    """A line starts far longer or shorter than its path: its length or a point is not what was meant."""


class WinchLimitWarning(UserWarning):
    """A winch met a limit: it did not do what it was commanded."""


class PushingLineWarning(UserWarning):
    """A quasi-static line pushed for a moment while it was stretched; an elastic one would be slack."""


def line_findings(scene: Description, time: Array, channels: Mapping[str, Array]) -> list[Finding]:
    """All of these in a run; channels left out are not judged."""
    lines = lines_of(scene.loads)
    if not lines or "line_unstretched_length" not in channels:
        return []
    lengths = np.asarray(channels["line_unstretched_length"]).reshape(time.size, len(lines))
    found: list[Finding] = []
    for (name, line), length in zip(lines.items(), lengths.T, strict=True):
        if line.winch:
            found += _met(name, line, time, length)
    if "line_tension" in channels:
        tensions = np.asarray(channels["line_tension"]).reshape(time.size, len(lines))
        found += [one for item in zip(lines.items(), tensions.T, strict=True) for one in _pushed(*item, time)]
    if "line_stretch" in channels and time[0] == 0.0:
        stretches = np.asarray(channels["line_stretch"]).reshape(time.size, len(lines))[0]
        found += _contradicted(list(lines), lengths[0], stretches)
    return found


def _contradicted(names: list[str], lengths: Array, stretches: Array) -> Iterator[Finding]:
    for name, length, stretch in zip(names, lengths, stretches, strict=True):
        if abs(stretch) <= LARGEST_CONTRADICTION * length:
            continue
        state = "stretched" if stretch > 0.0 else "slack"
        yield (
            LineLengthWarning,
            f"line {name!r}: starts {state} by {abs(stretch):.4g} m, {abs(stretch) / length:.3g} of its "
            f"unstretched {length:.6g} m: its path is {length + stretch:.6g} m long. Correct its length or "
            "its points, or take this as meant where the line starts slack",
        )


def _pushed(named: tuple[str, _core.Line], tension: Array, time: Array) -> Iterator[Finding]:
    name, line = named
    worst = int(np.argmin(tension))
    if line.stretch != QUASI_STATIC or tension[worst] >= 0.0:
        return
    yield (
        PushingLineWarning,
        f"line {name!r}: pushes with {-tension[worst]:.4g} N at t = {time[worst]:.6g} s: its stretch is "
        "quasi-static, and follows the tension too late to go slack. Give it stretch 'elastic'",
    )


def _met(name: str, line: _core.Line, time: Array, length: Array) -> Iterator[Finding]:
    ended = np.flatnonzero(length <= line.minimum_length + AT_END)
    if ended.size:
        yield (
            WinchLimitWarning,
            f"line {name!r}: its winch has hauled in to minimum_length, {line.minimum_length:.6g} m, at t = "
            f"{time[ended[0]]:.6g} s, and stops there. Haul in less, or give a smaller minimum_length",
        )
    command = np.abs(line.rate.evaluate(time)[:, 0])
    worst = int(np.argmax(command))
    if command[worst] > line.maximum_rate:
        yield (
            WinchLimitWarning,
            f"line {name!r}: its winch is commanded {command[worst]:.4g} m/s at t = {time[worst]:.6g} s, "
            f"beyond its maximum_rate of {line.maximum_rate:.4g} m/s, which it keeps. Command less, or give "
            "it more",
        )
