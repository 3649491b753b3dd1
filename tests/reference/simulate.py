"""Integration in time: SciPy's `solve_ivp` on the index-1 form, projected between intervals and at
outputs.
"""

from __future__ import annotations

import math
import time as clock
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from .kinematics import Motion
from .rotation import Array, quaternions_from_matrices, skew
from .system import Evaluation, System

UNCONTROLLED = 1e300  # absolute tolerance of the two work integrals: they follow the steps of the motion


@dataclass
class Layout:
    """Packing of the state: r, R, v, w of all bodies, memory states, work, absolute work."""

    bodies: int
    memory: int

    @property
    def size(self) -> int:
        return 18 * self.bodies + self.memory + 2

    def pack(self, motion: Motion, memory: Array, work: Array) -> Array:
        parts = (motion.r[:-1], motion.rotation[:-1], motion.v[:-1], motion.w[:-1], memory, work)
        return np.concatenate([np.ravel(part) for part in parts])

    def unpack(self, y: Array) -> tuple[Motion, Array, Array]:
        n = self.bodies
        r, v, w = np.zeros((n + 1, 3)), np.zeros((n + 1, 3)), np.zeros((n + 1, 3))
        rotation = np.empty((n + 1, 3, 3))
        rotation[n] = np.eye(3)
        r[:n] = y[: 3 * n].reshape(n, 3)
        rotation[:n] = y[3 * n : 12 * n].reshape(n, 3, 3)
        v[:n] = y[12 * n : 15 * n].reshape(n, 3)
        w[:n] = y[15 * n : 18 * n].reshape(n, 3)
        return Motion(r, rotation, v, w), y[18 * n : 18 * n + self.memory], y[18 * n + self.memory :]

    def tolerance(self, atol: float) -> Array:
        values = np.full(self.size, atol)
        values[-2:] = UNCONTROLLED
        return values


def simulate(
    system: System,
    t_end: float,
    times: ArrayLike,
    rtol: float = 1e-10,
    *,
    atol: float | None = None,
    method: str = "DOP853",
    projection_interval: float = 1.0,
    max_step: float = math.inf,
    memory_start: ArrayLike | None = None,
) -> dict[str, Any]:
    """Integrate from t = 0 and return arrays at the times asked for.

    Parameters
    ----------
    times : (k,) rising output times within [0, t_end], s.
    rtol, atol : tolerances per state; atol defaults to rtol / 100 (m, rad, m/s, rad/s, memory units).
    projection_interval : the state is projected and the integrator restarted at multiples of it, s.

    Returns
    -------
    dict with `time` (k), `position`, `velocity`, `angular_velocity` (k, n, 3) of the centres of mass in the
    inertial frame, `quaternion` (k, n, 4), `acceleration` (k, n, 6), `reaction_force`, `reaction_moment`
    (k, joints, 3), `multipliers` (k, m), `driver_load` (k, drivers), `actuator_load` (k, actuators),
    `coordinate`, `coordinate_rate` (k, revolute and sliding joints), `constraint_error`,
    `constraint_rate_error`, `constraint_error_before_projection`, `energy`, `energy_balance`,
    `absolute_work` (k); with a vessel `vessel_motion`, `wave_force`, `memory_force` (k, 6) and
    `memory_state`; `names` (dict of lists) and `stats` (dict of counters).

    Raises
    ------
    RuntimeError if the integrator gives up; ValueError for bad times or a start that does not close.
    """
    wanted = checked_times(times, t_end)
    began = clock.perf_counter()
    layout = Layout(len(system.mass), system.memory_states)
    memory = np.zeros(layout.memory) if memory_start is None else np.asarray(memory_start, dtype=float)
    motion = system.project(0.0, system.start, memory)
    y = layout.pack(motion, memory, np.zeros(2))
    recorder = Recorder(system, layout, system.evaluate(0.0, motion, memory).energy)
    if wanted[0] == 0.0:
        recorder.record(0.0, y)

    atol_vector = layout.tolerance(0.01 * rtol if atol is None else atol)
    settings = {"method": method, "rtol": rtol, "atol": atol_vector, "max_step": max_step}
    evaluations = steps = 0
    step = math.inf
    stops = interval_ends(t_end, projection_interval, system.breaks)
    for t_start, t_stop in zip([0.0, *stops[:-1]], stops, strict=True):
        solution = advance(system, layout, (t_start, t_stop), y, step, settings)
        evaluations += solution.nfev
        steps += len(solution.t) - 1
        if len(solution.t) > 2:
            step = float(np.max(np.diff(solution.t)))
        for t in wanted[(wanted > t_start) & (wanted <= t_stop)]:
            recorder.record(float(t), solution.y[:, -1] if t == t_stop else solution.sol(t))
        motion, memory, work = layout.unpack(solution.y[:, -1])
        y = layout.pack(system.project(t_stop, motion, memory), memory, work)
    result = recorder.result()
    result["stats"] = {
        "evaluations": evaluations,
        "steps": steps,
        "wall_s": clock.perf_counter() - began,
        "degrees_of_freedom": system.degrees_of_freedom,
        "constraints": system.rows.count,
        "rank": system.rank,
    }
    return result


def checked_times(times: ArrayLike, t_end: float) -> Array:
    """Output times as an array, refused if they do not rise or leave [0, t_end]."""
    wanted = np.asarray(times, dtype=float)
    if wanted.ndim != 1 or not len(wanted) or np.any(np.diff(wanted) <= 0.0):
        raise ValueError("times must be a rising one-dimensional array")
    if wanted[0] < 0.0 or wanted[-1] > t_end:
        raise ValueError(f"times span {wanted[0]} to {wanted[-1]} s, outside 0 to t_end = {t_end} s")
    return wanted


def advance(
    system: System,
    layout: Layout,
    interval: tuple[float, float],
    y: Array,
    step: float,
    settings: dict[str, Any],
) -> Any:
    """Integrate one interval with dense output; curves are read from its own side of its end."""
    from scipy.integrate import solve_ivp

    length = interval[1] - interval[0]
    last = np.nextafter(interval[1], -math.inf)
    solution = solve_ivp(
        lambda t, state: derivative(system, layout, min(t, last), state),
        interval,
        y,
        dense_output=True,
        first_step=min(step, length) if math.isfinite(step) else None,
        **settings,
    )
    if not solution.success:
        raise RuntimeError(f"integration stopped at t = {solution.t[-1]} s: {solution.message}")
    return solution


def interval_ends(t_end: float, interval: float, breaks: list[float]) -> list[float]:
    """End times of the intervals: multiples of the interval, curve breaks, and t_end."""
    count = max(1, math.ceil(t_end / interval - 1e-9))
    ends = {k * interval for k in range(1, count)} | {t_end} | {b for b in breaks if 0.0 < b < t_end}
    return sorted(ends)


def derivative(system: System, layout: Layout, t: float, y: Array) -> Array:
    """Right-hand side of the first-order system; R' = S(omega) R."""
    motion, memory, _ = layout.unpack(y)
    e = system.evaluate(t, motion, memory)
    a = e.acceleration.reshape(-1, 6)
    spin = skew(motion.w[:-1]) @ motion.rotation[:-1]
    parts = (motion.v[:-1], spin, a[:, :3], a[:, 3:], e.memory_rate, [e.power, abs(e.power)])
    return np.concatenate([np.ravel(part) for part in parts])


class Recorder:
    """Projects a copy of each output state and evaluates reactions and energies there."""

    def __init__(self, system: System, layout: Layout, start_energy: float) -> None:
        self.system, self.layout, self.start_energy = system, layout, start_energy
        self.rows: list[dict[str, Any]] = []
        self.rotations: list[Array] = []

    def record(self, t: float, y: Array) -> None:
        system = self.system
        raw, memory, work = self.layout.unpack(y)
        motion = system.project(t, raw, memory)
        unprojected = system.rows.evaluate(t, system.vectors.evaluate(raw))
        e = system.evaluate(t, motion, memory)
        force, moment = system.reactions(e)
        self.rotations.append(motion.rotation[:-1])
        row: dict[str, Any] = {
            "time": t,
            "position": motion.r[:-1],
            "velocity": motion.v[:-1],
            "angular_velocity": motion.w[:-1],
            "acceleration": e.acceleration.reshape(-1, 6),
            "reaction_force": force,
            "reaction_moment": moment,
            "multipliers": e.multipliers,
            "driver_load": system.driver_loads(e),
            "actuator_load": e.actuator_loads,
            "coordinate": e.coordinates,
            "coordinate_rate": e.coordinate_rates,
            "constraint_error": largest(e.rows.residual),
            "constraint_rate_error": largest(e.rows.rate),
            "constraint_error_before_projection": largest(unprojected.residual),
            "energy": e.energy,
            "energy_balance": e.energy - self.start_energy - work[0],
            "absolute_work": work[1],
        }
        self.rows.append(row | self._vessel(e, memory))

    def _vessel(self, e: Evaluation, memory: Array) -> dict[str, Any]:
        if self.system.vessel is None or e.vessel is None:
            return {}
        return {
            "vessel_motion": self.system.vessel.displacement(e.vectors),
            "wave_force": e.vessel.wave,
            "memory_force": e.vessel.memory_force,
            "memory_state": memory.copy(),
        }

    def result(self) -> dict[str, Any]:
        out: dict[str, Any] = {key: np.array([row[key] for row in self.rows]) for key in self.rows[0]}
        out["quaternion"] = quaternions_from_matrices(np.array(self.rotations))
        if "vessel_motion" in out:
            out["vessel_motion"][:, 3:] = np.unwrap(out["vessel_motion"][:, 3:], axis=0)
        angles = self.system.coordinates.is_angle
        out["coordinate"][:, angles] = np.unwrap(out["coordinate"][:, angles], axis=0)
        out["names"] = {
            "body": self.system.body_names,
            "joint": self.system.joint_names,
            "coordinate": self.system.coordinates.names,
            "actuator": self.system.actuators.names,
            "driver": self.system.driver_names,
        }
        return out


def largest(values: Array) -> float:
    """Largest absolute value, zero for none."""
    return float(np.max(np.abs(values))) if len(values) else 0.0
