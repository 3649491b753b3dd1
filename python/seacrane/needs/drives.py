"""Choices about what drives, holds and brakes: oil and controlled drives, contacts, small damping."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import partial

import numpy as np

from seacrane import _core
from seacrane.accuracy.simpler_scenes import locked
from seacrane.description.hydraulic_cylinders import hydraulic_cylinders, slide_of
from seacrane.description.places import place_of
from seacrane.description.suspension import hung_loads
from seacrane.needs.choice import Choice
from seacrane.scene.scene import Scene

TOUCHING = 0.05  # m: a body this near to a plane, or in it, stands on it


def held_oil(scene: Scene) -> Iterator[Choice]:
    """Hydraulic cylinders that hold their stroke, each held by a driver instead."""
    held = {
        name: slide
        for name, one in hydraulic_cylinders(scene).items()
        if (slide := slide_of(scene, one)) is not None and _is_still(one.reference)
    }
    if held:
        lines = [
            f'scene.remove("{name}", kind="load")\nscene.add_driver("{slide}", curve=0.0)'
            for name, slide in held.items()
        ]
        yield Choice(
            name=f"cylinders held without oil: {', '.join(held)}",
            script="\n".join(lines),
            made=partial(_held, slides=held),
            of="drives",
        )


def _is_still(curve: _core.Curve) -> bool:
    pieces = curve.to_pieces()
    return len(pieces["starts"]) == 1 and not np.any(np.reshape(pieces["coefficients"], (-1, 6))[:, 1:])


def _held(scene: Scene, *, slides: dict[str, str]) -> Scene:
    out = scene.copy(loads={name: load for name, load in scene.loads.items() if name not in slides})
    for slide in slides.values():
        out.add_driver(slide, curve=0.0)
    return out


def held_crane(scene: Scene) -> Iterator[Choice]:
    """Controlled coordinates held where they start."""
    if scene.actuators:
        yield Choice(
            name="crane held where it starts", script="scene = needs.locked(scene)", made=locked, of="drives"
        )


def no_air_drag(scene: Scene) -> Iterator[Choice]:
    """Of each body, in still air."""
    for name, load in scene.loads.items():
        if isinstance(load, _core.FlowForce) and not np.any(load.speed.to_pieces()["coefficients"]):
            yield without(f"no air drag on {load.body}", [name], of=f"air drag of {load.body}")


def no_wind(scene: Scene) -> Iterator[Choice]:
    """On each body that wind or current loads by coefficients."""
    for name, load in scene.loads.items():
        if isinstance(load, _core.FlowForce) and np.any(load.speed.to_pieces()["coefficients"]):
            yield without(f"no {name}", [name], of=name)


def no_pendulum_damping(scene: Scene) -> Iterator[Choice]:
    """Of each load's swing."""
    for name, load in scene.loads.items():
        if isinstance(load, _core.PendulumDamping):
            yield without(f"no pendulum damping of {load.second}", [name], of=f"damping of {load.second}")


def more_pendulum_damping(scene: Scene) -> Iterator[Choice]:
    """The usual damping of a load whose swing has none."""
    damped = {load.second for load in scene.loads.values() if isinstance(load, _core.PendulumDamping)}
    for hung in hung_loads(scene):
        if hung.load not in damped:
            first, point = hung.suspension.upper
            yield Choice(
                name=f"pendulum damping of {hung.load}",
                script=f'scene.add_pendulum_damping("{hung.load} swing", first="{first}", '
                f'first_point={tuple(point)}, second="{hung.load}")',
                made=partial(_damped, load=hung.load, first=first, point=tuple(point)),
                of=f"damping of {hung.load}",
            )


def _damped(scene: Scene, *, load: str, first: str, point: tuple[float, ...]) -> Scene:
    out = scene.copy()
    out.add_pendulum_damping(f"{load} swing", first=first, first_point=point, second=load)
    return out


def without(name: str, loads: Iterable[str], *, of: str) -> Choice:
    """The choice that takes loads out of a scene."""
    names = list(loads)
    script = "\n".join(f'scene.remove("{one}", kind="load")' for one in names)
    return Choice(name=name, script=script, made=partial(_removed, names=names), of=of)


def _removed(scene: Scene, *, names: list[str]) -> Scene:
    return scene.copy(loads={name: load for name, load in scene.loads.items() if name not in names})


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
