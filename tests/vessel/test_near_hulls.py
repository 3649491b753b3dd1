"""A part of a load beside a ship in a sea is told: distance and breadth, once for each ship."""

from __future__ import annotations

import re
import warnings
from typing import Any

import numpy as np
import pytest

from seacrane import Scene, SceneError, simulate
from seacrane.description.outline import ship_size
from seacrane.hydro import shipped_database
from seacrane.run import Run
from seacrane.warnings import ScatteredWavesWarning
from seacrane.water import BoxPart, SpherePart


def lowered(
    *, y: float, x: float = 0.0, z: float = -3.0, hs: float | None = 2.0, heading: float = 0.0, **more: Any
) -> Scene:
    """A load in the water beside the shipped hull, y and x in her axes."""
    scene = Scene(name="lowered")
    scene.add_vessel(shipped_database(), position=(40.0, -20.0, 0.0), heading_deg=heading)
    if hs is not None:
        scene.add_sea(hs=hs, tp=9.0, direction_deg=150.0, seed=2)
    turn = np.radians(heading)
    place = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]]) @ [x, y] + [40.0, -20.0]
    scene.add_body(name="load", mass=9e3, inertia=(9e3, 9e3, 9e3), position=(*place, z))
    scene.add_immersed(
        "load", parts=[SpherePart(diameter=2.0, point=(0.0, 0.0, dz)) for dz in (0.0, 4.0)], **more
    )
    return scene


def told(scene: Scene) -> list[str]:
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        Run(scene, 1.0)
    return [str(one.message) for one in caught if one.category is ScatteredWavesWarning]


def breadth() -> float:
    scene = lowered(y=50.0)
    return ship_size(scene.bodies["vessel"])[1]


@pytest.mark.parametrize("heading", [0.0, 65.0])
def test_a_part_within_a_breadth_is_told_with_both_lengths(heading: float) -> None:
    wide = breadth()
    (message,) = told(lowered(y=-(0.5 * wide + 6.0), heading=heading))
    away, across = (float(one) for one in re.findall(r"(\S+) m\b", message)[:2])
    assert away == pytest.approx(6.0, abs=0.01)
    assert across == pytest.approx(wide, rel=1e-2)
    assert re.search(r"'load\.[12]'.*side of 'vessel'", message)


@pytest.mark.parametrize(
    ("place", "near"),
    [
        ({"y": 0.0}, True),  # through a moonpool
        ({"y": 1.45}, True),  # of the breadth, from the centre plane
        ({"y": 1.55}, False),
        ({"y": 1.45, "hs": None}, False),
        ({"y": 0.0, "x": 1000.0}, False),
        ({"y": 1.0, "z": -200.0}, False),  # where hardly a wave is left
    ],
)
def test_it_is_told_where_it_counts(place: dict[str, Any], near: bool) -> None:
    given = {**place, "y": place["y"] * breadth()}
    assert bool(told(lowered(**given))) == near


def test_a_factor_that_is_stated_is_not_told_and_multiplies_the_waves() -> None:
    """Half of the waves twice is the waves: a load far from all hulls, in a linear sea."""
    assert told(lowered(y=0.0))
    assert not told(lowered(y=0.0, wave_factor=1.3))
    half, whole = (
        simulate(lowered(y=500.0, hs=hs, wave_factor=factor), 5.0, channels=["position"], rtol=1e-9)
        for hs, factor in ((4.0, 0.5), (2.0, 1.0))
    )
    one, other = (run.select("position", body="load") for run in (half, whole))
    assert one == pytest.approx(other, abs=1e-7)
    with pytest.raises(SceneError, match=r"wave_factor is -1"):
        lowered(y=0.0, wave_factor=-1.0)


def test_a_part_of_the_ship_herself_is_not_judged() -> None:
    scene = lowered(y=500.0)
    scene.add_immersed(
        "vessel", parts=[BoxPart(size=(4.0, 0.3, 0.3), fill=0.0, point=(0.0, 0.0, -4.0))], name="keel"
    )
    assert told(scene) == []
