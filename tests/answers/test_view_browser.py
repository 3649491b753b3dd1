"""The pages of `view` in a browser: they open from disk, ask for nothing, complain of nothing, and show the
run. `make test` looks at one page, `make nightly` at all; skipped where there is no Chromium."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import chromium
import numpy as np
import pytest
import view_scenes
from view_scenes import angle_between, case2

from seacrane import view
from seacrane.pictures import View

SHOWN = ("case2", pytest.param("pair", marks=pytest.mark.slow("opens a page")))


@pytest.fixture(scope="module")
def tab() -> Iterator[chromium.Tab]:
    with chromium.tab() as opened:
        yield opened


def opened(tab: chromium.Tab, shown: View, folder: Path, address: str = "") -> None:
    """The page from disk, in a browser that has forgotten the one before."""
    tab.requests.clear()
    tab.errors.clear()
    path = shown.save(folder / "page.html")
    tab.open(path.as_uri() + address)
    assert tab.errors == []
    assert tab.requests == [path.as_uri()]
    assert tab.value("document.documentElement.dataset.ready") == "true"


@pytest.mark.parametrize("name", SHOWN)
def test_a_page_opens_without_a_network(tab: chromium.Tab, name: str, tmp_path: Path) -> None:
    opened(tab, view(getattr(view_scenes, name)()), tmp_path)
    pictures = []
    for at in (0.0, 4.0):
        tab.value(f"seacrane.seek({at})")
        pictures.append(tab.colours()[:, 80:500, 400:880])
    assert pictures[0].reshape(3, -1).std(axis=1).min() > 10.0, "the picture is of one colour"
    assert np.abs(pictures[1] - pictures[0]).mean() > 1.0, "nothing moves"
    assert tab.errors == []


@pytest.mark.slow("opens a page")
def test_the_page_moves_bodies_and_waves_as_the_run_did(tab: chromium.Tab, tmp_path: Path) -> None:
    result = case2()
    opened(tab, view(result), tmp_path)
    for body in ("vessel", "knuckle_jib", "payload"):
        for index in (0, 137, 333, 600):
            pose = np.array(tab.value(f"seacrane.pose({json.dumps(body)}, {result.time[index]})"))
            np.testing.assert_allclose(pose[:3], result.select("position", body=body)[index], atol=1e-3)
            assert angle_between(pose[3:], result.select("quaternion", body=body)[index]) < 1e-4
    waves = result.scene.waves.components()
    for time, x, y in ((0.0, 0.0, 0.0), (31.7, 12.0, -40.0), (10000.3, -60.0, 5.0)):
        expected = float(waves.elevation(time, x=x, y=y))
        assert tab.value(f"seacrane.elevation({x}, {y}, {time})") == pytest.approx(expected, abs=1e-3)
