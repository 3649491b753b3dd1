"""Stages that move hydraulic cylinders and let their hoses burst: as one run, in files, what is refused."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hydraulic_scenes import FULL, SET, START, lifted, raised
from lift_examples import HEAD

from seacrane import (
    Curve,
    FileFormatError,
    Lift,
    Move,
    Run,
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


def test_a_stage_opens_the_spool() -> None:
    opened = simulate_stages(
        raised(),
        [Stage(name="open", duration=1.5, commands={"ram.command": 0.3}),
         Stage(name="shut", duration=1.5, commands={"ram.command": Move(to=0.0, over=0.5)})],
    )  # fmt: skip
    spool = opened["hydraulic_spool"][:, 0]
    assert np.max(spool) == pytest.approx(0.3, rel=1e-3) and spool[-1] == pytest.approx(0.0, abs=1e-6)


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
@pytest.mark.parametrize("stopped", [1.43, 1.5, 1.503])
def test_a_run_goes_on_bit_for_bit_across_a_burst(formulation: str, stopped: float) -> None:
    scene = lifted(rupture_time=1.5, rupture_area=HOLE, counterbalance_pressure=6e6, counterbalance_flow=8e-4)
    settings: dict[str, Any] = {"t_end": 1.7, "dt_out": 0.1, "rtol": 1e-6, "formulation": formulation}
    whole = Run(scene, **settings)
    whole.advance(stopped)
    later = Run(scene, **settings, start=whole.core.state)
    told = [event.name for event in whole.events()]
    for going in (whole, later):
        going.advance(1.7)
    assert np.array_equal(whole.core.state.values, later.core.state.values)
    assert [*told, *(event.name for event in later.events())].count("ram.rupture") == 1


def test_a_stage_alone_starts_on_oil_that_holds_its_load() -> None:
    stages = [
        Stage(name="up", duration=3.0, commands={"ram.reference": Move(by=0.1, over=2.0)}),
        Stage(name="wait", duration=1.0),
    ]
    alone = simulate_stages(raised(**FOLLOWS), stages, first="wait")
    np.testing.assert_allclose(alone["hydraulic_stroke"][:, 0], START + 0.1, atol=1e-6)
    np.testing.assert_allclose(alone["hydraulic_force"][:, 0], 1000.0 * 9.80665, rtol=1e-6)


@pytest.mark.parametrize(
    ("settings", "commands", "message"),
    [
        ({}, {"ram.reference": Move(by=0.1, over=1.0)}, "which is not there; there are ram.command"),
        ({"rated_flow": 0.0, "pump_pressure": 0.0}, {"ram.command": 0.1}, "there are ram.rupture"),
        (FOLLOWS, {"ram.reference": 0.4}, "give Move"),
        ({}, {"ram.rupture": 0.0}, "'ram.rupture' is 0 m2; give the area of the hole, above zero"),
        ({}, {"ram.rupture": Move(to=1e-6, over=1.0)}, "a hose bursts at once: give m2"),
        ({"rupture_time": 9.0, "rupture_area": HOLE}, {"ram.rupture": HOLE}, "which is not there"),
    ],
)  # fmt: skip
def test_commands_that_cannot_be_are_told(
    settings: dict[str, Any], commands: dict[str, Any], message: str
) -> None:
    with pytest.raises(SceneError, match=message):
        simulate_stages(raised(**settings), [Stage(name="s", duration=1.0, commands=commands)])


def test_a_hose_bursts_once() -> None:
    burst = {"ram.rupture": HOLE}
    stages = [Stage(name=name, duration=1.0, commands=burst) for name in ("one", "two")]
    with pytest.raises(SceneError, match=r"stage 'two': commands 'ram.rupture', and that hose bursts"):
        simulate_stages(raised(), stages)


FILE = (
    HEAD
    + f"""
[[body]]
name = "load"
mass_kg = 1000
inertia_kg_m2 = [10, 10, 10]
position_m = [0, 0, 1.35]

[[joint]]
kind = "prismatic"
name = "guide"
first = "ground"
second = "load"
point_m = [0, 0, 0]
axis = [0, 0, 1]

[[hydraulic_cylinder]]
name = "ram"
first = "ground"
second = "load"
full_area_m2 = {FULL}
rod_side_area_m2 = {SET["rod_side_area"]}
retracted_length_m = 1.05
stroke_m = 0.6
pump_pressure_Pa = 7.6e6
rated_flow_m3_per_s = 4e-4
gain_per_m = 5

[[stage]]
name = "up"
duration_s = 1
commands = [{{ name = "ram.reference", by_m = 0.05, over_s = 0.8 }}]

[[stage]]
name = "burst"
duration_s = 1
commands = [{{ name = "ram.rupture", value_m2 = 4e-6 }}, {{ name = "ram.command", value = -0.1 }}]
"""
)


@pytest.mark.warns("BoilingOilWarning")
def test_a_lift_file_commands_oil(tmp_path: Path) -> None:
    path = tmp_path / "lift.toml"
    path.write_text(FILE, encoding="utf-8")
    result = Lift.load(path).simulate()
    assert ("ram.rupture", 1.0) in [(event.name, event.time) for event in result.events]
    assert result["hydraulic_spill"][-1, 0] > 0.0
    path.write_text(FILE.replace("by_m = 0.05", "by_deg = 5"), encoding="utf-8")
    with pytest.raises(
        FileFormatError, match=r"by_deg is given of 'ram.reference', which is in m; give by_m"
    ):
        Lift.load(path).scene()
