"""An operability study of 1,250 storms: 10 seeds x 5 Hs x 5 periods x 5 directions on case 2's crane.

``python benchmarks/measure/operability_storms.py [--duration S] [--wire RUNG] [--publish]`` runs it on two
threads, where it is killed once and resumed, on two processes and on a local dask cluster, if distributed is
installed. It fails unless all storms and tables are identical. It writes ``operability-storms.csv``, the wall
times, and ``operability-of-case-2.csv``, the table, to ``out/bench/results``; with ``--publish`` to
``benchmarks/results``. With an elastic wire the names end in ``-elastic-wire`` or ``-quasi-static-wire``.

The payload hangs 25 m below the tip, swung out over the side. Guide lines brake its swing.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from concurrent.futures import Executor, ProcessPoolExecutor, ThreadPoolExecutor
from importlib.util import find_spec
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "benchmarks"))

from measure.section import significant  # noqa: E402
from measure.table import write  # noqa: E402
from seacrane import Criterion, Scene, allowable_hs, cases  # noqa: E402
from seacrane.crane import Payload  # noqa: E402
from seacrane.ensembles import Ensemble  # noqa: E402

LINK, MASS, G = 25.0, 10e3, 9.80665  # m, kg, m/s2
GUIDED = 0.03  # of critical damping, of the swing on guide lines
STIFFNESS = 1.5e8  # N, EA of the wire: 1,500 mm2 of rope
SWUNG_OUT = 50.0  # s
PERIODS = (6.0, 7.5, 9.0, 10.5, 12.0)  # s
DIRECTIONS = (90.0, 112.5, 135.0, 157.5, 180.0)  # degrees
HEIGHTS = (0.5, 1.0, 1.5, 2.0, 2.5)  # m
SEEDS = 10
TOLERANCE = 1e-4
START_UP = 300.0  # s
CRITERIA = (
    Criterion(channel="hook_load", maximum=1.15 * MASS * G, name="hook load"),
    Criterion(channel="tip_velocity", names={"axis": "z"}, maximum=0.8, name="tip velocity"),
    Criterion(
        channel="position", names={"body": "payload", "axis": "x"}, maximum=3.0, motion=True,
        statistic="significant", name="swing fore and aft",
    ),
    Criterion(
        channel="position", names={"body": "payload", "axis": "y"}, maximum=3.0, motion=True,
        statistic="significant", name="swing athwart",
    ),
)  # fmt: skip
EXECUTORS = ("threads", "processes", "dask")
KILLED_AT = 0.4  # of the packs


def study_scene(wire: str = "rigid") -> Scene:
    """Case 2 with its payload 25 m below the tip, on a rigid link or a wire, and guide lines."""
    scene = cases.case2(payload=Payload(mass=MASS, link_length=LINK))
    body, tip = scene.roles[""].tip
    if wire != "rigid":
        link = scene.joints["link"]
        scene.remove("link")
        scene.add_line(
            name="wire", bodies=[link.first, link.second],
            points=[link.first_frame.point, link.second_frame.point], EA=STIFFNESS,
            length=LINK / (1.0 + MASS * G / STIFFNESS), rung=wire,
        )  # fmt: skip
    scene.add_pendulum_damping(
        name="guide lines", first=body, second="payload", first_point=tip, ratio=GUIDED
    )
    return scene


@contextlib.contextmanager
def opened(name: str, workers: int) -> Iterator[Executor]:
    """An executor by its name."""
    if name == "threads":
        with ThreadPoolExecutor(workers) as executor:
            yield executor
    elif name == "processes":
        with ProcessPoolExecutor(workers) as executor:
            yield executor
    else:
        from distributed import Client, LocalCluster

        with (
            LocalCluster(n_workers=workers, threads_per_worker=1, dashboard_address=None) as cluster,
            Client(cluster) as client,
        ):
            yield client.get_executor()


def study(arguments: argparse.Namespace, **given: Any) -> Any:
    """The table of the study; `domain` and what runs it are given."""
    some = slice(arguments.points)
    return allowable_hs(
        study_scene(arguments.wire), criteria=CRITERIA, tp=PERIODS[some], direction_deg=DIRECTIONS[some],
        hs=HEIGHTS[some], seeds=range(1, arguments.seeds + 1), duration=arguments.duration,
        start_up=arguments.start_up, time=SWUNG_OUT,
        rtol=TOLERANCE, **given,
    )  # fmt: skip


def storms_here(arguments: argparse.Namespace) -> None:
    """Run the storms with one executor, and leave table and wall time beside the store."""
    store = Path(arguments.store)
    begin = time.perf_counter()
    with opened(arguments.executor, arguments.workers) as executor:
        table = study(arguments, domain="time", executor=executor, store=store)
    wall = time.perf_counter() - begin
    table.dataset.to_netcdf(store.with_suffix(".table.nc"))
    store.with_suffix(".json").write_text(json.dumps({"wall": wall, "failed": len(table.failures)}))


def storms_elsewhere(arguments: argparse.Namespace, executor: str, store: Path, *, kill: bool) -> float:
    """Run the storms in a process of their own; s of wall time, the killed one's included."""
    command = [
        sys.executable, __file__, "--store", str(store), "--executor", executor,
        "--duration", str(arguments.duration), "--start-up", str(arguments.start_up),
        "--seeds", str(arguments.seeds), "--points", str(arguments.points),
        "--workers", str(arguments.workers), "--wire", arguments.wire,
    ]  # fmt: skip
    before = 0.0
    if kill:
        begin = time.perf_counter()
        child = subprocess.Popen(command)
        count = arguments.seeds * arguments.points**3
        packs = min(250, count)
        while child.poll() is None and len(list(store.glob("*.nc"))) < KILLED_AT * packs:
            time.sleep(0.05)
        if child.poll() is not None:
            raise RuntimeError(
                f"{executor}: the storms ended before they were killed; give a longer duration"
            )
        child.kill()
        child.wait()
        before = time.perf_counter() - begin
        print(f"{executor}: killed after {before:.1f} s with {len(list(store.glob('*.nc')))} packs")
    subprocess.run(command, check=True)
    told = json.loads(store.with_suffix(".json").read_text())
    return before + float(told["wall"])


def compared(first: Path, other: Path) -> None:
    """Raise RuntimeError unless two stores hold the same storms, to the bit."""
    if not Ensemble.load(first).dataset.identical(Ensemble.load(other).dataset):
        raise RuntimeError(f"the storms of {first.name} and {other.name} differ")
    tables = [path.with_suffix(".table.nc").read_bytes() for path in (first, other)]
    if tables[0] != tables[1]:
        raise RuntimeError(f"the tables of {first.name} and {other.name} differ")


def measure(arguments: argparse.Namespace, folder: Path, work: Path) -> None:
    """All executors in turn; write both tables."""
    names = [name for name in arguments.executors if name != "dask" or find_spec("distributed")]
    count = arguments.seeds * arguments.points**3
    rows, stores = [], []
    for name in names:
        store, load = work / name, os.getloadavg()[0]
        wall = storms_elsewhere(arguments, name, store, kill=name == names[0])
        stores.append(store)
        compared(stores[0], store)
        hours = count * (arguments.duration + arguments.start_up) / 3600.0
        how = "killed once, resumed" if name == names[0] else "one go"
        cells = [significant(value) for value in (wall, 1e3 * wall / count, 3600.0 * hours / wall)]
        told = [name, str(arguments.workers), how, str(count), f"{arguments.duration:g}"]
        rows.append([*told, *cells, "yes", f"{load:.1f}"])
        print(f"{name}: {wall:.1f} s, identical with {names[0]}")
    ending = "" if arguments.wire == "rigid" else f"-{arguments.wire}-wire"
    head = ["executor", "workers", "run", "storms", "duration, s", "wall, s", "ms a storm"]
    head += ["simulated s a second", "identical", "load before"]
    write(folder / f"operability-storms{ending}.csv", head, rows)
    write(folder / f"operability-of-case-2{ending}.csv", *_table(arguments, stores[0]))


def _table(arguments: argparse.Namespace, store: Path) -> tuple[list[str], list[list[str]]]:
    import xarray

    linear = study(arguments, domain="frequency").dataset
    head = ["Tp, s", "direction, deg", "allowable Hs, m", "low, m", "high, m", "governing", "linear model, m"]
    rows = []
    with xarray.open_dataset(store.with_suffix(".table.nc")) as table:
        for tp in table["tp"].to_numpy():
            for direction in table["direction_deg"].to_numpy():
                cell, by_model = (one.sel(tp=tp, direction_deg=direction) for one in (table, linear))
                numbers = [float(cell[name]) for name in ("allowable_hs", "low", "high")]
                governs = str(cell["governing"].item()) or "none"
                told = [f"{value:.3f}" for value in (*numbers, float(by_model["allowable_hs"]))]
                rows.append([f"{tp:g}", f"{direction:g}", *told[:3], governs, told[3]])
    return head, rows


def main() -> int:
    """Run the study, or with --store the storms of one executor."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--duration", type=float, default=10800.0, help="s of each storm (default 10800)")
    parser.add_argument("--start-up", type=float, default=START_UP, help="s before that are left out")
    parser.add_argument("--seeds", type=int, default=SEEDS)
    parser.add_argument("--points", type=int, default=5, help="of Hs, period and direction (default 5)")
    parser.add_argument("--executors", nargs="+", choices=EXECUTORS, default=EXECUTORS)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--wire", choices=("rigid", "elastic", "quasi-static"), default="rigid")
    parser.add_argument("--publish", action="store_true", help="write to benchmarks/results")
    parser.add_argument("--folder", type=Path, help="write there instead")
    parser.add_argument("--store", help=argparse.SUPPRESS)
    parser.add_argument("--executor", choices=EXECUTORS, default="threads", help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    if arguments.store:
        storms_here(arguments)
        return 0
    usual = ROOT / ("benchmarks/results" if arguments.publish else "out/bench/results")
    work = Path(tempfile.mkdtemp(prefix="storms-"))
    try:
        measure(arguments, arguments.folder or usual, work)
    finally:
        shutil.rmtree(work, ignore_errors=True)
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
