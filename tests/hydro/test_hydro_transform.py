"""HydroDatabase.at and mirror: another reference point, the mirrored vessel."""

from __future__ import annotations

import dataclasses
import json
import logging
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from seacrane import cases, simulate
from seacrane.hydro import (
    AdditionalMatrices,
    DriftCoefficients,
    HydroDatabase,
    RollDamping,
    fit_memory,
    load_database,
    motion_response,
    passivity_certificate,
    shipped_database,
    vessel_parameters,
)
from seacrane.hydro.memory.certificate import is_energy_form
from seacrane.hydro.vessel.memory_stability import free_vessel_system
from seacrane.sea.dispersion import wavenumber
from seacrane.warnings import InfiniteFrequencyWarning, QuadraticDampingWarning

PARITY = np.array([1.0, -1.0, 1.0, -1.0, 1.0, -1.0])
POINTS = [(7.0, 0.0, 0.0), (0.0, 0.0, -3.0), (-11.0, 4.0, 2.5)]
MATRICES = (
    "added_mass",
    "damping",
    "infinite_frequency_added_mass",
    "zero_frequency_added_mass",
    "mass_matrix",
    "linear_damping",
    "restoring",
)


def full(**changes: Any) -> HydroDatabase:
    """Part of the shipped hull with every optional part filled; 45 m of water; not symmetric."""
    base = shipped_database()
    rng = np.random.default_rng(3)
    coarse = base.select(every=4, every_heading=6)
    n, m = len(coarse.omega), len(coarse.heading)
    skew = rng.normal(size=(6, 6)) * 1e5
    values: dict[str, Any] = {
        "linear_damping": np.diag([1.0, 2.0, 3.0, 400.0, 900.0, 800.0]) * 1e5 + skew,
        "roll_damping": RollDamping(
            linear=np.linspace(1e7, 2e7, n), quadratic=np.full(n, 1e8), linearised=rng.random((m, n)) * 1e7
        ),
        "additional": (
            AdditionalMatrices(
                cause="roll tanks",
                added_mass=rng.normal(size=(n, 6, 6)) * 1e6,
                damping=rng.normal(size=(n, 6, 6)) * 1e6,
                restoring=rng.normal(size=(n, 6, 6)) * 1e6,
            ),
        ),
        "drift": DriftCoefficients(
            heading=np.radians([0.0, 60.0, 120.0]),
            omega=np.array([0.5, 1.0]),
            coefficient=rng.normal(size=(3, 2, 6)) * 1e4,
        ),
        "motion_rao": rng.normal(size=(m, n, 6)) + 1j * rng.normal(size=(m, n, 6)),
        "depth": 45.0,
        "port_starboard_symmetric": False,
    }
    return dataclasses.replace(coarse, **(values | changes))


def lever(point: Any) -> np.ndarray:
    """The matrix of ``point x``."""
    return np.array([np.cross(point, axis) for axis in np.eye(3)]).T


def assert_same(found: HydroDatabase, base: HydroDatabase, tolerance: float) -> None:
    """Every array alike, by its largest entry; memory by its response."""
    pairs = [(name, getattr(found, name), getattr(base, name)) for name in (*MATRICES, "force", "motion_rao")]
    pairs += [("heading", found.heading, base.heading), ("omega", found.omega, base.omega)]
    for a, b in zip(found.additional, base.additional, strict=True):
        pairs += [
            (name, getattr(a, name), getattr(b, name)) for name in ("added_mass", "damping", "restoring")
        ]
    if base.drift is not None:
        assert found.drift is not None
        pairs += [
            (name, getattr(found.drift, name), getattr(base.drift, name))
            for name in ("heading", "coefficient")
        ]
    if base.roll_damping is not None:
        assert found.roll_damping is not None
        pairs.append(("linearised", found.roll_damping.linearised, base.roll_damping.linearised))
    if base.memory is not None:
        assert found.memory is not None
        w = np.geomspace(0.05, 10.0, 40)
        pairs += [("K", found.memory.transfer(w), base.memory.transfer(w))]
        pairs += [("A_inf", found.memory.added_mass, base.memory.added_mass)]
    for name, a, b in pairs:
        assert (a is None) == (b is None), name
        if a is not None:
            scale = np.abs(b).max() if b.ndim < 2 else np.abs(b).max(axis=tuple(range(b.ndim - 1)))
            assert np.all(np.abs(a - b) <= tolerance * np.maximum(scale, np.abs(b).max() * 1e-6)), name


# --- another reference point


@pytest.mark.parametrize("point", POINTS)
@pytest.mark.parametrize("phase_origin", [True, False])
def test_there_and_back_is_the_same_database(point: Any, phase_origin: bool) -> None:
    base = dataclasses.replace(full(), memory=shipped_database().memory)
    there = base.at(point, phase_origin=phase_origin, net_lift=2e7)
    back = there.at(-np.array(point), phase_origin=phase_origin, net_lift=2e7)
    assert_same(back, base, 1e-13)
    assert there.memory is not None and base.memory is not None
    assert there.memory.states == base.memory.states
    if np.any(point[:2]) and phase_origin:
        assert np.abs(there.force - base.force).max() > 0.1 * np.abs(base.force).max()


@pytest.mark.parametrize("point", POINTS)
def test_motions_at_the_new_point_are_those_the_rigid_body_has_there(point: Any) -> None:
    """Solved after moving = solved before, carried by ``x + theta x r``, with the wave's phase at r."""
    base = full()
    there = base.at(point)
    before = motion_response(base)
    carried = before.copy()
    carried[..., :3] += np.cross(before[..., 3:], point)
    k = wavenumber(base.omega, g=base.g, depth=base.depth)
    assert base.g * k * np.tanh(k * base.depth) == pytest.approx(base.omega**2, rel=1e-12)
    along = point[0] * np.cos(base.heading) + point[1] * np.sin(base.heading)
    carried *= np.exp(1j * np.outer(along, k))[:, :, None]
    assert motion_response(there) == pytest.approx(carried, rel=1e-9, abs=1e-12)
    assert base.motion_rao is not None and there.motion_rao is not None
    held = base.motion_rao.copy()
    held[..., :3] += np.cross(base.motion_rao[..., 3:], point)
    assert there.motion_rao == pytest.approx(held * np.exp(1j * np.outer(along, k))[:, :, None], rel=1e-12)


def test_the_phase_is_that_of_the_wave_at_the_new_point() -> None:
    """A small float driven by the surface alone: its heave force has the phase of the elevation."""
    base = full()
    wave = np.ones((len(base.heading), len(base.omega), 6), dtype=complex)
    point = (30.0, -8.0, 0.0)
    shifted = dataclasses.replace(base, force=wave).at(point).force[..., 2]
    k = wavenumber(base.omega, g=base.g, depth=base.depth)
    for m, heading in enumerate(base.heading):
        # a wave whose crest is at the new point at t = 0 has this elevation at the old one
        crest_back = np.exp(-1j * k * (-point[0] * np.cos(heading) - point[1] * np.sin(heading)))
        assert shifted[m] == pytest.approx(crest_back, rel=1e-12)
    stay = dataclasses.replace(base, force=wave).at(point, phase_origin=False)
    assert stay.force[..., 2] == pytest.approx(np.ones_like(shifted))
    assert "zero phase at the latter" in stay.origin


def test_moments_and_power_do_not_depend_on_the_point() -> None:
    """Loads do the same work, kinetic energy and dissipation stay, at any point."""
    base, point = full(), np.array([-9.0, 3.0, 4.0])
    there = base.at(point, phase_origin=False)
    rng = np.random.default_rng(1)
    old = rng.normal(size=6)
    new = old.copy()
    new[:3] += np.cross(old[3:], point)
    assert np.einsum("mni,i->mn", there.force, new) == pytest.approx(np.einsum("mni,i->mn", base.force, old))
    for name in MATRICES[:-1]:
        assert new @ getattr(there, name) @ new == pytest.approx(old @ getattr(base, name) @ old), name
    assert base.drift is not None and there.drift is not None
    assert there.drift.coefficient @ new == pytest.approx(base.drift.coefficient @ old)


@pytest.mark.parametrize("kind", ["per-pair", "passive"])
def test_the_free_vessel_with_memory_has_the_same_eigenvalues(kind: str) -> None:
    base = shipped_database()
    if kind == "passive":
        base = dataclasses.replace(base, memory=fit_memory(database=base, kind="passive", r2=0.9))
    there = base.at((12.0, -5.0, 3.0))
    before, after = (np.linalg.eigvals(free_vessel_system(vessel_parameters(d))) for d in (base, there))
    assert len(before) == len(after)
    distance = np.abs(before[:, None] - after)
    assert distance.min(axis=1).max() < 1e-10 and distance.min(axis=0).max() < 1e-10
    assert there.memory is not None
    if kind == "passive":
        assert all(is_energy_form(block) for block in there.memory.blocks)
        assert passivity_certificate(there.memory).passive


def test_a_run_about_the_new_point_is_the_same_voyage(tmp_path: Path) -> None:
    """The time domain about two points in the same sea: they differ by products of small motions only."""
    point = (10.0, 4.0, -3.0)
    base = shipped_database()
    base.at(point, phase_origin=False).save(tmp_path / "moved.nc")
    errors = []
    for hs in (0.1, 1.0):
        runs = []
        for database in (base, load_database(tmp_path / "moved.nc")):
            scene = cases.vessel(database=database, hs=hs, mooring_period=None)
            run = simulate(scene, t_end=20.0, dt_out=0.5, channels=["vessel_motion"])
            runs.append(np.asarray(run["vessel_motion"]))
        old, new = runs
        carried = old.copy()
        carried[:, :3] += np.cross(old[:, 3:], point)
        assert np.abs(new - old).max() > 0.1 * np.abs(old).max()
        errors.append((np.abs(new - carried).max(axis=0) / np.abs(old).max(axis=0)).max())
    assert errors[0] < 5e-3
    assert 5.0 < errors[1] / errors[0] < 20.0  # grows with the waves: of second order


def test_fits_are_judged_about_the_new_point() -> None:
    there = shipped_database().at((10.0, 0.0, 0.0))
    assert there.memory is not None
    row = next(row for row in there.memory.rows if (row.output, row.input) == (2, 4))
    fitted = there.memory.frequency_response(there.omega)[1][:, 2, 4]
    inside = (there.omega >= 0.3) & (there.omega <= 2.5)
    data = there.damping[inside, 2, 4]
    expected = 1.0 - np.sum((data - fitted[inside]) ** 2) / np.sum((data - data.mean()) ** 2)
    assert row.r2_damping == pytest.approx(expected)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        vessel_parameters(there)


def test_off_the_centreline_both_sides_are_written_out() -> None:
    base = shipped_database().select(every=5, every_heading=3)
    there = base.at((0.0, 6.0, 0.0))
    assert not there.port_starboard_symmetric
    assert len(there.heading) == 2 * len(base.heading) - 2
    back = there.at((0.0, -6.0, 0.0))
    heading, force = base.full_circle()
    assert back.heading == pytest.approx(heading)
    assert np.abs(back.force - force).max() < 1e-12 * np.abs(force).max()
    assert base.at((5.0, 0.0, 1.0)).port_starboard_symmetric


def test_midship_of_the_supply_vessel(shared: Path) -> None:
    """Against MSS, which moved the same files to midship with code of its own."""
    folder = shared / "veres" / "supply"
    expected = json.loads((folder / "expected.json").read_text())
    lcg = expected["header"]["LCG_aft_of_midship"]
    there = load_database(folder).at((lcg, 0.0, 0.0), phase_origin=False)
    ours = expected["xfwd_yport_zup"]["at_midship_waterline"]
    for key, matrix in ours["A"].items():
        assert there.added_mass[int(key)] == pytest.approx(np.array(matrix), rel=1e-12, abs=1e-3)
        assert there.damping[int(key)] == pytest.approx(np.array(ours["B"][key]), rel=1e-12, abs=1e-3)
    for key, pairs in ours["force_rao"].items():
        frequency, direction = key.split(",mu=")
        at = int(np.argmin(np.abs(np.angle(np.exp(1j * (there.heading - np.radians(float(direction))))))))
        values = np.array(pairs)
        found = there.force[at, int(frequency)]
        size = np.abs(values).max()
        assert np.abs(found - (values[:, 0] + 1j * values[:, 1])).max() < 1e-9 * size
    mss = expected["mss_fossen_axes"]
    turn = np.diag([1.0, -1.0, -1.0, 1.0, -1.0, -1.0])  # x forward, y starboard, z down
    without_surge = np.ix_(range(1, 6), range(1, 6))
    for key in mss["A"]:
        for name, symbol in (("added_mass", "A"), ("damping", "B")):
            found = turn @ getattr(there, name)[int(key)] @ turn
            wanted = np.array(mss[symbol][key])[without_surge]
            assert found[without_surge] == pytest.approx(wanted, rel=1e-9, abs=1e-3)
    assert turn @ there.mass_matrix @ turn == pytest.approx(np.array(mss["MRB"]), rel=1e-9, abs=1e-2)
    assert turn @ there.restoring @ turn == pytest.approx(np.array(mss["C"]), rel=1e-9, abs=1e-2)


# --- restoring of a box, from finite rotations


BOX = np.array([30.0, 8.0, 2.5])  # length, breadth, draught


def box_load(
    pose: np.ndarray, about: np.ndarray, centre: np.ndarray, weight: float, rho_g: float
) -> np.ndarray:
    """Force and moment of buoyancy and weight about the body point ``about``, displaced by ``pose``.

    The box lies with its midship section at x = 0, wall-sided; columns of water under the tilted surface are
    integrated exactly (polynomials of third degree, Gauss points).
    """
    shift, angle = pose[:3], float(np.linalg.norm(pose[3:]))
    axis = lever(pose[3:] / angle) if angle > 0.0 else np.zeros((3, 3))
    rotation = np.eye(3) + np.sin(angle) * axis + (1.0 - np.cos(angle)) * axis @ axis
    nodes, weights = np.polynomial.legendre.leggauss(4)
    force, moment = np.zeros(3), np.zeros(3)
    place = about + shift
    for x, wx in zip(nodes * BOX[0] / 2, weights * BOX[0] / 2, strict=True):
        for y, wy in zip(nodes * BOX[1] / 2, weights * BOX[1] / 2, strict=True):
            at = np.array([x, y, 0.0]) - about
            surface = -(place[2] + rotation[2] @ at) / rotation[2, 2]  # z in the body where the water ends
            wet = surface + BOX[2]
            middle = place + rotation @ (at + np.array([0.0, 0.0, 0.5 * (surface - BOX[2])]))
            lift = np.array([0.0, 0.0, rho_g * wx * wy * wet])
            force += lift
            moment += np.cross(middle - place, lift)
    pull = np.array([0.0, 0.0, -weight])
    return np.concatenate([force + pull, moment + np.cross(rotation @ (centre - about), pull)])


def box_restoring(about: np.ndarray, centre: np.ndarray, weight: float, rho_g: float) -> np.ndarray:
    """Restoring about a point by central differences."""
    step = 1e-4
    columns = [
        box_load(-step * unit, about, centre, weight, rho_g)
        - box_load(step * unit, about, centre, weight, rho_g)
        for unit in np.eye(6)
    ]
    return np.array(columns).T / (2.0 * step)


@pytest.mark.parametrize("lift", [0.0, 0.15], ids=["floating by itself", "lighter than its displacement"])
def test_restoring_of_a_box_about_another_point(lift: float) -> None:
    rho_g = 1025.0 * 9.81
    buoyancy = rho_g * float(np.prod(BOX))
    centre = np.array([0.0, 0.0, 0.7])
    weight = (1.0 - lift) * buoyancy
    about = {
        place: box_restoring(np.array(place), centre, weight, rho_g) for place in [(0.0, 0.0, 0.0), *POINTS]
    }
    origin = about[0.0, 0.0, 0.0]
    closed = rho_g * BOX[0] * BOX[1] * np.array([1.0, BOX[1] ** 2 / 12, BOX[0] ** 2 / 12])
    closed[1:] += -buoyancy * BOX[2] / 2 - weight * centre[2]
    assert np.diag(origin)[2:5] == pytest.approx(closed, rel=1e-6)
    base = full(restoring=origin, additional=(), roll_damping=None)
    for point in POINTS:
        found = base.at(point, net_lift=lift * buoyancy).restoring
        assert found == pytest.approx(about[point], rel=1e-6, abs=1e-6 * closed[2])
        if lift:
            assert np.abs(base.at(point).restoring - about[point]).max() > 1e-3 * closed[1]


# --- what cannot be moved, bad points


def test_quadratic_damping_of_a_translation_is_named() -> None:
    base = full(quadratic_damping=np.array([0.0, 5e4, 0.0, 7e8, 0.0, 9e9]))
    with pytest.warns(QuadraticDampingWarning, match=r"quadratic_damping\[1\] = 5e\+04 belongs to"):
        there = base.at((6.0, 0.0, 0.0))
    assert np.array_equal(there.quadratic_damping, base.quadratic_damping)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        base.at((0.0, 3.0, 0.0))  # sway keeps its velocity when the point moves along y
        dataclasses.replace(base, quadratic_damping=np.array([0, 0, 0, 7e8, 1e9, 9e9])).at((6.0, 2.0, 1.0))


@pytest.mark.parametrize("point", [(1.0, 2.0), (1.0, np.nan, 0.0), np.zeros((2, 3)), (np.inf, 0.0, 0.0)])
def test_a_point_is_three_finite_numbers(point: Any) -> None:
    with pytest.raises(ValueError, match="is not three finite numbers"):
        full().at(point)
    with pytest.raises(ValueError, match="net_lift is nan"):
        full().at((1.0, 0.0, 0.0), net_lift=float("nan"))


@pytest.mark.slow("real ships")
def test_limits_of_the_closure_follow_the_motions_that_mix(shared: Path) -> None:
    base = load_database(shared / "veres" / "supply")
    there = base.at((0.0, 3.0, 0.0))  # heave there holds roll, which the files give with fewer digits
    assert there.motion_rao_limit == pytest.approx([1e-3, 1e-3, 1e-3, 1e-3, 1e-5, 1e-3])
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", InfiniteFrequencyWarning)
        rows = {row.check: row for row in there.check()}
    assert all(
        rows[f"motion_rao_{name}"].verdict == "pass" for name in ("surge", "sway", "roll", "pitch", "yaw")
    )


@pytest.fixture(scope="module")
def barge() -> Any:
    """A barge in deep water: in finite depth Capytaine fits at random points, up to 0.4 % from run to run."""
    capytaine = pytest.importorskip("capytaine", reason="capytaine absent: pip install .[hydro]")
    import xarray

    logging.getLogger("capytaine").setLevel(logging.ERROR)

    def solve(centre: tuple[float, float, float], path: Path) -> HydroDatabase:
        mesh = capytaine.mesh_parallelepiped(
            size=(24.0, 8.0, 4.0), center=(3.0, 0.0, 0.0), resolution=(10, 4, 4)
        )
        body = capytaine.FloatingBody(
            mesh=mesh.immersed_part(),
            dofs=capytaine.rigid_body_dofs(rotation_center=centre),
            center_of_mass=(3.0, 0.0, 0.5),
            name="barge",
        )
        body.inertia_matrix = body.compute_rigid_body_inertia()
        body.hydrostatic_stiffness = body.compute_hydrostatic_stiffness()
        study = xarray.Dataset(
            coords={
                "omega": [0.6, 1.2],
                "wave_direction": np.radians([0.0, 40.0, 90.0, 150.0, 300.0]),
                "radiating_dof": list(body.dofs),
            }
        )
        capytaine.export_dataset(path, capytaine.BEMSolver().fill_dataset(study, [body], progress_bar=False))
        return load_database(path)

    return solve


def test_capytaine_about_two_rotation_centres(barge: Any, tmp_path: Path) -> None:
    """The same panels, twice solved: what Capytaine gives about the other centre is what at() makes.

    Not its inertia, which mixes the volume's centroid (moments) with the centre of mass (couplings).
    """
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        first = dataclasses.replace(
            barge((3.0, 0.0, 0.0), tmp_path / "one.nc"), port_starboard_symmetric=False
        )
        second = barge((-2.0, 1.5, -1.0), tmp_path / "two.nc")
    there = first.at((-5.0, 1.5, -1.0))
    for name in ("added_mass", "damping", "restoring"):
        wanted = getattr(second, name)
        scale = np.sqrt(np.abs(np.diagonal(wanted, axis1=-2, axis2=-1)).reshape(-1, 6).max(axis=0))
        scale[scale == 0.0] = scale.max()
        error = np.abs(getattr(there, name) - wanted) / np.outer(scale, scale)
        assert error.max() < 1e-10, name
    assert np.abs(there.force - second.force).max(axis=(0, 1)) == pytest.approx(
        np.zeros(6), abs=1e-12 * np.abs(second.force).max()
    )


# --- mirror


def test_mirroring_twice_is_the_same_database() -> None:
    base = dataclasses.replace(full(), memory=shipped_database().memory)
    once = base.mirror()
    assert_same(once.mirror(), base, 1e-13)
    assert once.source.endswith("mirrored in the centre plane") and once.mirror().source == base.source
    assert np.abs(once.force - base.force).max() > 0.0


def test_a_mirrored_vessel_answers_mirrored_waves_with_mirrored_motions() -> None:
    base = full()
    once = base.mirror()
    motions = motion_response(base)
    for m, heading in enumerate(base.heading):
        at = int(np.argmin(np.abs(np.angle(np.exp(1j * (once.heading + heading))))))
        assert motion_response(once)[at] == pytest.approx(motions[m] * PARITY, rel=1e-9, abs=1e-12)


def test_a_symmetric_vessel_is_its_own_mirror_image() -> None:
    base = shipped_database()
    once = base.mirror()
    for a, b in zip(base.full_circle(), once.full_circle(), strict=True):
        assert np.abs(a - b).max() <= 1e-12 * np.abs(a).max()
    query = np.radians([17.0, 123.0, 291.0])
    assert once.force_at(0.7, query) == pytest.approx(base.force_at(0.7, query), rel=1e-9, abs=1e-3)
    for name in ("added_mass", "damping", "restoring", "mass_matrix"):
        scale = np.abs(getattr(base, name)).max()
        assert getattr(once, name) == pytest.approx(getattr(base, name), abs=1e-3 * scale)
    before, after = (np.linalg.eigvals(free_vessel_system(vessel_parameters(d))) for d in (base, once))
    assert np.abs(before[:, None] - after).min(axis=1).max() < 1e-12


def test_mirror_and_point_commute() -> None:
    base = dataclasses.replace(full(), memory=shipped_database().memory)
    assert_same(base.at((4.0, 3.0, -2.0)).mirror(), base.mirror().at((4.0, -3.0, -2.0)), 1e-12)
