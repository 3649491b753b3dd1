"""Lines over sheaves with the numbers of their closed forms."""

from __future__ import annotations

from typing import Any

import numpy as np
from line_scenes import SWINGING_WINCH, on_arm

from seacrane import Scene
from seacrane.description.line_path import path_length

G = 9.80665
MASS, STIFFNESS = 20e3, 3e6  # kg, N: of the hook and of its line
RADIUS, HEIGHT = 0.3, 8.0  # m: of sheaves, and of the crown above the hook
DOWN = (0.0, -1.0, 0.0)  # axis of a sheave that a line passes below, towards x
OVER = (0.0, 1.0, 0.0)


def tackle(*, falls: int = 6, damping_ratio: float = 0.02, **sheaves: Any) -> Scene:
    """A hook on an even number of vertical falls, all in one plane, at rest in its own weight."""
    taut = MASS * G / (falls * STIFFNESS)
    scene = Scene(name="tackle")
    scene.add_body(name="hook", mass=MASS, inertia=(1e4, 1e4, 1e4), position=(0.0, 0.0, -HEIGHT))
    way = {"point": (0, 0, 0), "axis": (0, 0, 1)}
    scene.add_joint("guide", kind="prismatic", first="ground", second="hook", **way)
    centers = RADIUS * np.arange(-falls + 2, falls, 2.0)
    at_hook = np.arange(centers.size) % 2 == 0
    bodies = ["ground", *np.where(at_hook, "hook", "ground").tolist(), "ground"]
    x = [centers[0] - RADIUS, *centers, centers[-1] + RADIUS]
    axes = [(0, 0, 0), *[DOWN if low else OVER for low in at_hook], (0, 0, 0)]
    scene.add_line(name="hoist", bodies=bodies, points=np.column_stack([x, np.zeros((len(x), 2))]),
                   EA=STIFFNESS, length=path_of_tackle(falls) / (1.0 + taut), mass=MASS / falls**2,
                   damping_ratio=damping_ratio, sheaves={"radii": [0.0, *[RADIUS] * centers.size, 0.0],
                   "axes": axes, **sheaves})  # fmt: skip
    return scene


def path_of_tackle(falls: int) -> float:
    """Falls and half turns, m."""
    return falls * HEIGHT + (falls - 1) * np.pi * RADIUS


def belt(*, crossed: bool) -> tuple[Scene, float]:
    """A line that begins and ends at one point of its own belt around two wheels; and the belt's length."""
    large, small, apart = 1.0, 0.4, 3.0
    lean = np.arcsin((large + small if crossed else large - small) / apart)
    n = np.array([np.sin(lean), 0.0, np.cos(lean)])  # of the upper tangent on the large wheel, at the origin
    start = large * n + 1.0 * np.array([np.cos(lean), 0.0, -np.sin(lean)])
    scene = Scene(name="belt")
    scene.add_body(name="small", mass=1.0, inertia=(1.0, 1.0, 1.0), position=(apart, 0.0, 0.0), gravity=False)
    straight = np.sqrt(apart**2 - (large + small if crossed else large - small) ** 2)
    wraps = (np.pi + 2.0 * lean, np.pi + 2.0 * lean if crossed else np.pi - 2.0 * lean)
    length = 2.0 * straight + large * wraps[0] + small * wraps[1]
    scene.add_line(name="belt", bodies=["ground", "small", "ground", "ground"], points=[start, (0, 0, 0), (0,
                   0, 0), start], EA=1e3, length=length, sheaves={"radii": [0, small, large, 0], "axes": [(0,
                   0, 0), DOWN if crossed else OVER, OVER, (0, 0, 0)]})  # fmt: skip
    return scene, float(length)


def capstan(*, turns: float = 0.0, friction: float = 0.1, rate: float = -0.5) -> Scene:
    """A load on a line over one sheave to a winch beside it."""
    scene = Scene(name="capstan")
    scene.add_body(name="load", mass=1e3, inertia=(50.0, 50.0, 50.0), position=(RADIUS, 0.0, -6.0))
    scene.add_joint(
        kind="prismatic", name="guide", first="ground", second="load", point=(RADIUS, 0, 0), axis=(0, 0, 1)
    )
    path = 5.0 + 6.0 + RADIUS * (0.5 * np.pi + 2.0 * np.pi * turns)
    scene.add_line(name="hoist", bodies=["ground", "ground", "load"], points=[(-5.0, 0.0, RADIUS), (0, 0, 0),
                   (0, 0, 0)], EA=5e6, length=path / (1.0 + 1e3 * G / 5e6), damping_ratio=0.2,
                   sheaves={"radii": [0, RADIUS, 0], "axes": [(0, 0, 0), OVER, (0, 0, 0)], "turns": [0, turns,
                   0], "frictions": [0, friction, 0]})  # fmt: skip
    scene.add_winch(line="hoist", rate=rate, lag=0.2)
    return scene


def slewing(sheaves: Any = None, **change: Any) -> Scene:
    """An arm that swings, with a tackle of two falls over sheaves that lean out of its plane, a winch on the
    arm, friction, and a cord to the load."""
    scene = on_arm((4.2, 0.3, -5.0))
    sheaves = {
        "radii": [0, 0.2, 0.25, 0.2, 0],
        "axes": [(0, 0, 0), (0.0, 1.0, 0.1), (0.1, 1.0, 0.1), (0.2, -1.0, 0.1), (0, 0, 0)],
        "efficiencies": [1, 0.98, 1, 0.96, 1], "frictions": [0, 0, 0.03, 0, 0], "slip_speed": 0.05,
    } | (sheaves or {})  # fmt: skip
    scene.add_line(name="hoist", bodies=["ground", "arm", "cleat", "load", "cleat"], sheaves=sheaves,
                   points=[(0.0, 0.0, 0.0), (-0.5, 0.0, 0.8), (0.3, 0.0, 0.1), (0.0, 0.0, 0.5), (0.9, 0.2,
                   0.1)], **{"EA": 3e6, "length": 14.75, "damping_ratio": 0.05} | change)  # fmt: skip
    scene.add_winch(line="hoist", **SWINGING_WINCH)
    scene.add_line(
        name="cord", bodies=["ground", "load"], points=[(10.0, 3.0, -5.0), (0.5, 0, 0)], length=5.0,
        strains=[0.0, 0.1, 0.3, 0.8], tensions=[0.0, 300.0, 700.0, 3000.0],
    )  # fmt: skip
    return scene


def stiff(stiffness: float, rung: str, **change: Any) -> Scene:
    """`slewing` with a taut line of that EA, which starts with 8 kN."""
    scene = slewing(EA=stiffness, rung=rung, **change)
    line: Any = scene.loads["hoist"]
    scene.replace("hoist", length=path_length(scene, line) / (1.0 + 8e3 / stiffness))
    return scene
