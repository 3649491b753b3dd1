"""Reader of WAMIT results: ``.1 .3 .4 .hst .8 .9 .12d`` (numbers), ``.out`` (water, volume), ``.frc`` (mass).

File axes and headings are ours (x forward, y port, z up; heading = direction of travel from +x towards +y;
exp(+i omega t)). Dimensions follow the WAMIT manual, chapter 3, with length scale L: A rho L^k and B rho
omega L^k with k = 3, 4, 5 for no, one, two rotations; C rho g L^(k-1); forces rho g L^2, moments rho g L^3;
rotations 1/L. Phases in ``.out`` are rounded to degrees and not used.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from os import PathLike
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seacrane.errors import FileFormatError
from seacrane.hydro.data.drift_coefficients import DriftCoefficients
from seacrane.hydro.data.heading_circle import keeps_sides_apart
from seacrane.hydro.data.rigid_mass import rigid_mass_matrix
from seacrane.hydro.database.database import HydroDatabase
from seacrane.hydro.readers.as_read import as_read, mass_of_file
from seacrane.hydro.readers.band_of_data import with_band_of_data
from seacrane.hydro.readers.equivalent_box import equivalent_box
from seacrane.hydro.readers.format import Format, of_one_speed, zero_speed
from seacrane.hydro.readers.usual_inertia import usual_mass_matrix
from seacrane.hydro.readers.wamit_control import (
    ForceControl,
    Listing,
    check_period_output,
    read_force_control,
    read_listing,
)
from seacrane.hydro.readers.wamit_drift import BY_PREFERENCE, read_mean_drift
from seacrane.hydro.readers.wamit_tables import (
    Radiation,
    WaveTable,
    read_radiation,
    read_restoring,
    read_waves,
)
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.shown import shown
from seacrane.warnings import AssumedDensityWarning, PartialSetWarning

FloatArray = NDArray[np.float64]

SUFFIXES = (".1", ".3", ".4", ".hst", ".frc", ".out", ".cfg", ".pot", *BY_PREFERENCE)
NEEDED = (".1", ".3", ".hst")
USUAL_DENSITY = 1025.0
ROTATIONS = np.array([0, 0, 0, 1, 1, 1])
HASKIND_LIMIT = np.full(6, 0.01)  # two force methods differ by the mesh's error
HASKIND_FLOOR = np.array([0.05, 1e-4, 1e-4, 1e-4, 1e-4, 1e-4])  # surge in beam seas is a difference of errors
DIFFRACTION_LIMIT = np.full(6, 1e-3)  # the forces of .3 themselves, in seven digits
PANELS_PER_WAVELENGTH = 8.0


def read_wamit(
    path: str | PathLike[str],
    *,
    volume: float | None = None,
    depth: float = np.inf,
    g: float = 9.80665,
    length_scale: float = 1.0,
    rho: float | None = None,
    mass_matrix: ArrayLike | None = None,
    motions: Sequence[str] | None = None,
) -> HydroDatabase:
    """Read the WAMIT results at ``path``: a folder that holds one set, the common stem, or one of the files.

    Needs ``.1``, ``.3``, ``.hst`` and ``.out``. ``.4`` adds the motions, against which `check` compares;
    ``.frc``, of either form, the mass; ``.9``, ``.8`` or ``.12d`` (the first of them that is there) the mean
    drift. One rigid body at the origin of the waves, zero speed.

    Parameters
    ----------
    path : folder, stem or file.
    volume, depth, g, length_scale : m3, m, m/s2, m (ULEN), of a set without ``.out``, such as another code
        exports: there ``volume`` is needed. Beside a ``.out`` they are not used.
    rho : kg/m3, of a set that does not tell it.
    mass_matrix : (6, 6) in SI about the origin; it takes the place of mass and inertia of ``.frc``.
    motions : names of those that were solved for, where some were not: a motion without added mass and
        damping is refused unless it is left out here.

    Returns
    -------
    HydroDatabase : external damping of ``.frc`` is in ``linear_damping``, external stiffness in
        ``restoring``. Length, breadth and draught are those of the equivalent box. The trusted band ends
        where a wave is eight panels long.

    Warns
    -----
    AssumedDensityWarning : neither ``.frc`` nor ``.out`` holds a density.
    AssumedInertiaWarning : no ``.frc``, or one without mass matrix.
    PartialSetWarning : periods or headings are not the same in all files.

    Raises
    ------
    FileFormatError : a file is missing, truncated, damaged or inconsistent with the others; the message names
        the file and, where there is one, the line.
    """
    stem = find_wamit_stem(Path(path))
    files = {suffix: sibling(stem, suffix) for suffix in SUFFIXES}
    for suffix in NEEDED:
        if files[suffix] is None:
            raise FileFormatError(
                f"{stem}{suffix}: no such file; WAMIT needs {', '.join(NEEDED)} of the same stem"
            )
    mass = None if mass_matrix is None else np.asarray(mass_matrix, dtype=float)
    given = _Given(volume, float(depth), float(g), float(length_scale), rho, mass)
    try:
        found = as_read(stem, "read_wamit", _convert(stem, files, given), motions)
    except FileFormatError:
        raise
    except ValueError as error:
        raise FileFormatError(f"{stem}: {error}") from error
    return with_band_of_data(found)


def find_wamit_stem(path: Path) -> Path:
    """Common stem (folder and name without suffix) of the set of files that ``path`` points to."""
    if path.is_dir():
        stems = sorted({file.with_suffix("") for file in path.iterdir() if file.suffix == ".1"})
        if len(stems) != 1:
            found = ", ".join(stem.name for stem in stems) or "none"
            raise FileFormatError(
                f"{path}: one .1 file is needed in a WAMIT folder, found: {found}; give the stem"
            )
        return stems[0]
    if sibling(path, ".1") is None and path.suffix.lower() in SUFFIXES:
        return path.with_suffix("")
    return path


def is_wamit(path: Path) -> bool:
    """Whether ``path`` is a folder, stem or file of a WAMIT set."""
    if path.is_dir():
        return any(file.suffix == ".1" for file in path.iterdir())
    stem = find_wamit_stem(path)
    return any(sibling(stem, suffix) is not None for suffix in (".1", ".3", ".hst"))


def sibling(stem: Path, suffix: str) -> Path | None:
    """File of the set with that suffix, in either case."""
    for name in (stem.name + suffix, stem.name + suffix.upper()):
        if (stem.parent / name).is_file():
            return stem.parent / name
    return None


@dataclass(frozen=True, eq=False)
class _Given:
    """What the caller says of a set that lacks ``.out`` or ``.frc``."""

    volume: float | None
    depth: float
    g: float
    length_scale: float
    rho: float | None
    mass: FloatArray | None

    def listing(self, stem: Path) -> Listing:
        """In the place of ``.out``."""
        if self.volume is None:
            raise FileFormatError(
                f"{stem}.out: no such file; WAMIT needs it, or read_wamit the displaced volume in m3 (and "
                "depth, g, length_scale where they are not inf, 9.80665, 1)"
            )
        values = {"volume": self.volume, "depth": self.depth, "g": self.g, "length_scale": self.length_scale}
        for name, value in values.items():
            if not (value > 0.0 and (np.isfinite(value) or name == "depth")):
                raise FileFormatError(f"{stem}: {name} is {value!r}; give a positive number")
        return Listing(
            path=stem,
            version="without .out,",
            title="volume, depth and gravity as given",
            g=self.g,
            length_scale=self.length_scale,
            depth=self.depth,
            rho=None,
            volume=float(self.volume),
            center_of_buoyancy=np.zeros(3),
            center_of_gravity=None,
            body_height=0.0,
            symmetric=None,
            panels=None,
            period=np.zeros(0),
            last_line=0,
        )


@dataclass(frozen=True, eq=False)
class _Body:
    """What turns non-dimensional numbers into SI, and the inertia."""

    listing: Listing
    rho: float
    restoring: FloatArray
    box: tuple[float, float, float]
    control: ForceControl | None
    mass: FloatArray | None


def _convert(stem: Path, files: dict[str, Path | None], given: _Given) -> HydroDatabase:
    """The database in SI."""
    if files[".cfg"] is not None:
        check_period_output(files[".cfg"])
    radiation = read_radiation(_there(files, ".1"))
    listing = given.listing(stem) if files[".out"] is None else read_listing(files[".out"])
    if listing.symmetric is None:
        listing = replace(listing, symmetric=keeps_sides_apart(radiation.added_mass))
    force = read_waves(_there(files, ".3"))
    motion = None if files[".4"] is None else read_waves(files[".4"])
    control = None if files[".frc"] is None else read_force_control(files[".frc"])
    if files[".out"] is not None:
        _check_periods(listing, radiation.period, _there(files, ".1"))
    period, heading_deg = common_periods(stem, radiation, force, motion)
    rho = _density(stem, listing, control, given.rho)
    length_scale, g = listing.length_scale, listing.g
    power = 3 + np.add.outer(ROTATIONS, ROTATIONS)
    mass_scale = rho * length_scale**power
    restoring = read_restoring(_there(files, ".hst")) * rho * g * length_scale ** (power - 1)
    box = equivalent_box(restoring, listing.volume, rho * g)
    body = _Body(listing, rho, restoring, box, control, given.mass)
    omega = (2.0 * np.pi / period)[::-1]
    rows = np.searchsorted(radiation.period, period)[::-1]
    direction, order = wamit_directions(force.path, heading_deg)
    wave = WavePicker(period, heading_deg, order)
    limits = (radiation.infinite_frequency_added_mass, radiation.zero_frequency_added_mass)
    infinite, zero = (None if limit is None else limit * mass_scale for limit in limits)
    stiffness = None if control is None else control.stiffness
    damping = None if control is None else control.damping
    haskind = control is None or control.motions_option != 2
    return HydroDatabase(
        name=stem.name,
        omega=omega,
        heading=direction,
        added_mass=radiation.added_mass[rows] * mass_scale,
        damping=radiation.damping[rows] * mass_scale * omega[:, None, None],
        infinite_frequency_added_mass=infinite,
        zero_frequency_added_mass=zero,
        restoring=restoring if stiffness is None else restoring + stiffness,
        mass_matrix=_mass_matrix(stem, body),
        force=wave.pick(force) * rho * g * length_scale ** (2 + ROTATIONS),
        motion_rao=None if motion is None else wave.pick(motion) / length_scale**ROTATIONS,
        motion_rao_limit=HASKIND_LIMIT if haskind else DIFFRACTION_LIMIT,
        motion_rao_floor=HASKIND_FLOOR if haskind else np.full(6, 1e-4),
        linear_damping=np.zeros((6, 6)) if damping is None else damping,
        rho=rho,
        g=g,
        depth=listing.depth,
        length=box[0],
        breadth=box[1],
        draught=box[2],
        origin=_origin(listing),
        source=_source(stem, files, listing, haskind),
        trusted_band=_trusted(body, omega),
        port_starboard_symmetric=bool(listing.symmetric),
        drift=_drift(files, listing, rho),
    )


def _drift(files: dict[str, Path | None], listing: Listing, rho: float) -> DriftCoefficients | None:
    """Mean loads per squared amplitude, N/m2 and N m/m2, of the first file that has them."""
    path = next((files[suffix] for suffix in BY_PREFERENCE if files[suffix] is not None), None)
    if path is None:
        return None
    found = read_mean_drift(path)
    direction, order = wamit_directions(path, found.heading_deg)
    scale = rho * listing.g * listing.length_scale ** (1 + ROTATIONS)
    return DriftCoefficients(
        heading=direction,
        omega=(2.0 * np.pi / found.period)[::-1],
        coefficient=found.values[order][:, ::-1] * scale,
    )


def _there(files: dict[str, Path | None], suffix: str) -> Path:
    file = files[suffix]
    assert file is not None
    return file


def _check_periods(listing: Listing, period: FloatArray, path: Path) -> None:
    """Raise unless the listing goes through every period of the matrices."""
    for value in period:
        if not np.any(np.abs(listing.period - value) <= 1e-5 * value):
            raise FileFormatError(
                f"{listing.path}, line {listing.last_line}: the file ends without period {value:g} s of "
                f"{path.name}; it is truncated, or the files are not of one run"
            )


def common_periods(
    stem: Path, radiation: Radiation, force: WaveTable, motion: WaveTable | None
) -> tuple[FloatArray, FloatArray]:
    """Periods and headings that all files hold, with a warning where one holds more."""
    periods = [radiation.period, force.period] + ([] if motion is None else [motion.period])
    headings = [force.heading_deg] + ([] if motion is None else [motion.heading_deg])
    shared = []
    for what, unit, lists in (("periods", "s", periods), ("headings", "deg", headings)):
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


def wamit_directions(path: Path, heading_deg: FloatArray) -> tuple[FloatArray, NDArray[np.intp]]:
    """Directions in [0, 2 pi), rising, and their places in ``heading_deg``; 360 deg beside 0 is dropped."""
    wrapped = np.round(np.mod(heading_deg, 360.0), 6) % 360.0
    degrees, order = np.unique(wrapped, return_index=True)
    repeated = len(wrapped) - len(degrees)
    if repeated and not (repeated == 1 and np.ptp(heading_deg) == 360.0):
        raise FileFormatError(f"{path}: headings {shown(heading_deg.tolist())} deg name one direction twice")
    return np.radians(degrees), order


@dataclass(frozen=True, eq=False)
class WavePicker:
    """The common headings and periods out of a table, directions and frequencies rising."""

    period: FloatArray
    heading_deg: FloatArray
    order: NDArray[np.intp]

    def pick(self, table: WaveTable) -> NDArray[np.complex128]:
        rows = np.searchsorted(table.heading_deg, self.heading_deg)[self.order]
        columns = np.searchsorted(table.period, self.period)[::-1]
        return np.asarray(table.values[np.ix_(rows, columns)])


def _density(stem: Path, listing: Listing, control: ForceControl | None, asked: float | None) -> float:
    return water_density(stem, listing.rho, asked if control is None or control.rho is None else control.rho)


def water_density(stem: Path, listed: float | None, given: float | None) -> float:
    """kg/m3 of the listing or as given; where both tell it, they have to agree."""
    if given is None and listed is None:
        warn_caller(
            f"{stem}: neither .frc nor .out holds the water density; 1025 kg/m3 is taken, and every mass, "
            "stiffness and force is proportional to it",
            AssumedDensityWarning,
        )
        return USUAL_DENSITY
    if given is not None and listed is not None and abs(given - listed) > 1e-4 * given:
        raise FileFormatError(
            f"{stem}: density {given:g} kg/m3 in .frc but {listed:g} in .out; use files of one run"
        )
    return float(given if given is not None else listed or USUAL_DENSITY)


def _mass_matrix(stem: Path, body: _Body) -> FloatArray:
    """Mass matrix (6, 6): as given, or the displaced mass with the radii of gyration of ``.frc``."""
    control, listing = body.control, body.listing
    mass = body.rho * listing.volume
    asked = "read_wamit(mass_matrix=...)"
    if body.mass is not None:
        return body.mass
    if control is not None and control.mass is not None:
        return mass_of_file(control.path, asked, control.mass, displaced=mass)
    centre = listing.center_of_buoyancy.copy()
    if listing.center_of_gravity is not None:
        centre = listing.center_of_gravity.copy()
    if control is not None and control.radii is not None and control.height_of_gravity is not None:
        centre[2] = control.height_of_gravity
        about_origin = mass * control.radii * np.abs(control.radii)
        matrix = rigid_mass_matrix(mass, centre, np.zeros((3, 3)))
        matrix[3:, 3:] = about_origin
        return mass_of_file(control.path, asked, matrix)
    if control is not None and control.center_of_gravity is not None:
        centre = control.center_of_gravity
    return usual_mass_matrix(
        stem, "no mass matrix in .frc", mass=mass, centre=centre, length=body.box[0], breadth=body.box[1]
    )


def _origin(listing: Listing) -> str:
    height = listing.body_height
    place = "on the still waterline" if height == 0.0 else f"{height:g} m above the still waterline"
    return f"origin of the WAMIT body axes, {place}"


def _source(stem: Path, files: dict[str, Path | None], listing: Listing, haskind: bool) -> str:
    read = ", ".join(suffix for suffix in SUFFIXES if files[suffix] is not None and suffix != ".pot")
    method = "Haskind" if haskind else "diffraction"
    motions = "" if files[".4"] is None else f"; motions by WAMIT from {method} forces"
    return f"WAMIT {listing.version} files {stem.name} ({read}): {listing.title}{motions}"


def _trusted(body: _Body, omega: FloatArray) -> tuple[float, float] | None:
    """Up to the frequency whose deep-water wave is eight panels long, panels being equal squares."""
    if body.listing.panels is None:
        return None
    length, breadth, draught = body.box
    wetted = length * breadth + 2.0 * draught * (length + breadth)
    sides = 0.5 if body.listing.symmetric else 1.0
    wavelength = PANELS_PER_WAVELENGTH * np.sqrt(sides * wetted / body.listing.panels)
    high = min(float(np.sqrt(2.0 * np.pi * body.listing.g / wavelength)), float(omega[-1]))
    return (float(omega[0]), high) if omega[0] < high else None


FORMAT = Format(
    name="WAMIT",
    files="a WAMIT folder, stem or file (.1 .3 .hst .out, with .4, .frc and .8, .9 or .12d)",
    can_open=is_wamit,
    read=of_one_speed(read_wamit),
    speeds=zero_speed,
)
