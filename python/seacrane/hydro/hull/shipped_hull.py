"""`shipped_hull`: the wetted surface that the shipped database was computed from."""

from __future__ import annotations

from functools import cache

from seacrane.hydro.hull.hull import Hull
from seacrane.hydro.hull.parametric_hull import ParametricHull

VOLUME = 14.0e6 / 1025.0  # m3
STATIONS, GIRTH = 56, 20
# Of the entrance that encloses the volume, about its centre of buoyancy.
LINES = ParametricHull(
    length=115.0,
    breadth=25.0,
    draught=6.4,
    entrance_length=46.77395891238753,
    run_length=34.5,
    transom_breadth_fraction=0.75,
    transom_draught_fraction=0.2,
    section_exponent=6.0,
    origin_from_transom=55.298818409692544,
)


@cache
def shipped_hull() -> Hull:
    """The hull of 115 m of `shipped_database`, its origin the database's reference point; made once."""
    return Hull.from_parametric(LINES, stations=STATIONS, girth=GIRTH, name="hull_115")
