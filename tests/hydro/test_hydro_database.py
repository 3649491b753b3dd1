"""HydroDatabase: validation, interpolation of forces, symmetry, lossless NetCDF."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from seacrane.errors import FileFormatError
from seacrane.hydro import (
    AdditionalMatrices,
    DriftCoefficients,
    HydroDatabase,
    RollDamping,
    load_database,
    shipped_database,
)
from seacrane.hydro.data.interpolation import spline_weights

PARITY = np.array([1, -1, 1, -1, 1, -1])


def small(**changes: Any) -> HydroDatabase:
    """A floating body with smooth, made-up numbers: 12 frequencies, 7 headings from 0 to 180 degrees."""
    omega = np.linspace(0.2, 2.4, 12)
    heading = np.radians(np.arange(0.0, 181.0, 30.0))
    diagonal = np.diag([1.0, 1.2, 2.0, 30.0, 90.0, 80.0]) * 1e6
    values: dict[str, Any] = {
        "name": "small",
        "omega": omega,
        "heading": heading,
        "added_mass": diagonal * (1.0 + np.exp(-omega))[:, None, None],
        "damping": diagonal * (omega**2 * np.exp(-2.0 * omega))[:, None, None],
        "restoring": np.diag([0.0, 0.0, 3e6, 2e7, 9e7, 0.0]),
        "mass_matrix": diagonal,
        "force": 1e6 * np.exp(1j * np.sin(heading)[:, None, None] * omega[:, None]) * np.ones(6),
        "length": 50.0,
        "breadth": 12.0,
        "draught": 4.0,
        "origin": "centre of the waterplane",
        "source": "made up for tests",
    }
    return HydroDatabase(**(values | changes))


def everything() -> HydroDatabase:
    """A database in which every optional part is filled, with the shipped memory model."""
    base = small()
    rng = np.random.default_rng(5)
    return dataclasses.replace(
        base,
        infinite_frequency_added_mass=rng.normal(size=(6, 6)),
        zero_frequency_added_mass=rng.normal(size=(6, 6)),
        motion_rao=rng.normal(size=(7, 12, 6)) + 1j * rng.normal(size=(7, 12, 6)),
        linear_damping=rng.normal(size=(6, 6)),
        quadratic_damping=rng.normal(size=6),
        roll_damping=RollDamping(
            linear=rng.normal(size=12), quadratic=rng.normal(size=12), linearised=rng.normal(size=(7, 12))
        ),
        additional=tuple(
            AdditionalMatrices(
                cause=cause,
                added_mass=rng.normal(size=(12, 6, 6)),
                damping=rng.normal(size=(12, 6, 6)),
                restoring=rng.normal(size=(12, 6, 6)),
            )
            for cause in ("roll tanks", "bilge keels")
        ),
        trusted_band=(0.3, 2.0),
        depth=100.0,
        port_starboard_symmetric=False,
        memory=shipped_database().memory,
        drift=DriftCoefficients(
            heading=np.radians([0.0, 90.0]), omega=base.omega[:5], coefficient=rng.normal(size=(2, 5, 6))
        ),
    )


def test_spline_reproduces_a_cubic_exactly() -> None:
    knots = np.array([0.1, 0.4, 0.5, 1.1, 1.7, 2.0])
    query = np.linspace(0.1, 2.0, 31)
    assert spline_weights(knots, query) @ (knots**3 - knots) == pytest.approx(query**3 - query, abs=1e-12)


def test_periodic_spline_of_uneven_knots_converges_at_fourth_order() -> None:
    def error(count: int) -> float:
        knots = 2.0 * np.pi * (np.arange(count) + 0.2 * np.sin(np.arange(count))) / count
        knots = np.sort(np.mod(knots, 2.0 * np.pi))
        query = np.linspace(-7.0, 7.0, 501)
        return float(
            np.abs(spline_weights(knots, query, period=2.0 * np.pi) @ np.sin(knots) - np.sin(query)).max()
        )

    assert 3.0 < np.log2(error(24) / error(48)) < 5.0


def test_force_at_stored_points_is_the_stored_force() -> None:
    database = shipped_database()
    found = database.force_at(database.omega[None, :], database.heading[:, None])
    assert np.abs(found - database.force).max() < 1e-9 * np.abs(database.force).max()


@settings(max_examples=40, deadline=None)
@given(
    omega=st.floats(0.1, 3.1), heading=st.floats(-10.0, 10.0), turns=st.integers(min_value=-3, max_value=3)
)
def test_headings_wrap_and_mirror(omega: float, heading: float, turns: int) -> None:
    database = shipped_database()
    force = database.force_at(omega, heading)
    size = np.abs(database.force).max(axis=(0, 1))
    assert np.all(np.abs(database.force_at(omega, heading + 2.0 * np.pi * turns) - force) < 1e-9 * size)
    assert np.all(np.abs(database.force_at(omega, -heading) - PARITY * force) < 1e-9 * size)


def test_leaving_out_every_second_heading_and_frequency_changes_little() -> None:
    full = shipped_database()
    half = dataclasses.replace(
        full,
        omega=full.omega[::2],
        heading=full.heading[::2],
        added_mass=full.added_mass[::2],
        damping=full.damping[::2],
        force=full.force[::2, ::2],
        memory=None,
    )
    inside = (full.omega > 0.3) & (full.omega < 1.5)
    found = half.force_at(full.omega[None, inside], full.heading[:, None])
    size = np.abs(full.force).max(axis=(0, 1))
    assert (
        np.abs(found - full.force[:, inside]) / size
    ).max() < 0.05  # the full table is about 16 times better


@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_force_at_refuses_numbers_that_are_not_finite(value: float) -> None:
    with pytest.raises(ValueError, match="finite"):
        small().force_at(value, 0.0)
    with pytest.raises(ValueError, match="finite"):
        small().force_at(1.0, value)


def test_wide_gaps_between_headings_are_not_interpolated() -> None:
    base = small()
    keep = [0, 3]
    sparse = dataclasses.replace(base, heading=base.heading[keep], force=base.force[keep])
    assert sparse.force_at(1.0, np.pi / 2.0) == pytest.approx(base.force_at(1.0, np.pi / 2.0))
    assert sparse.force_at(1.0, -np.pi / 2.0) == pytest.approx(PARITY * base.force_at(1.0, np.pi / 2.0))
    with pytest.raises(ValueError, match="heading 45 deg is not among the stored ones"):
        sparse.force_at(1.0, np.pi / 4.0)


def test_an_unsymmetric_vessel_is_not_mirrored() -> None:
    with pytest.raises(ValueError, match="heading -30 deg is not among"):
        small(port_starboard_symmetric=False).force_at(1.0, -np.pi / 6.0)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"omega": np.linspace(2.4, 0.2, 12)}, "omega is not strictly increasing"),
        ({"omega": np.repeat(np.linspace(0.2, 2.4, 6), 2)}, "omega is not strictly increasing"),
        ({"omega": np.linspace(0.0, 2.4, 12)}, "omega spans 0"),
        ({"heading": np.radians([0.0, 30.0, 20.0, 40.0, 50.0, 60.0, 70.0])}, "heading is not strictly"),
        ({"heading": np.radians(np.linspace(0.0, 360.0, 7))}, "heading spans"),
        ({"added_mass": np.zeros((11, 6, 6))}, r"added_mass has shape \(11, 6, 6\)"),
        ({"force": np.zeros((7, 12, 5))}, "force has shape"),
        ({"damping": np.full((12, 6, 6), np.nan)}, r"damping\[0, 0, 0\] is nan"),
        ({"restoring": np.full((6, 6), np.inf)}, r"restoring\[0, 0\] is inf"),
        ({"mass_matrix": -np.eye(6)}, "mass matrix is not positive definite"),
        ({"rho": -1.0}, "rho is -1"),
        ({"g": 0.0}, "g is 0"),
        ({"depth": float("nan")}, "depth is nan"),
        ({"trusted_band": (2.0, 1.0)}, "trusted_band"),
        ({"omega": np.zeros(0)}, "shape|empty"),
    ],
    ids=lambda value: next(iter(value)) if isinstance(value, dict) else "",
)
def test_bad_input_names_the_object(changes: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        small(**changes)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"heading": [0.0, 7.0]}, "heading must rise"),
        ({"heading": [1.0, 1.0]}, "heading must rise"),
        ({"omega": [0.0, 0.4, 0.5]}, "omega must be positive"),
        ({"omega": [0.3, 0.4, np.nan]}, r"omega\[2\] is not finite"),
        ({"coefficient": np.zeros((2, 3, 3))}, r"coefficient has shape \(2, 3, 3\); \(2, 3, 6\)"),
        ({"omega": [], "coefficient": np.zeros((2, 0, 6))}, "shape"),
    ],
)
def test_bad_drift_coefficients_are_named(changes: dict[str, Any], message: str) -> None:
    good = {"heading": [0.0, 1.0], "omega": [0.3, 0.4, 0.5], "coefficient": np.zeros((2, 3, 6))}
    assert not DriftCoefficients(**good).coefficient.flags.writeable
    with pytest.raises(ValueError, match=message):
        DriftCoefficients(**(good | changes))


def test_arrays_are_read_only_copies() -> None:
    given_array = np.linspace(0.2, 2.4, 12)
    database = small(omega=given_array)
    given_array[0] = 9.0
    assert database.omega[0] == 0.2
    with pytest.raises(ValueError, match="read-only"):
        database.added_mass[0, 0, 0] = 1.0
    with pytest.raises(dataclasses.FrozenInstanceError):
        database.rho = 1.0  # type: ignore[misc]


def equal(a: Any, b: Any) -> bool:
    """Bit-for-bit equality of dataclasses, arrays and plain values."""
    if dataclasses.is_dataclass(a):
        return type(a) is type(b) and all(
            equal(getattr(a, entry.name), getattr(b, entry.name)) for entry in dataclasses.fields(a)
        )
    if isinstance(a, tuple):
        return len(a) == len(b) and all(equal(x, y) for x, y in zip(a, b, strict=True))
    if isinstance(a, np.ndarray):
        return a.dtype == b.dtype and a.tobytes() == b.tobytes()
    return bool(a == b)


@pytest.mark.warns(sometimes=["DampingWarning", "HeadingGapWarning", "RaoPhaseWarning"])
@pytest.mark.parametrize("build", [small, everything, shipped_database])
def test_netcdf_round_trip_loses_nothing(build: Any, tmp_path: Path) -> None:
    database = build()
    database.save(tmp_path / "copy.nc")
    assert equal(database, load_database(tmp_path / "copy.nc"))
    assert [file.name for file in tmp_path.iterdir()] == ["copy.nc"]


def test_a_failing_save_leaves_the_old_file(tmp_path: Path) -> None:
    target = tmp_path / "copy.nc"
    small().save(target)
    before = target.read_bytes()
    broken = small()
    object.__setattr__(broken, "rho", "not a number")
    object.__setattr__(broken, "trusted_band", ("a", "b"))
    with pytest.raises(ValueError, match="could not convert"):
        broken.save(target)
    assert target.read_bytes() == before
    assert [file.name for file in tmp_path.iterdir()] == ["copy.nc"]


def test_saving_into_a_missing_folder_says_so(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match="nowhere"):
        small().save(tmp_path / "nowhere" / "copy.nc")


def test_a_foreign_netcdf_file_is_refused(tmp_path: Path) -> None:
    import xarray

    xarray.Dataset({"x": ("a", [1.0])}).to_netcdf(tmp_path / "foreign.nc")
    with pytest.raises(FileFormatError, match="not a seacrane hydrodynamic database"):
        load_database(tmp_path / "foreign.nc")


@pytest.mark.parametrize("part", [0.0, 0.02, 0.3, 0.6, 0.9, 0.999])
def test_a_truncated_netcdf_file_is_refused(part: float, tmp_path: Path) -> None:
    shipped_database().save(tmp_path / "whole.nc")
    data = (tmp_path / "whole.nc").read_bytes()
    (tmp_path / "cut.nc").write_bytes(data[: int(part * len(data))])
    with pytest.raises(FileFormatError, match=r"cut\.nc"):
        load_database(tmp_path / "cut.nc")


@pytest.mark.parametrize("missing", ["omega", "force", "restoring", "memory/A", "memory/row_order"])
def test_a_netcdf_file_without_a_variable_is_refused(missing: str, tmp_path: Path) -> None:
    import netCDF4

    shipped_database().save(tmp_path / "whole.nc")
    with netCDF4.Dataset(tmp_path / "whole.nc", "a") as file:
        file.renameVariable(missing, "elsewhere") if "/" not in missing else file["memory"].renameVariable(
            missing.split("/")[1], "elsewhere"
        )
    with pytest.raises(FileFormatError, match="damaged"):
        load_database(tmp_path / "whole.nc")


@pytest.mark.parametrize("version", [0, 99])
def test_another_format_is_refused_with_both(version: int, tmp_path: Path) -> None:
    import netCDF4

    small().save(tmp_path / "newer.nc")
    with netCDF4.Dataset(tmp_path / "newer.nc", "a") as file:
        file.format_version = version
    with pytest.raises(
        FileFormatError,
        match=rf"is of format version {version}, and this seacrane reads format version 1; save",
    ):
        load_database(tmp_path / "newer.nc")


def test_unknown_files_name_the_supported_kinds(tmp_path: Path) -> None:
    (tmp_path / "some.txt").write_text("hello")
    with pytest.raises(
        FileFormatError, match=r"supported: a NetCDF file .* of Capytaine, .* of seacrane, a ShipX/VERES"
    ):
        load_database(tmp_path / "some.txt")
    with pytest.raises(FileFormatError, match="no such file"):
        load_database(tmp_path / "absent")
    with pytest.raises(FileFormatError, match="no such file"):
        HydroDatabase.load(tmp_path / "absent.nc")


def test_a_folder_holds_one_database(tmp_path: Path) -> None:
    with pytest.raises(FileFormatError, match="nothing of a known kind; supported"):
        load_database(tmp_path)
    small().save(tmp_path / "one.nc")
    assert load_database(tmp_path).name == "small"
    small().save(tmp_path / "two.nc")
    with pytest.raises(FileFormatError, match=r"several files .*, name one"):
        load_database(tmp_path)


def test_to_xarray_is_labelled_and_complete() -> None:
    database = everything()
    dataset = database.to_xarray()
    assert dataset.added_mass.sel(motion="heave", motion_of="heave").values == pytest.approx(
        database.added_mass[:, 2, 2]
    )
    assert np.array_equal(dataset.force.transpose("heading", "omega", "motion").values, database.force)
    assert dataset.attrs["rho"] == database.rho
    assert "added_mass_roll_tanks" in dataset
    dataset.force.values[:] = 0.0
    assert np.abs(database.force).max() > 0.0
