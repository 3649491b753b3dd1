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


def test_work_is_quadratic_and_grows_with_the_fourth_power_of_size() -> None:
    one = section_eddy_damping(**BOX)
    for changes, factor in (
        ({"amplitude_deg": 20.0}, 2.0), ({"omega": 10.0, "rho": 2050.0}, 4.0),
        ({"breadth": 0.56, "draught": 0.224}, 16.0),
    ):  # fmt: skip
        assert section_eddy_damping(**(BOX | changes)) == pytest.approx(factor * one)
    round_one = eddy_coefficient(half=1.0, area=0.25 * np.pi, depth=0.0, radius=1.0)
    assert abs(round_one) < 0.01 * eddy_coefficient(half=1.0, area=1.0, depth=0.0, radius=0.0)
    bilge = BOX | {"area_coefficient": 0.99}
    sizes = [section_eddy_damping(**(bilge | {"bilge_radius": radius})) for radius in (0.0, 0.02, 0.04)]
    assert sizes[0] > sizes[1] > sizes[2] > 0.0


def test_numbers_of_the_method() -> None:
    """By a second writing of the same equations, over full Lewis coefficients."""
    for half, area, radius, expected in (
        (1.25, 1.0, 0.0, 7.111), (1.25, 0.995, 0.02 / 0.112, 0.9410), (0.772, 0.541, 0.7720, 0.3078),
    ):  # fmt: skip
        found = eddy_coefficient(half=half, area=area, depth=0.0, radius=radius)
        assert found == pytest.approx(expected, rel=2e-3)


def test_what_makes_no_section_is_refused() -> None:
    for changes, words in (
        ({"area_coefficient": 1.1}, "is 1.1"), ({"axis_height": -0.2}, "axis above the keel"),
        ({"area_coefficient": 0.5, "axis_height": -0.07}, "raise the axis"), ({"breadth": 0.0}, "breadth"),
        ({"bilge_radius": -0.1}, "bilge_radius is -0.1"),
    ):  # fmt: skip
        with pytest.raises(SceneError, match=words):
            section_eddy_damping(**(BOX | changes))
