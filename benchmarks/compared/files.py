"""Comparisons that other measurements wrote: rows from their files."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from measure.table import read

from .row import Row

BENCHMARKS = Path(__file__).resolve().parents[1]
RESULTS = BENCHMARKS / "results"
PEERS = ("Pinocchio", "MuJoCo", "Exudyn", "NumPy/SciPy")
OWN = "redundant form, `dop853` at 1e-12"
SELF_CHECKS = {
    "damping_from_forces": "damping from the far field of the wave forces (Haskind)",
    "kramers_kronig": "added mass at infinite frequency from the damping (Kramers-Kronig)",
    "memory_motion": "motions with the fitted memory",
}


def records(path: Path) -> list[dict[str, str]]:
    """Rows of a CSV file by column."""
    head, rows = read(path)
    return [dict(zip(head, row, strict=True)) for row in rows]


def mechanisms() -> Iterator[Row]:
    """Problems with published or independent solutions: the worse of both formulations."""
    yield from _problems("reference-problems-tight.csv", "Mechanisms", "multibody/test_reference_problems.py")


def ships() -> Iterator[Row]:
    """A vessel against its linear equation."""
    yield from _problems(
        "reference-problems-ships.csv", "Vessel in waves", "multibody/test_reference_problems_sea.py"
    )


def _problems(file: str, subject: str, test: str) -> Iterator[Row]:
    worst: dict[tuple[str, str, str], tuple[float, str]] = {}
    for row in records(RESULTS / file):
        value, _, unit = row["largest difference"].partition(" ")
        key = (row["problem"], row["compared"], row["source"])
        worst[key] = max(worst.get(key, (0.0, unit)), (float(value), unit))
    for (problem, compared, source), (value, unit) in worst.items():
        yield Row(
            subject=subject, compared=f"{problem}: {compared}", reference=source, difference=value, unit=unit,
            limit=None, test=test,
        )  # fmt: skip


def peers() -> Iterator[Row]:
    """The crane in other engines: the nearest of their runs."""
    every = records(BENCHMARKS / "peers" / "results" / "all-runs.csv")
    for engine in PEERS:
        nearest = min(float(row["payload error, m"]) for row in every if row["engine"] == engine)
        yield Row(
            subject="Crane on a vessel", compared=f"payload's place over the run, {OWN}",
            reference=f"the same crane in {engine}, its nearest setting", difference=nearest, unit="m",
            limit=None, test="project/test_validation.py",
        )  # fmt: skip


def linear_model() -> Iterator[Row]:
    """Runs in the lowest sea against the linear model of the whole scene."""
    row = records(RESULTS / "linear-model-against-runs.csv")[0]
    for motion in ("heave", "pitch", "payload x"):
        yield Row(
            subject="Vessel in waves",
            compared=f"case 2 in a sea of {row['Hs, m']} m: {motion}, share of its standard deviation",
            reference="linear model, frequency domain", difference=float(row[motion]) / 100.0, unit="",
            limit=None, test="vessel/test_frequency_domain.py",
        )  # fmt: skip


def wave_sum() -> Iterator[Row]:
    """The table of wave loads against the sum."""
    rows = records(RESULTS / "trade-of-case-2-physics.csv")
    (row,) = [one for one in rows if one["changed"].startswith("waves summed exactly")]
    yield Row(
        subject="Vessel in waves", compared="payload of case 2 over 100 s, wave loads from the table",
        reference="wave loads summed at every evaluation", difference=float(row["payload, m"]), unit="m",
        limit=None, test="sea/test_sea.py",
    )  # fmt: skip


def database() -> Iterator[Row]:
    """What exact hydrodynamics relate, in the shipped database: the worst of the six motions."""
    every = records(RESULTS / "self-check-of-the-shipped-database.csv")
    rows = {row["check"].strip("`"): row for row in every}
    for check, words in SELF_CHECKS.items():
        values = [float(row["value"]) for name, row in rows.items() if name.startswith(f"{check}_")]
        yield Row(
            subject="Hydrodynamics", compared=f"shipped database: {words}", reference="the database itself",
            difference=max(values), unit="", limit=None, test="hydro/test_hydro_check.py",
        )  # fmt: skip


def wires() -> Iterator[Row]:
    """A wire that goes slack and snatches, at the tightest setting."""
    rows = records(RESULTS / "a-wire-that-goes-slack.csv")
    row = next(one for one in rows if one["setting"] == "rtol 1e-10")
    for what, column in (("time of going slack", "slack, s"), ("time of the snatch", "snatch, s"),
                         ("path until 2.2 s", "path, m")):  # fmt: skip
        yield Row(
            subject="Wires, stops, events", compared=f"ball on a wire: {what}", reference="SciPy with events",
            difference=float(row[column]), unit=column.rpartition(" ")[2], limit=None,
            test="run/test_events.py",
        )  # fmt: skip
