"""Every engine on the ten-body system: its settings, and its runs against one reference."""

from __future__ import annotations

import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests"))

from measure.records import scene_records
from measure.timing import best_seconds, timed_run
from mujoco_model import mjcf
from system import DT_OUT, T_END, ten_body_scene, tree_data, write_tree

from seacrane import Run, Scene
from seacrane.ensembles.other_sea import with_sea
from seacrane.run.lanes import INSTRUCTIONS, advance_side_by_side, module_of

Array = NDArray[np.float64]
SEACRANE = {
    "rk4": ("dt", (0.1, 0.05, 0.025)),
    "tsit5": ("rtol", (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8)),
    "verner65": ("rtol", (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8)),
    "verner76": ("rtol", (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8)),
    "dop853": ("rtol", (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8)),
}
PINOCCHIO = {
    **SEACRANE,
    "rk4": ("dt", (0.1, 0.05, 0.025, 0.0125, 0.00625)),
}
BAUMGARTE = 10.0  # 1/s
CHANNELS = ["position", "vessel_motion"]
MUJOCO = [("rk4", step, factor * step) for step in (0.05, 0.0125, 0.005, 0.00125) for factor in (1.0, 0.5)]
NUMPY = [("RK45", 1e-6), ("DOP853", 1e-9)]


@dataclass(frozen=True, kw_only=True)
class Point:
    """One run: CPU time of the loop, s, its evaluations, largest errors of payload (m) and roll (rad)."""

    engine: str
    method: str
    setting: str
    cpu: float
    evaluations: int
    payload: float
    roll: float


@dataclass(frozen=True)
class Reference:
    """Payload positions (n, 3) and roll (n,) at the outputs."""

    payload: Array
    roll: Array

    def point(self, payload: Array, roll: Array, **labels: object) -> Point:
        """A run against this reference; one that broke off or went astray has infinite error."""
        errors = [np.max(np.abs(a - b)) for a, b in ((payload, self.payload), (roll, self.roll))]
        errors = [float(e) if np.isfinite(e) else np.inf for e in errors]
        return Point(payload=errors[0], roll=errors[1], **labels)  # type: ignore[arg-type]


def own_run(scene: Scene, *, repeats: int, **settings: object) -> tuple[float, int, Array, Array]:
    """CPU time, evaluations, payload, roll of seacrane."""
    run = timed_run(scene, repeats=repeats, t_end=T_END, dt_out=DT_OUT, channels=CHANNELS, **settings)
    return run.cpu, run.counters["evaluations"], *_track(scene, run.channels)


def _track(scene: Scene, channels: Mapping[str, Array]) -> tuple[Array, Array]:
    """Payload and roll."""
    payload = channels["position"][:, list(scene.bodies).index("payload")]
    return payload, channels["vessel_motion"].reshape(len(payload), -1)[:, 3]


def lane_points(reference: Reference, repeats: int) -> Iterator[Point]:
    """A run of a batch in the lanes of this processor: the reference's sea, and others beside it."""
    scene = ten_body_scene("table")
    for lanes in (count for count in INSTRUCTIONS if module_of(count) is not None):
        scenes = [scene, *(with_sea(scene, {"seed": seed}) for seed in range(101, 100 + lanes))]
        for method, (key, values) in SEACRANE.items():
            for value in values:
                how = {"integrator": method, key: value, "dt_out": DT_OUT, "channels": CHANNELS}
                batches = [[Run(one, T_END, **how) for one in scenes] for _ in range(repeats)]
                last = batches[0][0]
                cpu = best_seconds(
                    lambda left=batches, beside=lanes: advance_side_by_side(left.pop(), beside, _go_on),
                    repeats=repeats,
                )
                if "kept_apart" in last.lanes:
                    raise RuntimeError(f"{method} {value:g} is not in lanes: {last.lanes['kept_apart']}")
                result = last.result()
                payload, roll = _track(scene, result.channels)
                yield reference.point(
                    payload, roll, engine=f"seacrane in {lanes} lanes", method=method,
                    setting=f"{key} {value:g}", cpu=cpu / lanes, evaluations=int(result.stats["evaluations"]),
                )  # fmt: skip


def _go_on(_time: float) -> None:
    """Nothing is looked at between steps."""


def seacrane_points(scene: Scene, reference: Reference, repeats: int) -> Iterator[Point]:
    """Both formulations, every integrator and setting."""
    for formulation in ("recursive", "redundant"):
        for method, (key, values) in SEACRANE.items():
            for value in values:
                cpu, evaluations, payload, roll = own_run(
                    scene, repeats=repeats, formulation=formulation, integrator=method, **{key: value}
                )
                yield reference.point(
                    payload, roll, engine=f"seacrane {formulation}", method=method,
                    setting=f"{key} {value:g}", cpu=cpu, evaluations=evaluations,
                )  # fmt: skip


def driver_run(command: list[str]) -> tuple[float, int, Array, Array]:
    """CPU time, evaluations, payload, roll of a driver."""
    with tempfile.TemporaryDirectory() as folder:  # MuJoCo logs into the current one
        done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=folder)
    if done.returncode:
        raise RuntimeError(f"{' '.join(command)}: {done.stderr.strip()}")
    lines = done.stdout.splitlines()
    head, *rows = lines[-round(T_END / DT_OUT) - 2 :]  # whatever an engine says of itself stands before
    values = np.array([[float(x) for x in row.split()] for row in rows])
    return float(head.split()[0]), int(head.split()[1]), values[:, :3], values[:, 3]


def peer_points(scene: Scene, reference: Reference, drivers: Path, repeats: int) -> Iterator[Point]:
    """Pinocchio and MuJoCo."""
    with tempfile.TemporaryDirectory() as folder:
        tree, model = Path(folder) / "tree.txt", Path(folder) / "model.xml"
        write_tree(scene, tree)
        model.write_text(mjcf(tree_data(scene)), encoding="utf-8")
        for method, (key, values) in PINOCCHIO.items():
            for value in values:
                command = [drivers / "pinocchio_run", tree, method, value, BAUMGARTE, repeats]
                cpu, evaluations, payload, roll = driver_run([str(word) for word in command])
                yield reference.point(
                    payload, roll, engine="Pinocchio", method=method, setting=f"{key} {value:g}", cpu=cpu,
                    evaluations=evaluations,
                )  # fmt: skip
        for method, step, constant in MUJOCO:
            command = [drivers / "mujoco_run", tree, model, method, step, constant, min(repeats, 2)]
            cpu, evaluations, payload, roll = driver_run([str(word) for word in command])
            yield reference.point(
                payload, roll, engine="MuJoCo", method=method, setting=f"dt {step:g}, loops {constant:g} s",
                cpu=cpu, evaluations=evaluations,
            )  # fmt: skip


def numpy_points(scene: Scene, reference: Reference) -> Iterator[Point]:
    """The paper's method in NumPy and SciPy, `tests/reference`; one run each."""
    from reference.simulate import simulate
    from reference.system import System

    records = scene_records(scene)
    payload = list(scene.bodies).index("payload")
    times = DT_OUT * np.arange(round(T_END / DT_OUT) + 1)
    for method, rtol in NUMPY:
        system = System(records)
        start = time.thread_time()
        result = simulate(system, T_END, times, rtol, method=method)
        cpu, evaluations = time.thread_time() - start, result["stats"]["evaluations"]
        yield reference.point(
            result["position"][:, payload], result["vessel_motion"][:, 3], engine="NumPy/SciPy",
            method=method, setting=f"rtol {rtol:g}", cpu=cpu, evaluations=evaluations,
        )  # fmt: skip
