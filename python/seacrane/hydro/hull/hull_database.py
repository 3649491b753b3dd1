"""`hydro_from_hull`: a hydrodynamic database from the shape of a hull."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seacrane import _core
from seacrane.arrays import Array
from seacrane.hydro.data.hydro_group_data import USUAL_RADII
from seacrane.hydro.data.rigid_mass import rigid_mass_matrix
from seacrane.hydro.database.database import HydroDatabase
from seacrane.hydro.database.transform import point_of
from seacrane.hydro.hull.hull import Hull
from seacrane.hydro.hull.lines import ParametricHull
from seacrane.hydro.hull.solution import HullSolution, capytaine_solution, symmetric_solution
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.checked import positive_of
from seacrane.warnings import FloatingPositionWarning, MeshConvergenceWarning, SubmergedPartWarning

LARGEST_CHANGE = 0.05  # of the largest of an entry
FEWEST = 8  # panels along the length and around, of the coarse mesh
HANGING = 1e-6  # of the volume
PANELS = 40  # on each half section
PANELS_PER_WAVE = 8.0
METHODS = ("strip", "capytaine")
WAVES = (50.0, 0.05)  # lengths of the ship: the longest and the shortest in deep water
DISPLACEMENT_LIMIT = 0.01  # of the displaced mass
TRIM_LIMIT = 0.001  # rad


def hydro_from_hull(
    hull: Hull | ParametricHull, *, center_of_gravity: ArrayLike, mass: float | None = None,
    radii_of_gyration: ArrayLike | None = None, omega: ArrayLike | None = None,
    heading: ArrayLike | None = None, speed: float = 0.0, method: Literal["strip", "capytaine"] = "strip",
    roll_damping_fraction: float = 0.0, trusted_band: tuple[float, float] | None = None, stations: int = 41,
    check: bool = False, rho: float = 1025.0, g: float = 9.81, name: str | None = None,
) -> HydroDatabase:  # fmt: skip
    """Hydrodynamic database of a hull at its drawn waterline in deep water, about the hull's origin.

    Parameters
    ----------
    hull : `Hull`, or `ParametricHull` with the default panels of `Hull.from_parametric`.
    center_of_gravity : (3,) m from the hull's origin, on the centre plane.
    mass : kg; None: the displaced mass.
    radii_of_gyration : (3,) m about the centre of gravity, roll, pitch, yaw; None: 0.36 breadth, 0.25 length,
        0.25 length.
    omega : (n,) rad/s, increasing; None: 61 frequencies from waves 50 times as long as the ship to waves of a
        twentieth of its length.
    heading : (m,) rad, direction of travel; None: every 5 degrees from 0 to 180.
    speed : m/s; only 0, as the motions, memory and seas of this package are for zero speed.
    method : "strip": strip theory, in seconds, no radiation in surge, needs nothing else. "capytaine": 3D
        panels, minutes, needs the extra ``hydro``.
    roll_damping_fraction : linear roll damping beside radiation, as a fraction of critical at the natural
        frequency.
    trusted_band : (low, high) rad/s; None: what the method says, see docs/hull-hydrodynamics.md.
    stations : sections of the strip theory, evenly spaced, ends included.
    check : whether to solve a mesh of half the panels too, and to tell in `source` what changes; half as long
        again.
    rho, g : kg/m3, m/s2.
    name : of the database; None: the hull's.

    Returns
    -------
    HydroDatabase : without a memory model; `fit_memory` makes one.

    Raises
    ------
    ValueError : a value out of range, a hull that would capsize, or as the method.
    ImportError : method "capytaine" without Capytaine.

    Warns
    -----
    FloatingPositionWarning : mass and displacement differ by more than 1 %, or the hull would trim by more
        than 0.001 rad.
    seacrane.warnings.SubmergedPartWarning : strip theory leaves out a part of the hull.
    seacrane.warnings.MeshConvergenceWarning : checked, and added mass or damping changes by more than 5 %.
    """
    shape = Hull.from_parametric(hull) if isinstance(hull, ParametricHull) else hull
    what = f"hull {shape.name!r}"
    if method not in METHODS:
        raise ValueError(f"{what}: method {method!r} is unknown; choose {' or '.join(METHODS)}")
    if speed != 0.0:
        raise ValueError(
            f"{what}: speed is {speed} m/s; motions, memory and seas of this package are for zero speed: "
            "pass speed=0.0 (_core.strip_theory has the coefficients at forward speed)"
        )
    if not 0.0 <= roll_damping_fraction < 1.0:
        raise ValueError(
            f"{what}: roll_damping_fraction is {roll_damping_fraction}; give 0 to below 1, such as 0.05"
        )
    for name_of, value in (("rho", rho), ("g", g), ("mass", 1.0 if mass is None else mass)):
        positive_of(f"{what}: {name_of}", value)
    centre = point_of(f"{what}: center_of_gravity", center_of_gravity)
    if abs(centre[1]) > 1e-9 * shape.breadth:
        raise ValueError(
            f"{what}: the centre of gravity is at y = {centre[1]:.4g} m; give it on the centre plane, and "
            "model what lies to one side as bodies"
        )
    if omega is None:
        low, high = np.sqrt(2.0 * np.pi * g / (shape.length * np.array(WAVES)))
        omega = np.linspace(low, high, 61)
    heading = np.radians(np.arange(0.0, 180.1, 5.0)) if heading is None else heading
    frequencies = _increasing(f"{what}: omega", omega, 0.0, np.inf, "above 0 rad/s")
    headings = _increasing(f"{what}: heading", heading, -1e-12, 2.0 * np.pi, "from 0 to below 2 pi rad")
    displaced = rho * shape.hydrostatics.volume
    weight = displaced if mass is None else float(mass)
    radii = USUAL_RADII * [shape.breadth, shape.length, shape.length]
    if radii_of_gyration is not None:
        radii = point_of(f"{what}: radii_of_gyration", radii_of_gyration)
        if np.any(radii <= 0.0):
            raise ValueError(f"{what}: radii_of_gyration are {radii} m; give three positive numbers")
    _require_afloat(shape, _restoring(shape, weight, centre, rho, g), displaced, weight, centre, g)

    def solve(mesh: Hull) -> HullSolution:
        given: dict[str, Any] = {"omega": frequencies, "heading": headings, "rho": rho, "g": g}
        if method == "capytaine":
            return symmetric_solution(capytaine_solution(mesh, **given))
        return symmetric_solution(strip_solution(mesh, stations=stations, **given))

    solution = solve(shape)
    if check:
        low, high = solution.trusted_band if trusted_band is None else trusted_band
        inside = (frequencies >= low) & (frequencies <= high)
        told = convergence_told(shape, solution, solve, inside if inside.any() else ~inside)
        solution = replace(solution, method=solution.method + told)
    return database_of_solution(
        shape, solution, center_of_gravity=centre, mass=weight, radii_of_gyration=radii,
        roll_damping_fraction=roll_damping_fraction, trusted_band=trusted_band, name=name or shape.name,
    )  # fmt: skip


def database_of_solution(
    hull: Hull, solution: HullSolution, *, center_of_gravity: Array, mass: float,
    radii_of_gyration: Array, roll_damping_fraction: float, trusted_band: tuple[float, float] | None,
    name: str,
) -> HydroDatabase:  # fmt: skip
    """The database of a solution that is symmetric already; see `hydro_from_hull`."""
    inertia, statics = mass * np.diag(radii_of_gyration**2), hull.hydrostatics
    height = float(center_of_gravity[2])
    source = (
        f"hydro_from_hull: {solution.method}; {hull.source}; volume of the panel mesh {statics.volume:.6f} "
        f"m3, mass {mass:.6g} kg, centre of gravity x {center_of_gravity[0]:.6f} m, z {height:.6f} m for "
        f"GM_T {statics.metacentric_height(height):.4f} m"
    )
    if roll_damping_fraction != 0.0:
        source += f"; linear roll damping of {roll_damping_fraction} of critical added in linear_damping"
    bare = HydroDatabase(
        name=name, omega=solution.omega, heading=solution.heading, added_mass=solution.added_mass,
        damping=solution.damping, zero_frequency_added_mass=solution.added_mass_zero,
        infinite_frequency_added_mass=solution.added_mass_infinite,
        restoring=_restoring(hull, mass, center_of_gravity, solution.rho, solution.g),
        mass_matrix=rigid_mass_matrix(mass, center_of_gravity, inertia), force=solution.force,
        length=hull.length, breadth=hull.breadth, draught=hull.draught, rho=solution.rho, g=solution.g,
        trusted_band=solution.trusted_band if trusted_band is None else trusted_band,
        origin=f"origin of the hull on the still waterline, {-hull.extent[0, 0]:.4f} m ahead of its aft end",
        source=source,
    )  # fmt: skip
    if roll_damping_fraction == 0.0:
        return bare
    return bare.with_roll_damping(fraction=roll_damping_fraction)


def _restoring(hull: Hull, mass: float, centre: Array, rho: float, g: float) -> Array:
    x, _, z = centre
    return hull.hydrostatics.restoring(rho=rho, g=g, center_of_gravity_z=z, center_of_gravity_x=x, mass=mass)


def _require_afloat(
    hull: Hull, restoring: Array, displaced: float, mass: float, centre: Array, g: float
) -> None:
    """Upright equilibrium: an error for a hull that capsizes, a warning where it sinks or trims."""
    for i, what in ((3, "roll"), (4, "pitch")):
        if restoring[i, i] <= 0.0:
            raise ValueError(
                f"hull {hull.name!r}: restoring in {what} is {restoring[i, i]:.4g} N m with the centre of "
                f"gravity {centre[2]:.4g} m above the waterline: it capsizes; lower the centre of gravity"
            )
    excess = mass / displaced - 1.0
    if abs(excess) > DISPLACEMENT_LIMIT:
        warn_caller(
            f"hull {hull.name!r}: mass {mass:.6g} kg is {100.0 * excess:+.1f} % off the displaced "
            f"{displaced:.6g} kg: without another vertical load it would float at another draught, where "
            "added mass, damping and forces differ. Change the draught, or add what it carries as bodies",
            FloatingPositionWarning,
        )
    lever = centre[0] - hull.hydrostatics.center_of_buoyancy[0]
    trim = mass * g * lever / restoring[4, 4]
    if abs(trim) > TRIM_LIMIT:
        warn_caller(
            f"hull {hull.name!r}: the centre of gravity lies {lever:+.4g} m forward of the centre of "
            f"buoyancy (x = {hull.hydrostatics.center_of_buoyancy[0]:.4g} m); the hull would trim by "
            f"{np.degrees(trim):+.3g} deg, which the database leaves out. Move one over the other",
            FloatingPositionWarning,
        )


def _increasing(what: str, value: ArrayLike, low: float, high: float, limits: str) -> Array:
    row = np.asarray(value, dtype=float)
    good = row.ndim == 1 and len(row) > 0 and bool(np.all(np.isfinite(row)))
    if not good or np.any(np.diff(row) <= 0.0) or row[0] <= low or row[-1] >= high:
        raise ValueError(f"{what} is {value!r}; give increasing numbers {limits}")
    return row


def strip_solution(
    hull: Hull, *, omega: Array, heading: Array, rho: float, g: float, stations: int
) -> HullSolution:
    """Radiation and excitation from even stations, both ends included.

    The trusted band begins where the wave is as long as the ship (longer waves do not see strips) and ends
    where it is eight panels of the largest section long.

    Warns with SubmergedPartWarning of a bulb ahead of the stem, or the like.
    Raises ValueError: fewer than five stations, or a section that is not one outline from waterline to keel.
    """
    if stations < 5:
        raise ValueError(f"hull {hull.name!r}: {stations} stations; give 5 or more, 20 to 40 for a ship")
    x = np.linspace(hull.extent[0, 0], hull.extent[1, 0], stations)
    cut = hull.sections(x)
    hanging = 2.0 * float(np.trapezoid([s.apart for s in cut], x)) / hull.hydrostatics.volume
    if hanging > HANGING:
        warn_caller(
            f"hull {hull.name!r}: {100.0 * hanging:.2g} % of the volume hangs apart under water (a bulb "
            "ahead of the stem, a pod) and is left out by strip theory: its added mass and wave force are "
            "missing. Use method='capytaine' to have them",
            SubmergedPartWarning,
        )
    solved = _core.strip_theory(
        x=x, sections=[s.section for s in cut], omega=omega, heading=heading, speed=0.0, rho=rho, g=g,
        panels=PANELS,
    )  # fmt: skip
    girth = max(float(np.hypot(*np.diff(s.section, axis=0).T).sum()) for s in cut)
    waves = np.array([hull.length, PANELS_PER_WAVE * girth / PANELS])
    low, high = np.sqrt(2.0 * np.pi * g / waves).tolist()
    return HullSolution(
        omega=omega, heading=heading, rho=rho, g=g, added_mass=solved["added_mass"],
        damping=solved["damping"], added_mass_zero=None,
        added_mass_infinite=solved["infinite_frequency_added_mass"], force=solved["force"],
        method=f"strip theory, {stations} stations, surge without radiation", trusted_band=(low, high),
    )  # fmt: skip


def convergence_told(
    hull: Hull, solution: HullSolution, solve: Callable[[Hull], HullSolution], inside: NDArray[np.bool_]
) -> str:
    """What changes with about half the panels, even ones, as the end of a database's `source`.

    ``solve`` solves the coarse hull at the same frequencies, of which those ``inside`` (n,) count. Warns with
    MeshConvergenceWarning where an entry on the diagonal changes by more than 5 % of its largest.
    """
    size, around = np.sqrt(2.0) * hull.panel_size, 0.5 * (hull.breadth + 2.0 * hull.draught)
    coarse = hull.remeshed(
        stations=max(FEWEST, round(hull.length / size)), girth=max(FEWEST // 2, round(around / size))
    )
    other = solve(coarse)
    changes = {}
    for symbol, name in (("A", "added_mass"), ("B", "damping")):
        for i in range(6):
            mine, theirs = (getattr(one, name)[inside, i, i] for one in (solution, other))
            largest = float(np.abs(mine).max()) or np.inf  # none where it is negligible
            changes[f"{symbol}{i + 1}{i + 1}"] = float(np.abs(mine - theirs).max()) / largest
    entry, worst = max(changes.items(), key=lambda pair: pair[1])
    told = f"; with {len(coarse.panels)} in place of {len(hull.panels)} panels {entry} changes by {worst:.2%}"
    if worst > LARGEST_CHANGE:
        large = ", ".join(f"{name} {value:.1%}" for name, value in changes.items() if value > LARGEST_CHANGE)
        warn_caller(
            f"hull {hull.name!r}: with {len(coarse.panels)} in place of {len(hull.panels)} panels these "
            f"change, by their largest: {large}. Mesh it finer: hull.remeshed(stations=..., girth=...)",
            MeshConvergenceWarning,
        )
    return told
