"""An operability study by runs alone on case 2's crane, beside what the linear model says.

The payload hangs 25 m below the tip, swung out over the side. Guide lines brake its swing.
"""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from typing import Any

from seacrane import Criterion, Scene, allowable_hs, cases
from seacrane.crane import Payload

from .section import Section
from .sources import CRANE, LANES

LINK, MASS, G = 25.0, 10e3, 9.80665  # m, kg, m/s2
GUIDED = 0.03  # of critical damping, of the swing on guide lines
SWUNG_OUT = 50.0  # s
PERIODS, DIRECTIONS = (6.0, 9.0, 12.0), (90.0, 135.0, 180.0)  # s, degrees
HEIGHTS, SEEDS = (0.5, 1.0, 1.5, 2.0, 2.5), 4  # m
DURATION, START_UP, TOLERANCE = 10_800.0, 300.0, 1e-4  # s, s
CRITERIA = (
    Criterion(channel="hook_load", maximum=1.15 * MASS * G, name="hook load"),
    Criterion(channel="tip_velocity", names={"axis": "z"}, maximum=0.8, name="tip velocity"),
    *(
        Criterion(
            channel="position", names={"body": "payload", "axis": axis}, maximum=3.0, motion=True,
            statistic="significant", name=f"swing {way}",
        )
        for axis, way in (("x", "fore and aft"), ("y", "athwart"))
    ),
)  # fmt: skip


def study_scene() -> Scene:
    """Case 2 with its payload 25 m below the tip, and guide lines."""
    scene = cases.case2(payload=Payload(mass=MASS, link_length=LINK))
    body, tip = scene.roles[""].tip
    scene.add_spring(name="guide lines", first=body, second="payload", first_point=tip, damping_ratio=GUIDED)
    return scene


def study(**given: Any) -> Any:
    """The table of the study; `domain` and what runs it are given."""
    return allowable_hs(
        study_scene(), criteria=CRITERIA, tp=PERIODS, direction_deg=DIRECTIONS, hs=HEIGHTS,
        seeds=range(1, SEEDS + 1), duration=DURATION, start_up=START_UP, time=SWUNG_OUT, rtol=TOLERANCE,
        **given,
    )  # fmt: skip


def operability() -> Iterator[list[str]]:
    """A row for each period and direction."""
    with ThreadPoolExecutor(2) as executor:
        runs = study(domain="time", executor=executor).dataset
    linear = study(domain="frequency").dataset
    for tp in PERIODS:
        for direction in DIRECTIONS:
            cell, by_model = (one.sel(tp=tp, direction_deg=direction) for one in (runs, linear))
            numbers = [float(cell[name]) for name in ("allowable_hs", "low", "high")]
            told = [f"{value:.3f}" for value in (*numbers, float(by_model["allowable_hs"]))]
            governs = str(cell["governing"].item()) or "none"
            yield [f"{tp:g}", f"{direction:g}", *told[:3], governs, told[3]]


SECTION = Section(
    title="Operability of case 2",
    text=(
        f"Allowable Hs by runs of three hours alone, {SEEDS} seeds at {len(HEIGHTS)} heights in each sea, "
        f"with its interval, and what the linear model says. A load of {MASS / 1e3:g} t hangs {LINK:g} m "
        f"below the tip, guide lines brake its swing by {100 * GUIDED:g} % of critical."
    ),
    head=["Tp, s", "direction, deg", "allowable Hs, m", "low, m", "high, m", "governing", "linear model, m"],
    rows=operability,
    sources=(*CRANE, *LANES, "python/seacrane/operability", "python/seacrane/statistics"),
)
