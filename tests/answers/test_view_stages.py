"""What a stage does not have is not drawn in it: on pages, in models, in pictures."""

from __future__ import annotations

import json
from functools import lru_cache
from pathlib import Path

import chromium
import numpy as np
import pytest
from stage_scenes import HEIGHT, STIFFNESS, on_deck
from test_view_gltf import Model

from seacrane import Result, Stage, simulate, view
from seacrane.pictures.drawing import drawing_of

PULL = 25e3  # N


@lru_cache(maxsize=1)
def lifted() -> Result:
    """A spring that is connected at 1 s, and a hoist that is released at 2 s and taken again at 3 s."""
    scene = on_deck()
    scene.add_spring(name="tugger", first="ground", second="load", stiffness=1.0, natural_length=1.0,
                     first_point=(5.0, 0.0, 1.0))  # fmt: skip
    stages = [
        Stage(name="hold", duration=1.0),
        Stage(name="tug", duration=1.0, connect=["tugger"]),
        Stage(name="let go", duration=1.0, release=["hoist"]),
        Stage(name="take", duration=1.0, connect=["hoist"]),
    ]
    return simulate(scene, stages, dt_out=0.2)


def test_wires_are_absent_from_release_to_connection() -> None:
    drawing = drawing_of(lifted())
    tugger, hoist = drawing.wires
    assert [tugger["element"], hoist["element"]] == ["tugger", "hoist"]
    times = np.array([0.0, 0.9, 1.1, 1.9, 2.1, 2.9, 3.1, 4.0])
    assert drawing.absent(tugger, times).tolist() == [True, True, *[False] * 6]
    assert drawing.absent(hoist, times).tolist() == [*[False] * 4, True, True, False, False]
    assert [wire["absent"] for wire in drawing_of(lifted().scene).wires] == [[], []]


def test_models_have_no_wire_where_there_is_none(tmp_path: Path) -> None:
    times, scale, _ = Model(view(lifted()).save_gltf(tmp_path / "lift.glb")).track("hoist 1", "scale")
    gone = (times > 2.0 + 1e-6) & (times < 3.0 - 1e-6)
    assert gone.any() and np.all(scale[gone] < 1e-4)
    assert np.all(scale[times < 1.9][:, :2] == 1.0) and np.all(scale[times < 1.9][:, 2] > 19.0)


def marked() -> Result:
    """Two stages, a named point 3 m beside a box on the ground, and a line that pulls at a seat."""
    scene = on_deck(length=HEIGHT / (1.0 + PULL / STIFFNESS))
    scene.add_point(name="corner", body="load", point=(1.0, 0.0, 0.0))
    scene.add_channel("mast", points=["corner"], center=(5.0, 0.0, 1.0), size=(2.0, 2.0, 4.0))
    stages = [Stage(name="hold", duration=1.0), Stage(name="wait", duration=1.0)]
    return simulate(scene, stages, dt_out=0.2)


def test_stages_points_clearances_and_forces_are_on_the_page() -> None:
    data = json.loads(view(marked()).html.split('id="data">')[1].split("</script>")[0])
    assert data["stages"] == [["hold", 0.0, 1.0], ["wait", 1.0, 2.0]]
    assert data["points"] == [{"name": "corner", "at": [0, 1.0, 0.0, 0.0]}]
    assert data["clearances"] == [
        {"name": "mast", "points": [[0, 1.0, 0.0, 0.0]], "at": [-1, 5.0, 0.0, 1.0], "size": [2.0, 2.0, 4.0]}
    ]
    (wire,) = data["wires"]
    assert 40e9 * (2.0 * wire["size"]) ** 2 == pytest.approx(STIFFNESS)


@pytest.mark.slow("opens pages")
def test_pages_tell_stage_clearance_and_tension_and_hide_what_is_absent(tmp_path: Path) -> None:
    with chromium.tab() as tab:
        tab.open(view(marked()).save(tmp_path / "page.html").as_uri())
        tab.value("seacrane.seek(1.5)")
        assert tab.value("seacrane.stage()") == "wait, 1.50 s"
        assert tab.value("seacrane.clearance('mast')") == pytest.approx(3.0, abs=1e-3)
        assert tab.value("seacrane.wire('hoist 1')") == f"hoist 1 {PULL / 1e3:g} kN"
        tab.open(view(lifted()).save(tmp_path / "lifted.html").as_uri())
        for time, absent in ((0.5, ["tugger"]), (1.5, []), (2.5, ["hoist 1"]), (4.0, [])):
            tab.value(f"seacrane.seek({time})")
            assert tab.value("seacrane.absent()") == absent
        assert tab.errors == []
