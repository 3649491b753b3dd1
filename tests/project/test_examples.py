"""Every example runs as a user would run it, prints numbers, leaves a picture only where it is told."""

from __future__ import annotations

import ast
import re
import subprocess
import sys
from pathlib import Path

import pytest

FOLDER = Path(__file__).resolve().parents[2] / "examples"
EXAMPLES = sorted(FOLDER.glob("*.py"))
NUMBER = r"-?\d+(?:\.\d+)?(?:e[-+]\d+)?"


def run(example: Path, folder: Path, *arguments: str) -> str:
    finished = subprocess.run(
        [sys.executable, str(example), *arguments],
        cwd=folder,
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )
    assert finished.returncode == 0, finished.stderr
    assert not finished.stderr, finished.stderr
    return finished.stdout


def test_the_examples_of_the_issue_exist() -> None:
    names = {path.stem for path in EXAMPLES}
    assert names >= {
        "pendulum", "vessel_in_waves", "crane_on_fixed_base", "full_scene_by_hand", "sampled_controller",
        "which_cylinder_forces", "winch_and_wire", "tandem_lift", "load_chart", "lift_in_stages",
    }  # fmt: skip


LONG = (
    "deep_lowering", "subsea_lowering", "feeder_lift_two_ships", "splash_zone", "design_study", "operability",
    "heave_compensation", "hull_to_database", "load_chart", "frequency_domain", "tandem_lift",
)  # fmt: skip
BY_NIGHT = pytest.mark.slow("a whole lift or study")


@pytest.mark.parametrize(
    "example",
    [pytest.param(path, marks=BY_NIGHT if path.stem in LONG else [], id=path.stem) for path in EXAMPLES],
)
def test_example_prints_numbers_and_saves_one_picture(example: Path, tmp_path: Path) -> None:
    pictures, work = tmp_path / "pictures", tmp_path / "work"
    pictures.mkdir()
    work.mkdir()
    said = run(example, work, str(pictures))
    assert len(re.findall(NUMBER, said)) >= 3
    assert "nan" not in said.lower().split()
    assert [path.name for path in pictures.iterdir()] == [f"{example.stem}.png"]
    assert (pictures / f"{example.stem}.png").read_bytes().startswith(b"\x89PNG")
    assert list(work.iterdir()) == []


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_example_starts_with_its_idea(example: Path) -> None:
    idea = ast.get_docstring(ast.parse(example.read_text(encoding="utf-8")))
    assert idea is not None
    assert len(idea.splitlines()[0]) > 30


def test_without_a_folder_nothing_is_written(tmp_path: Path) -> None:
    said = run(FOLDER / "pendulum.py", tmp_path)
    period = float(re.findall(NUMBER, said)[0])
    # Large swings: T / T0 = 2 K(sin(90 deg / 2)) / pi = 1.18034 (complete elliptic integral).
    small = float(re.findall(NUMBER, said)[1])
    assert period / small == pytest.approx(1.18034, rel=2e-4)
    assert list(tmp_path.iterdir()) == []


def test_the_hook_load_on_a_given_ship_is_that_by_hand(tmp_path: Path) -> None:
    run_, by_hand = run(FOLDER / "given_ship.py", tmp_path).splitlines()
    for mine, theirs in zip(re.findall(NUMBER, run_), re.findall(NUMBER, by_hand), strict=True):
        assert float(mine) == pytest.approx(float(theirs), rel=0.01)


def test_two_cranes_share_their_load_as_levers_do(tmp_path: Path) -> None:
    lines = [re.findall(NUMBER, line)[-2:] for line in run(FOLDER / "tandem_lift.py", tmp_path).splitlines()]
    found, by_hand = zip(*((float(mine), float(theirs)) for mine, theirs in lines), strict=True)
    assert found[:-2] == pytest.approx(by_hand[:-2], rel=0.005, abs=0.03)  # kN and deg at rest
    assert found[-2:] == pytest.approx(by_hand[-2:], rel=0.12)  # in waves, to first order of the swing


@pytest.mark.slow("a whole lift")
def test_a_template_goes_through_the_waves_taut(tmp_path: Path) -> None:
    """And the simplified method, which takes the largest speeds at once, says less of it than any run."""
    told = run(FOLDER / "splash_zone.py", tmp_path).splitlines()
    kinds: dict[str, list[list[float]]] = {"run": [], "simplified": []}
    for line in told:
        kinds[line.partition(",")[0]].append([float(number) for number in re.findall(NUMBER, line)][-3:])
    assert [len(rows) for rows in kinds.values()] == [5, 4]
    hook = (41.5e3 - 1025.0 * 0.2 * 6.0 * 4.0 * 3.0) * 9.80665 / 1e3  # kN
    assert kinds["run"][0][1] == pytest.approx(hook, rel=0.01)
    assert sum(row[1] for row in kinds["run"][1:]) > kinds["run"][0][1] - 1.5 * 9.80665
    hand = min(share for *_, share in kinds["simplified"])
    assert all(max(0.1, hand) < share < 1.0 for *_, share in kinds["run"])
    assert all(share == pytest.approx(low / static, abs=0.01) for low, static, share in kinds["run"])


@pytest.mark.slow("a whole lift")
def test_a_template_is_lowered_to_the_seabed_as_by_hand(tmp_path: Path) -> None:
    """Archimedes, drag at the lowering rate, resonance over depth, and what compensation leaves."""
    told = run(FOLDER / "subsea_lowering.py", tmp_path).splitlines()
    kinds = {word: [re.findall(NUMBER, line) for line in told if line.startswith(word)]
             for word in ("hook", "heave", "hoist", "stop")}  # fmt: skip
    assert [len(rows) for rows in kinds.values()] == [3, 5, 5, 2]
    for rows, within in ((kinds["hook"], 0.003), (kinds["heave"], 0.01), (kinds["stop"], 0.3)):
        for *_, found, by_hand in rows:
            assert float(found) == pytest.approx(float(by_hand), rel=within)
    periods = [float(row[-1]) for row in kinds["heave"]]
    assert periods == sorted(periods)
    assert all(0.1 < float(row[-1]) < 1.0 for row in kinds["hoist"])


@pytest.mark.slow("a whole lift")
def test_a_feeder_lift_tells_of_each_water(tmp_path: Path) -> None:
    """Ships that feel each other differ from such as do not, and two lids differ by less."""
    lines = run(FOLDER / "feeder_lift_two_ships.py", tmp_path).splitlines()
    alone, *lids = ([float(number) for number in re.findall(NUMBER, line)][-5:] for line in lines)
    assert len(lids) == 2
    for seas, hits, _, mean, worst in (alone, *lids):
        assert seas == 12 and hits > 0.0 and 1.2 < mean < worst < 3.0
    assert abs(lids[0][3] - lids[1][3]) < abs(lids[0][3] - alone[3])


def test_controller_example_calms_its_load(tmp_path: Path) -> None:
    free, controlled = (
        float(line.split()[-2]) for line in run(FOLDER / "sampled_controller.py", tmp_path).splitlines()
    )
    assert free > 0.5
    assert controlled < 0.05 * free
