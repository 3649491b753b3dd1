"""Joint kinds from Python: freedoms, consistent starts, contradictions."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from joint_examples import KINDS, own_arguments
from multibody_runs import quaternion_about, record

from seacrane import Frame, Scene
from seacrane.inputs.frames import rotation_matrix

# Assembly makes consistent what some scenes describe roughly, on purpose.
pytestmark = pytest.mark.filterwarnings("ignore::seacrane.warnings.AssemblyWarning")

FREEDOMS = {
    "weld": 0, "revolute": 1, "prismatic": 1, "cylindrical": 2, "universal": 2, "spherical": 3, "planar": 3,
    "distance": 5, "free": 6,
}  # fmt: skip


def one_joint(kind: str) -> Scene:
    scene = Scene(gravity=0.0)
    scene.add_body(name="box", mass=2.0, inertia=(1.0, 1.5, 2.0), position=(0.3, -0.2, 0.5))
    axis = (0.0, 0.0, 1.0) if KINDS[kind].own_point else (0.2, 0.3, 1.0)
    own = own_arguments(kind, lambda: (1.0, 0.0, -0.2), lambda: (0.6, 0.1, 0.5))
    scene.add_joint(
        kind=kind, name="joint", first="ground", second="box", point=(0.0, 0.1, 0.5), axis=axis, **own
    )
    return scene


@pytest.mark.parametrize("kind", KINDS)
def test_each_kind_leaves_its_freedoms_and_a_push_moves_a_body_only_along_them(kind: str) -> None:
    scene = one_joint(kind)
    model = scene.compile()
    assert kind not in FREEDOMS or 6 - KINDS[kind].rows == FREEDOMS[kind]
    assert (model.coordinates, model.constraints) == (6, KINDS[kind].rows)
    assert model.degrees_of_freedom == 6 - KINDS[kind].rows
    assert model.assembly["largest_translation_m"] < 1e-12
    scene.add_force("box", name="push", point=(0.1, 0.4, -0.2), force=(3.0, -2.0, 4.0))
    out = record(scene, 1.0)
    moved = np.max(np.abs(out["position"][-1] - out["position"][0]))
    assert moved < 1e-12 if KINDS[kind].rows == 6 else moved > 0.01
    assert np.max(out["constraint_error"]) < 1e-9
    assert np.max(out["constraint_rate_error"]) < 1e-9
    # The push does work; nothing else does.
    size = float(np.max(out["absolute_work"]))
    assert np.max(np.abs(out["energy_balance"])) <= 1e-6 * size + 1e-12


def parallelogram(*, offset: float = 0.0) -> Scene:
    """Two cranks and a coupler of 2 m in the x-z plane, spatial joints so that nothing is redundant."""
    scene = Scene(name="four-bar")
    for name, x, z in (("left", offset, 0.5), ("right", 2.0, 0.5), ("coupler", 1.0, 1.0)):
        scene.add_body(name=name, mass=1.0, inertia=(0.1, 0.1, 0.1), position=(x, 0.0, z))

    def join(kind: str, name: str, first: str, second: str, here: Any, there: Any) -> None:
        frames = [Frame(point=(x, 0.0, z), axes=[[1, 0, 0], [0, 0, 1], [0, -1, 0]]) for x, z in (here, there)]
        scene.add_joint(
            kind=kind, name=name, first=first, second=second, first_frame=frames[0], second_frame=frames[1]
        )

    join("revolute", "foot", "ground", "left", (0, 0), (0, -0.5))
    join("revolute", "knee", "left", "coupler", (0, 0.5), (-1, 0))
    join("spherical", "elbow", "coupler", "right", (1, 0), (0, 0.5))
    join("cylindrical", "heel", "ground", "right", (2, 0), (0, -0.5))
    return scene


def test_an_approximate_pose_is_closed_and_reported() -> None:
    exact, rough = parallelogram().compile(), parallelogram(offset=0.05).compile()
    assert exact.assembly["largest_translation_m"] < 1e-12
    report = rough.assembly
    assert report["residual_before"] == pytest.approx(0.05, rel=1e-6)
    assert report["residual_after"] < 1e-12
    assert 0.005 < report["largest_translation_m"] <= 0.06
    assert report["rank"] == rough.constraints == 17
    out = record(parallelogram(offset=0.05), 0.5)
    assert np.max(out["constraint_error"]) < 1e-9
    # It hangs on the same joints: the crank's centre stays half a metre from its foot.
    np.testing.assert_allclose(np.linalg.norm(out["position"][:, 0], axis=1), 0.5, atol=1e-9)


def test_velocities_that_tear_a_joint_are_made_consistent() -> None:
    scene = one_joint("prismatic")
    scene.replace("box", velocity=(1.0, 0.0, 0.0))
    axis = np.array([0.2, 0.3, 1.0]) / np.linalg.norm([0.2, 0.3, 1.0])
    out = record(scene, 0.1)
    # The part of the momentum along the guide is kept.
    assert np.abs(out["velocity"][:, 0] - axis[0] * axis).max() < 1e-10
    assert scene.compile().assembly["largest_velocity_change"] > 0.5


def test_joint_frames_may_lie_anywhere_on_their_bodies() -> None:
    q = quaternion_about((1, 1, 0), 0.7)
    runs = []
    for shift in (np.zeros(3), np.array([0.4, -0.3, 0.2])):
        scene = Scene()
        scene.add_body(
            name="flap", mass=3.0, inertia=(0.2, 0.3, 0.4), quaternion=q,
            position=rotation_matrix(q) @ shift, center_of_mass=np.array([0.5, 0.1, -0.2]) - shift,
        )  # fmt: skip
        hinge = {"first": "ground", "second": "flap", "point": (0.1, 0.2, 0.0), "axis": (1.0, 0.2, 0.0)}
        scene.add_joint(kind="revolute", name="hinge", **hinge)
        runs.append(record(scene, 1.0, rtol=1e-9))
    for name in ("position", "quaternion", "reaction_force", "reaction_moment"):
        bound = 1e-9 * max(1.0, np.max(np.abs(runs[0][name])))
        np.testing.assert_allclose(runs[0][name], runs[1][name], atol=bound)
