"""GM solid and fluid, ships that capsize, motions that grow; ballast against closed forms and its bounds."""

from __future__ import annotations

import warnings
from pathlib import Path

import numpy as np
import pytest
from test_statics import C33, C44, C55, LOAD, MASS, G, barge, hanging, lashed

from seacrane import Scene, SceneError, equilibrium, natural_modes, simulate, statics
from seacrane.crane import Payload
from seacrane.hydro import HydroDatabase, load_database, shipped_database
from seacrane.scene import Tank
from seacrane.warnings import InfiniteFrequencyWarning, MemoryFitWarning, UnstableRestWarning

KINDS = ("per-pair", "by-motion", "convolution")


@pytest.fixture(scope="module")
def supply(shared: Path) -> HydroDatabase:
    return load_database(shared / "veres" / "supply")


def afloat(database: HydroDatabase, memory: str = "per-pair", slack_moment: float = 0.0) -> Scene:
    scene = Scene(name="supply")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", InfiniteFrequencyWarning)
        warnings.simplefilter("ignore", MemoryFitWarning)
        scene.add_vessel(database, memory=memory, slack_moment=slack_moment)
    return scene


def test_gm_is_told_solid_and_fluid_with_its_spread_over_fits(supply: HydroDatabase) -> None:
    told = {kind: statics(afloat(supply, kind)) for kind in KINDS}
    solid = supply.restoring[3, 3] / (supply.mass_matrix[0, 0] * supply.g)
    fluid = [float(one["GM"]) for one in told.values()]
    for one in told.values():
        assert one["GM solid"] == pytest.approx(solid, rel=1e-3)
        assert one["GM spread"] == pytest.approx(max(fluid) - min(fluid), rel=0.01)
    assert solid == pytest.approx(2.14, abs=0.01)
    assert 1.42 < min(fluid) < max(fluid) < 1.48


def test_a_slack_tank_takes_its_moment_over_the_displacement(tmp_path: Path) -> None:
    scene = barge()
    before = statics(scene)
    assert "GM solid" not in before.columns
    scene = barge(slack_moment=1.5e6)
    told = statics(scene)
    assert told["GM"] == pytest.approx(float(before["GM"]) - 1.5e6 / MASS, rel=1e-9)
    assert told["GM solid"] == pytest.approx(float(before["GM"]), rel=1e-9)
    assert told["GM spread"] == 0.0
    loaded = lashed(scene, (0.0, 1.0, 5.0))
    lever = LOAD * G * 1.0 / (C44 - 1.5e6 * G - LOAD * G * 5.0)
    assert float(statics(loaded)["heel"]) == pytest.approx(-lever, rel=1e-2)
    loaded.save(tmp_path / "slack.json")
    again = Scene.load(tmp_path / "slack.json")
    assert again.provenance == loaded.provenance
    assert statics(again)["GM solid"] == statics(loaded)["GM solid"]


def test_a_slack_tank_stays_beside_the_matrices_of_a_database(supply: HydroDatabase) -> None:
    periods = []
    for moment in (0.0, 1e6):
        scene = afloat(supply, "convolution", slack_moment=moment)
        modes = natural_modes(scene, memory="database", database=supply)
        periods.append(modes.natural_period[modes.find("vessel roll")])
    assert periods[1] > 1.02 * periods[0]


@pytest.mark.warns("LoadInHullWarning")
def test_statics_tells_a_ship_that_capsizes_and_how_fast() -> None:
    scene, light = (hanging(barge(), y=0.0, mass=share * C44 / (G * 20.0)) for share in (1.1, 0.9))
    with pytest.warns(UnstableRestWarning, match=r"GM -\S+ m: .* grows, doubling in"):
        assert statics(scene)["GM"] < 0.0
    for call in (scene.compile, lambda: simulate(scene, 0.1)):
        with pytest.warns(UnstableRestWarning, match="grows|'hull': has a GM of about -0"):
            call()
    with warnings.catch_warnings(action="error", category=UnstableRestWarning):
        light.compile()
        equilibrium(light)


def test_modes_tell_what_grows() -> None:
    post = Scene(name="post")
    post.add_body(name="post", mass=1e3, inertia=(10.0,) * 3, position=(0, 0, 1.0))
    post.add_joint("foot", kind="revolute", first="ground", second="post", point=(0, 0, 0), axis=(0, 1, 0))
    with pytest.warns(UnstableRestWarning):
        modes = natural_modes(post)
    rate = np.sqrt(1e3 * G / (10.0 + 1e3))
    assert modes.real_eigenvalues == pytest.approx([-rate, rate], rel=1e-6)
    assert f"grows, doubling in {np.log(2.0) / rate:.3g} s" in str(modes.table())


def tanks(
    *, y: float = 8.0, capacity: float = 1e6, content: float = 5e5, ends: bool = True
) -> dict[str, Tank]:
    """A pair across of a capacity and content, and a pair along."""
    wings = {"port": (0.0, y, 0.0), "starboard": (0.0, -y, 0.0)}
    out = {name: Tank(point=at, capacity=capacity, content=content) for name, at in wings.items()}
    for name, x in {"fore": 30.0, "aft": -30.0}.items() if ends else ():
        out[name] = Tank(point=(x, 0.0, 0.0), capacity=1e6, content=5e5)
    return out


def crane_ship(heading_deg: float = 0.0) -> Scene:
    scene = Scene(name="ship")
    scene.add_vessel(shipped_database(), memory="none", heading_deg=heading_deg)
    scene.add_crane(payload=Payload(mass=20e3))
    return scene


def rest(scene: Scene) -> tuple[float, float, float]:
    told = statics(scene)
    heel, trim = (float(np.degrees(told[name].item())) for name in ("heel", "trim"))
    return heel, trim, told["draught change"].item()


def test_one_force_carries_the_weights_below_their_centre() -> None:
    scene = lashed(barge(), (0.0, 3.0, 2.0))
    ballast = scene.add_ballast()
    assert rest(scene) == pytest.approx((0.0, 0.0, 0.0), abs=1e-6)
    assert ballast.weight == pytest.approx(-LOAD * G) and ballast.center == pytest.approx([0.0, 3.0, 0.0])
    assert scene.point_forces["ballast"].force[2] == pytest.approx(LOAD * G)


@pytest.mark.parametrize(("heel", "trim"), [(0.0, 0.0), (2.0, -0.5), (-3.0, 1.0)])
def test_a_crane_ship_rests_at_the_heel_and_trim_asked_for(heel: float, trim: float) -> None:
    scene = crane_ship(heading_deg=30.0)
    scene.add_ballast(heel_deg=heel, trim_deg=trim)
    assert rest(scene)[:2] == pytest.approx((heel, trim), abs=1e-6)


def test_heel_by_a_shift_of_water_in_closed_form() -> None:
    """Shifting m across 2 y gives C44 phi = 2 m g y cos(phi); the least is moved, and nothing is taken in."""
    scene, phi = barge(), np.radians(2.0)
    ballast = scene.add_ballast(heel_deg=2.0, tanks=tanks())
    moved = C44 * phi / (G * 8.0 * np.cos(phi))  # kg, as a sum of both tanks
    assert abs(ballast.changes["port"]) + ballast.changes["starboard"] == pytest.approx(moved, rel=1e-6)
    assert ballast.changes["starboard"] >= 0.0 >= ballast.changes["port"], "a positive heel lifts port"
    assert rest(scene)[0] == pytest.approx(2.0, rel=1e-6)


def test_trim_by_water_in_closed_form() -> None:
    scene, theta = barge(), np.radians(0.5)
    ballast = scene.add_ballast(trim_deg=0.5, tanks=tanks(capacity=4e5, content=2e5))
    moved = C55 * theta / (G * 30.0 * np.cos(theta))
    assert abs(ballast.changes["aft"]) + ballast.changes["fore"] == pytest.approx(moved, rel=1e-6)
    assert rest(scene)[1] == pytest.approx(0.5, rel=1e-6)
    assert rest(scene)[2] == pytest.approx(sum(ballast.changes.values()) * G / C33, abs=1e-6)


def test_two_wing_tanks_correct_a_heel_and_leave_the_trim_as_it_comes() -> None:
    """A load at (x, y): water takes its moment about x, across 2 y of the tanks; C55 theta = x W is left."""
    scene = barge()
    scene.add_body("box", mass=LOAD, inertia=LOAD * np.eye(3), position=(10.0, 3.0, 0.0))
    scene.add_joint("lashed", kind="weld", first="hull", second="box", point=(10.0, 3.0, 0.0))
    ballast = scene.add_ballast(trim_deg=None, tanks=tanks(ends=False))
    assert ballast.changes["starboard"] - ballast.changes["port"] == pytest.approx(LOAD * 3.0 / 8.0, rel=1e-3)
    heel, trim, _ = rest(scene)
    assert heel == pytest.approx(0.0, abs=1e-6) and np.radians(trim) == pytest.approx(ballast.trim, rel=1e-6)
    assert ballast.trim == pytest.approx(10.0 * LOAD * G / C55, rel=1e-2)


def test_what_makes_no_ballast_is_refused() -> None:
    """50 t at 3 m take 18.75 t across by 8 m: port gives its 10 t, starboard has room for 1 t of 8.75 t."""
    scene, dry = lashed(barge(), (0.0, 3.0, 0.0)), tanks(content=1e3)
    del dry["starboard"]
    for call, words in (
        (lambda: scene.add_ballast(tanks=tanks(capacity=1.1e4, content=1e4)),
         "'starboard' would have to hold 18750 kg.*11000 kg"),
        (lambda: scene.add_ballast(tanks=dry), "'port' would have to give .* holds 1000 kg"),
        (barge().add_ballast, "'hull' carries no body"),
        (lambda: scene.add_ballast(heel_deg=40.0), "heel_deg is 40"),
        (lambda: barge(slack_moment=1e9), "slack_moment is 1000000000.0 kg m"),
        (lambda: Tank(point=(0.0, 0.0, 0.0), capacity=4.0, content=5.0), "content is 5"),
    ):  # fmt: skip
        with pytest.raises(SceneError, match=words):
            call()
    assert not scene.point_forces, "nothing is added where it is refused"
    scene.add_ballast(tanks=tanks(capacity=4e4, content=1e4))
    assert rest(scene)[:2] == pytest.approx((0.0, 0.0), abs=1e-6)
