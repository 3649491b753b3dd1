"""Choices about the small damping of loads in air: drag, and friction where they hang."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import partial

import numpy as np

from seacrane import _core
from seacrane.description.suspension import hung_loads
from seacrane.needs.choice import Choice
from seacrane.scene.scene import Scene


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
