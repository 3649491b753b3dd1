"""Cranes whose cylinders are hydraulic: statics, heave compensation, data files; stages that move oil."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import hydraulic_scenes as made
import numpy as np
import pytest
from element_runs import both_forms, goes_on
from hydraulic_scenes import OIL, PARTS, RETRACTED, START, lifted, raised
from line_scenes import add_led
from multibody_runs import record

from seacrane import Curve, Move, Scene, Stage, Until, natural_modes, simulate, statics
from seacrane.crane import Payload, load_crane
from seacrane.crane.load_crane import SHIPPED
from seacrane.description.hydraulic_cylinders import with_ideal_cylinders
from seacrane.scene import Counterbalance, Oil, Piston, Pump, Relief, Rupture, Valve

BOTH = {"main": OIL, "knuckle": OIL}
POSE = {"slew": -1.0, "s1": 2.0, "s2": 3.0}


def crane(hydraulics: Any = BOTH, **more: Any) -> Scene:
    scene = Scene(name="hydraulic crane")
    scene.add_crane(base="ground", payload=Payload(), hydraulics=hydraulics, held=True, **POSE | more)
    return scene


def test_a_stroke_has_one_name_whatever_drives_it() -> None:
    oil = simulate(crane(), 1.0, dt_out=0.5)
    moved = oil["hydraulic_stroke"] - oil["hydraulic_stroke"][0]
    assert oil["stroke"] == pytest.approx(moved, abs=1e-9)
    for led in (False, True):
        scene = Scene(name="driven")
        scene.add_crane(base="ground", payload_mass=10e3, damping=False, **POSE)
        if led:
            scene.add_driver("main", curve=Curve.table([0.0, 1.0], [0.0, 0.1], between="linear"))
        stroke = simulate(scene, 1.0, dt_out=0.5).select("stroke[main]")
        assert stroke == pytest.approx([0.0, 0.05, 0.1] if led else [0.0] * 3, abs=1e-9)


def test_a_crane_starts_at_rest_on_its_oil() -> None:
    scene = crane()
    expected = load_crane().static_cylinder_forces(s1=POSE["s1"], s2=POSE["s2"], payload_mass=Payload().mass)
    for name, force in zip(("main_cylinder", "knuckle_cylinder"), expected, strict=True):
        ram = scene.loads[name]
        assert ram.pressure * ram.full_area - ram.pressure_rod * ram.rod_side_area == pytest.approx(force)
    assert list(scene.drivers) == ["A.angle"]
    result = simulate(scene, 2.0, dt_out=0.5, rtol=1e-8)
    assert np.ptp(result["hydraulic_stroke"], axis=0) == pytest.approx(0.0, abs=1e-6)
    assert result["cylinder_force"][0] == pytest.approx(expected, rel=1e-9)


def on_a_ship(*, compensated: bool, **more: Any) -> Scene:
    """A load on a cylinder on a deck that heaves by 30 mm in 4 s."""
    scene = Scene(name="deck")
    swell = Curve.harmonic(start_time=2.0, offset=0.03, amplitude=0.03, omega=0.5 * np.pi, phase=np.pi)
    add_led(scene, "ship", Curve.constant(value=0.0).then(time=2.0, curve=swell))
    place = (0.0, 0.0, RETRACTED + START)
    scene.add_body(name="load", mass=1000.0, inertia=(10.0, 10.0, 10.0), position=place)
    scene.add_joint(kind="prismatic", name="rail", first="ship", second="load", axis=(0, 0, 1))
    oil = PARTS | {"valve": replace(made.VALVE, gain=20.0, rate_gain=12.0)} | more
    scene.add_hydraulic_cylinder(name="ram", first="ship", second="load", **oil)
    if compensated:
        scene.add_heave_compensation(name="ahc", body="ship", actuator="ram", ratio=-1.0, high_pass=0.0)
    return scene


def test_heave_is_compensated_by_oil_within_its_pressure_limits() -> None:
    def left(scene: Scene) -> float:
        out = record(scene, 14.0, dt_out=0.05, rtol=1e-6)
        return float(np.ptp(out["position"][out["time"] > 6.0, 1, 2]))

    none, active = left(on_a_ship(compensated=False)), left(on_a_ship(compensated=True))
    assert none == pytest.approx(0.06, rel=0.05)
    assert active < 0.1 * none
    ram = on_a_ship(compensated=True).loads["ram"]
    limit = Relief(pressure=1.2 * ram.pressure, flow=3e-4, override=6e5)
    limited = simulate(on_a_ship(compensated=True, relief=limit), 8.0, dt_out=0.1, rtol=1e-6)
    assert "ram.relief" in [event.name for event in limited.events]
    assert np.max(limited["hydraulic_pressure"][:, 0, 0]) < 1.2 * ram.pressure + 6e5


def test_both_formulations_move_a_hydraulic_crane_alike() -> None:
    opens = {"command": Curve.quintic(start_time=0, end_time=1, start=0, end=0.2)}
    within = {"hydraulic_stroke": 1e-8, "hydraulic_pressure": 1e-6 * OIL["pump"].pressure}
    out = both_forms(crane(BOTH | {"main": OIL | opens}), 2.0, within, rtol=1e-9)
    assert np.ptp(out["hydraulic_stroke"]) > 0.01


def test_ideal_cylinders_are_the_rung_below() -> None:
    """Stiff oil has the slow modes of a crane with locked cylinders, its statics and its ratio to the tip."""
    hard = Oil(modulus=1e13, hose_modulus=1e13, cylinder_modulus=1e13)
    stiff = OIL | {"oil": hard, "valve": replace(made.OF_CRANE, gain=0.0)}
    locked = Scene(name="locked")
    locked.add_crane(base="ground", payload=Payload(), held=True, **POSE)
    on_stiff_oil = crane({"main": stiff, "knuckle": stiff})
    soft, ideal = (natural_modes(scene).natural_period[:2] for scene in (on_stiff_oil, locked))
    assert soft == pytest.approx(ideal, rel=1e-4)
    assert set(with_ideal_cylinders(crane()).actuators) == {"main_cylinder", "knuckle_cylinder"}
    drawn = statics(crane())
    for name, value in statics(locked).columns.items():
        assert drawn.columns[name] == pytest.approx(value, rel=1e-9), name
    assert abs(drawn.columns["cylinder force main"]) > 1e3
    pushed = Scene(name="pushed")
    pushed.add_crane(base="ground", payload=Payload(), **POSE)
    for joint in ("A", "main_cylinder", "knuckle_cylinder"):
        pushed.add_actuator(joint=joint)
    ratios = [scene.add_heave_compensation(name="ahc", body="king", actuator="knuckle_cylinder").ratio
              for scene in (pushed, crane())]  # fmt: skip
    assert ratios[0] == pytest.approx(ratios[1], rel=1e-9)


FRAME_OIL: dict[str, Any] = {
    "pump": Pump(pressure=25e6), "piston": Piston(viscous_friction=5e5),
    "valve": Valve(rated_flow=0.01, rated_drop=1e6, gain=0.4, spool_lag=0.03),
}  # fmt: skip


@pytest.mark.parametrize("tilt", [0.5, 2.6])
def test_an_a_frame_starts_at_rest_on_its_oil(tilt: float) -> None:
    scene, load = Scene(name="A-frame"), Payload(mass=15e3, size=(2.0, 2.0, 2.0), link_length=3.0)
    scene.add_crane(
        load_crane("a_frame_40t"), base="ground", foot=(-50.0, 0.0, 10.0), coordinates={"tilt": tilt},
        payload=load, held=True, hydraulics={"tilt": FRAME_OIL},
    )  # fmt: skip
    ram = scene.loads["cylinder"]
    assert (ram.first, ram.second, list(scene.drivers)) == ("barrel", "rod", [])
    home = float(np.hypot(5.0, 5.2))
    assert (ram.retracted_length, ram.stroke) == pytest.approx((home - 1.6, 4.2), rel=1e-12)
    assert ram.full_area == pytest.approx(np.pi / 4.0 * 0.3**2)
    assert ram.full_area - ram.rod_side_area == pytest.approx(np.pi / 4.0 * 0.2**2)
    found = scene.copy().hold_pressures()["cylinder"]
    assert (ram.pressure, ram.pressure_rod) == pytest.approx((found.pressure, found.pressure_rod), rel=1e-6)
    if tilt == 0.5:
        result = simulate(scene, 1.0, dt_out=0.5, rtol=1e-8)
        assert np.ptp(result["hydraulic_stroke"]) < 1e-6
        told = float(statics(scene, coordinates={"tilt": 0.0})["cylinder force tilt"])
        assert result["cylinder_force"][0, 0] == pytest.approx(told, rel=1e-5)


KNUCKLE_FILE = (SHIPPED / "knuckle_boom_250t.toml").read_text(encoding="utf-8")
FRAME_FILE = (SHIPPED / "a_frame_40t.toml").read_text(encoding="utf-8")
PISTON = '\n[[pistons]]\ncylinder = "{}"\n[pistons.hydraulics]\n'
KEYS = "pump.pressure = 32e6\nvalve.rated_flow = 0.05\nvalve.rated_drop = 1e6\n"
TYPED = "pump.pressure_bar = 320\nvalve.rated_flow_l_per_min = 3000\nvalve.rated_drop_kPa = 1e3\n"


@pytest.mark.parametrize(
    ("text", "ram", "driven"),
    [
        (KNUCKLE_FILE + PISTON.format("main") + KEYS, "main_cylinder",
         {"A.angle", "knuckle_cylinder.displacement"}),
        (FRAME_FILE + PISTON.format("tilt") + TYPED, "cylinder", set()),
    ],
    ids=["knuckle boom", "A-frame"],
)  # fmt: skip
def test_a_data_file_may_say_that_a_crane_is_hydraulic(
    text: str, ram: str, driven: set[str], tmp_path: Path
) -> None:
    file = tmp_path / "crane.toml"
    file.write_text(text, encoding="utf-8")
    scene = Scene(name="of a file")
    scene.add_crane(load_crane(file), base="ground", held=True)
    assert scene.loads[ram].rated_flow == 0.05 and set(scene.drivers) == driven


FOLLOWS = replace(made.VALVE, gain=60.0, rate_gain=12.0, spool_lag=0.02)
HOLE = 4e-6  # m2


def test_a_stage_moves_the_reference_and_the_cylinder_follows() -> None:
    up = Stage(name="up", duration=3.0, commands={"ram.reference": Move(by=0.1, over=2.0)})
    down = Stage(name="down", duration=3.0, commands={"ram.reference": Move(to=START, over=2.0)})
    result = simulate(raised(valve=FOLLOWS), [up, down], dt_out=0.1)
    stroke = result["hydraulic_stroke"][:, 0]
    assert stroke[result.time <= 3.0][-1] == pytest.approx(START + 0.1, abs=2e-4)
    assert stroke[-1] == pytest.approx(START, abs=2e-4)
    curve = Curve.quintic(start_time=0.0, end_time=2.0, start=START, end=START + 0.1)
    whole = simulate(raised(reference=curve, valve=FOLLOWS), 3.0, dt_out=0.1)
    np.testing.assert_allclose(stroke[: len(whole.time)], whole["hydraulic_stroke"][:, 0], atol=2e-6)


@pytest.mark.warns("BoilingOilWarning")
def test_a_hose_bursts_where_its_pressure_passes_a_bound() -> None:
    """The instant is located; from there it is the run whose hose bursts at that time."""
    shut = Curve.quintic(start_time=0.5, end_time=0.51, start=0.6, end=0.0)
    curve = Curve.constant(value=0.6).then(time=0.5, curve=shut)
    pump = replace(made.PUMP, makeup_flow=4e-4)
    scene = raised(command=curve, piston=Piston(viscous_friction=2e4), pump=pump)
    bound = 1.02 * simulate(scene, 0.5)["hydraulic_pressure"][-1, 0, 1]
    high = Until.channel("hydraulic_pressure", minimum=bound, hydraulic_cylinder="ram", chamber="rod")
    stages = [
        Stage(name="lift", until=high, maximum_duration=2.0),
        Stage(name="burst", duration=1.0, commands={"ram.rupture": HOLE}),
    ]
    result = simulate(scene, stages, dt_out=0.05, rtol=1e-08)
    at = result.stages[0].end
    assert 0.5 < at < 0.6
    burst = ("ram.rupture", at)
    assert [(event.name, event.time) for event in result.events].count(burst) == 1
    again = scene.copy()
    again.replace("ram", rupture_time=at, rupture_area=HOLE)
    whole = simulate(again, at + 1.0, dt_out=0.05, rtol=1e-8)
    assert burst in [(event.name, event.time) for event in whole.events]
    for name in ("hydraulic_stroke", "hydraulic_spill"):
        late = [one[name][one.time > at + 0.5][:9, 0] for one in (result, whole)]
        np.testing.assert_allclose(*late, rtol=1e-6, atol=1e-12)
    assert np.all(result["hydraulic_spill"][result.time <= at] == 0.0)
    assert np.min(result["hydraulic_spill"][result.time > at + 0.01]) > 0.0


def test_a_run_goes_on_bit_for_bit_across_a_burst(formulation: str) -> None:
    burst, valve = Rupture(time=1.5, area=HOLE), Counterbalance(pressure=6e6, flow=8e-4)
    how: dict[str, Any] = {"dt_out": 0.1, "rtol": 1e-6, "formulation": formulation}
    for stopped in (1.43, 1.5, 1.503):
        goes_on(lambda: lifted(rupture=burst, counterbalance=valve), 1.7, stopped, **how)


def test_a_stage_opens_the_spool_and_one_alone_starts_on_oil_that_holds_its_load() -> None:
    shut = Stage(name="shut", duration=1.5, commands={"ram.command": Move(to=0.0, over=0.5)})
    opened = simulate(raised(), [Stage(name="open", duration=1.5, commands={"ram.command": 0.3}), shut])
    spool = opened["hydraulic_spool"][:, 0]
    assert np.max(spool) == pytest.approx(0.3, rel=1e-3) and spool[-1] == pytest.approx(0.0, abs=1e-6)
    up = Stage(name="up", duration=3.0, commands={"ram.reference": Move(by=0.1, over=2.0)})
    alone = simulate(raised(valve=FOLLOWS), [up, Stage(name="wait", duration=1.0)], first="wait")
    np.testing.assert_allclose(alone["hydraulic_stroke"][:, 0], START + 0.1, atol=1e-6)
    np.testing.assert_allclose(alone["hydraulic_force"][:, 0], 1000.0 * 9.80665, rtol=1e-6)
