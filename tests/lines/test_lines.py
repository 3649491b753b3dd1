"""Elastic lines and winches against closed forms and their own equations; what every line owes in a run."""

from __future__ import annotations

import pickle
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from element_runs import both_forms, goes_on
from heave_scenes import moving_crane
from heavy_line_scenes import KINDS, dropped, in_waves, wet
from line_scenes import MASS, STIFFNESS, G, busy, hung, on_deck, reeved, settled, swinging, taut
from multibody_runs import record
from numpy.testing import assert_allclose
from reeving_scenes import slewing, stiff
from scipy.integrate import solve_ivp
from test_jacobian import largest_error, moving

from seacrane import Curve, Result, Run, Scene, SceneError, integrator_names, simulate
from seacrane.analysis import equilibrium, linear_model, natural_modes
from seacrane.arrays import Array

OMEGA = np.sqrt(STIFFNESS / MASS)


@pytest.mark.parametrize("falls", [1, 6])
def test_falls_divide_the_tension_and_stiffen_by_their_square(falls: int) -> None:
    """EA / L of n falls is k / n^2 along the line, and n^2 times that at the hook."""
    scene = hung(falls=falls, velocity=(0.0, 0.0, 0.02))
    out = record(scene, 1.0, rtol=1e-10)
    heave = out["position"][:, 0, 2] - scene.bodies["load"].position[2]
    assert_allclose(heave, 0.02 / OMEGA * np.sin(OMEGA * out["time"]), atol=1e-9)
    assert_allclose(falls * out["line_tension"][:, 0], MASS * G - STIFFNESS * heave, rtol=1e-8)
    assert_allclose(out["line_length"][:, 0], -falls * out["position"][:, 0, 2], rtol=1e-12)


@pytest.mark.warns("LiftedStartWarning")
def test_the_order_is_kept_where_a_line_goes_slack_and_taut() -> None:
    """The crossings are located: errors fall with the tolerance, not with the step that met the kink."""
    scene = hung(damping=0.02, stretch=0.3)
    end = [record(scene, 4.0, rtol=rtol, dt_out=4.0)["position"][-1, 0, 2] for rtol in (1e-11, 1e-8, 1e-5)]
    out = record(scene, 4.0, rtol=1e-8)
    assert np.ptp(np.sign(out["line_stretch"])) == 2.0  # it is slack now and then
    assert abs(end[1] - end[0]) < 1e-6 and abs(end[2] - end[0]) < 1e-3


def pendulum(t: float, y: Array, scene: Scene, *, mass: float = 2e3) -> Array:
    """The load of `swinging` as a point at the end of its line, with its winch: position, velocity, l0, r."""
    line: Any = scene.loads["hoist"]
    place, velocity, l0, rate = y[:3], y[3:6], y[6], y[7]
    length = np.linalg.norm(place)
    along = place / length
    strain = length / l0 - 1.0
    strain_rate = (along @ velocity - rate * length / l0) / l0
    damping = 2.0 * line.damping_ratio * np.sqrt(line.EA * mass / l0) * l0
    tension = max(0.0, line.EA * strain + damping * strain_rate)
    command = np.clip(line.rate.evaluate([t])[0, 0], -line.maximum_rate, line.maximum_rate)
    change = np.clip((command - rate) / line.lag, -line.maximum_acceleration, line.maximum_acceleration)
    return np.concatenate([velocity, [0.0, 0.0, -G] - tension / mass * along, [rate, change]])


def test_a_pendulum_on_a_winch_follows_its_own_equations() -> None:
    """Solved by SciPy from the equations of a point on an elastic line of variable length."""
    scene = swinging(maximum_rate=0.5, maximum_acceleration=0.7)
    scene.replace("hoist", points=np.zeros((2, 3)), length=8.5)
    body = scene.bodies["load"]
    start = np.concatenate([body.position, body.velocity, [8.5, 0.0]])
    times = np.linspace(0.0, 5.0, 51)
    how: dict[str, Any] = {"rtol": 1e-11, "atol": 1e-12, "max_step": 2e-3}
    expected = solve_ivp(pendulum, (0.0, 5.0), start, t_eval=times, args=(scene,), **how).y.T
    out = record(scene, 5.0, dt_out=0.1, rtol=1e-9)
    assert_allclose(out["position"][:, 0], expected[:, :3], atol=2e-7)
    assert_allclose(out["load_state"], expected[:, 6:], atol=1e-8)
    assert_allclose(out["line_pay_out_rate"][:, 0], expected[:, 7], atol=1e-8)


@pytest.mark.warns("LiftedStartWarning")
def test_every_integrator_takes_states_and_converges() -> None:
    exact = record(reeved(), 1.0, rtol=1e-11, dt_out=1.0)
    for name in integrator_names():
        settings: dict[str, Any] = {"integrator": name}
        stepped = name in ("rk4", "semi-implicit-euler", "generalized-alpha", "rk-low-storage")
        settings |= {"dt": 2e-4} if stepped else {"rtol": 1e-8}
        run = Run(reeved(), t_end=1.0, dt_out=1.0, **settings)
        run.advance(1.0)
        out = run.core.channels()
        rough = 2e-3 if name == "semi-implicit-euler" else 2e-5
        assert_allclose(out["position"][-1], exact["position"][-1], atol=rough, err_msg=name)
        assert_allclose(out["load_state"][-1], exact["load_state"][-1], atol=rough, err_msg=name)


@pytest.mark.warns("LiftedStartWarning")
def test_states_are_named_read_and_set_and_kept_in_files(tmp_path: Path) -> None:
    result = simulate(swinging(), 1.0, dt_out=0.1)
    state, again = result.state, Result.load(result.save(tmp_path / "lift.nc"))
    assert list(state.load_states) == ["hoist.length", "hoist.rate"]
    assert state.load_states["hoist.length"] == result["load_state"][-1, 0]
    assert np.array_equal(again["load_state"], result["load_state"])
    assert again.state.load_states == state.load_states == pickle.loads(pickle.dumps(state)).load_states
    other = state.with_load_states({"hoist.rate": -0.25})
    assert other.load_states == state.load_states | {"hoist.rate": -0.25}
    assert simulate(swinging(), 1.5, start=other, dt_out=0.1)["line_pay_out_rate"][0, 0] == -0.25
    with pytest.raises(SceneError, match=r"'hoist\.speed'.* hoist\.length, hoist\.rate"):
        state.with_load_states({"hoist.speed": 1.0})
    with pytest.raises(SceneError, match=r"'hoist\.length' where"):
        simulate(hung(), 1.5, start=state)


def test_a_winch_lifts_a_load_off_its_stop(formulation: str) -> None:
    """It takes the weight over while the line stretches; the load leaves when the line carries all of it."""
    result = simulate(on_deck(), 3.0, dt_out=0.01, rtol=1e-8, formulation=formulation)
    assert [event.kind for event in result.events] == ["contact", "release"]
    lift_off = result.events[1].time
    hauled = 0.2 * (lift_off - 0.2 * (1.0 - np.exp(-lift_off / 0.2)))
    pulled = 2e6 * (10.0 / (10.05 - hauled) - 1.0)
    damping = 2.0 * 0.02 * np.sqrt(2e6 * 2e3 / 10.0) * 0.2
    assert pulled + damping == pytest.approx(2e3 * G, rel=1e-2)
    carried = result["line_tension"][:, 0] + result["limit_force"][:, 0]
    assert_allclose(carried[result.time < lift_off], 2e3 * G, rtol=1e-9)
    assert np.max(np.abs(result["energy_balance"])) < 1e-6 * result["absolute_work"][-1]


@pytest.mark.warns("LiftedStartWarning")
def test_rest_modes_and_the_linear_model_hold_the_states() -> None:
    """At rest by its weight; the drum's lag is a real mode, and its length a state that nothing holds."""
    scene = swinging(rate=0.0)
    scene.replace("hoist", points=np.zeros((2, 3)), length=8.5)
    scene.replace("load", position=(0.0, 0.0, -8.5))
    rest = equilibrium(scene)
    stretch = 2e3 * G * 8.5 / 4e6
    assert rest.values[2] == pytest.approx(-8.5 - stretch, abs=1e-9)
    assert rest.load_states == pytest.approx({"hoist.length": 8.5, "hoist.rate": 0.0}, abs=1e-12)
    values = np.sort(np.linalg.eigvals(linear_model(scene, state=rest).a).real)
    assert np.min(np.abs(values + 1.0 / 0.2)) < 1e-7
    modes = natural_modes(scene)
    heave = 2.0 * np.pi / np.sqrt(4e6 / 8.5 / 2e3)
    swing = 2.0 * np.pi * np.sqrt((8.5 + stretch) / G)
    for expected in (heave, swing):
        assert np.min(np.abs(modes.natural_period / expected - 1.0)) < 1e-6
    moving = swinging(rate=0.3, lag=0.5)
    with pytest.raises(SceneError, match=r"state 'hoist\.rate': changes by"):
        linear_model(moving, state=simulate(moving, 0.1).state)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"bodies": ["ground"]}, "1 bodies and 2 points"),
        ({"bodies": ["load", "load"], "points": [(0, 0, 0), (1, 0, 0)]}, "all its points on 'load'"),
        ({"bodies": ["ground", "ground", "load"], "points": np.zeros((3, 3))}, "point 1 twice in a row"),
        ({"winch": True, "length": Curve.quintic(start_time=0.0, end_time=1.0, start=10.0, end=9.0)},
         "length changes over time, and the winch does that"),
    ],
)  # fmt: skip
def test_lines_that_cannot_be_are_told(change: dict[str, Any], message: str) -> None:
    scene = hung()
    scene.replace("hoist", **change)
    with pytest.raises(SceneError, match=f"line 'hoist': .*{message}"):
        scene.compile()


EXACT: dict[str, Any] = {"integrator": "dop853", "rtol": 1e-9, "dt_out": 0.1}
WITH_MASS = {"position": 1e-7, "load_state": 1e-6}
USUAL = {"position": 1e-7, "load_state": 1e-7}
TENSE = USUAL | {"line_tension": 0.2}
WOUND = Curve.quintic(start_time=-1.0, end_time=4.0, start=10.5, end=14.0)
LYING, ROUGH = ({"position": bound, "load_state": bound} for bound in (1e-6, 1e-5))


IMPLICIT: dict[str, Any] = {"integrator": "rosenbrock", "rtol": 1e-5}
FIXED: dict[str, Any] = {"integrator": "rk4", "dt": 2e-3}


class Case:
    """A scene, for how long it runs, what agrees, and states to go on from and to linearise at."""

    def __init__(
        self, make: Callable[[], Scene], t_end: float, within: dict[str, float], how: Any = None, *,
        methods: tuple[dict[str, Any], ...] = ({"integrator": "dopri5"},), at: float | None = None,
        taut: bool = True,
    ) -> None:  # fmt: skip
        self.make, self.t_end, self.within, self.how = make, t_end, within, how or {"rtol": 1e-10}
        self.methods, self.at = methods, at  # s, where its Jacobian is asked for; else near the start
        self.taut = taut  # else its quasi-static line goes slack: no runs


CASES: dict[str, Case] = {
    "on a winch": Case(swinging, 4.0, TENSE, at=0.9),
    "over blocks": Case(reeved, 4.0, TENSE, methods=({"rtol": 1e-7}, FIXED, IMPLICIT), at=0.9),
    "on a drum with brake": Case(busy, 4.0, USUAL, methods=({"rtol": 1e-7}, IMPLICIT), at=2.1),
    "over sheaves": Case(slewing, 2.0, USUAL | {"section_tension": 0.2}, at=0.9),
    "quasi-static over sheaves": Case(lambda: stiff(3e7, "quasi-static"), 1.5, USUAL, at=0.5),
    "quasi-static on a winch": Case(lambda: settled(swinging(), settling=0.1), 4.0, USUAL, at=0.9),
    "two quasi-static ones": Case(taut, 4.0, USUAL, {"rtol": 1e-9}, at=0.9),
    "heave compensators": Case(moving_crane, 4.0, ROUGH, {"rtol": 1e-8}, methods=({"rtol": 1e-6}, IMPLICIT),
                               at=0.9),
    "on a seabed": Case(lambda: dropped(segments=3), 3.0, LYING, EXACT),
    "on a seabed in water": Case(lambda: dropped(medium="sea", diameter=0.1), 3.0, LYING, EXACT),
    "paid out by a curve": Case(lambda: in_waves(WOUND), 2.0, {"position": 1e-8}, EXACT | {"rtol": 1e-10}),
    "with mass, quasi-static": Case(lambda: wet(rung="quasi-static", compensated=True), 2.0, WITH_MASS, EXACT,
                                    taut=False),
} | {
    f"with mass, {kind}": Case(lambda kind=kind: wet(compensated=True, **KINDS[kind]), 2.0, WITH_MASS, EXACT)
    for kind in KINDS
}  # fmt: skip
RUNS = {name: case for name, case in CASES.items() if case.taut}
SOMETIMES = pytest.mark.warns(
    sometimes=["LiftedStartWarning", "QuasiStaticLineWarning", "WinchLimitWarning", "LineLengthWarning"]
)


@SOMETIMES
@pytest.mark.parametrize("name", RUNS)
def test_formulations_agree_and_the_ledger_closes(name: str) -> None:
    case = CASES[name]
    out = both_forms(case.make(), case.t_end, case.within, merge=True, **case.how)
    assert out["absolute_work"][-1] > 1e3
    assert np.ptp(out["position"], axis=0).max() > 0.1
    if "sheave_friction_power" in out:
        assert np.min(out["sheave_friction_power"]) < -1.0 and np.max(out["sheave_friction_power"]) <= 0.0
    if "drum_brake_power" in out and name == "on a drum with brake":
        assert np.min(out["drum_brake_power"]) < -100.0 and np.max(out["drum_brake_power"]) < 1e-6


@SOMETIMES
@pytest.mark.parametrize(
    ("name", "method"), [(name, i) for name, case in RUNS.items() for i in range(len(case.methods))]
)
def test_a_run_goes_on_bit_for_bit(name: str, method: int, formulation: str, tmp_path: Path) -> None:
    case = CASES[name]
    goes_on(case.make, 1.5, 0.73, tmp_path, dt_out=0.05, formulation=formulation, **case.methods[method])


@SOMETIMES
@pytest.mark.parametrize("name", CASES)
def test_the_exact_jacobian_is_that_of_differences(name: str) -> None:
    case = CASES[name]
    model = case.make().compile(merge=False)
    if case.at is None:
        for seed in (1, 4):
            assert largest_error(model, 0.7, moving(model, seed), step=3e-4, kinks=True) < 1e-6
        return
    run = Run(case.make(), t_end=case.at, dt_out=0.1, rtol=1e-8, model=model)
    run.advance(case.at)
    assert largest_error(model, case.at, np.array(run.core.state.values), step=3e-4, kinks=True) < 1e-6
