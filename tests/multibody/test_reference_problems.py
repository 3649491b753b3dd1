"""Classic mechanisms against published or independent solutions: both formulations, several integrators.

Limits are a few times what was measured. tests/reference_problems/README.md tells what each problem is and
where its solution comes from.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from multibody_runs import record
from reference.jets import Jet
from reference_problems import andrews, andrews_equations, bricard, four_bars, pendulums
from reference_problems.planar import angles
from reference_problems.problems import MECHANISMS, four_bar_row, run, squeezer

BOTH = ("redundant", "recursive")
# Problem: settings and the largest difference allowed, in the unit of what is compared (m or rad).
LIMITS: dict[str, list[tuple[dict[str, Any], float]]] = {
    "pendulum": [({"rtol": 1e-10}, 2e-9), ({"integrator": "cvode-bdf", "rtol": 1e-8}, 2e-5)],
    "four-bars": [({"rtol": 1e-8}, 1e-6)],
    "squeezer": [
        ({"rtol": 1e-7}, 1e-9),
        ({"integrator": "verner76", "rtol": 1e-8}, 1e-11),
        ({"integrator": "tsit5", "rtol": 1e-6}, 1e-8),
        ({"integrator": "cvode-bdf", "rtol": 1e-6}, 1e-6),
        ({"integrator": "rk4", "dt": 1e-5}, 1e-9),
    ],
    "bricard": [({"rtol": 1e-8}, 1e-7), ({"integrator": "dop853", "rtol": 1e-9}, 1e-9)],
    "governor": [({"integrator": "cvode-bdf", "rtol": 1e-7}, 1e-6)],
    "top": [
        ({"integrator": "dop853", "rtol": 1e-9}, 2e-8),
        ({"integrator": "rk4", "dt": 1e-4}, 1e-7),
        ({"integrator": "tsit5", "rtol": 1e-8}, 1e-7),
    ],
    "nut": [({"rtol": 1e-10}, 1e-7), ({"integrator": "verner65", "rtol": 1e-10}, 1e-7)],
    "crank": [({"rtol": 1e-10}, 1e-8), ({"integrator": "rosenbrock", "rtol": 1e-6}, 1e-4)],
}
CASES = [(name, settings, limit) for name, rows in LIMITS.items() for settings, limit in rows]


@pytest.mark.parametrize("formulation", BOTH)
@pytest.mark.parametrize(
    ("name", "settings", "limit"), CASES, ids=[f"{n}-{s.get('integrator', 'dopri5')}" for n, s, _ in CASES]
)
def test_problem(name: str, settings: dict[str, Any], limit: float, formulation: str) -> None:
    found = MECHANISMS[name](formulation=formulation, **settings)
    assert 0.0 < found.difference < limit, found


def test_a_stiff_governor_by_an_explicit_method() -> None:
    found = MECHANISMS["governor"](integrator="dopri5", rtol=1e-6)
    assert found.difference < 1e-9, found


# Andrews' squeezer


def test_the_published_squeezer_is_right_to_nine_digits() -> None:
    """Two solutions without anything in common agree to 3e-12 rad, and are both 1.4e-9 rad from the published
    one."""
    ours = squeezer(integrator="verner76", rtol=1e-8).difference
    published = squeezer(integrator="verner76", rtol=1e-8, published=True).difference
    assert ours < 1e-11
    assert 1e-9 < published < 2e-9


@pytest.mark.parametrize("formulation", BOTH)
def test_squeezer_of_planar_joints(formulation: str) -> None:
    """Ten hinges: nine rows of fifty are more than needed."""
    assert squeezer(planar=True, formulation=formulation, integrator="dop853", rtol=1e-6).difference < 1e-8


@pytest.mark.parametrize("formulation", BOTH)
def test_squeezer_starts_with_the_published_accelerations_and_ends_with_the_published_rates(
    formulation: str,
) -> None:
    scene = andrews.scene()
    channels = ("quaternion", "angular_velocity", "angular_acceleration")
    settings = {"formulation": formulation, "rtol": 1e-7}
    result = run(scene, andrews.END_TIME, 1e-4, settings, *channels)
    acceleration = andrews.relative(result["angular_acceleration"][..., 2])
    np.testing.assert_allclose(acceleration[0], andrews.START_ACCELERATION, rtol=0.0, atol=1e-7)
    np.testing.assert_allclose(acceleration[-1], andrews.END_ACCELERATION, rtol=0.0, atol=0.2)  # of 5e5
    rates = andrews.relative(result["angular_velocity"][..., 2])
    np.testing.assert_allclose(rates[-1], andrews.END_RATES, rtol=0.0, atol=2e-6)  # of 1e3


def test_the_squeezers_equations_are_those_of_the_published_accelerations() -> None:
    found = andrews_equations.acceleration(andrews.START, np.zeros(7))
    np.testing.assert_allclose(found, andrews.START_ACCELERATION, rtol=0.0, atol=1e-9)
    found = andrews_equations.acceleration(andrews.END, andrews.END_RATES)
    np.testing.assert_allclose(found, andrews.END_ACCELERATION, rtol=1e-5)


def test_published_heavy_top() -> None:
    """1.2e-6 m from a second-order method's, 4e-9 m from the elliptic integrals."""
    found = MECHANISMS["top"](published=True, integrator="dop853", rtol=1e-9)
    assert found.difference < 2e-6, found


# Loops through singular positions


@pytest.mark.parametrize("formulation", BOTH)
@pytest.mark.parametrize("loops", [1, 4])
def test_rows_of_four_bars_stay_on_their_branch(loops: int, formulation: str) -> None:
    """Every loop could fold in each of ten flat positions; joints hold each motion once, up to those
    positions."""
    found = four_bar_row(loops, planar=False, formulation=formulation, rtol=1e-8)
    assert found.difference < 2e-6, found
    angle, _ = four_bars.turned(loops, [0.0, 10.0])
    assert angle[0] == pytest.approx(0.0, abs=1e-12)
    assert angle[1] > 10.0 * np.pi


@pytest.mark.slow("forty loops")
@pytest.mark.filterwarnings("ignore:.*are redundant")
def test_forty_loops_of_redundant_joints_move_as_one_pendulum() -> None:
    """605 rows, 120 of them redundant; the recursive form has to tell 200 rows of loops apart."""
    result = run(four_bars.scene(40), 0.3, 0.1, {"rtol": 1e-8, "formulation": "recursive"}, "position")
    angle, _ = four_bars.turned(40, result.time)
    posts = result["position"][:, :41]
    feet = np.arange(41.0)
    np.testing.assert_allclose(posts[..., 0] - feet, np.outer(0.5 * np.sin(angle), np.ones(41)), atol=1e-7)


@pytest.mark.filterwarnings("ignore:.*are redundant")
def test_sixty_loops_of_redundant_joints_move_as_one_pendulum() -> None:
    """905 rows, of which 180 are left out."""
    result = run(four_bars.scene(60), 0.3, 0.1, {"rtol": 1e-8, "formulation": "redundant"}, "position")
    angle, _ = four_bars.turned(60, result.time)
    feet = np.arange(61.0)
    posts = result["position"][:, :61, 0] - feet
    np.testing.assert_allclose(posts, np.outer(0.5 * np.sin(angle), np.ones(61)), atol=1e-7)


@pytest.mark.slow("forty loops")
@pytest.mark.parametrize(("loops", "formulation"), [(10, "redundant"), (10, "recursive"), (40, "recursive")])
def test_many_four_bars(loops: int, formulation: str) -> None:
    """Up to the library's own forty loops, 81 bodies, through the first flat position."""
    found = four_bar_row(loops, planar=False, t_end=1.5, formulation=formulation, rtol=1e-8)
    assert four_bars.turned(loops, [1.5])[0][0] > 0.5 * np.pi
    assert found.difference < 1e-8, found


@pytest.mark.parametrize("angle", [0.3, 0.8, 2.0, -1.0, -3.0])
def test_bricards_closed_form_closes(angle: float) -> None:
    rotations, places = bricard.chain(Jet(angle, 1.0))
    for value, expected in zip(places[-1], bricard.VERTICES[0], strict=True):
        assert value.f == pytest.approx(expected, abs=1e-14)
        assert value.d == pytest.approx(0.0, abs=1e-13)
        assert value.dd == pytest.approx(0.0, abs=1e-12)
    last = bricard.product(rotations[-1], bricard.turn(bricard.AXES[0], *bricard.hinges(Jet(angle, 1.0))[0]))
    np.testing.assert_allclose([[c.f for c in row] for row in last], np.eye(3), atol=1e-14)


# Chaos


@pytest.mark.parametrize("formulation", BOTH)
@pytest.mark.parametrize(
    "settings", [{"rtol": 1e-8}, {"integrator": "dop853", "rtol": 1e-8}, {"integrator": "rk4", "dt": 1e-3}],
    ids=lambda settings: str(settings.get("integrator", "dopri5")),
)  # fmt: skip
def test_errors_of_a_double_pendulum_grow_as_those_of_its_start(
    settings: dict[str, Any], formulation: str
) -> None:
    """A million times in 9 s, at the exponent of two nearby motions of Lagrange's equations."""
    out = record(pendulums.double_scene(), 10.0, dt_out=0.1, formulation=formulation, **settings)
    times = out["time"]
    error = np.linalg.norm(
        angles("xz", out["quaternion"]) - pendulums.DOWN - pendulums.double_angles(times), axis=1
    )
    growth = pendulums.growth(times)
    late = times >= 2.0
    exponents = [np.polyfit(times[late], np.log(values[late]), 1)[0] for values in (error, growth)]
    assert exponents[1] > 1.0  # 1/s: it is chaotic
    assert exponents[0] == pytest.approx(exponents[1], rel=0.1)
    # Made early, and grown since: an error beside it would show as a ratio of its own.
    assert np.ptp(np.log(error[late] / growth[late])) < np.log(10.0)
    assert error[-1] < 2e-3
    assert np.max(np.abs(out["energy_balance"])) < 1e-6 * pendulums.GRAVITY
