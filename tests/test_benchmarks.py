"""The published tables of benchmarks/README.md tell of the engine as it is."""

import re
from pathlib import Path

import pytest

from seacrane import cases, simulate

PUBLISHED = Path(__file__).resolve().parent.parent / "benchmarks" / "README.md"
TITLE = "## Integrators: work and precision on case 2"
ROW = re.compile(
    r"\| (?P<integrator>[a-z0-9-]+) \| (?P<setting>[a-z0-9., -]+) \|[^|]+\|[^|]+\| (?P<evaluations>\d+) \|"
)
OTHER_MACHINES = 0.1  # of the evaluations: adaptive steps follow rounding, which differs between compilers


def published_evaluations() -> dict[tuple[str, str], int]:
    section = PUBLISHED.read_text(encoding="utf-8").split(TITLE)[1].split("\n## ")[0]
    matches = filter(None, map(ROW.match, section.splitlines()))
    return {(row["integrator"], row["setting"]): int(row["evaluations"]) for row in matches}


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
