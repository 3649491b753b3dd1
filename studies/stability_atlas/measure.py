"""The rows of an atlas: one method on one case, within a time; and the reference of a case."""

from __future__ import annotations

import warnings
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from seacrane import Method, SimulationError
from seacrane.trading.case import Case
from seacrane.trading.measured_case import measured, timed
from seacrane.trading.reference import Reference, reference
from seacrane.trading.row import UNNAMED, Row
from stability_atlas.methods import TIGHT
from stability_atlas.points import POINTS, QUANTITIES

Array = NDArray[np.float64]
AGREED = 1e-4  # of the motion, within which two tight runs need no third
SLOWER = 4.0  # a tight run may take that many times the time of others


def reference_of(case: Case, limit_s: float) -> Reference:
    """From two tight runs that differ in equations and method; if they disagree, the two nearest of all."""
    if case.truth is not None:
        return Reference(values=case.truth)

    def run(method: Method) -> Mapping[str, Array] | str:
        try:
            done = timed(case, method, POINTS.channels, limit_s=SLOWER * limit_s)
            if done.stopped is None:
                return {POINTS.name: POINTS.values(done.result())}
            reason: Exception = done.stopped
        except (ValueError, SimulationError) as error:  # a SceneError, or a result that is not finite
            reason = error
        return " ".join(str(reason).split())

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return reference(run, TIGHT, enough=AGREED)


def measure(case: Case, method: Method, truth: Reference, limit_s: float, row: Row) -> Row:
    """The row filled in; never raises for what a run may do."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            return measured(case, method, QUANTITIES, truth, row, limit_s=limit_s)
        except Exception as error:
            return row.ended(UNNAMED, f"{type(error).__name__}: {error}")
