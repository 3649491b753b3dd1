"""Files of a NEMOH project: where they stand, and what they hold, of one body or of several.

``RadiationCoefficients.tec`` has a block for each moving degree of freedom, with rows of omega and, for each
force, A and B. ``ExcitationForce.tec`` has a block for each wave direction, with rows of omega and, for each
force, modulus and phase (rad) in the time factor exp(-i omega t): its conjugate is ours. ``KH.dat`` is the
restoring matrix in SI, ``Hydrostatics.dat`` tells centre of gravity and volume, ``Nemoh.cal`` the water, the
directions and the points that the rotations turn about. NEMOH 3 heads its tables with their frequencies'
unit. Of several bodies, ``KH_0.dat`` and ``Hydrostatics_0.dat`` on stand in the order of ``Nemoh.cal``.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path, PureWindowsPath
from typing import Any

import numpy as np

from seacrane.arrays import Array
from seacrane.errors import FileFormatError
from seacrane.hydro.readers.as_read import omega_of, rising_directions, whole_stiffness
from seacrane.hydro.readers.text_records import NUMBER, is_number, number_at, text_of

RADIATION, EXCITATION = "RadiationCoefficients.tec", "ExcitationForce.tec"
STIFFNESS, HYDROSTATICS, CONTROL = "KH.dat", "Hydrostatics.dat", "Nemoh.cal"
INNER = ("results", "Results", "mesh", "Mesh")
UNITS = ("rad/s", "Hz", "s")  # of the tables' first column, in the order of Nemoh.cal
MOTIONS = 6


@dataclass(frozen=True, eq=False)
class Water:
    """``Nemoh.cal``: kg/m3, m/s2, m, and m from the origin of the mesh; ``centres`` (k, 3) of rotation.

    ``names`` of the bodies are those of their mesh files, or numbers where these are not one each.
    """

    rho: float
    g: float
    depth: float
    centres: Array
    phase_origin: tuple[float, float]
    names: list[str]


def project_of(path: Path) -> Path:
    """The folder that holds everything, from itself, a folder in it, or a file."""
    folder = path if path.is_dir() else path.parent
    return folder.parent if folder.name in INNER else folder


def sought(folder: Path, name: str) -> Path | None:
    """A file by name in either case, in the folder or its inner ones."""
    places = [place for place in (folder, *(folder / inner for inner in INNER)) if place.is_dir()]
    every = (file for place in places for file in sorted(place.iterdir()))
    return next((file for file in every if file.name.lower() == name.lower() and file.is_file()), None)


def needed(file: Path | None, place: Path) -> Path:
    """A file that was found; raises where it was not."""
    if file is None:
        files = ", ".join((RADIATION, EXCITATION, STIFFNESS, HYDROSTATICS))
        raise FileFormatError(
            f"{place}: no such file, nor in results or mesh; NEMOH needs {files}, of several bodies KH_0.dat "
            "and Hydrostatics_0.dat on"
        )
    return file


def read_solution(matrices: Path, forces: Path, control: Path | None, names: list[str]) -> dict[str, Any]:
    """What both files hold, directions (rad) rising; phases of the loads are those of the file."""
    radiation = _blocks(matrices, len(names))
    if len(radiation) != MOTIONS * len(names):
        raise FileFormatError(
            f"{matrices}: {len(radiation)} degrees of freedom; six of each of {', '.join(names)[:200]} are "
            "needed"
        )
    waves = _blocks(forces, len(names))
    omega = _frequencies(matrices, radiation, control)
    if not np.array_equal(_frequencies(forces, waves, control), omega):
        raise FileFormatError(f"{forces}: other frequencies than {RADIATION}; use files of one run")
    values = np.array([block.rows for block in radiation])  # moving, omega, columns
    direction, places = rising_directions(np.array([_direction(forces, each) for each in waves]))
    wave = np.array([block.rows for block in waves])[places]
    added_mass, damping = (values[:, :, at::2].transpose(1, 2, 0) for at in (1, 2))
    force = wave[:, :, 1::2] * np.exp(-1j * wave[:, :, 2::2])
    return {
        "omega": omega, "heading": direction, "added_mass": added_mass, "damping": damping, "force": force,
    }  # fmt: skip


@dataclass(frozen=True, eq=False)
class _Block:
    """Rows of numbers below a line of text."""

    title: str
    line: int
    rows: Array


def _blocks(path: Path, bodies: int) -> list[_Block]:
    """The blocks of a Tecplot file; lines of text without rows below them are its head."""
    found: list[tuple[str, int, list[list[float]]]] = [("", 0, [])]
    motions = MOTIONS * bodies
    for number, line in enumerate(_text_lines(path), start=1):
        words = line.split()
        if words and is_number(words[0]):
            row = _numbers_in(path, number, words, failed=True)
            if len(row) != 1 + 2 * motions:
                raise FileFormatError(
                    f"{path}, line {number}: {len(row)} numbers; omega and two for each of {motions} motions "
                    "are needed: the file is truncated, or of another body"
                )
            found[-1][2].append(row)
        elif words:
            found.append((line.strip(), number, []))
    blocks = [_Block(title, line, np.array(rows)) for title, line, rows in found if rows]
    if not blocks:
        raise FileFormatError(f"{path}: no numbers; the file is empty or truncated")
    return blocks


def _frequencies(path: Path, blocks: list[_Block], control: Path | None) -> Array:
    """Frequencies (rad/s), the same in every block."""
    first = blocks[0].rows[:, 0]
    for block in blocks[1:]:
        if not np.array_equal(block.rows[:, 0], first):
            raise FileFormatError(
                f"{path}, line {block.line}: {block.title[:60]!r} has other frequencies than the first; the "
                "file is truncated"
            )
    return omega_of(first, _unit(path, control))


def _unit(path: Path, control: Path | None) -> str:
    """What a table's first column is in: as its head says, else ``Nemoh.cal``; rad/s where neither does."""
    head = next((line for line in _text_lines(path) if line.strip()), "")
    words = re.search(r'VARIABLES\s*=\s*"[^"(]*\(([^)"]*)\)', head, re.IGNORECASE)
    headed = words.group(1).strip().lower() if words else None
    known = {unit.lower(): unit for unit in UNITS}
    if headed is not None and headed not in known:
        raise FileFormatError(f"{path}, line 1: frequencies in {headed[:20]!r}; {', '.join(UNITS)} are read")
    asked = None
    for number, line in enumerate([] if control is None else _text_lines(control), start=1):
        if asked is None and re.search(r"output\s+freq\w*\s+type", line, re.IGNORECASE):  # of NEMOH 3
            asked = dict(zip("123", UNITS, strict=True)).get(line.split()[0])
            if asked is None:
                raise FileFormatError(
                    f"{control}, line {number}: type {line.split()[0][:20]!r} of output frequencies; give 1, "
                    f"2 or 3 for {', '.join(UNITS)}"
                )
    if headed is not None and asked is not None and known[headed] != asked:
        raise FileFormatError(
            f"{path}, line 1: headed by {known[headed]}, and {control} asks for {asked}; give the files of "
            "one run"
        )
    return known[headed] if headed is not None else asked or UNITS[0]


def _direction(path: Path, block: _Block) -> float:
    """Direction of a block's waves, rad: ``angle = 0.5``, or in degrees where its title says so."""
    found = re.findall(rf"(?:angle|direction|beta)\s*=\s*({NUMBER})\s*(deg)?", block.title, re.IGNORECASE)
    if not found:
        raise FileFormatError(
            f"{path}, line {block.line}: no wave direction in {block.title[:60]!r}; 'angle = ...' is needed"
        )
    value, unit = found[-1]
    angle = _numbers_in(path, block.line, [value])[0]
    return float(np.radians(angle)) if unit else angle


def read_hydrostatics(path: Path) -> tuple[Array, float]:
    """Centre of gravity (3,) in m, and displaced volume in m3."""
    text = text_of(path)
    gravity = re.findall(rf"[XYZ]G\s*=\s*({NUMBER})", text)
    volume = re.search(rf"Displacement\s*=\s*({NUMBER})", text)
    if len(gravity) != 3 or volume is None:
        raise FileFormatError(f"{path}: no centre of gravity or no Displacement; the file is truncated")
    size = _numbers_in(path, 1, [volume.group(1)])[0]
    if not size > 0.0:
        raise FileFormatError(f"{path}: Displacement is {size:g} m3; give a positive one")
    return np.array(_numbers_in(path, 1, gravity)), size


def read_stiffness(path: Path) -> Array:
    """The restoring matrix (6, 6)."""
    lines = [(number, line.split()) for number, line in enumerate(_text_lines(path), start=1) if line.strip()]
    rows = [_numbers_in(path, number, words) for number, words in lines]
    if len(rows) != MOTIONS or any(len(row) != MOTIONS for row in rows):
        raise FileFormatError(f"{path}: is no matrix of six rows and columns; it is truncated or damaged")
    return whole_stiffness(np.array(rows))


def read_control(path: Path) -> Water:
    """Water and bodies of ``Nemoh.cal``: values stand before exclamation marks."""
    lines = enumerate(_text_lines(path), start=1)
    rows = [(n, line.split("!")[0].split()) for n, line in lines if not line.lstrip().startswith("---")]
    numbers = [
        _numbers_in(path, line, [word for word in row if re.fullmatch(NUMBER, word)]) for line, row in rows
    ]
    if len(numbers) < 5 or [len(row) for row in numbers[:5]] != [1, 1, 1, 2, 1]:
        raise FileFormatError(
            f"{path}: does not begin with density, gravity, depth, wave measurement point and number of "
            "bodies; give the file that NEMOH was run with"
        )
    (rho,), (g,), (depth,), origin, (bodies,) = numbers[:5]
    if not (rho > 0.0 and g > 0.0):
        raise FileFormatError(f"{path}: density {rho:g} kg/m3, gravity {g:g} m/s2; give positive ones")
    turns = [row for row in numbers[5:] if len(row) == 7 and row[0] == 2.0]
    if bodies == 1.0:
        turns = turns[:3]
    if not turns or bodies < 1.0 or (bodies > 1.0 and len(turns) != 6 * bodies):
        raise FileFormatError(
            f"{path}: {bodies:g} bodies with {len(turns)} lines of rotations; each has three motions and "
            "three moments about a point"
        )
    centres = []
    for i in range(int(bodies)):
        points = {tuple(row[4:]) for row in turns[6 * i : 6 * i + 3]}  # of the motions, before the forces
        if len(points) != 1:
            raise FileFormatError(
                f"{path}: rotations of body {i + 1} turn about {len(points)} points; one is needed"
            )
        centres.append(points.pop())
    meshes = [row[0] for _, row in rows if len(row) == 1 and row[0].lower().endswith(".dat")]
    names = [PureWindowsPath(mesh).stem for mesh in meshes]
    if not len(names) == len(set(names)) == len(centres):
        names = [f"body{i}" for i in range(1, len(centres) + 1)]
    return Water(rho, g, depth or np.inf, np.array(centres), (origin[0], origin[1]), names)


def _numbers_in(path: Path, line: int, words: list[str], *, failed: bool = False) -> list[float]:
    """Finite numbers; where a solution may have failed, NaN too."""
    return [np.nan if failed and word.lower() == "nan" else number_at(path, line, word) for word in words]


def _text_lines(path: Path) -> list[str]:
    return text_of(path).split("\n")
