"""Reader of WAMIT: ``.1 .2 .3 .4 .hst .8 .9 .12d`` (numbers), ``.out`` (water, bodies), ``.frc`` (mass).

File axes and headings are ours (x forward, y port, z up; heading = direction of travel from +x towards +y;
exp(+i omega t)). Dimensions follow the WAMIT manual, chapter 3, with length scale L: A rho L^k and B rho
omega L^k with k = 3, 4, 5 for no, one, two rotations; C rho g L^(k-1); forces rho g L^2, moments rho g L^3;
rotations 1/L; mean drift rho g L^k of a squared amplitude, k = 1 for forces and 2 for moments. Of several
bodies, matrices and forces are in each body's own axes (XBODY, YBODY, ZBODY, PHIBODY of the listing); waves
have zero phase at the origin of the global axes, which is the group's (chapter 8).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seacrane.arrays import Array
from seacrane.errors import FileFormatError
from seacrane.hydro.data.frozen import reading
from seacrane.hydro.data.heading_circle import keeps_sides_apart
from seacrane.hydro.data.hydro_data import DriftCoefficients
from seacrane.hydro.data.hydro_group_data import GroupBody
from seacrane.hydro.data.motion import force_of_motion
from seacrane.hydro.data.rigid_mass import rigid_mass_matrix
from seacrane.hydro.readers.as_read import Asked, Given, left_out, mass_of_file, rising_degrees
from seacrane.hydro.readers.format import Format, Loaded, sibling, stem_of, unread
from seacrane.hydro.readers.of_bodies import density_of, floating_body, hull_or_group, of_each
from seacrane.hydro.readers.wamit_listing import (
    ROTATIONS,
    ForceControl,
    ListedBody,
    Listing,
    check_period_output,
    count_bodies,
    listed_tables,
    read_force_control,
    read_listing,
)
from seacrane.hydro.readers.wamit_tables import (
    BY_PREFERENCE,
    LOADS,
    NEEDED,
    QUADRATIC,
    RADIATION,
    SUFFIXES,
    WAVES,
    Files,
    Radiation,
    WaveTable,
    radiation_of,
    read_mean_drift,
    read_restoring,
    read_table,
    require_set,
    waves_of,
)
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.shown import shown
from seacrane.warnings import PartialSetWarning, RoundedPhaseWarning

SET = ("WAMIT", (".1", ".out"), (*SUFFIXES, *QUADRATIC))  # as `stem_of` takes it
HASKIND_LIMIT = np.full(6, 0.01)  # two force methods differ by the mesh's error
HASKIND_FLOOR = np.array([0.05, 1e-4, 1e-4, 1e-4, 1e-4, 1e-4])  # surge in beam seas is a difference of errors
SAME_LIMIT = np.full(6, 1e-3)  # motions of the forces that are read, in seven digits
PANELS_PER_WAVELENGTH = 8.0


def read_wamit(
    path: str | PathLike[str],
    *,
    volume: float | None = None,
    depth: float = np.inf,
    g: float = 9.80665,
    length_scale: float = 1.0,
    rho: float | None = None,
    mass_matrix: Given | None = None,
    motions: Sequence[str] | None = None,
    leave_out: ArrayLike | None = None,
) -> Loaded:
    """Read the WAMIT results at ``path``: a folder that holds one set, the common stem, or one of the files.

    One body, at the origin of the waves, needs ``.1``, ``.3``, ``.hst`` and ``.out``. Without ``.3`` the
    forces are those of ``.2``, or what makes the motions of ``.4``, which takes the masses. ``.4`` adds the
    motions, against which `check` compares; ``.frc``, of either form, the mass; ``.9``, ``.8``, ``.12d``,
    ``.11d`` or ``.10d`` (the first of them that is there) the mean drift. Several bodies need ``.out`` alone,
    and are read from ``.1`` and ``.3`` where both are there: the phases of the listing are rounded to
    degrees. Zero speed.

    Parameters
    ----------
    path : folder, stem or file.
    volume, depth, g, length_scale : m3, m, m/s2, m (ULEN), of a set without ``.out``, such as another code
        exports: there ``volume`` is needed. Beside a ``.out`` they are not used.
    rho : kg/m3, of a set that does not tell it.
    mass_matrix : (6, 6) in SI about the origin; it takes the place of mass and inertia of ``.frc``. Of
        several bodies by name. Without either there is none.
    motions, leave_out : as `read_capytaine` takes them.

    Returns
    -------
    HydroDatabase : of one body. External damping of ``.frc`` is in ``linear_damping``, external stiffness in
        ``restoring``. Length, breadth and draught are those of the equivalent box. The trusted band ends
        where a wave is eight panels long.
    HydroGroup : of several, named as their geometry files, in the order of the listing, each about the origin
        of its own axes.

    Warns
    -----
    AssumedDensityWarning : neither ``.frc`` nor ``.out`` holds a density.
    PartialSetWarning : periods or headings are not the same in all files; or there is no ``.3``.
    RoundedPhaseWarning : the forces are those of the listing.

    Raises
    ------
    FileFormatError : a file is missing, truncated, damaged or inconsistent with the others; the message names
        the file and, where there is one, the line.
    """
    stem = stem_of(Path(path), *SET)
    files = {suffix: sibling(stem, suffix) for suffix in SUFFIXES}
    asked = Asked(
        where=stem, reader="read_wamit", mass_matrix=mass_matrix, motions=motions, leave_out=leave_out
    )
    with reading(stem):
        if files[".cfg"] is not None:
            check_period_output(files[".cfg"])
        listing = None if files[".out"] is None else read_listing(files[".out"])
        if listing is None or len(listing.bodies) == 1:
            require_set(stem, files)
        listing = listing or _listing_as_given(stem, volume, depth, g, length_scale)
        return _convert(asked, files, listing, rho)


def is_wamit(path: Path) -> bool:
    """Whether ``path`` is a folder, stem or file of a WAMIT set, or leads to a listing of several bodies."""
    if path.is_dir() and any(file.suffix == ".1" for file in path.iterdir()):
        return True
    try:
        stem = stem_of(path, *SET)
    except FileFormatError:
        return False
    if not path.is_dir() and any(sibling(stem, one) is not None for one in (*NEEDED, *LOADS, *QUADRATIC)):
        return True
    listing = sibling(stem, ".out") if path.is_dir() or path.suffix.lower() == ".out" else None
    return listing is not None and count_bodies(listing) > 1


def _listing_as_given(stem: Path, volume: float | None, depth: float, g: float, scale: float) -> Listing:
    """In the place of ``.out``, what the caller says."""
    if volume is None:
        raise FileFormatError(
            f"{stem}.out: no such file; WAMIT needs it, or read_wamit the displaced volume in m3 (and depth, "
            "g, length_scale where they are not inf, 9.80665, 1)"
        )
    given = {"volume": volume, "depth": depth, "g": g, "length_scale": scale}
    for name, value in given.items():
        if not (value > 0.0 and (np.isfinite(value) or name == "depth")):
            raise FileFormatError(f"{stem}: {name} is {value!r}; give a positive number")
    return Listing(
        path=stem, version="without .out,", title="volume, depth and gravity as given", g=float(g), rho=None,
        length_scale=float(scale), depth=float(depth),
        bodies=(ListedBody(stem.name, np.zeros(3), 0.0, float(volume), np.zeros(3)),),
    )  # fmt: skip


def _numbers(files: Files, listing: Listing) -> tuple[Radiation, WaveTable, str]:
    """Matrices and loads, non-dimensional, and the suffix of the file that holds the latter."""
    count = len(listing.bodies)
    kind = next(one for one in LOADS if files[one] is not None) if count == 1 else ".3"
    matrices, loads = files[".1"], files[kind]
    if matrices is not None and loads is not None:
        rows, forces = read_table(matrices, RADIATION), read_table(loads, WAVES)
        if kind != ".3":
            warn_caller(
                f"{loads}: read in place of .3, which is not there: {LOADS[kind]}"
                + (" that the forces are solved of" if kind == ".4" else ""),
                PartialSetWarning,
            )
    else:
        rows, forces = listed_tables(listing)
        kind = ".out"
        warn_caller(
            f"{listing.path}: wave forces are read from the listing, whose phases are rounded to degrees: "
            "each is off by up to 0.9 % of its size. Give the .1 and .3 files beside it",
            RoundedPhaseWarning,
        )
    return radiation_of(rows, bodies=count), waves_of(forces, bodies=count), kind


def _convert(asked: Asked, files: Files, listing: Listing, rho: float | None) -> Loaded:
    """The database or the group in SI."""
    stem, count = asked.where, len(listing.bodies)
    radiation, waves, kind = _numbers(files, listing)
    motion = None
    if files[".4"] is not None and count == 1 and kind != ".4":
        motion = waves_of(read_table(files[".4"], WAVES), bodies=1)
    control = None if files[".frc"] is None or count > 1 else read_force_control(files[".frc"])
    for value in [] if files[".out"] is None or files[".1"] is None else radiation.period:
        if not np.any(np.abs(np.array(listing.period) - value) <= 1e-5 * value):
            raise FileFormatError(
                f"{listing.path}, line {len(listing.lines)}: the file ends without period {value:g} s of the "
                ".1 file; it is truncated, or the files are not of one run"
            )
    period, heading_deg = _common_periods(stem, radiation, waves, motion)
    rho = rho if control is None or control.rho is None else control.rho
    if rho is not None and listing.rho is not None and abs(rho - listing.rho) > 1e-4 * rho:
        raise FileFormatError(
            f"{stem}: density {rho:g} kg/m3 in .frc but {listing.rho:g} in .out; use files of one run"
        )
    consequence = "every mass, stiffness and force is proportional to it"
    rho = density_of(asked, listing.rho if rho is None else rho, consequence)
    g, scale = listing.g, listing.length_scale
    turns = np.tile(ROTATIONS, count)
    mass_scale = rho * scale ** (3 + np.add.outer(turns, turns))
    omega = (2.0 * np.pi / period)[::-1]
    rows = np.searchsorted(radiation.period, period)[::-1]
    direction, order = _directions(waves.path, heading_deg)

    def picked(table: WaveTable) -> NDArray[np.complex128]:
        """The common headings and periods out of a table, directions and frequencies rising."""
        at = np.searchsorted(table.heading_deg, heading_deg)[order]
        return np.asarray(table.values[np.ix_(at, np.searchsorted(table.period, period)[::-1])])

    of_motions = kind == ".4"
    if of_motions and asked.mass_matrix is None and (control is None or control.mass is None):
        raise FileFormatError(
            f"{stem}.3: no such file, and forces follow from the motions of .4 only with the masses; give "
            "mass_matrix=, (6, 6) in SI, or .frc"
        )
    bodies = _bodies(asked, files, listing, rho, control)
    own: dict[str, Any] = {}
    origin = "origin of WAMIT's global axes, on the still waterline"
    lids = ", ".join(f"{body.name} {body.lid_panels}" for body in listing.bodies)
    told = ".out alone" if kind == ".out" else ".1, .3, .out"
    source = f"WAMIT {listing.version} files {stem.name} ({told}); interior lid panels: {lids}"
    if count == 1:
        haskind = control is None or control.motions_option != 2
        alike = haskind == (kind == ".2")
        symmetric = listing.symmetric
        if symmetric is None:
            symmetric = keeps_sides_apart(radiation.added_mass)
        own = {
            "port_starboard_symmetric": symmetric,
            "trusted_band": _trusted(listing, bodies[0], symmetric, omega),
            "motion_rao": None if motion is None else picked(motion) / scale**ROTATIONS,
            "motion_rao_limit": SAME_LIMIT if alike else HASKIND_LIMIT,
            "motion_rao_floor": np.full(6, 1e-4) if alike else HASKIND_FLOOR,
            "drift": _drift(files, listing, rho),
        }
        height = listing.bodies[0].position[2]
        place = "on the still waterline" if height == 0.0 else f"{height:g} m above the still waterline"
        origin = f"origin of the WAMIT body axes, {place}"
        read = ", ".join(suffix for suffix in SUFFIXES if files[suffix] is not None and suffix != ".pot")
        source = f"WAMIT {listing.version} files {stem.name} ({read}): {listing.title}"
        if motion is not None:
            source += f"; motions by WAMIT from {'Haskind' if haskind else 'diffraction'} forces"
    units = scale**-ROTATIONS if of_motions else rho * g * scale ** (2 + turns)
    found = hull_or_group(
        asked, bodies, fix="the .hst file of this run", alone=own,
        name=stem.name, origin=origin, source=source, rho=rho, g=g, depth=listing.depth,
        omega=omega, heading=direction,
        force=picked(waves) * units,
        added_mass=radiation.added_mass[rows] * mass_scale,
        **{name: limit * mass_scale for name, limit in radiation.limits.items()},
        damping=radiation.damping[rows] * mass_scale * omega[:, None, None],
    )  # fmt: skip
    found = replace(found, source=found.source + left_out(unread(stem, _read_of(files))))
    return replace(found, force=force_of_motion(found, found.force)) if of_motions else found


def _read_of(files: Files) -> set[str]:
    """Suffixes of the files that something is read of."""
    drift = next((one for one in BY_PREFERENCE if files[one] is not None), "")
    haskind = ".2" if files[".3"] is None else ""
    return {".1", ".3", ".4", ".hst", ".frc", ".out", ".cfg", ".pot", drift, haskind}


def _bodies(
    asked: Asked, files: Files, listing: Listing, rho: float, control: ForceControl | None
) -> list[GroupBody]:
    g, scale, several = listing.g, listing.length_scale, len(listing.bodies) > 1
    whole = None if files[".hst"] is None else read_restoring(files[".hst"], bodies=len(listing.bodies))
    names = [body.name for body in listing.bodies]
    masses = of_each(replace(asked, where=listing.path), "mass_matrix", names, asked.mass_matrix)
    power = scale ** (2 + np.add.outer(ROTATIONS, ROTATIONS))
    bodies = []
    for i, (body, mass) in enumerate(zip(listing.bodies, masses, strict=True)):
        at = slice(6 * i, 6 * i + 6)
        restoring = body.restoring(scale) * rho * g if whole is None else whole[at, at] * rho * g * power
        damping = None
        if control is not None:
            mass = _mass_of_control(asked, control, body, rho) if mass is None else mass
            damping = control.damping
        made = floating_body(
            asked, body.name, where=listing.path if several else None, several=several,
            position=body.position, heading=body.heading, restoring=restoring, volume=body.volume,
            water=(rho, g), mass=mass, linear_damping=damping,
        )  # fmt: skip
        if control is not None and control.stiffness is not None:
            made = replace(made, restoring=restoring + control.stiffness)
        bodies.append(made)
    return bodies


def _drift(files: Files, listing: Listing, rho: float) -> DriftCoefficients | None:
    """Mean loads per squared amplitude, N/m2 and N m/m2, of the first file that has them."""
    path = next((files[suffix] for suffix in BY_PREFERENCE if files[suffix] is not None), None)
    if path is None:
        return None
    found = read_mean_drift(path)
    direction, order = _directions(path, found.heading_deg)
    scale = rho * listing.g * listing.length_scale ** (1 + ROTATIONS)
    omega, load = (2.0 * np.pi / found.period)[::-1], found.values[order][:, ::-1] * scale
    return DriftCoefficients(heading=direction, omega=omega, coefficient=load)


def _common_periods(
    stem: Path, radiation: Radiation, force: WaveTable, motion: WaveTable | None
) -> tuple[Array, Array]:
    """Periods and headings that all files hold, with a warning where one holds more."""
    waves = [force] if motion is None else [force, motion]
    shared = []
    for what, unit, lists in (
        ("periods", "s", [radiation.period, *(table.period for table in waves)]),
        ("headings", "deg", [table.heading_deg for table in waves]),
    ):
        common = lists[0][np.all([np.isin(lists[0], other) for other in lists], axis=0)]
        if len(common) == 0:
            raise FileFormatError(f"{stem}: .1, .3 and .4 have no {what} in common; use files of one run")
        dropped = np.setdiff1d(np.concatenate(lists), common)
        if len(dropped):
            names = ", ".join(f"{value:g}" for value in dropped[:5]) + (", ..." if len(dropped) > 5 else "")
            warn_caller(
                f"{stem}: {what} {names} {unit} are not in every file of the set; the {len(common)} common "
                "ones are read, and nothing is known beyond them",
                PartialSetWarning,
            )
        shared.append(common)
    return shared[0], shared[1]


def _directions(path: Path, heading_deg: Array) -> tuple[Array, NDArray[np.intp]]:
    """Directions in [0, 2 pi), rising, and their places in ``heading_deg``; 360 deg beside 0 is dropped."""
    degrees, order = rising_degrees(heading_deg)
    repeated = len(heading_deg) - len(degrees)
    if repeated and not (repeated == 1 and np.ptp(heading_deg) == 360.0):
        raise FileFormatError(f"{path}: headings {shown(heading_deg.tolist())} deg name one direction twice")
    return np.radians(degrees), order


def _mass_of_control(asked: Asked, control: ForceControl, body: ListedBody, rho: float) -> Array | None:
    """Mass matrix (6, 6) of ``.frc``, or the displaced mass with its radii; None where it has neither."""
    mass = rho * body.volume
    if control.mass is not None:
        return mass_of_file(asked, control.mass, where=control.path, displaced=mass)
    if control.radii is None or control.height_of_gravity is None:
        return None
    centre = np.array([*body.gravity[:2], control.height_of_gravity])
    matrix = rigid_mass_matrix(mass, centre, np.zeros((3, 3)))
    matrix[3:, 3:] = mass * control.radii * np.abs(control.radii)
    return mass_of_file(asked, matrix, where=control.path)


def _trusted(listing: Listing, body: GroupBody, symmetric: bool, omega: Array) -> tuple[float, float] | None:
    """Up to the frequency whose deep-water wave is eight panels long, panels being equal squares."""
    if listing.panels is None:
        return None
    length, breadth, draught = body.length, body.breadth, body.draught
    wetted = length * breadth + 2.0 * draught * (length + breadth)
    sides = 0.5 if symmetric else 1.0
    wavelength = PANELS_PER_WAVELENGTH * np.sqrt(sides * wetted / listing.panels)
    high = min(float(np.sqrt(2.0 * np.pi * listing.g / wavelength)), float(omega[-1]))
    return (float(omega[0]), high) if omega[0] < high else None


FORMAT = Format(
    name="WAMIT",
    files="a WAMIT folder, stem or file (.1 .3 .hst .out, with .2, .4, .frc and .8, .9 or .12d)",
    looks="numbers alone: period, i, j, A, B in `.1`, period, heading, i, modulus, phase and parts in `.3`",
    can_open=is_wamit,
    read=read_wamit,
    takes=("mass_matrix",),
)
