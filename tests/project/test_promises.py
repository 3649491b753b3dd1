"""docs/contributing.md names tests that exist, for each of the three promises."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "contributing.md").read_text().partition("## What is added where")[0]
ROWS = re.findall(r"^\| (\d) \| (.*) \|$", PAGE, re.MULTILINE)
FILES = sorted({name for _, text in ROWS for name in re.findall(r"`(tests/\w+\.py)`", text)})


@pytest.mark.parametrize("name", FILES)
def test_a_test_that_holds_a_promise_exists(name: str) -> None:
    assert re.search(r"^def test_", (ROOT / name).read_text(), re.MULTILINE)


def test_every_promise_is_held_by_tests() -> None:
    promises = re.findall(r"^(\d)\. \*\*", PAGE, re.MULTILINE)
    assert promises == ["1", "2", "3"]
    assert {number for number, _ in ROWS} == set(promises)


def test_the_readme_leads_to_the_promises_and_the_mistakes() -> None:
    readme = (ROOT / "README.md").read_text()
    assert "(docs/contributing.md#three-promises)" in readme
    assert "(docs/mistakes.md)" in readme
