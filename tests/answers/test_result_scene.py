"""A result's file holds the scene that was run: pages are drawn from the file alone, damage is refused."""

from __future__ import annotations

import ctypes
import json
import re
import tracemalloc
from dataclasses import replace
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import pytest
from view_scenes import alone

from seacrane import (
    FileFormatError,
    Result,
    Scene,
    SceneError,
    cases,
    report,
    simulate,
    simulate_to_file,
    view,
)
from seacrane.cli.command_line import main
from seacrane.result import kept_scene
from seacrane.result.kept_scene import NOT_KEPT
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


def with_scene(path: Path, text: bytes, kind: str = "u1") -> Path:
    """A result's file whose scene is this text."""
    result = simulate(pendulum(), 0.5)
    bare = Result.from_arrays(
        time=result.time, arrays=result.channels, coords=result.coords, stats=result.stats, about=result.about
    )
    bare.save(path)
    with netCDF4.Dataset(path, "a") as file:
        file.createDimension(SCENE_DIMENSION, len(text))
        file.createVariable(SCENE, kind, (SCENE_DIMENSION,))[:] = np.frombuffer(text, "u1")
    return path


def test_a_page_is_drawn_from_the_file_alone(tmp_path: Path) -> None:
    loaded = Result.load(alone().save(tmp_path / "run.nc"))
    assert isinstance(loaded.scene, Scene)
    assert loaded.scene == alone().scene
    assert view(loaded).html == view(alone()).html
    again = Result.load(loaded.save(tmp_path / "again.nc"))
    assert again.scene == alone().scene
    assert "<h2>In three dimensions</h2>" in report(loaded).html


def test_a_run_to_a_file_keeps_its_scene_while_it_goes_on_and_when_it_is_resumed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path, scene = tmp_path / "run.nc", pendulum()
    with monkeypatch.context() as patch:
        patch.setattr(ResultFile, "finish", lambda self, reached_end: self._partial.path)
        partial = simulate_to_file(scene, path, 1.0, checkpoint_every=0.3).path
    assert partial.suffix == ".partial"
    so_far = Result.load(partial)
    assert so_far.scene == scene.copy(notes={})
    assert partial.read_bytes().count(b'"seacrane scene"') == 1
    simulate_to_file(scene, path, 1.0, resume=True)
    finished = Result.load(path)
    assert finished.scene == so_far.scene
    longer = simulate_to_file(scene, path, 2.0, resume=True).load()
    assert longer.time[-1] == 2.0
    assert longer.scene == so_far.scene
    assert view(longer).motion.end == 2.0


def test_notes_are_in_the_settings_alone(tmp_path: Path) -> None:
    loaded = Result.load(simulate(pendulum(), 0.5).save(tmp_path / "run.nc"))
    assert loaded.scene is not None
    assert loaded.scene.notes == {}
    assert loaded.settings["notes"] == {"project": "secret"}


def test_what_is_changed_in_the_scene_of_a_result_is_saved(tmp_path: Path) -> None:
    loaded = Result.load(simulate(pendulum(), 0.5).save(tmp_path / "run.nc"))
    assert loaded.scene is not None
    loaded.scene.add_mesh(body="ball", vertices=np.eye(3), faces=[[0, 1, 2]])
    again = Result.load(loaded.save(tmp_path / "again.nc")).scene
    assert again is not None
    assert list(again.meshes) == ["ball"]


def test_a_scene_from_a_file_runs_as_it_ran(tmp_path: Path) -> None:
    result = Result.load(alone().save(tmp_path / "run.nc"))
    assert result.scene is not None
    again = simulate(result.scene, 20.0)
    np.testing.assert_array_equal(again["position"], result["position"])


def without_scene(path: Path) -> Path:
    """A file of a run whose scene was too large for one."""
    return replace(alone(), kept_scene=None).save(path)


def test_a_file_without_a_scene_says_so(tmp_path: Path) -> None:
    result = Result.load(without_scene(tmp_path / "bare.nc"))
    assert result.scene is None
    with pytest.raises(
        SceneError, match=r"file that holds no scene; give its scene with view\(result, scene="
    ):
        view(result)


def test_c_functions_are_left_out_by_name(tmp_path: Path) -> None:
    @ctypes.CFUNCTYPE(ctypes.c_int, *[ctypes.c_void_p] * 4)
    def function(*_: Any) -> int:
        return 0

    address = ctypes.cast(function, ctypes.c_void_p).value
    assert address is not None
    scene = pendulum()
    run = simulate(scene, 0.5)
    scene.add_function_force(name="<gust>", body="ball", address=address)
    arrays = {"arrays": run.channels, "coords": run.coords, "stats": run.stats}
    result = Result.from_arrays(time=run.time, **arrays, scene=scene)
    loaded = Result.load(result.save(tmp_path / "run.nc"))
    assert loaded.stats[NOT_KEPT] == "function force '<gust>': a file holds data only"
    assert loaded.scene == pendulum().copy(notes={})
    assert "<td>function force &#x27;&lt;gust&gt;&#x27;: a file holds data only</td>" in view(loaded).html
    assert "left out" not in view(run).html


def test_a_scene_too_large_for_a_file_is_left_out_with_its_reason(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(kept_scene, "LARGEST_FILE", 100)
    loaded = Result.load(simulate(pendulum(), 0.5).save(tmp_path / "run.nc"))
    assert loaded.scene is None
    with pytest.raises(SceneError, match=r"holds no scene \('the scene: takes \d+ bytes, above 100'\)"):
        view(loaded)
    assert "In three dimensions" not in report(loaded).html
    told = simulate_to_file(pendulum(), tmp_path / "streamed.nc", 0.5)
    assert str(told.load().stats[NOT_KEPT]).startswith("the scene: takes")


HOSTILE = {
    "no JSON": (b"\x00\xff\xfe" * 20, r"run\.nc: its scene"),
    "no scene": (b"{}", "is not a scene file"),
    "nested": (b"[" * 100_000, r"run\.nc: its scene: (is nested too deeply|its lists)"),
    "repeated": (b'{"format": "seacrane scene", "format": 1}', "occurs twice"),
    "no number": (b'{"mass": NaN}', "NaN is not a number"),
}


@pytest.mark.parametrize("case", HOSTILE)
def test_hostile_bytes_are_refused_once_they_are_asked_for(case: str, tmp_path: Path) -> None:
    text, message = HOSTILE[case]
    loaded = Result.load(with_scene(tmp_path / "run.nc", text))
    assert loaded["position"].shape[1] == 1
    for ask in (lambda: loaded.scene, lambda: view(loaded), lambda: report(loaded)):
        with pytest.raises(FileFormatError, match=message) as caught:
            ask()
        assert len(str(caught.value)) < 500


def test_an_element_that_makes_no_sense_is_named(tmp_path: Path) -> None:
    path = simulate(pendulum(), 0.5).save(tmp_path / "sound.nc")
    with netCDF4.Dataset(path) as file:
        data = json.loads(bytes(file[SCENE][:]))
    data["bodies"][0]["mass"] = "heavy"
    loaded = Result.load(with_scene(tmp_path / "run.nc", json.dumps(data).encode()))
    with pytest.raises(FileFormatError, match=re.escape("run.nc: its scene.bodies[0].mass is 'heavy'")):
        view(loaded)


def test_a_scene_larger_than_any_is_not_parsed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("seacrane.description.file_text.LARGEST_FILE", 1000)
    loaded = Result.load(with_scene(tmp_path / "run.nc", b"{" + b" " * 2000 + b"}"))
    with pytest.raises(FileFormatError, match="has 2002 bytes, above 1000"):
        view(loaded)


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
    with pytest.raises(FileFormatError, match="its scene_json has 268435456 bytes, above"):
        Result.load(path)
    assert tracemalloc.get_traced_memory()[1] < 64 * 2**20
    tracemalloc.stop()


def test_a_scene_that_is_no_bytes_is_refused(tmp_path: Path) -> None:
    with pytest.raises(FileFormatError, match="its scene_json is of float64, not bytes"):
        Result.load(with_scene(tmp_path / "run.nc", b"{}", "f8"))


def test_a_scene_of_other_bodies_is_refused(tmp_path: Path) -> None:
    path = simulate(pendulum(), 0.5).save(tmp_path / "sound.nc")
    with netCDF4.Dataset(path) as file:
        text = bytes(file[SCENE][:]).replace(b'"ball"', b'"cube"')
    loaded = Result.load(with_scene(tmp_path / "run.nc", text))
    with pytest.raises(SceneError, match="is not the one of the result: 'ball', 'cube' are only in one"):
        view(loaded)


def test_the_command_writes_the_page_of_a_result(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    source, page = alone().save(tmp_path / "run.nc"), tmp_path / "page.html"
    assert main(["view", str(source), "--out", str(page)]) == 0
    assert f"saved {page}" in capsys.readouterr().out
    assert page.read_text(encoding="utf-8") == view(alone()).html
    page.write_text("mine")
    assert main(["view", str(source), "--out", str(page)]) == 1
    assert "is there already; give another name, or --overwrite" in capsys.readouterr().err
    assert page.read_text() == "mine"
    assert main(["view", "vessel", "--out", str(page), "--overwrite"]) == 0
    assert page.read_text(encoding="utf-8") == view(cases.vessel()).html
    assert main(["view", "vessel", "--out", str(tmp_path), "--overwrite"]) == 1
    assert "is a folder; name the page" in capsys.readouterr().err


def test_the_command_says_what_is_missing(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    page = tmp_path / "page.html"
    assert main(["view", str(without_scene(tmp_path / "bare.nc")), "--out", str(page)]) == 1
    assert "holds no scene" in capsys.readouterr().err
    few = simulate(cases.vessel(), 1.0, channels=["vessel_motion"]).save(tmp_path / "few.nc")
    assert main(["view", str(few), "--out", str(page)]) == 1
    assert "does not hold position, quaternion, velocity, angular_velocity" in capsys.readouterr().err
    (tmp_path / "script.py").write_text("raise SystemExit")
    assert main(["view", str(tmp_path / "script.py"), "--out", str(page)]) == 1
    assert "only `seacrane run` executes scripts" in capsys.readouterr().err
    assert not page.exists()
