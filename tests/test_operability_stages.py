"""Allowable Hs on ships whose motion is given, and how near outputs of a lift in stages are."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from stage_scenes import MASS, G, heaving

from seacrane import Criterion, SceneError, Stage, Until, allowable_hs, equilibrium
from seacrane.description.given import in_calm_water
from seacrane.operability.output_interval import fastest_bounce
from seacrane.run import StagedRun
from seacrane.warnings import CoarseOutputsWarning

STAGES = [
    Stage(name="hang", duration=8.0),
    Stage(
        name="down",
        until=Until.length("wire", minimum=20.0),
        maximum_duration=9.0,
        commands={"wire.rate": 0.4},
    ),
]
TENSION = Criterion(channel="line_tension[wire]", maximum=1.15 * MASS * G)
ASKED: dict[str, Any] = {
    "criteria": [TENSION],
    "tp": 8.0,
    "direction_deg": 0.0,
    "hs": [2.0, 4.0],
    "seeds": (1, 2, 3),
}


@pytest.mark.parametrize("ramp", [pytest.param(0.0, marks=pytest.mark.warns("AssemblyWarning")), 5.0])
def test_what_a_given_ship_allows_does_not_depend_on_the_sea_it_is_described_in(ramp: float) -> None:
    found = [allowable_hs(heaving(hs, ramp), stages=STAGES, **ASKED) for hs in (0.5, 5.0)]
    heights = [table.dataset["allowable_hs"].item() for table in found]
    assert heights[0] == heights[1] and 0.0 < heights[0] < 4.0
    assert not found[0].failures and not found[1].failures


@pytest.mark.parametrize("domain", ["auto", "time"])
def test_a_given_ship_is_run_everywhere_for_as_long_as_it_takes(domain: str) -> None:
    """Its motion is described for 60 s, and the runs take 90 s."""
    table = allowable_hs(heaving(1.0), **ASKED, duration=80.0, start_up=10.0, domain=domain)
    assert not table.failures
    assert table.dataset["domain"].item() == "time"
    assert 0.0 < table.dataset["allowable_hs"].item() < 4.0


def test_outputs_resolve_what_bounces_on_the_hoist() -> None:
    """The period is 2 pi sqrt(m l / EA), that of the shortest wire of the lift."""
    scene = in_calm_water(heaving(1.0))
    bounce = fastest_bounce(StagedRun(scene, STAGES, start=equilibrium(scene)))
    assert bounce is not None and bounce.load == "load"
    length = 18.5 / (1.0 + MASS * G / 3e7)
    assert bounce.period == pytest.approx(2.0 * np.pi * np.sqrt(MASS * length / 3e7), rel=5e-3)


def test_outputs_that_miss_bounces_are_told() -> None:
    with pytest.warns(
        CoarseOutputsWarning,
        match=r"dt_out is 0\.5 s, and 'load' bounces on its hoist in 0\.696 s: .* give 0\.087",
    ):
        allowable_hs(heaving(1.0), stages=STAGES, dt_out=0.5, **ASKED)


def test_outputs_may_be_far_apart_where_no_bounce_counts() -> None:
    heave = Criterion(channel="vessel_motion[heave]", maximum=5.0)
    assert not allowable_hs(heaving(1.0), stages=STAGES, dt_out=0.5, **ASKED | {"criteria": [heave]}).failures


def test_an_accuracy_chooses_the_method_of_all_storms() -> None:
    usual = allowable_hs(heaving(1.0), stages=STAGES, **ASKED)
    found = allowable_hs(heaving(1.0), stages=STAGES, accuracy={"line_tension.max": 0.01 * MASS * G}, **ASKED)
    heights = [table.dataset["allowable_hs"].item() for table in (usual, found)]
    assert heights[0] == pytest.approx(heights[1], rel=0.02) and heights[0] != heights[1]
    with pytest.raises(SceneError, match=r"rtol=0\.001 is given too"):
        allowable_hs(heaving(1.0), stages=STAGES, accuracy={"line_tension.max": 1e3}, rtol=1e-3, **ASKED)
