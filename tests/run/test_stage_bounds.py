"""What is met as a stage begins, and where the stages before one leave it; random lifts begun anew."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from random_staged_lifts import BED, HALF, MASS, hanging, random_stages
from stage_scenes import MASS as DECK_MASS
from stage_scenes import G, heaving, lift_off, on_deck
from test_stages import motored, noted

from seacrane import Result, Scene, SceneError, SimulationError, Stage, Until, simulate
from seacrane.run import StagedRun

DOWN, UP, STOP = ({"wire.rate": rate} for rate in (0.4, -0.4, 0.0))
HOW = {"rtol": 1e-6, "dt_out": 0.1}
LYING = BED + HALF  # m


def carried_out(scene: Scene, *stages: Stage) -> Result:
    """All that was recorded, also where the last stage is not over in time."""
    try:
        return simulate(scene, stages, **HOW)
    except SimulationError as error:
        return error.result


def until(condition: Any, commands: dict[str, float], name: str, longest: float = 60.0) -> Stage:
    return Stage(name=name, until=condition, maximum_duration=longest, commands=commands)


HIGH = {"channel": "position", "body": "load", "axis": "z"}
GAP = {"channel": "contact_least_gap", "contact": "feet"}
PAIRS: dict[str, tuple[Any, Any, dict[str, float], dict[str, float]]] = {
    "contact": (Until.contact("feet"), Until.release("feet"), DOWN, UP),
    "depth": (Until.depth("load", minimum=3.0), Until.depth("load", maximum=3.0), DOWN, UP),
    "channel": (Until.channel(**HIGH, maximum=5.0), Until.channel(**HIGH, minimum=5.0), DOWN, UP),
    "length": (Until.length("wire", minimum=35.0), Until.length("wire", maximum=35.0), DOWN, UP),
    "tension": (Until.tension("wire", maximum=15e4), Until.tension("wire", minimum=15e4), DOWN, UP),
    "clear": (Until.channel(**GAP, maximum=2.0), Until.clear("feet", minimum=2.0), DOWN, UP),
}  # fmt: skip


@pytest.mark.parametrize("kind", PAIRS)
def test_what_a_stage_ends_at_is_not_met_in_the_next_until_it_comes_back(kind: str) -> None:
    there, back, down, up = PAIRS[kind]
    stages = [until(there, down, "there"), until(back, up, "back"), until(there, down, "again")]
    spans = carried_out(hanging(), *stages).stages
    assert [span.name for span in spans] == ["there", "back", "again"]
    assert all(span.end - span.start > 0.05 for span in spans), spans
    assert all(span.ended_by and "from its start on" not in span.ended_by for span in spans)


def test_a_bound_that_a_stage_goes_beyond_is_met_from_its_start_on() -> None:
    low = Until.depth("load", minimum=3.0)
    result = carried_out(hanging(), until(low, DOWN, "down"), until(low, DOWN, "same"), until(
        Until.depth("load", minimum=2.0), DOWN, "above"))  # fmt: skip
    _, same, above = result.stages
    assert same.end - same.start < 1e-8 and above.end == above.start
    assert above.ended_by == "immersed_depth of 'load' above 2 m from its start on"


def test_controllers_are_called_once_where_a_stage_begins_at_its_bound() -> None:
    calls = []
    turned = {"channel": "coordinate", "joint_coordinate": "angle"}
    stages = [
        Stage(name="turn", until=Until.channel(**turned, minimum=0.2), maximum_duration=5.0),
        Stage(name="back", until=Until.channel(**turned, maximum=0.2), maximum_duration=0.5),
        Stage(name="go on", duration=0.5),
    ]  # fmt: skip
    with pytest.raises(SimulationError, match="stage 'back': is not over") as raised:
        simulate(motored(), stages, controllers=[noted(calls, 0.1)], dt_out=0.17)
    assert raised.value.result.stages[1].end - raised.value.result.stages[1].start == pytest.approx(0.5)
    assert_allclose(np.diff(calls), 0.1, rtol=1e-9)


def test_a_stage_alone_takes_over_what_those_before_it_reach() -> None:
    """Depth, clear, contact, release and rates; seats that let go stay open."""
    stages = [
        until(Until.contact("feet"), DOWN, "land"),
        until(Until.clear("feet", minimum=0.5), UP, "clear"),
        Stage(name="stop", duration=2.0, commands=STOP),
    ]  # fmt: skip
    for first, height in (("clear", LYING), ("stop", LYING + 0.5)):
        alone = simulate(hanging(), stages, first=first, **HOW)
        assert alone.curve("position[load, z]")[0] == pytest.approx(height, abs=0.02)
        assert alone["velocity"][0].max() == 0.0
    stages = [Stage(name="down", duration=4.0, commands=DOWN), Stage(name="on", duration=4.0)]
    going = simulate(hanging(), stages, first="on", **HOW)
    paid = np.diff(going.curve("line_unstretched_length[wire]")[[0, -1]])[0]
    assert paid == pytest.approx(0.4 * (4.0 - 0.5 - 0.2), abs=1e-3)  # from rest, within 1 s and the lag
    raised = simulate(on_deck(damping_ratio=0.1), lift_off(), first="raise", rtol=1e-08)
    assert raised.curve("position[load, z]")[0] == pytest.approx(1.0, abs=1e-3)
    stop = simulate(on_deck(damping_ratio=0.1), lift_off(), first="stop", rtol=1e-08)
    assert stop["line_tension"][0, 0] == pytest.approx(DECK_MASS * G, rel=1e-6)
    assert stop["line_unstretched_length"][0, 0] == pytest.approx(18.5)


def test_a_stage_alone_goes_on_from_a_state_that_is_given() -> None:
    scene = on_deck(damping_ratio=0.1)
    run = StagedRun(scene, lift_off(), **HOW)
    for _ in range(4):
        run.advance()
    begin = run.begun["raise"].state
    alone = StagedRun(scene, lift_off(), first="raise", start=begin, outputs_from=0.0, **HOW)
    for _ in range(2):
        alone.advance()
    assert np.array_equal(alone.state.values, run.state.values) and alone.state.time == run.state.time


@pytest.mark.parametrize("ramp", [pytest.param(0.0, marks=pytest.mark.warns("AssemblyWarning")), 5.0])
def test_a_stage_alone_begins_at_rest_aboard_a_ship_where_its_motion_has_it(ramp: float) -> None:
    stages = [
        until(Until.length("wire", minimum=20.0), DOWN, "down"),
        Stage(name="hang", duration=4.0, commands=STOP),
    ]
    alone = simulate(heaving(2.0, ramp), stages, first="hang", **HOW)
    whole = simulate(heaving(2.0, ramp), stages, start="rest", **HOW)
    part = whole.stage("hang")
    assert alone.time[0] == pytest.approx(whole.time[part.start - 1])
    ship = [result.curve("vessel_motion[heave]") for result in (alone, whole)]
    assert ship[0][0] == pytest.approx(ship[1][part.start - 1], abs=1e-8)
    assert ship[0][-1] == pytest.approx(ship[1][-1], abs=1e-8)
    assert abs(ship[0][0]) > 0.05
    assert alone.curve("line_tension[wire]")[0] == pytest.approx(MASS * 9.80665, rel=0.03)  # and its damper
    assert alone.curve("velocity[load, z]")[0] == 0.0


def test_what_a_scene_refuses_in_a_stage_names_the_stage() -> None:
    on = Stage(name="on", duration=1.0)
    tight = [until(Until.tension("wire", minimum=1e6), DOWN, "pull", 2.0), on]
    always = [until(Until.tension("wire", minimum=0.0), DOWN, "x")]
    for stages, given, message in (
        (always, {}, "stage 'x': would end at once"),
        (tight, {"first": "on"}, "first is 'on', and stage 'pull' .*start="),
    ):
        with pytest.raises(SceneError, match=message):
            simulate(hanging(), stages, **given)
    lost = [on, until(Until.depth("lode", minimum=1.0), DOWN, "down")]
    with pytest.raises(SceneError, match="stage 'down': waits for immersed 'lode'"):
        StagedRun(hanging(), lost)  # before anything runs


WITHIN = 0.8  # m: what a winch pays out while it takes up its rate from rest, not from another one
BY_DAY = (4, 5, 6, 9, 10)  # short ones
COARSE = {"rtol": 1e-5, "dt_out": 0.2}


def heights(result: Result) -> list[float]:
    """Of the load where each stage ends, m."""
    z = result.curve("position[load, z]")
    return [float(z[result.stage(span.name).stop - 1]) for span in result.stages]


MANY = pytest.mark.slow("120 random lifts")


@pytest.mark.parametrize("seed", [pytest.param(n, marks=() if n in BY_DAY else MANY) for n in range(124)])
def test_a_stage_of_a_random_lift_begun_anew_goes_as_in_the_whole(seed: int) -> None:
    stages = random_stages(seed)
    run = StagedRun(hanging(), stages, **COARSE)
    while run.advance():
        pass
    whole = run.result()
    for at, (stage, span) in enumerate(zip(stages, whole.stages, strict=True)):
        begin = run.begun[stage.name]
        again = StagedRun(begin.scene, stages[at:], start=begin.state, outputs_from=0.0, **COARSE)
        while again.advance():
            pass
        assert again.result().stages == whole.stages[at:]
        assert np.array_equal(again.state.values, run.state.values)
        alone = simulate(hanging(), stages, first=stage.name, **COARSE)
        assert alone.time[0] == pytest.approx(span.start if at else 0.0)
        there = max(whole.stage(stage.name).start - 1, 0)
        for channel, within in (("line_unstretched_length[wire]", 1e-9), ("position[load, z]", 0.1)):
            assert alone.curve(channel)[0] == pytest.approx(whole.curve(channel)[there], abs=within), channel
        assert_allclose(heights(alone), heights(whole)[at:], atol=WITHIN)
