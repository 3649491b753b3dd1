"""Lifts as text, and the same by calls of the API."""

from __future__ import annotations

import numpy as np

from seacrane import Curve, FlowCoefficients, Frame, Scene
from seacrane.scene import gust_curve, spline_curve
from seacrane.water import BoxPart, Opening, SpherePart

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
[[point_force]]; name = "push"; body = "arm"; force_N = [3, 0, 0]; point_m = [0, 0.5, 0]; body_axes = true
[[spring]]
name = "soft"; first = "ground"; second = "bob"; stiffness_N_per_m = 100; damping_N_s_per_m = 0.1
natural_length_m = 0.3
[[spring]]; name = "table"; first = "hull"; second = "box"; lengths_m = [1, 2.5]; forces_N = [0, 10]
[[line]]
name = "hoist"; bodies = ["ground", "box", "bob"]; points_m = [[0, 0, 9], [0, 0, 1], [0, 0, 0]]; EA_N = 1e6
length_m = 12; damping_ratio = 0.05; mass_kg = 300
[[line]]; name = "whip"; bodies = ["ground", "ground", "bob"]; points_m = [[-3, 0, 9], [0, 0, 9], [0, 0, 0]]
strains = [0, 0.1]; tensions_N = [0, 1000]; length_m = 12; radii_m = [0, 0.3, 0]
axes = [[0, 0, 0], [0, 1, 0], [0, 0, 0]]; efficiencies = [1, 0.98, 1]; slip_speed_m_per_s = 0.02
[[bridle]]; name = "sling"; hook = "ground"; load = "box"; hook_point_m = [0, 0, 9]
points_m = [[0.5, 0, 0.5], [-0.5, 0, 0.5]]; EA_N = [1e6]
[[roles]]; prefix = "quay "; tip = { body = "hull", point_m = [6, 0, 20] }
[[hoist]]
name = "quay hoist"; crane = "quay "; load = "anode"; mass_kg = 2e3; size_m = [1, 1, 2]; length_m = 5
falls = 2; stiffness_N_per_m = 1e6; block_mass_kg = 100
slings = { angle_deg = 60, EA_N = 1e7, breaking_load_N = 6e5 }; breaking_load_N = 4e5; safety_factor = 3
winch = { lag_s = 0.2, maximum_rate_m_per_s = 0.5 }
[[winch]]
line = "hoist"; rate_m_per_s = {kind = "quintic", start_time_s = 0, end_time_s = 2, start = 0, end = 0.5}
maximum_rate_m_per_s = 1; maximum_acceleration_m_per_s2 = 0.5; lag_s = 0.1; minimum_length_m = 2
tension_N = {kind = "quintic", start_time_s = 1, end_time_s = 3, start = 2e3, end = 4e3}
tension_gain_m_per_s_per_N = 1e-4; dead_band_N = 100; drum_inertia_kg_m2 = 500; drum_radius_m = 0.5
maximum_tension_N = 3e4; maximum_power_W = 5e4
brake = {kind = "quintic", start_time_s = 5, end_time_s = 5.1, start = 0, end = 1}; brake_capacity_N = 4e4
brake_give_m = 2e-3
[[heave_compensation]]
name = "ahc"; body = "hull"; point_m = [1, 2, 3]; winch = "hoist"; ratio = 1.5; high_pass_Hz = 0.02
lag_s = 0.3; lag_order = 2; actuator_frequency_Hz = 1.5; maximum_rate_m_per_s = 2; maximum_stroke_m = 3
[[gas_spring]]
name = "phc"; first = "box"; second = "bob"; area_m2 = 0.05; force_N = 2e4; stiffness_N_per_m = 3e3
length_m = 4; exponent = 1.3; damping_N_s_per_m = 100; minimum_m = 1; maximum_m = 7
[[hydraulic_cylinder]]
name = "ram"; first = "box"; second = "bob"; full_area_m2 = 0.05; rod_side_area_m2 = 0.03
retracted_length_m = 0.1; stroke_m = 20; pressure_Pa = 2e6; pressure_rod_Pa = 1e6; pump_pressure_Pa = 2e7
rated_flow_m3_per_s = 0.01; pump_check = true
reference_m = { kind = "quintic", start_time_s = 0, end_time_s = 5, start = 3, end = 4 }; gain_per_m = 2
rupture_time_s = 9; rupture_area_m2 = 1e-5
[[force_table]]
name = "gust"; body = "box"; times_s = [0, 1]; loads = [[0, 1, 2, 3, 4, 5], [6, 7, 8, 9, 10, 11]]
[[line]]
name = "chain"; rung = "with mass"; bodies = ["ground", "box"]; points_m = [[20, 5, 10], [0, 0, 1]]
EA_N = 1e8; length_m = 40; mass_per_length_kg_per_m = 5; segments = 3; segment_rung = "quasi-static"
settling_s = 0.3; diameter_m = 0.02; flow_m_per_s = [1, 0, 0]
seabed = { depth_m = 50, stiffness_N_per_m2 = 1e4, friction = 0.5, damping_ratio = 0.4, give_m = 0.02 }
[[line]]
name = "wet chain"; rung = "with mass"; bodies = ["ground", "box"]; points_m = [[20, 5, -10], [0, 0, 1]]
EA_N = 1e8; length_m = {kind = "quintic", start_time_s = 1, end_time_s = 9, start = 30, end = 34}
mass_per_length_kg_per_m = 5; segments = 2; diameter_m = 0.05; medium = "sea"; density_kg_per_m3 = 1000
drag_coefficient_along = 0.02; added_mass_coefficient = 0.9
[[immersed]]; body = "bob"; parts = [
    { kind = "sphere", diameter_m = 0.4 },
    { kind = "box", size_m = [1, 2, 0.5], strips = [2, 1], point_m = [0, 0, 0.1], slam = 6 },
]
[[entrapped_water]]; name = "skirt"; body = "bob"; area_m2 = 1.5; height_m = 0.5; point_m = [0, 0, -0.15]
openings = [{ point_m = [0, 0.5, -0.1], area_m2 = 0.02 }, { point_m = [0.5, 0, 0.3], area_m2 = 0.01 }]
air = "shut"; exponent = 1.2; air_pressure_Pa = 1.1e5; initial_m3 = 0.5
[pendulum_damping]
name = "swing"; first = "ground"; first_point_m = [0, 0, 9]; second = "bob"; ratio = 0.01
[air_drag]; body = "bob"; frontal_area_m2 = 2; lateral_area_m2 = 3; drag_coefficient = 0.8
[wind]; body = "hull"; direction_deg = 90; frontal_area_m2 = 400; lateral_area_m2 = 1200; length_m = 100
coefficients = { angle_deg = [0, 90, 180], x = [0.9, 0, -0.9], y = [0, 0.8, 0], yaw = [0, 0.1, 0] }
[wind.speed_m_per_s]; kind = "gust"; mean_speed_m_per_s = 12; duration_s = 10; seed = 3
[current]
body = "hull"; speed_m_per_s = 0.5; direction_deg = 0; frontal_area_m2 = 200; lateral_area_m2 = 700
length_m = 100
[current.coefficients]; angle_rad = [0.0, 1.5, 3.0]; x = [0.1, 0, -0.1]; y = [0, 0.6, 0]; yaw = [0, 0.05, 0]
[[line]]; joint = "rope"; rung = "rigid"; restitution = 0.2
[end_stop]
joint = "sleeve"; coordinate = "angle"; minimum_deg = -90; maximum_deg = 90; sticking_speed_rad_per_s = 0.01
[seat]; joint = "deck"
[soft_stop]; joint = "sleeve"; maximum_m = 2; stiffness_N_per_m = 1e4; damping_s_per_m = 0.5
[friction]; joint = "pin"; load_N_m = 4; speed_deg_per_s = 1
[[contact]]
name = "landing"; body = "bob"; points_m = [[0.5, 0, -0.5], [-0.5, 0, -0.5]]; on = "hull"; surface = "box"
place_m = [0, 0, -30]; size_m = [8, 4, 0.5]; stiffness_N_per_m = 1e5; damping_s_per_m = 0.5; friction = 0.3
hold_m = 2e-3
[[contact]]; body = "bob"; points_m = [[0.5, 0, 0.5]]; on = "hull"; surface = "plane"; axis = [0, -1, 0]
place_m = [0, 50, 0]; table = [[0, 0], [0.1, 2e3], [0.3, 2e4]]
[seabed]; body = "box"; points_m = [[0, 0, -0.5]]; depth_m = 80; stiffness_N_per_m = 2e5; friction = 0.4
[range]; joint = "sleeve"; minimum_m = -1; maximum_m = 3
[[point]]; name = "corner"; body = "box"; point_m = [0.1, 0.2, 0.3]
[[point]]; name = "edge"; body = "hull"; point_m = [1, 2, 3]
[clearance]; name = "hull"; points = ["corner"]; body = "hull"; center_m = [1, 0, 2]; size_m = [3, 4, 5]
[relative]; name = "corner over the edge"; point = "corner"; to = "edge"; axes = "hull"
[channel]; name = "drop"; expression = "edge.z - box.z"
[[limit_state]]; channel = "link_tension"; maximum_N = 8e4; minimum_N = 1e3
[[limit_state]]; name = "luffing"; channel = "stroke"; maximum_m = 2.5; names = { cylinder = "aft luff" }
[[limit_state]]; channel = "vessel_motion"; maximum_deg = 90; names = { motion = "roll" }
[lift_factors]
load = "box"; weight_contingency = 1.1; center_of_gravity_m = [0.1, 0, 0]; skew_load = [1.25]
dynamic_factor = 1.3; sling_safety_factor = 3; shackle_safety_factor = 4; shackle_breaking_load_N = 1e5
alpha = 0.7; sources = { alpha = "the project's own" }
[[record]]; joint = "pin"; name = "angle of the arm"
[[record]]; joint = "sleeve"; coordinate = "angle"
[[roles]]; prefix = "aft "; slew = "pin"; cylinders = { luff = "sleeve" }; link = "rope"
tip = { body = "arm", point_m = [0, 0, 1] }
areas = [{ cylinder = "luff", full_m2 = 0.5, rod_side_m2 = 0.25 }]
[notes]; project = "A-17"; tries = [1, 2.5]
""".replace("; ", "\n")
)


def every_table() -> Scene:
    """What `EVERY_TABLE` describes, by calls."""
    scene = Scene(name="every table", gravity=9.81, orientation="euler_xyz", baumgarte=0.5, length_scale=1.1)
    scene.add_body("hull", mass=1e6, inertia=[[2e6, 1e5, 0], [1e5, 3e6, 0], [0, 0, 2.5e6]],
                   center_of_mass=(0.1, -0.2, 0.3), angular_velocity=(0, 0, np.radians(2)))  # fmt: skip
    scene.add_body("arm", mass=12.5, inertia=[1, 2, 3], position=(1, 0, 2), quaternion=(0.5, 0.5, 0.5, 0.5),
                   velocity=(0, 0.1, 0), gravity=False)  # fmt: skip
    for i, name in enumerate(("bob", "box")):
        scene.add_body(name, mass=3, inertia=[1, 1, 1], position=(4, i, 0))
    scene.add_vessel(body="hull", name="water", added_mass=np.eye(6) * 1e5,
                     quadratic_damping=[0, 0, 3, 4, 5, 0], mooring_stiffness=[1e4, 2e4, 3e4],
                     kinematics="paper")  # fmt: skip
    scene.add_joint("pin", kind="revolute", first="hull", second="arm", axis=(0.3, 1, 0.2))
    scene.add_joint("cross", kind="universal", first="hull", second="bob", axis=(1, 0, 0),
                    second_axis=(0, 0, 1))  # fmt: skip
    scene.add_joint("rope", kind="distance", first="bob", second="box", point=(4, 0, 0),
                    second_point=(4, 1, 0.5), length=1.25)  # fmt: skip
    scene.add_joint("sleeve", kind="cylindrical", first="ground", second="box",
                    first_frame=Frame(point=(4, 1, 0)), second_frame=Frame())  # fmt: skip
    scene.add_joint("deck", kind="weld", first="ground", second="hull")
    shake = Curve.harmonic(amplitude=0.01, omega=2.0 * np.pi / 5.0, phase=np.radians(-90))
    scene.add_driver("sleeve", name="shaker", curve=shake)
    turn = spline_curve(times=np.arange(7.0), values=np.radians([0, 0, 1, 4, 9, 10, 10]))
    turn = turn.then(time=6, curve=Curve.constant(value=np.radians(10)))
    scene.add_driver("sleeve", coordinate="angle", curve=turn)
    swing = Curve.harmonic(start_time=9, offset=np.radians(-30), amplitude=np.radians(2),
                           omega=2.0 * np.pi / 4.0)  # fmt: skip
    move = Curve.quintic(start_time=1, end_time=7, start=0, end=np.radians(-30))
    scene.add_actuator(name="motor", joint="pin", stiffness=1e3, damping=200, feed_forward=5.5,
                       reference=move.then(time=9, curve=swing))  # fmt: skip
    scene.add_point_force("push", body="arm", force=(3, 0, 0), point=(0, 0.5, 0), body_axes=True)
    scene.add_spring("soft", first="ground", second="bob", stiffness=100, damping=0.1, natural_length=0.3)
    scene.add_spring("table", first="hull", second="box", lengths=[1, 2.5], forces=[0, 10])
    scene.add_line(name="hoist", bodies=["ground", "box", "bob"], points=[(0, 0, 9), (0, 0, 1), (0, 0, 0)],
                   EA=1e6, length=12, damping_ratio=0.05, mass=300)  # fmt: skip
    scene.add_line(name="whip", bodies=["ground", "ground", "bob"], points=[(-3, 0, 9), (0, 0, 9), (0, 0, 0)],
                   strains=[0, 0.1], tensions=[0, 1000], length=12, radii=[0, 0.3, 0],
                   axes=[(0, 0, 0), (0, 1, 0), (0, 0, 0)], efficiencies=[1, 0.98, 1],
                   slip_speed=0.02)  # fmt: skip
    scene.add_line(name="chain", rung="with mass", bodies=["ground", "box"], points=[(20, 5, 10), (0, 0, 1)],
                   EA=1e8, length=40, mass_per_length=5, segments=3, segment_rung="quasi-static",
                   settling=0.3, diameter=0.02, flow=(1, 0, 0),
                   seabed={"depth": 50, "stiffness": 1e4, "friction": 0.5, "damping_ratio": 0.4,
                           "give": 0.02})  # fmt: skip
    scene.add_line(
        name="wet chain", rung="with mass", bodies=["ground", "box"], points=[(20, 5, -10), (0, 0, 1)],
        EA=1e8, length=Curve.quintic(start_time=1, end_time=9, start=30, end=34), mass_per_length=5,
        segments=2, diameter=0.05, medium="sea", density=1000,
        drag_coefficient_along=0.02, added_mass_coefficient=0.9,
    )  # fmt: skip
    scene.add_line(joint="rope", rung="rigid", restitution=0.2)
    scene.add_winch("hoist", rate=Curve.quintic(start_time=0, end_time=2, start=0, end=0.5), maximum_rate=1,
                    maximum_acceleration=0.5, lag=0.1, minimum_length=2,
                    tension=Curve.quintic(start_time=1, end_time=3, start=2e3, end=4e3), tension_gain=1e-4,
                    dead_band=100, drum_inertia=500, drum_radius=0.5, maximum_tension=3e4, maximum_power=5e4,
                    brake=Curve.quintic(start_time=5, end_time=5.1, start=0, end=1), brake_capacity=4e4,
                    brake_give=2e-3)  # fmt: skip
    scene.add_roles(prefix="quay ", tip=("hull", (6, 0, 20)))
    scene.add_hoist("quay hoist", crane="quay ", load="anode", mass=2e3, size=(1, 1, 2), length=5, falls=2,
                    stiffness=1e6, block_mass=100, slings={"angle_deg": 60, "EA": 1e7, "breaking_load": 6e5},
                    winch={"lag": 0.2, "maximum_rate": 0.5}, breaking_load=4e5, safety_factor=3)  # fmt: skip
    scene.add_gas_spring("phc", first="box", second="bob", area=0.05, force=2e4, stiffness=3e3, length=4,
                         exponent=1.3, damping=100, minimum=1, maximum=7)  # fmt: skip
    scene.add_hydraulic_cylinder("ram", first="box", second="bob", full_area=0.05, rod_side_area=0.03,
                                 retracted_length=0.1, stroke=20, pressure=2e6, pressure_rod=1e6,
                                 pump_pressure=2e7, rated_flow=0.01, pump_check=True,
                                 reference=Curve.quintic(start_time=0, end_time=5, start=3, end=4), gain=2,
                                 rupture_time=9, rupture_area=1e-5)  # fmt: skip
    scene.add_bridle(name="sling", hook="ground", load="box", hook_point=(0, 0, 9), EA=[1e6],
                     points=[(0.5, 0, 0.5), (-0.5, 0, 0.5)])  # fmt: skip
    parts = [SpherePart(diameter=0.4), BoxPart(size=(1, 2, 0.5), strips=(2, 1), point=(0, 0, 0.1), slam=6)]
    scene.add_immersed("bob", parts=parts)
    scene.add_entrapped_water(name="skirt", body="bob", area=1.5, height=0.5, point=(0, 0, -0.15),
                              initial=0.5, openings=[Opening(point=(0, 0.5, -0.1), area=0.02),
                                                     Opening(point=(0.5, 0, 0.3), area=0.01)], air="shut",
                              exponent=1.2, air_pressure=1.1e5)  # fmt: skip
    scene.add_pendulum_damping("swing", first="ground", first_point=(0, 0, 9), second="bob", ratio=0.01)
    scene.add_air_drag(body="bob", frontal_area=2, lateral_area=3, drag_coefficient=0.8)
    scene.add_force_table(name="gust", body="box", times=[0, 1], loads=np.arange(12.0).reshape(2, 6))
    _add_flows(scene)
    scene.add_end_stop(joint="sleeve", coordinate="angle", minimum=np.radians(-90), maximum=np.radians(90),
                       sticking_speed=0.01)  # fmt: skip
    scene.add_seat(joint="deck")
    scene.add_soft_stop(joint="sleeve", maximum=2, stiffness=1e4, damping=0.5)
    scene.add_friction(joint="pin", load=4, speed=np.radians(1))
    scene.add_contact("bob", name="landing", points=[(0.5, 0, -0.5), (-0.5, 0, -0.5)], on="hull",
                      surface="box", place=(0, 0, -30), size=(8, 4, 0.5), stiffness=1e5, damping=0.5,
                      friction=0.3, hold=2e-3)  # fmt: skip
    scene.add_contact("bob", points=[(0.5, 0, 0.5)], on="hull", axis=(0, -1, 0), place=(0, 50, 0),
                      table=[(0, 0), (0.1, 2e3), (0.3, 2e4)])  # fmt: skip
    scene.add_seabed("box", points=[(0, 0, -0.5)], depth=80, stiffness=2e5, friction=0.4)
    scene.add_heave_compensation("ahc", body="hull", point=(1, 2, 3), winch="hoist", ratio=1.5,
                                 high_pass=0.02, lag=0.3, lag_order=2, actuator_frequency=1.5, maximum_rate=2,
                                 maximum_stroke=3)  # fmt: skip
    scene.add_range(joint="sleeve", minimum=-1, maximum=3)
    scene.add_limit_state(channel="link_tension", maximum=8e4, minimum=1e3)
    scene.add_limit_state(name="luffing", channel="stroke", maximum=2.5, names={"cylinder": "aft luff"})
    scene.add_limit_state(channel="vessel_motion", maximum=np.radians(90), names={"motion": "roll"})
    scene.add_lift_factors("box", weight_contingency=1.1, center_of_gravity=(0.1, 0, 0), skew_load=1.25,
                           dynamic_factor=1.3, sling_safety_factor=3, shackle_safety_factor=4,
                           shackle_breaking_load=1e5, alpha=0.7,
                           sources={"alpha": "the project's own"})  # fmt: skip
    scene.record_coordinate(joint="pin", name="angle of the arm")
    scene.add_point(name="corner", body="box", point=(0.1, 0.2, 0.3))
    scene.add_point(name="edge", body="hull", point=(1, 2, 3))
    scene.add_clearance(name="hull", points="corner", body="hull", center=(1, 0, 2), size=(3, 4, 5))
    scene.add_relative(name="corner over the edge", point="corner", to="edge", axes="hull")
    scene.add_channel(name="drop", expression="edge.z - box.z")
    scene.record_coordinate(joint="sleeve", coordinate="angle")
    scene.add_roles(prefix="aft ", slew="pin", cylinders={"luff": "sleeve"}, link="rope",
                    tip=("arm", (0, 0, 1)), areas={"luff": (0.5, 0.25)})  # fmt: skip
    scene.notes.update(project="A-17", tries=[1, 2.5])
    return scene


def _add_flows(scene: Scene) -> None:
    wind = FlowCoefficients(angle=np.radians([0, 90, 180]), x=[0.9, 0, -0.9], y=[0, 0.8, 0], yaw=[0, 0.1, 0])
    scene.add_wind(coefficients=wind, speed=gust_curve(mean_speed=12, duration=10, seed=3), direction_deg=90,
                   frontal_area=400, lateral_area=1200, length=100, body="hull")  # fmt: skip
    current = FlowCoefficients(angle=[0, 1.5, 3.0], x=[0.1, 0, -0.1], y=[0, 0.6, 0], yaw=[0, 0.05, 0])
    scene.add_current(coefficients=current, speed=0.5, direction_deg=0, frontal_area=200, lateral_area=700,
                      length=100, body="hull")  # fmt: skip


ON_DECK = (
    HEAD
    + """
[scene]; name = "on deck"

[[body]]; name = "load"; mass_kg = 20e3; inertia_kg_m2 = [1e4, 1e4, 1e4]; position_m = [0, 0, 1]

[[joint]]; kind = "weld"; name = "on deck"; first = "ground"; second = "load"; point_m = [0, 0, 0]

[seat]; joint = "on deck"

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
