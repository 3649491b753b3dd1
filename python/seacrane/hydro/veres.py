"""Reader of ShipX/VERES results: ``.re7`` (matrices), ``.re8`` (excitation), ``.re1`` (motions).

File axes are x aft, y starboard, z up; heading 0 is head sea; time factor exp(+i omega t); LCG positive aft
of midship; everything refers to the motion point (xmtn aft of midship, centreline, zmtn above the baseline),
which is also where waves have zero phase. To ours: diag(-1, -1, 1, -1, -1, 1), and direction = heading + 180
degrees.
"""

from __future__ import annotations

from dataclasses import dataclass
from os import PathLike
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from seacrane.errors import FileFormatError
from seacrane.hydro.database import AdditionalMatrices, HydroDatabase, RollDamping
from seacrane.hydro.text_records import TextRecords

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

TO_OURS = np.array([-1.0, -1.0, 1.0, -1.0, -1.0, 1.0])
BOTH_SIDES = np.outer(TO_OURS, TO_OURS)
ADDITIONAL_CAUSE = "roll tanks and other additional matrices"
LINEARISED_AMPLITUDE = 5.0  # m, the wave amplitude of the files' linearised roll damping
HEADER_LINES = 6
CLOSURE_LIMIT = np.array([1e-3, 1e-3, 1e-5, 1e-3, 1e-5, 1e-3])  # of eight digits


@dataclass(frozen=True)
class _Header:
    """What the first lines of .re1, .re7 and .re8 share."""

    rho: float
    g: float
    length: float
    breadth: float
    draught: float
    lcg_aft: float
    vcg: float
    speeds: int
    headings: int
    frequencies: int


@dataclass(frozen=True)
class _Matrices:
    """Contents of a .re7 file in its own axes: ``blocks`` (headings, frequencies, 6 kinds, 6, 6)."""

    header: _Header
    title: str
    mass: FloatArray
    motion_point: tuple[float, float]
    heading: FloatArray
    omega: FloatArray
    blocks: FloatArray
    roll: FloatArray


@dataclass(frozen=True)
class _Transfer:
    """Contents of a .re1 or .re8 file in its own axes: values (headings, frequencies, 6)."""

    header: _Header
    motion_point: tuple[float, float]
    heading: FloatArray
    omega: FloatArray
    values: ComplexArray


def read_veres(path: str | PathLike[str]) -> HydroDatabase:
    """Read the VERES results at ``path``: a folder that holds one set, the common stem, or one of the files.

    Needs ``.re7`` and ``.re8``; ``.re1`` adds the motion transfer functions, against which `check` compares.
    One speed, zero. The trusted band is the range between 0.3 and 2.6 rad/s that the files cover.

    Raises
    ------
    FileFormatError : a file is missing, truncated, inconsistent with the others, or of a forward speed; the
        message names the file and, where there is one, the line.
    """
    stem = find_stem(Path(path))
    re7, re8, re1 = (_sibling(stem, suffix) for suffix in (".re7", ".re8", ".re1"))
    for file, suffix in ((re7, ".re7"), (re8, ".re8")):
        if file is None:
            raise FileFormatError(f"{stem}{suffix}: no such file; VERES needs .re7 and .re8 of the same stem")
    assert re7 is not None and re8 is not None
    matrices = _read_matrices(re7)
    force = _read_transfer(re8)
    _check_same(re8, force, matrices)
    motion = None
    if re1 is not None:
        motion = _read_transfer(re1)
        _check_same(re1, motion, matrices)
    try:
        return _convert(stem, matrices, force, motion)
    except FileFormatError:
        raise
    except ValueError as error:
        raise FileFormatError(f"{stem}: {error}") from error


def find_stem(path: Path) -> Path:
    """Common stem (folder and name without suffix) of the set of files that ``path`` points to."""
    if path.is_dir():
        stems = sorted({file.with_suffix("") for file in path.iterdir() if file.suffix.lower() == ".re7"})
        if len(stems) != 1:
            found = ", ".join(stem.name for stem in stems) or "none"
            raise FileFormatError(
                f"{path}: one .re7 file is needed in a VERES folder, found: {found}; give the stem"
            )
        return stems[0]
    return path.with_suffix("") if path.suffix.lower() in (".re1", ".re2", ".re7", ".re8", ".hyd") else path


def _sibling(stem: Path, suffix: str) -> Path | None:
    """File of the set with that suffix, in either case."""
    for name in (stem.name + suffix, stem.name + suffix.upper()):
        if (stem.parent / name).is_file():
            return stem.parent / name
    return None


def _read_header(records: TextRecords, *, versioned: bool) -> tuple[str, _Header]:
    title = [records.text() for _ in range(HEADER_LINES)]
    rho, g = records.numbers(2, "density and gravity")
    length, breadth, draught = records.numbers(3, "length, breadth, draught")
    lcg, vcg = records.numbers(2, "LCG and VCG")
    if versioned:
        marker = records.peek()
        if len(marker) != 2 or marker[0] != "-1":
            raise records.error(
                "a version line '-1 2' is needed: only version 2 of .re7 is read; export it again"
            )
        _, version = records.integers(2, "version line")
        if version != 2:
            raise records.error(f"version {version} of .re7 is not known, only version 2; export it again")
    speeds, headings, frequencies, dofs = records.integers(
        4, "numbers of speeds, headings, frequencies, motions"
    )
    if dofs != 6 or min(speeds, headings, frequencies) < 1:
        raise records.error(
            f"counts {speeds} {headings} {frequencies} {dofs}: at least one speed, heading and frequency, "
            "and "
            "six motions are needed"
        )
    if speeds != 1:
        raise records.error(f"{speeds} speeds in the file; this reader takes files of the single speed zero")
    header = _Header(rho, g, length, breadth, draught, lcg, vcg, speeds, headings, frequencies)
    return title[0].strip() + "; ship " + title[2].split(":", 1)[-1].strip(), header


def _read_motion_point(records: TextRecords) -> tuple[float, float]:
    speed, _, _, x_aft, z = records.numbers(5, "speed, sinkage, trim, motion point")
    if speed != 0.0:
        raise records.error(f"forward speed {speed} m/s: only results of zero speed are read")
    return x_aft, z


def _read_matrices(path: Path) -> _Matrices:
    records = TextRecords(path)
    title, header = _read_header(records, versioned=True)
    m, n = header.headings, header.frequencies
    records.expect(6 + 1 + m * (1 + n * (1 + 36 + 1)), "the counts in its header")
    mass = np.array([records.numbers(6, "mass matrix") for _ in range(6)])
    point = _read_motion_point(records)
    heading, omega = np.empty(m), np.empty((m, n))
    blocks, roll = np.empty((m, n, 6, 6, 6)), np.empty((m, n, 3))
    for h in range(m):
        (heading[h],) = records.numbers(1, "heading")
        for k in range(n):
            (omega[h, k],) = records.numbers(1, "frequency")
            blocks[h, k] = records.table(36, 6, "A, A_add, B, B_add, C, C_add").reshape(6, 6, 6)
            roll[h, k] = records.numbers(3, "roll damping")
    records.finish()
    return _Matrices(header, title, mass, point, heading, _one_omega(records, omega), blocks, roll)


def _read_transfer(path: Path) -> _Transfer:
    records = TextRecords(path)
    _, header = _read_header(records, versioned=False)
    m, n = header.headings, header.frequencies
    records.expect(1 + m * (1 + n * 7), "the counts in its header")
    point = _read_motion_point(records)
    heading, omega = np.empty(m), np.empty((m, n))
    values = np.empty((m, n, 6), dtype=complex)
    for h in range(m):
        (heading[h],) = records.numbers(1, "heading")
        for k in range(n):
            (omega[h, k],) = records.numbers(1, "frequency")
            rows = records.table(6, 3, "motion, real, imaginary part")
            if not np.array_equal(rows[:, 0], np.arange(1, 7)):
                raise records.error(f"motions {rows[:, 0].tolist()} where 1 to 6 are expected")
            values[h, k] = rows[:, 1] + 1j * rows[:, 2]
    records.finish()
    return _Transfer(header, point, heading, _one_omega(records, omega), values)


def _one_omega(records: TextRecords, omega: FloatArray) -> FloatArray:
    """The frequencies, which every heading has to repeat."""
    if np.any(omega != omega[0]):
        heading = int(np.argwhere(np.any(omega != omega[0], axis=1))[0, 0])
        raise FileFormatError(
            f"{records.path}: frequencies of heading number {heading + 1} differ from those of the first"
        )
    return np.asarray(omega[0])


def _check_same(path: Path, transfer: _Transfer, matrices: _Matrices) -> None:
    """Raise unless a transfer-function file belongs to the same calculation as the matrices."""
    pairs = {
        "header (density, gravity, dimensions, counts)": transfer.header == matrices.header,
        "motion point": transfer.motion_point == matrices.motion_point,
        "headings": np.array_equal(transfer.heading, matrices.heading),
        "frequencies": np.array_equal(transfer.omega, matrices.omega),
    }
    for what, same in pairs.items():
        if not same:
            raise FileFormatError(f"{path}: {what} differ from the .re7 file; use files of one VERES run")


def _convert(stem: Path, matrices: _Matrices, force: _Transfer, motion: _Transfer | None) -> HydroDatabase:
    """The database in our conventions."""
    added_mass, added_mass_add, damping, damping_add, restoring, restoring_add = np.moveaxis(
        matrices.blocks, 2, 0
    )
    first = matrices.blocks[:1]
    scale = np.abs(first).max(axis=(0, 1), keepdims=True) + 1e-300
    if np.any(np.abs(matrices.blocks - first) > 1e-5 * scale):
        raise ValueError("matrices depend on the heading, which zero speed does not allow; check the files")
    if np.any(np.abs(restoring - restoring[0, 0]) > 1e-6 * np.abs(restoring).max()):
        raise ValueError("the restoring matrix depends on the frequency; check the .re7 file")
    direction = np.mod(np.radians(matrices.heading) + np.pi, 2.0 * np.pi)
    direction[np.abs(direction - 2.0 * np.pi) < 1e-12] = 0.0
    by_heading, by_omega = np.argsort(direction), np.argsort(matrices.omega)
    head, x_aft, z = matrices.header, *matrices.motion_point

    def of_frequency(block: FloatArray) -> FloatArray:
        return np.asarray(block[0][by_omega] * BOTH_SIDES + 0.0)  # + 0.0: no negative zeros

    def of_wave(values: ComplexArray) -> ComplexArray:
        return np.asarray(values[by_heading][:, by_omega] * TO_OURS)

    omega = matrices.omega[by_omega]
    extra = AdditionalMatrices(
        cause=ADDITIONAL_CAUSE,
        added_mass=of_frequency(added_mass_add),
        damping=of_frequency(damping_add),
        restoring=of_frequency(restoring_add),
    )
    present = any(np.any(x != 0.0) for x in (extra.added_mass, extra.damping, extra.restoring))
    roll = matrices.roll[by_heading][:, by_omega]
    return HydroDatabase(
        name=stem.name,
        omega=omega,
        heading=direction[by_heading],
        added_mass=of_frequency(added_mass),
        damping=of_frequency(damping),
        restoring=restoring[0, 0] * BOTH_SIDES + 0.0,
        mass_matrix=matrices.mass * BOTH_SIDES + 0.0,
        force=of_wave(force.values),
        motion_rao=None if motion is None else of_wave(motion.values),
        motion_rao_limit=CLOSURE_LIMIT,
        roll_damping=RollDamping(
            linear=roll[0, :, 0],
            quadratic=roll[0, :, 1],
            linearised=roll[:, :, 2],
            linearised_amplitude=LINEARISED_AMPLITUDE,
        ),
        additional=(extra,) if present else (),
        rho=head.rho,
        g=head.g,
        length=head.length,
        breadth=head.breadth,
        draught=head.draught,
        origin=(
            f"motion point of the files: {x_aft:g} m aft of midship, on the centreline, {z:g} m above the "
            "baseline"
        ),
        source=(
            f"ShipX/VERES files {stem.name}.re7, .re8{'' if motion is None else ', .re1'}: {matrices.title}"
        ),
        trusted_band=_trusted(omega),
        port_starboard_symmetric=True,
    )


def _trusted(omega: FloatArray) -> tuple[float, float] | None:
    """The part of 0.3 to 2.6 rad/s that the files cover, or None if that is nothing."""
    low, high = max(0.3, float(omega[0])), min(2.6, float(omega[-1]))
    return (low, high) if low < high else None
