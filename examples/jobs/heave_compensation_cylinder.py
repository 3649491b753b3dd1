"""Active heave compensation on a crane's knuckle cylinder, with a motion reference 0 to 0.6 s late."""

import numpy as np

from seacrane import Curve, MotionHistory, Scene, simulate
from seacrane.crane import FOOT, KnuckleBoomCrane

HEAVE, OMEGA, HIGH_PASS = 0.5, 2.0 * np.pi / 9.0, 0.03  # m, rad/s, Hz
MASS, ROPE, EA, END = 20e3, 12.0, 4e8, 81.0  # kg, m, N, s
POSE = {"theta": -np.pi / 2, "s1": 1.0, "s2": 1.5}
TIP = FOOT + KnuckleBoomCrane.load().geometry.tip(**POSE)
time = np.arange(0.0, END + 1.0, 0.25)
heave = np.zeros((time.size, 6))
heave[:, 2] = HEAVE * np.sin(OMEGA * time)


def lift(lag: float) -> Scene:
    scene = Scene(name="heave compensation on a cylinder")
    scene.add_given_vessel(MotionHistory(time=time, motion=heave), ramp=9.0)
    jib, head = scene.add_crane(**POSE).tip
    for joint in ("A", "main_cylinder"):
        scene.add_driver(joint=joint, curve=Curve.constant(value=0.0))
    scene.add_actuator(joint="knuckle_cylinder", stiffness=4e7, damping=8e6)
    hook = TIP - [0.0, 0.0, ROPE * (1.0 + MASS * scene.gravity / EA)]
    scene.add_body(name="load", mass=MASS, inertia=(1e4, 1e4, 1e4), position=hook)
    path = {"bodies": [jib, "load"], "points": [head, (0, 0, 0)]}
    scene.add_line(name="hoist", **path, stiffness=EA, length=ROPE)
    settings = {"lag": lag, "high_pass": HIGH_PASS, "actuator": "knuckle_cylinder"}
    scene.add_heave_compensation(name="ahc", body="vessel", point=TIP, **settings)
    return scene


for lag in (0.0, 0.1, 0.2, 0.4, 0.6):
    result = simulate(lift(lag), t_end=END, dt_out=0.1, rtol=1e-4)
    height = result.select("position", body="load", axis="z")[result.time >= 45.0]
    p = 1j * OMEGA
    by_hand = HEAVE * abs(1.0 - p / (p + 2.0 * np.pi * HIGH_PASS) / (1.0 + lag * p))
    print(f"lag {lag:.1f} s: load heaves by {np.std(height) * np.sqrt(2.0):.4f} m, by hand {by_hand:.4f} m")
