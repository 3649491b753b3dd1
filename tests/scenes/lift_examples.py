"""Lifts as text, and the same by calls of the API."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path
from typing import Any

import numpy as np

from seacrane import Curve, FlowCoefficients, Frame, Lift, Scene
from seacrane.description.hydraulic_cylinders import VALUES
from seacrane.hydro import BoxPart, Compartment, Opening, SpherePart
from seacrane.lift.tables import TABLES
from seacrane.scene import gust_curve, heave, spline_curve, springs


def lift_of(text: str, folder: Path, name: str = "my_lift.toml") -> Lift:
    (folder / name).write_text(text, encoding="utf-8")
    return Lift.load(folder / name)


HEAD = 'format = "seacrane lift"\nversion = 2\n'

PENDULUM = (
    HEAD
    + """
[scene]; name = "pendulum"

[[body]]; name = "bob"; mass_kg = 2; inertia_kg_m2 = [0.1, 0.1, 0.1]; position_m = [1, 0, 0]

[[joint]]; kind = "revolute"; name = "pivot"; first = "ground"; second = "bob"; point_m = [0, 0, 0]
axis = [0, 1, 0]

[run]; t_end_s = 2

[method]; integrator = "rk4"; dt_s = 0.01

[outputs]; dt_out_s = 0.5; channels = ["position", "constraint_error", "energy_balance"]
""".replace("; ", "\n")
)

# A line may hold several keys.
EVERY_TABLE = (
    HEAD
    + """
[scene]; name = "every table"; gravity_m_per_s2 = 9.81; orientation = "euler_xyz"; baumgarte_per_s = 0.5
length_scale = 1.1
[[body]]; name = "hull"; mass_kg = 1e6; inertia_kg_m2 = [[2e6, 1e5, 0], [1e5, 3e6, 0], [0, 0, 2.5e6]]
center_of_mass_m = [0.1, -0.2, 0.3]; angular_velocity_deg_per_s = [0, 0, 2]
[[body]]; name = "arm"; mass_kg = 12.5; inertia_kg_m2 = [1, 2, 3]; position_m = [1, 0, 2]
quaternion = [0.5, 0.5, 0.5, 0.5]; velocity_m_per_s = [0, 0.1, 0]; gravity = false
[[body]]; name = "bob"; mass_kg = 3; inertia_kg_m2 = [1, 1, 1]; position_m = [4, 0, 0]
[[body]]; name = "box"; mass_kg = 3; inertia_kg_m2 = [1, 1, 1]; position_m = [4, 1, 0]
[hydrodynamics]; body = "hull"; name = "water"; added_mass = [
    [1e5, 0, 0, 0, 0, 0], [0, 1e5, 0, 0, 0, 0], [0, 0, 1e5, 0, 0, 0],
    [0, 0, 0, 1e5, 0, 0], [0, 0, 0, 0, 1e5, 0], [0, 0, 0, 0, 0, 1e5],
]; quadratic_damping = [0, 0, 3, 4, 5, 0]; mooring_stiffness = [1e4, 2e4, 3e4]; kinematics = "paper"
[[joint]]; kind = "revolute"; name = "pin"; first = "hull"; second = "arm"; axis = [0.3, 1, 0.2]
[[joint]]; kind = "universal"; name = "cross"; first = "hull"; second = "bob"; axis = [1, 0, 0]
second_axis = [0, 0, 1]
[[joint]]; kind = "distance"; name = "rope"; first = "bob"; second = "box"; point_m = [4, 0, 0]
second_point_m = [4, 1, 0.5]; length_m = 1.25
[[joint]]; kind = "cylindrical"; name = "sleeve"; first = "ground"; second = "box"
first_frame = { point_m = [4, 1, 0] }; second_frame = {}
[[joint]]; kind = "weld"; name = "deck"; first = "ground"; second = "hull"
[[driver]]; joint = "sleeve"; name = "shaker"
curve_m = { kind = "harmonic", amplitude = 0.01, period_s = 5, phase_deg = -90 }
[[driver]]; joint = "sleeve"; coordinate = "angle"; curve_deg = [
    { kind = "spline", times_s = [0, 1, 2, 3, 4, 5, 6], values = [0, 0, 1, 4, 9, 10, 10] },
    { from_s = 6, kind = "constant", value = 10 },
]
[actuator]; name = "motor"; joint = "pin"; stiffness_N_m_per_rad = 1e3; damping_N_m_s_per_rad = 200
feed_forward_N_m = 5.5; reference_deg = [
    { kind = "quintic", start_time_s = 1, end_time_s = 7, start = 0, end = -30 },
    { from_s = 9, kind = "harmonic", start_time_s = 9, offset = -30, amplitude = 2, period_s = 4 },
]
[[force]]; name = "push"; body = "arm"; force_N = [3, 0, 0]; point_m = [0, 0.5, 0]; body_axes = true
[[spring]]
name = "soft"; first = "ground"; second = "bob"; stiffness_N_per_m = 100; damping_N_s_per_m = 0.1
natural_length_m = 0.3
[[spring]]; name = "table"; first = "hull"; second = "box"; lengths_m = [1, 2.5]; forces_N = [0, 10]
[[line]]
name = "hoist"; bodies = ["ground", "box", "bob"]; points_m = [[0, 0, 9], [0, 0, 1], [0, 0, 0]]; EA_N = 1e6
length_m = 12; damping_ratio = 0.05; mass_kg = 300
[[line]]; name = "whip"; bodies = ["ground", "ground", "bob"]; points_m = [[-3, 0, 9], [0, 0, 9], [0, 0, 0]]
strains = [0, 0.1]; tensions_N = [0, 1000]; length_m = 12
sheaves = { radii_m = [0, 0.3, 0], axes = [[0, 0, 0], [0, 1, 0], [0, 0, 0]], efficiencies = [1, 0.98, 1] }
[[roles]]; prefix = "quay "; tip = { body = "hull", point_m = [6, 0, 20] }
[[hoist]]
name = "quay hoist"; crane = "quay "; load = "anode"; mass_kg = 2e3; size_m = [1, 1, 2]; length_m = 5
falls = 2; stiffness_N_per_m = 1e6; block_mass_kg = 100
slings = { angle_deg = 60, EA_N = 1e7, breaking_load_N = 6e5 }; breaking_load_N = 4e5; safety_factor = 3
winch = { lag_s = 0.2, maximum_rate_m_per_s = 0.5 }
[[winch]]
line = "hoist"; rate_m_per_s = {kind = "quintic", start_time_s = 0, end_time_s = 2, start = 0, end = 0.5}
maximum_rate_m_per_s = 1; maximum_acceleration_m_per_s2 = 0.5; lag_s = 0.1; minimum_length_m = 2
maximum_length_m = 60
tension_N = {kind = "quintic", start_time_s = 1, end_time_s = 3, start = 2e3, end = 4e3}
tension_gain_m_per_s_per_N = 1e-4; dead_band_N = 100; drum_inertia_kg_m2 = 500; drum_radius_m = 0.5
maximum_tension_N = 3e4; maximum_power_W = 5e4
brake = {kind = "quintic", start_time_s = 5, end_time_s = 5.1, start = 0, end = 1}; brake_capacity_N = 4e4
brake_give_m = 2e-3
[[heave_compensation]]
name = "ahc"; body = "hull"; point_m = [1, 2, 3]; winch = "hoist"; ratio = 1.5; high_pass_Hz = 0.02
lag_s = 0.3; lag_order = 2; drive = { frequency_Hz = 1.5, maximum_rate_m_per_s = 2, maximum_stroke_m = 3 }
[[spring]]; name = "phc"; first = "box"; second = "bob"; damping_N_s_per_m = 100
gas = { area_m2 = 0.05, length_m = 4, force_N = 2e4, stiffness_N_per_m = 3e3, exponent = 1.3 }
stops = { minimum_m = 1, maximum_m = 7 }
[[hydraulic_cylinder]]
name = "ram"; first = "box"; second = "bob"; full_area_m2 = 0.05; rod_side_area_m2 = 0.03
retracted_length_m = 0.1; stroke_m = 20; chamber.pressure_Pa = 2e6; rod_chamber.pressure_Pa = 1e6
pump = { pressure_Pa = 2e7, check = true }; valve = { rated_flow_m3_per_s = 0.01, gain_per_m = 2 }
reference_m = { kind = "quintic", start_time_s = 0, end_time_s = 5, start = 3, end = 4 }
rupture = { time_s = 9, area_m2 = 1e-5 }
[[force]]
name = "gust"; body = "box"; times_s = [0, 1]; force_N = [[0, 1, 2, 3, 4, 5], [6, 7, 8, 9, 10, 11]]
[[line]]
name = "chain"; rung = "quasi-static"; bodies = ["ground", "box"]; points_m = [[20, 5, 10], [0, 0, 1]]
EA_N = 1e8; length_m = 40; settling_s = 0.3
[line.wire]; mass_per_length_kg_per_m = 5; segments = 3; diameter_m = 0.02; flow_m_per_s = [1, 0, 0]
seabed = { depth_m = 50, stiffness_N_per_m2 = 1e4, friction = 0.5, damping_ratio = 0.4, give_m = 0.02 }
[[line]]
name = "wet chain"; bodies = ["ground", "box"]; points_m = [[20, 5, -10], [0, 0, 1]]
EA_N = 1e8; length_m = {kind = "quintic", start_time_s = 1, end_time_s = 9, start = 30, end = 34}
[line.wire]; mass_per_length_kg_per_m = 5; segments = 2; diameter_m = 0.05; medium = "sea"
density_kg_per_m3 = 1000; drag_coefficient_along = 0.02; added_mass_coefficient = 0.9
[[immersed]]; body = "bob"; parts = [
    { kind = "sphere", diameter_m = 0.4 },
    { kind = "box", size_m = [1, 2, 0.5], strips = [2, 1], point_m = [0, 0, 0.1], slam = 6 },
]
[immersed.inside]; name = "skirt"; area_m2 = 1.5; height_m = 0.5; point_m = [0, 0, -0.15]
openings = [{ point_m = [0, 0.5, -0.1], area_m2 = 0.02 }, { point_m = [0.5, 0, 0.3], area_m2 = 0.01 }]
air = "shut"; exponent = 1.2; air_pressure_Pa = 1.1e5; initial_m3 = 0.5
[[spring]]
name = "swing"; first = "ground"; first_point_m = [0, 0, 9]; second = "bob"; damping_ratio = 0.01
[[wind]]; body = "bob"; frontal_area_m2 = 2; lateral_area_m2 = 3; drag_coefficient = 0.8
[[wind]]; body = "hull"; direction_deg = 90; frontal_area_m2 = 400; lateral_area_m2 = 1200; length_m = 100
coefficients = { angle_deg = [0, 90, 180], x = [0.9, 0, -0.9], y = [0, 0.8, 0], yaw = [0, 0.1, 0] }
[wind.speed_m_per_s]; kind = "gust"; mean_speed_m_per_s = 12; duration_s = 10; seed = 3
[current]
body = "hull"; speed_m_per_s = 0.5; direction_deg = 0; frontal_area_m2 = 200; lateral_area_m2 = 700
length_m = 100
[current.coefficients]; angle_rad = [0.0, 1.5, 3.0]; x = [0.1, 0, -0.1]; y = [0, 0.6, 0]; yaw = [0, 0.05, 0]
[[line]]; joint = "rope"; rung = "rigid"; restitution = 0.2
[[stop]]
joint = "sleeve"; coordinate = "angle"; minimum_deg = -90; maximum_deg = 90; sticking_speed_rad_per_s = 0.01
[[stop]]; joint = "deck"
[[stop]]; joint = "sleeve"; maximum_m = 2; stiffness_N_per_m = 1e4; damping_s_per_m = 0.5
[friction]; joint = "pin"; load_N_m = 4; speed_deg_per_s = 1
[[contact]]
name = "landing"; body = "bob"; points_m = [[0.5, 0, -0.5], [-0.5, 0, -0.5]]; on = "hull"; surface = "box"
place_m = [0, 0, -30]; size_m = [8, 4, 0.5]; stiffness_N_per_m = 1e5; damping_s_per_m = 0.5; friction = 0.3
hold_m = 2e-3
[[contact]]; body = "bob"; points_m = [[0.5, 0, 0.5]]; on = "hull"; surface = "plane"; axis = [0, -1, 0]
place_m = [0, 50, 0]; table = [[0, 0], [0.1, 2e3], [0.3, 2e4]]
[[contact]]; body = "box"; points_m = [[0, 0, -0.5]]; on = "seabed"; depth_m = 80; stiffness_N_per_m = 2e5
friction = 0.4
[[point]]; name = "corner"; body = "box"; point_m = [0.1, 0.2, 0.3]
[[point]]; name = "edge"; body = "hull"; point_m = [1, 2, 3]
[[channel]]; joint = "sleeve"; minimum_m = -1; maximum_m = 3
[[channel]]; name = "hull"; points = ["corner"]; body = "hull"; center_m = [1, 0, 2]; size_m = [3, 4, 5]
[[channel]]; name = "drop"; expression = "edge.z - box.z in hull"
[[limit_state]]; channel = "link_tension"; maximum_N = 8e4; minimum_N = 1e3
[[limit_state]]; name = "luffing"; channel = "stroke"; maximum_m = 2.5; names = { cylinder = "aft luff" }
[[limit_state]]; channel = "vessel_motion"; maximum_deg = 90; names = { motion = "roll" }
[lift_factors]
load = "box"; weight_contingency = 1.1; center_of_gravity_m = [0.1, 0, 0]; skew_load = [1.25]
dynamic_factor = 1.3; sling_safety_factor = 3; shackle_safety_factor = 4; shackle_breaking_load_N = 1e5
alpha = 0.7; sources = { alpha = "the project's own" }
[[channel]]; joint = "pin"; name = "angle of the arm"
[[channel]]; joint = "sleeve"; coordinate = "angle"; name = "turn"
[[roles]]; prefix = "aft "; slew = "pin"; cylinders = { luff = "sleeve" }; link = "rope"
tip = { body = "arm", point_m = [0, 0, 1] }
areas = [{ cylinder = "luff", full_m2 = 0.5, rod_side_m2 = 0.25 }]
[notes]; project = "A-17"; tries = [1, 2.5]
""".replace("; ", "\n")
)


UNIT = re.compile("(?:_(?:m2|m3|m|kg|N|Pa|s2|s|Hz|W|deg|rad|per))+$")
KINDS: dict[str, Any] = {"first_frame": Frame, "second_frame": Frame, "openings": Opening}
KINDS |= {"inside": Compartment, "coefficients": FlowCoefficients}
KINDS |= VALUES | heave.VALUES | springs.VALUES
PARTS = {"sphere": SpherePart, "box": BoxPart}
CURVES = {"spline": spline_curve, "gust": gust_curve}
ORDINATES = {"value", "start", "end", "amplitude", "offset", "values"}


def every_table() -> Scene:
    """What `EVERY_TABLE` describes, by calls: keys without units are keywords, degrees become radians."""
    parsed = tomllib.loads(EVERY_TABLE)
    scene = Scene(**_words(parsed["scene"]))
    scene.notes.update(parsed["notes"])
    for name in (name for name in TABLES if name in parsed and name not in ("scene", "notes")):
        call = {"hydrodynamics": "add_vessel"}.get(name, f"add_{name}")
        for one in parsed[name] if isinstance(parsed[name], list) else [parsed[name]]:
            getattr(scene, call)(**_words(one))
    return scene


def _words(table: dict[str, Any], kept: tuple[str, ...] = ("direction_deg",)) -> dict[str, Any]:
    return dict(_word(key, value) if key not in kept else (key, value) for key, value in table.items())


def _word(key: str, told: Any) -> tuple[str, Any]:
    name = UNIT.sub("", key)
    turned = "deg" in key[len(name) :]
    first = told[0] if isinstance(told, list) else told
    if name == "tip":
        return name, (told["body"], told["point_m"])
    if name == "areas":
        return name, {one["cylinder"]: (one["full_m2"], one["rod_side_m2"]) for one in told}
    if name == "parts":
        told = [dict(one) for one in told]
        return name, [PARTS[one.pop("kind")](**_words(one)) for one in told]
    if name in KINDS:
        made = [KINDS[name](**_words(one)) for one in (told if isinstance(told, list) else [told])]
        return name, made if isinstance(told, list) else made[0]
    if isinstance(first, dict) and "kind" in first:
        return name, _curve(told if isinstance(told, list) else [told], turned)
    if isinstance(told, dict):
        return name, _words(told, kept=("angle_deg",))
    return name, np.radians(told) if turned else told


def _curve(pieces: list[dict[str, Any]], turned: bool) -> Curve:
    curve = None
    for piece in pieces:
        given = _words(piece)
        if turned:
            given |= {name: np.radians(given[name]) for name in given.keys() & ORDINATES}
        at, kind = given.pop("from", None), given.pop("kind")
        if "period" in given:
            given["omega"] = 2.0 * np.pi / given.pop("period")
        one = (CURVES.get(kind) or getattr(Curve, kind))(**given)
        curve = one if curve is None else curve.then(time=at, curve=one)
    return curve


ON_DECK = (
    HEAD
    + """
[scene]; name = "on deck"

[[body]]; name = "load"; mass_kg = 20e3; inertia_kg_m2 = [1e4, 1e4, 1e4]; position_m = [0, 0, 1]

[[joint]]; kind = "weld"; name = "on deck"; first = "ground"; second = "load"; point_m = [0, 0, 0]

[stop]; joint = "on deck"

[line]; name = "hoist"; bodies = ["ground", "load"]; points_m = [[0, 0, 21], [0, 0, 0]]; EA_N = 5e7
length_m = 20.1

[winch]; line = "hoist"

[[stage]]; name = "hold"; duration_s = 1.05

[[stage]]; name = "lift off"; until = [{ release = "on deck" }]; maximum_duration_s = 60
commands = [{ name = "hoist.rate", value_m_per_s = -0.05 }]

[[stage]]; name = "raise"; until = [{ length = "hoist", maximum_m = 19.6 }]; maximum_duration_s = 60
commands = [{ name = "hoist.rate", to_m_per_s = -0.4, over_s = 1 }]

[[stage]]; name = "stop"; duration_s = 1
commands = [{ name = "hoist.rate", curve_m_per_s = { kind = "constant", value = 0 } }]

[[stage]]; name = "let go"; duration_s = 0.5; release = ["hoist"]

[outputs]; dt_out_s = 0.05
""".replace("; ", "\n")
)
