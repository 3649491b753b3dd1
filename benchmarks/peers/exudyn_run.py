"""Exudyn: redundant rigid bodies and joints, its own integrators; run by the peers' Python.

``exudyn_run.py TREE METHOD STEP(s) NEWTON REPEATS``, NEWTON the relative tolerance of its iterations. Prints
like the C++ drivers: CPU time and Newton iterations, then the payload's position and the roll every second.

Exudyn's axes are (z, -y, x) of the tree's, so that its angles x, y, z of the hull are yaw, -pitch, roll.
Waves, restoring, damping and controllers are symbolic user functions: Exudyn evaluates them in C++.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

sys.exudynFast = True  # the module without range checks

import exudyn as exu  # noqa: E402
import exudyn.itemInterface as items  # noqa: E402
from exudyn.advancedUtilities import CreateSymbolicUserFunction  # noqa: E402

sym = exu.symbolic
T_END = 100  # s
TURN = np.array([[0.0, 0.0, 1.0], [0.0, -1.0, 0.0], [1.0, 0.0, 0.0]])
HULL = ("vessel", "tower")
BODIES = (
    "king",
    "main_barrel",
    "main_rod",
    "main_jib",
    "knuckle_barrel",
    "knuckle_rod",
    "knuckle_jib",
    "payload",
)


def read_tree(path: Path) -> dict[str, np.ndarray]:
    """Arrays by name as `system.write_tree` writes them."""
    lines = (line.split("\t") for line in path.read_text(encoding="utf-8").splitlines())
    return {key: np.array([float(word) for word in values.split()[1:]]) for key, values in lines}


class Crane:
    """The system, its sensors and its solver settings."""

    def __init__(self, data: dict[str, np.ndarray]) -> None:
        self.data = data
        self.container = exu.SystemContainer()
        self.mbs = self.container.AddSystem()
        self.kept: list[Any] = []  # expression trees must outlive the run
        self.origins: dict[str, np.ndarray] = {}
        self.bodies: dict[str, Any] = {}
        self.nodes: dict[str, Any] = {}
        self._body("vessel", HULL, np.zeros(3))
        for name in BODIES:
            self._body(name, (name,), data[f"body {name}"][1:4])
        self._hinge("A", "vessel", "king")
        self._cylinder("main", "king", "main_jib", "B", "D")
        self._hinge("C", "king", "main_jib")
        self._cylinder("knuckle", "main_jib", "knuckle_jib", "E", "G")
        self._hinge("F", "main_jib", "knuckle_jib")
        ends = [data["point link"], data["second_point link"]]
        markers = [self._marker("knuckle_jib", ends[0]), self._marker("payload", ends[1])]
        length = float(np.linalg.norm(ends[0] - ends[1]))
        self.mbs.AddObject(items.ObjectConnectorDistance(markerNumbers=markers, distance=length))
        self._water()
        self.payload = self.mbs.AddSensor(
            items.SensorBody(
                bodyNumber=self.bodies["payload"], storeInternal=True, writeToFile=False,
                outputVariableType=exu.OutputVariableType.Position,
            )
        )  # fmt: skip
        self.hull = self.mbs.AddSensor(
            items.SensorNode(
                nodeNumber=self.nodes["vessel"], storeInternal=True, writeToFile=False,
                outputVariableType=exu.OutputVariableType.Coordinates,
            )
        )  # fmt: skip
        self.mbs.Assemble()

    def _body(self, name: str, parts: tuple[str, ...], origin: np.ndarray) -> None:
        """Rigid body of the named masses joined; Euler parameters, the hull with Tait-Bryan angles."""
        mass, moment, inertia = 0.0, np.zeros(3), np.zeros((3, 3))
        for part in parts:
            record = self.data[f"body {part}"]
            arm = TURN @ (record[1:4] - origin)
            mass += record[0]
            moment += record[0] * arm
            inertia += TURN @ record[4:].reshape(3, 3) @ TURN.T
            inertia += record[0] * (arm @ arm * np.eye(3) - np.outer(arm, arm))
        self.origins[name] = origin
        place = TURN @ origin
        if name == "vessel":
            node = items.NodeRigidBodyRxyz(referenceCoordinates=[*place, 0.0, 0.0, 0.0])
        else:
            node = items.NodeRigidBodyEP(referenceCoordinates=[*place, 1.0, 0.0, 0.0, 0.0])
        self.nodes[name] = self.mbs.AddNode(node)
        self.bodies[name] = self.mbs.AddObject(
            items.ObjectRigidBody(
                mass=mass, centerOfMass=list(moment / mass), nodeNumber=self.nodes[name],
                inertia=list(inertia[[0, 1, 2, 1, 0, 0], [0, 1, 2, 2, 2, 1]]),
            )
        )  # fmt: skip
        marker = self.mbs.AddMarker(items.MarkerBodyMass(bodyNumber=self.bodies[name]))
        weight = list(TURN @ [0.0, 0.0, -self.data["gravity"][0]])
        self.mbs.AddLoad(items.LoadMassProportional(markerNumber=marker, loadVector=weight))

    def _marker(self, body: str, point: np.ndarray, frame: np.ndarray | None = None) -> Any:
        place = exu.HT(
            rotation=np.eye(3) if frame is None else frame, translation=TURN @ (point - self.origins[body])
        )
        return self.mbs.AddMarker(items.MarkerBodyRigid(bodyNumber=self.bodies[body], localHT=place))

    def _symbolic(self, function: Callable[..., Any], name: str, kind: str) -> Any:
        self.kept.append(CreateSymbolicUserFunction(self.mbs, function, name, itemTypeName=kind))
        return self.kept[-1]

    def _controller(self, joint: str) -> Callable[..., Any]:
        """What the actuator resists with, over displacement and rate (Exudyn's sign)."""
        stiffness, damping, forward, t0, t1, low, high = map(float, self.data[f"actuator {joint}"])

        def force(mbs, t, itemNumber, u, v, k, d, f):
            s = sym.min(sym.max((t - t0) * (1.0 / (t1 - t0)), sym.Real(0.0)), sym.Real(1.0))
            value = low + (high - low) * (s * s * s * (10.0 - 15.0 * s + 6.0 * s * s))
            rate = (high - low) * 30.0 / (t1 - t0) * (s * s * (1.0 - s) * (1.0 - s))
            return stiffness * (u - value) + damping * (v - rate) - forward

        return force

    def _hinge(self, name: str, first: str, second: str) -> None:
        """Revolute joint; with a controller when the data have one."""
        point, axis = self.data[f"point {name}"], TURN @ self.data[f"axis {name}"]
        frame = _frame(axis, last=True)
        markers = [self._marker(body, point, frame) for body in (first, second)]
        self.mbs.AddObject(items.ObjectJointRevoluteZ(markerNumbers=markers))
        if f"actuator {name}" in self.data:
            kind = "ObjectConnectorTorsionalSpringDamper"
            torque = self._symbolic(self._controller(name), "springTorqueUserFunction", kind)
            self.mbs.AddObject(
                items.ObjectConnectorTorsionalSpringDamper(
                    markerNumbers=markers, springTorqueUserFunction=torque
                )
            )

    def _cylinder(self, name: str, carrier: str, jib: str, foot: str, head: str) -> None:
        """Universal joint, prismatic joint, spherical joint; the force acts between the ends."""
        a, b = self.data[f"point {foot}"], self.data[f"point {head}"]
        barrel, rod = f"{name}_barrel", f"{name}_rod"
        first, second = TURN @ self.data[f"axis {foot}"], TURN @ self.data[f"second_axis {foot}"]
        cross = np.column_stack([np.cross(first, second), first, second])
        ends = [self._marker(body, a, cross) for body in (carrier, barrel)]
        self.mbs.AddObject(items.ObjectJointGeneric(markerNumbers=ends, constrainedAxes=[1, 1, 1, 1, 0, 0]))
        axis = self.data[f"axis {name}_cylinder"]
        length = float(np.linalg.norm(b - a))
        if not np.allclose(b - a, length * axis, atol=1e-9):
            raise ValueError(f"{name}: the cylinder's axis does not join its ends")
        slide = _frame(TURN @ axis, last=False)
        ends = [self._marker(body, a, slide) for body in (barrel, rod)]
        self.mbs.AddObject(items.ObjectJointPrismaticX(markerNumbers=ends))
        ends = [self._marker(rod, b), self._marker(jib, b)]
        self.mbs.AddObject(items.ObjectJointSpherical(markerNumbers=ends))
        kind = "ObjectConnectorSpringDamper"
        force = self._symbolic(self._controller(f"{name}_cylinder"), "springForceUserFunction", kind)
        self.mbs.AddObject(
            items.ObjectConnectorSpringDamper(
                markerNumbers=[self._marker(carrier, a), ends[1]], referenceLength=length,
                springForceUserFunction=force,
            )
        )  # fmt: skip

    def _water(self) -> None:
        """Waves, restoring, damping, mooring and lift in the hull's coordinates, as `loads.hpp` has them."""
        d = self.data
        damping, restoring = d["damping"].reshape(6, 6), d["restoring"].reshape(6, 6)
        spring, damper = d["mooring stiffness"], d["mooring damping"]
        weight = d["body vessel"][0] * d["gravity"][0]
        lift = float(d["lift"][0] + weight)
        px, py, pz = map(float, (d["lift"][0] * d["lift"][1:] + weight * d["body vessel"][1:4]) / lift)
        omega = d["wave omega"]
        force = (d["wave force_real"] + 1j * d["wave force_imag"]).reshape(-1, 6)

        def wave(t, i):
            # Re(F exp(i w t)) as one cosine each
            return sum(
                float(abs(f)) * sym.cos(float(w) * t + float(np.angle(f)))
                for w, f in zip(omega, force[:, i], strict=True)
            )

        def linear(row, values):
            terms = [float(c) * value for c, value in zip(row, values, strict=True) if c]
            return sum(terms[1:], terms[0]) if terms else 0.0

        def loads(mbs, t, itemNumber, q, q_t):
            heave, sway, surge, yaw, pitch, roll = q[0], -1.0 * q[1], q[2], q[3], -1.0 * q[4], q[5]
            cy, sy, cp, sp = sym.cos(yaw), sym.sin(yaw), sym.cos(pitch), sym.sin(pitch)
            cr, sr = sym.cos(roll), sym.sin(roll)
            v, turn = [q_t[2], -1.0 * q_t[1], q_t[0]], [q_t[5], -1.0 * q_t[4], q_t[3]]
            u = [
                cy * v[0] + sy * v[1],
                cy * v[1] - sy * v[0],
                v[2],
                cp * turn[0],
                turn[1],
                turn[2] - sp * turn[0],
            ]
            w = [wave(t, i) - linear(damping[i], u) for i in range(6)]
            arm, up = cr * py - sr * pz, sr * py + cr * pz
            w[2] = w[2] + lift
            w[3] = w[3] + arm * lift
            w[4] = w[4] - (cp * px + sp * up) * lift
            r = [linear(restoring[i, 2:5], [heave, roll, pitch]) for i in (2, 3, 4)]
            mooring = [
                float(spring[i]) * place + float(damper[i]) * rate
                for i, (place, rate) in enumerate(((surge, v[0]), (sway, v[1]), (yaw, turn[2])))
            ]
            return [
                w[2] - r[0],
                mooring[1] - (sy * w[0] + cy * w[1]),
                cy * w[0] - sy * w[1] - mooring[0],
                w[5] - mooring[2],
                r[2] - w[4],
                cp * w[3] - sp * w[5] - r[1],
            ]

        self.mbs.AddObject(
            items.ObjectGenericODE2(
                nodeNumbers=[self.nodes["vessel"]], massMatrix=np.zeros((6, 6)),
                forceUserFunction=self._symbolic(loads, "forceUserFunction", "ObjectGenericODE2"),
            )
        )  # fmt: skip


def _frame(axis: np.ndarray, *, last: bool) -> np.ndarray:
    """Rotation whose last (or first) axis is the given one."""
    other = np.eye(3)[int(np.argmin(np.abs(axis)))]
    side = np.cross(axis, other)
    side /= np.linalg.norm(side)
    if last:
        return np.column_stack([side, np.cross(axis, side), axis])
    return np.column_stack([axis, side, np.cross(axis, side)])


def settings(method: str, step: float, tolerance: float) -> tuple[Any, Any]:
    """Exudyn's settings and its solver."""
    s = exu.SimulationSettings()
    integration = s.timeIntegration
    integration.endTime = T_END
    integration.numberOfSteps = T_END * round(1.0 / step)
    integration.verboseMode = 0
    integration.adaptiveStep = False
    integration.newton.useModifiedNewton = True
    integration.newton.relativeTolerance = tolerance
    s.solution.file.write = False
    s.solution.sensors.writePeriod = 1.0
    s.parallel.numberOfThreads = 1
    s.linearSolver.solverType = exu.LinearSolverType.EigenSparse
    if method == "trapezoidal":
        return s, exu.DynamicSolverType.TrapezoidalIndex2
    name, radius = method.split()
    if name != "generalized-alpha":
        raise ValueError(f"unknown method {method}")
    integration.generalizedAlpha.spectralRadius = float(radius)
    return s, exu.DynamicSolverType.GeneralizedAlpha


def main() -> None:
    """Run and print."""
    path, method, step, tolerance, repeats = sys.argv[1:]
    crane = Crane(read_tree(Path(path)))
    options, solver = settings(method, float(step), float(tolerance))
    best = np.inf
    for _ in range(int(repeats)):
        start = time.process_time()
        try:
            crane.mbs.SolveDynamic(options, solverType=solver, storeSolver=True)
        except (RuntimeError, ValueError) as error:
            print(error, file=sys.stderr)
        best = min(best, time.process_time() - start)
    counters = crane.mbs.sys["dynamicSolver"].it
    print(f"\n{best:.9g} {counters.newtonStepsCount} {T_END * round(1.0 / float(step))} 0")
    payload = crane.mbs.GetSensorStoredData(crane.payload)[:, 1:] @ TURN
    roll = crane.mbs.GetSensorStoredData(crane.hull)[:, 6]
    rows = np.full((T_END + 1, 4), np.nan)  # of a run that breaks off, what is missing stays so
    rows[: len(roll)] = np.column_stack([payload, roll])
    for row in rows:
        print(" ".join(f"{value:.17g}" for value in row))


if __name__ == "__main__":
    main()
