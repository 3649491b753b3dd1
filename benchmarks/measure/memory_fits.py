"""Fitted fluid memories of several databases: states, time, and what they change of the motions."""

from __future__ import annotations

import os
import time
import warnings
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

from seacrane import load_database
from seacrane.hydro import HydroDatabase, fit_memory, retardation_functions, shipped_database
from seacrane.hydro.memory.by_motion import fit_by_motion
from seacrane.hydro.memory.motion_judge import motion_judge
from seacrane.inputs.frames import MOTIONS

from .section import Section
from .sources import HULL

LIMITS = (0.01, 0.02, 0.05)


def databases() -> Iterator[tuple[str, HydroDatabase]]:
    """The shipped hull, and ships of SEACRANE_SHARED where it is set."""
    yield "shipped hull", shipped_database()
    folder = os.environ.get("SEACRANE_SHARED")
    if folder:
        yield "tanker (WAMIT)", load_database(Path(folder) / "wamit")
        yield "supply vessel (VERES)", load_database(Path(folder) / "veres" / "supply")


def memory_fits() -> Iterator[list[Any]]:
    """Per pair at R2 = 0.99, by motion at its limits, and the convolution."""
    before, os.environ["SEACRANE_CACHE"] = os.environ.get("SEACRANE_CACHE"), "off"
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            for name, database in databases():
                yield from _rows(name, replace(database, memory=None))
    finally:
        os.environ.pop("SEACRANE_CACHE")
        if before is not None:
            os.environ["SEACRANE_CACHE"] = before


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


SECTION = Section(
    title="Memory by motion",
    text=(
        "What a memory changes of each motion, in %: standard deviation of the difference over that of the "
        "motion, worst of the seas of Tp 5 to 18 s and of the headings; `peak` is the largest of the "
        "complex differences at the peaks of heave, roll and pitch. CPU seconds of one fit. Ships need "
        "SEACRANE_SHARED."
    ),
    head=["database", "memory", "states", "fit, s", *MOTIONS, "peak"],
    rows=memory_fits,
    sources=HULL,
    needs=lambda: "" if os.environ.get("SEACRANE_SHARED") else "SEACRANE_SHARED, the folder of the ships",
)
