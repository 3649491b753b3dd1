"""Lines with quasi-static stretch against closed forms, the elastic line, the rigid link, and energy."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
import pytest
from line_scenes import MASS, STIFFNESS, G, case2_on_a_line, hung, settled, swinging, taut
from multibody_runs import record
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from test_line_limits import pendulum

from seacrane import (
    Curve,
    SceneError,
    SimulationError,
    cases,
    simulate,
)
from seacrane.warnings import StiffWarning

Array = NDArray[np.float64]
OMEGA = np.sqrt(STIFFNESS / MASS)  # rad/s of the elastic line


def driven(omega: float, *, settling: float, amplitude: float = 1e-4) -> tuple[complex, complex]:
    """Steady amplitudes of the strain and of the tension of a hung load whose line pays out and hauls in.

    Over cos(omega t), by least squares, once the start has decayed.
    """
    scene = hung()
    length = Curve.harmonic(start_time=0.0, offset=10.0, amplitude=amplitude, omega=omega)
    scene.replace("hoist", length=length, rung="quasi-static", settling=settling)
    begin, period = 150.0 * settling, 2.0 * np.pi / omega
    out = record(scene, begin + 4.0 * period, dt_out=period / 16, rtol=1e-9)
    late = out["time"] > begin
    t = out["time"][late]
    wave = np.stack([np.ones_like(t), np.cos(omega * t), -np.sin(omega * t)], axis=1)
    strain = out["line_stretch"][late, 0] / out["line_unstretched_length"][late, 0]
    found = [
        np.linalg.lstsq(wave, values, rcond=None)[0] for values in (strain, out["line_tension"][late, 0])
    ]
    return complex(found[0][1], found[0][2]), complex(found[1][1], found[1][2])


def closed_form(omega: float, *, settling: float, amplitude: float = 1e-4) -> tuple[complex, complex]:
    """The same of T = EA (e + s (e' - w) + s^2 e''), w' = (e' - w) / s; of the elastic line at s = 0."""
    p, s, strain = 1j * omega, settling, MASS * G / (STIFFNESS * 10.0)
    follows = 1.0 + (s * p) ** 2 * (2.0 + s * p) / (1.0 + s * p)  # T / (EA e)
    length = (1.0 + strain) * amplitude / (1.0 + p**2 / OMEGA**2 / follows)
    tension = -MASS * p**2 * length
    return (length - (1.0 + strain) * amplitude) / 10.0, tension


@pytest.mark.parametrize(("omega", "settling"), [(1.0, 0.2), (2.0, 0.2), (1.5, 0.1)])
def test_a_driven_load_follows_the_closed_form(omega: float, settling: float) -> None:
    strain, tension = driven(omega, settling=settling)
    expected_strain, expected_tension = closed_form(omega, settling=settling)
    assert abs(strain - expected_strain) < 2e-4 * abs(expected_strain)
    assert abs(tension - expected_tension) < 2e-4 * abs(expected_tension)


def test_errors_are_of_second_order_in_the_settling_time() -> None:
    """Strain: 2 (s omega)^2, dissipative (s omega)^3. Tension: (omega / omega_line)^2 of that."""
    omega = 0.5
    elastic_strain, elastic_tension = closed_form(omega, settling=0.0)
    bound = (omega / OMEGA) ** 2
    errors = []
    for settling in (0.2, 0.1):
        strain, tension = closed_form(omega, settling=settling)
        of_strain, of_tension = strain / elastic_strain - 1.0, tension / elastic_tension - 1.0
        assert abs(of_strain) == pytest.approx(2.0 * (settling * omega) ** 2, rel=0.06)
        assert abs(of_tension) < 2.1 * (settling * omega) ** 2 * bound
        assert abs(of_tension) < bound  # that of a stretch in step with the tension of a rigid line
        assert abs(of_strain.imag) < 1.2 * (settling * omega) ** 3
        errors.append(abs(of_tension))
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.05)
    measured = driven(omega, settling=0.2)[0] / elastic_strain - 1.0
    assert abs(measured) == pytest.approx(2.0 * (0.2 * omega) ** 2, rel=0.06)


@pytest.mark.warns("QuasiStaticLineWarning")
def test_a_closed_loop_of_rows_beside_it() -> None:
    """Jacobians and steps where joints close a loop in the recursive form as well: three methods agree."""
    scene = taut()
    scene.add_joint(
        kind="distance", name="stay", first="ground", second="load", point=(4.2, 3.0, -5.0),
        second_point=(4.2, 0.1, -5.0),
    )  # fmt: skip
    runs = [
        record(scene, 2.0, rtol=rtol, integrator=method, formulation=form)["position"]
        for method, form, rtol in (
            ("dopri5", "redundant", 1e-9), ("dopri5", "recursive", 1e-9), ("rosenbrock", "recursive", 1e-6),
        )
    ]  # fmt: skip
    assert_allclose(runs[1], runs[0], atol=1e-6)
    assert_allclose(runs[2], runs[0], atol=1e-3)


@pytest.mark.warns("LiftedStartWarning")
def test_a_winch_works_on_the_tension_it_records() -> None:
    """Momentum of the load, and the winch's power: T (1 + e) times the rate, but for what the line stores."""
    out = record(settled(swinging(), settling=0.1), 6.0, rtol=1e-9)
    place = out["position"][:, 0]
    force = 2e3 * (out["acceleration"][:, 0] + np.array([0.0, 0.0, G]))
    assert_allclose(np.linalg.norm(force, axis=1), out["line_tension"][:, 0], rtol=1e-6)
    strain = out["line_stretch"] / out["line_unstretched_length"]
    carried = -out["line_tension"] * (1.0 + strain) * out["line_pay_out_rate"]
    stored = np.abs(0.02 * out["line_tension"] * out["line_pay_out_rate"]).max()
    assert np.abs(out["line_winch_power"] - carried).max() < stored
    assert np.ptp(place) > 1.0


def test_a_line_that_goes_slack_or_stops_ends_the_run_by_name() -> None:
    thrown = settled(hung())
    thrown.replace("load", velocity=(0.0, 0.0, 2.0))
    hauled = hung(length=3.0)
    hauled.add_winch(line="hoist", rate=-0.5, lag=0.2, minimum_length=2.5)
    for scene, integrator, words in (
        (thrown, "dopri5", "quasi-static, and it goes slack"),
        (thrown, "cvode-adams", "quasi-static, and it goes slack"),
        (settled(hung(stretch=-0.1)), "dopri5", "goes slack"),
        (settled(hauled), "dopri5", "hauled in to its minimum_length"),
    ):
        with pytest.raises(SimulationError, match=f"line 'hoist'.*{words}"):
            simulate(scene, 3.0, integrator=integrator)


@pytest.mark.warns("GrowingModeWarning", "UnitWarning")
def test_a_stiff_elastic_line_is_told_its_rung() -> None:
    with pytest.warns(StiffWarning, match="line 'hoist'.* taut, give it"):
        simulate(pendulum(1e11, damping=0.02), 12.0, channels=["position"], dt_out=0.1, rtol=1e-3)


@pytest.mark.warns("UnitWarning")
def test_stiff_costs_like_soft_on_case2() -> None:
    """From 1e8 to 1e11 N: 1 cm of the payload, 2 % of the tension's range, 1.5 times the evaluations."""
    how: dict[str, Any] = {"dt_out": 0.2, "channels": ["position", "line_tension"]}
    rigid = simulate(cases.case2(), 60.0, channels=["position"], rtol=1e-4)
    soft, stiff = (
        simulate(case2_on_a_line("quasi-static", ea), 60.0, rtol=1e-4, **how) for ea in (1e8, 1e11)
    )
    assert stiff.stats["evaluations"] < 1.1 * soft.stats["evaluations"]
    assert soft.stats["evaluations"] < 1.5 * rigid.stats["evaluations"]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", StiffWarning)
        elastic = simulate(case2_on_a_line("elastic", 1e8), 60.0, rtol=1e-7, **how)
    apart = soft.select("position", body="payload") - elastic.select("position", body="payload")
    assert np.linalg.norm(apart, axis=1).max() < 0.01
    tension = elastic["line_tension"]
    assert np.abs(soft["line_tension"] - tension).max() < 0.02 * np.ptp(tension)


def test_what_it_cannot_do_is_told() -> None:
    for method in ("ida", "generalized-alpha"):
        with pytest.raises(Exception, match=f'"{method}" has no accelerations for lines'):
            simulate(settled(hung()), 1.0, integrator=method)
    wrong, stopped, paper = hung(), taut(), cases.case2(kinematics="paper")
    wrong.replace("hoist", rung="stiff")
    stopped.add_body(name="float", mass=1.0, inertia=(1, 1, 1), position=(0, 0, -20))
    stopped.add_joint(kind="prismatic", name="rail", first="ground", second="float", point=(0, 0, -20))
    stopped.add_end_stop(name="stop", joint="rail", minimum=-1.0)
    tugger = {"points": [(60, 0, 20), (0, 0, 0)], "EA": 1e8, "length": 60.0, "rung": "quasi-static"}
    paper.add_line(name="tugger", bodies=["ground", "payload"], **tugger)
    for scene, words in (
        (wrong, "rung 'stiff' is unknown"),
        (stopped, "limit 'stop' makes impacts"),
        (paper, "kinematics 'paper'"),
    ):
        with pytest.raises(SceneError, match=words):
            scene.compile()
