"""Axes of mechanisms: tumbling, parametric resonance, dead centres, singular and redundant loops."""

from __future__ import annotations

import numpy as np

from seacrane import Scene, _core
from seacrane.accuracy.case import Case
from seacrane.description.description import STANDARD_GRAVITY
from stability_atlas.axis import Axis

LENGTH = 10.0  # m, of the pendulum whose support heaves
CUBE = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [1, 1, 1], [0, 1, 1], [0, 0, 1]], dtype=float)
HINGES = np.array([[0, 1, 0], [0, 0, 1], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 0, 0]], dtype=float)


def _box(spin: tuple[float, float, float], orientation: str) -> Case:
    """A box of 10 t on a wire that is not fixed at its middle."""
    scene = Scene(name="tumbling box", orientation=orientation)
    scene.add_body(
        name="payload", mass=1e4, inertia=(4.3e4, 3.1e4, 6.0e4), position=(0.0, 0.0, -10.0),
        angular_velocity=spin,
    )  # fmt: skip
    scene.add_joint(
        kind="distance", name="link", first="ground", second="payload", point=(0.0, 0.0, 0.0),
        second_point=(0.3, 0.0, -8.0),
    )  # fmt: skip
    return Case(scene=scene, t_end=10.0, dt_out=0.1)


def _tumbling(rate: float) -> Case:
    """About an axis that no axis of inertia is near; by quaternions, the default."""
    return _box((0.48 * rate, 0.64 * rate, 0.6 * rate), "quaternion")


def _tumbling_by_angles(rate: float) -> Case:
    """About y, by the paper's angles: it turns exactly through phi_y = 90 deg, where they are singular."""
    return _box((0.0, rate, 0.0), "euler_xyz")


def _heaving_support(amplitude: float) -> Case:
    """A pendulum whose support heaves at twice its frequency."""
    omega = 2.0 * np.sqrt(STANDARD_GRAVITY / LENGTH)
    scene = Scene(name="2:1 pendulum")
    scene.add_body(name="support", mass=100.0, inertia=(10.0, 10.0, 10.0))
    tilt = 0.01
    scene.add_body(
        name="bob", mass=1e4, inertia=(10.0, 10.0, 10.0),
        position=LENGTH * np.array([np.sin(tilt), 0.0, -np.cos(tilt)]),
    )  # fmt: skip
    scene.add_joint(kind="prismatic", name="guide", first="ground", second="support", point=(0, 0, 0))
    scene.add_joint(
        kind="revolute", name="hinge", first="support", second="bob", point=(0, 0, 0), axis=(0, 1, 0)
    )
    scene.add_driver(
        joint="guide", curve=_core.Curve.harmonic(amplitude=amplitude, omega=omega, phase=-0.5 * np.pi)
    )
    return Case(scene=scene, t_end=60.0, dt_out=0.5)


def _strut(base: float, turned: float, rate: float) -> Scene:
    """A jib of 10 m hinged at the origin; a cylinder from `base` m beside the hinge to 5 m along the jib."""
    scene = Scene(name="jib and cylinder")
    along = np.array([np.cos(turned), 0.0, np.sin(turned)])
    half = 0.5 * turned
    scene.add_body(
        name="jib", mass=1e4, inertia=(1e3, 8.5e4, 8.5e4), position=(0, 0, 0), center_of_mass=(5, 0, 0),
        quaternion=(np.cos(half), 0.0, -np.sin(half), 0.0), angular_velocity=(0.0, -rate, 0.0),
    )  # fmt: skip
    foot, head = np.array([base, 0.0, 0.0]), 5.0 * along
    line = head - foot
    if np.linalg.norm(line) > 0.0:
        line = line / np.linalg.norm(line)
    else:
        line = np.array([-np.sin(turned), 0.0, np.cos(turned)])
    angle = 0.5 * np.arctan2(line[2], line[0])
    turn = (np.cos(angle), 0.0, -np.sin(angle), 0.0)
    for name, at, mass in (("barrel", foot, 800.0), ("rod", head, 500.0)):
        side = 1.0 if name == "barrel" else -1.0
        scene.add_body(
            name=name, mass=mass, inertia=(20.0, 600.0, 600.0), position=at,
            center_of_mass=(side * 1.5, 0, 0), quaternion=turn,
        )  # fmt: skip
    across = (0.0, 1.0, 0.0)
    scene.add_joint(kind="revolute", name="hinge", first="ground", second="jib", point=(0, 0, 0), axis=across)
    scene.add_joint(
        kind="universal", name="foot", first="ground", second="barrel", point=foot, axis=across,
        second_axis=np.cross(line, across),
    )  # fmt: skip
    scene.add_joint(kind="spherical", name="head", first="jib", second="rod", point=head)
    scene.add_joint(kind="prismatic", name="cylinder", first="barrel", second="rod", point=head, axis=line)
    return scene


def _dead_centre(nearness: float) -> Case:
    """A jib that whirls through both dead centres of its cylinder, whose ends come that near each other."""
    scene = _strut(5.0 + nearness, 2.0, 4.0)
    scene.gravity = 0.0
    return Case(scene=scene, t_end=5.0, dt_out=0.05)


def _driven_to_dead_centre(short: float) -> Case:
    """A driver draws the cylinder to `short` m from where it cannot get any longer; below 0, beyond."""
    scene = _strut(-3.0, 2.0, 0.0)
    feet = np.array([-3.0, 0.0, 0.0])
    begin = float(np.linalg.norm(5.0 * np.array([np.cos(2.0), 0.0, np.sin(2.0)]) - feet))
    curve = _core.Curve.quintic(start_time=0.0, end_time=5.0, start=0.0, end=8.0 - short - begin)
    scene.add_driver(joint="cylinder", curve=curve)
    return Case(scene=scene, t_end=6.0, dt_out=0.1)


def _four_bar(mismatch: float) -> Case:
    """A parallelogram let go, which folds flat on its way; one bar is that much too long, over 2 m."""
    scene = Scene(name="four-bar")
    up = np.array([0.3, 0.0, 0.8])
    across = (0.0, 1.0, 0.0)
    feet = (np.zeros(3), np.array([2.0 * (1.0 + mismatch), 0.0, 0.0]))
    scene.add_body(name="coupler", mass=2.0, inertia=(0.1, 0.7, 0.7), position=np.array([1.0, 0, 0]) + up)
    for i, foot in enumerate(feet):
        scene.add_body(name=f"crank {i}", mass=1.0, inertia=(0.06, 0.06, 0.06), position=foot + 0.5 * up)
        ends = [foot, np.array([2.0 * i, 0.0, 0.0]) + up]
        kinds = ("revolute", "revolute") if i == 0 else ("cylindrical", "spherical")
        for kind, name, first, second, point in (
            (kinds[0], f"foot {i}", "ground", f"crank {i}", ends[0]),
            (kinds[1], f"head {i}", f"crank {i}", "coupler", ends[1]),
        ):
            scene.add_joint(
                kind=kind, name=name, first=first, second=second, point=point,
                axis=None if kind == "spherical" else across,
            )  # fmt: skip
    return Case(scene=scene, t_end=1.0, dt_out=0.02)


def _bricard(factor: float) -> Case:
    """Bricard's loop of six hinges along a cube's edges, one row too many; the mass of one rod multiplied."""
    scene = Scene(name="bricard")
    bodies = ["ground"]
    for i in range(1, 6):
        here, there = CUBE[i], CUBE[(i + 1) % 6]
        inertia = np.diag(np.full(3, 1.0 / 12.0)) * (1.0 - np.abs(there - here)) + 1e-3 * np.eye(3)
        by = factor if i == 3 else 1.0
        scene.add_body(name=f"rod {i}", mass=by, inertia=by * inertia, position=0.5 * (here + there))
        bodies.append(f"rod {i}")
    for i in range(6):
        first = "ground" if i == 1 else bodies[i - 1]
        scene.add_joint(
            kind="revolute", name=f"hinge {i}", first=first, second=bodies[i], point=CUBE[i], axis=HINGES[i]
        )
    return Case(scene=scene, t_end=2.0, dt_out=0.05)


def _hinges(count: float) -> Case:
    """A door on that many hinges, on a leaning post."""
    scene = Scene(name="door")
    scene.add_body(name="door", mass=30.0, inertia=(10.0, 12.0, 3.0), position=(0.5, 0.0, 0.0))
    lean = np.array([0.1, 0.0, 1.0]) / np.hypot(0.1, 1.0)
    for i, height in enumerate(np.linspace(-1.0, 1.0, int(count)) if count > 1.0 else [0.0]):
        scene.add_joint(
            kind="revolute", name=f"hinge {i}", first="ground", second="door", point=height * lean, axis=lean
        )
    scene.add_force("door", name="draught", point=(0.5, 0, 0), force=(0, 20, 0), body_axes=True)
    return Case(scene=scene, t_end=5.0, dt_out=0.1)


AXES = (
    Axis(name="tumble", title="A payload that tumbles on its wire, by quaternions", label="spin [rad/s]",
         values=(0.1, 1.0, 10.0, 100.0), quick=(1.0, 10.0), case=_tumbling),
    Axis(name="tumble-angles", title="A payload that tumbles on its wire, by the paper's XYZ angles",
         label="spin [rad/s]", values=(0.1, 1.0, 10.0, 100.0), quick=(0.1, 10.0), case=_tumbling_by_angles),
    Axis(name="parametric", title="A pendulum of 10 m on a support that heaves at twice its frequency",
         label="amplitude of heave [m]", values=(1e-3, 0.1, 1.0, 10.0), quick=(0.01, 1.0),
         case=_heaving_support),
    Axis(name="dead-centre", title="A jib whirled through the dead centres of its cylinder",
         label="least distance of the cylinder's ends [m]", values=(1.0, 0.1, 1e-3, 1e-5, 1e-8, 0.0),
         quick=(1.0, 1e-3, 0.0), case=_dead_centre),
    Axis(name="driven-dead-centre", title="A cylinder driven up to its dead centre and beyond",
         label="short of the dead centre [m]", values=(1.0, 0.01, 1e-4, 1e-6, 0.0, -0.1),
         quick=(0.01, 1e-4, -0.1), case=_driven_to_dead_centre),
    Axis(name="four-bar", title="A four-bar through its singular position", label="mismatch of its bars [-]",
         values=(0.1, 1e-2, 1e-4, 1e-6, 1e-10, 0.0), quick=(0.01, 1e-6, 0.0), case=_four_bar),
    Axis(name="bricard", title="Bricard's overconstrained loop", label="times the mass of one rod",
         values=(1e-8, 1e-4, 1.0, 1e4), quick=(1e-8, 1.0), case=_bricard),
    Axis(name="hinges", title="A door on many hinges", label="hinges", values=(1.0, 2.0, 5.0, 20.0),
         quick=(2.0, 5.0), case=_hinges),
)  # fmt: skip
