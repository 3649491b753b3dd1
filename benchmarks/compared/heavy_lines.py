"""Lines with mass against the closed catenary, MoorPy and MoorDyn; a pendulum with damping."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from heavy_line_scenes import CATENARY_H, CATENARY_V, heaving, weights_of_shape
from test_damping import decay, pendulum, swing

from seacrane import simulate

from .files import REFERENCES, records
from .row import Row

SUBJECT = "Lines and hanging loads"
MOORPY_H = 663_644.668  # N: moorpy.Catenary.catenary(800, 300, 900, 1e9, 1000, CB=-1e4), MoorPy 1.1


def catenary() -> Iterator[Row]:
    """A chain at rest: the worse of the two forces at its upper end."""
    h, v = weights_of_shape(160)
    yield Row(
        subject=SUBJECT, compared="line with mass at rest, 160 segments: forces at its upper end",
        reference="closed elastic catenary (Irvine)",
        difference=max(abs(h / CATENARY_H - 1.0), abs(v / CATENARY_V - 1.0)), unit="", limit=2e-5,
        test="lines/test_heavy_lines.py",
    )  # fmt: skip


def swinging() -> Iterator[Row]:
    """A point mass with the default of a payload's swing."""
    scene = pendulum(1e-3)
    scene.add_spring(name="swing", first="ground", second="load", damping_ratio=0.005)
    result = simulate(scene, t_end=30.0, rtol=1e-10)
    yield Row(
        subject=SUBJECT, compared="pendulum with 0.5 % of critical damping: angle over its start, 30 s",
        reference="closed form, small angles",
        difference=float(np.abs(swing(result) / 1e-3 - decay(result.time, 0.005)).max()), unit="",
        limit=1e-5, test="lines/test_damping.py",
    )  # fmt: skip


def peers() -> Iterator[Row]:
    """MoorPy's catenary, and MoorDyn's history of the same line (`benchmarks/peers/moordyn_line.py`)."""
    level, _ = weights_of_shape(160)
    yield Row(
        subject=SUBJECT, compared="line with mass at rest, 160 segments: level force",
        reference="MoorPy, catenary", difference=abs(level / MOORPY_H - 1.0), unit="", limit=2e-5,
        test="lines/test_heavy_lines.py",
    )  # fmt: skip
    told = np.array([[float(x) for x in row.values()] for row in records(REFERENCES / "heavy_line.csv")])
    result = simulate(heaving(20, 24.0), t_end=float(told[-1, 0]), dt_out=float(told[1, 0]), rtol=1e-8)
    own = result["line_tension"][:, [0, -1]]
    apart = np.abs(told[:, 1:] - own).max(axis=0) / np.ptp(own, axis=0)
    for end, share in zip(("fixed end", "moving end"), apart, strict=True):
        yield Row(
            subject=SUBJECT, compared=f"line with mass, one end heaves: tension at its {end}, of its range",
            reference="MoorDyn, same masses, EA and damping", difference=float(share), unit="", limit=2e-4,
            test="lines/test_heavy_lines.py",
        )  # fmt: skip
