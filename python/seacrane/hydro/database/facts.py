"""What a database is in a few facts: as a line, and as a table."""

from __future__ import annotations

from textwrap import shorten
from typing import Any

import numpy as np

from seacrane.hydro.data.hydro_data import HydroData
from seacrane.plotting.table import Table, facts, format_value

LETTERS = 100  # of a fact


def metacentric_height(database: HydroData) -> float:
    """GM (m) of the database's own C44 and mass; what tanks take from it is apart, in `additional`."""
    return float(database.restoring[3, 3] / (_mass(database) * database.g))


def as_line(database: HydroData) -> str:
    """For prompts."""
    omega = database.omega
    return (
        f"<HydroDatabase {database.name!r}: {_mass(database) / 1e3:.6g} t, {omega.size} frequencies "
        f"{omega[0]:.4g} to {omega[-1]:.4g} rad/s, {database.heading.size} headings>"
    )


def as_table(database: HydroData) -> Table:
    """The facts, names beside values."""
    rows = [(name, shorten(format_value(value), LETTERS)) for name, value in _facts(database)]
    return facts(rows, f"HydroDatabase {database.name!r}")


def _mass(database: HydroData) -> float:
    return float(database.mass_matrix[0, 0])


def _facts(database: HydroData) -> list[tuple[str, Any]]:
    """Main figures, what it holds, and where it comes from."""
    omega, heading = database.omega, np.rad2deg(database.heading)
    band = database.trusted_band
    memory = database.memory
    causes = ", ".join(one.cause for one in database.additional)
    return [
        ("length, breadth, draught [m]", f"{database.length:g}, {database.breadth:g}, {database.draught:g}"),
        ("mass [t]", float(f"{_mass(database) / 1e3:.6g}")),
        ("GM of its C44 and mass [m]", float(f"{metacentric_height(database):.4g}")),
        ("frequencies [rad/s]", f"{omega.size}, {omega[0]:.4g} to {omega[-1]:.4g}"),
        ("headings [deg]", f"{heading.size}, {heading[0]:.4g} to {heading[-1]:.4g}"),
        ("trusted band [rad/s]", "not stated" if band is None else f"{band[0]:.4g} to {band[1]:.4g}"),
        ("water depth [m]", "deep" if np.isinf(database.depth) else database.depth),
        ("forward speed [m/s]", database.speed),
        (
            "fitted fluid memory",
            "none" if memory is None else f"{sum(len(b.A) for b in memory.blocks)} states",
        ),
        ("additional matrices", causes or "none"),
        ("slow drift", "none" if database.drift is None else "coefficients"),
        ("reference point", database.origin),
        ("source", database.source),
    ]
