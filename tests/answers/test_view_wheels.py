"""Sheaves are drawn where lines run over them, and drums turn by what they pay out."""

from __future__ import annotations

import json
from functools import lru_cache
from pathlib import Path
from typing import Any

import chromium
import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from view_scenes import case2

from seacrane import Result, Scene, simulate, view
from seacrane._core import Line
from seacrane.description.line_path import described_poses, laid
from seacrane.pictures.drawing import drawing_of
from seacrane.pictures.wheels import Wheel

RADIUS, OVER, RATE = 0.5, 0.6, -0.8
ACROSS = (0.0, 1.0, 0.0)


def hoist(*, drum_on_path: bool = False, winch: bool = True, drum: bool = True) -> Scene:
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
    path: dict[str, Any] = {"bodies": bodies, "points": points, "radii": radii, "axes": axes}
    length = laid(Line(name="hoist", EA=1e7, length=1.0, **path), described_poses(scene)).length
    scene.add_line(name="hoist", EA=1e7, length=length - 0.01, damping_ratio=0.1, **path)
    if winch:
        own = {"drum_inertia": 100.0, "drum_radius": RADIUS} if drum else {}
        scene.add_winch(line="hoist", rate=RATE, lag=0.1, maximum_acceleration=2.0, **own)
    return scene


@lru_cache(maxsize=2)
def hoisted(drum_on_path: bool) -> Result:
    return simulate(hoist(drum_on_path=drum_on_path, drum=not drum_on_path), t_end=3.0, dt_out=0.1)


def wheels(what: Any) -> dict[str, Wheel]:
    return {wheel.name: wheel for wheel in drawing_of(what).wheels}


@pytest.mark.parametrize("drum_on_path", [False, True])
def test_the_rim_of_a_drum_moves_with_the_rope(drum_on_path: bool) -> None:
    """Its point at which the first span leaves runs along that span by what is paid out."""
    result = hoisted(drum_on_path)
    assert result.scene is not None
    drum = wheels(result)["hoist drum"]
    line = result.scene.loads["hoist"]
    path = laid(line, described_poses(result.scene))
    first = int(drum_on_path)
    span = path.ends[first] - path.starts[first]
    out = path.starts[first] - np.array(drum.at[1:])
    assert drum.at[0] == -1 and np.linalg.norm(out) == pytest.approx(RADIUS, abs=1e-4)
    assert drum.angle is not None
    small = drum.angle[1] * np.cross(drum.axis, out)
    paid = result["line_unstretched_length"][:, 0] - result["line_unstretched_length"][0, 0]
    motion = drawing_of(result).motion
    paid = np.interp(motion.times, result.time, paid)
    np.testing.assert_allclose(small, paid[1] * span / np.linalg.norm(span), atol=1e-4)
    np.testing.assert_allclose(drum.angle, paid / RADIUS, atol=1e-12)
    assert drum.angle[-1] < -3.0


def test_sheaves_are_discs_about_their_axes_on_their_bodies() -> None:
    found = wheels(hoist())
    sheave = found["hoist sheave 1"]
    assert set(found) == {"hoist drum", "hoist sheave 1"}
    assert (sheave.kind, sheave.at, sheave.angle) == ("sheave", [0, 2.0, 0.0, -1.0], None)
    disc = sheave.shapes[0]
    assert disc.radius == OVER
    np.testing.assert_allclose(np.cross(disc.end - disc.start, ACROSS), 0.0, atol=1e-12)
    np.testing.assert_allclose(disc.start + disc.end, 0.0, atol=1e-12)
    assert set(wheels(hoist(drum_on_path=True))) == {"hoist drum", "hoist sheave 2"}
    assert set(wheels(hoist(drum_on_path=True, winch=False))) == {"hoist sheave 1", "hoist sheave 2"}
    assert set(wheels(hoist(drum=False))) == {"hoist sheave 1"}


def test_a_block_that_lines_pass_often_is_drawn_once() -> None:
    scene = hoist()
    line = scene.loads["hoist"]
    for name, sign in (("again", 1.0), ("backwards", -1.0)):
        scene.add_line(
            name=name, bodies=line.bodies, points=[(10 if sign < 0 else 0, 0.0, 0.0), *line.points[1:]],
            radii=line.radii, axes=sign * line.axes, EA=1e7, length=12.0,
        )  # fmt: skip
    assert set(wheels(scene)) == {"hoist drum", "hoist sheave 1"}


@pytest.mark.parametrize("below", [0.0, 9.0])
def test_a_line_straight_down_has_a_level_drum(below: float) -> None:
    scene = Scene(name="down")
    scene.add_body(name="load", mass=2e3, inertia=(500.0, 500.0, 500.0), position=(0, 0, -below))
    scene.add_line(name="hoist", bodies=["ground", "load"], points=np.zeros((2, 3)), EA=1e7, length=9.0)
    scene.add_winch(line="hoist", rate=0.0, lag=0.1, drum_inertia=100.0, drum_radius=RADIUS)
    drawing = drawing_of(scene)
    (drum,) = drawing.wheels
    assert drum.axis[2] == 0.0
    np.testing.assert_allclose(np.linalg.norm(drum.at[1:]), RADIUS, atol=1e-4)
    assert drum.at[3] == 0.0 and drum.angle is None
    assert drawing.box[1, 2] >= RADIUS, "a picture leaves the drum out"


def test_a_drum_turns_by_the_state_and_without_both_stands_still() -> None:
    poses = ["position", "quaternion", "velocity", "angular_velocity"]
    for more, turns in ((["load_state"], True), ([], False)):
        result = simulate(hoist(), t_end=3.0, dt_out=0.1, channels=[*poses, *more])
        angle = wheels(result)["hoist drum"].angle
        if not turns:
            assert angle is None
            continue
        expected = wheels(hoisted(False))["hoist drum"].angle
        assert angle is not None and expected is not None
        np.testing.assert_allclose(angle, expected, atol=1e-9)


def test_pages_hold_one_row_of_angles_and_hardly_grow() -> None:
    def data(result: Result) -> dict[str, Any]:
        found = view(result).html.split('id="data">')[1].split("</script>")[0]
        return dict(json.loads(found))

    drum, sheave = data(hoisted(False))["wheels"]
    assert drum["angle"]["shape"] == [1, 16] and sheave["angle"] is None
    assert drum["axis"] == pytest.approx(ACROSS) and sheave["at"] == [0, 2.0, 0.0, -1.0]
    assert len(json.dumps([drum, sheave])) < 2500
    assert data(case2())["wheels"] == []


def test_models_turn_drums_below_their_bodies(tmp_path: Path) -> None:
    pygltflib = pytest.importorskip("pygltflib", reason="the extra dev holds pygltflib")
    result = hoisted(False)
    model = pygltflib.GLTF2().load(str(view(result).save_gltf(tmp_path / "lift.glb")))
    nodes = {node.name: i for i, node in enumerate(model.nodes)}
    assert nodes["hoist drum"] in model.nodes[0].children
    assert model.nodes[nodes["arm"]].children == [nodes["hoist sheave 1"]]
    assert model.nodes[nodes["hoist sheave 1"]].translation == [2.0, 0.0, -1.0]
    (animation,) = model.animations
    (channel,) = (one for one in animation.channels if one.target.node == nodes["hoist drum"])
    assert channel.target.path == "rotation"
    accessor = model.accessors[animation.samplers[channel.sampler].output]
    start = model.bufferViews[accessor.bufferView].byteOffset
    turned = np.frombuffer(model.binary_blob(), "<f4", 4 * accessor.count, start).reshape(-1, 4)
    angle = wheels(result)["hoist drum"].angle
    assert angle is not None
    expected = Rotation.from_rotvec(angle[:, None] * np.array(ACROSS))
    assert (Rotation.from_quat(turned) * expected.inv()).magnitude().max() < 1e-6


@lru_cache(maxsize=1)
def tumbling() -> Result:
    """A drum on a body that turns as it falls, and pays out."""
    scene = Scene(name="tumbling")
    scene.add_body(name="barge", mass=1e4, inertia=(1e4, 2e4, 3e4), position=(1, 2, 3),
                   center_of_mass=(0.5, 0, -0.5), angular_velocity=(0.3, 0.8, -0.5))  # fmt: skip
    scene.add_line(
        name="hoist", bodies=["barge", "ground"], points=[(0, 1, 2), (20, 0, 0)], EA=1e4, length=19.9
    )
    scene.add_winch(line="hoist", rate=1.0, lag=0.1, drum_inertia=100.0, drum_radius=RADIUS)
    return simulate(scene, t_end=2.0, dt_out=0.1)


def placed(result: Result, time: float) -> tuple[np.ndarray, Rotation]:
    """Where the drum is, and how it stands: its turning about its axis, then that of its body."""
    drawing = drawing_of(result)
    (drum,) = drawing.wheels
    position, quaternion = drawing.motion.at([time])
    body = Rotation.from_quat(np.roll(quaternion[0, 0], -1))
    assert drum.angle is not None
    angle = np.interp(time, drawing.motion.times, drum.angle)
    return position[0, 0] + body.apply(drum.at[1:]), body * Rotation.from_rotvec(angle * drum.axis)


@pytest.mark.slow("opens a page")
def test_the_page_turns_drums_on_their_bodies(tmp_path: Path) -> None:
    command = chromium.found()
    if command is None:
        pytest.skip("no Chromium: install Debian's package chromium")
    path = view(tumbling()).save(tmp_path / "page.html")
    with chromium.tab(command) as tab:
        tab.open(path.as_uri())
        for time in (0.0, 1.3, 2.0):
            pose = tab.value(f"seacrane.wheel('hoist drum', {time})")
            place, turn = placed(tumbling(), time)
            np.testing.assert_allclose(pose[:3], place, atol=1e-3)
            assert (Rotation.from_quat(np.roll(pose[3:], -1)) * turn.inv()).magnitude() < 2e-3
        assert tab.errors == []


@pytest.mark.slow("opens a page")
def test_the_picture_shows_that_drums_turn(tmp_path: Path) -> None:
    """By the mark on the flange."""
    from PIL import Image

    command = chromium.found()
    if command is None:
        pytest.skip("no Chromium: install Debian's package chromium")
    path = view(hoisted(False)).save(tmp_path / "page.html")
    marks = []
    with chromium.tab(command) as tab:
        tab.open(path.as_uri())
        tab.value("seacrane.look('port')")
        tab.value("document.getElementById('tracks').click()")
        for time in (0.0, 1.3, 3.0):
            tab.value(f"seacrane.seek({time})")
            tab.picture(tmp_path / "picture.png")
            with Image.open(tmp_path / "picture.png") as image:
                red, green, blue = np.moveaxis(np.asarray(image.convert("RGB"), dtype=float), -1, 0)
            marks.append((red > 1.8 * blue) & (green > 1.5 * blue) & (red > 100.0))
        assert tab.errors == []
    assert min(mark.sum() for mark in marks) > 50
    assert (marks[0] & marks[1]).sum() < 0.5 * marks[0].sum()
