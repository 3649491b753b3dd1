"""Lines with mass, with the numbers of their closed forms."""

from __future__ import annotations

from typing import Any

import numpy as np

from seacrane import Curve, Scene
from seacrane.scene import spline_curve
from seacrane.sea import Current

G = 9.80665
EA, MASS, LENGTH, RATIO = 1e8, 100.0, 900.0, 0.02  # N, kg/m, m: of the line that heaves
HEAVE, PERIOD = 1.0, 12.0  # m, s
CATENARY_H, CATENARY_V = 663_644.668, 728_230.403  # N, at the upper end: Irvine's elastic catenary


def slung(count: int) -> Scene:
    """The catenary of those forces: 800 m across, 300 m up, 900 m of 1000 N/m and EA 1e9 N."""
    scene = Scene(name="slung")
    scene.add_body(name="end", mass=1e3, inertia=(1e3, 1e3, 1e3), position=(800.0, 0.0, 300.0))
    scene.add_joint(kind="weld", name="bolts", first="ground", second="end")
    scene.add_line(name="line", bodies=["ground", "end"], points=np.zeros((2, 3)), EA=1e9,
                   length=900.0, wire={"mass_per_length": 1000.0 / G, "segments": count})  # fmt: skip
    return scene


def weights_of_shape(count: int) -> tuple[float, float]:
    """H and V (N) at the upper end of that line, as described: of its last segment and half its mass."""
    scene = slung(count)
    last = scene.bodies["end"].position - scene.bodies[f"line.{count - 1}"].position
    length, step = float(np.linalg.norm(last)), 900.0 / count
    tension = 1e9 * (length / step - 1.0)
    return tension * last[0] / length, tension * last[2] / length + 0.5 * 1000.0 * step


def heave(t_end: float) -> Curve:
    """Up and down from rest, m."""
    times = np.arange(0.0, t_end + 1.0, 0.02)
    return spline_curve(times=times, values=HEAVE * np.sin(2.0 * np.pi * times / PERIOD) ** 3)


def heaving(count: int, t_end: float) -> Scene:
    """A slack line below an end that moves up and down."""
    scene = Scene(name="heaving")
    scene.add_body(name="end", mass=1e3, inertia=(1e3, 1e3, 1e3), position=(800.0, 0.0, 0.0))
    scene.add_joint(
        kind="prismatic", name="guide", first="ground", second="end", point=(800, 0, 0), axis=(0, 0, 1)
    )
    scene.add_driver(joint="guide", curve=heave(t_end))
    line = {"EA": EA, "length": LENGTH, "damping_ratio": RATIO}
    scene.add_line(name="line", bodies=["ground", "end"], points=[(0, 0, -300), (0, 0, 0)],
                   wire={"mass_per_length": MASS, "segments": count}, **line)  # fmt: skip
    return scene


def hanging(count: int) -> Scene:
    """1 t on a wire of 100 m that hangs at rest, stretched by its own weight and the load's."""
    low = -100.0 - (1e3 + 0.5 * 5e3) * G * 100.0 / 1e6
    scene = Scene(name="hanging")
    scene.add_body(name="load", mass=1e3, inertia=(1e3, 1e3, 1e3), position=(0.0, 0.0, low))
    scene.add_line(name="wire", bodies=["ground", "load"], points=np.zeros((2, 3)),
                   EA=1e6, length=100.0, wire={"mass_per_length": 50.0, "segments": count})  # fmt: skip
    return scene


def string(count: int) -> Scene:
    """A taut string of 50 m without weight."""
    strain = 0.01
    scene = Scene(name="string", gravity=0.0)
    scene.add_body(name="end", mass=1e3, inertia=(1e3, 1e3, 1e3), position=(50.0, 0.0, 0.0))
    scene.add_joint(kind="weld", name="bolts", first="ground", second="end")
    scene.add_line(name="line", bodies=["ground", "end"], points=np.zeros((2, 3)), EA=1e6,
                   length=50.0 / (1.0 + strain), wire={"mass_per_length": 2.0 * (1.0 + strain),
                   "segments": count})  # fmt: skip
    return scene


def in_waves(length: Curve | float, *, seed: int = 3, rung: Any = "elastic") -> Scene:
    """Through the surface in waves and a current, a load on its end."""
    scene = Scene(name="wet", gravity=G)
    scene.add_sea(vessel=None, hs=1.5, tp=5.0, count=20, seed=seed, direction_deg=30.0, gamma=2.0,
                  current=Current(depth=0.0, speed=0.8, direction_deg=20.0))  # fmt: skip
    scene.add_body(name="load", mass=400.0, inertia=(90.0, 80.0, 70.0), position=(8.0, 1.0, -3.0),
                   velocity=(-1.0, 2.0, 1.0), angular_velocity=(0.4, -0.3, 0.6))  # fmt: skip
    scene.add_line("wire", "ground", "load", first_point=(0.0, 0.0, 5.0), second_point=(0.1, -0.2, 0.4),
                   EA=2e5, length=length, wire={"mass_per_length": 40.0, "diameter": 0.25, "medium": "sea",
                   "segments": 4}, rung=rung)  # fmt: skip
    return scene


BED = {"depth": 10.0, "stiffness": 2e4, "friction": 0.5}


def dropped(*, friction: float = 0.5, segments: int = 6, **given: Any) -> Scene:
    """A line that falls askew on a seabed 10 m below, a load at its end that slides there."""
    scene = Scene(name="dropped")
    scene.add_body(name="load", mass=300.0, inertia=(90.0, 80.0, 70.0), position=(14.0, 2.0, -8.5),
                   velocity=(1.0, 2.0, -0.5), angular_velocity=(0.2, -0.1, 0.3))  # fmt: skip
    scene.add_line("line", "ground", "load", first_point=(0.0, 0.0, -4.0), second_point=(0.1, -0.2, 0.1),
                   EA=2e5, length=16.0, damping_ratio=0.1, wire={"mass_per_length": 40.0,
                   "segments": segments, "seabed": BED | {"friction": friction}, **given})  # fmt: skip
    return scene


LAG, FIRST, LAST, OVER = 0.2, 10.5, 14.0, 4.0  # s, m, m, s
PAID = Curve.quintic(start_time=0.0, end_time=OVER, start=FIRST, end=LAST)
KINDS: dict[str, dict[str, Any]] = {
    "by rate": {},
    "holds a tension": {"tension": 4e3, "tension_gain": 1e-4},
    "with a drum": {
        "drum_inertia": 300.0, "drum_radius": 0.5, "maximum_tension": 2e4, "brake_capacity": 1e4,
        "brake": Curve.quintic(start_time=0.5, end_time=1.5, start=0.0, end=0.4),
    },
}  # fmt: skip


def asked(lag: float) -> Curve:
    """The rate that a winch with a lag is asked for to pay out as PAID does: r + lag r'."""
    quintic = np.polynomial.Polynomial(PAID.to_pieces()["coefficients"][0])
    rate = quintic.deriv(1) + lag * quintic.deriv(2)
    whole = np.zeros(6)
    whole[: rate.coef.size] = rate.coef
    return Curve.pieces(starts=[0.0, OVER], coefficients=[whole, np.zeros(6)])


def wet(
    length: Curve | float = FIRST, *, rung: Any = "elastic", compensated: bool = False, **winch: Any
) -> Scene:
    """On a winch, but with a curve for its length."""
    scene = in_waves(length, rung=rung)
    if not isinstance(length, Curve):
        scene.add_winch("wire", **{"rate": asked(LAG), "lag": LAG} | winch)
    if compensated:
        scene.add_heave_compensation("active", body="load", winch="wire", gain=0.3, lag=0.3, high_pass=0.05)
    return scene
