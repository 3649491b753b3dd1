"""Reader of OrcaFlex vessel types (``.yml`` text models) and of MaFreDo's ``.dhyd`` files.

Axes and wave directions are ours; te and kN become kg and N; phases that lag are conjugated to
exp(+i omega t). Loads and motions are moved to the reference origin of the matrices, where waves get zero
phase: a wave of zero phase at r from there is ahead by ``k . r``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from os import PathLike
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seacrane.errors import FileFormatError
from seacrane.hydro.data.reading import reading
from seacrane.hydro.data.rigid_mass import cross_matrix, rigid_mass_matrix
from seacrane.hydro.database.database import HydroDatabase
from seacrane.hydro.readers.as_read import as_read, finished, frequencies_kept, mass_of_file
from seacrane.hydro.readers.format import Format, is_file_of
from seacrane.hydro.readers.mafredo_file import read_mafredo
from seacrane.hydro.readers.of_bodies import equivalent_box
from seacrane.hydro.readers.orcaflex_model import KILO, Raos, VesselType, read_vessel_type
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.shown import shown
from seacrane.sea.dispersion import wavenumber
from seacrane.warnings import AssumedDensityWarning, PartialSetWarning

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

GRAVITY = 9.80665  # m/s2, OrcaFlex's
USUAL_DENSITY = 1025.0
SUFFIXES = (".yml", ".yaml", ".dhyd")
FORE_AFT = np.array([-1.0, 1.0, 1.0, 1.0, -1.0, -1.0])
MIRRORS = {
    "None": (False, False),
    "xz plane": (True, False),
    "yz plane": (False, True),
    "xz and yz planes": (True, True),
}  # port against starboard, bow against stern
SAME_FREQUENCY = 1e-6
MOTION_LIMIT = np.full(6, 1e-3)


@dataclass(frozen=True, eq=False)
class _Source:
    """What both kinds of file give, SI, about one reference origin, loads by (heading, frequency, motion)."""

    name: str
    source: str
    origin: str
    symmetry: str
    omega: FloatArray
    added_mass: FloatArray
    damping: FloatArray
    heading_deg: FloatArray
    load_omega: FloatArray
    force: ComplexArray
    rho: float
    motion: ComplexArray | None = None
    mass_matrix: FloatArray | None = None
    restoring: FloatArray | None = None
    linear_damping: FloatArray = field(default_factory=lambda: np.zeros((6, 6)))
    quadratic_damping: FloatArray = field(default_factory=lambda: np.zeros(6))
    depth: float = np.inf
    length: float | None = None
    displaced: float | None = None


def read_orcaflex(
    path: str | PathLike[str],
    *,
    mass_matrix: ArrayLike | None = None,
    restoring: ArrayLike | None = None,
    vessel_type: str | None = None,
    draught: str | None = None,
    rho: float | None = None,
    motions: Sequence[str] | None = None,
    leave_out: ArrayLike | None = None,
) -> HydroDatabase:
    """Read a vessel type of an OrcaFlex text model (``.yml``), or a ``.dhyd`` file of MaFreDo.

    Parameters
    ----------
    path : the file. ``.yml`` needs PyYAML (``pip install seacrane[orcaflex]``).
    mass_matrix, restoring : (6, 6) in SI about the reference origin; they take the place of mass, inertia and
        hydrostatic stiffness of a ``.yml`` file, and are needed for ``.dhyd``, which holds neither.
    vessel_type, draught : names, needed where a model holds several.
    rho : water density in kg/m3 in place of the model's, which is 1025 where it gives none.
    motions : names of those that were solved for, where some were not: a motion without added mass and
        damping is refused unless it is left out here.
    leave_out : rad/s of frequencies to do without, such as those at which a solution failed.

    Returns
    -------
    HydroDatabase : zero speed; with the displacement RAOs, where they are on the grid of the load RAOs, as
        `motion_rao`. Other damping of the vessel type is in ``linear_damping`` and ``quadratic_damping``.

    Warns
    -----
    AssumedDensityWarning : no density in the file and none given.
    AssumedSymmetryWarning : a ``.dhyd`` file of an old version, which does not name its symmetry.
    PartialSetWarning : matrices and load RAOs are not given at the same frequencies, or displacement RAOs on
        another grid.

    Raises
    ------
    FileFormatError : missing, damaged, of conventions that are not read, or without mass or stiffness; the
        message names the file and the place.
    """
    source = Path(path)
    if not source.is_file():
        raise FileFormatError(f"{source}: no such file; give the path of a .yml or .dhyd file")
    with reading(source):
        if source.suffix.lower() == ".dhyd":
            found = _mafredo(source, rho)
        else:
            kind = read_vessel_type(source, vessel_type=vessel_type, draught=draught)
            found = _orcaflex(source, kind, rho)
        made = _database(source, found, mass_matrix, restoring, leave_out)
        database = as_read(source, "read_orcaflex", made, motions)
    return finished(source, database, "restoring")


def _density(path: Path, given: float | None) -> float:
    if given is not None:
        if not 0.0 < float(given) < np.inf:
            raise FileFormatError(f"{path}: water density is {given:g} kg/m3; give a positive one")
        return float(given)
    warn_caller(
        f"{path}: holds no water density; 1025 kg/m3 is taken for the size of the hull and the self-check. "
        "Pass rho to read_orcaflex",
        AssumedDensityWarning,
    )
    return USUAL_DENSITY


def _orcaflex(path: Path, kind: VesselType, rho: float | None) -> _Source:
    """A vessel type about the reference origin of its matrices."""
    loads, motions = kind.loads, kind.motions
    if motions is not None and not all(
        np.array_equal(getattr(loads, name), getattr(motions, name)) for name in ("heading_deg", "omega")
    ):
        warn_caller(
            f"{path}: displacement RAOs are not at the directions and frequencies of the load RAOs; they are "
            "left out, and nothing proves that loads and matrices belong together",
            PartialSetWarning,
        )
        motions = None
    rho = _density(path, kind.rho if rho is None else rho)
    mass_matrix = None
    if kind.mass is not None:
        mass_matrix = rigid_mass_matrix(kind.mass, kind.centre - kind.origin, kind.inertia)
    restoring = None
    if kind.stiffness is not None:
        restoring = np.zeros((6, 6))
        restoring[2:5, 2:5] = kind.stiffness
    lever = kind.other_origin - kind.origin
    if np.any(kind.other_quadratic) and np.any(lever):
        raise FileFormatError(
            f"{path}: quadratic other damping acts at {lever.tolist()} m from the reference origin; only "
            "damping at that origin is read: move it there"
        )

    def phase(raos: Raos) -> ComplexArray:
        """From zero phase at the RAOs' phase origin to zero phase at the reference origin."""
        return _shift(raos.phase_origin - kind.origin, raos.omega, raos.heading_deg, kind.depth)

    turned = _moved(lever)
    x, y, z = kind.origin
    return _Source(
        name=path.stem,
        source=f"OrcaFlex model {path.name}, {kind.name}",
        origin=f"reference origin of the OrcaFlex vessel type, ({x:g}, {y:g}, {z:g}) m in its axes",
        symmetry=kind.symmetry,
        omega=kind.omega,
        added_mass=kind.added_mass,
        damping=kind.damping,
        heading_deg=loads.heading_deg,
        load_omega=loads.omega,
        force=loads.values @ _moved(loads.origin - kind.origin).T * phase(loads),
        motion=None
        if motions is None
        else motions.values @ _moved(kind.origin - motions.origin) * phase(motions),
        mass_matrix=mass_matrix,
        restoring=restoring,
        linear_damping=turned @ np.diag(kind.other_linear) @ turned.T,
        quadratic_damping=kind.other_quadratic,
        rho=rho,
        depth=kind.depth,
        length=kind.length,
        displaced=None if kind.volume is None else rho * kind.volume,
    )


def _moved(lever: FloatArray) -> FloatArray:
    """Matrix (6, 6) from a load at ``lever`` to the load at the origin: moments gain lever x force."""
    matrix = np.eye(6)
    matrix[3:, :3] = cross_matrix(lever)
    return matrix


def _shift(r: FloatArray, omega: FloatArray, heading_deg: FloatArray, depth: float) -> ComplexArray:
    """``exp(-i k . r)`` (m, n, 1) for a phase origin at ``r`` (x, y, ...) from the reference point."""
    beta = np.radians(heading_deg)
    along = r[0] * np.cos(beta) + r[1] * np.sin(beta)
    k = np.zeros(len(omega))
    usual = (omega > 0.0) & np.isfinite(omega)
    k[usual] = wavenumber(omega[usual], g=GRAVITY, depth=depth)
    return np.asarray(np.exp(-1j * np.outer(along, k))[:, :, None])


def _mafredo(path: Path, rho: float | None) -> _Source:
    """A ``.dhyd`` file about the point that all of it refers to."""
    data = read_mafredo(path)
    shift = _shift(data.phase_origin, data.load_omega, data.heading_deg, np.inf)
    with np.errstate(invalid="ignore"):  # what is not finite is named later, if it is used at all
        force = np.conj(data.force) * KILO * shift
    return _Source(
        name=path.stem,
        source=f"MaFreDo file {path.name}",
        origin="reference point of the MaFreDo database",
        symmetry=data.symmetry,
        omega=data.omega,
        added_mass=data.added_mass * KILO,
        damping=data.damping * KILO,
        heading_deg=data.heading_deg,
        load_omega=data.load_omega,
        force=force,
        rho=_density(path, rho),
    )


def _database(
    path: Path,
    found: _Source,
    mass_matrix: ArrayLike | None,
    restoring: ArrayLike | None,
    leave_out: ArrayLike | None,
) -> HydroDatabase:
    mass = _given(path, "mass_matrix", mass_matrix, found.mass_matrix)
    stiffness = _given(path, "restoring", restoring, found.restoring)
    if mass_matrix is None:
        asked = "read_orcaflex(mass_matrix=...)"
        box = equivalent_box(stiffness, float(mass[0, 0]) / found.rho, found.rho * GRAVITY)
        mass = mass_of_file(path, asked, mass, displaced=found.displaced, box=box)
    rows, columns = _common(path, found)
    tables = {
        "added_mass": found.added_mass[rows],
        "damping": found.damping[rows],
        "force": found.force[:, columns],
    }
    kept = frequencies_kept(path, "read_orcaflex", found.omega[rows], tables, leave_out)
    rows, columns = rows[kept], columns[kept]
    omega = found.omega[rows]
    heading, force, motion, symmetric = _circle(path, found, columns)
    box = equivalent_box(stiffness, float(mass[0, 0]) / found.rho, found.rho * GRAVITY)
    return HydroDatabase(
        name=found.name,
        omega=omega,
        heading=heading,
        added_mass=found.added_mass[rows],
        damping=found.damping[rows],
        infinite_frequency_added_mass=_limit(found.added_mass, np.isinf(found.omega)),
        zero_frequency_added_mass=_limit(found.added_mass, found.omega == 0.0),
        restoring=stiffness,
        mass_matrix=mass,
        force=force,
        motion_rao=motion,
        motion_rao_limit=MOTION_LIMIT,
        linear_damping=found.linear_damping,
        quadratic_damping=found.quadratic_damping,
        rho=found.rho,
        g=GRAVITY,
        depth=found.depth,
        length=box[0] if found.length is None else found.length,
        breadth=box[1],
        draught=box[2],
        origin=found.origin,
        source=found.source,
        port_starboard_symmetric=symmetric,
    )


def _given(path: Path, name: str, given: ArrayLike | None, in_file: FloatArray | None) -> FloatArray:
    """A constant matrix (6, 6): the caller's, else the file's."""
    if given is None and in_file is None:
        raise FileFormatError(f"{path}: holds no {name}; pass {name} (6, 6) in SI to read_orcaflex")
    matrix = np.asarray(in_file if given is None else given, dtype=float)
    if matrix.shape != (6, 6):
        raise ValueError(f"{name} has shape {matrix.shape}; (6, 6) is needed")
    return matrix


def _common(path: Path, found: _Source) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Places of the finite positive frequencies that matrices and loads share, rising."""
    rows, columns = [], []
    usual = [(w > 0.0) & np.isfinite(w) for w in (found.omega, found.load_omega)]
    for row in np.flatnonzero(usual[0])[np.argsort(found.omega[usual[0]])]:
        near = np.flatnonzero(
            np.abs(found.load_omega - found.omega[row]) <= SAME_FREQUENCY * found.omega[row]
        )
        if near.size:
            rows.append(row)
            columns.append(near[0])
    if not rows:
        raise FileFormatError(f"{path}: matrices and load RAOs have no frequency in common; check the source")
    left_out = int(usual[0].sum() + usual[1].sum()) - 2 * len(rows)
    if left_out:
        warn_caller(
            f"{path}: {left_out} frequencies are given for either the matrices or the load RAOs only; the "
            f"{len(rows)} common ones are read, and nothing is known beyond them",
            PartialSetWarning,
        )
    return np.array(rows), np.array(columns)


def _circle(
    path: Path, found: _Source, columns: NDArray[np.intp]
) -> tuple[FloatArray, ComplexArray, ComplexArray | None, bool]:
    """Directions in [0, 2 pi), rising, with loads and motions; mirrored where bow and stern are alike."""
    if found.symmetry not in MIRRORS:
        raise FileFormatError(
            f"{path}: symmetry {shown(found.symmetry)}; {', '.join(MIRRORS)} are read: expand the directions"
        )
    port, bow = MIRRORS[found.symmetry]
    degrees, force, motion = found.heading_deg, found.force[:, columns], found.motion
    motion = None if motion is None else motion[:, columns]
    if bow:
        degrees = np.concatenate([degrees, 180.0 - degrees])
        force = np.concatenate([force, force * FORE_AFT])
        motion = None if motion is None else np.concatenate([motion, motion * FORE_AFT])
    wrapped = np.round(np.mod(degrees, 360.0), 6) % 360.0
    wrapped, order = np.unique(wrapped, return_index=True)
    return np.radians(wrapped), force[order], None if motion is None else motion[order], port


def _limit(matrices: FloatArray, where: NDArray[np.bool_]) -> FloatArray | None:
    """The matrix at a limiting frequency, if there is one; MaFreDo's empty databases start with zeros."""
    found = matrices[where]
    return found[0] if len(found) and np.any(found[0]) else None


FORMAT = Format(
    name="OrcaFlex",
    files="an OrcaFlex model (.yml) or MaFreDo file (.dhyd)",
    can_open=lambda path: is_file_of(path, SUFFIXES),
    read=read_orcaflex,
)
