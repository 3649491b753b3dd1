"""What sets roll of a run apart from roll of the frequency domain, cause by cause."""

from __future__ import annotations

import os
import warnings
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from seacrane import cases, load_database, motion_rao, natural_modes
from seacrane.hydro import HydroDatabase, retardation_functions, shipped_database
from seacrane.scene.vessel_memory import core_memory

from .section import Section

BEAM = np.pi / 2.0


def databases() -> Iterator[tuple[str, HydroDatabase]]:
    """The shipped hull, and the two ships of `SEACRANE_SHARED` where that is set."""
    yield "shipped hull", shipped_database()
    folder = os.environ.get("SEACRANE_SHARED")
    if folder:
        yield "tanker (WAMIT)", load_database(Path(folder) / "wamit")
        yield "supply vessel (VERES)", load_database(Path(folder) / "veres" / "supply")


def roll_by_cause() -> Section:
    """Largest difference of roll in beam seas over its peak, with one thing changed at a time."""
    rows: list[list[Any]] = []
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for name, database in databases():
            bare = replace(
                database, linear_damping=np.zeros((6, 6)), roll_damping=None, memory=None, additional=()
            )
            rows.append(_row(name, database))
            rows.append(_row(f"{name}, radiation alone", bare))
    return Section(
        title="Roll by cause",
        text="`motion_rao` of the vessel alone in beam seas against `memory='database'` without springs.",
        head=["ship", "damping", "springs of 200 s", "given A_inf", "kernel of 30 s", "convolution"],
        rows=rows,
    )


def _row(name: str, database: HydroDatabase) -> list[Any]:
    """Damping of the roll mode in % of critical, then the differences in %."""
    free = cases.vessel(database=database, hs=0.0, memory="convolution", mooring_period=None)
    sprung = cases.vessel(database=database, hs=0.0, memory="convolution")
    low, high = database.trusted_band or (float(database.omega[0]), float(database.omega[-1]))
    omega = np.arange(max(low, 0.3), min(high, 1.0), 1e-3)

    def roll(scene: Any, memory: str = "scene") -> Any:
        return motion_rao(
            scene, database=database, omega=omega, direction=BEAM, body="vessel", memory=memory
        )[:, 3]  # fmt: skip

    truth = roll(free, "database")
    size = np.abs(truth)
    modes = natural_modes(free, memory="database", database=database)
    model = retardation_functions(database=database)
    short = retardation_functions(database=database, duration=30.0)
    given = database.infinite_frequency_added_mass
    known = None if given is None else _with(free, model, given - model.added_mass)
    cut = _with(free, short, short.added_mass - model.added_mass)

    def share(other: Any) -> float | None:
        return None if other is None else 100.0 * float(np.abs(other - truth).max() / size.max())

    return [
        name,
        100.0 * float(modes.damping_ratio[modes.find("vessel roll")]),
        share(roll(sprung, "database")),
        None if known is None else share(roll(known)),
        share(roll(cut)),
        share(roll(free)),
    ]


def _with(scene: Any, model: Any, more_mass: Any) -> Any:
    """The vessel with other retardation functions and more constant added mass."""
    out = scene.copy()
    fields = out.vessels["vessel"].__getstate__()
    fields["added_mass"] = np.array(fields["added_mass"]) + 0.5 * (more_mass + more_mass.T)
    out.vessels["vessel"] = type(out.vessels["vessel"])(**{**fields, "memory": core_memory(model)})
    return out
