"""Pages about several runs: everything inside one page, true numbers, safe text, atomic writing."""

from __future__ import annotations

import base64
import re
from html import unescape
from pathlib import Path

import pytest
from test_result import crane_run

from seacrane import cases, simulate
from seacrane.answers.report import Study, study_report
from seacrane.pictures import Finding, save_sheet
from seacrane.pictures.plots import overview_sheet
from seacrane.result import Result

SCENE = {"counts": [("bodies", 10), ("joints", 11)], "dropped": [("waves <0.1 %>", [3, 4.5])]}
FINDING = Finding(finding="yaw reacts", number="0.1 deg/s", expected="changes", verdict="reproduced")


class Page:
    """The tables, pictures and words of a page, whose elements are closed."""

    def __init__(self, text: str) -> None:
        for tag in ("table", "tr", "td", "th", "p", "h2", "div"):
            assert len(re.findall(rf"<{tag}\b", text)) == text.count(f"</{tag}>"), tag
        rows = re.findall(r"<tr.*?</tr>", text, re.DOTALL)
        self.rows = [
            [words(cell) for cell in re.findall(r"<t[dh].*?</t[dh]>", row, re.DOTALL)] for row in rows
        ]
        self.sources = re.findall(r'(?:src|href)="([^"]*)', text)
        self.text = words(text)

    def row(self, first: str) -> list[str]:
        (found,) = (row[1:] for row in self.rows if row and row[0] == first)
        return found


def words(text: str) -> str:
    return unescape(re.sub(r"<[^>]*>", "", text))


def test_tables_hold_the_runs_numbers_and_pictures_are_inside(tmp_path: Path) -> None:
    runs = {"vessel": simulate(cases.vessel(), 20.0), "case 2": simulate(cases.case2(), 20.0)}
    picture = save_sheet(overview_sheet(runs["vessel"]), tmp_path, "overview")
    contents = {"summary": ["Three cases."], "pictures": [picture], "scene": SCENE, "findings": [FINDING]}
    page = Page(study_report(Study(title="Lift of a <box> & payload", runs=runs, **contents)).html)
    (source,) = page.sources
    kind, _, data = source.partition(",")
    assert kind == "data:image/png;base64" and base64.b64decode(data) == picture.image.read_bytes()
    assert "Lift of a <box> & payload" in page.text
    second = runs["case 2"]
    assert page.row("degrees of freedom") == ["6", "14"] and page.row("joints") == ["11"]
    ratio = max(abs(second["energy_balance"])) / max(second["absolute_work"])
    assert float(page.row("balance over work")[1]) == pytest.approx(ratio, rel=1e-4)
    error = [float(cell) for cell in page.row("position residual after projection [m or rad]")]
    assert error == pytest.approx([one["constraint_error"].max() for one in runs.values()], rel=1e-4)
    faster = float(page.row("times faster than real time")[1])
    assert faster == pytest.approx(20.0 / second.stats["wall_s"], rel=1e-2)
    assert page.row("yaw reacts") == ["0.1 deg/s", "changes", "reproduced"]


def test_a_channel_that_was_not_recorded_leaves_its_cell_empty() -> None:
    run = crane_run(t_end=2.0)
    for name in ("energy_balance", "absolute_work", "constraint_error_before_projection"):
        del run["arrays"][name]
    result = Result.from_arrays(**run, interrupted=True)
    html = study_report(Study(title="t", runs={"case 2": result})).html
    assert Page(html).row("balance over work") == [""] and "run case 2 ended at 2 s" in html
