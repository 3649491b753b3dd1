"""Allowable Hs on ships whose motion is given, and of lifts in stages."""

from __future__ import annotations

import pytest
from stage_scenes import MASS, G, heaving

from seacrane import Criterion, Stage, Until, allowable_hs

LOWER = Until.length("wire", minimum=20.0)
STAGES = [Stage(name="hang", duration=8.0),
          Stage(name="down", until=LOWER, maximum_duration=9.0, commands={"wire.rate": 0.4})]  # fmt: skip
TENSION = Criterion(channel="line_tension[wire]", maximum=1.15 * MASS * G)
ASKED = {"criteria": [TENSION], "tp": 8.0, "direction_deg": 0.0, "hs": [2.0, 4.0], "seeds": (1, 2, 3)}


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


def test_what_a_lift_in_stages_allows_does_not_depend_on_its_outputs() -> None:
    """The load bounces on its hoist in 0.7 s: outputs 0.5 s apart see hardly any of its peaks."""
    near, far = (allowable_hs(heaving(1.0), stages=STAGES, dt_out=dt_out, **ASKED) for dt_out in (0.02, 0.5))
    assert far.dataset["allowable_hs"].item() == pytest.approx(near.dataset["allowable_hs"].item(), rel=2e-3)


def test_an_accuracy_chooses_the_method_of_all_storms() -> None:
    usual = allowable_hs(heaving(1.0), stages=STAGES, **ASKED)
    found = allowable_hs(heaving(1.0), stages=STAGES, accuracy={"line_tension.max": 0.01 * MASS * G}, **ASKED)
    heights = [table.dataset["allowable_hs"].item() for table in (usual, found)]
    assert heights[0] == pytest.approx(heights[1], rel=0.02) and heights[0] != heights[1]
