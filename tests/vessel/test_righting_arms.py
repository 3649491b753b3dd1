"""Righting arms against the formula of wall-sided hulls, by direct integration, and by their own work."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from seacrane.hydro import RightingArms, righting_arms

LENGTH, BREADTH, DEPTH, DRAUGHT = 100.0, 20.0, 14.0, 6.0
KG = 8.0
FACES = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]


def barge(**settings: Any) -> RightingArms:
    """A box, its origin on the waterline amidships."""
    corners = [(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (0.0, 1.0)]
    vertices = np.array(corners) * (LENGTH, BREADTH, DEPTH)
    given = {"center_of_gravity": (0.0, 0.0, KG - DRAUGHT), "draught": DRAUGHT, "heel_deg": 0.0}
    return righting_arms(vertices=vertices, **({"faces": FACES} | given | settings))


@pytest.mark.parametrize("trim", ["free", "fixed"])
def test_a_box_follows_the_formula_of_wall_sided_hulls_until_its_deck_is_wet(trim: str) -> None:
    """GZ = sin(phi) (GM + BM / 2 tan^2 phi), the sinkage of a box being that of its centre line."""
    least = min(DRAUGHT, DEPTH - DRAUGHT)
    edge = np.degrees(np.arctan(2.0 * least / BREADTH))
    heel = np.array([-25.0, -5.0, 0.0, 0.1, 10.0, 20.0, edge - 0.01])
    found = barge(heel_deg=heel, trim=trim)
    bm = BREADTH**2 / (12.0 * DRAUGHT)
    gm = 0.5 * DRAUGHT + bm - KG
    phi = np.radians(heel)
    assert_allclose(found.GM, gm, rtol=1e-12)
    assert found.volume == pytest.approx(LENGTH * BREADTH * DRAUGHT, rel=1e-12)
    assert_allclose(found.GZ, np.sin(phi) * (gm + 0.5 * bm * np.tan(phi) ** 2), atol=1e-9)
    assert_allclose(found.trim, 0.0, atol=1e-12)


def test_beyond_the_deck_edge_the_arm_is_that_of_the_immersed_polygon() -> None:
    """On a grid of points of the section, the waterline found by bisection; the formula is too large."""
    heel = np.radians(50.0)
    y, z = np.meshgrid(
        (np.arange(1600) + 0.5) / 1600 * BREADTH - 0.5 * BREADTH, (np.arange(1120) + 0.5) / 1120 * DEPTH
    )
    height = y * np.sin(heel) + (z - DRAUGHT) * np.cos(heel)
    level = np.quantile(height, DRAUGHT / DEPTH)
    wet = height < level
    across = (y * np.cos(heel) - (z - DRAUGHT) * np.sin(heel))[wet].mean()
    weight = -(KG - DRAUGHT) * np.sin(heel)
    found = barge(heel_deg=50.0)
    assert found.GZ[0] == pytest.approx(weight - across, abs=2e-3)
    assert found.sinkage[0] == pytest.approx(level, abs=0.02)


def test_free_trim_takes_work_off_a_wedge_whose_deck_is_wet() -> None:
    """A hull that is fuller aft trims as it heels, and rights itself less than one that is held."""
    vertices = np.array([[-50, -10, 0], [-50, 10, 0], [-50, 10, 14], [-50, -10, 14], [50, 0, 0], [50, 0, 14]])
    faces = [[0, 3, 2], [0, 2, 1], [0, 1, 4], [3, 5, 2], [0, 4, 5], [0, 5, 3], [1, 2, 5], [1, 5, 4]]
    settings: dict[str, Any] = {
        "vertices": vertices, "faces": faces, "draught": 6.0, "heel_deg": [0.0, 20.0, 40.0],
        "center_of_gravity": (-50.0 / 3.0, 0.0, 1.0),
    }  # fmt: skip
    free, fixed = righting_arms(**settings), righting_arms(trim="fixed", **settings)
    assert np.allclose(free.trim[:2], 0.0, atol=1e-9), "its sides are upright, its ends dip alike"
    assert abs(free.trim[2]) > 1e-3
    np.testing.assert_allclose(free.GZ[:2], fixed.GZ[:2], atol=1e-9)
    assert 1e-4 < fixed.GZ[2] - free.GZ[2] < 0.01


@pytest.mark.parametrize(
    ("given", "message"),
    [({"draught": 20.0}, "waterline"), ({"heel_deg": 91.0}, "90"), ({"faces": np.fliplr(FACES)}, "inwards")],
)
def test_what_makes_no_sense_is_told(given: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        barge(**given)
