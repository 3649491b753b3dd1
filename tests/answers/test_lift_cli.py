"""Lifts on the command line: run as the file says, options before the file, mistakes in one line."""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np
import pytest
from lift_examples import HEAD, PENDULUM

from seacrane import Lift, Result
from seacrane.cli import main
from seacrane.lift.schema import schema, schema_path


@pytest.fixture
def pendulum(tmp_path: Path) -> Path:
    path = tmp_path / "my_lift.toml"
    path.write_text(PENDULUM)
    return path


def test_a_lift_runs_as_its_file_says(pendulum: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = pendulum.parent / "out"
    assert main(["run", str(pendulum), "--out", str(out)]) == 0
    assert "pendulum: 2 s" in capsys.readouterr().out
    result, direct = Result.load(out / "my_lift.nc"), Lift.load(pendulum).simulate()
    assert result.stats["integrator"] == "rk4"
    assert set(result.channels) == {"position", "constraint_error", "energy_balance"}
    np.testing.assert_array_equal(result.time, direct.time)
    np.testing.assert_array_equal(result["position"], direct["position"])
    assert main(["report", str(pendulum)]) == 0
    assert "pivot" in capsys.readouterr().out


def test_options_go_before_the_file(pendulum: Path) -> None:
    out = pendulum.parent / "out"
    options = ["--t-end", "1", "--dt-out", "0.25", "--integrator", "semi-implicit-euler", "--dt", "0.005"]
    assert main(["run", str(pendulum), "--out", str(out), *options]) == 0
    result = Result.load(out / "my_lift.nc")
    assert result.time.tolist() == [0.0, 0.25, 0.5, 0.75, 1.0]
    assert result.stats["integrator"] == "semi-implicit-euler"
    assert set(result.channels) == {"position", "constraint_error", "energy_balance"}


MISTAKES = {
    "a key": (PENDULUM.replace("mass_kg", "mass_t"), r"line 9: .*mass_t.*body\]\] 1; nearest: mass_kg"),
    "a value": (PENDULUM.replace("axis = [0, 1, 0]", "axis = [0, 0, 0]"), r"line 19: \[\[joint\]\] 1: "),
    "another file": ("a = 1\n", "my_lift.toml: .*TOML"),
    "an option of a case": (HEAD, "--hs.*my_lift.toml"),
}


def test_a_mistake_is_one_line(pendulum: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for case, (text, words) in MISTAKES.items():
        pendulum.write_text(text)
        more = ["--hs", "2"] if case == "an option of a case" else []
        assert main(["run", str(pendulum), "--out", str(pendulum.parent / "out"), *more]) == 1
        told = capsys.readouterr().err.strip()
        assert re.search(words, told) and "\n" not in told, case
    assert not (pendulum.parent / "out").exists()


def test_the_schema_is_printed(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["schema"]) == 0
    assert json.loads(capsys.readouterr().out) == schema()
    assert main(["schema", "--path"]) == 0
    assert capsys.readouterr().out.strip() == str(schema_path())
