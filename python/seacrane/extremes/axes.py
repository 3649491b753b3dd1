"""All axes of the atlas by name."""

from __future__ import annotations

from seacrane.extremes import crane_axes, duration_axes, mechanism_axes, vessel_axes
from seacrane.extremes.axis import Axis

AXES: dict[str, Axis] = {
    axis.name: axis
    for axis in (*crane_axes.AXES, *vessel_axes.AXES, *mechanism_axes.AXES, *duration_axes.AXES)
}
