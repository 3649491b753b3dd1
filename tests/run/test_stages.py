"""Lifts in stages against closed forms, conservation laws, and one run without stages."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import line_scenes
import numpy as np
import pytest
from multibody_runs import masses, momentum
from numpy.testing import assert_allclose
from stage_scenes import HEIGHT, MASS, RATE, STIFFNESS, G, hoisting, lift_off, meeting, on_deck, swinging

from seacrane import (
    Curve,
    Method,
    Move,
    Result,
    SampledController,
    Scene,
    SceneError,
    SimulationError,
    Stage,
    State,
    Until,
    cases,
    simulate,
    summary,
)
from seacrane.arrays import Array
from seacrane.inputs.frames import rotation_matrix
from seacrane.run import StagedRun

TWO = [Stage(name="one", duration=2.0), Stage(name="two", duration=3.0)]


def carried_out(scene: Scene, stages: list[Stage], **settings: Any) -> StagedRun:
    run = StagedRun(scene, stages, **settings)
    while run.advance():
        pass
    return run


def height(result: Result, body: str = "load") -> Array:
    return result.select("position", body=body, axis="z")


@pytest.mark.parametrize("given", [{"formulation": "redundant"}, {"formulation": "recursive"},
                                   {"integrator": "rk4", "dt": 2.0**-7}])  # fmt: skip
def test_stages_that_change_nothing_are_a_run_that_went_on(given: dict[str, Any]) -> None:
    """To the bit; against a run that does not land on the stage's end to the tolerance."""
    scene, settings = swinging(), given | {"dt_out": 0.125}
    settings |= {} if "dt" in given else {"rtol": 1e-8}
    result, whole = simulate(scene, TWO, **settings), simulate(scene, 5.0, **settings)
    first = simulate(scene, 2.0, **settings)
    rest = simulate(scene, 5.0, start=first.state, **settings)
    for name, channel in result.items():
        assert np.array_equal(channel, np.concatenate([first[name], rest[name][1:]])), name
        assert "dt" not in given or np.array_equal(channel, whole[name]), name
    assert result.state == rest.state
    assert np.array_equal(result.time, whole.time)
    assert_allclose(result["position"], whole["position"], atol=1e-6)


@pytest.mark.warns("ThroughSeatWarning")
def test_deck_and_hook_carry_the_weight_and_the_load_leaves_when_the_hook_carries_it() -> None:
    """l0 = l / (1 + W / EA): the time follows from the winch's rate, which is reached by a quintic of 1 s."""
    result = simulate(on_deck(damping_ratio=0.0), lift_off(), rtol=1e-08)
    hook = result.select("line_tension", line="hoist")
    deck = result.select("limit_force", limit="on deck")
    seated = slice(0, result.stage("lift off").stop - 1)
    assert_allclose((hook + deck)[seated], MASS * G, rtol=1e-12)
    assert hook[0] == 0.0
    assert np.all(np.diff(hook[seated]) >= 0.0)
    paid = 20.1 - HEIGHT / (1.0 + MASS * G / STIFFNESS)
    span = result.stages[1]
    assert span.end - span.start == pytest.approx(0.5 + paid / RATE, abs=1e-6)
    assert span.ended_by == "'on deck' lets go"
    lifted = result.stage("lift off").stop - 1
    assert hook[lifted] == pytest.approx(MASS * G, rel=1e-6)
    assert deck[lifted + 1 :].max() == 0.0


@pytest.mark.warns("ThroughSeatWarning")
def test_a_load_that_is_let_go_falls_and_its_rope_takes_its_energy_along(tmp_path: Path) -> None:
    result = simulate(on_deck(), lift_off(), rtol=1e-08)
    fall = result.stage("let go")
    before = fall.start - 1
    t = result.time[fall] - result.time[before]
    speed = result.select("velocity", body="load", axis="z")[before]
    assert_allclose(height(result)[fall], height(result)[before] + speed * t - 0.5 * G * t**2, atol=1e-11)
    *_, released, fallen = result.events
    assert (fallen.name, fallen.kind) == ("on deck", "through")  # a seat holds nothing that comes back
    assert (released.name, released.kind, released.time) == ("hoist", "release", result.stages[-1].start)
    length, stretch = (result.select(channel, line="hoist")[before]
                       for channel in ("line_unstretched_length", "line_stretch"))  # fmt: skip
    assert released.energy_lost == pytest.approx(STIFFNESS * stretch**2 / (2.0 * length), rel=1e-9)
    assert result["impact_loss"][-1] == pytest.approx(released.energy_lost, rel=1e-12)
    assert np.all(result.select("line_tension", line="hoist")[fall] == 0.0)
    assert np.all(np.isnan(result.select("line_length", line="hoist")[fall]))
    assert np.max(np.abs(result["energy_balance"])) < 1e-6 * result["absolute_work"][-1]
    row = summary(result)["hoist tension hoist"]  # known, though the line is let go at last
    assert row.static_known and row.static == pytest.approx(MASS * G)
    assert row.factor is not None and row.factor > 1.0
    again = Result.load(result.save(tmp_path / "lift.nc"))
    assert (again.stages, again.events) == (result.stages, result.events)
    for name in result:
        assert np.array_equal(again[name], result[name], equal_nan=True), name
    wanted = ["position", "line_tension"]
    few = simulate(on_deck(), lift_off(), channels=wanted, method=Method(rtol=1e-05))
    assert set(few) == {*wanted, "line_unstretched_length"}  # which summaries need


@pytest.mark.parametrize("kind", ["weld", "spherical", "revolute"])
def test_a_connection_keeps_momentum_and_books_what_it_takes(kind: str, formulation: str) -> None:
    scene = meeting(kind)
    stages = [Stage(name="drift", duration=0.5), Stage(name="connected", duration=1.0, connect=["shackle"])]
    result = simulate(scene, stages, rtol=1e-10, formulation=formulation)
    linear, angular = momentum(scene, dict(result))
    assert_allclose(linear, np.broadcast_to(linear[0], linear.shape), atol=1e-9)
    assert_allclose(angular, np.broadcast_to(angular[0], angular.shape), atol=1e-9)
    (event,) = (event for event in result.events if event.kind == "connection")
    inertia = np.array([np.diag(body.inertia) for body in scene.bodies.values()])
    turn = np.array([[rotation_matrix(q) for q in row] for row in result["quaternion"]])
    spin = np.einsum("tbji,tbj->tbi", turn, result["angular_velocity"])
    moving = masses(scene) * np.sum(result["velocity"] ** 2, axis=-1) + np.sum(inertia * spin**2, axis=-1)
    energy = 0.5 * moving.sum(axis=1)
    joined = result.stage("connected")
    assert event.energy_lost > 0.05
    assert energy[0] - energy[joined] == pytest.approx(event.energy_lost, rel=1e-8)
    assert event.speed == pytest.approx(0.6, rel=1e-9)  # the largest of the rates at which it was off
    assert result["constraint_error"].max() < 1e-9
    assert np.all(result.select("reaction_force", joint="shackle")[: joined.start] == 0.0)


def falling(height: float = 10.0) -> Scene:
    scene = Scene(name="falling", gravity=G)
    scene.add_body(name="load", mass=3.0, inertia=(1.0, 1.0, 1.0), position=(0.0, 0.0, height))
    scene.add_joint(kind="free", name="above deck", first="ground", second="load", point=(0.0, 0.0, 0.0))
    scene.replace("above deck", second_frame=scene.joints["above deck"].first_frame)
    scene.add_stop(joint="above deck", coordinate="z", minimum=0.0, name="landing")
    return scene


@pytest.mark.parametrize("settings", [{"rtol": 1e-9}, {"integrator": "rk4", "dt": 0.013}])
def test_conditions_are_met_to_their_stated_error(settings: dict[str, Any]) -> None:
    below = Until.channel("position", body="load", axis="z", maximum=6.3)
    just_below = Until.channel("position", body="load", axis="z", maximum=6.25)
    slow = Until.channel("velocity", body="load", axis="z", maximum=-20.0)
    stages = [
        Stage(name="fall", until=[slow, just_below, below], maximum_duration=5.0),  # the first that is met
        Stage(name="land", until=Until.contact("landing"), maximum_duration=5.0),
        Stage(name="lie", duration=0.5),
    ]
    result = simulate(falling(), stages, **settings)
    passed, landed, _ = result.stages
    assert passed.end == pytest.approx(np.sqrt(2.0 * 3.7 / G), abs=2e-9)
    assert passed.ended_by == "position of 'z' of 'load' below 6.3 m"
    assert height(result)[result.stage("fall").stop - 1] == pytest.approx(6.3, abs=1e-8)
    assert landed.end == pytest.approx(np.sqrt(20.0 / G), abs=2e-6)
    assert_allclose(height(result)[result.stage("lie")], 0.0, atol=1e-9)
    assert [event.kind for event in result.events] == ["stage", "stage", "contact", "stage"]


def test_commands_go_on_smoothly_from_where_they_are() -> None:
    scene = Scene(name="jib", gravity=0.0)
    scene.add_body(name="jib", mass=10.0, inertia=(3.0, 3.0, 5.0), position=(1.0, 0.0, 0.0))
    scene.add_joint("slew", kind="revolute", first="ground", second="jib", point=(0, 0, 0), axis=(0, 0, 1))
    scene.add_driver(joint="slew", curve=Curve.constant(value=0.0), name="slew")
    scene.add_channel(joint="slew", name="slew")
    stages = [
        Stage(name="slew", duration=3.0, commands={"slew": Move(to=1.2, over=10.0)}),
        Stage(name="go back", duration=5.0, commands={"slew": Move(by=-0.5, over=4.0)}),
    ]
    with pytest.raises(SceneError, match=r"'follow': command 'slew' begins at 0 where it stands at -0\.\d+"):
        simulate(scene, [*stages, follow(0.0)])
    run = carried_out(scene, stages)
    start = run.begun["go back"].scene.drivers["slew"].curve.evaluate([3.0])[0]
    assert start[0] == pytest.approx(1.2 * (10 * 0.3**3 - 15 * 0.3**4 + 6 * 0.3**5), rel=1e-12)
    result = run.result()
    angle = result.select("coordinate", joint_coordinate="slew")
    assert_allclose(angle[result.time > 7.05], start[0] - 0.5, atol=1e-9)
    again = carried_out(scene, [*stages, follow(angle[-1])])
    curve = again.begun["follow"].scene.drivers["slew"].curve
    for time in (3.0, 7.0):
        assert_allclose(curve.evaluate([time - 1e-9])[0], curve.evaluate([time + 1e-9])[0], atol=1e-7)
    assert again.result().select("coordinate", joint_coordinate="slew")[-1] == pytest.approx(angle[-1] + 0.32)


def follow(start: float) -> Stage:
    quartic = Curve.pieces(starts=[0.0], coefficients=[[start, 0.0, 0.0, 0.04, 0.0, 0.0]])
    return Stage(name="follow", duration=2.0, commands={"slew": quartic})


@pytest.mark.parametrize("settings", [{"rtol": 1e-7}, {"rtol": 1e-5, "formulation": "redundant"},
                                      {"integrator": "rk4", "dt": 0.004}])  # fmt: skip
@pytest.mark.parametrize(("scene", "stages"), [(swinging, hoisting), (on_deck, lift_off)])
def test_a_stage_runs_again_from_its_start_to_the_bit(
    scene: Any, stages: Any, settings: Any, tmp_path: Path
) -> None:
    run = carried_out(scene(), stages(), **settings)
    whole = run.result()
    for place in range(len(stages())):
        name = stages()[place].name
        begin = run.begun[name]
        begin.scene.save(tmp_path / "stage.json")
        begin.state.save(tmp_path / "stage.state")
        again = carried_out(
            Scene.load(tmp_path / "stage.json"), stages()[place:], start=State.load(tmp_path / "stage.state"),
            outputs_from=0.0, **settings,
        )  # fmt: skip
        assert again.state.time == whole.state.time
        assert np.array_equal(again.state.values, whole.state.values)
        rest = again.result()
        assert rest.stages == whole.stages[place:]
        for channel in ("position", "energy_balance", "impact_loss"):
            if channel in whole:
                there = whole[channel][whole.stage(name)]
                assert np.array_equal(rest[channel][rest.stage(name)][-len(there) + 1 :], there[1:]), channel


def test_a_ship_in_waves_does_not_notice_that_its_cargo_is_fastened_anew() -> None:
    """Released and connected by another joint at the same place, while the ship is away from its mean."""
    scene = cases.vessel(count=20)
    place = np.add(scene.bodies["vessel"].position, (10.0, 3.0, 12.0))
    scene.add_body(name="cargo", mass=4e5, inertia=(1e6, 1e6, 1e6), position=place)
    for name in ("bolts", "lashings"):
        scene.add_joint(kind="weld", name=name, first="vessel", second="cargo")
    stages = [Stage(name="bolted", duration=12.0),
              Stage(name="lashed", duration=8.0, release=["bolts"], connect=["lashings"])]  # fmt: skip
    settings = {"rtol": 1e-8, "dt_out": 0.5}
    result = simulate(scene, stages, **settings)
    scene.remove("lashings")
    whole = simulate(scene, 20.0, **settings)
    assert np.ptp(whole["vessel_motion"][:, 2]) > 0.1
    assert_allclose(result["vessel_motion"], whole["vessel_motion"], atol=1e-6)
    forces = (result.select("reaction_force", joint=name) for name in ("bolts", "lashings"))
    assert_allclose(sum(forces), whole.select("reaction_force", joint="bolts"), rtol=1e-4, atol=10.0)
    assert abs(result.events[-1].energy_lost) < 1e-3


def test_every_kind_of_method_carries_out_stages() -> None:
    exact = carried_out(swinging(), hoisting(), rtol=1e-9)
    for near, settings in (
        (1e-6, {"rtol": 1e-9, "formulation": "redundant"}), (1e-3, {"integrator": "cvode-bdf", "rtol": 1e-8}),
        (1e-3, {"integrator": "generalized-alpha", "dt": 1e-3}),
    ):  # fmt: skip
        run = carried_out(swinging(), hoisting(), **settings)
        assert run.state.time == pytest.approx(exact.state.time, abs=0.1 * near)
        assert_allclose(run.result()["position"][-1], exact.result()["position"][-1], atol=near)


def test_ctrl_c_while_a_condition_is_located_keeps_what_was_recorded(monkeypatch: Any) -> None:
    def pressed(*_: Any) -> Any:
        raise KeyboardInterrupt

    monkeypatch.setattr("seacrane.run.locate.Course.tried", pressed)
    run = StagedRun(swinging(), [TWO[0], *hoisting()])
    assert run.advance() and not run.advance()
    result = run.result()
    assert run.interrupted and result.interrupted
    assert result.time[-1] == pytest.approx(2.0, abs=0.1)
    assert [span.ended_by for span in result.stages] == ["duration", ""]


WIND = "hoist.rate"
HOLD, ONE, LONG = {"name": "hold", "duration": 1e6}, {"duration": 1.0}, {"maximum_duration": 10.0}
FREE = {"until": Until.release("on deck")}


@pytest.mark.parametrize(
    ("stages", "message"),
    [
        ([{}], "'wait'.* duration"), ([FREE | ONE], "a duration and until"),
        ([FREE], "'wait'.* maximum_duration"),
        ([LONG | {"until": Until.contact("on deck")}], "never end: seat 'on deck'"),
        ([HOLD, ONE | {"commands": {WIND: -0.6}}], "'hoist.rate' reaches 0.6 m/s, .*maximum_rate of 0.5"),
        ([HOLD, ONE | {"commands": {WIND: Move(to=0.7, over=3.0)}}], "reaches 0.7 m/s"),
        ([ONE, ONE], "'wait'.*twice"), ([ONE | {"release": ["sling"]}], "releases: .*no 'sling'"),
        ([ONE | {"name": "a", "release": ["hoist"]}, ONE | {"release": ["hoist"]}], "releases 'hoist'"),
        ([ONE | {"name": "a", "commands": {WIND: 0.1}}, ONE | {"connect": ["hoist"]}], "'a' commands 'hoist"),
    ],
)  # fmt: skip
def test_stages_that_contradict_themselves_the_scene_or_each_other_are_told(
    stages: Any, message: str
) -> None:
    """What a winch never does, before any stage is run."""
    scene = on_deck()
    scene.replace("hoist", kind="load", maximum_rate=0.5, minimum_length=2.0)
    with pytest.raises(SceneError, match=message):
        simulate(scene, [Stage(**{"name": "wait"} | given) for given in stages])


def test_a_winch_at_its_limits_is_carried_out() -> None:
    scene = on_deck()
    scene.replace("hoist", kind="load", maximum_rate=0.5, minimum_length=18.9)
    shorter = Until.length("hoist", maximum=19.0)
    stages = [Stage(name="haul", until=shorter, maximum_duration=9.0, commands={WIND: -0.5})]
    result = simulate(scene, stages, dt_out=0.1, rtol=0.0001)
    assert result["line_unstretched_length"][-1, 0] == pytest.approx(19.0, abs=1e-6)


def test_a_stage_that_fails_is_told_with_what_was_recorded() -> None:
    stages = [Stage(name="drift", duration=0.2), Stage(name="join", duration=1.0, connect=["shackle"])]
    with pytest.raises(SceneError, match=r"'join': .*'shackle' is open by 0.18 .* at t = 0\.2 s") as apart:
        simulate(meeting(), stages)
    result: Any = apart.value.result
    assert result.time[-1] == 0.2 and result.interrupted
    deep = Until.channel("position", body="load", axis="z", maximum=-1.0)
    stages = [Stage(name="drop", until=deep, maximum_duration=3.0), Stage(name="rest", duration=1.0)]
    with pytest.raises(SimulationError, match=r"'drop': .*maximum_duration of 3 s") as late:
        simulate(falling(), stages)
    result = late.value.result
    assert result.time[-1] == 3.0 and result.stages[0].ended_by == ""


def test_a_file_holds_stages_that_are_over_when_the_process_ends(tmp_path: Path, monkeypatch: Any) -> None:
    path, states, saved = tmp_path / "lift.nc", [], Result.save

    def save(result: Result, to: Path) -> Path:
        states.append(([span.name for span in result.stages], result.interrupted))
        return saved(result, to)

    monkeypatch.setattr(Result, "save", save)
    written = simulate(on_deck(), lift_off()[:3], to=path, dt_out=0.25)
    assert states == [(["hold"], True), (["hold", "lift off"], True), (["hold", "lift off", "raise"], False)]
    kept = simulate(on_deck(), lift_off()[:3], dt_out=0.25)
    assert written.outputs == kept.time.size
    np.testing.assert_array_equal(written.load()["position"], kept["position"])
    with pytest.raises(FileExistsError, match=r"lift.nc is there"):
        simulate(on_deck(), lift_off(), to=path)
    hold, off = lift_off()[:2]
    short = Stage(name="lift off", until=off.until, maximum_duration=0.5, commands=off.commands)
    with pytest.raises(SimulationError, match=r"'lift off'.*maximum_duration"):
        simulate(on_deck(), [hold, short], to=path, dt_out=0.25, overwrite=True)
    kept = Result.load(path)
    assert kept.interrupted and [span.name for span in kept.stages] == ["hold", "lift off"]
    assert kept.time[-1] == pytest.approx(1.55)


def motored() -> Scene:
    """A bob on a motor, in no gravity: torque 1 N m gives 0.5 rad/s2."""
    scene = Scene(name="motored", gravity=0.0)
    scene.add_body(name="bob", mass=1.0, inertia=(1.0, 1.0, 1.0), position=(1.0, 0.0, 0.0))
    scene.add_joint("pin", kind="revolute", first="ground", second="bob", point=(0, 0, 0), axis=(0, 1, 0))
    scene.add_channel(joint="pin", name="angle")
    scene.add_actuator(name="motor", joint="pin")
    return scene


def noted(calls: list[float], period: float = 0.1) -> SampledController:
    """A torque that depends on how often it was called, which a second call would change."""

    def function(now: float, measured: Any) -> dict[str, float]:
        calls.append(now)
        return {"motor.force": 1.0 + 0.1 * len(calls)}

    return SampledController(period=period, function=function)


def test_a_controller_goes_on_through_stages_as_in_one_run() -> None:
    """And where a stage is run again, at the same times."""
    how = {"integrator": "rk4", "dt": 0.01, "dt_out": 0.05}
    once = []
    whole = simulate(motored(), 1.0, controllers=[noted(once)], **how)
    calls = []
    stages = [Stage(name="one", duration=0.37), Stage(name="two", duration=0.63)]
    run = carried_out(motored(), stages, controllers=[noted(calls)], **how)
    result = run.result()
    assert_allclose(calls, once, atol=1e-12)
    shared = np.isin(result.time.round(9), whole.time.round(9))
    assert_allclose(result["position"][shared], whole["position"], atol=1e-11)
    begin, again = run.begun["two"], calls[:4]
    given = {"start": begin.state, "outputs_from": 0.0, "controllers": [noted(again)], **how}
    other = carried_out(begin.scene, stages[1:], **given)
    assert again == calls
    np.testing.assert_array_equal(other.state.values, run.state.values)


@pytest.mark.parametrize("period", [0.03, 0.4])
def test_a_condition_is_located_without_calling_controllers_twice(period: float) -> None:
    """The bob turns by a staircase of torques; the angle at the end is the condition's."""
    calls = []
    until = Until.channel("coordinate", joint_coordinate="angle", minimum=0.2)
    stages = [Stage(name="turn", until=until, maximum_duration=5.0), Stage(name="go on", duration=0.5)]
    result = simulate(motored(), stages, controllers=[noted(calls, period)], rtol=1e-10, dt_out=0.17)
    end = result.stages[0].end
    angle, rate, at = 0.0, 0.0, 0.0
    for i, time in enumerate([*calls[1:], np.inf]):
        pull = 0.5 * (1.0 + 0.1 * (i + 1))
        span = min(time, end) - at
        angle, rate, at = angle + rate * span + 0.5 * pull * span**2, rate + pull * span, min(time, end)
        if at == end:
            break
    assert angle == pytest.approx(0.2, abs=1e-7)
    assert_allclose(np.diff(calls), period, rtol=1e-9)
    assert calls[-1] < result.time[-1] <= calls[-1] + period + 1e-9
    assert result.stages[0].ended_by.startswith("coordinate of 'angle' above 0.2")


def test_inputs_of_what_is_absent_are_left_out() -> None:
    scene = motored()
    scene.add_force("bob", name="push", force=(0.0, 0.0, 0.0))
    seen = []

    def function(now: float, measured: Any) -> dict[str, Any]:
        seen.append(now)
        return {"push.force": (0.0, 0.0, 1.0)}

    stages = [Stage(name="alone", duration=0.5), Stage(name="pushed", duration=0.5, connect=["push"])]
    pushed = SampledController(period=0.25, function=function)
    result = simulate(scene, stages, controllers=[pushed], dt_out=0.25, rtol=1e-09)
    assert seen == [0.0, 0.25, 0.5, 0.75]
    turned = result.select("coordinate", joint_coordinate="angle")
    assert turned[2] == 0.0 and abs(turned[-1]) == pytest.approx(0.5 * 0.5 * 0.5**2, rel=1e-3)


IGNORED = pytest.mark.filterwarnings("ignore")


@IGNORED
def test_bounds_of_a_winch_are_events_without_impacts(tmp_path: Path) -> None:
    """A motor that cannot hold its load reaches a bound, and the scene knows no impact."""
    scene = line_scenes.hung(damping=0.1)
    most = 0.9 * line_scenes.MASS * G
    scene.add_winch(line="hoist", drum_inertia=1e3, drum_radius=0.5, lag=0.2, maximum_tension=most)
    for end in (1.0, 1.5):  # counted over a resumption
        done = simulate(scene, end, to=tmp_path / "again.nc", resume=end > 1.0)
        assert done.stats["events"] == len(done.load().events) > 0
    assert done.load().events[0].kind == "limit"


@IGNORED
def test_stages_that_are_met_at_once_have_one_output(tmp_path: Path) -> None:
    longer = Until.length("hoist", minimum=1.0)
    at_once = Stage(name="look", until=longer, maximum_duration=5.0)
    whole = simulate(on_deck(), [at_once], dt_out=0.1)
    assert whole.time.tolist() == [0.0]
    assert [(span.start, span.end, span.ended_by[:5]) for span in whole.stages] == [(0.0, 0.0, "line_")]
    assert whole["position"][0, 0, 2] == 1.0
    path, hold = tmp_path / "lift.nc", Stage(name="hold", duration=0.5)
    gone_on = simulate(on_deck(), [at_once, hold], to=path, dt_out=0.1).load()
    plain = simulate(on_deck(), [hold], dt_out=0.1)
    assert gone_on.time.tolist() == plain.time.tolist() == Result.load(path).time.tolist()
    assert (gone_on["position"] == plain["position"]).all()
    assert [event.kind for event in gone_on.events] == ["stage", "stage"]


@IGNORED
@pytest.mark.parametrize("lies", [1.0, 0.3])
def test_impacts_of_all_stages_are_counted(lies: float) -> None:
    """m g h of the fall, also where the last stage has another model and no impact."""
    scene = falling(2.0)
    scene.add_body(name="other", mass=1.0, inertia=(1.0, 1.0, 1.0), position=(9.0, 0.0, 0.0))
    scene.add_joint(kind="weld", name="lashing", first="ground", second="other", point=(9.0, 0.0, 0.0))
    stages = [Stage(name="fall", duration=1.0), Stage(name="let go", duration=lies, release=["lashing"])]
    result = simulate(scene, stages, dt_out=0.1)
    fallen = 3.0 * G * 2.0
    assert result.stats["impact_energy_lost_J"] == pytest.approx(fallen, rel=1e-6)
