"""What a line with mass is, and is in: air, a fluid that flows, or the sea, and the seabed under it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, Literal, cast

import numpy as np
from numpy.typing import ArrayLike

from seacrane import _core
from seacrane.arrays import Array
from seacrane.errors import SceneError
from seacrane.hydro.parts.density import SEA_WATER, density_of
from seacrane.inputs.checked import finite_of, not_negative_of, number_of, positive_of, text_of
from seacrane.inputs.keywords import named
from seacrane.inputs.values import made_of
from seacrane.scene.wind_current import AIR

_Point = tuple[str, Array]  # a body and a point in its coordinates, m
MEDIA = ("air", "sea")
CYLINDER_DRAG = 1.2  # C_D of a cylinder across the flow, below its critical Reynolds number: DNV-RP-C205
CIRCLE_ADDED_MASS = 1.0  # C_a of a circle in ideal flow: H. Lamb, Hydrodynamics, art. 68
SKIN_DRAG = 0.01  # C_D along, on the skin of a wire: unverified
SOURCES = (
    ("added mass", "added_mass_coefficient", CIRCLE_ADDED_MASS, "a circle in ideal flow (Lamb, art. 68)"),
    ("drag across", "drag_coefficient", CYLINDER_DRAG, "a cylinder (DNV-RP-C205)"),
    ("drag along", "drag_coefficient_along", SKIN_DRAG, "unverified"),
)
OF_THE_SEA = {"drag_coefficient_along": SKIN_DRAG, "added_mass_coefficient": CIRCLE_ADDED_MASS}


@named
@dataclass(frozen=True, kw_only=True, eq=False)
class Wire:
    """What makes a line one with mass: elastic segments with masses between them, in air or in the sea.

    Attributes
    ----------
    mass_per_length : float
        kg/m.
    segments : int
        From 1 to 1000. The fastest mode is 2 segments / length sqrt(EA / mass_per_length), 1/s.
    diameter : float
        m, for what air or water does to it; 0 (default): nothing in air, refused in the sea.
    drag_coefficient : float
        Across the line. Default 1.2, a cylinder (DNV-RP-C205).
    drag_coefficient_along : float
        In the sea, along the line on its skin, pi diameter length. Default 0.01 (unverified). In air there
        is none.
    added_mass_coefficient : float
        In the sea: added mass across the line over the water that it displaces; there is none along it.
        Default 1, a circle in ideal flow.
    density : float or None
        kg/m3, of the fluid; default: that of the medium, air or sea water.
    flow : array_like, shape (3,)
        Velocity of the air, or of a fluid that has drag alone, m/s, inertial axes.
    medium : {"air", "sea"}
        In the sea what is below the surface has buoyancy, added mass and drag in the water of `add_sea`, its
        waves and current; still water without one.
    seabed : Seabed, mapping of its keywords, or None
        A level seabed on which its masses lie.
    """

    mass_per_length: float
    segments: int = 20
    diameter: float = 0.0
    drag_coefficient: float = CYLINDER_DRAG
    drag_coefficient_along: float = SKIN_DRAG
    added_mass_coefficient: float = CIRCLE_ADDED_MASS
    density: float | None = None
    flow: ArrayLike = (0.0, 0.0, 0.0)
    medium: Literal["air", "sea"] = "air"
    seabed: Seabed | Mapping[str, Any] | None = None

    @property
    def in_sea(self) -> bool:
        """Whether it is in the water of the scene."""
        return self.medium == "sea"

    def checked(self, what: str, *, wound: bool) -> Wire:
        """The same with a density in kg/m3, and with a Seabed."""
        if text_of(f"{what}: medium", self.medium) not in MEDIA:
            raise SceneError.of(f"{what}: medium", f"is {self.medium!r}; choose 'air' or 'sea'")
        number_of(f"{what}: diameter", self.diameter)
        bed = None if self.seabed is None else made_of(what, "seabed", Seabed, self.seabed)
        if not self.in_sea:
            for name, usual in OF_THE_SEA.items():
                if getattr(self, name) != usual:
                    raise SceneError.of(
                        f"{what}: {name}", "is of a line in water; leave it out, or choose medium 'sea'"
                    )
            if wound and self.diameter > 0.0:
                raise SceneError(
                    f"{what}: has drag in a fluid that flows steadily, which takes no length that changes; "
                    "leave out its diameter, or choose medium 'sea'"
                )
            return replace(self, seabed=bed, density=AIR if self.density is None else self.density)
        if np.any(self.flow):
            raise SceneError(f"{what}: is in the sea and has a flow; give the current to add_sea")
        positive_of(f"{what}: diameter", self.diameter, "m")
        density = density_of(what, SEA_WATER if self.density is None else self.density)
        return replace(self, seabed=bed, density=density)

    def source(self) -> str:
        """Where the coefficients are from."""
        return "; ".join(
            f"{what}: {getattr(self, key):g}, {text if getattr(self, key) == usual else 'given'}"
            for what, key, usual, text in SOURCES
        )

    def along(self, name: str, ends: tuple[_Point, _Point], length: float | _core.Curve) -> Any:
        """What it does to a segment of a length (m)."""
        (first, first_point), (second, second_point) = ends
        span: dict[str, Any] = {
            "first": first, "second": second, "first_point": first_point, "second_point": second_point,
            "density": self.density, "diameter": self.diameter, "length": length,
        }  # fmt: skip
        if not self.in_sea:
            return _core.SpanDrag(
                name=f"{name} drag", coefficient=self.drag_coefficient, flow=self.flow, **span
            )
        return _core.ImmersedSpan(
            name=f"{name} water", drag_coefficient=self.drag_coefficient, source=self.source(),
            drag_coefficient_along=self.drag_coefficient_along,
            added_mass_coefficient=self.added_mass_coefficient, **span,
        )  # fmt: skip

    def lifts(self, places: Array, segment: float, gravity: float) -> Array:
        """Buoyancy of each mass between segments of a length (m), (n - 1,) N; `places` (n + 1, 3), m.

        Of ends and masses, in their order. As ImmersedSpan has it in still water: half a segment counts with
        its share below the surface.
        """
        if not self.in_sea:
            return np.zeros(len(places) - 2)
        z = places[:, 2]
        half = np.diff(z) / 2.0
        over = np.hypot(half, self.diameter)
        lower, upper = (
            np.clip(0.5 - middle / over, 0.0, 1.0) for middle in (z[:-1] + half / 2.0, z[1:] - half / 2.0)
        )
        shares = [s**3 * (10.0 + s * (6.0 * s - 15.0)) for s in (lower, upper)]
        whole = self.displaced(segment, gravity)
        return np.asarray(0.5 * whole * (shares[0][1:] + shares[1][:-1]))

    def displaced(self, length: float, gravity: float) -> float:
        """Weight (N) of the water that a length (m) of it displaces; none in air."""
        if not self.in_sea:
            return 0.0
        return cast(float, self.density) * gravity * np.pi / 4.0 * self.diameter**2 * length


@named
@dataclass(frozen=True, kw_only=True)
class Seabed:
    """A level seabed on which a line with mass lies: stiffness, damping and friction, no model of soil.

    Attributes
    ----------
    depth : float
        Below z = 0, m.
    stiffness : float
        Force up on each metre of line for each metre that it sinks in, N/m2.
    friction : float
        Coulomb's coefficient, along the line and across it; 0: none.
    damping_ratio : float
        Of critical damping, for the line's own mass where it has sunk in at rest.
    give : float
        m that it slides at rest before friction is full.
    """

    depth: float
    stiffness: float
    friction: float
    damping_ratio: float = 1.0
    give: float = 0.05

    def __post_init__(self) -> None:
        finite_of("seabed: depth", self.depth, "m")
        positive_of("seabed: stiffness", self.stiffness, "N/m2")
        positive_of("seabed: give", self.give, "m")
        for name in ("friction", "damping_ratio"):
            not_negative_of(f"seabed: {name}", getattr(self, name))

    def under(
        self, node: tuple[str, Array], place: Array, *, length: float, mass: float, weight: float
    ) -> _core.SeabedNode:
        """It under a node with a length (m), mass (kg) and weight (N) of line, which is at a place (m)."""
        stiffness = self.stiffness * length
        return _core.SeabedNode(
            name=f"{node[0]} seabed", body=node[0], point=node[1], depth=self.depth, stiffness=stiffness,
            damping=2.0 * self.damping_ratio * math.sqrt(stiffness * mass) / weight, friction=self.friction,
            load=weight, give=self.give, anchor=place,
        )  # fmt: skip
