"""A tugger that holds 10 kN calms a swinging payload: it gives and takes rope as a damper does.

By hand: its pull T leans the payload by L T / (m g). Of a rate v of the payload the winch pays out v, which takes
v / gain of tension: a damper of 1 / gain, and a damping ratio of 1 / (2 m omega gain), with omega^2 = g / L.
"""

import numpy as np

from seacrane import Scene, simulate

G, MASS, LENGTH, PULL, GAIN = 9.80665, 20e3, 20.0, 10e3, 7e-4  # m/s2, kg, m, N, m/s for each N

scene = Scene(name="tugger")
scene.add_body(name="payload", mass=MASS, inertia=(4e4, 4e4, 4e4), position=(0, 0, -LENGTH))
scene.add_line(
    name="hoist", bodies=["ground", "payload"], points=[(0, 0, 0), (0, 0, 0)], stiffness=2e8,
    length=LENGTH / (1.0 + MASS * G / 2e8),
)  # fmt: skip
scene.add_line(
    name="tugger", bodies=["ground", "payload"], points=[(40, 0, -LENGTH), (0, 0, 0)], stiffness=5e6,
    length=40.0 / (1.0 + PULL / 5e6),
)  # fmt: skip
scene.add_winch(line="tugger", tension=PULL, tension_gain=GAIN, maximum_rate=1.5)
result = simulate(scene, t_end=100.0, dt_out=0.01)

x, pull = result["position"][:, 0, 0], result["line_tension"].sel(line="tugger") / 1e3
lean, omega = LENGTH * PULL / (MASS * G), np.sqrt(G / LENGTH)
swing = x - x[-1]
tops = np.flatnonzero((swing[1:-1] > swing[:-2]) & (swing[1:-1] >= swing[2:]) & (swing[1:-1] > 0.02)) + 1
decrement = np.log(swing[tops[0]] / swing[tops[-1]]) / (2.0 * np.pi * (tops.size - 1))
period = np.diff(result.time[tops]).mean()
fastest = np.abs(np.diff(x)).max() / 0.01
print("                        by hand   computed")
print(f"lean, m                 {lean:7.3f}   {x[-1]:8.3f}")
print(f"swing period, s         {2 * np.pi / omega:7.3f}   {period:8.3f}")
print(f"damping ratio           {1 / (2 * MASS * omega * GAIN):7.4f}   {decrement:8.4f}")
print(f"largest pull, kN        {PULL / 1e3 + fastest / GAIN / 1e3:7.2f}   {float(pull.max()):8.2f}")
