"""Drag that is given along axes of a part which lies on its side: the sides of the world may be meant."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from seacrane.description.once import once_in_any_sea
from seacrane.description.wet_parts import immersed_parts
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.frames import rotation_matrix
from seacrane.warnings import DragAxesWarning

if TYPE_CHECKING:
    from seacrane.description.description import Description

STEEP = np.radians(45.0)  # of the part's z axis from the vertical
UNLIKE = 1.5  # drag along z over that across it, or the other way round


@once_in_any_sea
def warn_of_drag_axes(scene: Description) -> None:
    """Warn of tables of parts whose z axis is far from the vertical as described, and whose drag knows it."""
    for part in immersed_parts(scene).values():
        if part.shape != "table" or part.body not in scene.bodies:
            continue
        turn = rotation_matrix(scene.bodies[part.body].quaternion) @ np.asarray(part.axes)
        tilt = float(np.arccos(np.clip(abs(turn[2, 2]), 0.0, 1.0)))
        areas = np.asarray(part.drag) / (0.5 * part.density)
        ratio = areas[2] / max(float(areas[:2].mean()), 1e-300)
        if tilt > STEEP and not 1.0 / UNLIKE <= ratio <= UNLIKE:
            warn_caller(
                f"immersed part {part.name!r}: its z axis is {np.degrees(tilt):.3g} deg from the vertical as "
                f"described, and its drag_area of {areas[2]:.4g} m2 acts along it, not upwards. drag_area is "
                "along the axes of the part, which turn with the body: give it in their order, or turn the "
                "part by axes, if it enters the water as described",
                DragAxesWarning,
            )
