"""OrcaFlex and MaFreDo readers: the shipped hull written in their layouts, MaFreDo as a second reader.

No OrcaFlex is at hand: models are written as OrcaFlex lays its text files out. MaFreDo writes the ``.dhyd``
files and reads the models independently.
"""

from __future__ import annotations

import copy
import dataclasses
import itertools
import warnings
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from test_hydro_capytaine import layout

from seacrane.cli import main
from seacrane.errors import FileFormatError
from seacrane.hydro import (
    AssumedDensityWarning,
    HydroDatabase,
    PartialSetWarning,
    available_speeds,
    load_database,
    motion_response,
    read_capytaine,
    read_orcaflex,
    rigid_mass_matrix,
    shipped_database,
)
from seacrane.hydro.orcaflex_model import ADDED_MASS, DAMPING, INERTIA, RAO_ROWS, STIFFNESS
from seacrane.hydro.relations import damping_from_forces

yaml = pytest.importorskip("yaml", reason="needs the extra 'orcaflex'")
mafredo = pytest.importorskip("mafredo", reason="needs the extra 'orcaflex'")

G = 9.80665
EVENTS = {"crest": 0.0, "zero down-crossing": 90.0, "trough": 180.0, "zero up-crossing": 270.0}
UNITS = ("period (s)", "frequency (rad/s)", "frequency (Hz)")
ZERO = (0.0, 0.0, 0.0)


@pytest.fixture(scope="module")
def hull() -> HydroDatabase:
    """Every ninth frequency of the shipped hull, 13 headings, with motions solved from it.

    Its roll damping beside radiation becomes "other damping".
    """
    base = shipped_database()
    part = dataclasses.replace(
        base,
        omega=base.omega[3::9],
        heading=base.heading[::3],
        added_mass=base.added_mass[3::9],
        damping=base.damping[3::9],
        force=base.force[::3, 3::9],
        g=G,
        memory=None,
    )
    return dataclasses.replace(part, motion_rao=motion_response(part))


def plain(value: Any) -> Any:
    """Nested lists of Python floats."""
    return np.asarray(value, dtype=float).tolist()


def model(
    hull: HydroDatabase,
    *,
    waves: str = "frequency (rad/s)",
    sense: str = "lags",
    unit: str = "degrees",
    event: str = "crest",
    turn: str = "degrees",
    reference: tuple[float, float, float] = ZERO,
    load: tuple[float, float, float] = ZERO,
    phase: tuple[float, float, float] = ZERO,
) -> dict[str, Any]:
    """The hull as an OrcaFlex model; its own reference point is the origin of the vessel's axes."""
    at, origin, start = (np.array(point, dtype=float) for point in (reference, load, phase))

    def periods(omega: np.ndarray) -> np.ndarray:
        with np.errstate(divide="ignore"):
            return {UNITS[0]: 2.0 * np.pi / omega, UNITS[1]: omega, UNITS[2]: omega / (2.0 * np.pi)}[waves]

    def moved(matrix: np.ndarray) -> list[Any]:
        """About the reference origin: the motion at ours is that at the reference plus rotation x lever."""
        steps = []
        for unit_motion in np.eye(6):
            there = unit_motion.copy()
            there[:3] += np.cross(unit_motion[3:], -at)
            wrench = matrix @ there
            wrench[3:] += np.cross(-at, wrench[:3])
            steps.append(wrench)
        return plain(np.array(steps).T)

    crest_at_start = (
        hull.omega**2 / G * (np.cos(hull.heading) * start[0] + np.sin(hull.heading) * start[1])[:, None]
    )

    def raos(values: np.ndarray, scale: np.ndarray) -> list[dict[str, Any]]:
        shifted = values * np.exp(1j * crest_at_start)[:, :, None] / scale
        lag = -np.degrees(np.angle(shifted)) - EVENTS[event]
        shown = (lag if sense == "lags" else -lag) % 360.0
        shown = shown if unit == "degrees" else np.radians(shown)
        rows = np.empty((*hull.force.shape[:2], 13))
        rows[:, :, 0], rows[:, :, 1::2], rows[:, :, 2::2] = periods(hull.omega), np.abs(shifted), shown
        return [
            {"RAODirection": float(np.degrees(b)), RAO_ROWS: plain(table)}
            for b, table in zip(hull.heading, rows, strict=True)
        ]

    forces, motions = hull.force.copy(), hull.motion_rao
    assert motions is not None
    motions = motions.copy()
    forces[:, :, 3:] += np.cross(-origin, forces[:, :, :3])
    motions[:, :, :3] += np.cross(motions[:, :, 3:], origin)
    angle = np.pi / 180.0 if turn == "degrees" else 1.0
    infinite = hull.infinite_frequency_added_mass
    assert infinite is not None
    omega = np.concatenate([[np.inf], hull.omega])
    tables = (
        np.concatenate([infinite[None], hull.added_mass]),
        np.concatenate([np.zeros((1, 6, 6)), hull.damping]),
    )
    mass = hull.mass_matrix[0, 0]
    lever = 0.5 * (hull.mass_matrix[3:, :3] - hull.mass_matrix[:3, 3:]) / mass
    centre = np.array([lever[2, 1], lever[0, 2], lever[1, 0]])
    inertia = hull.mass_matrix[3:, 3:] - rigid_mass_matrix(mass, centre, np.zeros((3, 3)))[3:, 3:]
    draught = {
        "Name": "Draught1",
        "Mass": float(mass / 1e3),
        INERTIA: plain(inertia / 1e3),
        "CentreOfGravity": plain(centre),
        "DisplacementRAOs": {
            "RAOOrigin": list(load),
            "PhaseOrigin": list(phase),
            "RAOs": raos(motions, np.array([1.0, 1.0, 1.0, angle, angle, angle])),
        },
        "LoadRAOs": {
            "RAOOrigin": list(load),
            "PhaseOrigin": [None, None, None] if load == phase else list(phase),
            "RAOs": raos(forces, np.full(6, 1e3)),
        },
        "ReferenceOrigin": list(reference),
        STIFFNESS: [row[2:5] for row in moved(hull.restoring / 1e3)[2:5]],
        "AMDMethod": "Frequency dependent",
        "FrequencyDependentAddedMassAndDamping": [
            {"AMDPeriodOrFrequency": float(p), ADDED_MASS: moved(a / 1e3), DAMPING: moved(b / 1e3)}
            for p, a, b in zip(periods(omega), *tables, strict=True)
        ],
        "OtherDampingOrigin": [0.0, 0.0, 0.0],
        "OtherLinearDamping": plain(np.diag(hull.linear_damping) / 1e3),
        "OtherQuadraticDamping": [0.0] * 6,
    }
    return {
        "General": {"UnitsSystem": "SI"},
        "Environment": {"Density": 1.025, "WaterDepth": "Infinity"},
        "VesselTypes": [
            {
                "Name": "Vessel type1",
                "Length": 115.0,
                "RAOResponseUnits": turn,
                "RAOWaveUnit": "amplitude",
                "WavesReferredToBy": waves,
                "RAOPhaseConvention": sense,
                "RAOPhaseUnitsConvention": unit,
                "RAOPhaseRelativeToConvention": event,
                "SurgePositive": "forward",
                "SwayPositive": "port",
                "HeavePositive": "up",
                "RollPositiveStarboard": "down",
                "PitchPositiveBow": "down",
                "YawPositiveBow": "port",
                "Symmetry": "xz plane",
                "Draughts": [draught],
            }
        ],
    }


def text_of(document: dict[str, Any]) -> str:
    """As OrcaFlex writes it: a heading, infinity as a word."""
    body = yaml.dump(
        document, Dumper=yaml.CSafeDumper, sort_keys=False, default_flow_style=None, width=100000
    )
    return "%YAML 1.1\n# Type: Model\n---\n" + body.replace(".inf", "Infinity")


def write(folder: Path, document: dict[str, Any]) -> Path:
    """The model as ``ship.yml``."""
    (folder / "ship.yml").write_text(text_of(document), encoding="utf-8")
    return folder / "ship.yml"


def assert_same(found: HydroDatabase, hull: HydroDatabase, *, rel: float = 1e-9) -> None:
    """Everything that both kinds of file hold."""
    assert found.omega == pytest.approx(hull.omega, rel=rel)
    assert found.heading == pytest.approx(hull.heading, abs=1e-8)
    for name in ("added_mass", "damping", "restoring", "mass_matrix"):
        exact = getattr(hull, name)
        scale = np.sqrt(np.abs(np.diagonal(exact, axis1=-2, axis2=-1)))
        largest = np.maximum(scale.max(axis=0) if exact.ndim == 3 else scale, 1.0)
        assert np.all(np.abs(getattr(found, name) - exact) <= rel * np.outer(largest, largest)), name
    assert np.all(np.abs(found.force - hull.force) <= rel * np.abs(hull.force).max(axis=(0, 1)))
    assert found.port_starboard_symmetric


@pytest.mark.parametrize(
    ("waves", "sense", "unit", "event"),
    [
        *itertools.product(UNITS[:1], ("lags", "leads"), ("degrees",), EVENTS),
        *itertools.product(UNITS[1:], ("leads",), ("radians",), ("trough",)),
    ],
)
def test_the_shipped_hull_comes_back(
    waves: str, sense: str, unit: str, event: str, hull: HydroDatabase, tmp_path: Path
) -> None:
    path = write(tmp_path, model(hull, waves=waves, sense=sense, unit=unit, event=event))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = load_database(path)
    assert_same(found, hull)
    assert found.infinite_frequency_added_mass == pytest.approx(hull.infinite_frequency_added_mass)
    assert (found.rho, found.g, found.depth, found.length) == (1025.0, G, np.inf, 115.0)
    assert "Vessel type1, Draught1" in found.source
    rows = {row.check: row for row in found.check() if row.check.startswith("motion_rao")}
    assert len(rows) == 6 and max(row.value for row in rows.values()) < 1e-8


def mafredo_in_our_terms(path: Path, hull: HydroDatabase) -> np.ndarray:
    """Loads (m, n, 6) of a model as MaFreDo reads it: kN, lagging."""
    data = mafredo.Hyddb1.create_from_orcaflex_yml(str(path), vessel_type_name="Vessel type1")
    values = [data.force_rao(i)["complex"].transpose("wave_direction", "omega").values for i in range(6)]
    return np.asarray(np.conj(np.stack(values, axis=-1)) * 1e3)


@pytest.mark.parametrize(
    ("waves", "sense", "event"), list(itertools.product(UNITS[1:], ("lags", "leads"), EVENTS))[::3]
)
def test_mafredo_reads_the_same_loads(
    waves: str, sense: str, event: str, hull: HydroDatabase, tmp_path: Path
) -> None:
    path = write(tmp_path, model(hull, waves=waves, sense=sense, event=event))
    found, other = read_orcaflex(path), mafredo_in_our_terms(path, hull)
    assert np.all(np.abs(found.force - other) <= 1e-9 * np.abs(found.force).max(axis=(0, 1)))


def test_units_of_rotations_do_not_touch_loads(hull: HydroDatabase, tmp_path: Path) -> None:
    """They are of displacement RAOs. MaFreDo 2026.8 multiplies load RAOs by 57.3 here: not followed."""
    path = write(tmp_path, model(hull, turn="radians"))
    found = read_orcaflex(path)
    assert_same(found, hull)
    assert found.motion_rao is not None and hull.motion_rao is not None
    assert np.abs(found.motion_rao - hull.motion_rao).max() < 1e-9
    other = np.abs(mafredo_in_our_terms(path, hull)[4, 3]) / np.abs(found.force[4, 3])
    assert other[:3] == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("reference", "load", "phase"),
    [
        ((3.0, 1.0, -2.0), (3.0, 1.0, -2.0), (3.0, 1.0, -2.0)),
        ((0.0, 0.0, 0.0), (20.0, -4.0, 5.0), (0.0, 0.0, 0.0)),
        ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (-30.0, 6.0, 1.0)),
        ((2.0, 0.5, 1.5), (20.0, -4.0, 5.0), (-30.0, 6.0, 1.0)),
    ],
)
def test_origins(reference: Any, load: Any, phase: Any, hull: HydroDatabase, tmp_path: Path) -> None:
    """Wherever the file takes its origins, the motion equation closes, and carries back to ours."""
    document = model(hull, reference=reference, load=load, phase=phase)
    found = read_orcaflex(write(tmp_path, document), restoring=_restoring_at(hull, reference))
    rows = [row.value for row in found.check() if row.check.startswith("motion_rao")]
    assert len(rows) == 6 and max(rows) < 1e-7
    at = np.array(reference)
    k = hull.omega**2 / G
    along = at[0] * np.cos(hull.heading) + at[1] * np.sin(hull.heading)
    expected = hull.force.copy()
    expected[:, :, 3:] += np.cross(-at, expected[:, :, :3])
    expected *= np.exp(1j * np.outer(along, k))[:, :, None]
    assert np.all(np.abs(found.force - expected) <= 1e-9 * np.abs(expected).max(axis=(0, 1)))


def _restoring_at(hull: HydroDatabase, reference: tuple[float, float, float]) -> np.ndarray:
    """The whole matrix about the reference, which a vertical move leaves outside the 3 x 3 of the file."""
    x, y, z = reference
    shift = np.eye(6)
    shift[:3, 3:] = [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]]
    return np.asarray(shift.T @ hull.restoring @ shift)


def test_directions_of_travel_and_signs_against_physics(hull: HydroDatabase, tmp_path: Path) -> None:
    """Energy radiated by the loads is that of the damping, and a long head sea lifts and pitches the ship."""
    found = read_orcaflex(write(tmp_path, model(hull, event="zero up-crossing", phase=(25.0, 0.0, 0.0))))
    radiated = damping_from_forces(found)
    assert radiated is not None
    inside = found.omega < 1.2  # as far as 15 degrees between headings resolve the loads
    for i in range(6):
        peak = found.damping[:, i, i].max()
        assert np.abs(radiated - found.damping)[inside, i, i].max() < 0.05 * peak
    head = int(np.argmin(np.abs(found.heading - np.pi)))
    lift = found.force[head, 0]
    assert lift[2] == pytest.approx(found.restoring[2, 2], rel=0.2)
    slope = -1j * found.omega[0] ** 2 / G  # of Re exp(i(wt + k x)): pitch, bow down, against d zeta / dx
    assert (lift[4] / found.restoring[4, 4] / slope).real > 0.5


def save(data: Any, path: Path) -> Path:
    """As MaFreDo saves it."""
    data.save_as(str(path), engine="netcdf4")
    return path


def mafredo_data(hull: HydroDatabase, **more: Any) -> Any:
    """The hull in MaFreDo: te, kN, phases that lag."""
    force = np.moveaxis(hull.force, (0, 1, 2), (2, 1, 0))
    data = mafredo.Hyddb1.create_from_data(
        hull.omega,
        hull.added_mass.swapaxes(1, 2) / 1e3,
        hull.damping.swapaxes(1, 2) / 1e3,
        np.degrees(hull.heading),
        np.abs(force) / 1e3,
        -np.angle(force),
        **more,
    )
    data.symmetry = mafredo.helpers.Symmetry.XZ
    return data


def read_dhyd(path: Path, hull: HydroDatabase, **more: Any) -> HydroDatabase:
    """With the mass and restoring that the file cannot hold."""
    return read_orcaflex(
        path, mass_matrix=hull.mass_matrix, restoring=hull.restoring, **({"rho": 1025.0} | more)
    )


def test_dhyd_round_trip(hull: HydroDatabase, tmp_path: Path) -> None:
    save(mafredo_data(hull), tmp_path / "ship.dhyd")
    found = read_dhyd(tmp_path / "ship.dhyd", hull)
    assert_same(found, hull)
    assert found.origin == "reference point of the MaFreDo database"
    assert found.motion_rao is None


def test_dhyd_phase_origin(hull: HydroDatabase, tmp_path: Path) -> None:
    """MaFreDo's phase origin is a point forward and to port of the reference point."""
    x, y = 12.0, -3.0
    k = hull.omega**2 / G
    along = np.outer(x * np.cos(hull.heading) + y * np.sin(hull.heading), k)
    there = dataclasses.replace(hull, force=hull.force * np.exp(1j * along)[:, :, None])
    path = save(mafredo_data(there), tmp_path / "ship.dhyd")
    with netCDF4.Dataset(path, "a") as file:  # which MaFreDo writes from 2026.7 on
        for axis, value in enumerate((x, y)):
            name = f"phase_origin_{axis}"
            info = file["info"]
            variable = info[name] if name in info.variables else info.createVariable(name, "f8", ())
            variable[...] = value
    assert_same(read_dhyd(path, hull), hull)


def test_mafredo_carries_a_capytaine_dataset_to_us(tmp_path: Path) -> None:
    """Two ways for one file: our reader of Capytaine, and MaFreDo's with our reader of MaFreDo."""
    dataset = layout().isel(omega=slice(1, -1))
    dataset.to_netcdf(tmp_path / "hull.nc", engine="netcdf4")
    direct = read_capytaine(tmp_path / "hull.nc")
    save(mafredo.Hyddb1.create_from_capytaine(str(tmp_path / "hull.nc")), tmp_path / "ship.dhyd")
    found = read_dhyd(tmp_path / "ship.dhyd", direct)
    scale = np.abs(direct.force).max(axis=(0, 1))
    for name in ("added_mass", "damping"):
        exact = getattr(direct, name)
        assert np.abs(getattr(found, name) - exact).max() <= 1e-9 * np.abs(exact).max()
    assert found.heading == pytest.approx(direct.heading, abs=1e-8)
    assert np.all(np.abs(found.force - direct.force) <= 1e-9 * scale)


def test_what_a_dhyd_file_does_not_hold(hull: HydroDatabase, tmp_path: Path) -> None:
    path = tmp_path / "ship.dhyd"
    save(mafredo_data(hull), path)
    with (
        pytest.warns(AssumedDensityWarning, match="1025 kg/m3"),
        pytest.raises(FileFormatError, match=r"holds no mass_matrix; pass mass_matrix \(6, 6\)"),
    ):
        load_database(path)
    with pytest.raises(FileFormatError, match="holds no restoring"):
        read_orcaflex(path, mass_matrix=hull.mass_matrix, rho=1025.0)
    with pytest.raises(FileFormatError, match=r"restoring has shape \(3, 3\)"):
        read_orcaflex(path, mass_matrix=hull.mass_matrix, restoring=np.eye(3), rho=1025.0)
    assert available_speeds(path) == (0.0,)


def test_limits_of_dhyd_frequencies(hull: HydroDatabase, tmp_path: Path) -> None:
    """MaFreDo keeps whatever frequencies it is given: zero becomes the limit of the added mass."""
    data = mafredo_data(hull)
    data.add_frequency(0.0)  # constant extrapolation
    save(data, tmp_path / "ship.dhyd")
    found = read_dhyd(tmp_path / "ship.dhyd", hull)
    assert found.omega == pytest.approx(hull.omega)
    assert found.zero_frequency_added_mass == pytest.approx(hull.added_mass[0], rel=1e-9, abs=1.0)


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
    data = mafredo.Hyddb1.create_from_orcaflex_yml(str(path), vessel_type_name="Vessel type1")
    data.expand360_using_symmetry()
    for degrees in (120.0, 180.0, 240.0):
        for k, omega in enumerate(found.omega):
            other = np.conj([rao.get_value(omega, degrees) for rao in data._force]) * 1e3
            ours = found.force_at(omega, np.radians(degrees))
            assert ours == pytest.approx(other, rel=1e-6, abs=1e-3), (degrees, k)


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


def test_displacement_raos_on_another_grid(hull: HydroDatabase, tmp_path: Path) -> None:
    document = model(hull)
    del document["VesselTypes"][0]["Draughts"][0]["DisplacementRAOs"]["RAOs"][2]
    with pytest.warns(PartialSetWarning, match="displacement RAOs are not at the directions"):
        assert read_orcaflex(write(tmp_path, document)).motion_rao is None


def test_common_frequencies(hull: HydroDatabase, tmp_path: Path) -> None:
    document = model(hull)
    del document["VesselTypes"][0]["Draughts"][0]["FrequencyDependentAddedMassAndDamping"][4]
    with pytest.warns(PartialSetWarning, match=r"1 frequencies are given for either"):
        found = read_orcaflex(write(tmp_path, document))
    keep = np.arange(len(hull.omega)) != 3
    assert np.all(np.abs(found.force - hull.force[:, keep]) <= 1e-9 * np.abs(hull.force).max(axis=(0, 1)))
    assert np.abs(found.added_mass - hull.added_mass[keep]).max() <= 1e-9 * hull.added_mass.max()


def test_a_choice_of_vessel_types_and_draughts(hull: HydroDatabase, tmp_path: Path) -> None:
    document = model(hull)
    kind = document["VesselTypes"][0]
    other = copy.deepcopy(kind) | {"Name": "Barge"}
    other["Draughts"].append(copy.deepcopy(other["Draughts"][0]) | {"Name": "Light", "Mass": 1e4})
    document["VesselTypes"].append(other)
    path = write(tmp_path, document)
    with pytest.raises(FileFormatError, match=r"holds Vessel type1, Barge; pass vessel_type="):
        load_database(path)
    with pytest.raises(FileFormatError, match=r"Barge/Draughts: holds Draught1, Light; pass draught="):
        read_orcaflex(path, vessel_type="Barge")
    assert read_orcaflex(path, vessel_type="Barge", draught="Light").mass_matrix[0, 0] == 1e7


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
def small_model(hull: HydroDatabase) -> dict[str, Any]:
    """Three frequencies and three directions."""
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


@pytest.mark.parametrize("part", [0.0, 0.02, 0.3, 0.6, 0.9, 0.999])
def test_truncated_dhyd(part: float, hull: HydroDatabase, tmp_path: Path) -> None:
    path = tmp_path / "ship.dhyd"
    save(mafredo_data(hull), path)
    whole = path.read_bytes()
    path.write_bytes(whole[: int(part * len(whole))])
    with pytest.raises(FileFormatError, match=r"ship\.dhyd: cannot be read as a MaFreDo database"):
        read_dhyd(path, hull)


def test_damaged_numbers_in_dhyd(hull: HydroDatabase, tmp_path: Path) -> None:
    data = mafredo_data(hull)
    data._mass.values[2, 1, 1] = np.nan
    save(data, tmp_path / "ship.dhyd")
    with pytest.raises(FileFormatError, match=r"ship\.dhyd: .*added_mass\[2, 1, 1\] is nan"):
        read_dhyd(tmp_path / "ship.dhyd", hull)


def test_command_line(hull: HydroDatabase, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(tmp_path, model(hull))
    assert main(["hydro", str(tmp_path)]) == 0
    assert "motion_rao_heave" in capsys.readouterr().out
