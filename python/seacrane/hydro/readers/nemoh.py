"""Reader of NEMOH's results in Tecplot form, as NEMOH 2 writes them and Capytaine exports them.

``RadiationCoefficients.tec`` has a block for each moving degree of freedom, with rows of omega and, for each
force, A and B. ``ExcitationForce.tec`` has a block for each wave direction, with rows of omega and, for each
force, modulus and phase (rad) in the time factor exp(-i omega t): its conjugate is ours. ``KH.dat`` is the
restoring matrix in SI, ``Hydrostatics.dat`` tells centre of gravity and volume, ``Nemoh.cal`` the water, the
directions and the point that the rotations turn about. NEMOH 3 heads its tables with their frequencies' unit.
The stiffness is about the centre of gravity, and that of Capytaine's exports about the rotation centre.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from os import PathLike
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seacrane.errors import FileFormatError
from seacrane.hydro.data.heading_circle import keeps_sides_apart
from seacrane.hydro.database.database import HydroDatabase
from seacrane.hydro.readers.as_read import as_read, frequencies_kept, whole_stiffness
from seacrane.hydro.readers.band_of_data import with_band_of_data
from seacrane.hydro.readers.equivalent_box import equivalent_box
from seacrane.hydro.readers.format import Format, of_one_speed, zero_speed
from seacrane.hydro.readers.numbers_of_text import NUMBER, is_number, number_of_word
from seacrane.hydro.readers.stiffness_point import stiffness_about
from seacrane.hydro.readers.usual_inertia import usual_mass_matrix
from seacrane.hydro.readers.wave_directions import phase_at, rising_directions
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.whole_file import read_whole
from seacrane.warnings import AssumedDensityWarning

FloatArray = NDArray[np.float64]

RADIATION, EXCITATION = "RadiationCoefficients.tec", "ExcitationForce.tec"
STIFFNESS, HYDROSTATICS, CONTROL = "KH.dat", "Hydrostatics.dat", "Nemoh.cal"
INNER = ("results", "Results", "mesh", "Mesh")
UNITS = ("rad/s", "Hz", "s")  # of the tables' first column, in the order of Nemoh.cal
MOTIONS = 6


def read_nemoh(
    path: str | PathLike[str],
    *,
    rho: float = 1025.0,
    g: float = 9.81,
    depth: float = np.inf,
    rotation_centre: ArrayLike = (0.0, 0.0, 0.0),
    mass_matrix: ArrayLike | None = None,
    motions: Sequence[str] | None = None,
    leave_out: ArrayLike | None = None,
) -> HydroDatabase:
    """Read a folder of NEMOH's results of one body with six motions.

    Parameters
    ----------
    path : the folder, or a file in it. The files stand in it, or in its ``results`` and ``mesh``.
    rho, g, depth, rotation_centre : kg/m3, m/s2, m and (3,) m from the origin of the mesh, of results without
        ``Nemoh.cal``, such as Capytaine exports; beside it they are not used.
    mass_matrix : (6, 6) in SI about the rotation centre; by default the displaced mass at the centre of
        gravity with usual radii of gyration.
    motions : names of those that were solved for, where some were not: a motion without added mass and
        damping is refused unless it is left out here.
    leave_out : rad/s of frequencies to do without, such as those at which a solution failed (NaN).

    Returns
    -------
    HydroDatabase : length, breadth and draught are those of the equivalent box.

    Warns
    -----
    AssumedDensityWarning : no ``Nemoh.cal``: density, gravity, depth and rotation centre are the arguments.
    AssumedInertiaWarning : no ``mass_matrix``.

    Raises
    ------
    FileFormatError : a file is missing, truncated or damaged; the message names it and the line.
    """
    folder = project_of(Path(path))
    files = {name: found_file(folder, name) for name in (RADIATION, EXCITATION, STIFFNESS, HYDROSTATICS)}
    if (control := sought(folder, CONTROL)) is not None:
        water, _ = read_control(control)
        if len(water.centres) != 1:
            raise FileFormatError(
                f"{control}: {len(water.centres)} bodies; load_database and read_nemoh_group read them"
            )
    else:
        centre = np.asarray(rotation_centre, dtype=float)
        water = Water(float(rho), float(g), float(depth), centre[None], (0.0, 0.0))
        warn_caller(
            f"{folder}: has no {CONTROL}; {rho:g} kg/m3, {g:g} m/s2, depth {depth:g} m and rotations about "
            f"{tuple(centre.tolist())} m are taken",
            AssumedDensityWarning,
        )
    try:
        made = _convert(folder, files, water, mass_matrix, leave_out)
        found = as_read(f"{files[RADIATION]}, {EXCITATION}", "read_nemoh", made, motions)
    except FileFormatError:
        raise
    except ValueError as error:
        names = ", ".join(str(file) for file in (*files.values(), control) if file is not None)
        raise FileFormatError(f"{names}: {error}") from error
    return with_band_of_data(found)


@dataclass(frozen=True, eq=False)
class Water:
    """``Nemoh.cal``: kg/m3, m/s2, m, and m from the origin of the mesh; ``centres`` (k, 3) of rotation."""

    rho: float
    g: float
    depth: float
    centres: FloatArray
    phase_origin: tuple[float, float]


def _convert(
    folder: Path,
    files: dict[str, Path],
    water: Water,
    mass_matrix: ArrayLike | None,
    leave_out: ArrayLike | None,
) -> HydroDatabase:
    radiation = blocks(files[RADIATION])
    if len(radiation) != MOTIONS:
        raise FileFormatError(
            f"{files[RADIATION]}: {len(radiation)} degrees of freedom; the six of one body are needed"
        )
    control = sought(folder, CONTROL)
    whole = solution(files[RADIATION], files[EXCITATION], radiation, blocks(files[EXCITATION]), control)
    solved = whole.kept(files[RADIATION], files[EXCITATION], "read_nemoh", leave_out)
    omega, direction, added_mass = solved.omega, solved.direction, solved.added_mass
    gravity, volume = read_hydrostatics(files[HYDROSTATICS])
    centre = water.centres[0]
    from_phases = np.array([centre[0] - water.phase_origin[0], centre[1] - water.phase_origin[1]])
    force = solved.force * phase_at(from_phases, omega, direction, water.g, water.depth)
    restoring = stiffness_about(
        centre,
        read_stiffness(files[STIFFNESS]),
        gravity=gravity,
        lift=force[:, 0],
        usual="rotation centre" if control is None else "centre of gravity",
    )
    box = equivalent_box(restoring, volume, water.rho * water.g)
    if mass_matrix is None:
        mass_matrix = usual_mass_matrix(
            folder, "NEMOH's results hold no mass matrix, pass mass_matrix to read_nemoh",
            mass=water.rho * volume, centre=gravity - centre, length=box[0], breadth=box[1],
        )  # fmt: skip
    return HydroDatabase(
        name=folder.resolve().name,
        omega=omega,
        heading=direction,
        added_mass=added_mass,
        damping=solved.damping,
        restoring=restoring,
        mass_matrix=np.asarray(mass_matrix, dtype=float),
        force=force,
        rho=water.rho,
        g=water.g,
        depth=water.depth,
        length=box[0],
        breadth=box[1],
        draught=box[2],
        origin=(
            f"rotation centre of the NEMOH body, ({centre[0]:g}, {centre[1]:g}, {centre[2]:g}) m from the "
            "origin of its mesh"
        ),
        source=f"NEMOH results in folder {folder.resolve().name}",
        port_starboard_symmetric=bool(centre[1] == 0.0 and keeps_sides_apart(added_mass)),
    )


@dataclass(frozen=True, eq=False)
class Solution:
    """Matrices (n, 6 k, 6 k) of k bodies, forces (m, n, 6 k) with the phases of the file, rad/s, rad."""

    omega: FloatArray
    direction: FloatArray
    added_mass: FloatArray
    damping: FloatArray
    force: NDArray[np.complex128]

    def kept(self, matrices: Path, forces: Path, reader: str, leave_out: ArrayLike | None) -> Solution:
        """Without the frequencies that the caller leaves out; `frequencies_kept` raises for what is none."""
        tables = {"added_mass": self.added_mass, "damping": self.damping, "force": self.force}
        told = f"{matrices}, {forces.name}"
        rows = frequencies_kept(told, reader, self.omega, tables, leave_out)
        return Solution(
            omega=self.omega[rows],
            direction=self.direction,
            added_mass=self.added_mass[rows],
            damping=self.damping[rows],
            force=self.force[:, rows],
        )


def solution(
    matrices: Path, forces: Path, radiation: list[_Block], waves: list[_Block], control: Path | None
) -> Solution:
    """What the blocks of both files hold, frequencies and directions rising."""
    omega, order = _frequencies(matrices, radiation, control)
    values = np.array([block.rows[order] for block in radiation])  # moving, omega, columns
    if not np.array_equal(_frequencies(forces, waves, control)[0], omega):
        raise FileFormatError(f"{forces}: other frequencies than {RADIATION}; use files of one run")
    direction, places = rising_directions(np.array([_direction(forces, each) for each in waves]))
    wave = np.array([block.rows[order] for block in waves])[places]
    return Solution(
        omega=omega,
        direction=direction,
        added_mass=values[:, :, 1::2].transpose(1, 2, 0),
        damping=values[:, :, 2::2].transpose(1, 2, 0),
        force=wave[:, :, 1::2] * np.exp(-1j * wave[:, :, 2::2]),
    )


@dataclass(frozen=True, eq=False)
class _Block:
    """Rows of numbers below a line of text."""

    title: str
    line: int
    rows: FloatArray


def blocks(path: Path, *, bodies: int = 1) -> list[_Block]:
    """The blocks of a Tecplot file; lines of text without rows below them are its head."""
    found: list[_Block] = []
    motions = MOTIONS * bodies
    title, start, rows = "", 0, list[list[float]]()

    def close() -> None:
        if rows:
            found.append(_Block(title, start, np.array(rows)))

    for number, line in enumerate(text_lines(path), start=1):
        words = line.split()
        if words and is_number(words[0]):
            rows.append(numbers_in(path, number, words, failed=True))
            if len(rows[-1]) != 1 + 2 * motions:
                many = "six" if bodies == 1 else motions
                raise FileFormatError(
                    f"{path}, line {number}: {len(rows[-1])} numbers; omega and two for each of {many} "
                    "motions "
                    "are needed: the file is truncated, or of another body"
                )
        elif words:
            close()
            title, start, rows = line.strip(), number, []
    close()
    if not found:
        raise FileFormatError(f"{path}: no numbers; the file is empty or truncated")
    return found


def _frequencies(
    path: Path, blocks: list[_Block], control: Path | None
) -> tuple[FloatArray, NDArray[np.intp]]:
    """Frequencies (rad/s), rising, the same in every block, and their places in it."""
    first = blocks[0].rows[:, 0]
    for block in blocks[1:]:
        if not np.array_equal(block.rows[:, 0], first):
            raise FileFormatError(
                f"{path}, line {block.line}: {block.title[:60]!r} has other frequencies than the first; the "
                "file is truncated"
            )
    unit = _unit(path, control)
    if unit == "s" and np.any(first <= 0.0):
        raise FileFormatError(f"{path}: a period is {first.min():g} s; give positive ones")
    omega = 2.0 * np.pi / first if unit == "s" else first * (2.0 * np.pi if unit == "Hz" else 1.0)
    order = np.argsort(omega)
    return omega[order], order


def _unit(path: Path, control: Path | None) -> str:
    """What a table's first column is in: as its head says, else ``Nemoh.cal``; rad/s where neither does."""
    head = next((line for line in text_lines(path) if line.strip()), "")
    words = re.search(r'VARIABLES\s*=\s*"[^"(]*\(([^)"]*)\)', head, re.IGNORECASE)
    headed = words.group(1).strip().lower() if words else None
    known = {unit.lower(): unit for unit in UNITS}
    if headed is not None and headed not in known:
        raise FileFormatError(f"{path}, line 1: frequencies in {headed[:20]!r}; {', '.join(UNITS)} are read")
    asked = None if control is None else _unit_of_control(control)
    if headed is not None and asked is not None and known[headed] != asked:
        raise FileFormatError(
            f"{path}, line 1: headed by {known[headed]}, and {control} asks for {asked}; give the files of "
            "one run"
        )
    return known[headed] if headed is not None else asked or UNITS[0]


def _unit_of_control(path: Path) -> str | None:
    """The unit that ``Nemoh.cal`` (NEMOH 3) asks tables to be written over."""
    for number, line in enumerate(text_lines(path), start=1):
        if re.search(r"output\s+freq\w*\s+type", line, re.IGNORECASE):
            word = line.split()[0]
            if word not in ("1", "2", "3"):
                raise FileFormatError(
                    f"{path}, line {number}: type {word[:20]!r} of output frequencies; give 1, 2 or 3 for "
                    f"{', '.join(UNITS)}"
                )
            return UNITS[int(word) - 1]
    return None


def _direction(path: Path, block: _Block) -> float:
    """Direction of a block's waves, rad: ``angle = 0.5``, or in degrees where its title says so."""
    found = re.findall(rf"(?:angle|direction|beta)\s*=\s*({NUMBER})\s*(deg)?", block.title, re.IGNORECASE)
    if not found:
        raise FileFormatError(
            f"{path}, line {block.line}: no wave direction in {block.title[:60]!r}; 'angle = ...' is needed"
        )
    value, unit = found[-1]
    angle = numbers_in(path, block.line, [value])[0]
    return float(np.radians(angle)) if unit else angle


def read_hydrostatics(path: Path) -> tuple[FloatArray, float]:
    """Centre of gravity (3,) in m, and displaced volume in m3."""
    text = "\n".join(text_lines(path))
    gravity = re.findall(rf"[XYZ]G\s*=\s*({NUMBER})", text)
    volume = re.search(rf"Displacement\s*=\s*({NUMBER})", text)
    if len(gravity) != 3 or volume is None:
        raise FileFormatError(f"{path}: no centre of gravity or no Displacement; the file is truncated")
    size = numbers_in(path, 1, [volume.group(1)])[0]
    if not size > 0.0:
        raise FileFormatError(f"{path}: Displacement is {size:g} m3; give a positive one")
    return np.array(numbers_in(path, 1, gravity)), size


def read_stiffness(path: Path) -> FloatArray:
    """The restoring matrix (6, 6)."""
    lines = [(number, line.split()) for number, line in enumerate(text_lines(path), start=1) if line.strip()]
    rows = [numbers_in(path, number, words) for number, words in lines]
    if len(rows) != MOTIONS or any(len(row) != MOTIONS for row in rows):
        raise FileFormatError(f"{path}: is no matrix of six rows and columns; it is truncated or damaged")
    return whole_stiffness(np.array(rows))


def read_control(path: Path) -> tuple[Water, list[str]]:
    """Water and bodies of ``Nemoh.cal``, and their mesh files: values stand before exclamation marks."""
    lines = enumerate(text_lines(path), start=1)
    rows = [(n, line.split("!")[0].split()) for n, line in lines if not line.lstrip().startswith("---")]
    numbers = [
        numbers_in(path, line, [word for word in row if re.fullmatch(NUMBER, word)]) for line, row in rows
    ]
    if len(numbers) < 5 or [len(row) for row in numbers[:5]] != [1, 1, 1, 2, 1]:
        raise FileFormatError(
            f"{path}: does not begin with density, gravity, depth, wave measurement point and number of "
            "bodies; give the file that NEMOH was run with"
        )
    (rho,), (g,), (depth,), origin, (bodies,) = numbers[:5]
    if not (rho > 0.0 and g > 0.0 and depth >= 0.0):
        raise FileFormatError(
            f"{path}: density {rho:g} kg/m3, gravity {g:g} m/s2, depth {depth:g} m; give positive ones (a "
            "depth of 0 is deep water)"
        )
    turns = [row for row in numbers[5:] if len(row) == 7 and row[0] == 2.0]
    if bodies == 1.0:
        turns = turns[:3]
    if not turns or bodies < 1.0 or (bodies > 1.0 and len(turns) != 6 * bodies):
        raise FileFormatError(
            f"{path}: {bodies:g} bodies with {len(turns)} lines of rotations; each has three motions and "
            "three "
            "moments about a point"
        )
    centres = []
    for i in range(int(bodies)):
        points = {tuple(row[4:]) for row in turns[6 * i : 6 * i + 3]}  # of the motions, before the forces
        if len(points) != 1:
            whose = "its rotations" if bodies == 1.0 else f"rotations of body {i + 1}"
            raise FileFormatError(f"{path}: {whose} turn about {len(points)} points; one is needed")
        centres.append(points.pop())
    water = Water(rho, g, depth or np.inf, np.array(centres), (origin[0], origin[1]))
    return water, [row[0] for _, row in rows if len(row) == 1 and row[0].lower().endswith(".dat")]


def numbers_in(path: Path, line: int, words: list[str], *, failed: bool = False) -> list[float]:
    """Finite numbers; where a solution may have failed, NaN too."""
    try:
        return [np.nan if failed and word.lower() == "nan" else number_of_word(word) for word in words]
    except ValueError as error:
        told = " ".join(words)[:60]
        raise FileFormatError(
            f"{path}, line {line}: {told!r} are no numbers, or not all finite: {error}"
        ) from None


def text_lines(path: Path) -> list[str]:
    try:
        return read_whole(path).decode("latin-1").splitlines()
    except OSError as error:
        raise FileFormatError(
            f"{path}: cannot be read ({error.strerror}); check the path and its rights"
        ) from error


def project_of(path: Path) -> Path:
    """The folder that holds everything, from itself, a folder in it, or a file."""
    folder = path if path.is_dir() else path.parent
    return folder.parent if folder.name in INNER else folder


def sought(folder: Path, name: str) -> Path | None:
    places = [folder, *(folder / inner for inner in INNER)]
    return next((place / name for place in places if (place / name).is_file()), None)


def found_file(folder: Path, name: str) -> Path:
    file = sought(folder, name)
    if file is None:
        needed = ", ".join((RADIATION, EXCITATION, STIFFNESS, HYDROSTATICS))
        raise FileFormatError(f"{folder / name}: no such file, nor in results or mesh; NEMOH needs {needed}")
    return file


def can_open_nemoh(path: Path) -> bool:
    return path.name in (RADIATION, EXCITATION, CONTROL) or (
        path.is_dir() and sought(project_of(path), RADIATION) is not None
    )


FORMAT = Format(
    name="NEMOH",
    files="a NEMOH folder (RadiationCoefficients.tec, ExcitationForce.tec, KH.dat, Hydrostatics.dat)",
    can_open=can_open_nemoh,
    read=of_one_speed(read_nemoh),
    speeds=zero_speed,
)
