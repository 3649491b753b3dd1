"""Pictures without a browser: what they are made of, and, where pyvista is installed, they themselves."""

from __future__ import annotations

import itertools
import re
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image
from view_scenes import alone, case2, pair, thrown

from seacrane import Scene, SceneError, cases, simulate
from seacrane.inputs.frames import rotation_matrix
from seacrane.pictures import still, video
from seacrane.pictures.camera import MARGIN, OPENING, WHOLE, camera_of
from seacrane.pictures.drawing import Drawing, drawing_of
from seacrane.pictures.page_sea import sea_components
from seacrane.pictures.still_drawing import Stage, sea_surface, wire_line

SIZE = (480, 300)


@pytest.fixture
def pyvista() -> Any:
    return pytest.importorskip("pyvista", reason="needs the extra stills: pip install 'seacrane[stills]'")


def test_the_sheet_of_water_is_the_sea_that_loads_the_vessel() -> None:
    scene = cases.vessel(hs=3.0, seed=7)
    assert scene.waves is not None
    sea = sea_surface(sea_components(scene), np.array([5.0, -8.0]), 70.0)
    height, slope = sea.elevation(123.4)
    waves = scene.waves.components()
    for i in np.random.default_rng(1).integers(len(height), size=20):
        x, y = sea.place[i]
        assert height[i] == pytest.approx(float(waves.elevation(123.4, x=x, y=y)), abs=1e-9)
        for k, (dx, dy) in enumerate(((1e-3, 0.0), (0.0, 1e-3))):
            ahead, behind = (waves.elevation(123.4, x=x + s * dx, y=y + s * dy) for s in (1.0, -1.0))
            assert slope[i, k] == pytest.approx(float(ahead - behind) / 2e-3, abs=1e-6)
    a, b, c = np.moveaxis(sea.place[sea.faces], 1, 0)
    area = 0.5 * np.sum((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])
    assert area == pytest.approx(np.pi * (9.0 * 70.0) ** 2, rel=1e-3)  # whole, and all facing up


@pytest.mark.parametrize("end", [(3.0, 0.0, 0.0), (0.0, 0.0, -3.0), (1.0, 2.0, 0.5), (0.0, 0.0, 0.0)])
def test_a_slack_line_has_its_length(end: tuple[float, float, float]) -> None:
    points, slack = wire_line(np.zeros(3), np.array(end), 5.0)
    assert slack
    np.testing.assert_allclose(points[[0, -1]], [np.zeros(3), end], atol=1e-4)
    assert np.linalg.norm(np.diff(points, axis=0), axis=1).sum() == pytest.approx(5.0, rel=1e-6)
    assert wire_line(np.zeros(3), np.array([5.0, 0.0, 0.0]), 5.0)[1] is False
    assert wire_line(np.zeros(3), np.array([3.0, 0.0, 0.0]), 0.0)[1] is False


def projected(drawing: Drawing, name: str, points: np.ndarray, position: np.ndarray) -> np.ndarray:
    """Across and up, as shares of half the picture's height; straight from the definition of a pinhole."""
    place, target = camera_of(drawing, name, SIZE[0] / SIZE[1]).at(position)
    view = (target - place) / np.linalg.norm(target - place)
    right = np.cross(view, (0.0, 0.0, 1.0))
    right /= np.linalg.norm(right)
    depth = (points - place) @ view
    flat = np.column_stack([(points - place) @ right, (points - place) @ np.cross(right, view)])
    return flat / depth[:, None] / np.tan(np.radians(OPENING / 2.0))


@pytest.mark.parametrize("name", WHOLE)
def test_everything_just_fits(name: str) -> None:
    drawing = drawing_of(case2())
    box = drawing.box
    corners = np.array([[x, y, z] for x in box[:, 0] for y in box[:, 1] for z in box[:, 2]])
    seen = np.abs(projected(drawing, name, corners, drawing.motion.position[0])) / (SIZE[0] / SIZE[1], 1.0)
    assert 0.8 < seen.max() < 1.0 / MARGIN**2


def test_cameras_stand_where_their_names_say() -> None:
    drawing = drawing_of(pair())
    centre = drawing.box.mean(axis=0)
    ahead = rotation_matrix(drawing.motion.quaternion[0, drawing.motion.bodies.index("vessel")])[:, 0]
    out = {name: camera_of(drawing, name, 1.6).place - centre for name in WHOLE}
    assert out["bow"] @ ahead > 0.0 > out["stern"] @ ahead
    assert np.cross(ahead, out["port"])[2] > 0.0 > np.cross(ahead, out["starboard"])[2]
    assert out["top"][2] > 10.0 * np.abs(out["top"][:2]).max()
    close = camera_of(drawing, "payload", 1.6)
    assert close.follows == drawing.motion.bodies.index("payload")


WRONG: dict[str, tuple[dict[str, Any], str]] = {
    "camera": ({"camera": "left"}, "camera is 'left'; choose overview, port, starboard, bow, stern, top"),
    "time": ({"time": 21.0}, "time is 21 s; the run goes from 0 to 20 s"),
    "no number": ({"time": "noon"}, "time is 'noon'; give a number"),
    "not finite": ({"time": float("nan")}, "time is nan s; the run goes from 0 to 20 s"),
    "size": ({"size": (10, 10)}, "size is (10, 10); give width and height from 100 to 4000 pixels"),
    "one size": ({"size": 300}, "size is 300; give width and height"),
    "ending": ({"path": "lift.bmp"}, "path ends in 'lift.bmp'; choose .png, .jpg, .webp"),
    "what": ({"what": 3}, "3 is neither a Result nor a Scene"),
}


@pytest.mark.parametrize("case", WRONG)
def test_what_cannot_be_drawn_is_refused_without_pyvista(case: str, tmp_path: Path) -> None:
    given, message = WRONG[case]
    given = {"what": alone(), "path": tmp_path / "lift.png", **given}
    with pytest.raises(SceneError, match=re.escape(message)):
        still(given.pop("what"), **given)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"speed": 0.0}, "from 0 to 20 s at speed 0 and rate 10; give an end after the start"),
        ({"start": 5.0, "end": 5.0}, "from 5 to 5 s"),
        ({"rate": 51.0}, "a rate from 1 to 50"),
        ({"speed": 1e-3}, "takes 200001 pictures, above 675 of this size; raise speed"),
        ({"path": "lift.mp4"}, "path ends in 'lift.mp4'; choose .gif, .png, .webp"),
    ],
)
def test_videos_that_make_no_sense_are_refused(given: dict[str, Any], message: str, tmp_path: Path) -> None:
    with pytest.raises(SceneError, match=re.escape(message)):
        video(alone(), **{"path": tmp_path / "lift.webp", **given})
    with pytest.raises(SceneError, match="is no Result; a scene is drawn by still"):
        video(cases.vessel(), path=tmp_path / "lift.webp")  # type: ignore[arg-type]


def test_a_missing_pyvista_is_told_with_the_extra(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pyvista", None)
    with pytest.raises(ImportError, match=re.escape("pip install 'seacrane[stills]'")):
        still(alone(), path=tmp_path / "lift.png")
    assert not list(tmp_path.iterdir())


def pixels(path: Path) -> np.ndarray:
    with Image.open(path) as image:
        return np.asarray(image.convert("RGB"), dtype=float)


def test_the_payload_is_in_the_picture_where_it_was_in_the_run(pyvista: Any, tmp_path: Path) -> None:
    """The middle of what is payload red, against a pinhole's projection of the payload's centre."""
    result, drawing = case2(), drawing_of(case2())
    found = []
    for time in (0.0, 42.8):
        path = still(result, path=tmp_path / f"{time}.png", time=time, camera="top", size=SIZE)
        red, green, blue = np.moveaxis(pixels(path), -1, 0)
        rows, columns = np.nonzero((red > 2.2 * green) & (red > 2.2 * blue))
        position = result["position"][round(time / 0.1)]
        index = list(result.coords["body"]).index("payload")
        (expected,) = projected(drawing, "top", position[index][None], position)
        half = SIZE[1] / 2.0
        place = np.array([columns.mean() + 0.5 - SIZE[0] / 2.0, SIZE[1] / 2.0 - rows.mean() - 0.5]) / half
        np.testing.assert_allclose(place, expected, atol=0.03)
        found.append(place)
    assert np.linalg.norm(found[1] - found[0]) > 0.1


def test_poses_and_water_are_those_of_the_time(pyvista: Any) -> None:
    result, drawing = case2(), drawing_of(case2())
    with Stage(drawing, camera_of(drawing, "overview", 1.6), SIZE) as stage:
        stage.show(30.0)
        for i, name in enumerate(result.coords["body"]):
            pose = np.asarray(stage.bodies[i][0].user_matrix)
            np.testing.assert_allclose(pose[:3, 3], result.select("position", body=name)[300], atol=1e-3)
            turn = rotation_matrix(result.select("quaternion", body=name)[300])
            np.testing.assert_allclose(pose[:3, :3], turn, atol=1e-4)
        assert result.scene is not None
        assert result.scene.waves is not None
        x, y, z = np.asarray(stage.water.points)[1234]
        expected = result.scene.waves.components().elevation(30.0, x=x, y=y)
        assert z == pytest.approx(float(expected), abs=1e-3)


def test_a_slack_wire_is_orange(pyvista: Any, tmp_path: Path) -> None:
    shares = []
    for time in (0.5, 5.9):
        path = still(thrown(), path=tmp_path / f"{time}.png", time=time, camera="payload", size=SIZE)
        red, green, blue = np.moveaxis(pixels(path), -1, 0)
        shares.append(np.mean((red > 200.0) & (green > 70) & (green < 0.62 * red) & (blue < 0.3 * red)))
    assert shares[0] > 10.0 * shares[1]
    assert shares[0] > 1e-4


def test_a_scene_without_water_and_a_scene_alone(pyvista: Any, tmp_path: Path) -> None:
    scene = Scene(name="pendulum")
    scene.add_body(name="ball", mass=1.0, inertia=(0.1, 0.1, 0.1), position=(0, 0, -1.0))
    for what in (simulate(scene, 0.5), cases.vessel()):
        path = still(what, path=tmp_path / "one.jpg", size=SIZE, overwrite=True)
        assert pixels(path).shape == (SIZE[1], SIZE[0], 3)
        assert pixels(path).reshape(-1, 3).std(axis=0).min() > 5.0
    with pytest.raises(FileExistsError, match="overwrite=True"):
        still(scene, path=path)


@pytest.mark.parametrize("ending", ["webp", "gif", "png"])
def test_a_video_has_its_pictures_and_its_pace(pyvista: Any, ending: str, tmp_path: Path) -> None:
    path = video(
        alone(), path=tmp_path / f"lift.{ending}", start=2.0, end=6.0, speed=2.0, rate=4.0, size=(160, 100)
    )
    with Image.open(path) as image:
        assert image.n_frames == 9
        frames = []
        for i in range(image.n_frames):
            image.seek(i)
            frames.append(np.asarray(image.convert("RGB"), dtype=float))
        assert image.info["duration"] == pytest.approx(250.0)
    changes = [np.abs(b - a).mean() for a, b in itertools.pairwise(frames)]
    assert min(changes) > 0.2
