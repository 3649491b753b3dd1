"""Fitted fluid memories of several databases: states, time, and what they change of the motions."""

from __future__ import annotations

import logging
import os
import time
import warnings
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from seacrane.hydro import (
    Hull,
    HydroDatabase,
    OffsetTable,
    fit_memory,
    hydro_from_hull,
    retardation_functions,
)
from seacrane.hydro.memory.by_motion import fit_by_motion
from seacrane.hydro.memory.motion_judge import motion_judge
from seacrane.inputs.frames import MOTIONS

from . import memory_by_motion
from .section import Section

LIMITS = (0.01, 0.02, 0.05)


def databases() -> Iterator[tuple[str, HydroDatabase]]:
    """Those of ships, and three bodies solved by Capytaine here where it is there."""
    yield from memory_by_motion.databases()
    try:
        import capytaine
    except ImportError:
        return
    logging.getLogger("capytaine").setLevel(logging.ERROR)
    box = capytaine.mesh_parallelepiped(size=(60.0, 20.0, 8.0), resolution=(20, 8, 6))
    ball = capytaine.mesh_sphere(radius=10.0, resolution=(14, 24))
    bodies = (
        (_of_mesh(box, "barge"), 2.0, 2.0),
        (_of_mesh(ball, "hemisphere"), -2.0, 2.4),
        (wigley_hull(), -2.0, 2.2),
    )
    for hull, height, highest in bodies:
        yield (
            f"{hull.name} (Capytaine)",
            hydro_from_hull(
                hull,
                center_of_gravity=(0.0, 0.0, height),
                omega=np.linspace(0.1, highest, 39),
                heading=np.radians(np.arange(0.0, 181.0, 15.0)),
                method="capytaine",
                roll_damping_fraction=0.03,
                trusted_band=(0.2, 0.9 * highest),
            ),
        )


def _of_mesh(mesh: Any, name: str) -> Hull:
    return Hull.from_mesh(vertices=mesh.vertices, faces=mesh.faces, name=name)


def wigley_hull() -> Hull:
    """y = B / 2 (1 - (2 x / L)^2) (1 - (z / T)^2) of 100 x 10 x 6.25 m [Wigley 1934], 34 x 12 panels."""
    x, z = np.linspace(-50.0, 50.0, 33), np.linspace(0.0, -6.25, 13)
    half = 5.0 * (1.0 - (x[:, None] / 50.0) ** 2) * (1.0 - (z / 6.25) ** 2)
    sections = tuple(np.column_stack([row, z]) for row in half)
    table = OffsetTable(x=x, sections=sections, name="Wigley hull")
    return Hull.from_offsets(table).remeshed(stations=34, girth=6)


def memory_fits() -> Section:
    """Per pair at R2 = 0.99, by motion at its limits, and the convolution."""
    os.environ["SEACRANE_CACHE"] = "off"
    rows: list[list[Any]] = []
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for name, database in databases():
            rows += _rows(name, replace(database, memory=None))
    return Section(
        title="Memory by motion",
        text=(
            "What a memory changes of each motion, in %: standard deviation of the difference over that of "
            "the motion, worst of the seas of Tp 5 to 18 s and of the headings; `peak` is the largest of the "
            "complex differences at the peaks of heave, roll and pitch. CPU seconds of one fit."
        ),
        head=["database", "memory", "states", "fit, s", *MOTIONS, "peak"],
        rows=rows,
    )


def _rows(name: str, database: HydroDatabase) -> list[list[Any]]:
    band = database.trusted_band or (float(database.omega[0]), float(database.omega[-1]))
    judge = motion_judge(database, band)
    kinds: list[tuple[str, Any]] = [("per-pair", lambda: fit_memory(database=database, kind="per-pair"))]
    for limit in LIMITS:
        label = f"by-motion, {100.0 * limit:g} %"
        kinds.append(
            (label, lambda limit=limit: fit_by_motion(database=database, band=band, known=None, limit=limit))
        )
    kinds.append(("convolution", lambda: retardation_functions(database=database)))
    rows = []
    for label, fit in kinds:
        start = time.process_time()
        model = fit()
        spent = time.process_time() - start
        error = judge.error_of(model)
        states = getattr(model, "states", 0)
        rows.append(
            [name, label, states, spent, *(100.0 * error.seas).tolist(), 100.0 * float(error.peaks.max())]
        )
    return rows
