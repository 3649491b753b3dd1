"""Compute the section of the flume in its depth: ``python tools/flume_section/flume_database.py``.

Writes `benchmarks/measured/ntnu_lewis_section.nc`, which the comparison with the flume takes, with the mean
drift of the section held still. Sizes are those of the paper (Sundsdal, Greco, Hanssen, Lugni 2025). Needs
nothing but the package.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from panels_in_flume import SectionInFlume, infinite_added_mass, section_in_flume

from seacrane.hydro import DriftCoefficients, Hull, HydroDatabase, OffsetTable
from seacrane.hydro.hull.hull_database import database_of_solution
from seacrane.hydro.hull.solution import HullSolution

FloatArray = NDArray[np.float64]
BREADTH, DRAUGHT, BILGE_RADIUS, LENGTH = 0.40, 0.20, 0.0512, 0.586
MASS, HEIGHT_OF_GRAVITY, GYRATION = 46.8, 0.106, 0.360 * 0.40  # kg, m above the keel as measured, m
DEPTH, RHO, G = 1.0, 1000.0, 9.81
OF_THE_TANK = (4.143, 4.952, 5.075, 5.194, 5.311, 5.425, 5.646, 5.86, 6.065, 7.004, 7.83, 8.578, 9.265, 9.905)
OMEGA = np.unique(np.round([*np.arange(0.5, 4.0, 0.25), *np.arange(4.0, 14.01, 0.125), *OF_THE_TANK], 10))
FINENESS = 1.6
ACROSS = np.radians([90.0, 270.0])
PLACE = Path(__file__).resolve().parents[2] / "benchmarks" / "measured" / "ntnu_lewis_section.nc"


def outline(fineness: float = FINENESS) -> FloatArray:
    """From the keel to the waterline; panels grow away from the bilge and the waterline."""
    flat, turn, wall = (round(count * fineness) for count in (24, 16, 24))
    half, r = 0.5 * BREADTH, BILGE_RADIUS
    bottom = (half - r) * np.sin(0.5 * np.pi * np.arange(flat + 1) / flat)
    angle = np.linspace(-0.5 * np.pi, 0.0, turn + 1)[1:]
    up = 0.5 * (1.0 - np.cos(np.pi * np.arange(1, wall + 1) / wall))
    return np.vstack(
        [
            np.column_stack([bottom, np.full(flat + 1, -DRAUGHT)]),
            np.column_stack([half - r + r * np.cos(angle), -DRAUGHT + r + r * np.sin(angle)]),
            np.column_stack([np.full(wall, half), (-DRAUGHT + r) * (1.0 - up)]),
        ]
    )


def flume_hull() -> Hull:
    """The section along its length across the flume, with 0.05 m of wall above the water."""
    section = [(0.5 * BREADTH, 0.05), *map(tuple, outline()[::-1])]
    table = OffsetTable(x=[-0.5 * LENGTH, 0.5 * LENGTH], sections=(section, section), name="flume section")
    return Hull.from_offsets(table)


def along(per_metre: FloatArray) -> FloatArray:
    """(..., 3, 3) of sway, heave, roll as (..., 6, 6) of the length, pitch and yaw by their levers."""
    out = np.zeros((*per_metre.shape[:-2], 6, 6))
    for i, a in enumerate((1, 2, 3)):
        for j, b in enumerate((1, 2, 3)):
            out[..., a, b] = LENGTH * per_metre[..., i, j]
    lever = LENGTH**3 / 12.0
    out[..., 4, 4], out[..., 5, 5] = lever * per_metre[..., 1, 1], lever * per_metre[..., 0, 0]
    return out


def drift_of(at: SectionInFlume) -> float:
    """Mean sway force of the held section over the squared wave amplitude, N/m2, by momentum far away."""
    kh = 2.0 * at.wavenumber * DEPTH
    flux = 0.25 * RHO * G * (1.0 + kh / np.sinh(kh))
    return float(LENGTH * flux * (1.0 + abs(at.reflected) ** 2 - abs(at.transmitted) ** 2))


def main() -> None:
    """Solve, save, and say how far energy is from being kept."""
    solved = []
    for omega in OMEGA:
        solved.append(section_in_flume(outline(), omega, depth=DEPTH, rho=RHO, g=G, fineness=FINENESS))
        energy = abs(solved[-1].reflected) ** 2 + abs(solved[-1].transmitted) ** 2
        print(f"{omega:.4g} rad/s: reflected and transmitted energy {energy:.4f}", flush=True)
    PLACE.parent.mkdir(exist_ok=True)
    database_of(solved).save(PLACE)
    print(f"{PLACE}: {PLACE.stat().st_size / 1e3:.0f} kB")


def database_of(solved: list[SectionInFlume]) -> HydroDatabase:
    """Of the solutions at `OMEGA`, about the waterline on the centre line."""
    force = np.zeros((2, len(solved), 6), dtype=complex)
    force[0, :, 1:4] = LENGTH * np.array([one.force for one in solved])
    force[1] = force[0] * np.array([1.0, -1.0, 1.0, -1.0, 1.0, 1.0])
    infinite = infinite_added_mass(outline(), depth=DEPTH, rho=RHO, fineness=FINENESS)
    solution = HullSolution(
        added_mass=along(np.array([one.added_mass for one in solved])),
        damping=along(np.array([one.damping for one in solved])),
        added_mass_zero=None,
        added_mass_infinite=along(infinite),
        force=force,
        method="two-dimensional panels in the flume's depth, tools/flume_section",
        trusted_band=(float(OMEGA[0]), float(OMEGA[-1])),
    )
    plain = database_of_solution(
        flume_hull(), solution, omega=OMEGA, heading=ACROSS,
        center_of_gravity=np.array([0.0, 0.0, HEIGHT_OF_GRAVITY - DRAUGHT]), mass=MASS,
        radii_of_gyration=np.array([GYRATION, 0.25 * LENGTH, 0.25 * LENGTH]), roll_damping_fraction=0.0,
        trusted_band=None, rho=RHO, g=G, name="flume section",
    )  # fmt: skip
    drift = np.zeros((2, len(solved), 6))
    drift[0, :, 1] = [drift_of(one) for one in solved]
    drift[1] = -drift[0]
    return replace(
        plain,
        depth=DEPTH,
        drift=DriftCoefficients(heading=ACROSS, omega=OMEGA, coefficient=drift),
        source=f"{plain.source}; drift of the section held still, by momentum far away",
    )


if __name__ == "__main__":
    main()
