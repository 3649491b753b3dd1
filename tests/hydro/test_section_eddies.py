"""Eddies of one section: limits that any section has, numbers of the method, what it refuses."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from seacrane import SceneError
from seacrane.hydro import section_eddy_damping
from seacrane.hydro.hull.section_eddies import eddy_coefficient

BOX: dict[str, Any] = {
    "breadth": 0.28, "draught": 0.112, "area_coefficient": 1.0, "amplitude_deg": 10.0, "omega": 5.0,
}  # fmt: skip


def test_a_round_section_that_rolls_about_its_centre_makes_hardly_any() -> None:
    round_one = eddy_coefficient(half=1.0, area=0.25 * np.pi, depth=0.0, radius=1.0)
    square = eddy_coefficient(half=1.0, area=1.0, depth=0.0, radius=0.0)
    assert abs(round_one) < 0.01 * square


def test_work_is_quadratic_and_grows_with_the_fourth_power_of_size() -> None:
    one = section_eddy_damping(**BOX)
    assert section_eddy_damping(**(BOX | {"amplitude_deg": 20.0})) == pytest.approx(2.0 * one)
    assert section_eddy_damping(**(BOX | {"omega": 10.0, "rho": 2050.0})) == pytest.approx(4.0 * one)
    twice = {"breadth": 0.56, "draught": 0.224}
    assert section_eddy_damping(**(BOX | twice)) == pytest.approx(16.0 * one)


@pytest.mark.parametrize(
    ("half", "area", "radius", "expected"),
    [(1.25, 1.0, 0.0, 7.111), (1.25, 0.995, 0.02 / 0.112, 0.9410), (0.772, 0.541, 0.7720, 0.3078)],
)
def test_numbers_of_the_method(half: float, area: float, radius: float, expected: float) -> None:
    """By a second writing of the same equations, over full Lewis coefficients."""
    assert eddy_coefficient(half=half, area=area, depth=0.0, radius=radius) == pytest.approx(
        expected, rel=2e-3
    )


def test_a_rounder_bilge_makes_fewer() -> None:
    sizes = [
        section_eddy_damping(**(BOX | {"area_coefficient": 0.99, "bilge_radius": radius}))
        for radius in (0.0, 0.02, 0.04)
    ]
    assert sizes[0] > sizes[1] > sizes[2] > 0.0


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"area_coefficient": 1.1}, "area_coefficient is 1.1"),
        ({"axis_height": -0.2}, "axis above the keel"),
        ({"area_coefficient": 0.5, "axis_height": -0.07}, "raise the axis"),
        ({"breadth": 0.0}, "breadth"),
        ({"omega": -1.0}, "omega"),
        ({"bilge_radius": -0.1}, "bilge_radius is -0.1"),
    ],
)
def test_what_makes_no_section_is_refused(changes: dict[str, Any], words: str) -> None:
    with pytest.raises(SceneError, match=words):
        section_eddy_damping(**(BOX | changes))
