"""Active heave compensation on a crane's knuckle cylinder, with a motion reference 0 to 0.6 s late."""

import numpy as np

from seacrane import MotionHistory, Scene, simulate
from seacrane.analysis import reflected_inertia
from seacrane.crane import FOOT, load_crane

HEAVE, OMEGA, HIGH_PASS, LOOP = 0.5, 2.0 * np.pi / 9.0, 0.03, 2.0 * np.pi * 2.0  # m, rad/s, Hz, rad/s
MASS, ROPE, EA, END = 20e3, 12.0, 4e8, 81.0  # kg, m, N, s
POSE = {"slew": -np.pi / 2, "s1": 3.0, "s2": 3.8}  # where the knuckle moves the tip up and down
CRANE = load_crane()
TIP = FOOT + CRANE.tip(**POSE)
HOLDING = CRANE.static_cylinder_forces(s1=POSE["s1"], s2=POSE["s2"], payload_mass=MASS)
time = np.arange(0.0, END + 1.0, 0.25)
heave = np.outer(HEAVE * np.sin(OMEGA * time), [0, 0, 1, 0, 0, 0])


def lift(lag: float) -> Scene:
    scene = Scene(name="heave compensation on a cylinder")
    scene.add_vessel(motion=MotionHistory(time=time, motion=heave), ramp=9.0)
    jib, head = scene.add_crane(**POSE).tip
    scene.add_actuator(joint="knuckle_cylinder")
    scene.add_body(name="load", mass=MASS, inertia=(1e4, 1e4, 1e4), position=TIP - [0.0, 0.0, ROPE])
    scene.add_line(name="hoist", bodies=[jib, "load"], points=[head, (0, 0, 0)], EA=EA, length=ROPE)
    felt, (_, held) = reflected_inertia(scene)["knuckle_cylinder"], HOLDING
    gains = {"stiffness": felt * LOOP**2, "damping": 1.6 * felt * LOOP, "feed_forward": held}
    scene.replace("knuckle_cylinder", kind="actuator", **gains)
    settings = {"body": "vessel", "point": TIP, "lag": lag, "high_pass": HIGH_PASS}
    scene.add_heave_compensation(name="ahc", actuator="knuckle_cylinder", **settings)
    return scene


for lag in (0.0, 0.1, 0.2, 0.4, 0.6):
    result = simulate(lift(lag), t_end=END, dt_out=0.1, rtol=1e-4)
    height = result.select("position", body="load", axis="z")[result.time >= 45.0]
    by_hand = HEAVE * abs(1.0 - 1j / (1j + 2.0 * np.pi * HIGH_PASS / OMEGA) / (1.0 + 1j * lag * OMEGA))
    print(f"lag {lag:.1f} s: load heaves by {np.std(height) * np.sqrt(2.0):.4f} m, by hand {by_hand:.4f} m")
