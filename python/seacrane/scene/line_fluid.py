"""What a line with mass is in, air, a fluid that flows, or the sea, and the seabed under it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seacrane import _core
from seacrane.errors import SceneError
from seacrane.inputs.checked import finite_of, not_negative_of, number_of, positive_of, text_of
from seacrane.inputs.shown import shown
from seacrane.scene.wind_current import AIR
from seacrane.water.density import SEA_WATER, density_of

Array = NDArray[np.float64]
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


@dataclass(frozen=True, kw_only=True)
class Fluid:
    """What a line with mass is in, and its coefficients there; `density` None: that of the medium."""

    medium: str
    density: float | None
    diameter: float
    drag_coefficient: float
    drag_coefficient_along: float
    added_mass_coefficient: float
    flow: ArrayLike

    @property
    def in_sea(self) -> bool:
        """Whether it is the water of the scene."""
        return self.medium == "sea"

    def checked(self, what: str, *, wound: bool) -> Fluid:
        """The same with a density in kg/m3."""
        if text_of(f"{what}: medium", self.medium) not in MEDIA:
            raise SceneError.of(f"{what}: medium", f"is {self.medium!r}; choose 'air' or 'sea'")
        number_of(f"{what}: diameter", self.diameter)
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
            return replace(self, density=AIR if self.density is None else self.density)
        if np.any(self.flow):
            raise SceneError(f"{what}: is in the sea and has a flow; give the current to add_sea")
        positive_of(f"{what}: diameter", self.diameter, "m")
        return replace(self, density=density_of(what, SEA_WATER if self.density is None else self.density))

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

    @staticmethod
    def of(around: Any) -> Fluid:
        """That of a segment, from what `along` made for it; without a diameter that is nothing."""
        still = np.zeros(3)
        if around is None:
            return Fluid(
                medium="air", density=None, diameter=0.0, drag_coefficient=0.0, flow=still, **OF_THE_SEA
            )
        common = {"density": around.density, "diameter": around.diameter}
        if isinstance(around, _core.SpanDrag):
            return Fluid(
                medium="air", drag_coefficient=around.coefficient, flow=around.flow, **common, **OF_THE_SEA
            )
        of_sea = {key: getattr(around, key) for key in ("drag_coefficient", *OF_THE_SEA)}
        return Fluid(medium="sea", flow=still, **common, **of_sea)

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

    @staticmethod
    def of(what: str, given: Seabed | Mapping[str, Any]) -> Seabed:
        """The seabed of a line; SceneError for keywords that are not there, are missing, or out of range."""
        if not isinstance(given, (Seabed, Mapping)):
            raise SceneError.of(
                f"{what}: seabed",
                f"is {shown(given)}; give depth, stiffness and friction, such as "
                "seabed={'depth': 50.0, 'stiffness': 25e3, 'friction': 0.5}",
            )
        keywords = given if isinstance(given, Mapping) else vars(given)
        try:
            bed = Seabed(**keywords)
        except TypeError as error:
            raise SceneError.of(
                f"{what}: seabed",
                f"has {', '.join(map(repr, keywords))}; it takes depth, stiffness, friction, "
                "and damping_ratio and give, the first three always",
            ) from error
        finite_of(f"{what}: seabed depth", bed.depth, "m")
        positive_of(f"{what}: seabed stiffness", bed.stiffness, "N/m2")
        positive_of(f"{what}: seabed give", bed.give, "m")
        for name in ("friction", "damping_ratio"):
            not_negative_of(f"{what}: seabed {name}", getattr(bed, name))
        return bed

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
