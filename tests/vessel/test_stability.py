"""GM solid and fluid, ships that capsize or heel too far, ballast beside the hull, and motions that grow."""

from __future__ import annotations

import warnings
from pathlib import Path

import numpy as np
import pytest
from lift_examples import HEAD
from test_statics import C44, LOAD, MASS, G, barge, hanging, on_deck

from seacrane import Lift, Scene, SceneError, equilibrium, natural_modes, simulate, statics
from seacrane.hydro import HydroDatabase, load_database, shipped_database
from seacrane.scene import Tank
from seacrane.warnings import (
    BallastOutsideHullWarning,
    InfiniteFrequencyWarning,
    LargeHeelWarning,
    MemoryFitWarning,
    UnstableRestWarning,
)

KINDS = ("per-pair", "by-motion", "convolution")


@pytest.fixture(scope="module")
def supply(shared: Path) -> HydroDatabase:
    return load_database(shared / "veres" / "supply")


def afloat(database: HydroDatabase, memory: str = "per-pair") -> Scene:
    scene = Scene(name="supply")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", InfiniteFrequencyWarning)
        warnings.simplefilter("ignore", MemoryFitWarning)
        scene.add_vessel(database, memory=memory)
    return scene


def post() -> Scene:
    """It stands on its hinge."""
    scene = Scene(name="post")
    scene.add_body(name="post", mass=1e3, inertia=(10.0,) * 3, position=(0, 0, 1.0))
    scene.add_joint(
        kind="revolute", name="foot", first="ground", second="post", point=(0, 0, 0), axis=(0, 1, 0)
    )
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
    scene.add_slack_tank(moment=1e6)
    scene.add_slack_tank(moment=5e5, vessel="hull")
    told = statics(scene)
    assert told["GM"] == pytest.approx(float(before["GM"]) - 1.5e6 / MASS, rel=1e-9)
    assert told["GM solid"] == pytest.approx(float(before["GM"]), rel=1e-9)
    assert told["GM spread"] == 0.0
    loaded = on_deck(scene, y=1.0, z=5.0)
    lever = LOAD * G * 1.0 / (C44 - 1.5e6 * G - LOAD * G * 5.0)
    assert float(statics(loaded)["heel"]) == pytest.approx(-lever, rel=1e-2)
    loaded.save(tmp_path / "slack.json")
    again = Scene.load(tmp_path / "slack.json")
    assert again.provenance == loaded.provenance
    assert statics(again)["GM solid"] == statics(loaded)["GM solid"]


def test_a_slack_tank_of_a_lift_file(tmp_path: Path) -> None:
    text = HEAD + '[vessel]\ndatabase = "hull_115"\nmemory = "none"\n[slack_tank]\nmoment_kg_m = 1e6\n'
    (tmp_path / "slack.toml").write_text(text, encoding="utf-8")
    scene = Lift.load(tmp_path / "slack.toml").scene()
    by_call = Scene(name=scene.name)
    by_call.add_vessel(shipped_database(), memory="none")
    by_call.add_slack_tank(moment=1e6)
    assert scene.vessels == by_call.vessels
    assert scene.provenance["vessel"].slack_tanks == (1e6 * scene.gravity, 0.0)


def test_a_slack_tank_stays_beside_the_matrices_of_a_database(supply: HydroDatabase) -> None:
    periods = []
    for moment in (0.0, 1e6):
        scene = afloat(supply, "convolution")
        scene.add_slack_tank(moment=moment)
        modes = natural_modes(scene, memory="database", database=supply)
        periods.append(modes.natural_period[modes.find("vessel roll")])
    assert periods[1] > 1.02 * periods[0]


@pytest.mark.parametrize("moment", [-1.0, 1e9, float("nan")])
def test_a_moment_beyond_the_restoring_is_refused(moment: float) -> None:
    with pytest.raises(SceneError, match="slack tank: moment"):
        barge().add_slack_tank(moment=moment)


@pytest.mark.warns("LoadInHullWarning")
def test_statics_tells_a_ship_that_capsizes_and_how_fast() -> None:
    heavy = 1.1 * C44 / (G * 20.0)
    scene = hanging(barge(), y=0.0, mass=heavy)
    with pytest.warns(UnstableRestWarning, match=r"1 of 1 poses; GM -\S+ m: .* grows, doubling in"):
        told = statics(scene)
    assert told["GM"] < 0.0
    with pytest.warns(UnstableRestWarning, match="does not stay at this rest: .* grows"):
        equilibrium(scene)
    with pytest.warns(UnstableRestWarning, match="vessel 'hull': has a GM of about -0"):
        scene.compile()
    with pytest.warns(UnstableRestWarning, match="vessel 'hull': has a GM of about -0"):
        simulate(scene, 0.1)


def test_a_ship_that_stays_is_not_told_of() -> None:
    light = hanging(barge(), y=0.0, mass=0.9 * C44 / (G * 20.0))
    with warnings.catch_warnings():
        warnings.simplefilter("error", UnstableRestWarning)
        light.compile()
        statics(light)
        equilibrium(light)


def test_statics_tells_heel_beyond_linear_restoring() -> None:
    with pytest.warns(LargeHeelWarning, match=r"heel is \S+ deg, beyond 20 deg in 1 of 1 poses"):
        statics(on_deck(barge(), y=12.0, z=0.0, mass=1e6))


def test_ballast_outside_the_hull_is_told_of() -> None:
    """The hull's radii of gyration make a ship of 89 m and 20 m."""
    with pytest.warns(BallastOutsideHullWarning, match=r"the force is at .* to port, 30 m outside a hull"):
        on_deck(barge(), y=39.8, z=0.0, mass=1e4).add_ballast()
    tank = {side: Tank(point=(0.0, y, 0.0), capacity=1e6, content=5e5) for side, y in (("p", 40), ("s", -40))}
    with pytest.warns(BallastOutsideHullWarning, match="tank 'p'"):
        barge().add_ballast(heel_deg=1.0, tanks=tank)


def test_the_table_of_modes_tells_what_grows() -> None:
    with pytest.warns(UnstableRestWarning):
        modes = natural_modes(post())
    rate = np.sqrt(1e3 * G / (10.0 + 1e3))
    assert modes.real_eigenvalues == pytest.approx([-rate, rate], rel=1e-6)
    assert len(modes.eigenvalues) == 0
    assert f"grows, doubling in {np.log(2.0) / rate:.3g} s" in modes.table().splitlines()[-1]


@pytest.mark.parametrize("memory", KINDS)
def test_the_table_has_the_six_motions_of_a_ship(supply: HydroDatabase, memory: str) -> None:
    labels = [" ".join(row.split()[:2]) for row in natural_modes(afloat(supply, memory)).table().splitlines()]
    for motion in ("surge", "sway", "heave", "roll", "pitch", "yaw"):
        assert f"vessel {motion}" in labels


def test_a_motion_that_nothing_brings_back_has_its_row() -> None:
    scene = barge()
    hull = scene.vessels["hull"]
    scene.replace(hull.name, kind="vessel", mooring_stiffness=[0.0, 0.0, 0.0])
    rows = natural_modes(scene).table().splitlines()
    for motion in ("surge", "sway", "yaw"):
        assert f"{'hull ' + motion:24}nothing brings it back" in rows
