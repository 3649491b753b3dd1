"""Reader of ShipX/VERES results: ``.re7`` (matrices), ``.re8`` (excitation), ``.re1`` (motions), ``.re2``
(drift), ``.hyd`` (hydrostatics).

File axes are x aft, y starboard, z up; heading 0 is head sea; time factor exp(+i omega t); LCG positive aft
of midship; everything refers to the motion point (xmtn aft of midship, centreline, zmtn above the baseline),
which is also where waves have zero phase. To ours: diag(-1, -1, 1, -1, -1, 1), and direction = heading + 180
degrees. Drift coefficients: surge and sway by rho g B^2 / L, yaw by rho g B^2, per squared amplitude.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field, fields, replace
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.arrays import Array
from seacrane.errors import FileFormatError
from seacrane.hydro.data.frozen import reading
from seacrane.hydro.data.hydro_data import AdditionalMatrices, DriftCoefficients, RollDamping
from seacrane.hydro.data.motion import force_of_motion, one_function
from seacrane.hydro.database.database import HydroDatabase
from seacrane.hydro.readers.as_read import left_out
from seacrane.hydro.readers.format import Format, sibling, unread
from seacrane.hydro.readers.text_records import NUMBER as WORD
from seacrane.hydro.readers.text_records import TextRecords
from seacrane.hydro.readers.veres_files import LOST, SET, Case, VeresSet, choose_speed, is_veres, read_set
from seacrane.inputs.caller import warn_caller
from seacrane.warnings import EncounterFrequencyWarning, HydrostaticsWarning, PartialSetWarning

TO_OURS = np.array([-1.0, -1.0, 1.0, -1.0, -1.0, 1.0])
BOTH_SIDES = np.outer(TO_OURS, TO_OURS)
GRID = {"motion_point": "motion point", "heading": "headings", "omega": "frequencies"}
DRIFT_MOTIONS = [0, 1, 5]
ADDITIONAL_CAUSE = "roll tanks and other additional matrices"
LINEARISED_AMPLITUDE = 5.0  # m, the wave amplitude of the files' linearised roll damping
CLOSURE_LIMIT = np.array([1e-3, 1e-3, 1e-5, 1e-3, 1e-5, 1e-3])  # of eight digits
SPEED_CLOSURE_LIMIT = np.full(6, 1e-2)  # interpolated in encounter frequency
BAND = (0.3, 2.6)  # rad/s
AGREEMENT = 0.02  # between headings at one encounter frequency, of the geometric mean of the diagonals
DRIFT_DIGITS = 1e-4  # .re2 gives frequencies and headings in four and two decimals
HEADING_DIGITS = 6e-3
TOLERANCE, ROUNDING = 2e-3, 1e-3  # the digits of .hyd: a share, and m
POSITION_TOLERANCE = 1e-3  # of the length, for points along the ship
TONNES = 1000.0
NUMBER = re.compile(rf"^{WORD}\*?$")


def read_veres(path: str | PathLike[str], *, speed: float | None = None) -> HydroDatabase:
    """Read the VERES results at ``path``: a folder that holds one set, the common stem, or one of the files.

    Needs ``.re7`` (version 1 or 2) and ``.re8``; ``.re1`` adds the motion transfer functions, against which
    `check` compares; ``.re2`` the drift coefficients; ``.hyd`` is compared with the matrices. Without
    ``.re8`` the wave forces are those that make the motions of ``.re1``. `source` tells what a missing file
    takes away.

    Parameters
    ----------
    path : folder, stem or file.
    speed : which forward speed of the set, m/s; by default the one nearest to zero.

    Returns
    -------
    HydroDatabase : the trusted band is the range between 0.3 and 2.6 rad/s that the files cover. At forward
        speed the matrices are functions of the encounter frequency: those of a beam sea, where encounter and
        wave frequency are the same, else those of all headings joined.

    Warns
    -----
    SeveralSpeedsWarning : the set holds several speeds and ``speed`` is not given.
    PartialSetWarning : a speed is not in every file; or there is no ``.re8``.
    EncounterFrequencyWarning : at forward speed the headings do not agree on one function of the encounter
        frequency, or do not cover the files' range.
    HydrostaticsWarning : ``.hyd`` contradicts the matrices.

    Raises
    ------
    FileFormatError : a file is missing, truncated, inconsistent with the others, or without that speed; the
        message names the file and, where there is one, the line.
    """
    found = read_set(Path(path))
    chosen = choose_speed(found, speed)
    with reading(found.stem):
        database = _convert(found, chosen)
    _check_hydrostatics(found, chosen)
    return database


def _convert(found: VeresSet, speed: float) -> HydroDatabase:
    """The database in our conventions."""
    case, head = found.case(".re7", speed), found.matrices.header
    direction = _direction(case.heading)
    by_heading, by_omega = np.argsort(direction), np.argsort(case.omega)
    waves: dict[str, NDArray[np.complex128]] = {}
    for suffix in (".re8", ".re1"):
        if suffix in found.files:
            transfer = found.case(suffix, speed)
            for name, what in GRID.items():
                if not np.array_equal(getattr(transfer, name), getattr(case, name)):
                    raise found.other_run(suffix, what)
            waves[suffix] = np.asarray(transfer.values[by_heading][:, by_omega] * TO_OURS)
    omega = case.omega[by_omega]
    added_mass, damping, extra, roll = _tables(found, case, by_omega)
    restoring = case.blocks[:, :, 4]
    if np.any(np.abs(restoring - restoring[0, 0]) > 1e-6 * np.abs(restoring).max()):
        raise ValueError("the restoring matrix depends on heading or frequency; check the .re7 file")
    present = any(np.any(x != 0.0) for x in (extra.added_mass, extra.damping, extra.restoring))
    x_aft, z = case.motion_point
    names = ", ".join(file.path.suffix.lower() for file in found.files.values())
    missing = [suffix for suffix in LOST if sibling(found.stem, suffix) is None]
    lost = "".join(f"; no {suffix}: {LOST[suffix]}" for suffix in missing)
    damped = RollDamping(
        linear=roll[:, 0], quadratic=roll[:, 1], linearised=case.roll[by_heading][:, by_omega, 2],
        linearised_amplitude=LINEARISED_AMPLITUDE,
    )  # fmt: skip
    database = HydroDatabase(
        name=found.stem.name, omega=omega, heading=direction[by_heading],
        added_mass=added_mass, damping=damping,
        restoring=restoring[0, 0] * BOTH_SIDES + 0.0, mass_matrix=found.matrices.mass * BOTH_SIDES + 0.0,
        force=next(iter(waves.values())), motion_rao=waves.get(".re1") if ".re8" in waves else None,
        motion_rao_limit=CLOSURE_LIMIT if speed == 0.0 else SPEED_CLOSURE_LIMIT,
        roll_damping=damped, additional=(extra,) if present else (),
        drift=_drift(found, case) if ".re2" in found.files else None,
        rho=head.rho, g=head.g, speed=case.speed,
        length=head.length, breadth=head.breadth, draught=head.draught,
        origin=f"motion point of the files: {x_aft:g} m aft of midship, on the centreline, {z:g} m above the "
        "baseline",
        source=f"ShipX/VERES files {found.stem.name} ({names}): {found.matrices.title}{lost}"
        + left_out(unread(found.stem, SET[2])),
        trusted_band=_trusted(omega), port_starboard_symmetric=True,
    )  # fmt: skip
    return database if ".re8" in waves else _with_forces(found.stem, database)


def _with_forces(stem: Path, database: HydroDatabase) -> HydroDatabase:
    """Wave forces from motions, which stand in their place."""
    force = force_of_motion(database, database.force)
    if not np.all(np.isfinite(force)):
        raise FileFormatError(
            f"{stem}.re8: no such file, and at {database.speed:g} m/s some frequencies of encounter are "
            "beyond the matrices, so that wave forces do not follow from the motions of .re1"
        )
    warn_caller(
        f"{stem}: no .re8; wave forces are solved from the motions of .re1 and the matrices, which then "
        "cannot be compared",
        PartialSetWarning,
    )
    return replace(database, force=force)


def _direction(heading_deg: Array) -> Array:
    """Directions of travel in [0, 2 pi) of the files' headings."""
    direction = np.mod(np.radians(heading_deg) + np.pi, 2.0 * np.pi)
    direction[np.abs(direction - 2.0 * np.pi) < 1e-12] = 0.0
    return np.asarray(direction)


def _tables(
    found: VeresSet, case: Case, by_omega: NDArray[np.intp]
) -> tuple[Array, Array, AdditionalMatrices, Array]:
    """Added mass, damping, what is additional, and roll damping, by the frequency (of encounter), rising."""
    omega = case.omega[by_omega]
    ours = case.blocks[:, by_omega] * BOTH_SIDES + 0.0  # + 0.0: no negative zeros
    roll = case.roll[:, by_omega, :2]
    if case.speed == 0.0:
        scale = np.abs(ours[:1]).max(axis=(0, 1), keepdims=True) + 1e-300
        if np.any(np.abs(ours - ours[:1]) > 1e-5 * scale):
            raise ValueError(
                "matrices depend on the heading, which zero speed does not allow; check the files"
            )
        blocks, roll = ours[0], roll[0]
    else:
        blocks, roll = _of_encounter(found, case, ours, roll, omega)
    added_mass, added_mass_add, damping, damping_add, _, restoring_add = np.moveaxis(blocks, 1, 0)
    extra = AdditionalMatrices(
        cause=ADDITIONAL_CAUSE, added_mass=added_mass_add, damping=damping_add, restoring=restoring_add
    )
    return added_mass, damping, extra, roll


def _of_encounter(
    found: VeresSet, case: Case, blocks: Array, roll: Array, omega: Array
) -> tuple[Array, Array]:
    """Blocks (n, 6, 6, 6) and roll damping (n, 2) from those of every heading, with warnings."""
    m, n = blocks.shape[:2]
    along = np.cos(np.radians(case.heading))
    along[np.abs(along) < 1e-12] = 0.0
    encounter = omega + case.speed / found.matrices.header.g * np.outer(along, omega**2)
    flat = np.concatenate([blocks.reshape(m, n, -1), roll], axis=2)
    band = _trusted(omega) or (0.0, np.inf)
    joined, apart, (low, high) = one_function(flat, omega=omega, encounter=encounter, band=band)
    if low > omega[0] * (1.0 + 1e-9) or high < omega[-1] * (1.0 - 1e-9):
        warn_caller(
            f"{found.stem}: at {case.speed:g} m/s the headings cover encounter frequencies {low:.4g} to "
            f"{high:.4g} rad/s of {omega[0]:.4g} to {omega[-1]:.4g}; the end values are held beyond, and "
            "motions there follow from that guess. Add a beam sea to the VERES run",
            EncounterFrequencyWarning,
        )
    peak = np.sqrt(np.abs(np.diagonal(blocks, axis1=3, axis2=4)).max(axis=(0, 1)))  # (kinds, 6)
    scale = peak[:, :, None] * peak[:, None, :]
    difference = apart[:-2].reshape(6, 6, 6)
    relative = np.where(scale > 0.0, difference / np.where(scale > 0.0, scale, 1.0), 0.0)
    if relative.max() > AGREEMENT:
        kind, j, k = np.unravel_index(int(relative.argmax()), relative.shape)
        name = ("A", "A_add", "B", "B_add", "C", "C_add")[int(kind)]
        warn_caller(
            f"{found.stem}: at {case.speed:g} m/s the headings differ at the same encounter frequency by up "
            f"to {relative.max():.1%} of the largest diagonals, in {name}{j + 1}{k + 1}; one function is "
            "taken for all, and motions are off accordingly",
            EncounterFrequencyWarning,
        )
    return joined[:, :-2].reshape(n, 6, 6, 6), joined[:, -2:]


def _drift(found: VeresSet, matrices: Case) -> DriftCoefficients:
    """Mean loads per squared amplitude in our axes, on the exact grid of the matrices."""
    case, head = found.case(".re2", matrices.speed), found.files[".re2"].header
    for name, digits in (("heading", HEADING_DIGITS), ("omega", DRIFT_DIGITS)):
        rough, exact = getattr(case, name), getattr(matrices, name)
        if len(rough) != len(exact) or np.any(np.abs(rough - exact) > digits):
            raise found.other_run(".re2", GRID[name])
    force = head.rho * head.g * head.breadth**2
    scale = force * np.array([1.0 / head.length, 1.0 / head.length, 1.0])
    direction = _direction(matrices.heading)
    by_heading, by_omega = np.argsort(direction), np.argsort(matrices.omega)
    load = np.zeros((*case.values.shape[:2], 6))
    load[:, :, DRIFT_MOTIONS] = case.values * scale * TO_OURS[DRIFT_MOTIONS]
    load, omega = load[by_heading][:, by_omega], matrices.omega[by_omega]
    return DriftCoefficients(heading=direction[by_heading], omega=omega, coefficient=load)


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


def _check_hydrostatics(found: VeresSet, speed: float) -> None:
    """Warn where the text of ``.hyd`` and the matrices are of different ships or loadings."""
    path = sibling(found.stem, ".hyd")
    if path is None:
        return
    text, case = read_veres_hydrostatics(path), found.case(".re7", speed)
    ship, matrix, restoring = found.matrices.header, found.matrices.mass, case.blocks[0, 0, 4]
    mass, weight = matrix[0, 0], matrix[0, 0] * ship.g
    x, z = ship.lcg_aft - case.motion_point[0], ship.vcg - case.motion_point[1]
    gyration = {
        "r44": matrix[3, 3] / mass - z**2,
        "r55": matrix[4, 4] / mass - x**2 - z**2,
        "r66": matrix[5, 5] / mass - x**2,
    }
    near = {name: float(np.sqrt(max(square, 0.0))) for name, square in gyration.items()}
    near |= {name: getattr(ship, name) for name in ("length", "breadth", "draught", "vcg")}
    near |= {
        "displacement": float(mass),
        "gm_transverse": float(restoring[3, 3] / weight),
        "gm_longitudinal": float(restoring[4, 4] / weight),
    }
    expected = {name: (value, TOLERANCE * abs(value) + ROUNDING) for name, value in near.items()}
    along = (ship.length / 2.0 - ship.lcg_aft, POSITION_TOLERANCE * ship.length)
    expected |= {"lcg": along, "lcb": along}
    different = [
        f"{entry.name} {getattr(text, entry.name):.6g} against {expected[entry.name][0]:.6g}"
        for entry in fields(text)
        if entry.name in expected
        and getattr(text, entry.name) is not None
        and not abs(getattr(text, entry.name) - expected[entry.name][0]) <= expected[entry.name][1]
    ]
    if different:
        warn_caller(
            f"{path}: contradicts {found.matrices.path.name}: {'; '.join(different)} (SI); the matrices are "
            "used, and mass, restoring and natural periods may be of another loading",
            HydrostaticsWarning,
        )


def _trusted(omega: Array) -> tuple[float, float] | None:
    """The part of 0.3 to 2.6 rad/s that the files cover, or None if that is nothing."""
    low, high = max(BAND[0], float(omega[0])), min(BAND[1], float(omega[-1]))
    return (low, high) if low < high else None


FORMAT = Format(
    name="VERES",
    files="a ShipX/VERES folder, stem or file (.re7 with .re8, .re1, .re2, .hyd)",
    looks="`.re7`: six lines of text, then density and gravity, main dimensions, counts and tables",
    can_open=is_veres,
    read=read_veres,
    takes=("speed",),
    speeds=lambda path: read_set(path).common_speeds(),
)
