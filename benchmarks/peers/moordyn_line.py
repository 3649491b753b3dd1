"""A line whose upper end heaves, in MoorDyn; run where `moordyn` is installed: ``moordyn_line.py [FILE]``.

Writes time and the tensions of the first and the last segment to FILE, by default
``references/heavy_line.csv``, which benchmarks/compared/heavy_lines.py compares with. The line has the
same nodes, EA, mass and damping, and no water.
"""

from __future__ import annotations

import csv
import sys
import tempfile
from pathlib import Path

import moordyn
import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "tests" / "scenes"))

from heavy_line_scenes import EA, LENGTH, MASS, RATIO, heave  # noqa: E402

RESULT = HERE / "references" / "heavy_line.csv"
HEAD = ("time, s", "fixed end, N", "moving end, N")
SEGMENTS, T_END, EVERY = 20, 24.0, 0.1  # -, s, s
COUPLING, INNER = (
    0.005,
    2e-4,
)  # s: MoorDyn moves an end in straight lines within the first, and steps by the other
INPUT = f"""heavy line
--- LINE TYPES
TypeName Diam Mass/m EA BA EI Cd Ca CdAx CaAx
(name) (m) (kg/m) (N) (N-s) (N-m^2) (-) (-) (-) (-)
wire 0.001 {MASS} {EA} {2.0 * RATIO * np.sqrt(EA * MASS) * LENGTH / SEGMENTS} 0 0 0 0 0
--- POINTS
ID Type X Y Z Mass Volume CdA CA
(#) (-) (m) (m) (m) (kg) (m3) (m2) (-)
1 Fixed 0 0 -300 0 0 0 0
2 Coupled 800 0 0 0 0 0 0
--- LINES
ID LineType AttachA AttachB UnstrLen NumSegs Outputs
(#) (name) (#) (#) (m) (-) (-)
1 wire 1 2 {LENGTH} {SEGMENTS} -
--- OPTIONS
0 writeLog
{INNER} dtM
RK4 tScheme
0 WtrDnsty
9.80665 gravity
5000 WtrDpth
1.0 dtIC
3000 TmaxIC
1e-5 threshIC
--- end
"""


def main(file: Path = RESULT) -> None:
    """Run and write."""
    with tempfile.TemporaryDirectory() as folder:
        deck = Path(folder) / "line.txt"
        deck.write_text(INPUT, encoding="utf-8")
        system = moordyn.Create(str(deck))
        moordyn.Init(system, [800.0, 0.0, 0.0], [0.0, 0.0, 0.0])
        line = moordyn.GetLine(system, 1)

        def tensions() -> list[float]:
            return [float(np.linalg.norm(moordyn.GetLineNodeTen(line, i))) for i in (0, SEGMENTS)]

        curve, rows = heave(T_END), [[0.0, *tensions()]]
        for i in range(round(T_END / COUPLING)):
            value, rate, _ = curve.evaluate([i * COUPLING])[0]
            moordyn.Step(system, [800.0, 0.0, value], [0.0, 0.0, rate], i * COUPLING, COUPLING)
            if (i + 1) % round(EVERY / COUPLING) == 0:
                rows.append([(i + 1) * COUPLING, *tensions()])
        moordyn.Close(system)
    with file.open("w", newline="", encoding="utf-8") as out:
        csv.writer(out, lineterminator="\n").writerows([HEAD, *([f"{x:.10g}" for x in row] for row in rows)])


if __name__ == "__main__":
    main(*map(Path, sys.argv[1:]))
