"""What is fast here: threads, linear algebra, a short run of the paper's case 2, and seeds of it in lanes."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from typing import Any

import numpy as np

from seacrane import _core, cases
from seacrane.answers.checks import speed
from seacrane.ensembles.ensemble import Ensemble, ensemble
from seacrane.ensembles.kept import Kept
from seacrane.run.lanes import INSTRUCTIONS, lanes_of, module_of
from seacrane.scene.scene import Scene
from seacrane.simulation import simulate

THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
SPAN = 20.0  # s of case 2
SPAN_OF_LANES = 100.0  # s
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


def lane_facts() -> dict[str, str]:
    """How many seeds ensembles step side by side here, and how long as many seeds of case 2 take."""
    usual = lanes_of(None)
    told = {"lanes of ensembles": f"{usual} by default; " + ", ".join(map(_lanes_told, INSTRUCTIONS))}
    usable = [lanes for lanes in INSTRUCTIONS if module_of(lanes) is not None]
    return told | {_seeds_of(lanes): _pace_of_lanes(lanes) for lanes in usable}


def _seeds_of(lanes: int) -> str:
    return f"{lanes} seeds of it in lanes, {SPAN_OF_LANES:g} s"


def _lanes_told(lanes: int) -> str:
    name = INSTRUCTIONS[lanes]
    if module_of(lanes) is not None:
        return f"{lanes} ({name})"
    why = "this build has none" if _core.has_instructions(name) else "this processor has none"
    return f"not {lanes} ({name}): {why}"


def _pace_of_lanes(lanes: int) -> str:
    """Beside each other and one after another; or why they do not go side by side."""
    scene = cases.case2()
    beside, made = _quickest(lambda: _seeds(scene, lanes, lanes))
    alone, _ = _quickest(lambda: _seeds(scene, lanes, 1))
    failed = [*made.failures.values(), *filter(None, made.dataset.kept_apart.to_numpy().tolist())]
    if failed:
        return f"not side by side: {failed[0]}"
    return f"{1e3 * beside:.3g} ms, one after another {1e3 * alone:.3g} ms"


def _seeds(scene: Scene, count: int, lanes: int) -> Ensemble:
    return ensemble(
        scene,
        over={"seed": range(1, count + 1)},
        keep={"track": Kept(channel="position", names={"body": "payload"})},
        t_end=SPAN_OF_LANES,
        lanes=lanes,
    )


def _quickest(call: Callable[[], Ensemble]) -> tuple[float, Ensemble]:
    """Seconds of the quickest of some calls, and what the last one made."""
    seconds = []
    for _ in range(REPEATS):
        start = time.perf_counter()
        made = call()
        seconds.append(time.perf_counter() - start)
    return min(seconds), made
