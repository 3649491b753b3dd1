"""The published numbers of benchmarks/results tell of the engine as it is."""

import csv
from pathlib import Path

import pytest

from seacrane import cases, simulate

RESULTS = Path(__file__).resolve().parent.parent / "benchmarks" / "results"
OTHER_MACHINES = 0.1  # of the evaluations: adaptive steps follow rounding, which differs between compilers


def published_evaluations() -> dict[tuple[str, str], int]:
    with (RESULTS / "integrators-work-and-precision-on-case-2.csv").open(encoding="utf-8") as file:
        return {(row["integrator"], row["setting"]): int(row["evaluations"]) for row in csv.DictReader(file)}


@pytest.fixture(scope="module")
def case2():
    return cases.case2()


@pytest.mark.parametrize(
    ("integrator", "setting"),
    [
        ("rk4", {"dt": 0.1}),
        ("dopri5", {"rtol": 1e-6}),
        ("tsit5", {"rtol": 1e-4}),
        ("rosenbrock", {"rtol": 1e-3}),
        ("generalized-alpha", {"dt": 0.05}),
        ("ark-dirk", {"rtol": 1e-4}),
        ("cvode-bdf", {"rtol": 1e-4}),
        ("ida", {"rtol": 1e-3}),
    ],
)
def test_published_evaluations_are_those_of_today(case2, integrator, setting):
    label = ", ".join(f"{name} {value:g}" for name, value in setting.items())
    told = published_evaluations()[integrator, label]
    run = simulate(case2, t_end=100.0, dt_out=1.0, integrator=integrator, channels=["position"], **setting)
    assert run.stats["evaluations"] == pytest.approx(told, rel=OTHER_MACHINES)
