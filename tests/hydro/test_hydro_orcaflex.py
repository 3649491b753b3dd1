"""OrcaFlex's models in all conventions and origins; MaFreDo's ``.dhyd`` files, and it as a second reader.

No OrcaFlex is at hand. MaFreDo 2026.3.1 and later need Python 3.12; files of its layout are written here.
"""

from __future__ import annotations

import copy
import dataclasses
import importlib
import itertools
import sys
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import pytest
from orcaflex_writer import EVENTS, UNITS, ZERO, G, assert_same, hull_part, model, write

from seacrane.errors import FileFormatError
from seacrane.hydro import HydroDatabase, load_database, read_orcaflex
from seacrane.warnings import AssumedDensityWarning, AssumedSymmetryWarning, PartialSetWarning

pytest.importorskip("yaml", reason="needs the extra 'orcaflex'")


@pytest.fixture(scope="module")
def hull() -> HydroDatabase:
    return hull_part()


@pytest.mark.parametrize(
    ("waves", "sense", "unit", "event", "turn"),
    [
        *itertools.product(UNITS[:1], ("lags", "leads"), ("degrees",), EVENTS, ("degrees",)),
        *itertools.product(UNITS[1:], ("leads",), ("radians",), ("trough",), ("radians",)),
    ],
)
def test_the_shipped_hull_comes_back(
    waves: str, sense: str, unit: str, event: str, turn: str, hull: HydroDatabase, tmp_path: Path
) -> None:
    """Units of rotations are of displacement RAOs. (MaFreDo 2026.8 multiplies load RAOs by 57.3.)"""
    path = write(tmp_path, model(hull, waves=waves, sense=sense, unit=unit, event=event, turn=turn))
    found = load_database(path)
    assert_same(found, hull)
    assert np.abs(found.motion_rao - hull.motion_rao).max() < 1e-9
    assert found.infinite_frequency_added_mass == pytest.approx(hull.infinite_frequency_added_mass)
    assert (found.rho, found.g, found.depth, found.length) == (1025.0, G, np.inf, 115.0)


@pytest.mark.parametrize(
    ("reference", "load", "phase"),
    [(ZERO, (20.0, -4.0, 5.0), ZERO), ((2.0, 0.5, 1.5), (20.0, -4.0, 5.0), (-30.0, 6.0, 1.0))],
)
def test_origins(reference: Any, load: Any, phase: Any, hull: HydroDatabase, tmp_path: Path) -> None:
    """Wherever the file takes its origins, the motion equation closes, and carries back to ours."""
    x, y, z = reference
    shift = np.eye(6)  # the whole restoring, which a vertical move leaves outside the 3 x 3 of the file
    shift[:3, 3:] = [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]]
    document = model(hull, reference=reference, load=load, phase=phase)
    found = read_orcaflex(write(tmp_path, document), restoring=shift.T @ hull.restoring @ shift)
    rows = [row.value for row in found.check() if row.check.startswith("motion_rao")]
    assert len(rows) == 6 and max(rows) < 1e-7
    along = x * np.cos(hull.heading) + y * np.sin(hull.heading)
    expected = hull.force.copy()
    expected[:, :, 3:] += np.cross((-x, -y, -z), expected[:, :, :3])
    expected *= np.exp(1j * np.outer(along, hull.omega**2 / G))[:, :, None]
    assert np.all(np.abs(found.force - expected) <= 1e-9 * np.abs(expected).max(axis=(0, 1)))


def test_other_damping_is_read(hull: HydroDatabase, tmp_path: Path) -> None:
    document = model(hull)
    state = document["VesselTypes"][0]["Draughts"][0]
    state["OtherLinearDamping"] = [1.0, 2.0, 3.0, 4e4, 5.0, 6.0]
    state["OtherQuadraticDamping"] = [0.0, 0.0, 0.0, 7e5, 0.0, 0.0]
    found = read_orcaflex(write(tmp_path, document))
    assert np.array_equal(np.diag(found.linear_damping), [1e3, 2e3, 3e3, 4e7, 5e3, 6e3])
    assert found.quadratic_damping[3] == 7e8
    state["OtherDampingOrigin"] = [0.0, 0.0, 2.0]
    with pytest.raises(FileFormatError, match=r"quadratic other damping acts at \[0.0, 0.0, 2.0\] m"):
        read_orcaflex(write(tmp_path, document))
    state["OtherQuadraticDamping"] = [0.0] * 6
    found = read_orcaflex(write(tmp_path, document))
    assert found.linear_damping[3, 3] == pytest.approx(4e7 + 2e3 * 4.0)  # sway damping two metres up
    assert found.linear_damping[1, 3] == pytest.approx(-2e3 * 2.0)


def test_grids_that_differ(hull: HydroDatabase, tmp_path: Path) -> None:
    document = model(hull)
    draught = document["VesselTypes"][0]["Draughts"][0]
    del draught["FrequencyDependentAddedMassAndDamping"][4]
    with pytest.warns(PartialSetWarning, match="1 frequencies"):
        found = read_orcaflex(write(tmp_path, document))
    keep = np.arange(len(hull.omega)) != 3
    assert np.all(np.abs(found.force - hull.force[:, keep]) <= 1e-9 * np.abs(hull.force).max(axis=(0, 1)))
    assert np.abs(found.added_mass - hull.added_mass[keep]).max() <= 1e-9 * hull.added_mass.max()


def test_a_choice_of_vessel_types_and_draughts(hull: HydroDatabase, tmp_path: Path) -> None:
    document = model(hull)
    other = copy.deepcopy(document["VesselTypes"][0]) | {"Name": "Barge"}
    other["Draughts"].append(copy.deepcopy(other["Draughts"][0]) | {"Name": "Light", "Mass": 1e4})
    document["VesselTypes"].append(other)
    path = write(tmp_path, document)
    with pytest.raises(FileFormatError, match="Vessel type1, Barge; pass vessel_type="):
        load_database(path)
    with pytest.raises(FileFormatError, match="Draught1, Light; pass draught="):
        read_orcaflex(path, vessel_type="Barge")
    assert read_orcaflex(path, vessel_type="Barge", draught="Light").mass_matrix[0, 0] == 1e7


def library() -> Any:
    return importlib.import_module("mafredo")


needs_mafredo = pytest.mark.skipif(
    sys.version_info < (3, 12), reason="MaFreDo is written in the syntax of Python 3.12"
)


def dhyd(
    hull: HydroDatabase, folder: Path, *, phase_origin: tuple[float, float] | None = None, info: bool = True
) -> Path:
    """The hull as ``ship.dhyd`` in MaFreDo's layout: te, kN, phases that lag."""
    path = folder / "ship.dhyd"
    with netCDF4.Dataset(path, "w") as file:
        for name, table in (("mass", hull.added_mass), ("damping", hull.damping)):
            dimensions = {"omega": hull.omega, "radiating_dof": np.arange(6), "influenced_dof": np.arange(6)}
            put(file.createGroup(name), dimensions, {"array": table.swapaxes(1, 2) / 1e3})
        for i, name in enumerate(("Surge", "Sway", "Heave", "Roll", "Pitch", "Yaw")):
            loads = np.conj(hull.force[:, :, i].T) / 1e3
            dimensions = {"omega": hull.omega, "wave_direction": np.degrees(hull.heading)}
            put(file.createGroup(name), dimensions, {"real": loads.real, "imag": loads.imag})
        if info:
            group = file.createGroup("info")
            group.createVariable("symmetry", "i8", ())[...] = 1
            for axis, value in enumerate(phase_origin or ()):
                group.createVariable(f"phase_origin_{axis}", "f8", ())[...] = value
    return path


def put(group: Any, dimensions: dict[str, np.ndarray], arrays: dict[str, np.ndarray]) -> None:
    for name, values in dimensions.items():
        group.createDimension(name, len(values))
        group.createVariable(name, values.dtype, (name,), fill_value=False)[...] = values
    for name, values in arrays.items():
        group.createVariable(name, "f8", tuple(dimensions), fill_value=False)[...] = values


def mafredo_data(hull: HydroDatabase) -> Any:
    force = np.moveaxis(hull.force, (0, 1, 2), (2, 1, 0))
    matrices = (table.swapaxes(1, 2) / 1e3 for table in (hull.added_mass, hull.damping))
    loads = (np.degrees(hull.heading), np.abs(force) / 1e3, -np.angle(force))
    data = library().Hyddb1.create_from_data(hull.omega, *matrices, *loads)
    data.symmetry = library().helpers.Symmetry.XZ
    return data


def read_dhyd(path: Path, hull: HydroDatabase) -> HydroDatabase:
    """With the mass and restoring that the file cannot hold."""
    return read_orcaflex(path, mass_matrix=hull.mass_matrix, restoring=hull.restoring, rho=1025.0)


def test_dhyd_round_trip(hull: HydroDatabase, tmp_path: Path) -> None:
    """Also of a phase origin that is a point forward and to port of the reference point."""
    found = read_dhyd(dhyd(hull, tmp_path), hull)
    assert_same(found, hull)
    assert found.origin == "reference point of the MaFreDo database" and found.motion_rao is None
    x, y = 12.0, -3.0
    along = np.outer(x * np.cos(hull.heading) + y * np.sin(hull.heading), hull.omega**2 / G)
    there = dataclasses.replace(hull, force=hull.force * np.exp(1j * along)[:, :, None])
    assert_same(read_dhyd(dhyd(there, tmp_path, phase_origin=(x, y)), hull), hull)


def test_what_a_dhyd_file_does_not_hold(hull: HydroDatabase, tmp_path: Path) -> None:
    """Mass and restoring; and old files no symmetry: with directions on one side only it is taken for one."""
    path = dhyd(hull, tmp_path)
    with pytest.warns(AssumedDensityWarning), pytest.raises(FileFormatError, match="holds no mass_matrix"):
        load_database(path)
    with pytest.raises(FileFormatError, match="holds no restoring"):
        read_orcaflex(path, mass_matrix=hull.mass_matrix, rho=1025.0)
    whole = dataclasses.replace(hull, heading=hull.heading + np.radians(170.0))
    for ship, message in ((hull, "up to 180 deg 'xz plane'"), (whole, "up to 350 deg 'None'")):
        with pytest.warns(AssumedSymmetryWarning, match=message):
            found = read_dhyd(dhyd(ship, tmp_path, info=False), hull)
        assert found.port_starboard_symmetric == (ship is hull)


@needs_mafredo
def test_what_mafredo_writes(hull: HydroDatabase, tmp_path: Path) -> None:
    """The library's own file, and the layout the other tests write; the frequency zero is a limit."""
    data, path = mafredo_data(hull), tmp_path / "library.dhyd"
    data.save_as(str(path), engine="netcdf4")
    assert_same(read_dhyd(path, hull), hull)
    with netCDF4.Dataset(path) as file, netCDF4.Dataset(dhyd(hull, tmp_path)) as ours:
        assert set(file.groups) == set(ours.groups)
        for name in ("mass", "Yaw", "info"):
            known = {"__xarray_dataarray_variable__", "array", "phase", "phase_origin_0", "phase_origin_1"}
            assert set(file[name].variables) - known == set(ours[name].variables) - known
    data.add_frequency(0.0)  # constant extrapolation
    data.save_as(str(path), engine="netcdf4")
    found = read_dhyd(path, hull)
    assert found.omega == pytest.approx(hull.omega)
    assert found.zero_frequency_added_mass == pytest.approx(hull.added_mass[0], rel=1e-9, abs=1.0)


@needs_mafredo
@pytest.mark.parametrize(
    ("waves", "sense", "event"), list(itertools.product(UNITS[1:], ("lags", "leads"), EVENTS))[::5]
)
def test_mafredo_reads_the_same_loads(
    waves: str, sense: str, event: str, hull: HydroDatabase, tmp_path: Path
) -> None:
    path = write(tmp_path, model(hull, waves=waves, sense=sense, event=event))
    data = library().Hyddb1.create_from_orcaflex_yml(str(path), vessel_type_name="Vessel type1")
    values = [data.force_rao(i)["complex"].transpose("wave_direction", "omega").values for i in range(6)]
    found, other = read_orcaflex(path).force, np.conj(np.stack(values, axis=-1)) * 1e3
    assert np.all(np.abs(found - other) <= 1e-9 * np.abs(found).max(axis=(0, 1)))


@needs_mafredo
def test_bow_and_stern_alike(hull: HydroDatabase, tmp_path: Path) -> None:
    """A quarter of the directions of a vessel with two planes of symmetry, against MaFreDo's expansion."""
    quarter = dataclasses.replace(
        hull, heading=hull.heading[:7], force=hull.force[:7], motion_rao=hull.motion_rao[:7]
    )  # type: ignore[index]
    document = model(quarter)
    document["VesselTypes"][0]["Symmetry"] = "xz and yz planes"
    path = write(tmp_path, document)
    found = read_orcaflex(path)
    assert np.degrees(found.heading) == pytest.approx(np.arange(0.0, 181.0, 15.0))
    data = library().Hyddb1.create_from_orcaflex_yml(str(path), vessel_type_name="Vessel type1")
    data.expand360_using_symmetry()
    for degrees in (120.0, 180.0, 240.0):
        for k, omega in enumerate(found.omega):
            other = np.conj([rao.get_value(omega, degrees) for rao in data._force]) * 1e3
            ours = found.force_at(omega, np.radians(degrees))
            assert ours == pytest.approx(other, rel=1e-6, abs=1e-3), (degrees, k)
