"""All axes of the atlas by name."""

from __future__ import annotations

from stability_atlas import (
    contact_axes,
    crane_axes,
    duration_axes,
    hydraulic_axes,
    line_axes,
    mechanism_axes,
    switching_axes,
    vessel_axes,
    water_axes,
)
from stability_atlas.axis import Axis

AXES: dict[str, Axis] = {
    axis.name: axis
    for group in (
        crane_axes,
        vessel_axes,
        mechanism_axes,
        switching_axes,
        line_axes,
        hydraulic_axes,
        water_axes,
        contact_axes,
        duration_axes,
    )
    for axis in group.AXES
}
