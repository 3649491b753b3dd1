"""OrcaFlex reader on altered, truncated and hostile documents: always an error that names the place."""

from __future__ import annotations

import copy
import dataclasses
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from orcaflex_writer import hull_part, model, text_of, write

from seacrane.errors import FileFormatError
from seacrane.hydro import PartialSetWarning, load_database, read_orcaflex
from seacrane.hydro.readers.orcaflex_model import INERTIA, RAO_ROWS, STIFFNESS

pytest.importorskip("yaml", reason="needs the extra 'orcaflex'")


def alter(document: dict[str, Any], place: str, value: Any) -> None:
    """Set, or drop with None, one entry of the model: ``place`` is below Vessel, Draught or the top."""
    kind = document["VesselTypes"][0]
    where, _, key = place.rpartition("/")
    node = {"": document, "vessel": kind, "draught": kind["Draughts"][0]}.get(where)
    if node is None:
        node = kind["Draughts"][0][where]
    if value is None:
        del node[key]
    else:
        node[key] = value


@pytest.mark.parametrize(
    ("place", "value", "message"),
    [
        ("General", {"UnitsSystem": "US"}, "units system 'US'"),
        ("VesselTypes", None, "VesselTypes is missing"),
        ("VesselTypes", [], "VesselTypes: holds nothing"),
        ("VesselTypes", 3, "VesselTypes: a list is expected"),
        ("vessel/RAOWaveUnit", "steepness", "RAOWaveUnit is 'steepness'; only 'amplitude'"),
        ("vessel/SurgePositive", "aft", "SurgePositive is 'aft'"),
        ("vessel/SwayPositive", "starboard", "SwayPositive"),
        ("vessel/HeavePositive", "down", "HeavePositive"),
        ("vessel/RollPositiveStarboard", "up", "RollPositiveStarboard"),
        ("vessel/PitchPositiveBow", "up", "PitchPositiveBow"),
        ("vessel/YawPositiveBow", "starboard", "YawPositiveBow"),
        ("vessel/WavesReferredToBy", "length", "WavesReferredToBy is 'length'"),
        ("vessel/RAOPhaseConvention", "follows", "RAO phases as 'follows'"),
        ("vessel/RAOPhaseRelativeToConvention", "noon", "relative to 'noon'"),
        ("vessel/RAOPhaseUnitsConvention", "grads", "'grads'"),
        ("vessel/RAOResponseUnits", "grads", "RAOResponseUnits is 'grads'"),
        ("vessel/Symmetry", "Circular", "symmetry 'Circular'"),
        ("vessel/Length", "long", "Length: 'long' is not a number"),
        ("vessel/Length", -3.0, "length is -3"),
        ("draught/Mass", "Infinity", "Mass: inf is not finite"),
        ("draught/Mass", -1.0, "not positive definite|positive"),
        ("draught/Mass", None, "holds no mass_matrix"),
        ("draught/" + STIFFNESS, None, "holds no restoring"),
        ("draught/" + STIFFNESS, [[1.0, 2.0, 3.0]], "3 rows are expected, found 1"),
        (
            "draught/" + STIFFNESS,
            [[1.0, 2.0], [1.0] * 3, [1.0] * 3],
            r"\[1\]: 3 numbers are expected, found 2",
        ),
        ("draught/" + STIFFNESS, [[0.0] * 3 for _ in range(3)], "C33 = 0"),
        ("draught/" + INERTIA, "none", "a list is expected"),
        ("draught/ReferenceOrigin", [1.0, 2.0], "ReferenceOrigin: 3 numbers are expected"),
        ("draught/FrequencyDependentAddedMassAndDamping", None, "one body with the method"),
        ("draught/FrequencyDependentAddedMassAndDamping", [{}], "AMDPeriodOrFrequency is missing"),
        ("draught/LoadRAOs", None, "LoadRAOs is missing"),
        ("LoadRAOs/RAOs", [], "RAOs is empty|RAOs is missing"),
        ("LoadRAOs/RAOs", [{"RAODirection": 0.0, RAO_ROWS: [[1.0] * 12]}], "13 numbers are expected"),
        ("LoadRAOs/RAOs", [{"RAODirection": True, RAO_ROWS: [[1.0] * 13]}], "'True' is not a number"),
        ("LoadRAOs/RAOs", [{"RAODirection": 0.0, RAO_ROWS: [[-1.0] * 13]}], "frequency -1; give positive"),
        ("LoadRAOs/RAOs", [{"RAODirection": 0.0, RAO_ROWS: [[0.77] * 13]}], "no frequency in common"),
    ],
)
def test_alterations_are_named(
    place: str, value: Any, message: str, small_model: dict[str, Any], tmp_path: Path
) -> None:
    document = copy.deepcopy(small_model)
    alter(document, place, value)
    path = write(tmp_path, document)
    with warnings.catch_warnings(), pytest.raises(FileFormatError, match=rf"ship\.yml.*({message})"):
        warnings.simplefilter("ignore")
        read_orcaflex(path)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "no OrcaFlex model"),
        ("[1, 2]", "no OrcaFlex model"),
        ("a: [1, 2", r"line \d+: no YAML document"),
        ("a: b: c", r"line 1: no YAML document"),
        ("a: 1\n--- \nb: 2\n", "no YAML document"),
        ("a: &x [1]\nb: *x\n", "line 2: nested too deeply or aliased"),
        ("[" * 300000, "line 1: nested too deeply"),
        ("- " * 300000 + "1", "line 1: nested too deeply"),
        ("{a: " * 300000, "line 1: nested too deeply"),
        ("a: !!python/object:os.system x\n", "no YAML document"),
        ("a: 1\x00\n", "no YAML document"),
    ],
    ids=lambda value: value[:12],
)
def test_documents_that_are_no_model(text: str, message: str, tmp_path: Path) -> None:
    (tmp_path / "ship.yml").write_text(text)
    with pytest.raises(FileFormatError, match=r"ship\.yml.*" + message):
        load_database(tmp_path / "ship.yml")


def test_a_file_that_is_no_text(tmp_path: Path) -> None:
    (tmp_path / "ship.yml").write_bytes(b"\xff\xfe\x00a")
    with pytest.raises(FileFormatError, match="no UTF-8 text"):
        load_database(tmp_path / "ship.yml")
    with pytest.raises(FileFormatError, match="no such file"):
        read_orcaflex(tmp_path / "absent.yml")


@pytest.fixture(scope="module")
def small_model() -> dict[str, Any]:
    """Three frequencies and three directions."""
    hull = hull_part()
    part = dataclasses.replace(
        hull,
        omega=hull.omega[:3],
        heading=hull.heading[:3],
        added_mass=hull.added_mass[:3],
        damping=hull.damping[:3],
        force=hull.force[:3, :3],
        motion_rao=hull.force[:3, :3],
    )
    return model(part)


@pytest.fixture(scope="module")
def small(small_model: dict[str, Any]) -> str:
    """The small model without displacement RAOs, as text."""
    document = copy.deepcopy(small_model)
    del document["VesselTypes"][0]["Draughts"][0]["DisplacementRAOs"]
    return text_of(document)


def test_every_truncation_is_noticed(small: str, tmp_path: Path) -> None:
    """A text without its end lacks something that is needed, or frequencies, or nothing but other damping."""
    lines = small.splitlines()
    path = tmp_path / "ship.yml"
    read = 0
    for kept in range(0, len(lines), 2):
        path.write_text("\n".join(lines[:kept]) + "\n")
        try:
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                found = read_orcaflex(path)
        except FileFormatError as error:
            assert "ship.yml" in str(error)
        else:
            read += 1
            partial = any(warning.category is PartialSetWarning for warning in caught)
            assert partial == (len(found.omega) < 3)
            assert kept > 0.8 * len(lines) or partial
    assert read < 0.6 * len(lines) / 2


@pytest.mark.filterwarnings("ignore::UserWarning")
@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(data=st.data())
def test_random_damage_gives_a_database_or_a_named_error(
    data: st.DataObject, small: str, tmp_path: Path
) -> None:
    start = data.draw(st.integers(0, len(small) - 1))
    removed = data.draw(st.integers(0, 40))
    inserted = data.draw(st.text(alphabet="0123456789.-+eEDnaif[]{}&*:, \n\x00é", max_size=12))
    path = tmp_path / "ship.yml"
    path.write_text(small[:start] + inserted + small[start + removed :], encoding="utf-8")
    try:
        found = read_orcaflex(path)
    except FileFormatError as error:
        assert "ship.yml" in str(error)
    else:
        assert np.all(np.isfinite(found.force))
