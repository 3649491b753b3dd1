"""Tables of lift files that no lift of `lift_examples` has: each gives what its call gives."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from lift_examples import HEAD, lift_of
from test_jointed_cranes import LATTICE

from seacrane import MotionRaos, Scene, simulate
from seacrane.crane import load_crane
from seacrane.hydro import shipped_database
from seacrane.scene import MotionHistory

G, LOAD = 9.80665, 40e3  # m/s2, kg
SHIPS = """
[[vessel]]
database = "hull_115"; motion = "raos"; duration_s = 30; ramp_s = 5
[[vessel]]
name = "barge"; position_m = [0, 60, 0]; heading_deg = 90; size_m = [90, 30, 5]
[vessel.raos]
omega_rad_per_s = [0.3, 0.6]
[[vessel.raos.headings]]
heading_deg = 0
amplitude = [[1, 0, 1, 0, 0.009, 0], [0.8, 0, 0.8, 0, 0.02, 0]]
phase_deg = [[-90, 0, 0, 0, -90, 0], [-90, 0, 0, 0, -90, 0]]
[[vessel]]
name = "quay"; motion = "rest"; position_m = [0, 120, 0]
[[vessel]]
name = "measured"; position_m = [0, 180, 0]
[vessel.history]
time_s = [0, 1, 2, 3, 4, 5]
motion = [[0, 0, 0, 0, 0, 0], [0, 0, 0.1, 0, 0, 0], [0, 0, 0.2, 0, 0, 0],
          [0, 0, 0.3, 0, 0, 0], [0, 0, 0.2, 0, 0, 0], [0, 0, 0.1, 0, 0, 0]]
[[sea]]
hs_m = 1; tp_s = 12; direction_deg = 90; count = 40
[[sea]]
vessel = "barge"
[[sea]]
vessel = "quay"
""".replace("; ", "\n")


@pytest.mark.warns("RaoPhaseWarning", "OutsideRaosWarning", sometimes=("OutsideRaosWarning",))
def test_given_ships(tmp_path: Path) -> None:
    barge = MotionRaos(
        omega=[0.3, 0.6], heading=[0.0],
        values=[[[-1j, 0, 1, 0, -0.009j, 0], [-0.8j, 0, 0.8, 0, -0.02j, 0]]],
    )  # fmt: skip
    motion = np.zeros((6, 6))
    motion[:, 2] = 0.0, 0.1, 0.2, 0.3, 0.2, 0.1
    scene = Scene()
    scene.add_vessel(motion=shipped_database(), duration=30.0, ramp=5.0)
    scene.add_vessel(motion=barge, name="barge", position=(0, 60, 0), heading_deg=90.0, size=(90, 30, 5))
    scene.add_vessel(motion="rest", name="quay", position=(0, 120, 0))
    history = MotionHistory(time=range(6), motion=motion)
    scene.add_vessel(motion=history, name="measured", position=(0, 180, 0))
    scene.add_sea(hs=1.0, tp=12.0, direction_deg=90.0, count=40)
    scene.add_sea(vessel="barge")
    scene.add_sea(vessel="quay")
    read = lift_of(HEAD + SHIPS, tmp_path).scene()
    one, other = simulate(read, 5.0), simulate(scene, 5.0)
    np.testing.assert_allclose(one["vessel_motion"], other["vessel_motion"], atol=1e-12)
    assert np.ptp(one["vessel_motion"][:, 0, 2]) > 1e-3 and read.provenance == scene.provenance
    scene.save(tmp_path / "scene.json")
    assert Scene.load(tmp_path / "scene.json") == scene


def test_a_luffing_rope_lifts_the_boom_that_it_holds(tmp_path: Path) -> None:
    text = """
[crane]
crane = "crane.toml"; base = "ground"; foot_m = [0, 0, 0]; held = true
[[crane.coordinates]]
name = "boom"; value_deg = 60
[crane.payload]
mass_kg = 20e3
[winch]
line = "luffing rope"; rate_m_per_s = 0.1
[run]
t_end_s = 0.5
""".replace("; ", "\n")
    (tmp_path / "crane.toml").write_text(LATTICE, encoding="utf-8")
    result = lift_of(HEAD + text, tmp_path).simulate()
    assert result["link_tension"][0] == pytest.approx(20e3 * G, rel=1e-2)
    assert result["line_length"][-1, 0] > result["line_length"][0, 0]


def test_pressures_hold_a_crane_with_its_load(tmp_path: Path) -> None:
    crane = load_crane()
    scene = Scene()
    scene.add_crane(crane, base="ground", foot=(0, 0, 0), slew=-1.0, s1=2.0, s2=3.0, held=True)
    body, point = scene.roles[""].tip
    x, y, z = scene.place_of(body=body, point=point).tolist()
    text = f"""
[crane]
base = "ground"; foot_m = [0, 0, 0]; slew_rad = -1.0; s1_m = 2.0; s2_m = 3.0; held = true
hydraulics = {{ main = {{ pump = {{ pressure_Pa = 32e6 }}, valve = {{ rated_flow_m3_per_s = 0.05 }} }} }}
[[body]]
name = "load"; mass_kg = {LOAD}; inertia_kg_m2 = [4e4, 4e4, 4e4]; position_m = [{x!r}, {y!r}, {z - 12.0!r}]
[[line]]
name = "hoist"; bodies = ["{body}", "load"]; points_m = [{list(point)}, [0, 0, 0]]; EA_N = 3e8
tension_at_start_N = {LOAD * G!r}
[hold_pressures]
[run]
t_end_s = 1
""".replace("; ", "\n")
    assert np.ptp(lift_of(HEAD + text, tmp_path).simulate()["hydraulic_stroke"]) < 1e-6
