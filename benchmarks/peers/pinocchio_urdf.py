"""Accelerations of the service crane in Pinocchio, by its own URDF reader; run by the peers' Python:
``pinocchio_urdf.py [FILE]``.

States are random; the loop of the jib's cylinder is open, as URDF has it. Writes
``references/service_arm.json``, which a test holds seacrane to.
"""

import json
import sys
from pathlib import Path

import numpy as np
import pinocchio as pin

ROOT = Path(__file__).resolve().parents[2]
URDF = ROOT / "python" / "seacrane" / "data" / "cranes" / "service_arm_5t.urdf"
RESULT = Path(__file__).parent / "references" / "service_arm.json"
STATES = 3

model = pin.buildModelFromUrdf(str(URDF))
model.gravity.linear = np.array([0.0, 0.0, -9.80665])
data = model.createData()
names = list(model.names)[1:]
random = np.random.default_rng(1)
states = []
for _ in range(STATES):
    positions = random.uniform(-0.15, 0.15, len(names))
    rates = random.uniform(-1.0, 1.0, len(names))
    q = pin.neutral(model)
    for name, position in zip(names, positions, strict=True):
        joint = model.joints[model.getJointId(name)]
        value = [np.cos(position), np.sin(position)] if joint.nq == 2 else [position]
        q[joint.idx_q : joint.idx_q + joint.nq] = value
    accelerations = pin.aba(model, data, q, rates, np.zeros(model.nv))
    rows = {"positions": positions, "rates": rates, "accelerations": accelerations}
    states.append({key: dict(zip(names, row.tolist(), strict=True)) for key, row in rows.items()})
out = Path(sys.argv[1]) if len(sys.argv) > 1 else RESULT
source = f"Pinocchio {pin.__version__}: buildModelFromUrdf, aba; gravity 9.80665 m/s2, no torques"
out.write_text(json.dumps({"source": source, "states": states}, indent=1) + "\n", encoding="utf-8")
