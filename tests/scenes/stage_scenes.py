"""Scenes that stages are tried on, with the numbers of their closed forms."""

from __future__ import annotations

from typing import Any

import numpy as np

from seacrane import Frame, MotionRaos, Move, Scene, Stage, Until

G = 9.80665
MASS, STIFFNESS, HEIGHT = 20e3, 5e7, 20.0  # kg, N, m from the load on deck to the block
RATE = 0.05  # m/s


def on_deck(*, length: float = 20.1, **line: Any) -> Scene:
    """A load that rests on deck below a block, with a slack line on a winch."""
    scene = Scene(name="on deck", gravity=G)
    scene.add_body("load", mass=MASS, inertia=(1e4,) * 3, position=(0, 0, 1))
    scene.add_joint("on deck", kind="weld", first="ground", second="load", point=(0, 0, 0))
    scene.add_stop(joint="on deck")
    scene.add_line(
        name="hoist", bodies=["ground", "load"], points=[(0.0, 0.0, HEIGHT + 1.0), (0.0, 0.0, 0.0)],
        EA=STIFFNESS, length=length, **line,
    )  # fmt: skip
    scene.add_winch("hoist")
    return scene


def lift_off() -> list[Stage]:
    """Hold, lift off, raise, stop, and let go."""
    free, short = Until.release("on deck"), Until.length("hoist", maximum=18.5)
    slowly, fast, still = ({"hoist.rate": rate} for rate in (-RATE, -0.4, 0.0))
    return [Stage(name="hold", duration=1.05), Stage(name="lift off", until=free, maximum_duration=60.0,
                                                     commands=slowly),
            Stage(name="raise", until=short, maximum_duration=60.0, commands=fast),
            Stage(name="stop", duration=2.0, commands=still),
            Stage(name="let go", duration=1.0, release=["hoist"])]  # fmt: skip


def swinging() -> Scene:
    """A load that swings on its winch, always taut."""
    scene = on_deck(damping_ratio=0.1)
    scene.remove("on deck", kind="load")
    scene.remove("on deck", kind="joint")
    scene.replace("load", position=(3.0, 0.0, 21.0 - np.sqrt(20.16**2 - 9.0)), velocity=(0, 0.8, 0))
    return scene


def hoisting() -> list[Stage]:
    """Raise to a length, in mid-air stop, lower again."""
    short = Until.length("hoist", maximum=19.0)
    low = Until.channel("position", body="load", axis="z", maximum=1.9)
    up, still, down = ({"hoist.rate": rate} for rate in (-0.4, 0.0, Move(to=0.5, over=2.0)))
    return [Stage(name="raise", until=short, maximum_duration=9.0, commands=up),
            Stage(name="stop", duration=2.03, commands=still),
            Stage(name="lower", until=low, maximum_duration=9.0, commands=down)]  # fmt: skip


def meeting(kind: str = "weld", *, velocity: float = 0.6, after: float = 0.5) -> Scene:
    """Two bodies in space, spinning, that meet at a joint when so many seconds have passed."""
    scene = Scene(name="meeting", gravity=0.0)
    scene.add_body("hook", mass=2.0, inertia=(0.5, 0.6, 0.7), position=(0, 0, 0), velocity=(0, 0.3, 0))
    scene.add_body("load", mass=5.0, inertia=(1.5, 2.0, 2.5), position=(1.0, 0.3 * after, velocity * after),
                   velocity=(0.0, 0.0, -velocity))  # fmt: skip
    axes = np.eye(3)
    scene.add_joint("shackle", kind=kind, first="hook", second="load",
                    first_frame=Frame(point=(0.4, 0, 0), axes=axes),
                    second_frame=Frame(point=(-0.6, 0, 0), axes=axes))  # fmt: skip
    return scene


def heaving(hs: float, ramp: float = 5.0, duration: float = 60.0) -> Scene:
    """A load that hangs from a ship that heaves with the waves."""
    scene = Scene(name="heaving")
    values = np.zeros((2, 4, 6), dtype=complex)
    values[:, :, 2] = 1.0
    raos = MotionRaos(omega=[0.3, 0.6, 1.5, 4.0], heading=[0.0, np.pi], values=values)
    scene.add_vessel(motion=raos, ramp=ramp, duration=duration)
    scene.add_sea(hs=hs, tp=8.0, direction_deg=0.0, count=40, seed=2)
    scene.add_body("load", mass=MASS, size=(3.0, 3.0, 3.0), position=(20, 0, 10))
    scene.add_line("wire", first="vessel", first_point=(20, 0, 30), second="load", EA=3e7,
                   damping_ratio=0.05, tension_at_start=MASS * scene.gravity)  # fmt: skip
    scene.add_winch("wire", lag=0.2)
    return scene
