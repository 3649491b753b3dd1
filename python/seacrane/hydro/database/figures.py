"""Plots of a hydrodynamic database: added mass, damping, memory and their fits, wave forces, motions."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from seacrane.arrays import Array, Complex
from seacrane.hydro.data.heading_circle import PORT_STARBOARD
from seacrane.hydro.data.hydro_data import HydroData
from seacrane.hydro.data.hydro_group_data import in_trusted_band
from seacrane.hydro.data.motion import motion_response
from seacrane.hydro.data.relations import retardation_from_damping
from seacrane.inputs.frames import MOTIONS
from seacrane.plotting.panel import Line, Panel, Picture, Sheet, save_sheet

NEGLIGIBLE = 1e-4  # of the geometric mean of the diagonals: such an entry is not drawn
HEADINGS_DEG = (0, 45, 90, 135, 180)
HEADING_COLOURS = (0, 1, 2, 3, 6)  # of the palette: told apart in print
ADDED_MASS = (
    "Added mass",
    "A",
    ("kg", "kg m", "kg m2"),
)  # letter; of two translations, one of each, rotations
DAMPING = ("Radiation damping", "B", ("kg/s", "kg m/s", "kg m2/s"))
RETARDATION = ("Retardation functions", "K", ("N/m", "N", "N m"))
FAINT = 1e-2  # of the largest: its phase is not drawn
BAND = "trusted band: the source vouches for its numbers"


def matrix_panels(
    quantity: tuple[str, str, tuple[str, str, str]], curves: dict[str, Array], count: int
) -> list[Panel]:
    """Every entry (j, k), j <= k, that is not negligible anywhere, over ``count`` frequencies or times.

    ``curves`` are (n, 6, 6) or (6, 6), by label, SI. The first decides which entries are drawn; a constant
    becomes a dotted line.
    """
    _, symbol, units = quantity
    size = np.abs(next(iter(curves.values()))).max(axis=0)
    scale = np.sqrt(np.outer(size.diagonal(), size.diagonal()))
    panels = []
    for j, k in zip(*np.triu_indices(6), strict=True):
        if not size[j, k] > NEGLIGIBLE * scale[j, k] > 0:
            continue
        lines = [
            Line(
                label=label,
                values=np.broadcast_to(matrices[..., j, k], count).copy(),
                colour=place,
                style=":" if matrices.ndim == 2 else ("-", "--")[min(place, 1)],
            )
            for place, (label, matrices) in enumerate(curves.items())
        ]
        unit = units[int(j > 2) + int(k > 2)]
        panels.append(Panel(quantity=f"{symbol}{j + 1}{k + 1}", unit=unit, lines=tuple(lines)))
    return panels


def _sheet(
    database: HydroData, title: str, caption: str, panels: Sequence[Panel], time: Array | None = None
) -> Sheet:
    """Panels over the frequency with its trusted band, or over time."""
    return Sheet(
        title=f"{title}, {database.name}", caption=caption,
        abscissa=database.omega if time is None else time,
        abscissa_name="omega" if time is None else "time", abscissa_unit="rad/s" if time is None else "s",
        panels=tuple(panels), columns=2, shaded=database.trusted_band if time is None else None,
        shaded_name=BAND,
    )  # fmt: skip


ENTRIES = "x forward, y to port, z up; upper triangle, entries that are not negligible."


def radiation_sheet(database: HydroData, part: int) -> Sheet:
    """Added mass and its limits at infinite frequency (``part`` 0), or damping (1), and its fit.

    Beside radiation all causes together (tanks), where the additional restoring counts as added mass,
    -C / omega^2, as in the fit.
    """
    memory, additional = database.memory, database.additional
    radiation = (database.added_mass, database.damping)[part]
    curves = {"database": radiation}
    if memory is not None:
        fitted = memory.frequency_response(database.omega)[part]
        curves["memory model"] = fitted
    if additional:
        square = database.omega[:, None, None] ** 2
        more = [(one.added_mass - one.restoring / square, one.damping)[part] for one in additional]
        causes = ", ".join(each.cause for each in additional)
        curves[f"with {causes}"] = radiation + sum(more)
        if memory is not None:
            curves[f"model with {causes}"] = fitted + memory.additional_response(database.omega)[part]
    if part == 0 and memory is not None:
        curves["model, infinite frequency"] = memory.added_mass
    if part == 0 and database.infinite_frequency_added_mass is not None:
        curves["database, infinite frequency"] = database.infinite_frequency_added_mass
    quantity = (ADDED_MASS, DAMPING)[part]
    return _sheet(database, quantity[0], ENTRIES, matrix_panels(quantity, curves, len(database.omega)))


def retardation_sheet(database: HydroData) -> Sheet:
    """Retardation functions: cosine transform of the damping, and the memory model's impulse response."""
    time = np.linspace(0.0, 10.0 * np.sqrt(database.length / database.g), 401)
    curves = {"from damping": retardation_from_damping(database, time)}
    if database.memory is not None:
        curves["memory model"] = database.memory.impulse_response(time)
    caption = (
        " Damping is transformed up to the end of the trusted band, joined by straight lines, with a tail as "
        "omega^-3."
    )
    panels = matrix_panels(RETARDATION, curves, len(time))
    return _sheet(database, RETARDATION[0], ENTRIES + caption, panels, time)


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


def _polar_panels(
    database: HydroData, table: Complex, what: str, units: tuple[str, str], *,
    doubtful: NDArray[np.bool_], file: Complex | None = None,
) -> list[Panel]:  # fmt: skip
    """Amplitudes, then phases of (m, n, 6) at a few headings; ``file`` as crosses, units of both kinds.

    Phases are left out where ``doubtful`` (n,), and of what is below 1 % of its largest.
    """
    headings = list(zip(HEADING_COLOURS, chosen_headings(database).items(), strict=False))
    tables = {"": (table, "-")} | ({} if file is None else {", file": (file, "x")})
    amplitudes, phases = [], []
    for i, motion in enumerate(MOTIONS):
        unit, least = units[i > 2], FAINT * np.nanmax(np.abs(table[..., i]))
        size, phase = [], []
        for colour, (label, (index, signs)) in headings:
            for more, (values, style) in tables.items():
                one = np.abs(values[index, :, i])
                one = np.rad2deg(one) if unit.startswith("deg") else one
                size.append(Line(label=f"{label}{more}", values=one, colour=colour, style=style))
            there = table[index, :, i] * signs[i]
            faint = ~(np.abs(there) >= least) | doubtful
            angle = np.where(faint, np.nan, np.rad2deg(np.angle(there)))
            phase.append(Line(label=label, values=angle, colour=colour, style="."))
        amplitudes.append(Panel(quantity=f"|{motion}{what}|", unit=unit, lines=tuple(size)))
        phases.append(Panel(quantity=f"{motion}{what} phase", unit="deg", lines=tuple(phase)))
    return amplitudes + phases


def force_sheet(database: HydroData) -> Sheet:
    """Amplitude and phase of the wave force per metre of wave amplitude, at a few headings."""
    caption = (
        "Per metre of wave amplitude; the angle is the direction the waves travel to, 0 following. "
        "Phases are ahead of the crest at the reference point; those outside the trusted band, and of forces "
        "below 1 % of their largest, are left out."
    )
    doubtful, units = ~in_trusted_band(database), ("N/m", "N m/m")
    panels = _polar_panels(database, database.force, " force", units, doubtful=doubtful)
    return _sheet(database, "Wave forces", caption, panels)


def motion_sheet(database: HydroData) -> Sheet:
    """Motions solved from the database, beside the file's own where it holds them."""
    caption = (
        "Per metre of wave amplitude, solved from mass, added mass, damping, restoring and wave "
        "forces; crosses are the motions the file holds. The angle is the direction the waves travel to, "
        "0 following. Phases are ahead of the crest, of motions above 1 % of their largest."
    )
    doubtful = np.zeros(len(database.omega), dtype=bool)
    panels = _polar_panels(
        database, motion_response(database), "", ("m/m", "deg/m"), doubtful=doubtful,
        file=database.motion_rao,
    )  # fmt: skip
    return _sheet(database, "Motions", caption, panels)


SHEETS: dict[str, Callable[[HydroData], Sheet]] = {
    "added_mass": lambda database: radiation_sheet(database, 0),
    "damping": lambda database: radiation_sheet(database, 1),
    "retardation": retardation_sheet,
    "wave_force": force_sheet,
    "motion": motion_sheet,
}


def hydro_sheets(database: HydroData, names: Sequence[str] | None = None) -> dict[str, Sheet]:
    """Sheets by the names in `SHEETS`, with the curves of the database's own memory, where it has one; those
    without any panel are left out, and of all (None) the motions of a database without a mass.

    Raises
    ------
    ValueError
        An unknown name.
    """
    if names is None:
        names = [name for name in SHEETS if name != "motion" or database.mass_matrix is not None]
    for name in names:
        if name not in SHEETS:
            raise ValueError(
                f"database {database.name!r}: there is no figure {name!r}; choose among {', '.join(SHEETS)}"
            )
    sheets = {name: SHEETS[name](database) for name in names}
    return {name: sheet for name, sheet in sheets.items() if sheet.panels}


def save_hydro_figures(*, database: HydroData, folder: Path) -> list[Picture]:
    """Write all figures of a database into an existing folder, each as .png and .csv."""
    return [save_sheet(sheet, folder, stem) for stem, sheet in hydro_sheets(database).items()]
