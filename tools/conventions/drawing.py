"""What the pictures share: arrows, arcs, labels, and the ship that they show."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes

from seacrane.arrays import Array
from seacrane.pictures.pose import hull_lines

INK, SHIP, GHOST, SEA = "0.15", "0.4", "0.72", "#0072B2"
X_COLOUR, Y_COLOUR, Z_COLOUR = "#B3332F", "#2E7D32", "#1F4E9E"
MOVED = "#D55E00"


def deck() -> Array:
    """Outline of the deck (6, 3), m, in the vessel's axes."""
    return hull_lines()[0]


def side() -> Array:
    """Outline of the hull seen from starboard (k, 3)."""
    lines = hull_lines()
    x = np.array([line[:, 0] for line in lines[:2]])
    z = np.array([line[0, 2] for line in lines[:2]])
    low, high = x.min(), x.max()
    return np.array([(low, 0, z[0]), (high, 0, z[0]), (high - 8, 0, z[1]), (low, 0, z[1]), (low, 0, z[0])])


def section() -> Array:
    """Outline of the hull seen from ahead (5, 3)."""
    top, bottom = hull_lines()[:2]
    half = top[:, 1].max()
    corners = [(0, half, top[0, 2]), (0, -half, top[0, 2]), (0, -half, bottom[0, 2]), (0, half, bottom[0, 2])]
    return np.array([*corners, corners[0]])


def arrow(axes: Axes, start: Any, end: Any, *, colour: str = INK, width: float = 1.6) -> None:
    """A straight arrow in the picture's coordinates."""
    axes.annotate(
        "", xy=tuple(end), xytext=tuple(start),
        arrowprops={"arrowstyle": "-|>", "color": colour, "linewidth": width, "shrinkA": 0, "shrinkB": 0,
                    "mutation_scale": 13},
    )  # fmt: skip


def arc(axes: Axes, centre: Any, radius: float, start: float, end: float, *, colour: str = INK) -> None:
    """An arc with an arrow at its end; angles in rad, counter-clockwise in the picture."""
    angles = np.linspace(start, end, 60)
    x, y = centre[0] + radius * np.cos(angles), centre[1] + radius * np.sin(angles)
    axes.plot(x[:-2], y[:-2], color=colour, linewidth=1.6)
    arrow(axes, (x[-4], y[-4]), (x[-1], y[-1]), colour=colour)


def label(axes: Axes, place: Any, text: str, *, colour: str = INK, size: float = 9, **options: Any) -> None:
    """Words at a place, centred unless told otherwise."""
    options = {"ha": "center", "va": "center", **options}
    axes.text(*place, text, color=colour, fontsize=size, **options)


def towards_viewer(axes: Axes, place: Any, size: float, *, colour: str) -> None:
    """The tip of an arrow that comes out of the picture."""
    _ring(axes, place, size, colour)
    axes.plot(*place, "o", markersize=size / 3.5, color=colour)


def away_from_viewer(axes: Axes, place: Any, size: float, *, colour: str) -> None:
    """The feathers of an arrow that goes into the picture."""
    _ring(axes, place, size, colour)
    axes.plot(*place, "x", markersize=size / 2.0, color=colour, markeredgewidth=1.4)


def _ring(axes: Axes, place: Any, size: float, colour: str) -> None:
    axes.plot(*place, "o", markersize=size, mfc="white", mec=colour, mew=1.6)


def bare(axes: Axes, title: str) -> None:
    """Equal scales and no ticks: only directions count."""
    axes.set_aspect("equal")
    axes.axis("off")
    axes.set_title(title, fontsize=10)
