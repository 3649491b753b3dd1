"""The density of the water on a load, and the unit in which it has to be."""

from __future__ import annotations

from typing import Any

from seacrane.errors import SceneError
from seacrane.inputs.checked import positive_of

SEA_WATER = 1025.0  # kg/m3
LEAST_DENSITY = 100.0  # kg/m3, below which a density is rather in t/m3


def density_of(what: str, value: Any) -> float:
    """A density in kg/m3; raises SceneError for one that looks like t/m3."""
    density = positive_of(f"{what}: density", value, "kg/m3")
    if density < LEAST_DENSITY:
        raise SceneError.of(f"{what}: density", f"is {density:g}, which looks like t/m3; give kg/m3")
    return density
