"""The published numbers of benchmarks/results tell of the engine as it is."""

import csv
import subprocess
import sys
from pathlib import Path

import pytest

from seacrane import cases, simulate

ROOT = Path(__file__).resolve().parents[2]
RESULTS = ROOT / "benchmarks" / "results"
OTHER_MACHINES = 0.1  # of the evaluations: adaptive steps follow rounding, which differs between compilers


@pytest.mark.parametrize(
    ("integrator", "setting"),
    [("dopri5", {"rtol": 1e-6}), ("generalized-alpha", {"dt": 0.05}), ("ida", {"rtol": 1e-3})],
)
def test_published_evaluations_are_those_of_today(integrator, setting):
    label = ", ".join(f"{name} {value:g}" for name, value in setting.items())
    with (RESULTS / "integrators-work-and-precision-on-case-2.csv").open(encoding="utf-8") as file:
        rows = {(row["integrator"], row["setting"]): row for row in csv.DictReader(file)}
    told = int(rows[integrator, label]["evaluations"])
    given = {"t_end": 100.0, "dt_out": 1.0, "channels": ["position"], **setting}
    run = simulate(cases.case2(), integrator=integrator, **given)
    assert run.stats["evaluations"] == pytest.approx(told, rel=OTHER_MACHINES)


def test_every_benchmark_can_be_imported() -> None:
    """They run by night and on release; what they import is renamed by day."""
    folder = RESULTS.parent
    names = [f"measure.{path.stem}" for path in sorted((folder / "measure").glob("[!_]*.py"))]
    names += [path.stem for path in sorted(folder.glob("*.py"))]
    script = "import importlib, sys\nfor name in sys.argv[1:]: importlib.import_module(name)"
    command = [sys.executable, "-c", script, *names]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_every_script_that_its_own_text_calls_by_a_path_starts() -> None:
    for path in sorted(ROOT.glob("benchmarks/**/*.py")):
        name, text = path.relative_to(ROOT).as_posix(), path.read_text(encoding="utf-8")
        if f"python {name}" in text and "ArgumentParser" in text:
            subprocess.run([sys.executable, name, "--help"], cwd=ROOT, check=True, capture_output=True)
