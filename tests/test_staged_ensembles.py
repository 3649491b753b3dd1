"""Ensembles of lifts in stages: each member is the staged run of its own scene, to the bit."""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from seacrane import (
    Move,
    Scene,
    SceneError,
    SimulationError,
    Stage,
    Until,
    ensemble,
    shipped_database,
    simulate_stages,
)
from seacrane.ensembles import Ensemble, sensitivity
from seacrane.ensembles.other_sea import with_sea

G = 9.80665
MASS, EA = 40e3, 2e8


def feeder(*, hs: float = 1.0) -> Scene:
    """A load on the deck of a barge, below a crane on the ground that lifts it off."""
    scene = Scene(name="feeder")
    scene.add_vessel(shipped_database(), memory="none", mooring=60.0)
    scene.add_body(name="load", mass=MASS, size=(6.0, 6.0, 3.0), position=(0.0, 0.0, 11.5))
    scene.add_joint(kind="weld", name="grillage", first="vessel", second="load", point=(0.0, 0.0, 10.0))
    scene.add_seat("grillage")
    scene.add_line(
        name="hoist",
        bodies=["ground", "load"],
        points=[(0.0, 0.0, 40.0), (0.0, 0.0, 1.5)],
        EA=EA,
        length=28.0,
    )
    scene.add_winch("hoist", lag=0.2, maximum_rate=1.0)
    scene.add_sea(hs=hs, tp=8.0, direction_deg=180.0, seed=1)
    return scene


STAGES = [
    Stage(name="wait", duration=5.0),
    Stage(name="lift", until=Until.release("grillage"), maximum_duration=30.0, commands={"hoist.rate": -0.5}),
    Stage(name="up", duration=5.0),
]
KEEP: dict[str, Any] = {
    "peak": "hook_load[stage=up].max",
    "whole": "hook_load.max",
    "lifted": "stage[lift].end",
    "took": "stage[lift].duration",
}
HOW: dict[str, Any] = {"dt_out": 0.02, "rtol": 1e-5}


@pytest.fixture(scope="module")
def lifts() -> Ensemble:
    return ensemble(feeder(), stages=STAGES, over={"seed": [1, 2, 3]}, keep=KEEP, **HOW)


def test_members_are_their_staged_runs_to_the_bit(lifts: Ensemble) -> None:
    for place, seed in enumerate((1, 2, 3)):
        run = simulate_stages(with_sea(feeder(), {"seed": seed}), STAGES, **HOW)
        hook, lift = run.select("hook_load", suspension="hoist"), run.stages[1]
        member = lifts.dataset.isel(seed=place)
        assert float(member.whole.squeeze()) == hook.max()
        assert float(member.peak.squeeze()) == hook[run.stage("up")].max()
        assert (float(member.lifted), float(member.took)) == (lift.end, lift.end - lift.start)
    assert not lifts.failures and len(set(lifts.dataset.lifted.to_numpy().tolist())) == 3


def test_the_peak_is_that_of_the_relative_speed_at_lift_off() -> None:
    """m g + sqrt((m a)^2 + v^2 k m) of a load that leaves a deck moving at v against the hook, by hand."""
    keep = {
        "peak": "hook_load[stage=up].max",
        "speed": _speed_at_lift_off,
        "stiffness": _stiffness_at_lift_off,
    }
    lifts = ensemble(feeder(), stages=STAGES, over={"seed": range(8)}, keep=keep, **HOW)
    data = lifts.dataset
    hand = MASS * G + np.abs(data.speed.to_numpy()) * np.sqrt(data.stiffness.to_numpy() * MASS)
    peak = data.peak.to_numpy().reshape(hand.shape)
    assert peak == pytest.approx(hand, rel=0.05)


def _at_lift_off(result: Any) -> int:
    return int(np.searchsorted(result.time, result.stages[1].end))


def _speed_at_lift_off(result: Any) -> float:
    i = _at_lift_off(result)
    return 0.5 + float(-result.select("velocity", body="load", axis="z")[i])


def _stiffness_at_lift_off(result: Any) -> float:
    return EA / float(result.curve("line_unstretched_length[hoist]")[_at_lift_off(result)])


def test_numbers_of_stages_vary_by_path(lifts: Ensemble) -> None:
    over = [{"stages.lift.commands.hoist.rate": rate, "stages.wait.duration": wait, "seed": 2}
            for rate, wait in ((-0.5, 5.0), (-0.25, 5.0), (-0.5, 7.0))]  # fmt: skip
    told = ensemble(feeder(), stages=STAGES, over=over, keep=KEEP, **HOW).dataset
    assert float(told.lifted[0]) == float(lifts.dataset.lifted[1])
    slow = [STAGES[0], Stage(name="lift", until=Until.release("grillage"), maximum_duration=30.0,
                             commands={"hoist.rate": -0.25}), STAGES[2]]  # fmt: skip
    run = simulate_stages(with_sea(feeder(), {"seed": 2}), slow, **HOW)
    assert float(told.lifted[1]) == run.stages[1].end
    assert float(told.lifted[2] - told.took[2]) == 7.0


def test_numbers_of_moves_vary_too() -> None:
    scene = Scene(name="cart")
    scene.add_body(name="cart", mass=10.0, size=(1.0, 1.0, 1.0))
    scene.add_joint(kind="prismatic", name="rail", first="ground", second="cart", axis=(1.0, 0.0, 0.0))
    scene.add_driver("rail", curve=0.0)
    stages = [Stage(name="out", duration=4.0, commands={"rail.displacement": Move(to=1.0, over=2.0)})]
    path = "stages.out.commands.rail.displacement.to"
    told = ensemble(scene, stages=stages, over={path: [1.0, 2.5]}, keep={"x": "position[cart, x].max"})
    assert told.dataset.x.to_numpy().ravel() == pytest.approx([1.0, 2.5], abs=1e-9)


def test_a_member_that_never_reaches_a_stage_says_so() -> None:
    short = [STAGES[0], Stage(name="lift", until=Until.release("grillage"), maximum_duration=0.5,
                              commands={"hoist.rate": -0.5}), STAGES[2]]  # fmt: skip
    over = {"stages.lift.maximum_duration": [0.5, 30.0]}
    told = ensemble(feeder(), stages=short, over=over, keep=KEEP, **HOW)
    assert list(told.failures) == [0]
    assert "stage 'lift'" in told.failures[0] and "SimulationError" in told.failures[0]
    with pytest.raises(SimulationError, match="stage 'lift'"):
        ensemble(feeder(), stages=short, over=over, keep=KEEP, on_error="raise", **HOW)


@pytest.mark.parametrize("name", ["lifts", "lifts.zarr"])
def test_a_store_goes_on_and_tells_other_stages_apart(tmp_path: Path, name: str, lifts: Ensemble) -> None:
    """The second call has one member more to run; another rate is another study."""
    ran: list[int] = []

    def counted(scene: Scene) -> list[Stage]:
        ran.append(1)
        return STAGES

    asked: dict[str, Any] = {"over": {"seed": [1, 2, 3]}, "keep": KEEP, "store": tmp_path / name, "pack": 1}
    for _ in range(2):
        with ThreadPoolExecutor(2) as executor:
            told = ensemble(feeder(), stages=STAGES, executor=executor, **asked, **HOW)
        assert told.dataset.peak.to_numpy().tolist() == lifts.dataset.peak.to_numpy().tolist()
    faster = [STAGES[0], Stage(name="lift", until=Until.release("grillage"), maximum_duration=30.0,
                               commands={"hoist.rate": -0.6}), STAGES[2]]  # fmt: skip
    with pytest.raises(SceneError, match="another study"):
        ensemble(feeder(), stages=faster, **asked, **HOW)
    made = ensemble(feeder(), stages=counted, over={"seed": [1]}, keep=KEEP, **HOW)
    assert ran and made.dataset.peak.to_numpy().ravel()[0] == lifts.dataset.peak.to_numpy().ravel()[0]


def test_a_killed_study_keeps_its_members(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Stopped in the third member: the first two are read, the others run."""
    asked: dict[str, Any] = {"over": {"seed": [1, 2, 3, 4]}, "keep": KEEP, "store": tmp_path / "s", "pack": 1}
    steps = iter(range(1000))

    def stopping(run: Any) -> Iterator[int]:
        if next(steps) == 2:
            raise KeyboardInterrupt
        while run.advance():
            pass
        return run

    from seacrane.ensembles import job

    with monkeypatch.context() as patched:
        patched.setattr(job, "_stepped", stopping)
        with pytest.raises(KeyboardInterrupt):
            ensemble(feeder(), stages=STAGES, **asked, **HOW)
    kept = Ensemble.load(tmp_path / "s")
    assert np.isfinite(kept.dataset.peak.to_numpy()).sum() == 2
    done = ensemble(feeder(), stages=STAGES, **asked, **HOW)
    assert np.isfinite(done.dataset.peak.to_numpy()).all()


def test_seeds_are_added_until_the_peak_is_known() -> None:
    told = ensemble(
        feeder(hs=0.5), stages=STAGES, over={"seed": range(60)}, until={"peak.mean": 0.1},
        keep={"peak": "hook_load[hoist, stage=up].max"}, **HOW,
    )  # fmt: skip
    (one,) = told.certainty
    assert one.seeds in (20, 40, 60)


def test_sensitivity_takes_stages() -> None:
    """A faster winch makes a higher peak: v sqrt(k m) for each m/s."""
    told = sensitivity(
        feeder(hs=0.3), stages=STAGES, parameters={"stages.lift.commands.hoist.rate": (-0.5, 0.05)},
        seeds=range(10), keep="hook_load[hoist, stage=up].max", **HOW,
    )  # fmt: skip
    slope = told.gradients["stages.lift.commands.hoist.rate"].value
    assert slope == pytest.approx(-np.sqrt(EA / 27.0 * MASS), rel=0.15)


def test_what_contradicts_is_refused_by_name() -> None:
    given: dict[str, Any] = {"over": {"seed": [1]}, "keep": KEEP}
    with pytest.raises(SceneError, match=r"t_end is 10\.0, and stages tell their end"):
        ensemble(feeder(), stages=STAGES, t_end=10.0, **given)
    with pytest.raises(SceneError, match="lanes is 4, and stages are run one by one"):
        ensemble(feeder(), stages=STAGES, lanes=4, **given)
    with pytest.raises(SceneError, match="stages is 'lift'; give a list of Stage"):
        ensemble(feeder(), stages="lift", **given)  # type: ignore[arg-type]
    with pytest.raises(
        SceneError,
        match=r"no parameter 'stages.lift.commands.hoist.rat'; nearest: 'stages.lift.commands.hoist.rate'",
    ):
        ensemble(feeder(), stages=STAGES, over={"stages.lift.commands.hoist.rat": [1.0]}, keep=KEEP)
    with pytest.raises(SceneError, match="accuracy is for runs without stages"):
        ensemble(feeder(), stages=STAGES, accuracy={"roll": 0.01}, **given)
    told = ensemble(
        feeder(), stages=STAGES, over={"seed": [1]}, keep={"x": "hook_load[stage=down].max"}, **HOW
    )
    assert "no stage 'down'" in told.failures[0]
