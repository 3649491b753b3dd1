"""From the core's generic channels to the names that results carry."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence, Set
from contextlib import suppress
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from seacrane.analysis.least_pulls import least_pulls, weighed_suspensions
from seacrane.description.channels import CHANNELS, DERIVED, FIXED, OWN
from seacrane.description.compilation import compile_scene
from seacrane.description.crane_parts import cylinders, hooks, piston_areas, slews, tips
from seacrane.description.hydraulic_cylinders import hydraulic_cylinders, slide_of
from seacrane.description.loads import winches_of
from seacrane.description.once import once, once_in_any_sea
from seacrane.description.places import position_of
from seacrane.description.roles import pressure
from seacrane.description.suspension import names_of_suspensions
from seacrane.description.wet_parts import immersed_depths, wet_names
from seacrane.errors import SceneError
from seacrane.inputs.caller import silently
from seacrane.inputs.frames import rotation_matrix
from seacrane.run.hanging import (
    lead_angles,
    on_cranes,
    rated_hooks,
    slewing_hooks,
    sling_angles,
    swings,
    tip_velocities,
    utilisations,
)
from seacrane.run.hook_loads import hook_loads, link_tensions, lowest_segments, slack_margins
from seacrane.run.motions import motions
from seacrane.run.own import require_own, with_sources
from seacrane.scene.recorded import Clearance, distance_from_box

if TYPE_CHECKING:
    from seacrane import _core
    from seacrane.description.description import Description

Array = NDArray[np.float64]
NEEDED = ("position", "quaternion")


def core_channels(scene: Description, wanted: Sequence[str], known: Sequence[str]) -> set[str]:
    """The core's channels that the wanted ones are made of; raises SceneError for an unknown name."""
    made_of: set[str] = set()
    for name in wanted:
        made_from = DERIVED[name].made_of if name in DERIVED else (name,)
        sources = [source for source in made_from if source in known]
        if not sources:
            missing = missing_names(scene, DERIVED)
            derived = [one for one, channel in DERIVED.items() if set(channel.made_of) & set(known)]
            possible = [one for one in derived if one not in missing]
            raise SceneError(
                f"channel {name!r} is unknown to this scene; it offers: {', '.join([*known, *possible])}"
            )
        made_of.update(sources)
    return made_of


@once_in_any_sea
def derived_coords(scene: Description) -> Mapping[str, list[str]]:
    """Names along the dimensions of derived channels."""
    return {
        "cylinder": list(cylinders(scene)),
        "piston": list(piston_areas(scene)),
        "suspension": list(names_of_suspensions(scene)),
        "weighed": weighed_suspensions(scene),
        "immersed": list(wet_names(scene)),
        "gap": list(scene.clearances),
        "pair": list(scene.relatives),
        "expression": list(scene.channels),
        "winch": list(winches_of(scene.loads)),
        "slew": list(slews(scene)),
        "hook": [one.label for one in on_cranes(scene)],
        "tip": list(tips(scene)),
    }


@once
def all_names(scene: Description, model: _core.Model) -> Mapping[str, list[str]]:
    """Names along the dimensions of all channels but those that every scene has."""
    return {**model.axes, **derived_coords(scene)}


@once
def recorded_channels(scene: Description, model: _core.Model, asked: tuple[str, ...] | None) -> Set[str]:
    """The core's channels that a run records for those that it is asked for; None: for the usual ones."""
    ends = ["end_tension"] if lowest_segments(scene) else []
    usual = [*model.channel_names(), *ends, *(state.channel for state in scene.limit_states.values()), OWN]
    wanted = with_sources(scene, usual if asked is None else asked)
    if "slack_margin" in wanted:
        least_pulls(scene)  # before the run: what comes to no rest is refused
    made_of = core_channels(scene, wanted, model.channel_names(defaults_only=False))
    return made_of if ends or "end_tension" in wanted else made_of - {"end_tension"}


NEEDS = {  # what a channel of Python's own has its names from, by the dimension
    "cylinder": "a crane with cylinders: add_crane, or name them by add_roles(cylinders=...)",
    "piston": "areas of pistons: give add_roles(areas=...), or a crane's file with them",
    "suspension": "a link, a wire or a line: add one",
    "weighed": "a link, a wire or lines that carry a load which nothing else holds: add one",
    "immersed": "parts in water: add_immersed them",
    "gap": "a clearance: add_clearance one",
    "pair": "two points: add_relative them",
    "expression": "an expression: add_channel one",
    "winch": "a line on a winch: add_winch one",
}
_SLEW = "a slew drive: add_crane, or name it by add_roles(slew=...)"
_HOOK = "a load on a crane: add_hoist one, or name link or line by add_roles"
PARTS: Mapping[str, tuple[Callable[[Description], Any], str]] = {  # of those that have no names where one is
    "slew_angle": (slews, _SLEW),
    "slew_torque": (slews, _SLEW),
    "tip_velocity": (tips, "the tip of a crane: add_crane, or name it by add_roles(tip=...)"),
    "link_tension": (hooks, "a link on a crane: name a distance joint by add_roles(link=...)"),
    "swing": (on_cranes, _HOOK),
    "offlead": (slewing_hooks, f"{_HOOK}, on a crane with a tip and a slew drive"),
    "sidelead": (slewing_hooks, f"{_HOOK}, on a crane with a tip and a slew drive"),
    "utilisation": (rated_hooks, f"{_HOOK}, on a crane with a tip, a slew drive and a capacity table"),
}


def require_channels(scene: Description, wanted: Iterable[str]) -> None:
    """SceneError for channels that a scene has at no time, and for those of its limit states.

    Of a scene that cannot be compiled as it is described, those that Python derives are known.
    """
    limits, asked = [state.channel for state in scene.limit_states.values()], list(wanted)
    require_names(scene, [*asked, *limits])
    if all(name in CHANNELS and "body" in CHANNELS[name].dims for name in asked):  # what has bodies has these
        return
    known = list(CHANNELS)
    with suppress(SceneError), silently():
        known = compile_scene(scene).channel_names(defaults_only=False)
    core_channels(scene, with_sources(scene, asked), known)


def require_names(scene: Description, wanted: Iterable[str]) -> None:
    """SceneError where nothing in the scene has a derived channel that is asked for."""
    asked = list(wanted)
    for channel, need in missing_names(scene, [*asked, *with_sources(scene, asked)]).items():
        raise SceneError(f"channel {channel!r} is unknown to this scene; it needs {need}")


def missing_names(scene: Description, wanted: Iterable[str]) -> dict[str, str]:
    """What derived channels that nothing in the scene has: what each needs."""
    names = derived_coords(scene)
    derived = [channel for channel in wanted if channel in DERIVED]
    unnamed = {
        channel: NEEDS[dim]
        for channel in derived
        for dim in CHANNELS[channel].dims
        if dim in NEEDS and not names[dim]
    }
    parts = {channel: PARTS[channel] for channel in derived if channel in PARTS}
    return unnamed | {channel: need for channel, (there, need) in parts.items() if not there(scene)}


@once
def require_limited_channels(scene: Description, model: _core.Model) -> None:
    """SceneError where a limit state or an expression has a channel or a place that the scene has not."""
    known = model.channel_names(defaults_only=False)
    axes = {**all_names(scene, model), **FIXED}
    require_own(scene, axes)
    require_names(scene, [OWN] if scene.channels else [])
    for name, state in scene.limit_states.items():
        try:
            core_channels(scene, with_sources(scene, [state.channel]), known)
            require_names(scene, [state.channel])
        except SceneError as error:
            raise SceneError(f"limit state {name!r}: {error}") from error
        for dim, chosen in state.names.items():
            if chosen not in axes.get(dim, ()):
                raise SceneError(
                    f"limit state {name!r}: there is no {dim} {chosen!r}; choose from "
                    f"{', '.join(axes.get(dim, ()))}"
                )


def named_channels(
    scene: Description, arrays: dict[str, Array], asked: Collection[str] | None = None
) -> dict[str, Array]:
    """Adds what results call by the roles of cranes: strokes, drives, tensions, tips and how payloads hang.

    Slew and hook have no axis of their own where there is one of them. `asked`: which of those that cost most
    are wanted; None: all.
    """
    strokes = {label: (joint, "displacement") for label, joint in cylinders(scene).items()}
    drives = slews(scene)
    wanted = set(DERIVED if asked is None else asked)
    loads = hook_loads(scene, arrays)
    leads = lead_angles(scene, arrays) if wanted & {"offlead", "sidelead"} else None
    offlead, sidelead = leads or (None, None)
    found: dict[str, Array | None] = {
        "stroke": _recorded(scene, arrays.get("coordinate"), strokes),
        "stroke_rate": _recorded(scene, arrays.get("coordinate_rate"), strokes),
        "cylinder_force": _loads(scene, arrays, strokes),
        "cylinder_pressure": _pressures(scene, arrays, strokes),
        **turning_channels(scene, arrays),
        "slew_torque": _without_axis_of_one(_loads(scene, arrays, drives)),
        "link_tension": _without_axis_of_one(link_tensions(scene, arrays, loads)),
        "hook_load": loads,
        "slack_margin": slack_margins(scene, loads)
        if loads is not None and "slack_margin" in wanted
        else None,
        "utilisation": _without_axis_of_one(
            None if loads is None or "utilisation" not in wanted else utilisations(scene, arrays, loads)
        ),
        "clearance": clearances(scene, arrays),
        "immersed_depth": immersed_depths(scene, arrays) if "immersed_depth" in wanted else None,
        "tip_velocity": _without_axis_of_one(
            tip_velocities(scene, arrays) if "tip_velocity" in wanted else None
        ),
        "swing": _without_axis_of_one(swings(scene, arrays) if "swing" in wanted else None),
        "sling_angle": sling_angles(scene, arrays) if "sling_angle" in wanted else None,
        "offlead": _without_axis_of_one(offlead),
        "sidelead": _without_axis_of_one(sidelead),
    }
    out = arrays | {name: values for name, values in found.items() if values is not None}
    out |= motions(scene, arrays, asked)
    return {name: np.ascontiguousarray(values) for name, values in out.items()}


def turning_channels(scene: Description, arrays: Mapping[str, Array]) -> dict[str, Array]:
    """Those of `named_channels` that count turns."""
    angle = _turned(_recorded(scene, arrays.get("coordinate"), slews(scene)))
    return {} if angle is None else {"slew_angle": angle}


def _columns(array: Array | None, places: Sequence[int]) -> Array | None:
    return None if array is None or not places else array[:, places]


def _recorded(scene: Description, array: Array | None, wanted: Mapping[str, tuple[str, str]]) -> Array | None:
    """Columns of joint coordinates; None unless all of them are recorded."""
    recorded = list(scene.recorded.values())
    if not all(place in recorded for place in wanted.values()):
        return None
    return _columns(array, [recorded.index(place) for place in wanted.values()])


def _loads(
    scene: Description, arrays: Mapping[str, Array], wanted: Mapping[str, tuple[str, str]]
) -> Array | None:
    """Loads along joint coordinates; None unless something is known to act along all of them."""
    columns = [_drive_load(scene, arrays, place) for place in wanted.values()]
    known = [column for column in columns if column is not None]
    return np.column_stack(known) if known and len(known) == len(columns) else None


def _pressures(
    scene: Description, arrays: Mapping[str, Array], cylinders: Mapping[str, tuple[str, str]]
) -> Array | None:
    """In the loaded chambers of the cylinders whose areas are known."""
    areas = piston_areas(scene)
    forces = _loads(scene, arrays, {label: cylinders[label] for label in areas})
    if forces is None:
        return None
    return np.column_stack([pressure(forces[:, i], pair) for i, pair in enumerate(areas.values())])


def _drive_load(scene: Description, arrays: Mapping[str, Array], wanted: tuple[str, str]) -> Array | None:
    """What actuators and the driver apply along a joint coordinate together."""
    actuators = [(actuator.joint, actuator.coordinate) for actuator in scene.actuators.values()]
    drivers = [(driver.joint, driver.coordinate) for driver in scene.drivers.values()]
    loads = [
        arrays[channel][:, i]
        for channel, places in (
            ("actuator_force", actuators),
            ("driver_force", drivers),
            ("hydraulic_force", _pushed(scene)),
        )
        for i, place in enumerate(places)
        if place == wanted and channel in arrays
    ]
    return sum(loads[1:], loads[0].copy()) if loads else None


def _pushed(scene: Description) -> list[tuple[str, str] | None]:
    """The joint coordinates along which hydraulic cylinders push: those of the bodies that they join."""
    slides = [slide_of(scene, one) for one in hydraulic_cylinders(scene).values()]
    return [None if slide is None else (slide, "displacement") for slide in slides]


def _turned(angles: Array | None) -> Array | None:
    """Angles counted on over whole turns."""
    return _without_axis_of_one(None if angles is None else np.unwrap(angles, axis=0))


def _without_axis_of_one(array: Array | None) -> Array | None:
    return array[:, 0] if array is not None and array.shape[1] == 1 else array


def clearances(scene: Description, arrays: Mapping[str, Array]) -> Array | None:
    """Clearances (time, gap), m; None where there is none, or the core recorded too little."""
    if not scene.clearances or not all(name in arrays for name in NEEDED):
        return None
    return np.stack([_clearance(scene, arrays, one) for one in scene.clearances.values()], axis=1)


def _clearance(scene: Description, arrays: Mapping[str, Array], gap: Clearance) -> Array:
    center = position_of(scene, arrays, gap.body, gap.center)
    turn = np.eye(3)[None]
    if gap.body in scene.bodies:
        turn = rotation_matrix(arrays["quaternion"][:, list(scene.bodies).index(gap.body)])
    found = []
    for name in gap.points:
        point = scene.points[name]
        away = position_of(scene, arrays, point.body, point.point) - center
        found.append(distance_from_box((away[:, None, :] @ turn)[:, 0], gap.size))
    return np.asarray(np.min(found, axis=0))
