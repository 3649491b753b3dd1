"""Rows of four-bars in Exudyn and MuJoCo; run by the peers' Python.

``four_bars_run.py ENGINE LOOPS STEP(s) NEWTON``: rods of 1 m and 1 kg upright at the start, 1 m/s at their
tops (IFToMM benchmark A02). Prints the seconds of building the model, of one evaluation and of the run of
1 s, then the place (x, z) of the first rod's top at its end.
"""

from __future__ import annotations

import sys
import time

import numpy as np

T_END, GRAVITY, SPEED = 1.0, 9.81, 1.0
INERTIA = [1e-6, 1.0 / 12.0, 1.0 / 12.0]  # kg m2, of a rod along x
EVALUATIONS = 200


def mujoco_run(loops: int, step: float) -> tuple[float, float, float, float, float]:
    """Posts on hinges, couplers on hinges at their tops, closed by `connect` to the next post's top."""
    import mujoco

    def rod(name: str, at: str, inner: str, euler: str) -> str:
        inertial = f'<inertial pos="0.5 0 0" mass="1" diaginertia="{" ".join(map(repr, INERTIA))}"/>'
        hinge = f'<joint name="{name}" type="hinge" axis="0 1 0"/>'
        return f'<body name="{name}" pos="{at}" euler="{euler}">{hinge}{inertial}{inner}</body>'

    posts = []
    for i in range(loops + 1):
        coupler = rod(f"coupler{i}", "1 0 0", "", "0 90 0") if i < loops else ""
        posts.append(rod(f"post{i}", f"{i} 0 0", coupler, "0 -90 0"))
    ends = "".join(
        f'<connect body1="coupler{i}" body2="post{i + 1}" anchor="1 0 0" solref="{2 * step!r} 1" '
        'solimp="0.9999 0.9999 0.001"/>'
        for i in range(loops)
    )
    text = (
        f'<mujoco><compiler angle="degree"/><option timestep="{step!r}" gravity="0 0 -{GRAVITY}" '
        'integrator="RK4" tolerance="1e-12"/>'
        f"<worldbody>{''.join(posts)}</worldbody><equality>{ends}</equality></mujoco>"
    )
    begun = time.process_time()
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    built = time.process_time() - begun
    for i in range(loops + 1):
        data.joint(f"post{i}").qvel[0] = SPEED
        if i < loops:
            data.joint(f"coupler{i}").qvel[0] = -SPEED
    begun = time.process_time()
    for _ in range(EVALUATIONS):
        mujoco.mj_forward(model, data)
    evaluation = (time.process_time() - begun) / EVALUATIONS
    begun = time.process_time()
    mujoco.mj_step(model, data, nstep=round(T_END / step))
    spent = time.process_time() - begun
    angle = float(data.joint("post0").qpos[0])
    return built, evaluation, spent, float(np.sin(angle)), float(np.cos(angle))


def exudyn_run(loops: int, step: float, newton: float) -> tuple[float, float, float, float, float]:
    """Rigid bodies with Euler parameters; joints that hold each motion once, trapezoidal rule on index 2."""
    sys.exudynFast = True  # type: ignore[attr-defined]
    import exudyn as exu
    import exudyn.itemInterface as items

    begun = time.process_time()
    container = exu.SystemContainer()
    mbs = container.AddSystem()
    ground = mbs.AddObject(items.ObjectGround())
    turn = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])  # its z along the hinges

    def body(place: list[float], angle: float, rate: float, velocity: list[float]) -> tuple[int, np.ndarray]:
        along = np.array([np.cos(angle), 0.0, np.sin(angle)])
        half = -0.5 * angle
        node = mbs.AddNode(
            items.NodeRigidBodyEP(
                referenceCoordinates=[*(np.array(place) + 0.5 * along), np.cos(half), 0.0, np.sin(half), 0.0],
                initialVelocities=[
                    *velocity, 0.5 * -np.sin(half) * rate, 0.0, 0.5 * np.cos(half) * rate, 0.0,
                ],
            )
        )  # fmt: skip
        made = mbs.AddObject(
            items.ObjectRigidBody(mass=1.0, inertia=[*INERTIA, 0.0, 0.0, 0.0], nodeNumber=node)
        )
        mark = mbs.AddMarker(items.MarkerBodyMass(bodyNumber=made))
        mbs.AddLoad(items.LoadMassProportional(markerNumber=mark, loadVector=[0.0, 0.0, -GRAVITY]))
        return made, along

    def marker(on: int, point: list[float], along: np.ndarray | None = None) -> int:
        frame = turn if along is None else np.array([along, [0, 1, 0], np.cross(along, [0, 1, 0])]) @ turn
        return mbs.AddMarker(
            items.MarkerBodyRigid(bodyNumber=on, localHT=exu.HT(rotation=frame, translation=point))
        )

    def pin(first: int, second: int, axes: list[int]) -> None:
        mbs.AddObject(items.ObjectJointGeneric(markerNumbers=[first, second], constrainedAxes=axes))

    revolute, cylindrical, spherical = [1, 1, 1, 1, 1, 0], [1, 1, 0, 1, 1, 0], [1, 1, 1, 0, 0, 0]
    posts = [body([i, 0.0, 0.0], 0.5 * np.pi, SPEED, [0.5 * SPEED, 0.0, 0.0]) for i in range(loops + 1)]
    couplers = [body([i, 0.0, 1.0], 0.0, 0.0, [SPEED, 0.0, 0.0]) for i in range(loops)]
    foot, head = [-0.5, 0.0, 0.0], [0.5, 0.0, 0.0]
    for i, (post, up) in enumerate(posts):
        pin(marker(ground, [i, 0.0, 0.0]), marker(post, foot, up), cylindrical if i else revolute)
        if i < loops:
            pin(marker(post, head, up), marker(couplers[i][0], foot, couplers[i][1]), revolute)
        if i:
            pin(marker(couplers[i - 1][0], head, couplers[i - 1][1]), marker(post, head, up), spherical)
    place = mbs.AddSensor(
        items.SensorBody(
            bodyNumber=posts[0][0], localPosition=head, storeInternal=True, writeToFile=False,
            outputVariableType=exu.OutputVariableType.Position,
        )
    )  # fmt: skip
    mbs.Assemble()
    built = time.process_time() - begun
    settings = exu.SimulationSettings()
    settings.timeIntegration.numberOfSteps = round(T_END / step)
    settings.timeIntegration.endTime = T_END
    settings.timeIntegration.verboseMode = 0
    settings.timeIntegration.newton.relativeTolerance = newton
    settings.timeIntegration.newton.useModifiedNewton = True
    settings.solution.file.write = False
    settings.solution.sensors.writePeriod = T_END
    settings.linearSolver.solverType = exu.LinearSolverType.EigenSparse
    begun = time.process_time()
    mbs.SolveDynamic(settings, solverType=exu.DynamicSolverType.TrapezoidalIndex2)
    spent = time.process_time() - begun
    iterations = mbs.sys["dynamicSolver"].it.newtonStepsCount
    x, _, z = mbs.GetSensorStoredData(place)[-1, 1:4]
    return built, spent / max(iterations, 1), spent, float(x), float(z)


if __name__ == "__main__":
    engine, number, step_s, tolerance = sys.argv[1:]
    if engine == "mujoco":
        found = mujoco_run(int(number), float(step_s))
    else:
        found = exudyn_run(int(number), float(step_s), float(tolerance))
    print(*map(repr, found))
