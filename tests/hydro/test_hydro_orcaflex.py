"""OrcaFlex reader: the shipped hull written in OrcaFlex's layout, in all its conventions and origins.

No OrcaFlex is at hand; `test_hydro_mafredo` compares with a second reader.
"""

from __future__ import annotations

import copy
import itertools
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from orcaflex_writer import EVENTS, UNITS, ZERO, G, assert_same, hull_part, model, write

from seacrane.errors import FileFormatError
from seacrane.hydro import HydroDatabase, load_database, read_orcaflex
from seacrane.warnings import PartialSetWarning

pytest.importorskip("yaml", reason="needs the extra 'orcaflex'")


@pytest.fixture(scope="module")
def hull() -> HydroDatabase:
    """Seven frequencies and 13 headings of the shipped hull, with motions."""
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
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = load_database(path)
    assert_same(found, hull)
    assert np.abs(found.motion_rao - hull.motion_rao).max() < 1e-9
    assert found.infinite_frequency_added_mass == pytest.approx(hull.infinite_frequency_added_mass)
    assert (found.rho, found.g, found.depth, found.length) == (1025.0, G, np.inf, 115.0)
    assert "Vessel type1, Draught1" in found.source


@pytest.mark.parametrize(
    ("reference", "load", "phase"),
    [
        ((3.0, 1.0, -2.0),) * 3,
        (ZERO, (20.0, -4.0, 5.0), ZERO),
        ((2.0, 0.5, 1.5), (20.0, -4.0, 5.0), (-30.0, 6.0, 1.0)),
    ],
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
    document = model(hull)
    del document["VesselTypes"][0]["Draughts"][0]["DisplacementRAOs"]["RAOs"][2]
    with pytest.warns(PartialSetWarning, match="displacement RAOs"):
        assert read_orcaflex(write(tmp_path, document)).motion_rao is None


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
    path.write_bytes(b"\xff\xfe\x00a")
    with pytest.raises(FileFormatError, match="no UTF-8 text"):
        load_database(path)
    with pytest.raises(FileFormatError, match="no such file"):
        read_orcaflex(tmp_path / "absent.yml")
