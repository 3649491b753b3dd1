"""A hook on a line over three sheaves in Exudyn; run by the peers' Python: ``exudyn_reeving.py [FILE]``.

Writes time, place of the hook, length and tension of the line (ReevingSystemSprings) to FILE, by default
``references/reeving.csv``, which benchmarks/compared/reeving.py compares with.
"""

from __future__ import annotations

import csv
import sys
from pathlib import Path

import numpy as np

RESULT = Path(__file__).parent / "references" / "reeving.csv"
HEAD = ("time, s", "x, m", "y, m", "z, m", "length, m", "tension, N")
T_END, EVERY = 4.0, 0.1  # s
STEP = 2e-4  # s
GRAVITY = 9.80665
HOOK = {
    "mass": 2000.0, "inertia": (300.0, 400.0, 500.0), "position": (0.9, 0.0, -8.0),
    "velocity": (0.5, 0.0, 0.0), "angular_velocity": (0.0, 0.1, 0.0),
}  # fmt: skip
ON_HOOK = (False, False, True, False, False)
POINTS = ((-4.0, 0.0, -1.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.5), (1.5, 0.0, 0.1), (4.0, 0.0, -2.0))
RADII = (0.0, 0.4, 0.3, 0.35, 0.0)
AXES = ((0.0, 1.0, 0.0), (0.0, 1.0, 0.0), (0.0, -1.0, 0.0), (0.0, 1.0, 0.0), (0.0, 1.0, 0.0))
STIFFNESS, DAMPING, LENGTH = 3e6, 2e4, 24.9  # EA, N; DA, N s; m


def run() -> list[list[float]]:
    """A row for each output, by an explicit method of order 6 with fixed steps."""
    import exudyn as exu
    import exudyn.itemInterface as items
    from exudyn.utilities import RigidBodyInertia

    mbs = exu.SystemContainer().AddSystem()
    ground = mbs.AddObject(items.ObjectGround())
    hook = mbs.CreateRigidBody(
        inertia=RigidBodyInertia(mass=HOOK["mass"], inertiaTensor=np.diag(HOOK["inertia"])),
        referencePosition=list(HOOK["position"]),
        initialVelocity=list(HOOK["velocity"]),
        initialAngularVelocity=list(HOOK["angular_velocity"]),
        gravity=[0.0, 0.0, -GRAVITY],
        nodeType=exu.NodeType.RotationRotationVector,
    )
    markers = [
        mbs.AddMarker(items.MarkerBodyRigid(bodyNumber=hook if on else ground, localPosition=list(point)))
        for on, point in zip(ON_HOOK, POINTS, strict=True)
    ]
    line = mbs.AddObject(
        items.ReevingSystemSprings(
            markerNumbers=markers, hasCoordinateMarkers=False, stiffnessPerLength=STIFFNESS,
            dampingPerLength=DAMPING, regularizationForce=-1.0, referenceLength=LENGTH,
            sheavesAxes=exu.Vector3DList([list(axis) for axis in AXES]), sheavesRadii=list(RADII),
        )
    )  # fmt: skip
    kinds = exu.OutputVariableType
    place = mbs.AddSensor(
        items.SensorBody(bodyNumber=hook, outputVariableType=kinds.Position, storeInternal=True)
    )
    told = [
        mbs.AddSensor(items.SensorObject(objectNumber=line, outputVariableType=kind, storeInternal=True))
        for kind in (kinds.Distance, kinds.ForceLocal)
    ]
    mbs.Assemble()
    settings = exu.SimulationSettings()
    settings.timeIntegration.endTime = T_END
    settings.timeIntegration.numberOfSteps = round(T_END / STEP)
    settings.solutionSettings.sensorsWritePeriod = EVERY
    settings.solutionSettings.writeSolutionToFile = False
    settings.timeIntegration.verboseMode = 0
    mbs.SolveDynamic(settings, solverType=exu.DynamicSolverType.RK67)
    columns = [np.asarray(mbs.GetSensorStoredData(sensor)) for sensor in (place, *told)]
    return np.column_stack([columns[0], columns[1][:, 1], columns[2][:, 1]]).tolist()


def main() -> None:
    """Run and write."""
    path = Path(sys.argv[1]) if len(sys.argv) > 1 else RESULT
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(HEAD)
        writer.writerows([f"{value:.12g}" for value in row] for row in run())


if __name__ == "__main__":
    main()
