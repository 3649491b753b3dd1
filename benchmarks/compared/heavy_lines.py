"""Lines with mass against the closed catenary, MoorPy and MoorDyn; a pendulum with damping."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from heavy_line_scenes import CATENARY_H, CATENARY_V, weights_of_shape
from test_damping import decay, pendulum, swing

from seacrane import simulate

from .files import RESULTS, records
from .row import Row

SUBJECT = "Lines and hanging loads"


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
    scene.add_pendulum_damping(name="swing", first="ground", second="load")
    result = simulate(scene, t_end=30.0, rtol=1e-10)
    yield Row(
        subject=SUBJECT, compared="pendulum with 0.5 % of critical damping: angle over its start, 30 s",
        reference="closed form, small angles",
        difference=float(np.abs(swing(result) / 1e-3 - decay(result.time, 0.005)).max()), unit="",
        limit=1e-5, test="lines/test_damping.py",
    )  # fmt: skip


def peers() -> Iterator[Row]:
    """What `benchmarks/measure/heavy_lines.py` wrote: the finest of its runs."""
    row = records(RESULTS / "heavy-lines-against-moorpy.csv")[-1]
    yield Row(
        subject=SUBJECT, compared=f"line with mass at rest, {row['segments']} segments: level force",
        reference="MoorPy, catenary", difference=float(row["error of H, N"]) / float(row["H of MoorPy, N"]),
        unit="", limit=None, test="lines/test_heavy_lines.py",
    )  # fmt: skip
    row = records(RESULTS / "heavy-lines-against-moordyn.csv")[-1]
    for end in ("fixed end", "moving end"):
        yield Row(
            subject=SUBJECT, compared=f"line with mass, one end heaves: tension at its {end}, of its range",
            reference="MoorDyn, same masses, EA and damping", difference=float(row[end]), unit="", limit=None,
            test="lines/test_heavy_lines.py",
        )  # fmt: skip
