"""Names of channels: what the core records and keeps for those that are wanted, and what they need."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence, Set
from contextlib import suppress
from difflib import get_close_matches
from operator import attrgetter
from typing import Any

from seacrane import _core
from seacrane.analysis.least_pulls import least_pulls, weighed_suspensions
from seacrane.description.channels import CHANNELS, DERIVED, FIXED, OWN, unit_of
from seacrane.description.compilation import compile_scene
from seacrane.description.crane_parts import cylinders, hooks, piston_areas, slews, tips
from seacrane.description.description import Description
from seacrane.description.loads import lines_of, whole_of, winches_of
from seacrane.description.once import once, once_in_any_sea
from seacrane.description.pick import Pick
from seacrane.description.places import POSE
from seacrane.description.roles import CraneRoles
from seacrane.description.suspension import Hung, hung_loads, names_of_suspensions
from seacrane.description.wet_parts import wet_names
from seacrane.errors import SceneError
from seacrane.inputs.caller import silently
from seacrane.scene.recorded import picks

USUAL = (
    "vessel_motion", "actuator_force", "driver_force", "hydraulic_force", "tension", "line_tension",
    "end_tension", "section_tension", "gas_spring_tension", "contact_press", "limit_force",
)  # fmt: skip
# Derived channels that rise, or fall, with what they are made of.
MONOTONE = (
    "stroke", "stroke_rate", "cylinder_force", "cylinder_pressure", "slew_torque", "link_tension",
    "hook_load", "slack_margin", "utilisation", "wire_paid_out", "wire_spare",
)  # fmt: skip


def kept_names(scene: Description, recorded: Iterable[str], asked: Iterable[str] | None) -> set[str]:
    """Channels of a result, of those recorded and made of them; None: the usual ones."""
    if asked is not None:
        return set(asked)
    limited = limited_channels(scene)
    derived = {name for name in DERIVED if DERIVED[name].by_default or name in limited}
    return derived | {*recorded} - {"time"} | {*with_sources(scene, [OWN])}


def unit_in(scene: Description | None, pick: Pick) -> str:
    """The unit of one curve; of a channel of one's own that of its expression in the scene."""
    own = None if scene is None else scene.channels.get(pick.names.get("expression", ""))
    return unit_of(pick.channel, pick.names.values()) if own is None else own.unit


def sources_of(name: str) -> tuple[str, ...]:
    """The core's channels that a channel is made of, as far as a scene has them."""
    return DERIVED[name].made_of if name in DERIVED else (name,)


def with_sources(scene: Description, channels: Iterable[str]) -> list[str]:
    """Channels with those that expressions are made of in the place of the expressions."""
    out = list(dict.fromkeys(channels))
    if OWN not in out:
        return out
    made_of = [pick.channel for curves in picks(scene).values() for pick in curves]
    return list(dict.fromkeys([*(name for name in out if name != OWN), *made_of]))


def core_channels(scene: Description, wanted: Sequence[str], known: Sequence[str]) -> set[str]:
    """The core's channels that the wanted ones are made of; raises SceneError for an unknown name."""
    made_of: set[str] = set()
    for name in wanted:
        sources = [source for source in sources_of(name) if source in known]
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
    return {dim: list(names(scene)) for dim, (names, _) in ALONG.items()}


@once
def all_names(scene: Description, model: _core.Model) -> Mapping[str, Sequence[str]]:
    """Names along every dimension of the channels but time."""
    return {**model.axes, **derived_coords(scene), **FIXED}


@once
def recorded_channels(scene: Description, model: _core.Model, asked: tuple[str, ...] | None) -> Set[str]:
    """The core's channels that a run records for those that it is asked for; None: for the usual ones."""
    ends = ["end_tension"] if lowest_segments(scene) else []
    usual = [*model.channel_names(), *ends, *limited_channels(scene), OWN]
    wanted = with_sources(scene, usual if asked is None else asked)
    if "slack_margin" in wanted:
        least_pulls(scene)  # before the run: what comes to no rest is refused
    made_of = core_channels(scene, wanted, model.channel_names(defaults_only=False))
    return made_of if ends or "end_tension" in wanted else made_of - {"end_tension"}


def limited_channels(scene: Description) -> list[str]:
    """The channels of its limit states."""
    return [state.channel for state in scene.limit_states.values()]


def wanted_extremes(scene: Description, recorded: Set[str], asked: tuple[str, ...] | None) -> set[str]:
    """Those of the core's recorded channels, for the channels that are asked for; None: the usual ones."""
    names = (*USUAL, *limited_channels(scene)) if asked is None else asked
    made_of = {source for name in names if name in MONOTONE for source in sources_of(name)}
    wanted = {*names, *made_of.difference(POSE)}
    return {name for name in recorded & wanted if CHANNELS[name].has_extremes}


def sought_peaks(asked: tuple[str, ...] | None, peaks: Iterable[str] | None) -> tuple[str, ...] | None:
    """Channels whose peaks are wanted, of those asked for: None, of all; SceneError for an unknown one."""
    if unknown := {*(peaks or ())} - CHANNELS.keys():
        raise SceneError(f"peaks: there is no channel {min(unknown)!r}; name channels whose peaks are wanted")
    return asked if peaks is None else tuple(peaks)


def followed(scene: Description, recorded: Set[str], asked: tuple[str, ...] | None) -> dict[str, set[str]]:
    """Derived channels that are made anew at every step: of what recorded channels."""
    names = limited_channels(scene) if asked is None else asked
    found = {}
    for name in names:
        if name not in DERIVED or name in MONOTONE or DERIVED[name].turns:
            continue
        made_of = {source for part in with_sources(scene, [name]) for source in sources_of(part)}
        found[name] = made_of & recorded
    return found


def on_cranes(scene: Description) -> list[Hung]:
    """What hangs on the cranes, in their order."""
    return [one for one in hung_loads(scene) if one.crane is not None]


def is_rated(crane: CraneRoles | None) -> bool:
    """Whether its capacity over the radius of its tip is known."""
    return crane is not None and bool(crane.capacity) and crane.slew is not None and crane.tip is not None


def has_slew(scene: Description, crane: CraneRoles | None) -> bool:
    """Whether it slews, with a tip."""
    if crane is None or crane.slew is None or crane.tip is None:
        return False
    return crane.slew[0] in scene.joints and crane.tip[0] in scene.bodies


def _slewing_hooks(scene: Description) -> list[Hung]:
    return [one for one in on_cranes(scene) if has_slew(scene, one.crane)]


@once_in_any_sea
def lowest_segments(scene: Description) -> Mapping[str, int]:
    """The last segment of each line with mass: the place of the line along `whole_line`."""
    wholes = list(dict.fromkeys(whole_of(name, line) for name, line in lines_of(scene.loads).items()))
    last = {whole_of(name, line): name for name, line in lines_of(scene.loads).items()}
    return {name: wholes.index(whole) for whole, name in last.items() if name != whole}


_HOOK = "a load on a crane: add_hoist one, or name link or line by add_roles"
_SLEWING_HOOK = f"{_HOOK}, on a crane with a tip and a slew drive"
Names = tuple[Callable[[Description], Iterable[Any]], str]
ALONG: Mapping[str, Names] = {  # by dimension of derived channels: its names, and what a scene has them from
    "cylinder": (cylinders, "a crane with cylinders: add_crane, or name them by add_roles(cylinders=...)"),
    "piston": (piston_areas, "areas of pistons: give add_roles(areas=...), or a crane's file with them"),
    "suspension": (names_of_suspensions, "a link, a wire or a line: add one"),
    "weighed": (weighed_suspensions,
                "a link, a wire or lines that carry a load which nothing else holds: add one"),
    "immersed": (wet_names, "parts in water: add_immersed them"),
    "gap": (attrgetter("clearances"), "points and a box: add_channel(points=...) them"),
    "expression": (attrgetter("channels"), "an expression: add_channel one"),
    "winch": (lambda scene: winches_of(scene.loads), "a line on a winch: add_winch one"),
    "slew": (slews, "a slew drive: add_crane, or name it by add_roles(slew=...)"),
    "hook": (lambda scene: [one.label for one in on_cranes(scene)], _HOOK),
    "tip": (tips, "the tip of a crane: add_crane, or name it by add_roles(tip=...)"),
}  # fmt: skip
PARTS: Mapping[str, Names] = {  # of those that some of these names have, and others not
    "link_tension": (hooks, "a link on a crane: name a distance joint by add_roles(link=...)"),
    "offlead": (_slewing_hooks, _SLEWING_HOOK),
    "sidelead": (_slewing_hooks, _SLEWING_HOOK),
    "utilisation": (
        lambda scene: [one for one in on_cranes(scene) if is_rated(one.crane)],
        f"{_HOOK}, on a crane with a tip, a slew drive and a capacity table",
    ),
}


def require_channels(scene: Description, wanted: Iterable[str]) -> None:
    """SceneError for channels that a scene has at no time, and for those of its limit states.

    Of a scene that cannot be compiled as it is described, those that Python derives are known.
    """
    asked = list(wanted)
    require_names(scene, [*asked, *limited_channels(scene)])
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
        channel: ALONG[dim][1]
        for channel in derived
        for dim in CHANNELS[channel].dims_of_several
        if dim in ALONG and not names[dim]
    }
    parts = {channel: PARTS[channel] for channel in derived if channel in PARTS}
    return unnamed | {channel: need for channel, (there, need) in parts.items() if not there(scene)}


@once
def require_limited_channels(scene: Description, model: _core.Model) -> None:
    """SceneError where a limit state or an expression has a channel or a place that the scene has not.

    Also where an expression leaves one of several places open.
    """
    known, axes = model.channel_names(defaults_only=False), all_names(scene, model)
    for channel, curves in picks(scene).items():
        for pick in curves:
            _require_one(f"channel {channel!r}: {pick}", pick, axes)
    require_names(scene, [OWN] if scene.channels else [])
    for name, state in scene.limit_states.items():
        try:
            core_channels(scene, with_sources(scene, [state.channel]), known)
            require_names(scene, [state.channel])
        except SceneError as error:
            raise SceneError(f"limit state {name!r}: {error}") from error
        for dim, chosen in state.names.items():
            _require_name(f"limit state {name!r}", dim, chosen, axes.get(dim, ()))


def require_curves(scene: Description, asked: Iterable[Pick]) -> None:
    """SceneError for channels that a scene has at no time, or names of which it has none, or several."""
    wanted, axes = list(asked), dict[str, Sequence[str]]()
    require_channels(scene, [pick.channel for pick in wanted])
    with suppress(SceneError), silently():  # what is described may be no scene before its stages
        axes = dict(all_names(scene, compile_scene(scene)))
    for pick in wanted if axes else ():
        _require_one(str(pick), pick, axes)


def _require_one(what: str, pick: Pick, axes: Mapping[str, Sequence[str]]) -> None:
    """That a scene has what a pick names, and that it names one along each dimension."""
    for dim in CHANNELS[pick.channel].dims_of_several[1:]:
        _require_name(what, dim, pick.names.get(dim), axes.get(dim, ()))


def _require_name(what: str, dim: str, name: str | None, known: Sequence[str]) -> None:
    if name is None and len(known) != 1:
        raise SceneError(f"{what}: says not which {dim}; name one of {', '.join(known) or 'none'}")
    if name is not None and name not in known:
        near = get_close_matches(name, known, n=1)
        fix = f"did you mean {near[0]!r}?" if near else f"choose from {', '.join(known) or 'none'}"
        raise SceneError(f"{what}: there is no {dim} {name!r}; {fix}")
