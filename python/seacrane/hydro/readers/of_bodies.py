"""What a reader makes of the bodies of a file: the database of one, or the group of several."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.arrays import Array
from seacrane.errors import FileFormatError
from seacrane.hydro.data.heading_circle import keeps_sides_apart, phase_at
from seacrane.hydro.data.hydro_group_data import GroupBody
from seacrane.hydro.database.database import HydroDatabase
from seacrane.hydro.group.group import HydroGroup
from seacrane.hydro.readers.as_read import (
    Asked,
    Given,
    frequencies_kept,
    mass_of_file,
    mirrored,
    require_own_hydrostatics,
    require_solved,
    warn_of_turning_over,
    whole_stiffness,
    with_band_of_data,
)
from seacrane.hydro.readers.format import Loaded
from seacrane.inputs.caller import warn_caller
from seacrane.warnings import AssumedDensityWarning

USUAL_DENSITY = 1025.0
LIMITS = {"infinite_frequency_added_mass": np.inf, "zero_frequency_added_mass": 0.0}
SYMMETRIC = ("added_mass", "damping", *LIMITS)
OWN = ("mass_matrix", "restoring", "linear_damping", "quadratic_damping", "length", "breadth", "draught")


def hull_or_group(
    asked: Asked,
    bodies: Sequence[GroupBody],
    *,
    fix: str,
    omega: Array,
    waves_from: Sequence[float] | Array = (0.0, 0.0),
    alone: Mapping[str, Any] | None = None,
    at: Sequence[float] | None = None,
    **tables: Any,
) -> Loaded:
    """The database of one body, with zero phase at its reference point, or the group of several.

    Halves of matrices are completed, and what has no trusted band has one up to the first jump.

    Parameters
    ----------
    fix : what the caller gives in place of hydrostatics that are another's.
    omega : (n,) rad/s in any order; what stands at 0 and infinity is a limit of the added mass.
    waves_from : (x, y) m from the origin of the bodies' places, where waves have zero phase.
    alone : what a database of one body has besides.
    at : (3,) m, where a body alone is moved to.
    tables : what both hold: name, source, origin, headings, matrices, forces and water.

    Raises FileFormatError: as the checks of `as_read`.
    """
    one = bodies[0] if len(bodies) == 1 else None
    if one is not None:
        tables |= {name: getattr(one, name) for name in OWN} | dict(alone or {})
    for name, limit in LIMITS.items():
        tables.setdefault(name, matrix_at(tables["added_mass"], omega == limit))
    rows = frequencies_kept(asked, omega, tables)
    omega = omega[rows]
    tables |= {name: tables[name][rows] for name in ("added_mass", "damping")}
    tables |= {key: tables[key][:, rows] for key in ("force", "motion_rao") if tables.get(key) is not None}
    away = np.subtract((0.0, 0.0) if one is None else one.position[:2], waves_from)
    if away.any():
        water = {"g": tables["g"], "depth": tables["depth"]}
        tables["force"] = tables["force"] * phase_at(away, omega, tables["heading"], **water)
    on_axis = all(body.position[1] == 0.0 and body.heading == 0.0 for body in bodies)
    tables.setdefault("port_starboard_symmetric", on_axis and keeps_sides_apart(tables["added_mass"]))
    tables |= {name: mirrored(tables[name]) for name in SYMMETRIC if tables[name] is not None}
    if one is None:
        whole = tuple(replace(body, restoring=whole_stiffness(body.restoring)) for body in bodies)
        group = HydroGroup(omega=omega, bodies=whole, **tables)
        require_solved(asked, group)
        require_own_hydrostatics(asked.where, group, fix)
        return with_band_of_data(group)
    found = HydroDatabase(omega=omega, **tables | {"restoring": whole_stiffness(one.restoring)})
    require_solved(asked, found)
    warn_of_turning_over(asked.where, found)
    return with_band_of_data(found if at is None else replace(found.at(at), origin=found.origin))


def matrix_at(matrices: Array, where: NDArray[np.bool_]) -> Array | None:
    """The matrix at a limiting frequency, if there is one; where nothing was solved there are zeros."""
    found = matrices[where]
    return found[0] if len(found) and np.all(np.isfinite(found)) and np.any(found[0]) else None


def floating_body(
    asked: Asked,
    name: str,
    *,
    several: bool,
    restoring: Array,
    water: tuple[float, float],
    mass: Array | None,
    volume: float | None = None,
    displaced: float | None = None,
    where: Path | None = None,
    **others: Any,
) -> GroupBody:
    """A body with its equivalent box.

    Parameters
    ----------
    water : density and gravity, kg/m3 and m/s2.
    mass : (6, 6), or None where neither the file nor the caller tells it.
    volume : m3; None: that of the mass.
    displaced : m3, where the file tells it beside such a mass.
    where : the file of its hydrostatics, for messages.
    others : of `GroupBody`; sizes that the file tells take the place of the box's, where they are not None.

    Raises FileFormatError: as `box_of` and `mass_of_file`.
    """
    where, rho, of_mass = where or asked.where, water[0], volume is None
    if not (rho > 0.0 and water[1] > 0.0):
        raise FileFormatError(f"{asked.where}: rho is {rho:g} kg/m3, g {water[1]:g} m/s2; give positive ones")
    if volume is None:
        volume = np.nan if mass is None else float(mass[0, 0]) / rho
    box = box_of(where, name if several else "", restoring, volume, rho * water[1])
    if mass is not None and (of_mass or asked.mass_matrix is not None):
        floats = displaced if of_mass else volume
        mass = mass_of_file(
            asked, mass, where=Path(f"{where}: {name}") if several else where, box=box,
            displaced=None if floats is None else rho * floats,
        )  # fmt: skip
    sizes: dict[str, Any] = dict(zip(("length", "breadth", "draught"), box, strict=True))
    sizes |= {key: value for key, value in others.items() if value is not None}
    return GroupBody(name=name, mass_matrix=mass, restoring=restoring, **sizes)


def of_each(
    asked: Asked, what: str, names: Sequence[str], given: Given | None, shape: tuple[int, ...] = (6, 6)
) -> list[Any]:
    """The caller's array of each body, in the order of the file's names, or None; one body needs no name.

    Raises FileFormatError: other names than those of the file, or another shape.
    """
    if given is None:
        return [None] * len(names)
    if not isinstance(given, Mapping) and len(names) == 1:
        given = {names[0]: given}
    if not isinstance(given, Mapping) or set(given) != set(names):
        told = ", ".join(map(str, given))[:200] if isinstance(given, Mapping) else "none by name"
        raise FileFormatError(
            f"{asked.where}: holds bodies {', '.join(names)[:200]}; {what} is given for {told or 'none'}: "
            "name each of them"
        )
    arrays = [np.array(given[name], dtype=float) for name in names]
    for name, array in zip(names, arrays, strict=True):
        if array.shape != shape or not np.all(np.isfinite(array)):
            raise FileFormatError(
                f"{asked.where}: {what} of {name} has shape {array.shape}; {shape} finite numbers"
            )
    return arrays


def box_of(
    where: Path, name: str, restoring: Array, volume: float, weight_density: float
) -> tuple[float, float, float]:
    """Length, breadth, draught (m) of the floating box that C33, C55 (6, 6) and the volume (m3) describe.

    A box has ``C55 / C33 = L^2 / 12`` but for the small term of the heights of buoyancy and gravity,
    waterplane ``C33 / (rho g) = L B`` and volume ``L B T``. ``weight_density`` is rho g in N/m3. A pointed
    ship comes out shorter than it is (246 m as 226 m): good enough for scales, not for geometry. Where C55 is
    not positive, of a hull that turns over by itself, it tells no length: the box is as broad as long.

    Raises FileFormatError: nothing floats on such a waterplane; or, where there is a ``name`` among several,
    C55 may be that of all together.
    """
    heave, pitch = float(restoring[2, 2]), float(restoring[4, 4])
    area = heave / weight_density if weight_density > 0.0 else 0.0
    length = float(np.sqrt(12.0 * pitch / heave if pitch > 0.0 else area)) if heave > 0.0 else 0.0
    told = ""
    if name and not pitch > 0.0:
        told = "both have to be positive in a group: check whether they are this body's own"
    elif heave <= 0.0:
        told = "the first has to be positive for a floating vessel: check the hydrostatics"
    elif not (0.0 < area < np.inf and 0.0 < length < np.inf):
        told = f"no box floats so in water of {weight_density:.6g} N/m3: check density and hydrostatics"
    if told:
        raise FileFormatError(
            f"{where}: {f'body {name}: ' if name else ''}restoring C33 = {heave:.6g} N/m and C55 = "
            f"{pitch:.6g} N m/rad; {told}"
        )
    return length, area / length, volume / area


def density_of(asked: Asked, given: float | None, consequence: str) -> float:
    """kg/m3 of the water, as given by file or caller; else the usual one, with a warning."""
    if given is None:
        warn_caller(
            f"{asked.where}: holds no water density; 1025 kg/m3 is taken, and {consequence}. Pass rho to "
            f"{asked.reader}",
            AssumedDensityWarning,
        )
        return USUAL_DENSITY
    if not 0.0 < float(given) < np.inf:
        raise FileFormatError(f"{asked.where}: water density is {given:g} kg/m3; give a positive one")
    return float(given)
