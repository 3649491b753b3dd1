"""Relative motion, angles, hooks and clearances by quaternions, differences and geometry; their refusals."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from seacrane import FileFormatError, Result, Scene, SceneError, simulate
from seacrane.arrays import Array
from seacrane.scene.file import scene_digest

CORNER, EDGE, COM = (1.0, -2.0, -3.0), (4.0, 5.0, 1.5), (0.3, -0.2, 0.6)


def tumbling() -> Scene:
    """A load that tumbles over a hull that turns about all its axes."""
    scene = Scene(name="tumbling")
    scene.add_body(name="load", mass=1e3, inertia=(1e3, 2e3, 2.5e3), position=(3.0, 2.0, 12.0),
                   velocity=(0.5, 0.2, 1.0), angular_velocity=(0.2, -0.7, 0.4), gravity=False)  # fmt: skip
    scene.add_body(
        name="hull", mass=1e6, inertia=(1e7, 3e7, 3.5e7), center_of_mass=COM, position=(1.0, 0.0, 0.0),
        angular_velocity=(0.3, 0.1, -0.2), velocity=(0.1, 0.0, -0.2), gravity=False,
    )  # fmt: skip
    scene.add_point(name="corner", body="load", point=CORNER)
    scene.add_point(name="edge", body="hull", point=EDGE)
    return scene


def turned(q: Array, vectors: Any) -> Array:
    w, u = q[:, :1], q[:, 1:]
    v = np.broadcast_to(vectors, (len(q), 3))
    return np.asarray(v + 2.0 * np.cross(u, np.cross(u, v) + w * v))


def by_hand(result: Result, point: Any = CORNER, to: Any = EDGE) -> Array:
    """A point over another, the corner over the edge, along the axes of the hull, by quaternions."""
    load, hull = ([result.select(name, body=body) for name in ("position", "quaternion")]
                  for body in ("load", "hull"))  # fmt: skip
    apart = load[0] + turned(load[1], point) - hull[0] - turned(hull[1], np.subtract(to, COM))
    return turned(hull[1] * [1.0, -1.0, -1.0, -1.0], apart)


def test_over_a_deck_by_quaternions_and_differences() -> None:
    scene = tumbling()
    for axis in "xyz":
        scene.add_channel(axis, expression=f"corner.{axis} in hull - edge.{axis} in hull")
        scene.add_channel(f"v{axis}", expression=f"corner.v{axis} in hull")
    scene.add_channel("load", expression="load.y in 'hull' + 0 m")
    result = simulate(scene, 5.0, dt_out=0.01, rtol=1e-10)
    over, rate = (
        np.column_stack([result.curve(f"own[{begun}{axis}]") for axis in "xyz"]) for begun in ("", "v")
    )
    assert_allclose(over, by_hand(result), atol=1e-12)
    assert_allclose(rate[1:-1], (over[2:] - over[:-2]) / 0.02, atol=2e-4)
    assert np.abs(rate - result.select("point_velocity", point="corner")).max() > 1.0
    assert_allclose(result.curve("own[load]"), by_hand(result, (0, 0, 0), (0, 0, 0))[:, 1], atol=1e-12)


def test_angles_of_bodies_turn_the_axes_back() -> None:
    result = simulate(tumbling(), 5.0, channels=["heel", "trim", "yaw", "quaternion"])
    for body in ("load", "hull"):
        heel, trim, yaw = (result.select(name, body=body) for name in ("heel", "trim", "yaw"))
        q = result.select("quaternion", body=body)
        half = [(np.cos(0.5 * angle), np.sin(0.5 * angle)) for angle in (heel, trim, yaw)]
        (cr, sr), (cp, sp), (cy, sy) = half
        again = np.column_stack([
            cy * cp * cr + sy * sp * sr, cy * cp * sr - sy * sp * cr,
            cy * sp * cr + sy * cp * sr, sy * cp * cr - cy * sp * sr,
        ])  # fmt: skip
        assert_allclose(again * np.sign(np.sum(again * q, axis=1, keepdims=True)), q, atol=1e-9)
    with pytest.raises(SceneError, match="vessel_motion"):
        result.curve("yaw")  # by itself that of a vessel, which is not there


def hoisting() -> Scene:
    scene = Scene(name="hoisting")
    scene.add_body(name="load", mass=1e3, inertia=(1e3, 1e3, 1e3), position=(0.0, 0.0, -10.0))
    scene.add_line(name="wire", bodies=["ground", "load"], points=[(0, 0, 0), (0, 0, 1)], EA=1e7, length=9.0)
    scene.add_winch("wire", rate=-0.5, minimum_length=2.0)
    return scene


def test_wire_and_hook_of_a_winch() -> None:
    asked = ["hook_speed", "wire_paid_out", "wire_spare", "position", "quaternion"]
    result = simulate(hoisting(), 4.0, dt_out=0.05, channels=asked)
    assert_allclose(result.curve("wire_paid_out"), -0.5 * result.time, atol=1e-9)
    assert_allclose(result.curve("wire_spare"), 7.0 - 0.5 * result.time, atol=1e-9)
    end = result.place_of("load", (0.0, 0.0, 1.0))
    risen = np.trapezoid(result.curve("hook_speed"), result.time)
    assert risen == pytest.approx(end[-1, 2] - end[0, 2], abs=1e-2)


def test_files_keep_it_and_any_point_has_a_place_after_a_run(tmp_path: Path) -> None:
    scene = tumbling()
    digest = scene_digest(scene)
    result = simulate(scene, 2.0)
    edge = result.place_of("hull", EDGE)
    assert_allclose(edge, result.select("point_position", point="edge"), atol=1e-12)
    assert np.array_equal(Result.load(result.save(tmp_path / "run.nc")).place_of("hull", EDGE), edge)
    scene.add_channel("over deck", expression="corner.z in hull - edge.z")
    assert scene_digest(scene) != digest and scene_digest(tumbling()) == digest
    scene.add_channel("gap", points="corner", body="hull", size=(3.0, 2.0, 1.0))
    scene.save(tmp_path / "scene.json")
    again = Scene.load(tmp_path / "scene.json")
    assert (again.channels, again.clearances) == (scene.channels, scene.clearances)
    text = (tmp_path / "scene.json").read_text().replace("edge.z", "brink.z")
    (tmp_path / "scene.json").write_text(text)
    with pytest.raises(FileFormatError, match="no point or body 'brink'"):
        Scene.load(tmp_path / "scene.json")
    with pytest.raises(SceneError, match="channel 'over deck' refer to it"):
        scene.remove("edge")
    with pytest.raises(SceneError, match="no body 'deck'"):
        scene.add_channel("a", expression="corner.z in deck")
    with pytest.raises(SceneError, match="no point 'hull'"):
        scene.add_channel("a", points="hull")


def falling(*, turned: float = 0.0) -> Scene:
    """A block that falls past a box on a body that is turned about z."""
    scene = Scene(name="falling", gravity=9.80665)
    scene.add_body(name="block", mass=1.0, inertia=(1.0, 1.0, 1.0), position=(3.0, 0.0, 10.0))
    scene.add_point(name="left", body="block", point=(-1.0, 0.0, 0.0))
    scene.add_point(name="right", body="block", point=(1.0, 0.0, 0.0))
    about_z = (np.cos(0.5 * turned), 0.0, 0.0, np.sin(0.5 * turned))
    scene.add_body(name="house", mass=1e3, inertia=(1e3, 1e3, 1e3), position=(0.0, 0.0, -1.0),
                   quaternion=about_z, gravity=False)  # fmt: skip
    return scene


@pytest.mark.parametrize("turned", [0.0, np.pi / 2.0])
def test_a_block_falls_past_a_box(turned: float) -> None:
    """The box is 2 m by 8 m by 4 m high; turned, its long side lies below the block."""
    scene = falling(turned=turned)
    box = {"body": "house", "center": (0.0, 0.0, 1.0), "size": (2.0, 8.0, 4.0)}
    scene.add_channel("house", points=["left", "right"], **box)
    result = simulate(scene, 1.2, dt_out=0.1)
    height = 10.0 - 0.5 * 9.80665 * result.time**2
    above, aside = np.maximum(np.abs(height) - 2.0, 0.0), 1.0 if turned == 0.0 else 0.0
    expected = np.hypot(above, aside)
    inside = (np.abs(height) < 2.0) & (turned > 0.0)
    expected[inside] = np.maximum(np.abs(height[inside]) - 2.0, -1.0)
    found = result.select("clearance", gap="house")
    assert_allclose(found[~inside], expected[~inside], atol=1e-6)
    assert np.all(found[inside] < 0.0)
