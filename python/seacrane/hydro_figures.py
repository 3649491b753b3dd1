"""Plots of a hydrodynamic database: added mass, damping and their fits, wave forces, motions."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from seacrane.figures import Line, Panel, Picture, Sheet, save_sheet
from seacrane.result import MOTIONS

if TYPE_CHECKING:
    from seacrane.hydro import HydroDatabase, MemoryModel

Array = NDArray[np.float64]

NEGLIGIBLE = 1e-4  # of the geometric mean of the diagonals: such an entry is not drawn
HEADINGS_DEG = (0, 45, 90, 135, 180)
ADDED_MASS_UNITS = ("kg", "kg m", "kg m2")
DAMPING_UNITS = ("kg/s", "kg m/s", "kg m2/s")


def drawn_entries(matrices: Array) -> list[tuple[int, int]]:
    """Entries (j, k), j <= k, of matrices (n, 6, 6) that are not negligible anywhere."""
    size = np.abs(matrices).max(axis=0)
    scale = np.sqrt(np.outer(size.diagonal(), size.diagonal()))
    return [(j, k) for j in range(6) for k in range(j, 6) if size[j, k] > NEGLIGIBLE * scale[j, k] > 0]


def matrix_sheet(
    *, omega: Array, data: Array, fitted: Array | None, symbol: str, units: tuple[str, str, str], title: str
) -> Sheet:
    """Every entry of a matrix over frequency, data and fit.

    Parameters
    ----------
    omega : ndarray, shape (n,)
        rad/s.
    data, fitted : ndarray, shape (n, 6, 6)
        SI; no fitted lines if None.
    symbol : str
        A or B.
    units : (str, str, str)
        Of entries between two translations, one translation and one rotation, two rotations.
    title : str
        Heading.
    """
    panels = []
    for j, k in drawn_entries(data):
        lines = [Line(label="database", values=data[:, j, k], colour=0)]
        if fitted is not None:
            lines.append(Line(label="memory model", values=fitted[:, j, k], colour=1, style="--"))
        unit = units[(j > 2) + (k > 2)]
        panels.append(Panel(quantity=f"{symbol}{j + 1}{k + 1}", unit=unit, lines=tuple(lines)))
    return Sheet(
        title=title,
        caption="x forward, y to port, z up; upper triangle, entries that are not negligible.",
        abscissa=omega,
        abscissa_name="omega",
        abscissa_unit="rad/s",
        panels=tuple(panels),
        columns=2,
    )


def chosen_headings(database: HydroDatabase) -> dict[str, int]:
    """The heading nearest to each of `HEADINGS_DEG`, on either side of a symmetric ship."""
    chosen = {}
    for wanted in np.deg2rad(HEADINGS_DEG):
        sides = (wanted, -wanted) if database.port_starboard_symmetric else (wanted,)
        away = np.min([np.abs(np.angle(np.exp(1j * (database.heading - side)))) for side in sides], axis=0)
        index = int(np.argmin(away))
        chosen[f"{np.rad2deg(database.heading[index]):.4g} deg"] = index
    return chosen


def force_sheet(database: HydroDatabase) -> Sheet:
    """Amplitude of the wave force per metre of wave amplitude, at a few headings."""
    headings = chosen_headings(database)
    panels = tuple(
        Panel(
            quantity=f"|{motion} force|",
            unit="N/m" if i < 3 else "N m/m",
            lines=tuple(
                Line(label=label, values=np.abs(database.force[index, :, i]), colour=place)
                for place, (label, index) in enumerate(headings.items())
            ),
        )
        for i, motion in enumerate(MOTIONS)
    )
    return Sheet(
        title=f"Wave forces, {database.name}",
        caption="Per metre of wave amplitude; the angle is the direction the waves travel to, 0 following.",
        abscissa=database.omega,
        abscissa_name="omega",
        abscissa_unit="rad/s",
        panels=panels,
        columns=2,
    )


def motion_sheet(database: HydroDatabase) -> Sheet:
    """Motions solved from the database, beside the file's own where it holds them."""
    from seacrane.hydro import motion_response

    solved = motion_response(database)
    panels = []
    for i, motion in enumerate(MOTIONS):
        lines = []
        for place, (label, index) in enumerate(chosen_headings(database).items()):
            lines.append(Line(label=label, values=_degrees(np.abs(solved[index, :, i]), i), colour=place))
            if database.motion_rao is not None:
                values = _degrees(np.abs(database.motion_rao[index, :, i]), i)
                lines.append(Line(label=f"{label}, file", values=values, colour=place, style="x"))
        panels.append(Panel(quantity=f"|{motion}|", unit="m/m" if i < 3 else "deg/m", lines=tuple(lines)))
    return Sheet(
        title=f"Motions, {database.name}",
        caption="Per metre of wave amplitude, solved from mass, added mass, damping, restoring and wave "
        "forces; crosses are the motions the file holds. The angle is the direction the waves travel to, "
        "0 following.",
        abscissa=database.omega,
        abscissa_name="omega",
        abscissa_unit="rad/s",
        panels=tuple(panels),
        columns=2,
    )


def _degrees(values: Array, motion: int) -> Array:
    return np.rad2deg(values) if motion > 2 else values


def save_hydro_figures(
    *, database: HydroDatabase, folder: Path, memory: MemoryModel | None = None
) -> list[Picture]:
    """Write added_mass, damping, wave_force and motion, each as .png and .csv.

    Parameters
    ----------
    database : HydroDatabase
        Any database.
    folder : Path
        Existing folder.
    memory : MemoryModel, optional
        Whose fitted matrices are drawn over the data; the database's own if None, and none if it has none.

    Returns
    -------
    list of Picture
    """
    memory = memory or database.memory
    fitted = memory.frequency_response(database.omega) if memory is not None else (None, None)
    parts = {
        "added_mass": (database.added_mass, fitted[0], "A", ADDED_MASS_UNITS, "Added mass"),
        "damping": (database.damping, fitted[1], "B", DAMPING_UNITS, "Radiation damping"),
    }
    sheets = {
        stem: matrix_sheet(
            omega=database.omega, data=data, fitted=fit, symbol=symbol, units=units,
            title=f"{name}, {database.name}",
        )
        for stem, (data, fit, symbol, units, name) in parts.items()
    }  # fmt: skip
    sheets |= {"wave_force": force_sheet(database), "motion": motion_sheet(database)}
    return [save_sheet(sheet, folder, stem) for stem, sheet in sheets.items() if sheet.panels]
