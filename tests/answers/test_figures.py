"""The paper's figures: axes and signs, the data behind every panel, poses, and the findings as numbers."""

from __future__ import annotations

import csv
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib import cbook
from test_result import BODIES, crane_result, crane_run, smooth_step, vessel_result

from seacrane import Frame, Scene, simulate
from seacrane.description.file_origin import roles_to_data
from seacrane.hydro import motion_response, shipped_database
from seacrane.hydro.database.figures import chosen_headings, save_hydro_figures
from seacrane.pictures import (
    Panel,
    PaperRuns,
    Sheet,
    paper_findings,
    plot_overview,
    save_paper_figures,
    save_pose_figure,
    save_sheet,
)
from seacrane.pictures.findings import amplitude_at, slew_stop
from seacrane.pictures.overview import overview_sheet
from seacrane.pictures.paper_figures import crane_skeleton
from seacrane.pictures.pose import box_lines, complete_skeleton, posed_lines, rotation_matrix, wire_lines
from seacrane.plotting.panel import Line, draw
from seacrane.result import MOTIONS, Result
from seacrane.result.about import About

PNG = b"\x89PNG\r\n\x1a\n"


def image_size(path: Path) -> tuple[int, int]:
    head = path.read_bytes()[:24]
    assert head[:8] == PNG, path
    return int.from_bytes(head[16:20], "big"), int.from_bytes(head[20:24], "big")


def read_csv(path: Path) -> tuple[list[str], np.ndarray]:
    with path.open(newline="", encoding="utf-8") as file:
        names, *rows = csv.reader(file)
    return names, np.array(rows, float)


def posed_case2(*, dt: float = 1.0) -> Result:
    """Case 2 with the shipped crane's own geometry on a ship that floats still."""
    from seacrane.crane import KnuckleBoomCrane, Payload

    crane, payload = KnuckleBoomCrane.load(), Payload()
    run = crane_run(heel=0.0, dt=dt)
    still = np.zeros_like(run["arrays"]["vessel_motion"])
    position, quaternion = run["arrays"]["position"], run["arrays"]["quaternion"]
    position[:, 0], quaternion[:, 0] = (0, 0, 3), (1, 0, 0, 0)
    for i, share in enumerate(smooth_step(run["time"])):
        pose = {"slew": -np.pi / 2 * share, "s1": 2 * share, "s2": 2 * share}
        for record in [*crane.bodies(**pose), crane.payload_body(payload, **pose)]:
            body = BODIES.index(record.name)
            quaternion[i, body] = record.quaternion
            position[i, body] = record.position + rotation_matrix(record.quaternion) @ record.center_of_mass
    run["arrays"] |= {"vessel_motion": still}
    scene = Scene()
    scene.add_crane(crane, base="ground", payload=payload)
    about = About(cranes=[roles_to_data(roles) for roles in scene.roles.values()])
    return Result.from_arrays(**run | {"about": about})


@pytest.fixture(scope="module")
def runs() -> PaperRuns:
    return PaperRuns(
        vessel=vessel_result(), vessel_without_memory=vessel_result(memory=False),
        case2=crane_result(heel=0.02), case1=crane_result(payload=False, heel=0.015, scene="case1"),
        case3=crane_result(payload=False, heel=0.015, oscillation=0.5, scene="case3"),
    )  # fmt: skip


@pytest.fixture(scope="module")
def drawn(runs: PaperRuns, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("figures")
    pictures = save_paper_figures(runs=runs, folder=folder)
    assert list(pictures) == list(range(3, 11))
    return folder


def test_eight_figures_and_their_data_are_written(drawn: Path, runs: PaperRuns) -> None:
    expected = {f"figure_{number:02d}.{kind}" for number in range(3, 11) for kind in ("png", "csv")}
    assert {path.name for path in drawn.iterdir()} == expected
    for path in drawn.glob("*.png"):
        width, height = image_size(path)
        assert width > 800 and height > 300, path.name
    names, numbers = read_csv(drawn / "figure_03.csv")
    assert names[1:3] == ["surge, with memory [m]", "surge, without memory [m]"]
    ours = [[MOTIONS.index(one.partition(",")[0]), one.endswith("[deg]")] for one in names[1:]]
    for column, (motion, turns) in enumerate(ours, start=1):
        run = runs.vessel if column % 2 else runs.vessel_without_memory
        expected_values = run["vessel_motion"][:, motion] * (np.degrees(1.0) if turns else 1.0)
        np.testing.assert_allclose(numbers[:, column], expected_values, rtol=1e-9, atol=1e-12)
    assert len(ours) == 12 and sum(turns for _, turns in ours) == 6
    names, numbers = read_csv(drawn / "figure_07.csv")
    assert names == ["time [s]", "stroke 1 [m]", "stroke 2 [m]", "slew angle [deg]"]
    np.testing.assert_allclose(numbers[-1, 3], -90, atol=1e-9)
    euler = runs.case3.select("euler_xyz", axis="z")
    phi = np.unwrap(euler[:, BODIES.index("king")] - euler[:, BODIES.index("tower")])
    np.testing.assert_allclose(numbers[:, 3], np.rad2deg(phi), atol=1e-6)
    _, numbers = read_csv(drawn / "figure_10.csv")  # the difference of two heaves
    late = numbers[:, 0] > 50
    np.testing.assert_allclose(numbers[~late, 1], 0, atol=1e-12)
    np.testing.assert_allclose(numbers[late, 1], 0.025 * np.cos(2 * np.pi * numbers[late, 0] / 5), atol=1e-9)


def test_what_cannot_be_drawn_is_refused(runs: PaperRuns, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="1001 outputs to 100 s, 601 outputs to 60 s"):
        odd = replace(runs, vessel_without_memory=vessel_result(t_end=60.0))
        save_paper_figures(runs=odd, folder=tmp_path)
    assert not list(tmp_path.iterdir())
    panel = Panel(quantity="heave", unit="m", lines=(Line(label="short", values=np.zeros(3)),))
    with pytest.raises(ValueError, match=r"'short'.*'heave'.*3.*5"):
        Sheet(title="t", caption="c", abscissa=np.arange(5.0), panels=(panel,))
    result = posed_case2(dt=10.0)
    for skeleton, words in (
        ({"mast": [np.zeros((2, 3))]}, "mast"), ({"king": [np.zeros(3)]}, r"'king'.*\(3,\)"),
        ({"king": [np.full((2, 3), np.nan)]}, "finite"),
    ):  # fmt: skip
        with pytest.raises(ValueError, match=words):
            complete_skeleton(result, skeleton)
    run = crane_run(t_end=1.0, waves=False)
    run["arrays"] = {"constraint_error": run["arrays"]["constraint_error"]}
    with pytest.raises(ValueError, match="constraint_error"):
        plot_overview(Result.from_arrays(**run))


def test_the_cranes_lines_meet_at_its_joints(tmp_path: Path) -> None:
    """Lines that share a joint share its point in every pose, up to the figure's own rounding; the wire is as
    long as the link, and the hull lies on the waterline about the reference point."""
    result, skeleton = posed_case2(), crane_skeleton()
    image_size(save_pose_figure(result=result, folder=tmp_path, skeleton=skeleton).image)
    complete = complete_skeleton(result, skeleton)
    for output in (0, -1):
        lines: dict[str, Any] = {}
        for body, number, points in posed_lines(result, skeleton, output):
            lines[f"{body}{number}"] = points
        jib, knuckle, king = lines["main_jib1"], lines["knuckle_jib1"], lines["king0"]
        for first, second in [
            (king[1], jib[0]),  # C
            (king[2], lines["main_barrel0"][0]),  # B
            (jib[1], lines["main_rod0"][0]),  # D
            (jib[2], lines["knuckle_barrel0"][0]),  # E
            (jib[3], knuckle[0]),  # F
            (knuckle[1], lines["knuckle_rod0"][0]),  # G
            (lines["tower0"][1], king[0]),  # A
        ]:
            np.testing.assert_allclose(first, second, atol=1e-9)
        (wire,) = wire_lines(result, complete, output)
        assert np.linalg.norm(wire[1] - wire[0]) == pytest.approx(8.0, abs=1e-9)
    poses = [posed_lines(result, complete, at) for at in (0, -1)]
    first, last = (
        np.mean([line.mean(axis=0) for body, _, line in pose if body == "payload"], axis=0) for pose in poses
    )
    assert first[0] < 33.0 - 5 and first[1] == pytest.approx(10.0, abs=3), "aft of the crane's foot"
    assert last[1] > 12.5 + 3, "clear of the ship's port side"
    hull = np.vstack([line for body, _, line in posed_lines(result, complete, 0) if body == "vessel"])
    np.testing.assert_allclose(hull.min(axis=0), [-57.5, -12.5, -6.4], atol=1e-12)
    np.testing.assert_allclose(hull.max(axis=0), [57.5, 12.5, 10.0], atol=1e-12)
    edges = np.concatenate(
        [np.linalg.norm(np.diff(line, axis=0), axis=1) for line in box_lines((6.0, 6.0, 4.0))]
    )
    assert sorted(edges) == [4.0] * 4 + [6.0] * 8


@pytest.mark.parametrize(("bodies", "payload"), [((), []), (("box",), ["box"]), (("hook", "box"), ["box"])])
def test_the_overview_draws_what_hangs_lowest(bodies: tuple[str, ...], payload: list[str]) -> None:
    """Not the body that was added last; none where nothing hangs."""
    scene, above = Scene(name="hung"), "ground"
    frames = {"first_frame": Frame(), "second_frame": Frame()}
    for depth, name in enumerate(bodies, start=1):
        scene.add_body(name=name, mass=100.0, inertia=np.eye(3), position=(0.0, 0.0, -2.0 * depth))
        scene.add_joint(f"to {name}", kind="distance", first=above, second=name, length=2.0, **frames)
        above = name
    scene.add_body(name="bystander", mass=1.0, inertia=np.eye(3), position=(50.0, 0.0, 0.0))
    result = simulate(scene, t_end=0.1)
    panels = [panel.quantity for panel in overview_sheet(result).panels if "position" in panel.quantity]
    assert panels == [f"{name} position" for name in payload]


@pytest.mark.parametrize("name", ["$x^$", "$\\frac$ $", "_hidden"])
def test_names_and_lines_are_drawn_as_they_are(name: str, tmp_path: Path) -> None:
    """Dollars begin no formula, and a name that begins with an underscore is in the legend."""
    time = np.linspace(0, 1, 11)
    lines = (Line(label=name, values=time**2), Line(label="other", values=-time))
    panel = Panel(quantity="heave", unit="m", lines=lines)
    sheet = Sheet(title=name, caption="", abscissa=time, panels=(panel,))
    (axes,) = draw(sheet).axes
    for drawn_line, line in zip(axes.lines, lines, strict=True):
        np.testing.assert_array_equal(drawn_line.get_ydata(), line.values)
    texts = [text.get_text() for text in axes.get_legend().get_texts()]
    assert [text.replace(r"\$", "$").strip() for text in texts] == [name, "other"]
    assert cbook.is_math_text(texts[0]) is False
    names, numbers = read_csv(save_sheet(sheet, tmp_path, "square").image.with_suffix(".csv"))
    assert names == ["time [s]", f"heave, {name} [m]", "heave, other [m]"]
    np.testing.assert_allclose(numbers[:, 1], time**2, rtol=1e-9)


def test_the_findings_measure_what_the_runs_contain(runs: PaperRuns) -> None:
    found = {item.finding.split(" ")[0]: item for item in paper_findings(runs)}
    assert found["Case"].verdict == found["Fluid"].verdict == "reproduced"
    assert "sway 0.15 m" in found["Case"].number and "heave 0.025 m" in found["Case"].number
    assert "case 1 -0.859 deg, case 2 -1.146 deg" in found["The"].number
    assert found["Leaving"].verdict == "measured" and "x 1.25" in found["Leaving"].number


def test_findings_are_denied_when_the_runs_do_not_show_them() -> None:
    same = vessel_result()
    cases = {
        name: crane_result(payload=name == "case2", heel=0.0, scene=name)
        for name in ("case1", "case2", "case3")
    }
    runs = PaperRuns(vessel=same, vessel_without_memory=same, **cases)
    verdicts = [item.verdict for item in paper_findings(runs)]
    assert verdicts == ["not reproduced", "measured", *["not reproduced"] * 5]


def test_an_amplitude_is_separated_from_the_waves_and_the_end_of_the_slew_from_ripple() -> None:
    time = np.arange(0, 100.05, 0.1)
    for amplitude in (0.0, 2.0):
        values = amplitude * np.cos(2 * np.pi * time / 5 + 0.7) + 0.3 + 0.01 * time
        assert amplitude_at(time, values, period=5, start=50) == pytest.approx(amplitude, abs=1e-12)
    with pytest.raises(ValueError, match="two periods of 5 s"):
        amplitude_at(time, values, period=5, start=95)
    run = crane_run()
    run["arrays"]["slew_angle"] += np.deg2rad(0.2) * np.sin(run["time"])
    stop = slew_stop(Result.from_arrays(**run))
    assert 36.0 < stop < 45.0
    assert smooth_step(np.array([stop]))[0] == pytest.approx(0.99, abs=6e-3)


@pytest.mark.slow("draws all figures")
def test_the_databases_plots_hold_its_numbers(tmp_path: Path) -> None:
    database = shipped_database()
    found = [one.image.stem for one in save_hydro_figures(database=database, folder=tmp_path)]
    assert found == ["added_mass", "damping", "retardation", "wave_force", "motion"]
    assert database.memory is not None
    index, _ = chosen_headings(database)["90 deg"]
    assert np.rad2deg(database.heading[index]) == pytest.approx(90)
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
