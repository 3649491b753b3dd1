"""Stages that move hydraulic cylinders and let their hoses burst: as one run, in files, what is refused."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from element_runs import goes_on
from hydraulic_scenes import START, lifted, raised

from seacrane import (
    Curve,
    Move,
    SceneError,
    Stage,
    Until,
    simulate,
    simulate_stages,
)

FOLLOWS: dict[str, Any] = {"gain": 60.0, "rate_gain": 12.0, "spool_lag": 0.02}
HOLE = 4e-6  # m2


def test_a_stage_moves_the_reference_and_the_cylinder_follows() -> None:
    up = Stage(name="up", duration=3.0, commands={"ram.reference": Move(by=0.1, over=2.0)})
    down = Stage(name="down", duration=3.0, commands={"ram.reference": Move(to=START, over=2.0)})
    result = simulate_stages(raised(**FOLLOWS), [up, down], dt_out=0.1)
    stroke = result["hydraulic_stroke"][:, 0]
    assert stroke[result.time <= 3.0][-1] == pytest.approx(START + 0.1, abs=2e-4)
    assert stroke[-1] == pytest.approx(START, abs=2e-4)
    curve = Curve.quintic(start_time=0.0, end_time=2.0, start=START, end=START + 0.1)
    whole = simulate(raised(reference=curve, **FOLLOWS), 3.0, dt_out=0.1)
    np.testing.assert_allclose(stroke[: len(whole.time)], whole["hydraulic_stroke"][:, 0], atol=2e-6)


@pytest.mark.warns("BoilingOilWarning")
def test_a_hose_bursts_where_its_pressure_passes_a_bound() -> None:
    """The instant is located; from there it is the run whose hose bursts at that time."""
    shut = Curve.quintic(start_time=0.5, end_time=0.51, start=0.6, end=0.0)
    curve = Curve.constant(value=0.6).then(time=0.5, curve=shut)
    scene = raised(command=curve, viscous_friction=2e4, makeup_flow=4e-4)
    bound = 1.02 * simulate(scene, 0.5)["hydraulic_pressure"][-1, 0, 1]
    high = Until.channel("hydraulic_pressure", minimum=bound, hydraulic_cylinder="ram", chamber="rod")
    stages = [
        Stage(name="lift", until=high, maximum_duration=2.0),
        Stage(name="burst", duration=1.0, commands={"ram.rupture": HOLE}),
    ]
    result = simulate_stages(scene, stages, dt_out=0.05, rtol=1e-8)
    at = result.stages[0].end
    assert 0.5 < at < 0.6
    burst = ("ram.rupture", at)
    assert [(event.name, event.time) for event in result.events].count(burst) == 1
    again = scene.copy()
    again.replace("ram", rupture_time=at, rupture_area=HOLE)
    whole = simulate(again, at + 1.0, dt_out=0.05, rtol=1e-8)
    assert burst in [(event.name, event.time) for event in whole.events]
    for name in ("hydraulic_stroke", "hydraulic_spill"):
        late = [one[name][one.time > at + 0.5][:9, 0] for one in (result, whole)]
        np.testing.assert_allclose(*late, rtol=1e-6, atol=1e-12)
    assert np.all(result["hydraulic_spill"][result.time <= at] == 0.0)
    assert np.min(result["hydraulic_spill"][result.time > at + 0.01]) > 0.0


@pytest.mark.parametrize("formulation", ["recursive", "redundant"])
def test_a_run_goes_on_bit_for_bit_across_a_burst(formulation: str) -> None:
    burst = {"rupture_time": 1.5, "rupture_area": HOLE}
    valve = {"counterbalance_pressure": 6e6, "counterbalance_flow": 8e-4}
    for stopped in (1.43, 1.5, 1.503):
        goes_on(
            lambda: lifted(**burst, **valve), 1.7, stopped, dt_out=0.1, rtol=1e-6, formulation=formulation
        )


def test_a_stage_opens_the_spool_and_one_alone_starts_on_oil_that_holds_its_load() -> None:
    opened = simulate_stages(
        raised(),
        [Stage(name="open", duration=1.5, commands={"ram.command": 0.3}),
         Stage(name="shut", duration=1.5, commands={"ram.command": Move(to=0.0, over=0.5)})],
    )  # fmt: skip
    spool = opened["hydraulic_spool"][:, 0]
    assert np.max(spool) == pytest.approx(0.3, rel=1e-3) and spool[-1] == pytest.approx(0.0, abs=1e-6)
    up = Stage(name="up", duration=3.0, commands={"ram.reference": Move(by=0.1, over=2.0)})
    alone = simulate_stages(raised(**FOLLOWS), [up, Stage(name="wait", duration=1.0)], first="wait")
    np.testing.assert_allclose(alone["hydraulic_stroke"][:, 0], START + 0.1, atol=1e-6)
    np.testing.assert_allclose(alone["hydraulic_force"][:, 0], 1000.0 * 9.80665, rtol=1e-6)


@pytest.mark.parametrize(
    ("settings", "commands", "message"),
    [
        ({}, {"ram.reference": Move(by=0.1, over=1.0)}, "there are ram.command"),
        ({"rated_flow": 0.0, "pump_pressure": 0.0}, {"ram.command": 0.1}, "there are ram.rupture"),
        (FOLLOWS, {"ram.reference": 0.4}, "give Move"),
        ({}, {"ram.rupture": 0.0}, "'ram.rupture' is 0 m2"),
        ({}, {"ram.rupture": Move(to=1e-6, over=1.0)}, "a hose bursts at once"),
        ({"rupture_time": 9.0, "rupture_area": HOLE}, {"ram.rupture": HOLE}, "not there"),
        ({}, {"ram.rupture": HOLE}, "stage 'again': commands 'ram.rupture'"),
    ],
)
def test_commands_that_cannot_be_are_told(settings: Any, commands: dict[str, Any], message: str) -> None:
    stages = [Stage(name=name, duration=1.0, commands=commands) for name in ("s", "again")]
    with pytest.raises(SceneError, match=message):
        simulate_stages(raised(**settings), stages)
