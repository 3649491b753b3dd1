"""Hulls from every source: hydrostatics against closed forms, order of convergence, sections, bad files."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hull_shapes import ascii_stl, box, joined, moved, sphere, stl, wigley_mesh, wigley_offsets

from seacrane.errors import FileFormatError
from seacrane.hydro import Hull, Hydrostatics, OffsetTable, ParametricHull, read_offset_table, read_stl

RHO, G = 1025.0, 9.81
SHIP = (100.0, 16.0, 6.0)


def from_mesh(mesh: tuple[np.ndarray, np.ndarray], draught: float | None = None) -> Hull:
    return Hull.from_mesh(vertices=mesh[0], faces=mesh[1], draught=draught)


def values(statics: Hydrostatics) -> np.ndarray:
    inertia = [statics.waterplane_inertia_roll, statics.waterplane_inertia_pitch]
    return np.array([statics.volume, statics.center_of_buoyancy[2], statics.waterplane_area, *inertia])


def barge(half: Any, **given: Any) -> Hull:
    return Hull.from_offsets(OffsetTable(x=[-20.0, 20.0], sections=(half,) * 2), **given)


def test_box_of_a_mesh_and_of_two_stations() -> None:
    """40 x 10 m, draught 4 m, from its keel too: everything in closed form, to rounding."""
    mesh = box(length=40.0, breadth=10.0, bottom=-4.0, top=3.0)
    hulls = [from_mesh(mesh), from_mesh(moved(mesh, 0.0, 0.0, 6.5), draught=4.0)]
    hulls += [barge([[5.0, 3.0], [5.0, -4.0]]), barge([[0.0, 9.0], [5.0, 9.0], [5.0, 16.0]], draught=4.0)]
    for hull in hulls:
        statics = hull.hydrostatics
        inertia = [40.0 * 1000.0 / 12.0, 10.0 * 64000.0 / 12.0]
        assert values(statics) == pytest.approx([1600.0, -2.0, 400.0, *inertia], rel=1e-12)
        assert statics.wetted_surface == pytest.approx(400.0 + 2.0 * 4.0 * 50.0, rel=1e-12)
        assert (hull.length, hull.breadth, hull.draught) == pytest.approx((40.0, 10.0, 4.0))
        assert statics.metacentric_height(1.0) == pytest.approx(100.0 / 48.0 - 3.0)
        stiff = statics.restoring(rho=RHO, g=G, center_of_gravity_z=1.0)
        levers = [400.0, 1600.0 * (100.0 / 48.0 - 3.0), 1600.0 * (1600.0 / 48.0 - 3.0)]
        assert np.diag(stiff)[2:5] == pytest.approx(RHO * G * np.array(levers))


@pytest.mark.parametrize("draught", [3.0, 7.5])
def test_sphere_cap(draught: float) -> None:
    """A floating sphere of radius 5 m: cap volume and area, metacentre at the centre whatever the draught."""
    radius, errors, centre = 5.0, [], 5.0 - draught
    volume, area = np.pi * draught**2 * (15.0 - draught) / 3.0, np.pi * draught * (10.0 - draught)
    below = 3.0 * (10.0 - draught) ** 2 / (4.0 * (15.0 - draught))
    for count in (24, 48, 96):
        statics = from_mesh(sphere(radius, count), draught=draught).hydrostatics
        off = [
            statics.volume / volume - 1.0, statics.waterplane_area / area - 1.0,
            statics.wetted_surface / (2.0 * np.pi * radius * draught) - 1.0,
            (statics.center_of_buoyancy[2] - centre + below) / radius,
            (statics.metacentre_transverse - centre) / radius,
            (statics.metacentre_longitudinal - centre) / radius,
        ]  # fmt: skip
        errors.append(np.abs(off).max())
    assert errors[-1] < 3e-3
    assert np.all(np.log2(np.divide(errors[:-1], errors[1:])) > 1.7)


def wigley_values() -> np.ndarray:
    """Closed forms: 4/9 L B T, -3/8 T, 2/3 L B, 2/105 L B^3 ..., L^3 B / 30."""
    length, breadth, draught = SHIP
    volume, area = 4.0 / 9.0 * length * breadth * draught, 2.0 / 3.0 * length * breadth
    roll = 2.0 / 3.0 * (breadth / 2.0) ** 3 * length / 2.0 * 32.0 / 35.0
    return np.array([volume, -0.375 * draught, area, roll, breadth * (length / 2.0) ** 3 * 4.0 / 15.0])


def test_offsets_and_mesh_of_a_wigley_hull_converge_at_second_order_to_the_closed_form() -> None:
    exact = wigley_values()
    for make in (
        lambda n: Hull.from_offsets(wigley_offsets(*SHIP, n)),
        lambda n: from_mesh(wigley_mesh(*SHIP, n)),
    ):
        errors = [np.abs(values(make(n).hydrostatics) / exact - 1.0) for n in (6, 12, 24)]
        assert np.all(errors[2] < 6e-3)
        assert np.all(np.log2(errors[0] / errors[1]) > 1.8)
        assert np.all(np.log2(errors[1] / errors[2]) > 1.9)


def test_moving_the_origin_moves_the_moments() -> None:
    hull = Hull.from_offsets(wigley_offsets(*SHIP, 6))
    away = hull.moved(7.0)
    before, after = hull.hydrostatics, away.hydrostatics
    assert after.center_of_buoyancy[0] - before.center_of_buoyancy[0] == pytest.approx(7.0)
    steiner = 14.0 * before.waterplane_moment_x + 49.0 * before.waterplane_area
    assert after.waterplane_inertia_pitch - before.waterplane_inertia_pitch == pytest.approx(steiner)
    assert after.metacentre_longitudinal == pytest.approx(before.metacentre_longitudinal)
    assert away.at_centre_of_buoyancy().hydrostatics.center_of_buoyancy[0] == pytest.approx(0.0, abs=1e-12)
    # Flotation ahead of the origin (x > 0): C35 = -rho g integral b x dx is negative.
    stiff = after.restoring(rho=RHO, g=G, center_of_gravity_z=0.0)
    assert stiff[2, 4] == pytest.approx(-RHO * G * 7.0 * before.waterplane_area)


def test_restoring_is_what_the_heeled_and_trimmed_box_shows() -> None:
    """Moments of weight and buoyancy of a box tilted by a small angle, its mesh rotated and cut anew."""
    vertices, faces = box(length=40.0, breadth=10.0, bottom=-4.0, top=6.0)
    vertices = vertices + np.array([2.0, 0.0, 0.0])
    upright = Hull.from_mesh(vertices=vertices, faces=faces).hydrostatics
    c = upright.restoring(rho=RHO, g=G, center_of_gravity_z=-1.0, center_of_gravity_x=1.2, mass=1.5e6)
    angle = 1e-4
    turn = np.array([[np.cos(angle), 0, np.sin(angle)], [0, 1, 0], [-np.sin(angle), 0, np.cos(angle)]])

    def load(rotation: np.ndarray) -> tuple[float, float]:
        """Heave force (N) and pitch moment about the origin (N m)."""
        wet = Hull.from_mesh(vertices=vertices @ rotation.T, faces=faces).hydrostatics
        gravity = rotation @ np.array([1.2, 0.0, -1.0])
        buoyancy, weight = RHO * G * wet.volume, 1.5e6 * G
        return buoyancy - weight, -wet.center_of_buoyancy[0] * buoyancy + gravity[0] * weight

    up, moment = (np.array(load(turn)) - np.array(load(turn.T))) / (2.0 * angle)
    assert -up == pytest.approx(c[2, 4], rel=1e-5)
    assert -moment == pytest.approx(c[4, 4], rel=1e-5)


def test_remeshing_keeps_the_shape_bilges_and_waterlines() -> None:
    """Corners of the section are corners of panels: outline, area and volume stay to rounding."""
    hull = Hull.from_offsets(wigley_offsets(*SHIP, 24))
    even = hull.remeshed(stations=48, girth=16)
    assert values(even.hydrostatics) == pytest.approx(values(hull.hydrostatics), rel=5e-3)
    assert len(even.panels) <= 2 * 48 * 16
    for half, girth in (
        ([[5.0, 0.0], [5.0, -4.0]], 7),  # a box, keel at the centre line added
        ([[6.0, 0.0], [5.0, -2.5], [2.0, -4.0], [0.0, -4.2]], 9),  # two chines
    ):
        fine, statics = barge(half).remeshed(stations=10, girth=girth), barge(half).hydrostatics
        assert fine.hydrostatics.volume == pytest.approx(statics.volume, rel=1e-12)
        assert fine.hydrostatics.wetted_surface == pytest.approx(statics.wetted_surface, rel=1e-12)
        for corner in half:
            assert np.any(np.all(np.isclose(fine.panels.reshape(-1, 3)[:, 1:], corner, atol=1e-9), axis=1))


def test_a_parametric_hull_has_its_main_dimensions() -> None:
    shape = ParametricHull(
        length=115.0, breadth=25.0, draught=6.4, entrance_length=40.0, run_length=34.5,
        transom_breadth_fraction=0.75, transom_draught_fraction=0.2, section_exponent=6.0,
    )  # fmt: skip
    points = shape.panels(stations=56, girth=20).reshape(-1, 3)
    assert np.ptp(points, axis=0) == pytest.approx([115.0, 25.0, 6.4], rel=2e-3)


def half_area(section: np.ndarray) -> float:
    return float(-np.trapezoid(section[:, 0], section[:, 1]))


def test_slices_of_mesh_and_offsets_have_the_area_of_the_closed_form() -> None:
    """Wigley: half area B T / 3 (1 - (2x/L)^2) at every station."""
    length, breadth, draught = SHIP
    x = np.linspace(-0.47, 0.47, 13) * length
    exact = breadth * draught / 3.0 * (1.0 - (2.0 * x / length) ** 2)
    mesh, table = from_mesh(wigley_mesh(*SHIP, 40)), Hull.from_offsets(wigley_offsets(*SHIP, 40))
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
    hull = from_mesh(joined(box(length=40.0, breadth=10.0, bottom=-4.0, top=3.0), bulb))
    ahead, inside = hull.sections([24.0, 0.0])
    assert np.all(ahead.section == 0.0)
    assert ahead.apart == pytest.approx(0.5 * np.pi * 1.5**2, rel=5e-3)
    assert inside.apart == 0.0
    with pytest.raises(ValueError, match="hangs apart"):
        hull.remeshed(stations=40, girth=6)
    one = box(length=40.0, breadth=3.0, bottom=-4.0, top=3.0)
    catamaran = from_mesh(joined(moved(one, 0.0, 5.0, 0.0), moved(one, 0.0, -5.0, 0.0)))
    assert catamaran.hydrostatics.volume == pytest.approx(2 * 480.0)
    with pytest.raises(ValueError, match="more than once"):
        catamaran.sections([0.0])


BOX = box(length=40.0, breadth=10.0, bottom=-4.0, top=3.0)


def triangles() -> np.ndarray:
    vertices, faces = wigley_mesh(100.0, 16.0, 6.0, 6)
    return vertices[faces]


def test_ascii_and_binary_stl_give_the_hull_of_the_mesh(tmp_path: Path) -> None:
    vertices, faces = wigley_mesh(100.0, 16.0, 6.0, 6)
    volume = Hull.from_mesh(vertices=vertices, faces=faces).hydrostatics.volume
    (tmp_path / "a.stl").write_text(ascii_stl(triangles()))
    stl(tmp_path / "b.stl", triangles())
    stl(tmp_path / "c.stl", triangles(), header=b"solid but binary all the same")
    stl(tmp_path / "mm.stl", 1000.0 * triangles())
    for name in ("a", "b", "c"):
        assert Hull.from_stl(tmp_path / f"{name}.stl").hydrostatics.volume == pytest.approx(volume, rel=1e-6)
    with pytest.raises(ValueError, match=r"in mm, perhaps.*scale=0\.001"):
        Hull.from_stl(tmp_path / "mm.stl")
    scaled = Hull.from_stl(tmp_path / "mm.stl", scale=0.001)
    assert scaled.hydrostatics.volume == pytest.approx(volume, rel=1e-6)
    assert "mm.stl" in scaled.source


def test_no_prefix_of_an_stl_file_is_a_smaller_hull(tmp_path: Path) -> None:
    text, path = ascii_stl(triangles()), tmp_path / "hull.stl"
    first = "vertex " + text.partition("vertex ")[2].partition("\n")[0]
    for content in (
        text[: len(text) // 2].rsplit("\n", 1)[0] + "\n", text.replace(f"{first}\n", "", 1),
        text.replace(first, f"{first} 0", 1), text.replace(first, f"{first}x", 1),
        text.replace("endfacet", "endfacet\nendsolid\nsolid b", 1).removesuffix("endsolid hull\n"),
    ):  # fmt: skip
        path.write_text(content)
        with pytest.raises(FileFormatError, match=r"hull\.stl.*export it again"):
            read_stl(path)
    whole = stl(path, triangles()[:20]).read_bytes()
    for size in range(0, len(whole), 7):
        path.write_bytes(whole[:size])
        with pytest.raises(FileFormatError):
            read_stl(path)


def test_offset_files_forward_or_aft_with_comments_and_malformed(tmp_path: Path) -> None:
    path = tmp_path / "barge.csv"
    for order in (1, -1):
        stations = [(x, [(5.0, 2.0), (5.0, -4.0), (0.0, -4.0)]) for x in (-20.0, 0.0, 20.0)][::order]
        lines = ["# a barge", "x,y,z"]
        for x, points in stations:
            lines += [f"{x}, {y}, {z}" for y, z in points] + [""]
        path.write_text("\n".join(lines))
        hull = Hull.from_offsets(path)
        assert hull.name == "barge" and hull.hydrostatics.volume == pytest.approx(1600.0)
    path.write_text("0,5,0\n1,5,0\n0,5,-1\n")
    with pytest.raises(FileFormatError, match=r"(?s)barge\.csv.*line 3.*comes back"):
        read_offset_table(path)
    table = OffsetTable(x=[0.0, 10.0], sections=([[5.0, 2.0], [0.0, -4.0]], [[1.0, -1.0], [0.0, -4.0]]))
    with pytest.raises(ValueError, match="x = 10 m begins 1 m below"):
        Hull.from_offsets(table)


TURNED = np.vstack([BOX[1][:1], BOX[1][1:2, ::-1], BOX[1][2:]])
NO_HULL: list[tuple[tuple[np.ndarray, np.ndarray], str]] = [
    ((BOX[0], BOX[1][[0, 1, 2, 3, 5]]), "the surface is open"), ((BOX[0], TURNED), "normals disagree"),
    ((BOX[0], BOX[1][:, ::-1]), "inwards"), (joined(BOX, BOX), "more than two faces"),
    (moved(BOX, 0.0, 1.0, 0.0), "off the plane y = 0"), (moved(BOX, 0.0, 0.0, 9.0), "nothing is below"),
    ((BOX[0], BOX[1] + 1), "names vertex 8 of 8"),
    (box(length=4.0, breadth=40.0, bottom=-4.0, top=1.0), "x is forward"),
    (box(length=4e4, breadth=1e4, bottom=-4e3, top=1.0), "in mm"),
    ((np.full_like(BOX[0], np.nan), BOX[1]), "finite"),
]  # fmt: skip


def test_a_surface_that_is_no_hull_is_refused() -> None:
    for (vertices, faces), message in NO_HULL:
        with pytest.raises(ValueError, match=message):
            Hull.from_mesh(vertices=vertices, faces=faces)
    open_above = Hull.from_mesh(vertices=BOX[0], faces=BOX[1][:5])  # no deck
    assert open_above.hydrostatics.volume == pytest.approx(1600.0)
