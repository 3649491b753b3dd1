"""Whether coordinates went where references led them, and stayed in their ranges: looked at after a run."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from seacrane.description.joint_coordinates import ANGLES, Pose, coordinate_at, wrapped
from seacrane.inputs.frames import rotation_matrix
from seacrane.warnings import FullTurnWarning, OutsideRangeWarning, SoftGainsWarning

if TYPE_CHECKING:
    from seacrane import _core
    from seacrane.description.description import Description

Array = NDArray[np.float64]
Channels = Mapping[str, Array]
Finding = tuple[type[Warning], str]
BEYOND = 0.01  # m times the length scale, or rad: what a control may overshoot a range
SHORT = 0.25  # m times the length scale
SHORT_ANGLE = np.radians(5.0)
STEADY = 3.0  # standard deviations: an error of the mean, not of a motion about it
LAST = 0.4  # of the outputs, which are judged
FEWEST_OUTPUTS = 16


def following(scene: Description, time: Array, channels: Channels, steered: Collection[str]) -> list[Finding]:
    """What left its range or its reference; `steered`: actuators that a controller has moved."""
    return _ranges(scene, time, channels) + _actuators(scene, time, channels, steered)


def _values(scene: Description, joint: str, coordinate: str, channels: Channels) -> Array | None:
    """A coordinate at the outputs (n,), or None where nothing recorded tells it."""
    places = list(scene.recorded.values())
    if "coordinate" in channels and (joint, coordinate) in places:
        return channels["coordinate"][:, places.index((joint, coordinate))]
    if "position" not in channels or "quaternion" not in channels:
        return None
    index = {name: i for i, name in enumerate(scene.bodies)}

    def pose(body: str) -> Pose:
        at = index[body]
        return channels["position"][:, at], rotation_matrix(channels["quaternion"][:, at])

    return coordinate_at(scene, joint, coordinate, pose)


def _ranges(scene: Description, time: Array, channels: Channels) -> list[Finding]:
    found: list[Finding] = []
    for name, limit in scene.ranges.items():
        values = _values(scene, limit.joint, limit.coordinate, channels)
        if values is None:
            continue
        angular = limit.coordinate in ANGLES
        beyond = np.maximum(limit.minimum - values, values - limit.maximum)
        at = int(beyond.argmax())
        if beyond[at] <= BEYOND * (1.0 if angular else scene.length_scale):
            continue
        found.append(
            (
                OutsideRangeWarning,
                f"range {name!r}: {limit.joint}.{limit.coordinate} reaches {values[at]:.4g} {_unit(angular)} "
                f"at t = {time[at]:.6g} s, outside {limit.minimum:.4g} to {limit.maximum:.4g} from the "
                "described pose: the real one ends there. Correct reference or gains, or add its end stops "
                "(Scene.add_stop)",
            )
        )
    return found


def _actuators(
    scene: Description, time: Array, channels: Channels, steered: Collection[str]
) -> list[Finding]:
    found: list[Finding] = []
    for name, actuator in scene.actuators.items():
        if name in steered or not _holds(actuator):
            continue
        values = _values(scene, actuator.joint, actuator.coordinate, channels)
        if values is None:
            continue
        error = actuator.reference.evaluate(time)[:, 0] - values
        if actuator.coordinate in ANGLES:
            error = wrapped(error)
            found += _passed(name, time, error)
        if actuator.stiffness == 0.0 or actuator.damping > 0.0:  # else a spring
            found += _short(scene, name, error)
    return found


def _holds(actuator: _core.Actuator) -> bool:
    """Whether an actuator has a reference to follow: a controller's gains, or a curve that says so."""
    if actuator.stiffness > 0.0:
        return actuator.damping > 0.0 or actuator.coordinate in ANGLES
    data = actuator.reference.to_pieces()
    return bool(np.any(np.asarray(data["coefficients"]) != 0.0))


def _passed(name: str, time: Array, error: Array) -> list[Finding]:
    jumps = np.flatnonzero(np.abs(np.diff(error)) > np.pi)
    if not jumps.size:
        return []
    return [
        (
            FullTurnWarning,
            f"actuator {name!r}: came to be half a turn from its reference {jumps.size} time(s), first at t "
            f"= {time[jumps[0] + 1]:.6g} s: an angle is known to whole turns only, and from there it was "
            "driven the other way round. Lead it by a slower reference, or give it stronger gains",
        )
    ]


def _short(scene: Description, name: str, error: Array) -> list[Finding]:
    actuator = scene.actuators[name]
    last = error[-max(int(LAST * error.size), 1) :]
    angular = actuator.coordinate in ANGLES
    limit = SHORT_ANGLE if angular else SHORT * scene.length_scale
    mean = float(last.mean())
    if error.size < FEWEST_OUTPUTS or abs(mean) <= limit or abs(mean) <= STEADY * float(last.std()):
        return []
    away = f"{np.degrees(mean):.4g} deg" if angular else f"{mean:.4g} m"
    return [
        (
            SoftGainsWarning,
            f"actuator {name!r}: ends {away} from its reference: stiffness {actuator.stiffness:.4g} and "
            f"damping {actuator.damping:.4g} {'N m/rad, N m s/rad' if angular else 'N/m, N s/m'} are too "
            "soft for what it carries. Give stiffness = inertia * omega**2 with omega well above the motion "
            "(seacrane.analysis.reflected_inertia), or its load as feed_forward (seacrane.balance)",
        )
    ]


def _unit(angular: bool) -> str:
    return "rad" if angular else "m"
