"""A model whose one section lies across a flume: its database from the section's solutions in that depth."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from panels_in_flume import SectionInFlume, infinite_added_mass, section_in_flume

from seacrane.hydro import DriftCoefficients, Hull, HydroDatabase
from seacrane.hydro.hull.hull_database import database_of_solution
from seacrane.hydro.hull.solution import HullSolution

FloatArray = NDArray[np.float64]
ACROSS = np.radians([90.0, 270.0])
RHO, G = 1000.0, 9.81


@dataclass(frozen=True, kw_only=True)
class SectionModel:
    """Sizes in m, mass in kg.

    ``outline`` (p, 2) y, z from the keel to the waterline; ``hull`` of the same section, whose length lies
    across the flume; ``center``: height of the centre of gravity over the waterline; ``gyration``: of roll.
    """

    name: str
    outline: FloatArray
    hull: Hull
    length: float
    depth: float
    mass: float
    center: float
    gyration: float
    fineness: float

    def solved(self, omega: FloatArray) -> list[SectionInFlume]:
        """At each frequency; says how far energy is from being kept."""
        found = []
        for one in omega:
            at = section_in_flume(
                self.outline, float(one), depth=self.depth, rho=RHO, g=G, fineness=self.fineness
            )
            energy = abs(at.reflected) ** 2 + abs(at.transmitted) ** 2
            print(f"{one:.4g} rad/s: reflected and transmitted energy {energy:.4f}", flush=True)
            found.append(at)
        return found

    def along(self, per_metre: FloatArray) -> FloatArray:
        """(..., 3, 3) of sway, heave, roll as (..., 6, 6) of the length, pitch and yaw by their levers."""
        out = np.zeros((*per_metre.shape[:-2], 6, 6))
        for i, a in enumerate((1, 2, 3)):
            for j, b in enumerate((1, 2, 3)):
                out[..., a, b] = self.length * per_metre[..., i, j]
        lever = self.length**3 / 12.0
        out[..., 4, 4], out[..., 5, 5] = lever * per_metre[..., 1, 1], lever * per_metre[..., 0, 0]
        return out

    def drift(self, at: SectionInFlume) -> float:
        """Mean sway force of the held section over the squared wave amplitude, N/m2, by momentum far away."""
        kh = 2.0 * at.wavenumber * self.depth
        flux = 0.25 * RHO * G * (1.0 + kh / np.sinh(kh))
        return float(self.length * flux * (1.0 + abs(at.reflected) ** 2 - abs(at.transmitted) ** 2))

    def database(self, solved: list[SectionInFlume]) -> HydroDatabase:
        """Of the solutions, about the waterline on the centre line, with the drift of the held section."""
        omega = np.array([one.omega for one in solved])
        force = np.zeros((2, len(solved), 6), dtype=complex)
        force[0, :, 1:4] = self.length * np.array([one.force for one in solved])
        force[1] = force[0] * np.array([1.0, -1.0, 1.0, -1.0, 1.0, 1.0])
        infinite = infinite_added_mass(self.outline, depth=self.depth, rho=RHO, fineness=self.fineness)
        solution = HullSolution(
            omega=omega, heading=ACROSS, rho=RHO, g=G,
            added_mass=self.along(np.array([one.added_mass for one in solved])),
            damping=self.along(np.array([one.damping for one in solved])),
            added_mass_zero=None,
            added_mass_infinite=self.along(infinite),
            force=force,
            method="two-dimensional panels in the flume's depth, tools/flume_section",
            trusted_band=(float(omega[0]), float(omega[-1])),
        )  # fmt: skip
        plain = database_of_solution(
            self.hull, solution, mass=self.mass,
            center_of_gravity=np.array([0.0, 0.0, self.center]),
            radii_of_gyration=np.array([self.gyration, 0.25 * self.length, 0.25 * self.length]),
            roll_damping_fraction=0.0, trusted_band=None, name=self.name,
        )  # fmt: skip
        drift = np.zeros((2, len(solved), 6))
        drift[0, :, 1] = [self.drift(one) for one in solved]
        drift[1] = -drift[0]
        return replace(
            plain,
            depth=self.depth,
            drift=DriftCoefficients(heading=ACROSS, omega=omega, coefficient=drift),
            source=f"{plain.source}; drift of the section held still, by momentum far away",
        )

    def save(self, omega: FloatArray, place: Path) -> None:
        """Solve, save."""
        self.database(self.solved(omega)).save(place)
        print(f"{place}: {place.stat().st_size / 1e3:.0f} kB")
