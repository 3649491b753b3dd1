"""What the paper's figures are drawn from: poses, amplitudes, the end of the slew, the database's numbers."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest
from test_result import crane_run

from seacrane import Curve, cases, simulate
from seacrane.hydro import motion_response, shipped_database
from seacrane.hydro.database.figures import chosen_headings, save_hydro_figures
from seacrane.pictures.findings import amplitude_at, slew_stop
from seacrane.pictures.pose import link_lines, outlined_skeleton, posed_lines
from seacrane.result import Result


def read_csv(path: Path) -> tuple[list[str], np.ndarray]:
    with path.open(newline="", encoding="utf-8") as file:
        names, *rows = csv.reader(file)
    return names, np.array([[float(cell or "nan") for cell in row] for row in rows])


def test_the_cranes_lines_meet_at_its_joints() -> None:
    """And the wire is as long as the link."""
    result = simulate(cases.case2(), t_end=0.2)
    lines = {body: points for body, _, points in posed_lines(result, outlined_skeleton(result), -1)}
    for first, second in [  # A to G
        ("tower", "king"), ("king", "main_barrel"), ("king", "main_jib"), ("main_jib", "main_rod"),
        ("main_jib", "knuckle_barrel"), ("main_jib", "knuckle_jib"), ("knuckle_jib", "knuckle_rod"),
    ]:  # fmt: skip
        apart = np.linalg.norm(lines[first][:, None] - lines[second][None], axis=-1)
        assert apart.min() < 1e-6
    (wire,) = link_lines(result, -1)
    assert np.linalg.norm(wire[1] - wire[0]) == pytest.approx(8.0, abs=1e-6)


def test_an_amplitude_is_separated_from_the_waves_and_the_end_of_the_slew_from_ripple() -> None:
    time = np.arange(0, 100.05, 0.1)
    values = 2.0 * np.cos(2 * np.pi * time / 5 + 0.7) + 0.3 + 0.01 * time
    assert amplitude_at(time, values, period=5, start=50) == pytest.approx(2.0, abs=1e-12)
    run, turn = crane_run(), Curve.quintic(start_time=0.0, end_time=45.0, start=0.0, end=-0.5 * np.pi)
    slewed = turn.evaluate(time)[:, 0] + np.deg2rad(0.2) * np.sin(time)
    stop = slew_stop(Result.from_arrays(**run | {"time": time, "arrays": {"slew_angle": slewed}}))
    assert 36.0 < stop < 45.0
    assert turn.evaluate([stop])[0, 0] == pytest.approx(-0.99 * 0.5 * np.pi, abs=6e-3)


@pytest.mark.slow("draws all figures")
def test_the_databases_plots_hold_its_numbers(tmp_path: Path) -> None:
    database = shipped_database()
    save_hydro_figures(database=database, folder=tmp_path)
    index, _ = chosen_headings(database)["90 deg"]
    fitted = database.memory.frequency_response(database.omega)[1][:, 2, 2]
    roll = np.rad2deg(np.abs(motion_response(database)[index, :, 3]))
    for file, column, values in (
        ("damping", "B33, database [kg/s]", database.damping[:, 2, 2]),
        ("damping", "B33, memory model [kg/s]", fitted),
        ("motion", "|roll|, 90 deg [deg/m]", roll),
        ("wave_force", "|sway force|, 90 deg [N/m]", np.abs(database.force[index, :, 1])),
    ):
        names, numbers = read_csv(tmp_path / f"{file}.csv")
        np.testing.assert_allclose(numbers[:, 0], database.omega, rtol=1e-9)
        np.testing.assert_allclose(numbers[:, names.index(column)], values, rtol=1e-8)
        assert not any(name.startswith("B12") for name in names), "symmetry makes it negligible"
