"""What is told of a run once it is over: no missing number may take the run with it."""

from __future__ import annotations

from pathlib import Path

import pytest
from line_scenes import MASS, G, hung
from stage_scenes import on_deck
from test_stages import falling

from seacrane import Result, Scene, Stage, Until, simulate_stages
from seacrane.run.stages_to_file import simulate_stages_to_file
from seacrane.run.to_file import simulate_to_file

pytestmark = pytest.mark.filterwarnings("ignore")
AT_ONCE = Stage(name="look", until=Until.length("hoist", minimum=1.0), maximum_duration=5.0)


def weak() -> Scene:
    """A winch whose motor cannot hold its load: it reaches a bound, and the scene knows no impact."""
    scene = hung(damping=0.1)
    scene.add_winch(line="hoist", drum_inertia=1e3, drum_radius=0.5, lag=0.2, maximum_tension=0.9 * MASS * G)
    return scene


def test_bounds_of_a_winch_are_events_without_impacts(tmp_path: Path) -> None:
    for end in (1.0, 1.5):  # counted over a resumption
        done = simulate_to_file(weak(), tmp_path / "again.nc", end, resume=end > 1.0)
        assert done.stats["events"] == len(done.load().events) > 0
    assert done.load().events[0].kind == "limit"


def test_stages_that_are_met_at_once_have_one_output(tmp_path: Path) -> None:
    whole = simulate_stages(on_deck(), [AT_ONCE], dt_out=0.1)
    assert whole.time.tolist() == [0.0]
    assert [(span.start, span.end, span.ended_by[:5]) for span in whole.stages] == [(0.0, 0.0, "line_")]
    assert whole["position"][0, 0, 2] == 1.0
    path, hold = tmp_path / "lift.nc", Stage(name="hold", duration=0.5)
    gone_on = simulate_stages_to_file(on_deck(), [AT_ONCE, hold], path, dt_out=0.1)
    plain = simulate_stages(on_deck(), [hold], dt_out=0.1)
    assert gone_on.time.tolist() == plain.time.tolist() == Result.load(path).time.tolist()
    assert (gone_on["position"] == plain["position"]).all()
    assert [event.kind for event in gone_on.events] == ["stage", "stage"]


@pytest.mark.parametrize("lies", [1.0, 0.3])
def test_impacts_of_all_stages_are_counted(lies: float) -> None:
    """m g h of the fall, also where the last stage has another model and no impact."""
    scene = falling(2.0)
    scene.add_body(name="other", mass=1.0, inertia=(1.0, 1.0, 1.0), position=(9.0, 0.0, 0.0))
    scene.add_joint(kind="weld", name="lashing", first="ground", second="other", point=(9.0, 0.0, 0.0))
    stages = [Stage(name="fall", duration=1.0), Stage(name="let go", duration=lies, release=["lashing"])]
    result = simulate_stages(scene, stages, dt_out=0.1)
    fallen = 3.0 * G * 2.0
    assert result.stats["impact_energy_lost_J"] == pytest.approx(fallen, rel=1e-6)
