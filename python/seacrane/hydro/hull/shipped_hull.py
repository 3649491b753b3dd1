"""`shipped_hull`: the wetted surface that the shipped database was computed from."""

from __future__ import annotations

from functools import cache

from seacrane.hydro.hull.hull import Hull
from seacrane.hydro.hull.parametric_hull import ParametricHull

VOLUME = 14.0e6 / 1025.0  # m3
STATIONS, GIRTH = 56, 20
LINES = ParametricHull(
    length=115.0,
    breadth=25.0,
    draught=6.4,
    entrance_length=40.0,
    run_length=34.5,
    transom_breadth_fraction=0.75,
    transom_draught_fraction=0.2,
    section_exponent=6.0,
)


@cache
def shipped_hull() -> Hull:
    """The hull of 115 m of `shipped_database`, its origin the database's reference point; made once."""
    shape = LINES.scaled_to_volume(VOLUME, stations=STATIONS, girth=GIRTH)
    return Hull.from_parametric(shape, stations=STATIONS, girth=GIRTH, name="hull_115")
