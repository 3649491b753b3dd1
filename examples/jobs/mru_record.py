"""20 t under a crane on a ship that moves as its motion unit recorded: CSV in degrees, 10 Hz, noise."""

from io import StringIO

import numpy as np
from scipy.integrate import solve_ivp
from scipy.interpolate import make_interp_spline
from scipy.signal import butter, filtfilt
from scipy.spatial.transform import Rotation

from seacrane import MotionHistory, Scene, simulate

MASS, ROPE, STIFF, END, NOISE = 20e3, 12.0, 4e6, 120.0, np.random.default_rng(1)  # kg, m, N/m, s

# A record as it comes: time, s; heave, m; roll and pitch, deg. Yours: np.loadtxt("record.csv", ...).
t = np.arange(0.0, END + 5.0, 0.1)
grow = np.sin(np.pi / 2 * np.minimum(t / 20.0, 1.0)) ** 2
waves = [
    grow * size * np.sin(2 * np.pi * t / period) for size, period in ((0.6, 8.1), (1.0, 12.5), (0.4, 9.5))
]
told = np.column_stack([t, *(wave + 0.01 * NOISE.normal(size=t.size) for wave in waves)])
text = StringIO("\n".join(",".join(f"{value:.4f}" for value in row) for row in told))

record = np.loadtxt(text, delimiter=",")
heave, roll, pitch = filtfilt(*butter(4, 0.5, fs=10.0), record[:, 1:], axis=0).T  # noise above 0.5 Hz
zero = np.zeros(t.size)
motion = np.column_stack([zero, zero, heave, np.radians(roll), np.radians(pitch), zero])
scene = Scene(name="record")
scene.add_vessel(motion=MotionHistory(time=record[:, 0], motion=motion), ramp=0.0)
scene.add_crane(slew=-np.pi / 2, s1=1.0, s2=2.0)
scene.add_hoist(mass=MASS, size=(1.6, 1.6, 1.2), length=ROPE, stiffness=STIFF, damping=False)
at = scene.place_of("tip")
result = simulate(scene, t_end=END, dt_out=0.1)

# By hand: the tip's path by rotations and a spline, and a mass on a spring below it.
turned = Rotation.from_euler("xy", np.radians([roll, pitch]).T).apply(at)
path = make_interp_spline(record[:, 0], turned + np.outer(heave, [0, 0, 1]), k=5)
down, loose = ROPE + 0.6, MASS * scene.gravity / STIFF


def pull(time, state):
    """Of the wire on the load, N, with its 2 % of damping."""
    up = path(time) - state[:3]
    long = np.linalg.norm(up)
    rate = (path(time, 1) - state[3:]) @ up / long
    return (STIFF * (long - down + loose) + 0.04 * np.sqrt(STIFF * MASS) * rate) * up / long


def rates(time, state):
    return np.hstack([state[3:], pull(time, state) / MASS - [0, 0, scene.gravity]])


swing = solve_ivp(rates, (0, END), [*(np.asarray(at) - [0, 0, down]), 0, 0, 0], rtol=1e-6, t_eval=result.time)
hand = [np.linalg.norm(pull(time, state)) / 1e3 for time, state in zip(swing.t, swing.y.T, strict=True)]
run = result.select("hook_load", suspension="hoist") / 1e3
for name, of in (("largest", np.max), ("least", np.min), ("standard deviation of the", np.std)):
    print(f"{name} hook load {of(run):.2f} kN, by hand {of(hand):.2f} kN")
