"""Angles, strokes and loads of the crane that comes with seacrane, drawn by its own geometry."""

from __future__ import annotations

import numpy as np
from drawing import (
    GHOST,
    INK,
    MOVED,
    SHIP,
    X_COLOUR,
    Y_COLOUR,
    Z_COLOUR,
    Array,
    arc,
    arrow,
    bare,
    deck,
    label,
)
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from seacrane.crane import FOOT, load_crane

LINES = (("A", "C"), ("A", "B"), ("C", "F"), ("F", "tip"))
CYLINDERS = (("B", "D"), ("E", "G"))
LOW, HIGH = (1.0, 1.5), (3.0, 3.5)  # strokes s1, s2 of both poses, m
HANGS = 8.0  # m, of the payload below the tip
SLEW = -np.pi / 2.0  # rad
KNUCKLE = "knuckle jib angle:\n+ unfolds; from the\nmain jib's line, so\nnegative here"


def crane_figure() -> Figure:
    """Slew from above, angles and strokes from starboard, and the signs of loads."""
    figure = Figure(figsize=(13.0, 5.2), layout="constrained")
    above, beside, loads = figure.subplots(1, 3, width_ratios=(1.0, 1.45, 0.75))
    _slew(above)
    _angles(beside)
    _loads(loads)
    return figure


def _points(slew: float, strokes: tuple[float, float]) -> dict[str, Array]:
    return load_crane().points(slew=slew, s1=strokes[0], s2=strokes[1])


def _slew(axes: Axes) -> None:
    foot = np.array(FOOT)
    outline = deck()
    axes.plot(outline[:, 0], outline[:, 1], color=SHIP, linewidth=1.4)
    for slew, colour in ((0.0, GHOST), (SLEW, MOVED)):
        tip = foot + _points(slew, LOW)["tip"]
        axes.plot([foot[0], tip[0]], [foot[1], tip[1]], color=colour, linewidth=4, solid_capstyle="butt")
    axes.plot(*foot[:2], "o", color=INK, markersize=5)
    arrow(axes, (-40, -5), (-24, -5), colour=X_COLOUR)
    arrow(axes, (-40, -5), (-40, 6), colour=Y_COLOUR)
    label(axes, (-21, -5), "x", colour=X_COLOUR, size=11)
    label(axes, (-37, 6), "y", colour=Y_COLOUR, size=11)
    arc(axes, foot, 13, np.pi, np.pi + SLEW, colour=MOVED)
    label(axes, (foot[0] - 23, foot[1] + 14), "-90 deg", colour=MOVED)
    label(axes, (foot[0] - 16, foot[1] - 6), "slew 0: jibs aft", colour="0.5")
    label(axes, (foot[0] + 2, foot[1] + 29), "jibs to port", colour=MOVED, ha="left")
    label(axes, (foot[0] + 3, foot[1] - 3), "V", ha="left")
    label(axes, (0, -24), "slew is right-handed about z (up)")
    axes.set(xlim=(-62, 66), ylim=(-30, 48))
    bare(axes, "from above: slew angle")


def _angles(axes: Axes) -> None:
    _draw(axes, _points(0.0, LOW), jib=GHOST, cylinder=GHOST)
    points = _points(0.0, HIGH)
    _draw(axes, points, jib=INK, cylinder=MOVED)
    c, f, tip = (points[name][[0, 2]] for name in ("C", "F", "tip"))
    axes.plot([c[0], c[0] - 17], [c[1], c[1]], ":", color=INK, linewidth=1.0)
    main, hand = (np.arctan2(*(end - start)[::-1]) for start, end in ((c, f), (f, tip)))
    arc(axes, c, 13, np.pi, main, colour=Z_COLOUR)
    label(axes, c + np.array([-15.5, 4.0]), "main jib\nangle +", colour=Z_COLOUR, ha="right")
    along = (f - c) / np.linalg.norm(f - c)
    axes.plot(*np.array([f, f + 12 * along]).T, ":", color=INK, linewidth=1.0)
    arc(axes, f, 8, hand, hand - np.radians(28.0), colour=Z_COLOUR)
    label(axes, f + np.array([-11.5, 2.6]), KNUCKLE, colour=Z_COLOUR, ha="right", size=8)
    for first, second, name, shift in (("B", "D", "s1 +", (-3.4, -0.8)), ("E", "G", "s2 +", (-2.6, -2.4))):
        start_point, end = (points[one][[0, 2]] for one in (first, second))
        reach = (end - start_point) / np.linalg.norm(end - start_point)
        middle = 0.5 * (start_point + end) + np.array(shift) * 0.45
        arrow(axes, middle - 2.5 * reach, middle + 2.5 * reach, colour=MOVED)
        label(axes, middle + 0.55 * np.array(shift), name, colour=MOVED)
    for name, shift in (("A", (1.6, -0.6)), ("B", (1.6, 0.4)), ("C", (1.6, 1.0)), ("D", (-0.4, 1.6)),
                        ("E", (2.2, 0.6)), ("F", (1.6, 1.2)), ("G", (-1.4, 2.0))):  # fmt: skip
        label(axes, points[name][[0, 2]] + np.array(shift), name, size=8)
    axes.plot(*np.array([tip, tip - np.array([0, HANGS])]).T, color=INK, linewidth=1.0)
    axes.plot([-40, 12], [0, 0], color=SHIP, linewidth=1.4)
    arrow(axes, (4, 0), (11, 0), colour=X_COLOUR)
    arrow(axes, (4, 0), (4, 7), colour=Z_COLOUR)
    label(axes, (12.5, 0.2), "x", colour=X_COLOUR, size=11)
    label(axes, (6, 7), "z", colour=Z_COLOUR, size=11)
    axes.set(xlim=(-46, 15), ylim=(-3, 50))
    bare(axes, "from starboard, slew 0: both strokes extended (grey: before)")


def _draw(axes: Axes, points: dict[str, Array], *, jib: str, cylinder: str) -> None:
    axes.plot([0, 0], [0, points["A"][2]], color=jib, linewidth=3)
    for lines, colour, width in ((LINES, jib, 2.6), (CYLINDERS, cylinder, 1.8)):
        for first, second in lines:
            ends = np.array([points[first], points[second]])
            axes.plot(ends[:, 0], ends[:, 2], color=colour, linewidth=width)


def _loads(axes: Axes) -> None:
    axes.plot([0, 0], [31, 41], color=MOVED, linewidth=5, solid_capstyle="butt")
    arrow(axes, (0, 41), (0, 47), colour=INK)
    arrow(axes, (0, 31), (0, 25), colour=INK)
    label(axes, (3, 36), "cylinder_force +\npushes its ends apart", ha="left")
    axes.plot([0, 0], [6, 18], color=INK, linewidth=1.2)
    axes.add_patch(_box((-2.2, 2.5), 4.4, 3.5))
    arrow(axes, (-1.4, 6), (-1.4, 11), colour=INK)
    arrow(axes, (-1.4, 18), (-1.4, 13), colour=INK)
    label(axes, (3, 12), "link_tension +\npulls its ends together;\nnegative: a rod that\npushes", ha="left")
    axes.set(xlim=(-6, 24), ylim=(-3, 50))
    bare(axes, "loads")


def _box(corner: tuple[float, float], width: float, height: float) -> Rectangle:
    return Rectangle(corner, width, height, fill=False, color="#8B0000", linewidth=1.4)
