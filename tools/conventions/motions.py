"""The six motions, each drawn in its positive sense."""

from __future__ import annotations

import numpy as np
from drawing import (
    GHOST,
    MOVED,
    SEA,
    X_COLOUR,
    Y_COLOUR,
    Z_COLOUR,
    Array,
    arc,
    arrow,
    away_from_viewer,
    bare,
    deck,
    label,
    section,
    side,
    towards_viewer,
)
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from seacrane.inputs.frames import rotation_matrix

ANGLE = np.radians(14.0)  # of each rotation in the picture


def motions_figure() -> Figure:
    """From above, from starboard, from ahead; moved outlines are turned by the package's own rotations."""
    figure = Figure(figsize=(12.5, 4.4), layout="constrained")
    above, beside, ahead = figure.subplots(1, 3, width_ratios=(1.25, 1.25, 1.0))
    _yaw(above)
    _pitch(beside)
    _roll(ahead)
    return figure


def turned(axis: int, points: Array) -> Array:
    """Points after a positive rotation about an axis of the vessel."""
    quaternion = np.zeros(4)
    quaternion[0], quaternion[1 + axis] = np.cos(0.5 * ANGLE), np.sin(0.5 * ANGLE)
    return np.asarray(points @ rotation_matrix(quaternion).T)


def _yaw(axes: Axes) -> None:
    for points, colour in ((deck(), GHOST), (turned(2, deck()), MOVED)):
        axes.plot(points[:, 0], points[:, 1], color=colour, linewidth=1.4)
    arrow(axes, (0, 0), (34, 0), colour=X_COLOUR)
    arrow(axes, (0, 0), (0, 30), colour=Y_COLOUR)
    towards_viewer(axes, (0, 0), 11, colour=Z_COLOUR)
    label(axes, (22, -5), "surge +", colour=X_COLOUR)
    label(axes, (0, 35), "sway +, to port", colour=Y_COLOUR)
    arc(axes, (0, 0), 66, 0.0, ANGLE, colour=MOVED)
    label(axes, (60, 24), "yaw +\nbow to port", colour=MOVED)
    axes.set(xlim=(-65, 82), ylim=(-42, 48))
    bare(axes, "from above (x right, y up)")


def _pitch(axes: Axes) -> None:
    axes.axhline(0.0, color=SEA, linewidth=1.0)
    for points, colour in ((side(), GHOST), (turned(1, side()), MOVED)):
        axes.plot(points[:, 0], points[:, 2], color=colour, linewidth=1.4)
    arrow(axes, (0, 0), (0, 30), colour=Z_COLOUR)
    away_from_viewer(axes, (0, 0), 11, colour=Y_COLOUR)
    label(axes, (0, 35), "heave +, up", colour=Z_COLOUR)
    arc(axes, (0, 0), 66, 0.0, -ANGLE, colour=MOVED)
    label(axes, (62, -27), "pitch +\nbow down", colour=MOVED)
    axes.set(xlim=(-65, 82), ylim=(-42, 48))
    bare(axes, "from starboard (x right, z up)")


def _roll(axes: Axes) -> None:
    axes.axhline(0.0, color=SEA, linewidth=1.0)
    for points, colour in ((section(), GHOST), (turned(0, section()), MOVED)):
        axes.plot(points[:, 1], points[:, 2], color=colour, linewidth=1.4)
    towards_viewer(axes, (0, 0), 11, colour=X_COLOUR)
    arc(axes, (0, 0), 17, 0.0, ANGLE, colour=MOVED)
    label(axes, (17.5, 8), "roll +\nport side up", colour=MOVED)
    label(axes, (15.5, -9), "port")
    label(axes, (-15.5, -9), "starboard")
    axes.set(xlim=(-23, 23), ylim=(-14, 16))
    bare(axes, "from ahead (y right, z up)")
