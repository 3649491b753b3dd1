"""Comparisons that other measurements wrote, and problems and checks that the package or its tests hold."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
from measure.table import read

from seacrane import cases, simulate
from seacrane.hydro import shipped_database

from .row import Row

BENCHMARKS = Path(__file__).resolve().parents[1]
RESULTS = BENCHMARKS / "results"
REFERENCES = BENCHMARKS / "peers" / "references"  # what a peer recorded
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
    from reference_problems.problems import mechanisms

    yield from _problems(mechanisms(), "Mechanisms", "multibody/test_reference_problems.py")


def ships() -> Iterator[Row]:
    """A vessel against its linear equation."""
    from reference_problems.problems import ships

    yield from _problems(ships(), "Vessel in waves", "multibody/test_reference_problems_sea.py")


def _problems(comparisons: Iterable[Any], subject: str, test: str) -> Iterator[Row]:
    worst: dict[tuple[str, ...], tuple[float, str]] = {}
    for one in comparisons:
        key = (one.problem, one.quantity, one.source)
        found = (float(f"{one.difference:.1e}"), one.unit)
        worst[key] = max(worst.get(key, (0.0, one.unit)), found)
    for (problem, compared, source), (difference, unit) in worst.items():
        yield Row(
            subject=subject, compared=f"{problem}: {compared}", reference=source, difference=difference,
            unit=unit, limit=None, test=test,
        )  # fmt: skip


def peers() -> Iterator[Row]:
    """The crane in other engines: the nearest of their runs."""
    for row in records(RESULTS / "quickest-setting-within-a-payload-error.csv"):
        if row["payload error at most"] == "its nearest" and not row["engine"].startswith("seacrane"):
            yield Row(
                subject="Crane on a vessel", compared=f"payload's place over the run, {OWN}",
                reference=f"the same crane in {row['engine']}, its nearest setting",
                difference=float(row["payload error, m"]), unit="m", limit=None,
                test="project/test_validation.py",
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
    found = [
        simulate(
            cases.case2(evaluation=evaluation), 100.0, dt_out=1.0, integrator="dop853", rtol=1e-10,
            channels=["position"],
        ).select("position", body="payload")
        for evaluation in ("table", "exact")
    ]  # fmt: skip
    yield Row(
        subject="Vessel in waves", compared="payload of case 2 over 100 s, wave loads from the table",
        reference="wave loads summed at every evaluation",
        difference=float(np.linalg.norm(found[0] - found[1], axis=1).max()), unit="m", limit=1e-7,
        test="sea/test_sea.py",
    )  # fmt: skip


def database() -> Iterator[Row]:
    """What exact hydrodynamics relate, in the shipped database: the worst of the six motions."""
    rows = shipped_database().check()
    for check, words in SELF_CHECKS.items():
        values = [float(row.value) for row in rows if row.check.startswith(f"{check}_")]
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
