"""One batch in three engines, each on as many threads as it is given:
``python benchmarks/peers/batches.py --peers out/peers/bin/python --drivers out/bench-peers/drivers``.

The drivers are those of `build_drivers.sh`. Prints the table; with ``--publish`` it is written to
``benchmarks/peers/results``, on a machine that does nothing else.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from measure.section import Section
from mujoco_model import IN_A_BATCH, mjcf
from numpy.typing import NDArray
from system import DT_OUT, T_END, ten_body_scene, tree_data, write_tree

from seacrane import Kept, Scene, ensemble
from seacrane.ensembles.other_sea import with_sea

Array = NDArray[np.float64]
HERE = Path(__file__).resolve().parent
LEVEL = 0.01  # m
SHARE = 0.5  # of the members that have to be within it: errors of others grow too far
BAUMGARTE = 10.0  # 1/s, of Pinocchio's loops
TRACK = Kept(channel="position", names={"body": "payload"}, interval=DT_OUT)
SEACRANE = [
    (method, rtol) for method in ("tsit5", "verner65", "dop853") for rtol in (1e-2, 3e-3, 1e-3, 3e-4, 1e-4)
]
PINOCCHIO = SEACRANE
MUJOCO = [(step, factor * step) for step in (0.05, 0.025, 0.0125, 0.005) for factor in (1.0, 0.5)]


@dataclass(frozen=True, kw_only=True)
class Batch:
    """One setting of an engine on the whole batch: seconds, and the payload's tracks (members, times, 3)."""

    engine: str
    setting: str
    wall: float
    cpu: float
    tracks: Array


def seacrane_batches(
    scene: Scene, seeds: range, threads: int, repeats: int, lanes: int, settings: list[tuple[str, float]]
) -> Iterator[Batch]:
    """The whole call of `ensemble`, seas and results included."""
    for method, rtol in settings:
        wall = cpu = np.inf
        for _ in range(repeats):
            with ThreadPoolExecutor(threads) as pool:
                begun, spent = time.perf_counter(), time.process_time()
                made = ensemble(
                    scene, over={"seed": seeds}, keep={"track": TRACK}, t_end=T_END,
                    executor=pool, lanes=lanes, pack=max(lanes, 4), integrator=method, rtol=rtol,
                    formulation="recursive", dt_out=DT_OUT, channels=("position",),
                )  # fmt: skip
                cpu = min(cpu, time.process_time() - spent)
                wall = min(wall, time.perf_counter() - begun)
        apart = set(made.dataset.kept_apart.to_numpy()) - {""}
        if made.failures or apart:
            raise RuntimeError(f"seacrane: {made.failures or apart}")
        yield Batch(
            engine=f"seacrane, {lanes} lanes" if lanes > 1 else "seacrane, no lanes",
            setting=f"{method}, rtol {rtol:g}", wall=wall, cpu=cpu, tracks=made.dataset.track.to_numpy(),
        )  # fmt: skip


def peer_batches(
    scene: Scene, seeds: range, threads: int, repeats: int, drivers: Path, python: str
) -> Iterator[Batch]:
    """Pinocchio in C++ and MuJoCo's `rollout`: stepping alone, of models that are made before."""
    with tempfile.TemporaryDirectory() as folder:
        trees = [str(Path(folder) / f"tree_{seed}.txt") for seed in seeds]
        for seed, tree in zip(seeds, trees, strict=True):
            write_tree(with_sea(scene, {"seed": seed}), Path(tree))
        model = Path(folder) / "model.xml"
        model.write_text(mjcf(tree_data(scene), IN_A_BATCH), encoding="utf-8")
        for method, rtol in PINOCCHIO:
            words = [drivers / "pinocchio_batch", threads, method, rtol, BAUMGARTE, repeats, *trees]
            yield _driven("Pinocchio", f"{method}, rtol {rtol:g}", words, folder, len(trees))
        library = drivers / "mujoco_loads.so"
        for step, constant in MUJOCO:
            words = [
                python,
                HERE / "mujoco_batch.py",
                library,
                model,
                threads,
                step,
                constant,
                repeats,
                *trees,
            ]
            yield _driven(
                "MuJoCo rollout", f"rk4, dt {step:g}, loops {constant:g} s", words, folder, len(trees)
            )


def _driven(engine: str, setting: str, words: list[Any], folder: str, members: int) -> Batch:
    done = subprocess.run(list(map(str, words)), capture_output=True, text=True, check=False, cwd=folder)
    if done.returncode:
        raise RuntimeError(f"{engine}: {done.stderr.strip()}")
    times = round(T_END / DT_OUT) + 1
    head, *rows = done.stdout.splitlines()[-members * times - 1 :]
    values = np.array([[float(x) for x in row.split()[:3]] for row in rows])
    wall, cpu = (float(x) for x in head.split()[:2])
    return Batch(engine=engine, setting=setting, wall=wall, cpu=cpu, tracks=values.reshape(members, times, 3))


def batches(drivers: Path, python: str, *, members: int = 64, threads: int = 2, repeats: int = 3) -> Section:
    """The quickest setting of each engine that is good enough, on the same members."""
    scene, seeds = ten_body_scene(), range(1, members + 1)
    assert scene.waves is not None
    tabled = scene.copy(waves=replace(scene.waves, evaluation="table"))
    (truth,) = seacrane_batches(scene, seeds, threads, 1, 1, [("verner76", 1e-9)])
    busy = os.getloadavg()[0]
    quickest: dict[str, tuple[Batch, Array]] = {}
    tried: list[str] = []
    sources: list[Callable[[], Iterator[Batch]]] = [
        lambda: seacrane_batches(tabled, seeds, threads, repeats, 4, SEACRANE),
        lambda: seacrane_batches(tabled, seeds, threads, repeats, 1, SEACRANE),
        lambda: peer_batches(scene, seeds, threads, repeats, drivers, python),
    ]
    for source in sources:
        for one in source():
            tried.append(one.engine)
            errors = np.linalg.norm(one.tracks - truth.tracks, axis=-1).max(axis=1)
            errors = np.where(np.isfinite(errors), errors, np.inf)
            good = float(np.quantile(errors, SHARE)) <= LEVEL
            print(f"{one.engine}, {one.setting}: {one.cpu / members * 1e3:.2f} ms CPU, "
                  f"{np.quantile(errors, SHARE):.2g} m", flush=True)  # fmt: skip
            if good and (one.engine not in quickest or one.cpu < quickest[one.engine][0].cpu):
                quickest[one.engine] = one, errors
    best = min(one.cpu for one, _ in quickest.values())
    rows: list[list[Any]] = [
        [
            name, one.setting, 1e3 * one.cpu / members, one.cpu / best, members * T_END / one.wall,
            float(np.quantile(errors, SHARE)), float(errors.max()),
        ]
        for name, (one, errors) in quickest.items()
    ]  # fmt: skip
    rows += [
        [name, "no setting reaches it", *[None] * 5] for name in dict.fromkeys(tried) if name not in quickest
    ]
    return Section(
        title="Batches against peers",
        text=(
            f"{members} members of the system above that differ in the phases of their waves, {T_END:g} s, "
            f"payload every second, on {threads} threads. For each engine the quickest of its settings with "
            f"half the members within {LEVEL:g} m of seacrane's verner76 at rtol 1e-9. In some of the "
            "others any error grows to metres within this time, in every engine, as the worst ones tell. CPU "
            "time of all threads, for a member; simulated seconds a second by the wall.\n\n"
            "- seacrane: the whole call of `ensemble` from Python: seas, starts, steps, results. Its waves "
            "come from a table with a bound of 1e-9, as always; those of the peers and of the reference are "
            "sums of cosines.\n"
            "- The peers: stepping alone, of models that were made before. What they leave out is in no time "
            "of theirs: seas, memory of radiated waves, stores, members that fail.\n"
            "- Pinocchio: C++ on a pool of threads, seacrane's integrators.\n"
            "- MuJoCo: the threads of its `rollout`, its Runge-Kutta method; the loads by a C "
            "callback, without Python.\n\n"
            f"Best of {repeats}. Load of the machine before: {busy:.1f} on {os.cpu_count()} cores."
        ),
        head=[
            "engine", "setting", "CPU, ms a member", "over the quickest", "simulated s per s",
            "payload error of the middle member, m", "worst, m",
        ],
        rows=rows,
        folder="benchmarks/peers/results",
    )  # fmt: skip


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--peers", required=True, help="Python that has the peers installed")
    parser.add_argument("--drivers", required=True, type=Path, help="folder of the compiled drivers")
    parser.add_argument("--members", type=int, default=64)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--publish", action="store_true", help="write into benchmarks/peers")
    options = parser.parse_args()
    section = batches(
        options.drivers.resolve(), str(Path(options.peers).absolute()), members=options.members,
        threads=options.threads, repeats=options.repeats,
    )  # fmt: skip
    print(section.markdown())
    if options.publish:
        section.save(HERE / "results")


if __name__ == "__main__":
    main()
