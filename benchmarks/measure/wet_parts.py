"""What water on a load costs: one evaluation of a lift with parts in still water and in waves."""

from __future__ import annotations

import warnings
from collections.abc import Iterator

from seacrane import Scene, shipped_database
from seacrane.hydro import BoxPart

from .section import Section
from .sources import CRANE
from .timing import evaluation_ns

SIZE = (10.0, 4.0, 3.0)  # m
STRIPS = (1, 5, 20)
REPEATS = 5


def wet_parts() -> Iterator[list[object]]:
    """ns of an evaluation, dry and with strips, in both forms."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for formulation in ("recursive", "redundant"):
            dry = [_ns(0, formulation, waves=waves) for waves in (False, True)]
            for strips in STRIPS:
                wet = [_ns(strips, formulation, waves=waves) for waves in (False, True)]
                yield [
                    formulation,
                    strips,
                    *dry,
                    *wet,
                    *(one / other for one, other in zip(wet, dry, strict=True)),
                ]


def _ns(strips: int, formulation: str, *, waves: bool) -> float:
    scene = Scene(name="wet lift")
    scene.add_vessel(shipped_database())
    scene.add_crane(slew=-1.2, s1=1.4, s2=1.0)
    tip = scene.place_of("tip")
    scene.add_hoist(mass=60e3, size=SIZE, length=float(tip[2]) - 0.5 * SIZE[2], EA=4e8, rung="quasi-static",
                    winch={"lag": 0.3, "maximum_rate": 1.0})  # fmt: skip
    if strips:
        scene.add_immersed("load", parts=[BoxPart(size=SIZE, strips=(strips, 1), fill=0.2, perforation=0.2)])
    if waves:
        scene.add_sea(hs=1.5, tp=7.0, direction_deg=150.0, seed=1)
    return evaluation_ns(scene.compile(), repeats=REPEATS, count=1000, formulation=formulation)


SECTION = Section(
    title="Water on a load",
    text=(
        "Shipped hull and held crane, alone or in a sea of 200 components (Hs 1.5 m, Tp 7 s); a box of "
        f"{SIZE[0]:g} x {SIZE[1]:g} x {SIZE[2]:g} m on the wire of a winch, its middle at the surface, cut "
        f"into strips in a row. ns of an evaluation, best of {REPEATS}."
    ),
    head=["formulation", "strips", "dry, no sea [ns]", "dry, in waves [ns]", "wet, no sea [ns]",
          "wet, in waves [ns]", "over dry, no sea", "over dry, in waves"],
    rows=wet_parts,
    sources=(*CRANE, "python/seacrane/hydro/parts", "cpp/seacrane/elements/loads/immersed*",
             "cpp/seacrane/elements/loads/*water*", "cpp/seacrane/elements/loads/wet_volume.hpp"),
)  # fmt: skip
