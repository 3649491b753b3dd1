"""required(): choices of modelling made simpler one at a time, and the set that is enough."""

from __future__ import annotations

import dataclasses
import math
from typing import Any

import numpy as np
import pytest
from ensemble_studies import drifting_hull

import seacrane as sc
from seacrane import answers
from seacrane.answers import Choice, Loss, choices_of, missing_from
from seacrane.answers.required import least_of
from seacrane.hydro import BoxPart, two_barges
from seacrane.scene import Pump, Valve
from seacrane.scene.file import scene_digest

LENGTH, RATIO, G = 5.0, 0.02, 9.80665
OMEGA = math.sqrt(G / LENGTH)
PERIODS = 5
RUN = {"t_end": (PERIODS + 0.25) * 2.0 * math.pi / OMEGA, "dt_out": 0.02, "rtol": 1e-9}
LAST = {"last": f"position[bob, x, after={(PERIODS - 0.5) * 2.0 * math.pi / OMEGA:.6g}].max"}
SWING = 0.02  # m


def pendulum() -> sc.Scene:
    """A point mass on a rod, with friction where it hangs, and drag of no coefficient."""
    scene = sc.Scene(name="pendulum")
    scene.add_body(name="bob", mass=1e3, inertia=(1.0, 1.0, 1.0), position=(SWING, 0.0, -LENGTH))
    scene.add_joint(kind="distance", name="rod", first="ground", second="bob", point=(0, 0, 0),
                    second_point=(SWING, 0.0, -LENGTH))  # fmt: skip
    scene.add_spring("friction", first="ground", second="bob", damping_ratio=RATIO)
    scene.add_wind(body="bob", frontal_area=2.0, lateral_area=3.0, drag_coefficient=0.0)
    return scene


def held(**crane: Any) -> sc.Scene:
    scene = sc.Scene(name="held")
    scene.add_crane(base="ground", foot=(0.0, 0.0, 12.0), s1=2.0, s2=1.0, held=True, **crane)
    return scene


def slung(**more: Any) -> sc.Scene:
    """A load on four slings below a block, whose hoist is shaken by nothing but its own start."""
    scene = held()
    rig = {"block_mass": 1e3, "winch": {"lag": 0.2}, "slings": {"angle_deg": 60, "EA": 5e7}}
    scene.add_hoist(mass=35e3, size=(6, 4, 4), length=5.0, EA=6e7, **rig, **more)
    return scene


def wet() -> sc.Scene:
    """A box cut into strips, with waves at its parts."""
    scene = sc.Scene(name="wet")
    scene.add_sea(vessel=None, hs=1.0, tp=8.0, direction_deg=0.0)
    scene.add_body(name="box", mass=40e3, inertia=(1e5, 1e5, 1e5), position=(0.0, 0.0, -8.0))
    scene.add_line(
        "wire", bodies=["ground", "box"], points=[(0.0, 0.0, 10.0), (0, 0, 1.0)], EA=5e7, length=17.0
    )
    scene.add_immersed("box", parts=[BoxPart(size=(6.0, 4.0, 1.0), strips=(3, 1))])
    return scene


def on_deck() -> sc.Scene:
    """A box that stands on points of its own."""
    scene = sc.Scene(name="on deck")
    scene.add_body(name="box", mass=1e3, inertia=(1e3, 1e3, 1e3), position=(0.0, 0.0, 0.5), size=(1, 1, 1))
    scene.add_contact("box", on="ground", points=[(x, y, -0.5) for x in (-0.5, 0.5) for y in (-0.5, 0.5)])
    return scene


def on_oil() -> sc.Scene:
    """A crane that stands on the oil of two cylinders."""
    oil = {"pump": Pump(pressure=32e6), "valve": Valve(rated_flow=0.05, rated_drop=1e6, gain=0.8)}
    scene = held(hydraulics={"main": oil, "knuckle": oil})
    scene.add_hoist(mass=35e3, size=(6, 4, 4), length=5.0, EA=6e7)
    return scene


def drifting(*, drift: bool = True, phase: Any = "mean") -> sc.Scene:
    """A ship whose database knows its drift."""
    scene = sc.Scene(name="drifting")
    scene.add_vessel(drifting_hull())
    scene.add_sea(hs=2.0, tp=8.0, direction_deg=180.0, count=20, drift=drift, phase=phase)
    return scene


def heavy(segments: int = 4, **more: Any) -> sc.Scene:
    """A load on a wire with mass in water, off a winch."""
    scene = held()
    wire = {"mass_per_length": 20.0, "segments": segments, "medium": "sea", "diameter": 0.05, **more}
    scene.add_hoist(mass=35e3, size=(6, 4, 4), winch={"lag": 0.2}, length=50.0, EA=6e7, wire=wire)
    return scene


def barges(lid: float | None = 0.03) -> sc.Scene:
    scene = sc.Scene(name="barges")
    for vessel in scene.add_vessel(two_barges(lid_damping=lid)):
        sea = {} if scene.waves else {"hs": 1.0, "tp": 8.0, "direction_deg": 150.0}
        scene.add_sea(vessel=vessel.name, **sea)
    return scene


def beside_a_given_ship() -> sc.Scene:
    """A box in the waves beside a ship that is held at rest, which does not need the sea."""
    scene = wet()
    scene.add_vessel(motion="rest", name="ship", position=(60.0, 0.0, 0.0))
    return scene


def test_what_damping_takes_and_what_drag_of_nothing_does_not() -> None:
    scene = pendulum()
    found = sc.required(scene, keep=LAST, repeats=1, **RUN)
    swung = SWING * math.exp(-RATIO * OMEGA * PERIODS * 2.0 * math.pi / OMEGA)
    assert found.full["last"] == pytest.approx(swung, rel=2e-3)
    assert found.row("no pendulum damping").changes["last"] == pytest.approx(SWING - swung, rel=2e-3)
    assert abs(found.row("no air drag").changes["last"]) <= found.noise["last"] < 1e-6
    turned = sc.required(scene, keep=LAST, repeats=1, choices=choices_of(scene)[::-1], **RUN)
    assert {row.name: row.changes for row in turned.rows} == {row.name: row.changes for row in found.rows}


def test_the_set_is_run_once_against_the_full_one_and_its_script_makes_it(monkeypatch: Any) -> None:
    monkeypatch.setattr(Loss, "share", property(lambda self: self.evaluations))
    monkeypatch.setattr(Loss, "spread", property(lambda self: 0.0))
    peak = {"peak": "hook_load[hoist].max"}
    scene = slung()
    found = sc.required(scene, keep=peak, within=0.02, t_end=3.0)
    assert [row.of for row in found.taken] and found.least.evaluations < 0.5
    assert len({row.of for row in found.taken}) == len(found.taken)
    held = {"scene": scene.copy(), "answers": answers, "dataclasses": dataclasses}
    exec(found.script, held)
    least = sc.simulate(held["scene"], 3.0)["hook_load"].max()
    full = sc.simulate(scene, 3.0)["hook_load"].max()
    assert found.least.changes["peak"] == pytest.approx(least - full, abs=0.01 * full)
    assert abs(found.least.changes["peak"]) <= found.limits["peak"]


@pytest.mark.parametrize(
    "described",
    [
        pendulum, slung, wet, on_deck, on_oil, drifting, heavy, beside_a_given_ship, sc.cases.case2,
        pytest.param(barges, marks=pytest.mark.slow("fits memories")),
    ],
)  # fmt: skip
def test_a_script_makes_what_is_measured(described: Any) -> None:
    scene = described()
    tried = [*choices_of(scene), *missing_from(scene)]
    assert tried
    for choice in tried:
        held = {"scene": scene.copy(), "answers": answers, "dataclasses": dataclasses, "np": np}
        exec(choice.script, held)
        assert scene_digest(held["scene"]) == scene_digest(choice.made(scene)), choice.name


def test_what_does_not_run_is_a_row_with_its_reason() -> None:
    keep = {"pull": "line_tension[wire].max"}
    found = sc.required(beside_a_given_ship(), keep=keep, t_end=2.0, repeats=1)
    row = found.row("line wire rigid")
    assert not row.stable and "'pull' is gone: no channel 'line_tension'" in row.message
    assert found.row("no waves on parts in water").stable
    scene = slung()
    stiff, *others = choices_of(scene)
    made = stiff.made(scene)
    for choice in others:  # one whose object is gone does nothing
        choice.made(made)
    assert not any("sling" in name for name in made.loads)


def test_oil_that_holds_is_as_good_as_a_driver() -> None:
    """And a start that is a function is that of each scene."""
    (held,) = [choice for choice in choices_of(on_oil()) if choice.of == "drives"]
    given = {"keep": {"peak": "hook_load[hoist].max"}, "repeats": 1, "choices": [held]}
    found = sc.required(on_oil(), t_end=2.0, start=sc.equilibrium, **given)
    (row,) = found.rows
    assert row.stable and row.evaluations < 1.0
    assert abs(row.changes["peak"]) < 1e-3 * found.full["peak"]


def test_fewer_waves_keep_their_loads_over_the_heading_and_drift_is_left_out_or_missed() -> None:
    scene = drifting(phase="actual")
    few, all_of_them = answers.strongest(scene.waves, 5), answers.strongest(scene.waves, 20)
    kept = np.isin(scene.waves.omega, few.omega)
    assert kept.sum() == 5
    hull, whole = few.hull(), scene.waves.hull()
    for name in ("force_by_heading", "drift_by_heading"):
        np.testing.assert_array_equal(getattr(hull, name).values, getattr(whole, name).values[:, kept])
    assert scene_digest(scene.copy(waves=all_of_them)) == scene_digest(scene)
    (less,) = [choice for choice in choices_of(drifting()) if choice.of == "slow drift of vessel"]
    calm = drifting(drift=False)
    (more,) = [choice for choice in missing_from(calm) if choice.of == "slow drift of vessel"]
    assert scene_digest(less.made(drifting())) == scene_digest(calm)
    assert scene_digest(more.made(calm)) == scene_digest(drifting())


@pytest.mark.slow("fits memories")
@pytest.mark.warns("RelativePlaceWarning", "MemoryFitWarning")
def test_hulls_that_do_not_feel_each_other_need_no_group() -> None:
    alone = barges(lid=None)
    (choice,) = [one for one in choices_of(alone) if one.of.startswith("coupling")]
    made = choice.made(alone)
    assert not made.groups and all(len(vessel.memory) for vessel in made.vessels.values())
    run, right = (sc.simulate(scene, 60.0)["position"] for scene in (made, alone))
    assert np.abs(run - right).max() < 0.02 * np.ptp(right, axis=0).max()
    near = barges()
    near_run, without = (
        sc.simulate(scene, 60.0)["position"] for scene in (near, answers.uncoupled(near, "two barges"))
    )
    assert np.abs(near_run - without).max() > 0.05


def test_the_least_set_takes_one_choice_about_each_thing_and_keeps_the_sum_of_changes() -> None:
    rows = []
    for name, of, share, change in (
        ("half", "waves", 0.9, 0.1), ("quarter", "waves", 0.8, 0.7), ("stiff", "lines", 0.5, 0.6),
        ("free", "drag", 0.7, -0.2), ("dearer", "memory", 1.2, 0.0), ("wrong", "oil", 0.01, 9.0),
    ):  # fmt: skip
        nothing = Choice(name=name, script="", made=lambda scene: scene, of=of)
        given = {"choice": nothing, "shares": (share, share), "changes": {"x": change}}
        rows.append(Loss(name=name, script="", of=of, **given))
    taken = {row.name for row in least_of(rows, {"x": 1.0}, {"x": 0.0})}
    assert taken == {"half", "stiff", "free"}
    assert taken == {row.name for row in least_of(rows[::-1], {"x": 1.0}, {"x": 0.0})}
    assert not least_of(rows, {"x": 0.05}, {"x": 0.0})
