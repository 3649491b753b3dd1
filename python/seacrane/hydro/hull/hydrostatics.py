"""Hydrostatics of a wetted surface, and righting arms over large angles of heel at constant displacement."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from seacrane.arrays import Array
from seacrane.hydro.database.transform import point_of
from seacrane.hydro.hull.panels import (
    afloat,
    area_vectors,
    closed_below,
    cut_panels,
    mesh_triangles,
    triangles_of,
)
from seacrane.inputs.brief import brief
from seacrane.plotting.table import Answer, Column, Table


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
    center_of_buoyancy: Array
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
        self, *, rho: float, g: float, center_of_gravity_z: float, center_of_gravity_x: float | None = None,
        mass: float | None = None,
    ) -> Array:  # fmt: skip
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


def panel_hydrostatics(panels: Array) -> Hydrostatics:
    """Hydrostatics of a wetted panel mesh (n, 4, 3), by the divergence theorem over its triangles."""
    triangles = triangles_of(panels)
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    area = area_vectors(triangles)
    middle = np.stack([0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)], axis=1)  # exact for quadratics

    def integral(values: Array) -> float:
        """Surface integral of ``values`` (n, 3 nodes) times the z component of the outward normal."""
        return float(np.sum(area[:, 2] * values.mean(axis=1)))

    x, y, z = middle[..., 0], middle[..., 1], middle[..., 2]
    volume = integral(z)
    # x z and z^2 / 2 are the z-primitives of x and z; cubic terms are left to the triangle's own exact rule.
    centre = np.array([integral(x * z), integral(y * z), integral(0.5 * z * z)]) / volume
    return Hydrostatics(
        volume=volume, center_of_buoyancy=centre, waterplane_area=-integral(np.ones_like(z)),
        waterplane_moment_x=-integral(x), waterplane_moment_y=-integral(y),
        waterplane_inertia_roll=-integral(y * y), waterplane_inertia_pitch=-integral(x * x),
        waterplane_product=-integral(x * y), wetted_surface=float(np.linalg.norm(area, axis=1).sum()),
    )  # fmt: skip


LARGEST = 90.0  # deg
ROUNDS, EXACT = 60, 1e-11  # of Newton's method; of the length
TRIMS = ("free", "fixed")


@dataclass(frozen=True, kw_only=True, eq=False)
class RightingArms(Answer):
    """Righting arms over heel. Made by `righting_arms`; prints as a table.

    Attributes
    ----------
    heel : (n,) rad; positive lifts port.
    GZ : (n,) m; positive brings the hull back from a positive heel.
    sinkage : (n,) by which the origin is lower than upright, m.
    trim : (n,) rad; positive lowers the bow.
    volume : Displaced, m3.
    GM : Upright, from the waterplane, m.
    """

    heel: Array
    GZ: Array
    sinkage: Array
    trim: Array
    volume: float
    GM: float

    __repr__ = brief

    def _shown(self) -> Table:
        units = {"heel": "rad", "GZ": "m", "sinkage": "m", "trim": "rad"}
        heel, *others = (
            Column(name=key, values=getattr(self, key), unit=unit) for key, unit in units.items()
        )
        return Table(
            axes=[heel],
            columns=others,
            title=f"displacement {self.volume:.6g} m3, GM {self.GM:.4g} m",
            attributes={"volume": self.volume, "GM": self.GM},
        )


def righting_arms(
    *, vertices: ArrayLike, faces: ArrayLike, center_of_gravity: ArrayLike, heel_deg: ArrayLike,
    draught: float | None = None, trim: str = "free", name: str = "hull",
) -> RightingArms:  # fmt: skip
    """GZ over heel of a closed surface, deck included, that keeps its displacement.

    The hull is turned about its x axis, then sinks, and with free trim turns about the horizontal axis
    across it, until its buoyancy carries its weight. GZ is the horizontal distance, across the hull, from
    the centre of gravity to the line of buoyancy. A load that hangs free counts at its tip.

    Parameters
    ----------
    vertices : (n, 3) m. x forward, y port with the centre plane at y = 0, z up.
    faces : (m, 3) or (m, 4) indices, anticlockwise from outside; what is open there floods.
    center_of_gravity : (3,) m, from the origin on the waterline. With free trim the hull first takes the
        trim of this x; upright without trim it is that of the centre of buoyancy.
    heel_deg : angles, deg, within 90; positive lifts port.
    draught : m above the lowest vertex; None: z = 0 of the mesh is the waterline.
    trim : "free", or "fixed" at zero.
    name : of the hull, for messages.

    Raises
    ------
    ValueError : an open surface, or one that is wholly above or under water; angles beyond 90 deg; a hull
        that does not come to rest, such as one that founders.
    """
    closed = closed_below(f"hull {name!r}", mesh_triangles(name, vertices, faces))
    triangles = afloat(name, closed, draught)
    centre = point_of(f"hull {name!r}: center_of_gravity", center_of_gravity)
    if trim not in TRIMS:
        raise ValueError(f"hull {name!r}: trim is {trim!r}; give {' or '.join(map(repr, TRIMS))}")
    if not triangles[..., 2].min() < 0.0 < triangles[..., 2].max():
        raise ValueError(
            f"hull {name!r}: lies from z = {triangles[..., 2].min():.4g} to {triangles[..., 2].max():.4g} m, "
            "not across the waterline z = 0; give the draught, and the surface up to the deck"
        )
    heels = np.atleast_1d(np.asarray(heel_deg, dtype=float))
    if not np.all(np.abs(heels) <= LARGEST):
        raise ValueError(f"hull {name!r}: heel_deg has {heels}; give angles within {LARGEST:g} deg")
    hull = _Heeled(name, triangles, centre, free=trim == "free")
    heels = np.radians(heels)
    gz, sinkage, trims = np.array([hull.arm(float(heel)) for heel in heels]).reshape(-1, 3).T
    height = hull.upright.metacentric_height(float(centre[2]))
    return RightingArms(heel=heels, GZ=gz, sinkage=sinkage, trim=trims, volume=hull.upright.volume, GM=height)


class _Heeled:
    """A hull that is heeled at constant displacement."""

    def __init__(self, name: str, triangles: Array, centre: Array, *, free: bool) -> None:
        self.name, self.triangles, self.centre, self.free = name, triangles, centre, free
        self.length = float(np.ptp(triangles.reshape(-1, 3), axis=0).max())
        self.upright = self.under(triangles)
        if self.upright.volume <= 0.0:
            raise ValueError(
                f"hull {name!r}: encloses {self.upright.volume:.4g} m3, so its normals point inwards; "
                "reverse the order of the vertices of every face"
            )

    def under(self, placed: Array) -> Hydrostatics:
        """The properties of what of it is under water, in axes of the water."""
        wet = cut_panels(placed[:, [0, 1, 2, 2]], axis=2, side=-1, tolerance=1e-12 * self.length)
        if not len(wet):
            raise ValueError(f"hull {self.name!r}: leaves the water; correct its draught")
        return panel_hydrostatics(wet)

    def arm(self, heel: float) -> tuple[float, float, float]:
        """GZ, sinkage and trim at a heel, by Newton's method with the waterplane as its Jacobian."""
        trim, sinkage = 0.0, 0.0
        for _ in range(ROUNDS):
            (c, s), (ct, st) = (np.cos(heel), np.sin(heel)), (np.cos(trim), np.sin(trim))
            roll = np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])
            turn = np.array([[ct, 0.0, st], [0.0, 1.0, 0.0], [-st, 0.0, ct]]) @ roll
            under = self.under(self.triangles @ turn.T - np.array([0.0, 0.0, sinkage]))
            weight = turn @ self.centre
            x, y, _ = under.center_of_buoyancy - weight
            missing = self.upright.volume - under.volume
            needs_trim = self.free and abs(x) > EXACT * self.length
            if abs(missing) <= EXACT * self.upright.volume and not needs_trim:
                return float(-y), sinkage, trim
            weight = weight - np.array([0.0, 0.0, sinkage])
            down, bow = self._step(under, missing, float(x), weight)
            sinkage, trim = sinkage + down, trim + bow
        raise ValueError(
            f"hull {self.name!r}: does not come to rest at a heel of {np.degrees(heel):.4g} deg; does it "
            "founder? Give the surface up to the deck, or ask for less heel"
        )

    def _step(self, under: Hydrostatics, missing: float, off: float, weight: Array) -> tuple[float, float]:
        """Sinkage (m) and trim (rad) towards equilibrium, not far at once.

        The waterplane tells how the volume changes, and its moment about the centre of gravity at `weight`.
        """
        area, first = max(under.waterplane_area, 1e-9 * self.length**2), under.waterplane_moment_x
        farthest, down, bow = 0.1 * self.length, missing / area, 0.0
        if self.free:
            lever = float(under.center_of_buoyancy[2] - weight[2])
            second = under.waterplane_inertia_pitch - weight[0] * first + under.volume * lever
            matrix = np.array([[area, first], [first - weight[0] * area, second]])
            down, bow = np.linalg.lstsq(matrix, np.array([missing, -off * under.volume]), rcond=1e-12)[0]
        return float(np.clip(down, -farthest, farthest)), float(np.clip(bow, -0.1, 0.1))
