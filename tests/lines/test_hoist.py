"""add_hoist: what hangs from a crane, in one call, at rest, against closed forms."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import scipy.linalg

from seacrane import Scene, SceneError, Stage, Until, shipped_database, simulate
from seacrane.analysis import equilibrium, natural_modes
from seacrane.scene import Slings

G = 9.80665
BOX: dict[str, Any] = {"mass": 20e3, "size": (4.0, 4.0, 3.0)}


def hoisted(**given: Any) -> Scene:
    scene = Scene(name="hoisted")
    scene.add_crane(base="ground", s1=1.5, s2=1.0, held=True)
    scene.add_hoist(**given)
    return scene


@pytest.mark.parametrize(
    "given",
    [{"EA": 3e7, "falls": 4}, {"stiffness": 2e6, "falls": 3, "rung": "quasi-static"}, {"rung": "rigid"},
     {"EA": 3e7, "falls": 2, "block_mass": 1e3, "slings": {"angle_deg": 60, "EA": 5e7}},
     {"EA": 3e7, "block_mass": 1e3, "slings": Slings(length=5.0, EA=5e7), "winch": True}],
)  # fmt: skip
def test_it_starts_at_rest(given: dict[str, Any]) -> None:
    scene = hoisted(**BOX, **given)
    result = simulate(scene, 5.0)
    weight = (BOX["mass"] + given.get("block_mass", 0.0)) * G
    assert result.select("hook_load", suspension="hoist") == pytest.approx(weight, rel=1e-4)
    assert np.ptp(result.curve("position[load, z]")) < 1e-5
    tip = scene.place_of(body=scene.roles[""].tip[0], point=scene.roles[""].tip[1])  # type: ignore[index]
    assert scene.bodies["load"].position[:2] == pytest.approx(tip[:2])


def test_falls_and_slings_are_as_stiff_as_by_hand() -> None:
    """Static stretch under a further weight: n falls of EA / L, four slings at an angle, in series."""
    EA, falls, angle, heights = 2e7, 2, np.radians(60.0), []
    for mass in (20e3, 22e3):
        scene = hoisted(**BOX, EA=EA, falls=falls, block_mass=1e3, slings={"angle_deg": 60.0, "EA": 3e7})
        scene.replace("load", mass=mass)
        heights.append(simulate(scene, 0.1, start="rest").curve("position[load, z]")[0])
    reach = np.hypot(2.0, 2.0)
    sling = 4 * 3e7 / (reach / np.cos(angle)) * np.sin(angle) ** 2
    hand = 2e3 * G * (8.0 / (falls * EA) + 1.0 / sling)
    assert heights[0] - heights[1] == pytest.approx(hand, rel=0.01)


def test_block_and_load_swing_as_a_double_pendulum() -> None:
    """10 t on 15 m of wire, 80 t on slings of 6 m below it: 9.63, 1.88 s about x and 9.73, 2.59 s about y."""
    m1, m2, l1, drop, size = 10e3, 80e3, 15.0, 6.0 + 2.5, np.array([12.0, 4.0, 5.0])
    scene = Scene()
    scene.add_crane(base="ground", s1=3.5, s2=2.0, held=True)
    points = [(x, y, 2.5) for x in (5.0, -5.0) for y in (2.0, -2.0)]
    scene.add_hoist(mass=m2, size=size, length=l1, stiffness=4e9, block_mass=m1, damping=False,
                    slings={"length": np.sqrt(65.0), "EA": 1e10, "points": points})  # fmt: skip
    found = natural_modes(scene, state=equilibrium(scene)).natural_period
    for inertia in m2 / 12 * (size @ size - size**2)[:2]:
        stiffness = G * np.diag([(m1 + m2) * l1, m2 * drop])
        mass = np.array([[(m1 + m2) * l1**2, m2 * l1 * drop], [m2 * l1 * drop, m2 * drop**2 + inertia]])
        for omega2 in scipy.linalg.eigh(stiffness, mass)[0]:
            assert np.abs(found * np.sqrt(omega2) / (2.0 * np.pi) - 1.0).min() < 1e-4


def test_it_hangs_at_a_height_or_stands_on_a_deck_and_is_lifted_off() -> None:
    assert hoisted(**BOX, EA=3e7, height=2.0).bodies["load"].position[2] == pytest.approx(3.5)
    scene = Scene()
    scene.add_vessel(motion="rest")
    scene.add_crane(s1=1.5, s2=1.0, held=True)
    slings = {"length": 5.0, "EA": 5e7}
    how: dict[str, Any] = {"block_mass": 500.0, "slings": slings, "winch": {"lag": 0.1}}
    scene.add_hoist(**BOX, EA=3e7, on="vessel", height=8.0, **how)
    still = simulate(scene, 2.0)
    assert still.select("hook_load", suspension="hoist") == pytest.approx(500.0 * G, rel=1e-3)
    assert np.ptp(still.curve("position[load, z]")) < 1e-6
    until = Until.release("load on vessel")
    lift = Stage(name="lift", until=until, maximum_duration=30.0, commands={"hoist.rate": -0.1})
    lifted = simulate(scene, [lift, Stage(name="up", duration=20.0)])
    assert lifted.stages[0].ended_by and lifted.curve("position[load, z]")[-1] > 10.0
    assert lifted.select("hook_load", suspension="hoist")[-1] == pytest.approx(20.5e3 * G, rel=0.02)


def test_on_feet_it_is_what_is_built_by_hand() -> None:
    """On a turned deck; the load is lifted off and comes down again."""
    scenes, height, (x, y, z) = (Scene(), Scene()), 2.0, 0.5 * np.array(BOX["size"])
    for scene in scenes:
        scene.add_vessel(motion="rest", name="feeder", position=(3.0, -2.0, 0.0), heading_deg=30.0)
        scene.add_crane(base="ground", s1=1.5, s2=1.0, held=True)
    made, hand = scenes
    how: dict[str, Any] = {"slack": 0.1, "winch": {"lag": 0.2}, "damping": False, "feet": {"friction": 0.4}}
    body, head = made.add_hoist(**BOX, EA=3e8, on="feeder", height=height, **how).tip  # type: ignore[misc]
    tip = hand.place_of("tip")
    turned = hand.bodies["feeder"].quaternion
    hand.add_body("load", **BOX, position=(*tip[:2], height + z), quaternion=turned)
    corners = [(a, b, -z) for a in (-x, x) for b in (-y, y)]
    hand.add_contact("load", on="feeder", points=corners, place=(0.0, 0.0, height), friction=0.4)
    length = tip[2] - height - 2.0 * z + 0.1
    hand.add_line("hoist", bodies=[body, "load"], points=[head, (0.0, 0.0, z)], EA=3e8, length=length)
    hand.add_winch("hoist", lag=0.2)
    assert made.loads["load on feeder"] == hand.loads["load on feeder"]
    up = Until.clear("load on feeder", minimum=0.2)
    lift = [Stage(name="up", until=up, maximum_duration=20.0, commands={"hoist.rate": -0.3}),
            Stage(name="down", duration=3.0, commands={"hoist.rate": 0.3})]  # fmt: skip
    runs = [simulate(scene, lift, rtol=1e-8, channels=["position", "contact_press"]) for scene in scenes]
    assert runs[0].stages[0].ended_by
    one, other = (run.select("position", body="load")[-1] for run in runs)
    assert one == pytest.approx(other, abs=1e-6)
    assert runs[0]["contact_press"][-1].sum() == pytest.approx(BOX["mass"] * G, rel=0.05)


def test_a_ship_beside_a_load_on_rough_feet_is_ballasted() -> None:
    """A load that only touches its deck does not press on it yet: the search for rest sets it down."""
    weights = []
    for feet in ({"friction": 0.4}, True):
        scene = Scene()
        scene.add_vessel(shipped_database())
        scene.add_crane(slew=-np.pi / 2, s1=1.0, s2=2.0)
        x, y, _ = scene.place_of("tip")
        scene.add_vessel(motion="rest", name="barge", position=(x, y, 0.0))
        scene.add_hoist(**BOX, EA=6e7, on="barge", height=3.0, slack=1.5, feet=feet)
        weights.append(scene.add_ballast(vessel="vessel").weight)
    assert weights[0] == pytest.approx(weights[1], rel=1e-6)


def test_slack_is_what_the_winch_takes_in_before_the_line_pulls() -> None:
    """By hand: slack and stretch of all falls at a rate that takes a ramp of 1 s to be reached."""
    scene, falls = Scene(), 4
    scene.add_crane(base="ground", s1=1.5, s2=1.0, held=True)
    roles = scene.add_hoist(**BOX, EA=3e8, falls=falls, on="ground", slack=0.2, winch={"lag": 0.0})
    path = scene.place_of(body=roles.tip[0], point=roles.tip[1])[2] - BOX["size"][2]
    assert scene.loads["hoist"].length.evaluate([0.0])[0, 0] == pytest.approx(falls * (path + 0.2), rel=1e-9)
    lift = Stage(name="lift", until=Until.release("load on ground"), maximum_duration=30.0,
                 commands={"hoist.rate": -0.4})  # fmt: skip
    (span,) = simulate(scene, [lift]).stages
    stretch = 20e3 * G * path / (falls * 3e8)
    assert span.end == pytest.approx(0.5 + (0.2 + stretch) * falls / 0.4, rel=0.01)


def test_an_existing_body_stays_a_ship_turns_the_load_and_slings_take_a_rung() -> None:
    scene = Scene()
    scene.add_crane(base="ground", s1=1.5, s2=1.0, held=True)
    scene.add_body("anode", mass=5e3, size=(1, 1, 1), position=(20.0, 1.0, 2.0))
    roles = scene.add_hoist(load="anode", EA=3e7)
    assert roles.payload == "anode" and roles.line == "hoist" and roles is scene.roles[""]
    assert scene.bodies["anode"].position == pytest.approx([20.0, 1.0, 2.0])
    with pytest.raises(SceneError, match="hangs on the crane already"):
        scene.add_hoist(**BOX, EA=3e7)
    turned = Scene()
    turned.add_vessel(shipped_database(), heading_deg=90.0)
    turned.add_crane(s1=1.5)
    turned.add_hoist(**BOX, EA=3e7)
    w, _, _, z = turned.bodies["load"].quaternion
    assert 2.0 * np.degrees(np.arctan2(z, w)) == pytest.approx(90.0)
    slung = hoisted(**BOX, EA=3e7, block_mass=1e3, slings=SLUNG | {"rung": "quasi-static"})
    assert {one.rung for name, one in slung.loads.items() if "sling" in name} == {"quasi-static"}


def test_a_load_described_inside_or_below_its_deck_is_named() -> None:
    """Height of its centre over the deck, along the deck's normal: the barge lies heeled by 10 deg."""
    scene, deck = Scene(), np.array([3.0, 1.0, 5.0])
    heeled = (np.cos(np.radians(5.0)), np.sin(np.radians(5.0)), 0.0, 0.0)
    normal = np.array([0.0, -np.sin(np.radians(10.0)), np.cos(np.radians(10.0))])
    scene.add_body("barge", mass=1e6, size=(40, 20, 4), position=(0, 0, 3), quaternion=heeled)
    for name, over in (("good", 1.5), ("in", -0.5), ("under", -9.0)):
        scene.add_body(name, mass=2e4, size=(4, 4, 3), position=deck + over * normal, quaternion=heeled)
        scene.add_joint(name, kind="weld", first="barge", second=name, point=deck, axis=normal)
    scene.add_stop("good")
    for name, words in (("in", "inside 'barge', .* raise it by 2 m"), ("under", "below .* by 10.5 m")):
        with pytest.raises(SceneError, match=words):
            scene.add_stop(name)


SLUNG = {"angle_deg": 60, "EA": 5e7}


@pytest.mark.parametrize(
    ("given", "words"),
    [({"falls": 2, "wire": {"mass_per_length": 9}}, "has one fall"), ({"slings": SLUNG}, "block_mass is 0"),
     ({"block_mass": 1e3, "slings": {"length": 2.0, "EA": 1e7}}, r"give more than 2\.828"),
     ({"block_mass": 1e3, "slings": SLUNG | {"angle_deg": 95}}, "between 0 and 90"),
     ({"height": 500.0}, "above the tip"), ({"height": 1.0, "length": 3.0}, "a length and a height"),
     ({"stiffness": 1e6}, "one of them"), ({"crane": "aft "}, "prefixes of the scene's cranes"),
     ({"slack": 0.2}, "its load stands on a deck"), ({"feet": True}, "feet and no deck"),
     ({"on": "ground", "feet": {"place": (0, 0, 1)}}, "feet has 'place'"), ({"winch": 3}, "winch is 3"),
     ({"on": "ground", "slack": 0.2, "block_mass": 1e3}, "has no block")],
)  # fmt: skip
def test_what_does_not_fit_is_named_and_leaves_the_scene_as_it_was(given: dict[str, Any], words: str) -> None:
    scene = Scene()
    scene.add_crane(base="ground", s1=1.5, s2=1.0, held=True)
    before = scene.copy()
    told = BOX | {"EA": 3e7} | given
    with pytest.raises(SceneError, match=words):
        scene.add_hoist(**{key: value for key, value in told.items() if value is not None})
    assert scene == before
