"""Strip theory against the panel method on the shipped hull: ``python tools/compare_strip_panel.py``.

Draws the figures of docs/hull-hydrodynamics.md; `benchmarks/measure/strip.py` measures its table. Results
of the panel method are those of the shipped database.
"""

from __future__ import annotations

import argparse
from dataclasses import replace
from pathlib import Path

import numpy as np
from make_database import GM_TRANSVERSE, MASS, ROLL_DAMPING_FRACTION
from matplotlib.figure import Figure
from numpy.typing import NDArray

from seacrane.hydro import HydroDatabase, hydro_from_hull, shipped_database
from seacrane.hydro.hull.hull import shipped_hull

ENTRIES = ((1, 1), (2, 2), (3, 3), (4, 4), (5, 5), (1, 3), (2, 4), (1, 5))
HEADINGS_DEG = (180, 135, 90)
MOTIONS = ("surge", "sway", "heave", "roll", "pitch", "yaw")
UNITS = {"A": ("kg", "kg m", "kg m2"), "B": ("kg/s", "kg m/s", "kg m2/s")}


def main() -> None:
    """Figures to the folder."""
    parser = argparse.ArgumentParser(description=__doc__)
    root = Path(__file__).resolve().parents[1]
    parser.add_argument("--out", type=Path, default=root / "docs" / "figures")
    folder = parser.parse_args().out
    panel, strip = shipped_database(), strip_database()
    for symbol, name in (("A", "added_mass"), ("B", "damping")):
        matrix_figure(symbol, name, panel, strip).savefig(folder / f"strip_panel_{name}.png", dpi=110)
    force_figure(panel, strip).savefig(folder / "strip_panel_excitation.png", dpi=110)


def strip_database() -> HydroDatabase:
    """The shipped hull on the shipped grids, by strip theory."""
    panel = shipped_database()
    hull = replace(shipped_hull(), name="hull_115_strip")
    centre = [0.0, 0.0, hull.hydrostatics.metacentre_transverse - GM_TRANSVERSE]
    strip = hydro_from_hull(
        hull,
        center_of_gravity=centre,
        mass=MASS,
        omega=panel.omega,
        heading=panel.heading,
        roll_damping_fraction=ROLL_DAMPING_FRACTION,
    )
    # The same added damping for both: its fraction of critical depends a little on the added mass.
    return replace(strip, linear_damping=panel.linear_damping)


def matrix_figure(symbol: str, name: str, panel: HydroDatabase, strip: HydroDatabase) -> Figure:
    """Diagonals that strip theory has, and the heave-pitch coupling."""
    figure = Figure(figsize=(11.0, 6.0), layout="constrained")
    for axes, (j, k) in zip(figure.subplots(2, 3).flat, (*ENTRIES[:5], (2, 4)), strict=True):
        axes.plot(panel.omega, getattr(panel, name)[:, j, k], color="black", label="panels (Capytaine)")
        axes.plot(strip.omega, getattr(strip, name)[:, j, k], "--", color="tab:red", label="strip theory")
        axes.axvspan(0.8, 1.3, color="0.92")
        axes.set(
            ylabel=f"{symbol}{j + 1}{k + 1} [{UNITS[symbol][(j > 2) + (k > 2)]}]", xlabel="omega [rad/s]"
        )
        bounds = np.concatenate([getattr(panel, name)[4:, j, k], getattr(strip, name)[4:, j, k]])
        axes.set(xlim=(0.1, 2.5), ylim=limits(bounds))
    figure.axes[0].legend()
    return figure


def limits(values: NDArray[np.float64]) -> tuple[float, float]:
    low, high = min(0.0, float(values.min())), max(0.0, float(values.max()))
    return low - 0.05 * (high - low), high + 0.05 * (high - low)


def force_figure(panel: HydroDatabase, strip: HydroDatabase) -> Figure:
    """Modulus of the excitation over frequency at three headings."""
    figure = Figure(figsize=(11.0, 6.0), layout="constrained")
    for i, axes in enumerate(figure.subplots(2, 3).flat):
        for degrees, colour in zip(HEADINGS_DEG, ("tab:blue", "tab:orange", "tab:green"), strict=True):
            h = int(np.abs(panel.heading - np.radians(degrees)).argmin())
            axes.plot(panel.omega, np.abs(panel.force[h, :, i]), color=colour, label=f"{degrees} deg, panels")
            axes.plot(
                strip.omega, np.abs(strip.force[h, :, i]), "--", color=colour, label=f"{degrees} deg, strip"
            )
        unit = "N/m" if i < 3 else "N m/m"
        axes.set(ylabel=f"|{MOTIONS[i]}| [{unit}]", xlabel="omega [rad/s]", xlim=(0.1, 2.5), ylim=(0.0, None))
    figure.axes[0].legend(fontsize=8)
    return figure


if __name__ == "__main__":
    main()
