"""Each row of docs/mistakes.md: the mistake in a script as a user would write it, and what answers it."""

from __future__ import annotations

import re
import warnings
from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from typing import Any

import mistaken_units
import numpy as np
import pytest
from hydraulic_scenes import raised

import seacrane
from seacrane import (
    Curve,
    SampledController,
    Scene,
    SeaState,
    Stage,
    Until,
    WaveSystem,
    balance,
    equilibrium,
    simulate,
)
from seacrane.analysis import driven
from seacrane.crane import Payload
from seacrane.hydro import HydroDatabase, HydroGroup, ikeda_roll_damping, shipped_database
from seacrane.hydro.hull.shipped_hull import shipped_hull
from seacrane.scene.wind_current import FlowCoefficients
from seacrane.sea import jonswap
from seacrane.water import BoxPart, PlatePart, TablePart

PAGE = (Path(__file__).parents[2] / "docs" / "mistakes.md").read_text()
JOINTS = {"slew": "A", "main": "main_cylinder", "knuckle": "knuckle_cylinder"}


def answers() -> dict[str, list[str]]:
    """The page's rows: the mistake, and the warnings or errors that answer it."""
    rows = [line.split("|")[1:-1] for line in PAGE.splitlines() if line.startswith("| ")]
    return {row[0].strip(): re.findall(r"`(\w+(?:Warning|Error))`", row[2]) for row in rows[1:]}


ROWS = answers()


def lift(*, mass: float = 20e3, slew: float = 0.0, ballast: bool = True, sea: float | None = None) -> Scene:
    """A lift on the shipped hull, its drives without gains."""
    database = shipped_database()
    scene = Scene(name="lift")
    scene.add_vessel(database)
    if sea is not None:
        scene.add_sea(hs=2.0, tp=8.0, direction_deg=sea, seed=1)
    scene.add_crane(base="vessel", slew=slew, payload=Payload(mass=mass))
    for name, joint in JOINTS.items():
        scene.record_coordinate(joint=joint)
        scene.add_actuator(name=name, joint=joint)
    if ballast:
        held = balance(scene)
        x, y, _ = held.weight_center
        scene.add_point_force(name="ballast", body="vessel", point=(x, y, 0.0), force=(0, 0, held.weight))
    return scene


def controlled(omega: float, *, feed_forward: bool = True) -> Scene:
    """The crane on land, its drives held by gains of that frequency (rad/s)."""
    scene = Scene(name="crane")
    scene.add_crane(base="ground", payload=Payload(mass=20e3))
    for name, joint in JOINTS.items():
        scene.add_actuator(name=name, joint=joint)
    held, inertia = balance(scene), seacrane.analysis.reflected_inertia(scene)
    scene.actuators.clear()
    for name, joint in JOINTS.items():
        gains = {"stiffness": inertia[name] * omega**2, "damping": 1.6 * omega * inertia[name]}
        load = held.loads[name] if feed_forward else 0.0
        scene.add_actuator(name=name, joint=joint, feed_forward=load, **gains)
    return scene


def move(end: float, *, until: float = 4.0) -> Curve:
    return Curve.quintic(start_time=0.0, end_time=until, start=0.0, end=end)


def degrees_for_radians() -> None:
    simulate(driven(lift(), references={"slew": move(-90.0)}), t_end=5.0)


def a_pose_in_degrees() -> None:
    lift(slew=-90.0, ballast=False)


def raos_in_degrees() -> None:
    omega = np.array([0.3, 0.6, 1.0])
    values = np.zeros((1, 3, 6), dtype=complex)
    values[0, :, 2] = 1.0
    values[0, :, 4] = -1j * np.degrees(omega**2 / 9.81)
    seacrane.MotionRaos(omega=omega, heading=[np.pi], values=values)


def headings_in_degrees() -> None:
    seacrane.MotionRaos(omega=[0.3, 0.6], heading=[0.0, 180.0], values=np.zeros((2, 2, 6)))


def record_in_degrees() -> None:
    time = np.linspace(0.0, 60.0, 121)
    motion = np.zeros((121, 6))
    motion[:, 3] = 2.5 * np.sin(0.7 * time)
    seacrane.MotionHistory(time=time, motion=motion)


def radians_for_degrees() -> None:
    lift(sea=np.pi * 3 / 4, ballast=False)


def compass_bearing() -> None:
    lift(sea=315.0, ballast=False)


def wind_where_it_comes_from() -> None:
    scene = lift(sea=180.0)
    circle = np.linspace(0.0, np.pi, 5)
    drag = FlowCoefficients(
        angle=circle, x=np.cos(circle), y=np.array([0.0, 0.6, 0.8, 0.6, 0.0]), yaw=0.0 * circle
    )
    areas = {"frontal_area": 500.0, "lateral_area": 1500.0, "length": 115.0}
    scene.add_wind(coefficients=drag, speed=12.0, direction_deg=0.0, **areas)
    simulate(driven(scene), t_end=1.0)


def payload_in_tonnes() -> None:
    Payload(mass=20.0)


def body_in_tonnes() -> None:
    scene = lift()
    load = scene.bodies["payload"]
    del scene.bodies["payload"]
    scene.add_body(name="payload", mass=20.0, inertia=[70.0, 70.0, 80.0], position=load.position)
    simulate(driven(scene), t_end=1.0)


def depth_above_water() -> None:
    sea = SeaState(systems=[WaveSystem(spectrum=jonswap(hs=2.0, tp=8.0), direction_deg=180.0)], seed=1)
    sea.realise().waves.kinematics(time=0.0, x=0.0, y=0.0, z=[10.0, 30.0])


def negative_water_depth() -> None:
    SeaState(systems=[WaveSystem(spectrum=jonswap(hs=2.0, tp=8.0), direction_deg=180.0)], depth=-60.0)


def no_ballast() -> None:
    simulate(driven(lift(ballast=False)), t_end=1.0)


def a_tower_too_heavy() -> None:
    scene = Scene(name="top-heavy")
    scene.add_vessel(shipped_database(), memory="none")
    scene.add_body(name="tower", mass=1e6, inertia=[1e7] * 3, position=(0, 0, 60))
    scene.add_joint(kind="weld", name="bolts", first="vessel", second="tower", point=(0, 0, 10))
    scene.compile()


def ballast_overboard() -> None:
    scene = lift(ballast=False, mass=50e3)
    scene.add_ballast(heel_deg=15.0)


def soft_gains() -> None:
    simulate(controlled(0.5, feed_forward=False), t_end=20.0)


def a_constant_beyond_half_a_turn() -> None:
    scene = controlled(5.0)
    slew = scene.actuators.pop("slew")
    scene.add_actuator(
        name="slew", joint="A", stiffness=slew.stiffness, damping=slew.damping, reference=np.radians(270.0)
    )
    simulate(scene, t_end=1.0)


def more_than_half_a_turn_recorded() -> None:
    scene = lift()
    simulate(driven(scene, references={"slew": move(np.radians(270.0), until=40.0)}), t_end=41.0)


def strokes_out_of_range() -> None:
    simulate(driven(lift(), references={"main": move(-4.0)}), t_end=5.0)


def strokes_left_in_a_run() -> None:
    scene = Scene(name="no load along the cylinders")
    scene.add_crane(base="ground", s1=1.0, s2=1.0, held=False)
    simulate(scene, t_end=3.0)


def a_hoist_in_no_time() -> None:
    step = Curve.constant(value=0.0).then(time=1.0, curve=Curve.constant(value=2.0))
    simulate(driven(lift(), references={"main": step}), t_end=2.0)


def a_hoist_at_once_at_full_speed() -> None:
    ramp = Curve.pieces(starts=[1.0, 2.0], coefficients=[[0, 0.2, 0, 0, 0, 0], [0.2, 0, 0, 0, 0, 0]])
    simulate(driven(lift(), references={"main": ramp}), t_end=3.0)


def a_reference_that_starts_elsewhere() -> None:
    driven(lift(), references={"slew": Curve.constant(value=-0.5)}).compile()


def two_controllers() -> None:
    both = [SampledController(period=0.1, function=lambda t, m: {"slew.force": 1.0}) for _ in range(2)]
    simulate(controlled(5.0), t_end=1.0, controllers=both)


def a_slew_that_flings_its_load() -> None:
    scene = Scene(name="crane")
    scene.add_crane(base="ground", payload=Payload(mass=20e3))
    scene.add_actuator(name="slew", joint="A")
    for joint in ("main_cylinder", "knuckle_cylinder"):
        scene.add_driver(joint=joint, curve=Curve.constant(value=0.0))
    simulate(driven(scene, references={"slew": move(-np.pi / 2, until=10.0)}), t_end=15.0)


def a_hook_on_a_wire_that_is_let_go() -> None:
    scene = Scene(name="hook")
    scene.add_body(name="load", mass=1e3, inertia=(1e3, 1e3, 1e3), position=(0, 0, -9), velocity=(5.0, 0, 0))
    scene.add_line(name="wire", bodies=["ground", "load"], points=np.zeros((2, 3)), EA=1e7, length=8.99)
    simulate(scene, t_end=3.0)


def a_stop_of_steel() -> None:
    scene = Scene(name="stop")
    scene.add_body(name="pin", mass=1.0, inertia=(1, 1, 1), velocity=(0.1, 0, 0), gravity=False)
    scene.add_joint(kind="prismatic", name="rail", first="ground", second="pin", axis=(1, 0, 0))
    scene.add_actuator(joint="rail", stiffness=1e8, damping=2e4)
    simulate(scene, t_end=10.0, integrator="dopri5", channels=["position"])


def above_the_table() -> None:
    scene = Scene(name="crane")
    roles = scene.add_crane(base="ground", payload=Payload(mass=20e3))
    scene.roles[""] = replace(roles, capacity=((10.0, 30e3), (15.0, 22e3), (25.0, 12e3)))
    for joint in JOINTS.values():
        scene.add_driver(joint=joint, curve=Curve.constant(value=0.0))
    simulate(scene, t_end=0.5)


def a_link_down_to_the_keel() -> None:
    database = shipped_database()
    scene = Scene(name="lift")
    scene.add_vessel(database)
    scene.add_crane(payload=Payload(mass=20e3, link_length=20.0))
    for name, joint in JOINTS.items():
        scene.add_actuator(name=name, joint=joint)
    scene.add_ballast()
    simulate(driven(scene), t_end=0.5)


def a_crane_without_drives() -> None:
    scene = Scene(name="quay")
    scene.add_crane(base="ground", payload=Payload(mass=20e3), held=False)
    simulate(scene, t_end=0.1)


def hours_at_a_loose_tolerance() -> None:
    """A box on a spring in place of the load, with the steps that waves would give."""
    scene = Scene(name="rocking")
    scene.add_body(name="box", mass=1.0, inertia=[1, 1, 1], velocity=(1e-6, 0, 0))
    scene.add_joint(kind="prismatic", name="rail", first="ground", second="box", axis=(1, 0, 0))
    scene.add_spring(name="spring", first="ground", second="box", first_point=(-9, 0, 0), stiffness=5.0,
                     natural_length=9.0)  # fmt: skip
    simulate(scene, t_end=3 * 3600.0, dt_out=1.0, integrator="tsit5", rtol=1e-2, maximum_step=0.5)


def a_gain_beyond_what_oil_bears() -> None:
    simulate(raised(gain=80.0, viscous_friction=2e3, spool_lag=1e-3), 0.1)


def a_hose_that_bursts_and_no_makeup() -> None:
    shut = {"pump_pressure": 0.0, "rated_flow": 0.0, "pressure_rod": 1e6}
    simulate(raised(rupture_time=0.1, rupture_area=2e-5, **shut), 0.5)


def a_roll_amplitude_in_radians() -> None:
    ikeda_roll_damping(shipped_hull(), amplitude_deg=np.radians(8.0), omega=0.5, axis_height=2.0)


def bilge_keels_in_millimetres() -> None:
    ikeda_roll_damping(
        shipped_hull(), amplitude_deg=8.0, omega=0.5, axis_height=2.0, bilge_keel_length=35.0,
        bilge_keel_breadth=400.0,
    )  # fmt: skip


def moored() -> HydroDatabase:
    """The shipped hull as a file of a moored ship would hold it."""
    database = shipped_database()
    return replace(database, restoring=database.restoring + np.diag([2e5, 3e5, 0.0, 0.0, 0.0, 1e9]))


def a_mooring_beside_the_file_s() -> None:
    Scene(name="moored").add_vessel(moored(), mooring=np.diag([2e5, 3e5, 0.0, 0.0, 0.0, 1e9]))


def a_file_that_holds_its_mooring() -> None:
    Scene(name="moored").add_vessel(moored())


def pair(distance: float) -> HydroGroup:
    """The shipped hull twice; it is 25 m broad."""
    ship = shipped_database()
    return HydroGroup.from_databases(
        databases={"crane": ship, "feeder": ship},
        positions={"crane": (0.0, 0.0, 0.0), "feeder": (0.0, distance, 0.0)},
    )


def a_ship_within_another() -> None:
    pair(20.0)


def two_ships_in_another_order() -> None:
    pair(30.0).require(names=["feeder", "crane"])


def a_ship_beside_its_place() -> None:
    pair(30.0).require(positions={"feeder": (0.0, 28.0, 0.0)})


def forces_as_text() -> None:
    lift(ballast=False).add_point_force(name="pull", body="payload", force=["1e3", "0", "0"])


def hoist(**line: object) -> Scene:
    scene = Scene(name="hoist")
    scene.add_body(name="load", mass=20e3, inertia=(1e4, 1e4, 1e4), position=(0, 0, -10))
    given = {"EA": 3e7, "tension_at_start": 20e3 * scene.gravity} | line
    scene.add_line(name="hoist", bodies=["ground", "load"], points=np.zeros((2, 3)), **given)
    return scene


def a_motor_in_kilonewtons() -> None:
    scene = hoist()
    scene.add_winch(line="hoist", lag=0.1, drum_inertia=500.0, drum_radius=0.5, maximum_tension=300)
    simulate(scene, t_end=0.1)


def a_hoist_ten_centimetres_short() -> None:
    simulate(hoist(EA=5e7, length=9.9, tension_at_start=None), t_end=0.1)


def a_guide_ten_centimetres_off() -> None:
    scene = hoist()
    scene.add_contact("load", on="ground", points=[(1, 0, 0)], surface="post", place=(1.1, 0, -10),
                      size=(0.4, 6), stiffness=1e6, name="guide")  # fmt: skip
    simulate(scene, t_end=0.1)


def a_tagline_connected_short() -> None:
    scene = hoist()
    scene.add_line(
        name="tag", bodies=["ground", "load"], points=[(6.5, 0, -10), (0, 0, 0)], EA=1e6, length=5.0
    )
    stages = [
        seacrane.Stage(name="wait", duration=0.1),
        seacrane.Stage(name="hook on", duration=0.1, connect=["tag"]),
    ]
    seacrane.simulate_stages(scene, stages)


def a_resonant_wire_as_quasi_static() -> None:
    scene = Scene(name="deep")
    scene.add_body(name="tip", mass=1e3, inertia=(1e3, 1e3, 1e3), gravity=False)
    scene.add_joint(kind="prismatic", name="up", first="ground", second="tip", axis=(0, 0, 1))
    scene.add_driver(joint="up", curve=Curve.harmonic(amplitude=0.2, omega=1.2, phase=np.pi / 2))
    scene.add_body(name="load", mass=180e3, inertia=(4e5, 4e5, 4e5), position=(0, 0, -2000))
    scene.add_line(
        name="wire", bodies=["tip", "load"], points=np.zeros((2, 3)), EA=4e8,
        tension_at_start=180e3 * scene.gravity, rung="quasi-static",
    )  # fmt: skip
    simulate(scene, t_end=1.0)


def lowered(depth: float, *, to: float, stages: bool) -> None:
    """Down a shaft of water: by a stage that waits for it, or by time."""
    scene = hoist(tension_at_start=None, length=10.0)
    scene.add_winch(line="hoist", lag=0.1)
    waves = WaveSystem(spectrum=jonswap(hs=0.5, tp=6.0), direction_deg=0.0)
    scene.add_sea(vessel=None, sea=SeaState(systems=[waves], depth=depth))
    scene.add_immersed("load", parts=[BoxPart(size=(2.0, 2.0, 2.0), fill=0.5)])
    down: dict[str, Any] = {"commands": {"hoist.rate": 5.0}}
    deep = Stage(name="down", until=Until.depth("load", minimum=to), maximum_duration=60.0, **down)
    by_time = Stage(name="down", duration=2.0, **down)
    seacrane.simulate_stages(scene, [deep if stages else by_time], start="rest")


def a_stage_below_the_seabed() -> None:
    lowered(50.0, to=97.0, stages=True)


def a_winch_that_pays_out_too_long() -> None:
    lowered(15.0, to=97.0, stages=False)


def on_its_side(part: Any) -> None:
    scene = Scene(name="on its side")
    half = np.sqrt(0.5)
    scene.add_body("load", mass=40e3, size=(6, 4, 3), position=(0, 0, -9), quaternion=(half, 0, half, 0))
    scene.add_immersed("load", parts=[part])
    simulate(scene, t_end=0.1)


def drag_of_the_world() -> None:
    tables = {"depths": (0, 3), "volumes": (0, 36), "added_masses": ((0, 0, 0), (3e4, 4e4, 9e4))}
    on_its_side(TablePart(height=3, drag_area=(40, 40, 90), source="a tank", **tables))


def added_mass_in_tonnes() -> None:
    on_its_side(BoxPart(size=(6, 4, 3), added_mass=(30, 40, 90), source="a tank"))


def a_plate_in_millimetres() -> None:
    on_its_side(PlatePart(size=(6, 4), thickness=20))


def a_box_in_centimetres() -> None:
    on_its_side(BoxPart(size=(600, 400, 300)))


def a_hoist_described_under_water() -> None:
    scene = on_a_ship(height=-9.0)
    scene.add_immersed("load", parts=[BoxPart(size=(6, 4, 4), fill=0.2)])
    simulate(scene, t_end=0.1)


def on_a_ship(slew: float = -np.pi / 2, **hoist: Any) -> Scene:
    scene = Scene(name="on a ship")
    scene.add_vessel(shipped_database(), memory="none")
    scene.add_crane(slew=slew, s1=2.0, s2=2.0)
    scene.add_hoist(mass=35e3, size=(6, 4, 4), EA=6e7, **hoist)
    scene.add_ballast()
    return scene


def a_load_on_the_deck_of_a_crane_turned_out() -> None:
    simulate(on_a_ship(on="vessel", height=10.0), t_end=0.1)


def a_load_below_the_deck() -> None:
    simulate(on_a_ship(slew=0.0, on="vessel", height=5.0), t_end=0.1)


def a_sea_of_no_height() -> None:
    Scene(name="settings").add_sea(vessel=None, hs=None, tp=8.0, direction_deg=90.0)


def a_part_in_millimetres() -> None:
    on_its_side(BoxPart(size=(6, 4, 3), point=(0, 0, 1500)))


SCRIPTS: dict[str, list[Callable[[], None]]] = {
    "degrees where radians are meant": [degrees_for_radians, a_pose_in_degrees],
    "RAOs in degrees per metre": [raos_in_degrees, headings_in_degrees],
    "a record in degrees": [record_in_degrees],
    "radians where degrees are meant": [radians_for_degrees],
    "compass directions": [compass_bearing, wind_where_it_comes_from],
    "tonnes for kilograms": [payload_in_tonnes, body_in_tonnes],
    "depth with the wrong sign": [depth_above_water, negative_water_depth],
    "ballast left out": [no_ballast],
    "a crane too heavy for its ship": [a_tower_too_heavy],
    "ballast beside the ship": [ballast_overboard],
    "gains too soft": [soft_gains],
    "angles beyond half a turn": [a_constant_beyond_half_a_turn, more_than_half_a_turn_recorded],
    "strokes beyond the cylinder": [strokes_out_of_range, strokes_left_in_a_run],
    "motions in no time": [a_hoist_in_no_time, a_hoist_at_once_at_full_speed],
    "a start that joints do not allow": [a_reference_that_starts_elsewhere],
    "two masters of one input": [two_controllers],
    "a load that swings too far": [a_slew_that_flings_its_load, a_hook_on_a_wire_that_is_let_go],
    "more than the crane may lift": [above_the_table],
    "a load in the hull": [a_link_down_to_the_keel],
    "a mode far faster than the outputs": [a_stop_of_steel],
    "a crane that nothing holds": [a_crane_without_drives],
    "a loose tolerance for hours": [hours_at_a_loose_tolerance],
    "a hydraulic cylinder that swings by itself": [a_gain_beyond_what_oil_bears],
    "a hose that bursts, and nothing that lets oil in": [a_hose_that_bursts_and_no_makeup],
    "a roll amplitude in radians": [a_roll_amplitude_in_radians],
    "bilge keels in millimetres": [bilge_keels_in_millimetres],
    "a mooring counted twice": [a_mooring_beside_the_file_s, a_file_that_holds_its_mooring],
    "two ships that are not as computed": [
        a_ship_within_another,
        two_ships_in_another_order,
        a_ship_beside_its_place,
    ],
    "kilonewtons for newtons at a winch": [a_motor_in_kilonewtons],
    "a load that starts inside a guide": [a_guide_ten_centimetres_off],
    "a line too short for the pose": [a_hoist_ten_centimetres_short],
    "a load that carries itself under water": [a_hoist_described_under_water],
    "a load on no deck": [a_load_on_the_deck_of_a_crane_turned_out, a_load_below_the_deck],
    "a sea without its height": [a_sea_of_no_height],
    "a line connected too short": [a_tagline_connected_short],
    "a wire that resonates, as quasi-static": [a_resonant_wire_as_quasi_static],
    "water shallower than the path": [a_stage_below_the_seabed, a_winch_that_pays_out_too_long],
    "drag along axes of the world": [drag_of_the_world],
    "added mass in tonnes": [added_mass_in_tonnes],
    "sizes in water in another unit": [a_plate_in_millimetres, a_box_in_centimetres],
    "a part far from its body": [a_part_in_millimetres],
    "texts for numbers": [forces_as_text],
    **mistaken_units.SCRIPTS,
}
FILES = {__file__, mistaken_units.__file__}


def test_the_page_and_these_scripts_hold_the_same_mistakes() -> None:
    assert list(ROWS) == list(SCRIPTS)


@pytest.mark.parametrize("name", [name for row in ROWS.values() for name in row])
def test_every_answer_on_the_page_is_a_public_class(name: str) -> None:
    home = seacrane.errors if name.endswith("Error") else seacrane.warnings
    assert issubclass(getattr(home, name), (UserWarning, seacrane.errors.SeacraneError))


@lru_cache
def answer(script: Callable[[], None]) -> tuple[frozenset[str], frozenset[str]]:
    """Names of the classes that answer a script, and the files that its warnings name."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            script()
            refused = []
        except seacrane.errors.SeacraneError as error:
            refused = [type(error).__name__]
    names = [warning.category.__name__ for warning in caught]
    return frozenset([*names, *refused]), frozenset(warning.filename for warning in caught)


@pytest.mark.parametrize("script", [s for scripts in SCRIPTS.values() for s in scripts])
def test_a_mistake_is_answered_by_name_at_the_user_s_line(script: Callable[[], None]) -> None:
    mistake = next(m for m, scripts in SCRIPTS.items() if script in scripts)
    names, files = answer(script)
    assert names & set(ROWS[mistake])
    assert files <= FILES


@pytest.mark.parametrize("mistake", SCRIPTS)
def test_every_answer_of_a_row_is_given_by_one_of_its_scripts(mistake: str) -> None:
    assert set().union(*(answer(script)[0] for script in SCRIPTS[mistake])) >= set(ROWS[mistake])


def test_the_same_scripts_without_the_mistake_warn_of_nothing() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        ready = lift(sea=135.0)
        simulate(driven(ready, references={"slew": move(-np.pi / 2, until=45.0)}), t_end=60.0)
        simulate(controlled(5.0), t_end=5.0)
        without = driven(lift(ballast=False))
        simulate(without, t_end=1.0, start=equilibrium(without))


def loaded_to_port(heading: float) -> Scene:
    """A hull at a heading with 300 t welded on, 20 m before its origin and 8 m to port."""
    scene = Scene(name="deck load")
    scene.add_vessel(shipped_database())
    hull = scene.bodies.pop("vessel")
    turn = (np.cos(heading / 2.0), 0.0, 0.0, np.sin(heading / 2.0))
    scene.add_body(
        name="vessel",
        mass=hull.mass,
        inertia=hull.inertia,
        center_of_mass=hull.center_of_mass,
        quaternion=turn,
    )
    cosine, sine = np.cos(heading), np.sin(heading)
    place = (20.0 * cosine - 8.0 * sine, 20.0 * sine + 8.0 * cosine, 5.0)
    scene.add_body(name="load", mass=300e3, inertia=[1e6, 1e6, 1e6], position=place)
    scene.add_joint(kind="weld", name="lashing", first="vessel", second="load")
    return scene


@pytest.mark.parametrize("heading", [0.0, np.pi / 2, -2.0])
def test_the_heel_that_missing_ballast_is_said_to_give_is_that_of_the_rest_state(heading: float) -> None:
    """On any heading; the rest state also feels the load's height, which the estimate leaves out."""
    scene = loaded_to_port(heading)
    with pytest.warns(seacrane.warnings.BallastWarning) as caught:
        simulate(scene, t_end=0.1)
    words = re.search(
        r"heel it by (\S+) deg, trim it by (\S+) deg and lift it by (\S+) m", str(caught[0].message)
    )
    assert words is not None
    said = [float(word) for word in words.groups()]
    rest = simulate(scene, t_end=0.1, start=equilibrium(scene))["vessel_motion"][0]
    np.testing.assert_allclose(said, [*np.degrees(rest[3:5]), rest[2]], rtol=0.1)
