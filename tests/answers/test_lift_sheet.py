"""Lift sheets: every number by hand, the worst corner of the envelope, sources, files, what is refused."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from seacrane import Lift, Result, Scene, SceneError, report, simulate, summary
from seacrane.answers import lift_sheet

G = 9.80665
MASS, BLOCK, GAMMA, DAF, SKL = 20e3, 1e3, 1.1, 1.3, 1.25
SOURCE = {"weight_contingency": "not weighed; the project's table 2"}


def rigged(*, on: str | None = None, feet: bool = False, **slings: Any) -> Scene:
    scene = Scene(name="rigged")
    scene.add_crane(base="ground", s1=1.5, s2=1.0)
    place: dict[str, Any] = {"length": 10.0} if on is None else {"on": on}
    place |= {"feet": {"friction": 0.3}} if feet else {}
    scene.add_hoist(
        mass=MASS, size=(4, 4, 3), EA=3e7, falls=2, block_mass=BLOCK, breaking_load=4e5, safety_factor=3.0,
        slings={"angle_deg": 60.0, "EA": 1e9, "breaking_load": 6e5} | slings, **place,
    )  # fmt: skip
    return scene


def with_factors(scene: Scene, **given: Any) -> Scene:
    known: dict[str, Any] = {"weight_contingency": GAMMA, "dynamic_factor": DAF, "skew_load": SKL,
                             "sling_safety_factor": 3.0, "shackle_breaking_load": 3e5,
                             "shackle_safety_factor": 4.0, "alpha": 0.7, "sources": SOURCE}  # fmt: skip
    scene.add_lift_factors(**known | given)
    return scene


@pytest.mark.parametrize(("on", "feet"), [(None, False), ("ground", False), ("ground", True)])
def test_every_number_by_hand(on: str | None, feet: bool) -> None:
    """Whether the load hangs as described or stands on a deck, welded or on feet; and where each is from."""
    sheet = lift_sheet(with_factors(rigged(on=on, feet=feet)))
    static = (GAMMA * MASS + BLOCK) * G
    force = DAF * SKL * GAMMA * MASS * G / (4.0 * np.sin(np.pi / 3))
    expected = {
        "weight": MASS * G, "design weight": GAMMA * MASS * G, "static hook load": static,
        "dynamic hook load": DAF * static, "rope tension hoist": DAF * static / 2,
        "safety factor hoist": 4e5 / (DAF * static / 2), "alpha factor": 0.7,
    }  # fmt: skip
    for name, value in expected.items():
        assert sheet[name].value == pytest.approx(value, rel=1e-6), name
    for name in ("hoist sling 1", "hoist sling 4"):
        assert sheet[f"force {name}"].value == pytest.approx(force, rel=1e-3)
        assert sheet[f"safety factor {name}"].value == pytest.approx(6e5 / force, rel=1e-3)
    shackle = sheet["safety factor of the shackle, hoist sling 1"]
    assert shackle.value == pytest.approx(3e5 / force, rel=1e-3)
    assert shackle.kept is False and sheet["safety factor hoist sling 1"].kept is True and not sheet.kept
    assert sheet["weight contingency"].source == SOURCE["weight_contingency"]
    assert sheet["force hoist sling 1"].source == "SKL: unverified"
    own = lift_sheet(with_factors(rigged(on=on, feet=feet), skew_load=[1.25, 1.0, 1.25, 1.0]))
    first, second = (own[f"force hoist sling {k}"].value for k in (1, 2))
    assert first / second == pytest.approx(1.25, rel=1e-6)


def test_the_worst_corner_of_the_envelope_counts() -> None:
    """Two slings of one length on a rigid load: W sin(beta + phi) / sin(2 beta), phi the load's tilt."""
    ends, length, off = [(2.0, 0.0, 1.5), (-2.0, 0.0, 1.5)], 4.0, 0.3
    scene = rigged(angle_deg=None, length=length, points=ends)
    sheet = lift_sheet(
        with_factors(scene, center_of_gravity=(off, 0.0, 0.0), dynamic_factor=1.0, skew_load=1.0)
    )
    height = np.sqrt(length**2 - 2.0**2)
    beta, phi = np.arctan2(2.0, height), np.arctan2(off, 1.5 + height)
    force = GAMMA * MASS * G * np.sin(beta + phi) / np.sin(2.0 * beta)
    for name in ("force hoist sling 1", "force hoist sling 2"):
        assert sheet[name].value == pytest.approx(force, rel=2e-3), "either side may be the heavy one"


def test_a_run_gives_its_own_dynamic_factor_and_the_report_has_the_sheet(tmp_path: Path) -> None:
    scene = with_factors(rigged(), dynamic_factor=None)
    scene.replace("load", velocity=(0.0, 0.0, -0.5))
    result = simulate(scene, 5.0)
    factor = summary(result)["hook load"].factor
    assert factor is not None and factor > 1.1
    sheet = lift_sheet(result)
    assert sheet["dynamic factor"].value == factor and sheet["dynamic factor"].source.startswith("this run")
    result.save(tmp_path / "run.nc")
    loaded = Result.load(tmp_path / "run.nc")
    assert lift_sheet(loaded).rows == sheet.rows
    page = report(loaded).html
    assert "<h2>Lift sheet</h2>" in page and "the project&#x27;s table 2" in page


def test_two_cranes_share_a_load_as_their_hooks_stand() -> None:
    """At -2 and 4 m of the centre: two thirds and one third, with factors of their own in the summary."""
    scene = Scene(name="tandem")
    scene.add_body("girder", mass=30e3, size=(10, 1, 1), position=(0.0, 0.0, -20.5))
    for name, x in (("aft ", -2.0), ("fore ", 4.0)):
        scene.add_body(f"{name}tip", mass=1e3, size=(1, 1, 1), position=(x, 0.0, 0.0))
        scene.add_joint(f"{name}weld", kind="weld", first="ground", second=f"{name}tip", point=(x, 0, 0))
        scene.add_line(
            f"{name}hoist", f"{name}tip", "girder", first_point=(0, 0, 0), second_point=(x, 0, 0.5), EA=1e9,
            breaking_load=1e6,
        )  # fmt: skip
        scene.add_roles(prefix=name, line=f"{name}hoist")
    told = summary(simulate(scene, 2.0))
    for name, share in (("aft", 2 / 3), ("fore", 1 / 3)):
        row = told[f"hook load {name} hook"]
        assert row.static_known and row.static == pytest.approx(share * 30e3 * G, rel=1e-3)
    sheet = lift_sheet(with_factors(scene, load="girder", sources={}))
    assert sheet["static hook load aft hook"].value == pytest.approx(GAMMA * 20e3 * G, rel=1e-3)
    assert sheet["safety factor fore hoist"].value == pytest.approx(1e6 / (GAMMA * DAF * 10e3 * G), rel=1e-3)


def test_files_keep_it(tmp_path: Path) -> None:
    scene = with_factors(rigged(), center_of_gravity=(0.2, -0.1, 0.0))
    scene.save(tmp_path / "scene.json")
    loaded = Scene.load(tmp_path / "scene.json")
    assert loaded.lift_factors == scene.lift_factors and loaded.ratings == scene.ratings
    load = {"name": "load", "mass_t": 1, "size_m": [1, 1, 1]}
    told = [
        Lift({"body": load, "lift_factors": {"load": "load", "skew_load": one}}).scene().lift_factors
        for one in (1.25, [1.25])
    ]
    assert told[0] == told[1] and told[0]["load"].skew_load == (1.25,)


def test_factors_that_fit_no_lift_are_refused_by_name() -> None:
    scene = rigged()
    tag = {"name": "tag", "first": "ground", "second": "load", "EA": 1e6, "safety_factor": 3.0}
    refused: list[tuple[Any, dict[str, Any], str]] = [
        (scene.add_lift_factors, {"skew_load": [1.25, 0.5]}, "skew_load is 0.5"),
        (scene.add_lift_factors, {"sources": {"daf": "x"}}, "'daf'.*weight_contingency"),
        (scene.add_line, tag, "'tag'.*safety_factor.*breaking_load"),
        (lift_sheet, {"subject": scene, "load": "tower"}, "'tower' hangs on nothing"),
        (lift_sheet, {"subject": with_factors(rigged(), skew_load=[1.1, 1.2, 1.3])}, "has 3 .* 4 slings"),
    ]
    for call, given, words in refused:
        with pytest.raises(SceneError, match=words):
            call(**given)
    assert "tag" not in scene.loads and "tag" not in scene.ratings
