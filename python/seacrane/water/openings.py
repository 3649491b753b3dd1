"""Openings of a compartment through which water comes and goes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from seacrane.inputs.checked import positive_of, shaped_of
from seacrane.inputs.keywords import named


@named
@dataclass(frozen=True, kw_only=True)
class Opening:
    """A hole in the wall of a compartment, small against its section.

    Parameters
    ----------
    point : array_like, shape (3,)
        Its centre, m, body coordinates, between bottom and top of the compartment.
    area : float
        m2, of the hole itself; the jet fills `discharge_coefficient` of it.
    """

    point: Any
    area: float

    def __post_init__(self) -> None:
        shaped_of("opening: point", self.point, (3,))
        positive_of("opening: area", self.area, "m2")
