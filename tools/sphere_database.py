"""Compute the sphere of IEA OES Task 10 with Capytaine: ``python tools/sphere_database.py``.

Writes `benchmarks/measured/oes_sphere_decay.nc`. A development tool: needs Capytaine 3. The panels have the
sphere's volume, so that the sphere floats at half.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from seacrane.hydro import Hull, hydro_from_hull

RADIUS, MASS, RHO, G = 5.0, 261.8e3, 1000.0, 9.81
ROUND, DOWN = 36, 12  # panels
OMEGA = np.round([*np.arange(0.2, 3.01, 0.2), *np.arange(3.5, 6.01, 0.5)], 10)
PLACE = Path(__file__).resolve().parents[1] / "benchmarks" / "measured" / "oes_sphere_decay.nc"


def half_sphere() -> Hull:
    """Its lower half, in rings from the waterline down."""
    down = 0.5 * np.pi * np.arange(DOWN + 1) / DOWN
    turn = 2.0 * np.pi * np.arange(ROUND) / ROUND
    rings = [np.column_stack([np.cos(d) * np.cos(turn), np.cos(d) * np.sin(turn), np.full(ROUND, -np.sin(d))])
             for d in down]  # fmt: skip
    faces = [
        (i * ROUND + j, (i + 1) * ROUND + j, (i + 1) * ROUND + k, i * ROUND + k)
        for i in range(DOWN)
        for j, k in zip(range(ROUND), [*range(1, ROUND), 0], strict=True)
    ]
    unit = Hull.from_mesh(vertices=np.vstack(rings), faces=faces, name="sphere")
    size = np.cbrt(MASS / RHO / unit.hydrostatics.volume)
    return Hull.from_mesh(vertices=size * np.vstack(rings), faces=faces, name="sphere")


def gyration() -> NDArray[np.float64]:
    """Of a solid sphere; only heave is looked at."""
    return np.full(3, np.sqrt(0.4) * RADIUS)


def main() -> None:
    """Solve, save, and print heave over Hulme's (1982) units."""
    database = hydro_from_hull(
        half_sphere(), method="capytaine", omega=OMEGA, heading=[0.0], rho=RHO, g=G, mass=MASS,
        center_of_gravity=[0.0, 0.0, -2.0], radii_of_gyration=gyration(),
    )  # fmt: skip
    database.save(PLACE)
    unit = RHO * 2.0 / 3.0 * np.pi * RADIUS**3
    for omega, added, damping in zip(
        OMEGA, database.added_mass[:, 2, 2], database.damping[:, 2, 2], strict=True
    ):
        print(f"kR {omega**2 * RADIUS / G:.3f}: A {added / unit:.4f}, B {damping / unit / omega:.4f}")
    print(f"{PLACE}: {PLACE.stat().st_size / 1e3:.0f} kB")


if __name__ == "__main__":
    main()
