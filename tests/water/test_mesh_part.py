"""Parts from meshes: volume over depth, added mass on draughts by panels, pile-up, both limits, the cache."""

from __future__ import annotations

import itertools
import struct
import sys
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import mesh_shapes
import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import quad
from scipy.spatial import ConvexHull, HalfspaceIntersection
from scipy.spatial.transform import Rotation

from seacrane import Scene, SceneError, simulate
from seacrane.errors import FileFormatError
from seacrane.warnings import MeshConvergenceWarning
from seacrane.water import BoxPart, MeshPart, from_mesh, panel_added_mass
from seacrane.water.mesh_volume import MeshShape, volumes_below

Array = NDArray[np.float64]
G, RHO = 9.80665, 1025.0
BOX = mesh_shapes.box((2.0, 1.0, 1.5))
ROUGH: dict[str, Any] = {
    "panels": 60,
    "draughts": (0.3, 0.75, 1.5),
}  # of BOX, for what panels do not matter to


@pytest.fixture(scope="module", autouse=True)
def capytaine() -> Any:
    return pytest.importorskip(
        "capytaine", reason="Capytaine is not installed: pip install 'seacrane[hydro]'"
    )


@pytest.fixture(autouse=True)
def coarse_on_purpose() -> Any:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", MeshConvergenceWarning)
        yield


def at(part: MeshPart, depth: float) -> tuple[Array, Array]:
    """Added mass at a depth of the table over density, m3: fast, slow."""
    i = int(np.argmin(np.abs(part.depths - depth)))
    assert part.depths[i] == pytest.approx(depth, rel=1e-4)
    return part.added_masses[i] / part.density, part.low_frequency_added_masses[i] / part.density


# --- volume ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize("seed", range(3))
def test_the_volume_below_a_level_is_that_of_the_clipped_polyhedron(seed: int) -> None:
    """Of a random convex one, as the intersection of its half spaces with that below the level."""
    rng = np.random.default_rng(seed)
    points = rng.normal(size=(14, 3)) * (2.0, 1.0, 1.5)
    shape = MeshShape.of(mesh_shapes.hull_of(points))
    corners = shape.triangles.reshape(-1, 3)
    faces = ConvexHull(corners).equations
    levels = np.linspace(0.05, 1.2, 8) * shape.size[2]
    for level, found in zip(levels, volumes_below(shape.triangles, levels), strict=True):
        lower = corners[corners[:, 2].argmin()]
        inside = lower + 1e-3 * (corners.mean(axis=0) - lower)
        cut = HalfspaceIntersection(np.vstack([faces, [0.0, 0.0, 1.0, -level]]), inside).intersections
        assert found == pytest.approx(ConvexHull(cut).volume, rel=1e-9)
    assert volumes_below(shape.triangles, levels)[-1] == pytest.approx(ConvexHull(points).volume, rel=1e-12)


@pytest.mark.slow("panels")
def test_a_part_lies_at_half_height_on_the_centre_of_its_volume() -> None:
    """Of an upright wedge, moved and turned about z on its body."""
    section = [[0.0, 0.0], [1.0, 1.0], [0.0, 1.0]]  # half a wedge: its centre is a third aside
    mesh = mesh_shapes.prism(section, 2.0) + np.array([5.0, 0.0, -3.0])
    turn = Rotation.from_rotvec([0.0, 0.0, 0.5]).as_matrix()
    part = from_mesh(mesh, panels=60, draughts=(0.5, 1.0), point=(1.0, 2.0, 3.0), axes=turn)
    assert part.point == pytest.approx(turn @ [5.0, 1.0 / 3.0, -2.5] + [1.0, 2.0, 3.0], abs=1e-9)
    assert part.size == pytest.approx([2.0, 1.0, 1.0])
    assert (part.height, part.extent) == pytest.approx((1.0, 2.0))


@pytest.mark.parametrize("depth", [0.2, 0.77, 1.3, 1.6, 4.0])
def test_a_box_floats_level_as_a_box_part(depth: float) -> None:
    forces = []
    for part in (from_mesh(BOX, **ROUGH), BoxPart(size=(2.0, 1.0, 1.5))):
        scene = Scene(name="float", gravity=G)
        scene.add_body(
            name="load", mass=1e7, inertia=(1e7, 1e7, 1e7), position=(0.0, 0.0, 0.75 - depth), gravity=False
        )
        scene.add_immersed("load", parts=[part], density=RHO)
        result = simulate(scene, t_end=0.01, dt_out=0.01, channels=["load_force"])
        forces.append(np.asarray(result["load_force"])[0].reshape(3))
    assert forces[0] == pytest.approx(forces[1], rel=2e-3, abs=1.0)
    assert forces[0][2] == pytest.approx(RHO * G * 2.0 * min(depth, 1.5), rel=2e-4)


# --- added mass -----------------------------------------------------------------------------------------


def test_a_sphere_has_the_added_mass_of_hulme_in_both_limits() -> None:
    """A. Hulme, J. Fluid Mech. 121 (1982) 443: 0.5 and 0.8310 of 2/3 pi R^3 in heave at half depth; half of
    its volume far below."""
    radius = 2.0
    half = 2.0 / 3.0 * np.pi * radius**3
    mesh = mesh_shapes.sphere(radius)
    middle = 0.5 * float(np.ptp(mesh[..., 2]))  # its corners are a little outside
    part = from_mesh(mesh, panels=300, draughts=(middle, 2.0 * middle))
    fast, slow = at(part, middle)
    assert fast[2] / half == pytest.approx(0.5, rel=0.02)
    assert slow[2] / half == pytest.approx(0.8310, rel=0.02)
    assert slow[0] / half == pytest.approx(0.5, rel=0.03)  # the wall makes it half of a whole sphere
    assert part.added_masses[-1] / RHO == pytest.approx(half * np.ones(3), rel=0.02)
    assert part.low_frequency_added_masses[-1] == pytest.approx(part.added_masses[-1], rel=1e-12)


@pytest.mark.slow("panels")
def test_a_long_cylinder_has_the_added_mass_of_greenhow_and_li_but_at_its_ends() -> None:
    """Half immersed, per length from the difference of two lengths: pi/2 of density R^2. The ends take
    what DNV-RP-C205 has of a cylinder in an unbounded fluid (unverified), which is twice this one."""
    radius, lengths = 1.0, (6.0, 10.0)
    parts = [
        from_mesh(mesh_shapes.prism(mesh_shapes.circle(radius, 12), length), panels=400, draughts=(1.0, 2.1))
        for length in lengths
    ]
    depth = 0.5 * parts[0].height  # of a polygon
    found = [np.interp(depth, part.depths, part.added_masses[:, 2]) / RHO for part in parts]
    assert (found[1] - found[0]) / (lengths[1] - lengths[0]) == pytest.approx(np.pi / 2.0, rel=0.04)
    ratios = [value / (length * np.pi / 2.0) for value, length in zip(found, lengths, strict=True)]
    assert ratios == pytest.approx([0.81, 0.90], abs=0.02)  # its table, read at 3 and 5 diameters


def double_wedge(deadrise: float) -> float:
    """Added mass of a wedge over density and the square of half its width, from the map of the outside of a
    circle on that of a rhombus, dz/dw = C (1 - 1/w^2)^(1 - p) (1 + 1/w^2)^p with p = 2 deadrise / pi: of
    z = C w + C (1 - 2 p) / w + ... it is pi C^2 (2 - 2 p) less the wedge's own area."""
    p = 2.0 * deadrise / np.pi
    side = quad(lambda t: (2.0 * np.sin(t)) ** (1.0 - p) * (2.0 * np.cos(t)) ** p, 0.0, np.pi / 2.0)[0]
    scale = 1.0 / np.cos(deadrise) / side
    return float(np.pi * scale**2 * (2.0 - 2.0 * p) - np.tan(deadrise))


@pytest.mark.slow("panels")
def test_a_wedge_has_the_added_mass_of_a_double_wedge_and_with_wetting_that_of_one_piled_up() -> None:
    assert double_wedge(1e-6) == pytest.approx(np.pi / 2.0, rel=1e-5)
    assert double_wedge(np.pi / 4.0) / (np.pi / 2.0) == pytest.approx(0.7566, rel=1e-4)
    deadrise, height, lengths = 30.0, 1.0, (8.0, 14.0)
    half = 1.0 / np.tan(np.radians(deadrise))
    tables = []
    for length in lengths:
        mesh = mesh_shapes.prism(mesh_shapes.wedge(deadrise, height), length)
        plain, wetted = (
            from_mesh(mesh, panels=int(50 * length), draughts=(0.5, 1.0), wetting=w)
            for w in (1.0, np.pi / 2.0)
        )  # as many panels in each metre, so that both err alike
        wet = 0.5 / (np.pi / 2.0)
        assert at(wetted, wet)[0] == pytest.approx(at(plain, 0.5)[0], rel=1e-3)
        assert at(wetted, 1.0)[0] == pytest.approx(at(plain, 1.0)[0], rel=1e-9)
        assert wetted.added_masses[-1] == pytest.approx(plain.added_masses[-1], rel=1e-12)
        assert at(wetted, 0.5)[0][2] > 1.5 * at(plain, 0.5)[0][2]
        tables.append(at(plain, 0.5)[0][2])
    found = (tables[1] - tables[0]) / (lengths[1] - lengths[0])
    assert found == pytest.approx(double_wedge(np.radians(deadrise)) * (0.5 * half) ** 2, rel=0.06)


def test_added_mass_grows_with_depth_and_panels_hardly_need_mending() -> None:
    rng = np.random.default_rng(5)
    part = from_mesh(mesh_shapes.hull_of(rng.normal(size=(12, 3)) * (1.5, 1.0, 1.0)), panels=150)
    assert np.all(np.diff(part.added_masses, axis=0) >= 0.0)
    assert np.all(np.diff(part.volumes) >= 0.0)
    assert part.mended < 0.02
    below = part.depths > part.height
    assert np.all(part.added_masses[below] <= part.added_masses[-1])
    assert part.added_masses[-2] == pytest.approx(part.added_masses[-1], rel=0.1), (
        "the surface no longer counts"
    )
    half = int(np.argmin(np.abs(part.depths - 0.5 * part.height)))
    slow, fast = part.low_frequency_added_masses[half], part.added_masses[half]
    assert np.all(slow > fast)
    assert f"{slow[2] / fast[2]:.1f}" in part.source


def test_a_flat_bottom_gains_half_of_a_plates_added_mass_over_the_depth_of_its_slam() -> None:
    side = 2.0
    mesh = mesh_shapes.box((side, side, 1.0))
    first = 0.5 * 0.579 * np.pi / 4.0 * side**3  # m3, DNV-RP-N103 as of `BoxPart`
    early, found = 0.02, {}  # m
    for slam in (None, 8.0):
        part = from_mesh(mesh, slam=slam, panels=200, draughts=(0.04, 0.1, 0.5, 1.0))
        up, coefficient = part.added_masses[:, 2] / RHO, slam or 5.0
        over = 2.0 * first / (coefficient * side**2)
        assert up[0] == 0.0
        found[coefficient] = float(np.interp(early, part.depths, up))
        sides = found[coefficient] - 0.5 * coefficient * side**2 * early
        assert 0.0 < sides < 0.1 * first
        assert first < np.interp(1.3 * over, part.depths, up) < 1.3 * first
    assert found[8.0] - found[5.0] == pytest.approx(0.5 * (8.0 - 5.0) * side**2 * early, rel=0.01)


def test_perforation_and_density_are_factors() -> None:
    plain = from_mesh(BOX, **ROUGH)
    holed = from_mesh(BOX, perforation=0.2, density=1000.0, **ROUGH)
    assert holed.added_masses == pytest.approx(plain.added_masses * 0.7551 * 1000.0 / RHO, rel=1e-3)
    assert holed.volumes == pytest.approx(plain.volumes, rel=1e-12)
    for density in (900.0, RHO):
        piece = next(holed.pieces(density))
        assert piece.added_masses == pytest.approx(holed.added_masses * density / 1000.0, rel=1e-12)
        assert piece.size == pytest.approx([2.0, 1.0, 1.5])


@pytest.mark.parametrize("formulation", ["recursive", "redundant"])
def test_a_mesh_that_is_dropped_keeps_the_ledger(formulation: str) -> None:
    part = from_mesh(mesh_shapes.sphere(1.0, 100), panels=100, wetting=1.5)
    scene = Scene(name="drop", gravity=G)
    mass = 6000.0
    scene.add_body(
        name="load", mass=mass, inertia=(mass, mass, mass), position=(0.0, 0.0, 1.2), velocity=(0, 0, -3)
    )
    scene.add_immersed("load", parts=[part], density=RHO)
    result = simulate(
        scene, t_end=3.0, dt_out=0.01, channels=["position", "energy_balance", "absolute_work"],
        formulation=formulation, integrator="dop853", rtol=1e-11,
    )  # fmt: skip
    z = np.asarray(result.select("position", body="load", axis="z"))
    assert z.min() < -1.0 < 1.0 < z[:30].max()
    assert np.max(np.abs(result["energy_balance"])) < 1e-7 * np.max(result["absolute_work"])
    assert [event.name for event in result.events][:2] == ["load.1.touch", "load.1.awash"]


# --- what is kept ---------------------------------------------------------------------------------------


def test_a_ladder_is_found_on_disk_again_to_the_bit(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SEACRANE_CACHE", str(tmp_path))
    first = from_mesh(BOX, **ROUGH)
    (file,) = (tmp_path / "added_mass").iterdir()
    real = panel_added_mass._Panels.solved

    def never(*_: Any, **__: Any) -> Array:
        raise AssertionError("solved again")

    monkeypatch.setattr(panel_added_mass._Panels, "solved", never)
    monkeypatch.setitem(sys.modules, "capytaine", None)
    assert from_mesh(BOX, wetting=1.2, perforation=0.1, **ROUGH).volumes[-1] == first.volumes[-1]
    again = from_mesh(BOX, **ROUGH)
    for name in ("depths", "volumes", "added_masses", "low_frequency_added_masses", "size"):
        assert np.array_equal(getattr(first, name), getattr(again, name)), name
    assert (first.source, first.mended, first.panel_error) == (again.source, again.mended, again.panel_error)
    monkeypatch.undo()
    monkeypatch.setenv("SEACRANE_CACHE", str(tmp_path))
    monkeypatch.setattr(panel_added_mass._Panels, "solved", never)
    for other in ({"scale": 0.999}, {"panels": 61}, {"draughts": (0.3, 0.75, 1.6)}):
        with pytest.raises(AssertionError, match="solved again"):
            from_mesh(BOX, **(ROUGH | other))
    file.write_bytes(file.read_bytes()[:300])
    monkeypatch.setattr(panel_added_mass._Panels, "solved", real)
    assert np.array_equal(from_mesh(BOX, **ROUGH).added_masses, first.added_masses)


def test_nothing_is_written_where_it_is_switched_off(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    from_mesh(BOX, **ROUGH)
    assert not list(tmp_path.iterdir())


# --- files, and what is refused -------------------------------------------------------------------------


def stl(path: Path, triangles: Array) -> Path:
    rows = b"".join(
        struct.pack("<12fH", 0.0, 0.0, 0.0, *triangle.ravel().astype("<f4"), 0) for triangle in triangles
    )
    path.write_bytes(b"\0" * 80 + struct.pack("<I", len(triangles)) + rows)
    return path


def test_a_file_in_millimetres_is_read_with_its_scale(tmp_path: Path) -> None:
    path = stl(tmp_path / "template.stl", 1000.0 * BOX)
    with pytest.raises(SceneError, match=r"mesh 'template.stl': is 2000 m large, .*give scale=0.001"):
        from_mesh(path)
    part = from_mesh(path, scale=1e-3, source="drawing 12", **ROUGH)
    assert part.volumes[-1] == pytest.approx(3.0, rel=1e-6)
    assert part.source.startswith("drawing 12; mesh 'template.stl', Capytaine")


def test_without_capytaine_the_extra_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "capytaine", None)
    with pytest.raises(ImportError, match=r"added mass needs Capytaine 3.*pip install 'seacrane\[hydro\]'"):
        from_mesh(BOX, **ROUGH)


def fine() -> Array:
    """More triangles than are solved for."""
    parts = [BOX]
    while len(parts[0]) <= panel_added_mass.MOST_PANELS:
        a, b, c = (parts[0][:, k] for k in range(3))
        p, q, r = 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)
        cuts = [(a, p, r), (p, b, q), (r, q, c), (p, q, r)]
        parts = [np.concatenate([np.stack(cut, axis=1) for cut in cuts])]
    return parts[0]


@pytest.mark.parametrize(
    ("made", "message"),
    [
        (lambda: from_mesh(BOX[1:]), "3 edges, the first near .* have one face only: the surface is open"),
        (lambda: from_mesh(BOX[:, ::-1]), "encloses -3 m3, so its faces point inwards; reverse"),
        (lambda: from_mesh(np.concatenate([BOX[:1, ::-1], BOX[1:]])), "normals disagree"),
        (lambda: from_mesh(BOX * (1.0, 1.0, 0.0)), "mesh of triangles: "),
        (lambda: from_mesh(BOX * 1e-6), "is 2e-06 m large, below 0.01 m"),
        (lambda: from_mesh(BOX * np.nan), "not finite"),
        (lambda: from_mesh(BOX[0]), r"has shape \(3, 3\)"),
        (lambda: from_mesh(fine()), "3072 triangles, above the 3000 panels"),
        (lambda: from_mesh("load.obj"), "file is 'load.obj'; give .stl"),
        (lambda: from_mesh(BOX, density=1.025), "density is 1.025, which looks like t/m3; give kg/m3"),
        (lambda: from_mesh(BOX, draughts=(-0.5, 1.5)), "draughts holds -0.5 m"),
        (lambda: from_mesh(BOX, draughts=(1.0, 0.5, 1.5)), "draughts has 0.5 m after 1 m"),
        (lambda: from_mesh(BOX, draughts=(0.5, 1.0)), "draughts ends at 1 m, above its top, .* at 1.5 m"),
        (lambda: from_mesh(BOX, draughts=()), "draughts has 0 values"),
        (lambda: from_mesh(BOX, wetting=0.5), "wetting is 0.5; give 1"),
        (lambda: from_mesh(BOX, slam=3.0), "slam is 3; a C_S of 5"),
        (lambda: from_mesh(mesh_shapes.sphere(1.0), slam=6.0), "nothing of its bottom is flat"),
        (lambda: from_mesh(BOX, perforation=0.7), "perforation is 0.7"),
        (lambda: from_mesh(BOX, panels=10), "panels is 10"),
        (lambda: from_mesh(BOX, panels=80.5), "panels is 80.5"),
        (lambda: from_mesh(BOX, scale=-1.0), "scale is -1"),
        (lambda: from_mesh(BOX, point=(1.0, 2.0)), "point"),
        (lambda: from_mesh(BOX, drag_area=(1.0, -1.0, 0.0), **ROUGH), "drag_area"),
    ],
)  # fmt: skip
def test_bad_meshes_and_numbers_are_refused(made: Callable[[], Any], message: str) -> None:
    with pytest.raises(SceneError, match=message):
        made()


def test_a_damaged_file_is_refused(tmp_path: Path) -> None:
    path = stl(tmp_path / "cut.stl", BOX)
    path.write_bytes(path.read_bytes()[:-10])
    with pytest.raises(FileFormatError, match=r"cut\.stl"):
        from_mesh(path)


def test_panels_that_do_not_suffice_are_told() -> None:
    thin = mesh_shapes.box((2.0, 2.0, 0.1))
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        part = from_mesh(thin, panels=50, draughts=(0.1, 0.5))
    assert part.panel_error > 0.05
    told = [str(one.message) for one in caught if one.category is MeshConvergenceWarning]
    assert f"changes by {part.panel_error:.1%} with half the panels" in told[0]
    assert caught[0].filename == __file__


def test_arrays_of_a_part_are_its_own_and_read_only() -> None:
    part = from_mesh(BOX, **ROUGH)
    for name in ("depths", "volumes", "added_masses", "low_frequency_added_masses", "size"):
        assert not getattr(part, name).flags.writeable, name
    assert list(itertools.islice(repr(part), 9)) == list("<MeshPart")
