"""The paper's figures: axes and signs, the data behind every panel, poses, and the findings as numbers."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest
from test_result import BODIES, crane_result, crane_run, smooth_step, vessel_result

from seacrane import cases, simulate
from seacrane.description.outline import outline_of
from seacrane.hydro import motion_response, shipped_database
from seacrane.hydro.database.figures import chosen_headings, save_hydro_figures
from seacrane.pictures import PaperRuns, paper_findings, save_paper_figures
from seacrane.pictures.findings import amplitude_at, slew_stop
from seacrane.pictures.pose import link_lines, outlined_skeleton, posed_lines
from seacrane.result import MOTIONS, Result
from seacrane.result.about import About


def read_csv(path: Path) -> tuple[list[str], np.ndarray]:
    with path.open(newline="", encoding="utf-8") as file:
        names, *rows = csv.reader(file)
    return names, np.array([[float(cell or "nan") for cell in row] for row in rows])


@pytest.fixture(scope="module")
def runs() -> PaperRuns:
    drawn = {"about": About(outline=outline_of(cases.case2()))}
    return PaperRuns(
        vessel=vessel_result(), vessel_without_memory=vessel_result(memory=False),
        case2=Result.from_arrays(**crane_run(heel=0.02) | drawn),
        case1=crane_result(payload=False, heel=0.015, scene="case1"),
        case3=crane_result(payload=False, heel=0.015, oscillation=0.5, scene="case3"),
    )  # fmt: skip


def test_eight_figures_and_their_data_are_written(runs: PaperRuns, tmp_path: Path) -> None:
    assert list(save_paper_figures(runs=runs, folder=tmp_path)) == list(range(3, 11))
    for number in range(3, 11):
        assert (tmp_path / f"figure_{number:02d}.png").read_bytes().startswith(b"\x89PNG")
    names, numbers = read_csv(tmp_path / "figure_03.csv")
    ours = [[MOTIONS.index(one.partition(",")[0]), one.endswith("[deg]")] for one in names[1:]]
    for column, (motion, turns) in enumerate(ours, start=1):
        run = runs.vessel if column % 2 else runs.vessel_without_memory
        expected_values = run["vessel_motion"][:, motion] * (np.degrees(1.0) if turns else 1.0)
        np.testing.assert_allclose(numbers[:, column], expected_values, rtol=1e-9, atol=1e-12)
    assert len(ours) == 12 and sum(turns for _, turns in ours) == 6
    _, numbers = read_csv(tmp_path / "figure_07.csv")
    np.testing.assert_allclose(numbers[-1, 3], -90, atol=1e-9)
    euler = runs.case3.select("euler_xyz", axis="z")
    phi = np.unwrap(euler[:, BODIES.index("king")] - euler[:, BODIES.index("tower")])
    np.testing.assert_allclose(numbers[:, 3], np.rad2deg(phi), atol=1e-6)
    _, numbers = read_csv(tmp_path / "figure_10.csv")  # the difference of two heaves
    late = numbers[:, 0] > 50
    np.testing.assert_allclose(numbers[~late, 1], 0, atol=1e-12)
    np.testing.assert_allclose(numbers[late, 1], 0.025 * np.cos(2 * np.pi * numbers[late, 0] / 5), atol=1e-9)


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


def test_the_findings_measure_what_the_runs_contain(runs: PaperRuns) -> None:
    found = {item.finding.split(" ")[0]: item for item in paper_findings(runs)}
    assert found["Case"].verdict == found["Fluid"].verdict == "reproduced"
    assert "sway 0.15 m" in found["Case"].number and "heave 0.025 m" in found["Case"].number
    assert "case 1 -0.859 deg, case 2 -1.146 deg" in found["The"].number
    assert found["Leaving"].verdict == "measured" and "x 1.25" in found["Leaving"].number


def test_an_amplitude_is_separated_from_the_waves_and_the_end_of_the_slew_from_ripple() -> None:
    time = np.arange(0, 100.05, 0.1)
    values = 2.0 * np.cos(2 * np.pi * time / 5 + 0.7) + 0.3 + 0.01 * time
    assert amplitude_at(time, values, period=5, start=50) == pytest.approx(2.0, abs=1e-12)
    run = crane_run()
    run["arrays"]["slew_angle"] += np.deg2rad(0.2) * np.sin(run["time"])
    stop = slew_stop(Result.from_arrays(**run))
    assert 36.0 < stop < 45.0
    assert smooth_step(np.array([stop]))[0] == pytest.approx(0.99, abs=6e-3)


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
