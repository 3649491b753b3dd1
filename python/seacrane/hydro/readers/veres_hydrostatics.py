"""Hydrostatics of ShipX/VERES (``.hyd``): what the text says, and whether the matrices agree with it."""

from __future__ import annotations

import re
from dataclasses import dataclass, field, fields
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from seacrane.errors import FileFormatError
from seacrane.hydro.readers.text_records import NUMBER as WORD
from seacrane.hydro.readers.text_records import TextRecords
from seacrane.hydro.readers.veres_files import Case, VeresFile

TOLERANCE = 2e-3  # the digits of the text
ROUNDING = 1e-3  # m
POSITION_TOLERANCE = 1e-3  # of the length, for points along the ship
TONNES = 1000.0
NUMBER = re.compile(rf"^{WORD}\*?$")


def _row(label: str) -> Any:
    """A value of the file, which stands in the row that begins so."""
    return field(default=None, metadata={"row": label})


@dataclass(frozen=True, kw_only=True)
class VeresHydrostatics:
    """What a ``.hyd`` file holds of the ship; None for rows that it does not have.

    Of a specified and a calculated value the one marked as applied is given, else the last.

    Attributes
    ----------
    length, breadth, draught, sinkage : m; trim_deg : deg, positive aft.
    displacement : kg.
    kb, vcg : centre of buoyancy and of gravity above the baseline, m.
    lcb, lcg : the same forward of the aft perpendicular, m.
    cb, cw : block and waterplane coefficient.
    gm_transverse, gm_longitudinal : metacentric heights, m.
    r44, r55, r66 : radii of gyration about the centre of gravity, m.
    """

    length: float | None = _row("Length between perpendiculars")
    breadth: float | None = _row("Breadth")
    draught: float | None = _row("Draught, midship")
    sinkage: float | None = _row("Sinkage")
    trim_deg: float | None = _row("Trim")
    displacement: float | None = _row("Displacement")
    kb: float | None = _row("Vertical center of b")
    vcg: float | None = _row("Vertical center of gravity")
    lcb: float | None = _row("Longitudinal center of b")
    lcg: float | None = _row("Longitudinal center of gravity")
    cb: float | None = _row("Block coefficient")
    cw: float | None = _row("Water plane area coefficient")
    gm_transverse: float | None = _row("Transverse metacentric height")
    gm_longitudinal: float | None = _row("Longitudinal metacentric height")
    r44: float | None = _row("Roll radius of gyration")
    r55: float | None = _row("Pitch radius of gyration")
    r66: float | None = _row("Yaw radius of gyration")


def read_veres_hydrostatics(path: str | PathLike[str]) -> VeresHydrostatics:
    """Read a ``.hyd`` file of ShipX/VERES.

    Raises
    ------
    FileFormatError : a row without its number, a number that is not finite, or none of the known rows.
    """
    records = TextRecords(Path(path))
    values: dict[str, float] = {}
    rows = {entry.name: str(entry.metadata["row"]) for entry in fields(VeresHydrostatics)}
    for line in records.rest():
        name = next((name for name, label in rows.items() if line.strip().startswith(label)), None)
        if name is not None and name not in values:
            values[name] = _value(records, line.strip(), rows[name])
    if not values:
        raise FileFormatError(f"{path}: none of the rows of a VERES hydrostatics file; export it again")
    if "displacement" in values:
        values["displacement"] *= TONNES
    return VeresHydrostatics(**values)


def _value(records: TextRecords, line: str, label: str) -> float:
    """The applied number (marked with ``*``), else the last, of a row."""
    words = line[len(label) :].split()
    numbers = [word for word in words if NUMBER.match(word)]
    if not numbers or not NUMBER.match(words[-1]):
        raise records.error(f"{label}: no number at the end of the row; the file is damaged or truncated")
    marked = [word for word in numbers if word.endswith("*")]
    return records.number((marked or numbers)[-1].rstrip("*"), label)


def contradictions(hydrostatics: VeresHydrostatics, file: VeresFile, case: Case) -> list[str]:
    """Every value of the text that the matrices contradict, as "name: text against matrices"."""
    expected = _of_matrices(file, case)
    found = []
    for entry in fields(hydrostatics):
        text = getattr(hydrostatics, entry.name)
        if text is None or entry.name not in expected:
            continue
        matrices, tolerance = expected[entry.name]
        if not abs(text - matrices) <= tolerance:
            found.append(f"{entry.name} {text:.6g} against {matrices:.6g}")
    return found


def _of_matrices(file: VeresFile, case: Case) -> dict[str, tuple[float, float]]:
    """What the matrices and header of ``.re7`` say, with what rounding allows."""
    ship, matrix, restoring = file.header, file.mass, case.blocks[0, 0, 4]
    mass, weight = matrix[0, 0], matrix[0, 0] * ship.g
    x, z = ship.lcg_aft - case.motion_point[0], ship.vcg - case.motion_point[1]
    along = ship.length / 2.0 - ship.lcg_aft
    gyration = {
        "r44": matrix[3, 3] / mass - z**2,
        "r55": matrix[4, 4] / mass - x**2 - z**2,
        "r66": matrix[5, 5] / mass - x**2,
    }
    near = {name: float(np.sqrt(max(square, 0.0))) for name, square in gyration.items()}
    near |= {
        "length": ship.length,
        "breadth": ship.breadth,
        "draught": ship.draught,
        "displacement": float(mass),
        "vcg": ship.vcg,
        "gm_transverse": float(restoring[3, 3] / weight),
        "gm_longitudinal": float(restoring[4, 4] / weight),
    }
    limits = {name: (value, TOLERANCE * abs(value) + ROUNDING) for name, value in near.items()}
    point = (along, POSITION_TOLERANCE * ship.length)
    return limits | {"lcg": point, "lcb": point}
