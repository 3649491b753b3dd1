"""The table of validation: every row within its bound and as its source says; a sample is computed again."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parents[2]
ROUNDING = 1e-11  # differences below it depend on the compiler


@pytest.fixture
def published(modules: Any) -> dict[str, dict[str, str]]:
    """Rows of the file, by what was compared with what."""
    files = modules("compared.files")
    rows = files.records(files.RESULTS / "validation.csv")
    return {f"{row['compared']}; {row['with']}": row for row in rows}


def test_every_row_is_within_its_bound(published: dict[str, dict[str, str]]) -> None:
    rows = published.values()
    assert len(rows) > 60
    assert [row["test"] for row in rows if not (ROOT / row["test"].strip("`")).is_file()] == []
    bounded = [row for row in rows if row["bound"]]
    assert len(bounded) > 20
    for row in bounded:
        assert number(row["largest difference"]) <= number(row["bound"]), row["compared"]


def number(text: str) -> float:
    """A cell's number; of per cent, the share."""
    value = float(text.split()[0])
    return value / 100.0 if text.endswith("%") else value


FROM_FILES = ("peers", "linear_model", "wires")


def test_rows_from_other_files_are_as_these_say(modules: Any, published: dict[str, dict[str, str]]) -> None:
    for name in FROM_FILES:
        for row in getattr(modules("compared.files"), name)():
            assert tuple(published[f"{row.compared}; {row.reference}"].values()) == row.cells


SAMPLE: dict[str, dict[str, Any]] = {
    "files.wave_sum": {}, "engine.jacobians": {}, "engine.going_on": {}, "engine.momentum": {},
    "engine.formulations": {"names": ("case 2",)}, "engine.energy": {"names": ("heavy top",)},
    "engine.books": {"names": ("case 2",)}, "crane.statics": {}, "crane.masses": {}, "sea.spectrum": {},
    "sea.drift": {}, "hull.hydrostatics": {}, "roll_and_mooring.roll_damping": {},
    "roll_and_mooring.moorings": {}, "events.bouncing_ball": {}, "reeving.closed_forms": {},
    "reeving.exudyn": {},
}  # fmt: skip


@pytest.mark.parametrize("name", SAMPLE)
@pytest.mark.filterwarnings("ignore::UserWarning")
def test_a_sample_is_as_published(name: str, modules: Any, published: dict[str, dict[str, str]]) -> None:
    """Within the bound; the same number where it is not made of rounding."""
    module, function = name.split(".")
    for row in getattr(modules(f"compared.{module}"), function)(**SAMPLE[name]):
        told = number(published[f"{row.compared}; {row.reference}"]["largest difference"])
        assert row.difference <= row.limit
        if told > ROUNDING and row.difference > ROUNDING and row.limit > 1e-6:
            assert row.difference == pytest.approx(told, rel=0.1)


def test_the_facts_of_the_readme_are_those_of_the_files(modules: Any) -> None:
    """And of one engine."""
    facts, table, sources = modules("facts"), modules("measure.table"), modules("measure.sources")
    head, rows = table.read(facts.SECTION.path)
    assert tuple(head) == facts.HEAD
    assert [tuple(row) for row in rows] == facts.facts()
    speed = sources.measured(facts.RESULTS / f"{facts.SPEED}.csv")
    assert sources.measured(facts.SECTION.path)["engine"] == speed["engine"]
