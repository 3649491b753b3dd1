"""Least static loads of rods, lines and slings: those at rest in air, or with all that hangs under water."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from seacrane import _core
from seacrane.analysis.inverse import channels_at
from seacrane.analysis.rest_state import held, rest_states
from seacrane.arrays import Array
from seacrane.description.compilation import compile_scene
from seacrane.description.description import COMPILED, GROUND, KINDS, Description
from seacrane.description.elements import add_joint
from seacrane.description.loads import bodies_of, changed, lines_of, path_of
from seacrane.description.once import once_in_any_sea
from seacrane.description.places import place_of
from seacrane.description.suspension import Rig, Suspension, least_weights, names_of_suspensions, rigs
from seacrane.description.wet_parts import immersed_parts, waters_in

TENSIONS = ("tension", "line_tension")


@once_in_any_sea
def weighed_suspensions(scene: Description) -> list[str]:
    """Names of the suspensions whose least static load is known."""
    known = {one.channel for rig in rigs(scene) for one in (*rig.held, *rig.inner)}
    return [name for name in names_of_suspensions(scene) if name in known or name in least_weights(scene)]


@once_in_any_sea
def least_pulls(scene: Description) -> Mapping[str, float]:
    """Least static load (N) at the lower ends of `weighed_suspensions`; SceneError where none comes to rest.

    Of what alone carries its load the least weight. Of slings the lesser at two rests of what hangs: in air,
    and with all parts in water. Zero of a sling that is slack at one of them.
    """
    found = dict(least_weights(scene))
    for rig in rigs(scene):
        shared = [one for one in (*rig.held, *rig.inner) if one.channel not in found]
        if shared:
            rests = [_pulls(one, shared) for one in _alone(scene, rig)]
            found |= {one.channel: min(pulls[one.channel] for pulls in rests) for one in shared}
    return {name: found[name] for name in weighed_suspensions(scene)}


def _alone(scene: Description, rig: Rig) -> list[Description]:
    """Scenes with nothing but what hangs, its upper ends held: in air, and where it is wet under water."""
    inside = {*rig.bodies, GROUND}
    above = {part for one in rig.held for part in one.parts}
    kept = {
        key: {
            name: one for name, one in getattr(scene, key).items()
            if name not in above and (bodies := bodies_of(one, scene.joints)) and inside.issuperset(bodies)
        }
        for key in COMPILED
    }  # fmt: skip
    kept["bodies"] = {name: body for name, body in scene.bodies.items() if name in rig.bodies}
    empty: dict[str, dict[str, Any]] = {key: {} for key in KINDS}
    whole = scene.copy(waves=None, **empty | kept)
    wet = {*immersed_parts(whole), *(one.name for one in waters_in(whole))}
    dry = whole.copy(loads={name: one for name, one in whole.loads.items() if name not in wet})
    lowered = [_held(scene, rig, dry, 0.0)]
    return [*lowered, _held(scene, rig, whole, _depth(whole))] if wet else lowered


def _depth(scene: Description) -> float:
    """How far all parts are under water, however they turn, once it is lowered so far, m."""
    reaches = [
        np.linalg.norm(part.point) + np.linalg.norm(part.size) for part in immersed_parts(scene).values()
    ]
    reaches += [np.linalg.norm(water.point) + water.height for water in waters_in(scene)]
    heights = [body.position[2] for body in scene.bodies.values()]
    return float(max(heights) + np.ptp(heights) + 2.0 * max(reaches))


def _held(scene: Description, rig: Rig, alone: Description, depth: float) -> Description:
    """What hangs, lowered by a depth (m), its upper ends where they are described over it."""
    drop = np.array([0.0, 0.0, -depth])
    bodies = {name: changed(body, position=body.position + drop) for name, body in alone.bodies.items()}
    out = alone.copy(bodies=bodies)
    if len(rig.held) == 1:
        body, point = rig.held[0].lower
        add_joint(out, rig.held[0].name, kind="spherical", first=GROUND, second=body,
                  point=place_of(out, body=body, point=point))  # fmt: skip
        return out
    for one in rig.held:
        _hang(scene, out, one, drop)
    return out


def _hang(scene: Description, out: Description, one: Suspension, drop: Array) -> None:
    """Give a scene one of the lines or rods on which it hangs, from the ground."""
    for name in one.parts:
        if name in scene.joints:
            rod = scene.joints[name]
            upper = place_of(scene, body=rod.first, point=rod.first_frame.point) + drop
            frame = _core.Frame(point=upper, axes=rod.first_frame.axes)
            out.joints[name] = changed(rod, first=GROUND, first_frame=frame)
            continue
        line = lines_of(scene.loads)[name]
        ends = [
            (body, point) if body in out.bodies else (GROUND, place_of(scene, body=body, point=point) + drop)
            for body, point in path_of(line)
        ]
        bodies, points = zip(*ends, strict=True)
        out.loads[name] = changed(line, bodies=list(bodies), points=list(points))


def _pulls(scene: Description, wanted: Sequence[Suspension]) -> dict[str, float]:
    """Load at the lower end of each at rest, N, by its `channel`."""
    state = next(rest_states(scene, times=[0.0]))
    told = channels_at(compile_scene(held(scene)), set(TENSIONS), 0.0, np.array(state.values))
    pulls = np.concatenate([told[name] for name in TENSIONS if name in told])
    found = dict(zip(names_of_suspensions(scene), pulls.tolist(), strict=True))
    return {one.channel: one.falls * max(found[one.channel], 0.0) for one in wanted}
