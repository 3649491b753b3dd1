"""What a reader makes of the bodies of a file: the database of one, or the group of several."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seacrane.errors import FileFormatError
from seacrane.hydro.data.heading_circle import keeps_sides_apart, phase_at
from seacrane.hydro.data.hydro_group_data import GroupBody
from seacrane.hydro.data.rigid_mass import rigid_mass_matrix
from seacrane.hydro.database.database import HydroDatabase
from seacrane.hydro.group.group import HydroGroup
from seacrane.hydro.readers.format import Loaded
from seacrane.inputs.caller import warn_caller
from seacrane.warnings import AssumedInertiaWarning

FloatArray = NDArray[np.float64]
Given = ArrayLike | Mapping[str, ArrayLike]  # of one body, or by name

ORIGIN = (0.0, 0.0)
USUAL_RADII = (0.36, 0.25, 0.25)  # of breadth, length, length


def hull_or_group(
    bodies: Sequence[GroupBody],
    *,
    force: NDArray[np.complex128],
    waves_from: Sequence[float] | FloatArray = ORIGIN,
    alone: Mapping[str, Any] | None = None,
    **tables: Any,
) -> Loaded:
    """The database of one body, with zero phase at its reference point, or the group of several.

    Parameters
    ----------
    force : (m, n, 6 k) with zero phase at ``waves_from``, (x, y) m from the origin of the bodies' places.
    alone : what a database of one body has besides.
    tables : what both hold: name, source, origin, frequencies, headings, matrices and water.
    """
    one = bodies[0] if len(bodies) == 1 else None
    away = np.subtract(ORIGIN if one is None else one.position[:2], waves_from)
    if away.any():
        water = {"g": tables["g"], "depth": tables["depth"]}
        force = force * phase_at(away, tables["omega"], tables["heading"], **water)
    on_axis = all(body.position[1] == 0.0 and body.heading == 0.0 for body in bodies)
    tables |= {
        "force": force,
        "port_starboard_symmetric": on_axis and keeps_sides_apart(tables["added_mass"]),
    }
    if one is None:
        return HydroGroup(bodies=tuple(bodies), **tables)
    own = ("mass_matrix", "restoring", "linear_damping", "length", "breadth", "draught")
    return HydroDatabase(**tables | {name: getattr(one, name) for name in own} | dict(alone or {}))


def floating_body(
    where: Path,
    name: str,
    *,
    several: bool,
    position: FloatArray,
    restoring: FloatArray,
    volume: float,
    water: tuple[float, float],
    mass: FloatArray | None,
    centre: FloatArray,
    lacks: str,
    heading: float = 0.0,
) -> GroupBody:
    """A body with its equivalent box, and with the displaced mass where it has none.

    Parameters
    ----------
    volume : m3, displaced.
    water : density and gravity, kg/m3 and m/s2.
    mass : (6, 6), or None: that of ``volume`` at ``centre`` (3,), with a warning of what the file ``lacks``.

    Raises FileFormatError: nothing floats on such a waterplane, or C55 is that of all bodies together.
    """
    rho, g = water
    length, breadth, draught = box_of(where, name if several else "", restoring, volume, rho * g)
    if mass is None:
        mass = usual_mass_matrix(
            where, lacks, mass=rho * volume, centre=centre, length=length, breadth=breadth
        )
    return GroupBody(
        name=name,
        position=position,
        heading=heading,
        mass_matrix=mass,
        restoring=restoring,
        length=length,
        breadth=breadth,
        draught=draught,
    )


def usual_mass_matrix(
    where: object, why: str, *, mass: float, centre: FloatArray, length: float, breadth: float
) -> FloatArray:
    """The displaced mass (kg) at its centre (3,), m, with usual radii of gyration: (6, 6) in SI.

    Warns
    -----
    AssumedInertiaWarning : always; the message begins with ``where`` and ``why``.
    """
    radii = np.array(USUAL_RADII) * (breadth, length, length)
    warn_caller(
        f"{where}: {why}; the displaced mass {mass:.6g} kg with radii of gyration of "
        f"{radii[0]:.3g}, {radii[1]:.3g}, {radii[2]:.3g} m (0.36 B, 0.25 L, 0.25 L) is taken, and natural "
        "periods in roll and pitch follow from that guess",
        AssumedInertiaWarning,
    )
    return rigid_mass_matrix(mass, centre, np.diag(mass * radii**2))


def of_each(
    path: Path, what: str, names: Sequence[str], given: Given, shape: tuple[int, ...]
) -> list[FloatArray]:
    """The caller's array of each body, in the order of the file's names; of one body it needs no name.

    Raises FileFormatError: other names than those of the file, or another shape.
    """
    if not isinstance(given, Mapping) and len(names) == 1:
        given = {names[0]: given}
    if not isinstance(given, Mapping) or set(given) != set(names):
        told = ", ".join(map(str, given))[:200] if isinstance(given, Mapping) else "none by name"
        raise FileFormatError(
            f"{path}: holds bodies {', '.join(names)[:200]}; {what} is given for {told or 'none'}: name each "
            "of them"
        )
    arrays = [np.array(given[name], dtype=float) for name in names]
    for name, array in zip(names, arrays, strict=True):
        if array.shape != shape or not np.all(np.isfinite(array)):
            raise FileFormatError(f"{path}: {what} of {name} has shape {array.shape}; {shape} finite numbers")
    return arrays


def of_each_or_none(
    path: Path, what: str, names: Sequence[str], given: Given | None
) -> list[FloatArray] | list[None]:
    """`of_each` of matrices (6, 6), or None of each body where the caller gives nothing."""
    return [None] * len(names) if given is None else of_each(path, what, names, given, (6, 6))


def box_of(
    path: Path, name: str, restoring: FloatArray, volume: float, weight_density: float
) -> tuple[float, float, float]:
    """Length, breadth and draught of a body's equivalent box, m; ``name``: of one among several.

    Raises FileFormatError: nothing floats on such a waterplane, or C55 is that of all bodies together.
    """
    if name and not restoring[4, 4] > 0.0:
        raise FileFormatError(
            f"{path}: body {name}: restoring C33 = {restoring[2, 2]:.6g} N/m and C55 = {restoring[4, 4]:.6g} "
            "N m/rad; both have to be positive in a group: check whether they are this body's own"
        )
    try:
        return equivalent_box(restoring, volume, weight_density)
    except ValueError as error:
        raise FileFormatError(f"{path}: {f'body {name}: ' if name else ''}{error}") from error


def equivalent_box(restoring: FloatArray, volume: float, weight_density: float) -> tuple[float, float, float]:
    """Length, breadth, draught (m) of the floating box that C33, C55 (6, 6) and the volume (m3) describe.

    A box has ``C55 / C33 = L^2 / 12`` but for the small term of the heights of buoyancy and gravity,
    waterplane ``C33 / (rho g) = L B`` and volume ``L B T``. ``weight_density`` is rho g in N/m3. A pointed
    ship comes out shorter than it is (246 m as 226 m): good enough for scales, not for geometry. Where C55 is
    not positive, of a hull that turns over by itself, it tells no length: the box is as broad as long.

    Raises ValueError: C33 is not positive: nothing floats on this waterplane.
    """
    heave, pitch = float(restoring[2, 2]), float(restoring[4, 4])
    if heave <= 0.0:
        raise ValueError(
            f"restoring C33 = {heave:.6g} N/m and C55 = {pitch:.6g} N m/rad; the first has to be positive "
            "for a floating vessel: check the hydrostatics"
        )
    area = heave / weight_density if weight_density > 0.0 else 0.0
    length = float(np.sqrt(12.0 * pitch / heave)) if pitch > 0.0 else float(np.sqrt(area))
    if not (0.0 < area < np.inf and 0.0 < length < np.inf):
        raise ValueError(
            f"C33 = {heave:.6g} N/m and C55 = {pitch:.6g} N m/rad with {weight_density:.6g} N/m3 of water "
            "are of no floating box: check density, gravity and hydrostatics"
        )
    return length, area / length, volume / area
