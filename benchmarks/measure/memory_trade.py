"""`memory_trade`: what each kind and order of memory model costs in states and in error."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from seacrane.hydro.data.hydro_data import HydroData
from seacrane.hydro.data.memory_model import RADIATION, MemoryModel
from seacrane.hydro.memory.certificate import passivity_certificate
from seacrane.hydro.memory.fit import BY_MOTION, fit_memory
from seacrane.hydro.memory.fit import KINDS as FITTED
from seacrane.hydro.memory.joint_passivity import scaled_damping
from seacrane.hydro.memory.motion_errors import memory_motion_errors
from seacrane.hydro.memory.retardation import RetardationModel, retardation_functions
from seacrane.inputs.frames import MOTIONS
from seacrane.one_thread import one_thread

FloatArray = NDArray[np.float64]

KINDS = (*FITTED, "convolution")
POINTS_PER_STEP = 2  # of the convolution's quadrature
FREQUENCIES = 4001
TARGETS = (0.9, 0.95, 0.98, 0.99, 0.995)
LIMITS = (0.05, 0.02, 0.01)


@dataclass(frozen=True, kw_only=True)
class MemoryTradeRow:
    """One model: how large it is and how far it is from the data, over the trusted band.

    Attributes
    ----------
    kind : "by-motion", "per-pair", "passive" or "convolution".
    r2 : the R2 asked for, the largest of those that gave this same model; of a memory by motion and of a
        convolution, which are not asked for one, that of its worst pair.
    limit : of a memory by motion, what was asked for, the smallest of those that gave this model; else None.
    reached : whether every pair has the R2, or the motions the limit.
    states : of the radiation blocks. additional_states : of other causes (roll tanks).
    history_samples : points in time at which a convolution keeps the motion, all causes together.
    error_kernel : largest over the pairs of the root mean square of the retardation function's misfit
        ``|K_fit(i w) - K(i w)|`` over that of ``K = B + i w (A - A_inf)``, with the model's A_inf.
    error_added_mass, error_damping : largest over the pairs of the root mean square misfit over the standard
        deviation of the data, ``sqrt(1 - R2)``.
    error_motion : largest difference of any motion by its largest, worst heading; worst_motion names it.
    passive, margin : of `passivity_certificate`; of a convolution, whether the smallest scaled eigenvalue of
        its damping is positive from 1e-3 rad/s to a quarter of its sampling frequency, and that eigenvalue:
        looked at, not proven.
    """

    kind: str
    r2: float
    limit: float | None
    reached: bool
    states: int
    additional_states: int
    history_samples: int
    error_kernel: float
    error_added_mass: float
    error_damping: float
    error_motion: float
    worst_motion: str
    passive: bool
    margin: float


def memory_trade(
    database: HydroData,
    *,
    targets: Sequence[float] = TARGETS,
    kinds: Sequence[str] = KINDS,
    limits: Sequence[float] = LIMITS,
) -> list[MemoryTradeRow]:
    """Fit every kind to every R2 in ``targets``, or limit in ``limits``, and measure the models.

    Equal models appear once.

    Returns
    -------
    list of MemoryTradeRow : by kind, then by number of states.

    Raises
    ------
    ValueError : as `fit_memory`.
    """
    rows: list[MemoryTradeRow] = []
    for kind in kinds:
        if kind == "convolution":
            rows.append(_convolution_row(database))
            continue
        seen: dict[tuple[float, ...], MemoryTradeRow] = {}
        for model in _fits(database, kind, targets, limits):
            row = trade_row(database, model, kind=kind)
            same = (row.states, row.additional_states, round(row.error_kernel, 9), round(row.error_motion, 9))
            seen[same] = row if row.reached else seen.get(same, row)
        rows += sorted(seen.values(), key=lambda row: row.states)
    return rows


def _fits(
    database: HydroData, kind: str, targets: Sequence[float], limits: Sequence[float]
) -> Iterator[MemoryModel]:
    """Models of one kind, the most is asked of the last."""
    if kind == BY_MOTION:
        for limit in sorted(limits, reverse=True):
            yield fit_memory(database=database, kind=kind, limit=limit)
        return
    for r2 in sorted(targets):
        yield fit_memory(database=database, kind=kind, r2=r2)


@one_thread
def trade_row(database: HydroData, model: MemoryModel, *, kind: str) -> MemoryTradeRow:
    """Errors and size of one model."""
    radiation = [row for row in model.rows if row.cause == RADIATION]
    states = sum(len(block.A) for block in model.blocks if block.cause == RADIATION)
    certificate = passivity_certificate(model)
    worst, error = _worst_motion(database, model)
    return MemoryTradeRow(
        kind=kind,
        r2=model.r2,
        limit=None if model.motion is None else model.motion.limit,
        reached=all(row.accepted for row in radiation),
        states=states,
        additional_states=model.states - states,
        history_samples=0,
        error_kernel=_kernel_error(database, model, [(row.output, row.input) for row in radiation]),
        error_added_mass=max(float(np.sqrt(max(1.0 - row.r2_added_mass, 0.0))) for row in radiation),
        error_damping=max(float(np.sqrt(max(1.0 - row.r2_damping, 0.0))) for row in radiation),
        error_motion=error,
        worst_motion=worst,
        passive=certificate.passive,
        margin=certificate.margin,
    )


def _convolution_row(database: HydroData) -> MemoryTradeRow:
    """The same of the database's retardation functions."""
    model = retardation_functions(database=database)
    worst, error = _worst_motion(database, model)
    added_mass, damping = float(model.error_added_mass.max()), float(model.error_damping.max())
    omega = np.geomspace(1e-3, 0.5 * np.pi / model.step, FREQUENCIES)
    margin = float(scaled_damping(model.frequency_response(omega)[1], database.damping).min())
    return MemoryTradeRow(
        kind="convolution",
        r2=1.0 - max(added_mass, damping) ** 2,
        limit=None,
        reached=True,
        states=0,
        additional_states=0,
        history_samples=POINTS_PER_STEP * (len(model.radiation) - 1),
        error_kernel=_kernel_error(database, model, np.argwhere(model.error_damping > 0.0)),
        error_added_mass=added_mass,
        error_damping=damping,
        error_motion=error,
        worst_motion=worst,
        passive=margin >= 0.0,
        margin=margin,
    )


def _worst_motion(database: HydroData, model: MemoryModel | RetardationModel) -> tuple[str, float]:
    """The motion that the memory changes most, and by how much."""
    errors = memory_motion_errors(database, model)
    worst = int(errors.argmax())
    return MOTIONS[worst], float(errors[worst])


def _kernel_error(
    database: HydroData, model: MemoryModel | RetardationModel, pairs: Iterable[tuple[int, int]]
) -> float:
    """Largest relative misfit of K(i w) over the pairs, within the model's band."""
    low, high = model.band
    inside = (database.omega >= low - 1e-9) & (database.omega <= high + 1e-9)
    omega = database.omega[inside][:, None, None]
    a = 0.5 * (database.added_mass + database.added_mass.swapaxes(1, 2))[inside]
    b = 0.5 * (database.damping + database.damping.swapaxes(1, 2))[inside]
    added_mass, damping = model.frequency_response(database.omega[inside])
    data = b + 1j * omega * (a - model.added_mass)
    misfit = damping - b + 1j * omega * (added_mass - a)
    ratios = [np.linalg.norm(misfit[:, j, k]) / np.linalg.norm(data[:, j, k]) for j, k in pairs]
    return float(max(ratios))
