"""Accuracies of lifts in stages: closed forms, courses that differ, and random lifts against two judges."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from accuracy_scenes import hung
from staged_accuracy import DT_OUT, lift_of, told, word

import seacrane as sc
from seacrane.accuracy.asked import Matching, curve_apart, extremes_apart, matched
from seacrane.cli import main
from seacrane.warnings import AnotherCourseWarning

G, MASS, HEIGHT, STIFFNESS = 9.80665, 2e3, 0.8, 4e6  # m/s2, kg, m above the surface, N/m
TOUCHES = np.sqrt(2.0 * HEIGHT / G)  # s
WEIGHT = MASS * G
PEAK = WEIGHT + np.sqrt(WEIGHT**2 + 2.0 * STIFFNESS * WEIGHT * HEIGHT)  # N, in the lowest point
OMEGA = 2.0  # rad/s


def dropped(height: float = HEIGHT) -> sc.Scene:
    """A load that falls onto an elastic surface."""
    scene = sc.Scene(name="dropped", gravity=G)
    scene.add_body("load", mass=MASS, inertia=(1e3, 1e3, 1e3), position=(0.0, 0.0, height))
    foot = [(0.0, 0.0, 0.0)]
    scene.add_contact("load", on="ground", points=foot, stiffness=STIFFNESS, damping=0.0, name="foot")
    return scene


FALL = [
    sc.Stage(name="fall", until=sc.Until.contact("foot"), maximum_duration=2.0),
    sc.Stage(name="press", duration=0.06),
]


@pytest.mark.parametrize("limit", [1e-2, 1e-4])
def test_a_drop_onto_a_surface_is_as_exact_as_told(limit: float) -> None:
    asked = {"stage[fall].end": limit, "contact_press.max": limit * PEAK, "event_times": limit}
    result = sc.simulate(dropped(), FALL, dt_out=0.002, accuracy=asked)
    errors = {
        "stage[fall].end": abs(result.stages[0].end - TOUCHES),
        "contact_press.max": abs(float(result.reached("contact_press")[1].max()) - PEAK),
        "event_times": abs(next(e.time for e in result.events if e.kind == "contact") - TOUCHES),
    }
    for name, allowed in asked.items():
        assert errors[name] <= float(result.stats[f"error_estimate_{name}"]) + 1e-9 * max(allowed, 1.0)
        assert result.stats[f"error_estimate_{name}"] <= allowed == result.stats[f"accuracy_{name}"]


def swinging_mass() -> sc.Scene:
    """On a spring, from 1 m beside its rest."""
    scene = sc.Scene(name="harmonic", gravity=0.0)
    scene.add_body("load", mass=MASS, inertia=(1.0, 1.0, 1.0), position=(1.0, 0.0, 0.0))
    scene.add_joint(kind="prismatic", name="rail", first="ground", second="load", axis=(1.0, 0.0, 0.0))
    spring = {"first_point": (-20, 0, 0), "natural_length": 20.0, "stiffness": MASS * OMEGA**2}
    scene.add_spring("hold", first="ground", second="load", **spring)
    return scene


def test_curves_of_an_oscillation_that_ends_at_a_place_are_as_exact_as_told() -> None:
    half = sc.Until.channel("position", body="load", axis="x", maximum=0.5)
    stages = [sc.Stage(name="in", until=half, maximum_duration=2.0), sc.Stage(name="on", duration=3.0)]
    for limit in (1e-2, 1e-5):
        result = sc.simulate(swinging_mass(), stages, dt_out=0.1, accuracy={"position": limit})
        time = result.time - (result.stages[0].end - np.arccos(0.5) / OMEGA)  # at equal phase of "on"
        error = np.abs(result.select("position", body="load", axis="x") - np.cos(OMEGA * time)).max()
        estimate = float(result.stats["error_estimate_position"])
        shift = abs(result.stages[0].end - np.arccos(0.5) / OMEGA)
        assert error <= estimate + OMEGA * shift <= 3.0 * limit
        assert estimate <= limit
        assert shift <= float(result.stats["error_estimate_event_times"])
        assert "accuracy_event_times" not in result.stats


def test_a_jump_that_is_late_by_4_ms_is_an_error_of_time_alone() -> None:
    def tension(time: np.ndarray, taut: float) -> np.ndarray:
        return np.where(time > taut, 25e3 + 1e4 * np.sin(3.0 * (time - taut)), 0.0)[:, None, None]

    time, late = np.arange(0.0, 2.001, 0.05), 0.004
    matching = Matching(
        one=np.array([0.0, 0.998, 2.0]), other=np.array([0.0, 0.998 + late, 2.0]), course="", shift=late
    )
    one, other = tension(time, 0.998), tension(time, 0.998 + late)
    assert np.abs(one - other).max() > 20e3
    assert curve_apart(time, one, time, other, matching) < 3.5 * 1e4 * late
    assert curve_apart(time, one, time, other + 50.0, matching) == pytest.approx(50.0, abs=3.5 * 1e4 * late)


def bounced(height: float, duration: float) -> sc.Result:
    stages = [sc.Stage(name="bounce", duration=duration)]
    return sc.simulate(dropped(height), stages, dt_out=0.01, rtol=1e-09, integrator="dop853")


def test_a_hit_more_is_another_course() -> None:
    once, again = bounced(0.8, 1.0), bounced(0.8, 1.35)
    same, other = matched(once, bounced(0.801, 1.0)), matched(once, again)
    assert same.course == ""
    assert same.shift == pytest.approx(np.sqrt(2.0 * 0.801 / G) - TOUCHES, rel=0.1)
    assert other.course == "contact of 'foot.1' 1 times in one run, 2 in another"
    heights = [run.select("position", body="load")[:, None] for run in (once, again)]
    assert extremes_apart(*heights) < 0.02


def test_a_lift_that_takes_another_course_at_every_tolerance_says_so() -> None:
    """Four feet graze the bed: rounding says which of them touches again."""
    scene, stages = lift_of(10)
    with pytest.warns(AnotherCourseWarning, match=r"(contact|release) of 'feet\.\d' \d+ times in one run, "):
        result = sc.simulate(scene, stages, dt_out=DT_OUT, accuracy={"position": 0.006})
    assert "extremes" in str(result.stats["accuracy_course"])
    assert 0.0 < float(result.stats["error_estimate_position"]) <= 0.006


@pytest.mark.warns("LineLengthWarning")
def test_one_run_takes_extremes_and_times_too() -> None:
    scene, mass, place = hung(np.random.default_rng(3), drop=0.1)
    length = float(np.linalg.norm(place))
    scene.add_line(
        "hoist", first="ground", second="load", EA=mass * G * 50.0, length=length, damping_ratio=0.1
    )
    truth = sc.simulate(scene, 3.0, dt_out=0.01, integrator="dop853", rtol=1e-11)
    peak = float(truth.reached("line_tension")[1].max())
    result = sc.simulate(scene, 3.0, dt_out=0.01, accuracy={"line_tension.max": 1e-3 * peak})
    assert abs(float(result.reached("line_tension")[1].max()) - peak) <= 1e-3 * peak


def test_an_ensemble_of_stages_chooses_its_method_by_its_members() -> None:
    heights, asked = [0.5, 0.8, 1.1], {"accuracy": {"stage[fall].end": 1e-4}, "dt_out": 0.01}
    found = sc.ensemble(
        dropped, over={"height": heights}, stages=FALL, keep={"end": "stage[fall].end"}, **asked
    )
    assert found.accuracy is not None and found.accuracy.held
    ends = found.dataset.end.to_numpy().ravel()
    assert np.abs(ends - np.sqrt(2.0 * np.array(heights) / G)).max() <= 1e-4


@pytest.mark.parametrize("number", range(20))
def test_an_accuracy_of_a_random_staged_lift_holds(number: int) -> None:
    one = word(number)
    assert one.end in ("held", "not judgeable"), told([one])


def test_a_lift_file_asks_for_an_accuracy(tmp_path: Path) -> None:
    load = {"name": "load", "mass_kg": MASS, "inertia_kg_m2": [1e3] * 3, "position_m": [0.0, 0.0, HEIGHT]}
    tables = {
        "body": load, "contact": {"body": "load", "on": "ground", "points_m": [[0.0] * 3], "name": "foot"},
        "stage": [{"name": "fall", "until": [{"contact": "foot"}], "maximum_duration_s": 2.0},
                  {"name": "press", "duration_s": 0.2}],
        "run": {"accuracy": {"stage[fall].end": 1e-3, "contact_press.max": 100.0}},
    }  # fmt: skip
    path = tmp_path / "drop.toml"
    sc.Lift(tables).save(path)
    assert main(["run", str(path), "--out", str(tmp_path / "out")]) == 0
    result = sc.Result.load(tmp_path / "out" / "drop.nc")
    assert abs(result.stages[0].end - TOUCHES) <= 1e-3
    assert result.stats["accuracy_contact_press.max"] == 100.0
