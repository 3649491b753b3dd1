"""Cranes whose cylinders are hydraulic: statics, compensation of heave, data files, lift files, cost."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hydraulic_scenes import RETRACTED, SET, START
from multibody_runs import record

from seacrane import Curve, Scene, SceneError, natural_modes, simulate, statics
from seacrane.crane import KnuckleBoomCrane, Payload, data_file
from seacrane.description.hydraulic_cylinders import with_ideal_cylinders
from seacrane.errors import FileFormatError
from seacrane.hydro import shipped_database

OIL: dict[str, Any] = {
    "pump_pressure": 32e6, "rated_flow": 0.05, "rated_drop": 1e6, "spool_lag": 0.03, "gain": 0.8,
    "viscous_friction": 2e6,
}  # fmt: skip
BOTH = {"main": OIL, "knuckle": OIL}
POSE = {"slew": -1.0, "s1": 2.0, "s2": 3.0}


def crane(hydraulics: Any = BOTH, **more: Any) -> Scene:
    scene = Scene(name="hydraulic crane")
    scene.add_crane(base="ground", payload=Payload(), hydraulics=hydraulics, held=True, **POSE | more)
    return scene


@pytest.mark.warns("PushingLinkWarning")
def test_a_stroke_has_one_name_whatever_drives_it() -> None:
    """Held, led by a driver, pushed by an actuator or by oil: counted from the described pose."""
    oil = simulate(crane(), 1.0, dt_out=0.5)
    moved = oil["hydraulic_stroke"] - oil["hydraulic_stroke"][0]
    assert oil["stroke"] == pytest.approx(moved, abs=1e-9)
    for drive in ("held", "driver", "actuator"):
        scene = Scene(name=drive)
        scene.add_crane(base="ground", payload_mass=10e3, damping=False, **POSE)
        if drive == "driver":
            scene.add_driver("main", curve=Curve.table([0.0, 1.0], [0.0, 0.1], between="linear"))
        if drive == "actuator":
            scene.add_actuator(name="main", joint="main_cylinder", stiffness=1e9, damping=1e8)
        result = simulate(scene, 1.0, dt_out=0.5)
        assert result["stroke"].shape == (3, 2) and result["slew_angle"].shape == (3,)
        assert result.select("stroke[main]")[-1] == pytest.approx(0.1 if drive == "driver" else 0.0, abs=0.02)


def test_a_crane_starts_at_rest_on_its_oil() -> None:
    scene = crane()
    expected = KnuckleBoomCrane.load().static_cylinder_forces(
        s1=POSE["s1"], s2=POSE["s2"], payload_mass=Payload().mass
    )
    for name, force in zip(("main_cylinder", "knuckle_cylinder"), expected, strict=True):
        ram = scene.loads[name]
        assert ram.pressure * ram.full_area - ram.pressure_rod * ram.rod_side_area == pytest.approx(force)
    assert list(scene.drivers) == ["A.angle"]
    result = simulate(scene, 2.0, dt_out=0.5, rtol=1e-8)
    assert np.ptp(result["hydraulic_stroke"], axis=0) == pytest.approx(0.0, abs=1e-6)
    assert result["cylinder_force"][0] == pytest.approx(expected, rel=1e-9)
    by_scene = Scene(name="the same, from the scene's statics")
    by_scene.add_crane(base="ground", payload=Payload(), held=True, hydraulics={"knuckle": OIL}, **POSE)
    by_scene.remove("main_cylinder.displacement")
    main = scene.loads["main_cylinder"]
    given = {field.name: getattr(main, field.name) for field in type(main).FIELDS}
    ram = by_scene.add_hydraulic_cylinder(**given | {"pressure": None, "pressure_rod": None})
    assert ram.pressure == pytest.approx(main.pressure, rel=1e-9)


def test_statics_tell_what_hydraulic_cylinders_hold() -> None:
    drawn = statics(crane())
    ideal = Scene(name="ideal")
    ideal.add_crane(base="ground", payload=Payload(), held=True, **POSE)
    for name, value in statics(ideal).columns.items():
        assert drawn.columns[name] == pytest.approx(value, rel=1e-9), name
    assert abs(drawn.columns["cylinder force main"]) > 1e3


@pytest.mark.parametrize("ramp", [20.0, 0.0])
def test_pressures_hold_a_crane_on_a_given_ship_in_a_sea(ramp: float) -> None:
    """The ship's motion is at its start no rest, and with ramp=0 not the described pose."""
    found = []
    for in_a_sea in (False, True):
        database, scene = shipped_database(), Scene(name="given")
        scene.add_given_vessel(database, ramp=ramp)
        crane = scene.add_crane(held=True, s1=2.0, s2=2.5, hydraulics={"main": OIL, "knuckle": OIL})
        body, head = crane.tip
        scene.add_body(
            name="load", mass=20e3, inertia=(2e4, 2e4, 2e4),
            position=scene.place_of(body=body, point=head) - np.array([0.0, 0.0, 15.0]),
        )  # fmt: skip
        scene.add_line(
            name="hoist", bodies=[body, "load"], points=[head, (0, 0, 0)], EA=1e8,
            tension_at_start=20e3 * scene.gravity,
        )  # fmt: skip
        if in_a_sea:
            scene.add_sea(hs=3.0, tp=7.0, seed=5)
        found.append([(one.pressure, one.pressure_rod) for one in scene.hold_pressures().values()])
    assert found[1] == found[0]


def test_both_formulations_move_a_hydraulic_crane_alike() -> None:
    opens = {"command": Curve.quintic(start_time=0, end_time=1, start=0, end=0.2)}
    scene = crane(BOTH | {"main": OIL | opens})
    one, two = (record(scene, 2.0, rtol=1e-9, formulation=name) for name in ("redundant", "recursive"))
    assert np.ptp(one["hydraulic_stroke"]) > 0.01
    assert np.max(np.abs(one["hydraulic_stroke"] - two["hydraulic_stroke"])) < 1e-8
    assert np.max(np.abs(one["hydraulic_pressure"] - two["hydraulic_pressure"])) < 1e-6 * OIL["pump_pressure"]
    for run in (one, two):
        assert np.max(np.abs(run["energy_balance"])) < 1e-6 * run["absolute_work"][-1]


def test_a_crane_without_hydraulics_is_what_it_was() -> None:
    plain = Scene(name="plain")
    plain.add_crane(base="ground", payload=Payload(), **POSE)
    none = Scene(name="plain")
    none.add_crane(base="ground", payload=Payload(), hydraulics={}, **POSE)
    assert plain == none
    assert not any("hydraulic" in name for name in plain.compile().channel_names(defaults_only=False))


def test_ideal_cylinders_are_the_rung_below() -> None:
    """Stiff oil has the slow modes of a crane with locked cylinders."""
    stiff = OIL | {"oil_modulus": 1e13, "hose_modulus": 1e13, "cylinder_modulus": 1e13, "gain": 0.0}
    locked = Scene(name="locked")
    locked.add_crane(base="ground", payload=Payload(), held=True, **POSE)
    soft, ideal = (
        natural_modes(scene).natural_period[:2]
        for scene in (crane({"main": stiff, "knuckle": stiff}), locked)
    )
    assert soft == pytest.approx(ideal, rel=1e-4)
    assert set(with_ideal_cylinders(crane()).actuators) == {"main_cylinder", "knuckle_cylinder"}


def on_a_ship(*, compensated: bool, **more: Any) -> Scene:
    """A load on a cylinder on a deck that heaves by 30 mm in 4 s."""
    scene = Scene(name="deck")
    scene.add_body(name="ship", mass=1e6, inertia=(1e6, 1e6, 1e6), position=(0, 0, 0))
    scene.add_joint(
        kind="prismatic", name="deck", first="ground", second="ship", point=(0, 0, 0), axis=(0, 0, 1)
    )
    swell = Curve.harmonic(start_time=2.0, offset=0.03, amplitude=0.03, omega=0.5 * np.pi, phase=np.pi)
    rise = Curve.constant(value=0.0).then(time=2.0, curve=swell)
    scene.add_driver(joint="deck", curve=rise)
    place = (0.0, 0.0, RETRACTED + START)
    scene.add_body(name="load", mass=1000.0, inertia=(10.0, 10.0, 10.0), position=place)
    scene.add_joint(
        kind="prismatic", name="guide", first="ship", second="load", point=(0, 0, 0), axis=(0, 0, 1)
    )
    scene.add_hydraulic_cylinder(
        name="ram", first="ship", second="load", **SET | {"gain": 20.0, "rate_gain": 12.0} | more
    )
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
    limit = {"relief_pressure": 1.2 * ram.pressure, "relief_flow": 3e-4, "relief_override": 6e5}
    limited = simulate(on_a_ship(compensated=True, **limit), 8.0, dt_out=0.1, rtol=1e-6)
    assert "ram.relief" in [event.name for event in limited.events]
    assert np.max(limited["hydraulic_pressure"][:, 0, 0]) < 1.2 * ram.pressure + 6e5


def test_a_compensator_finds_the_ratio_of_a_hydraulic_cylinder() -> None:
    ideal = Scene(name="ideal")
    ideal.add_crane(base="ground", s1=3.0, s2=3.8)
    for joint in ("A", "main_cylinder", "knuckle_cylinder"):
        ideal.add_actuator(joint=joint)
    oil = Scene(name="oil")
    oil.add_crane(base="ground", s1=3.0, s2=3.8, held=True, hydraulics={"knuckle": OIL})
    found = [
        scene.add_heave_compensation(name="ahc", body="king", actuator="knuckle_cylinder").ratio
        for scene in (ideal, oil)
    ]
    assert found[0] == pytest.approx(found[1], rel=1e-9)


def test_a_data_file_may_say_that_a_crane_is_hydraulic(tmp_path: Path) -> None:
    keys = ("pump_pressure = 32e6", "rated_flow = 0.05", "rated_drop = 1e6", "pump_check = true")
    table = "\n".join(("[main_cylinder.hydraulics]", *keys, ""))
    text = data_file.DEFAULT_PATH.read_text(encoding="utf-8")
    file = tmp_path / "crane.toml"
    file.write_text(
        text.replace("[[main_cylinder.barrel]]", table + "\n[[main_cylinder.barrel]]"), encoding="utf-8"
    )
    scene = Scene(name="of a file")
    scene.add_crane(KnuckleBoomCrane.load(file), base="ground", held=True)
    assert scene.loads["main_cylinder"].rated_flow == 0.05 and scene.loads["main_cylinder"].pump_check
    assert set(scene.drivers) == {"A.angle", "knuckle_cylinder.displacement"}
    file.write_text(
        text.replace("[[main_cylinder.barrel]]", table + "colour = 1\n[[main_cylinder.barrel]]"),
        encoding="utf-8",
    )
    with pytest.raises(FileFormatError, match=r"unknown key main_cylinder.hydraulics.colour"):
        KnuckleBoomCrane.load(file)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"boom": OIL}, "hydraulics are given of cylinder 'boom'; the cylinders are 'main', 'knuckle'"),
        (True, "hydraulics are True; give {'main'"),
        ({"main": {"colour": 1.0}}, "colour"),
        (
            {"main": OIL | {"relief_pressure": 1e6, "relief_flow": 0.1}},
            "relief_pressure is .* below the holding",
        ),
    ],
)
def test_bad_hydraulics_of_a_crane_are_named(given: Any, message: str) -> None:
    with pytest.raises((SceneError, TypeError), match=message):
        crane(given).compile()
