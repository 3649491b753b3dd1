"""Run one setting of one case, within a time, and tell how it ended."""

from __future__ import annotations

import time
import warnings
from dataclasses import dataclass, replace
from itertools import combinations
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.errors import SceneError, SimulationError
from seacrane.inputs.frames import rotation_matrix
from seacrane.run.method import Method
from seacrane.run.simulation import Run
from stability_atlas import rows
from stability_atlas.axis import Case
from stability_atlas.rows import UNKNOWN, Row

Array = NDArray[np.float64]
CHECKS = ("constraint_error", "constraint_error_before_projection", "energy_balance", "absolute_work")
MOTION = ("position", "quaternion", "velocity", "angular_velocity")
LEAST_MOTION = 1e-9  # m; what rests within it has no relative error
AGREED = 1e-4  # of the motion, within which two tight runs need no third
SLOWER = 4.0  # a tight run may take that many times the time of others
TIGHT = (
    Method(formulation="redundant", integrator="verner76", rtol=1e-11),
    Method(formulation="recursive", integrator="dop853", rtol=1e-11),
    Method(formulation="redundant", integrator="dop853", rtol=1e-9),
    Method(formulation="recursive", integrator="verner76", rtol=1e-9),
)


class OutOfTime(Exception):
    """The time granted to a run is over."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Reference:
    """Points on the bodies at the outputs (n, bodies, 4, 3), m; how well they are known, over the motion."""

    points: Array | None
    motion: float
    uncertainty: float
    known: str


def points_on_bodies(position: Array, quaternion: Array) -> Array:
    """The centre of mass, and one metre from it along each body axis: (n, bodies, 4, 3), m."""
    axes = np.swapaxes(rotation_matrix(quaternion), -1, -2)
    return np.concatenate([position[..., None, :], position[..., None, :] + axes], axis=-2)


def largest_motion(points: Array) -> float:
    """Largest distance of any point from where it was at the first output, m."""
    return float(np.linalg.norm(points - points[0], axis=-1).max())


def run_within(case: Case, method: Method, limit_s: float) -> tuple[Run, OutOfTime | SimulationError | None]:
    """A run of all that the atlas looks at, and what ended it early.

    `limit_s` is processor time, so that the verdict does not depend on what else the machine does.
    """
    deadline = time.process_time() + limit_s

    def ask(_: float) -> None:
        if time.process_time() > deadline:
            raise OutOfTime(f"granted {limit_s:g} s of processor time")

    model = case.scene.compile()
    known = model.channel_names(defaults_only=False)
    run = Run(
        case.scene, t_end=case.t_end, dt_out=case.dt_out, start=case.start, model=model,
        channels=[name for name in (*MOTION, *CHECKS) if name in known], **method.arguments(),
    )  # fmt: skip
    try:
        if not run.advance(case.t_end, ask):
            raise KeyboardInterrupt
    except (OutOfTime, SimulationError) as error:
        return run, error
    return run, None


def reference(case: Case, limit_s: float) -> Reference:
    """From two tight runs that differ in equations and method; if they disagree, the two nearest of all."""
    if case.truth is not None:
        points = points_on_bodies(*case.truth)
        return Reference(points=points, motion=largest_motion(points), uncertainty=UNKNOWN, known="")
    found: list[tuple[str, Array]] = []
    failed: list[str] = []
    stop: Exception | None
    for method in TIGHT:
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                run, stop = run_within(case, method, SLOWER * limit_s)
        except (SceneError, SimulationError) as error:
            stop = error
        if stop is None:
            channels = run.core.channels()
            found.append((method.name, points_on_bodies(channels["position"], channels["quaternion"])))
        else:
            failed.append(f"not {method.name}: {one_line(stop)}")
        if len(found) >= 2 and _nearest(found)[0] <= AGREED * largest_motion(found[0][1]):
            break
    if not found:
        return Reference(points=None, motion=UNKNOWN, uncertainty=UNKNOWN, known="; ".join(failed))
    apart, first, second = _nearest(found) if len(found) > 1 else (UNKNOWN, 0, 0)
    points = found[first][1]
    motion = largest_motion(points)
    names = dict.fromkeys([found[first][0], found[second][0]])
    return Reference(
        points=points, motion=motion, uncertainty=apart / motion if motion > LEAST_MOTION else UNKNOWN,
        known="; ".join([*names, *failed]),
    )  # fmt: skip


def _nearest(runs: list[tuple[str, Array]]) -> tuple[float, int, int]:
    """Distance of the two runs that are nearest to each other, m, and which these are."""
    pairs = combinations(range(len(runs)), 2)
    return min((_distance(runs[i][1], runs[j][1]), i, j) for i, j in pairs)


def measure(case: Case, method: Method, truth: Reference, limit_s: float, row: Row) -> Row:
    """The row filled in; never raises for what a run may do."""
    begun = time.perf_counter()
    row = replace(row, uncertainty=truth.uncertainty, motion=truth.motion)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            run, stop = run_within(case, method, limit_s)
            row = replace(row, **_counts(run))
            if stop is None:
                row = _completed(case, run.core.channels(), truth, row)
            else:
                verdict = rows.SLOW if isinstance(stop, OutOfTime) else rows.STOPPED
                row = replace(row, verdict=verdict, message=one_line(stop))
        except SimulationError as stopped:  # at the start
            row = replace(row, verdict=rows.STOPPED, message=one_line(stopped))
        except ValueError as refusal:  # a SceneError, or that of a function of arrays
            row = replace(row, verdict=rows.REFUSED, message=one_line(refusal))
        except Exception as error:
            row = replace(row, verdict=rows.UNNAMED, message=f"{type(error).__name__}: {one_line(error)}")
    return replace(row, wall_s=time.perf_counter() - begun)


def _completed(case: Case, channels: dict[str, Array], truth: Reference, row: Row) -> Row:
    for name, values in channels.items():
        if not np.isfinite(values).all():
            return replace(row, verdict=rows.NOT_FINITE, message=f"{name} is not finite")
    points = points_on_bodies(channels["position"], channels["quaternion"])
    error = UNKNOWN
    if truth.points is not None and truth.motion > LEAST_MOTION:
        error = _distance(points, truth.points) / truth.motion
    return replace(
        row, verdict=rows.COMPLETED, error=error, energy=_energy(case, channels),
        motion=row.motion if truth.points is not None else largest_motion(points),
        drift=float(channels["constraint_error_before_projection"].max()),
        left=float(channels["constraint_error"].max()),
    )  # fmt: skip


def _distance(points: Array, others: Array) -> float:
    return float(np.linalg.norm(points - others, axis=-1).max())


def _energy(case: Case, channels: dict[str, Array]) -> float:
    """Largest balance over the absolute work by the end, or the largest kinetic energy."""
    bodies = case.scene.bodies.values()
    mass = np.array([body.mass for body in bodies])
    inertia = np.array([body.inertia for body in bodies])
    rotation = rotation_matrix(channels["quaternion"])
    spin = np.einsum("nkji,nkj->nki", rotation, channels["angular_velocity"])
    kinetic = 0.5 * (
        np.einsum("k,nki,nki->n", mass, channels["velocity"], channels["velocity"])
        + np.einsum("kij,nki,nkj->n", inertia, spin, spin)
    )
    size = max(float(channels["absolute_work"][-1]), float(kinetic.max()))
    return float(np.abs(channels["energy_balance"]).max()) / size if size > 0.0 else UNKNOWN


def _counts(run: Run) -> dict[str, Any]:
    counted = run.core.statistics()
    names = ("steps", "rejected_steps", "evaluations", "dense_solves")
    return {name: int(counted[name]) for name in names} | {"simulated_s": run.core.time - run.start.time}


def one_line(error: BaseException) -> str:
    """An exception's text without line breaks."""
    return " ".join(str(error).split())
