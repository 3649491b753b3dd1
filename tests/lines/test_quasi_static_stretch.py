"""Lines with quasi-static stretch against closed forms, the elastic line, the rigid link, and energy."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from line_scenes import MASS, STIFFNESS, G, case2_on_a_line, hung, reeved, swinging
from multibody_runs import record
from numpy.testing import assert_allclose
from numpy.typing import NDArray

from seacrane import (
    Curve,
    Run,
    Scene,
    SceneError,
    SimulationError,
    State,
    cases,
    equilibrium,
    natural_modes,
    simulate,
)
from seacrane.warnings import StiffWarning

Array = NDArray[np.float64]
OMEGA = np.sqrt(STIFFNESS / MASS)  # rad/s of the elastic line
FORMULATIONS = ["redundant", "recursive"]


def settled(scene: Scene, *, settling: float = 0.2, **change: Any) -> Scene:
    """The scene with all its lines quasi-static."""
    for name, load in list(scene.loads.items()):
        if type(load).__name__ == "Line":
            scene.replace(name, rung="quasi-static", settling=settling, **change)
    return scene


def pulled() -> Scene:
    """`reeved` with both lines taut: they feel each other."""
    scene = settled(reeved(), settling=0.1)
    length = Curve.harmonic(start_time=0.0, offset=5.0, amplitude=0.05, omega=3.0)
    scene.replace("tugger", length=length)
    scene.replace("hoist", length=13.7566)  # carries the load from the start
    return scene


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


def pendulum(rung: str, stiffness: float, *, settling: float = 0.1) -> Scene:
    """2 t on 8 m, let go at 1 rad, its line as long as without weight."""
    scene = Scene(name="pendulum")
    place = 8.0 * np.array([np.sin(1.0), 0.0, -np.cos(1.0)])
    scene.add_body(name="load", mass=2e3, inertia=(300.0, 400.0, 500.0), position=place)
    if rung == "rigid":
        scene.add_joint(
            kind="distance", name="hoist", first="ground", second="load", point=(0, 0, 0), second_point=place,
        )  # fmt: skip
    else:
        scene.add_line(
            name="hoist", bodies=["ground", "load"], points=np.zeros((2, 3)), EA=stiffness,
            length=8.0 / (1.0 + 2e3 * G * np.cos(1.0) / stiffness), rung=rung, settling=settling,
        )  # fmt: skip
    return scene


def motion(scene: Scene, **settings: Any) -> Array:
    return np.asarray(record(scene, 12.0, dt_out=0.2, rtol=1e-9, **settings)["position"][:, 0])


def test_it_tends_to_the_rigid_link_as_one_over_ea() -> None:
    rigid = motion(pendulum("rigid", 0.0))
    apart = [np.abs(motion(pendulum("quasi-static", ea)) - rigid).max() for ea in (1e8, 1e9, 1e10)]
    assert apart[0] / apart[1] == pytest.approx(10.0, rel=0.05)
    assert apart[1] / apart[2] == pytest.approx(10.0, rel=0.05)


def test_it_is_far_nearer_to_the_elastic_line_than_the_rigid_link_and_by_the_order() -> None:
    elastic = motion(pendulum("elastic", 1e7))
    rigid = np.abs(motion(pendulum("rigid", 0.0)) - elastic).max()
    apart = [np.abs(motion(pendulum("quasi-static", 1e7, settling=s)) - elastic).max() for s in (0.1, 0.05)]
    assert apart[0] < 0.2 * rigid
    assert apart[0] / apart[1] > 3.0


@pytest.mark.warns(sometimes=["LiftedStartWarning", "QuasiStaticLineWarning"])
@pytest.mark.parametrize("formulation", FORMULATIONS)
@pytest.mark.parametrize("make", [lambda: settled(swinging(), settling=0.1), pulled])
def test_the_energy_balance_closes(make: Any, formulation: str) -> None:
    out = record(make(), 6.0, rtol=1e-8, formulation=formulation)
    assert out["absolute_work"][-1] > 1e3
    assert np.max(np.abs(out["energy_balance"])) < 1e-6 * out["absolute_work"][-1]


@pytest.mark.warns("QuasiStaticLineWarning")
def test_both_formulations_agree() -> None:
    a, b = (record(pulled(), 4.0, rtol=1e-9, formulation=form) for form in FORMULATIONS)
    for name in ("position", "velocity", "load_state"):
        assert_allclose(a[name], b[name], atol=1e-6)
    for name in ("acceleration", "line_tension"):
        assert_allclose(a[name], b[name], atol=1e-5 * np.abs(a[name]).max())


@pytest.mark.warns("QuasiStaticLineWarning")
def test_a_closed_loop_of_rows_beside_it() -> None:
    """Jacobians and steps where joints close a loop in the recursive form as well: three methods agree."""
    scene = pulled()
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


def test_no_mode_is_faster_than_one_over_the_settling_time() -> None:
    for stiffness in (1e8, 1e12):
        modes = natural_modes(settled(hung(length=10.0), settling=0.2, EA=stiffness))
        assert np.min(modes.natural_period[np.isfinite(modes.natural_period)]) > 2.0 * np.pi * 0.2


def test_it_rests_where_the_elastic_line_does() -> None:
    scene = hung(stretch=0.0, damping=0.1)
    elastic = equilibrium(scene).values
    found = equilibrium(settled(hung(stretch=0.0, damping=0.1))).values
    assert_allclose(np.asarray(found)[:3], np.asarray(elastic)[:3], atol=1e-9)


@pytest.mark.warns("LiftedStartWarning")
def test_a_run_goes_on_bit_for_bit(tmp_path: Path) -> None:
    scene = settled(swinging(), settling=0.1)
    whole = Run(scene, t_end=1.5, dt_out=0.05)
    whole.advance(0.73)
    whole.core.state.save(tmp_path / "half.state")
    whole.advance(1.5)
    start = State.load(tmp_path / "half.state", scene=scene)
    rest = Run(scene, t_end=1.5, dt_out=0.05, start=start)
    rest.advance(1.5)
    assert np.array_equal(rest.core.state.values, whole.core.state.values)
    assert set(start.load_states) == {"hoist.length", "hoist.rate", "hoist.strain_rate"}


@pytest.mark.warns("UnitWarning")
def test_stiff_costs_like_soft_on_case2() -> None:
    """From 1e8 to 1e11 N: 1 cm of the payload, 2 % of the tension's range, 1.5 times the evaluations."""
    settings: dict[str, Any] = {"dt_out": 0.2, "rtol": 1e-4}
    rigid = simulate(cases.case2(), 60.0, channels=["position"], **settings)
    evaluations = {}
    for stiffness in (1e8, 1e11):
        scene = case2_on_a_line("quasi-static", stiffness)
        out = simulate(scene, 60.0, channels=["position", "line_tension"], **settings)
        evaluations[stiffness] = out.stats["evaluations"]
        assert evaluations[stiffness] < 1.5 * rigid.stats["evaluations"]
        if stiffness > 1e8:
            continue
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", StiffWarning)
            elastic = simulate(
                case2_on_a_line("elastic", stiffness), 60.0, channels=["position", "line_tension"],
                dt_out=0.2, rtol=1e-7,
            )  # fmt: skip
        payload = list(scene.bodies).index("payload")
        apart = np.asarray(out["position"])[:, payload] - np.asarray(elastic["position"])[:, payload]
        assert np.linalg.norm(apart, axis=1).max() < 0.01
        tension = np.asarray(elastic["line_tension"])[:, 0]
        assert np.abs(np.asarray(out["line_tension"])[:, 0] - tension).max() < 0.02 * np.ptp(tension)
    assert evaluations[1e11] < 1.1 * evaluations[1e8]


def test_a_line_that_goes_slack_ends_the_run_by_name() -> None:
    scene = settled(hung())
    scene.replace("load", velocity=(0.0, 0.0, 2.0))
    for integrator in ("dopri5", "cvode-adams"):
        with pytest.raises(
            SimulationError, match="line 'hoist': its stretch is quasi-static, and it goes slack"
        ):
            simulate(scene, 3.0, integrator=integrator)
    with pytest.raises(SimulationError, match="goes slack"):
        simulate(settled(hung(stretch=-0.1)), 1.0)


def test_hauling_in_to_the_end_is_refused_by_name() -> None:
    scene = hung(length=3.0)
    scene.add_winch(line="hoist", rate=-0.5, lag=0.2, minimum_length=2.5)
    with pytest.raises(SimulationError, match="has hauled in to its minimum_length"):
        simulate(settled(scene), 3.0)


def test_what_it_cannot_do_is_told() -> None:
    with pytest.raises(SceneError, match="rung 'stiff' is unknown; choose 'elastic' or 'quasi-static'"):
        scene = hung()
        scene.replace("hoist", rung="stiff")
        scene.compile()
    for method in ("ida", "generalized-alpha"):
        with pytest.raises(Exception, match=f'"{method}" has no accelerations for lines'):
            simulate(settled(hung()), 1.0, integrator=method)
    scene = pulled()
    scene.add_body(name="float", mass=1.0, inertia=(1, 1, 1), position=(0, 0, -20))
    scene.add_joint(
        kind="prismatic", name="rail", first="ground", second="float", point=(0, 0, -20), axis=(0, 0, 1)
    )
    scene.add_end_stop(name="stop", joint="rail", minimum=-1.0)
    with pytest.raises(SceneError, match="limit 'stop' makes impacts, which shake the line"):
        scene.compile()
    with pytest.raises(SceneError, match="has kinematics 'paper'"):
        paper = cases.case2(kinematics="paper")
        paper.add_line(
            name="tugger", bodies=["ground", "payload"], points=[(60, 0, 20), (0, 0, 0)], EA=1e8,
            length=60.0, rung="quasi-static",
        )  # fmt: skip
        paper.compile()


@pytest.mark.warns("GrowingModeWarning", "UnitWarning")
def test_a_stiff_elastic_line_is_told_its_rung() -> None:
    scene = pendulum("elastic", 1e11)
    with pytest.warns(StiffWarning, match="the stretch of line 'hoist' and the line stays taut, give it"):
        simulate(scene, 12.0, channels=["position"], dt_out=0.1, rtol=1e-3)
