"""A tugger that holds 10 kN calms a swinging payload: it gives and takes rope as a damper does.

By hand: its pull T leans the payload by L T / (m g), about which it swings from the vertical. Where it moves
at v the winch takes in or pays out v, for v / gain of tension: a damper of 1 / gain, and a damping ratio z =
1 / (2 m omega gain), omega^2 = g / L. The first swing passes the middle at lean omega exp(-z pi / 2).
"""

import numpy as np

from seacrane import Scene, simulate

G, MASS, LENGTH, PULL, GAIN = 9.80665, 20e3, 20.0, 10e3, 7e-4  # m/s2, kg, m, N, m/s for each N

scene = Scene(name="tugger")
scene.add_body(name="payload", mass=MASS, inertia=(4e4, 4e4, 4e4), position=(0, 0, -LENGTH))
scene.add_line(
    name="hoist", bodies=["ground", "payload"], points=[(0, 0, 0), (0, 0, 0)], EA=2e8,
    length=LENGTH / (1.0 + MASS * G / 2e8),
)  # fmt: skip
scene.add_line(
    name="tugger", bodies=["ground", "payload"], points=[(40, 0, -LENGTH), (0, 0, 0)], EA=5e6,
    length=40.0 / (1.0 + PULL / 5e6),
)  # fmt: skip
scene.add_winch(line="tugger", tension=PULL, tension_gain=GAIN, maximum_rate=1.5)
result = simulate(scene, t_end=300.0, dt_out=0.02)

x, pull = result["position"][:, 0, 0], result["line_tension"][:, 1]
swing, lean, omega = x - x[-1], LENGTH * PULL / (MASS * G), np.sqrt(G / LENGTH)
tops = np.flatnonzero((swing[1:-1] > swing[:-2]) & (swing[1:-1] >= swing[2:]) & (swing[1:-1] > 0.05)) + 1
damping = np.log(swing[tops[0]] / swing[tops[-1]]) / (2.0 * np.pi * (tops.size - 1))
by_hand = 1.0 / (2.0 * MASS * omega * GAIN)
least = PULL - lean * omega * np.exp(-by_hand * np.pi / 2.0) / GAIN
print("                   by hand  computed")
print(f"lean, m            {lean:7.3f}  {x[-1]:8.3f}")
print(f"swing period, s    {2.0 * np.pi / omega:7.3f}  {np.diff(result.time[tops]).mean():8.3f}")
print(f"damping ratio      {by_hand:7.4f}  {damping:8.4f}")
print(f"least pull, kN     {least / 1e3:7.3f}  {pull.min() / 1e3:8.3f}")
