"""Headings far from midship, groups about centres of gravity, and the seas of small hulls."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from group_cases import written_pair

from seacrane import MotionRaos
from seacrane.hydro import HydroGroup, fit_memory, shipped_database
from seacrane.hydro.data.excitation import force_on_grid
from seacrane.hydro.memory.motion_judge import peak_periods


@pytest.mark.parametrize("along", [-57.5, 40.0])
def test_forces_far_from_midship_are_as_good_as_there(along: float) -> None:
    """Every 15 deg of the shipped hull, halfway between, against its 5 deg: 1.5 % at the stern before."""
    fine = shipped_database()
    coarse = fine.select(every_heading=3)
    omega, heading = np.meshgrid([0.5, 0.7, 0.9], np.radians(np.arange(7.5, 360.0, 15.0)))
    size = np.abs(fine.force).max(axis=(0, 1))[2]

    def error(x: float) -> float:
        true, got = (one.at((x, 0.0, 0.0)).force_at(omega, heading)[..., 2] for one in (fine, coarse))
        return float(np.abs(got - true).max() / size)

    assert error(along) < 1.2 * error(0.0) < 0.002
    far = coarse.at((along, 0.0, 0.0))
    grid = force_on_grid(far, omega[0], heading[:, 0])
    assert np.abs(grid - far.force_at(omega, heading)).max() <= 1e-9 * np.abs(far.force).max()


def test_motions_about_the_stern() -> None:
    omega, heading = np.arange(0.2, 1.61, 0.1), np.radians(np.arange(0.0, 360.0, 30.0))

    def heave(w: np.ndarray, b: np.ndarray) -> np.ndarray:
        return np.exp(-((w / 0.9) ** 4) / 3.0) * np.exp(60j * w**2 / 9.81 * np.cos(b))

    values = heave(omega[:, None], heading[:, None, None]) * np.eye(6)[2]
    raos = MotionRaos(omega=omega, heading=heading, values=values, symmetric=False)
    between = heading + np.radians(15.0)
    for w in (0.6, 0.9):
        at = np.full(between.size, w)
        assert np.abs(raos.at(at, between)[:, 2] - heave(at, between)).max() < 0.01


def test_a_group_is_moved_as_its_hulls_are() -> None:
    pair = written_pair(heading=np.pi)
    point = np.array([3.0, 1.0, -2.0])
    moved = pair.at({"feeder": point})
    assert np.array_equal(moved.bodies[0].position, pair.bodies[0].position)
    assert moved.bodies[1].position == pytest.approx(pair.bodies[1].position + np.array([-3.0, -1.0, -2.0]))
    alone, there = pair["feeder"].at(point), moved["feeder"]
    for name in ("added_mass", "damping", "mass_matrix", "restoring", "force"):
        mine, theirs = getattr(there, name), getattr(alone, name)
        assert np.abs(mine - theirs).max() <= 1e-9 * np.abs(theirs).max(), name
    back = moved.at({"feeder": -point})
    assert np.abs(back.added_mass - pair.added_mass).max() <= 1e-9 * np.abs(pair.added_mass).max()
    hull = shipped_database().select(every=12, every_heading=6)
    places = {"a": (0.0, 0.0, 1.0), "b": (300.0, 0.0, 1.0)}
    line = HydroGroup.from_databases(databases={"a": hull, "b": hull}, positions=places)
    aside = line.at({"b": (0.0, 5.0, 0.0)})
    assert line.port_starboard_symmetric and not aside.port_starboard_symmetric
    assert aside.heading.size == 2 * (line.heading.size - 1)


def test_a_small_hull_is_judged_in_its_own_seas() -> None:
    """Ships keep 5 to 18 s; a hull of 1:10 meets those of its scale, and its memory keeps the limit there."""
    assert peak_periods(115.0) == pytest.approx(np.geomspace(5.0, 18.0, 9), rel=1e-12)
    small = peak_periods(11.5)
    assert small[0] == pytest.approx(5.0 * np.sqrt(0.1)) and small[-1] > 18.0 * np.sqrt(0.1)
    full = replace(shipped_database(), memory=None, motion_rao=None)
    turns, time = np.array([0, 0, 0, 1, 1, 1]), np.sqrt(0.1)
    mass = 0.1 ** (3.0 + turns[:, None] + turns)
    low, high = full.trusted_band or (0.3, 2.5)
    infinite = full.infinite_frequency_added_mass
    model = replace(
        full, omega=full.omega / time, added_mass=full.added_mass * mass, damping=full.damping * mass / time,
        restoring=full.restoring * mass / 0.1, mass_matrix=full.mass_matrix * mass,
        force=full.force * 0.1 ** (2.0 + turns), linear_damping=full.linear_damping * mass / time,
        infinite_frequency_added_mass=infinite * mass, zero_frequency_added_mass=None,
        length=11.5, breadth=full.breadth / 10.0, draught=full.draught / 10.0,
        trusted_band=(low / time, high / time),
    )  # fmt: skip
    memory = fit_memory(database=model)
    assert memory.motion is not None and memory.motion.reached
