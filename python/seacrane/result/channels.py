"""What may be recorded: dimensions, unit and description of every channel, in one table."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

AXES = ("x", "y", "z")
QUATERNION = ("w", "x", "y", "z")


@dataclass(frozen=True, kw_only=True)
class Channel:
    """Dimensions, unit and description of one recorded quantity."""

    dims: tuple[str, ...]
    unit: str
    long_name: str
    several: str = ""

    def dims_of(self, axes: int) -> tuple[str, ...]:
        """Dimensions of an array with so many axes: with several vessels (or slew drives, or hooks), theirs
        comes after time."""
        more = self.several and axes == len(self.dims) + 1
        return ("time", self.several, *self.dims[1:]) if more else self.dims


def _channel(dims: str, unit: str, long_name: str, *, several: str = "") -> Channel:
    return Channel(dims=("time", *dims.split()), unit=unit, long_name=long_name, several=several)


_SIX = "m (surge, sway, heave), rad (roll, pitch, yaw)"
_WRENCH = "N (surge, sway, heave), N m (roll, pitch, yaw)"

CHANNELS: Mapping[str, Channel] = MappingProxyType(
    {
        "position": _channel("body axis", "m", "centre of mass, inertial frame"),
        "velocity": _channel("body axis", "m/s", "velocity of the centre of mass, inertial frame"),
        "angular_velocity": _channel("body axis", "rad/s", "angular velocity, inertial frame"),
        "acceleration": _channel("body axis", "m/s2", "acceleration of the centre of mass, inertial frame"),
        "angular_acceleration": _channel("body axis", "rad/s2", "angular acceleration, inertial frame"),
        "quaternion": _channel("body wxyz", "1", "orientation, scalar first, body to inertial"),
        "euler_xyz": _channel("body axis", "rad", "XYZ Euler angles, R = Rx Ry Rz, body to inertial"),
        "vessel_motion": _channel(
            "motion", _SIX, "vessel's reference point from rest, and yaw-pitch-roll angles", several="vessel"
        ),
        "coordinate": _channel("joint_coordinate", "m or rad", "joint coordinate, second body to first"),
        "coordinate_rate": _channel("joint_coordinate", "m/s or rad/s", "rate of the joint coordinate"),
        "actuator_force": _channel("actuator", "N or N m", "load of the actuator along its coordinate"),
        "driver_force": _channel("driver", "N or N m", "load of the driver along its coordinate"),
        "tension": _channel("link", "N", "tension of the constant-distance link"),
        "stroke": _channel("cylinder", "m", "cylinder stroke, extension positive"),
        "stroke_rate": _channel("cylinder", "m/s", "rate of the cylinder stroke"),
        "cylinder_force": _channel("cylinder", "N", "actuator force of the cylinder, positive pushes"),
        "slew_angle": _channel("", "rad", "slew angle of the crane", several="slew"),
        "slew_torque": _channel("", "N m", "actuator torque of the slew drive", several="slew"),
        "link_tension": _channel(
            "", "N", "tension of the link between crane tip and payload", several="hook"
        ),
        "reaction_force": _channel(
            "joint axis", "N", "constraint force on the second body, inertial frame, at the joint point"
        ),
        "reaction_moment": _channel(
            "joint axis", "N m", "constraint moment on the second body, inertial frame, at the joint point"
        ),
        "wave_elevation": _channel(
            "", "m", "undisturbed wave elevation where wave loads take their phase", several="vessel"
        ),
        "wave_force": _channel(
            "motion", _WRENCH, "wave load on the vessel at its reference point", several="vessel"
        ),
        "drift_force": _channel(
            "motion", _WRENCH, "slow drift load on the vessel at its reference point", several="vessel"
        ),
        "limit_force": _channel("limit", "N or N m", "tension of a wire, push of a stop, pressure on a seat"),
        "impact_loss": _channel("", "J", "mechanical energy lost in impacts of limits since the start"),
        "constraint_error": _channel("", "m or rad", "largest absolute constraint residual"),
        "constraint_rate_error": _channel("", "m/s or rad/s", "largest absolute velocity residual"),
        "constraint_error_before_projection": _channel(
            "", "m or rad", "largest absolute residual before projection since the last output"
        ),
        "energy_balance": _channel(
            "", "J", "mechanical energy change minus work of all non-conservative loads"
        ),
        "absolute_work": _channel("", "J", "integral of the absolute power of the non-conservative loads"),
    }
)


def attributes(name: str) -> dict[str, str]:
    """`units` and `long_name` of a channel, or of `time`."""
    if name == "time":
        return {"units": "s", "long_name": "time since the start of the run"}
    return {"units": CHANNELS[name].unit, "long_name": CHANNELS[name].long_name}
