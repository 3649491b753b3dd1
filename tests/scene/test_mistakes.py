"""Each row of docs/mistakes.md: the mistake in a script as a user would write it, and what answers it."""

from __future__ import annotations

import re
import warnings
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import line_scenes
import mistaken_units
import named
import numpy as np
import pytest
import stage_scenes
from hydraulic_scenes import VALVE, raised
from line_scenes import add_led, below
from mistaken_units import raos, record
from named import on_joint, on_wire
from slipped_scenes import MASS, G, with_load
from stage_scenes import lift_off, on_deck

import seacrane
from seacrane import Curve, MotionRaos, SampledController, Scene, Stage, Until, simulate
from seacrane.analysis import balance, driven, equilibrium, reflected_inertia
from seacrane.answers import FatigueCurve, fatigue
from seacrane.crane import Payload
from seacrane.hydro import BoxPart, HydroGroup, PlatePart, TablePart, ikeda_roll_damping, shipped_database
from seacrane.hydro.hull.hull import shipped_hull
from seacrane.scene import Chamber, Gas, Piston, Pump, Rupture, Valve
from seacrane.scene.wind_current import FlowCoefficients
from seacrane.sea import SeaState, WaveSystem, jonswap

PAGE = (Path(__file__).parents[2] / "docs" / "mistakes.md").read_text()
JOINTS = {"slew": "A", "main": "main_cylinder", "knuckle": "knuckle_cylinder"}


def answers() -> dict[str, list[str]]:
    """The page's rows: the mistake, and the warnings or errors that answer it."""
    rows = [line.split("|")[1:-1] for line in PAGE.splitlines() if line.startswith("| ")]
    return {row[0].strip(): re.findall(r"`(\w+(?:Warning|Error))`", row[2]) for row in rows[1:]}


ROWS = answers()


def lift(*, slew: float = 0.0, ballast: bool = True, sea: float | None = None, mass: float = MASS,
         **load: float) -> Scene:  # fmt: skip
    scene = Scene(name="lift")
    scene.add_vessel(shipped_database())
    if sea is not None:
        scene.add_sea(hs=2.0, tp=8.0, direction_deg=sea, seed=1)
    scene.add_crane(base="vessel", slew=slew, payload=Payload(mass=mass, **load))
    for name, joint in JOINTS.items():
        scene.add_channel(joint=joint)
        scene.add_actuator(name=name, joint=joint)
    if ballast:
        held = balance(scene)
        x, y, _ = held.weight_center
        scene.add_force("vessel", name="ballast", point=(x, y, 0.0), force=(0, 0, held.weight))
    return scene


def on_land() -> Scene:
    scene = Scene(name="crane")
    scene.add_crane(base="ground", payload=Payload(mass=MASS))
    return scene


def controlled(omega: float, *, feed_forward: bool = True, **slew: Any) -> Scene:
    """The crane on land, its drives held by gains of that frequency (rad/s)."""
    scene = on_land()
    for name, joint in JOINTS.items():
        scene.add_actuator(joint, name=name)
    held, inertia = balance(scene), reflected_inertia(scene)
    for name in JOINTS:
        gains = {"stiffness": inertia[name] * omega**2, "damping": 1.6 * omega * inertia[name]}
        scene.replace(name, feed_forward=held.loads[name] if feed_forward else 0.0, **gains)
    if slew:
        scene.replace("slew", **slew)
    return scene


def move(end: float, *, until: float = 4.0) -> Curve:
    return Curve.quintic(start_time=0.0, end_time=until, start=0.0, end=end)


def follow(drive: str, curve: Curve, t_end: float = 5.0) -> None:
    simulate(driven(lift(), references={drive: curve}), t_end=t_end)


def hung(line: dict[str, Any] | None = None, **winch: Any) -> None:
    scene = on_wire(depth=15.0, **(line or {}))
    if winch:
        scene.add_winch("hoist", **winch)
    simulate(scene, t_end=0.2)


def on_gas(pressure: float, volume: float) -> None:
    scene, gas = with_load((0, 0, -10)), Gas(area=0.05, pressure=pressure, volume=volume)
    scene.add_spring("gas", first="ground", second="load", gas=gas)
    simulate(scene, t_end=0.2)


def on_its_side(part: Any) -> None:
    scene, half = Scene(name="on its side"), np.sqrt(0.5)
    scene.add_body("load", mass=40e3, size=(6, 4, 3), position=(0, 0, -9), quaternion=(half, 0, half, 0))
    scene.add_immersed("load", parts=[part])
    simulate(scene, t_end=0.1)


def above_a_deck(**surface: Any) -> None:
    scene = with_load((0, 0, 3.0))
    scene.add_contact("load", on="ground", points=[(-1, 0, -1), (1, 0, -1)], **surface)
    simulate(scene, t_end=1.0)


def on_a_ship(*, slew: float = -np.pi / 2, parts: Any = (), **hoist: Any) -> None:
    scene = Scene(name="on a ship")
    scene.add_vessel(shipped_database(), memory="none")
    scene.add_crane(slew=slew, s1=2.0, s2=2.0)
    scene.add_hoist(mass=35e3, size=(6, 4, 4), EA=6e7, **hoist)
    scene.add_ballast()
    for part in parts:
        scene.add_immersed("load", parts=[part])
    simulate(scene, t_end=0.1)


def lowered(depth: float, *, stages: bool) -> None:
    """Down a shaft of water: by a stage that waits for it, or by time."""
    scene = on_wire(tension_at_start=None, length=10.0)
    scene.add_winch("hoist", lag=0.1)
    scene.add_sea(vessel=None, sea=SeaState(systems=[waves(hs=0.5, tp=6.0)], depth=depth))
    scene.add_immersed("load", parts=[BoxPart(size=(2.0, 2.0, 2.0), fill=0.5)])
    down: dict[str, Any] = {"commands": {"hoist.rate": 5.0}}
    deep = Stage(name="down", until=Until.depth("load", minimum=97.0), maximum_duration=60.0, **down)
    simulate(scene, [deep if stages else Stage(name="down", duration=2.0, **down)], start="rest")


def waves(hs: float = 2.0, tp: float = 8.0) -> WaveSystem:
    return WaveSystem(spectrum=jonswap(hs=hs, tp=tp), direction_deg=180.0)


def pair(distance: float) -> HydroGroup:
    ship = shipped_database()
    return HydroGroup.from_databases(databases={"crane": ship, "feeder": ship},
                                     positions={"crane": (0.0, 0.0, 0.0),
                                                "feeder": (0.0, distance, 0.0)})  # fmt: skip


MOORING = np.diag([2e5, 3e5, 0.0, 0.0, 0.0, 1e9])


def moored(**more: Any) -> None:
    """The shipped hull as a file of a moored ship would hold it."""
    database = shipped_database()
    Scene(name="moored").add_vessel(replace(database, restoring=database.restoring + MOORING), **more)


def ikeda(amplitude_deg: float, **keel: float) -> None:
    ikeda_roll_damping(shipped_hull(), amplitude_deg=amplitude_deg, omega=0.5, axis_height=2.0, **keel)


def wind_where_it_comes_from() -> None:
    scene, circle = lift(sea=180.0), np.linspace(0.0, np.pi, 5)
    side = np.array([0.0, 0.6, 0.8, 0.6, 0.0])
    drag = FlowCoefficients(angle=circle, x=np.cos(circle), y=side, yaw=0.0 * circle)
    areas = {"frontal_area": 500.0, "lateral_area": 1500.0, "length": 115.0}
    scene.add_wind(coefficients=drag, speed=12.0, direction_deg=0.0, **areas)
    simulate(driven(scene), t_end=1.0)


def body_in_tonnes() -> None:
    scene = lift()
    load = scene.bodies.pop("payload")
    scene.add_body("payload", mass=20.0, inertia=[70.0, 70.0, 80.0], position=load.position)
    simulate(driven(scene), t_end=1.0)


def a_tower_too_heavy() -> None:
    scene = Scene(name="top-heavy")
    scene.add_vessel(shipped_database(), memory="none")
    scene.add_body("tower", mass=1e6, inertia=[1e7] * 3, position=(0, 0, 60))
    scene.add_joint("bolts", kind="weld", first="vessel", second="tower", point=(0, 0, 10))
    scene.compile()


def two_controllers() -> None:
    both = [SampledController(period=0.1, function=lambda t, m: {"slew.force": 1.0}) for _ in range(2)]
    simulate(controlled(5.0), t_end=1.0, controllers=both)


def a_stop_of_steel() -> None:
    scene = on_joint("box", velocity=(0.1, 0, 0), gravity=False)
    scene.add_actuator("rail", stiffness=1e8, damping=2e4)
    simulate(scene, t_end=10.0, integrator="dopri5", channels=["position"])


def above_the_table() -> None:
    scene = on_land()
    for joint in JOINTS.values():
        scene.add_driver(joint, curve=0.0)
    scene.roles[""] = replace(scene.roles[""], capacity=((10.0, 30e3), (15.0, 22e3), (25.0, 12e3)))
    simulate(scene, t_end=0.5)


def thrown() -> None:
    scene = on_wire()
    scene.replace("load", velocity=(6, 0, 0))
    simulate(scene, t_end=3.0)


def a_link_down_to_the_keel() -> None:
    scene = lift(ballast=False, link_length=20.0)
    scene.add_ballast()
    simulate(driven(scene), t_end=0.5)


def let_go(t_end: float, **crane: Any) -> None:
    scene = Scene(name="nothing holds the jibs")
    scene.add_crane(base="ground", held=False, **crane)
    simulate(scene, t_end=t_end)


def hours_at_a_loose_tolerance() -> None:
    """A box on a spring in place of the load, with the steps that waves would give."""
    scene = on_joint("box", velocity=(1e-6, 0, 0))
    scene.add_spring("spring", first="ground", second="box", first_point=(-9, 0, 0), stiffness=5.0,
                     natural_length=9.0)  # fmt: skip
    simulate(scene, t_end=3 * 3600.0, dt_out=1.0, integrator="tsit5", rtol=1e-2, maximum_step=0.5)


def a_guide_ten_centimetres_off() -> None:
    scene = on_wire()
    scene.add_contact("load", on="ground", points=[(1, 0, 0)], surface="post", place=(1.1, 0, -10),
                      size=(0.4, 6), stiffness=1e6, name="guide")  # fmt: skip
    simulate(scene, t_end=0.1)


def a_tagline_connected_short() -> None:
    scene = on_wire()
    scene.add_line("tag", "ground", "load", first_point=(6.5, 0, -10), EA=1e6, length=5.0)
    stages = [Stage(name="wait", duration=0.1), Stage(name="on", duration=0.1, connect=["tag"])]
    simulate(scene, stages)


def a_resonant_wire_as_quasi_static() -> None:
    scene = below((0, 0, -2000), mass=180e3)
    add_led(scene, "tip", Curve.harmonic(amplitude=0.2, omega=1.2, phase=np.pi / 2))
    scene.add_line("wire", "tip", "load", EA=4e8, tension_at_start=180e3 * G, rung="quasi-static")
    simulate(scene, t_end=1.0)


def worn_over_megapascals() -> None:
    run = simulate(on_wire(tension_at_start=2.5e5), t_end=5.0, dt_out=0.01, channels=["line_tension"])
    fatigue(run, curves={"line_tension[hoist]": FatigueCurve(constant=1e12, slope=3, scale=900e-6)})


def drag_of_the_world() -> None:
    tables = {"depths": (0, 3), "volumes": (0, 36), "added_masses": ((0, 0, 0), (3e4, 4e4, 9e4))}
    on_its_side(TablePart(height=3, drag_area=(40, 40, 90), source="a tank", **tables))


# In no time, and at once at full speed.
STEP = Curve.constant(value=0.0).then(time=1.0, curve=Curve.constant(value=2.0))
RAMP = Curve.pieces(starts=[1.0, 2.0], coefficients=[[0, 0.2, 0, 0, 0, 0], [0.2, 0, 0, 0, 0, 0]])
IN_DEGREES = np.where(np.arange(6) < 3, 1.0, 180.0 / np.pi)
SHUT = {"pump": Pump(), "valve": Valve(), "rod_chamber": Chamber(pressure=1e6, hose_volume=78.5e-6)}
SCRIPTS: dict[str, list[Callable[[], Any]]] = {
    "degrees where radians are meant": [lambda: follow("slew", move(-90.0)),
        lambda: lift(slew=-90.0, ballast=False)],
    "RAOs in degrees per metre": [lambda: raos(lambda v: v * IN_DEGREES),
        lambda: MotionRaos(omega=[0.3, 0.6], heading=[0.0, 180.0], values=np.zeros((2, 2, 6)))],
    "a record in degrees": [lambda: record(0.0, roll=2.5)],
    "radians where degrees are meant": [lambda: lift(sea=np.pi * 3 / 4, ballast=False)],
    "compass directions": [lambda: lift(sea=315.0, ballast=False), wind_where_it_comes_from],
    "tonnes for kilograms": [lambda: Payload(mass=20.0), body_in_tonnes],
    "depth with the wrong sign": [
        lambda: SeaState(systems=[waves()]).realise().waves.kinematics(time=0, x=0, y=0, z=[10.0, 30.0]),
        lambda: SeaState(systems=[waves()], depth=-60.0)],
    "ballast left out": [lambda: simulate(driven(lift(ballast=False)), t_end=1.0)],
    "a crane too heavy for its ship": [a_tower_too_heavy],
    "ballast beside the ship": [lambda: lift(ballast=False, mass=50e3).add_ballast(heel_deg=15.0)],
    "gains too soft": [lambda: simulate(controlled(0.5, feed_forward=False), t_end=20.0)],
    "angles beyond half a turn": [
        lambda: simulate(controlled(5.0, reference=np.radians(270.0)), t_end=1.0),
        lambda: follow("slew", move(np.radians(270.0), until=40.0), t_end=41.0)],
    "strokes beyond the cylinder": [lambda: follow("main", move(-4.0)), lambda: let_go(3.0, s1=1.0, s2=1.0)],
    "motions in no time": [lambda: follow("main", STEP, 2.0), lambda: follow("main", RAMP, 3.0)],
    "a start that joints do not allow": [
        lambda: driven(lift(), references={"slew": Curve.constant(value=-0.5)}).compile()],
    "two masters of one input": [two_controllers],
    "a load that swings too far": [thrown],
    "more than the crane may lift": [above_the_table],
    "a load in the hull": [a_link_down_to_the_keel],
    "a mode far faster than the outputs": [a_stop_of_steel],
    "a crane that nothing holds": [lambda: let_go(0.1, payload=Payload(mass=MASS))],
    "a loose tolerance for hours": [hours_at_a_loose_tolerance],
    "a hydraulic cylinder that swings by itself": [
        lambda: simulate(raised(
            valve=replace(VALVE, gain=80.0, spool_lag=1e-3), piston=Piston(viscous_friction=2e3)), 0.1)],
    "a hose that bursts, and nothing that lets oil in": [
        lambda: simulate(raised(rupture=Rupture(time=0.1, area=2e-5), **SHUT), 0.5)],
    "a roll amplitude in radians": [lambda: ikeda(np.radians(8.0))],
    "bilge keels in millimetres": [lambda: ikeda(8.0, bilge_keel_length=35.0, bilge_keel_breadth=400.0)],
    "a mooring counted twice": [lambda: moored(mooring=MOORING), moored],
    "two ships that are not as computed": [lambda: pair(20.0),
        lambda: pair(30.0).require(names=["feeder", "crane"]),
        lambda: pair(30.0).require(positions={"feeder": (0.0, 28.0, 0.0)})],
    "kilonewtons for newtons at a winch": [
        lambda: hung(lag=0.1, drum_inertia=500.0, drum_radius=0.5, maximum_tension=300)],
    "a load that starts inside a guide": [a_guide_ten_centimetres_off],
    "a line too short for the pose": [lambda: hung({"length": 14.9, "tension_at_start": None})],
    "a load that carries itself under water": [
        lambda: on_a_ship(height=-9.0, parts=[BoxPart(size=(6, 4, 4), fill=0.2)])],
    "a load on no deck": [lambda: on_a_ship(on="vessel", height=10.0),
        lambda: on_a_ship(slew=0.0, on="vessel", height=5.0)],
    "a sea without its height": [
        lambda: Scene(name="settings").add_sea(vessel=None, hs=None, tp=8.0, direction_deg=90.0)],
    "a line connected too short": [a_tagline_connected_short],
    "a wire that resonates, as quasi-static": [a_resonant_wire_as_quasi_static],
    "water shallower than the path": [lambda: lowered(50.0, stages=True),
        lambda: lowered(15.0, stages=False)],
    "drag along axes of the world": [drag_of_the_world],
    "added mass in tonnes": [
        lambda: on_its_side(BoxPart(size=(6, 4, 3), added_mass=(30, 40, 90), source="a tank"))],
    "sizes in water in another unit": [lambda: on_its_side(PlatePart(size=(6, 4), thickness=20)),
        lambda: on_its_side(BoxPart(size=(600, 400, 300)))],
    "a part far from its body": [lambda: on_its_side(BoxPart(size=(6, 4, 3), point=(0, 0, 1500)))],
    "texts for numbers": [
        lambda: lift(ballast=False).add_force("payload", name="pull", force=["1e3", "0", "0"])],
    "EA in kilonewtons": [lambda: hung({"EA": 5e4})],
    "times in milliseconds": [lambda: hung(rate=-0.3, lag=200.0)],
    "lengths and speeds in millimetres": [lambda: hung(lag=0.2, drum_inertia=1e3, drum_radius=500.0),
        lambda: hung(rate=100.0, lag=0.2)],
    "pressures in bar": [lambda: on_gas(39.2, 0.1)],
    "volumes in litres": [lambda: on_gas(39.2e5, 100.0)],
    "a fatigue curve over MPa": [worn_over_megapascals],
    "percentages for shares": [lambda: hung({"damping_ratio": 2.0})],
    "a heave in centimetres": [lambda: record(150.0)],
    "a record with noise": [lambda: record(1.5, noise=5e-3)],
    "phases of the other sign, or in degrees": [lambda: raos(np.conj),
        lambda: raos(lambda v: np.abs(v) * np.exp(1j * np.degrees(np.angle(v))))],
    "a load that comes back to its deck": [lambda: simulate(on_deck(), lift_off())],
    "a deck upside down, or above the feet": [lambda: above_a_deck(axis=(0, 0, -1), place=(0, 0, 1)),
        lambda: above_a_deck(place=(0, 0, 2.8))],
}  # fmt: skip
FILES = {__file__, *(module.__file__ for module in (line_scenes, mistaken_units, named, stage_scenes))}


def test_the_page_and_these_scripts_hold_the_same_mistakes_and_public_answers() -> None:
    assert set(ROWS) == set(SCRIPTS)
    for name in {name for row in ROWS.values() for name in row}:
        home = seacrane.errors if name.endswith("Error") else seacrane.warnings
        assert issubclass(getattr(home, name), (UserWarning, seacrane.errors.SeacraneError))


def answer(script: Callable[[], Any]) -> tuple[set[str], set[str]]:
    """Names of the classes that answer a script, and the files that its warnings name."""
    refused = set()
    with warnings.catch_warnings(record=True, action="always") as caught:
        try:
            script()
        except seacrane.errors.SeacraneError as error:
            refused = {type(error).__name__}
    names = {warning.category.__name__ for warning in caught}
    return names | refused, {warning.filename for warning in caught}


@pytest.mark.parametrize("mistake", SCRIPTS)
def test_a_mistake_is_answered_at_the_user_s_line_and_every_answer_of_its_row_is_given(mistake: str) -> None:
    given = set[str]()
    for number, script in enumerate(SCRIPTS[mistake]):
        names, files = answer(script)
        assert names & set(ROWS[mistake]), number
        assert files <= FILES, number
        given |= names
    assert given >= set(ROWS[mistake])


def test_the_same_scripts_without_the_mistake_warn_of_nothing() -> None:
    ready = lift(sea=135.0)
    simulate(driven(ready, references={"slew": move(-np.pi / 2, until=45.0)}), t_end=60.0)
    simulate(controlled(5.0), t_end=5.0)
    without = driven(lift(ballast=False))
    simulate(without, t_end=1.0, start=equilibrium(without))


def test_the_heel_that_missing_ballast_is_said_to_give_is_that_of_the_rest_state() -> None:
    """Of 300 t, 20 m before the origin and 8 m to port; the rest state also feels their height."""
    heading = -2.0
    scene, cosine, sine = Scene(name="deck load"), np.cos(heading), np.sin(heading)
    scene.add_vessel(shipped_database(), heading_deg=np.degrees(heading))
    place = (20.0 * cosine - 8.0 * sine, 20.0 * sine + 8.0 * cosine, 5.0)
    scene.add_body("load", mass=300e3, inertia=[1e6, 1e6, 1e6], position=place)
    scene.add_joint("lashing", kind="weld", first="vessel", second="load")
    with pytest.warns(seacrane.warnings.BallastWarning) as caught:
        simulate(scene, t_end=0.1)
    told = str(caught[0].message)
    words = re.search(r"heel it by (\S+) deg, trim it by (\S+) deg and lift it by (\S+) m", told)
    assert words is not None
    rest = simulate(scene, t_end=0.1, start=equilibrium(scene))["vessel_motion"][0]
    said = [float(word) for word in words.groups()]
    np.testing.assert_allclose(said, [*np.degrees(rest[3:5]), rest[2]], rtol=0.1)
