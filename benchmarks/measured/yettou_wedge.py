"""A wedge of 25 deg dropped into still water (Yettou et al. 2006)."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from measured_row import Array, MeasuredRow, Source
from scipy.special import gamma

from seacrane import Scene, simulate
from seacrane.hydro import TablePart

SOURCE = Source(
    title="Wedge that falls into water",
    repository="dineshadepu/02_particles_dispersion",
    commit="6baaa54f0c8a7df17fdc81176f7ff694ca1fb2fb",
    licence="none told: a few numbers quoted",
    about="tank: water entry of a wedge, Yettou et al. (2006), read from a figure by others",
    quoted=True,
)
DEADRISE, HALF_BREADTH, MASS, SPEED = np.radians(25.0), 0.6, 94.0, 5.05  # rad, m, kg/m, m/s as it touches
RHO, G = 1000.0, 9.81
HEIGHT = HALF_BREADTH * np.tan(DEADRISE)
TIME = np.array([5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 40.0])  # ms
MEASURED = np.array([4.82, 4.10, 3.16, 2.56, 2.33, 2.10, 1.78])  # m/s
BEM = np.array([4.67, 3.96, 3.29, 2.79, 2.42, 2.14, 1.76])
PILE_UP, PLATE, OWN = (
    "table with pile-up",
    "table of the plate as broad as the level water",
    "table of the wedge alone, as a panel code has it",
)


def rows(_: Path) -> Iterator[MeasuredRow]:
    line = np.linspace(0.0, 42.0, 211)
    for by, factor in factors().items():
        ours = speeds(line, factor)
        common: dict[str, Any] = {
            "picture": "measured_wedge_entry", "panel": "speed of a wedge of 25 deg", "by": by,
            "x": "time, ms", "y": "speed, m/s", "at": TIME, "of": "value", "points": (TIME, MEASURED),
            "line": (line, ours), "others": {"boundary elements of Zhao and Faltinsen, quoted": (TIME, BEM)},
        }  # fmt: skip
        at = np.interp(TIME, line, ours)
        expected = 0.08 if by == PILE_UP else None
        yield MeasuredRow(**common, compared="speed", measured=MEASURED, ours=at, expected=expected)
        yield MeasuredRow(
            **common, compared="speed, boundary elements instead of the tank", measured=BEM, ours=at,
        )  # fmt: skip


def factors() -> dict[str, float]:
    """Added mass by each way, over density times the square of the half breadth at the level surface."""
    share = DEADRISE / np.pi
    of_wedge = np.pi / np.sin(DEADRISE) * gamma(1.5 - share) / gamma(1.0 - share) ** 2 / gamma(0.5 + share)
    return {
        PILE_UP: float(0.5 * np.pi * (0.5 * np.pi) ** 2 * (1.0 - share) ** 2),
        PLATE: float(0.5 * np.pi),
        OWN: float(np.tan(DEADRISE) * (of_wedge - 1.0)),
    }


def speeds(times: Array, factor: float) -> Array:
    """m/s downwards at times in ms after touch."""
    scene = Scene(name="wedge", gravity=G)
    scene.add_body(
        name="wedge", mass=MASS, inertia=(MASS, MASS, MASS), position=(0.0, 0.0, 0.5 * HEIGHT),
        velocity=(0.0, 0.0, -SPEED),
    )  # fmt: skip
    scene.add_immersed("wedge", parts=[table(factor)], density=RHO)
    result = simulate(scene, t_end=1e-3 * float(times[-1]), dt_out=1e-4, channels=["velocity"], rtol=1e-8)
    return np.interp(1e-3 * times, result.time, -result.select("velocity", body="wedge", axis="z"))


def table(factor: float) -> TablePart:
    """A metre of the wedge up to its chines; what is wet counts to the level surface."""
    depth = np.linspace(0.0, HEIGHT, 81)
    half = depth / np.tan(DEADRISE)
    upright = RHO * factor * half**2
    none = np.zeros_like(depth)
    return TablePart(
        height=HEIGHT, depths=depth, volumes=half * depth, source="wedge by the page of measurements",
        added_masses=np.stack([none, none, upright], axis=1),
    )  # fmt: skip
