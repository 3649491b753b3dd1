"""What contact costs: one evaluation of a lift without it, with it apart, and closed."""

from __future__ import annotations

import warnings
from collections.abc import Iterator

from seacrane import Scene, shipped_database

from .section import Section
from .sources import CRANE
from .timing import evaluation_ns

SIZE = (6.0, 4.0, 3.0)  # m
POINTS = (1, 4, 15)
REPEATS = 5


def contact_cost() -> Iterator[list[object]]:
    """ns of an evaluation in both forms, without contact, apart and closed."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for formulation in ("recursive", "redundant"):
            without = _ns(0, 0.0, formulation)
            for points in POINTS:
                apart, closed = (_ns(points, gap, formulation) for gap in (20.0, -0.01))
                yield [formulation, points, without, apart, closed, apart / without, closed / without]


def _ns(points: int, gap: float, formulation: str) -> float:
    scene = Scene(name="lift")
    scene.add_vessel(shipped_database())
    scene.add_crane(slew=-1.2, s1=1.4, s2=1.0)
    scene.add_hoist(mass=60e3, size=SIZE, length=10.0, EA=4e8, rung="quasi-static")
    scene.add_sea(hs=1.5, tp=7.0, direction_deg=150.0, seed=1)
    if points:
        low = scene.place_of("load", (0.0, 0.0, -0.5 * SIZE[2]))
        (hull,) = scene.vessels
        deck = scene.place_of(hull)
        feet = [(0.2 * i - 1.4, 0.3 * (i % 2), -0.5 * SIZE[2]) for i in range(points)]
        scene.add_contact("load", on=hull, points=feet, place=low - deck - (0.0, 0.0, gap), friction=0.3)
    return evaluation_ns(scene.compile(), repeats=REPEATS, count=1000, formulation=formulation)


SECTION = Section(
    title="Contact",
    text=(
        "Shipped hull and held crane in a sea of 200 components (Hs 1.5 m, Tp 7 s), a load on a wire; its "
        "points against a plane of the hull with friction, all 20 m away, or all pressed by 1 cm. ns of an "
        f"evaluation, best of {REPEATS}."
    ),
    head=["formulation", "points", "without [ns]", "apart [ns]", "closed [ns]", "apart over without",
          "closed over without"],
    rows=contact_cost,
    sources=(*CRANE, "cpp/seacrane/elements/loads/contact*", "cpp/seacrane/elements/loads/surface_law.hpp"),
)  # fmt: skip
