"""What the error of a run is measured in: payload position, tip velocity, roll, forces, or any channel."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from seacrane.description.channels import CHANNELS, DERIVED
from seacrane.description.crane_parts import cylinders, payloads
from seacrane.description.given import given_vessels
from seacrane.description.holding import with_holds
from seacrane.description.suspension import Place, hung_loads
from seacrane.errors import SceneError
from seacrane.inputs.checked import positive_of
from seacrane.inputs.frames import rotation_matrix

if TYPE_CHECKING:
    from seacrane import _core
    from seacrane.result import Result
    from seacrane.scene.scene import Scene

Array = NDArray[np.float64]
ROLL = 3
GENERIC = ("position", "velocity")


@dataclass(frozen=True, kw_only=True)
class Quantity:
    """A named quantity of a run.

    Attributes
    ----------
    name, unit : str
    channels : tuple of str
        Channels that it is made of.
    values : callable
        Result to ndarray of shape (n, items, parts): an error is the length over the parts, the largest of
        the items.
    """

    name: str
    unit: str
    channels: tuple[str, ...]
    values: Callable[[Result], Array]


@dataclass(frozen=True, kw_only=True)
class ErrorMeasures:
    """Error of one quantity over a run, in its unit.

    Attributes
    ----------
    largest : float
        Over time.
    rms : float
        Root of the mean square over time.
    std : float
        Of the standard deviations over time: what a statistic loses, whatever the phase.
    """

    largest: float
    rms: float
    std: float


def compare(reference: Array, values: Array) -> ErrorMeasures:
    """Error of values (n, items, parts) against a reference of the same shape."""
    distance = np.linalg.norm(values - reference, axis=-1)
    spread = np.linalg.norm(values.std(axis=0) - reference.std(axis=0), axis=-1)
    return ErrorMeasures(
        largest=float(distance.max()),
        rms=float(np.sqrt((distance**2).mean(axis=0)).max()),
        std=float(spread.max()),
    )


def quantities_of(scene: Scene, model: _core.Model, names: Iterable[str] | None) -> dict[str, Quantity]:
    """The quantities asked for; by default what the scene has of the named ones.

    Raises
    ------
    SceneError
        For a name that is neither one of them nor a channel of the scene.
    """
    offered = _offered(scene)
    if names is None:
        return offered or {name: _channel(name) for name in GENERIC}
    if isinstance(names, str) or not isinstance(names, Iterable):
        raise SceneError(f"quantities is {names!r}; give a list of names")
    known = model.channel_names(defaults_only=False)
    channels = [*known, *(name for name, channel in DERIVED.items() if set(channel.made_of) & set(known))]
    out = {}
    for name in names:
        if name not in offered and name not in channels:
            raise SceneError(
                f"quantity {name!r} is unknown to this scene; it offers {', '.join([*offered, *channels])}"
            )
        out[name] = offered[name] if name in offered else _channel(name)
    if not out:
        raise SceneError("quantities is empty; name at least one, or leave it out")
    return out


def limits_of(quantities: Mapping[str, Quantity], accuracy: Mapping[str, Any]) -> dict[str, float]:
    """Accuracies as positive numbers; raises SceneError for what is none or is not measured."""
    if not accuracy:
        raise SceneError("accuracy is empty; give at least one quantity and its largest error")
    out = {}
    for name, value in accuracy.items():
        if name not in quantities:
            raise SceneError(f"accuracy: {name!r} was not measured; choose from {', '.join(quantities)}")
        limit = positive_of(f"accuracy: {name}", value)
        out[name] = limit
    return out


def _offered(scene: Scene) -> dict[str, Quantity]:
    on_cranes = [one for one in hung_loads(scene) if one.crane is not None]
    hung, found = list(dict.fromkeys([*payloads(scene).values(), *(one.load for one in on_cranes)])), []
    if hung:
        found.append(
            Quantity(
                name="payload_position",
                unit="m",
                channels=("position",),
                values=lambda result: np.stack(
                    [result.select("position", body=body) for body in hung], axis=1
                ),
            )
        )
    if on_cranes:
        found.append(_tip_velocity(scene, [one.hangs_from for one in on_cranes]))
    if len(scene.vessels) > len(given_vessels(scene)):
        found.append(
            Quantity(
                name="roll",
                unit="rad",
                channels=("vessel_motion",),
                values=lambda result: result["vessel_motion"][..., ROLL].reshape(result.time.size, -1, 1),
            )
        )
    driven = {actuator.joint for actuator in scene.actuators.values()}
    driven |= {driver.joint for driver in with_holds(scene).drivers.values()}
    if cylinders(scene) and driven.issuperset(cylinders(scene).values()):
        found.append(_channel("cylinder_force", unit="N"))
    if on_cranes:
        names = [one.suspension.channel for one in on_cranes]
        found.append(
            Quantity(
                name="hook_tension",
                unit="N",
                channels=("hook_load",),
                values=lambda result: np.stack(
                    [result.select("hook_load", suspension=name) for name in names], axis=1
                )[:, :, None],
            )
        )
    return {quantity.name: quantity for quantity in found}


def _tip_velocity(scene: Scene, tips: Sequence[Place]) -> Quantity:
    """Velocity of the points that loads hang from, inertial axes."""
    levers = [
        (body, np.asarray(point) - np.asarray(scene.bodies[body].center_of_mass)) for body, point in tips
    ]

    def velocity(result: Result, body: str, lever: Array) -> Array:
        turned = rotation_matrix(result.select("quaternion", body=body)) @ lever
        spin = result.select("angular_velocity", body=body)
        return np.asarray(result.select("velocity", body=body) + np.cross(spin, turned))

    return Quantity(
        name="tip_velocity",
        unit="m/s",
        channels=("velocity", "angular_velocity", "quaternion"),
        values=lambda result: np.stack([velocity(result, *lever) for lever in levers], axis=1),
    )


def _channel(name: str, *, unit: str | None = None) -> Quantity:
    """A channel, every entry of its last dimension for itself unless that is an axis."""
    vector = CHANNELS[name].dims[-1] in ("axis", "wxyz")

    def values(result: Result) -> Array:
        array = np.asarray(result[name])
        parts = array.shape[-1] if vector else 1
        return array.reshape(len(array), -1, parts)

    return Quantity(name=name, unit=unit or CHANNELS[name].unit, channels=(name,), values=values)
