"""What contacts carried, in every answer; what they press on, in pictures."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import numpy as np
import pytest

from seacrane import Result, Scene, report, simulate, summary, view
from seacrane.answers import contact_hits
from seacrane.pictures.shapes import BoxShape, MeshShape, TubeShape

FEET = [(x, y, -0.5) for x in (-0.5, 0.5) for y in (-0.5, 0.5)]


def landing() -> Scene:
    """A box that falls by half a metre onto a barge, between a post, a pipe and a block on the ground."""
    scene = Scene(name="landing")
    scene.add_body("barge", mass=1e6, size=(30, 10, 4))
    scene.add_joint("moored", kind="weld", first="ground", second="barge")
    scene.add_body("box", mass=1e3, size=(1, 1, 1), position=(0, 0, 3.0))
    post = {"surface": "post", "place": (-1.0, 0, 4), "size": (0.4, 4.0)}
    pipe = {"surface": "pipe", "place": (0, 5.0, 4), "size": (1, 1.2, 3)}
    block = {"surface": "box", "place": (2.0, 0, 4), "size": (1, 2, 3), "stiffness": 1e5}
    scene.add_contact("box", on="barge", points=FEET, place=(0, 0, 2.0), name="deck")
    scene.add_contact("box", on="barge", points=[(-0.5, 0, 0)], name="guide", **post)
    scene.add_contact("box", on="barge", points=[(0, 0.5, 0)], name="pipe", **pipe)
    scene.add_contact("box", on="ground", points=[(0.5, 0, 0)], name="bumper", **block)
    return scene


@cache
def landed() -> Result:
    return simulate(landing(), 2.0, dt_out=0.01)


def test_a_landing_tells_its_loads_speeds_and_rehits() -> None:
    told, hits = summary(landed()).contacts["deck"], contact_hits(landed(), "deck")
    assert told.peak == max(hit.peak for hit in hits) and told.speed == max(hit.speed for hit in hits)
    assert told.speed == pytest.approx(np.sqrt(2.0 * 9.80665 * 0.5), rel=1e-3)
    assert told.rehits == sum(hit.number > 1 for hit in hits) > 0
    assert told.first == min(hit.begin for hit in hits)
    assert np.isnan(summary(landed()).contacts["guide"].first)


def test_every_answer_tells_them(tmp_path: Path) -> None:
    peak = f"{summary(landed()).contacts['deck'].peak / 1e3:.1f}"
    loaded = Result.load(landed().save(tmp_path / "landing.nc"))
    for page in (report(landed()).html, view(landed()).html, str(summary(loaded))):
        assert "deck" in page and peak in page


def test_what_contacts_press_on_is_drawn_where_it_is() -> None:
    drawn = {wheel.name: wheel for wheel in view(landed()).drawing.wheels}
    kinds = {"deck": BoxShape, "guide": TubeShape, "pipe": MeshShape, "bumper": BoxShape}
    assert {name: type(one.shapes[0]) for name, one in drawn.items()} == kinds
    assert drawn["bumper"].at == [-1, 2.0, 0.0, 4.0] and drawn["guide"].at == [0, -1.0, 0.0, 4.0]
    deck = drawn["deck"].shapes[0].points
    assert deck[:, 2].max() == pytest.approx(0.0) and np.ptp(deck, axis=0)[0] == pytest.approx(3.0)
    pipe = np.hypot(*drawn["pipe"].shapes[0].points[:, :2].T)
    assert (pipe.min(), pipe.max()) == pytest.approx((0.5, 0.6))
