"""Ballast: the rest state is what was asked for, tanks hold what closed forms say, and bounds are kept."""

from __future__ import annotations

import numpy as np
import pytest
from test_statics import C33, C44, C55, LOAD, G, barge, hanging, on_deck

from seacrane import Scene, SceneError, equilibrium, statics
from seacrane.crane import Payload
from seacrane.hydro import shipped_database
from seacrane.scene import Tank


def pair(*, y: float = 8.0, capacity: float = 4e5, content: float = 2e5) -> dict[str, Tank]:
    sides = {"port": y, "starboard": -y}
    return {
        name: Tank(point=(0.0, side, 0.0), capacity=capacity, content=content) for name, side in sides.items()
    }


def ends(**given: float) -> dict[str, Tank]:
    places = {"fore": 30.0, "aft": -30.0}
    return {name: Tank(point=(x, 0.0, 0.0), capacity=1e6, content=5e5) for name, x in places.items()}


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
    scene = on_deck(barge(), y=3.0, z=2.0)
    ballast = scene.add_ballast()
    assert rest(scene) == pytest.approx((0.0, 0.0, 0.0), abs=1e-6)
    assert ballast.weight == pytest.approx(-LOAD * G) and ballast.center == pytest.approx([0.0, 3.0, 0.0])
    assert scene.point_forces["ballast"].force[2] == pytest.approx(LOAD * G)


@pytest.mark.parametrize(("heel", "trim"), [(0.0, 0.0), (2.0, -0.5), (-3.0, 1.0)])
def test_a_crane_ship_rests_at_the_heel_and_trim_asked_for(heel: float, trim: float) -> None:
    scene = crane_ship(heading_deg=30.0)
    scene.add_ballast(heel_deg=heel, trim_deg=trim)
    assert rest(scene)[:2] == pytest.approx((heel, trim), abs=1e-6)


def test_tanks_turn_the_ship_upright_and_change_its_draught() -> None:
    places = {"pa": (-40.0, 9.0), "sa": (-40.0, -9.0), "pf": (40.0, 9.0), "sf": (40.0, -9.0)}
    tanks = {n: Tank(point=(x, y, 2.0), capacity=4e5, content=2e5) for n, (x, y) in places.items()}
    scene = crane_ship()
    ballast = scene.add_ballast(tanks=tanks)
    assert rest(scene)[:2] == pytest.approx((0.0, 0.0), abs=1e-6)
    assert all(-1e-6 <= kg <= 4e5 + 1e-6 for kg in ballast.contents.values())
    assert ballast.weight == pytest.approx(G * sum(ballast.changes.values()))
    assert "tank" in str(ballast) and "content [t]" in str(ballast)


def test_heel_by_a_shift_of_water_in_closed_form() -> None:
    """Shifting m across 2 y gives C44 phi = 2 m g y cos(phi); the least is moved, and nothing is taken in."""
    scene, phi = barge(), np.radians(2.0)
    tanks = pair(y=8.0, capacity=1e6, content=5e5) | ends()
    ballast = scene.add_ballast(heel_deg=2.0, tanks=tanks)
    moved = C44 * phi / (G * 8.0 * np.cos(phi))  # kg, as a sum of both tanks
    assert abs(ballast.changes["port"]) + ballast.changes["starboard"] == pytest.approx(moved, rel=1e-6)
    assert ballast.changes["starboard"] >= 0.0 >= ballast.changes["port"], "a positive heel lifts port"
    assert rest(scene)[0] == pytest.approx(2.0, rel=1e-6)


def test_trim_by_water_in_closed_form() -> None:
    scene, theta = barge(), np.radians(0.5)
    ballast = scene.add_ballast(trim_deg=0.5, tanks=pair() | ends())
    moved = C55 * theta / (G * 30.0 * np.cos(theta))
    assert abs(ballast.changes["aft"]) + ballast.changes["fore"] == pytest.approx(moved, rel=1e-6)
    assert rest(scene)[1] == pytest.approx(0.5, rel=1e-6)
    assert rest(scene)[2] == pytest.approx(sum(ballast.changes.values()) * G / C33, abs=1e-6)


def test_two_wing_tanks_correct_a_heel_and_leave_the_trim_as_it_comes() -> None:
    """A load at (x, y): water takes its moment about x, across 2 y of the tanks; C55 theta = x W is left."""
    scene = barge()
    scene.add_body("box", mass=LOAD, inertia=LOAD * np.eye(3), position=(10.0, 3.0, 0.0))
    scene.add_joint("lashed", kind="weld", first="hull", second="box", point=(10.0, 3.0, 0.0))
    ballast = scene.add_ballast(trim_deg=None, tanks=pair(y=8.0, capacity=1e6, content=5e5))
    assert ballast.changes["starboard"] - ballast.changes["port"] == pytest.approx(LOAD * 3.0 / 8.0, rel=1e-3)
    heel, trim, _ = rest(scene)
    assert heel == pytest.approx(0.0, abs=1e-6) and np.radians(trim) == pytest.approx(ballast.trim, rel=1e-6)
    assert ballast.trim == pytest.approx(10.0 * LOAD * G / C55, rel=1e-2)


def test_one_force_may_leave_the_trim_too() -> None:
    scene = crane_ship()
    free = scene.add_ballast(trim_deg=None)
    assert rest(scene)[0] == pytest.approx(0.0, abs=1e-6)
    assert rest(scene)[1] == pytest.approx(np.degrees(free.trim), abs=1e-6)


def test_runs_start_from_its_equilibrium() -> None:
    scene = hanging(barge(), y=3.0)
    scene.add_ballast(heel_deg=1.0)
    model_roll = equilibrium(scene).values[3:7]
    assert 2.0 * np.arcsin(model_roll[1]) == pytest.approx(np.radians(1.0), rel=1e-6)


def test_a_tank_that_would_overflow_is_named() -> None:
    """50 t at 3 m take 18.75 t across by 8 m: port gives its 10 t, starboard has room for 1 t of 8.75 t."""
    scene = on_deck(barge(), y=3.0, z=0.0)
    words = r"tank 'starboard' would have to hold 18750 kg, above its capacity of 11000 kg.*give it more"
    with pytest.raises(SceneError, match=words):
        scene.add_ballast(tanks=pair(capacity=1.1e4, content=1e4) | ends())
    assert not scene.point_forces, "nothing is added where it is refused"
    scene.add_ballast(tanks=pair(capacity=4e4, content=1e4) | ends())
    assert rest(scene)[:2] == pytest.approx((0.0, 0.0), abs=1e-6)


def test_a_tank_that_would_run_dry_is_named() -> None:
    scene = on_deck(barge(), y=3.0, z=0.0)
    dry = {"port": Tank(point=(0.0, 8.0, 0.0), capacity=1e6, content=1e3)} | ends()
    with pytest.raises(SceneError, match=r"tank 'port' would have to give .* and holds 1000 kg"):
        scene.add_ballast(tanks=dry)


def test_what_makes_no_ballast_is_refused() -> None:
    with pytest.raises(SceneError, match="the vessels are none; name one as vessel"):
        Scene().add_ballast()
    with pytest.raises(SceneError, match=r"vessel 'hull' carries no body.*give tanks"):
        barge().add_ballast()
    with pytest.raises(SceneError, match=r"no contents of tanks 'fore', 'aft' make them.*trim_deg=None"):
        on_deck(barge(), y=3.0, z=0.0).add_ballast(tanks=ends())
    with pytest.raises(SceneError, match="heel_deg is 40; give an angle within 20 deg"):
        on_deck(barge(), y=3.0, z=0.0).add_ballast(heel_deg=40.0)
    with pytest.raises(SceneError, match="heel_deg and trim_deg are None; ask for one"):
        on_deck(barge(), y=3.0, z=0.0).add_ballast(heel_deg=None, trim_deg=None)
    with pytest.raises(SceneError, match=r"tanks are \{\}; give at least one Tank"):
        barge().add_ballast(tanks={})
    with pytest.raises(SceneError, match="content is 5 kg; give one from 0 to its capacity of 4 kg"):
        Tank(point=(0.0, 0.0, 0.0), capacity=4.0, content=5.0)
