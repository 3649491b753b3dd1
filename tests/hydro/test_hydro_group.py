"""`HydroGroup`: its hulls, order, motions, modes, gaps and checks against closed forms and single hulls."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from group_cases import written_pair
from scipy.special import j0

from seacrane.errors import SceneError
from seacrane.hydro import (
    GroupBody,
    HydroDatabase,
    HydroGroup,
    motion_response,
    piston_frequency,
    shipped_database,
    spikes,
)
from seacrane.hydro.data.packed import packed, unpacked
from seacrane.hydro.data.relations import damping_from_forces
from seacrane.hydro.group.gap import irregular_frequencies

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


@pytest.mark.parametrize("heading", [0.0, np.pi, np.pi / 2])
def test_a_hull_of_a_group_is_the_database_it_was_made_of(hull: HydroDatabase, heading: float) -> None:
    """Matrices to the last bit; forces at every heading, whatever place and heading the hull has."""
    found = beside(hull, heading=heading)["two"]
    assert np.array_equal(found.added_mass, hull.added_mass)
    assert np.array_equal(found.damping, hull.damping)
    assert np.array_equal(found.mass_matrix, hull.mass_matrix)
    expected = hull.force_at(hull.omega[None, :], found.heading[:, None])
    assert np.abs(found.force - expected).max() <= 1e-9 * np.abs(expected).max()


def test_without_coupling_each_hull_moves_as_alone(hull: HydroDatabase) -> None:
    group = beside(hull)
    for name in group:
        alone = motion_response(group[name])
        at_origin = group.motion_rao[:, :, group.place(name)]
        along = np.exp(1j * np.outer(np.sin(group.heading) *
        group.bodies[group.names.index(name)].position[1],
                                     group.omega**2 / group.g))  # fmt: skip
        assert at_origin * along[:, :, None] == pytest.approx(alone, rel=1e-9, abs=1e-12)


def test_the_motion_equation_holds_with_coupling() -> None:
    group = written_pair()
    w = group.omega[:, None, None]
    damping = group.damping + group.linear_damping
    left = -(w**2) * (group.mass_matrix + group.added_mass) + 1j * w * damping + group.restoring
    residual = np.einsum("nij,mnj->mni", left, group.motion_rao) - group.force
    terms = np.einsum("nij,mnj->mni", np.abs(left), np.abs(group.motion_rao)) + np.abs(group.force)
    assert np.abs(residual / terms).max() < 1e-12


def test_names_exchanged_exchange_everything() -> None:
    group = written_pair()
    other = group.ordered(["feeder", "crane"])
    assert other.names == ("feeder", "crane")
    assert np.array_equal(other.added_mass[:, :6, 6:], group.added_mass[:, 6:, :6])
    assert other.motion_rao[:, :, 6:] == pytest.approx(group.motion_rao[:, :, :6], rel=1e-9)
    assert other.ordered(["crane", "feeder"]).digest == group.digest
    with pytest.raises(ValueError, match="does not name each of crane, feeder once"):
        group.ordered(["crane", "crane"])


def test_a_group_is_stored_as_bytes_and_comes_back() -> None:
    group = written_pair()
    found = unpacked(packed(group), (HydroGroup,))
    assert isinstance(found, HydroGroup)
    assert found.digest == group.digest
    assert found.names == group.names
    assert "crane, feeder" in repr(group)


def axisymmetric(force: float) -> HydroDatabase:
    """A body in deep water that heaves alone, its damping by Haskind's relation from one force."""
    base = shipped_database().select(every=6)
    heave = np.zeros((6, 6))
    heave[2, 2] = 1.0
    x = np.zeros((72, len(base.omega), 6), dtype=complex)
    x[:, :, 2] = force * np.exp(-base.omega)
    damping = base.omega**3 / (2.0 * base.rho * base.g**3) * np.abs(x[0, :, 2]) ** 2
    return replace(
        base,
        heading=np.arange(72) * np.pi / 36,
        force=x,
        damping=damping[:, None, None] * heave,
        port_starboard_symmetric=False,
        memory=None,
        drift=None,
        length=1.0,
        breadth=1.0,
        trusted_band=None,
    )


@pytest.mark.parametrize("distance", [3.0, 12.0, 25.0])
def test_two_heaving_points_couple_by_j0(distance: float) -> None:
    """Far-field energy of two bodies alike: B12 / B11 = J0(k R), by the phases of the group's forces."""
    point = axisymmetric(1e6)
    group = beside(point, place=(0.6 * distance, 0.8 * distance, 0.0))
    radiated = damping_from_forces(group)
    assert radiated is not None
    k = group.omega**2 / group.g
    assert radiated[:, 2, 2] == pytest.approx(point.damping[:, 2, 2], rel=1e-9)
    assert radiated[:, 2, 8] / radiated[:, 2, 2] == pytest.approx(j0(k * distance), abs=2e-4)


def test_modes_of_two_masses_on_springs() -> None:
    """Heave of two hulls coupled by inertia: C - w^2 (M -+ a) = 0 in closed form."""
    stiffness, inertia, coupled, rate = 4.0e6, 1.0e6, 2.0e5, 3.0e4
    group = two_springs(stiffness, inertia, coupled, rate)
    found = [mode for mode in group.natural_modes()]
    expected = [np.sqrt(stiffness / (inertia + sign * coupled)) for sign in (1.0, -1.0)]
    assert [mode.omega for mode in found] == pytest.approx(expected, rel=1e-9)
    together, against = found
    assert together.shape[2] == pytest.approx(together.shape[8], rel=1e-9)
    assert against.shape[2] == pytest.approx(-against.shape[8], rel=1e-9)
    expected_ratio = rate / (2.0 * together.omega * (inertia + coupled))
    assert together.damping_ratio == pytest.approx(expected_ratio, rel=1e-9)
    assert together.period == pytest.approx(2.0 * np.pi / expected[0], rel=1e-9)


def two_springs(stiffness: float, inertia: float, coupled: float, rate: float) -> HydroGroup:
    """Two bodies of which only heave is restored; their water couples them by inertia."""
    omega, heave = np.linspace(0.2, 4.0, 39), np.zeros((6, 6))
    heave[2, 2] = 1.0
    body = GroupBody(
        name="one",
        position=np.zeros(3),
        mass_matrix=0.5 * inertia * np.eye(6),
        restoring=stiffness * heave,
        length=10.0,
        breadth=5.0,
        draught=2.0,
    )
    added = np.kron(np.eye(2), 0.5 * inertia * heave) + np.kron(1.0 - np.eye(2), coupled * heave)
    return HydroGroup(
        name="springs",
        bodies=(body, replace(body, name="two", position=np.array([0.0, 20.0, 0.0]))),
        omega=omega,
        heading=np.zeros(1),
        added_mass=np.broadcast_to(added, (39, 12, 12)),
        damping=np.broadcast_to(rate * np.kron(np.eye(2), heave), (39, 12, 12)),
        force=np.zeros((1, 39, 12)),
        source="closed form",
    )


@pytest.mark.parametrize(
    ("draught", "gap", "period"), [(5.0, 3.0, 5.918), (5.0, 1.0, 5.142), (10.0, 3.0, 7.427)]
)
def test_piston_period(draught: float, gap: float, period: float) -> None:
    """Numbers worked out by hand, of two hulls of 20 m."""
    found = 2.0 * np.pi / piston_frequency(draught=draught, gap=gap, width=40.0 + gap, g=9.80665)
    assert found == pytest.approx(period, abs=6e-4)


def test_irregular_frequency_of_a_box() -> None:
    """The lowest eigenfrequency of the water inside, by the closed form of Frank (1967) for a long box."""
    body = two_springs(1.0, 1.0, 0.0, 0.0).bodies[0]
    long = replace(body, length=1e6)
    k = np.pi / long.breadth
    assert irregular_frequencies(long, 9.81)[0] == pytest.approx(
        np.sqrt(9.81 * k / np.tanh(k * long.draught)), rel=1e-6
    )


def with_peak(group: HydroGroup, omega: float, height: float = 4.0) -> HydroGroup:
    """The group with a narrow peak in the heave damping of its first hull."""
    damping = group.damping.copy()
    bell = 1.0 / (1.0 + ((group.omega - omega) / 0.02) ** 2)
    damping[:, 2, 2] += height * damping[:, 2, 2].max() * bell
    return replace(group, damping=damping)


def test_a_gap_is_told_apart_from_an_irregular_frequency(hull: HydroDatabase) -> None:
    fine = shipped_database()
    place = (0.0, fine.breadth + 4.0, 0.0)
    group = beside(fine, place=place)
    [gap] = group.gaps()
    assert gap.width == pytest.approx(4.0, rel=1e-9)
    assert gap.piston == pytest.approx(
        piston_frequency(draught=fine.draught, gap=4.0, width=2.0 * fine.breadth + 4.0, g=fine.g), rel=1e-12
    )
    assert not spikes(group)
    [of_gap] = spikes(with_peak(group, 1.02 * gap.piston))
    assert (of_gap.cause, of_gap.of) == ("gap", "one-two")
    irregular = float(irregular_frequencies(group.bodies[0], fine.g)[0])
    [of_hull] = spikes(with_peak(group, irregular))
    assert (of_hull.cause, of_hull.expected) == ("irregular", pytest.approx(irregular))
    inside = replace(with_peak(group, irregular), trusted_band=(float(fine.omega[0]), float(fine.omega[-1])))
    failed = [row.check for row in inside.check() if row.verdict == "fail" and "frequency" in row.check]
    assert failed == ["irregular_frequency_one_rad_s"]


def test_hulls_that_do_not_feel_each_other_break_the_far_field_alone(hull: HydroDatabase) -> None:
    """Their waves add up far away, so that the damping must couple them; everything else is sound."""
    rows = beside(hull, place=(0.0, 30.0, 0.0)).check()
    assert [row.check for row in rows if row.verdict == "fail"] == ["damping_from_forces_one_two"]
    names = {row.check for row in rows}
    assert {
        "symmetry_added_mass_coupling",
        "damping_from_forces_one_heave",
        "kramers_kronig_two_roll",
    } <= names


def test_check_names_what_is_wrong(hull: HydroDatabase) -> None:
    group = beside(hull)
    coupling = group.damping.copy()
    coupling[:, 2, 8] = coupling[:, 8, 2] = 1.5 * group.damping[:, 2, 2]
    failed = {row.check for row in replace(group, damping=coupling).check() if row.verdict == "fail"}
    assert {"damping_smallest_eigenvalue", "damping_from_forces_one_two"} <= failed
    skewed = group.added_mass.copy()
    skewed[:, 2, 8] = 0.5 * group.added_mass[:, 2, 2]
    failed = {row.check for row in replace(group, added_mass=skewed).check() if row.verdict == "fail"}
    assert "symmetry_added_mass_coupling" in failed
    assert "symmetry_added_mass" not in failed


def test_requirements_are_refused_by_name() -> None:
    group = written_pair()
    group.require(names=["crane", "feeder"], positions={"feeder": (6.0, 38.0, -1.5)}, apart=True)
    draught = group.bodies[1].draught
    with pytest.raises(SceneError, match=r"another order: use group.ordered"):
        group.require(names=["feeder", "crane"])
    with pytest.raises(SceneError, match=r"feeder has its reference point at \(6, 38, -1.5\) m, not at"):
        group.require(positions={"feeder": (6.0, 38.0, 0.0)})
    with pytest.raises(SceneError, match="feeder was computed with a draught of"):
        group.require(draughts={"feeder": 1.1 * draught})
    with pytest.raises(SceneError, match="positions name 'tug', which it has not"):
        group.require(positions={"tug": (0.0, 0.0, 0.0)})


def test_hulls_that_overlap_are_refused(hull: HydroDatabase) -> None:
    with pytest.raises(SceneError, match="one and two overlap by"):
        beside(hull, place=(0.0, 0.5 * hull.breadth, 0.0))
    with pytest.raises(SceneError, match="one and two overlap by"):
        beside(hull, heading=np.pi / 2, place=(0.5 * hull.length, 0.0, 0.0))


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"depth": 40.0}, "depth is inf in 'one' and 40 in 'two'"),
        ({"rho": 1000.0}, "rho is 1025 in 'one' and 1000 in 'two'"),
        ({"omega": np.linspace(0.3, 1.0, 3)}, "other frequencies"),
    ],
)
def test_one_water_for_all(hull: HydroDatabase, changes: dict[str, object], message: str) -> None:
    short = hull.select(omega=[0, 1, 2])
    other = replace(short, trusted_band=None, memory=None, **changes)
    with pytest.raises(ValueError, match=message):
        HydroGroup.from_databases(
            databases={"one": short, "two": other}, positions={"one": (0, 0, 0), "two": APART}
        )


def test_bad_groups_are_named() -> None:
    group = written_pair()
    with pytest.raises(ValueError, match="crane, crane; give two or more, each with a name of its own"):
        replace(group, bodies=(group.bodies[0], group.bodies[0]))
    with pytest.raises(ValueError, match=r"added_mass has shape .* needed for bodies crane, feeder"):
        replace(group, added_mass=group.added_mass[:, :6, :6])
    with pytest.raises(KeyError, match="no body 'tug'"):
        group["tug"]
    with pytest.raises(ValueError, match=r"feeder.*mass matrix is not positive definite"):
        replace(group.bodies[1], mass_matrix=-np.eye(6))
