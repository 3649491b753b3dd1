"""What strip theory costs: a hull's whole database, and its parts."""

from __future__ import annotations

from typing import Any

import numpy as np

from seacrane import _core
from seacrane.hydro.hull.parametric_hull import ParametricHull

from .section import Section
from .timing import best_seconds

HULL = ParametricHull(
    length=115.0,
    breadth=25.0,
    draught=6.4,
    entrance_length=40.0,
    run_length=34.5,
    transom_breadth_fraction=0.75,
    transom_draught_fraction=0.2,
    section_exponent=6.0,
    origin_from_transom=57.5,
)
STATIONS, FREQUENCIES, HEADINGS = 24, 60, 13


def strip_cost(*, repeats: int) -> Section:
    """CPU time of the 115 m hull by strip theory, at rest and under way, and by panels on a section."""
    x = np.linspace(-57.5, 57.5, STATIONS)
    sections = [_section(float(station)) for station in x]
    omega, heading = np.linspace(0.05, 3.0, FREQUENCIES), np.linspace(0.0, np.pi, HEADINGS)

    def seconds(**options: Any) -> float:
        settings = {"omega": omega, "heading": heading, **options}
        return best_seconds(lambda: _core.strip_theory(x=x, sections=sections, **settings), repeats=repeats)

    rows = [
        ["at rest, 40 panels (default)", seconds()],
        ["at rest, 20 panels", seconds(panels=20)],
        ["at rest, 80 panels", seconds(panels=80)],
        ["at rest, one heading", seconds(heading=[np.pi])],
        ["5 m/s, 40 panels", seconds(speed=5.0)],
    ]
    return Section(
        title="Strip theory",
        text=(
            f"The 115 m hull, {STATIONS} stations, {FREQUENCIES} frequencies, {HEADINGS} headings: added "
            f"mass, damping and forces; CPU time, best of {repeats}. Under way every heading meets the waves "
            "at frequencies of its own, and the sections are solved for each."
        ),
        head=["case", "CPU, s"],
        rows=rows,
    )


def _section(x: float) -> np.ndarray[Any, np.dtype[np.float64]]:
    points = HULL.section(x, 40)
    points[0, 1] = points[-1, 0] = 0.0
    return points
