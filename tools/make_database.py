"""Compute the shipped hydrodynamic database with Capytaine: ``python tools/make_database.py``.

A development tool: needs Capytaine 3. The grids are here, the hull is `shipped_hull`, everything else is that
of `seacrane.hydro.hydro_from_hull`.
"""

from __future__ import annotations

import argparse
import hashlib
from dataclasses import replace
from pathlib import Path

import numpy as np

from seacrane.hydro import Hull, HydroDatabase, fit_memory
from seacrane.hydro.hull.hull import LINES, VOLUME, shipped_hull
from seacrane.hydro.hull.hull_database import database_of_solution
from seacrane.hydro.hull.solution import HullSolution, capytaine_solution, symmetric_solution

RHO, G = 1025.0, 9.81
MASS = VOLUME * RHO
GM_TRANSVERSE = 3.0
ROLL_DAMPING_FRACTION = 0.05
TRUSTED_BAND = (0.3, 2.5)
LID_PANEL_RADIUS = 1.5
OMEGA = np.round(np.arange(0.1, 3.1001, 0.05), 10)
HEADING = np.radians(np.arange(0.0, 180.1, 5.0))


def main() -> None:
    """Compute, fit, save."""
    parser = argparse.ArgumentParser(description=__doc__)
    root = Path(__file__).resolve().parents[1]
    parser.add_argument("--out", type=Path, default=root / "python" / "seacrane" / "data" / "hull_115.nc")
    parser.add_argument(
        "--raw", type=Path, help="keep Capytaine's solution here, and reuse it when it is there"
    )
    arguments = parser.parse_args()
    hull = shipped_hull()
    database = database_of_solution(
        hull,
        symmetric_solution(solve_or_reuse(hull, arguments.raw)),
        center_of_gravity=np.array([0.0, 0.0, hull.hydrostatics.metacentre_transverse - GM_TRANSVERSE]),
        mass=MASS,
        radii_of_gyration=np.array([0.36 * LINES.breadth, 0.25 * LINES.length, 0.25 * LINES.length]),
        roll_damping_fraction=ROLL_DAMPING_FRACTION,
        trusted_band=TRUSTED_BAND,
        name="hull_115",
    )
    database = replace(database, source=source_of(database))
    database = replace(database, memory=fit_memory(database=database, band=TRUSTED_BAND, kind="per-pair"))
    database.save(arguments.out)
    for row in database.check():
        print(f"{row.check:40s} {row.value:12.4g} {row.verdict}")
    print(f"{arguments.out}: {arguments.out.stat().st_size / 1e3:.0f} kB")


def solve_or_reuse(hull: Hull, raw: Path | None) -> HullSolution:
    """Solve, or read what an earlier run of this script kept."""
    if raw is not None and raw.exists():
        with np.load(raw) as stored:
            values = {name: stored[name] for name in stored}
        values |= {"method": str(values["method"]), "rho": RHO, "g": G}
        values["trusted_band"] = tuple(values["trusted_band"].tolist())
        return HullSolution(**values)
    solution = capytaine_solution(
        hull, omega=OMEGA, heading=HEADING, rho=RHO, g=G, lid_panel_radius=LID_PANEL_RADIUS
    )
    if raw is not None:
        with raw.open("wb") as file:
            np.savez(file, **vars(solution))
    return solution


def source_of(database: HydroDatabase) -> str:
    """The database's own words, with the hash of this script."""
    script = hashlib.sha256(Path(__file__).read_bytes()).hexdigest()
    return f"tools/make_database.py (sha256 {script}); {database.source}"


if __name__ == "__main__":
    main()
