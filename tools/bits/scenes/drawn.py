"""Twenty trees of random joints, some with loops, on the ground, afloat or in the sea of a ship's matrices.

Only whole numbers of PCG64 are drawn, whose stream NumPy keeps; all else is made of these.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from bits.case import by, case
from bits.scenes.parts import G
from seacrane import Curve, Scene

COUNT = 20
TREE = (
    "revolute",
    "prismatic",
    "cylindrical",
    "universal",
    "spherical",
    "planar",
    "distance",
    "weld",
    "free",
)
LOOP = ("distance", "spherical", "cylindrical")
SECONDS = (
    by("rk4", "redundant", dt=5e-3), by("tsit5", "redundant"), by("dop853", "redundant"),
    by("verner65", "redundant"), by("cvode-bdf", "redundant"),
)  # fmt: skip


class Draw:
    """Numbers of one stream."""

    def __init__(self, seed: int) -> None:
        self.stream = np.random.PCG64([2026, seed])

    def share(self) -> float:
        """From 0 to 1."""
        return float(self.stream.random_raw() >> 11) * 2.0**-53

    def between(self, low: float, high: float, count: int | None = None) -> Any:
        values = np.array([low + (high - low) * self.share() for _ in range(count or 1)])
        return values if count else float(values[0])

    def one_of(self, given: Any) -> Any:
        return given[int(self.share() * len(given))]

    def unit(self) -> Any:
        while True:
            way = self.between(-1.0, 1.0, 3)
            if 0.2 < way @ way < 1.0:
                return way / np.sqrt(way @ way)


def body(scene: Scene, draw: Draw, name: str, at: Any, mass: float) -> None:
    a, b, c = draw.between(0.05, 0.3, 3)
    scene.add_body(
        name=name, mass=mass, inertia=mass * np.array([b + c, a + c, a + b]), position=at,
        center_of_mass=draw.between(-0.2, 0.2, 3),
    )  # fmt: skip


def join(
    scene: Scene, draw: Draw, kind: str, name: str, ends: tuple[str, str], places: dict[str, Any]
) -> None:
    point = 0.5 * (places[ends[0]] + places[ends[1]]) + draw.between(-0.5, 0.5, 3)
    axis, more = draw.unit(), {}
    if kind == "universal":
        more["second_axis"] = np.cross(axis, draw.unit())
    if kind == "distance":
        more["second_point"] = point + draw.between(0.5, 1.0) * draw.unit()
    if kind == "free":
        axis = (0.0, 0.0, 1.0)
    scene.add_joint(kind=kind, name=name, first=ends[0], second=ends[1], point=point, axis=axis, **more)


def drawn(seed: int) -> Scene:
    draw = Draw(seed)
    scene = Scene(name=f"drawn {seed}", gravity=G)
    base = draw.one_of(("ground", "ground", "floating", "ship"))
    root = "ground" if base == "ground" else "base"
    places = {root: np.zeros(3)}
    if base != "ground":
        body(scene, draw, "base", np.zeros(3), 100.0)
    if base == "ship":
        stiff = np.diag([0.0, 0.0, 900.0, 700.0, 700.0, 0.0])
        spring = {"mooring_stiffness": np.full(3, 10.0), "mooring_damping": np.full(3, 10.0)}
        scene.add_vessel(
            body="base",
            added_mass=20.0 * np.eye(6),
            linear_damping=5.0 * np.eye(6),
            restoring=stiff,
            **spring,
        )
    for i in range(1 + int(5 * draw.share())):
        holder, name = draw.one_of(list(places)), f"body {i}"
        places[name] = places[holder] + draw.between(-1.0, 1.0, 3)
        body(scene, draw, name, places[name], 10.0 ** draw.between(-1.0, 1.0))
        join(scene, draw, draw.one_of(TREE), f"joint {i}", (holder, name), places)
    names = list(places)
    if len(names) > 2 and draw.share() < 0.5:
        join(scene, draw, draw.one_of(LOOP), "closing", (names[0], names[-1]), places)
    ends = {"first": names[0], "second": names[-1], "first_point": draw.between(-1, 1, 3)}
    scene.add_spring(
        name="spring", **ends, stiffness=draw.between(1, 50), damping=draw.between(0, 2), natural_length=0.4
    )
    movable = [joint for joint in scene.joints.values() if joint.kind in ("revolute", "prismatic")]
    for i, joint in enumerate(movable):
        if i % 2 and "closing" not in scene.joints:
            swing = Curve.harmonic(offset=-0.2, amplitude=0.2, omega=1.5)
            scene.add_driver(joint=joint.name, curve=swing)
        else:
            scene.add_actuator(
                joint=joint.name, stiffness=draw.between(0, 20), damping=draw.between(0, 2), reference=0.1
            )
    return scene


for number in range(COUNT):
    second = SECONDS[number % len(SECONDS)]
    case(by("dopri5"), second, t_end=1.0, name=f"{number:02}")(lambda number=number: drawn(number))
