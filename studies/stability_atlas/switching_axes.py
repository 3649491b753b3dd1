"""Axes of what switches or nearly does: rebounds, stiff stops, friction, a wire that snatches."""

from __future__ import annotations

import numpy as np

from seacrane import Scene, _core
from seacrane.accuracy.case import Case
from stability_atlas.axis import Axis

MASS = 1e4  # kg


def _slide(height: float, rate: float = 0.0) -> Scene:
    """A load on a vertical guide."""
    scene = Scene(name="load on a guide")
    scene.add_body(
        name="load", mass=MASS, inertia=(1e3, 1e3, 1e3), position=(0.0, 0.0, height), velocity=(0, 0, rate)
    )
    scene.add_joint(kind="prismatic", name="guide", first="ground", second="load", point=(0, 0, height))
    return scene


def _rebound(restitution: float) -> Case:
    """A load that falls by 1 m onto a rigid stop, again and again."""
    scene = _slide(1.0)
    scene.add_stop(joint="guide", minimum=-1.0, restitution=restitution)
    return Case(scene=scene, t_end=10.0, dt_out=0.1)


def _soft_stop(stiffness: float) -> Case:
    """A load that falls by 1 m onto an elastic stop."""
    scene = _slide(1.0)
    scene.add_stop(joint="guide", minimum=-1.0, stiffness=stiffness, damping=0.1)
    return Case(scene=scene, t_end=5.0, dt_out=0.05)


def _friction(speed: float) -> Case:
    """A load dragged to and fro by a spring against Coulomb friction, smooth over this speed."""
    scene = _slide(0.0)
    scene.gravity = 0.0
    scene.add_actuator(
        joint="guide", stiffness=4e4, damping=1e3,
        reference=_core.Curve.harmonic(amplitude=1.0, omega=1.0, phase=-0.5 * np.pi),
    )  # fmt: skip
    scene.add_friction(joint="guide", load=1e4, speed=speed)
    return Case(scene=scene, t_end=10.0, dt_out=0.1)


def _snatch(amplitude: float) -> Case:
    """A load on a wire of 10 m whose upper end heaves at 2 rad/s: beyond 2.5 m it goes slack and snatches."""
    scene = Scene(name="snatching wire")
    scene.add_body(name="support", mass=100.0, inertia=(10.0, 10.0, 10.0))
    scene.add_body(name="load", mass=MASS, inertia=(1e3, 1e3, 1e3), position=(0.3, 0.0, -9.99549899))
    scene.add_joint(kind="prismatic", name="guide", first="ground", second="support", point=(0, 0, 0))
    scene.add_joint(
        kind="distance", name="wire", first="support", second="load", point=(0, 0, 0),
        second_point=(0.3, 0.0, -9.99549899),
    )  # fmt: skip
    scene.add_driver(
        joint="guide", curve=_core.Curve.harmonic(amplitude=amplitude, omega=2.0, phase=-0.5 * np.pi)
    )
    scene.add_line(joint="wire", rung="rigid")
    return Case(scene=scene, t_end=10.0, dt_out=0.1)


AXES = (
    Axis(name="rebound", title="A load that falls onto a rigid stop", label="restitution [-]",
         values=(0.0, 0.3, 0.9, 0.99, 1.0), quick=(0.0, 0.9), case=_rebound),
    Axis(name="soft-stop", title="A load of 10 t that falls by 1 m onto an elastic stop",
         label="stiffness [N/m]", values=(1e5, 1e7, 1e9, 1e11, 1e13), quick=(1e5, 1e9), case=_soft_stop),
    Axis(name="friction", title="A load of 10 t dragged against friction of 10 kN",
         label="speed over which friction is smooth [m/s]", values=(1.0, 1e-2, 1e-3, 1e-5, 1e-7),
         quick=(1e-2, 1e-5), case=_friction),
    Axis(name="snatch", title="A wire that goes slack and snatches", label="amplitude of heave [m]",
         values=(0.1, 2.0, 3.0, 5.0, 10.0), quick=(2.0, 5.0), case=_snatch),
)  # fmt: skip
