"""What Aqwa's files hold: the database in ASCII (``.AH1``), and the listing (``.LIS``) of one structure.

The blocks of ``.AH1`` are matrices of the load on the first structure named by motions of the second.
Versions before 18.2 leave the structure out of GENERAL, as BEMIO's ``readAQWA`` tells; none was at hand.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from seacrane.arrays import Array, Complex
from seacrane.errors import FileFormatError
from seacrane.hydro.data.rigid_mass import rigid_mass_matrix
from seacrane.hydro.readers.text_records import NUMBER, is_number, number_at, text_of
from seacrane.inputs.caller import warn_caller
from seacrane.warnings import RoundedPhaseWarning

INDICES = {"MASS": 1, "HYDSTIFFNESS": 1, "ADDEDMASS": 3, "DAMPING": 3, "ADDEDMASS_LF": 2, "ADDEDMASS_HF": 2,
           "COG": 1, "DRAFT": 1, "DISPLACEMENT": 1, "FIDD": 1, "FORCERAO": 3}  # fmt: skip
NUMBERS = {
    "COG": 3,
    "DRAFT": 1,
    "DISPLACEMENT": 1,
    "FIDD": 6,
    "FORCERAO": 12,
}  # after the indices; of all others 36
LIMITS = {"zero_frequency_added_mass": "ADDEDMASS_LF", "infinite_frequency_added_mass": "ADDEDMASS_HF"}
NUMBERED = "LHFR"  # in the head of files whose GENERAL names the structure
LOADS = "FROUDE KRYLOV + DIFFRACTION FORCES-VARIATION WITH WAVE PERIOD/FREQUENCY"
MOTIONS = "R.A.O.S-VARIATION WITH WAVE PERIOD/FREQUENCY"
MATRICES = {"STIFFNESSMATRIX": "stiffness", "ADDEDMASS": "added_mass", "DAMPING": "damping"}
ROWS = ("X", "Y", "Z", "RX", "RY", "RZ")
ROUNDED = 1e-3  # rad/s, and its share: frequencies stand in several tables with fewer digits
TURNS = np.repeat([1.0, np.pi / 180.0], 3)  # motions of the listing, whose rotations are in degrees
TOLD = {
    "water depth": r"WATER\s+DEPTH[ .]*=",
    "density of water": r"DENSITY\s+OF\s+WATER[ .]*=",
    "acceleration due to gravity": r"ACCELERATION\s+DUE\s+TO\s+GRAVITY[ .]*=",
    "total mass": r"T O T A L\s+\d+\s",
    "centre of gravity": r"C\.O\.G\.\s+GX=",
    "inertia matrix": r"INERTIA MATRIX",
    "displacement": r"MESH BASED DISPLACEMENT[ .]*=",
}


@dataclass(frozen=True, eq=False)
class Run:
    """What either file holds, SI: of k structures, n frequencies and m directions, in the file's order.

    ``water`` is depth, density and gravity; ``other_damping`` (k, 6) does not depend on frequency; loads and
    motions (m, n, 6 k) have zero phase at the centres.
    """

    water: tuple[float, float, float]
    omega: Array
    heading_deg: Array
    centres: Array
    masses: Array
    stiffness: Array
    volumes: Array
    added_mass: Array
    damping: Array
    force: Complex
    draughts: Array | None = None
    other_damping: Array | None = None
    motion: Complex | None = None
    limits: dict[str, Array | None] = field(default_factory=dict)
    left_out: Sequence[str] = ()


# The database


@dataclass(frozen=True, eq=False)
class _Section:
    """The words below a title of the database, and the line of each."""

    path: Path
    name: str
    words: list[str]
    lines: list[int]

    def error(self, at: int, message: str) -> FileFormatError:
        line = self.lines[min(at, len(self.lines) - 1)] if self.lines else 1
        return FileFormatError(f"{self.path}, line {line}: {self.name}: {message}")

    def numbers(self, first: int, count: int) -> list[float]:
        if first + count > len(self.words):
            raise self.error(len(self.words), "ends within a record; the file is truncated")
        places = range(first, first + count)
        return [number_at(self.path, self.lines[i], self.words[i], f"{self.name}: ") for i in places]

    def records(self) -> dict[tuple[int, ...], Array]:
        """Numbers by their leading indices, which count from 1."""
        indices, count = INDICES[self.name], NUMBERS.get(self.name, 36)
        found: dict[tuple[int, ...], Array] = {}
        for first in range(0, len(self.words), indices + count):
            every = self.numbers(first, indices + count)
            key = tuple(int(value) for value in every[:indices])
            if key in found or min(key) < 1 or list(key) != every[:indices]:
                raise self.error(first, f"{list(every[:indices])} are no indices of another record")
            found[key] = np.array(every[indices:])
        return found


def _sections(path: Path) -> tuple[dict[str, _Section], bool]:
    """The sections by title, "" before the first; and whether GENERAL names the structure."""
    found = {"": _Section(path, "head", [], [])}
    now, numbered = found[""], False
    for line, text in enumerate(text_of(path).split("\n"), start=1):
        if text.startswith("*"):
            numbered |= NUMBERED in text
        elif text[:1].isalpha():
            name = text.strip()[:40]
            if name in found:
                raise FileFormatError(
                    f"{path}, line {line}: {name} stands a second time; write the file again"
                )
            now = found[name] = _Section(path, name, [], [])
        else:
            words = text.split()
            now.words.extend(words)
            now.lines.extend([line] * len(words))
    return found, numbered


def read_database(path: Path) -> Run:
    sections, numbered = _sections(path)
    lacking = {"GENERAL", *INDICES} - {*LIMITS.values(), "DRAFT", "FIDD"} - set(sections)
    if lacking:
        raise FileFormatError(f"{path}: holds no {', '.join(sorted(lacking))}; write it with option AHD1")
    told = {name: section.records() for name, section in sections.items() if name in INDICES}
    count = len(told["COG"])
    heading_deg, omega = _grid(sections[""], count)
    n, m = len(omega), len(heading_deg)

    def of_all(name: str, *sizes: int) -> Array:
        """Records of all indices, stacked in their order."""
        every: list[tuple[int, ...]] = []
        if len(told[name]) == np.prod(sizes):
            every = [tuple(at + 1 for at in place) for place in np.ndindex(*sizes)]
        if not every or set(every) != set(told[name]):
            raise FileFormatError(
                f"{path}: {name} holds {len(told[name])} records, and {' x '.join(map(str, sizes))} are "
                "needed; the file is truncated or damaged"
            )
        return np.array([told[name][key] for key in every])

    def matrices(name: str, *last: int) -> Array:
        """(..., 6 k, 6 k) of blocks by structure."""
        blocks = of_all(name, count, count, *last).reshape(count, count, -1, 6, 6)
        return blocks.transpose(2, 0, 3, 1, 4).reshape(-1, 6 * count, 6 * count)

    general = sections["GENERAL"].numbers(int(numbered), 3)
    loads = of_all("FORCERAO", count, m, n).reshape(count, m, n, 2, 6).transpose(3, 1, 2, 0, 4)
    size, phase = loads.reshape(2, m, n, 6 * count)
    return Run(
        water=(general[0], general[1], general[2]), omega=omega, heading_deg=heading_deg,
        centres=of_all("COG", count), volumes=of_all("DISPLACEMENT", count)[:, 0],
        masses=of_all("MASS", count).reshape(-1, 6, 6),
        stiffness=of_all("HYDSTIFFNESS", count).reshape(-1, 6, 6),
        added_mass=matrices("ADDEDMASS", n), damping=matrices("DAMPING", n),
        force=np.asarray(size * np.exp(-1j * np.radians(phase)), dtype=complex),
        draughts=of_all("DRAFT", count)[:, 0] if "DRAFT" in told else None,
        other_damping=of_all("FIDD", count) if "FIDD" in told else None,
        limits={name: matrices(entry)[0] for name, entry in LIMITS.items() if entry in told},
        left_out=[name for name in sections if name and name != "GENERAL" and name not in INDICES],
    )  # fmt: skip


def _grid(head: _Section, count: int) -> tuple[Array, Array]:
    """Directions (deg) and frequencies (rad/s), which the head repeats for each structure."""
    found, at = [], 0
    while at < len(head.words):
        number, m, n = head.numbers(at, 3)
        if not (m >= 1.0 and n >= 1.0 and m == int(m) and n == int(n)):
            raise head.error(at, f"{m:g} directions and {n:g} frequencies of structure {number:g}")
        found.append(np.split(np.array(head.numbers(at + 3, int(m + n))), [int(m)]))
        at += 3 + int(m + n)
    if not 1 <= len(found) <= count or any(not map(np.array_equal, one, found[0]) for one in found):
        raise head.error(0, f"{len(found)} tables of directions and frequencies for {count} structures")
    return found[0][0], found[0][1]


# The listing


def read_listing(path: Path) -> Run:
    text = text_of(path)
    structures = set(re.findall(r"P A R A M E T E R S   F O R   S T R U C T U R E +(\d+)", text))
    if len(structures) != 1:
        raise FileFormatError(
            f"{path}: a listing of {len(structures)} structures; one is read: of several give the "
            "database in ASCII (.AH1), which options AHD1 and LHFR write"
        )
    lines = text.split("\n")
    omega = _listed_frequencies(path, lines)
    matrices, limits = _listed_matrices(path, lines, omega)
    heading_deg, loads = _listed_waves(path, lines, LOADS, omega)
    motion = None
    if any(line.strip() == MOTIONS for line in lines):
        directions, motion = _listed_waves(path, lines, MOTIONS, omega)
        motion = motion * TURNS if np.array_equal(directions, heading_deg) else None

    def told(name: str, count: int = 1) -> Array:
        return _listed_numbers(path, text, name, count)

    warn_caller(
        f"{path}: loads are those of the listing, in three digits; give the database in ASCII (.AH1)",
        RoundedPhaseWarning,
    )
    water = [float(told(name)[0]) for name in list(TOLD)[:3]]
    inertia = told("inertia matrix", 9).reshape(3, 3)
    return Run(
        water=(water[0], water[1], water[2]), omega=omega, heading_deg=heading_deg,
        centres=told("centre of gravity", 3)[None], volumes=told("displacement"),
        masses=rigid_mass_matrix(float(told("total mass")[0]), np.zeros(3), inertia)[None],
        force=loads, motion=motion, limits=limits,
        stiffness=matrices["stiffness"], added_mass=matrices["added_mass"], damping=matrices["damping"],
    )  # fmt: skip


def _listed_numbers(path: Path, text: str, name: str, count: int) -> Array:
    """Numbers that stand behind words of the listing; capital letters may stand between them."""
    found = re.search(TOLD[name] + rf"\s*({NUMBER})" + rf"[\sA-Z=]+?({NUMBER})" * (count - 1), text)
    if found is None:
        raise FileFormatError(f"{path}: holds no {name}; it is truncated")
    line = text.count("\n", 0, found.start()) + 1
    return np.array([number_at(path, line, word) for word in found.groups()])


def _listed_frequencies(path: Path, lines: Sequence[str]) -> Array:
    """Of rows of (structure,) number, frequency in rad/s and in Hz, period, wavenumber and more."""
    found: list[float] = []
    listed = False
    for line, text in enumerate(lines, start=1):
        words = text.split()
        if "W A V E   F R E Q U E N C I E S" in text:
            listed = True
        elif "DIRECTIONS" in words:
            break
        elif listed and len(words) >= 9 and is_number(words[0]):
            place = 1 if "." in words[1] else 2  # of the frequency, after one or two whole numbers
            found.append(number_at(path, line, words[place]))
    if not found:
        raise FileFormatError(f"{path}: holds no table of wave frequencies; it is truncated")
    return np.array(found)


def _listed_matrices(
    path: Path, lines: Sequence[str], omega: Array
) -> tuple[dict[str, Array], dict[str, Array | None]]:
    """Stiffness (1, 6, 6), added mass and damping (n, 6, 6), and the limits of the added mass."""
    found: dict[str, list[tuple[float, bool, list[list[float]]]]] = {name: [] for name in MATRICES.values()}
    rows: list[list[float]] = [[]] * 6
    frequency, limit = 0.0, False
    for line, text in enumerate(lines, start=1):
        joined, words = text.replace(" ", ""), text.split()
        if "WAVEFREQUENCY=" in joined:
            word = joined.partition("WAVEFREQUENCY=")[2].partition("(")[0]
            frequency, limit = number_at(path, line, word), "ENCOUNTER" in joined
        elif joined in MATRICES:
            rows = []
            found[MATRICES[joined]].append((frequency, limit, rows))
        elif len(rows) < 6 and len(words) == 7 and words[0] == ROWS[len(rows)]:
            rows.append([number_at(path, line, word) for word in words[1:]])
    usual = {name: [one for one in every if not one[1]] for name, every in found.items()}
    usual["stiffness"] = usual["stiffness"][:1]
    for name, every in usual.items():
        if not every or any(len(one[2]) != 6 for one in every):
            raise FileFormatError(f"{path}: a {name} matrix is not of six rows; the file is truncated")
        if name != "stiffness":
            _require_same(path, name, [one[0] for one in every], omega)
    whole = [one for one in found["added_mass"] if one[1] and len(one[2]) == 6]
    limits: dict[str, Array | None] = {
        "infinite_frequency_added_mass" if one[0] > omega.max() else "zero_frequency_added_mass": np.array(
            one[2]
        )
        for one in whole
    }
    return {name: np.array([one[2] for one in every]) for name, every in usual.items()}, limits


def _require_same(path: Path, name: str, told: Sequence[float], omega: Array) -> None:
    if len(told) != len(omega) or not np.allclose(told, omega, rtol=ROUNDED, atol=ROUNDED):
        raise FileFormatError(
            f"{path}: {name} is not at the {len(omega)} listed frequencies; the file is truncated or damaged"
        )


def _listed_waves(path: Path, lines: Sequence[str], title: str, omega: Array) -> tuple[Array, Complex]:
    """Directions (deg), and loads or motions (m, n, 6) of rows of period, frequency, (direction,) and six
    times amplitude and phase."""
    found: dict[float, list[list[float]]] = {}
    rows: list[list[float]] = []
    listed = False
    for line, text in enumerate(lines, start=1):
        if "VARIATION WITH" in text:
            listed = text.strip() == title
            continue
        words = text.split() if listed else []
        if len(words) in (14, 15) and is_number(words[0]):
            numbers = [number_at(path, line, word) for word in words]
            if len(numbers) == 15:
                rows = found.setdefault(numbers.pop(2), [])
            rows.append(numbers)
    if not found:
        raise FileFormatError(f"{path}: holds no table {title!r}; it is truncated")
    for degrees, rows in found.items():
        _require_same(path, f"a table of direction {degrees:g} deg", [row[1] for row in rows], omega)
    table = np.array(list(found.values()))
    return np.array(list(found)), table[:, :, 2::2] * np.exp(-1j * np.radians(table[:, :, 3::2]))
