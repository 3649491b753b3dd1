"""Random four-bars close to where all their joints lie on one line, and random shapes by seed alone."""

from __future__ import annotations

import numpy as np
from random_scenes import CLOSING, KINDS, Shape, unit

from seacrane import Scene
from seacrane.arrays import Array


def shape_of(seed: int, *, most: int = 6, loops: int = 0, struts: int = 0) -> Shape:
    """Uniform draws: up to `most` bodies, one to `loops` joints more than a tree has, `struts` cylinders."""
    rng = np.random.default_rng(seed)
    count = int(rng.integers(1, most + 1))
    return Shape(
        seed=int(rng.integers(2**32)), parents=tuple(int(rng.integers(-1, i)) for i in range(count)),
        kinds=tuple(str(rng.choice(KINDS)) for _ in range(count)),
        swapped=tuple(bool(b) for b in rng.integers(0, 2, count)),
        closing=tuple(str(rng.choice(CLOSING)) for _ in range(rng.integers(1, loops + 1) if loops else 0)),
        base=str(rng.choice(["ground", "floating", "vessel"])), driven=bool(rng.integers(2)), struts=struts
    )  # fmt: skip


def four_bar(rng: np.random.Generator, turned: float) -> Array | None:
    """Joints (4, 2) of a four-bar whose bars fold into one line, its first crank `turned` rad from there;
    None where these bars do not turn."""
    first, far, last = rng.uniform(0.4, 1.5, 3) * rng.choice([-1.0, 1.0], 3)
    points = np.array([[0.0, 0.0], [first, 0.0], [first + far, 0.0], [first + far + last, 0.0]])
    if abs(points[3, 0]) < 0.3:
        return None
    points[1] = first * np.array([np.cos(turned), np.sin(turned)])
    gap = points[3] - points[1]
    distance = float(np.linalg.norm(gap))
    along = (distance**2 + far**2 - last**2) / (2.0 * distance)
    if far**2 < along**2:
        return None
    across = np.sqrt(far**2 - along**2)
    points[2] = points[1] + (along * gap + across * np.array([-gap[1], gap[0]])) / distance
    return points


def nearly_flat(seed: int, turned: float, *, planar: bool = False, decades: float = 6.0) -> Scene:
    """A four-bar in a random plane, `turned` rad from its singular position. `planar`: four hinges, three of
    whose rows are redundant; else a ball and a sliding hinge let the loop hold each motion once."""
    rng = np.random.default_rng(seed)
    points = None
    while points is None:
        points = four_bar(rng, turned)
    normal = unit(rng)
    x = np.cross(normal, unit(rng))
    x /= np.linalg.norm(x)
    places = rng.normal(size=3) + points @ np.array([x, np.cross(normal, x)])
    scene = Scene(name="flat", gravity=9.81)
    for i in range(3):
        mass = 10.0 ** rng.uniform(-0.5 * decades, 0.5 * decades)
        scene.add_body(
            name=f"bar {i}", mass=mass, inertia=mass * np.diag(rng.uniform(0.1, 0.19, 3)),
            position=0.5 * (places[i] + places[i + 1]) + rng.uniform(-0.1, 0.1, 3),
        )  # fmt: skip
    bodies = ["ground", "bar 0", "bar 1", "bar 2", "ground"]
    kinds = ["revolute"] * 4 if planar else ["revolute", "revolute", "spherical", "cylindrical"]
    order = range(4) if rng.integers(2) else range(3, -1, -1)
    for i in order:
        kind = kinds[i] if order[0] == 0 else kinds[3 - i]
        pair = bodies[i : i + 2] if rng.integers(2) else bodies[i : i + 2][::-1]
        extra = {} if kind == "spherical" else {"axis": normal}
        scene.add_joint(kind=kind, name=f"pin {i}", first=pair[0], second=pair[1], point=places[i], **extra)
    return scene
