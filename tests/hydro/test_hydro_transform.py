"""HydroDatabase.at and mirror: another reference point, the mirrored vessel."""

from __future__ import annotations

import dataclasses
import itertools
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

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
from seacrane.hydro.vessel.parameters import free_vessel_system
from seacrane.sea.dispersion import wavenumber
from seacrane.warnings import QuadraticDampingWarning

PARITY = np.array([1.0, -1.0, 1.0, -1.0, 1.0, -1.0])
POINTS = [(7.0, 0.0, 0.0), (0.0, 0.0, -3.0), (-11.0, 4.0, 2.5)]
MATRICES = (
    "added_mass", "damping", "infinite_frequency_added_mass", "zero_frequency_added_mass", "mass_matrix",
    "linear_damping", "restoring",
)  # fmt: skip


def full(**changes: Any) -> HydroDatabase:
    """Part of the shipped hull with every optional part filled; 45 m of water; not symmetric."""
    rng = np.random.default_rng(3)
    coarse = shipped_database().select(every=4, every_heading=6)
    n, m = len(coarse.omega), len(coarse.heading)
    tanks = {name: rng.normal(size=(n, 6, 6)) * 1e6 for name in ("added_mass", "damping", "restoring")}
    drift = {"heading": np.radians([0.0, 60.0, 120.0]), "omega": np.array([0.5, 1.0])}
    values: dict[str, Any] = {
        "linear_damping": np.diag([1.0, 2.0, 3.0, 400.0, 900.0, 800.0]) * 1e5 + rng.normal(size=(6, 6)) * 1e5,
        "roll_damping": RollDamping(
            linear=np.linspace(1e7, 2e7, n), quadratic=np.full(n, 1e8), linearised=rng.random((m, n)) * 1e7
        ),
        "additional": (AdditionalMatrices(cause="roll tanks", **tanks),),
        "drift": DriftCoefficients(**drift, coefficient=rng.normal(size=(3, 2, 6)) * 1e4),
        "motion_rao": rng.normal(size=(m, n, 6)) + 1j * rng.normal(size=(m, n, 6)),
        "depth": 45.0,
        "port_starboard_symmetric": False,
    }
    return dataclasses.replace(coarse, **(values | changes))


def assert_same(found: HydroDatabase, base: HydroDatabase, tolerance: float) -> None:
    """Every array alike, by its largest entry; memory by its response."""
    w = np.geomspace(0.05, 10.0, 40)
    parts = [(found, base, (*MATRICES, "force", "motion_rao", "heading", "omega"))]
    parts += [
        (a, b, ("added_mass", "damping", "restoring"))
        for a, b in zip(found.additional, base.additional, strict=True)
    ]
    parts += [(found.drift, base.drift, ("heading", "coefficient"))]
    parts += [(found.roll_damping, base.roll_damping, ("linearised",))]
    pairs = [(name, getattr(a, name), getattr(b, name)) for a, b, names in parts for name in names]
    if base.memory is not None:
        assert found.memory is not None and found.memory.states == base.memory.states
        pairs += [("K", found.memory.transfer(w), base.memory.transfer(w))]
        pairs += [("A_inf", found.memory.added_mass, base.memory.added_mass)]
    for name, a, b in pairs:
        scale = np.abs(b).max() if b.ndim < 2 else np.abs(b).max(axis=tuple(range(b.ndim - 1)))
        assert np.all(np.abs(a - b) <= tolerance * np.maximum(scale, np.abs(b).max() * 1e-6)), name


@pytest.mark.parametrize("point", POINTS)
def test_moves_and_mirrors_undo_each_other(point: Any) -> None:
    base = full(memory=shipped_database().memory)
    x, y, z = point
    for phase_origin in (True, False):
        there = base.at(point, phase_origin=phase_origin, net_lift=2e7)
        assert_same(there.at((-x, -y, -z), phase_origin=phase_origin, net_lift=2e7), base, 1e-13)
        if (x or y) and phase_origin:
            assert np.abs(there.force - base.force).max() > 0.1 * np.abs(base.force).max()
    once = base.mirror()
    assert_same(once.mirror(), base, 1e-13)
    assert np.abs(once.force - base.force).max() > 0.0
    assert_same(base.at(point).mirror(), once.at((x, -y, z)), 1e-12)


@pytest.mark.parametrize("point", POINTS)
def test_motions_at_the_new_point_are_those_the_rigid_body_has_there(point: Any) -> None:
    """Solved after moving = solved before, carried by ``x + theta x r``, with the wave's phase at r."""
    base = full()
    there, stay = base.at(point), base.at(point, phase_origin=False)
    k = wavenumber(base.omega, g=base.g, depth=base.depth)
    assert base.g * k * np.tanh(k * base.depth) == pytest.approx(base.omega**2, rel=1e-12)
    along = point[0] * np.cos(base.heading) + point[1] * np.sin(base.heading)
    phase = np.exp(1j * np.outer(along, k))[:, :, None]

    def carried(motions: Any) -> np.ndarray:
        return np.concatenate(
            [motions[..., :3] + np.cross(motions[..., 3:], point), motions[..., 3:]], axis=-1
        )

    before = carried(motion_response(base))
    assert motion_response(there) == pytest.approx(before * phase, rel=1e-9, abs=1e-12)
    assert motion_response(stay) == pytest.approx(before, rel=1e-9, abs=1e-12)
    assert there.motion_rao == pytest.approx(carried(base.motion_rao) * phase, rel=1e-12)


def test_moments_and_power_do_not_depend_on_the_point() -> None:
    """Loads do the same work, kinetic energy and dissipation stay, at any point."""
    base, point, old = full(), np.array([-9.0, 3.0, 4.0]), np.random.default_rng(1).normal(size=6)
    there = base.at(point, phase_origin=False)
    new = np.concatenate([old[:3] + np.cross(old[3:], point), old[3:]])
    assert np.einsum("mni,i->mn", there.force, new) == pytest.approx(np.einsum("mni,i->mn", base.force, old))
    for name in MATRICES[:-1]:
        assert new @ getattr(there, name) @ new == pytest.approx(old @ getattr(base, name) @ old), name
    assert there.drift.coefficient @ new == pytest.approx(base.drift.coefficient @ old)


def test_the_free_vessel_with_memory_by_motion_has_the_same_eigenvalues() -> None:
    base = shipped_database()
    base = dataclasses.replace(base, memory=fit_memory(database=base))
    there = base.at((12.0, -5.0, 3.0))
    before, after = (np.linalg.eigvals(free_vessel_system(vessel_parameters(d))) for d in (base, there))
    distance = np.abs(before[:, None] - after)
    assert len(before) == len(after)
    assert distance.min(axis=1).max() < 1e-10 and distance.min(axis=0).max() < 1e-10
    assert all(is_energy_form(block) for block in there.memory.blocks)
    assert passivity_certificate(there.memory).passive


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
    there = load_database(folder).at((expected["header"]["LCG_aft_of_midship"], 0, 0), phase_origin=False)
    ours, mss = expected["xfwd_yport_zup"]["at_midship_waterline"], expected["mss_fossen_axes"]
    turn = np.diag([1.0, -1.0, -1.0, 1.0, -1.0, -1.0])  # x forward, y starboard, z down
    for name, symbol in (("added_mass", "A"), ("damping", "B")):
        for key, matrix in ours[symbol].items():
            assert getattr(there, name)[int(key)] == pytest.approx(np.array(matrix), rel=1e-12, abs=1e-3)
        for key, matrix in mss[symbol].items():
            found = (turn @ getattr(there, name)[int(key)] @ turn)[1:, 1:]  # without surge
            assert found == pytest.approx(np.array(matrix)[1:, 1:], rel=1e-9, abs=1e-3)
    for key, pairs in ours["force_rao"].items():
        frequency, direction = key.split(",mu=")
        at = int(np.argmin(np.abs(np.angle(np.exp(1j * (there.heading - np.radians(float(direction))))))))
        wanted = np.array(pairs) @ [1.0, 1j]
        assert np.abs(there.force[at, int(frequency)] - wanted).max() < 1e-9 * np.abs(pairs).max()
    assert turn @ there.mass_matrix @ turn == pytest.approx(np.array(mss["MRB"]), rel=1e-9, abs=1e-2)
    assert turn @ there.restoring @ turn == pytest.approx(np.array(mss["C"]), rel=1e-9, abs=1e-2)


@pytest.mark.parametrize("point", POINTS)
def test_restoring_about_another_point_is_that_of_the_same_loads(point: Any) -> None:
    """Of a box, by moments about the point that turns with it; a net lift has a lever about the new point.

    Wall-sided at small angles: buoyancy by the waterplane of the displaced box, weight at its centre.
    """
    rho_g, (length, breadth, draught) = 1025.0 * 9.81, (30.0, 8.0, 2.5)
    centre, buoyancy = np.array([0.0, 0.0, 0.7]), rho_g * length * breadth * draught

    def restoring(about: Any, weight: float) -> np.ndarray:
        nodes = np.sqrt(1.0 / 12.0) * np.array([-1.0, 1.0])  # Gauss points of two, exact for squares
        total = np.zeros((6, 6))
        for x, y in itertools.product(length * nodes, breadth * nodes):
            arm, column = np.array([x, y, -draught / 2]) - about, rho_g * length * breadth / 4
            for j, unit in enumerate(np.eye(6)):  # a motion of the point, small angles
                rise = unit[2] + np.cross(unit[3:], (x, y, 0.0) - np.array(about))[2]
                turned = np.cross(unit[3:], arm)
                lost = np.array([0.0, 0.0, column * rise])
                surface = np.array([x, y, 0.0]) - about
                total[:, j] += np.concatenate([lost, np.cross(surface, lost)])
                total[3:, j] -= np.cross(turned, (0.0, 0.0, column * draught))
        for j, turn in enumerate(np.eye(3)):
            total[3:, 3 + j] += np.cross(np.cross(turn, centre - about), (0.0, 0.0, weight))
        return total

    for share in (0.0, 0.15):
        weight = (1.0 - share) * buoyancy
        base = full(restoring=restoring(np.zeros(3), weight), additional=(), roll_damping=None)
        c33 = rho_g * length * breadth
        metacentre = c33 * breadth**2 / 12 - buoyancy * draught / 2 - weight * centre[2]
        assert base.restoring[[2, 3], [2, 3]] == pytest.approx([c33, metacentre])
        wanted = restoring(point, weight)
        found = base.at(point, net_lift=share * buoyancy).restoring
        assert found == pytest.approx(wanted, abs=1e-9 * np.abs(wanted).max())
        if share:
            assert np.abs(base.at(point).restoring - wanted).max() > 1e-3 * metacentre


def test_what_cannot_be_moved_is_named() -> None:
    base = full(quadratic_damping=np.array([0.0, 5e4, 0.0, 7e8, 0.0, 9e9]))
    with pytest.warns(QuadraticDampingWarning, match=r"quadratic_damping\[1\] = 5e\+04"):
        there = base.at((6.0, 0.0, 0.0))
    assert np.array_equal(there.quadratic_damping, base.quadratic_damping)
    base.at((0.0, 3.0, 0.0))  # sway keeps its velocity when the point moves along y
    dataclasses.replace(base, quadratic_damping=np.array([0, 0, 0, 7e8, 1e9, 9e9])).at((6.0, 2.0, 1.0))
    with pytest.raises(ValueError, match="three finite numbers"):
        base.at((1.0, np.nan, 0.0))


def test_a_mirrored_vessel_answers_mirrored_waves_with_mirrored_motions() -> None:
    base = full()
    once = base.mirror()
    motions = motion_response(base)
    for m, heading in enumerate(base.heading):
        at = int(np.argmin(np.abs(np.angle(np.exp(1j * (once.heading + heading))))))
        assert motion_response(once)[at] == pytest.approx(motions[m] * PARITY, rel=1e-9, abs=1e-12)
