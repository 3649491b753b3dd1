"""What the error of a run is measured in: payload position, tip velocity, roll, forces, or any pick."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from seacrane.arrays import Array
from seacrane.description.channels import CHANNELS, DERIVED, unit_of
from seacrane.description.crane_parts import cylinders, payloads
from seacrane.description.given import given_vessels
from seacrane.description.holding import with_holds
from seacrane.description.pick import pick_of
from seacrane.description.suspension import hung_loads
from seacrane.errors import SceneError
from seacrane.inputs.checked import positive_of
from seacrane.run.channel_names import require_channels

if TYPE_CHECKING:
    from seacrane import _core
    from seacrane.result import Result
    from seacrane.scene.scene import Scene

GENERIC = ("position", "velocity")
STAGE = re.compile(r"stage\[\s*([^\[\]]+?)\s*\]\.(start|end|duration)")
ENDS = {"min": 0, "max": 1}


@dataclass(frozen=True, kw_only=True)
class Quantity:
    """A named quantity of a run.

    Attributes
    ----------
    channels : Channels that it is made of.
    values : Of a result, (n, items, parts): an error is the length over the parts, the largest of the items.
        Of numbers, such as extremes, n is 1.
    of_numbers : How far what they are taken of goes in a result, in the unit; None: it is a curve.
    """

    name: str
    unit: str
    channels: tuple[str, ...]
    values: Callable[[Result], Array]
    of_numbers: Callable[[Result], float] | None = None

    def motion(self, result: Result) -> float:
        """Largest distance from its start, in its unit."""
        if self.of_numbers is not None:
            return self.of_numbers(result)
        return motion_of(self.values(result))


@dataclass(frozen=True, kw_only=True)
class ErrorMeasures:
    """Error of one quantity over a run, in its unit."""

    largest: float
    rms: float  # root of the mean square over time
    std: float  # of the standard deviations over time: what a statistic loses, whatever the phase


def motion_of(values: Array) -> float:
    """Largest distance of values (n, items, parts) from those at the first output."""
    return float(np.nanmax(np.linalg.norm(values - values[:1], axis=-1), initial=0.0))


def compare(reference: Array, values: Array) -> ErrorMeasures:
    """Error of values (n, items, parts) against a reference of the same shape."""
    distance = np.linalg.norm(values - reference, axis=-1)
    spread = np.linalg.norm(values.std(axis=0) - reference.std(axis=0), axis=-1)
    return ErrorMeasures(
        largest=float(distance.max()),
        rms=float(np.sqrt((distance**2).mean(axis=0)).max()),
        std=float(spread.max()),
    )


def quantities_of(
    scene: Scene, model: _core.Model | None, names: Iterable[str] | None
) -> dict[str, Quantity]:
    """The quantities asked for; by default what the scene has of the named ones.

    Without a model, of a lift in stages, channels are looked for in everything that is ever connected.
    Raises SceneError for a name that is neither one of them nor picks a channel of the scene.
    """
    offered = _offered(scene)
    if names is None:
        return offered or {name: _picked(name) for name in GENERIC}
    if isinstance(names, str) or not isinstance(names, Iterable):
        raise SceneError(f"quantities is {names!r}; give a list of names")
    out = {}
    for name in names:
        out[name] = offered[name] if name in offered else _of_text(name)
        if name not in offered:
            _require_known(scene, model, out[name], offered)
    if not out:
        raise SceneError("quantities is empty; name at least one, or leave it out")
    return out


def _require_known(scene: Scene, model: _core.Model | None, found: Quantity, offered: Iterable[str]) -> None:
    """SceneError for a quantity of a channel that the scene has not."""
    if model is None:
        require_channels(scene, found.channels)
        return
    channels = offered_channels(model)
    if not set(found.channels) <= set(channels):
        raise SceneError(
            f"quantity {found.name!r} is unknown to this scene; it offers {', '.join([*offered, *channels])}"
        )


def offered_channels(model: _core.Model) -> list[str]:
    """All that a result of this model may hold."""
    known = model.channel_names(defaults_only=False)
    return [*known, *(name for name, channel in DERIVED.items() if set(channel.made_of) & set(known))]


def channels_of(quantities: Mapping[str, Quantity]) -> list[str]:
    """What the quantities are made of."""
    return list(dict.fromkeys(channel for quantity in quantities.values() for channel in quantity.channels))


def of_stages(quantity: Quantity) -> Quantity:
    """The least and the largest of each part in each stage: an event that moves by a moment moves none."""

    def values(result: Result) -> Array:
        found = quantity.values(result)
        spans = [found[result.stage(span.name)] for span in result.stages]
        if not all(len(span) for span in spans):
            raise SceneError(f"quantity {quantity.name!r}: a stage has no output; give a smaller dt_out")
        return np.stack([extreme for span in spans for extreme in (span.min(axis=0), span.max(axis=0))])

    return replace(quantity, values=values)


def limits_of(quantities: Collection[str], accuracy: Mapping[str, Any]) -> dict[str, float]:
    """Accuracies as positive numbers; raises SceneError for what is none or is not measured."""
    if not accuracy:
        raise SceneError("accuracy is empty; give at least one quantity and its largest error")
    out = {}
    for name, value in accuracy.items():
        if name not in quantities:
            raise SceneError(f"accuracy: {name!r} was not measured; choose from {', '.join(quantities)}")
        out[name] = positive_of(f"accuracy: {name}", value)
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


def _of_text(text: str) -> Quantity:
    """A curve, an extreme such as "hook_load.max", or the time of a stage such as "stage[lift].end"."""
    stage = STAGE.fullmatch(text) if isinstance(text, str) else None
    if stage is not None and stage[2] != "duration":
        name, what = stage.groups()
        return Quantity(
            name=text, unit="s", channels=(), of_numbers=lambda result: float(np.ptp(result.time)),
            values=lambda result: np.full((1, 1, 1), stage_time(result, name, what, "accuracy")),
        )  # fmt: skip
    selector, _, end = text.rpartition(".") if isinstance(text, str) else ("", "", "")
    return _extreme(text, selector, ENDS[end]) if selector and end in ENDS else _picked(text)


def stage_time(result: Result, stage: str, what: str, asker: str) -> float:
    """When a stage of a lift begins or ends, or how long it takes, s; SceneError where there is none."""
    for span in result.stages:
        if span.name == stage:
            return span.end - span.start if what == "duration" else float(getattr(span, what))
    known = ", ".join(one.name for one in result.stages) or "none"
    raise SceneError(f"{asker}: there is no stage {stage!r}; the run has {known}")


def _extreme(text: str, selector: str, end: int) -> Quantity:
    """The least or the largest of each curve that is picked, also between outputs."""
    pick = pick_of("quantity", selector)

    def values(result: Result) -> Array:
        part = result.part(after=pick.after, stage=pick.stage)
        reached = result.reached(pick.channel, part=part, **pick.names)[end]
        return np.asarray((np.fmin, np.fmax)[end].reduce(reached, axis=0)).reshape(1, -1, 1)

    def motion(result: Result) -> float:
        curves = np.asarray(result.select(pick.channel, **pick.names)).reshape(result.time.size, -1)
        return float(np.nanmax(np.abs(curves - curves[:1]), initial=0.0))

    return Quantity(
        name=text, unit=unit_of(pick.channel, list(pick.names.values())), channels=(pick.channel,),
        values=values, of_numbers=motion,
    )  # fmt: skip


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

    unit = unit_of(pick.channel, list(pick.names.values()))
    return Quantity(name=text, unit=unit, channels=(pick.channel,), values=values)
