"""The stability atlas: the quick one must keep every promise, and its parts must notice what goes wrong."""

from __future__ import annotations

import csv
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from seacrane import Method
from seacrane.accuracy import row as rows
from seacrane.accuracy.quantities import ErrorMeasures
from seacrane.accuracy.row import Row
from stability_atlas import committed, stability_atlas
from stability_atlas.__main__ import main
from stability_atlas.axes import AXES
from stability_atlas.methods import DEFAULT, QUICK


def rows_of(folder: Path, name: str = "extremes.csv") -> list[dict[str, str]]:
    with (folder / name).open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


@pytest.mark.slow("an atlas")
def test_the_quick_atlas_keeps_every_promise_predicts_step_limits_and_goes_on(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert main(["--out", str(tmp_path), "--quick"]) == 0
    found = rows_of(tmp_path)
    assert {row["axis"] for row in found} == set(AXES)
    assert not [row for row in found if row["verdict"] in rows.FORBIDDEN]
    for axis in AXES.values():
        for value in axis.quick:
            methods = [row for row in found if (row["axis"], float(row["value"])) == (axis.name, value)]
            assert len(methods) == len(QUICK)
    limits = rows_of(tmp_path, "extremes_step.csv")
    assert len(limits) == 8
    for row in limits:
        assert float(row["found"]) == pytest.approx(float(row["predicted"]), rel=0.02)

    def fail(groups: Any, jobs: int) -> Any:
        raise AssertionError(f"{len(groups)} groups are run again")

    monkeypatch.setattr("stability_atlas.study.run_all", fail)
    # A line that an interrupted call was writing is left out.
    with (tmp_path / "extremes_rows.jsonl").open("a") as file:
        file.write('{"axis": "pay\n')
    again = stability_atlas(out=tmp_path, quick=True, axes=["payload", "heel"], figures=False, progress=False)
    assert {row.case["axis"] for row in again.rows} == {"payload", "heel"}
    assert not again.broken


def known(error: float, uncertainty: float = 0.0) -> dict[str, Any]:
    """Fields of a row whose error and uncertainty are these shares of the motion."""
    measures = ErrorMeasures(largest=2.0 * error, rms=error, std=error)
    return {"errors": {"points": measures}, "uncertainty": {"points": 2.0 * uncertainty},
            "motion": {"points": 2.0}}  # fmt: skip


GOOD = Row(case={"axis": "payload", "value": 10.0}, method=DEFAULT, verdict=rows.COMPLETED,
           left=1e-15, energy=1e-9, **known(1e-9))  # fmt: skip
DRIVEN: dict[str, Any] = {"axis": "driven-dead-centre", "value": -0.1}
OPEN = "joint or driver 'hinge': is open by 0.3 m or rad and projection does not close it"
STOPPED = replace(GOOD, case=DRIVEN, verdict=rows.STOPPED, message=OPEN)
HEEL: dict[str, Any] = {"axis": "heel", "value": 10.0}
RK4 = Method(integrator="rk4", dt=0.02)


@pytest.mark.parametrize(
    ("row", "words"),
    [
        (replace(GOOD, left=1e-6), "constraint error"),
        (replace(GOOD, energy=1e-3), "energy error"),
        (replace(GOOD, **known(0.9, 1e-9)), "of the motion"),
        (replace(GOOD, verdict=rows.SLOW, message="granted 20 s"), "slow instead of completed: granted 20 s"),
        (replace(STOPPED, verdict=rows.COMPLETED), "completed instead of stopped"),
        *((replace(GOOD, case=HEEL, method=RK4, verdict=bad, message="x"), bad) for bad in rows.FORBIDDEN),
    ],
)
def test_a_broken_promise_is_told(row: Row, words: str) -> None:
    """An error against a reference that is not known breaks none."""
    assert committed.broken([GOOD, STOPPED, replace(GOOD, **known(0.9, 0.8))], list(AXES)) == []
    (text,) = committed.broken([row], list(AXES))
    assert words in text
