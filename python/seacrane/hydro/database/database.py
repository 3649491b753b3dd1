"""`HydroDatabase`: the hydrodynamics of one vessel, with all that is done to it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import cache
from importlib.resources import files
from os import PathLike
from pathlib import Path
from textwrap import shorten
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from seacrane.arrays import Array, Complex
from seacrane.errors import SceneError
from seacrane.hydro.data.excitation import force_at, full_circle
from seacrane.hydro.data.hydro_data import HydroData
from seacrane.hydro.data.hydro_group_data import mass_of
from seacrane.hydro.data.motion import natural_frequency
from seacrane.hydro.data.packed import digest_of
from seacrane.hydro.database.check import check_database, metacentric_height
from seacrane.hydro.database.figures import hydro_sheets
from seacrane.hydro.database.netcdf import dataset_of, load_database_file, save_database
from seacrane.hydro.database.transform import mirrored_database, moved_database, selected_database
from seacrane.inputs.checked import not_negative_of
from seacrane.inputs.keywords import named
from seacrane.plotting.panel import draw
from seacrane.plotting.table import Table, facts, format_value

if TYPE_CHECKING:
    from matplotlib.figure import Figure

LETTERS = 100  # of a fact


class HydroDatabase(HydroData):
    __doc__ = HydroData.__doc__

    at = moved_database
    mirror = mirrored_database
    select = selected_database
    check = check_database
    save = save_database
    to_xarray = dataset_of

    def force_at(
        self, omega: ArrayLike, heading: ArrayLike, *, outside: Literal["error", "limits"] = "error"
    ) -> Complex:
        """Complex wave excitation per metre of amplitude, by cubic splines in frequency and heading.

        Parameters
        ----------
        omega, heading : rad/s and rad, broadcast against each other; headings wrap, and are mirrored where
            the vessel is port-starboard symmetric.
        outside : what to do with frequencies beyond the database: ``"error"``, or ``"limits"``: below it the
            force tends to the hydrostatic one of a long wave, above it there is none.

        Returns
        -------
        (..., 6) N/m and N m/m, a new array.

        Raises
        ------
        SceneError : a frequency outside the range (unless ``outside="limits"``), a value that is not finite,
            or a heading in a gap of more than 45 degrees between the database's headings.
        """
        return force_at(self, omega, heading, outside=outside)

    def full_circle(self) -> tuple[Array, Complex]:
        """Headings (k,) within [0, 2 pi), the mirrored ones added, and their forces (k, n, 6); new arrays."""
        return full_circle(self)

    def without_mooring(self) -> HydroDatabase:
        """The database without the stiffness of surge, sway and yaw that its restoring holds.

        What a mooring added to heave, roll and pitch among themselves stays: nothing tells it from water.
        """
        kept = self.restoring.copy()
        kept[[0, 1, 5], :] = 0.0
        kept[:3, [0, 1, 5]] = 0.0
        return replace(self, restoring=kept)

    def with_roll_damping(
        self, *, linear: float = 0.0, quadratic: float = 0.0, fraction: float = 0.0
    ) -> HydroDatabase:
        """The database with this roll damping beside radiation, in place of what it has.

        Parameters
        ----------
        linear : N m s/rad, of the rate of roll.
        quadratic : N m s2/rad2, of rate |rate|; `ikeda_roll_damping` estimates both.
        fraction : of the critical damping at the roll natural frequency, added to ``linear``.

        Raises
        ------
        SceneError : a negative value, or a fraction where the roll natural frequency is outside the table.
        """
        for what, value in (("linear", linear), ("quadratic", quadratic), ("fraction", fraction)):
            not_negative_of(f"database {self.name!r}: roll damping, {what}", value)
        whole, squares = self.linear_damping.copy(), self.quadratic_damping.copy()
        whole[3, 3], squares[3] = linear, quadratic
        if fraction:
            whole[3, 3] = linear + _roll_damping_of(self, fraction)
        return replace(self, linear_damping=whole, quadratic_damping=squares, roll_damping=None)

    def plot(self, what: str | Sequence[str] | None = None) -> dict[str, Figure]:
        """Figures by name: added_mass, damping, retardation, wave_force, motion; needs matplotlib.

        Parameters
        ----------
        what : a name or several; None draws all, of a database without a mass without its motions. Fitted
            curves are those of `memory`, where there is one.

        Returns
        -------
        dict of matplotlib.figure.Figure : they belong to no window; ``savefig`` writes one.

        Raises
        ------
        ValueError : a name that is not among the figures.
        """
        names = [what] if isinstance(what, str) else what
        return {name: draw(sheet) for name, sheet in hydro_sheets(self, names).items()}

    @property
    def digest(self) -> str:
        """SHA-256 of all that it holds: equal for databases that say the same."""
        return digest_of(self)

    def __repr__(self) -> str:
        omega, mass = self.omega, self.mass_matrix
        weight = "no mass" if mass is None else f"{mass[0, 0] / 1e3:.6g} t"
        return (
            f"<HydroDatabase {self.name!r}: {weight}, {omega.size} frequencies {omega[0]:.4g} to "
            f"{omega[-1]:.4g} rad/s, {self.heading.size} headings>"
        )

    def __str__(self) -> str:
        return str(_facts(self))

    def _repr_html_(self) -> str:
        return _facts(self)._repr_html_()

    @staticmethod
    def load(path: str | PathLike[str]) -> HydroDatabase:
        """Read a file written by `save`.

        Raises
        ------
        seacrane.errors.FileFormatError : the file is not one of ours, or is damaged.
        """
        return load_database_file(HydroDatabase, path)


def _roll_damping_of(database: HydroData, fraction: float) -> float:
    """N m s/rad: a fraction of the critical roll damping at the roll natural frequency."""
    resonance = natural_frequency(database, 3)
    if resonance is None:
        raise SceneError(
            f"hull {database.name!r}: the roll natural frequency lies outside {database.omega[0]:.4g} to "
            f"{database.omega[-1]:.4g} rad/s; widen omega, or check centre of gravity and radii of gyration"
        )
    inertia = mass_of(database)[3, 3] + np.interp(resonance, database.omega, database.added_mass[:, 3, 3])
    return float(fraction * 2.0 * np.sqrt(database.restoring[3, 3] * inertia))


def _facts(database: HydroData) -> Table:
    """Main figures, what it holds, and where it comes from."""
    omega, heading = database.omega, np.rad2deg(database.heading)
    band, memory, mass = database.trusted_band, database.memory, database.mass_matrix
    weight: float | str = "none"
    height: float | str = "none"
    if mass is not None:
        weight, height = float(f"{mass[0, 0] / 1e3:.6g}"), float(f"{metacentric_height(database):.4g}")
    rows: list[tuple[str, Any]] = [
        ("length, breadth, draught [m]", f"{database.length:g}, {database.breadth:g}, {database.draught:g}"),
        ("mass [t]", weight),
        ("GM of its C44 and mass [m]", height),
        ("frequencies [rad/s]", f"{omega.size}, {omega[0]:.4g} to {omega[-1]:.4g}"),
        ("headings [deg]", f"{heading.size}, {heading[0]:.4g} to {heading[-1]:.4g}"),
        ("trusted band [rad/s]", "not stated" if band is None else f"{band[0]:.4g} to {band[1]:.4g}"),
        ("water depth [m]", "deep" if np.isinf(database.depth) else database.depth),
        ("forward speed [m/s]", database.speed),
        ("fitted fluid memory", "none" if memory is None else f"{memory.states} states"),
        ("additional matrices", ", ".join(one.cause for one in database.additional) or "none"),
        ("slow drift", "none" if database.drift is None else "coefficients"),
        ("reference point", database.origin),
        ("source", database.source),
    ]
    shown = [(name, shorten(format_value(value), LETTERS)) for name, value in rows]
    return facts(shown, f"HydroDatabase {database.name!r}")


@named
@cache
def shipped_database() -> HydroDatabase:
    """The database of the 115 m hull that comes with the package, memory included; read once, immutable."""
    return HydroDatabase.load(Path(str(files("seacrane") / "data" / "hull_115.nc")))
