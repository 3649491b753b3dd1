"""Reader of OrcaFlex vessel types (``.yml`` text models) and of MaFreDo's ``.dhyd`` files.

Axes and wave directions are ours; te and kN become kg and N; phases that lag are conjugated to
exp(+i omega t). Loads and motions are moved to the reference origin of the matrices, where waves get zero
phase: a wave of zero phase at r from there is ahead by ``k . r``.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seacrane.arrays import Array, Complex
from seacrane.errors import FileFormatError
from seacrane.hydro.data.frozen import reading
from seacrane.hydro.data.heading_circle import phase_at
from seacrane.hydro.data.hydro_data import DriftCoefficients
from seacrane.hydro.data.rigid_mass import cross_matrix, rigid_mass_matrix
from seacrane.hydro.database.database import HydroDatabase
from seacrane.hydro.readers.as_read import Asked, rising_degrees
from seacrane.hydro.readers.format import Format, is_file_of
from seacrane.hydro.readers.of_bodies import (
    LIMITS,
    density_of,
    floating_body,
    hull_or_group,
    matrix_at,
    of_each,
)
from seacrane.hydro.readers.orcaflex_model import KILO, Raos, VesselType, read_vessel_type
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.frames import MOTIONS
from seacrane.inputs.netcdf_limits import NETCDF_ERRORS, open_netcdf
from seacrane.inputs.shown import shown
from seacrane.warnings import AssumedSymmetryWarning, PartialSetWarning

Places = NDArray[np.intp]

GRAVITY = 9.80665  # m/s2, OrcaFlex's
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
MATRIX, LOADS = ("omega", "influenced_dof", "radiating_dof"), ("wave_direction", "omega")  # of MaFreDo
SYMMETRIES = (*MIRRORS, "Circular")
WHOLE = 1e-6  # deg beyond 180 from where headings are of both sides


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
    motions, leave_out : as `read_capytaine` takes them.

    Returns
    -------
    HydroDatabase : zero speed; with the displacement RAOs, where they are on the grid of the load RAOs, as
        `motion_rao`. Other damping of the vessel type is in ``linear_damping`` and ``quadratic_damping``, its
        wave drift in ``drift``.

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
    asked = Asked(
        where=source, reader="read_orcaflex", mass_matrix=mass_matrix, restoring=restoring, motions=motions,
        leave_out=leave_out,
    )  # fmt: skip
    with reading(source):
        if source.suffix.lower() == ".dhyd":
            kind = _read_mafredo(source)
        else:
            kind = read_vessel_type(source, vessel_type=vessel_type, draught=draught)
        return _convert(asked, kind, kind.rho if rho is None else rho)


def _convert(asked: Asked, kind: VesselType, rho: float | None) -> HydroDatabase:
    """A vessel type about the reference origin of its matrices."""
    rho = density_of(asked, rho, "the size of the hull and the self-check follow from it")
    mass, restoring = _constant_matrices(asked, kind)
    lever = kind.other_origin - kind.origin
    if np.any(kind.other_quadratic) and np.any(lever):
        raise FileFormatError(
            f"{asked.where}: quadratic other damping acts at {lever.tolist()} m from the reference origin; "
            "only damping at that origin is read: move it there"
        )
    turned = _moved(lever)
    body = floating_body(
        asked, kind.name, several=False, restoring=restoring, water=(rho, GRAVITY), mass=mass,
        displaced=kind.volume, position=np.zeros(3), length=kind.length,
        linear_damping=turned @ np.diag(kind.other_linear) @ turned.T, quadratic_damping=kind.other_quadratic,
    )  # fmt: skip
    loads, motions = kind.loads, kind.motions
    if motions is not None and not all(
        np.array_equal(getattr(loads, name), getattr(motions, name)) for name in ("heading_deg", "omega")
    ):
        warn_caller(
            f"{asked.where}: displacement RAOs are not at the directions and frequencies of the load RAOs; "
            "they are left out, and nothing proves that loads and matrices belong together",
            PartialSetWarning,
        )
        motions = None
    if kind.symmetry not in MIRRORS:
        raise FileFormatError(
            f"{asked.where}: symmetry {shown(kind.symmetry)}; {', '.join(MIRRORS)} are read: expand the "
            "directions"
        )
    port, bow = MIRRORS[kind.symmetry]
    rows, columns = _common(asked.where, kind)
    tables = {"force": _at_origin(kind, loads, _moved(loads.origin - kind.origin).T, columns)}
    if motions is not None:
        moved = _moved(kind.origin - motions.origin)
        tables["motion_rao"] = _at_origin(kind, motions, moved, columns)
    heading, tables = _all_round(loads.heading_deg, tables, bow)
    found = hull_or_group(
        asked, [body], fix="restoring", alone={
            **tables,
            **{name: matrix_at(kind.added_mass, kind.omega == limit) for name, limit in LIMITS.items()},
            "motion_rao_limit": MOTION_LIMIT,
            "drift": _drift(kind, bow),
            "port_starboard_symmetric": port,
        },
        name=asked.where.stem, origin=kind.place, source=kind.source,
        rho=rho, g=GRAVITY, depth=kind.depth, omega=kind.omega[rows], heading=heading,
        added_mass=kind.added_mass[rows], damping=kind.damping[rows],
    )  # fmt: skip
    assert isinstance(found, HydroDatabase)
    return found


def _all_round(degrees: Array, tables: Mapping[str, Any], bow: bool) -> tuple[Array, dict[str, Any]]:
    """Directions in rad, rising, and tables (m, n, 6) of them; of both ends where they are alike."""
    if bow:
        degrees = np.concatenate([degrees, 180.0 - degrees])
        tables = {name: np.concatenate([table, table * FORE_AFT]) for name, table in tables.items()}
    degrees, order = rising_degrees(degrees)
    return np.radians(degrees), {name: table[order] for name, table in tables.items()}


def _drift(kind: VesselType, bow: bool) -> DriftCoefficients | None:
    """Mean drift about the reference origin."""
    told = kind.drift
    if told is None or not len(told.omega):
        return None
    load = told.values @ _moved(told.origin - kind.origin).T
    heading, tables = _all_round(told.heading_deg, {"coefficient": load}, bow)
    return DriftCoefficients(heading=heading, omega=told.omega, **tables)


def _constant_matrices(asked: Asked, kind: VesselType) -> tuple[Array, Array]:
    """Mass matrix and restoring (6, 6): the caller's, else the file's."""
    told: dict[str, Array | None] = {"mass_matrix": None, "restoring": None}
    if kind.mass is not None:
        told["mass_matrix"] = rigid_mass_matrix(kind.mass, kind.centre - kind.origin, kind.inertia)
    if kind.stiffness is not None:
        told["restoring"] = np.pad(kind.stiffness, (2, 1))
    found: list[Any] = []
    for name, in_file in told.items():
        (given,) = of_each(asked, name, [kind.name], getattr(asked, name))
        if given is None and in_file is None:
            raise FileFormatError(f"{asked.where}: holds no {name}; pass it, (6, 6) in SI, to read_orcaflex")
        found.append(in_file if given is None else given)
    return found[0], found[1]


def _moved(lever: Array) -> Array:
    """Matrix (6, 6) from a load at ``lever`` to the load at the origin: moments gain lever x force."""
    matrix = np.eye(6)
    matrix[3:, :3] = cross_matrix(lever)
    return matrix


def _at_origin(kind: VesselType, raos: Raos, moved: Array, columns: Places) -> Complex:
    """Loads or motions (m, n, 6) about the reference origin, where waves get zero phase."""
    away = kind.origin - raos.phase_origin
    headings = np.radians(raos.heading_deg)
    with np.errstate(invalid="ignore"):  # what is not finite is named later
        turned = raos.values[:, columns] @ moved
        return np.asarray(turned * phase_at(away, raos.omega[columns], headings, GRAVITY, kind.depth))


def _common(path: Path, kind: VesselType) -> tuple[Places, Places]:
    """Places of the finite positive frequencies that matrices and loads share, rising."""
    usual = [np.flatnonzero((w > 0.0) & np.isfinite(w)) for w in (kind.omega, kind.loads.omega)]
    rows = usual[0][np.argsort(kind.omega[usual[0]])]
    omega = kind.omega[rows, None]
    near = np.abs(kind.loads.omega[usual[1]] - omega) <= SAME_FREQUENCY * omega
    common = near.any(axis=1)
    if not common.any():
        raise FileFormatError(f"{path}: matrices and load RAOs have no frequency in common; check the source")
    left_out = len(rows) + len(usual[1]) - 2 * int(common.sum())
    if left_out:
        warn_caller(
            f"{path}: {left_out} frequencies are given for either the matrices or the load RAOs only; the "
            f"{common.sum()} common ones are read, and nothing is known beyond them",
            PartialSetWarning,
        )
    return rows[common], usual[1][near[common].argmax(axis=1)]


def _read_mafredo(path: Path) -> VesselType:
    """A ``.dhyd`` file: NetCDF in te and kN, phases that lag, without mass and stiffness.

    Groups ``mass`` and ``damping`` hold one array each, ``Surge`` to ``Yaw`` real and imaginary part of the
    loads, ``info`` symmetry and phase origin, forward and to port of what loads and matrices refer to.
    """
    with reading(path, "a MaFreDo database", NETCDF_ERRORS), open_netcdf(path) as file:
        matrices = [_mafredo_matrices(file[name]) for name in ("mass", "damping")]
        groups = [file[motion.capitalize()] for motion in MOTIONS]
        grids = [[_coordinate(group[name]) for name in LOADS] for group in groups]
        omega, (degrees, load_omega) = _coordinate(file["mass"]["omega"]), grids[0]
        if not np.array_equal(omega, _coordinate(file["damping"]["omega"])):
            raise ValueError("added mass and damping have different frequencies")
        for motion, grid in zip(MOTIONS, grids, strict=True):
            if not all(map(np.array_equal, grid, grids[0])):
                raise ValueError(f"loads in {motion} and surge have different frequencies or directions")
        parts = [[_by_names(group[part], LOADS) for group in groups] for part in ("real", "imag")]
        real, imaginary = (np.stack(part, axis=-1) for part in parts)
        force = np.asarray(np.conj(real + 1j * imaginary) * KILO, dtype=complex)
        info = file.groups["info"].variables if "info" in file.groups else {}
        places = ("phase_origin_0", "phase_origin_1")
        origin = [float(info[name][...]) if name in info else 0.0 for name in places]
        if not np.isfinite(origin).all():
            raise ValueError(f"phase_origin is {origin}")
        if "symmetry" in info:
            symmetry = SYMMETRIES[int(np.asarray(info["symmetry"][...]))]
        else:  # of old versions
            one_side = bool(np.all(np.mod(degrees, 360.0) <= 180.0 + WHOLE))
            symmetry = "xz plane" if one_side else "None"
            warn_caller(
                f"{path}: does not say which symmetry the vessel has; with directions up to "
                f"{degrees.max():g} deg {symmetry!r} is taken, and loads from the other side follow from "
                "that guess",
                AssumedSymmetryWarning,
            )
    return VesselType(
        name=path.stem, source=f"MaFreDo file {path.name}", place="reference point of the MaFreDo database",
        symmetry=symmetry, omega=omega, added_mass=matrices[0] * KILO, damping=matrices[1] * KILO,
        loads=Raos(degrees, load_omega, force, np.zeros(3), np.array([*origin, 0.0])),
    )  # fmt: skip


def _mafredo_matrices(group: Any) -> Array:
    """The group's array (n, 6, 6) with the influenced motion first, in the order of our motions."""
    found = [variable for variable in group.variables.values() if set(variable.dimensions) == set(MATRIX)]
    if len(found) != 1:
        raise ValueError(f"group {group.name} holds {len(found)} arrays by {', '.join(MATRIX)}")
    array = _by_names(found[0], MATRIX)
    for axis, name in enumerate(MATRIX[1:], start=1):
        labels = [str(label).lower() for label in np.asarray(group[name][...]).tolist()]
        words = MOTIONS if labels[0] in MOTIONS else tuple(str(i) for i in range(6))
        if sorted(labels) != sorted(words):
            raise ValueError(f"{name} holds {', '.join(labels)[:200]}; six motions are needed")
        array = np.take(array, [labels.index(word) for word in words], axis=axis)
    return array


def _by_names(variable: Any, order: tuple[str, ...]) -> Array:
    """A variable's numbers with its dimensions in that order."""
    axes = [variable.dimensions.index(name) for name in order]
    return np.asarray(variable[...], dtype=float).transpose(axes)


def _coordinate(variable: Any) -> Array:
    """A list of finite numbers (infinity excepted for frequencies)."""
    values = np.ravel(np.asarray(variable[...], dtype=float))
    if values.size == 0 or np.any(np.isnan(values)) or np.any(np.isneginf(values)):
        raise ValueError(f"{variable.name} is empty or holds undefined values")
    return values


FORMAT = Format(
    name="OrcaFlex",
    files="an OrcaFlex model (.yml) or MaFreDo file (.dhyd)",
    looks="`%YAML 1.1`, `VesselTypes:`; MaFreDo's groups `mass`, `damping`, `Surge` to `Yaw`",
    can_open=lambda path: is_file_of(path, SUFFIXES),
    read=read_orcaflex,
    takes=("mass_matrix",),
)
