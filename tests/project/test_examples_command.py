"""`seacrane examples`: what it writes is what the project holds, runs, and opens in Jupyter."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest
from test_cli import command_line, refusal

ROOT = Path(__file__).resolve().parents[2]
LISTING = re.compile(r"^```toml\n(.*?)^```", re.DOTALL | re.MULTILINE)
TAUGHT = {"first_lift": "getting-started", "box_over_the_side": "lift-files", "case2_study": "studies"}


@pytest.fixture(scope="module")
def written(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """By the command of the installed package."""
    folder = tmp_path_factory.mktemp("examples") / "mine"
    done = command_line("examples", folder)
    assert done.returncode == 0, done.stderr
    for what in ("scripts", "jobs", "lift files"):
        assert re.search(rf"\d+ {what} in ", done.stdout)
    return folder


def test_all_examples_are_written_as_the_project_holds_them_and_replace_nothing(written: Path) -> None:
    """Those that a document teaches are its listings."""
    source = ROOT / "examples"
    wanted = {path.relative_to(source) for path in source.rglob("*.*") if "__pycache__" not in path.parts}
    found = {path.relative_to(written) for path in written.rglob("*.*")}
    assert {path for path in found if path.parts[0] != "notebooks"} == wanted
    assert all((written / name).read_bytes() == (source / name).read_bytes() for name in wanted)
    for name, document in TAUGHT.items():
        listing, *_ = LISTING.findall((ROOT / "docs" / f"{document}.md").read_text(encoding="utf-8"))
        assert (source / "lifts" / f"{name}.toml").read_text(encoding="utf-8") == listing
    mine = written / "pendulum.py"
    theirs = mine.read_text()
    mine.write_text("print('mine')\n")
    assert "pendulum.py" in refusal(command_line("examples", written))
    assert mine.read_text() == "print('mine')\n"
    assert command_line("examples", written, "--overwrite").returncode == 0
    assert mine.read_text() == theirs


def test_a_script_and_lift_files_run_where_they_are_written(written: Path, tmp_path: Path) -> None:
    command = [sys.executable, "jobs/wire_snatch.py"]
    done = subprocess.run(command, cwd=written, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "") and done.stdout
    for name in ("box_over_the_side", "suction_anchor"):
        done = command_line("run", written / "lifts" / f"{name}.toml", "--out", tmp_path, "--t-end", "2")
        assert done.returncode == 0, done.stderr
    assert [path.suffix for path in tmp_path.iterdir()] == [".nc", ".nc"]
