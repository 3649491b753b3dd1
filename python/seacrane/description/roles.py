"""The parts of a crane by the work they do: its slew drive, cylinders, link, payload and tip."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from seacrane.description.capacity import Capacity
from seacrane.description.cylinder_areas import Areas
from seacrane.description.luffing_rope import LuffingRope
from seacrane.inputs.read_only import ReadOnly

Vector = tuple[float, float, float]


@dataclass(frozen=True, kw_only=True)
class CraneRoles:
    """Which elements of a scene are the parts of one crane. Channels, figures and studies read it.

    Attributes
    ----------
    prefix : str
        Begins every label, such as "aft main" of the cylinder "main"; it tells cranes of a scene apart.
    slew : (str, str) or None
        Joint and coordinate of the slew drive.
    cylinders : mapping of str to str
        Sliding joint of every cylinder, by its label without the prefix.
    luffs : mapping of str to (str, str)
        Joint and coordinate of every hinge that raises and lowers the jib, by its label.
    ropes : mapping of str to LuffingRope
        That hold hinges, by the hinge's label.
    link : str or None
        Distance joint from the tip to the payload.
    line : str or None
        In its place, the line from the tip on which the payload hangs, by itself or below a block.
    payload : str or None
        Body that hangs on either.
    tip : (str, (float, float, float)) or None
        Body that carries the tip, and the tip in its coordinates, m.
    capacity : tuple of (float, float)
        Largest allowable load (kg) over the radius of the tip from the slew axis (m); empty: none is known.
    areas : mapping of str to (float, float)
        Full side and rod side of the piston, m2, by the cylinder's label, where they are known.
    held : bool
        Whether a drive on which nothing acts when the scene is compiled is held as it is described.
    design_factor : float
        Dynamic factor that the capacity contains: a hook load may be that many times its weight.
    structure : str or None
        Joint and spring, of one name, by which the crane leans, where it gives.
    """

    prefix: str = ""
    slew: tuple[str, str] | None = None
    cylinders: Mapping[str, str] = field(default_factory=dict)
    link: str | None = None
    payload: str | None = None
    tip: tuple[str, Vector] | None = None
    capacity: Capacity = ()
    areas: Mapping[str, Areas] = field(default_factory=dict)
    luffs: Mapping[str, tuple[str, str]] = field(default_factory=dict)
    ropes: Mapping[str, LuffingRope] = field(default_factory=dict)
    held: bool = False
    design_factor: float = 1.0
    line: str | None = None
    structure: str | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "cylinders", ReadOnly(self.cylinders))
        object.__setattr__(self, "areas", ReadOnly(self.areas))
        object.__setattr__(self, "luffs", ReadOnly(self.luffs))
        object.__setattr__(self, "ropes", ReadOnly(self.ropes))
