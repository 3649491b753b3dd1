"""docs/troubleshooting.md has an entry for all that stops a run, and none for what is gone."""

from __future__ import annotations

import re

from message_sites import CLASS, CPP, LITERAL, PYTHON, ROOT, classes_of, stops

import seacrane.warnings

PAGE = (ROOT / "docs" / "troubleshooting.md").read_text()
STOPS = PAGE.split("## A run that stops")[1].split("\n## ")[0]


def test_every_stop_of_a_run_has_an_entry_and_every_entry_is_of_the_package() -> None:
    """By the words in backquotes after "Message:" or "Messages:"."""
    paragraphs = [one.replace("\n", " ") for one in STOPS.split("\n\n") if one.startswith("Message")]
    assert len(stops()) >= 30
    told = [word for paragraph in paragraphs for word in re.findall(r"`([^`]+)`", paragraph)]
    assert {site: words for site, words in stops().items() if not any(one in words for one in told)} == {}
    reports = [CPP / "run" / "guards.cpp", PYTHON / "run" / "advance.py"]
    words = [*stops().values(), *("".join(LITERAL.findall(path.read_text())) for path in reports)]
    assert [one for one in told if not any(one in text for text in words)] == []


def test_every_error_has_an_entry_and_every_warning_a_name_for_type_checkers() -> None:
    assert [name for name in sorted(classes_of("SeacraneError")) if f"`{name}`" not in PAGE] == []
    made = {name: one for name, one in vars(seacrane.warnings).items() if isinstance(one, type)}
    listed = dict(CLASS.findall((PYTHON / "warnings.pyi").read_text()))
    assert listed == {name: one.__base__.__name__ for name, one in made.items()}
    assert len({one.code for one in made.values()}) == len(made) > 100
