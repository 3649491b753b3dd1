"""Axes of contact: how stiff it is, how fast it is met, and by what."""

from __future__ import annotations

from seacrane import Scene
from seacrane.accuracy.case import Case
from stability_atlas.axis import Axis

MASS, STIFFNESS, HEIGHT = 1e4, 1e7, 0.2  # kg, N/m of each foot, m


def _dropped(
    *, mass: float = MASS, stiffness: float = STIFFNESS, speed: float = 0.0, friction: float = 0.3
) -> Case:
    """A load with four feet that falls on the ground, and moves along it."""
    scene = Scene(name="dropped")
    scene.add_body(
        name="load", mass=mass, size=(2.0, 2.0, 1.0), position=(0.0, 0.0, 0.5 + HEIGHT),
        velocity=(0.5, 0.0, -speed),
    )  # fmt: skip
    feet = [(x, y, -0.5) for x in (-1.0, 1.0) for y in (-1.0, 1.0)]
    scene.add_contact("load", points=feet, on="ground", stiffness=stiffness, friction=friction)
    return Case(scene=scene, t_end=1.5, dt_out=0.05)


AXES = (
    Axis(name="contact-stiffness", title="A load dropped on feet, their stiffness", label="stiffness [N/m]",
         values=(1e4, 1e5, 1e6, 1e7, 1e8, 1e10, 1e12), quick=(1e5, 1e8, 1e12),
         case=lambda value: _dropped(stiffness=value)),
    Axis(name="contact-speed", title="A load thrown on its feet", label="speed [m/s]",
         values=(0.0, 0.1, 1.0, 3.0, 10.0, 30.0), quick=(0.0, 3.0, 30.0),
         case=lambda value: _dropped(speed=value)),
    Axis(name="contact-mass", title="A load dropped on feet, its mass", label="mass [kg]",
         values=(1e-3, 1.0, 1e2, 1e4, 1e6), quick=(1e-3, 1e4, 1e6),
         case=lambda value: _dropped(mass=value, stiffness=STIFFNESS * value / MASS)),
    Axis(name="contact-friction", title="A load dropped on feet, their friction", label="coefficient",
         values=(0.0, 1e-3, 0.1, 1.0, 10.0), quick=(0.0, 1.0), case=lambda value: _dropped(friction=value)),
)  # fmt: skip
