"""A batch of trees by the threads of `mujoco.rollout`; run by the peers' Python:
``mujoco_batch.py LOADS.so MODEL.xml THREADS STEP TIMECONST REPEATS TREE...``.

Prints the best wall and CPU time of `rollout`, then the payload's position at every second, tree by tree.
Integrator RK4; the loops as in mujoco_run.cpp.
"""

import ctypes
import sys
import time
from pathlib import Path

import mujoco
import numpy as np
from mujoco.rollout import Rollout

SECONDS = 100
IMPEDANCE = 0.9999  # the stiffest that it takes

library, path, threads, step, constant, repeats, *trees = sys.argv[1:]
loads = ctypes.CDLL(library)
text = Path(path).read_text(encoding="utf-8")
per_second = round(1.0 / float(step))
models = []
for tree in trees:
    member = loads.add_loads(tree.encode())
    if member < 0:
        sys.exit(f"cannot read {tree}")
    model = mujoco.MjModel.from_xml_string(text)
    model.opt.integrator = mujoco.mjtIntegrator.mjINT_RK4
    model.opt.timestep = 1.0 / per_second
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_REFSAFE  # else loops are kept above two steps
    model.eq_solref[:] = float(constant), 1.0
    model.eq_solimp[:, :2] = IMPEDANCE
    model.numeric_data[0] = member
    models.append(model)
mujoco.set_mjcb_passive(loads.apply_loads)

data = [mujoco.MjData(models[0]) for _ in range(int(threads))]
kind = mujoco.mjtState.mjSTATE_FULLPHYSICS
start = np.empty(mujoco.mj_stateSize(models[0], kind))
mujoco.mj_getState(models[0], data[0], start, kind)
starts = np.tile(start, (len(models), 1))
steps = SECONDS * per_second + 1  # a sensor tells where a step begins
wall = cpu = np.inf
with Rollout(nthread=int(threads)) as rollout:
    for _ in range(int(repeats)):
        begun, spent = time.perf_counter(), time.process_time()
        _, sensed = rollout.rollout(models, data, starts, nstep=steps)
        cpu = min(cpu, time.process_time() - spent)
        wall = min(wall, time.perf_counter() - begun)
mujoco.set_mjcb_passive(None)
print(wall, cpu)
for row in sensed[:, ::per_second].reshape(-1, 3):
    print(*map(repr, row.tolist()))
