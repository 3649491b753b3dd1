"""What the error of a run is measured in: payload position, tip velocity, roll, forces, or any pick."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from seacrane.description.channels import CHANNELS, DERIVED, unit_of
from seacrane.description.crane_parts import cylinders, payloads
from seacrane.description.given import given_vessels
from seacrane.description.holding import with_holds
from seacrane.description.pick import pick_of
from seacrane.description.suspension import hung_loads
from seacrane.errors import SceneError
from seacrane.inputs.checked import positive_of

if TYPE_CHECKING:
    from seacrane import _core
    from seacrane.result import Result
    from seacrane.scene.scene import Scene

Array = NDArray[np.float64]
GENERIC = ("position", "velocity")


@dataclass(frozen=True, kw_only=True)
class Quantity:
    """A named quantity of a run.

    Attributes
    ----------
    channels : Channels that it is made of.
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
    largest : Over time.
    rms : Root of the mean square over time.
    std : Of the standard deviations over time: what a statistic loses, whatever the phase.
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

    Raises SceneError for a name that is neither one of them nor picks a channel of the scene.
    """
    offered = _offered(scene)
    if names is None:
        return offered or {name: _picked(name) for name in GENERIC}
    if isinstance(names, str) or not isinstance(names, Iterable):
        raise SceneError(f"quantities is {names!r}; give a list of names")
    known = model.channel_names(defaults_only=False)
    channels = [*known, *(name for name, channel in DERIVED.items() if set(channel.made_of) & set(known))]
    out = {}
    for name in names:
        found = offered[name] if name in offered else _picked(name)
        if name not in offered and not set(found.channels) <= set(channels):
            raise SceneError(
                f"quantity {name!r} is unknown to this scene; it offers {', '.join([*offered, *channels])}"
            )
        out[name] = found
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
        found.append(_stacked("payload_position", "position", [{"body": body} for body in hung]))
    if on_cranes:
        found.append(_picked("tip_velocity"))
    if len(scene.vessels) > len(given_vessels(scene)):
        found.append(_picked("roll"))
    driven = {actuator.joint for actuator in scene.actuators.values()}
    driven |= {driver.joint for driver in with_holds(scene).drivers.values()}
    if cylinders(scene) and driven.issuperset(cylinders(scene).values()):
        found.append(_picked("cylinder_force"))
    if on_cranes:
        names = [{"suspension": one.suspension.channel} for one in on_cranes]
        found.append(_stacked("hook_load", "hook_load", names))
    return {quantity.name: quantity for quantity in found}


def _stacked(name: str, channel: str, items: Sequence[Mapping[str, str]]) -> Quantity:
    """Items of a channel by their names."""

    def values(result: Result) -> Array:
        picked = [result.select(channel, **names) for names in items]
        return np.stack(picked, axis=1).reshape(result.time.size, len(items), -1)

    return Quantity(name=name, unit=CHANNELS[channel].unit, channels=(channel,), values=values)


def _picked(text: str) -> Quantity:
    """What a text picks, every entry of its last dimension for itself unless that is an axis."""
    pick = pick_of("quantity", text)
    if pick.parts:
        raise SceneError(f"quantity {text!r}: an error is of a whole run; leave out {pick.parts}")
    channel = CHANNELS[pick.channel]
    vector = channel.dims[-1] in ("axis", "wxyz") and channel.dims[-1] not in pick.names

    def values(result: Result) -> Array:
        array = np.asarray(result.select(pick))
        return array.reshape(len(array), -1, array.shape[-1] if vector else 1)

    unit = unit_of(pick.channel, pick.names.values())
    return Quantity(name=text, unit=unit, channels=(pick.channel,), values=values)
