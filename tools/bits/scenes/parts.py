"""Bodies, guides and shaken decks of which scenes are made."""

from __future__ import annotations

from typing import Any

import numpy as np

from seacrane import Curve, FlowCoefficients, Scene
from seacrane.scene import spline_curve

G = 9.80665
UP = (0.0, 0.0, 1.0)
HULL_IN_FLOW = FlowCoefficients(
    angle=np.radians([0, 90, 180]), x=[0.9, 0, -0.9], y=[0, 0.8, 0], yaw=[0, 0.1, 0]
)


def with_load(
    position: Any = (0.0, 0.0, 0.0), *, mass: float = 2e3, gravity: float = G, **more: Any
) -> Scene:
    """A scene with a body "load"."""
    scene = Scene(name="load", gravity=gravity)
    scene.add_body(
        name="load", mass=mass, inertia=mass * np.array([0.3, 0.4, 0.5]), position=position, **more
    )
    return scene


def guided(axis: Any = (1.0, 0.0, 0.0), **more: Any) -> Scene:
    """The same on a rail "rail"."""
    scene = with_load(**more)
    scene.add_joint(kind="prismatic", name="rail", first="ground", second="load", axis=axis)
    scene.add_channel(joint="rail")
    return scene


def thrown(**more: Any) -> Scene:
    """A load that flies and turns."""
    return with_load(velocity=(1.0, 0.5, 2.0), angular_velocity=(0.3, -0.2, 0.5), **more)


def heaving(amplitude: float = 0.5, omega: float = 0.9) -> Scene:
    """A ship on a guide, led up and down from rest."""
    scene = Scene(name="heaving", gravity=G)
    scene.add_body(name="ship", mass=1e6, inertia=(1e7, 1e8, 1e8))
    scene.add_joint(kind="prismatic", name="sea", first="ground", second="ship", axis=UP)
    scene.add_driver(joint="sea", curve=waving(amplitude, omega))
    return scene


def waving(amplitude: float, omega: float) -> Curve:
    """A (sin wt)^3, which begins at rest."""
    time = np.arange(0.0, 12.0, 0.1)
    return spline_curve(times=time, values=amplitude * np.sin(omega * time) ** 3)


def ramp(end: float, *, begin: float = 0.2, last: float = 1.2, start: float = 0.0) -> Curve:
    """From one value to another between two times."""
    return Curve.quintic(start_time=begin, end_time=last, start=start, end=end)
