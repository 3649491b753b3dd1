"""The seabed under a line with mass."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.errors import SceneError
from seacrane.inputs.checked import finite_of, not_negative_of, positive_of
from seacrane.inputs.shown import shown

Array = NDArray[np.float64]


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
            raise SceneError(
                f"{what}: seabed is {shown(given)}; give depth, stiffness and friction, such as "
                "seabed={'depth': 50.0, 'stiffness': 25e3, 'friction': 0.5}"
            )
        keywords = given if isinstance(given, Mapping) else vars(given)
        try:
            bed = Seabed(**keywords)
        except TypeError as error:
            raise SceneError(
                f"{what}: seabed has {', '.join(map(repr, keywords))}; it takes depth, stiffness, friction, "
                "and damping_ratio and give, the first three always"
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
