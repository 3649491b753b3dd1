"""Memory identification: known systems, the shipped hull, the supply vessel; realisation and passivity."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest
from scipy.linalg import expm

from seacrane.hydro import (
    HydroDatabase,
    MemoryModel,
    fit_memory,
    load_database,
    memory_rows,
    shipped_database,
)
from seacrane.hydro.data.memory_model import RADIATION
from seacrane.hydro.memory.identification import IdentificationData, fit_lowest_order, fit_order, r_squared
from seacrane.hydro.memory.realisation import realise

OMEGA = np.linspace(0.1, 3.0, 59)
NUMERATOR = np.array([3.0, 1.5, 0.8, 0.0])
DENOMINATOR = np.polymul([1.0, 0.6, 0.7], [1.0, 1.1, 1.9])


def known_system(**changes: object) -> IdentificationData:
    """Data of an exact order-4 retardation function with A_inf = 5."""
    kernel = np.polyval(NUMERATOR, 1j * OMEGA) / np.polyval(DENOMINATOR, 1j * OMEGA)
    values: dict[str, object] = {
        "omega": OMEGA,
        "added_mass": 5.0 + kernel.imag / OMEGA,
        "damping": kernel.real,
        "trusted": (OMEGA > 0.29) & (OMEGA < 2.51),
        "added_mass_infinite": None,
    }
    return IdentificationData(**(values | changes))  # type: ignore[arg-type]


@pytest.fixture(scope="module")
def supply(shared: Path) -> HydroDatabase:
    """The supply vessel with its memory fitted per pair."""
    database = load_database(shared / "veres" / "supply")
    return dataclasses.replace(database, memory=fit_memory(database=database, kind="per-pair"))


def memory_of(database: HydroDatabase) -> MemoryModel:
    """The database's memory, which has to be there."""
    assert database.memory is not None
    return database.memory


@pytest.mark.parametrize("known", [None, 5.0])
def test_a_known_system_is_recovered(known: float | None) -> None:
    fit, _ = fit_order(known_system(added_mass_infinite=known), order=4, starts=[])
    assert fit.denominator == pytest.approx(DENOMINATOR, rel=1e-4)
    assert fit.numerator == pytest.approx(NUMERATOR, rel=1e-3, abs=1e-3)
    assert fit.added_mass_infinite == pytest.approx(5.0, rel=1e-4)
    assert fit.worst > 1.0 - 1e-8


def test_static_stiffness_and_no_zero_at_origin_are_recovered() -> None:
    numerator = NUMERATOR + np.array([0.0, 0.0, 0.0, 0.9])
    kernel = np.polyval(numerator, 1j * OMEGA) / np.polyval(DENOMINATOR, 1j * OMEGA)
    data = known_system(
        added_mass=kernel.imag / OMEGA + 4.0 / OMEGA**2,
        damping=kernel.real,
        added_mass_infinite=0.0,
        zero_at_origin=False,
        static_stiffness=True,
    )
    fit, _ = fit_order(data, order=4, starts=[])
    assert fit.static_stiffness == pytest.approx(-4.0, rel=1e-3)
    assert fit.numerator == pytest.approx(numerator, rel=1e-2, abs=1e-2)


def test_the_lowest_sufficient_order_is_taken() -> None:
    data = known_system()
    fit = fit_lowest_order(data, r2=0.999, orders=range(2, 7))
    below, _ = fit_order(data, order=fit.order - 1, starts=[])
    assert fit.worst >= 0.999
    assert below.worst < 0.999


def test_r_squared_of_the_mean_is_zero() -> None:
    data = np.array([1.0, 2.0, 4.0])
    assert r_squared(data, np.full(3, data.mean())) == pytest.approx(0.0)
    assert r_squared(data, data) == 1.0
    assert r_squared(np.ones(3), np.ones(3)) == 1.0


def test_realisation_keeps_the_transfer_function() -> None:
    block = realise(NUMERATOR * 1e8, DENOMINATOR, output=3, input=1, cause=RADIATION)
    reference = 1e8 * np.polyval(NUMERATOR, 1j * OMEGA) / np.polyval(DENOMINATOR, 1j * OMEGA)
    assert np.abs(block.transfer(OMEGA)[:, 0, 0] - reference).max() < 1e-9 * np.abs(reference).max()
    assert np.sort_complex(block.poles) == pytest.approx(np.sort_complex(np.roots(DENOMINATOR)))
    assert np.linalg.norm(block.C) == pytest.approx(1.0)
    assert (block.outputs.tolist(), block.inputs.tolist()) == ([3], [1])


def test_state_scale_is_the_largest_harmonic_amplitude() -> None:
    block = realise(NUMERATOR, DENOMINATOR, output=3, input=3, cause=RADIATION)
    omega = np.geomspace(0.01, 100.0, 3000)
    resolvent = 1j * omega[:, None, None] * np.eye(4) - block.A
    states = np.abs(np.linalg.solve(resolvent, np.broadcast_to(block.B.astype(complex), (3000, 4, 1))))
    assert block.state_scale == pytest.approx(0.01 * states.max(axis=0)[:, 0], rel=1e-2)


def test_unstable_denominators_are_refused() -> None:
    with pytest.raises(ValueError, match="unstable pole"):
        realise(np.array([1.0, 0.0]), np.array([1.0, -0.2, 1.0]), output=0, input=0, cause=RADIATION)


@pytest.mark.warns(sometimes=["InfiniteFrequencyWarning"])
@pytest.mark.parametrize("which", ["shipped", "supply"])
def test_every_entry_follows_the_data(which: str, request: pytest.FixtureRequest) -> None:
    database = shipped_database() if which == "shipped" else request.getfixturevalue("supply")
    model = memory_of(database)
    inside = (database.omega >= model.band[0] - 1e-9) & (database.omega <= model.band[1] + 1e-9)
    added_mass, damping = model.frequency_response(database.omega)
    entries = [(row.output, row.input) for row in model.rows if row.cause == RADIATION]
    assert len(entries) == (12 if which == "shipped" else 9)
    for j, k in [*entries, *((k, j) for j, k in entries)]:
        assert r_squared(database.added_mass[inside, j, k], added_mass[inside, j, k]) >= 0.99
        assert r_squared(database.damping[inside, j, k], damping[inside, j, k]) >= 0.99
    assert all(row.accepted for row in model.rows)
    forgotten = np.ones((6, 6), dtype=bool)
    for j, k in entries:
        forgotten[j, k] = forgotten[k, j] = False
    assert not np.any(np.abs(database.damping)[:, forgotten] > 1e-6 * np.abs(database.damping).max())


@pytest.mark.parametrize("which", ["shipped", "supply"])
def test_models_are_stable_smooth_and_forget(which: str, request: pytest.FixtureRequest) -> None:
    database = shipped_database() if which == "shipped" else request.getfixturevalue("supply")
    model = memory_of(database)
    for block in model.blocks:
        assert block.poles.real.max() < -0.02
        assert np.abs(block.poles).max() < 8.0
        assert np.all(block.state_scale > 0.0)
        if block.cause == RADIATION:
            still = np.linalg.solve(block.A, block.B)
            assert abs((block.C @ still)[0, 0]) < 1e-6 * np.abs(block.transfer(database.omega)).max()
    assert model.states == sum(len(block.A) for block in model.blocks)


def test_the_supply_vessel_matches_the_counts_of_the_incumbent_or_less(supply: HydroDatabase) -> None:
    """13 entries of order 3 to 4 (the paper's 46 states) hold the radiation; the roll tanks come on top."""
    model = memory_of(supply)
    radiation = [block for block in model.blocks if block.cause == RADIATION]
    assert len(radiation) == 13
    assert sum(len(block.A) for block in radiation) <= 50


def test_roll_tanks_have_a_static_stiffness_and_a_model_of_their_own(supply: HydroDatabase) -> None:
    model = memory_of(supply)
    (extra,) = supply.additional
    added_mass, damping = model.additional_response(supply.omega)
    inside = (supply.omega >= 0.3) & (supply.omega <= 2.6)
    assert r_squared(extra.added_mass[inside, 3, 3], added_mass[inside, 3, 3]) > 0.99
    assert r_squared(extra.damping[inside, 3, 3], damping[inside, 3, 3]) > 0.99
    lowest = -(supply.omega[0] ** 2) * extra.added_mass[0, 3, 3]
    assert model.additional_stiffness[3, 3] == pytest.approx(lowest, rel=0.15)


def test_impulse_response_is_the_cosine_transform_of_the_damping() -> None:
    """K(t) = C exp(A t) B = 2 / pi integral B(w) cos(w t) dw, here for the fitted damping."""
    block = next(b for b in memory_of(shipped_database()).blocks if b.outputs[0] == b.inputs[0] == 2)
    omega = np.linspace(0.0, 400.0, 400_001)
    damping = block.transfer(omega[1:])[:, 0, 0].real
    damping = np.concatenate([[0.0], damping])
    for t in (0.7, 2.0, 5.0):
        direct = (block.C @ expm(block.A * t) @ block.B)[0, 0]
        transformed = 2.0 / np.pi * np.trapezoid(damping * np.cos(omega * t), omega)
        assert direct == pytest.approx(transformed, abs=2e-3 * abs((block.C @ block.B)[0, 0]))


def test_estimated_infinite_added_mass_is_close_to_the_computed_one() -> None:
    database = shipped_database()
    assert database.infinite_frequency_added_mass is not None
    difference = np.diag(memory_of(database).added_mass - database.infinite_frequency_added_mass)
    span = np.ptp(np.diagonal(database.added_mass, axis1=1, axis2=2), axis=0)
    assert np.all(np.abs(difference) < 0.04 * span)


def test_known_infinite_added_mass_is_used_when_asked() -> None:
    database = shipped_database()
    model = fit_memory(database=database, kind="per-pair", r2=0.97, infinite_frequency="known")
    assert database.infinite_frequency_added_mass is not None
    assert np.diag(model.added_mass) == pytest.approx(np.diag(database.infinite_frequency_added_mass))


def test_refit_gives_the_shipped_model() -> None:
    database = shipped_database()
    shipped, again = memory_of(database), fit_memory(database=database, kind="per-pair")
    assert [(row.output, row.input, row.order) for row in again.rows] == [
        (row.output, row.input, row.order) for row in shipped.rows
    ]
    old, new = shipped.transfer(database.omega), again.transfer(database.omega)
    assert np.abs(old - new).max(axis=0) == pytest.approx(0.0, abs=1e-3 * np.abs(old).max())


def test_passivity_is_that_of_the_fitted_damping() -> None:
    database = shipped_database()
    model = memory_of(database)
    peak = np.sqrt(np.diagonal(database.damping, axis1=1, axis2=2).max(axis=0))
    omega = np.geomspace(1e-3, 1e3, 1500)
    damping = model.frequency_response(omega)[1] / np.outer(peak, peak)
    lowest = np.linalg.eigvalsh(0.5 * (damping + damping.swapaxes(1, 2)))[:, 0]
    assert lowest.min() == pytest.approx(model.passivity.minimum, abs=1e-3)
    assert model.passivity.minimum > -0.05


def test_memory_rows_name_every_entry(supply: HydroDatabase) -> None:
    rows = {row.check: row for row in memory_rows(supply, memory_of(supply))}
    assert rows["memory_r2_damping_33"].verdict == "pass"
    assert rows["memory_r2_added_mass_44_additional"].verdict == "pass"
    assert rows["vessel_with_memory_growth_per_s"].verdict == "pass"
    assert rows["memory_motion_heave"].value < 0.05


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"band": (0.3, 0.5)}, "holds 5 frequencies"),
        ({"r2": 1.0}, "r2 is 1"),
        ({"r2": float("nan")}, "r2 is nan"),
        ({"infinite_frequency": "known"}, "has no infinite-frequency added mass"),
    ],
    ids=str,
)
def test_bad_requests_are_refused(changes: dict[str, object], message: str) -> None:
    database = dataclasses.replace(shipped_database(), infinite_frequency_added_mass=None)
    with pytest.raises(ValueError, match=message):
        fit_memory(database=database, **changes)  # type: ignore[arg-type]
