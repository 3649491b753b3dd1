"""What hangs on a crane."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from seacrane.crane.parts import BodyRecord, JointRecord
from seacrane.inputs.checked import not_negative_of, positive_of
from seacrane.inputs.keywords import named
from seacrane.inputs.plausible import warn_of_density

SWING_RATIO = 0.005  # of critical damping of a swinging load: an estimate
BOX_DRAG = 1.05  # C_D of a cube with a face to the flow: Hoerner, Fluid-Dynamic Drag (1965)

Array = npt.NDArray[np.float64]
Vector = tuple[float, float, float]


@named
@dataclass(frozen=True, kw_only=True)
class Payload:
    """A uniform box hanging on a link of constant length from the crane tip, attached at its top's centroid.

    Attributes
    ----------
    mass : float
        kg.
    size : (float, float, float)
        Edges along body x, y and z, m.
    link_length : float
        Tip to the centroid of the top, m.
    swing_damping_ratio : float
        Of critical damping of its swing, as in `Scene.add_pendulum_damping`; 0 is none. Default: an estimate.
    drag_coefficient : float
        C_D of the box in still air, as in `Scene.add_air_drag`; 0 is no drag. Default 1.05 (Hoerner 1965).

    Warns
    -----
    MassUnitWarning
        Lighter than foam: tonnes given for kg.
    """

    mass: float = 10.0e3
    size: Vector = (6.0, 6.0, 4.0)
    link_length: float = 8.0
    swing_damping_ratio: float = SWING_RATIO
    drag_coefficient: float = BOX_DRAG

    def __post_init__(self) -> None:
        values = {"mass": self.mass, "link_length": self.link_length}
        values |= {f"size[{index}]": edge for index, edge in enumerate(self.size)}
        for name, given in values.items():
            positive_of(f"payload: {name}", given)
        for name in ("swing_damping_ratio", "drag_coefficient"):
            not_negative_of(f"payload: {name}", getattr(self, name))
        warn_of_density("payload", self.mass, math.prod(self.size))

    @property
    def inertia(self) -> Array:
        """About the centre of mass, body axes, shape (3, 3), kg m2."""
        x, y, z = (edge**2 for edge in self.size)
        return np.diag([y + z, z + x, x + y]) * (self.mass / 12.0)

    def under(self, tip: Array) -> BodyRecord:
        """Hanging at rest under a tip, its frame at its centre, along the frame of the tip's coordinates."""
        drop = self.link_length + self.size[2] / 2.0
        return BodyRecord(
            name="payload",
            mass=self.mass,
            inertia=self.inertia,
            center_of_mass=np.zeros(3),
            position=tip - np.array([0.0, 0.0, drop]),
            quaternion=np.array([1.0, 0.0, 0.0, 0.0]),
        )

    def link(self, tip: Array, body: str) -> JointRecord:
        """From a tip and its body to the centroid of the top."""
        return JointRecord(
            name="link",
            kind="distance",
            first=body,
            second="payload",
            point=tip.copy(),
            second_point=tip - np.array([0.0, 0.0, self.link_length]),
            length=self.link_length,
        )
