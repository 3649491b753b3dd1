"""Lifts in stages side by side: as alone, together where they are alike at one time."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import pytest
from ensemble_studies import cart, luffed
from marks import needs_lanes
from stage_scenes import on_deck

from seacrane import Kept, Move, Scene, Stage, Until, ensemble, shipped_database

pytestmark = [
    needs_lanes,
    pytest.mark.filterwarnings("ignore::UserWarning"),
]
FINE = {"rtol": 1e-8, "dt_out": 0.1}


def hoist(name: str, rate: float) -> Stage:
    return Stage(name=name, duration=3.0, commands={"hoist.rate": rate})


HOIST = [Stage(name="wait", duration=2.0), hoist("raise", -0.4), hoist("hold", 0.0)]
HOOK = Kept(channel="hook_load", interval=0.5)
KEEP = {"hook": HOOK, "raised": "line_unstretched_length[stage=hold].min", "end": "stage[raise].end"}


@cache
def lift(rung: str = "quasi-static") -> Scene:
    scene = Scene(name="hoisting")
    scene.add_vessel(shipped_database())
    scene.add_crane(slew=-1.2, s1=1.4, s2=1.0)
    winch = {"lag": 0.3, "maximum_rate": 1.0}
    scene.add_hoist(mass=60e3, size=(4.0, 4.0, 4.0), length=14.0, EA=4e8, rung=rung, winch=winch)
    scene.add_sea(hs=1.5, tp=7.0, direction_deg=150.0, seed=1, count=30)
    return scene


def in_both(source: Any, **study: Any) -> tuple[Any, Any]:
    """Datasets alone and in lanes."""
    alone, beside = (ensemble(source, lanes=lanes, **study) for lanes in (1, 4))
    assert alone.failures == beside.failures == {}
    return alone.dataset, beside.dataset


@pytest.mark.parametrize("rung", ["elastic", "quasi-static"])
def test_stages_that_end_at_times_run_side_by_side_as_alone(rung: str) -> None:
    alone, beside = in_both(lift(rung), stages=HOIST, over={"seed": [1, 2, 3, 4]}, keep=KEEP, **FINE)
    assert (beside.kept_apart == "").all()
    assert beside.attrs["side_by_side"] == "4 in 4 lanes"
    for name in KEEP:
        assert np.abs(beside[name] - alone[name]).max() < 1e-5 * np.abs(alone[name]).max(), name
    assert float(np.abs(alone.hook[0] - alone.hook[1]).max()) > 1e3


def rolling() -> list[Stage]:
    """Ends as the ship rolls: at another time in every sea."""
    leans = Until.channel("vessel_motion", motion="roll", maximum=-0.3)
    up, hold = {"hoist.rate": -0.1}, {"hoist.rate": 0.0}
    first = Stage(name="raise", until=leans, maximum_duration=60.0, commands=up)
    return [first, Stage(name="hold", duration=4.0, commands=hold)]


def test_members_whose_stages_end_at_their_own_times_meet_again() -> None:
    keep = KEEP | {"hook": "hook_load[hoist, stage=hold].max"}
    alone, beside = in_both(lift(), stages=rolling(), over={"seed": [1, 2, 3, 4]}, keep=keep, **FINE)
    ends = alone.end.to_numpy()
    assert len(set(ends.tolist())) == 4
    assert np.abs(beside.end - alone.end).max() < 1e-5
    assert np.abs(beside.hook - alone.hook).max() < 1e-5 * np.abs(alone.hook).max()
    told = sorted(beside.kept_apart.to_numpy().tolist())
    assert told[:3] == [""] * 3 and told[3].startswith("from t = ") and "no other lift is alike" in told[3]


PULL = [
    Stage(name="stand", duration=1.0),
    Stage(name="pull", duration=3.0, commands={"rail.displacement": Move(to=1.0, over=2.0)}),
]
CART = {"x": Kept(channel="position", names={"body": "cart", "axis": "x"}, interval=0.5)}
OVER = {"seed": [1, 2, 3], "mass": [9.0, 4.0], "kind": ["prismatic", "cylindrical"]}


@pytest.mark.parametrize("stages", [(), PULL])
def test_the_order_of_names_changes_nothing(stages: Any) -> None:
    """To the bit, nor who is beside whom: masses in lanes of one kind of joint."""
    study = {"keep": CART, "lanes": 4, "dt_out": 0.1, "rtol": 1e-5, "stages": stages}
    study |= {} if stages else {"t_end": 3.0}
    orders = [["seed", "mass", "kind"], ["kind", "mass", "seed"], ["mass", "kind", "seed"]]
    found = [ensemble(cart, over={name: OVER[name] for name in order}, **study).dataset for order in orders]
    for other in found[1:]:
        assert np.array_equal(other.x.transpose(*found[0].x.dims), found[0].x)
        assert (other.kept_apart.transpose(*found[0].kept_apart.dims) == found[0].kept_apart).all()
    assert (found[0].kept_apart == "").all()


def test_kinds_that_cannot_share_are_no_neighbours() -> None:
    """With a seed of one value, neighbours by mass would be of both kinds."""
    over = {"kind": ["prismatic", "cylindrical"], "mass": [4.0, 5.0, 6.0, 7.0], "seed": [1]}
    for names in (["kind", "mass", "seed"], ["mass", "kind", "seed"]):
        told = ensemble(
            cart, over={name: over[name] for name in names}, keep=CART, lanes=4, t_end=1.0, dt_out=0.1
        ).dataset
        assert told.attrs["side_by_side"] == "8 in 4 lanes"


def test_lifts_on_different_sides_go_beside_those_on_their_own() -> None:
    """Their models share what lanes share: where their cylinders stand is seen in the runs alone."""
    turn = Kept(channel="quaternion", names={"body": "rod"}, interval=0.1)
    keep = {"turn": turn, "lanes": lambda result: float(result.stats.get("lanes", 1))}
    stages = [Stage(name="fall", duration=0.5), Stage(name="on", duration=0.3)]
    over = [{"turned": 0}, {"turned": 1}] * 2
    alone, beside = in_both(luffed, stages=stages, over=over, keep=keep, **FINE)
    assert (beside.kept_apart == "").all() and (beside.lanes == 4).all()
    assert np.abs(beside.turn - alone.turn).max() < 1e-6
    assert np.abs(alone.turn[0] - alone.turn[1]).max() > 0.1


def test_stages_with_limits_are_run_as_alone_and_say_why() -> None:
    scene = on_deck(damping_ratio=0.1)
    scene.add_body(name="tug", mass=2.0, size=(1.0, 1.0, 1.0), position=(40.0, 0.0, 0.0))
    stages = [Stage(name="hold", duration=0.5), Stage(name="up", duration=1.0, commands={"hoist.rate": -0.1})]
    over = {"loads.hoist.EA": [4e7, 5e7]}
    alone, beside = in_both(scene, stages=stages, over=over, keep={"t": "line_tension.max"}, dt_out=0.1)
    assert np.array_equal(alone.t, beside.t)
    assert (beside.kept_apart == "it has limits").all()
    assert beside.attrs["side_by_side"] == "0 in 4 lanes, by themselves 2 (it has limits)"


@pytest.mark.parametrize("integrator", ["rk4", "rk-low-storage"])
def test_fixed_steps_run_side_by_side_as_alone(integrator: str) -> None:
    how = {"t_end": 4.0, "dt_out": 0.5, "integrator": integrator, "dt": 0.01}
    alone, beside = in_both(lift(), over={"seed": [1, 2, 3, 4]}, keep={"hook": HOOK}, **how)
    assert (beside.kept_apart == "").all()
    assert np.abs(beside.hook - alone.hook).max() < 1e-9 * np.abs(alone.hook).max()
