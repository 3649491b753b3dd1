"""Parametric hull: volume, hydrostatics, closed mesh."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from seacrane.hydro.hull.hydrostatics import panel_hydrostatics
from seacrane.hydro.hull.parametric_hull import ParametricHull

RHO, G = 1025.0, 9.81
VOLUME = 14.0e6 / RHO
HULL = ParametricHull(
    length=115.0,
    breadth=25.0,
    draught=6.4,
    entrance_length=40.0,
    run_length=34.5,
    transom_breadth_fraction=0.75,
    transom_draught_fraction=0.2,
    section_exponent=6.0,
)


@pytest.mark.parametrize(("stations", "girth"), [(16, 4), (30, 9)])
def test_the_solved_mesh_encloses_the_volume_with_its_centre_at_the_origin(stations: int, girth: int) -> None:
    hull = HULL.scaled_to_volume(VOLUME, stations=stations, girth=girth)
    statics = panel_hydrostatics(hull.panels(stations=stations, girth=girth))
    assert statics.volume == pytest.approx(VOLUME, rel=1e-12)
    assert statics.center_of_buoyancy[:2] == pytest.approx([0.0, 0.0], abs=1e-9)


def test_main_dimensions() -> None:
    points = HULL.panels(stations=56, girth=20).reshape(-1, 3)
    assert np.ptp(points, axis=0) == pytest.approx([115.0, 25.0, 6.4], rel=2e-3)
    assert points[:, 2].max() == 0.0


def test_the_mesh_is_closed_by_the_waterplane_and_points_outwards() -> None:
    panels = HULL.panels(stations=24, girth=6)
    triangles = np.concatenate([panels[:, [0, 1, 2]], panels[:, [0, 2, 3]]])
    area = 0.5 * np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    assert area.sum(axis=0)[:2] == pytest.approx([0.0, 0.0], abs=1e-9)
    assert -area.sum(axis=0)[2] == pytest.approx(panel_hydrostatics(panels).waterplane_area)
    assert np.all(np.linalg.norm(area, axis=1) > 1e-4)


def test_hydrostatics_of_a_box_in_closed_form() -> None:
    """A 40 x 10 x 4 m box: volume 1600 m3, BM_T = B^2 / 12 T, BM_L = L^2 / 12 T."""
    x, y, z = np.array([-20.0, 20.0]), np.array([-5.0, 5.0]), -4.0
    corner = [(x[0], y[0]), (x[1], y[0]), (x[1], y[1]), (x[0], y[1])]
    faces = [
        [(*corner[i], z), (*corner[(i + 1) % 4], z), (*corner[(i + 1) % 4], 0.0), (*corner[i], 0.0)]
        for i in range(4)
    ]
    faces.append([(*corner[i], z) for i in (0, 3, 2, 1)])
    statics = panel_hydrostatics(np.array(faces))
    assert statics.volume == pytest.approx(1600.0)
    assert statics.center_of_buoyancy == pytest.approx([0.0, 0.0, -2.0], abs=1e-12)
    restoring = statics.restoring(rho=RHO, g=G, center_of_gravity_z=1.0)
    weight = RHO * G * 1600.0
    assert restoring[2, 2] == pytest.approx(RHO * G * 400.0)
    assert restoring[3, 3] == pytest.approx(weight * (100.0 / 48.0 - 3.0))
    assert restoring[4, 4] == pytest.approx(weight * (1600.0 / 48.0 - 3.0))


def test_heave_pitch_coupling_has_the_sign_of_the_waterplane_lever() -> None:
    """Flotation centre aft of the origin (x < 0): C35 = -rho g integral b x dx is positive."""
    hull = HULL.scaled_to_volume(VOLUME, stations=16, girth=5)
    statics = panel_hydrostatics(hull.panels(stations=16, girth=5))
    assert statics.waterplane_moment_x < 0.0
    assert statics.restoring(rho=RHO, g=G, center_of_gravity_z=0.0)[2, 4] > 0.0


def test_the_mesh_converges_to_the_smooth_hull_at_second_order() -> None:
    def volume(factor: int) -> float:
        return panel_hydrostatics(HULL.panels(stations=16 * factor, girth=5 * factor)).volume

    coarse, middle, fine = volume(1), volume(2), volume(4)
    assert 2.5 < (middle - coarse) / (fine - middle) < 6.0


def test_a_volume_out_of_reach_is_refused() -> None:
    with pytest.raises(ValueError, match="out of reach"):
        HULL.scaled_to_volume(115.0 * 25.0 * 6.4, stations=16, girth=4)
    with pytest.raises(ValueError, match="out of reach"):
        replace(HULL, section_exponent=1.0).scaled_to_volume(VOLUME, stations=16, girth=4)
