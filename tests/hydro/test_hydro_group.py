"""`HydroGroup` against closed forms and single hulls; files of two bodies come back, damage is named."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from group_cases import bemio_file, capytaine_dataset, capytaine_file, nemoh_folder, wamit_files, written_pair
from scipy.special import j0

from seacrane import Scene
from seacrane.errors import FileFormatError, SceneError
from seacrane.hydro import (
    GroupBody,
    HydroDatabase,
    HydroGroup,
    fit_memory,
    load_database,
    load_hull,
    motion_response,
    piston_frequency,
    read_bemio,
    read_capytaine,
    read_nemoh,
    read_wamit,
    shipped_database,
    spikes,
)
from seacrane.hydro.data.packed import packed, unpacked
from seacrane.hydro.data.relations import damping_from_forces
from seacrane.hydro.group.gap import irregular_frequencies
from seacrane.warnings import AssumedReferenceWarning, RoundedPhaseWarning

APART = (0.0, 120.0, 0.0)  # m


@pytest.fixture(scope="module")
def hull() -> HydroDatabase:
    return shipped_database().select(every=3, every_heading=2)


def beside(hull: HydroDatabase, *, heading: float = 0.0, place: tuple[float, ...] = APART) -> HydroGroup:
    return HydroGroup.from_databases(
        databases={"one": hull, "two": hull},
        positions={"one": (0.0, 0.0, 0.0), "two": place},
        headings={"two": heading},
    )


def test_a_hull_of_a_group_is_the_database_it_was_made_of_and_moves_as_alone(hull: HydroDatabase) -> None:
    """Matrices to the last bit; forces at every heading, whatever place and heading the hull has."""
    for heading in (0.0, np.pi, np.pi / 2):
        group = beside(hull, heading=heading)
        found = group["two"]
        for name in ("added_mass", "damping", "mass_matrix"):
            assert np.array_equal(getattr(found, name), getattr(hull, name))
        expected = hull.force_at(hull.omega[None, :], found.heading[:, None])
        assert np.abs(found.force - expected).max() <= 1e-9 * np.abs(expected).max()
        if heading == 0.0:
            for name, y in (("one", 0.0), ("two", APART[1])):
                along = np.exp(1j * np.outer(np.sin(group.heading) * y, group.omega**2 / group.g))
                moved = group.motion_rao[:, :, group.place(name)] * along[:, :, None]
                assert moved == pytest.approx(motion_response(group[name]), rel=1e-9, abs=1e-12)


def test_a_point_of_a_turned_hull_lies_along_its_own_axes(hull: HydroDatabase) -> None:
    moved = beside(hull, heading=np.pi / 2).at({"two": (2.0, 1.0, 0.0)})
    assert moved.bodies[1].position == pytest.approx(np.add(APART, (-1.0, 2.0, 0.0)))


def test_names_exchanged_exchange_everything() -> None:
    group = written_pair()
    other = group.ordered(["feeder", "crane"])
    assert other.names == ("feeder", "crane")
    assert np.array_equal(other.added_mass[:, :6, 6:], group.added_mass[:, 6:, :6])
    assert other.motion_rao[:, :, 6:] == pytest.approx(group.motion_rao[:, :, :6], rel=1e-9)
    assert other.ordered(["crane", "feeder"]).digest == group.digest
    found = unpacked(packed(group), (HydroGroup,))  # stored as bytes
    assert isinstance(found, HydroGroup)
    assert (found.digest, found.names) == (group.digest, group.names)


def axisymmetric(force: float) -> HydroDatabase:
    """A body in deep water that heaves alone, its damping by Haskind's relation from one force."""
    base = shipped_database().select(every=6)
    heave = np.zeros((6, 6))
    heave[2, 2] = 1.0
    x = np.zeros((72, len(base.omega), 6), dtype=complex)
    x[:, :, 2] = force * np.exp(-base.omega)
    damping = base.omega**3 / (2.0 * base.rho * base.g**3) * np.abs(x[0, :, 2]) ** 2
    return replace(
        base, heading=np.arange(72) * np.pi / 36, force=x, damping=damping[:, None, None] * heave,
        port_starboard_symmetric=False, memory=None, drift=None, length=1.0, breadth=1.0, trusted_band=None,
    )  # fmt: skip


@pytest.mark.parametrize("distance", [3.0, 12.0, 25.0])
def test_two_heaving_points_couple_by_j0(distance: float) -> None:
    """Far-field energy of two bodies alike: B12 / B11 = J0(k R), by the phases of the group's forces."""
    point = axisymmetric(1e6)
    group = beside(point, place=(0.6 * distance, 0.8 * distance, 0.0))
    radiated = damping_from_forces(group)
    k = group.omega**2 / group.g
    assert radiated[:, 2, 2] == pytest.approx(point.damping[:, 2, 2], rel=1e-9)
    assert radiated[:, 2, 8] / radiated[:, 2, 2] == pytest.approx(j0(k * distance), abs=2e-4)


def test_modes_of_two_masses_on_springs() -> None:
    """Heave of two hulls coupled by inertia: C - w^2 (M -+ a) = 0 in closed form."""
    stiffness, inertia, coupled, rate = 4.0e6, 1.0e6, 2.0e5, 3.0e4
    group = two_springs(stiffness, inertia, coupled, rate)
    found = list(group.natural_modes())
    expected = [np.sqrt(stiffness / (inertia + sign * coupled)) for sign in (1.0, -1.0)]
    assert [mode.omega for mode in found] == pytest.approx(expected, rel=1e-9)
    together, against = found
    assert together.shape[2] == pytest.approx(together.shape[8], rel=1e-9)
    assert against.shape[2] == pytest.approx(-against.shape[8], rel=1e-9)
    expected_ratio = rate / (2.0 * together.omega * (inertia + coupled))
    assert together.damping_ratio == pytest.approx(expected_ratio, rel=1e-9)
    assert together.period == pytest.approx(2.0 * np.pi / expected[0], rel=1e-9)


def two_springs(stiffness: float, inertia: float, coupled: float, rate: float) -> HydroGroup:
    omega, heave, at = np.linspace(0.2, 4.0, 39), np.zeros((6, 6)), np.array([0.0, 20.0, 0.0])
    heave[2, 2] = 1.0
    body = GroupBody(
        name="one", position=np.zeros(3), mass_matrix=0.5 * inertia * np.eye(6), restoring=stiffness * heave,
        length=10.0, breadth=5.0, draught=2.0,
    )  # fmt: skip
    added = np.kron(np.eye(2), 0.5 * inertia * heave) + np.kron(1.0 - np.eye(2), coupled * heave)
    damping = rate * np.kron(np.eye(2), heave)
    return HydroGroup(
        name="springs", bodies=(body, replace(body, name="two", position=at)), omega=omega,
        heading=np.zeros(1),
        added_mass=np.tile(added, (39, 1, 1)), damping=np.tile(damping, (39, 1, 1)),
        force=np.zeros((1, 39, 12)), source="closed form",
    )  # fmt: skip


def with_peak(group: HydroGroup, omega: float, height: float = 4.0) -> HydroGroup:
    damping = group.damping.copy()
    bell = 1.0 / (1.0 + ((group.omega - omega) / 0.02) ** 2)
    damping[:, 2, 2] += height * damping[:, 2, 2].max() * bell
    return replace(group, damping=damping)


def test_a_gap_is_told_apart_from_an_irregular_frequency() -> None:
    """Piston periods by hand, of two hulls of 20 m; the lowest eigenfrequency in a long box [Frank 1967]."""
    for draught, width, period in ((5.0, 3.0, 5.918), (5.0, 1.0, 5.142), (10.0, 3.0, 7.427)):
        found = 2.0 * np.pi / piston_frequency(draught=draught, gap=width, width=40.0 + width, g=9.80665)
        assert found == pytest.approx(period, abs=6e-4)
    long = replace(two_springs(1.0, 1.0, 0.0, 0.0).bodies[0], length=1e6)
    k = np.pi / long.breadth
    lowest = np.sqrt(9.81 * k / np.tanh(k * long.draught))
    assert irregular_frequencies(long, 9.81)[0] == pytest.approx(lowest, rel=1e-6)
    fine = shipped_database()
    group = beside(fine, place=(0.0, fine.breadth + 4.0, 0.0))
    [gap] = group.gaps()
    assert gap.width == pytest.approx(4.0, rel=1e-9)
    piston = piston_frequency(draught=fine.draught, gap=4.0, width=2.0 * fine.breadth + 4.0, g=fine.g)
    assert gap.piston == pytest.approx(piston, rel=1e-12)
    assert not spikes(group)
    [of_gap] = spikes(with_peak(group, 1.02 * gap.piston))
    assert (of_gap.cause, of_gap.of) == ("gap", "one-two")
    irregular = float(irregular_frequencies(group.bodies[0], fine.g)[0])
    [of_hull] = spikes(with_peak(group, irregular))
    assert (of_hull.cause, of_hull.expected) == ("irregular", pytest.approx(irregular))
    inside = replace(with_peak(group, irregular), trusted_band=(float(fine.omega[0]), float(fine.omega[-1])))
    failed = [row.check for row in inside.check() if row.verdict == "fail" and "frequency" in row.check]
    assert failed == ["irregular_frequency_one_rad_s"]


def test_the_check_names_what_is_wrong(hull: HydroDatabase) -> None:
    """Waves of hulls that do not feel each other add up far away, so that the damping must couple them."""

    def failing(group: HydroGroup) -> set[str]:
        return {row.check for row in group.check() if row.verdict == "fail"}

    assert failing(beside(hull, place=(0.0, 30.0, 0.0))) == {"damping_from_forces_one_two"}
    group = beside(hull)
    coupling, skewed = group.damping.copy(), group.added_mass.copy()
    coupling[:, 2, 8] = coupling[:, 8, 2] = 1.5 * group.damping[:, 2, 2]
    wrong = failing(replace(group, damping=coupling))
    assert {"damping_smallest_eigenvalue", "damping_from_forces_one_two"} <= wrong
    skewed[:, 2, 8] = 0.5 * group.added_mass[:, 2, 2]
    wrong = failing(replace(group, added_mass=skewed))
    assert "symmetry_added_mass_coupling" in wrong and "symmetry_added_mass" not in wrong


def test_requirements_and_groups_that_do_not_fit_are_refused_by_name(hull: HydroDatabase) -> None:
    group = written_pair()
    group.require(names=["crane", "feeder"], positions={"feeder": (6.0, 38.0, -1.5)}, apart=True)
    for given, message in (
        ({"names": ["feeder", "crane"]}, "use group.ordered"),
        ({"positions": {"feeder": (6.0, 38.0, 0.0)}}, r"feeder .* \(6, 38, -1.5\) m"),
        ({"draughts": {"feeder": 1.1 * group.bodies[1].draught}}, "feeder .* draught"),
    ):  # fmt: skip
        with pytest.raises(SceneError, match=message):
            group.require(**given)
    with pytest.raises(SceneError, match="one and two overlap by"):
        beside(hull, heading=np.pi / 2, place=(0.5 * hull.length, 0.0, 0.0))
    short = hull.select(omega=[0, 1, 2])
    for changes, message in (
        ({"depth": 40.0}, "depth is inf in 'one' and 40"), ({"rho": 1000.0}, "rho is 1025 in 'one' and 1000"),
        ({"omega": np.linspace(0.3, 1.0, 3)}, "other frequencies"),
    ):  # fmt: skip
        other = {"one": short, "two": replace(short, trusted_band=None, memory=None, **changes)}
        with pytest.raises(ValueError, match=message):
            HydroGroup.from_databases(databases=other, positions={"one": (0, 0, 0), "two": APART})


pytestmark = pytest.mark.filterwarnings("ignore::seacrane.warnings.RoughDataWarning")

Reader = Callable[..., HydroGroup]
FORMATS: dict[str, tuple[Callable[[HydroGroup, Path], Path], Reader]] = {
    "capytaine": (capytaine_file, read_capytaine),
    "wamit": (wamit_files, read_wamit),
    "nemoh": (nemoh_folder, read_nemoh),
    "bemio": (bemio_file, read_bemio),
}


@pytest.fixture(scope="module")
def pair() -> HydroGroup:
    return written_pair()


def masses(group: HydroGroup) -> dict[str, np.ndarray]:
    return {body.name: body.mass_matrix for body in group.bodies}


def assert_same(found: HydroGroup, group: HydroGroup, tolerance: float = 1e-9) -> None:
    assert found.names == group.names
    scale = np.sqrt(np.abs(np.diagonal(group.added_mass, axis1=1, axis2=2)).max(axis=0))
    both = np.outer(scale, scale)
    assert found.omega == pytest.approx(group.omega, rel=1e-9)
    assert found.heading == pytest.approx(group.heading, abs=1e-9)
    for name in ("added_mass", "damping"):
        assert np.abs((getattr(found, name) - getattr(group, name)) / both).max() < tolerance
    largest = np.abs(group.force).max(axis=(0, 1))
    assert np.abs((found.force - group.force) / largest).max() < tolerance
    for mine, its in zip(found.bodies, group.bodies, strict=True):
        assert mine.position == pytest.approx(its.position, abs=1e-9)
        assert mine.heading == pytest.approx(its.heading, abs=1e-9)
        assert np.abs(mine.restoring - its.restoring).max() <= 1e-9 * np.abs(its.restoring).max()
        assert np.abs(mine.mass_matrix - its.mass_matrix).max() <= 1e-9 * np.abs(its.mass_matrix).max()


@pytest.mark.parametrize("name", FORMATS)
def test_what_was_written_comes_back(name: str, pair: HydroGroup, tmp_path: Path) -> None:
    """Names, order, places, phases and which index is the load: coupling blocks are not symmetric here."""
    write, read = FORMATS[name]
    path = write(pair, tmp_path)
    given = {} if name == "capytaine" else {"mass_matrix": masses(pair)}
    assert_same(read(path, **given), pair)
    found = load_database(path)
    assert isinstance(found, HydroGroup) and found.names == pair.names
    with pytest.raises(FileFormatError, match="crane, feeder, and one hull"):
        load_hull(path)


def test_wamit_turned_and_by_its_listing_alone(pair: HydroGroup, tmp_path: Path) -> None:
    """PHIBODY: matrices and forces are in the body's own axes, phases stay at the global origin."""
    turned = written_pair(heading=np.pi)
    assert_same(read_wamit(wamit_files(turned, tmp_path), mass_matrix=masses(turned)), turned)
    for file in tmp_path.iterdir():
        file.unlink()
    path = wamit_files(pair, tmp_path, numbers=False)
    with pytest.warns(RoundedPhaseWarning, match="degrees"):
        found = read_wamit(path, mass_matrix=masses(pair))
    assert_same(replace(found, force=pair.force), pair)
    off = np.abs(found.force - pair.force) / np.maximum(np.abs(pair.force), 1e-300)
    assert 1e-4 < off.max() <= np.radians(0.5) + 1e-6


def test_rotation_centres_that_a_file_does_not_tell(pair: HydroGroup, tmp_path: Path) -> None:
    path = tmp_path / "silent.nc"
    capytaine_dataset(pair).drop_vars("rotation_center").to_netcdf(path)
    with pytest.warns(AssumedReferenceWarning, match="crane, feeder"):
        found = read_capytaine(path)
    assert not np.any([body.position for body in found.bodies])
    told = {body.name: body.position for body in pair.bodies}
    assert_same(read_capytaine(path, rotation_centre=told), pair)
    with pytest.raises(FileFormatError, match=r"rotation_centre .* crane"):
        read_capytaine(path, rotation_centre={"crane": (0.0, 0.0, 0.0)})


def test_hydrostatics_in_another_order_are_named(pair: HydroGroup, tmp_path: Path) -> None:
    """The files of two unlike bodies exchanged: a long wave lifts each with its own C33 alone."""
    bodies = (pair.bodies[0], replace(pair.bodies[1], restoring=2.0 * pair.bodies[1].restoring))
    unlike = replace(pair, bodies=bodies)
    force = pair.force.copy()
    force[:, :, 6:] *= 2.0
    force[:, 0, 2::6] = np.diag(unlike.restoring)[2::6]
    unlike = replace(unlike, omega=0.1 * pair.omega, force=force)
    folder = nemoh_folder(unlike, tmp_path)
    read_nemoh(folder, mass_matrix=masses(unlike))
    for source, target in (("Kh_0", "spare"), ("Kh_1", "Kh_0"), ("spare", "Kh_1")):
        shutil.move(folder / "Mesh" / f"{source}.dat", folder / "Mesh" / f"{target}.dat")
    with pytest.raises(FileFormatError, match=r"restoring of crane has C33 = .* of feeder"):
        read_nemoh(folder, mass_matrix=masses(unlike))


def test_damage_is_named(pair: HydroGroup, tmp_path: Path) -> None:
    for damage, message in (
        (lambda d: d.isel(influenced_dof=slice(1, None)), "only one of influenced_dof .* holds crane__"),
        (lambda d: d.assign_coords(forward_speed=2.0), "forward_speed is 2"),
    ):
        damage(capytaine_dataset(pair)).to_netcdf(tmp_path / "pair.nc")
        with pytest.raises(FileFormatError, match=rf"pair\.nc: .*{message}"):
            read_capytaine(tmp_path / "pair.nc")
    folder = nemoh_folder(pair, tmp_path)
    control = folder / "Nemoh.cal"
    control.write_text(control.read_text().replace("38.0", "39.0", 1))
    with pytest.raises(FileFormatError, match="body 2 turn about 2"):
        read_nemoh(folder, mass_matrix=masses(pair))
    path = bemio_file(pair, tmp_path)
    with pytest.raises(FileFormatError, match=r"mass_matrix .* crane, barge"):
        read_bemio(path, mass_matrix={"crane": np.eye(6), "barge": np.eye(6)})
    capytaine_dataset(pair).drop_vars("inertia_matrix").to_netcdf(tmp_path / "no_mass.nc")
    assert read_capytaine(tmp_path / "no_mass.nc").mass_matrix is None  # its draughts are in the file
    found = load_database(path)
    assert found.mass_matrix is None and {row.check for row in found.check()}
    for needs in (
        lambda: found.motion_rao,
        found.natural_modes,
        lambda: Scene().add_vessel(found, memory="none"),
        lambda: fit_memory(database=found),
    ):
        with pytest.raises(SceneError, match=r"'pair': mass_matrix .* of crane, feeder: .* by name"):
            needs()
