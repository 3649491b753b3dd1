"""The record of results: what it covers, that scenes give it, and that a planted difference is found."""

from __future__ import annotations

import copy
import json
import sys
from pathlib import Path
from typing import Any

import pytest

from seacrane import _core, integrator_names

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "tools"))

import bits.scenes  # noqa: E402, F401
from bits.__main__ import as_text, main  # noqa: E402
from bits.case import CASES  # noqa: E402
from bits.compare import Change, Renamed, differences  # noqa: E402
from bits.record import recorded  # noqa: E402

FIXED_STEP = {"semi-implicit-euler", "rk4", "rk-low-storage", "generalized-alpha"}
QUICK = ("loads/actuator", "lines/wound_by_a_winch", "contact/end_stop", "cranes/case2_by_its_paper",
         "drawn/15")  # fmt: skip
NONE = Renamed()


@pytest.fixture(scope="module")
def record() -> dict[str, Any]:
    return json.loads((ROOT / "tests" / "bits.json").read_text(encoding="utf-8"))


def test_every_scene_load_and_integrator_is_recorded_with_its_settings(record: dict[str, Any]) -> None:
    scenes = record["scenes"].values()
    new = [name for name in CASES if name not in record["scenes"]]
    assert list(record["scenes"]) == list(CASES), f"tests/bits.json:1: python -m bits --record --scenes {new}"
    assert len(CASES) >= 60 and min(len(scene["runs"]) for scene in scenes) >= 2
    loads = {kind for scene in scenes for kind in scene["loads"]}
    assert loads == set(_core.LOAD_KINDS), "tools/bits/scenes/loads.py:1: no scene has another kind"
    settings = [run["settings"] for scene in scenes for run in scene["runs"].values()]
    assert {told["integrator"] for told in settings} == set(integrator_names())
    for told in settings:
        step = {"dt"} if told["integrator"] in FIXED_STEP else set()
        assert told.keys() >= {"integrator", "formulation", "rtol", "dt_out"} | step, told


@pytest.mark.parametrize("name", QUICK)
def test_a_scene_gives_what_is_recorded(name: str, record: dict[str, Any]) -> None:
    apart = differences(record["scenes"][name], recorded(name), NONE)
    assert [str(one) for one in apart if one.size > 1e-9] == []


def test_a_planted_difference_is_found(record: dict[str, Any], tmp_path: Path, capsys: Any) -> None:
    copied = copy.deepcopy(record)
    position = next(iter(copied["scenes"][QUICK[0]]["runs"].values()))["channels"]["position"]
    position |= {"last": (float.fromhex(position["largest"]) * 2.0 + 1.0).hex(), "sha256": "0" * 64}
    file = tmp_path / "bits.json"
    file.write_text(as_text(copied), encoding="utf-8")
    assert main(["--file", str(file), "--scenes", QUICK[0]]) == 1
    told = capsys.readouterr().out
    assert QUICK[0] in told and "in position" in told and "not as recorded" in told


def test_a_change_is_expected_within_its_bound_alone(record: dict[str, Any]) -> None:
    one = record["scenes"][QUICK[0]]
    now = copy.deepcopy(one)
    pressed = next(iter(now["runs"].values()))["channels"]["actuator_force"]
    pressed |= {"largest": (float.fromhex(pressed["largest"]) * (1.0 + 1e-3)).hex(), "sha256": "0" * 64}
    (apart,) = differences(one, now, NONE)
    assert apart.size == pytest.approx(1e-3, rel=0.5)
    for bound in (1e-2, 1e-5):
        change = Change(scenes="loads/*", channels="actuator_*", bound=bound, reason="try")
        assert apart.expected(QUICK[0], [change]) is (change if bound > 1e-3 else None)
