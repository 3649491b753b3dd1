"""A database as a table for notebooks."""

from __future__ import annotations

import numpy as np

from seacrane.hydro.data.hydro_data import HydroData
from seacrane.plotting.html import notebook_table


def as_html(database: HydroData) -> str:
    """Main figures, what it holds, and where it comes from."""
    omega, heading = database.omega, np.rad2deg(database.heading)
    mass = float(database.mass_matrix[0, 0])
    band = database.trusted_band
    memory = database.memory
    rows = [
        ("length, breadth, draught [m]", f"{database.length:g}, {database.breadth:g}, {database.draught:g}"),
        ("mass [t]", float(f"{mass / 1e3:.6g}")),
        ("frequencies [rad/s]", f"{omega.size}, {omega[0]:.4g} to {omega[-1]:.4g}"),
        ("headings [deg]", f"{heading.size}, {heading[0]:.4g} to {heading[-1]:.4g}"),
        ("trusted band [rad/s]", "not stated" if band is None else f"{band[0]:.4g} to {band[1]:.4g}"),
        ("water depth [m]", "deep" if np.isinf(database.depth) else database.depth),
        ("forward speed [m/s]", database.speed),
        (
            "fitted fluid memory",
            "none" if memory is None else f"{sum(len(b.A) for b in memory.blocks)} states",
        ),
        ("slow drift", "none" if database.drift is None else "coefficients"),
        ("reference point", database.origin),
        ("source", database.source),
    ]
    return notebook_table((), rows, caption=f"HydroDatabase {database.name!r}")
