"""Fitted fluid memories of several databases: states, time, and what they change of the motions."""

from __future__ import annotations

import os
import time
import warnings
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from seacrane import load_database
from seacrane.hydro import (
    GroupBody,
    HydroDatabase,
    HydroGroup,
    fit_memory,
    retardation_functions,
    shipped_database,
)
from seacrane.hydro.memory.by_motion import fit_by_motion
from seacrane.hydro.memory.motion_judge import motion_judge
from seacrane.hydro.memory.oscillators import Oscillators
from seacrane.inputs.frames import MOTIONS

from .section import Section
from .sources import HULL

LIMITS = (0.01, 0.02, 0.05)
HULLS, OF_GROUPS = (2, 5), 0.02
MASSES, SHARE, APART = 6, 0.4, 60.0  # of a hull's waves; what a neighbour feels of them; m


def databases() -> Iterator[tuple[str, HydroDatabase]]:
    """The shipped hull, and ships of SEACRANE_SHARED where it is set."""
    yield "shipped hull", shipped_database()
    folder = os.environ.get("SEACRANE_SHARED")
    if folder:
        yield "tanker (WAMIT)", load_database(Path(folder) / "wamit")
        yield "supply vessel (VERES)", load_database(Path(folder) / "veres" / "supply")


def group(hulls: int) -> HydroGroup:
    """Shipped hulls side by side in waves of oscillators, which neighbours feel the less the farther off."""
    one = shipped_database()
    random, place = np.random.default_rng(1), np.arange(hulls)
    share = np.repeat(SHARE ** np.abs(np.subtract.outer(place, place)), MASSES, axis=0)
    coupling = 0.3 * random.normal(size=(hulls * MASSES, hulls, 6)) * share[:, :, None]
    w = np.tile(np.linspace(0.4, 1.2, MASSES), hulls) * random.uniform(0.9, 1.1, hulls * MASSES)
    water = Oscillators(w=w, dampers=np.diag(0.6 * w), coupling=coupling.reshape(len(w), -1))
    size = np.tile(np.sqrt(np.diagonal(one.damping, axis1=1, axis2=2).max(axis=0)), hulls)
    kernel = water.transfer(one.omega) * np.outer(size, size)
    infinite = np.kron(np.eye(hulls), one.added_mass[-1])
    names = ("mass_matrix", "restoring", "linear_damping", "length", "breadth", "draught")
    of_one: dict[str, Any] = {name: getattr(one, name) for name in names}
    bodies = [GroupBody(name=f"hull{i}", position=np.array([0.0, i * APART, 0.0]), **of_one) for i in place]
    return HydroGroup(
        name=f"{hulls} hulls", bodies=tuple(bodies), omega=one.omega, heading=one.heading,
        force=np.tile(one.force, hulls), added_mass=infinite + kernel.imag / one.omega[:, None, None],
        damping=kernel.real, infinite_frequency_added_mass=infinite, source="known oscillators",
        trusted_band=one.trusted_band,
    )  # fmt: skip


def memory_fits() -> Iterator[list[Any]]:
    """Per pair at R2 = 0.99, by motion at its limits, and the convolution."""
    before, os.environ["SEACRANE_CACHE"] = os.environ.get("SEACRANE_CACHE"), "off"
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            for name, database in databases():
                yield from _rows(name, replace(database, memory=None))
            for hulls in HULLS:
                yield _of_group(group(hulls))
    finally:
        os.environ.pop("SEACRANE_CACHE")
        if before is not None:
            os.environ["SEACRANE_CACHE"] = before


def _of_group(database: HydroGroup) -> list[Any]:
    start = time.process_time()
    model = fit_memory(database=database, limit=OF_GROUPS)
    spent = time.process_time() - start
    assert model.motion is not None
    seas, peaks = (
        100.0 * part.reshape(-1, 6).max(axis=0)
        for part in (model.motion.error.seas, model.motion.error.peaks)
    )
    label = f"by-motion, {100.0 * OF_GROUPS:g} %"
    return [database.name, label, model.states, spent, *seas.tolist(), float(peaks.max())]


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
        "complex differences at the peaks of heave, roll and pitch. CPU seconds of one fit. Of groups, the "
        "worst hull; their water is of known oscillators. Ships need SEACRANE_SHARED."
    ),
    head=["database", "memory", "states", "fit, s", *MOTIONS, "peak"],
    rows=memory_fits,
    sources=HULL,
    needs=lambda: "" if os.environ.get("SEACRANE_SHARED") else "SEACRANE_SHARED, the folder of the ships",
)
