"""Names of 0.1 and 0.2: scripts are refused with the new one, files are read with one warning."""

from __future__ import annotations

import pickle
import warnings
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from lift_examples import PENDULUM

import seacrane
from seacrane import FileFormatError, Lift, renamed
from seacrane.lift.study_keys import KEEP
from seacrane.lift.tables import TABLES
from seacrane.warnings import RenamedKeysWarning

OLDER = PENDULUM.replace("version = 2", "version = 1")


def write(folder: Path, text: str) -> Path:
    path = folder / "older.toml"
    path.write_text(text)
    return path


@pytest.fixture
def renamed_keys(monkeypatch: pytest.MonkeyPatch) -> None:
    """As if 0.2 had had a table "stage_of_outputs" and the keys "weight" of a body and "end" of a run."""
    monkeypatch.setitem(renamed.LIFT_TABLES, "recorded", ("outputs", {"dt_out_s": 0.5}))
    monkeypatch.setitem(renamed.LIFT_KEYS, "body", {"weight": "mass"})
    monkeypatch.setitem(renamed.LIFT_KEYS, "run", {"end": "t_end"})
    monkeypatch.setitem(renamed.LIFT_DEFAULTS, "body", {"gravity": False})


def older_text() -> str:
    text = OLDER.replace("mass_kg", "weight_kg").replace("t_end_s", "end_s")
    return text.replace("[outputs]\ndt_out_s = 0.5", "[recorded]")


@pytest.mark.usefixtures("renamed_keys")
def test_a_lift_of_before_is_read_with_one_warning_that_lists_old_and_new_keys(tmp_path: Path) -> None:
    with pytest.warns(RenamedKeysWarning) as told:
        lift = Lift.load(write(tmp_path, older_text()))
    assert len(told) == 1
    text = str(told[0].message)
    for part in ("older.toml", "weight_kg of [body] is mass_kg", "end_s of [run] is t_end_s", "version = 2",
                 "[recorded] is [outputs] with dt_out_s = 0.5"):  # fmt: skip
        assert part in text
    now = Lift.load(write(tmp_path, PENDULUM.replace("mass_kg", "gravity = false\nmass_kg")))
    assert lift == now and lift.outputs.dt_out == 0.5


@pytest.mark.usefixtures("renamed_keys")
def test_a_lift_of_before_is_told_of_once_in_all_processes(tmp_path: Path) -> None:
    with pytest.warns(RenamedKeysWarning):
        lift = Lift.load(write(tmp_path, older_text()))
    with warnings.catch_warnings():
        warnings.simplefilter("error", RenamedKeysWarning)
        assert pickle.loads(pickle.dumps(lift)) == lift
        lift.save(tmp_path / "now.toml")
        assert Lift.load(tmp_path / "now.toml") == lift


@pytest.mark.usefixtures("renamed_keys")
@pytest.mark.parametrize(
    "old, message",
    [
        ("weight_kg", r"line 9: weight_kg of \[body\] is mass_kg since 0.3"),
        ("weight", r"nearest: length|weight is unknown|known are"),
    ],
)
def test_a_lift_of_now_is_refused_its_old_keys_by_their_new_names(
    tmp_path: Path, old: str, message: str
) -> None:
    with pytest.raises(FileFormatError, match=message):
        Lift.load(write(tmp_path, PENDULUM.replace("mass_kg", old)))


@pytest.mark.usefixtures("renamed_keys")
def test_a_lift_of_now_is_refused_its_old_tables_by_their_new_names(tmp_path: Path) -> None:
    with pytest.raises(FileFormatError, match=r"\[recorded\] is \[outputs\] with dt_out_s = 0.5 since 0.3"):
        Lift.load(write(tmp_path, PENDULUM.replace("[outputs]\ndt_out_s = 0.5", "[recorded]")))


@pytest.mark.usefixtures("renamed_keys")
def test_an_old_key_beside_its_new_one_is_refused(tmp_path: Path) -> None:
    both = OLDER.replace("mass_kg = 2", "mass_kg = 2\nweight_kg = 2")
    with pytest.raises(FileFormatError, match="weight_kg stands beside mass_kg; leave it out"):
        Lift.load(write(tmp_path, both))


def test_a_lift_of_before_without_old_keys_is_read_without_a_word(tmp_path: Path) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert Lift.load(write(tmp_path, OLDER)) == Lift.load(write(tmp_path, PENDULUM))


def test_a_call_refuses_an_old_keyword_by_its_new_name(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(renamed.KEYWORDS, "lift_off", {"above": "minimum", "at": "name the curve in channel"})

    def lift_off(channel: str, minimum: float = 0.0) -> tuple[str, float]:
        return channel, minimum

    lift_off.__qualname__ = "lift_off"
    call: Any = renamed.refusing(lift_off)
    assert call("roll", minimum=2.0) == ("roll", 2.0)
    with pytest.raises(TypeError, match=r"lift_off\(\) has no keyword 'above' since 0.3; it is 'minimum'"):
        call("roll", above=2.0)
    with pytest.raises(TypeError, match=r"has no keyword 'at' since 0.3; name the curve in channel"):
        call("roll", at={})


def test_a_class_refuses_an_old_keyword_by_its_new_name(monkeypatch: pytest.MonkeyPatch) -> None:
    @dataclass(frozen=True)
    class Bound:
        maximum: float

    monkeypatch.setitem(renamed.KEYWORDS, Bound.__qualname__, {"max": "maximum"})
    bound: Any = renamed.refusing(Bound)
    assert bound(maximum=2.0) == Bound(2.0)
    with pytest.raises(TypeError, match=r"has no keyword 'max' since 0.3; it is 'maximum'"):
        bound(max=2.0)


def test_an_old_public_name_is_refused_by_its_new_address(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(renamed.NAMES, "jacobi", "analysis.jacobian")
    with pytest.raises(
        ImportError, match=r"'seacrane' has no attribute 'jacobi'; it is seacrane.analysis.jacobian"
    ):
        from seacrane import jacobi  # type: ignore[attr-defined]  # noqa: F401


def test_every_old_key_leads_to_one_that_there_is() -> None:
    for table, names in renamed.LIFT_KEYS.items():
        outer, *inner = table.split(".")
        keys = {key.name: key for key in TABLES[renamed.LIFT_TABLES.get(outer, (outer,))[0]].keys}
        for name in inner:
            keys = {key.name: key for key in keys[name].keys}
        assert set(names.values()) <= set(keys) and not set(names) & set(keys), table
    for old, (new, _) in renamed.LIFT_TABLES.items():
        assert new in TABLES and old not in TABLES
    kept = {key.name for key in KEEP}
    assert set(renamed.STUDY_KEYS.get("keep", {}).values()) <= kept
    assert not set(renamed.NAMES) & set(dir(seacrane))
