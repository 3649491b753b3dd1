"""Sections sliced from hulls."""

from __future__ import annotations

import numpy as np
import pytest
from hull_shapes import box, joined, moved, sphere, wigley_mesh, wigley_offsets

from seacrane.hydro import Hull, OffsetTable

SHIP = (100.0, 16.0, 6.0)


def half_area(section: np.ndarray) -> float:
    return float(-np.trapezoid(section[:, 0], section[:, 1]))


def test_slices_of_mesh_and_offsets_have_the_area_of_the_closed_form() -> None:
    """Wigley: half area B T / 3 (1 - (2x/L)^2) at every station."""
    length, breadth, draught = SHIP
    x = np.linspace(-0.47, 0.47, 13) * length
    exact = breadth * draught / 3.0 * (1.0 - (2.0 * x / length) ** 2)
    vertices, faces = wigley_mesh(*SHIP, 40)
    mesh, table = Hull.from_mesh(vertices=vertices, faces=faces), Hull.from_offsets(wigley_offsets(*SHIP, 40))
    for hull in (mesh, table):
        cut = hull.sections(x)
        assert [half_area(s.section) for s in cut] == pytest.approx(exact, abs=1e-3 * exact.max())
        for s in cut:
            assert s.apart == s.section[0, 1] == s.section[-1, 0] == 0.0
            assert np.all(np.diff(s.section[:, 1]) <= 1e-9)
    hull = Hull.from_offsets(wigley_offsets(*SHIP, 8))
    x = np.linspace(-50.0, 50.0, 33)  # the table's stations, straight between them, and the middles
    areas = np.array([2.0 * half_area(s.section) for s in hull.sections(x)])
    # Between stations the area of a straight loft is quadratic: Simpson's rule gives the surface's volume.
    simpson = np.sum(areas[:-1:2] + 4.0 * areas[1::2] + areas[2::2]) * 100.0 / 16.0 / 6.0
    assert simpson == pytest.approx(hull.hydrostatics.volume, rel=1e-9)
    stem = hull.sections([50.0])[0].section
    assert np.all(stem[:, 0] == 0.0) and stem[-1, 1] == pytest.approx(-6.0)


def test_a_bottom_that_rises_to_the_waterline_ends_in_an_empty_section() -> None:
    """The bottom of a barge rises straight from 4 m depth at x = 0 to 1 m above the waterline at x = 25 m."""
    deep = [[5.0, 2.0], [5.0, -4.0]]
    table = OffsetTable(x=[-20.0, 0.0, 25.0], sections=(deep, deep, [[5.0, 2.0], [5.0, 1.0]]))
    hull = Hull.from_offsets(table)
    assert hull.extent[:, 0] == pytest.approx([-20.0, 20.0])
    assert hull.hydrostatics.volume == pytest.approx(20.0 * 40.0 + 0.5 * 20.0 * 40.0)
    cut = hull.sections([-20.0, -19.9, 10.0, 20.0])
    assert [half_area(s.section) for s in cut] == pytest.approx([20.0, 20.0, 10.0, 0.0])
    assert np.all(cut[-1].section == 0.0)


def test_a_bulb_ahead_of_the_stem_hangs_apart() -> None:
    """A sphere of radius 1.5 m wholly under water, 4 m ahead of a box; two hulls beside each other."""
    bulb = moved(sphere(1.5, 48), 24.0, 0.0, -2.5)
    vertices, faces = joined(box(length=40.0, breadth=10.0, bottom=-4.0, top=3.0), bulb)
    hull = Hull.from_mesh(vertices=vertices, faces=faces)
    ahead, inside = hull.sections([24.0, 0.0])
    assert np.all(ahead.section == 0.0)
    assert ahead.apart == pytest.approx(0.5 * np.pi * 1.5**2, rel=5e-3)
    assert inside.apart == 0.0
    with pytest.raises(ValueError, match="hangs apart"):
        hull.remeshed(stations=40, girth=6)
    one = box(length=40.0, breadth=3.0, bottom=-4.0, top=3.0)
    vertices, faces = joined(moved(one, 0.0, 5.0, 0.0), moved(one, 0.0, -5.0, 0.0))
    catamaran = Hull.from_mesh(vertices=vertices, faces=faces)
    assert catamaran.hydrostatics.volume == pytest.approx(2 * 480.0)
    with pytest.raises(ValueError, match="more than once"):
        catamaran.sections([0.0])


@pytest.mark.parametrize("away", [0.0, 1e-9, -1e-6])
def test_slices_next_to_the_vertices_of_a_fan(away: float) -> None:
    """Planes through and beside the pole of a sphere, where 48 panels meet, and all its other vertices."""
    vertices, faces = sphere(5.0, 48)
    hull = Hull.from_mesh(vertices=vertices, faces=faces, draught=4.0)
    x = np.unique(np.round(hull.panels[..., 0], 9))[1:-1] + away
    exact = [abs(25.0 - v**2) for v in x]
    for s, square in zip(hull.sections(x), exact, strict=True):
        radius, above = np.sqrt(square), 1.0  # height of the centre
        area = square * np.arccos(above / radius) - above * np.sqrt(square - above**2)
        assert 2.0 * half_area(s.section) == pytest.approx(area, abs=0.25)
