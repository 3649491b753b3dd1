"""Hydrostatics of ShipX/VERES (``.hyd``): what the text says, and whether the matrices agree with it."""

from __future__ import annotations

import re
from dataclasses import dataclass, fields
from os import PathLike
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from seacrane.errors import FileFormatError
from seacrane.hydro.readers.text_records import NUMBER as WORD
from seacrane.hydro.readers.text_records import TextRecords

FloatArray = NDArray[np.float64]

TOLERANCE = 2e-3  # the digits of the text
ROUNDING = 1e-3  # m
POSITION_TOLERANCE = 1e-3  # of the length, for points along the ship
ROWS = {
    "length": "Length between perpendiculars",
    "breadth": "Breadth",
    "draught": "Draught, midship",
    "sinkage": "Sinkage",
    "trim_deg": "Trim",
    "displacement": "Displacement",
    "kb": "Vertical center of b",
    "vcg": "Vertical center of gravity",
    "lcb": "Longitudinal center of b",
    "lcg": "Longitudinal center of gravity",
    "cb": "Block coefficient",
    "cw": "Water plane area coefficient",
    "gm_longitudinal": "Longitudinal metacentric height",
    "gm_transverse": "Transverse metacentric height",
    "r44": "Roll radius of gyration",
    "r55": "Pitch radius of gyration",
    "r66": "Yaw radius of gyration",
}
TONNES = 1000.0
NUMBER = re.compile(rf"^{WORD}\*?$")


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

    length: float | None = None
    breadth: float | None = None
    draught: float | None = None
    sinkage: float | None = None
    trim_deg: float | None = None
    displacement: float | None = None
    kb: float | None = None
    vcg: float | None = None
    lcb: float | None = None
    lcg: float | None = None
    cb: float | None = None
    cw: float | None = None
    gm_transverse: float | None = None
    gm_longitudinal: float | None = None
    r44: float | None = None
    r55: float | None = None
    r66: float | None = None


@dataclass(frozen=True, eq=False)
class Loading:
    """What the matrices are of, in the files' axes: x aft of midship and z above the baseline, in m."""

    mass: FloatArray
    restoring: FloatArray
    g: float
    length: float
    breadth: float
    draught: float
    lcg_aft: float
    vcg: float
    motion_point: tuple[float, float]


def read_veres_hydrostatics(path: str | PathLike[str]) -> VeresHydrostatics:
    """Read a ``.hyd`` file of ShipX/VERES.

    Raises
    ------
    FileFormatError : a row without its number, a number that is not finite, or none of the known rows.
    """
    records = TextRecords(Path(path))
    values: dict[str, float] = {}
    for line in records.rest():
        name = next((name for name, label in ROWS.items() if line.strip().startswith(label)), None)
        if name is not None and name not in values:
            values[name] = _value(records, line.strip(), ROWS[name])
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


def contradictions(hydrostatics: VeresHydrostatics, loading: Loading) -> list[str]:
    """Every value of the text that the matrices contradict, as "name: text against matrices"."""
    expected = _of_matrices(loading)
    found = []
    for entry in fields(hydrostatics):
        text = getattr(hydrostatics, entry.name)
        if text is None or entry.name not in expected:
            continue
        matrices, tolerance = expected[entry.name]
        if not abs(text - matrices) <= tolerance:
            found.append(f"{entry.name} {text:.6g} against {matrices:.6g}")
    return found


def _of_matrices(ship: Loading) -> dict[str, tuple[float, float]]:
    """What the matrices and headers say, with what rounding allows."""
    mass, weight = ship.mass[0, 0], ship.mass[0, 0] * ship.g
    x, z = ship.lcg_aft - ship.motion_point[0], ship.vcg - ship.motion_point[1]
    along = ship.length / 2.0 - ship.lcg_aft
    gyration = {
        "r44": ship.mass[3, 3] / mass - z**2,
        "r55": ship.mass[4, 4] / mass - x**2 - z**2,
        "r66": ship.mass[5, 5] / mass - x**2,
    }
    near = {name: float(np.sqrt(max(square, 0.0))) for name, square in gyration.items()}
    near |= {
        "length": ship.length,
        "breadth": ship.breadth,
        "draught": ship.draught,
        "displacement": float(mass),
        "vcg": ship.vcg,
        "gm_transverse": float(ship.restoring[3, 3] / weight),
        "gm_longitudinal": float(ship.restoring[4, 4] / weight),
    }
    limits = {name: (value, TOLERANCE * abs(value) + ROUNDING) for name, value in near.items()}
    point = (along, POSITION_TOLERANCE * ship.length)
    return limits | {"lcg": point, "lcb": point}
