"""Integration in time: SciPy's `solve_ivp` on the index-1 form, projected in intervals and at outputs."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from scipy.integrate import solve_ivp

from .kinematics import Motion
from .rotation import Array, quaternions_from_matrices, skew
from .system import System


def pack(motion: Motion, memory: Array) -> Array:
    """r, R, v, w of all bodies, memory states."""
    parts = (motion.r[:-1], motion.rotation[:-1], motion.v[:-1], motion.w[:-1], memory)
    return np.concatenate([np.ravel(part) for part in parts])


def unpack(system: System, y: Array) -> tuple[Motion, Array]:
    n = len(system.mass)
    r, v, w = np.zeros((3, n + 1, 3))
    rotation = np.broadcast_to(np.eye(3), (n + 1, 3, 3)).copy()
    r[:n] = y[: 3 * n].reshape(n, 3)
    rotation[:n] = y[3 * n : 12 * n].reshape(n, 3, 3)
    v[:n] = y[12 * n : 15 * n].reshape(n, 3)
    w[:n] = y[15 * n : 18 * n].reshape(n, 3)
    return Motion(r, rotation, v, w), y[18 * n :]


def derivative(system: System, t: float, y: Array) -> Array:
    """Right-hand side of the first-order system; R' = S(omega) R."""
    motion, memory = unpack(system, y)
    e = system.evaluate(t, motion, memory)
    a = e.acceleration.reshape(-1, 6)
    spin = skew(motion.w[:-1]) @ motion.rotation[:-1]
    parts = (motion.v[:-1], spin, a[:, :3], a[:, 3:], e.vessel.memory_rate)
    return np.concatenate([np.ravel(part) for part in parts])


def simulate(
    system: System, t_end: float, times: ArrayLike, rtol: float = 1e-10, *, method: str = "DOP853",
    projection_interval: float = 1.0,
) -> dict[str, Any]:  # fmt: skip
    """Integrate from t = 0: what `recorded` gives at the rising times asked for, `names` and `stats`.

    The absolute tolerance is rtol / 100. The state is projected and the integrator restarted at multiples of
    `projection_interval` and at the breaks of curves.
    """
    wanted = np.asarray(times, dtype=float)
    memory = np.zeros(system.memory_states)
    y = pack(system.project(0.0, system.start, memory), memory)
    rows = [recorded(system, 0.0, y)] if wanted[0] == 0.0 else []
    evaluations, step, begin = 0, math.inf, 0.0
    multiples = {k * projection_interval for k in range(1, math.ceil(t_end / projection_interval - 1e-9))}
    for end in sorted(multiples | {t_end} | {b for b in system.breaks if 0.0 < b < t_end}):
        last = np.nextafter(end, -math.inf)  # curves are read from this side of the interval's end
        solution = solve_ivp(
            lambda t, state, last=last: derivative(system, min(t, last), state), (begin, end), y,
            method=method, rtol=rtol, atol=0.01 * rtol, dense_output=True,
            first_step=min(step, end - begin) if math.isfinite(step) else None,
        )  # fmt: skip
        if not solution.success:
            raise RuntimeError(f"integration stopped at t = {solution.t[-1]} s: {solution.message}")
        evaluations += solution.nfev
        if len(solution.t) > 2:
            step = float(np.max(np.diff(solution.t)))
        for t in wanted[(wanted > begin) & (wanted <= end)]:
            rows.append(recorded(system, float(t), solution.y[:, -1] if t == end else solution.sol(t)))
        motion, memory = unpack(system, solution.y[:, -1])
        y, begin = pack(system.project(end, motion, memory), memory), end
    out: dict[str, Any] = {key: np.array([row[key] for row in rows]) for key in rows[0]}
    out["vessel_motion"][:, 3:] = np.unwrap(out["vessel_motion"][:, 3:], axis=0)
    out["names"] = {"body": system.body_names, "joint": system.joint_names}
    out["stats"] = {"evaluations": evaluations}
    return out


def recorded(system: System, t: float, y: Array) -> dict[str, Any]:
    """A projected copy of an output state, and the loads there."""
    raw, memory = unpack(system, y)
    motion = system.project(t, raw, memory)
    e = system.evaluate(t, motion, memory)
    force, moment = system.reactions(e)
    return {
        "time": t, "position": motion.r[:-1], "velocity": motion.v[:-1], "angular_velocity": motion.w[:-1],
        "quaternion": quaternions_from_matrices(motion.rotation[:-1]), "reaction_force": force,
        "reaction_moment": moment, "actuator_load": e.actuator_loads, "wave_force": e.vessel.wave,
        "vessel_motion": system.vessel.displacement(e.vectors), "memory_force": e.vessel.memory_force,
    }  # fmt: skip
