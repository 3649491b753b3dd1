"""The reference of a case, and what a run of it by a method costs, how it ends and how wrong it is."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from seacrane.accuracy.case import Case, OutOfTime, timed
from seacrane.accuracy.methods import TIGHT
from seacrane.accuracy.quantities import Quantity, channels_of, compare, motion_of
from seacrane.accuracy.row import COMPLETED, NOT_FINITE, REFUSED, SLOW, STOPPED, UNKNOWN, Row
from seacrane.analysis.after_run import require_finite
from seacrane.arrays import Array
from seacrane.errors import SceneError, SeacraneError, SimulationError
from seacrane.inputs.frames import rotation_matrix
from seacrane.result.result import Result
from seacrane.run.method import Method
from seacrane.scene.scene import Scene

CHECKS = ("constraint_error", "constraint_error_before_projection", "energy_balance", "absolute_work",
          "quaternion", "velocity", "angular_velocity")  # fmt: skip
COUNTED = ("steps", "rejected_steps", "evaluations", "dense_solves")


@dataclass(frozen=True, kw_only=True, eq=False)
class Reference:
    """Values by quantity, and how well they are known."""

    values: Mapping[str, Array] = field(default_factory=dict)  # each (n, items, parts)
    uncertainty: Mapping[str, float] = field(default_factory=dict)  # how far tight runs differ
    runs: tuple[str, ...] = ()  # the methods, the one that gave the values first
    refused: Mapping[str, str] = field(default_factory=dict)  # methods that did not work, and why

    @property
    def motion(self) -> dict[str, float]:
        """Largest distance of each quantity from its start."""
        return {name: motion_of(values) for name, values in self.values.items()}


def tight_reference(
    case: Case, quantities: Mapping[str, Quantity], methods: Sequence[Method] = TIGHT
) -> Reference:
    """A tight run and its check, in another formulation and by another method; the first is the reference.

    Raises SceneError if fewer than two of them work: a reference without a second opinion is none.
    """
    found: dict[str, Mapping[str, Array]] = {}
    refused = {}
    for method in methods:
        try:
            result = require_finite(timed(case, method, channels_of(quantities)).result())
            found[method.name] = {name: quantity.values(result) for name, quantity in quantities.items()}
        except SeacraneError as error:
            refused[method.name] = str(error)
        if len(found) == 2:
            break
    else:
        raise SceneError(
            f"scene {case.scene.name!r}: only {len(found)} of {len(methods)} reference runs work, and one "
            f"cannot be checked: {'; '.join(refused.values())}"
        )
    truth, other = found.values()
    apart = {name: compare(values, other[name]).largest for name, values in truth.items()}
    return Reference(values=truth, uncertainty=apart, runs=tuple(found), refused=refused)


def measured(
    case: Case,
    method: Method,
    quantities: Mapping[str, Quantity],
    truth: Reference,
    row: Row,
    *,
    repeats: int = 1,
    long_s: float = np.inf,
    limit_s: float | None = None,
) -> Row:
    """The row filled in; what stops or refuses the run is its verdict. Bounds are those of `timed`."""
    row = replace(row, uncertainty=truth.uncertainty, motion=truth.motion)
    channels = [*channels_of(quantities), *CHECKS]
    try:
        done = timed(case, method, channels, repeats=repeats, long_s=long_s, limit_s=limit_s)
        counted: dict[str, Any] = {name: int(done.stats[name]) for name in COUNTED}
        row = replace(
            row, stepped=str(done.stats["formulation"]), simulated_s=float(done.stats["simulated_s"]),
            wall_s=done.wall_s, cpu_s=done.cpu_s, **counted,
        )  # fmt: skip
        result = done.result()
        for name, array in result.channels.items():
            if not np.isfinite(array).all():
                return row.ended(NOT_FINITE, f"{name} is not finite")
        found = {name: quantity.values(result) for name, quantity in quantities.items()}
    except OutOfTime as stopped:
        return row.ended(SLOW, stopped)
    except SimulationError as stopped:
        return row.ended(STOPPED, stopped)
    except ValueError as refusal:  # a SceneError, or that of a function of arrays
        return row.ended(REFUSED, refusal)
    errors = {name: compare(truth.values[name], v) for name, v in found.items() if name in truth.values}
    own = {name: motion_of(v) for name, v in found.items() if name not in truth.motion}
    largest = {name: float(result.channels[name].max()) for name in CHECKS[:2] if name in result.channels}
    return replace(
        row, errors=errors, motion={**truth.motion, **own},
        drift=largest.get("constraint_error_before_projection", UNKNOWN),
        left=largest.get("constraint_error", UNKNOWN), energy=energy_error(case.scene, result),
    ).ended(COMPLETED, "")  # fmt: skip


def energy_error(scene: Scene, result: Result) -> float:
    """Largest balance over the absolute work by the end, or the largest kinetic energy; NaN without them."""
    if not {"energy_balance", "absolute_work"} <= result.channels.keys():
        return UNKNOWN
    bodies = scene.bodies.values()
    mass = np.array([body.mass for body in bodies])
    inertia = np.array([body.inertia for body in bodies])
    velocity, rotation = result["velocity"], rotation_matrix(result["quaternion"])
    spin = np.einsum("nkji,nkj->nki", rotation, result["angular_velocity"])
    kinetic = 0.5 * (
        np.einsum("k,nki,nki->n", mass, velocity, velocity) + np.einsum("kij,nki,nkj->n", inertia, spin, spin)
    )
    size = max(float(result["absolute_work"][-1]), float(kinetic.max()))
    return float(np.abs(result["energy_balance"]).max()) / size if size > 0.0 else UNKNOWN
