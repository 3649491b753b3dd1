"""Sheaves are drawn where lines run over them, and drums turn by what they pay out."""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from test_view_gltf import Model

from seacrane import Result, Scene, simulate, view
from seacrane._core import Line
from seacrane.description.line_path import described_poses, laid
from seacrane.pictures.drawing import drawing_of
from seacrane.pictures.wheels import Wheel

RADIUS, OVER, RATE = 0.5, 0.6, -0.8
ACROSS = (0.0, 1.0, 0.0)


def hoist(*, drum_on_path: bool = False, drum: bool = True) -> Scene:
    """A load below a sheave at the end of an arm, on a line from the ground: from a point, or from a drum
    that is the first sheave of the path."""
    scene = Scene(name="hoist")
    scene.add_body(name="arm", mass=2e3, inertia=(500.0, 500.0, 500.0), position=(5, 0, 6),
                   center_of_mass=(-2, 0, 1))  # fmt: skip
    scene.add_body(name="load", mass=2e3, inertia=(500.0, 500.0, 500.0), position=(5 + OVER, 0, 0))
    scene.add_joint(kind="weld", name="stands", first="ground", second="arm")
    bodies, points = ["ground", "arm", "load"], [(0, 0, 0), (0, 0, 0), (0, 0, 0.5)]
    radii, axes = [0, OVER, 0], [(0, 0, 0), ACROSS, (0, 0, 0)]
    if drum_on_path:
        bodies, points = ["ground", *bodies], [(-RADIUS, 0, 0), *points]
        radii, axes = [0, RADIUS, OVER, 0], [(0, 0, 0), ACROSS, ACROSS, (0, 0, 0)]
    path: dict[str, Any] = {"bodies": bodies, "points": points}
    wheels = {"radii": radii, "axes": axes}
    length = laid(Line(name="hoist", EA=1e7, length=1.0, **path, **wheels), described_poses(scene)).length
    scene.add_line(name="hoist", EA=1e7, length=length - 0.01, damping_ratio=0.1, sheaves=wheels, **path)
    own = {"drum_inertia": 100.0, "drum_radius": RADIUS} if drum else {}
    scene.add_winch(line="hoist", rate=RATE, lag=0.1, maximum_acceleration=2.0, **own)
    return scene


@cache
def hoisted(drum_on_path: bool) -> Result:
    return simulate(hoist(drum_on_path=drum_on_path, drum=not drum_on_path), t_end=3.0, dt_out=0.1)


def wheels(what: Any) -> dict[str, Wheel]:
    return {wheel.name: wheel for wheel in drawing_of(what).wheels}


@pytest.mark.parametrize("drum_on_path", [False, True])
def test_the_rim_of_a_drum_moves_with_the_rope(drum_on_path: bool) -> None:
    """Its point at which the first span leaves runs along that span by what is paid out."""
    result = hoisted(drum_on_path)
    drum = wheels(result)["hoist drum"]
    path = laid(result.scene.loads["hoist"], described_poses(result.scene))
    first = int(drum_on_path)
    span = path.ends[first] - path.starts[first]
    out = path.starts[first] - np.array(drum.at[1:])
    assert drum.at[0] == -1 and np.linalg.norm(out) == pytest.approx(RADIUS, abs=1e-4)
    small = drum.angle[1] * np.cross(drum.axis, out)
    paid = result["line_unstretched_length"][:, 0] - result["line_unstretched_length"][0, 0]
    paid = np.interp(drawing_of(result).motion.times, result.time, paid)
    np.testing.assert_allclose(small, paid[1] * span / np.linalg.norm(span), atol=1e-4)
    np.testing.assert_allclose(drum.angle, paid / RADIUS, atol=1e-12)
    assert drum.angle[-1] < -3.0
    if not drum_on_path:  # by the state where the length was not recorded
        names = ["position", "quaternion", "velocity", "angular_velocity", "load_state"]
        by_state = simulate(hoist(), t_end=3.0, dt_out=0.1, channels=names)
        np.testing.assert_allclose(wheels(by_state)["hoist drum"].angle, drum.angle, atol=1e-9)


def test_sheaves_are_discs_about_their_axes_on_their_bodies() -> None:
    """A block that lines pass often is drawn once."""
    scene = hoist()
    found = wheels(scene)
    sheave = found["hoist sheave 1"]
    assert (sheave.kind, sheave.at, sheave.angle) == ("sheave", [0, 2.0, 0.0, -1.0], None)
    disc = sheave.shapes[0]
    assert disc.radius == OVER
    np.testing.assert_allclose(np.cross(disc.end - disc.start, ACROSS), 0.0, atol=1e-12)
    np.testing.assert_allclose(disc.start + disc.end, 0.0, atol=1e-12)
    assert set(wheels(hoist(drum_on_path=True))) == {"hoist drum", "hoist sheave 2"}
    line = scene.loads["hoist"]
    for name, sign in (("again", 1.0), ("backwards", -1.0)):
        scene.add_line(name=name, bodies=line.bodies, points=[(10 if sign < 0 else 0, 0.0, 0.0),
                       *line.points[1:]], sheaves={"radii": line.radii, "axes": sign * line.axes}, EA=1e7,
                       length=12.0)  # fmt: skip
    assert set(wheels(scene)) == set(found) == {"hoist drum", "hoist sheave 1"}


def test_a_line_straight_down_has_a_level_drum() -> None:
    scene = Scene(name="down")
    scene.add_body(name="load", mass=2e3, inertia=(500.0, 500.0, 500.0), position=(0, 0, -9.0))
    scene.add_line(name="hoist", bodies=["ground", "load"], points=np.zeros((2, 3)), EA=1e7, length=9.0)
    scene.add_winch(line="hoist", rate=0.0, lag=0.1, drum_inertia=100.0, drum_radius=RADIUS)
    drawing = drawing_of(scene)
    (drum,) = drawing.wheels
    assert drum.axis[2] == drum.at[3] == 0.0
    np.testing.assert_allclose(np.linalg.norm(drum.at[1:]), RADIUS, atol=1e-4)
    assert drawing.box[1, 2] >= RADIUS, "a picture leaves the drum out"


def test_pages_and_models_turn_drums_below_their_bodies(tmp_path: Path) -> None:
    result = hoisted(False)
    data = json.loads(view(result).html.split('id="data">')[1].split("</script>")[0])
    drum, sheave = data["wheels"]
    assert drum["axis"] == pytest.approx(ACROSS) and sheave["at"] == [0, 2.0, 0.0, -1.0]
    model = Model(view(result).save_gltf(tmp_path / "lift.glb"))
    nodes, named = model.gltf.nodes, model.nodes
    assert named["hoist drum"] in nodes[0].children
    assert nodes[named["arm"]].children == [named["hoist sheave 1"]]
    assert nodes[named["hoist sheave 1"]].translation == [2.0, 0.0, -1.0]
    turned = model.track("hoist drum", "rotation")[1]
    angle = wheels(result)["hoist drum"].angle
    expected = Rotation.from_rotvec(angle[:, None] * np.array(ACROSS))
    assert (Rotation.from_quat(turned) * expected.inv()).magnitude().max() < 1e-6
