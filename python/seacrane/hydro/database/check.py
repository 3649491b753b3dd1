"""Self-check of a database: closure of the motion equation, physical matrices, quality of the memory."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from seacrane.arrays import Array
from seacrane.hydro.data.data_warnings import smallest_eigenvalues
from seacrane.hydro.data.hydro_data import HydroData
from seacrane.hydro.data.hydro_group_data import in_trusted_band, mass_of, mass_scales
from seacrane.hydro.data.memory_model import RADIATION, MemoryModel
from seacrane.hydro.data.motion import (
    encounter_frequency,
    inside_table,
    motion_errors,
    motion_response,
    natural_frequency,
)
from seacrane.hydro.data.relations import (
    damping_from_forces,
    infinite_added_mass_from_damping,
    resolved_by_headings,
)
from seacrane.hydro.memory.fit import enough_frequencies, fit_memory
from seacrane.hydro.vessel.parameters import growth_rate, time_domain_vessel
from seacrane.inputs.frames import MOTIONS
from seacrane.one_thread import one_thread

SHORTEST_PERIOD = 5.0  # s, of waves by which motions are judged
SYMMETRY_LIMIT = 0.03
DAMPING_LIMIT = -0.01
FORCE_DAMPING_LIMIT = 0.1
GROWTH_LIMIT = 1e-9
NOISE = 1e-3
KRAMERS_KRONIG_LIMIT = 0.05
PASSIVITY_LIMIT = 0.0


@dataclass(frozen=True, kw_only=True)
class CheckRow:
    """One line of the self-check: ``verdict`` is "pass", "fail", or "info" where there is no limit."""

    check: str
    value: float
    limit: float | None
    verdict: str


def check_database(database: HydroData) -> list[CheckRow]:
    """All checks that the database's content allows; docs/hydrodynamics.md says what each value means.

    A database without a memory model has one fitted here, if its band holds enough frequencies and its speed
    is zero. One without a mass has no row that takes it: no motions, natural periods or memory.
    """
    weighs = database.mass_matrix is not None
    floating = ("heave", "roll", "pitch") if weighs else ()
    natural = {name: natural_frequency(database, MOTIONS.index(name)) for name in floating}
    rows = [
        *(_mass_rows(database) if weighs else ()),
        *_matrix_rows(database),
        *(info(f"natural_period_{name}_s", 2.0 * np.pi / w) for name, w in natural.items() if w is not None),
        *_relation_rows(database),
    ]
    model = database.memory
    if database.speed != 0.0:
        return rows
    if model is None and weighs and enough_frequencies(database):
        model = fit_memory(database=database)
    return rows if model is None else rows + memory_rows(database, model)


def _mass_rows(database: HydroData) -> list[CheckRow]:
    """The mass, and what it makes of the restoring and of the wave forces."""
    return [
        info("mass_t", mass_of(database)[0, 0] / 1e3),
        info("GM_of_C44_and_mass_m", metacentric_height(database)),
        *_closure_rows(database),
    ]


def metacentric_height(database: HydroData) -> float:
    """GM (m) of the database's own C44 and mass; what tanks take from it is apart, in `additional`."""
    return float(database.restoring[3, 3] / (float(mass_of(database)[0, 0]) * database.g))


@one_thread
def memory_rows(database: HydroData, model: MemoryModel) -> list[CheckRow]:
    """Quality of a memory model: fits, stability, passivity, and its effect on the motions."""
    rows = []
    for row in model.rows:
        suffix = f"{row.output + 1}{row.input + 1}" + ("" if row.cause == RADIATION else "_additional")
        rows.append(at_least(f"memory_r2_added_mass_{suffix}", row.r2_added_mass, model.r2))
        rows.append(at_least(f"memory_r2_damping_{suffix}", row.r2_damping, model.r2))
    slowest = min((row.slowest_decay for row in model.rows), default=np.inf)
    rows += fit_rows(model)
    stable = "pass" if slowest > 0.0 else "fail"
    rows.append(CheckRow(check="memory_slowest_decay_per_s", value=slowest, limit=0.0, verdict=stable))
    rows.append(info("memory_fastest_pole_per_s", max((row.fastest_pole for row in model.rows), default=0.0)))
    rows += passivity_rows(model)
    growth = growth_rate(time_domain_vessel(database, memory=model))
    rows.append(at_most("vessel_with_memory_growth_per_s", growth, GROWTH_LIMIT))
    known = database.infinite_frequency_added_mass
    if known is not None:
        span = np.ptp(np.diagonal(database.added_mass, axis1=1, axis2=2), axis=0)
        apart = np.abs(np.diag(model.added_mass - known)) / np.where(span > 0.0, span, np.inf)
        rows.append(info("memory_infinite_added_mass_against_database", float(np.max(apart))))
    added_mass, damping = (
        a + b
        for a, b in zip(
            model.frequency_response(database.omega), model.additional_response(database.omega), strict=True
        )
    )
    static = sum((part.restoring for part in database.additional), np.zeros((len(database.omega), 6, 6)))
    added_mass = added_mass - static / database.omega[:, None, None] ** 2
    fitted = motion_response(database, added_mass=added_mass, damping=damping)
    errors = motion_errors(database, fitted, motion_response(database), inside=in_trusted_band(database))
    return rows + [info(f"memory_motion_{name}", errors[i]) for i, name in enumerate(MOTIONS)]


def fit_rows(model: MemoryModel) -> list[CheckRow]:
    """States, and by how much motions are off."""
    rows = [info("memory_states", float(model.states))]
    if model.motion is not None:
        rows.append(at_most("memory_motion_error", model.motion.error.worst, model.motion.limit))
        rows.append(info("memory_motion_error_of_convolution", model.motion.floor))
    return rows


def passivity_rows(model: MemoryModel) -> list[CheckRow]:
    """Whether the model takes energy, within the band and everywhere."""
    where = {"in_band": model.passivity.in_band, "everywhere": model.passivity.minimum}
    return [at_least(f"memory_passivity_{name}", value, PASSIVITY_LIMIT) for name, value in where.items()]


def _closure_rows(database: HydroData) -> list[CheckRow]:
    """Motions solved from A, B, C, F against those of the source, by the largest of each motion.

    In waves of 5 s and more, within the trusted band; at forward speed frequencies of waves and of encounter
    have to be within it. Shorter waves move no ship, and what symmetry forbids is noise in files: neither is
    judged by its own size.
    """
    if database.motion_rao is None:
        return []
    solved = motion_response(database)
    long = database.omega <= 2.0 * np.pi / SHORTEST_PERIOD
    trusted = in_trusted_band(database)
    inside = np.broadcast_to(trusted & long if np.any(trusted & long) else trusted, solved.shape[:2])
    if database.speed != 0.0:
        encounter = np.abs(encounter_frequency(database))
        inside = inside & inside_table(database.omega, encounter) & in_trusted_band(database, encounter)
    given = np.where(inside[:, :, None], database.motion_rao, 0.0)
    largest = np.abs(given).max(axis=(0, 1))
    lever = np.concatenate([np.ones(3), 0.5 * np.array([database.breadth, database.length, database.length])])
    largest = np.maximum(largest, NOISE * (largest * lever).max() / lever)  # of what moves the hull's ends
    error = np.where(inside[:, :, None], np.abs(solved - given), 0.0).max(axis=(0, 1))
    errors = np.where(largest > 0.0, error / np.where(largest > 0.0, largest, 1.0), 0.0)
    limits = database.motion_rao_limit.tolist()
    return [at_most(f"motion_rao_{name}", errors[i], limits[i]) for i, name in enumerate(MOTIONS)]


def _matrix_rows(database: HydroData) -> list[CheckRow]:
    """Symmetry of A and B, semi-definite B in the trusted band, missing surge terms.

    Without limits at forward speed, which couples heave and pitch, sway and yaw with opposite signs
    (Salvesen, Tuck and Faltinsen 1970).
    """
    rows = []
    moving = database.speed != 0.0
    inside = in_trusted_band(database)
    added_mass, damping = database.added_mass[inside], database.damping[inside]
    for name, matrix in (("added_mass", added_mass), ("damping", damping)):
        asymmetry = float(skewness(matrix).max())
        rows.append(at_most(f"symmetry_{name}", asymmetry, None if moving else SYMMETRY_LIMIT))
    smallest = float(smallest_eigenvalues(damping, mass_scales(database)).min())
    rows.append(at_least("damping_smallest_eigenvalue", smallest, None if moving else DAMPING_LIMIT))
    rows.append(info("surge_terms_missing", float(_surge_is_missing(database))))
    return rows


def skewness(matrices: Array) -> Array:
    """Largest ``X_jk - X_kj`` (m, m) over the frequencies, by the largest diagonals of both motions."""
    scale = np.sqrt(np.abs(np.diagonal(matrices, axis1=1, axis2=2)).max(axis=0))
    product = np.outer(scale, scale)
    skew = np.abs(matrices - matrices.swapaxes(1, 2)).max(axis=0)
    return np.asarray(np.where(product > 0.0, skew / np.where(product > 0.0, product, 1.0), 0.0))


def _surge_is_missing(database: HydroData) -> bool:
    return not (np.any(database.added_mass[:, 0, :]) or np.any(database.damping[:, 0, :]))


def _relation_rows(database: HydroData) -> list[CheckRow]:
    """Damping against the far-field waves, infinite-frequency added mass against the damping."""
    rows = []
    radiated = damping_from_forces(database)
    if radiated is not None:
        inside = in_trusted_band(database) & resolved_by_headings(database)
        limit = None if _surge_is_missing(database) else FORCE_DAMPING_LIMIT  # which strip theory disobeys
        for i, name in enumerate(MOTIONS):
            peak = float(np.abs(database.damping[:, i, i]).max())
            if peak > 0.0 and np.any(inside):
                error = np.abs(radiated - database.damping)[inside, i, i].max() / peak
                rows.append(at_most(f"damping_from_forces_{name}", error, limit))
    if database.infinite_frequency_added_mass is not None:
        difference = infinite_added_mass_from_damping(database) - database.infinite_frequency_added_mass
        for i, name in enumerate(MOTIONS):
            span = float(np.ptp(database.added_mass[:, i, i]))
            if span > 0.0:
                share = float(abs(difference[i, i]) / span)
                rows.append(at_most(f"kramers_kronig_{name}", share, KRAMERS_KRONIG_LIMIT))
    return rows


def at_most(check: str, value: float, limit: float | None) -> CheckRow:
    """A row that fails above its limit; without one it only tells."""
    verdict = "info" if limit is None else "pass" if value <= limit else "fail"
    return CheckRow(check=check, value=float(value), limit=limit, verdict=verdict)


def at_least(check: str, value: float, limit: float | None) -> CheckRow:
    """A row that fails below its limit."""
    verdict = "info" if limit is None else "pass" if value >= limit else "fail"
    return CheckRow(check=check, value=float(value), limit=limit, verdict=verdict)


def info(check: str, value: float) -> CheckRow:
    return at_most(check, value, None)
