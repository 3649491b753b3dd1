"""Parts from meshes: volume over depth, added mass on draughts by panels, pile-up, both limits, the cache."""

from __future__ import annotations

import os
import signal
import sys
from pathlib import Path
from threading import Timer
from typing import Any
from unittest.mock import Mock

import mesh_shapes
import numpy as np
import pytest
from hull_shapes import stl
from scipy.integrate import quad
from scipy.spatial import ConvexHull, HalfspaceIntersection

from seacrane import Scene, SceneError, simulate
from seacrane.arrays import Array
from seacrane.hydro import BoxPart, MeshPart, part_from_mesh
from seacrane.hydro.parts import panel_added_mass, panel_workers
from seacrane.hydro.parts.panel_added_mass import MeshShape, volumes_below
from seacrane.warnings import MeshConvergenceWarning

G, RHO = 9.80665, 1025.0
pytestmark = pytest.mark.filterwarnings("ignore::seacrane.warnings.MeshConvergenceWarning")  # coarse
BOX = mesh_shapes.box((2.0, 1.0, 1.5))
ROUGH: dict[str, Any] = {"panels": 60, "draughts": (0.3, 0.75, 1.5)}  # where panels do not matter


@pytest.fixture(scope="module", autouse=True)
def capytaine() -> Any:
    return pytest.importorskip("capytaine", reason="pip install 'seacrane[hydro]'")


def at(part: MeshPart, depth: float) -> tuple[Array, Array]:
    """Added mass at a depth of the table over density, m3: fast, slow."""
    i = int(np.argmin(np.abs(part.depths - depth)))
    assert part.depths[i] == pytest.approx(depth, rel=1e-4)
    return part.added_masses[i] / part.density, part.low_frequency_added_masses[i] / part.density


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


def test_a_box_floats_level_as_a_box_part() -> None:
    for depth in (0.2, 0.77, 1.3, 1.6, 4.0):
        forces = []
        for part in (part_from_mesh(BOX, **ROUGH), BoxPart(size=(2.0, 1.0, 1.5))):
            scene, at = Scene(name="float", gravity=G), (0.0, 0.0, 0.75 - depth)
            scene.add_body(name="load", mass=1e7, inertia=(1e7, 1e7, 1e7), position=at, gravity=False)
            scene.add_immersed("load", parts=[part], density=RHO)
            result = simulate(scene, t_end=0.01, dt_out=0.01, channels=["load_force"])
            forces.append(np.asarray(result["load_force"])[0].reshape(3))
        assert forces[0] == pytest.approx(forces[1], rel=2e-3, abs=1.0)
        assert forces[0][2] == pytest.approx(RHO * G * 2.0 * min(depth, 1.5), rel=2e-4)


def test_a_sphere_has_the_added_mass_of_hulme_in_both_limits() -> None:
    """A. Hulme, J. Fluid Mech. 121 (1982) 443: 0.5 and 0.8310 of 2/3 pi R^3 in heave at half depth; half of
    its volume far below."""
    radius = 2.0
    half = 2.0 / 3.0 * np.pi * radius**3
    mesh = mesh_shapes.sphere(radius)
    middle = 0.5 * float(np.ptp(mesh[..., 2]))  # its corners are a little outside
    part = part_from_mesh(mesh, panels=300, draughts=(middle, 2.0 * middle))
    fast, slow = at(part, middle)
    assert fast[2] / half == pytest.approx(0.5, rel=0.02)
    assert slow[2] / half == pytest.approx(0.8310, rel=0.02)
    assert slow[0] / half == pytest.approx(0.5, rel=0.03)  # the wall makes it half of a whole sphere
    assert part.added_masses[-1] / RHO == pytest.approx(half * np.ones(3), rel=0.02)
    assert part.low_frequency_added_masses[-1] == pytest.approx(part.added_masses[-1], rel=1e-12)


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
    deadrise, lengths, tables = 30.0, (8.0, 14.0), []
    half = 1.0 / np.tan(np.radians(deadrise))
    for length in lengths:
        mesh = mesh_shapes.prism(mesh_shapes.wedge(deadrise, 1.0), length)
        plain, wetted = (
            part_from_mesh(mesh, panels=int(50 * length), draughts=(0.5, 1.0), wetting=w)
            for w in (1.0, np.pi / 2.0)
        )  # as many panels in each metre, so that both err alike
        assert at(wetted, 0.5 / (np.pi / 2.0))[0] == pytest.approx(at(plain, 0.5)[0], rel=1e-3)
        assert at(wetted, 1.0)[0] == pytest.approx(at(plain, 1.0)[0], rel=1e-9)
        assert wetted.added_masses[-1] == pytest.approx(plain.added_masses[-1], rel=1e-12)
        assert at(wetted, 0.5)[0][2] > 1.5 * at(plain, 0.5)[0][2]
        tables.append(at(plain, 0.5)[0][2])
    found = (tables[1] - tables[0]) / (lengths[1] - lengths[0])
    assert found == pytest.approx(double_wedge(np.radians(deadrise)) * (0.5 * half) ** 2, rel=0.06)


def test_a_flat_bottom_gains_half_of_a_plates_added_mass_over_the_depth_of_its_slam() -> None:
    side = 2.0
    mesh = mesh_shapes.box((side, side, 1.0))
    first = 0.5 * 0.579 * np.pi / 4.0 * side**3  # m3, DNV-RP-N103 as of `BoxPart`
    early, found = 0.02, {}  # m
    for slam in (None, 8.0):
        part = part_from_mesh(mesh, slam=slam, panels=200, draughts=(0.04, 0.1, 0.5, 1.0))
        up, coefficient = part.added_masses[:, 2] / RHO, slam or 5.0
        over = 2.0 * first / (coefficient * side**2)
        assert up[0] == 0.0
        found[coefficient] = float(np.interp(early, part.depths, up))
        sides = found[coefficient] - 0.5 * coefficient * side**2 * early
        assert 0.0 < sides < 0.1 * first
        assert first < np.interp(1.3 * over, part.depths, up) < 1.3 * first
    assert found[8.0] - found[5.0] == pytest.approx(0.5 * (8.0 - 5.0) * side**2 * early, rel=0.01)


def test_a_ladder_is_found_on_disk_again_to_the_bit(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SEACRANE_CACHE", str(tmp_path))
    first = part_from_mesh(BOX, **ROUGH)
    (file,) = (tmp_path / "added_mass").iterdir()
    real = panel_added_mass._solved
    monkeypatch.setattr(panel_added_mass, "_solved", Mock(side_effect=AssertionError("solved again")))
    with monkeypatch.context() as without:
        without.setitem(sys.modules, "capytaine", None)
        assert part_from_mesh(BOX, wetting=1.2, perforation=0.1, **ROUGH).volumes[-1] == first.volumes[-1]
        again = part_from_mesh(BOX, **ROUGH)
    for name in ("depths", "volumes", "added_masses", "low_frequency_added_masses", "size"):
        assert np.array_equal(getattr(first, name), getattr(again, name)), name
    assert (first.source, first.mended, first.panel_error) == (again.source, again.mended, again.panel_error)
    for other in ({"scale": 0.999}, {"panels": 61}, {"draughts": (0.3, 0.75, 1.6)}):
        with pytest.raises(AssertionError, match="solved again"):
            part_from_mesh(BOX, **(ROUGH | other))
    file.write_bytes(file.read_bytes()[:300])
    monkeypatch.setattr(panel_added_mass, "_solved", real)
    assert np.array_equal(part_from_mesh(BOX, **ROUGH).added_masses, first.added_masses)


@pytest.mark.slow("processes begin, each with Capytaine")
def test_processes_solve_the_same_and_end_at_ctrl_c(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SEACRANE_CACHE", "off")
    here, begun, begin = part_from_mesh(BOX, **ROUGH), [], panel_workers._begun
    monkeypatch.setattr(panel_workers, "FEW", 0)
    apart = part_from_mesh(BOX, **ROUGH)
    assert apart.added_masses == pytest.approx(here.added_masses, rel=1e-9)
    assert apart.low_frequency_added_masses == pytest.approx(here.low_frequency_added_masses, rel=1e-9)
    monkeypatch.setattr(panel_workers, "_begun", lambda: begun.append(begin()) or begun[-1])
    before = signal.signal(signal.SIGINT, signal.default_int_handler)  # which jobs in the background lack
    Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    try:
        with pytest.raises(KeyboardInterrupt):
            part_from_mesh(BOX, panels=2000)
    finally:
        signal.signal(signal.SIGINT, before)
    assert begun and all(process.poll() is not None for process in begun)


def test_a_file_is_read_with_its_scale_and_density_and_holes_are_factors(tmp_path: Path) -> None:
    path = stl(tmp_path / "template.stl", 1000.0 * BOX)
    with pytest.raises(SceneError, match=r"'template.stl': is 2000 m large.*scale=0.001"):
        part_from_mesh(path)
    plain = part_from_mesh(path, scale=1e-3, source="drawing 12", **ROUGH)
    assert plain.volumes[-1] == pytest.approx(3.0, rel=1e-6)
    holed = part_from_mesh(BOX, perforation=0.2, density=1000.0, **ROUGH)
    assert holed.added_masses == pytest.approx(plain.added_masses * 0.7551 * 1000.0 / RHO, rel=1e-3)
    piece = next(holed.pieces(900.0))
    assert piece.added_masses == pytest.approx(holed.added_masses * 0.9, rel=1e-12)


@pytest.mark.parametrize(
    ("mesh", "given", "message"),
    [(BOX[1:], {}, "3 edges.*surface is open"), (BOX[:, ::-1], {}, "encloses -3 m3"),
     (np.concatenate([BOX[:1, ::-1], BOX[1:]]), {}, "normals disagree"), (BOX * np.nan, {}, "not finite"),
     (BOX, {"density": 1.025}, "t/m3"), (BOX, {"draughts": (1.0, 0.5, 1.5)}, "draughts is .*increasing"),
     (BOX, {"draughts": (0.5, 1.0)}, "draughts is .* on to .* its top"),
     (BOX, {"slam": 3.0}, "slam is 3"), (mesh_shapes.sphere(1.0), {"slam": 6.0}, "bottom is flat")],
)  # fmt: skip
def test_bad_meshes_and_numbers_are_refused(mesh: Any, given: dict[str, Any], message: str) -> None:
    with pytest.raises(SceneError, match=message):
        part_from_mesh(mesh, **given)


def test_panels_that_do_not_suffice_are_told() -> None:
    with pytest.warns(MeshConvergenceWarning, match="changes by") as told:
        part = part_from_mesh(mesh_shapes.box((2.0, 2.0, 0.1)), panels=50, draughts=(0.1, 0.5))
    assert part.panel_error > 0.05 and f"by {part.panel_error:.1%}" in str(told[0].message)
