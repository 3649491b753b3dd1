"""`fit_memory`: memory of radiation and roll tanks of a database, by motion or per entry.

A model that was made before is found again by a digest of all that its fit looks at: the database's numbers,
the settings of the fit, and the version of the fit. The package holds that of the shipped hull; others are in
the folder ``memory`` of the user's cache (`seacrane.inputs.user_cache`). A file that cannot be read is made
anew.
"""

from __future__ import annotations

import hashlib
import json
from contextlib import suppress
from dataclasses import fields
from importlib.resources import files
from pathlib import Path
from typing import Any, Literal

import numpy as np

from seacrane.arrays import Array
from seacrane.hydro.data.hydro_data import AdditionalMatrices, HydroData
from seacrane.hydro.data.hydro_group_data import Hydrodynamics, in_trusted_band
from seacrane.hydro.data.memory_model import RADIATION, FitRow, MemoryBlock, MemoryModel
from seacrane.hydro.data.motion import require_zero_speed
from seacrane.hydro.data.packed import NOT_PACKED, packed, unpacked
from seacrane.hydro.memory.by_motion import fit_by_motion
from seacrane.hydro.memory.certificate import joint_passivity, realise_pair
from seacrane.hydro.memory.identification import (
    FEWEST_FREQUENCIES,
    IdentificationData,
    RationalFit,
    dissipation_limit,
    fit_lowest_order,
    fit_row,
    judged_band,
    memory_entries,
    symmetric,
    within,
)
from seacrane.hydro.memory.motion_judge import SHIP, length_of, peak_periods
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.user_cache import keep_file, read_kept, user_cache
from seacrane.one_thread import one_thread
from seacrane.warnings import InfiniteFrequencyWarning

ORDERS = range(2, 9)
BY_MOTION = "by-motion"
KINDS = (BY_MOTION, "per-pair")
LIMIT = 0.01  # of the motions
R2 = 0.99
VERSION, OF_GROUPS = 2, 3  # of fits of one hull, of several; raised with every change of a fit
USED = (
    "omega",
    "heading",
    "added_mass",
    "damping",
    "restoring",
    "mass_matrix",
    "force",
    "infinite_frequency_added_mass",
    "linear_damping",
    "port_starboard_symmetric",
)
FOLDER, SUFFIX = "memory", ".memory"
_of_process: dict[str, MemoryModel] = {}


@one_thread
def fit_memory(
    *, database: Hydrodynamics, band: tuple[float, float] | None = None, r2: float | None = None,
    infinite_frequency: Literal["estimated", "known"] = "estimated", kind: str = BY_MOTION,
    limit: float | None = None, progress: bool = False,
) -> MemoryModel:  # fmt: skip
    """Identify the fluid memory of ``database``.

    Parameters
    ----------
    database : added mass and damping, made symmetric here; of a `HydroGroup`, the memory of all its motions
        together, of kind "by-motion".
    band : (low, high) in rad/s over which the fit is judged; default: the database's trusted band, else all
        of it.
    r2 : of kind "per-pair": coefficient of determination that added mass *and* damping of every entry shall
        reach, 0.99 by default; the lowest order that reaches it is taken. An entry that does not reach it at
        any order keeps its best model, and its row says ``accepted=False``.
    infinite_frequency : whether each entry's infinite-frequency added mass is estimated with its model, or
        taken from the database. A panel code's value carries the error of its mesh at wavelengths the mesh
        cannot resolve, and forcing it on the model costs states and puts poles beyond the data.
    kind : "by-motion" (default), one model with common poles per group of coupled motions that cannot deliver
        energy (`passivity_certificate` proves it), as small as `limit` allows; or "per-pair", the paper's,
        one single-input model per entry of the matrices.
    limit : of kind "by-motion", 0.01 by default: by how much the memory may change the standard deviation of
        any motion in seas of Tp 5 to 18 s (hulls below 60 m: in their own, docs/memory.md) from any stored
        heading, against the database's own matrices; a fifth of what it may change the peaks of heave, roll
        and pitch. What was reached is `MemoryModel.motion`.
    progress : show a progress bar of a fit by motion, with the masses and the error of the model at hand.

    Returns
    -------
    MemoryModel : symmetric entries (j, k) and (k, j) share one fit but have a block each.

    Warns
    -----
    InfiniteFrequencyWarning : the added mass at infinite frequency is estimated, and the database has none to
        compare the estimate with.

    Raises
    ------
    ValueError : a band that holds fewer than eight frequencies, an ``r2`` or ``limit`` outside (0, 1) or of
        another kind, another ``kind``, a known infinite-frequency added mass asked for and not there, or a
        database of a forward speed.

    Notes
    -----
    Entries whose damping and whose variation of added mass stay below 1e-4 of the geometric mean of their
    diagonals are dropped, and those that symmetry forbids. Additional matrices (roll tanks) get a static
    stiffness and a model of their own, in which the retardation function need not vanish at zero frequency,
    always of the per-pair kind.
    """
    if isinstance(database, HydroData):
        require_zero_speed(database)
    elif kind != BY_MOTION:
        raise ValueError(
            f"group {database.name!r}: memory of kind {kind!r} is of one hull; use kind='by-motion', which "
            "keeps all motions together passive"
        )
    target = _target(kind, r2=r2, limit=limit)
    judged, _ = judged_band(database, band)
    known = database.infinite_frequency_added_mass if infinite_frequency == "known" else None
    if infinite_frequency == "known" and known is None:
        raise ValueError(
            f"database {database.name!r} has no infinite-frequency added mass; pass "
            "infinite_frequency='estimated'"
        )
    if database.infinite_frequency_added_mass is None:
        warn_caller(
            f"database {database.name!r} has no infinite-frequency added mass: it is estimated from "
            f"frequencies up to {database.omega[-1]:.3g} rad/s, and an error in it is a wrong mass in every "
            "acceleration. Look at the rows memory_motion_* of database.check()",
            InfiniteFrequencyWarning,
        )
    settings: dict[str, Any] = {
        "kind": kind,
        "band": judged,
        "target": target,  # the R2, or the limit
        "known": infinite_frequency == "known",
    }
    name = _digest(database, settings)
    model = _kept(name)
    if model is None:
        if not isinstance(database, HydroData) or kind == BY_MOTION:
            inner = None if known is None else symmetric(known)
            model = fit_by_motion(
                database=database, band=judged, known=inner, limit=target, progress=progress
            )
        else:
            model = _fit_per_pair(database, known, judged, target)
        _of_process[name] = model
        keep_file(user_cache(FOLDER), f"{name}{SUFFIX}", packed(model))
    return model


def _target(kind: str, *, r2: float | None, limit: float | None) -> float:
    """The R2, or the limit of a fit by motion."""
    if kind not in KINDS:
        raise ValueError(f"memory kind {kind!r} is unknown; choose {' or '.join(KINDS)}")
    if kind == BY_MOTION and r2 is not None:
        raise ValueError(
            f"r2 is {r2}, and memory by motion is asked for a limit; give limit, or kind='per-pair'"
        )
    if kind != BY_MOTION and limit is not None:
        raise ValueError(
            f"limit is {limit}, and memory of kind {kind!r} is asked for an R2; give r2, or kind='by-motion'"
        )
    name, value, usual = ("limit", limit, LIMIT) if kind == BY_MOTION else ("r2", r2, R2)
    if value is not None and not 0.0 < value < 1.0:
        raise ValueError(f"{name} is {value}; give a number between 0 and 1")
    return usual if value is None else value


def _fit_per_pair(
    database: HydroData, known: Array | None, band: tuple[float, float], r2: float
) -> MemoryModel:
    """Entries without memory keep their (constant) added mass where that at infinity is not known."""
    blocks: list[MemoryBlock] = []
    rows: list[FitRow] = []
    trusted = within(database.omega, band)
    infinite = symmetric(database.added_mass[-1] if known is None else known)
    stiffness = np.zeros((6, 6))
    parts: tuple[HydroData | AdditionalMatrices, ...] = (database, *database.additional)
    for part in parts:
        cause = part.cause if isinstance(part, AdditionalMatrices) else RADIATION
        radiation, tank = cause == RADIATION, cause != RADIATION
        added_mass, damping = symmetric(part.added_mass), symmetric(part.damping)
        fits: dict[tuple[int, int], RationalFit] = {}
        mirrored = radiation and database.port_starboard_symmetric
        for j, k in memory_entries(added_mass, damping, database.omega, mirrored=mirrored):
            data = IdentificationData(
                omega=database.omega, added_mass=added_mass[:, j, k], damping=damping[:, j, k],
                trusted=trusted,
                added_mass_infinite=0.0 if tank else None if known is None else float(infinite[j, k]),
                zero_at_origin=radiation, static_stiffness=tank,
                dissipation_limit=dissipation_limit(fits, j, k),
            )  # fmt: skip
            fit = fits[j, k] = fit_lowest_order(data, orders=ORDERS, error=lambda fit: -fit.worst, limit=-r2)
            if radiation:
                infinite[j, k] = infinite[k, j] = fit.added_mass_infinite
            else:
                stiffness[j, k] += fit.static_stiffness
                stiffness[k, j] = stiffness[j, k]
            blocks += realise_pair(fit, j, k, cause)
            poles = np.asarray(np.roots(fit.denominator), dtype=complex)
            rows.append(fit_row(cause, (j, k), poles, fit.quality, r2))
    return MemoryModel(
        blocks=tuple(blocks), added_mass=infinite, additional_added_mass=np.zeros((6, 6)),
        additional_stiffness=stiffness, band=band, r2=r2, rows=tuple(rows),
        passivity=joint_passivity(blocks, database.damping, band),
    )  # fmt: skip


def enough_frequencies(database: Hydrodynamics) -> bool:
    """Whether `fit_memory` has data: no forward speed, and eight frequencies in the trusted band."""
    inside = in_trusted_band(database)
    return bool(database.speed == 0.0 and np.count_nonzero(inside) >= FEWEST_FREQUENCIES)


def shipped_folder() -> Path:
    """Models that come with the package; `tools/ship_memory.py` writes them."""
    return Path(str(files("seacrane") / "data" / "memory"))


def _kept(name: str) -> MemoryModel | None:
    """The model of that digest which was made before, or None."""
    for folder in (shipped_folder(), user_cache(FOLDER)):
        if folder is not None and name not in _of_process:
            with suppress(OSError, *NOT_PACKED):
                _of_process[name] = unpacked(read_kept(folder / f"{name}{SUFFIX}"), (MemoryModel,))
    return _of_process.get(name)


def _digest(database: Hydrodynamics, settings: dict[str, Any]) -> str:
    """Of everything that a fit depends on, as hexadecimal text."""
    version = VERSION if isinstance(database, HydroData) else OF_GROUPS
    parts = hashlib.sha256(json.dumps([version, settings]).encode())
    length = length_of(database)
    if length < SHIP:  # whose fit is judged in seas of its own
        parts.update(peak_periods(length).tobytes())
    values = [(name, getattr(database, name)) for name in USED]
    for part in (database.roll_damping, *database.additional):
        if part is not None:
            values += [(entry.name, getattr(part, entry.name)) for entry in fields(part)]
    for name, value in values:
        array = np.asarray("none" if value is None else value)
        parts.update(f"{name} {array.dtype} {array.shape} ".encode())
        parts.update(np.ascontiguousarray(array).tobytes())
    return parts.hexdigest()
