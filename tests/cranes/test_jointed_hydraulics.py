"""Hydraulic cylinders of cranes that are no knuckle booms: A-frame and URDF arm, by calls and data files."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from seacrane import Move, Scene, SceneError, Stage, simulate, simulate_stages, statics
from seacrane.crane import Payload, load_crane
from seacrane.crane.load_crane import SHIPPED
from seacrane.errors import FileFormatError
from seacrane.hydro import shipped_database

OIL: dict[str, Any] = {
    "pump_pressure": 25e6, "rated_flow": 0.01, "rated_drop": 1e6, "gain": 0.4, "spool_lag": 0.03,
    "viscous_friction": 5e5,
}  # fmt: skip
LOAD = Payload(mass=15e3, size=(2.0, 2.0, 2.0), link_length=3.0)


def a_frame(*, base: str = "ground", tilt: float = 0.5, **oil: Any) -> Scene:
    scene = Scene(name="A-frame")
    if base == "vessel":
        scene.add_vessel(shipped_database())
    scene.add_crane(
        load_crane("a_frame_40t"), base=base, foot=(-50.0, 0.0, 10.0), coordinates={"tilt": tilt},
        payload=LOAD, held=True, hydraulics={"tilt": OIL | oil},
    )  # fmt: skip
    return scene


@pytest.mark.parametrize("tilt", [-1.6, 0.5, 2.6])
def test_an_a_frame_starts_at_rest_on_its_oil(tilt: float) -> None:
    """Its own statics are those of the engine, at the ends of the stroke too."""
    scene = a_frame(tilt=tilt)
    ram = scene.loads["cylinder"]
    assert (ram.first, ram.second, list(scene.drivers)) == ("barrel", "rod", [])
    home = float(np.hypot(5.0, 5.2))
    assert (ram.retracted_length, ram.stroke) == pytest.approx((home - 1.6, 4.2), rel=1e-12)
    assert ram.full_area == pytest.approx(np.pi / 4.0 * 0.3**2)
    assert ram.full_area - ram.rod_side_area == pytest.approx(np.pi / 4.0 * 0.2**2)
    engine = scene.copy()
    found = engine.hold_pressures()["cylinder"]
    assert (ram.pressure, ram.pressure_rod) == pytest.approx((found.pressure, found.pressure_rod), rel=1e-6)
    if tilt == 0.5:
        result = simulate(scene, 1.0, dt_out=0.5, rtol=1e-8)
        assert np.ptp(result["hydraulic_stroke"]) < 1e-6
        told = float(statics(scene, coordinates={"tilt": 0.0})["cylinder force tilt"])
        assert result["cylinder_force"][0, 0] == pytest.approx(told, rel=1e-5)


@pytest.mark.warns("BoilingOilWarning")
def test_a_stage_swings_the_frame_out_over_the_stern() -> None:
    scene = a_frame(base="vessel")
    move = Stage(name="out", duration=25.0, commands={"cylinder.reference": Move(by=1.0, over=20.0)})
    one, two = (
        simulate_stages(scene, [move], dt_out=0.5, formulation=formulation)
        for formulation in ("recursive", "redundant")
    )
    for result in (one, two):
        assert np.ptp(result["hydraulic_stroke"]) == pytest.approx(1.0, abs=0.05)
        assert np.max(np.abs(result["energy_balance"])) < 1e-6 * result["absolute_work"][-1]
    np.testing.assert_allclose(one["hydraulic_stroke"], two["hydraulic_stroke"], atol=1e-6)


AREAS = {"full_area": 0.0154, "rod_side_area": 0.0104}


def arm(label: str, **oil: Any) -> Scene:
    scene = Scene(name="arm")
    load = Payload(mass=2e3, size=(1.0, 1.0, 1.0), link_length=2.0)
    scene.add_crane(
        load_crane("service_arm_5t"), base="ground", foot=(0, 0, 0), coordinates={"jib": 0.4, "slew": 0.3},
        payload=load, held=True, damping=False, hydraulics={label: OIL | oil},
    )  # fmt: skip
    return scene


def test_the_jib_of_a_urdf_arm_stands_on_oil() -> None:
    scene = arm("jib", **AREAS)
    assert set(scene.drivers) == {"slew.angle", "telescope.displacement"}
    result = simulate(scene, 1.0, dt_out=0.5, rtol=1e-8)
    assert np.ptp(result["hydraulic_stroke"]) < 1e-6


@pytest.mark.parametrize(
    ("label", "oil", "message"),
    [
        ("jib", {}, "the areas of the jib cylinder are not known"),
        (
            "telescope",
            AREAS,
            "cylinder 'telescope': where it takes hold is not known, as no other joint of",
        ),
        ("boom", AREAS, "hydraulics are given of cylinder 'boom'; the cylinders are 'jib', 'telescope'"),
    ],
)
def test_oil_that_does_not_fit_is_told(label: str, oil: dict[str, Any], message: str) -> None:
    with pytest.raises(SceneError, match=message):
        arm(label, **oil)


def test_a_lattice_boom_has_no_cylinders() -> None:
    with pytest.raises(SceneError, match="the cylinders are none"):
        Scene(name="x").add_crane(load_crane("lattice_boom_100t"), base="ground", hydraulics={"boom": OIL})


PISTON = """
[[pistons]]
cylinder = "tilt"

[pistons.hydraulics]
pump_pressure = 25e6
rated_flow = 0.01
gain = 1.0
"""


def test_a_data_file_may_say_that_a_frame_is_hydraulic(tmp_path: Path) -> None:
    path = tmp_path / "frame.toml"
    text = (SHIPPED / "a_frame_40t.toml").read_text(encoding="utf-8") + PISTON
    path.write_text(text, encoding="utf-8")
    scene = Scene(name="of a file")
    scene.add_crane(load_crane(path), base="ground", foot=(0, 0, 0), held=True)
    assert scene.loads["cylinder"].rated_flow == 0.01
    path.write_text(text.replace("gain = 1.0", "colour = 1.0"), encoding="utf-8")
    with pytest.raises(FileFormatError, match=r"unknown key pistons\[0\].hydraulics.colour"):
        load_crane(path)
