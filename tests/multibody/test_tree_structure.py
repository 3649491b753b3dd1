"""What the recursive form takes from the structure of a scene: links, slender cylinders, axes of symmetry,
actuators on coordinates of the tree, and outputs of kinematics alone."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from multibody_runs import ramp

from seacrane import Scene, cases, simulate
from seacrane.arrays import Array
from seacrane.inputs.frames import rotation_matrix

ROD = np.diag([0.3, 0.3, 0.02])  # about z
PLATE = np.array([[2.0, 0.3, 0.1], [0.3, 1.5, 0.2], [0.1, 0.2, 2.2]])
TILT = np.array([np.cos(0.3), 0.6 * np.sin(0.3), 0.8 * np.sin(0.3), 0.0])  # of all that is built


def turned(vector: Any) -> Array:
    """From the axes that a mechanism is drawn in to the inertial ones."""
    return np.asarray(rotation_matrix(TILT) @ np.asarray(vector, dtype=float))


def add_body(scene: Scene, name: str, at: Any, inertia: Array) -> None:
    scene.add_body(name=name, mass=3.0, inertia=inertia, position=turned(at), quaternion=TILT)


def jib(*, off_line: float = 0.0, swapped: bool = False) -> Scene:
    """A jib on a turning column, a cylinder across its hinge in the x-z plane, and a load on a link.

    `off_line` moves the cylinder's upper end out of that plane; `swapped` writes all joints the other way."""
    scene = Scene(name="jib", gravity=9.81)
    add_body(scene, "column", (0.0, 0.1, 1.0), PLATE)
    add_body(scene, "jib", (2.0, 0.0, 3.0), PLATE)
    lower, upper = np.array([1.0, 0.0, 0.5]), np.array([2.0, off_line, 3.0])
    line = (upper - lower) / np.linalg.norm(upper - lower)
    for name, share in (("barrel", 0.3), ("rod", 0.7)):
        add_body(scene, name, lower + share * (upper - lower), ROD)
    add_body(scene, "load", (4.0, 0.0, 2.0), np.eye(3))
    add_body(scene, "tail", (4.2, 0.1, 1.5), PLATE)

    def join(kind: str, name: str, first: str, second: str, point: Any, axis: Any, **more: Any) -> None:
        if swapped:
            first, second = second, first
            if "second_axis" in more:
                axis, more["second_axis"] = more["second_axis"], axis
            if "second_point" in more:
                point, more["second_point"] = more["second_point"], point
        for key in more.keys() & {"second_axis", "second_point"}:
            more[key] = turned(more[key])
        scene.add_joint(
            kind=kind, name=name, first=first, second=second, point=turned(point), axis=turned(axis), **more
        )

    across = np.cross((0.0, 1.0, 0.0), line)
    join("revolute", "slew", "ground", "column", (0.0, 0.0, 0.0), (0.0, 0.0, 1.0))
    join("revolute", "luff", "column", "jib", (0.0, 0.0, 2.0), (0.0, 1.0, 0.0))
    join("prismatic", "cylinder", "barrel", "rod", 0.5 * (lower + upper), line)
    join("universal", "cross", "column", "barrel", lower, (0.0, 1.0, 0.0), second_axis=across)
    join("spherical", "ball", "jib", "rod", upper, (0.0, 0.0, 1.0))
    join("distance", "link", "jib", "load", (4.0, 0.0, 3.5), (0.0, 0.0, 1.0), second_point=(4.0, 0.1, 2.3))
    if not swapped:
        across = (0.0, 1.0, 0.0)
        join("universal", "hook", "load", "tail", (4.0, 0.0, 1.8), (1.0, 0.0, 0.0), second_axis=across)
    else:
        join("prismatic", "way", "ground", "tail", (4.2, 0.1, 1.5), (0.2, 0.3, 1.0))
        scene.add_actuator(name="push", joint="way", stiffness=50.0, damping=4.0, reference=ramp(0.1, 0.4))
    scene.add_actuator(name="turn", joint="slew", stiffness=30.0, damping=5.0, feed_forward=ramp(2.0, 2.3))
    scene.add_actuator(
        name="lift", joint="cylinder", stiffness=400.0, damping=20.0, reference=ramp(-0.2, 0.1)
    )
    return scene


@pytest.mark.warns(sometimes=["PushingLinkWarning"])
@pytest.mark.parametrize(("swapped", "off_line"), [(False, 0.0), (True, 0.2)])
def test_actuators_do_the_same_work_on_coordinates_as_on_bodies(swapped: bool, off_line: float) -> None:
    scene = jib(off_line=off_line, swapped=swapped)
    tree, bodies = (
        simulate(scene, t_end=1.0, dt_out=0.25, rtol=1e-10, integrator="dop853", formulation=kind)
        for kind in ("recursive", "redundant")
    )
    for channel in ("position", "velocity", "actuator_force", "absolute_work"):
        # The work sums |power|, whose kinks no method resolves to its tolerance.
        bound = 1e-2 if channel == "absolute_work" else 1e-7
        np.testing.assert_allclose(tree[channel], bodies[channel], rtol=bound, atol=bound, err_msg=channel)
    for result in (tree, bodies):
        assert np.abs(result["energy_balance"]).max() < 1e-8 * result["absolute_work"][-1]
    assert tree["absolute_work"][-1] > 1.0


def test_implicit_steps_know_the_actuators_on_the_tree() -> None:
    scene, errors = jib(), []
    settings: dict[str, Any] = {"t_end": 0.5, "dt_out": 0.5, "formulation": "recursive"}
    exact = simulate(scene, integrator="dop853", rtol=1e-12, **settings)["position"]
    for rtol in (1e-4, 1e-7):
        found = simulate(scene, integrator="rosenbrock", rtol=rtol, **settings)
        assert found.stats["jacobians"] > 0
        errors.append(np.abs(found["position"] - exact).max())
    assert errors[0] < 1e-3 and errors[1] < 1e-2 * errors[0]


def test_outputs_of_kinematics_are_those_of_all_channels() -> None:
    """Alone they are taken from the tree itself; beside others from the state of the described bodies."""
    scene = cases.case2(count=20)
    alone = ["position", "velocity", "quaternion", "vessel_motion", "coordinate", "absolute_work"]
    few, all_of_them = (
        simulate(scene, t_end=5.0, dt_out=0.5, formulation="recursive", channels=channels)
        for channels in (alone, None)
    )
    assert "constraint_error" in all_of_them.channels and "constraint_error" not in few.channels
    for channel in alone:
        like = np.abs(all_of_them[channel]).max()
        np.testing.assert_allclose(few[channel], all_of_them[channel], rtol=0.0, atol=1e-12 * like)


def test_outputs_beside_merged_bodies_do_not_change_the_waves() -> None:
    """Steps and outputs share the knots of the wave table, whose values no order of calls changes."""
    scene = cases.case2(count=20)
    loads = ["wave_force"]
    dense, coarse = (
        simulate(scene, t_end=4.0, dt_out=dt, formulation="recursive", channels=loads) for dt in (0.1, 2.0)
    )
    np.testing.assert_array_equal(dense["wave_force"][::20], coarse["wave_force"])
