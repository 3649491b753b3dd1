"""The same ten-body crane in four engines: measured by ``benchmarks/run.py``.

Needs the peers in an environment of their own, which `make bench` makes (`requirements.txt`), and compiles
their C++ drivers; every setting of every engine runs on one core.
"""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parent))

from engines import Point, Reference, lane_points, numpy_points, own_run, peer_points, seacrane_points
from measure.section import RESULTS, ROOT, Section
from measure.sources import ENGINE
from system import ten_body_scene

from seacrane.inputs.atomic import atomic_write

HERE = Path(__file__).resolve().parent
PYTHON = ROOT / "out" / "peers" / "bin" / "python"
LEVELS = (1e-2, 1e-4, 1e-6)  # m
NEAREST = "its nearest"
ALONE = ("seacrane recursive", "seacrane redundant")
MARKS = {"seacrane recursive": "o-", "seacrane redundant": "s-", "Pinocchio": "^--", "MuJoCo": "v--",
         "NumPy/SciPy": "x:"}  # fmt: skip
REPEATS = 3


def needs() -> str:
    """What is missing, in words."""
    return "" if PYTHON.exists() else "the peers: make out/peers/.installed"


def drivers() -> Path:
    """The folder of the compiled drivers."""
    folder = ROOT / "out" / "bench-peers" / "drivers"
    subprocess.run([HERE / "build_drivers.sh", PYTHON, folder], check=True)
    return folder


def quickest() -> Iterator[list[Any]]:
    """Per payload error the quickest setting of each engine, over that of seacrane; then its nearest."""
    points = _points()
    engines = list(dict.fromkeys(p.engine for p in points))
    _figure(points, RESULTS.parent / "peers" / "work_precision.png")
    for level in LEVELS:
        own = min(p.cpu for p in points if p.engine in ALONE and p.payload <= level)
        for engine in engines:
            passing = [p for p in points if p.engine == engine and p.payload <= level]
            if not passing:
                yield [f"{level:g} m", engine, "no setting reaches it", None, None, None]
                continue
            best = min(passing, key=lambda p: p.cpu)
            yield [f"{level:g} m", *_told(best), best.cpu / own, best.payload]
    for engine in MARKS:
        best = min((p for p in points if p.engine == engine), key=lambda p: p.payload)
        yield [NEAREST, *_told(best), None, best.payload]


def _told(point: Point) -> list[Any]:
    return [point.engine, f"{point.method}, {point.setting}", 1e3 * point.cpu]


def _points() -> list[Point]:
    scene = ten_body_scene()
    tight: dict[str, Any] = {"repeats": 1, "rtol": 1e-12}
    _, _, payload, roll = own_run(scene, formulation="redundant", integrator="dop853", **tight)
    reference = Reference(payload, roll)
    points: list[Point] = []
    for source in (
        seacrane_points(scene, reference, REPEATS),
        lane_points(reference, REPEATS),
        peer_points(scene, reference, drivers(), REPEATS),
        numpy_points(scene, reference),
    ):
        for point in source:
            print(point, flush=True)
            points.append(point)
    return points


def _figure(points: list[Point], path: Path) -> None:
    """Work-precision diagram: payload error over CPU time, a line per engine and method."""
    from matplotlib.figure import Figure

    picture = Figure(figsize=(7.5, 5.0), layout="constrained")
    axes = picture.subplots()
    for number, (engine, mark) in enumerate(MARKS.items()):
        for index, method in enumerate(dict.fromkeys(p.method for p in points if p.engine == engine)):
            line = [p for p in points if (p.engine, p.method) == (engine, method) and p.payload < 1.0]
            label = engine if index == 0 else None
            axes.loglog([1e3 * p.cpu for p in line], [p.payload for p in line], mark, ms=4, lw=0.8,
                        color=f"C{number}", label=label)  # fmt: skip
    axes.set_xlabel("CPU time of 100 s, ms")
    axes.set_ylabel("largest error of the payload's position, m")
    axes.grid(True, which="both", alpha=0.3)
    axes.legend(fontsize=8)
    with atomic_write(path) as draft:
        picture.savefig(draft, dpi=130, format="png")


SECTION = Section(
    title="Quickest setting within a payload error",
    text=(
        "The same crane in other engines ([what each is](peers/README.md)): 100 s of ten bodies, CPU time "
        "of one thread. At loose tolerances single errors are partly luck. The last rows are the nearest "
        "that each engine comes to seacrane's redundant form by `dop853` at rtol 1e-12."
    ),
    head=["payload error at most", "engine", "setting", "CPU, ms", "over the quickest of seacrane",
          "payload error, m"],
    rows=quickest,
    sources=(*ENGINE, "benchmarks/peers/*.py", "benchmarks/peers/*.cpp", "benchmarks/peers/*.hpp"),
    needs=needs,
)  # fmt: skip
