"""Scenes with limits that several test files share, and SciPy's answer for one of them."""

from __future__ import annotations

from typing import Any

import numpy as np
from named import on_joint
from scipy.integrate import solve_ivp

from seacrane import Curve, Scene
from seacrane.arrays import Array

GRAVITY = 9.80665
HEIGHT, MASS, INERTIA = 2.0, 3.0, (0.1, 0.2, 0.3)
LENGTH, FIRST_SPEED = 2.0, 8.0  # of the pendulum: enough to leave the circle, too little to go round


def ball(*, restitution: float = 0.5, height: float = HEIGHT, sticking_speed: float = 1e-3) -> Scene:
    scene = Scene(name="ball")
    scene.add_body("ball", mass=MASS, inertia=INERTIA, position=(0.0, 0.0, height))
    scene.add_joint("air", kind="free", first="ground", second="ball", point=(0.0, 0.0, height))
    scene.add_stop(joint="air", coordinate="z", minimum=-height, restitution=restitution,
                       sticking_speed=sticking_speed, name="floor")  # fmt: skip
    return scene


def pendulum(restitution: float = 0.0, **wire: Any) -> Scene:
    """A ball below its hook, thrown sideways so fast that the wire goes slack before the top."""
    scene = Scene(name="pendulum")
    scene.add_body("ball", mass=MASS, inertia=INERTIA, position=(0.0, 0.0, -LENGTH),
                   velocity=(FIRST_SPEED, 0.0, 0.0))  # fmt: skip
    scene.add_joint("wire", kind="distance", first="ground", second="ball", point=(0, 0, 0),
                    second_point=(0.0, 0.0, -LENGTH))  # fmt: skip
    scene.add_line(joint="wire", rung="rigid", restitution=restitution, **wire)
    return scene


def scipy_pendulum(times: Array, restitution: float) -> tuple[Array, list[float]]:
    """Positions (n, 2) of the same ball by SciPy, in polar and Cartesian coordinates by turns, and events."""

    def tension(_: float, y: Array) -> Any:
        return y[1] ** 2 * LENGTH + GRAVITY * np.cos(y[0])

    def reach(_: float, y: Array) -> Any:
        return y[0] ** 2 + y[1] ** 2 - LENGTH**2

    tension.terminal, tension.direction = True, -1.0
    reach.terminal, reach.direction = True, 1.0
    settings: dict[str, Any] = {"rtol": 1e-12, "atol": 1e-12, "dense_output": True, "method": "DOP853"}
    out, events = np.full((times.size, 2), np.nan), []
    t, end, taut = 0.0, float(times[-1]), True
    y = np.array([0.0, FIRST_SPEED / LENGTH])
    while t < end:
        if taut:
            run = solve_ivp(lambda _, y: [y[1], -GRAVITY / LENGTH * np.sin(y[0])], (t, end), y,
                            events=tension, **settings)  # fmt: skip
        else:
            run = solve_ivp(lambda _, y: [y[2], y[3], 0.0, -GRAVITY], (t, end), y, events=reach, **settings)
        here = (times >= t) & (times <= run.t[-1])
        states = run.sol(times[here])
        out[here] = (
            np.column_stack([LENGTH * np.sin(states[0]), -LENGTH * np.cos(states[0])])
            if taut
            else states[:2].T
        )
        t, y = float(run.t[-1]), run.y[:, -1]
        if run.status != 1:
            break
        events.append(t)
        if taut:
            along = np.array([np.cos(y[0]), np.sin(y[0])])
            y = np.concatenate([LENGTH * np.array([np.sin(y[0]), -np.cos(y[0])]), LENGTH * y[1] * along])
            # a hair inside, so that the crossing is not found again at once
            y[:2] *= 1.0 - 1e-14
            taut = False
        else:
            outwards = y[:2] / LENGTH
            y[2:] -= (1.0 + restitution) * (y[2:] @ outwards) * outwards
            if restitution == 0.0:
                angle = np.arctan2(y[0], -y[1])
                y = np.array([angle, (y[2] * np.cos(angle) + y[3] * np.sin(angle)) / LENGTH])
                taut = True
            else:
                y[:2] *= 1.0 - 1e-14
    return out, events


def pushed(restitution: float = 0.0) -> Scene:
    """A slide pushed against its stop by a load that turns round: F = -F0 cos(w t)."""
    scene = on_joint("slide", mass=MASS, gravity=0.0)
    scene.add_actuator("rail", name="ram", feed_forward=Curve.harmonic(amplitude=-30.0, omega=2.0))
    scene.add_stop(joint="rail", minimum=-0.5, maximum=4.0, restitution=restitution)
    return scene


def lift(rate: float = 0.2, stiffness: float = 2.0e3) -> Scene:
    """A load on the deck, a hook that is hauled up, a spring between them that is just slack at the start."""
    scene = Scene(name="lift")
    scene.add_body("load", mass=MASS, inertia=INERTIA)
    scene.add_body("hook", mass=1.0, inertia=INERTIA, position=(0, 0, 5), velocity=(0.0, 0.0, rate))
    scene.add_joint("deck", kind="weld", first="ground", second="load")
    scene.add_joint("hoist", kind="prismatic", first="ground", second="hook")
    rise = Curve.pieces(starts=[-1.0], coefficients=[[-rate, rate, 0, 0, 0, 0]])
    scene.add_driver("hoist", curve=rise)
    scene.add_spring("wire", first="hook", second="load", stiffness=stiffness, natural_length=5.0)
    scene.add_stop(joint="deck")
    return scene
