"""Choices about contacts: a seat in the place of one, or none."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np

from seacrane import _core
from seacrane.description.places import place_of
from seacrane.needs.choice import Choice
from seacrane.needs.small_damping import without
from seacrane.scene.scene import Scene

TOUCHING = 0.05  # m: a body this near to a plane, or in it, stands on it


def no_contact(scene: Scene) -> Iterator[Choice]:
    """Without one of the contacts."""
    for name in _contacts(scene):
        yield without(f"no contact {name}", [name], of=f"contact {name}")


def welded_contact(scene: Scene) -> Iterator[Choice]:
    """A body that stands on a plane held by a seat until it is lifted off."""
    for name, one in _contacts(scene).items():
        jointed = any(one.body in (joint.first, joint.second) for joint in scene.joints.values())
        if one.surface == "plane" and not jointed and _stands(scene, one):
            place, axis = _foot(scene, one)
            yield Choice(
                name=f"seat in place of contact {name}",
                script=f'scene.remove("{name}", kind="load")\n'
                f'scene.add_joint("{name}", kind="weld", first="{one.on}", second="{one.body}", '
                f'point={place}, axis={axis})\nscene.add_stop("{name}")',
                made=partial(_seated, name=name),
                of=f"contact {name}",
            )


def _contacts(scene: Scene) -> dict[str, _core.Contact]:
    return {name: load for name, load in scene.loads.items() if isinstance(load, _core.Contact)}


def _stands(scene: Scene, one: _core.Contact) -> bool:
    place, axis = _foot(scene, one)
    heights = [
        float(np.dot(place_of(scene, body=one.body, point=p) - np.array(place), axis)) for p in one.points
    ]
    return max(heights) < TOUCHING


def _foot(scene: Scene, one: _core.Contact) -> tuple[list[float], list[float]]:
    """A place on the plane and the axis away from it, inertial frame."""
    origin = place_of(scene, body=one.on, point=one.place)
    tip = place_of(scene, body=one.on, point=np.asarray(one.place) + np.asarray(one.axes)[:, 2])
    middle = np.mean([place_of(scene, body=one.body, point=p) for p in one.points], axis=0)
    axis = tip - origin
    foot = middle - np.dot(middle - origin, axis) * axis
    return np.round(foot, 9).tolist(), np.round(axis, 12).tolist()


def _seated(scene: Scene, *, name: str) -> Scene:
    if name not in scene.loads:
        return scene
    one = _contacts(scene)[name]
    place, axis = _foot(scene, one)
    out = scene.copy()
    out.remove(name, kind="load")
    out.add_joint(name, kind="weld", first=one.on, second=one.body, point=place, axis=axis)
    out.add_stop(name)
    return out
