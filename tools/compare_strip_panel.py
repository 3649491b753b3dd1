"""Strip theory against the panel method on the shipped hull: ``python tools/compare_strip_panel.py``.

Writes the tables of docs/hull-hydrodynamics.md to benchmarks/results, and draws its figures. Results of the
panel method are those of the shipped database.
"""

from __future__ import annotations

import argparse
import csv
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from make_database import GM_TRANSVERSE, MASS, ROLL_DAMPING_FRACTION
from matplotlib.figure import Figure
from numpy.typing import NDArray

from seacrane import Scene, linear_model, response_statistics
from seacrane.hydro import HydroDatabase, hydro_from_hull, shipped_database
from seacrane.hydro.hull.shipped_hull import shipped_hull
from seacrane.sea import jonswap

FREQUENCIES = (0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.1, 1.2, 1.3, 1.5, 2.0)
ENTRIES = ((1, 1), (2, 2), (3, 3), (4, 4), (5, 5), (1, 3), (2, 4), (1, 5))
HEADINGS_DEG = (180, 135, 90)
PERIODS = (6, 7, 8, 9, 10, 12, 14, 16)  # s
MOTIONS = ("surge", "sway", "heave", "roll", "pitch", "yaw")
UNITS = {"A": ("kg", "kg m", "kg m2"), "B": ("kg/s", "kg m/s", "kg m2/s")}


def main() -> None:
    """Tables to their files, figures to the folder."""
    parser = argparse.ArgumentParser(description=__doc__)
    root = Path(__file__).resolve().parents[1]
    parser.add_argument("--out", type=Path, default=root / "docs" / "figures")
    folder = parser.parse_args().out
    panel, strip = shipped_database(), strip_database()
    save_ratios(panel, strip)
    save_bands(panel, strip)
    save_forces(panel, strip)
    save_motions(panel, strip)
    save_periods(panel, strip)
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


def nearest(panel: HydroDatabase, omega: float) -> int:
    return int(np.abs(panel.omega - omega).argmin())


def save(name: str, head: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
    """A table of the document."""
    path = Path(__file__).resolve().parents[1] / "benchmarks" / "results" / f"{name}.csv"
    with path.open("w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows([head, *rows])
    subprocess.run([sys.executable, path.parents[1] / "documents.py", "--measured", path], check=True)


def save_ratios(panel: HydroDatabase, strip: HydroDatabase) -> None:
    """Strip over panel at the same frequency; the limits of the added mass to the screen."""
    for symbol, name in (("A", "added_mass"), ("B", "damping")):
        one, other = getattr(panel, name), getattr(strip, name)
        rows = []
        for omega in FREQUENCIES:
            i = nearest(panel, omega)
            rows.append([f"{omega}", *(f"{other[i, j, k] / one[i, j, k]:.2f}" for j, k in ENTRIES)])
        head = ["rad/s", *(f"{symbol}{j + 1}{k + 1}" for j, k in ENTRIES)]
        save(f"strip-over-panels-{name.replace('_', '-')}", head, rows)
    limits = np.diagonal(strip.infinite_frequency_added_mass) / np.diagonal(
        panel.infinite_frequency_added_mass
    )
    print("A_inf:", np.round(limits, 3), "\n")


def save_bands(panel: HydroDatabase, strip: HydroDatabase) -> None:
    """Strip over panel less 1, %, least and largest: below the trusted band, in it, and above."""
    low = strip.trusted_band[0]
    bands = ((0.3, low), (low, 0.8), (0.8, 1.3), (1.3, 2.0))
    rows = []
    for symbol, name in (("A", "added_mass"), ("B", "damping")):
        ratio = getattr(strip, name) / np.where(getattr(panel, name) == 0.0, np.nan, getattr(panel, name))
        for j, k in ENTRIES:
            row = [f"{symbol}{j + 1}{k + 1}"]
            for first, last in bands:
                inside = (panel.omega >= first - 1e-9) & (panel.omega <= last + 1e-9)
                off = 100.0 * (ratio[inside, j, k] - 1.0)
                row.append(f"{off.min():+.0f} to {off.max():+.0f}")
            rows.append(row)
    save("strip-off-by-band", ["entry", *(f"{a:.2f} to {b:.2f} rad/s" for a, b in bands)], rows)


def save_forces(panel: HydroDatabase, strip: HydroDatabase) -> None:
    """Largest difference of the complex force over 0.5 to 1.5 rad/s by the panel method's largest there."""
    inside = (panel.omega >= 0.5) & (panel.omega <= 1.5)
    rows = []
    for degrees in HEADINGS_DEG:
        h = int(np.abs(panel.heading - np.radians(degrees)).argmin())
        one, other = panel.force[h, inside], strip.force[h, inside]
        largest = np.abs(panel.force[:, inside]).max(axis=(0, 1))
        error = np.abs(other - one).max(axis=0) / largest
        rows.append([f"{degrees}", *(f"{100.0 * e:.1f}" for e in error)])
    save("strip-against-panels-forces", ["heading deg", *MOTIONS], rows)


def save_motions(panel: HydroDatabase, strip: HydroDatabase) -> None:
    """Significant double amplitudes in Hs 2 m, Tp 8 s."""
    scenes = []
    for database in (panel, strip):
        scene = Scene(name=database.name)
        scene.add_vessel(database, memory="passive")
        scenes.append((scene, database))
    rows = []
    for degrees in HEADINGS_DEG:
        found = [
            response_statistics(
                scene,
                spectrum=jonswap(hs=2.0, tp=8.0),
                direction=np.radians(degrees),
                body="vessel",
            ).significant_double_amplitude
            for scene, database in scenes
        ]
        for i in (0, 1, 2, 3, 4, 5):
            scale, unit = (1.0, "m") if i < 3 else (np.degrees(1.0), "deg")
            one, other = scale * found[0][i], scale * found[1][i]
            if one > 1e-6:
                values = (f"{one:.3f} {unit}", f"{other:.3f} {unit}", f"{other / one:.2f}")
                rows.append([f"{degrees}", MOTIONS[i], *values])
    save("strip-against-panels-motions", ["heading deg", "motion", "panel", "strip", "strip / panel"], rows)


def save_periods(panel: HydroDatabase, strip: HydroDatabase) -> None:
    """Largest difference of a motion in seas of several periods, %, by the largest over the headings."""
    models = []
    for database in (panel, strip):
        scene = Scene(name=database.name)
        scene.add_vessel(database, memory="convolution")
        models.append((linear_model(scene, memory="database", database=database), database))
    rows = []
    for tp in PERIODS:
        sea = jonswap(hs=2.0, tp=tp)
        found = np.array(
            [
                [
                    response_statistics(linear, spectrum=sea, direction=np.radians(h), body="vessel").std
                    for h in (0, 45, 90, 135, 180)
                ]
                for linear, database in models
            ]
        )
        off = 100.0 * (np.abs(found[1] - found[0]) / found[0].max(axis=0)).max(axis=0)
        below = sea.energy(minimum_omega=panel.omega[0], maximum_omega=strip.trusted_band[0]) / sea.moment(0)
        rows.append([f"{tp}", f"{100.0 * below:.0f}", *(f"{value:.0f}" for value in off)])
    save("strip-motions-by-period", ["Tp s", "below band", *MOTIONS], rows)


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
