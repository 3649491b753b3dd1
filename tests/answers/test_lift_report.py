"""The report of one run: any scene, true numbers, safe names, one list of sections."""

from __future__ import annotations

from dataclasses import replace
from html import unescape
from pathlib import Path

import numpy as np
import pytest
from test_report import Page
from test_result import crane_run

from seacrane import Frame, Result, Scene, Stage, cases, report, shipped_database, simulate
from seacrane.answers import Report
from seacrane.answers.checks import judged_bounds, statistics_of

pytestmark = pytest.mark.filterwarnings("ignore::seacrane.warnings.LargeSwingWarning")  # thrown on purpose
NASTY = "<img src=x onerror=alert(1)>&\"'"


def titles(page: Report) -> list[str]:
    return [part.split("</h2>")[0] for part in page.html.split("<h2>")[1:]]


def swinging(*, wire: bool, speed: float = 3.0, name: str = "swing", body: str = "ball") -> Scene:
    scene = Scene(name=name)
    scene.add_body(body, mass=100.0, inertia=np.eye(3), position=(0, 0, -2), velocity=(speed, 0, 0))
    frames = {"first_frame": Frame(), "second_frame": Frame()}
    scene.add_joint("rope", kind="distance", first="ground", second=body, length=2.0, **frames)
    scene.add_roles(link="rope")
    if wire:
        scene.add_line(joint="rope", rung="rigid")
    return scene


@pytest.fixture(scope="module")
def lift() -> Result:
    return simulate(cases.case2(), t_end=3.0)


@pytest.fixture(scope="module")
def page(lift: Result) -> Report:
    return report(lift)


def test_a_lift_has_its_sections_and_replaces_no_other_page(page: Report, tmp_path: Path) -> None:
    found = titles(page)
    assert found[:2] == ["At a glance", "Summary"] and found[-1] == "Provenance"
    assert {"Scene", "In three dimensions", "Hook load and tension", "Limits", "Payload track"} < set(found)
    sources = Page(page.html).sources
    assert len(sources) == 4 and all(one.startswith("data:image/png;base64,") for one in sources)
    path = page.save(tmp_path / "lift.html")
    assert page.save(path).read_text(encoding="utf-8") == page.html
    path.write_text("<p>my own</p>", encoding="utf-8")
    with pytest.raises(FileExistsError, match="not of seacrane"):
        page.save(path)


def test_a_staged_lift_tells_what_was_lifted_by_what_and_when() -> None:
    """A block and slings on a winch from a crane on a given ship, hoisted in the second of two stages."""
    scene = Scene(name="staged")
    scene.add_vessel(motion="rest", name="barge")
    scene.add_crane(base="barge", slew=-np.pi / 2, s1=2.0, s2=2.0)
    rig = {"block_mass": 1e3, "slings": {"angle_deg": 60, "EA": 5e7}, "winch": {"maximum_rate": 0.5}}
    scene.add_hoist(mass=20e3, size=(3, 3, 2), EA=4e7, falls=2, **rig)
    hoist = Stage(name="hoist", duration=3.0, commands={"hoist.rate": -0.4})
    result = simulate(scene, [Stage(name="hang", duration=2.0), hoist], dt_out=0.1)
    read = Page(report(result).html)
    assert read.row("load") == ["load, 20 t, 3 x 3 x 2 m, 4 slings, block and rigging 1 t"]
    rope = 2.0 * (8.0 - 8.0 * 21e3 * result.scene.gravity / 2.0 / 4e7)
    assert read.row("wire") == [f"hoist, elastic, 2 falls, EA 4e+07 N, {rope:.4g} m of rope, winch (0.5 m/s)"]
    hook = result.select("hook_load", suspension="hoist") / 9.80665e3
    for name, start, end in (("hang", "0", "2"), ("hoist", "2", "5")):
        within = hook[result.stage(name)]
        assert read.row(name) == [start, end, "duration", f"{within.min():.4g} to {within.max():.4g}"]
    assert f"{hook.min():.4g} t" in read.text, "the least hook load is that of the hook, not of a sling"


def test_statistics_are_those_of_the_channels(lift: Result, page: Report) -> None:
    row = Page(page.html).row("wave elevation")
    wave = lift["wave_elevation"]
    expected = [
        wave.max(), lift.time[wave.argmax()], wave.min(), lift.time[wave.argmin()], wave.mean(), wave.std(),
    ]  # fmt: skip
    assert row[0] == "m"
    assert [float(cell) for cell in row[1:]] == pytest.approx(expected, rel=1e-3)
    assert Page(page.html).row("hoist tension")[:2] == ["kN", "98.07"]
    run = crane_run()
    run["arrays"]["vessel_motion"][:, 1] = 1e-16  # which is rounding
    named = {one[0] for one in statistics_of(Result.from_arrays(**run))[0]}
    assert "vessel motion sway" not in named and "vessel motion surge" in named


def test_any_result_has_a_report() -> None:
    assert {"At a glance", "Statistics", "Checks"} <= set(titles(report(simulate(cases.vessel(), 5.0))))
    run = crane_run(t_end=1.0)
    arrays = {"constraint_error": run["arrays"]["constraint_error"][:1]}
    page = report(Result.from_arrays(**(run | {"arrays": arrays, "time": run["time"][:1]})))
    assert "Checks" in titles(page)
    run = crane_run(t_end=2.0)
    run["arrays"]["tension"][-1] = np.nan
    for name in ("vessel_motion", "cylinder_force"):
        run["arrays"][name][:] = np.nan
    page = report(Result.from_arrays(**run, interrupted=True))
    assert "Interrupted: the run ended at 2 s" in page.html
    assert "nan" not in Page(page.html).row("hoist tension")


def test_names_are_escaped_everywhere() -> None:
    scene = swinging(wire=True, name=NASTY, body=NASTY)
    scene.notes["<b>note</b>"] = NASTY
    result = simulate(scene, t_end=0.2)
    for shown in (scene, result, replace(shipped_database(), name=NASTY, source=NASTY)):
        html = shown._repr_html_()
        assert "<img src=x" not in html and "&lt;img src=x" in html
    page = report(result, title=NASTY)
    assert "<img src=x" not in page.html and "<b>note" not in page.html
    read = Page(page.html)
    assert NASTY in read.text and all(one.startswith("data:") for one in read.sources)
    assert unescape(page._repr_html_().split('srcdoc="')[1].split('" title')[0]) == page.html


def test_links_wires_and_stops_are_judged() -> None:
    (rod,) = judged_bounds(simulate(swinging(wire=False, speed=2.0), t_end=1.0))
    assert (rod.name, rod.kind, rod.held) == ("rope", "link", True)
    (taut,) = judged_bounds(simulate(swinging(wire=True, speed=2.0), t_end=1.0))
    assert (taut.kind, taut.held) == ("wire", True)
    (slack,) = judged_bounds(simulate(swinging(wire=True, speed=8.0), t_end=3.0))
    assert slack.held is False and slack.words.startswith("slack once")
    scene = Scene(name="stop", gravity=0.0)
    scene.add_body(name="slide", mass=1.0, inertia=np.eye(3), velocity=(0.0, 0.0, 1.0))
    scene.add_joint(kind="prismatic", name="rail", first="ground", second="slide", point=(0.0, 0.0, 0.0))
    scene.add_channel(joint="rail")
    scene.add_stop(joint="rail", maximum=0.5, restitution=0.5)
    (hit,) = judged_bounds(simulate(scene, t_end=1.0))
    assert (hit.kind, hit.bound, hit.held) == ("stop", " to 0.5 m", False)
    assert hit.words.startswith("hit once, fastest 1")


def test_ranges_are_judged_by_what_was_recorded(lift: Result) -> None:
    bounds = {one.name: one for one in judged_bounds(lift)}
    assert bounds["main_cylinder"].bound == "0 to 5 m" and bounds["main_cylinder"].held
    first = {**lift.about.bounds[0], "maximum": 1e-4 * float(lift["stroke"].max()), "minimum": -1.0}
    far = replace(lift.about, bounds=[first, *lift.about.bounds[1:]])
    moved = replace(lift, channels={**lift.channels, "coordinate": lift["coordinate"] + 0.5}, about=far)
    assert {one.name: one for one in judged_bounds(moved)}["main_cylinder"].held is False
    assert "of 3 not held" in report(moved).html
    unknown = {name: values for name, values in lift.channels.items() if name != "coordinate"}
    silent = replace(lift, channels=unknown)
    assert {one.held for one in judged_bounds(silent) if one.kind == "range"} == {None}


def test_checks_that_fail_are_told() -> None:
    run = crane_run()
    run["arrays"]["constraint_error"] += 1e-3
    run["arrays"]["energy_balance"] = 0.5 * run["arrays"]["absolute_work"]
    html = report(Result.from_arrays(**run)).html
    assert "do not use the numbers" in html and "Energy is off by more than 0.001" in html
