"""What a rod has, a line has: all that docs/hoists.md lists, asked of every lift by a run."""

from __future__ import annotations

import json
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from seacrane import Lift, Scene, Stage, ensemble, report, shipped_database, simulate, view
from seacrane.answers import load_chart, statics, summary
from seacrane.crane import Payload
from seacrane.description.suspension import hung_loads
from seacrane.lift.shown_study import shown_study
from seacrane.lift.study_run import run_study
from seacrane.operability import Criterion, allowable_hs
from seacrane.pictures.drawn_bodies import looks
from seacrane.warnings import BallastWarning, LoadInHullWarning, MassUnitWarning

DOCUMENT = Path(__file__).resolve().parents[2] / "docs" / "hoists.md"
G, MASS, SIZE, LENGTH = 9.80665, 40e3, (6.0, 6.0, 4.0), 8.0  # of the rod's usual load
ROPE = {"EA": 4e7}
SLUNG = {"falls": 4, "block_mass": 2e3, "slings": {"angle_deg": 60.0, "EA": 8e7}}
LIFTS: dict[str, dict[str, Any]] = {
    "rod": {}, "rigid": {"rung": "rigid"}, "quasi-static": {"rung": "quasi-static", **ROPE},
    "elastic": {"rung": "elastic", **ROPE}, "auto": {"rung": "auto", **ROPE},
    "with mass": {"wire": {"mass_per_length": 20.0}, **ROPE},
    "four falls, block, slings": SLUNG | ROPE,
}  # fmt: skip
SWINGS = ("payload swing", "offlead", "sidelead", "payload offset x", "payload offset y")
STAGES = [Stage(name="hang", duration=0.04), Stage(name="up", duration=0.04)]
HOW: dict[str, Any] = {"dt_out": 0.02, "integrator": "rk4", "dt": 5e-4}
ALL = pytest.mark.parametrize("by", LIFTS)
pytestmark = pytest.mark.filterwarnings("ignore")


def hung(
    by: str, *, mass: float = MASS, length: float = LENGTH, base: str = "vessel", slew: float = -0.5 * np.pi
) -> Scene:
    scene = Scene(name=by)
    if base == "vessel":
        scene.add_vessel(shipped_database(), memory="none")
    payload = Payload(mass=mass, size=SIZE, link_length=length) if by == "rod" else None
    scene.add_crane(base=base, slew=slew, payload=payload)
    if payload is None:
        scene.add_hoist(load="payload", mass=mass, size=SIZE, length=length, **LIFTS[by])
    return scene


def at_sea(by: str) -> Scene:
    scene = hung(by)
    scene.add_limit_state(channel="offlead", maximum=0.5)
    scene.add_sea(hs=1.0, tp=8.0, seed=3, direction_deg=60.0)
    return scene


def hook(by: str) -> str:
    """Its hook load in the stage that lifts."""
    (load,) = hung_loads(hung(by))
    return f"hook_load[{load.suspension.channel}, stage=up]"


def warned(by: str, category: type[Warning], *, runs: bool = True, **given: Any) -> bool:
    with warnings.catch_warnings(record=True, action="always") as caught:
        scene = hung(by, **given)
        if runs:
            simulate(scene, 0.01, **HOW)
    return category in {one.category for one in caught}


def in_stages(by: str, **given: Any) -> Any:
    return ensemble(at_sea(by), stages=STAGES, keep={"peak": f"{hook(by)}.max"}, **given, **HOW)


def rows(by: str) -> dict[str, bool]:
    """Of the table: what it has."""
    run, scene = simulate(at_sea(by), 0.5, **HOW), hung(by)
    told, page = summary(run), report(run).html
    row, names = told["hook load"], {one.name for one in told}
    weight, factor = (MASS + LIFTS[by].get("block_mass", 0.0)) * G, row.maximum / row.static
    exact = row.static_known and row.factor == pytest.approx(factor, rel=1e-6) and f"{factor:.2f}" in page
    drawn = json.loads(view(run).html.split('id="data">')[1].split("</script>")[0])
    tracks = {(one["kind"], one["name"]) for one in drawn["tracks"]}
    jib, tip = scene.roles[""].tip or ("", ())
    points = looks(scene)[jib].points + scene.bodies[jib].center_of_mass
    near = np.all(points.min(axis=0) - 0.5 < tip) and np.all(tip < points.max(axis=0) + 0.5)
    kinds = {type(load).__name__ for load in scene.loads.values()}
    chart = load_chart(hung(by, base="ground"), radii=[14.0, 18.0], limits={"cylinder force main": 9e6})
    at_rest, (state,), lifted = statics(scene), run.utilisation, in_stages(by, over={"seed": [1, 2]})
    criterion = Criterion(channel=hook(by), maximum=3.0 * weight, statistic="p90")
    seas = allowable_hs(
        at_sea(by), criteria=[criterion], tp=[8.0], direction_deg=[60.0], hs=(1.0,), seeds=range(1, 4),
        stages=STAGES, **HOW,
    ).dataset  # fmt: skip
    return {
        "swing, offlead, sidelead and offset": all(one in names and one in page for one in SWINGS),
        "dynamic factor by itself, in summary and report": exact and abs(row.static / weight - 1.0) < 0.01,
        "hook load at a glance": "Largest hook load" in page and "Least hook load" in page,
        "arrow of tension and track in the page":
            "link" in {one["group"] for one in drawn["arrows"]} and ("payload", "payload") in tracks,
        "jib drawn to its tip": bool(near),
        "`MassUnitWarning`": warned(by, MassUnitWarning, runs=False, mass=40.0),
        "`BallastWarning`": warned(by, BallastWarning, mass=400e3),
        "`LoadInHullWarning`": warned(by, LoadInHullWarning, length=18.0, slew=0.0),
        "damping by default": {"PendulumDamping", "FlowForce"} <= kinds,
        "load chart": bool(np.all(np.diff([*chart.allowable.ravel(), MASS]) < 0.0)),
        "columns of statics": float(at_rest["hook load"]) == pytest.approx(weight, rel=0.01)
            and "hoist tension" in at_rest.columns,
        "limit states": state.name == "offlead" and state.kept is True,
        "stages in `ensemble`": not lifted.failures and bool(np.isfinite(lifted.dataset.peak).all()),
        "stages in `allowable_hs`":
            (seas.domain.item(), seas.reason.item()) == ("time", "a lift in stages"),
    }  # fmt: skip


def is_documented(row: str) -> bool:
    _, _, listed = " ".join(DOCUMENT.read_text(encoding="utf-8").split()).partition("Each has: ")
    return row in listed.partition(". ")[0].split("; ")


@ALL
def test_whatever_it_hangs_on_has_it(by: str) -> None:
    found = rows(by)
    assert not [row for row, yes in found.items() if not yes]
    assert all(is_documented(row) for row in found)


@pytest.mark.parametrize("by", [
    pytest.param(by, marks=pytest.mark.slow("many runs")) if by == "with mass" else by for by in LIFTS
])  # fmt: skip
def test_stages_run_until(by: str) -> None:
    told = in_stages(by, over={"seed": range(20)}, until={"peak.mean": 0.5})
    assert not told.failures and told.certainty[0].seeds == 20 and is_documented("stages with `until=`")


UNITS = {"EA": "EA_N", "mass_per_length": "mass_per_length_kg_per_m", "block_mass": "block_mass_kg"}
STUDY: dict[str, Any] = {
    "over": {"stages.up.duration": [0.1, 0.2]},
    "keep": [{"name": "peak", "channel": "hook_load[stage=up]", "what": "maximum"}],
}


def in_file(given: dict[str, Any]) -> dict[str, Any]:
    return {UNITS.get(key, key): in_file(one) if isinstance(one, dict) else one for key, one in given.items()}


@ALL
def test_a_study_file_of_its_stages_runs(by: str, tmp_path: Path) -> None:
    told: dict[str, Any] = {
        "scene": {"name": "hung"}, "method": {"integrator": "rk4", "dt_s": 5e-4},
        "outputs": {"dt_out_s": 0.02}, "crane": [{"base": "ground"}],
        "stage": [{"name": one.name, "duration_s": 0.1} for one in STAGES], "study": STUDY,
    }  # fmt: skip
    if by == "rod":
        told["crane"][0]["payload_mass_kg"] = MASS
    else:
        told["hoist"] = {"load": "payload", "mass_kg": MASS, "size_m": list(SIZE)} | in_file(LIFTS[by])
    Lift(told).save(tmp_path / "lift.toml")
    found = run_study(tmp_path / "lift.toml", tmp_path / "out")
    assert is_documented("stages in study files") and not found.failures
    assert np.isfinite(found.dataset.peak).all()
    assert bool(shown_study(tmp_path / "out").tables) == (found.dataset.peak.size == 2)  # of one hook


def test_a_lift_off_makes_auto_elastic() -> None:
    """A seat that lets go makes an impact, which the quasi-static stretch does not know."""
    hanging = {"length": 8.0}, "rest", "quasi-static"
    for given, start, rung in (({"on": "ground", "winch": {"lag": 0.2}}, None, "elastic"), hanging):
        scene = Scene(name="on deck")
        scene.add_crane(base="ground", s1=1.5, s2=1.0)
        scene.add_hoist(mass=MASS, size=SIZE, EA=1e9, rung="auto", **given)
        assert f"hoist: {rung}" in simulate(scene, 1.0, start=start).stats["line_rungs"]
