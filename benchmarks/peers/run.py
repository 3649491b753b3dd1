"""The same ten-body crane in five engines: ``python benchmarks/peers/run.py``.

Needs the peers in an environment of their own (`requirements.txt`); compiles their C++ drivers, runs every
setting of every engine on one core, and writes the table and the work-precision diagram to
``out/bench-peers``, with ``--publish`` to ``benchmarks/peers``. Run it with seacrane's Python; ``--peers``
names that of the peers.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

import documents
import numpy as np
from batches import batches
from engines import Point, Reference, numpy_points, own_run, peer_points, seacrane_points
from loops import loops_section
from measure.section import Section
from system import COMPONENTS, ten_body_scene

from seacrane.inputs.atomic import atomic_write

HERE = Path(__file__).resolve().parent
LEVELS = (1e-2, 1e-4, 1e-6)  # m
PICTURE = "work_precision.png"
RESULTS = "benchmarks/peers/results"
MARKS = {"seacrane recursive": "o-", "seacrane redundant": "s-", "Pinocchio": "^--", "MuJoCo": "v--",
         "Exudyn": "D--", "NumPy/SciPy": "x:"}  # fmt: skip
INTRODUCTION = f"""# Against other engines

Written by `benchmarks/peers/run.py --publish`. To measure again, with seacrane's Python:

    python -m venv out/peers && out/peers/bin/pip install -r benchmarks/peers/requirements.txt
    python benchmarks/peers/run.py --peers out/peers/bin/python

The system is case 2 without memory: hull, tower, king, two jibs, two barrels and rods, and the payload
on its link. It has the shipped gains, {COMPONENTS} cosines per motion as wave loads, summed exactly. Runs
are of 100 s, with outputs every second. A full 6 x 6 added mass does not fit the ten inertia parameters
of a body in the peers, so all engines get the same entrained water. It is a mass of A33 without weight
at the hull's centre of mass, with the moments A44, A55, A55 about it.

- seacrane: as installed, steps with projection.
- Pinocchio: tree of 20 coordinates without quaternions, loops closed by two point constraints with Baumgarte
  at 10 1/s, `constraintDynamics` without regularisation; in C++, on seacrane's own integrators: the same
  tableaus, error control, scales, dense output. Gains of 5 and 20 1/s change little; not tried: its `lcaba`.
- MuJoCo: the same tree, hinges and slides, loops closed by soft `connect` constraints of the highest
  impedance (0.9999), own integrators, loads by a C++ callback. "loops" is the time constant of `solref`.
  `implicitfast` takes the callback's controllers explicitly and is unstable here at 0.01 s.
- NumPy/SciPy: the index-1 form of `tests/reference`, `solve_ivp`, projected every second.
- Exudyn: nine rigid bodies with Euler parameters (the hull with Tait-Bryan angles) and its own joints,
  spring-dampers and distance constraint; the version without range checks, modified Newton iterations, sparse
  solver. Waves, water and controllers are symbolic user functions, which Exudyn evaluates in C++: no Python
  runs in the loop, and they take roughly a fifth of its time (sampled). Its explicit methods refuse
  algebraic equations, so what is left are methods of order 2: the trapezoidal rule on index 2, generalised
  alpha. Its evaluations are Newton iterations. Other linear solvers, full Newton iterations, a Jacobian every
  step and rotation vectors were slower or equal here. In the last 20 s errors grow some 300-fold, in
  Pinocchio alike.

Times are CPU times of one thread, best of several runs, outputs included (NumPy and Exudyn: one run). The
C++ drivers are compiled with seacrane's flags (-O3 -fno-math-errno), Pinocchio from its headers; MuJoCo's and
Exudyn's libraries are the wheels'.
"""


def cheapest(points: list[Point], engine: str, level: float) -> Point | None:
    """The quickest run of an engine within a payload error."""
    passing = [p for p in points if p.engine == engine and p.payload <= level]
    return min(passing, key=lambda p: p.cpu, default=None)


def ratios(points: list[Point]) -> Section:
    """Per payload error: the quickest setting of each engine, over the quickest of seacrane."""
    rows: list[list[object]] = []
    for level in LEVELS:
        own = min(p.cpu for p in points if p.engine.startswith("seacrane") and p.payload <= level)
        for engine in MARKS:
            best = cheapest(points, engine, level)
            if best is None:
                rows.append([f"{level:g} m", engine, "no setting reaches it", None, None])
            else:
                label = f"{best.method}, {best.setting}"
                rows.append([f"{level:g} m", engine, label, 1e3 * best.cpu, best.cpu / own])
    return Section(
        title="Quickest setting within a payload error",
        text="Among the settings below; at loose tolerances single errors are partly luck, see the diagram.",
        head=["payload error at most", "engine", "setting", "CPU, ms", "over the quickest of seacrane"],
        rows=rows,
        folder=RESULTS,
    )


def table(points: list[Point], uncertainty: float) -> Section:
    """All runs."""
    rows = [
        [
            p.engine,
            p.method,
            p.setting,
            1e3 * p.cpu,
            p.evaluations,
            1e6 * p.cpu / max(p.evaluations, 1),
            p.payload,
            p.roll,
        ]
        for p in points
    ]
    return Section(
        title="All runs",
        text=(
            "Errors: largest difference over all outputs from seacrane redundant, dop853, rtol 1e-12; the "
            f"recursive form with verner76 at 1e-12 differs from it by {uncertainty:.1e} m."
        ),
        head=["engine", "method", "setting", "CPU, ms", "evaluations", "us per evaluation, all in",
              "payload error, m", "roll error, rad"],
        rows=rows,
        folder=RESULTS,
    )  # fmt: skip


def figure(points: list[Point], path: Path) -> None:
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


def measure(drivers: Path, python: str, repeats: int) -> tuple[list[Point], float]:
    """All points, and the reference's uncertainty in the payload's position, m."""
    scene = ten_body_scene()
    _, _, payload, roll = own_run(scene, repeats=1, formulation="redundant", integrator="dop853", rtol=1e-12)
    _, _, other, _ = own_run(scene, repeats=1, formulation="recursive", integrator="verner76", rtol=1e-12)
    reference = Reference(payload, roll)
    points = []
    for source in (
        seacrane_points(scene, reference, repeats),
        peer_points(scene, reference, drivers, python, repeats),
        numpy_points(scene, reference),
    ):
        for point in source:
            print(point, flush=True)
            points.append(point)
    return points, float(np.max(np.abs(other - payload)))


def absolute(path: str) -> str:
    """The same path from any working folder."""
    return str(Path(path).absolute())


def main() -> int:
    """Build, measure, write; returns the exit status."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    # Not resolved: an environment's Python is a link, and another program where it points to.
    parser.add_argument("--peers", required=True, type=absolute, help="Python that has the peers installed")
    parser.add_argument("--publish", action="store_true", help="write into benchmarks/peers")
    parser.add_argument("--repeats", type=int, default=5, help="equal runs per setting, default 5")
    parser.add_argument("--drivers", type=Path, help="folder of drivers that are compiled already")
    options = parser.parse_args()
    if options.repeats < 1:
        parser.error(f"--repeats is {options.repeats}; give at least 1")
    folder = HERE if options.publish else HERE.parents[1] / "out" / "bench-peers"
    folder.mkdir(parents=True, exist_ok=True)
    drivers = options.drivers and options.drivers.resolve()
    if drivers is None:
        drivers = HERE.parents[1] / "out" / "bench-peers" / "drivers"
        subprocess.run([HERE / "build_drivers.sh", options.peers, drivers], check=True)
    points, uncertainty = measure(drivers, options.peers, options.repeats)
    figure(points, folder / PICTURE)
    picture = f"![Payload error over CPU time, per engine]({PICTURE})\n"
    together = batches(drivers, options.peers, repeats=min(options.repeats, 3))
    in_a_row = loops_section(options.peers, repeats=min(options.repeats, 3))
    shown, last = (ratios(points), together, in_a_row), table(points, uncertainty)
    for section in (*shown, last):
        section.save(folder / "results")
    sections = (*(section.marked() for section in shown), last.marked(shown=False))
    parts = [INTRODUCTION, picture, *(f"{section}\n" for section in sections)]
    with atomic_write(folder / "README.md") as draft:
        draft.write_text("\n".join(parts), encoding="utf-8")
    if options.publish:
        documents.fill()
    print(f"written to {folder}", file=sys.stderr)
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
