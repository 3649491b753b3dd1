"""The rival: an independent NumPy/SciPy implementation of the same equations, on the same ten-body case."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import cases

from .records import scene_records
from .section import Section
from .timing import timed_run

Array = NDArray[np.float64]
SCRIPT = Path(__file__).resolve().parents[1] / "rival_numpy.py"
RTOL, DT_OUT = 1e-6, 0.1
REFERENCE: dict[str, Any] = {"integrator": "dopri5", "rtol": 1e-11}
METHODS = ("DOP853", "RK45")


def run_rival(records: dict[str, Any], *, t_end: float, method: str) -> tuple[dict[str, Any], Array]:
    """Counters of the rival, run in a process of its own, and its body positions (n, bodies, 3)."""
    with tempfile.TemporaryDirectory() as folder:
        scene, out = Path(folder) / "scene.json", Path(folder) / "run.npz"
        scene.write_text(json.dumps(records), encoding="utf-8")
        command = [sys.executable, str(SCRIPT), str(scene), "--t-end", str(t_end), "--dt-out", str(DT_OUT)]
        command += ["--rtol", str(RTOL), "--method", method, "--out", str(out)]
        environment = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
        done = subprocess.run(command, capture_output=True, text=True, check=False, env=environment)
        if done.returncode != 0:
            raise RuntimeError(f"the rival failed: {done.stderr.strip()}")
        with np.load(out) as arrays:
            return json.loads(done.stdout), np.array(arrays["position"])


def rival(*, repeats: int, t_end: float) -> Section:
    """Wall time, evaluations and error of both on case 2, at the same tolerance and outputs."""
    scene = cases.case2()
    model = scene.compile()
    records = scene_records(scene)
    tight = timed_run(scene, model=model, repeats=1, t_end=t_end, dt_out=DT_OUT, **REFERENCE)
    reference = tight.channels["position"]
    times = 3 * repeats  # short runs, whose wall time others easily disturb
    own = timed_run(scene, model=model, repeats=times, t_end=t_end, dt_out=DT_OUT, rtol=RTOL)
    exact = cases.case2(evaluation="exact")
    summed = timed_run(exact, repeats=times, t_end=t_end, dt_out=DT_OUT, rtol=RTOL)

    def row(label: str, wall: float, evaluations: int, position: Array) -> list[object]:
        error = float(np.max(np.abs(position - reference)))
        return [label, wall, wall / own.wall, evaluations, 1e6 * wall / evaluations, error]

    rows = [
        row("seacrane, dopri5", own.wall, own.counters["evaluations"], own.channels["position"]),
        row("seacrane, dopri5, exact wave sum", summed.wall, summed.counters["evaluations"],
            summed.channels["position"]),
    ]  # fmt: skip
    for method in METHODS:
        stats, position = run_rival(records, t_end=t_end, method=method)
        rows.append(row(f"NumPy/SciPy, {method}", stats["wall_s"], stats["evaluations"], position))
    return Section(
        title="Rival: NumPy and SciPy",
        text=(
            "`benchmarks/rival_numpy.py` runs the independent reference implementation of `tests/reference` "
            "(same equations, vectorised NumPy, SciPy's solve_ivp) on records of the same scene. "
            f"Both run {t_end:g} s of case 2 at rtol {RTOL:g}, with outputs every {DT_OUT:g} s, reactions "
            f"included, on one thread. Wall times: ours best of {times}, every default channel; the rival's "
            "one run. Error: largest difference of any body's position from seacrane's dopri5 at rtol 1e-11, "
            "so the last column also says how far the two implementations agree."
        ),
        head=["program", "wall, s", "over seacrane", "evaluations", "us per evaluation, all in", "error, m"],
        rows=rows,
    )
