"""What assembly changes of a description is told, with names and sizes, and small corrections are not."""

from __future__ import annotations

import numpy as np
import pytest

from seacrane import Curve, Scene
from seacrane.description.compilation import LARGEST_MOVE, LARGEST_TURN, moves
from seacrane.warnings import AssemblyWarning

ARM = 20.0  # m, hinge to the centre of the boom


def boom(angle: float = 0.0, **body: object) -> Scene:
    """A boom on a hinge whose driver starts at `angle` from the described pose."""
    scene = Scene(name="boom")
    scene.add_body(name="boom", mass=1e3, inertia=[1e3, 1e4, 1e4], position=(ARM, 0, 0), **body)
    scene.add_joint("hinge", kind="revolute", first="ground", second="boom", point=(0, 0, 0), axis=(0, 0, 1))
    scene.add_driver(joint="hinge", curve=Curve.constant(value=angle))
    return scene


@pytest.mark.parametrize("orientation", ["quaternion", "euler_xyz"])
@pytest.mark.parametrize("angle", [-np.pi / 2, 1.0, 0.02])
def test_a_driver_off_the_described_pose_is_told_with_what_it_moved(angle: float, orientation: str) -> None:
    scene = boom(angle)
    scene.orientation = orientation
    with pytest.warns(AssemblyWarning, match=r"body 'boom' by .* open, m or rad: 'hinge.angle' by") as caught:
        model = scene.compile()
    assert caught[0].filename == __file__
    ((name, moved, turned),) = moves(scene, model)
    assert name == "boom"
    assert moved == pytest.approx(2.0 * ARM * np.sin(abs(angle) / 2.0), rel=1e-9)  # the chord
    assert turned == pytest.approx(abs(angle), rel=1e-7)
    assert model.assembly["open"] == [("hinge.angle", pytest.approx(abs(angle)))]


def test_what_is_told_goes_with_the_scene_s_length_scale() -> None:
    """But a metre is told on any; corrections below the stated distance are not."""
    boom(0.9 * LARGEST_MOVE / ARM).compile()
    boom(0.0).compile()
    scene = boom(0.9 * LARGEST_TURN)
    scene.length_scale = 20.0  # a chord of 0.18 m, and a turn below 0.01 rad
    assert moves(scene, scene.compile()) == []
    scene.length_scale = 1.0
    with pytest.warns(AssemblyWarning):
        assert [name for name, _, _ in moves(scene, scene.compile())] == ["boom"]
    sledge = Scene(name="sledge", length_scale=1e4)
    sledge.add_body(name="sledge", mass=1e3, inertia=[1e3, 1e3, 1e3])
    sledge.add_joint(kind="prismatic", name="rail", first="ground", second="sledge", axis=(1, 0, 0))
    sledge.add_driver(joint="rail", curve=Curve.constant(value=1.1))
    with pytest.warns(AssemblyWarning):
        sledge.compile()


def test_a_described_velocity_that_joints_do_not_allow_is_told() -> None:
    """The driver holds the boom's centre, said to move at 1 m/s; a driver's own rate needs no word."""
    with pytest.warns(AssemblyWarning, match=r"velocities: body 'boom' by 1 m/s"):
        boom(velocity=(1.0, 0.0, 0.0)).compile()
    scene = boom()
    scene.drivers.clear()
    scene.add_driver(joint="hinge", curve=Curve.pieces(starts=[0.0], coefficients=[[0, 0.1, 0, 0, 0, 0]]))
    scene.compile()


def test_a_hull_said_to_move_alone_keeps_its_speed_or_it_is_told() -> None:
    """Momentum: 100 t at 2 m/s take 10 t at rest along, at 2 / 1.1 m/s."""
    scene = Scene(gravity=0.0)
    scene.add_body(name="hull", mass=100e3, inertia=[1e6, 1e6, 1e6], velocity=(2.0, 0.0, 0.0))
    scene.add_body(name="load", mass=10e3, inertia=[1e4, 1e4, 1e4])
    scene.add_joint(kind="weld", name="lashing", first="hull", second="load", point=(0, 0, 0))
    with pytest.warns(AssemblyWarning, match=rf"body 'hull' by {2.0 - 2.0 / 1.1:.4g} m/s"):
        scene.compile()
