"""Public models that OrcaFlex saved, beside twenty lines that read them too, and numbers by MaFreDo."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from seacrane.errors import FileFormatError
from seacrane.hydro import HydroDatabase, read_orcaflex
from seacrane.hydro.readers.orcaflex_model import ADDED_MASS, DAMPING, DRIFT_ROWS, RAO_ROWS

yaml = pytest.importorskip("yaml", reason="needs the extra 'orcaflex'")

MASS = {"barge_100x30x4_q1": 12.3e6, "refcase_lags": 51.25e3, "refcase_leads": 51.25e3, "testModel": None}
MAFREDO = Path(__file__).with_name("mafredo_numbers.json")  # tools/mafredo_numbers.py


@pytest.fixture(scope="module")
def models(shared: Path) -> Path:
    if not (shared / "orcaflex").is_dir():
        pytest.skip(f"no {shared / 'orcaflex'}")
    return shared / "orcaflex"


def read(folder: Path, name: str) -> HydroDatabase:
    """With a mass matrix where the file has a placeholder."""
    mass = MASS[name]
    given = {} if mass is None else {"mass_matrix": mass * np.diag([1.0, 1.0, 1.0, 80.0, 800.0, 800.0])}
    return read_orcaflex(folder / f"{name}.yml", **given)  # type: ignore[arg-type]


def plainly(path: Path) -> dict[str, Any]:
    """Matrices, forces by direction and drift of such a file, in SI: all else is as we have it."""
    kind = yaml.load(path.read_text("utf-8-sig"), Loader=yaml.CSafeLoader)["VesselTypes"][0]
    state = kind["Draughts"][0]

    def omega(values: Any) -> np.ndarray:
        values = np.array(values, dtype=float)
        with np.errstate(divide="ignore"):
            return 2.0 * np.pi / values if "period" in kind["WavesReferredToBy"] else values

    found = {"added_mass": {}, "damping": {}, "force": {}, "drift": {}}
    for entry in state["FrequencyDependentAddedMassAndDamping"]:
        for name, key in (("added_mass", ADDED_MASS), ("damping", DAMPING)):
            w = float(omega(entry["AMDPeriodOrFrequency"]))
            found[name][w] = 1e3 * np.array(entry[key], dtype=float)
    sense = -1j if kind["RAOPhaseConvention"] == "lags" else 1j
    for entry in state["LoadRAOs"]["RAOs"]:
        for row in np.array(entry[RAO_ROWS], dtype=float):
            load = 1e3 * row[1::2] * np.exp(sense * np.radians(row[2::2]))
            found["force"][entry["RAODirection"], float(omega(row[0]))] = load
    for entry in state["WaveDrift"]["RAOs"]:
        for row in np.array(entry[DRIFT_ROWS], dtype=float):
            found["drift"][entry["RAODirection"], float(omega(row[0]))] = 1e3 * row[1:]
    return found


@pytest.mark.parametrize("name", MASS)
def test_every_number_is_the_files(name: str, models: Path) -> None:
    found, plain = read(models, name), plainly(models / f"{name}.yml")
    kept = {w for w in plain["added_mass"] if 0.0 < w < np.inf}
    assert sorted(kept) == pytest.approx(found.omega, rel=1e-9)
    for k, w in enumerate(sorted(kept)):
        for table in ("added_mass", "damping"):
            assert getattr(found, table)[k] == pytest.approx(plain[table][w], rel=1e-6, abs=1e-9)
    if np.inf in plain["added_mass"]:
        assert found.infinite_frequency_added_mass == pytest.approx(plain["added_mass"][np.inf], rel=1e-6)
    for (degrees, w), load in plain["force"].items():
        if 0.0 < w < np.inf:
            at = np.isclose(found.heading, np.radians(degrees)), np.isclose(found.omega, w, rtol=1e-9)
            error = np.abs(found.force[at][0] - load)
            assert np.all(error <= 1e-6 * np.abs(load) + 1e-9 * np.abs(found.force).max())
    told = {key: load for key, load in plain["drift"].items() if 0.0 < key[1] < np.inf}
    assert (found.drift is None) == (not told)
    for (degrees, w), load in told.items():
        at = np.isclose(found.drift.heading, np.radians(degrees)), np.isclose(found.drift.omega, w, rtol=1e-9)
        assert found.drift.coefficient[at][0] == pytest.approx(load, rel=1e-6)


def test_lags_and_leads_are_one_sea(models: Path) -> None:
    lags, leads = (read(models, f"refcase_{sense}") for sense in ("lags", "leads"))
    assert np.abs(lags.force - leads.force).max() < 1e-9 * np.abs(lags.force).max()
    assert np.abs(lags.motion_rao - leads.motion_rao).max() < 1e-9  # type: ignore[operator]


@pytest.mark.parametrize("name", json.loads(MAFREDO.read_text()))
def test_mafredo_reads_the_same(name: str, models: Path) -> None:
    found = read(models, name)
    column = int(np.argmin(np.abs(found.heading - np.radians(45.0))))
    for told in json.loads(MAFREDO.read_text())[name]:
        k = int(np.argmin(np.abs(found.omega - told["omega"])))
        assert found.omega[k] == pytest.approx(told["omega"], rel=1e-9)
        for table in ("added_mass", "damping"):
            other = np.array(told[table])
            assert np.abs(getattr(found, table)[k] - other).max() <= 1e-6 * np.abs(other).max()
        other = np.array(told["force_at_45_deg"]) @ (1.0, 1.0j)
        assert np.all(np.abs(found.force[column, k] - other) <= 1e-6 * np.abs(other) + 1e-6)


@pytest.mark.parametrize(
    ("name", "why"),
    [("barge_100x30x4_q1", "mass is 1000 kg, and it displaces"), ("refcase_lags", "not positive definite")],
)
def test_placeholder_masses_are_asked_for(name: str, why: str, models: Path) -> None:
    with pytest.raises(FileFormatError, match=rf"{why}.*mass_matrix="):
        read_orcaflex(models / f"{name}.yml")
