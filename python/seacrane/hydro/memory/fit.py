"""`fit_memory`: memory of radiation and roll tanks of a database, by motion, per entry or per group."""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import NDArray

from seacrane.hydro.data.hydro_data import AdditionalMatrices, HydroData
from seacrane.hydro.data.hydro_group_data import Hydrodynamics, in_trusted_band
from seacrane.hydro.data.memory_model import RADIATION, FitRow, MemoryBlock, MemoryModel
from seacrane.hydro.data.motion import require_zero_speed
from seacrane.hydro.memory.by_motion import fit_by_motion
from seacrane.hydro.memory.cache import FitSettings, keep_fit, kept_fit
from seacrane.hydro.memory.entries import FEWEST_FREQUENCIES, dissipation_limit, memory_entries
from seacrane.hydro.memory.identification import IdentificationData, RationalFit, fit_lowest_order
from seacrane.hydro.memory.joint_passivity import joint_passivity
from seacrane.hydro.memory.realisation import realise
from seacrane.inputs.caller import warn_caller
from seacrane.one_thread import one_thread
from seacrane.warnings import InfiniteFrequencyWarning

FloatArray = NDArray[np.float64]

ORDERS = range(2, 9)
BY_MOTION = "by-motion"
KINDS = (BY_MOTION, "per-pair")
LIMIT = 0.01  # of the motions
R2 = 0.99


@one_thread
def fit_memory(
    *,
    database: Hydrodynamics,
    band: tuple[float, float] | None = None,
    r2: float | None = None,
    infinite_frequency: Literal["estimated", "known"] = "estimated",
    kind: str = BY_MOTION,
    limit: float | None = None,
) -> MemoryModel:
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
    low, high = band or database.trusted_band or (float(database.omega[0]), float(database.omega[-1]))
    trusted = (database.omega >= low - 1e-9) & (database.omega <= high + 1e-9)
    if trusted.sum() < FEWEST_FREQUENCIES:
        raise ValueError(
            f"database {database.name!r}: the band {low:.4g} to {high:.4g} rad/s holds {trusted.sum()} "
            "frequencies; widen it to eight or more"
        )
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
    settings = FitSettings(
        kind=kind,
        band=(float(low), float(high)),
        target=target,
        known=infinite_frequency == "known",
    )
    model = kept_fit(database, settings)
    if model is None:
        symmetric = None if known is None else 0.5 * (known + known.T)
        if not isinstance(database, HydroData) or kind == BY_MOTION:
            model = fit_by_motion(database=database, band=settings.band, known=symmetric, limit=target)
        else:
            model = _fit_to_data(database, known, settings.band, trusted, target)
        keep_fit(database, settings, model)
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
    usual = LIMIT if kind == BY_MOTION else R2
    for name, value in (("r2", r2), ("limit", limit)):
        if value is not None and not 0.0 < value < 1.0:
            raise ValueError(f"{name} is {value}; give a number between 0 and 1")
    return next((value for value in (r2, limit) if value is not None), usual)


def _fit_to_data(
    database: HydroData,
    known: FloatArray | None,
    band: tuple[float, float],
    trusted: NDArray[np.bool_],
    r2: float,
) -> MemoryModel:
    """Model of kind "per-pair"."""
    blocks, rows, added_mass = _fit_radiation(database, known, trusted, r2)
    extra_mass, stiffness = np.zeros((6, 6)), np.zeros((6, 6))
    for part in database.additional:
        more = _fit_additional(database, part, trusted, r2)
        blocks += more[0]
        rows += more[1]
        extra_mass += more[2]
        stiffness += more[3]
    return MemoryModel(
        blocks=tuple(blocks),
        added_mass=added_mass,
        additional_added_mass=extra_mass,
        additional_stiffness=stiffness,
        band=band,
        r2=r2,
        rows=tuple(rows),
        passivity=joint_passivity(blocks, database.damping, band),
    )


def enough_frequencies(database: Hydrodynamics) -> bool:
    """Whether `fit_memory` has data: no forward speed, and eight frequencies in the trusted band."""
    inside = in_trusted_band(database)
    return bool(database.speed == 0.0 and np.count_nonzero(inside) >= FEWEST_FREQUENCIES)


def _fit_radiation(
    database: HydroData, known: FloatArray | None, trusted: NDArray[np.bool_], r2: float
) -> tuple[list[MemoryBlock], list[FitRow], FloatArray]:
    """Blocks, rows and infinite-frequency added mass (6, 6) of the radiation matrices."""
    blocks: list[MemoryBlock] = []
    rows: list[FitRow] = []
    fits: dict[tuple[int, int], RationalFit] = {}
    infinite = np.zeros((6, 6)) if known is None else 0.5 * (known + known.T)
    symmetric_a = 0.5 * (database.added_mass + database.added_mass.swapaxes(1, 2))
    symmetric_b = 0.5 * (database.damping + database.damping.swapaxes(1, 2))
    symmetric = database.port_starboard_symmetric
    for j, k in memory_entries(symmetric_a, symmetric_b, database.omega, symmetric=symmetric):
        data = IdentificationData(
            omega=database.omega,
            added_mass=symmetric_a[:, j, k],
            damping=symmetric_b[:, j, k],
            trusted=trusted,
            added_mass_infinite=None if known is None else float(infinite[j, k]),
            dissipation_limit=dissipation_limit(fits, j, k),
        )
        fit = fits[j, k] = fit_lowest_order(data, r2=r2, orders=ORDERS)
        infinite[j, k] = infinite[k, j] = fit.added_mass_infinite
        _append(blocks, rows, fit, j, k, cause=RADIATION, r2=r2)
    if known is None:
        infinite = _keep_constant_entries(infinite, symmetric_a, blocks)
    return blocks, rows, infinite


def _fit_additional(
    database: HydroData, part: AdditionalMatrices, trusted: NDArray[np.bool_], r2: float
) -> tuple[list[MemoryBlock], list[FitRow], FloatArray, FloatArray]:
    """Blocks, rows, instantaneous added mass and static stiffness (6, 6) of one additional cause."""
    blocks: list[MemoryBlock] = []
    rows: list[FitRow] = []
    fits: dict[tuple[int, int], RationalFit] = {}
    mass, stiffness = np.zeros((6, 6)), np.zeros((6, 6))
    symmetric_a = 0.5 * (part.added_mass + part.added_mass.swapaxes(1, 2))
    symmetric_b = 0.5 * (part.damping + part.damping.swapaxes(1, 2))
    for j, k in memory_entries(symmetric_a, symmetric_b, database.omega):
        data = IdentificationData(
            omega=database.omega,
            added_mass=symmetric_a[:, j, k],
            damping=symmetric_b[:, j, k],
            trusted=trusted,
            added_mass_infinite=0.0,
            zero_at_origin=False,
            static_stiffness=True,
            dissipation_limit=dissipation_limit(fits, j, k),
        )
        fit = fits[j, k] = fit_lowest_order(data, r2=r2, orders=ORDERS)
        stiffness[j, k] = stiffness[k, j] = fit.static_stiffness
        _append(blocks, rows, fit, j, k, cause=part.cause, r2=r2)
    return blocks, rows, mass, stiffness


def _keep_constant_entries(
    infinite: FloatArray, added_mass: FloatArray, blocks: list[MemoryBlock]
) -> FloatArray:
    """Entries without memory keep their (constant) added mass."""
    fitted = {(int(j), int(k)) for block in blocks for j in block.outputs for k in block.inputs}
    kept = infinite.copy()
    for j in range(6):
        for k in range(6):
            if (j, k) not in fitted:
                kept[j, k] = added_mass[-1, j, k]
    return kept


def _append(
    blocks: list[MemoryBlock], rows: list[FitRow], fit: RationalFit, j: int, k: int, *, cause: str, r2: float
) -> None:
    """Add the blocks (j, k) and (k, j) of one fit, and its row."""
    for output, input_ in dict.fromkeys([(j, k), (k, j)]):
        blocks.append(realise(fit.numerator, fit.denominator, output=output, input=input_, cause=cause))
    poles = np.roots(fit.denominator)
    rows.append(
        FitRow(
            cause=cause,
            output=j,
            input=k,
            order=fit.order,
            r2_added_mass=fit.r2_added_mass,
            r2_damping=fit.r2_damping,
            r2_added_mass_all=fit.r2_added_mass_all,
            r2_damping_all=fit.r2_damping_all,
            slowest_decay=float(-poles.real.max()),
            fastest_pole=float(np.abs(poles).max()),
            accepted=fit.worst >= r2,
        )
    )
