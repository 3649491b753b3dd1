"""Aqwa's database and listing: each against the other, RM3 against three codes, files that we wrote."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest
from aqwa_writer import ah1, listing, run_of, run_of_group
from test_hydro_group_rm3 import three_codes

from seacrane.hydro import (
    HydroDatabase,
    HydroGroup,
    load_database,
    motion_response,
    read_aqwa,
    shipped_database,
    two_barges,
)
from seacrane.warnings import FloatingPositionWarning, RoundedPhaseWarning

PLACE = np.array([3.0, 0.5, 0.0])  # of the centre of gravity, from the reference point
MATRICES = ("added_mass", "damping")
pytestmark = pytest.mark.filterwarnings("ignore::seacrane.warnings.SourceWarning")


@pytest.fixture(scope="module")
def aqwa(shared: Path) -> Path:
    if not (shared / "aqwa").is_dir():
        pytest.skip(f"no {shared / 'aqwa'}")
    return shared / "aqwa"


@pytest.fixture(scope="module")
def hull() -> HydroDatabase:
    base = shipped_database().select(every=9, every_heading=6)
    base = dataclasses.replace(base, linear_damping=np.zeros((6, 6)), depth=1000.0, trusted_band=None)
    base = dataclasses.replace(base, memory=None).at(-PLACE)
    return dataclasses.replace(base, motion_rao=motion_response(base))


def centre(hull: HydroDatabase) -> tuple[float, float, float]:
    return 3.0, 0.5, float(hull.mass_matrix[0, 4] / hull.mass_matrix[0, 0])


def test_cylinder_of_database_and_listing(aqwa: Path) -> None:
    """To the digits of each; the listing's own motions follow from matrices and loads of either."""
    with pytest.warns(FloatingPositionWarning, match="C44"):
        found = read_aqwa(aqwa / "cylinder.AH1")
    with pytest.warns((FloatingPositionWarning, RoundedPhaseWarning)):
        listed = read_aqwa(aqwa / "cylinder.LIS")
    assert np.degrees(found.heading) == pytest.approx([0.0, 180.0])
    assert (found.rho, found.g, found.depth) == (listed.rho, listed.g, listed.depth) == (1025.0, 9.807, 3.0)
    assert found.omega == pytest.approx(listed.omega, abs=1e-5)
    assert listed.mass_matrix == pytest.approx(found.mass_matrix, rel=2e-4)  # inertia in four digits
    for name in (*MATRICES, "restoring", "infinite_frequency_added_mass", "zero_frequency_added_mass"):
        ours, other = getattr(found, name), getattr(listed, name)
        assert np.abs(ours - other).max() <= 1e-6 * np.abs(ours).max(), name
    sizes = np.abs(found.force)
    assert np.all(np.abs(found.force - listed.force) <= 0.006 * sizes + 1e-3)
    moved = motion_response(dataclasses.replace(found, motion_rao=None))
    for i in (0, 2, 4):  # those that a round body has in waves along its axis
        assert np.abs(moved[..., i] - listed.motion_rao[..., i]).max() <= 2e-3 * np.abs(moved[..., i]).max()


def test_rm3_of_four_codes(aqwa: Path, shared: Path) -> None:
    """Loads with their phases, and matrices, as far as the codes agree.

    Aqwa's surge of float and spar is coupled as by water in a narrow gap between them: both moving as one are
    compared in it. It is in 49.5 m of water, the others in deep water, which long waves tell.
    """
    found = read_aqwa(aqwa / "RM3.AH1")
    assert found.names == ("structure1", "structure2")
    w = found.omega[18]
    for name, other in three_codes(shared / "rm3").items():
        k = int(np.abs(other.omega - w).argmin())
        for i, most in {2: 0.02, 4: 0.03}.items():  # heave and pitch of the float
            assert abs(found.force[0, 18, i] / other.force[0, k, i] - 1.0) <= most, (name, i)
            for table in MATRICES:
                ours, theirs = getattr(found, table)[18, i, i], getattr(other, table)[k, i, i]
                assert ours == pytest.approx(theirs, rel=2.0 * most), (name, table, i)
        turned = np.angle(found.force[0, 18] / other.force[0, k], deg=True)
        assert np.abs(turned[[0, 2, 4, 6, 8, 10]]).max() < 1.5, name
        for table, most in (("added_mass", 0.06), ("damping", 0.05), ("force", 0.02)):
            ours, theirs = joined(found, table)[18], joined(other, table)[k]
            assert abs(ours / theirs - 1.0) <= most, (name, table)


def joined(group: HydroGroup, table: str) -> np.ndarray:
    """Surge of both as one, waves along +x."""
    if table == "force":
        return np.asarray(group.force[0, :, 0] + group.force[0, :, 6])
    return np.asarray(getattr(group, table)[:, ::6, ::6].sum(axis=(1, 2)))


def test_the_shipped_hull_comes_back(hull: HydroDatabase, tmp_path: Path) -> None:
    """From a centre of gravity off its reference point, where Aqwa's waves have their crest."""
    run = run_of(hull, centre(hull))
    damped = dataclasses.replace(run, other_damping=np.array([[1e4, 0.0, 0.0, 7e7, 0.0, 0.0]]))
    (tmp_path / "ship.AH1").write_text(ah1(damped, 10) + "FARFIELD\n  1  1  1  0.0\n")
    (tmp_path / "ship.LIS").write_text(listing(run))
    found = load_database(tmp_path).at(-PLACE)  # the database, where both are there
    with pytest.warns(RoundedPhaseWarning):
        listed = load_database(tmp_path / "ship.LIS").at(-PLACE)
    assert found.linear_damping[3, 3] == pytest.approx(7e7)
    assert found.source == "Aqwa file ship.AH1; left out: FARFIELD"
    for one, digits in ((found, 1e-7), (listed, 6e-3)):
        assert one.heading == pytest.approx(hull.heading, abs=1e-6)
        for name in (*MATRICES, "force", "mass_matrix", "restoring", "infinite_frequency_added_mass"):
            ours = getattr(hull, name)
            for i in range(6):  # by the largest of each motion
                size = np.abs(ours[..., i]).max()
                assert np.abs(getattr(one, name)[..., i] - ours[..., i]).max() <= digits * size, (name, i)
    rows = [row.value for row in listed.check() if row.check.startswith("motion_rao")]
    assert len(rows) == 6 and max(rows) < 0.05
    old = ah1(run, 10).replace("LHFR", "NONE").replace("GENERAL\n  1 ", "GENERAL\n")
    (tmp_path / "old.AH1").write_text(old)
    assert read_aqwa(tmp_path / "old.AH1").depth == 1000.0


def test_a_pair_comes_back(tmp_path: Path) -> None:
    """Several structures: places of blocks, and phases of each at the origin of all."""
    pair = dataclasses.replace(two_barges(lid_damping=None), depth=500.0)
    (tmp_path / "pair.AH1").write_text(ah1(run_of_group(pair), 10))
    found = read_aqwa(tmp_path / "pair.AH1")
    assert isinstance(found, HydroGroup)
    for name in (*MATRICES, "force"):
        ours, other = getattr(pair, name), getattr(found, name)
        assert np.abs(ours - other).max() <= 1e-8 * np.abs(ours).max()
