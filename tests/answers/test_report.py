"""Pages about several runs: everything inside one page, true numbers, safe text, atomic writing."""

from __future__ import annotations

import base64
import re
from html import unescape

import pytest
from test_result import crane_result, crane_run, vessel_result

from seacrane.answers.measures import energy_closure, speed, worst
from seacrane.answers.paper_report import Study, study_report
from seacrane.pictures import Finding, Picture, save_sheet
from seacrane.pictures.overview import overview_sheet
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


@pytest.fixture(scope="module")
def runs() -> dict[str, Result]:
    return {"vessel": vessel_result(t_end=20.0), "case 2": crane_result(t_end=20.0)}


@pytest.fixture(scope="module")
def picture(tmp_path_factory: pytest.TempPathFactory, runs: dict[str, Result]) -> Picture:
    return save_sheet(overview_sheet(runs["vessel"]), tmp_path_factory.mktemp("report"), "overview")


@pytest.fixture(scope="module")
def page(runs: dict[str, Result], picture: Picture) -> Page:
    contents = {"summary": ["Three cases."], "pictures": [picture], "scene": SCENE, "findings": [FINDING]}
    return Page(study_report(Study(title="Lift of a <box> & payload", runs=runs, **contents)).html)


def test_the_page_needs_nothing_outside_itself_and_escapes_text(page: Page, picture: Picture) -> None:
    (source,) = page.sources
    kind, _, data = source.partition(",")
    assert kind == "data:image/png;base64" and base64.b64decode(data) == picture.image.read_bytes()
    assert "Lift of a <box> & payload" in page.text


def test_tables_hold_the_runs_numbers(page: Page, runs: dict[str, Result]) -> None:
    second = runs["case 2"]
    assert page.row("degrees of freedom") == ["6", "14"] and page.row("joints") == ["11"]
    ratio = max(abs(second["energy_balance"])) / max(second["absolute_work"])
    assert float(page.row("balance over work")[1]) == pytest.approx(ratio, rel=1e-4)
    error = [float(cell) for cell in page.row("position residual after projection [m or rad]")]
    assert error == pytest.approx([one["constraint_error"].max() for one in runs.values()], rel=1e-4)
    assert float(page.row("times faster than real time")[1]) == pytest.approx(20.0 / 0.25)
    assert page.row("yaw reacts") == ["0.1 deg/s", "changes", "reproduced"]


def test_a_channel_that_was_not_recorded_leaves_its_cell_empty() -> None:
    run = crane_run(t_end=2.0)
    for name in ("energy_balance", "absolute_work", "constraint_error_before_projection"):
        del run["arrays"][name]
    run["stats"]["wall_s"] = 0.0
    result = Result.from_arrays(**run, interrupted=True)
    assert worst(result, "energy_balance") is energy_closure(result) is speed(result) is None
    html = study_report(Study(title="t", runs={"case 2": result})).html
    assert Page(html).row("balance over work") == [""] and "run case 2 ended at 2 s" in html
