"""Random lifts in stages: a stage begun anew goes as it does in the whole lift."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose
from random_staged_lifts import hanging, random_stages

from seacrane import Result, Stage, simulate_stages
from seacrane.run import StagedRun

WITHIN = 0.8  # m: what a winch pays out while it takes up its rate from rest, not from another one
BY_DAY = (4, 5, 6, 9, 10)  # short ones
HOW = {"rtol": 1e-5, "dt_out": 0.2}


def heights(result: Result) -> list[float]:
    """Of the load where each stage ends, m."""
    z = result.curve("position[load, z]")
    return [float(z[result.stage(span.name).stop - 1]) for span in result.stages]


def begun_anew(seed: int) -> None:
    stages = random_stages(seed)
    run = StagedRun(hanging(), stages, **HOW)
    while run.advance():
        pass
    whole = run.result()
    for at, stage in enumerate(stages):
        begin = run.begun[stage.name]
        again = StagedRun(begin.scene, stages[at:], start=begin.state, outputs_from=0.0, **HOW)
        while again.advance():
            pass
        assert again.result().stages == whole.stages[at:]
        assert np.array_equal(again.state.values, run.state.values)
        alone_as_in_the_whole(whole, stages, at)


def alone_as_in_the_whole(whole: Result, stages: list[Stage], at: int) -> None:
    begin = whole.stages[at].start
    alone = simulate_stages(hanging(), stages, first=stages[at].name, **HOW)
    assert alone.time[0] == pytest.approx(begin if at else 0.0)
    there = max(whole.stage(stages[at].name).start - 1, 0)
    for channel, within in (("line_unstretched_length[wire]", 1e-9), ("position[load, z]", 0.1)):
        assert alone.curve(channel)[0] == pytest.approx(whole.curve(channel)[there], abs=within), channel
    assert_allclose(heights(alone), heights(whole)[at:], atol=WITHIN)


MANY = pytest.mark.slow("120 random lifts")


@pytest.mark.parametrize("seed", [pytest.param(n, marks=() if n in BY_DAY else MANY) for n in range(124)])
def test_a_stage_of_a_random_lift_begun_anew_goes_as_in_the_whole(seed: int) -> None:
    begun_anew(seed)
