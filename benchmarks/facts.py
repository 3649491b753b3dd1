"""The table of the README, a few lines out of the tables of one engine."""

from __future__ import annotations

from collections.abc import Iterator

from measure.section import RESULTS, Section
from measure.sources import measured
from measure.table import read

SPEED, HOURS, VALIDATION, PAGES, PEERS = (
    "speed-of-100-s", "three-hours-of-case-2", "validation", "three-dimensional-pages",
    "quickest-setting-within-a-payload-error",
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
    """Each line and its value, as the tables hold it; of tables that another engine measured, none."""
    lines = [(SPEED, _speed), (HOURS, _hours), (PEERS, _peers), (VALIDATION, _agreement), (PAGES, _page)]
    return [line for name, told in lines if _engine(name) == _engine(SPEED) for line in told()]


def _engine(name: str) -> str | None:
    return (measured(RESULTS / f"{name}.csv") or {}).get("engine")


def _speed() -> Iterator[tuple[str, str]]:
    row = _row(SPEED, scene="case2", formulation="recursive")
    told = f"{row['CPU, ms']} ms, {row['times real time']} times real time"
    yield "100 s of case 2, default setting, CPU", told


def _hours() -> Iterator[tuple[str, str]]:
    row = _row(HOURS, integrator="verner65")
    yield f"3 h of case 2, `verner65` at {row['rtol']}, CPU", f"{row['CPU, s']} s"


def _peers() -> Iterator[tuple[str, str]]:
    within = "0.0001 m"
    rows = {
        name: _row(PEERS, engine=engine, **{"payload error at most": within})
        for engine, name in ENGINES.items()
    }
    told = ", ".join(f"{name} {row['CPU, ms']} ms" for name, row in rows.items())
    yield f"the same crane, payload within {within}, CPU", told


def _agreement() -> Iterator[tuple[str, str]]:
    head, rows = read(RESULTS / f"{VALIDATION}.csv")
    compared, other, value = (head.index(name) for name in ("compared", "with", "largest difference"))
    for start, words in VALIDATED.items():
        (row,) = [one for one in rows if f"{one[compared]}; {one[other]}".startswith(start)]
        yield words, row[value]


def _page() -> Iterator[tuple[str, str]]:
    row = _row(PAGES, run="60 s")
    yield "three-dimensional page of a lift of 60 s, one file", f"{row['page, MB']} MB"


def _row(name: str, **wanted: str) -> dict[str, str]:
    """The first row that holds these cells."""
    head, rows = read(RESULTS / f"{name}.csv")
    every = (dict(zip(head, row, strict=True)) for row in rows)
    return next(row for row in every if wanted.items() <= row.items())


SECTION = Section(
    title="Facts",
    text="What the README shows: lines of tables above that one engine measured.",
    head=HEAD,
    rows=facts,
    sources=tuple(f"benchmarks/results/{name}.csv" for name in (SPEED, HOURS, VALIDATION, PAGES, PEERS)),
    of=(SPEED,),
)
