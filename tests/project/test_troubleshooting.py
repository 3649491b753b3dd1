"""docs/troubleshooting.md has an entry for all that stops a run or warns, and none for what is gone."""

from __future__ import annotations

import inspect
import re

import pytest
from message_sites import CPP, LITERAL, PYTHON, ROOT, classes_of, stops

import seacrane.warnings

PAGE = (ROOT / "docs" / "troubleshooting.md").read_text()
STOPS = PAGE.split("## A run that stops")[1].split("\n## ")[0]


def fragments() -> list[str]:
    """Words in backquotes after "Message:" or "Messages:", entry by entry."""
    paragraphs = [p.replace("\n", " ") for p in STOPS.split("\n\n") if p.startswith("Message")]
    return [word for paragraph in paragraphs for word in re.findall(r"`([^`]+)`", paragraph)]


WARNINGS = {
    one.__name__: one
    for one in vars(seacrane.warnings).values()
    if isinstance(one, type) and not one.__subclasses__()
}


def test_the_sources_are_read() -> None:
    """The scan must see stops known to exist, in every form of a throw."""
    words = "\n".join(stops().values())
    for known in ("projection does not close it", "the step size has collapsed", "controller: raised",
                  "XYZ angles are singular", "Newton's iteration", "stands still"):  # fmt: skip
        assert known in words
    assert len(stops()) >= 30
    assert classes_of("UserWarning", "Warning") >= set(WARNINGS)


def test_every_stop_of_a_run_has_an_entry() -> None:
    told = fragments()
    assert {site: words for site, words in stops().items() if not any(one in words for one in told)} == {}


@pytest.mark.parametrize("fragment", fragments())
def test_every_message_on_the_page_is_one_of_the_package(fragment: str) -> None:
    reports = [CPP / "run" / "guards.cpp", PYTHON / "run" / "advance.py"]
    words = [*stops().values(), *("".join(LITERAL.findall(path.read_text())) for path in reports)]
    assert any(fragment in text for text in words)


@pytest.mark.parametrize("name", sorted(WARNINGS))
def test_every_warning_has_an_entry(name: str) -> None:
    assert f"\n| `{name}` | " in PAGE


@pytest.mark.parametrize("name", re.findall(r"\n\| `(\w+Warning)` \| ", PAGE))
def test_every_entry_of_a_warning_is_one_of_the_package(name: str) -> None:
    assert name in WARNINGS


@pytest.mark.parametrize("name", sorted(WARNINGS))
def test_an_entry_of_a_warning_says_when_it_comes_and_what_to_do(name: str) -> None:
    when, *then = inspect.cleandoc(WARNINGS[name].__doc__ or "").split("\n\n")
    assert when.endswith(".") and len(then) == 1 and then[0].endswith(".")
    assert issubclass(WARNINGS[name], seacrane.warnings.SeacraneWarning)


def test_every_error_is_listed() -> None:
    assert [name for name in sorted(classes_of("SeacraneError")) if f"`{name}`" not in PAGE] == []
