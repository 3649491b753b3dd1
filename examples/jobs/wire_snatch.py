"""Peaks in a wire of 50 m with 20 t on it: a snatch out of slack, and a winch that hauls in at once."""

import numpy as np

from seacrane import Scene, simulate

MASS, LENGTH, SPEED = 20e3, 50.0, 1.0  # kg, m, m/s


def peak(stiffness: float, *, snatch: bool) -> float:
    """First peak of the tension, kN: the load falls into its wire, or the winch takes it up, at SPEED."""
    scene = Scene(name="peak")
    hangs = 0.0 if snatch else MASS * scene.gravity / stiffness * LENGTH
    velocity = (0.0, 0.0, -SPEED if snatch else 0.0)
    scene.add_body(
        name="load", mass=MASS, inertia=(1e4, 1e4, 1e4), position=(0, 0, -LENGTH - hangs), velocity=velocity
    )
    path = {"bodies": ["ground", "load"], "points": np.zeros((2, 3)), "damping_ratio": 0.0}
    scene.add_line(name="wire", **path, EA=stiffness, length=LENGTH)
    if not snatch:
        scene.add_winch(line="wire", rate=-SPEED)
    half = np.pi * np.sqrt(MASS * LENGTH / stiffness)  # s, of the period of the load on its wire
    return float(simulate(scene, t_end=1.2 * half, dt_out=half / 200)["line_tension"].max()) / 1e3


for stiffness in (3e7, 1e8, 1e9):
    weight, hit = MASS * 9.80665 / 1e3, SPEED * np.sqrt(stiffness / LENGTH * MASS) / 1e3
    for name, run, by_hand in (
        ("snatch", peak(stiffness, snatch=True), weight + np.hypot(weight, hit)),
        ("winch", peak(stiffness, snatch=False), weight + hit),
    ):
        print(f"EA {stiffness:.0e} N, {name:6} at {SPEED:g} m/s: {run:7.1f} kN, by hand {by_hand:7.1f} kN")
