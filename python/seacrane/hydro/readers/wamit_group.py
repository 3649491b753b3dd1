"""Reader of WAMIT results of several bodies: ``.out`` for water and bodies, ``.1 .3 .hst`` for the numbers.

Each body's matrices and forces are in its own axes (XBODY, YBODY, ZBODY, PHIBODY of the listing); waves have
zero phase at the origin of the global axes, which is the group's (WAMIT manual, chapters 3 and 8). Dimensions
are those of `seacrane.hydro.readers.wamit`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from os import PathLike
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seacrane.errors import FileFormatError
from seacrane.hydro.data.group_body import GroupBody
from seacrane.hydro.group.group import HydroGroup
from seacrane.hydro.readers.as_read import as_read
from seacrane.hydro.readers.band_of_data import with_band_of_group
from seacrane.hydro.readers.format import Format, of_one_speed, zero_speed
from seacrane.hydro.readers.of_bodies import box_of, group_symmetric, of_each, require_own_hydrostatics
from seacrane.hydro.readers.usual_inertia import usual_mass_matrix
from seacrane.hydro.readers.wamit import (
    ROTATIONS,
    WavePicker,
    common_periods,
    find_wamit_stem,
    is_wamit,
    sibling,
    wamit_directions,
    water_density,
)
from seacrane.hydro.readers.wamit_listing import (
    GroupListing,
    ListedBody,
    count_bodies,
    listed_tables,
    read_group_listing,
)
from seacrane.hydro.readers.wamit_tables import (
    Radiation,
    WaveTable,
    radiation_of,
    read_radiation,
    read_restoring,
    read_waves,
    waves_of,
)
from seacrane.inputs.caller import warn_caller
from seacrane.warnings import RoundedPhaseWarning

FloatArray = NDArray[np.float64]


def read_wamit_group(
    path: str | PathLike[str],
    *,
    rho: float | None = None,
    mass_matrices: Mapping[str, ArrayLike] | None = None,
    motions: Sequence[str] | None = None,
) -> HydroGroup:
    """Read the WAMIT results of several bodies at ``path``: a folder, the common stem, or one of the files.

    Needs ``.out``. The numbers are those of ``.1`` and ``.3`` where both are there, else of the listing,
    whose phases are rounded to degrees; restoring is that of ``.hst``, else of the listing. Zero speed.

    Parameters
    ----------
    path : folder, stem or file.
    rho : kg/m3, of a listing that does not tell it.
    mass_matrices : by body, (6, 6) in SI about its origin; by default the displaced masses with usual radii
        of gyration.
    motions : names of those that were solved for, where some were not: a motion without added mass and
        damping is refused unless it is left out here.

    Returns
    -------
    HydroGroup : bodies are named as their geometry files, in the order of the listing, each about the origin
        of its own axes. Lengths, breadths and draughts are those of the equivalent boxes.

    Warns
    -----
    AssumedDensityWarning : the listing holds no density, and none is given.
    AssumedInertiaWarning : no ``mass_matrices``.
    RoundedPhaseWarning : the forces are those of the listing.
    PartialSetWarning : periods or headings are not the same in all files.

    Raises
    ------
    FileFormatError : a file is missing, truncated, damaged or inconsistent with the others; the message names
        the file, the line or the body.
    """
    stem = _stem_of(Path(path))
    listing = sibling(stem, ".out")
    if listing is None:
        raise FileFormatError(f"{stem}.out: no such file; it tells the bodies, their places and the water")
    try:
        found = as_read(
            stem,
            "read_wamit_group",
            _convert(stem, read_group_listing(listing), listing, rho, mass_matrices),
            motions,
        )
    except FileFormatError:
        raise
    except ValueError as error:
        raise FileFormatError(f"{stem}: {error}") from error
    require_own_hydrostatics(stem, found, "the .hst file of this run")
    return with_band_of_group(found)


def _stem_of(path: Path) -> Path:
    """As `find_wamit_stem`, and of a folder that holds one listing alone."""
    if path.is_dir():
        listings = [file for file in path.iterdir() if file.suffix.lower() == ".out"]
        if len(listings) == 1:
            return listings[0].with_suffix("")
    return path.with_suffix("") if path.suffix.lower() == ".out" else find_wamit_stem(path)


@dataclass(frozen=True, eq=False)
class _Numbers:
    """What the files hold, non-dimensional; ``restoring`` (6 k, 6 k) or None."""

    radiation: Radiation
    waves: WaveTable
    restoring: FloatArray | None
    files: str


def _numbers(stem: Path, path: Path, listing: GroupListing) -> _Numbers:
    count = len(listing.bodies)
    matrices, waves, stiffness = (sibling(stem, suffix) for suffix in (".1", ".3", ".hst"))
    restoring = None if stiffness is None else read_restoring(stiffness, bodies=count)
    if matrices is not None and waves is not None:
        return _Numbers(
            read_radiation(matrices, bodies=count), read_waves(waves, bodies=count), restoring, ".1, .3, .out"
        )
    rows, forces = listed_tables(path, listing.lines)
    warn_caller(
        f"{path}: wave forces are read from the listing, whose phases are rounded to degrees: each is "
        "off by up "
        "to 0.9 % of its size. Give the .1 and .3 files beside it",
        RoundedPhaseWarning,
    )
    return _Numbers(radiation_of(rows, bodies=count), waves_of(forces, bodies=count), restoring, ".out alone")


def _convert(
    stem: Path,
    listing: GroupListing,
    path: Path,
    asked: float | None,
    masses: Mapping[str, ArrayLike] | None,
) -> HydroGroup:
    numbers = _numbers(stem, path, listing)
    period, heading_deg = common_periods(stem, numbers.radiation, numbers.waves, None)
    rho, g, scale = water_density(stem, listing.rho, asked), listing.g, listing.length_scale
    turns = np.tile(ROTATIONS, len(listing.bodies))
    mass_scale = rho * scale ** (3 + np.add.outer(turns, turns))
    omega = (2.0 * np.pi / period)[::-1]
    rows = np.searchsorted(numbers.radiation.period, period)[::-1]
    direction, order = wamit_directions(numbers.waves.path, heading_deg)
    limits = (numbers.radiation.infinite_frequency_added_mass, numbers.radiation.zero_frequency_added_mass)
    infinite, zero = (None if limit is None else limit * mass_scale for limit in limits)
    names = [body.name for body in listing.bodies]
    given = None if masses is None else of_each(path, "mass_matrices", names, masses, (6, 6))
    bodies = [
        _body(path, body, numbers.restoring, i, (rho, g, scale), None if given is None else given[i])
        for i, body in enumerate(listing.bodies)
    ]
    added_mass = numbers.radiation.added_mass[rows] * mass_scale
    force = WavePicker(period, heading_deg, order).pick(numbers.waves)
    lids = ", ".join(f"{body.name} {body.lid_panels}" for body in listing.bodies)
    return HydroGroup(
        name=stem.name,
        bodies=tuple(bodies),
        omega=omega,
        heading=direction,
        added_mass=added_mass,
        damping=numbers.radiation.damping[rows] * mass_scale * omega[:, None, None],
        infinite_frequency_added_mass=infinite,
        zero_frequency_added_mass=zero,
        force=force * rho * g * scale ** (2 + turns),
        rho=rho,
        g=g,
        depth=listing.depth,
        port_starboard_symmetric=group_symmetric(bodies, added_mass),
        origin="origin of WAMIT's global axes, on the still waterline",
        source=f"WAMIT {listing.version} files {stem.name} ({numbers.files}); interior lid panels: {lids}",
    )


def _body(
    path: Path,
    body: ListedBody,
    whole: FloatArray | None,
    index: int,
    water: tuple[float, float, float],
    mass: FloatArray | None,
) -> GroupBody:
    rho, g, scale = water
    restoring = body.restoring * rho * g
    if whole is not None:
        at = slice(6 * index, 6 * index + 6)
        power = 2 + np.add.outer(ROTATIONS, ROTATIONS)
        restoring = whole[at, at] * rho * g * scale**power
    box = box_of(path, body.name, restoring, body.volume, rho * g)
    if mass is None:
        mass = usual_mass_matrix(
            path,
            f"no mass matrix of {body.name}, give read_wamit_group(mass_matrices=...)",
            mass=rho * body.volume,
            centre=body.gravity,
            length=box["length"],
            breadth=box["breadth"],
        )
    return GroupBody(
        name=body.name,
        position=body.position,
        heading=body.heading,
        mass_matrix=mass,
        restoring=restoring,
        **box,
    )


def _can_open(path: Path) -> bool:
    if path.is_dir() or path.suffix.lower() == ".out" or is_wamit(path):
        try:
            stem = _stem_of(path)
        except FileFormatError:
            return False
        listing = sibling(stem, ".out")
        return listing is not None and count_bodies(listing) > 1
    return False


FORMAT = Format(
    name="WAMIT",
    files="a WAMIT folder, stem or file (.1 .3 .hst .out, with .4, .frc and .8, .9 or .12d)",
    can_open=_can_open,
    read=of_one_speed(read_wamit_group),
    speeds=zero_speed,
)
