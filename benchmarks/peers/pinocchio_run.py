"""Pinocchio on the tree of `system.write_tree`; run by the peers' Python, prints what the C++ drivers print.

    pinocchio_run.py TREE METHOD(RK4|RK45|DOP853) SETTING(step s, or tolerance) BAUMGARTE(1/s)

The loop over time is Python and SciPy, the accelerations are the library's C++. What is timed is therefore
`constraintDynamics` alone, at states of the run, times its number: no loads, no integrator, no loop. An empty
turn of the timing loop is taken off; the bindings' conversion of arguments stays in.
"""

from __future__ import annotations

import math
import sys
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

Array = NDArray[np.float64]
N = 20
SLEW, MAIN, KNUCKLE = 6, 9, 13
T_END = 100


def read_tree(path: Path) -> dict[str, Array]:
    """Arrays by name."""
    lines = (line.split("\t") for line in path.read_text(encoding="utf-8").splitlines())
    return {key: np.array([float(x) for x in values.split()[1:]]) for key, values in lines}


class Loads:
    """Generalised loads of water, waves, moorings and controllers in the tree's coordinates."""

    def __init__(self, d: dict[str, Array]) -> None:
        self.d = d
        self.damping, self.restoring = (d[key].reshape(6, 6) for key in ("damping", "restoring"))
        self.waves = (d["wave force_real"] + 1j * d["wave force_imag"]).reshape(-1, 6)
        # Restoring holds the hull's weight: it is taken back, together with the lift, at the common point.
        weight, lift = d["body vessel"][0] * d["gravity"][0], d["lift"][0]
        self.lift = lift + weight
        self.point = (lift * d["lift"][1:] + weight * d["body vessel"][1:4]) / self.lift
        self.actuators = {
            SLEW: d["actuator A"],
            MAIN: d["actuator main_cylinder"],
            KNUCKLE: d["actuator knuckle_cylinder"],
        }

    def __call__(self, t: float, q: Array, v: Array) -> Array:
        load = np.zeros(N)
        (yaw, pitch, roll), d = q[3:6], self.d
        cy, sy, cp, sp = math.cos(yaw), math.sin(yaw), math.cos(pitch), math.sin(pitch)
        cr, sr = math.cos(roll), math.sin(roll)
        # twist u and wrench w about the reference point in the frame that follows yaw
        u = np.array([cy * v[0] + sy * v[1], cy * v[1] - sy * v[0], v[2], cp * v[5], v[4], v[3] - sp * v[5]])
        w = (np.exp(1j * t * d["wave omega"]) @ self.waves).real - self.damping @ u
        x, y, z = self.point
        across, up = cr * y - sr * z, sr * y + cr * z
        w[2:5] += self.lift * np.array([1.0, across, -(cp * x + sp * up)])
        r = self.restoring[2:5, 2:5] @ np.array([q[2], roll, pitch])
        load[:2] = cy * w[0] - sy * w[1], sy * w[0] + cy * w[1]
        load[2:6] = w[2] - r[0], w[5], w[4] - r[2], cp * w[3] - sp * w[5] - r[1]
        moored = [0, 1, 3]
        load[moored] -= d["mooring stiffness"] * q[moored] + d["mooring damping"] * v[moored]
        for place, (stiffness, damping, feed_forward, t0, t1, low, high) in self.actuators.items():
            s = min(max((t - t0) / (t1 - t0), 0.0), 1.0)
            value = low + (high - low) * s**3 * (10.0 - 15.0 * s + 6.0 * s * s)
            rate = (high - low) * 30.0 * (s * (1.0 - s)) ** 2 / (t1 - t0)
            load[place] = feed_forward + stiffness * (value - q[place]) + damping * (rate - v[place])
        return load


class Crane:
    """The tree, its frames parallel to the inertial one at the start, and its two loops."""

    def __init__(self, d: dict[str, Array], baumgarte: float) -> None:
        self.d, self.model = d, pin.Model()
        self.model.gravity.linear = np.array([0.0, 0.0, -d["gravity"][0]])
        self.origins = {0: np.zeros(3)}
        hull = self.add(self.add(0, pin.JointModelTranslation(), np.zeros(3)), pin.JointModelSphericalZYX())
        self.bodies(hull, "vessel", "tower")
        king = self.add(hull, pin.JointModelRZ(), d["point A"], "king")
        main_rod = self.cylinder(king, "B", "main")
        main_jib = self.add(king, pin.JointModelRY(), d["point C"], "main_jib")
        knuckle_rod = self.cylinder(main_jib, "E", "knuckle")
        knuckle_jib = self.add(main_jib, pin.JointModelRY(), d["point F"], "knuckle_jib")
        swing = self.add(knuckle_jib, pin.JointModelRX(), d["point link"])
        swing = self.add(swing, pin.JointModelRY(), d["point link"])
        self.payload = self.add(swing, pin.JointModelSphericalZYX(), d["second_point link"], "payload")
        self.payload_centre = d["body payload"][1:4] - d["second_point link"]
        self.loops = pin.StdVec_RigidConstraintModel()
        for rod, jib, at in ((main_rod, main_jib, "D"), (knuckle_rod, knuckle_jib, "G")):
            self.close(rod, jib, d[f"point {at}"], baumgarte)

    def add(self, parent: int, joint: pin.JointModel, at: Array | None = None, *bodies: str) -> int:
        at = self.origins[parent] if at is None else at
        place = pin.SE3(np.eye(3), at - self.origins[parent])
        new = self.model.addJoint(parent, joint, place, f"joint{len(self.origins)}")
        self.origins[new] = at
        self.bodies(new, *bodies)
        return new

    def bodies(self, joint: int, *names: str) -> None:
        for name in names:
            b = self.d[f"body {name}"]
            inertia = pin.Inertia(b[0], b[1:4] - self.origins[joint], b[4:].reshape(3, 3))
            self.model.appendBodyToJoint(joint, inertia, pin.SE3.Identity())

    def cylinder(self, carrier: int, foot: str, name: str) -> int:
        at, along = self.d[f"point {foot}"], self.d[f"axis {name}_cylinder"]
        pivot = self.add(carrier, pin.JointModelRY(), at)
        across = pin.JointModelRevoluteUnaligned(self.d[f"second_axis {foot}"])
        barrel = self.add(pivot, across, at, f"{name}_barrel")
        return self.add(barrel, pin.JointModelPrismaticUnaligned(along), at, f"{name}_rod")

    def close(self, rod: int, jib: int, point: Array, baumgarte: float) -> None:
        ends = [pin.SE3(np.eye(3), point - self.origins[joint]) for joint in (rod, jib)]
        loop = pin.RigidConstraintModel(
            pin.ContactType.CONTACT_3D, self.model, rod, ends[0], jib, ends[1], pin.ReferenceFrame.LOCAL
        )
        corrector = loop.m_baumgarte_parameters
        corrector.Kp, corrector.Kd = baumgarte**2, 2.0 * baumgarte
        self.loops.append(loop)


class Dynamics:
    """Right-hand side of coordinates and rates; keeps some of its states to time the accelerations."""

    def __init__(self, d: dict[str, Array], baumgarte: float) -> None:
        self.crane, self.loads = Crane(d, baumgarte), Loads(d)
        self.data = self.crane.model.createData()
        self.loop_data = pin.StdVec_RigidConstraintData()
        for loop in self.crane.loops:
            self.loop_data.append(loop.createData())
        pin.initConstraintDynamics(self.crane.model, self.data, self.crane.loops, self.loop_data)
        self.settings = pin.ProximalSettings(1e-12, 0.0, 1)
        self.evaluations = 0
        self.kept: list[tuple[Array, Array, Array]] = []

    def acceleration(self, q: Array, v: Array, load: Array) -> Array:
        """Of the library."""
        model, data, loops = self.crane.model, self.data, self.crane.loops
        return pin.constraintDynamics(model, data, q, v, load, loops, self.loop_data, self.settings)

    def __call__(self, t: float, y: Array) -> Array:
        q, v = y[:N].copy(), y[N:].copy()
        load = self.loads(t, q, v)
        if self.evaluations % 10 == 0:
            self.kept.append((q, v, load))
        self.evaluations += 1
        return np.concatenate([v, self.acceleration(q, v, load)])

    def output(self, y: Array) -> Array:
        """Payload position (3) and roll."""
        pin.forwardKinematics(self.crane.model, self.data, y[:N].copy())
        return np.append(self.data.oMi[self.crane.payload].act(self.crane.payload_centre), y[5])

    def seconds(self) -> float:
        """CPU time of one `constraintDynamics` called from Python, less an empty turn; best of 5."""
        times = []
        for _ in range(5):
            start = time.thread_time()
            for q, v, load in self.kept:
                self.acceleration(q, v, load)
            middle = time.thread_time()
            for q, v, load in self.kept:
                _ = q, v, load
            times.append((2.0 * middle - start - time.thread_time()) / len(self.kept))
        return min(times)


def rk4(rate: Callable[[float, Array], Array], y: Array, t: float, step: float) -> Array:
    """One second of classical RK4."""
    count = round(1.0 / step)
    h = 1.0 / count
    for i in range(count):
        s = t + i * h
        k1 = rate(s, y)
        k2 = rate(s + 0.5 * h, y + 0.5 * h * k1)
        k3 = rate(s + 0.5 * h, y + 0.5 * h * k2)
        y = y + h / 6.0 * (k1 + 2.0 * (k2 + k3) + rate(s + h, y + h * k3))
    return y


def march(dynamics: Dynamics, method: str, setting: float) -> Array:
    """Outputs (seconds + 1, 4)."""
    y = np.zeros(2 * N)
    if method == "RK4":
        rows = [dynamics.output(y)]
        for second in range(T_END):
            y = rk4(dynamics, y, float(second), setting)
            rows.append(dynamics.output(y))
        return np.array(rows)
    scale = np.full(N, 0.01)  # error scales as in seacrane: 0.1 m, 0.01 rad, and the same per second
    scale[[0, 1, 2, MAIN, KNUCKLE]] = 0.1
    run = solve_ivp(
        dynamics, (0.0, T_END), y, method=method, rtol=1e-13, atol=setting * np.tile(scale, 2),
        t_eval=np.arange(T_END + 1.0),
    )  # fmt: skip
    if not run.success:
        raise RuntimeError(run.message)
    return np.array([dynamics.output(state) for state in run.y.T])


def main() -> int:
    """Run and print."""
    tree, method, setting, baumgarte = sys.argv[1:]
    dynamics = Dynamics(read_tree(Path(tree)), float(baumgarte))
    rows = march(dynamics, method, float(setting))
    evaluations = dynamics.evaluations
    print(f"{dynamics.seconds() * evaluations:.9g} {evaluations}")
    for row in rows:
        print(" ".join(f"{value:.17g}" for value in row))
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
