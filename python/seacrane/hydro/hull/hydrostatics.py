"""Hydrostatics of a wetted surface: volume, centres, waterplane, wetted area, restoring."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class Hydrostatics:
    """What floats a hull, about its origin: x forward, y port, z up, z = 0 on the still waterline.

    Attributes
    ----------
    volume : m3.
    center_of_buoyancy : (3,) m.
    waterplane_area : m2.
    waterplane_moment_x, waterplane_moment_y : integrals of x and of y over the waterplane, m3.
    waterplane_inertia_roll, waterplane_inertia_pitch, waterplane_product : of y^2, x^2 and x y, m4.
    wetted_surface : m2.
    """

    volume: float
    center_of_buoyancy: FloatArray
    waterplane_area: float
    waterplane_moment_x: float
    waterplane_inertia_roll: float
    waterplane_inertia_pitch: float
    waterplane_moment_y: float = 0.0
    waterplane_product: float = 0.0
    wetted_surface: float = 0.0

    @property
    def center_of_flotation(self) -> float:
        """x (m) of the centroid of the waterplane."""
        return self.waterplane_moment_x / self.waterplane_area

    @property
    def metacentre_transverse(self) -> float:
        """Height (m) of the transverse metacentre above the waterline."""
        return float(self.center_of_buoyancy[2] + self.waterplane_inertia_roll / self.volume)

    @property
    def metacentre_longitudinal(self) -> float:
        """Height (m) of the longitudinal metacentre, for trim about the centre of flotation."""
        about_flotation = self.waterplane_inertia_pitch - self.waterplane_moment_x * self.center_of_flotation
        return float(self.center_of_buoyancy[2] + about_flotation / self.volume)

    def metacentric_height(self, center_of_gravity_z: float) -> float:
        """Transverse GM (m) for a centre of gravity at that height (m) above the waterline."""
        return self.metacentre_transverse - center_of_gravity_z

    def restoring(
        self,
        *,
        rho: float,
        g: float,
        center_of_gravity_z: float,
        center_of_gravity_x: float | None = None,
        mass: float | None = None,
    ) -> FloatArray:
        """Restoring matrix about the origin, equations (13)-(16) of the paper for the freely floating hull.

        Parameters
        ----------
        rho, g : kg/m3, m/s2.
        center_of_gravity_z, center_of_gravity_x : m; x defaults to that of the centre of buoyancy.
        mass : kg; default: the displaced mass.

        Returns
        -------
        (6, 6) N/m, N, N m. A centre of gravity before or behind that of buoyancy leaves C46 (Newman 1977,
        Marine Hydrodynamics, section 6.16).
        """
        x_b, _, z_b = self.center_of_buoyancy
        buoyancy = rho * g * self.volume
        weight = buoyancy if mass is None else mass * g
        x_g = x_b if center_of_gravity_x is None else center_of_gravity_x
        lever = buoyancy * z_b - weight * center_of_gravity_z
        c = np.zeros((6, 6))
        c[2, 2] = rho * g * self.waterplane_area
        c[2, 4] = c[4, 2] = -rho * g * self.waterplane_moment_x
        c[3, 3] = rho * g * self.waterplane_inertia_roll + lever
        c[4, 4] = rho * g * self.waterplane_inertia_pitch + lever
        c[3, 5] = weight * x_g - buoyancy * x_b
        return c


def triangles_of(panels: FloatArray) -> FloatArray:
    """Two triangles (2 n, 3, 3) of every quadrilateral (n, 4, 3)."""
    return np.concatenate([panels[:, [0, 1, 2]], panels[:, [0, 2, 3]]])


def area_vectors(triangles: FloatArray) -> FloatArray:
    """Area times normal (n, 3) of triangles (n, 3, 3), m2."""
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    return 0.5 * np.cross(b - a, c - a)


def panel_hydrostatics(panels: FloatArray) -> Hydrostatics:
    """Hydrostatics of a wetted panel mesh (n, 4, 3), by the divergence theorem over its triangles."""
    triangles = triangles_of(panels)
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    area = area_vectors(triangles)
    middle = np.stack([0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)], axis=1)  # exact for quadratics

    def integral(values: FloatArray) -> float:
        """Surface integral of ``values`` (n, 3 nodes) times the z component of the outward normal."""
        return float(np.sum(area[:, 2] * values.mean(axis=1)))

    x, y, z = middle[..., 0], middle[..., 1], middle[..., 2]
    volume = integral(z)
    # x z and z^2 / 2 are the z-primitives of x and z; cubic terms are left to the triangle's own exact rule.
    centre = np.array([integral(x * z), integral(y * z), integral(0.5 * z * z)]) / volume
    return Hydrostatics(
        volume=volume,
        center_of_buoyancy=centre,
        waterplane_area=-integral(np.ones_like(z)),
        waterplane_moment_x=-integral(x),
        waterplane_moment_y=-integral(y),
        waterplane_inertia_roll=-integral(y * y),
        waterplane_inertia_pitch=-integral(x * x),
        waterplane_product=-integral(x * y),
        wetted_surface=float(np.linalg.norm(area, axis=1).sum()),
    )
