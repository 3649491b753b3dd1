"""HydroDatabase: validation, interpolation of forces, symmetry, selection, lossless NetCDF."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import pytest
from test_hydro_transform import full

from seacrane.errors import FileFormatError
from seacrane.hydro import DriftCoefficients, HydroDatabase, load_database, shipped_database
from seacrane.hydro.data.interpolation import spline_weights

PARITY = np.array([1, -1, 1, -1, 1, -1])


def small(**changes: Any) -> HydroDatabase:
    """A floating body with smooth, made-up numbers: 12 frequencies, 7 headings from 0 to 180 degrees."""
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
    """A database in which every optional part is filled, with the shipped memory model."""
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
        ({"omega": np.linspace(0.0, 2.4, 12)}, "omega spans 0"), ({"trusted_band": (2.0, 1.0)}, "trusted_b"),
        ({"heading": np.radians(np.linspace(0.0, 360.0, 7))}, "heading spans"),
        ({"added_mass": np.zeros((11, 6, 6))}, r"added_mass has shape \(11, 6, 6\)"),
        ({"force": np.zeros((7, 12, 5))}, "force has shape"), ({"mass_matrix": -np.eye(6)}, "mass matrix"),
        ({"damping": np.full((12, 6, 6), np.nan)}, r"damping\[0, 0, 0\] is nan"),
    ]  # fmt: skip
    for changes, message in table:
        with pytest.raises(ValueError, match=message):
            small(**changes)
    good = {"heading": [0.0, 1.0], "omega": [0.3, 0.4, 0.5], "coefficient": np.zeros((2, 3, 6))}
    for changes, message in (
        ({"heading": [0.0, 7.0]}, "heading must rise"), ({"omega": [0.0, 0.4, 0.5]}, "omega must"),
        ({"coefficient": np.zeros((2, 3, 3))}, r"coefficient has shape \(2, 3, 3\)"),
    ):  # fmt: skip
        with pytest.raises(ValueError, match=message):
            DriftCoefficients(**(good | changes))


def test_arrays_are_read_only_copies_and_labelled_in_xarray() -> None:
    given_array = np.linspace(0.2, 2.4, 12)
    database = small(omega=given_array)
    given_array[0] = 9.0
    assert database.omega[0] == 0.2
    with pytest.raises(ValueError, match="read-only"):
        database.added_mass[0, 0, 0] = 1.0
    database = everything()
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


def test_a_failing_save_leaves_the_old_file(tmp_path: Path) -> None:
    target = tmp_path / "copy.nc"
    small().save(target)
    before = target.read_bytes()
    broken = small()
    object.__setattr__(broken, "trusted_band", ("a", "b"))
    with pytest.raises(ValueError, match="could not convert"):
        broken.save(target)
    assert target.read_bytes() == before
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
    with pytest.raises(FileFormatError, match=r"several files .*name one"):
        load_database(tmp_path)
    one.unlink()
    assert load_database(tmp_path).name == shipped_database().name


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


def test_a_choice_that_makes_no_sense() -> None:
    table: list[tuple[dict[str, Any], str]] = [
        ({"omega": (2.0, 1.0)}, "no range"), ({"omega": (5.0, 6.0)}, "leaves nothing"),
        ({"omega": [0, 99]}, "beyond its 61"), ({"omega": [0.5, 1.5]}, "neither a range"),
        ({"omega": [1, 1]}, "twice"), ({"omega": (2.6, 3.0)}, "trusted band 0.3 to 2.5"),
    ]  # fmt: skip
    for choice, message in table:
        with pytest.raises(ValueError, match=message):
            shipped_database().select(**choice)
