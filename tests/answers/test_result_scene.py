"""A result's file holds the scene that was run: pages are drawn from the file alone, damage is refused."""

from __future__ import annotations

import ctypes
import json
import tracemalloc
from dataclasses import replace
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import pytest
from view_scenes import alone

from seacrane import Result, Scene, cases, report, simulate, view
from seacrane.cli.command_line import main
from seacrane.errors import FileFormatError, SceneError
from seacrane.result import about
from seacrane.result.about import NOT_KEPT
from seacrane.result.result_file import SCENE, SCENE_DIMENSION
from seacrane.result.stream import ResultFile


def pendulum() -> Scene:
    scene = Scene(name="pendulum")
    scene.add_body(name="ball", mass=1.0, inertia=(0.1, 0.1, 0.1), position=(0.3, 0, -1.0))
    scene.add_joint(
        kind="revolute", name="pivot", first="ground", second="ball", point=(0, 0, 0), axis=(0, 1, 0)
    )
    scene.notes["project"] = "secret"
    return scene


def with_scene(path: Path, text: bytes) -> Path:
    """A result's file whose scene is this text."""
    replace(simulate(pendulum(), 0.5), kept_scene=None).save(path)
    with netCDF4.Dataset(path, "a") as file:
        file.createDimension(SCENE_DIMENSION, len(text))
        file.createVariable(SCENE, "u1", (SCENE_DIMENSION,))[:] = np.frombuffer(text, "u1")
    return path


def test_a_page_is_drawn_and_a_run_repeated_from_the_file_alone(tmp_path: Path) -> None:
    loaded = Result.load(alone().save(tmp_path / "run.nc"))
    assert loaded.scene == alone().scene
    assert view(loaded).html == view(alone()).html
    np.testing.assert_array_equal(simulate(loaded.scene, 20.0)["position"], loaded["position"])
    loaded.scene.add_mesh(body="vessel", vertices=np.eye(3), faces=[[0, 1, 2]])
    again = Result.load(loaded.save(tmp_path / "again.nc"))
    assert list(again.scene.meshes) == ["vessel"]
    assert "<h2>In three dimensions</h2>" in report(again).html


def test_a_run_to_a_file_keeps_its_scene(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path, scene = tmp_path / "run.nc", pendulum()
    with monkeypatch.context() as patch:
        patch.setattr(ResultFile, "finish", lambda self, reached_end: self._partial.path)
        partial = simulate(scene, 1.0, to=path, checkpoint_every=0.3).path
    assert partial.suffix == ".partial"
    so_far = Result.load(partial)
    assert so_far.scene == scene.copy(notes={})
    assert partial.read_bytes().count(b'"seacrane scene"') == 1
    simulate(scene, 1.0, to=path, resume=True)
    finished = Result.load(path)
    assert finished.scene == so_far.scene
    longer = simulate(scene, 2.0, to=path, resume=True).load()
    assert longer.scene == so_far.scene and view(longer).motion.end == 2.0


def test_c_functions_and_notes_are_left_out(tmp_path: Path) -> None:
    """Functions by name; notes are in the settings alone."""

    @ctypes.CFUNCTYPE(ctypes.c_int, *[ctypes.c_void_p] * 4)
    def function(*_: Any) -> int:
        return 0

    scene = pendulum()
    run = simulate(scene, 0.5)
    scene.add_force("ball", name="<gust>", force=function)
    result = Result.from_arrays(
        time=run.time, arrays=run.channels, coords=run.coords, stats=run.stats, about=run.about, scene=scene
    )
    loaded = Result.load(result.save(tmp_path / "run.nc"))
    assert str(loaded.stats[NOT_KEPT]).startswith("function force '<gust>'")
    assert loaded.scene == pendulum().copy(notes={}) and loaded.settings["notes"] == {"project": "secret"}


def test_a_scene_too_large_for_a_file_is_left_out(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(about, "LARGEST_FILE", 100)
    loaded = Result.load(simulate(pendulum(), 0.5).save(tmp_path / "run.nc"))
    assert loaded.scene is None
    with pytest.raises(SceneError, match=r"takes \d+ bytes, above 100"):
        view(loaded)
    told = simulate(pendulum(), 0.5, to=tmp_path / "streamed.nc")
    assert str(told.load().stats[NOT_KEPT]).startswith("the scene: takes")


HOSTILE: list[tuple[Any, str]] = [
    (b"\x00\xff\xfe" * 20, r"run\.nc: its scene"), (b"{}", "is not a scene file"),
    (b"[" * 100_000, r"run\.nc: its scene"),
    (b'{"format": "seacrane scene", "format": 1}', "occurs twice"), (b'{"mass": NaN}', "NaN is not a number"),
    ((b'"mass": 1.0', b'"mass": "heavy"'), r"bodies\[0\]\.mass is 'heavy'"),
    ((b'"ball"', b'"cube"'), "'ball', 'cube'"),
]  # fmt: skip


@pytest.mark.parametrize(("text", "message"), HOSTILE)
def test_hostile_bytes_are_refused(text: Any, message: str, tmp_path: Path) -> None:
    if isinstance(text, tuple):  # of a sound one
        pendulum().save(tmp_path / "scene.json")
        text = json.dumps(json.loads((tmp_path / "scene.json").read_text())).encode().replace(*text)
    loaded = Result.load(with_scene(tmp_path / "run.nc", text))
    assert loaded["position"].shape[1] == 1
    with pytest.raises((FileFormatError, SceneError), match=message) as caught:
        view(loaded)
    assert len(str(caught.value)) < 500


def test_a_scene_that_unfolds_is_refused_before_it_is_read(tmp_path: Path) -> None:
    """A quarter of a gigabyte of nothing in a small file."""
    path = with_scene(tmp_path / "run.nc", b"{}")
    with netCDF4.Dataset(path, "a") as file:
        file.renameVariable(SCENE, "old")
    with netCDF4.Dataset(path, "a") as file:
        file.createDimension("many", 2**28)
        file.createVariable(SCENE, "u1", ("many",), zlib=True, chunksizes=(2**20,))[:8] = 1
    assert path.stat().st_size < 2**20
    tracemalloc.start()
    with pytest.raises(FileFormatError, match="scene_json has 268435456 bytes"):
        Result.load(path)
    assert tracemalloc.get_traced_memory()[1] < 64 * 2**20
    tracemalloc.stop()


def test_the_command_writes_the_page_of_a_result(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    source, page = alone().save(tmp_path / "run.nc"), tmp_path / "page.html"
    assert main(["view", str(source), "--out", str(page)]) == 0
    assert page.read_text(encoding="utf-8") == view(alone()).html
    page.write_text("mine")
    assert main(["view", str(source), "--out", str(page)]) == 1
    assert "--overwrite" in capsys.readouterr().err and page.read_text() == "mine"
    few = simulate(cases.vessel(), 1.0, channels=["vessel_motion"]).save(tmp_path / "few.nc")
    assert main(["view", str(few), "--out", str(tmp_path / "few.html")]) == 1
    assert "position, quaternion" in capsys.readouterr().err and not (tmp_path / "few.html").exists()
    assert main(["view", "vessel", "--out", str(page), "--overwrite"]) == 0
    assert page.read_text(encoding="utf-8") == view(cases.vessel()).html
