"""The published numbers of benchmarks/results tell of the engine as it is."""

import csv
import subprocess
import sys
from pathlib import Path

import pytest
from line_scenes import case2_on_a_line

from seacrane import allowable_hs, cases, simulate

ROOT = Path(__file__).resolve().parents[2]
RESULTS = ROOT / "benchmarks" / "results"
OTHER_MACHINES = 0.1  # of the evaluations: adaptive steps follow rounding, which differs between compilers


@pytest.mark.parametrize(
    ("integrator", "setting"),
    [
        ("rk4", {"dt": 0.1}), ("dopri5", {"rtol": 1e-6}), ("rosenbrock", {"rtol": 1e-3}),
        ("generalized-alpha", {"dt": 0.05}), ("cvode-bdf", {"rtol": 1e-4}), ("ida", {"rtol": 1e-3}),
    ],
)  # fmt: skip
def test_published_evaluations_are_those_of_today(integrator, setting):
    label = ", ".join(f"{name} {value:g}" for name, value in setting.items())
    (told,) = [
        int(row["evaluations"])
        for row in rows_of("integrators-work-and-precision-on-case-2.csv")
        if (row["integrator"], row["setting"]) == (integrator, label)
    ]
    given = {"t_end": 100.0, "dt_out": 1.0, "channels": ["position"], **setting}
    run = simulate(cases.case2(), integrator=integrator, **given)
    assert run.stats["evaluations"] == pytest.approx(told, rel=OTHER_MACHINES)


def rows_of(name: str) -> list[dict[str, str]]:
    with (RESULTS / name).open(encoding="utf-8") as file:
        return list(csv.DictReader(file))


def test_published_costs_of_lines_are_those_of_today():
    """A quasi-static line on case 2, and the periods after a snatch of an elastic one."""
    (told,) = [
        int(row["evaluations"])
        for row in rows_of("stiff-lines.csv")
        if (row["EA, N"], row["stretch"], row["method"]) == ("1e9", "quasi-static", "dopri5 0.0001")
    ]
    run = simulate(
        case2_on_a_line("quasi-static", 1e9), t_end=100.0, dt_out=0.2, integrator="dopri5", rtol=1e-4,
        channels=["position", "line_tension"],
    )  # fmt: skip
    assert run.stats["evaluations"] == pytest.approx(told, rel=OTHER_MACHINES)
    snatches = [row for row in rows_of("cost-of-a-snatch.csv") if row["method"] == "dopri5 0.0001"]
    assert snatches.pop()["EA, N"] == "rigid, an impact"
    assert [row["EA, N"] for row in snatches] == ["1e7", "1e8", "1e9", "1e10", "1e11"]
    for row in snatches:
        assert 0 < int(row["evaluations"]) < 2000
        assert -5.0 < float(row["off the closed form, %"]) < 0.0  # the damping takes of the peak


def test_the_published_study_of_operability_is_that_of_today(monkeypatch):
    """Its linear column, for one cell that a criterion reaches; the runs of a cell take minutes."""
    monkeypatch.syspath_prepend(str(RESULTS.parent))
    from measure.operability import CRITERIA, study_scene

    (told,) = [
        row
        for row in rows_of("operability-of-case-2.csv")
        if (row["Tp, s"], row["direction, deg"]) == ("9", "135")
    ]
    found = allowable_hs(
        study_scene(), criteria=CRITERIA, tp=9.0, direction_deg=135.0, hs=[2.5], time=50.0,
        domain="frequency",
    )  # fmt: skip
    assert found.dataset["allowable_hs"].item() == pytest.approx(float(told["linear model, m"]), abs=2e-3)


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
