"""What a database can be read with, and yet tell wrong: each a warning that names the consequence."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from seacrane.arrays import Array
from seacrane.hydro.data.heading_circle import LARGEST_HEADING_GAP, both_sides
from seacrane.hydro.data.hydro_data import HydroData
from seacrane.hydro.data.hydro_group_data import in_trusted_band, mass_scales
from seacrane.hydro.data.motion import natural_frequency
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.frames import MOTIONS
from seacrane.sea.dispersion import wavenumber
from seacrane.warnings import (
    AsymmetryWarning,
    BelowBandWarning,
    DampingWarning,
    HeadingGapWarning,
    WaterMismatchWarning,
)

DAMPING_LIMIT = -0.01  # of the largest diagonals, as in the self-check
SYMMETRY_LIMIT, ONE_SIDED = 0.1, 0.45  # of the diagonals, and of the larger entry; coarse meshes leave less
SKEW_LIMIT = 0.35  # of the diagonals, whatever the entry
ROUND_OFF = 1e-4  # of the largest damping over mass: less is none
SAME_WATER = 0.005
BOX_LIMIT = 1.05  # lengths of files are between perpendiculars, or rounded
EMPTY = 0.05  # of the box: no hull is as slender
MOST_BELOW = 0.1  # of the energy of the waves
FLOATING = (2, 3, 4)  # heave, roll, pitch


def warn_of_data(database: HydroData) -> None:
    """All warnings that a database gives without being used; `load_database` asks for them."""
    warn_of_matrices(database)
    _warn_of_headings(database)
    _warn_of_box(database)


def warn_of_matrices(database: HydroData) -> None:
    """Symmetry of added mass and damping within the trusted band, and damping that adds energy."""
    inside = np.flatnonzero(in_trusted_band(database))
    tables = {"linear_damping": database.linear_damping[None]}
    if database.speed == 0.0 and inside.size:
        _warn_of_asymmetry(database, inside)
        tables = {"radiation damping": database.damping[inside]} | tables
    for what, table in tables.items():
        lowest = smallest_eigenvalues(table, mass_scales(database))
        if lowest.min() < DAMPING_LIMIT:
            at = ""
            if what != "linear_damping":
                at = f" at {database.omega[inside[int(lowest.argmin())]]:.4g} rad/s"
            warn_caller(
                f"database {database.name!r}: {what}{at} has a negative eigenvalue, "
                f"{100.0 * lowest.min():.3g} % of its largest diagonals: a motion in that combination gains "
                "energy from still water. Correct the matrices, or narrow trusted_band to frequencies that "
                "are sound",
                DampingWarning,
            )
    tabulated = database.roll_damping
    worst = float(database.quadratic_damping.min())
    if tabulated is not None:
        worst = min(worst, float(tabulated.linear.min()), float(tabulated.quadratic.min()))
    if worst < 0.0:
        warn_caller(
            f"database {database.name!r}: a coefficient of quadratic or roll damping is {worst:.4g}, below "
            "zero: the motion gains energy from still water, more the faster it is. Correct its sign",
            DampingWarning,
        )


def warn_of_water(
    database: HydroData,
    *,
    gravity: float,
    depth: float | None = None,
    omega: Array | None = None,
    what: str = "the scene",
) -> None:
    """Compare the database's water with another one's, to half a percent.

    Parameters
    ----------
    gravity : m/s2 of ``what``.
    depth : m (inf: deep) of ``what``; None where it has no waves.
    omega : (n,) rad/s of its waves, whose lengths are compared.
    what : named in the warning.
    """
    ratio = gravity / database.g
    if abs(ratio - 1.0) > SAME_WATER:
        warn_caller(
            f"database {database.name!r}: g is {database.g:g} m/s2, that of {what} {gravity:g}; the "
            f"restoring holds weights {abs(ratio - 1.0):.1%} off those of the bodies: heel and trim are off "
            "alike, and wave lengths too. Give both the same gravity",
            WaterMismatchWarning,
        )
    elif depth is not None and omega is not None and len(omega):
        waves = wavenumber(omega, g=gravity, depth=depth) / wavenumber(
            omega, g=database.g, depth=database.depth
        )
        worst = int(np.abs(waves - 1.0).argmax())
        if abs(waves[worst] - 1.0) > SAME_WATER:
            warn_caller(
                f"database {database.name!r}: computed for a depth of {database.depth:g} m, {what} has "
                f"{depth:g} m: at {omega[worst]:.3g} rad/s wavenumbers differ by "
                f"{abs(waves[worst] - 1.0):.1%}, and so do phases along the ship. Use a database of that "
                "depth",
                WaterMismatchWarning,
            )


def smallest_eigenvalues(damping: Array, mass: Array) -> Array:
    """The smallest eigenvalues of the symmetric part (n,), by the largest diagonals over all frequencies."""
    scale = _scales(damping, mass)
    if not np.any(scale):
        off = np.abs(damping).max(axis=(1, 2))
        return np.asarray(np.where(off > 0.0, -1.0, 0.0))  # coupling alone is indefinite
    scaled = damping / np.outer(scale, scale)
    return np.asarray(np.linalg.eigvalsh(0.5 * (scaled + scaled.swapaxes(1, 2)))[:, 0])


def _scales(matrices: Array, mass: Array) -> Array:
    """Roots (6,) of the largest diagonals of matrices (n, 6, 6) over the frequencies.

    One that is round-off beside the largest, both over the ``mass`` (6,) of each motion, counts as the bound
    of that round-off.
    """
    diagonal = np.abs(np.diagonal(matrices, axis1=1, axis2=2)).max(axis=0)
    return np.asarray(np.sqrt(np.maximum(diagonal, ROUND_OFF * mass * (diagonal / mass).max())))


def _warn_of_asymmetry(database: HydroData, inside: NDArray[np.intp]) -> None:
    """At rest both matrices are symmetric: else a half is missing, or an entry misplaced."""
    for name in ("added_mass", "damping"):
        matrices = getattr(database, name)[inside]
        scale = np.maximum(_scales(matrices, mass_scales(database)), 1e-150)  # no damping at all
        apart = np.abs(matrices - matrices.swapaxes(1, 2)).max(axis=0)
        larger = np.maximum(np.abs(matrices).max(axis=0), np.abs(matrices).max(axis=0).T)
        share = apart / np.outer(scale, scale)
        skew = np.where((apart > ONE_SIDED * larger) | (share > SKEW_LIMIT), share, 0.0)
        row, column = np.unravel_index(int(skew.argmax()), skew.shape)
        if skew[row, column] > SYMMETRY_LIMIT:
            warn_caller(
                f"database {database.name!r}: {name} is not symmetric: its entries {row + 1}{column + 1} and "
                f"{column + 1}{row + 1} differ by {skew[row, column]:.1%} of the diagonals, which those of "
                "no hull at rest do; motions that they couple are off by as much. Give both halves of the "
                "matrices, or the mean of both",
                AsymmetryWarning,
            )


def _warn_of_headings(database: HydroData) -> None:
    circle = both_sides(database.heading)[0] if database.port_starboard_symmetric else database.heading
    steps = np.diff(np.append(circle, circle[0] + 2.0 * np.pi))
    gap = float(steps.max())
    if gap <= LARGEST_HEADING_GAP + 1e-9:
        return
    start = float(np.degrees(circle[int(steps.argmax())]))
    one_side = "" if database.port_starboard_symmetric else " The vessel is not symmetric, so no side mirrors"
    warn_caller(
        f"database {database.name!r}: headings leave a gap of {np.degrees(gap):.4g} deg from {start:.4g} "
        f"deg; a sea from within it is refused, as are short-crested seas that reach it.{one_side}",
        HeadingGapWarning,
    )


def _warn_of_box(database: HydroData) -> None:
    """A hull fills the box around it, in part: else mass, density, g or lengths are in other units."""
    area = database.length * database.breadth
    filled = {
        "mass": mass_scales(database)[0] / (database.rho * area * database.draught),
        "C33": database.restoring[2, 2] / (database.rho * database.g * area),
    }
    for name, share in filled.items():
        if share > BOX_LIMIT or (name == "mass" and share < EMPTY):
            warn_caller(
                f"database {database.name!r}: its {name} needs {share:.4g} times the box of length, breadth "
                f"and draught at rho = {database.rho:g} kg/m3, g = {database.g:g} m/s2: weight and buoyancy "
                "do not fit each other. Check units, density and main dimensions",
                WaterMismatchWarning,
            )
            return


def warn_of_waves_below_band(database: HydroData, share: float, what: str) -> None:
    """Warn where more than a tenth of the energy of the waves is below the trusted band.

    Parameters
    ----------
    database : with `trusted_band`, or without, where nothing is known.
    share : of the energy of the waves below the band.
    what : whose waves these are, for the message.
    """
    if database.trusted_band is None or share <= MOST_BELOW:
        return
    warn_caller(
        f"{what}: {share:.0%} of their energy is below {database.trusted_band[0]:.3g} rad/s, where the "
        f"trusted band of database {database.name!r} begins; {_consequence(database)}",
        BelowBandWarning,
    )


def warn_of_resonance_below_band(database: HydroData) -> None:
    """Warn where heave, roll or pitch resonates below the trusted band."""
    if database.trusted_band is None or database.speed != 0.0:
        return
    low = database.trusted_band[0]
    found = {MOTIONS[i]: natural_frequency(database, i) for i in FLOATING}
    below = [f"{name} at {at:.3g} rad/s" for name, at in found.items() if at is not None and at < low]
    if below:
        warn_caller(
            f"database {database.name!r}: {', '.join(below)} resonates below {low:.3g} rad/s, where its "
            f"trusted band begins; {_consequence(database)}",
            BelowBandWarning,
        )


def _consequence(database: HydroData) -> str:
    if "strip theory" in database.source:
        return (
            "radiation damping of strip theory is too large there, several times in roll and more in pitch "
            "and yaw. Use hydro_from_hull(..., method='capytaine')"
        )
    return "its numbers are doubtful there. Use a database that covers these frequencies"
