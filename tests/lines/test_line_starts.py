"""What lines and winches tell before a run: starts that lift too much, motors that hold too little."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
import pytest
from line_scenes import MASS, G, hung

from seacrane import Curve, Scene, SceneError, Stage, equilibrium, simulate, simulate_stages
from seacrane.warnings import LiftedStartWarning, LineLengthWarning, WinchLimitWarning

DRUM: dict[str, float] = {"lag": 0.1, "drum_inertia": 500.0, "drum_radius": 0.5}


def told(scene: Scene, t_end: float = 0.2) -> list[str]:
    """Warnings of a run, by class and beginning."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        simulate(scene, t_end, dt_out=0.1)
    return [f"{one.category.__name__}: {one.message}" for one in caught]


def on_drum(**winch: Any) -> Scene:
    scene = hung(damping=0.1)
    scene.add_winch(line="hoist", **DRUM | winch)
    return scene


@pytest.mark.warns(sometimes=["WinchLimitWarning"])
@pytest.mark.parametrize(
    ("winch", "words"),
    [
        (
            {"maximum_tension": 300.0},
            "its motor and brake hold 300 N at the start, less than the 1.961e+05 N",
        ),
        ({"brake": 1.0, "brake_capacity": 300.0}, "its motor and brake hold 300 N at the start"),
        (
            {"brake_capacity": 300.0},
            "its brake holds 300 N, less than the 1.961e.05 N .* it slips when it closes",
        ),
        (
            {"brake": 1.0, "brake_capacity": 4e5, "maximum_tension": 300.0},
            "its motor holds 300 N, less than .* the load falls when the brake opens",
        ),
    ],
)
def test_a_winch_that_holds_less_than_what_hangs_on_it_is_told(winch: dict[str, float], words: str) -> None:
    words = words.replace("e+05", "e.05")
    with pytest.warns(WinchLimitWarning, match=f"line 'hoist': {words}"):
        simulate(on_drum(**winch), 0.05, dt_out=0.05)


def test_a_winch_that_holds_what_hangs_on_it_is_not() -> None:
    assert told(on_drum(maximum_tension=3e5, brake_capacity=4e5)) == []
    halves = hung(falls=2, damping=0.1)
    halves.add_winch(line="hoist", **DRUM, maximum_tension=0.6 * MASS * G)
    assert told(halves) == []


@pytest.mark.parametrize(
    ("winch", "bound"),
    [
        ({"rate": -0.5, "maximum_power": 1e3}, "maximum_power, 1000 W"),
        ({"rate": -0.5, "maximum_tension": 2e5}, r"maximum_tension, 2e\+05 N"),
        (
            {
                "brake": Curve.constant(value=1.0),
                "brake_capacity": 1.05 * MASS * G,
                "length": 9.99,
            },
            "brake_capacity, 2.059e.05 N",
        ),
    ],
)
def test_every_bound_of_a_winch_that_is_reached_is_told(winch: dict[str, Any], bound: str) -> None:
    scene = hung(damping=0.1)
    if "length" in winch:
        scene.replace("hoist", length=winch.pop("length"))
    scene.add_winch(line="hoist", **DRUM | winch)
    with pytest.warns(WinchLimitWarning, match=f"line 'hoist': its winch reached its {bound}, at t = "):
        result = simulate(scene, 0.5, dt_out=0.1)
    assert f"its winch reached its {bound.split(',')[0]}" in result.stats["validity"]


@pytest.mark.warns("LineLengthWarning")
def test_a_start_that_lifts_far_more_than_the_weight_is_told() -> None:
    for falls in (1, 3):
        with pytest.warns(
            LiftedStartWarning, match=r"body 'load': its lines start by lifting it with .*, 2\.\d+"
        ):
            simulate(hung(stretch=2.6 * MASS * G / 3e6, falls=falls), 0.05, dt_out=0.05)
    assert told(hung(stretch=1.4 * MASS * G / 3e6)) == []
    assert told(hung(stretch=0.0)) == []
    rest = equilibrium(hung(stretch=0.15))
    with warnings.catch_warnings():
        warnings.simplefilter("error", LiftedStartWarning)
        simulate(hung(stretch=0.15), 0.05, dt_out=0.05, start=rest)


def test_lines_that_pull_against_each_other_lift_by_what_is_left() -> None:
    scene = hung(stretch=2.0 * MASS * G / 3e6)
    scene.add_line(
        name="stay", bodies=["load", "ground"], points=[(0, 0, 0), (0, 0, -30.0)], EA=1e7,
        tension_at_start=MASS * G,
    )  # fmt: skip
    assert not any("LiftedStartWarning" in one for one in told(scene))


def test_a_load_on_its_seat_that_is_lifted_at_once_is_told() -> None:
    scene = Scene(name="deck")
    scene.add_body(name="load", mass=MASS, inertia=(1e4, 1e4, 1e4), position=(0, 0, -10.0))
    scene.add_joint(kind="weld", name="deck", first="ground", second="load")
    scene.add_seat(joint="deck")
    scene.add_line(name="hoist", bodies=["ground", "load"], points=np.zeros((2, 3)), EA=5e7, length=9.9)
    with pytest.warns(LiftedStartWarning, match="2.58 times its weight"):
        simulate(scene, 0.1, dt_out=0.1)


def test_a_stage_that_connects_a_line_too_short_is_told() -> None:
    scene = hung()
    scene.add_line(
        name="tag", bodies=["ground", "load"], points=[(1.0, 0, -10.0), (0, 0, 0)], EA=1e6, length=0.71
    )
    stages = [Stage(name="wait", duration=0.1), Stage(name="hook on", duration=0.1, connect=["tag"])]
    with pytest.warns(
        LineLengthWarning, match=r"stage 'hook on': line 'tag' connects stretched by 0\.29.* m, 0.41"
    ):
        simulate_stages(scene, stages)
    scene.replace("tag", length=1.0)
    with warnings.catch_warnings():
        warnings.simplefilter("error", LineLengthWarning)
        simulate_stages(scene, stages)


def test_a_winch_on_a_segment_of_a_line_with_mass_is_refused() -> None:
    scene = Scene(name="deep")
    scene.add_body(name="load", mass=MASS, inertia=(1e4, 1e4, 1e4), position=(0, 0, -100.0))
    scene.add_line(
        name="wire", rung="with mass", bodies=["ground", "load"], points=np.zeros((2, 3)), EA=1e8,
        length=100.0, mass_per_length=12.0, segments=4,
    )  # fmt: skip
    words = r"line 'wire\.1': is a segment of line 'wire'.*add_winch\('wire', ...\)"
    with pytest.raises(SceneError, match=words):
        scene.add_winch(line="wire.1", rate=0.1)
    scene.replace("wire.1", kind="load", winch=True)
    with pytest.raises(SceneError, match=words):
        scene.compile()


def moored() -> Scene:
    """A barge of 100 t that hangs between two lines: at rest these are stretched by a fifth."""
    scene = Scene(name="moored")
    scene.add_body(name="barge", mass=1e5, size=(20, 8, 4))
    for name, x in (("fore", 1.0), ("aft", -1.0)):
        points = [(30.0 * x, 0, 5), (10.0 * x, 0, 0)]
        scene.add_line(name=name, bodies=["ground", "barge"], points=points, EA=4e6, length=19.0)
    return scene


@pytest.mark.warns(sometimes=["LineLengthWarning"])
@pytest.mark.parametrize("start", [None, "rest"])
def test_a_line_that_is_stretched_at_rest_contradicts_nothing(start: Any) -> None:
    """Its described pose does; runs and lifts in stages alike."""
    runs = (
        simulate(moored(), 0.2, start=start),
        simulate_stages(moored(), [Stage(name="wait", duration=0.2)], start=start),
    )
    for run in runs:
        said = str(run.stats.get("validity", ""))
        assert ("line 'fore': starts stretched" in said) == (start is None)
        assert (run["line_stretch"][0] > 0.05 * 19.0).all()
