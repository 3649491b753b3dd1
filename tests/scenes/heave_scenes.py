"""Ships that heave by a harmonic, loads behind heave compensation, and the closed forms of what is left."""

from __future__ import annotations

from typing import Any

import numpy as np

from seacrane import Curve, Scene
from seacrane.arrays import Array
from seacrane.scene import Drive

G = 9.80665
TIP, ROPE = 20.0, 15.0  # m
MASS, STIFFNESS = 2e3, 5e7  # kg, N
NO_DRIVE = Drive()


def heaving(*, amplitude: float = 1.0, omega: float = 0.7) -> Scene:
    """A ship on a vertical guide that heaves by amplitude sin(omega t)."""
    scene = Scene(name="heaving")
    scene.add_body(name="ship", mass=1e6, inertia=(1e7, 1e8, 1e8))
    scene.add_joint(
        kind="prismatic", name="sea", first="ground", second="ship", point=(0, 0, 0), axis=(0, 0, 1)
    )
    wave = Curve.harmonic(start_time=0.0, amplitude=amplitude, omega=omega, phase=-0.5 * np.pi)
    scene.add_driver(joint="sea", name="wave", curve=wave)
    return scene


def hung(falls: int = 1, lag: float = 0.0, rung: str = "elastic", **heave: Any) -> Scene:
    """A load below the ship's tip on a winch."""
    scene = heaving(**heave)
    depth = TIP - ROPE - MASS * G * ROPE / STIFFNESS / falls
    scene.add_body(name="load", mass=MASS, inertia=(500.0, 500.0, 500.0), position=(0.0, 0.0, depth))
    scene.add_line(name="hoist", bodies=(["ship", "load"] * falls)[: falls + 1],
                   points=([(0, 0, TIP), (0, 0, 0)] * falls)[: falls + 1], EA=STIFFNESS, length=falls * ROPE,
                   damping_ratio=0.05, rung=rung)  # fmt: skip
    scene.add_winch(line="hoist", lag=lag)
    return scene


def compensated(**settings: Any) -> Scene:
    scene = hung()
    scene.add_heave_compensation(
        "ahc", body="ship", point=(0, 0, TIP), winch="hoist", high_pass=0.0, **settings
    )
    return scene


def transfer(
    omega: Any, *, high_pass: float = 0.0, lag: float = 0.0, lag_order: int = 1, gain: float = 1.0,
    drive: Drive = NO_DRIVE, winch_lag: float = 0.0,
) -> Any:  # fmt: skip
    """H(i omega), of the stroke to the motion."""
    p = 1j * np.asarray(omega)
    out = gain / (1.0 + winch_lag * p) * (p / (p + 2.0 * np.pi * high_pass) if high_pass else 1.0)
    out = out / (1.0 + lag * p + ((lag * p) ** 2 / 3.0 if lag_order == 2 else 0.0))
    if drive.frequency:
        w = 2.0 * np.pi * drive.frequency
        out = out * w**2 / (p**2 + 2.0 * drive.damping * w * p + w**2)
    return out


def amplitude_of(time: Array, values: Array, omega: float, since: float) -> complex:
    """Of the harmonic part from a time on: Re amplitude exp(i omega t)."""
    kept = time >= since
    t = time[kept]
    basis = np.stack([np.cos(omega * t), -np.sin(omega * t), np.ones_like(t), t], axis=1)
    found, *_ = np.linalg.lstsq(basis, values[kept], rcond=None)
    return complex(found[0], found[1])


def moving_crane() -> Scene:
    """A boom that a compensator luffs, on a ship that heaves and rolls; another moves the load's winch."""
    scene = Scene(name="crane")
    scene.add_body(name="ship", mass=5e5, inertia=(5e7, 5e7, 5e7), velocity=(0.0, 0.0, 0.3))
    scene.add_joint(kind="free", name="sea", first="ground", second="ship", point=(0, 0, 0))
    for motion, k, held in (("x", 4e5, 0.0), ("y", 4e5, 0.0), ("z", 4e5, 9.80665 * 5.4e5),
                            ("roll", 4e7, 0.0), ("pitch", 4e8, 8e6), ("yaw", 4e7, 0.0)):  # fmt: skip
        scene.add_actuator(joint="sea", coordinate=motion, name=f"sea {motion}", stiffness=k,
                           damping=0.05 * k, feed_forward=held)  # fmt: skip
    scene.add_body(
        name="boom", mass=2e4, inertia=(1e4, 7e5, 7e5), position=(10.0, 0.0, 12.0), velocity=(0.0, 0.0, 0.3)
    )
    scene.add_joint(
        kind="revolute", name="pin", first="ship", second="boom", point=(0, 0, 12.0), axis=(0, 1, 0)
    )
    scene.add_actuator(joint="pin", name="luff", stiffness=4e8, damping=8e7, feed_forward=-6e6)
    scene.add_body(name="load", mass=2e4, inertia=(1e4, 1e4, 1e4), position=(20.0, 0.0, -8.0))
    scene.add_line(name="hoist", bodies=["boom", "load"], points=[(10.0, 0.0, 0.0), (0, 0, 0)], EA=2e8,
                   length=20.0)  # fmt: skip
    scene.add_winch(line="hoist", lag=0.1)
    scene.add_heave_compensation(name="by winch", body="boom", point=(10, 0, 0), winch="hoist", lag=0.2,
                                 high_pass=0.05, gain=0.4, drive=Drive(maximum_rate=0.15))  # fmt: skip
    scene.add_heave_compensation(
        name="by luffing", body="ship", point=(20.0, 0.0, 12.0), actuator="luff", ratio=0.05, gain=0.5,
        lag=0.1, lag_order=2, high_pass=0.05, drive=Drive(frequency=1.0, maximum_stroke=0.2),
    )  # fmt: skip
    return scene
