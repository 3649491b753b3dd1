"""The table of the README, a few lines out of the files of measurements: ``python benchmarks/facts.py``.

Writes ``results/facts.csv`` and fills the documents; so do ``run.py`` and ``validation.py --publish``.
"""

from __future__ import annotations

from pathlib import Path

import documents
from measure.table import read, write

BENCHMARKS = Path(__file__).resolve().parent
RESULTS = BENCHMARKS / "results"
PEERS = BENCHMARKS / "peers" / "results" / "quickest-setting-within-a-payload-error.csv"
SOURCES = (
    RESULTS / "speed-of-100-s.csv", RESULTS / "three-hours-of-case-2.csv", RESULTS / "validation.csv",
    RESULTS / "three-dimensional-pages.csv", PEERS,
)  # fmt: skip
HEAD = ("measured", "value")
ENGINES = {"seacrane recursive": "seacrane", "Pinocchio": "Pinocchio", "MuJoCo": "MuJoCo",
           "NumPy/SciPy": "NumPy and SciPy"}  # fmt: skip
VALIDATED = {
    "case 2, 100 s: places": "case 2 in two formulations that share no solver, 100 s",
    "case 2 with fast references, 4 s: position": "case 2, fast references, in an independent program, 4 s",
    "Andrews' squeezer: seven angles, 0.03 s; its equations": "Andrews' squeezer, seven angles, with SciPy",
    "case 2, 100 s, `rtol` 1e-8: gap": "joints of case 2 over 100 s: largest gap",
    "case 2, 100 s, `rtol` 1e-8: energy": "energy balance of case 2 over the work done",
}


def facts() -> list[tuple[str, str]]:
    """Each line and its value, as the files hold it."""
    return [*_cost(), *_agreement(), _page()]


def _cost() -> list[tuple[str, str]]:
    speed = _row(RESULTS / "speed-of-100-s.csv", scene="case2")
    storm = _row(RESULTS / "three-hours-of-case-2.csv", integrator="verner65")
    within = "0.0001 m"
    quickest = ", ".join(
        f"{name} {_row(PEERS, engine=engine, **{'payload error at most': within})['CPU, ms']} ms"
        for engine, name in ENGINES.items()
    )
    times = f"{speed['CPU, ms']} ms, {speed['times real time (CPU)']} times real time"
    return [
        ("100 s of case 2, default setting, CPU", times),
        (f"3 h of case 2, `verner65` at {storm['rtol']}, CPU", f"{storm['CPU, s']} s"),
        (f"the same crane, payload within {within}, CPU", quickest),
    ]


def _agreement() -> list[tuple[str, str]]:
    head, rows = read(RESULTS / "validation.csv")
    compared, other, value = (head.index(name) for name in ("compared", "with", "largest difference"))
    found = []
    for start, words in VALIDATED.items():
        (row,) = [one for one in rows if f"{one[compared]}; {one[other]}".startswith(start)]
        found.append((words, row[value]))
    return found


def _page() -> tuple[str, str]:
    page = _row(RESULTS / "three-dimensional-pages.csv", run="60 s")
    return "three-dimensional page of a lift of 60 s, one file", f"{page['page, MB']} MB"


def _row(path: Path, **wanted: str) -> dict[str, str]:
    """The first row that holds these cells."""
    head, rows = read(path)
    every = (dict(zip(head, row, strict=True)) for row in rows)
    return next(row for row in every if wanted.items() <= row.items())


def publish() -> None:
    """Write the file and fill the documents."""
    write(RESULTS / "facts.csv", HEAD, facts(), of=SOURCES)
    documents.fill()


if __name__ == "__main__":
    publish()
