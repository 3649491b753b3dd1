"""Heavy lines: their cost, and themselves against MoorDyn and MoorPy.

``python benchmarks/measure/heavy_lines.py [--publish] [--cost]``; with ``--cost`` the cost alone.

Else it needs both programs (``pip install moorpy moordyn``). A line hangs between a fixed point and one that
moves up and down; each program has the same nodes, EA, mass, damping and no water. Writes
``heavy-lines-cost.csv``, ``heavy-lines-against-moordyn.csv`` and ``heavy-lines-against-moorpy.csv`` to
``out/bench/results``, with ``--publish`` to ``benchmarks/results``.
"""

from __future__ import annotations

import argparse
import contextlib
import os
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "benchmarks"))
sys.path.extend(map(str, [ROOT / "tests", *(ROOT / "tests").glob("*/")]))

from heavy_line_scenes import EA, LENGTH, MASS, RATIO, hanging, heave, heaving, weights_of_shape  # noqa: E402

from measure.table import write  # noqa: E402
from seacrane import simulate  # noqa: E402
from seacrane.analysis import fastest_mode  # noqa: E402

Array = NDArray[np.float64]
SEGMENTS = 20
T_END, DT_OUT = 24.0, 0.02  # s
COUPLING = (0.02, 0.01, 0.005)  # s: MoorDyn moves an end in straight lines within such a step
INNER = 2e-4  # s, of MoorDyn's own Runge-Kutta steps
INPUT = """heavy line
--- LINE TYPES
TypeName Diam Mass/m EA BA EI Cd Ca CdAx CaAx
(name) (m) (kg/m) (N) (N-s) (N-m^2) (-) (-) (-) (-)
wire 0.001 {mass} {stiffness} {damping} 0 0 0 0 0
--- POINTS
ID Type X Y Z Mass Volume CdA CA
(#) (-) (m) (m) (m) (kg) (m3) (m2) (-)
1 Fixed 0 0 -300 0 0 0 0
2 Coupled 800 0 0 0 0 0 0
--- LINES
ID LineType AttachA AttachB UnstrLen NumSegs Outputs
(#) (name) (#) (#) (m) (-) (-)
1 wire 1 2 {length} {segments} -
--- OPTIONS
0 writeLog
{inner} dtM
RK4 tScheme
0 WtrDnsty
9.80665 gravity
5000 WtrDpth
1.0 dtIC
3000 TmaxIC
1e-5 threshIC
--- end
"""


def moordyn(coupling: float) -> Array:
    """Tension of the first and the last segment, (n, 2), N."""
    import moordyn as program

    step = LENGTH / SEGMENTS
    text = INPUT.format(
        mass=MASS, stiffness=EA, length=LENGTH, segments=SEGMENTS, inner=INNER,
        damping=2.0 * RATIO * np.sqrt(EA * MASS) * step,
    )  # fmt: skip
    with tempfile.TemporaryDirectory() as folder, silence():
        path = Path(folder) / "line.txt"
        path.write_text(text)
        system = program.Create(str(path))
        program.Init(system, [800.0, 0.0, 0.0], [0.0, 0.0, 0.0])
        line = program.GetLine(system, 1)
        found = [ends(program, line)]
        for i in range(round(T_END / coupling)):
            value, rate, _ = heave(T_END).evaluate([i * coupling])[0]
            program.Step(system, [800.0, 0.0, value], [0.0, 0.0, rate], i * coupling, coupling)
            found.append(ends(program, line))
        program.Close(system)
    return np.array(found)[:: round(DT_OUT / coupling)]


def ends(program: object, line: object) -> list[float]:
    """Its tension at an end is that of the segment there."""
    at = (0, SEGMENTS)
    return [float(np.linalg.norm(program.GetLineNodeTen(line, i))) for i in at]  # type: ignore[attr-defined]


@contextlib.contextmanager
def silence() -> Iterator[None]:
    """Of a library that writes to the terminal."""
    kept = os.dup(1)
    with Path(os.devnull).open("w") as nowhere:
        os.dup2(nowhere.fileno(), 1)
        try:
            yield
        finally:
            os.dup2(kept, 1)
            os.close(kept)


def against_moordyn() -> Iterator[tuple[str, ...]]:
    """Largest differences as shares of the range of each tension, by MoorDyn's coupling step."""
    result = simulate(heaving(SEGMENTS, T_END), t_end=T_END, dt_out=DT_OUT, rtol=1e-8)
    own = result["line_tension"][:, [0, -1]]
    spread = np.ptp(own, axis=0)
    for coupling in COUPLING:
        apart = np.abs(moordyn(coupling) - own).max(axis=0) / spread
        yield f"{coupling:g}", *(f"{share:.2g}" for share in apart)


def against_moorpy() -> Iterator[tuple[str, ...]]:
    """H and V at the upper end of the closed catenary, and of chains of more and more segments."""
    from moorpy.Catenary import catenary

    # A negative CB: so far below the lower end is the seabed, m.
    level, upper = (abs(float(force)) for force in catenary(800, 300, 900, 1e9, 1000, CB=-1e4)[2:4])
    for count in (10, 20, 40, 80, 160):
        h, v = weights_of_shape(count)
        yield str(count), f"{level:.3f}", f"{upper:.3f}", f"{abs(h - level):.4g}", f"{abs(v - upper):.4g}"


def cost() -> Iterator[tuple[str, ...]]:
    """A load that is pushed aside on 1000 m of wire, 10 s: what segments, stretch and method make of it."""
    for count in (5, 10, 20, 40):
        for stretch in ("elastic", "quasi-static"):
            for integrator in ("dopri5", "cvode-bdf") if stretch == "elastic" else ("dopri5",):
                scene = hanging(
                    count, load=20e3, velocity=1.0, EA=2e8, length=1000.0, mass_per_length=12.0,
                    segment_rung=stretch,
                )  # fmt: skip
                mode = fastest_mode(scene.compile()) or 0.0
                result = simulate(scene, t_end=10.0, integrator=integrator, rtol=1e-4)
                place = np.hypot(*result.select("position", body="load")[-1, [0, 2]])
                told = (f"{mode:.3g}", stretch, integrator, str(result.stats["evaluations"]))
                yield str(count), *told, f"{place:.3f}"


def main() -> None:
    """Measure and write."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--publish", action="store_true", help="write into benchmarks/ instead of out/bench")
    parser.add_argument("--cost", action="store_true", help="nothing but the cost")
    given = parser.parse_args()
    publish = given.publish
    folder = ROOT / "benchmarks" / "results" if publish else ROOT / "out" / "bench" / "results"
    head = ("segments", "fastest mode, 1/s", "stretch", "method", "evaluations", "load from the top, m")
    write(folder / "heavy-lines-cost.csv", head, list(cost()))
    if given.cost:
        return
    head = ("segments", "H of MoorPy, N", "V of MoorPy, N", "error of H, N", "error of V, N")
    write(folder / "heavy-lines-against-moorpy.csv", head, list(against_moorpy()))
    head = ("coupling step, s", "fixed end", "moving end")
    write(folder / "heavy-lines-against-moordyn.csv", head, list(against_moordyn()))


if __name__ == "__main__":
    main()
