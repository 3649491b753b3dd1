"""Ballast tanks, and the smallest changes of their contents that make a moment."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from seacrane.arrays import Array
from seacrane.errors import SceneError
from seacrane.inputs.checked import number_of, positive_of, shaped_of
from seacrane.inputs.shown import shown

Vector = tuple[float, float, float]
OVERFLOW, RUN_DRY = 1e3, 1e6  # cost of 1 kg beyond a bound over that of 1 kg moved
OVER = 1e-6  # of the largest capacity: rounding of the linear program


@dataclass(frozen=True, kw_only=True)
class Tank:
    """A ballast tank.

    Attributes
    ----------
    point : (float, float, float)
        Centre of what it holds, body coordinates of the vessel, m.
    capacity : float
        kg.
    content : float
        kg that it holds in the condition of the vessel's database; default 0.
    """

    point: Vector
    capacity: float
    content: float = 0.0

    def __post_init__(self) -> None:
        x, y, z = shaped_of("tank: point", self.point, (3,)).tolist()
        object.__setattr__(self, "point", (x, y, z))
        object.__setattr__(self, "capacity", positive_of("tank: capacity", self.capacity, "kg"))
        object.__setattr__(self, "content", number_of("tank: content", self.content))
        if not np.all(np.isfinite(self.point)):
            raise SceneError(f"tank: point is {self.point}; give three finite numbers, m")
        if not 0.0 <= self.content <= self.capacity:
            raise SceneError(
                f"tank: content is {self.content:g} kg; give one from 0 to its capacity of "
                f"{self.capacity:g} kg"
            )


def tanks_of(given: Any) -> dict[str, Tank]:
    """Tanks by name; SceneError for anything else."""
    if not isinstance(given, Mapping) or not given:
        raise SceneError(f"ballast: tanks are {shown(given)}; give at least one Tank by its name")
    for name, tank in given.items():
        if not isinstance(name, str) or not isinstance(tank, Tank):
            raise SceneError(f"ballast: tank {shown(name)} is {shown(tank)}; give a seacrane.scene.Tank")
    return dict(given)


def fills(tanks: Mapping[str, Tank], moments: Array, needed: Array) -> Array:
    """Changes of the contents (kg) that make moments about roll, pitch or both, the least water moved.

    Those `needed` (k,), N m, by those of 1 kg in each tank (k, n). Raises SceneError if the tanks cannot make
    it: what the fullest, or the emptiest, would have to hold.
    """
    from scipy.optimize import linprog

    count, size = len(tanks), float(np.max(np.abs(moments), initial=1e-300))
    room = np.array([tank.capacity - tank.content for tank in tanks.values()])
    there = np.array([tank.content for tank in tanks.values()])
    # In and out of each tank; and how far the worst of them goes beyond what it holds, and below nothing.
    equal = np.hstack([moments, -moments, np.zeros((len(needed), 2))]) / size
    beyond = np.hstack([np.eye(2 * count), -np.kron(np.eye(2), np.ones((count, 1)))])
    cost = np.append(np.ones(2 * count), count * np.array([OVERFLOW, RUN_DRY]))
    solved = linprog(
        cost, A_ub=beyond, b_ub=np.concatenate([room, there]), A_eq=equal, b_eq=needed / size,
        bounds=(0.0, None), method="highs",
    )  # fmt: skip
    if solved.status != 0:
        raise SceneError(
            f"ballast: moments of {' and '.join(f'{one:.4g}' for one in needed)} N m are needed, about roll "
            f"and pitch as asked for, and no contents of tanks {', '.join(map(repr, tanks))} make them; add "
            "one on each side of the centreline, forward and aft, or leave the trim (trim_deg=None)"
        )
    change = solved.x[:count] - solved.x[count : 2 * count]
    _require_room(tanks, change)
    return np.asarray(np.clip(change, -there, room))


def _require_room(tanks: Mapping[str, Tank], change: Array) -> None:
    contents = {name: one.content + float(kg) for (name, one), kg in zip(tanks.items(), change, strict=True)}
    beyond = {name: max(content - tanks[name].capacity, -content) for name, content in contents.items()}
    worst = max(beyond, key=lambda name: beyond[name])
    if beyond[worst] <= OVER * max(tank.capacity for tank in tanks.values()):
        return
    tank, content = tanks[worst], contents[worst]
    if content > 0.0:
        what = f"would have to hold {content:.6g} kg, above its capacity of {tank.capacity:g} kg"
    else:
        what = f"would have to give {tank.content - content:.6g} kg, and holds {tank.content:g} kg"
    raise SceneError(
        f"ballast: tank {worst!r} {what}, the others being at their bounds too or of no use: give it more, "
        "add a tank further out, or ask for less heel or trim"
    )
