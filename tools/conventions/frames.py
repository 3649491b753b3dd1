"""The inertial frame and a vessel's."""

from __future__ import annotations

import numpy as np
from drawing import (
    INK,
    SEA,
    SHIP,
    X_COLOUR,
    Y_COLOUR,
    Z_COLOUR,
    arc,
    arrow,
    away_from_viewer,
    bare,
    deck,
    label,
    side,
    towards_viewer,
)
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from seacrane.inputs.frames import rotation_about_z

PLACE, HEADING = np.array([105.0, 62.0]), np.radians(35.0)  # of the vessel in the picture, m
LONG = 52.0  # of an axis, m


def frames_figure() -> Figure:
    """Both frames from above, and the vessel's from starboard."""
    figure = Figure(figsize=(11.0, 4.9), layout="constrained")
    above, beside = figure.subplots(1, 2)
    _from_above(above)
    _from_starboard(beside)
    return figure


def _from_above(axes: Axes) -> None:
    arrow(axes, (0, 0), (LONG, 0), colour=X_COLOUR)
    arrow(axes, (0, 0), (0, LONG), colour=Y_COLOUR)
    towards_viewer(axes, (0, 0), 11, colour=Z_COLOUR)
    label(axes, (LONG + 6, 0), "x", colour=X_COLOUR, size=11)
    label(axes, (0, LONG + 6), "y", colour=Y_COLOUR, size=11)
    label(axes, (-9, -8), "z", colour=Z_COLOUR, size=11)
    label(axes, (2, -18), "inertial frame: origin on the still waterline,\nz up", ha="left")
    turn = rotation_about_z(HEADING)[:2, :2]
    outline = PLACE + deck()[:, :2] @ turn.T
    axes.plot(*outline.T, color=SHIP, linewidth=1.4)
    along, across = PLACE + 0.9 * LONG * turn[:, 0], PLACE + 0.6 * LONG * turn[:, 1]
    arrow(axes, PLACE, along, colour=X_COLOUR)
    arrow(axes, PLACE, across, colour=Y_COLOUR)
    towards_viewer(axes, PLACE, 9, colour=Z_COLOUR)
    label(axes, PLACE + 1.3 * LONG * turn[:, 0], "x forward:\nsurge", colour=X_COLOUR)
    label(axes, PLACE + 0.85 * LONG * turn[:, 1], "y to port:\nsway", colour=Y_COLOUR)
    axes.plot([PLACE[0], PLACE[0] + 0.75 * LONG], [PLACE[1]] * 2, ":", color=INK, linewidth=1.0)
    arc(axes, PLACE, 0.62 * LONG, 0.0, HEADING)
    label(axes, PLACE + np.array([1.02 * LONG, 0.12 * LONG]), "heading_deg", size=9)
    axes.plot([0, PLACE[0]], [0, PLACE[1]], ":", color=INK, linewidth=1.0)
    label(axes, 0.28 * PLACE + np.array([15, -2]), "position", size=9)
    axes.set(xlim=(-25, 190), ylim=(-35, 135))
    bare(axes, "from above: inertial frame, and a vessel at its rest")


def _from_starboard(axes: Axes) -> None:
    axes.axhline(0.0, color=SEA, linewidth=1.2)
    outline = side()
    axes.plot(outline[:, 0], outline[:, 2], color=SHIP, linewidth=1.4)
    arrow(axes, (0, 0), (30, 0), colour=X_COLOUR)
    arrow(axes, (0, 0), (0, 26), colour=Z_COLOUR)
    away_from_viewer(axes, (0, 0), 11, colour=Y_COLOUR)
    label(axes, (33, 3.4), "x forward", colour=X_COLOUR, ha="left")
    label(axes, (0, 30), "z up: heave", colour=Z_COLOUR)
    label(axes, (-6, 3.4), "y to port", colour=Y_COLOUR, ha="right")
    label(axes, (-62, 2.5), "z = 0", colour=SEA, ha="right")
    label(axes, (0, -15), "reference point of the vessel: on the still waterline at its rest")
    label(axes, (56, 14), "bow")
    axes.set(xlim=(-80, 80), ylim=(-40, 45))
    bare(axes, "from starboard: a vessel's frame")
