"""What may be recorded: dimensions, unit and description of every channel.

The core's channels come from its own table. Those that Python derives from them are in `DERIVED`.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from functools import lru_cache, partial
from types import MappingProxyType

from seacrane import _core

_DRIVE = "actuator_force driver_force hydraulic_force"
_POSE = "position quaternion"
_MOTION = "position quaternion velocity angular_velocity"
_PULL = f"tension line_tension end_tension {_POSE}"
COUNTED_ON = ("energy_balance", "impact_loss")  # each run of stages counts from its own start
LEAST, LARGEST = "_least", "_largest"  # what files call extremes, behind the channel's name
OWN = "own"  # expressions of other channels


@dataclass(frozen=True, kw_only=True)
class Channel:
    """Dimensions, unit and description of one recorded quantity."""

    dims: tuple[str, ...]  # of its arrays, "time" first
    dims_of_several: tuple[str, ...]  # where there are several vessels, slew drives or hooks: after time
    unit: str
    long_name: str
    by_default: bool = True  # whether a run records it unasked
    made_of: tuple[str, ...] = ()  # channels of the core; empty for its own, and for expressions
    turns: bool = False  # whether it is an angle that counts whole turns
    has_extremes: bool = False  # whether a run keeps those between outputs, where it is asked for them

    def dims_of(self, axes: int) -> tuple[str, ...]:
        """Dimensions of an array with so many axes."""
        return self.dims_of_several if axes == len(self.dims_of_several) else self.dims


def _derived(
    dims: str, unit: str, made_of: str, long_name: str, *, several: str = "", turns: bool = False,
    by_default: bool = True,
) -> Channel:  # fmt: skip
    own = dims.split()
    return Channel(
        dims=("time", *own), dims_of_several=("time", *several.split(), *own), unit=unit, long_name=long_name,
        by_default=by_default, made_of=tuple(made_of.split()), turns=turns,
    )  # fmt: skip


_asked = partial(_derived, by_default=False)

DERIVED: Mapping[str, Channel] = MappingProxyType({
    "stroke": _derived("cylinder", "m", "coordinate", "cylinder stroke, extension positive"),
    "stroke_rate": _derived("cylinder", "m/s", "coordinate_rate", "rate of the cylinder stroke"),
    "cylinder_force": _derived("cylinder", "N", _DRIVE, "actuator force of the cylinder, positive pushes"),
    "cylinder_pressure": _derived("piston", "Pa", _DRIVE,
        "pressure in the loaded chamber of the cylinder, the rod side's negative"),
    "slew_angle": _derived("", "rad", "coordinate", "slew angle of the crane", several="slew", turns=True),
    "slew_torque": _derived("", "N m", _DRIVE, "actuator torque of the slew drive", several="slew"),
    "link_tension": _derived("", "N", "tension",
        "tension of the link between crane tip and payload", several="hook"),
    "hook_load": _derived("suspension", "N", _PULL,
        "load on the lower end of a link, a wire or a line, all its falls together"),
    "clearance": _derived("gap", "m", _POSE, "distance of points from a box, negative inside"),
    "heel": _asked("body", "rad", "quaternion",
        "yaw-pitch-roll angle about the body's own x axis; positive lifts its port side"),
    "trim": _asked("body", "rad", "quaternion",
        "its angle about the y axis after yaw; positive lowers the body's bow"),
    "yaw": _asked("body", "rad", "quaternion",
        "its angle about the vertical, within half a turn; positive turns the bow to port"),
    "hook_speed": _asked("suspension", "m/s", _MOTION,
        "vertical velocity of the lower end of a link, a wire or a line, positive up"),
    "slack_margin": _asked("weighed", "1", _PULL,
        "load on the lower end over the least static one there, that under water where parts in water "
        "hang; slack at zero"),
    "sling_angle": _asked("suspension", "rad", _POSE,
        "angle of the last straight part of a link, a wire or a line above the horizontal"),
    "utilisation": _asked("", "1", _PULL,
        "hook load over what the crane's table allows at this radius, times its design factor",
        several="hook"),
    "immersed_depth": _asked("immersed", "m", _POSE,
        "depth below still water of the lowest point of a body's parts in water, and of each of them"),
    "wire_paid_out": _asked("winch", "m", "line_unstretched_length",
        "unstretched length of the line over the one described"),
    "wire_spare": _asked("winch", "m", "line_unstretched_length",
        "length that the winch may still haul in, down to its minimum length"),
    "own": _derived("expression", "SI", "", "channel of one's own, in the unit of its expression"),
    "tip_velocity": _derived("axis", "m/s", _MOTION,
        "velocity of the crane tip, inertial frame", several="tip"),
    "swing": _asked("", "rad", _POSE,
        "angle of the load from straight below the crane's tip", several="hook"),
    "offlead": _derived("", "rad", _POSE,
        "angle of link or line below the tip from the vertical, away from the crane positive",
        several="hook"),
    "sidelead": _derived("", "rad", _POSE,
        "angle of link or line below the tip from the vertical across the boom, to its left positive",
        several="hook"),
})  # fmt: skip

CHANNELS: Mapping[str, Channel] = MappingProxyType({
    **{
        one.name: Channel(
            dims=("time", *one.dims), dims_of_several=("time", *one.dims_of_several), unit=one.unit,
            long_name=one.text, by_default=one.by_default, has_extremes=one.has_extremes,
        )
        for one in _core.channels()
    },
    **DERIVED,
})  # fmt: skip

# Names along the dimensions that are the same in every scene.
FIXED: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {dim: tuple(names) for dim, names in _core.axes().items() if names}
)
# Dimensions whose names belong to the scene.
NAMED = frozenset(dim for channel in CHANNELS.values() for dim in channel.dims_of_several[1:]) - set(FIXED)
AXES, MOTIONS = FIXED["axis"], FIXED["motion"]


def unit_of(channel: str, names: Collection[str]) -> str:
    """The unit of one curve: "m (surge, sway, heave), rad (roll, pitch, yaw)" is one unit for each motion."""
    for unit, listed in re.findall(r"([^,()]+) \(([^)]*)\)", CHANNELS[channel].unit):
        if set(names) & set(listed.split(", ")):
            return str(unit).strip()
    return CHANNELS[channel].unit


def units_of(channel: str) -> list[str]:
    """All units that curves of a channel may have."""
    listed = [unit.strip() for unit, _ in re.findall(r"([^,()]+) \(([^)]*)\)", CHANNELS[channel].unit)]
    return listed or CHANNELS[channel].unit.split(" or ")


@lru_cache(maxsize=1024)
def channel_of(name: str) -> str:
    """The channel whose least or largest values an array of a file holds; of others the name itself."""
    for ending in (LEAST, LARGEST):
        if name.endswith(ending) and name.removesuffix(ending) in CHANNELS:
            return name.removesuffix(ending)
    return name


@lru_cache(maxsize=1024)
def dims_of(name: str, axes: int) -> tuple[str, ...]:
    """Dimensions of an array with so many axes, of a channel or of its least or largest values."""
    return CHANNELS[channel_of(name)].dims_of(axes)


def attributes(name: str) -> dict[str, str]:
    """`units` and `long_name` of a channel, of its least or largest values, or of `time`."""
    if name == "time":
        return {"units": "s", "long_name": "time since the start of the run"}
    kind = CHANNELS[channel_of(name)]
    which = name.removeprefix(channel_of(name)).removeprefix("_")
    told = f"{which} value since the output before: {kind.long_name}" if which else kind.long_name
    return {"units": kind.unit, "long_name": told}
