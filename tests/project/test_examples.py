"""Every example runs as a user would run it, prints numbers, leaves a picture only where it is told."""

from __future__ import annotations

import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from seacrane.lift.answer_keys import ANSWERS

FOLDER = Path(__file__).resolve().parents[2] / "examples"
EXAMPLES = sorted(FOLDER.glob("*.py"))
NUMBER = r"-?\d+(?:\.\d+)?(?:e[-+]\d+)?"
Rows = list[list[float]]


def pendulum(said: str, rows: Rows) -> None:
    """Large swings: T / T0 = 2 K(sin(90 deg / 2)) / pi = 1.18034 (complete elliptic integral)."""
    period, small = (float(one) for one in re.findall(NUMBER, said)[:2])
    assert period / small == pytest.approx(1.18034, rel=2e-4)


def given_ship(said: str, rows: Rows) -> None:
    """The hook load is that by hand."""
    found, by_hand = rows
    assert found == pytest.approx(by_hand, rel=0.01)


def tandem_lift(said: str, rows: Rows) -> None:
    """Two cranes share their load as levers do: kN and deg at rest; in waves, to first order of the swing."""
    found, by_hand = zip(*(row[-2:] for row in rows), strict=True)
    assert found[:-2] == pytest.approx(by_hand[:-2], rel=0.005, abs=0.03)
    assert found[-2:] == pytest.approx(by_hand[-2:], rel=0.12)


def sampled_controller(said: str, rows: Rows) -> None:
    free, controlled = (float(line.split()[-2]) for line in said.splitlines())
    assert free > 0.5 and controlled < 0.05 * free


def splash_zone(said: str, rows: Rows) -> None:
    """A template goes through the waves taut, and the simplified method, which takes the largest speeds at
    once, says less of it than any run."""
    lines = list(zip(said.splitlines(), rows, strict=True))
    runs, simplified = (
        [row[-3:] for line, row in lines if line.startswith(one)] for one in ("run,", "simpl")
    )
    assert (len(runs), len(simplified)) == (5, 4)
    hook = (41.5e3 - 1025.0 * 0.2 * 6.0 * 4.0 * 3.0) * 9.80665 / 1e3  # kN
    assert runs[0][1] == pytest.approx(hook, rel=0.01)
    assert sum(row[1] for row in runs[1:]) > runs[0][1] - 1.5 * 9.80665
    hand = min(share for *_, share in simplified)
    assert all(max(0.1, hand) < share < 1.0 for *_, share in runs)
    assert all(share == pytest.approx(low / static, abs=0.01) for low, static, share in runs)


def subsea_lowering(said: str, rows: Rows) -> None:
    """Archimedes, drag at the lowering rate, resonance over depth, and what compensation leaves."""
    lines = list(zip(said.splitlines(), rows, strict=True))
    hook, heave, hoist, stop = (
        [row for line, row in lines if line.startswith(word)] for word in ("hook", "heave", "hoist", "stop")
    )
    assert [len(kind) for kind in (hook, heave, hoist, stop)] == [3, 5, 5, 2]
    for kind, within in ((hook, 0.003), (heave, 0.01), (stop, 0.3)):
        for *_, found, by_hand in kind:
            assert found == pytest.approx(by_hand, rel=within)
    periods = [row[-1] for row in heave]
    assert periods == sorted(periods)
    assert all(0.1 < row[-1] < 1.0 for row in hoist)


def derrick(said: str, rows: Rows) -> None:
    """Moments about the heel, the bridle's angle, wind, current and tank by hand."""
    here, hand = zip(*(row[-2:] for row in rows if len(row) >= 2), strict=True)
    assert len(hand) == 5 and here == pytest.approx(hand, rel=0.02)


CHECKED: list[Callable[[str, Rows], None]] = [
    derrick, pendulum, given_ship, tandem_lift, sampled_controller, splash_zone, subsea_lowering,
]  # fmt: skip
BY_HAND = {one.__name__: one for one in CHECKED}
LONG = (
    "deep_lowering", "subsea_lowering", "feeder_lift_two_ships", "splash_zone", "design_study", "operability",
    "heave_compensation", "hull_to_database", "load_chart", "frequency_domain",
)  # fmt: skip
BY_NIGHT = pytest.mark.slow("a whole lift or study")


@pytest.mark.parametrize(
    "example",
    [pytest.param(path, marks=BY_NIGHT if path.stem in LONG else [], id=path.stem) for path in EXAMPLES],
)
def test_example_prints_numbers_and_saves_one_picture(example: Path, tmp_path: Path) -> None:
    pictures, work = tmp_path / "pictures", tmp_path / "work"
    for folder in (pictures, work):
        folder.mkdir()
    command = [sys.executable, str(example), str(pictures)]
    done = subprocess.run(command, cwd=work, capture_output=True, text=True, timeout=300, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    said = done.stdout
    assert len(re.findall(NUMBER, said)) >= 3
    assert "nan" not in said.lower().split()
    assert [path.name for path in pictures.iterdir()] == [f"{example.stem}.png"]
    assert (pictures / f"{example.stem}.png").read_bytes().startswith(b"\x89PNG")
    assert list(work.iterdir()) == []
    assert set(BY_HAND) <= {path.stem for path in EXAMPLES}
    if example.stem in BY_HAND:
        rows = [[float(one) for one in re.findall(NUMBER, line)] for line in said.splitlines()]
        BY_HAND[example.stem](said, rows)


@BY_NIGHT
def test_a_lift_file_gives_every_answer(tmp_path: Path) -> None:
    """By somebody who types one command: all that a lift file may ask for, of one run and of seeds."""
    command = [sys.executable, "-m", "seacrane", "answers", str(FOLDER / "lifts" / "answers.toml")]
    done = subprocess.run([*command, "--out", str(tmp_path)], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    names = {path.stem for path in tmp_path.glob("*.csv")}
    assert names == {*ANSWERS, "code_factors_2", "deck_cargo_fastening"}
    page = (tmp_path / "answers.html").read_text(encoding="utf-8")
    for words in (
        "Fatigue by",
        "Off-board lift by codes",
        "Simplified method,",
        "Deck cargo:",
        "Re-hits after",
    ):
        assert words in done.stdout and words in page
    again = subprocess.run([*command, "--out", str(tmp_path)], capture_output=True, text=True, check=False)
    assert (again.returncode, again.stdout) == (0, done.stdout)
