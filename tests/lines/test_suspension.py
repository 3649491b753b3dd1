"""What hangs on what: a lift by any rung, and by the paper's rod, is told alike and pulls alike."""

from __future__ import annotations

import math
import warnings
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hydraulic_scenes import OIL
from line_scenes import below
from numpy.testing import assert_allclose

from seacrane import Frame, Result, Scene, SceneError, shipped_database, simulate, summary
from seacrane.answers import load_chart, statics
from seacrane.crane import Payload, load_crane
from seacrane.inputs.frames import rotation_matrix
from seacrane.scene import Slings

G = 9.80665
MASS, SIZE, LENGTH = 40e3, (3.0, 3.0, 2.0), 12.0
RUNGS: Mapping[str, dict[str, Any]] = {
    "rigid": {}, "quasi-static": {"EA": 4e8}, "elastic": {"EA": 4e8}, "auto": {"EA": 4e8},
    "with mass": {"EA": 4e8, "wire": {"mass_per_length": 20.0}},
}  # fmt: skip
QUICK = ["rod", "rigid", "elastic", "auto"]


def lift(rung: str, *, mass: float = MASS, slew: float = 0.0, base: str = "ground") -> Scene:
    """The same load, as long a wire and the same crane, whatever it hangs on."""
    scene = Scene(name=f"lift by {rung}")
    if base == "vessel":
        scene.add_vessel(shipped_database())
    rod = Payload(mass=mass, size=SIZE, link_length=LENGTH) if rung == "rod" else None
    scene.add_crane(base=base, slew=slew, payload=rod)
    if rod is None:
        how: dict[str, Any] = RUNGS[rung] | ({} if "wire" in RUNGS[rung] else {"rung": rung})
        scene.add_hoist(load="payload", mass=mass, size=SIZE, length=LENGTH, **how)
    return scene


@pytest.fixture(scope="module")
def runs() -> dict[str, Result]:
    found = {}
    for rung in QUICK:
        scene = lift(rung, base="vessel", slew=-0.5 * np.pi)
        scene.add_sea(hs=1.0, tp=8.0, seed=3, direction_deg=60.0)
        with warnings.catch_warnings(action="ignore"):  # an unballasted lift at sea
            found[rung] = simulate(scene, 60.0)
    return found


@pytest.mark.parametrize("rung", QUICK[1:])
def test_any_rung_and_the_rod_print_the_same_rows(runs: dict[str, Result], rung: str) -> None:
    told, rod = summary(runs[rung]), summary(runs["rod"])
    assert [row.name for row in told] == [row.name for row in rod]
    for name in ("hook load", "hoist tension"):
        assert told[name].static_known and told[name].static == pytest.approx(MASS * G, rel=1e-12)
        assert told[name].factor == pytest.approx(rod[name].factor, rel=0.01)
    for name in ("payload swing", "offlead", "sidelead", "payload offset y"):
        assert told[name].maximum == pytest.approx(rod[name].maximum, rel=0.03)


@pytest.mark.warns("BallastWarning")
@pytest.mark.parametrize("rung", ["rod", "elastic"])
def test_lead_and_swing_are_those_of_the_recorded_poses(runs: dict[str, Result], rung: str) -> None:
    """Offlead along the jib, sidelead across it to its left, by quaternions; the crane slews about z."""
    run, roles = runs[rung], runs[rung].scene.roles[""]
    assert roles.tip is not None and roles.slew is not None
    body, point = roles.tip
    turn = rotation_matrix(run.select("quaternion", body=body))
    lever = np.asarray(point) - run.scene.bodies[body].center_of_mass
    tip = run.select("position", body=body) + turn @ lever
    top = rotation_matrix(run.select("quaternion", body="payload")) @ np.array([0.0, 0.0, 0.5 * SIZE[2]])
    hang = run.select("position", body="payload") + top - tip
    slew = run.scene.joints[roles.slew[0]]
    out = tip - run.place_of(slew.first, slew.first_frame.point)
    along = out[:, :2] / np.linalg.norm(out[:, :2], axis=1, keepdims=True)
    ahead = np.einsum("ij,ij->i", hang[:, :2], along)
    left = hang[:, 1] * along[:, 0] - hang[:, 0] * along[:, 1]
    assert run["offlead"] == pytest.approx(np.arctan2(ahead, -hang[:, 2]), abs=1e-12)
    assert run["sidelead"] == pytest.approx(np.arctan2(left, -hang[:, 2]), abs=1e-12)
    again = simulate(run.scene, 1.0, channels=["swing", "sling_angle"])
    swing = np.arctan2(np.hypot(hang[:, 0], hang[:, 1]), -hang[:, 2])[: again.time.size]
    assert again["swing"] == pytest.approx(swing, abs=1e-6)
    assert again["sling_angle"][:, 0] == pytest.approx(0.5 * np.pi - swing, abs=1e-6)


@pytest.mark.parametrize(("rung", "wire"), [("rigid", 0.0), ("elastic", 0.0), ("with mass", 20.0 * LENGTH)])
def test_statics_and_charts_are_those_of_the_rod_but_for_the_wire(rung: str, wire: float) -> None:
    """At its upper end its own weight is on it too; in poses metres away what hangs is led along."""
    rod, told = (statics(lift(one), slew=[0.0, 0.5]) for one in ("rod", rung))
    assert [name for name in told.columns if not name.startswith("line ")] == list(rod.columns)
    more = told["hoist tension"] - rod["hoist tension"]
    assert more == pytest.approx(wire * G, rel=2e-3, abs=1e-6 * MASS * G)
    if not wire:
        assert told["cylinder force main"] == pytest.approx(rod["cylinder force main"], rel=1e-6)
    assert told["hook load"] == pytest.approx(MASS * G, rel=1e-6)
    charts = [load_chart(lift(one), radii=[14.0, 18.0], limits={"cylinder force main": 9e6})
              for one in ("rod", rung)]  # fmt: skip
    assert charts[1].allowable + wire == pytest.approx(charts[0].allowable, rel=2e-5 if wire else 1e-5)


def thrown(rung: str) -> Scene:
    """So fast from below its line of 5 m that it goes slack on its way round."""
    scene = below((0.0, 0.0, -6.0), mass=MASS, size=SIZE, velocity=(np.sqrt(4.0 * 5.0 * G), 0.0, 0.0))
    if rung == "rod":
        ends = {"first_frame": Frame(), "second_frame": Frame(), "length": 6.0}
        scene.add_joint(kind="distance", name="hoist", first="ground", second="load", **ends)
        return scene
    taut = {} if rung == "rigid" else {"EA": 1e7, "tension_at_start": 5.0 * MASS * G}
    scene.add_line(name="hoist", first="ground", second="load", rung=rung, **taut)  # type: ignore[arg-type]
    return scene


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("rung", ["rod", "rigid", "auto"])
def test_a_rung_that_knows_no_snap_tells_no_factor(rung: str) -> None:
    """Only the line that stretches tells a factor where it goes slack."""
    told = summary(simulate(thrown(rung), 3.0))
    row = told["hook load hoist"]
    assert row.static == pytest.approx(MASS * G) and row.minimum < 0.02 * MASS * G
    knows = rung == "auto"
    assert row.blind != knows and (row.factor is not None) == knows
    assert ("knows no snap" in str(told)) != knows


def rigged(design_factor: float) -> Scene:
    """Block and four slings at 60 degrees on two falls."""
    scene, slings = Scene(name="rigged"), Slings(angle_deg=60, EA=8e7)
    scene.add_crane(base="ground", design_factor=design_factor)
    scene.add_hoist(mass=MASS, size=SIZE, falls=2, EA=1e8, block_mass=2e3, slings=slings)
    return scene


def test_margins_and_angles_of_a_rigged_load() -> None:
    """The hook carries block and load, a sling its share at rest; they stand at 60 degrees."""
    recorded = ["hook_load", "line_tension", "slack_margin", "sling_angle", "swing"]
    run = simulate(rigged(1.0), 1.0, channels=recorded)
    told = summary(run)
    assert told["hook load"].static == pytest.approx((MASS + 2e3) * G)
    assert told["hoist tension"].static == pytest.approx(0.5 * (MASS + 2e3) * G, rel=1e-12)
    assert run.coords["weighed"] == ("hoist", *(f"hoist sling {i}" for i in range(1, 5)))
    assert run["slack_margin"] == pytest.approx(1.0, abs=1e-3)
    for number in range(1, 5):
        angle = run.select("sling_angle", suspension=f"hoist sling {number}")
        assert np.degrees(angle) == pytest.approx(60.0, abs=0.1)


def test_utilisation_is_the_hook_load_over_the_table_with_its_design_factor() -> None:
    scene = rigged(1.3)
    scene.roles[""] = replace(scene.roles[""], capacity=((10.0, 60e3), (40.0, 50e3)))
    run = simulate(scene, 1.0, channels=["utilisation", "hook_load"])
    radius = float(statics(scene)["tip radius"])
    allowed = np.interp(radius, [10.0, 40.0], [60e3, 50e3]) * 1.3 * G
    hook = run.select("hook_load", suspension="hoist")
    assert run["utilisation"] == pytest.approx(hook / allowed, rel=1e-3)


LOAD = 1e4  # kg


def hung(bodies: list[str], points: list[tuple[float, float, float]], tension: float) -> Scene:
    """A load on a line with its falls, at rest."""
    scene = Scene(name="hung", gravity=G)
    scene.add_body(name="load", mass=LOAD, inertia=(1e4, 1e4, 1e4), position=(0.0, 0.0, -20.0))
    scene.add_line(
        name="hoist", bodies=bodies, points=points, EA=1e8, tension_at_start=tension, damping_ratio=0.1
    )
    scene.add_winch(line="hoist")
    return scene


def test_a_line_carries_the_weight_by_all_its_falls() -> None:
    """And has a dynamic factor and a slack margin over the weight, whatever the run began with."""
    falls = 3
    scene = hung(["ground", "load"] * 2, [(0.0, 0.0, 0.0)] * 4, LOAD * G / falls)
    result = simulate(scene, 1.0, dt_out=0.25, channels=["hook_load", "line_tension"])
    assert result.coords["suspension"] == ("hoist",)
    assert_allclose(result["hook_load"], LOAD * G, rtol=1e-4)
    assert_allclose(result["hook_load"][:, 0], falls * result["line_tension"][:, 0], rtol=1e-12)
    scene.replace("load", position=(0.0, 0.0, -19.995))
    scene.add_limit_state(channel="hook_load", maximum=1e6)
    table = summary(simulate(scene, 2.0, dt_out=0.01))
    tension, hook = table["hoist tension hoist"], table["hook load hoist"]
    assert tension.static_known and tension.static == pytest.approx(LOAD * G / falls)
    assert hook.static == pytest.approx(LOAD * G)
    for row in (tension, hook):
        assert row.factor == pytest.approx(row.maximum / row.static) and row.factor > 1.01
        assert row.slack_margin == pytest.approx(row.minimum / row.static) and row.slack_margin < 0.99


def test_a_drum_on_deck_does_not_count_as_the_hook() -> None:
    """From a drum over the tip to the load: the load is reached last, though it is named in the middle."""
    points = [(30.0, 0.0, -20.0), *[(0.0, 0.0, 0.0)] * 3]
    scene = hung(["ground", "ground", "load", "ground"], points, 0.5 * LOAD * G)
    result = simulate(scene, 0.5, dt_out=0.25, channels=["hook_load", "line_tension"])
    assert_allclose(result["hook_load"][:, 0], 2.0 * result["line_tension"][:, 0], rtol=1e-12)
    assert_allclose(result["hook_load"], LOAD * G, rtol=1e-3)


HELD = 40e3  # kg


def hang(scene: Scene, tip: tuple[str, Any], *, drum: tuple[str, Any] | None = None) -> None:
    """A load at rest on a hoist from the tip; with a drum its rope runs on to there."""
    place = scene.place_of(body=tip[0], point=tip[1]) - (0.0, 0.0, 12.0)
    scene.add_body(name="load", mass=HELD, inertia=(HELD, HELD, HELD), position=place)
    path = [*([drum] if drum else []), tip, ("load", (0.0, 0.0, 0.0))]
    scene.add_line(
        name="hoist", bodies=[body for body, _ in path], points=[point for _, point in path], EA=3e8,
        tension_at_start=HELD * scene.gravity,
    )  # fmt: skip
    scene.add_winch(line="hoist")


def lattice(*, drum: bool = False, link: bool = False) -> Scene:
    scene, load = Scene(name="lattice"), Payload(mass=HELD, size=(3.0, 3.0, 3.0)) if link else None
    pose: dict[str, Any] = {"foot": (0, 0, 0), "coordinates": {"boom": 0.9}, "held": True}
    scene.add_crane(load_crane("lattice_boom_100t"), base="ground", payload=load, damping=False, **pose)
    if not link:
        hang(scene, ("boom", (-48.0, 0.0, 0.0)), drum=("house", (4.0, 0.0, 2.0)) if drum else None)
    scene.add_winch("luffing rope")
    return scene


def test_a_load_on_a_hoist_pulls_at_the_luffing_rope_and_one_that_runs_to_the_house_relieves_it() -> None:
    """By its tension times the lever arm of its upper part about the hinge, over falls and their arm."""
    plain, over, linked = lattice(), lattice(drum=True), lattice(link=True)
    pull, relieved, alike = (
        float(simulate(scene, 0.1, dt_out=0.1).select("line_tension", line="luffing rope")[0])
        for scene in (plain, over, linked)
    )
    assert pull == pytest.approx(alike, rel=1e-7)
    head = 48.0 * np.array([-math.cos(0.9), math.sin(0.9)])
    mast = np.array([8.0, 13.0])
    drum = np.asarray(over.place_of(body="house", point=(4.0, 0.0, 2.0)))[[0, 2]] - (-2.0, 15.0)

    def arm(to: Any) -> float:
        way = (to - head) / np.linalg.norm(to - head)
        return abs(float(head[0] * way[1] - head[1] * way[0]))

    assert pull - relieved == pytest.approx(HELD * G * arm(drum) / arm(mast) / 12.0, rel=1e-7)
    for scene, within in ((plain, 1e-5), (over, 1e-4)):
        assert np.ptp(simulate(scene, 3.0, dt_out=0.5).select("position", body="load", axis="z")) < within


def knuckle(payload: Payload | None = None) -> Scene:
    scene, pose = Scene(name="oil"), {"slew": -1.0, "s1": 2.0, "s2": 3.0}
    oil = {"main": OIL, "knuckle": OIL}
    scene.add_crane(base="ground", payload=payload, damping=False, hydraulics=oil, held=True, **pose)
    return scene


def test_pressures_hold_a_load_that_hangs_on_a_winch() -> None:
    linked, hoisted = knuckle(Payload(mass=HELD)), knuckle()
    hang(hoisted, hoisted.roles[""].tip)
    found = hoisted.hold_pressures()
    for name, ram in found.items():
        assert ram.pressure == pytest.approx(linked.loads[name].pressure, rel=1e-9)
        assert hoisted.loads[name] == ram
    result = simulate(hoisted, 2.0, dt_out=0.5, rtol=1e-7)
    assert np.ptp(result["hydraulic_stroke"], axis=0) == pytest.approx(0.0, abs=1e-6)
    scene = knuckle()
    scene.add_body(name="load", mass=HELD, inertia=(HELD, HELD, HELD), position=(0, 0, 50))
    with pytest.raises(SceneError, match=r"body 'load' accelerates by 9.81"):
        scene.hold_pressures()


@pytest.mark.parametrize("rung", ["elastic", "quasi-static"])
def test_a_line_with_all_points_on_one_body_is_told(rung: Any) -> None:
    scene = Scene(name="stay")
    scene.add_vessel(shipped_database(), name="ship")
    ends = {"first_point": (0, 0, 5), "second_point": (10, 0, 5)}
    scene.add_line("stay", first="ship", second="ship", EA=1e7, length=9.99, rung=rung, **ends)
    with pytest.raises(SceneError, match=r"line 'stay': has all its points on 'ship', which it cannot move"):
        simulate(scene, 1.0)
