"""Part of the shipped hull as an OrcaFlex text model, laid out as OrcaFlex saves it."""

from __future__ import annotations

import dataclasses
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from seacrane.hydro import HydroDatabase, motion_response, rigid_mass_matrix, shipped_database
from seacrane.hydro.readers.orcaflex_model import ADDED_MASS, DAMPING, INERTIA, RAO_ROWS, STIFFNESS

G = 9.80665
EVENTS = {"crest": 0.0, "zero down-crossing": 90.0, "trough": 180.0, "zero up-crossing": 270.0}
UNITS = ("period (s)", "frequency (rad/s)", "frequency (Hz)")
ZERO = (0.0, 0.0, 0.0)
Place = tuple[float, float, float]


@cache
def hull_part() -> HydroDatabase:
    """Every ninth frequency of the shipped hull, 13 headings, with motions solved from it.

    Its roll damping beside radiation becomes "other damping".
    """
    base = shipped_database()
    part = dataclasses.replace(
        base, omega=base.omega[3::9], heading=base.heading[::3], added_mass=base.added_mass[3::9],
        damping=base.damping[3::9], force=base.force[::3, 3::9], g=G, memory=None,
    )  # fmt: skip
    return dataclasses.replace(part, motion_rao=motion_response(part))


def plain(value: Any) -> Any:
    """Nested lists of Python floats."""
    return np.asarray(value, dtype=float).tolist()


def model(
    hull: HydroDatabase, *, waves: str = "frequency (rad/s)", sense: str = "lags", unit: str = "degrees",
    event: str = "crest", turn: str = "degrees", reference: Place = ZERO, load: Place = ZERO,
    phase: Place = ZERO,
) -> dict[str, Any]:  # fmt: skip
    """The hull as an OrcaFlex model; its own reference point is the origin of the vessel's axes."""
    at, origin, start = (np.array(point, dtype=float) for point in (reference, load, phase))

    def periods(omega: np.ndarray) -> np.ndarray:
        with np.errstate(divide="ignore"):
            return {UNITS[0]: 2.0 * np.pi / omega, UNITS[1]: omega, UNITS[2]: omega / (2.0 * np.pi)}[waves]

    def moved(matrix: np.ndarray) -> list[Any]:
        """About the reference origin: the motion at ours is that at the reference plus rotation x lever."""
        lever = np.eye(6)
        lever[:3, 3:] = np.cross(np.eye(3), -at).T
        return plain(lever.T @ matrix @ lever)

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
    motions = motions.copy()
    forces[:, :, 3:] += np.cross(-origin, forces[:, :, :3])
    motions[:, :, :3] += np.cross(motions[:, :, 3:], origin)
    angle = np.pi / 180.0 if turn == "degrees" else 1.0
    infinite = hull.infinite_frequency_added_mass
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
                "Name": "Vessel type1", "Length": 115.0, "RAOResponseUnits": turn, "RAOWaveUnit": "amplitude",
                "WavesReferredToBy": waves, "RAOPhaseConvention": sense, "RAOPhaseUnitsConvention": unit,
                "RAOPhaseRelativeToConvention": event, "SurgePositive": "forward", "SwayPositive": "port",
                "HeavePositive": "up", "RollPositiveStarboard": "down", "PitchPositiveBow": "down",
                "YawPositiveBow": "port", "Symmetry": "xz plane", "Draughts": [draught],
            }
        ],
    }  # fmt: skip


def text_of(document: dict[str, Any]) -> str:
    """As OrcaFlex writes it: a heading, infinity as a word."""
    import yaml

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
