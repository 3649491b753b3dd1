"""Directions of waves, wind and current, and how a wave travels."""

from __future__ import annotations

import numpy as np
from drawing import GHOST, INK, SEA, SHIP, X_COLOUR, Y_COLOUR, arc, arrow, bare, deck, label
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from seacrane.sea import WaveComponents

WORDS = {
    0: "0: following",
    45: "45",
    90: "90: towards port",
    135: "135: from the\nstarboard bow",
    180: "180: head",
    225: "225 (-135): from\nthe port bow",
    270: "270 (-90): towards starboard",
    315: "315 (-45)",
}
PERIOD = 8.0  # s, of the wave in the picture


def waves_figure() -> Figure:
    """The rose of directions, and one component at two times."""
    figure = Figure(figsize=(11.0, 4.9), layout="constrained")
    above, beside = figure.subplots(1, 2, width_ratios=(1.25, 1.0))
    _rose(above)
    _profile(beside)
    return figure


def _rose(axes: Axes) -> None:
    outline = deck()
    axes.plot(outline[:, 0], outline[:, 1], color=SHIP, linewidth=1.4)
    arrow(axes, (0, 0), (30, 0), colour=X_COLOUR)
    arrow(axes, (0, 0), (0, 22), colour=Y_COLOUR)
    label(axes, (35, 0), "x", colour=X_COLOUR, size=11)
    label(axes, (5, 22), "y", colour=Y_COLOUR, size=11)
    for degrees, words in WORDS.items():
        to = np.array([np.cos(np.radians(degrees)), np.sin(np.radians(degrees))])
        arrow(axes, -124 * to, -84 * to, colour=SEA, width=2.2)
        label(axes, -(144 + 14 * abs(to[0])) * to, words, colour=SEA)
    arc(axes, (0, 0), 66, 0.0, np.radians(120.0), colour=INK)
    label(axes, (-4, 42), "from +x\ntowards +y", size=8)
    axes.set(xlim=(-200, 200), ylim=(-162, 162))
    bare(axes, "from above: direction_deg is where waves, wind and current go to\n(heading_deg of the sea 0)")


def _profile(axes: Axes) -> None:
    omega = 2.0 * np.pi / PERIOD
    wave = WaveComponents(omega=[omega], amplitude=[1.0], phase=[0.0], direction=[0.0])
    x = np.linspace(-60.0, 170.0, 400)
    early, late = ([wave.elevation(t, x=at, y=0.0) for at in x] for t in (0.0, PERIOD / 6.0))
    axes.axhline(0.0, color=GHOST, linewidth=0.8)
    axes.plot(x, late, color=SEA, linewidth=1.6, label="one sixth of a period later")
    axes.plot(x, early, "--", color=SEA, linewidth=1.1, label="t = 0, phase 0: crest at the origin")
    number = omega**2 / 9.81
    moved = omega * PERIOD / 6.0 / number
    arrow(axes, (0.0, 1.12), (moved, 1.12), colour=INK)
    axes.plot(0, 0, "o", color=INK, markersize=4)
    axes.set(xlabel="x [m]", ylabel="elevation [m]", ylim=(-1.6, 1.4))
    axes.grid(True, linewidth=0.4, alpha=0.6)
    axes.legend(loc="lower center", fontsize=8, ncols=2, frameon=False)
    axes.set_title("a component of direction 0: its crests travel towards +x", fontsize=10)
