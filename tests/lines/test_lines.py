"""Elastic lines and winches against closed forms, their own equations, energy, and the other formulation."""

from __future__ import annotations

import pickle
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from line_scenes import MASS, STIFFNESS, G, hung, on_deck, reeved, swinging
from multibody_runs import record
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from seacrane import (
    Curve,
    Result,
    Run,
    Scene,
    SceneError,
    State,
    equilibrium,
    integrator_names,
    linear_model,
    natural_modes,
    simulate,
)
from seacrane.analysis import Evaluator
from seacrane.description.outline import outline_of
from seacrane.pictures.wires import wires_of
from seacrane.warnings import LineLengthWarning, WinchLimitWarning

Array = NDArray[np.float64]
OMEGA = np.sqrt(STIFFNESS / MASS)


def test_a_load_on_a_line_swings_up_and_down_by_k_over_m() -> None:
    scene = hung(velocity=(0.0, 0.0, 0.05))
    out = record(scene, 3.0, rtol=1e-10)
    heave = out["position"][:, 0, 2] - scene.bodies["load"].position[2]
    assert_allclose(heave, 0.05 / OMEGA * np.sin(OMEGA * out["time"]), atol=1e-9)
    assert_allclose(out["line_tension"][:, 0], MASS * G - STIFFNESS * heave, rtol=1e-8)


@pytest.mark.parametrize("falls", [2, 3, 6])
def test_falls_divide_the_tension_and_stiffen_by_their_square(falls: int) -> None:
    """EA / L of n falls is k / n^2 along the line, and n^2 times that at the hook."""
    scene = hung(falls=falls, velocity=(0.0, 0.0, 0.02))
    out = record(scene, 1.0, rtol=1e-10)
    heave = out["position"][:, 0, 2] - scene.bodies["load"].position[2]
    assert_allclose(heave, 0.02 / OMEGA * np.sin(OMEGA * out["time"]), atol=1e-9)
    assert_allclose(falls * out["line_tension"][:, 0], MASS * G - STIFFNESS * heave, rtol=1e-8)
    assert_allclose(out["line_length"][:, 0], -falls * out["position"][:, 0, 2], rtol=1e-12)


def test_damping_is_the_fraction_of_critical_damping() -> None:
    for falls in (1, 4):
        modes = natural_modes(hung(falls=falls, damping=0.05))
        heave = int(np.argmin(np.abs(modes.natural_period - 2.0 * np.pi / OMEGA)))
        assert modes.damping_ratio[heave] == pytest.approx(0.05, rel=1e-6)
        assert modes.natural_period[heave] == pytest.approx(2.0 * np.pi / OMEGA, rel=1e-6)


def test_a_step_of_the_hoisting_rate_peaks_at_weight_and_v_root_k_m() -> None:
    """On a line so long that its stiffness stays: 441 kN for 20 t, 3 MN/m and 1 m/s."""
    scene = hung(length=2000.0)
    scene.add_winch(line="hoist", rate=-1.0)
    out = record(scene, 1.0, dt_out=1e-3, rtol=1e-9)
    peak = float(np.max(out["line_tension"]))
    assert peak == pytest.approx(MASS * G + np.sqrt(STIFFNESS * MASS), rel=2e-4)
    assert peak == pytest.approx(441e3, abs=0.5e3)


def test_a_snatch_peaks_at_its_closed_form() -> None:
    """A load that meets the end of its slack line at 1 m/s: 510 kN."""
    slack, speed, weight = 0.02, 1.0, MASS * G
    scene = hung(stretch=-slack, velocity=(0.0, 0.0, -np.sqrt(speed**2 - 2.0 * G * slack)))
    out = record(scene, 0.6, dt_out=2e-4, rtol=1e-9)
    expected = weight + np.sqrt(weight**2 + STIFFNESS * MASS * speed**2)
    assert float(np.max(out["line_tension"])) == pytest.approx(expected, rel=1e-6)
    assert expected == pytest.approx(510e3, abs=0.5e3)
    assert np.all(out["line_tension"][out["time"] < 0.02] == 0.0)
    assert np.all((out["line_tension"][:, 0] > 0.0) == (out["line_stretch"][:, 0] > 0.0))


@pytest.mark.warns("LiftedStartWarning")
def test_the_order_is_kept_where_a_line_goes_slack_and_taut() -> None:
    """The crossings are located: errors fall with the tolerance, not with the step that met the kink."""
    scene = hung(damping=0.02, stretch=0.3)
    end = [record(scene, 4.0, rtol=rtol, dt_out=4.0)["position"][-1, 0, 2] for rtol in (1e-11, 1e-8, 1e-5)]
    out = record(scene, 4.0, rtol=1e-8)
    assert np.ptp(np.sign(out["line_stretch"])) == 2.0  # it is slack now and then
    assert abs(end[1] - end[0]) < 1e-6
    assert abs(end[2] - end[0]) < 1e-3


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
    bound = line.maximum_acceleration
    gravity = np.array([0.0, 0.0, -G])
    change = np.clip((command - rate) / line.lag, -bound, bound)
    return np.concatenate([velocity, gravity - tension / mass * along, [rate, change]])


def test_a_pendulum_on_a_winch_follows_its_own_equations() -> None:
    """Solved by SciPy from the equations of a point on an elastic line of variable length."""
    scene = swinging(maximum_rate=0.5, maximum_acceleration=0.7)
    scene.replace("hoist", points=np.zeros((2, 3)), length=8.5)
    body = scene.bodies["load"]
    start = np.concatenate([body.position, body.velocity, [8.5, 0.0]])
    times = np.linspace(0.0, 5.0, 51)
    expected = solve_ivp(
        pendulum, (0.0, 5.0), start, t_eval=times, args=(scene,), rtol=1e-11, atol=1e-12, max_step=2e-3
    ).y.T
    out = record(scene, 5.0, dt_out=0.1, rtol=1e-9)
    assert_allclose(out["position"][:, 0], expected[:, :3], atol=2e-7)
    assert_allclose(out["load_state"], expected[:, 6:], atol=1e-8)
    assert_allclose(out["line_pay_out_rate"][:, 0], expected[:, 7], atol=1e-8)


def test_the_winch_keeps_its_bounds() -> None:
    """A jump of the command by 2 m/s: the acceleration's bound until the lag takes over, then the rate's."""
    scene = hung(damping=0.02)
    jump = Curve.constant(value=0.0).then(time=1.0, curve=Curve.constant(value=2.0))
    scene.add_winch(line="hoist", rate=jump, maximum_rate=0.8, maximum_acceleration=0.5, lag=0.4)
    out = record(scene, 4.0, rtol=1e-9)
    t, (length, rate) = out["time"], out["load_state"].T
    ramped = 0.5 * np.clip(t - 1.0, 0.0, None)
    corner = 1.0 + (0.8 - 0.5 * 0.4) / 0.5
    expected = np.where(t < corner, ramped, 0.8 - 0.2 * np.exp(-(t - corner) / 0.4))
    assert_allclose(rate, expected, atol=1e-6)
    paid_out = np.cumsum(0.5 * np.diff(t) * (expected[1:] + expected[:-1]))
    assert_allclose(length[1:], 10.0 + paid_out, atol=5e-4)
    assert_allclose(out["line_unstretched_length"][:, 0], length, rtol=1e-14)


def test_hauling_in_stops_at_the_minimum_length() -> None:
    scene = hung(length=3.0, damping=0.05)
    scene.add_winch(line="hoist", rate=-0.5, minimum_length=2.0)
    out = record(scene, 4.0, rtol=1e-8)
    assert_allclose(out["load_state"][:, 0], np.maximum(3.0 - 0.5 * out["time"], 2.0), atol=1e-7)
    assert_allclose(out["line_pay_out_rate"][out["time"] > 2.05], 0.0)


@pytest.mark.warns("LiftedStartWarning")
@pytest.mark.parametrize("formulation", ["redundant", "recursive"])
@pytest.mark.parametrize("make", [swinging, reeved])
def test_the_energy_balance_closes(make: Any, formulation: str) -> None:
    out = record(make(), 6.0, rtol=1e-8, formulation=formulation)
    assert out["absolute_work"][-1] > 1e3
    assert np.max(np.abs(out["energy_balance"])) < 1e-6 * out["absolute_work"][-1]


def test_the_winch_lifts_by_its_power() -> None:
    """Slow hauling in: its work is the weight times the rise, and the rope's strain energy it takes."""
    scene = hung(damping=0.2)
    haul = Curve.quintic(start_time=0.5, end_time=20.0, start=0.0, end=-0.4)
    scene.add_winch(line="hoist", rate=haul)
    out = record(scene, 20.0, dt_out=0.01, rtol=1e-9)
    work = np.trapezoid(out["line_winch_power"][:, 0], out["time"])
    rise = out["position"][-1, 0, 2] - out["position"][0, 0, 2]
    tension, l0 = out["line_tension"][:, 0], out["line_unstretched_length"][:, 0]
    stored = tension**2 * l0 / (2.0 * STIFFNESS * 10.0)
    moving = 0.5 * MASS * out["velocity"][-1, 0, 2] ** 2
    assert work == pytest.approx(MASS * G * rise + stored[-1] - stored[0] + moving, rel=2e-4)


@pytest.mark.warns("LiftedStartWarning")
@pytest.mark.parametrize("make", [swinging, reeved])
def test_both_formulations_and_merged_bodies_agree(make: Any) -> None:
    scene = make()
    runs = [record(scene, 4.0, rtol=1e-10, formulation=name) for name in ("redundant", "recursive")]
    unmerged = Run(scene, t_end=4.0, dt_out=0.05, rtol=1e-10, model=scene.compile(merge=False))
    unmerged.advance(4.0)
    runs.append(dict(unmerged.core.channels()))
    for other in runs[1:]:
        assert_allclose(other["position"], runs[0]["position"], atol=1e-7)
        assert_allclose(other["load_state"], runs[0]["load_state"], atol=1e-7)
        assert_allclose(other["line_tension"], runs[0]["line_tension"], atol=2e-1)


@pytest.mark.warns("LiftedStartWarning")
def test_every_integrator_takes_states_and_converges() -> None:
    exact = record(reeved(), 1.0, rtol=1e-11, dt_out=1.0)
    for name in integrator_names():
        settings: dict[str, Any] = {"integrator": name}
        stepped = name in ("rk4", "semi-implicit-euler", "generalized-alpha", "rk-low-storage")
        settings |= {"dt": 2e-4} if stepped else {"rtol": 1e-8}
        try:
            run = Run(reeved(), t_end=1.0, dt_out=1.0, **settings)
        except (SceneError, TypeError, ValueError) as error:
            pytest.fail(f"{name}: {error}")
        run.advance(1.0)
        out = run.core.channels()
        rough = 2e-3 if name == "semi-implicit-euler" else 2e-5
        assert_allclose(out["position"][-1], exact["position"][-1], atol=rough, err_msg=name)
        assert_allclose(out["load_state"][-1], exact["load_state"][-1], atol=rough, err_msg=name)


@pytest.mark.warns("LiftedStartWarning")
@pytest.mark.parametrize("formulation", ["redundant", "recursive"])
@pytest.mark.parametrize(
    "settings", [{"integrator": "dopri5", "rtol": 1e-7}, {"integrator": "rk4", "dt": 2e-3},
                 {"integrator": "rosenbrock", "rtol": 1e-5}],
)  # fmt: skip
def test_a_run_goes_on_bit_for_bit(settings: dict[str, Any], formulation: str, tmp_path: Path) -> None:
    whole = Run(reeved(), t_end=1.5, dt_out=0.05, formulation=formulation, **settings)
    whole.advance(0.73)
    whole.core.state.save(tmp_path / "half.state")
    whole.advance(1.5)
    start = State.load(tmp_path / "half.state", scene=reeved())
    rest = Run(reeved(), t_end=1.5, dt_out=0.05, start=start, formulation=formulation, **settings)
    rest.advance(1.5)
    assert np.array_equal(rest.core.state.values, whole.core.state.values)


@pytest.mark.warns("LiftedStartWarning")
def test_the_exact_jacobian_is_that_of_differences() -> None:
    scene = reeved()
    model = scene.compile(merge=False)
    run = Run(scene, t_end=0.9, dt_out=0.1, rtol=1e-8, model=model)
    run.advance(0.9)
    y = np.array(run.core.state.values)
    at = Evaluator(model)
    exact = np.asarray(at.jacobian(0.9, y))
    states = [place for _, _, place, *_ in model.load_states]
    for j in [*states, 0, 7, 14, model.twist_index(0)]:
        step = np.zeros_like(y)
        step[j] = 1e-5
        near, far = ((at.derivative(0.9, y + k * step) - at.derivative(0.9, y - k * step)) / (2e-5 * k)
                     for k in (1.0, 2.0))  # fmt: skip
        expected = (4.0 * near - far) / 3.0
        assert_allclose(exact[:, j], expected, atol=1e-6 * np.max(np.abs(exact)), rtol=1e-6)


@pytest.mark.warns("LiftedStartWarning")
def test_states_are_named_read_and_set(tmp_path: Path) -> None:
    scene = swinging()
    result = simulate(scene, 1.0, dt_out=0.1)
    state = result.state
    assert list(state.load_states) == ["hoist.length", "hoist.rate"]
    assert state.load_states["hoist.length"] == result["load_state"][-1, 0]
    other = state.with_load_states({"hoist.rate": -0.25})
    assert other.load_states == state.load_states | {"hoist.rate": -0.25}
    assert simulate(scene, 1.5, start=other, dt_out=0.1)["line_pay_out_rate"][0, 0] == -0.25
    with pytest.raises(
        SceneError, match=r"no load state 'hoist.speed'; this one has hoist.length, hoist.rate"
    ):
        state.with_load_states({"hoist.speed": 1.0})
    assert pickle.loads(pickle.dumps(state)).load_states == state.load_states
    state.save(tmp_path / "a.state")
    assert State.load(tmp_path / "a.state", scene=scene).load_states == state.load_states
    with pytest.raises(SceneError, match=r"state 'hoist.length' where this scene has"):
        simulate(hung(), 1.5, start=state)


@pytest.mark.parametrize("formulation", ["redundant", "recursive"])
def test_a_winch_lifts_a_load_off_its_stop(formulation: str) -> None:
    """It takes the weight over while the line stretches; the load leaves when the line carries all of it."""
    result = simulate(on_deck(), 3.0, dt_out=0.01, rtol=1e-8, formulation=formulation)
    assert [event.kind for event in result.events] == ["contact", "release"]
    lift_off = result.events[1].time
    # Hauled in by 0.2 (t - 0.2 (1 - exp(-t / 0.2))) m: slack, then the stretch under the weight.
    hauled = 0.2 * (lift_off - 0.2 * (1.0 - np.exp(-lift_off / 0.2)))
    pulled = 2e6 * (10.0 / (10.05 - hauled) - 1.0)
    damping = 2.0 * 0.02 * np.sqrt(2e6 * 2e3 / 10.0) * 0.2
    assert pulled + damping == pytest.approx(2e3 * G, rel=1e-2)
    carried = result["line_tension"][:, 0] + result["limit_force"][:, 0]
    assert_allclose(carried[result.time < lift_off], 2e3 * G, rtol=1e-9)
    assert np.max(np.abs(result["energy_balance"])) < 1e-6 * result["absolute_work"][-1]


def test_a_file_holds_the_states(tmp_path: Path) -> None:
    result = simulate(on_deck(), 0.5, dt_out=0.1)
    result.save(tmp_path / "lift.nc")
    again = Result.load(tmp_path / "lift.nc")
    assert_allclose(again["load_state"], result["load_state"], rtol=0.0)
    assert list(again.coords["state_name"]) == ["hoist.length", "hoist.rate"]
    assert again.state.load_states == result.state.load_states


def test_an_input_adds_to_the_winchs_command() -> None:
    scene = hung(damping=0.1)
    scene.add_winch(line="hoist", rate=0.1)
    run = Run(scene, t_end=1.0, dt_out=0.1)
    run.advance(0.5)
    run.core.set_inputs([0.2])
    run.advance(1.0)
    assert run.core.state.load_states["hoist.length"] == pytest.approx(10.0 + 0.5 * 0.1 + 0.5 * 0.3, abs=1e-9)


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


def test_kinks_of_a_command_are_stops() -> None:
    for lag in (0.0, 0.3):
        scene = hung(damping=0.1)
        jump = Curve.constant(value=0.0).then(time=0.7, curve=Curve.constant(value=0.5))
        scene.add_winch(line="hoist", rate=jump, lag=lag)
        assert scene.compile().breakpoints == [0.7]
    lengths = Curve.constant(value=10.0).then(time=0.4, curve=Curve.constant(value=10.01))
    scene = hung()
    scene.replace("hoist", length=lengths)
    assert scene.compile().breakpoints == [0.4]


@pytest.mark.warns("LiftedStartWarning")
def test_a_length_that_contradicts_the_path_is_told() -> None:
    with pytest.warns(
        LineLengthWarning, match=r"line 'hoist': starts stretched by 0.3 m, 0.03 of its unstr.* 10 m"
    ):
        result = simulate(hung(stretch=0.3), 0.1, dt_out=0.1)
    assert "starts stretched" in result.stats["validity"]
    with pytest.warns(LineLengthWarning, match=r"starts slack by 0\.2 m"):
        simulate(hung(stretch=-0.2), 0.1, dt_out=0.1)


def test_a_winch_that_met_its_limits_is_told() -> None:
    scene = hung(length=3.0, damping=0.05, stretch=0.02)
    scene.add_winch(line="hoist", rate=-0.5, maximum_rate=0.4, minimum_length=2.9)
    with pytest.warns(WinchLimitWarning) as told:
        simulate(scene, 0.5, dt_out=0.05)
    assert [str(one.message).split(": ")[1][:23] for one in told] == [
        "its winch has hauled in", "its winch is commanded ",
    ]  # fmt: skip
    assert "2.9 m, at t = 0.25 s" in str(told[0].message)
    assert "commanded 0.5 m/s at t = 0 s, beyond its maximum_rate of 0.4 m/s" in str(told[1].message)


def test_files_hold_lines(tmp_path: Path) -> None:
    scene = reeved()
    scene.save(tmp_path / "scene.json")
    again = Scene.load(tmp_path / "scene.json")
    assert again == scene and again.loads["hoist"].bodies == ["ground", "cleat", "load", "cleat"]
    assert dict(scene.report()["elements"])["lines"] == [
        "hoist (ground to cleat to load to cleat)", "tugger (ground to load)",
    ]  # fmt: skip
    with pytest.raises(SceneError, match=r"load 'hoist'.* refer to it"):
        scene.remove("cleat")


def bad(**change: Any) -> Scene:
    scene = hung()
    scene.replace("hoist", **change)
    return scene


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"EA": 0.0}, "EA is 0 N; it must be positive"),
        ({"length": 0.0}, "length is 0 m at t = 0 s; it must be positive"),
        ({"length": -1.0}, "length is -1 m"),
        ({"damping_ratio": -0.1}, "damping_ratio is -0.1; it must not be negative"),
        ({"bodies": ["ground"]}, "has 1 bodies and 2 points; give as many of both, at least two"),
        ({"bodies": ["load", "load"], "points": [(0, 0, 0), (1, 0, 0)]}, "has all its points on 'load'"),
        (
            {"bodies": ["ground", "ground", "load"], "points": np.zeros((3, 3))},
            "visits point 1 twice in a row; leave one of them out",
        ),
        ({"bodies": ["ground", "hook"]}, "there is no body 'hook'; add it first"),
        ({"lag": 0.1}, "has a rate or a lag, and no winch"),
    ],
)
def test_lines_that_cannot_be_are_told(change: dict[str, Any], message: str) -> None:
    with pytest.raises(SceneError, match=f"line 'hoist': .*{message}"):
        bad(**change).compile()


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"maximum_rate": 0.0}, "maximum_rate is 0 m/s; it must be positive"),
        ({"maximum_acceleration": 0.5}, "maximum_acceleration needs a lag"),
        ({"lag": -1.0}, "lag is -1 s; it must not be negative"),
        ({"minimum_length": 11.0}, "starts with a length of 10 m and a minimum_length of 11 m"),
    ],
)
def test_winches_that_cannot_be_are_told(given: dict[str, Any], message: str) -> None:
    scene = hung()
    scene.add_winch(line="hoist", **given)
    with pytest.raises(SceneError, match=f"line 'hoist': {message}"):
        scene.compile()


def test_a_winch_needs_a_line_of_its_own() -> None:
    scene = hung()
    with pytest.raises(SceneError, match="there is no line 'rope'; the scene has hoist"):
        scene.add_winch(line="rope")
    scene.add_winch(line="hoist")
    with pytest.raises(SceneError, match="has a winch already"):
        scene.add_winch(line="hoist")
    scene.replace("hoist", length=Curve.quintic(start_time=0.0, end_time=1.0, start=10.0, end=9.0))
    with pytest.raises(SceneError, match="length changes over time, and the winch does that"):
        scene.compile()


def test_a_path_is_drawn_span_by_span() -> None:
    scene = reeved()
    names = [wire["name"] for wire in wires_of(scene, list(scene.bodies))]
    assert names == ["hoist 1", "hoist 2", "hoist 3", "tugger 1"]
    ends = [(link[0], link[2]) for link in outline_of(scene)["links"]]
    assert ends[:3] == list(pairwise(["ground", "cleat", "load", "cleat"]))
