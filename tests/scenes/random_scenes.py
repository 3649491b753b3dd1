"""Random trees, loops and cylinder struts, in which joints of every kind close exactly as described."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import joint_examples
import numpy as np

from seacrane import Curve, Model, Scene
from seacrane.analysis import Evaluator
from seacrane.arrays import Array
from seacrane.hydro import StateSpaceBlock
from seacrane.inputs.frames import rotation_matrix

# All kinds, those first that hold something and let something go.
KINDS = sorted(joint_examples.KINDS, key=lambda kind: joint_examples.KINDS[kind].rows in (0, 6))
CLOSING = ["distance", "spherical", "universal", "cylindrical", "planar"]


@dataclass(frozen=True, kw_only=True)
class Shape:
    """What is drawn: how bodies hang together. Points, axes and masses follow from `seed`."""

    seed: int
    parents: tuple[int, ...]  # -1: the base
    kinds: tuple[str, ...]
    swapped: tuple[bool, ...]
    closing: tuple[str, ...] = ()
    decades: float = 6.0  # the masses are spread over
    base: str = "ground"  # or floating, vessel
    driven: bool = False
    struts: int = 0  # of the hinges that get one


def unit(rng: np.random.Generator) -> Array:
    vector = rng.normal(size=3)
    return np.asarray(vector / np.linalg.norm(vector))


def across(axis: Array, rng: np.random.Generator) -> Array:
    return np.cross(axis, unit(rng))


class Builder:
    """A scene from a shape."""

    def __init__(self, shape: Shape) -> None:
        self.shape = shape
        self.rng = np.random.default_rng(shape.seed)
        self.scene = Scene(name="random", gravity=9.81)
        self.base = "ground" if shape.base == "ground" else "base"
        if self.base == "base":
            self.add_body("base", np.zeros(3), mass=100.0)
        if shape.base == "vessel":
            self.add_vessel()
        for i, (parent, kind) in enumerate(zip(shape.parents, shape.kinds, strict=True)):
            holder = self.base if parent < 0 else f"body {parent}"
            at = self.place(holder) + self.rng.uniform(-1.0, 1.0, 3)
            self.add_body(f"body {i}", at)
            self.join(f"joint {i}", kind, holder, f"body {i}", shape.swapped[i])
        for i, kind in enumerate(shape.closing):
            first, second = self.rng.choice([self.base, *self.names()], 2, replace=False)
            self.join(f"closing {i}", kind, str(first), str(second), False)
        self.add_struts()
        self.add_loads()

    def names(self) -> list[str]:
        return [f"body {i}" for i in range(len(self.shape.parents))]

    def place(self, body: str) -> Array:
        return np.zeros(3) if body == "ground" else np.array(self.scene.bodies[body].position)

    def add_body(self, name: str, position: Array, *, mass: float | None = None) -> None:
        half = 0.5 * self.shape.decades
        mass = float(10.0 ** self.rng.uniform(-half, half)) if mass is None else mass
        a, b, c = self.rng.uniform(0.05, 0.3, 3)  # of three pairs of points: such a body exists
        quaternion = self.rng.normal(size=4)
        self.scene.add_body(name, mass=mass, inertia=mass * np.diag([b + c, a + c, a + b]), position=position,
                            quaternion=quaternion / np.linalg.norm(quaternion),
                            center_of_mass=self.rng.uniform(-0.2, 0.2, 3))  # fmt: skip

    def add_vessel(self) -> None:
        root = self.rng.normal(size=(6, 6))
        memory = StateSpaceBlock(inputs=[2], outputs=[2], a=[[0.0, 1.0], [-4.0, -1.5]], b=[[1.0], [0.5]],
                                 c=[[30.0, 60.0]], d=[[0.0]])  # fmt: skip
        self.scene.add_vessel(
            body="base", added_mass=20.0 * root @ root.T, linear_damping=5.0 * np.eye(6),
            quadratic_damping=np.full(6, 2.0), restoring=np.diag([0.0, 0.0, 900.0, 700.0, 700.0, 0.0]),
            mooring_stiffness=np.full(3, 10.0), mooring_damping=np.full(3, 10.0), memory=[memory],
        )  # fmt: skip

    def join(self, name: str, kind: str, first: str, second: str, swapped: bool) -> None:
        if swapped:
            first, second = second, first
        axis = unit(self.rng)
        about, other = joint_examples.KINDS[kind], dict[str, Any](joint_examples.own_numbers(kind))
        if about.own_axis:
            other["second_axis"] = across(axis, self.rng)
        point = 0.5 * (self.place(first) + self.place(second)) + self.rng.uniform(-0.5, 0.5, 3)
        if about.own_point:
            other["second_point"] = point + self.rng.uniform(0.3, 1.0) * unit(self.rng)
        if about.rows == 0:
            axis = np.array([0.0, 0.0, 1.0])
        self.scene.add_joint(name, kind=kind, first=first, second=second, point=point, axis=axis, **other)

    def add_struts(self) -> None:
        """Cylinders across the first hinges, the universal joint at either end, joints in either order; every
        other one close to its dead centre, where its line meets the hinge."""
        rng, left = self.rng, self.shape.struts
        for joint in [j for j in self.scene.joints.values() if j.kind == "revolute"]:
            if left == 0:
                return
            left -= 1
            tag, (base, arm) = joint.name, map(str, rng.permutation([joint.first, joint.second]))
            hinge, axes = self.frame(joint)
            axis = axes[:, 2]
            radial = np.cross(axis, unit(rng))
            radial /= np.linalg.norm(radial)
            lower = hinge - rng.uniform(0.5, 1.0) * radial + rng.uniform(-0.2, 0.2) * axis
            turned = 10.0 ** rng.uniform(-3, -1) if left % 2 else rng.uniform(0.5, 2.0)
            direction = np.cos(turned) * radial + np.sin(turned) * np.cross(axis, radial)
            upper = hinge + rng.uniform(0.6, 1.2) * direction + rng.uniform(-0.2, 0.2) * axis
            line = (upper - lower) / np.linalg.norm(upper - lower)
            barrel, rod = f"{tag} barrel", f"{tag} rod"
            self.add_body(barrel, lower + 0.3 * (upper - lower) + rng.uniform(-0.1, 0.1, 3))
            self.add_body(rod, lower + 0.7 * (upper - lower) + rng.uniform(-0.1, 0.1, 3))
            slide = line + 0.1 * rng.normal(size=3)
            self.pair(f"{tag} slide", "prismatic", barrel, rod, 0.5 * (lower + upper), axis=slide)
            ends = [(base, barrel, lower), (arm, rod, upper)]
            held, free = ends if rng.integers(2) else ends[::-1]
            fixed = across(line, rng) + 0.1 * line
            second = np.cross(fixed, unit(rng) + line)
            self.pair(f"{tag} cross", "universal", *held, axis=fixed, second_axis=second)
            self.pair(f"{tag} ball", "spherical", *free)

    def pair(self, name: str, kind: str, first: str, second: str, point: Array, **axes: Any) -> None:
        if self.rng.integers(2):
            first, second = second, first
            if "second_axis" in axes:
                axes["axis"], axes["second_axis"] = axes["second_axis"], axes["axis"]
        self.scene.add_joint(name, kind=kind, first=first, second=second, point=point, **axes)

    def frame(self, joint: Any) -> tuple[Array, Array]:
        """Joint point and axes in the inertial frame."""
        if joint.first == "ground":
            return np.array(joint.first_frame.point), np.array(joint.first_frame.axes)
        body = self.scene.bodies[joint.first]
        rotation = rotation_matrix(np.array(body.quaternion))
        point = np.array(body.position) + rotation @ np.array(joint.first_frame.point)
        return point, rotation @ np.array(joint.first_frame.axes)

    def add_loads(self) -> None:
        rng, scene = self.rng, self.scene
        names = [self.base, *self.names()]
        for i in range(2):
            first, second = rng.choice(names, 2, replace=False)
            scene.add_spring(f"spring {i}", first=str(first), second=str(second),
                             first_point=rng.uniform(-1, 1, 3), second_point=rng.uniform(-1, 1, 3),
                             stiffness=rng.uniform(1, 50), damping=rng.uniform(0, 2),
                             natural_length=0.4)  # fmt: skip
        movable = [j for j in scene.joints.values() if j.kind in ("revolute", "prismatic", "cylindrical")]
        for k, joint in enumerate(j for j in movable if not j.name.endswith("slide")):
            if k % 2 and self.shape.driven and not self.shape.closing:
                curve = Curve.harmonic(offset=-0.2 * np.cos(0.7), amplitude=0.2, omega=1.5, phase=0.7)
                scene.add_driver(joint=joint.name, curve=curve)
            else:
                scene.add_actuator(joint=joint.name, stiffness=rng.uniform(0, 20), damping=rng.uniform(0, 2),
                                   feed_forward=rng.normal(), reference=0.1 * rng.normal())  # fmt: skip


def build(shape: Shape) -> Scene:
    return Builder(shape).scene


def moving(model: Model, seed: int, speed: float = 1.0) -> Array:
    """The start with random velocities, on the constraints: drivers start at zero, with a rate."""
    state = np.array(model.initial_state)
    rng = np.random.default_rng(seed)
    for body in range(len(model.bodies)):
        at = model.twist_index(body)
        state[at : at + 6] += speed * rng.normal(size=6)
    return np.array(Evaluator(model).project(0.0, state))
