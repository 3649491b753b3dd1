"""Active heave compensation on a winch: what a measured motion 0 to 0.6 s late leaves of the heave."""

import numpy as np

from seacrane import Curve, Scene, simulate
from seacrane.scene import Drive

MASS, ROPE, EA, TIP = 20e3, 20.0, 4e8, 30.0  # kg, m, N, m
HEAVE, OMEGA, HIGH_PASS, RATE = 1.0, 2.0 * np.pi / 9.0, 0.03, 1.0  # m, rad/s, Hz, m/s


def lift(drive: Drive, **signal: float) -> Scene:
    scene = Scene(name="heave compensation on a winch")
    scene.add_body(name="ship", mass=1e6, inertia=(1e7, 1e8, 1e8))
    scene.add_joint(kind="prismatic", name="sea", first="ground", second="ship", axis=(0, 0, 1))
    wave = Curve.harmonic(start_time=0.0, offset=HEAVE, amplitude=HEAVE, omega=OMEGA, phase=np.pi)
    scene.add_driver(joint="sea", curve=wave)
    stretched = ROPE * (1.0 + MASS * scene.gravity / EA)
    scene.add_body(name="load", mass=MASS, inertia=(1e4, 1e4, 1e4), position=(0, 0, TIP - stretched))
    scene.add_line("hoist", "ship", "load", first_point=(0, 0, TIP), EA=EA, length=ROPE)
    scene.add_winch(line="hoist")
    scene.add_heave_compensation("ahc", body="ship", point=(0, 0, TIP), winch="hoist", drive=drive, **signal)
    return scene


for lag in (0.0, 0.1, 0.2, 0.4, 0.6):
    result = simulate(lift(Drive(maximum_rate=RATE), lag=lag, high_pass=HIGH_PASS), t_end=81.0, dt_out=0.1)
    height = result.select("position", body="load", axis="z")[result.time >= 45.0]
    p = 1j * OMEGA
    by_hand = HEAVE * abs(1.0 - p / (p + 2.0 * np.pi * HIGH_PASS) / (1.0 + lag * p))
    print(f"lag {lag:.1f} s: load heaves by {np.std(height) * np.sqrt(2.0):.4f} m, by hand {by_hand:.4f} m")

result = simulate(lift(Drive(maximum_rate=0.5), high_pass=0.0), t_end=81.0, dt_out=0.1)
first = next(event for event in result.events if event.kind == "limit")
by_hand = np.arcsin(0.5 / (HEAVE * OMEGA)) / OMEGA
print(f"winch of 0.5 m/s: {first.name} reached at {first.time:.4f} s, by hand {by_hand:.4f} s")
