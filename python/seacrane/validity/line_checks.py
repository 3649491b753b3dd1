"""Elastic lines whose length contradicts their path, and winches that met their limits."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.description.loads import lines_of, whole_of, winch_of, winches_of
from seacrane.description.rungs import QUASI_STATIC
from seacrane.description.suspension import line_weights
from seacrane.inputs.caller import warn_caller
from seacrane.warnings import (
    FleetAngleWarning,
    LineLengthWarning,
    LineTableWarning,
    PushingLineWarning,
    WinchLimitWarning,
)

if TYPE_CHECKING:
    from seacrane.description.description import Description

Array = NDArray[np.float64]
Finding = tuple[type[Warning], str]
LARGEST_CONTRADICTION = 0.01  # of the line's length, at the start
AT_END = 1e-6  # m
STRONGEST = 1e12  # N or W: a bound here or beyond is none
LARGEST_FLEET_ANGLE = 4.0  # degrees, the usual bound for ropes of cranes


class _Bound(NamedTuple):
    """What a winch does at a bound, and what to give."""

    unit: str
    then: str
    fix: str


BOUNDS = {
    "maximum_tension": _Bound("N", "so that its motor holds no more, and the load may fall", "Lift less"),
    "maximum_power": _Bound("W", "so that its motor gives no more", "Lift slower"),
    "brake_capacity": _Bound("N", "so that its brake slips", "Close it on less"),
}


def bound_findings(scene: Description, reached: Iterable[tuple[float, str]]) -> list[Finding]:
    """Bounds of winches that were reached, by the times (s) and names of events; rates and ends apart."""
    lines, first = winches_of(scene.loads), {name: time for time, name in sorted(reached, reverse=True)}
    return [
        (
            WinchLimitWarning,
            f"line {name!r}: its winch reached its {bound}, {getattr(line, bound):.4g} {of.unit}, at t = "
            f"{first[f'{name}.{bound}']:.6g} s, {of.then}. {of.fix}, or give it more",
        )
        for name, line in lines.items()
        for bound, of in BOUNDS.items()
        if f"{name}.{bound}" in first
    ]


def warn_of_connected(
    title: str, scene: Description, name: str, measured: Mapping[str, Array], time: float
) -> None:
    """Warn of a line that a stage connects at `time` (s) and that is too short for where its ends are."""
    lines = lines_of(scene.loads)
    at = list(lines).index(name)
    length, stretch, tension = (
        float(np.ravel(measured[channel])[at])
        for channel in ("line_unstretched_length", "line_stretch", "line_tension")
    )
    usual = max([LARGEST_CONTRADICTION, *lines[name].strains]) + strains_at_rest(scene).get(name, 0.0)
    if stretch > usual * length:
        warn_caller(
            f"{title}: line {name!r} connects stretched by {stretch:.4g} m, {stretch / length:.3g} of its "
            f"unstretched {length:.6g} m, at t = {time:.6g} s: it pulls with {tension:.4g} N at once. Give "
            f"it {length + stretch:.6g} m, pay out before, or connect it nearer",
            LineLengthWarning,
        )


def line_findings(
    scene: Description, time: Array, channels: Mapping[str, Array], *, described: bool = True
) -> list[Finding]:
    """All of these in a run; channels left out are not judged, nor lengths where it is not `described`."""
    lines = lines_of(scene.loads)
    found: list[Finding] = []
    if "sheave_fleet_angle" in channels:
        sheaves = [f"{name} {i}" for name, line in lines.items() for i in turned_at(line)]
        angles = np.degrees(np.asarray(channels["sheave_fleet_angle"])).reshape(time.size, len(sheaves))
        found += _leaning(sheaves, time, angles)
    if not lines or "line_unstretched_length" not in channels:
        return found
    lengths = np.asarray(channels["line_unstretched_length"]).reshape(time.size, len(lines))
    for line, length in zip(lines.values(), lengths.T, strict=True):
        if line.winch:
            found += _met(winch_of(line), line, time, length / line.share)
    if "line_tension" in channels:
        tensions = np.asarray(channels["line_tension"]).reshape(time.size, len(lines))
        found += [one for item in zip(lines.items(), tensions.T, strict=True) for one in _pushed(*item, time)]
    if "line_stretch" not in channels:
        return found
    stretches = np.asarray(channels["line_stretch"]).reshape(time.size, len(lines))
    if described and time[0] == 0.0:
        found += _contradicted(lines, strains_at_rest(scene), lengths[0], stretches[0])
    for (name, line), strain in zip(lines.items(), (stretches / lengths).T, strict=True):
        if len(line.strains):
            found += _beyond(name, line, time, strain)
    return found


def turned_at(line: _core.Line) -> list[int]:
    """The points of a line's path at which it lies on a sheave or meets friction."""
    turned = np.zeros(len(line.points), dtype=bool)
    for values, usual in ((line.radii, 0.0), (line.efficiencies, 1.0), (line.frictions, 0.0)):
        if len(values):
            turned |= np.asarray(values) != usual
    return [int(i) for i in np.flatnonzero(turned)]


def _beyond(name: str, line: _core.Line, time: Array, strain: Array) -> Iterator[Finding]:
    worst = int(np.argmax(strain))
    if strain[worst] > line.strains[-1]:
        yield (
            LineTableWarning,
            f"line {name!r}: is strained by {strain[worst]:.4g} at t = {time[worst]:.6g} s, and its table "
            f"ends at {line.strains[-1]:.4g}; it went on along its last tangent. Extend the table",
        )


def _leaning(sheaves: list[str], time: Array, angles: Array) -> Iterator[Finding]:
    for name, angle in zip(sheaves, angles.T, strict=True):
        worst = int(np.argmax(angle))
        if angle[worst] > LARGEST_FLEET_ANGLE:
            yield (
                FleetAngleWarning,
                f"line at sheave {name!r}: leaves the plane of its rim by {angle[worst]:.3g} degrees at t = "
                f"{time[worst]:.6g} s, beyond {LARGEST_FLEET_ANGLE:g} degrees; the rope would climb out of "
                "its groove. Turn the sheave's axis, or put it on a body that swivels",
            )


def strains_at_rest(scene: Description) -> dict[str, float]:
    """The strains of lines with a constant EA that alone carry what hangs on them, by that weight."""
    lines = lines_of(scene.loads)
    return {
        name: weight / falls / lines[name].EA
        for name, (weight, falls) in line_weights(scene).items()
        if not len(lines[name].strains)
    }


def _contradicted(
    lines: Mapping[str, _core.Line], resting: Mapping[str, float], lengths: Array, stretches: Array
) -> Iterator[Finding]:
    """Lines whose described length is not that of their path; a heavy one is the sum of its segments.

    What hangs on a line stretches it at rest, by the strain in `resting`; that is no contradiction.
    """
    wholes = [whole_of(name, line) for name, line in lines.items()]
    for name in dict.fromkeys(wholes):
        own = np.array([whole == name for whole in wholes])
        length, stretch = float(lengths[own].sum()), float(stretches[own].sum())
        mine = [line for line, is_own in zip(lines.values(), own, strict=True) if is_own]
        segments = [one for one, whole in zip(lines, wholes, strict=True) if whole == name]
        at_rest = max(resting.get(one, 0.0) for one in segments)
        tables = [strain for line in mine for strain in line.strains]
        usual = max([LARGEST_CONTRADICTION, *tables])  # a cord is meant to be as long as its table
        if -LARGEST_CONTRADICTION * length <= stretch <= (usual + at_rest) * length:
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
    if line.rung != QUASI_STATIC or tension[worst] >= 0.0:
        return
    yield (
        PushingLineWarning,
        f"line {name!r}: pushes with {-tension[worst]:.4g} N at t = {time[worst]:.6g} s: its stretch is "
        "quasi-static, and follows the tension too late to go slack. Give it rung 'elastic'",
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
