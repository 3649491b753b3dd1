"""Rows of four-bars in three engines: ``python benchmarks/peers/loops.py --peers out/peers/bin/python``.

Prints the table; with ``--publish`` it is written to ``benchmarks/peers/results``, on a machine that does
nothing else.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
sys.path.extend(map(str, (Path(__file__).resolve().parents[2] / "tests").glob("*/")))
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests"))

import numpy as np
from measure.exponent import exponent
from measure.section import Section
from measure.timing import best_seconds, evaluation_ns, timed_run
from reference_problems import four_bars

HERE = Path(__file__).resolve().parent
LOOPS = (1, 5, 10, 20, 40, 80)
T_END = 1.0  # s, before the first flat position
LARGE = 10  # loops, from which on the growth is taken
NEWTON = "1e-8"
STEP = 0.001  # s, of the peers
RTOL = 1e-6
TEXT = f"""Loops in a row, rods of 1 m and 1 kg, upright at the start ([A02](https://www.iftomm-multibody.org/benchmark)):
one evaluation, compiling or building the model, and {T_END:g} s with the error of the first rod's top against
elliptic functions. "Once" has joints that hold each motion once; "hinges" has hinges throughout, three rows
too many in each loop. seacrane: default integrator at rtol {RTOL:g}. MuJoCo: `mj_forward`, hinges and soft
`connect` constraints, `RK4` at {STEP:g} s. Exudyn: rigid bodies with joints that hold each motion once,
trapezoidal rule on index 2 at {STEP:g} s; its evaluation is a Newton iteration, all in. The exponent is of
one evaluation from {LARGE} loops on. CPU time of one thread, the best of several."""


class Row(NamedTuple):
    """One engine on so many loops: s of an evaluation, of compiling and of the run, and its error, m."""

    loops: int
    joints: str
    engine: str
    evaluation: float
    compiled: float
    run: float
    error: float


def error(loops: int, x: float, z: float) -> float:
    """Of the first rod's top at the end, m."""
    return float(np.hypot(*(np.array([x, z]) - four_bars.top(loops, [T_END])[0])))


def own(loops: int, planar: bool, formulation: str, repeats: int) -> tuple[float, float, float, float]:
    """Evaluation, compile and run, s, and the error, m."""
    scenes = [four_bars.scene(loops, planar=planar) for _ in range(3 * repeats)]
    scene = scenes[-1].copy()
    compiled = best_seconds(lambda: scenes.pop().compile(), repeats=len(scenes))  # each keeps its model
    model = scene.compile()
    count = max(5, 4000 // loops)
    evaluation = 1e-9 * evaluation_ns(model, repeats=3 * repeats, count=count, formulation=formulation)
    run = timed_run(
        scene, model=model, repeats=repeats, t_end=T_END, dt_out=T_END, channels=["position"],
        formulation=formulation, rtol=RTOL,
    )  # fmt: skip
    x, _, z = 2.0 * run.channels["position"][-1, 0]
    return evaluation, compiled, run.cpu, error(loops, x, z)


def peer(python: str, engine: str, loops: int, repeats: int) -> tuple[float, float, float, float]:
    """The same of another engine, the best of each."""
    command = [python, str(HERE / "four_bars_run.py"), engine, str(loops), repr(STEP), NEWTON]
    runs = []
    for _ in range(repeats):
        done = subprocess.run(command, check=True, capture_output=True, text=True)
        runs.append([float(word) for word in done.stdout.splitlines()[-1].split()])
    built, evaluation, spent, x, z = np.min(runs, axis=0)[:3].tolist() + runs[0][3:]
    return evaluation, built, spent, error(loops, x, z)


def rows(python: str, repeats: int) -> Iterator[Row]:
    """Of each number of loops, joints and engine."""
    for loops in LOOPS:
        for joints, planar in (("once", False), ("hinges", True)):
            for formulation in ("recursive", "redundant"):
                found = own(loops, planar, formulation, repeats)
                yield Row(loops, joints, f"seacrane {formulation}", *found)
        yield Row(loops, "hinges, soft ends", "MuJoCo", *peer(python, "mujoco", loops, repeats))
        yield Row(loops, "once", "Exudyn", *peer(python, "exudyn", loops, repeats))


def grown(measured: list[Row], last: Row) -> float | None:
    """The exponent of one evaluation, beside the longest row of its kind."""
    if last.loops != LOOPS[-1]:
        return None
    alike = [row for row in measured if (row.joints, row.engine) == (last.joints, last.engine)]
    return exponent([row.loops for row in alike], [row.evaluation for row in alike], smallest=LARGE)


def loops_section(python: str, repeats: int) -> Section:
    """The table, with how one evaluation grows."""
    measured = []
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for row in rows(python, repeats):
            print(row, flush=True)
            measured.append(row)
    return Section(
        title="Loops in a row",
        text=TEXT.replace("\n", " "),
        head=["loops", "joints", "engine", "one evaluation, us", "compile, ms", f"{T_END:g} s, ms",
              "error, m", f"exponent from {LARGE} on"],
        rows=[
            [row.loops, row.joints, row.engine, 1e6 * row.evaluation, 1e3 * row.compiled, 1e3 * row.run,
             row.error, grown(measured, row)]
            for row in measured
        ],
        folder="benchmarks/peers/results",
    )  # fmt: skip


def main() -> int:
    """Measure and print; returns the exit status."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--peers", required=True, help="Python that has the peers installed")
    parser.add_argument("--publish", action="store_true", help="write into benchmarks/peers/results")
    parser.add_argument("--repeats", type=int, default=5, help="equal runs of each, default 5")
    options = parser.parse_args()
    section = loops_section(str(Path(options.peers).absolute()), options.repeats)
    print(section.markdown())
    if options.publish:
        section.save(HERE / "results")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
