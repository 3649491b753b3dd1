"""A mass on a hydraulic actuator in Exudyn; run by the peers' Python: ``exudyn_hydraulics.py [FILE]``.

Writes time, length, speed of the mass and both pressures (ObjectConnectorHydraulicActuatorSimple) to FILE, by
default ``references/hydraulics.csv``, which benchmarks/compared/hydraulics.py compares with.
"""

from __future__ import annotations

import csv
import math
import sys
from pathlib import Path

import numpy as np

RESULT = Path(__file__).parent / "references" / "hydraulics.csv"
HEAD = ("time, s", "length, m", "speed, m/s", "full side, Pa", "rod side, Pa")
T_END, EVERY = 1.0, 0.02  # s
STEP = 2e-5  # s
GRAVITY, MASS = 9.80665, 1000.0
BORE, ROD = 0.08, 0.035  # m
FULL, RING = math.pi / 4.0 * BORE**2, math.pi / 4.0 * (BORE**2 - ROD**2)
OFFSET, STROKE, LENGTH = 1.05, 0.6, 1.35  # m
HOSES = (31.4e-6, 78.5e-6)  # m3
OIL, CYLINDER, HOSE = 1.5e9, 3.15e10, 1.5e8  # Pa
SUPPLY, TANK = 7.6e6, 0.1e6  # Pa
CONDUCTANCE = 24e-3 / 60.0 / math.sqrt(3.5e6)  # m3/s/sqrt(Pa)
OPENING = -0.4  # retracts: the mass hangs and is lifted
DAMPING = 1e4  # N s/m
START = (0.76e6, (0.76e6 * FULL + MASS * GRAVITY) / RING)  # Pa


def run() -> list[list[float]]:
    """A row for each output, by an explicit method of order 6 with fixed steps."""
    import exudyn as exu
    import exudyn.itemInterface as items

    mbs = exu.SystemContainer().AddSystem()
    ground = mbs.AddObject(items.ObjectGround())
    point = mbs.AddNode(items.NodePoint(referenceCoordinates=[0.0, 0.0, -LENGTH]))
    mass = mbs.AddObject(items.MassPoint(mass=MASS, nodeNumber=point))
    ends = [mbs.AddMarker(items.MarkerBodyPosition(bodyNumber=body)) for body in (ground, mass)]
    mbs.AddLoad(items.Force(markerNumber=ends[1], loadVector=[0.0, 0.0, -MASS * GRAVITY]))
    oil = mbs.AddNode(
        items.NodeGenericODE1(
            referenceCoordinates=[0.0, 0.0], initialCoordinates=list(START), numberOfODE1Coordinates=2
        )
    )
    mbs.AddObject(
        items.HydraulicActuatorSimple(
            markerNumbers=ends, nodeNumbers=[oil], offsetLength=OFFSET, strokeLength=STROKE,
            chamberCrossSection0=FULL, chamberCrossSection1=RING, hoseVolume0=HOSES[0], hoseVolume1=HOSES[1],
            valveOpening0=OPENING, valveOpening1=-OPENING, actuatorDamping=DAMPING, oilBulkModulus=OIL,
            cylinderBulkModulus=CYLINDER, hoseBulkModulus=HOSE, nominalFlow=CONDUCTANCE,
            systemPressure=SUPPLY, tankPressure=TANK, useChamberVolumeChange=True,
        )
    )  # fmt: skip
    kinds = exu.OutputVariableType
    told = [
        mbs.AddSensor(items.SensorNode(nodeNumber=node, outputVariableType=kind, storeInternal=True))
        for node, kind in ((point, kinds.Position), (point, kinds.Velocity), (oil, kinds.Coordinates))
    ]
    mbs.Assemble()
    settings = exu.SimulationSettings()
    settings.timeIntegration.endTime = T_END
    settings.timeIntegration.numberOfSteps = round(T_END / STEP)
    settings.solutionSettings.sensorsWritePeriod = EVERY
    settings.solutionSettings.writeSolutionToFile = False
    settings.timeIntegration.verboseMode = 0
    mbs.SolveDynamic(settings, solverType=exu.DynamicSolverType.RK67)
    place, speed, pressures = (np.asarray(mbs.GetSensorStoredData(sensor)) for sensor in told)
    return np.column_stack([place[:, 0], -place[:, 3], speed[:, 3], pressures[:, 1:]]).tolist()


def main() -> None:
    """Run and write."""
    path = Path(sys.argv[1]) if len(sys.argv) > 1 else RESULT
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(HEAD)
        writer.writerows([f"{value:.12g}" for value in row] for row in run())


if __name__ == "__main__":
    main()
