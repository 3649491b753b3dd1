"""What is fast here: threads, linear algebra, and a short run of the paper's case 2."""

from __future__ import annotations

import os
from typing import Any

import numpy as np

from seacrane import cases
from seacrane.reporting.measures import speed
from seacrane.simulation import simulate

THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
SPAN = 20.0  # s of case 2
REPEATS = 3


def processors() -> int:
    """Processors that this process may use."""
    allowed = getattr(os, "sched_getaffinity", None)
    return len(allowed(0)) if allowed else os.cpu_count() or 1


def thread_facts() -> dict[str, str]:
    """Processors, and what the environment says of threads."""
    told = {name: os.environ[name] for name in THREADS if name in os.environ}
    return {"processors": str(processors()), **told}


def blas() -> str:
    """NumPy's linear algebra."""
    config: Any = np.show_config(mode="dicts")
    found = config.get("Build Dependencies", {}).get("blas", {})
    return f"{found.get('name', 'unknown')} {found.get('version', '')}".strip()


def pace_of_case2() -> tuple[float, float]:
    """Seconds of the loop, and simulated seconds per second, of the quickest of three runs of case 2."""
    scene = cases.case2()
    runs = [simulate(scene, SPAN) for _ in range(REPEATS)]
    result = min(runs, key=lambda run: float(run.stats["wall_s"]))
    return float(result.stats["wall_s"]), speed(result) or float("inf")
