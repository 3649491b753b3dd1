"""The rows of an atlas: one method on one case, within a time; and the reference of a case."""

from __future__ import annotations

import math
import warnings
from collections.abc import Mapping
from itertools import combinations

from seacrane import Method, SimulationError
from seacrane.accuracy.case import Case, OutOfTime, timed
from seacrane.accuracy.measured import Reference, measured
from seacrane.accuracy.quantities import compare, motion_of
from seacrane.accuracy.row import UNNAMED, Row
from seacrane.arrays import Array
from stability_atlas.methods import TIGHT
from stability_atlas.points import POINTS, QUANTITIES, KnownCase

REST = 1e-300  # in place of no motion
AGREED = 1e-4  # of the motion, within which two tight runs need no third
SLOWER = 4.0  # a tight run may take that many times the time of others


def reference_of(case: Case, limit_s: float) -> Reference:
    """From two tight runs that differ in equations and method; if they disagree, the two nearest of all."""
    if isinstance(case, KnownCase):
        return Reference(values={POINTS.name: case.truth})

    found: dict[str, Array] = {}
    refused = {}
    for method in TIGHT:
        try:
            with warnings.catch_warnings(action="ignore"):
                done = timed(case, method, POINTS.channels, limit_s=SLOWER * limit_s)
                found[method.name] = POINTS.values(done.result())
        except (ValueError, SimulationError, OutOfTime) as error:  # a SceneError, or what is not finite
            refused[method.name] = " ".join(str(error).split())
        if len(found) > 1 and _nearest(found)[0] <= AGREED:
            break
    if len(found) < 2:
        values = [(POINTS.name, one) for one in found.values()]
        return Reference(values=dict(values), runs=tuple(found), refused=refused)
    _, names = _nearest(found)
    apart = compare(*(found[name] for name in names)).largest
    return Reference(
        values={POINTS.name: found[names[0]]}, uncertainty={POINTS.name: apart}, runs=names, refused=refused
    )  # fmt: skip


def _nearest(found: Mapping[str, Array]) -> tuple[float, tuple[str, str]]:
    """The two runs that are nearest to each other, and their distance over the motion of the first run."""
    motion = max(motion_of(next(iter(found.values()))), REST)

    def distance(pair: tuple[str, str]) -> float:
        apart = compare(found[pair[0]], found[pair[1]]).largest
        return apart / motion if math.isfinite(apart) else math.inf

    nearest = min(combinations(found, 2), key=distance)
    return distance(nearest), nearest


def measure(case: Case, method: Method, truth: Reference, limit_s: float, row: Row) -> Row:
    """The row filled in; never raises for what a run may do."""
    with warnings.catch_warnings(action="ignore"):
        try:
            return measured(case, method, QUANTITIES, truth, row, limit_s=limit_s)
        except Exception as error:
            return row.ended(UNNAMED, f"{type(error).__name__}: {error}")
