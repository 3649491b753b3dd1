"""HydroDatabase: forces between, selection, lossless NetCDF; data that contradict themselves or the scene."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import pytest
from test_hydro_transform import full

from seacrane import Scene
from seacrane.errors import FileFormatError
from seacrane.hydro import (
    AdditionalMatrices,
    DriftCoefficients,
    HydroDatabase,
    MemoryModel,
    RollDamping,
    fit_memory,
    load_database,
    shipped_database,
    vessel_parameters,
)
from seacrane.hydro.data.data_warnings import warn_of_water
from seacrane.hydro.data.interpolation import spline_weights
from seacrane.warnings import (
    AsymmetryWarning,
    DampingWarning,
    HeadingGapWarning,
    InfiniteFrequencyWarning,
    MemoryMismatchWarning,
    NonPassiveMemoryWarning,
    WaterMismatchWarning,
)

PARITY = np.array([1, -1, 1, -1, 1, -1])


def small(**changes: Any) -> HydroDatabase:
    omega, heading = np.linspace(0.2, 2.4, 12), np.radians(np.arange(0.0, 181.0, 30.0))
    diagonal = np.diag([1.0, 1.2, 2.0, 30.0, 90.0, 80.0]) * 1e6
    values: dict[str, Any] = {
        "name": "small", "omega": omega, "heading": heading, "length": 50.0, "breadth": 12.0, "draught": 4.0,
        "added_mass": diagonal * (1.0 + np.exp(-omega))[:, None, None],
        "damping": diagonal * (omega**2 * np.exp(-2.0 * omega))[:, None, None],
        "restoring": np.diag([0.0, 0.0, 3e6, 2e7, 9e7, 0.0]), "mass_matrix": diagonal,
        "force": 1e6 * np.exp(1j * np.sin(heading)[:, None, None] * omega[:, None]) * np.ones(6),
        "origin": "centre of the waterplane", "source": "made up for tests",
    }  # fmt: skip
    return HydroDatabase(**(values | changes))


def everything() -> HydroDatabase:
    drag = np.random.default_rng(5).normal(size=6)
    return full(memory=shipped_database().memory, quadratic_damping=drag, trusted_band=(0.3, 2.0))


def test_splines_reproduce_a_cubic_and_converge_at_fourth_order_on_a_circle() -> None:
    knots = np.array([0.1, 0.4, 0.5, 1.1, 1.7, 2.0])
    query = np.linspace(0.1, 2.0, 31)
    assert spline_weights(knots, query) @ (knots**3 - knots) == pytest.approx(query**3 - query, abs=1e-12)
    query, errors = np.linspace(-7.0, 7.0, 501), []
    for count in (24, 48):
        knots = 2.0 * np.pi * (np.arange(count) + 0.2 * np.sin(np.arange(count))) / count
        knots = np.sort(np.mod(knots, 2.0 * np.pi))
        weights = spline_weights(knots, query, period=2.0 * np.pi)
        errors.append(np.abs(weights @ np.sin(knots) - np.sin(query)).max())
    assert 3.0 < np.log2(errors[0] / errors[1]) < 5.0
    database = shipped_database()
    found = database.force_at(database.omega[None, :], database.heading[:, None])
    assert np.abs(found - database.force).max() < 1e-9 * np.abs(database.force).max()


def test_headings_wrap_and_mirror() -> None:
    database = shipped_database()
    size = np.abs(database.force).max(axis=(0, 1))
    draw = np.random.default_rng(8)
    for omega, heading in zip(draw.uniform(0.1, 3.1, 40), draw.uniform(-10.0, 10.0, 40), strict=True):
        force = database.force_at(omega, heading)
        for turns in (-3, 1):
            turned = database.force_at(omega, heading + 2.0 * np.pi * turns)
            assert np.all(np.abs(turned - force) < 1e-9 * size)
        assert np.all(np.abs(database.force_at(omega, -heading) - PARITY * force) < 1e-9 * size)


def test_bad_input_names_the_object() -> None:
    table: list[tuple[dict[str, Any], str]] = [
        ({"omega": np.linspace(2.4, 0.2, 12)}, "omega is not strictly increasing"),
        ({"heading": np.radians(np.linspace(0.0, 360.0, 7))}, "heading spans"),
        ({"added_mass": np.zeros((11, 6, 6))}, r"added_mass has shape \(11, 6, 6\)"),
        ({"force": np.zeros((7, 12, 5))}, "force has shape"), ({"mass_matrix": -np.eye(6)}, "mass matrix"),
        ({"damping": np.full((12, 6, 6), np.nan)}, r"damping\[0, 0, 0\] is nan"),
    ]  # fmt: skip
    for changes, message in table:
        with pytest.raises(ValueError, match=message):
            small(**changes)
    good = {"heading": [0.0, 1.0], "omega": [0.3, 0.4, 0.5], "coefficient": np.zeros((2, 3, 6))}
    with pytest.raises(ValueError, match="heading spans"):
        DriftCoefficients(**(good | {"heading": [0.0, 7.0]}))


def test_arrays_are_read_only_copies_and_labelled_in_xarray() -> None:
    given_array = np.linspace(0.2, 2.4, 12)
    database = small(omega=given_array)
    given_array[0] = 9.0
    assert database.omega[0] == 0.2
    with pytest.raises(ValueError, match="read-only"):
        database.added_mass[0, 0, 0] = 1.0
    dataset = database.to_xarray()
    heave = dataset.added_mass.sel(motion="heave", motion_of="heave").values
    assert heave == pytest.approx(database.added_mass[:, 2, 2])
    assert np.array_equal(dataset.force.transpose("heading", "omega", "motion").values, database.force)


@pytest.mark.warns(sometimes=["DampingWarning", "HeadingGapWarning", "RaoPhaseWarning"])
@pytest.mark.parametrize("build", [small, everything, shipped_database])
def test_netcdf_round_trip_loses_nothing(build: Any, tmp_path: Path) -> None:
    """To the bit."""

    def plain(value: Any) -> Any:
        if dataclasses.is_dataclass(value):
            return type(value), [plain(getattr(value, entry.name)) for entry in dataclasses.fields(value)]
        if isinstance(value, tuple):
            return [plain(entry) for entry in value]
        return (value.dtype, value.tobytes()) if isinstance(value, np.ndarray) else value

    database = build()
    database.save(tmp_path / "copy.nc")
    assert plain(database) == plain(load_database(tmp_path / "copy.nc"))
    assert [file.name for file in tmp_path.iterdir()] == ["copy.nc"]


def test_damaged_foreign_and_other_files_are_refused(tmp_path: Path) -> None:
    path, one = tmp_path / "whole.nc", tmp_path / "one.nc"
    shipped_database().save(path)
    data = path.read_bytes()
    for part in (0.02, 0.6, 0.999):
        one.write_bytes(data[: int(part * len(data))])
        with pytest.raises(FileFormatError, match=r"one\.nc"):
            load_database(one)
    for missing in ("force", "memory/A"):
        one.write_bytes(data)
        *group, name = missing.split("/")
        with netCDF4.Dataset(one, "a") as file:
            (file[group[0]] if group else file).renameVariable(name, "elsewhere")
        with pytest.raises(FileFormatError, match="damaged"):
            load_database(one)
    one.write_bytes(data)
    with netCDF4.Dataset(one, "a") as file:
        file.format_version = 99
    with pytest.raises(FileFormatError, match=r"format version 99, .* version 1"):
        load_database(one)


def test_selected_values_are_the_stored_ones() -> None:
    base = full()
    part = base.select(omega=(0.5, 1.5), heading=[3, 0, -1], every=2)
    rows = np.flatnonzero((base.omega >= 0.5) & (base.omega <= 1.5))[::2]
    headings = np.array([0, 3, len(base.heading) - 1])
    assert len(rows) > 1 and np.array_equal(part.heading, base.heading[headings])
    for name in ("omega", "added_mass", "damping"):
        assert np.array_equal(getattr(part, name), getattr(base, name)[rows])
    for name in ("force", "motion_rao"):
        assert np.array_equal(getattr(part, name), getattr(base, name)[headings][:, rows])
    one, other = part.roll_damping, base.roll_damping
    assert np.array_equal(one.linearised, other.linearised[headings][:, rows])
    assert np.array_equal(one.linear, other.linear[rows])
    assert np.array_equal(part.additional[0].damping, base.additional[0].damping[rows])
    assert part.drift is base.drift and np.array_equal(part.restoring, base.restoring)
    assert not part.force.flags.writeable
    assert part.trusted_band == (part.omega[0], part.omega[-1])


def test_ranges_cross_zero_and_memory_stays_with_all_its_frequencies() -> None:
    base = shipped_database()
    full_turn = dataclasses.replace(base.at((0.0, 1.0, 0.0)), memory=None)
    part = full_turn.select(heading=(np.radians(-20.0), np.radians(10.0)))
    assert np.degrees(part.heading) == pytest.approx([0.0, 5.0, 10.0, 340.0, 345.0, 350.0, 355.0])
    assert base.select(heading=slice(0, None, 2)).memory is base.memory
    assert base.select().memory is base.memory
    assert base.select(omega=slice(1, None)).memory is None
    assert base.select(omega=(0.0, 2.0)).trusted_band == (0.3, base.omega[base.omega <= 2.0][-1])
    assert base.select(omega=[20]).trusted_band == base.trusted_band


def hull(**changes: Any) -> HydroDatabase:
    return dataclasses.replace(shipped_database(), **({"memory": None} | changes))


def saved(database: HydroDatabase, folder: Path) -> HydroDatabase:
    database.save(folder / "hull.nc")
    return load_database(folder / "hull.nc")


def test_infinite_frequency_added_mass_that_is_not_there() -> None:
    database = hull(infinite_frequency_added_mass=None)
    with pytest.warns(InfiniteFrequencyWarning, match=r"3.1 rad/s"):
        fit_memory(database=database, kind="per-pair", r2=0.9)
    with pytest.raises(ValueError, match="infinite_frequency='estimated'"):
        fit_memory(database=database, infinite_frequency="known")


def damped(at: Any = slice(None), **entries: float) -> np.ndarray:
    """The hull's damping with entries multiplied, given as shares of what their diagonals bound."""
    damping = shipped_database().damping.copy()
    for pair, share in entries.items():
        j, k = (int(one) - 1 for one in pair[1:])
        bound = np.sqrt(damping[at, j, j] * damping[at, k, k])
        damping[at, j, k] = damping[at, k, j] = share * bound
    return damping


ROLL = RollDamping(linear=np.full(61, -1.0), quadratic=np.zeros(61), linearised=np.zeros((37, 61)))


@pytest.mark.warns(sometimes=["MemoryMismatchWarning", "RollDampingWarning"])
@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"damping": damped(12, b33=-1.0)}, r"radiation damping at 0\.7 rad/s"),
        ({"damping": damped(b35=1.3)}, "radiation damping at"),  # heave and pitch together gain energy
        ({"linear_damping": np.eye(6)[::-1] * 1e6}, "linear_damping has a negative eigenvalue"),
        ({"quadratic_damping": np.array([0, 0, 0, -1e7, 0, 0])}, r"-1e\+07, below zero"),
        ({"roll_damping": ROLL}, "-1, below zero"),
    ],
)
def test_negative_damping_is_named(changes: dict[str, Any], message: str, tmp_path: Path) -> None:
    database = hull(**changes)
    with pytest.warns(DampingWarning, match=message):
        saved(database, tmp_path)
    with pytest.warns(DampingWarning, match=message) as told:
        vessel_parameters(database, memory=shipped_database().memory)
    assert not any(one.category is NonPassiveMemoryWarning for one in told)  # the memory is not to blame
    saved(hull(damping=damped(-3, b33=-1.0)), tmp_path)  # noise outside the trusted band is no fault


def test_gaps_between_headings_are_told(tmp_path: Path) -> None:
    base = shipped_database()
    degrees = np.degrees(base.heading)
    kept, edge = (list(map(int, np.flatnonzero((degrees < 61) | (degrees > most)))) for most in (119, 104))
    for database, message, at in (
        (hull(port_starboard_symmetric=False), "a gap of 180 deg from 180 deg.*not symmetric", -60.0),
        (base.select(heading=kept), "a gap of 60 deg from 60 deg", 90.0),
    ):
        with pytest.warns(HeadingGapWarning, match=message):
            found = saved(database, tmp_path)
        with pytest.raises(ValueError, match=f"heading {at:g} deg is not among the stored ones"):
            found.force_at(1.0, np.radians(at))
    saved(hull().at((0.0, 2.0, 0.0)), tmp_path)
    saved(base.select(heading=edge), tmp_path)  # 45 deg can be bridged


def test_frequencies_and_headings_are_never_extrapolated() -> None:
    base = shipped_database()
    for omega in (base.omega[0] - 1e-6, base.omega[-1] + 1e-6):
        with pytest.raises(ValueError, match=r"is outside 0\.1 to 3\.1 rad/s"):
            base.force_at(omega, 0.0)
    # Magnitudes or phases alone would give other values between.
    phase = np.exp(1j * np.outer(np.cos(base.heading), 20.0 * base.omega))[:, :, None]
    w, b = 0.725, np.radians(42.5)
    found = hull(force=1e6 * phase * np.ones(6)).force_at(w, b)[2]
    assert np.abs(found - 1e6 * np.exp(20j * w * np.cos(b))) < 0.02e6


def test_units_and_water_that_do_not_fit(tmp_path: Path) -> None:
    for changes, message in (
        ({"rho": 1.025}, r"mass .*742\.3 times"), ({"g": 1.62}, r"C33 .*5\.082 times"),
        ({"length": 11.5}, r"mass .*7\.423 times"),
    ):  # fmt: skip
        with pytest.warns(WaterMismatchWarning, match=message):
            saved(hull(**changes), tmp_path)
    Scene(name="earth").add_vessel(shipped_database())  # 9.80665 and 9.81
    with pytest.warns(WaterMismatchWarning, match=r"9\.81 m/s2, .* 1\.62"):
        Scene(name="moon", gravity=1.62).add_vessel(shipped_database())
    omega, shallow = np.array([0.3, 0.8, 2.0]), hull(depth=30.0)
    warn_of_water(shallow, gravity=9.81, depth=30.0, omega=omega)
    warn_of_water(shallow, gravity=9.81, depth=np.inf, omega=omega[1:] * 1.5)  # deep for these waves
    with pytest.warns(WaterMismatchWarning, match="30 m, the sea has inf m: at 0.3 rad/s"):
        warn_of_water(shallow, gravity=9.81, depth=np.inf, omega=omega, what="the sea")


def test_a_memory_of_another_point_or_tanks_is_found() -> None:
    base = shipped_database()
    vessel_parameters(base)
    vessel_parameters(base.at((1.0, 0.0, 0.0)))
    vessel_parameters(base.mirror())
    for point in ((1.0, 0.0, 0.0), (0.0, 0.0, 1.0), (-30.0, 0.0, 0.0)):
        with pytest.warns(MemoryMismatchWarning, match="states R2 = .* for pair"):
            vessel_parameters(base.at(point), memory=base.memory)
    tanks = np.zeros((61, 6, 6))
    tanks[:, 3, 3] = 1e6
    part = AdditionalMatrices(cause="tanks", added_mass=tanks, damping=tanks, restoring=0.0 * tanks)
    with pytest.warns(MemoryMismatchWarning, match="holds nothing of tanks"):
        vessel_parameters(dataclasses.replace(base, additional=(part,)))
    rows = (*base.memory.rows, dataclasses.replace(base.memory.rows[3], cause="tanks"))
    with pytest.warns(MemoryMismatchWarning, match="it holds tanks"):
        vessel_parameters(base, memory=dataclasses.replace(base.memory, rows=rows))


@pytest.mark.warns("MemoryMismatchWarning")
def test_a_memory_that_feeds_the_motions_is_named() -> None:
    """Blocks off the diagonal half as strong again, and heave whose memory pushes in place of damping."""
    base = shipped_database()

    def changed(factor: float, heave: float) -> MemoryModel:
        blocks = []
        for block in base.memory.blocks:
            own = list(block.inputs) == list(block.outputs)
            scale = (heave if list(block.inputs) == [2] else 1.0) if own else factor
            blocks.append(dataclasses.replace(block, C=scale * block.C))
        return dataclasses.replace(base.memory, blocks=tuple(blocks))

    forced = changed(1.5, 1.0)  # what the model states about itself is now wrong
    assert forced.passivity.minimum > -0.05
    for model, message in ((forced, "of the largest at"), (changed(1.0, -1.0), "free vessel grow with")):
        with pytest.warns(NonPassiveMemoryWarning, match=message):
            vessel_parameters(base, memory=model)


@pytest.mark.filterwarnings("ignore::seacrane.warnings.MemoryFitWarning")
def test_any_use_of_a_skew_matrix_warns() -> None:
    skew = shipped_database().added_mass.copy()
    skew[:, 0, 4] += 0.5 * np.sqrt(skew[:, 0, 0] * skew[:, 4, 4])
    with pytest.warns(AsymmetryWarning, match="added_mass is not symmetric: its entries 15 and 51"):
        vessel_parameters(hull(added_mass=skew))
