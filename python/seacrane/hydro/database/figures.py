"""Plots of a hydrodynamic database: added mass, damping, memory and their fits, wave forces, motions."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from seacrane.hydro.data.heading_circle import PORT_STARBOARD
from seacrane.hydro.data.hydro_data import HydroData
from seacrane.hydro.data.hydro_group_data import in_trusted_band
from seacrane.hydro.data.memory_model import MemoryModel
from seacrane.hydro.data.motion import motion_response
from seacrane.hydro.data.relations import retardation_from_damping
from seacrane.inputs.frames import MOTIONS
from seacrane.plotting.panel import Line, Panel, Picture, Sheet, save_sheet

Array = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

NEGLIGIBLE = 1e-4  # of the geometric mean of the diagonals: such an entry is not drawn
HEADINGS_DEG = (0, 45, 90, 135, 180)
HEADING_COLOURS = (0, 1, 2, 3, 6)  # of the palette: told apart in print
RADIATION = (
    ("Added mass", "A", ("kg", "kg m", "kg m2")),
    ("Radiation damping", "B", ("kg/s", "kg m/s", "kg m2/s")),
)
RETARDATION = ("Retardation functions", "K", ("N/m", "N", "N m"))
FAINT = 1e-2  # of a force's largest: its phase is not drawn
BAND = "trusted band: the source vouches for its numbers"


def drawn_entries(matrices: Array) -> list[tuple[int, int]]:
    """Entries (j, k), j <= k, of matrices (n, 6, 6) that are not negligible anywhere."""
    size = np.abs(matrices).max(axis=0)
    scale = np.sqrt(np.outer(size.diagonal(), size.diagonal()))
    return [(j, k) for j in range(6) for k in range(j, 6) if size[j, k] > NEGLIGIBLE * scale[j, k] > 0]


def matrix_sheet(
    abscissa: tuple[str, str, Array], curves: dict[str, Array], matrix: tuple[str, str, tuple[str, str, str]],
    *, name: str, caption: str = "", band: tuple[float, float] | None = None,
) -> Sheet:  # fmt: skip
    """Every entry of a matrix over frequency or time.

    Parameters
    ----------
    abscissa : name, unit and values (n,).
    curves : (n, 6, 6) or (6, 6), by label, SI. The first decides which entries are drawn; a constant becomes
        a dotted line.
    matrix : what it is, its letter, and its units between two translations, one of each, two rotations.
    name, caption : of the database, and what follows the usual sentence below.
    band : rad/s, shaded.
    """
    quantity, symbol, units = matrix
    panels = []
    for j, k in drawn_entries(next(iter(curves.values()))):
        lines = [
            Line(
                label=label,
                values=np.broadcast_to(matrices[..., j, k], abscissa[2].shape).copy(),
                colour=place,
                style=":" if matrices.ndim == 2 else ("-", "--")[min(place, 1)],
            )
            for place, (label, matrices) in enumerate(curves.items())
        ]
        unit = units[(j > 2) + (k > 2)]
        panels.append(Panel(quantity=f"{symbol}{j + 1}{k + 1}", unit=unit, lines=tuple(lines)))
    caption = "x forward, y to port, z up; upper triangle, entries that are not negligible." + caption
    return _sheet(f"{quantity}, {name}", caption, abscissa, panels, band)


def _sheet(
    title: str, caption: str, abscissa: tuple[str, str, Array], panels: Sequence[Panel],
    band: tuple[float, float] | None,
) -> Sheet:  # fmt: skip
    name, unit, values = abscissa
    return Sheet(
        title=title,
        caption=caption,
        abscissa=values,
        abscissa_name=name,
        abscissa_unit=unit,
        panels=tuple(panels),
        columns=2,
        shaded=band,
        shaded_name=BAND,
    )


def with_additional(database: HydroData, memory: MemoryModel | None, part: int) -> dict[str, Array]:
    """Radiation and all other causes (tanks) together, and their fit; ``part``: 0 added mass, 1 damping.

    Additional restoring counts as added mass, -C / omega^2, as in the fit.
    """
    if not database.additional:
        return {}
    square = database.omega[:, None, None] ** 2
    sums = [
        database.added_mass + sum(each.added_mass - each.restoring / square for each in database.additional),
        database.damping + sum(each.damping for each in database.additional),
    ]
    causes = ", ".join(each.cause for each in database.additional)
    curves = {f"with {causes}": sums[part]}
    if memory is not None:
        fit = memory.frequency_response(database.omega), memory.additional_response(database.omega)
        curves[f"model with {causes}"] = fit[0][part] + fit[1][part]
    return curves


def radiation_sheet(database: HydroData, memory: MemoryModel | None, part: int) -> Sheet:
    """Added mass and its limits at infinite frequency (``part`` 0), or damping (1), and its fit."""
    curves = {"database": (database.added_mass, database.damping)[part]}
    if memory is not None:
        curves["memory model"] = memory.frequency_response(database.omega)[part]
    curves |= with_additional(database, memory, part)
    if part == 0 and memory is not None:
        curves["model, infinite frequency"] = memory.added_mass
    if part == 0 and database.infinite_frequency_added_mass is not None:
        curves["database, infinite frequency"] = database.infinite_frequency_added_mass
    abscissa = ("omega", "rad/s", database.omega)
    return matrix_sheet(abscissa, curves, RADIATION[part], name=database.name, band=database.trusted_band)


def retardation_sheet(database: HydroData, memory: MemoryModel | None) -> Sheet:
    """Retardation functions: cosine transform of the damping, and the memory model's impulse response."""
    time = np.linspace(0.0, 10.0 * np.sqrt(database.length / database.g), 401)
    curves = {"from damping": retardation_from_damping(database, time)}
    if memory is not None:
        curves["memory model"] = memory.impulse_response(time)
    return matrix_sheet(
        ("time", "s", time),
        curves,
        RETARDATION,
        name=database.name,
        caption=" Damping is transformed up to the end of the trusted band, joined by straight lines, with "
        "a tail as omega^-3.",
    )


def chosen_headings(database: HydroData) -> dict[str, tuple[int, Array]]:
    """By label, the heading nearest to each of `HEADINGS_DEG`, and the signs (6,) of its forces there.

    A symmetric ship has the mirror images too: a table of one side serves for the other.
    """
    chosen = {}
    for wanted in np.deg2rad(HEADINGS_DEG):
        sides = (database.heading, -database.heading)[: 1 + database.port_starboard_symmetric]
        away = np.array([np.abs(np.angle(np.exp(1j * (side - wanted)))) for side in sides])
        side, index = np.unravel_index(int(np.argmin(away)), away.shape)
        angle = np.rad2deg(np.mod(sides[side][index], 2.0 * np.pi))
        label = f"{np.round(angle, 6) % 360.0:.4g} deg"
        chosen[label] = int(index), PORT_STARBOARD if side else np.ones(6)
    return chosen


def force_sheet(database: HydroData) -> Sheet:
    """Amplitude and phase of the wave force per metre of wave amplitude, at a few headings."""
    headings = chosen_headings(database)
    force = np.array([database.force[index] * signs for index, signs in headings.values()])
    size = np.abs(force)
    doubtful = ~in_trusted_band(database)
    faint = (size < FAINT * np.abs(database.force).max(axis=(0, 1))) | doubtful[:, None]
    phase = np.where(faint, np.nan, np.rad2deg(np.angle(force)))

    def panel(quantity: str, unit: str, values: Array, style: str) -> Panel:
        lines = [
            Line(label=label, values=values[place], colour=HEADING_COLOURS[place], style=style)
            for place, label in enumerate(headings)
        ]
        return Panel(quantity=quantity, unit=unit, lines=tuple(lines))

    amplitudes = [
        panel(f"|{motion} force|", "N/m" if i < 3 else "N m/m", size[:, :, i], "-")
        for i, motion in enumerate(MOTIONS)
    ]
    phases = [panel(f"{motion} force phase", "deg", phase[:, :, i], ".") for i, motion in enumerate(MOTIONS)]
    caption = (
        "Per metre of wave amplitude; the angle is the direction the waves travel to, 0 following. "
        "Phases are ahead of the crest at the reference point; those outside the trusted band, and of forces "
        "below 1 % of their largest, are left out."
    )
    abscissa = ("omega", "rad/s", database.omega)
    return _sheet(
        f"Wave forces, {database.name}", caption, abscissa, [*amplitudes, *phases], database.trusted_band
    )


def motion_sheet(database: HydroData) -> Sheet:
    """Motions solved from the database, beside the file's own where it holds them."""
    solved = motion_response(database)
    panels = []
    for i, motion in enumerate(MOTIONS):
        lines = []
        for place, (label, (index, _)) in enumerate(chosen_headings(database).items()):
            colour = HEADING_COLOURS[place]
            lines.append(Line(label=label, values=_degrees(np.abs(solved[index, :, i]), i), colour=colour))
            if database.motion_rao is not None:
                values = _degrees(np.abs(database.motion_rao[index, :, i]), i)
                lines.append(Line(label=f"{label}, file", values=values, colour=colour, style="x"))
        panels.append(Panel(quantity=f"|{motion}|", unit="m/m" if i < 3 else "deg/m", lines=tuple(lines)))
    panels += [_motion_phase(database, solved, i, motion) for i, motion in enumerate(MOTIONS)]
    caption = (
        "Per metre of wave amplitude, solved from mass, added mass, damping, restoring and wave "
        "forces; crosses are the motions the file holds. The angle is the direction the waves travel to, "
        "0 following. Phases are ahead of the crest, of motions above 1 % of their largest."
    )
    abscissa = ("omega", "rad/s", database.omega)
    return _sheet(f"Motions, {database.name}", caption, abscissa, panels, database.trusted_band)


def _motion_phase(database: HydroData, solved: ComplexArray, i: int, motion: str) -> Panel:
    """Phase of a motion ahead of the crest, where it is above 1 % of its largest."""
    lines = []
    for place, (label, (index, signs)) in enumerate(chosen_headings(database).items()):
        values = solved[index, :, i] * signs[i]
        faint = ~(np.abs(values) >= FAINT * np.nanmax(np.abs(solved[..., i])))
        phase = np.where(faint, np.nan, np.rad2deg(np.angle(values)))
        lines.append(Line(label=label, values=phase, colour=HEADING_COLOURS[place], style="."))
    return Panel(quantity=f"{motion} phase", unit="deg", lines=tuple(lines))


def _degrees(values: Array, motion: int) -> Array:
    return np.rad2deg(values) if motion > 2 else values


SHEETS: dict[str, Callable[[HydroData, MemoryModel | None], Sheet]] = {
    "added_mass": lambda database, memory: radiation_sheet(database, memory, 0),
    "damping": lambda database, memory: radiation_sheet(database, memory, 1),
    "retardation": retardation_sheet,
    "wave_force": lambda database, _: force_sheet(database),
    "motion": lambda database, _: motion_sheet(database),
}


def hydro_sheets(database: HydroData, names: Sequence[str] = tuple(SHEETS)) -> dict[str, Sheet]:
    """Sheets by the names in `SHEETS`, with the curves of the database's own memory, where it has one; those
    without any panel are left out.

    Raises
    ------
    ValueError
        An unknown name.
    """
    for name in names:
        if name not in SHEETS:
            raise ValueError(
                f"database {database.name!r}: there is no figure {name!r}; choose among {', '.join(SHEETS)}"
            )
    sheets = {name: SHEETS[name](database, database.memory) for name in names}
    return {name: sheet for name, sheet in sheets.items() if sheet.panels}


def save_hydro_figures(*, database: HydroData, folder: Path) -> list[Picture]:
    """Write all figures of a database into an existing folder, each as .png and .csv."""
    return [save_sheet(sheet, folder, stem) for stem, sheet in hydro_sheets(database).items()]
