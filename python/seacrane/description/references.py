"""What drivers and actuators are asked to follow, looked at before a run: jumps, ranges, half turns."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial

import numpy as np

from seacrane import _core
from seacrane.arrays import Array
from seacrane.description.description import Description
from seacrane.description.given import given_vessels, require_described
from seacrane.description.limit_state import Range
from seacrane.description.once import once
from seacrane.description.places import ANGLES, coordinate_at, start_pose, wrapped
from seacrane.errors import SceneError
from seacrane.inputs.caller import warn_caller
from seacrane.warnings import DriverImpulseWarning

JUMP = 1e-6  # m or rad: what projection closes without a word
RATE_JUMP = 1e-3  # m/s or rad/s, as much as matters
BEYOND = 1e-9  # m or rad
HALF_A_TURN = np.pi * (1.0 - 1e-9)
PLACES = 17  # looked at in each piece of a reference
WITHIN = 1.0 - 1e-12  # of a piece: its end, before the next one
PER_PERIOD, MOST_PERIODS = 16, 100


@dataclass(frozen=True)
class Reference:
    """A curve that a joint coordinate is to follow, and who says so."""

    owner: str
    joint: str
    coordinate: str
    curve: _core.Curve


def references(scene: Description) -> Iterator[Reference]:
    """Curves of drivers, and of actuators that hold to their reference."""
    for name, driver in scene.drivers.items():
        yield Reference(f"driver {name!r}", driver.joint, driver.coordinate, driver.curve)
    for name, actuator in scene.actuators.items():
        if actuator.stiffness > 0.0:
            yield Reference(f"actuator {name!r}", actuator.joint, actuator.coordinate, actuator.reference)


@once
def check_references(
    scene: Description, model: _core.Model, *, start: float, end: float, described: bool
) -> None:
    """Look at references from `start` to `end` (s) of a run; `described`: it starts at the described pose.

    Raises SceneError where a run is longer than a ship's given motion, a driver's curve jumps, a reference
    leaves the range of its coordinate, or that of an angle starts half a turn or more from it, or jumps by as
    much. Warns with DriverImpulseWarning where a driver's rate jumps.
    """
    require_described(scene, end)
    for reference in references(scene):
        for limit in scene.ranges.values():
            if (limit.joint, limit.coordinate) == (reference.joint, reference.coordinate):
                _check_range(reference, limit, start, end)
    smooth = tuple(f"{body}.motion." for body, kind in given_vessels(scene).items() if kind == "raos")
    for name, driver in scene.drivers.items():
        if not name.startswith(smooth):  # sums of cosines, in thousands of pieces
            _check_jumps(name, driver, start, end)
    for name, actuator in scene.actuators.items():
        if actuator.coordinate in ANGLES and actuator.stiffness > 0.0:
            _check_turns(scene, model, name, start, end, described)


def _jumps(curve: _core.Curve, start: float, end: float) -> tuple[Array, Array, Array]:
    """Times within a run where a piece begins, and by what value and rate jump there."""
    starts = np.asarray(curve.to_pieces()["starts"], dtype=float)
    times = starts[(starts > start) & (starts < end)]
    jumps = curve.evaluate(times) - curve.evaluate(np.nextafter(times, -np.inf))
    return times, jumps[:, 0], jumps[:, 1]


def _samples(curve: _core.Curve, start: float, end: float) -> tuple[Array, Array]:
    """Times within a run, many in every piece, and the values there."""
    data = curve.to_pieces()
    starts = np.asarray(data["starts"], dtype=float)
    first = max(int(np.searchsorted(starts, start, side="right")) - 1, 0)
    last = max(int(np.searchsorted(starts, end, side="left")), first + 1)
    begin, stop = np.maximum(starts[first:last], start), np.append(starts[first + 1 : last], end)
    count = np.full(last - first, PLACES)
    if len(data["cosines"]):
        periods = np.abs(np.asarray(data["cosines"])[first:last, 1]) * (stop - begin) / (2.0 * np.pi)
        count += (PER_PERIOD * np.clip(periods, 0.0, MOST_PERIODS)).astype(int)
    piece, place = np.repeat(np.arange(last - first), count), [np.linspace(0.0, WITHIN, n) for n in count]
    times = begin[piece] + np.concatenate(place) * np.maximum(stop - begin, 0.0)[piece]
    return times, curve.evaluate(times)[:, 0]


def _check_range(reference: Reference, limit: Range, start: float, end: float) -> None:
    times, values = _samples(reference.curve, start, end)
    beyond = np.maximum(limit.minimum - values, values - limit.maximum)
    worst = int(beyond.argmax())
    if beyond[worst] <= BEYOND:
        return
    raise SceneError(
        f"{reference.owner}: asks for {reference.joint}.{reference.coordinate} = {values[worst]:.6g} at t = "
        f"{times[worst]:.6g} s, outside its range of {limit.minimum:.6g} to {limit.maximum:.6g} from the "
        f"described pose; keep the reference inside, or change scene.ranges[{limit.name!r}] if the range is "
        "wrong"
    )


def _check_jumps(name: str, driver: _core.Driver, start: float, end: float) -> None:
    times, value, rate = _jumps(driver.curve, start, end)
    what = f"driver {name!r}: {driver.joint}.{driver.coordinate}"
    unit = "m"
    if driver.coordinate in ANGLES:
        value, unit = wrapped(value), "rad"  # whole turns move nothing
    if np.any(np.abs(value) > JUMP):
        at = int(np.argmax(np.abs(value) > JUMP))
        raise SceneError(
            f"{what} jumps by {value[at]:.6g} {unit} at t = {times[at]:.6g} s: that moves what it drives in "
            "no time and without work; join the pieces by a Curve.quintic, or let an actuator follow the jump"
        )
    if np.any(np.abs(rate) > RATE_JUMP):
        at = int(np.argmax(np.abs(rate)))
        warn_caller(
            f"{what} jumps in rate by {rate[at]:.4g} {unit}/s at t = {times[at]:.6g} s: what it drives takes "
            "an impulse there, which is in no recorded force and whose work is in no energy; join the pieces "
            "smoothly, as Curve.quintic does",
            DriverImpulseWarning,
        )


def _check_turns(
    scene: Description, model: _core.Model, name: str, start: float, end: float, described: bool
) -> None:
    """An angle is known to whole turns only, and an actuator takes the turn nearest to its reference."""
    actuator = scene.actuators[name]
    what = f"actuator {name!r}: reference of {actuator.joint}.{actuator.coordinate}"
    fix = "lead it there by a curve, such as Curve.quintic, that the angle can follow"
    times, jumps, _ = _jumps(actuator.reference, start, end)
    if np.any(np.abs(jumps) >= HALF_A_TURN):
        at = int(np.argmax(np.abs(jumps)))
        raise SceneError(
            f"{what} jumps by {np.degrees(jumps[at]):.6g} deg at t = {times[at]:.6g} s, half a turn or more: "
            f"it would turn the short way; {fix}"
        )
    if not described:
        return
    pose = partial(start_pose, scene, model)
    angle = float(coordinate_at(scene, actuator.joint, actuator.coordinate, pose)[0])
    away = float(actuator.reference.evaluate([start])[0, 0]) - angle
    if abs(away) >= HALF_A_TURN:
        raise SceneError(
            f"{what} starts {np.degrees(away):.6g} deg from the angle, which starts at "
            f"{np.degrees(angle):.6g} deg: half a turn or more, it would turn the short way; {fix}, or count "
            "the reference from the angle's own start, between -180 and 180 deg"
        )
