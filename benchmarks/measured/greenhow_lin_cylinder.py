"""A cylinder that falls into still water, half as heavy as it and as heavy (Greenhow and Lin 1983)."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from measured_row import Array, MeasuredRow, Source

from seacrane import Scene, simulate
from seacrane.hydro import CylinderPart

SOURCE = Source(
    title="Cylinder that falls into water",
    repository="dineshadepu/02_particles_dispersion",
    commit="6baaa54f0c8a7df17fdc81176f7ff694ca1fb2fb",
    licence="none told: a few numbers quoted",
    about="tank: water entry of a cylinder, Greenhow and Lin (1983), read from a figure by others",
    quoted=True,
)
DIAMETER, SPEED, RHO, G = 0.11, 2.955, 1000.0, 9.81  # m, m/s as it touches, per metre of its length
HALF, WHOLE = "half as heavy as water", "as heavy as water"
SHARES = {HALF: 0.5, WHOLE: 1.0}
DRAG = {HALF: 1.0, WHOLE: 0.6}  # C_D, below and in its critical range
# Times over sqrt(D/g), and depths of the lowest point over D.
DEPTHS = {
    HALF: np.array([[0.277, 0.495], [0.378, 0.609], [0.797, 1.068], [1.131, 1.220]]),
    WHOLE: np.array([[0.138, 0.401], [0.282, 0.943], [0.843, 1.682], [1.032, 2.010], [1.881, 2.724]]),
}
SLAMS = {"C_S pi, von Karman's": np.pi, "C_S 5.15, as it touches": 5.15}
UNIT = np.sqrt(DIAMETER / G)


def rows(_: Path) -> Iterator[MeasuredRow]:
    for words, measured in DEPTHS.items():
        time, depth = measured.T
        line = np.linspace(0.0, 1.05 * time[-1], 200)
        believed = depth < 0.99 * free_fall(time)
        for by, slam in SLAMS.items():
            ours = dropped(line, SHARES[words], drag=DRAG[words], slam=slam)
            common: dict[str, Any] = {
                "picture": "measured_cylinder_entry", "panel": f"cylinder {words}", "by": by,
                "x": "time sqrt(g/D), -", "y": "depth over D", "of": "value", "points": (time, depth),
                "line": (line, ours), "others": {"free fall": _up_to(line, free_fall(line), depth[-1])},
            }  # fmt: skip
            for kept, told, expected in ((believed, "", 0.05), (~believed, ", points of free fall", None)):
                if kept.any():
                    yield MeasuredRow(
                        **common, compared=f"{words}: depth{told}", at=time[kept], measured=depth[kept],
                        ours=np.interp(time[kept], line, ours), expected=expected,
                    )  # fmt: skip


def dropped(times: Array, share: float, *, drag: float, slam: float) -> Array:
    """Depths of the lowest point over D, at times over sqrt(D/g) after touch.

    ``share``: density over that of water.
    """
    mass = share * RHO * np.pi / 4.0 * DIAMETER**2
    scene = Scene(name="cylinder", gravity=G)
    scene.add_body(
        name="cylinder", mass=mass, inertia=(mass, mass, mass), position=(0.0, 0.0, 0.5 * DIAMETER),
        velocity=(0.0, 0.0, -SPEED),
    )  # fmt: skip
    part = CylinderPart(length=1.0, diameter=DIAMETER, strips=1, drag=drag, slam=slam)
    scene.add_immersed("cylinder", parts=[part], density=RHO)
    result = simulate(scene, t_end=float(times[-1] * UNIT), dt_out=2.5e-4, channels=["position"], rtol=1e-8)
    z = result.select("position", body="cylinder", axis="z")
    return np.interp(times * UNIT, result.time, 0.5 - z / DIAMETER)


def free_fall(times: Array) -> Array:
    """Depths over D without any water: more is impossible."""
    return np.asarray(SPEED / np.sqrt(G * DIAMETER) * times + 0.5 * times**2)


def _up_to(times: Array, depths: Array, deepest: float) -> tuple[Array, Array]:
    kept = depths < deepest
    return times[kept], depths[kept]
