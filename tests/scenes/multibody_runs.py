"""Runs of generic scenes and the mechanisms that several test files share."""

from __future__ import annotations

from typing import Any

import numpy as np
from reference.classic import Link
from reference.jets import Jet
from reference.mechanisms import SingleCoordinate, SliderCrank
from reference.rotation import quaternions_from_matrices

from seacrane import Curve, Run, Scene
from seacrane.arrays import Array
from seacrane.crane import Payload
from seacrane.inputs.frames import rotation_matrix

ACTUATORS = {"slew": "A", "main": "main_cylinder", "knuckle": "knuckle_cylinder"}
CRANK = SliderCrank(Link(1.5, 0.08, 0.4, 0.15), (0.0, 0.3, 0.2), 1.2, 1.5, (0.02, 0.25, 0.24), 2.0)
# Stiffness and damping that give the stiffest coordinate of the crane a frequency of about 5 rad/s.
GAINS = {"slew": (2.0e9, 6.0e8), "main": (6.0e7, 2.0e7), "knuckle": (2.5e7, 8.0e6)}


def record(scene: Scene, t_end: float, *, dt_out: float = 0.05, rtol: float = 1e-8,
           **settings: Any) -> dict[str, Any]:  # fmt: skip
    """All channels of a run, opt-in ones too, and `stats`."""
    model = scene.compile()
    run = Run(scene, t_end=t_end, dt_out=dt_out, rtol=rtol, model=model,
              channels=model.channel_names(defaults_only=False), **settings)  # fmt: skip
    run.advance(t_end)
    out: dict[str, Any] = dict(run.core.channels())
    return out | {"stats": run.core.statistics(), "bodies": list(scene.bodies), "joints": list(scene.joints)}


def quaternion_about(axis: Any, angle: float) -> Array:
    unit = np.asarray(axis, dtype=float) / np.linalg.norm(axis)
    return np.append(np.cos(0.5 * angle), np.sin(0.5 * angle) * unit)


def ramp(rate: float, start: float = 0.0) -> Curve:
    """start + rate t."""
    return Curve.pieces(starts=[-1.0], coefficients=[[start - rate, rate, 0.0, 0.0, 0.0, 0.0]])


def add_moving_bodies(scene: Scene, mechanism: SingleCoordinate, names: list[str], q: float,
                      rate: float) -> list[Array]:  # fmt: skip
    """Adds the bodies of a mechanism at (q, rate); returns their rotation matrices."""
    rotations = []
    for name, moving in zip(names, mechanism.kinematics(Jet(q, 1.0)), strict=True):
        _, _, position, slope, spin = moving.terms()
        rotation = np.array([[c.f for c in axis] for axis in moving.axes]).T
        scene.add_body(name, mass=moving.mass, inertia=moving.inertia, position=position,
                       velocity=rate * slope, quaternion=quaternions_from_matrices(rotation),
                       angular_velocity=rate * spin)  # fmt: skip
        rotations.append(rotation)
    return rotations


def slider_crank(crank: SliderCrank, q: float, rate: float, *, gravity: float = 9.81) -> Scene:
    """The spatial slider-crank of the reference, with every joint in its place."""
    scene = Scene(name="slider-crank", gravity=gravity)
    _, rod, _ = add_moving_bodies(scene, crank.mechanism(), ["crank", "rod", "slider"], q, rate)
    middle = scene.bodies["rod"].position
    half = 0.5 * crank.rod_length * rod[:, 0]
    scene.add_joint("shaft", kind="revolute", first="ground", second="crank", point=crank.pivot,
                    axis=(1, 0, 0))  # fmt: skip
    scene.add_joint("pin", kind="spherical", first="crank", second="rod", point=middle - half)
    scene.add_joint("cross", kind="universal", first="slider", second="rod", point=middle + half,
                    axis=(0, 1, 0), second_axis=rod[:, 1])  # fmt: skip
    scene.add_joint("guide", kind="prismatic", first="ground", second="slider", point=middle + half,
                    axis=(1, 0, 0))  # fmt: skip
    return scene


def crane_scene(*, base: str = "ground", payload: bool = True, references: dict[str, Curve] | None = None,
                **pose: float) -> Scene:  # fmt: skip
    """The shipped crane with its three actuators; on the ground, or on a body of this name added before."""
    scene = Scene(name="crane on a fixed base")
    add_crane(scene, base=base, payload=payload, references=references, **pose)
    return scene


def add_crane(scene: Scene, *, base: str, payload: bool, references: dict[str, Curve] | None = None,
              **pose: float) -> None:  # fmt: skip
    scene.add_crane(base=base, payload=Payload() if payload else None, damping=False, **pose)
    for name, joint in ACTUATORS.items():
        stiffness, damping = GAINS[name]
        scene.add_actuator(name=name, joint=joint, stiffness=stiffness, damping=damping,
                           reference=(references or {}).get(name, 0.0))  # fmt: skip


def swing_out(duration: float = 10.0) -> dict[str, Curve]:
    """References that move everything at once."""
    ends = {"slew": -1.0, "main": 1.0, "knuckle": 1.5}
    return {
        name: Curve.quintic(start_time=0.0, end_time=duration, start=0.0, end=end)
        for name, end in ends.items()
    }


def world_inertia(scene: Scene, quaternions: Array) -> Array:
    """R I R^T of all bodies, shape (k, n, 3, 3)."""
    rotation = rotation_matrix(quaternions)
    inertia = np.array([body.inertia for body in scene.bodies.values()])
    return np.asarray(rotation @ inertia @ np.swapaxes(rotation, -1, -2))


def masses(scene: Scene) -> Array:
    return np.array([body.mass for body in scene.bodies.values()])


def momentum(scene: Scene, out: dict[str, Any]) -> tuple[Array, Array]:
    """Linear and angular momentum about the origin, (k, 3)."""
    m = masses(scene)[:, None]
    spin = np.einsum("knij,knj->kni", world_inertia(scene, out["quaternion"]), out["angular_velocity"])
    linear = m * out["velocity"]
    return linear.sum(axis=1), (spin + np.cross(out["position"], linear)).sum(axis=1)


def struck(bob: float = 2.0) -> Scene:
    """A cart that takes up 1.5 m/s at once, with a pendulum on it."""
    scene = Scene(name="struck")
    scene.add_body("cart", mass=3.0, inertia=(1.0, 1.0, 1.0))
    scene.add_joint("rail", kind="prismatic", first="ground", second="cart", axis=(1.0, 0.0, 0.0))
    runs = Curve.table([1.0, 4.0], [0.0, 4.5], between="linear")
    scene.add_driver("rail", curve=Curve.constant(value=0.0).then(time=1.0, curve=runs))
    scene.add_body("bob", mass=bob, inertia=(0.3, 0.3, 0.3), position=(0.2, 0.0, -1.0))
    scene.add_joint("pin", kind="revolute", first="cart", second="bob", point=(0, 0, 0), axis=(0, 1, 0))
    return scene
