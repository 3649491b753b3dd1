"""Two cranes hoist one load, one on a quay and one on a ship that heaves: who carries what, when."""

import numpy as np

from seacrane import MotionHistory, Scene, simulate

MASS, LENGTH, CENTRE, EA = 40e3, 26.0, np.array([33.0, 42.0, 12.0]), 2e8  # kg, m, m of its centre, N
HEAVE, OMEGA, OUT = 0.3, 2.0 * np.pi / 10.0, np.pi / 2  # m, rad/s, rad
CRANES = {"ship": ("vessel", (33.0, 10.0, 10.0), -OUT), "quay": ("ground", (33.0, 78.0, 8.0), OUT)}

scene, time = Scene(name="two cranes"), np.arange(0.0, 200.0, 0.5)
motion = np.zeros((time.size, 6))
motion[:, 2] = HEAVE * np.sin(OMEGA * time)
scene.add_vessel(motion=MotionHistory(time=time, motion=motion))
turning = MASS * LENGTH**2 / 12.0
scene.add_body(name="load", mass=MASS, inertia=(turning, 1e5, turning), position=CENTRE)
lugs = {}
for name, (base, foot, slew) in CRANES.items():
    crane = scene.add_crane(base=base, foot=foot, slew=slew, s1=2.0, s2=1.0, held=True, prefix=f"{name} ")
    body, point = crane.tip
    above = scene.place_of(f"{name} tip") - CENTRE
    lugs[name] = above[1]
    points = [point, (0.0, above[1], 0.0)]
    scene.add_line(name=name, bodies=[body, "load"], points=points, EA=EA, length=above[2] - 0.02)
    scene.add_winch(line=name, rate=-0.05, lag=0.5)
result = simulate(scene, t_end=180.0)

part, span = result.time > 60.0, lugs["quay"] - lugs["ship"]
rise, turn = HEAVE * OMEGA**2 * lugs["quay"] / span, HEAVE * OMEGA**2 / span  # m/s2, rad/s2 of the load
by_lever = {"ship": lugs["quay"] / span, "quay": -lugs["ship"] / span}
for name, share in by_lever.items():
    hook = result.select("line_tension", line=name)[part] / 1e3
    side = 1.0 if name == "ship" else -1.0
    swing = abs(MASS * share * rise + side * turning * turn / span) / 1e3
    print(f"{name} hook {hook.mean():.2f} kN, by hand {MASS * scene.gravity * share / 1e3:.2f} kN")
    print(f"     varies by {0.5 * np.ptp(hook):.2f} kN, by hand {swing:.2f} kN")
