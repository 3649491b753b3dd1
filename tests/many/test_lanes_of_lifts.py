"""Ordinary lifts side by side, in one run and in stages: as alone, together where they are alike."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from ensemble_studies import cart, luffed, pendulum
from hydraulic_scenes import raised
from marks import needs_lanes
from multibody_runs import struck
from stage_scenes import on_deck
from test_lanes import beside_and_alone, differences

from seacrane import Curve, Kept, Move, Run, Scene, Stage, Until, _core, cases, ensemble, shipped_database
from seacrane.scene import Gas, Stops

pytestmark = [needs_lanes, pytest.mark.filterwarnings("ignore::UserWarning")]
FINE = {"rtol": 1e-8, "dt_out": 0.1}


def lift(
    *,
    seed: int = 1,
    mass: float = 60e3,
    EA: float = 4e8,
    rung: str = "elastic",
    held: bool = True,
    **winch: Any,
) -> Scene:
    """The ordinary lift: shipped hull, held crane, a load on a winch's wire."""
    scene = Scene(name="ordinary")
    scene.add_vessel(shipped_database())
    scene.add_crane(slew=-1.2, s1=1.4, s2=1.0, held=held)
    winch = {"lag": 0.3, "maximum_rate": 1.0} | winch
    scene.add_hoist(mass=mass, size=(4.0, 4.0, 4.0), length=14.0, EA=EA, rung=rung, winch=winch)
    scene.add_sea(hs=1.5, tp=7.0, direction_deg=150.0, seed=seed, count=30)
    return scene


def compensated(*, seed: int) -> Scene:
    scene = lift(seed=seed)
    scene.add_heave_compensation("ahc", body="vessel", point=(10.0, 15.0, 20.0), winch="hoist", lag=0.1)
    return scene


def many_loads() -> Scene:
    scene = pendulum()
    scene.add_body(name="weight", mass=3.0, inertia=(0.1, 0.2, 0.1), position=(2.0, 0.5, -1.0))
    scene.add_spring("table", first="bob", second="weight", lengths=[0.5, 1.0, 3.0], forces=[0.0, 4.0, 9.0])
    scene.add_spring("spring", first="bob", second="weight", stiffness=30.0, damping=2.0, natural_length=1.0)
    scene.add_force("weight", name="push", point=(0.1, 0, 0), force=(1.0, 2.0, 3.0))
    scene.add_spring(name="damping", first="bob", second="weight", damping_ratio=0.2)
    rows = [(1.0, 0, 0, 0, 0, 0), (0, 4.0, 1.0, 0.5, 0, 0.2)]
    scene.add_force("weight", name="gust", times=[0.0, 5.0], force=rows)
    gas = Gas(area=1e-3, pressure=4e4, volume=0.1, exponent=1.3, length=3.0)
    stops = Stops(minimum=0.2, maximum=5.0)
    scene.add_spring("gas", first="ground", second="weight", gas=gas, damping=2.0, stops=stops)
    scene.add_friction("pin", load=0.4, speed=0.02)
    scene.add_stop(joint="pin", minimum=-2.0, maximum=2.0, stiffness=50.0)
    scene.add_wind(body="weight", frontal_area=0.3, lateral_area=0.5)
    scene.add_line(name="whip", bodies=["ground", "bob", "weight"], points=[(0, 0, 4), (0, 0, 0), (0, 0, 0)],
                   EA=3e3, length=5.0, sheaves={"radii": [0, 0.1, 0], "axes": [(0, 0, 0), (0, 1, 0), (0, 0,
                   0)], "efficiencies": [1, 0.98, 1]})  # fmt: skip
    return scene


MEMBERS: dict[str, Any] = {
    "seas": lambda: [lift(seed=seed) for seed in range(1, 5)],
    "compensated": lambda: [compensated(seed=seed) for seed in range(1, 5)],
    "many loads": lambda: [many_loads()] * 4,
    "hydraulics": lambda: [raised(mass=1000.0)] * 4,
    "masses": lambda: [lift(mass=mass) for mass in (40e3, 50e3, 60e3, 70e3)],
    "EA": lambda: [lift(EA=EA, rung="quasi-static") for EA in (2e8, 3e8, 4e8, 5e8)],
    "lag": lambda: [lift(lag=lag) for lag in (0.1, 0.2, 0.3, 0.4)],
}


@pytest.mark.parametrize("of", MEMBERS)
def test_lanes_may_differ_in_seas_masses_and_loads(of: str) -> None:
    scenes = MEMBERS[of]()
    if of != "many loads":  # whose rope comes to its sheave on the way
        runs = [Run(scene, 1.0, formulation="recursive", rtol=1e-3) for scene in scenes]
        assert _core.kept_apart([run.core for run in runs]) == ""
    assert differences(scenes, 3, 1e-4, at=[0.0, 0.7, 4.1].__getitem__) < 1e-10


def in_both(source: Any, **study: Any) -> tuple[Any, Any]:
    """Datasets alone and in lanes."""
    alone, beside = (ensemble(source, lanes=lanes, **study) for lanes in (1, 4))
    assert alone.failures == beside.failures == {}
    return alone.dataset, beside.dataset


HOOK = Kept(channel="hook_load", interval=1.0)


@pytest.mark.parametrize(
    "method", [{"rtol": 1e-8}, *({"integrator": name, "dt": 0.01} for name in ("rk4", "rk-low-storage"))]
)
def test_seeds_of_a_lift_run_side_by_side_as_alone(method: dict[str, Any]) -> None:
    source = compensated if "rtol" in method else lift
    over = {"seed": [1, 2, 3, 4]}
    alone, beside = in_both(source, over=over, keep={"hook": HOOK}, t_end=6.0, dt_out=1.0, **method)
    assert (beside.kept_apart == "").all()
    bound = 1e-5 if "rtol" in method else 1e-9
    assert np.abs(beside.hook - alone.hook).max() < bound * np.abs(alone.hook).max()


def driven(*, seed: int) -> Scene:
    """A quasi-static wire on a crane that drivers move in all its joints."""
    scene = lift(seed=seed, rung="quasi-static", held=False)
    for joint, way in (("A", 0.1), ("main_cylinder", 0.1), ("knuckle_cylinder", -0.05)):
        curve = Curve.quintic(start_time=0.5, end_time=4.0, start=0.0, end=way)
        scene.add_driver(joint=joint, curve=curve)
    return scene


def on_a_link(*, seed: int) -> Scene:
    return cases.case2(seed=seed, hs=2.0, count=30)


@pytest.mark.parametrize("method", [{"rtol": 1e-9}, {"integrator": "rk4", "dt": 0.01}])
@pytest.mark.parametrize(
    ("source", "channels"),
    [(on_a_link, ["hook_load", "acceleration"]), (driven, ["hook_load", "driver_force", "acceleration"])],
)
def test_what_is_solved_for_has_outputs_and_peaks_as_alone(
    source: Any, channels: list[str], method: dict[str, Any]
) -> None:
    keep: dict[str, Any] = {
        f"{name}_{what}": f"{name}.{what}" for name in channels for what in ("max", "min")
    }
    keep |= {name: Kept(channel=name, interval=0.7) for name in channels}
    over = {"seed": [1, 2, 3]}
    alone, beside = in_both(source, over=over, keep=keep, t_end=4.2, dt_out=0.7, **method)
    assert (beside.kept_apart == "").all()
    bound = 1e-4 if "rtol" in method else 1e-9
    for name in keep:
        scale = np.abs(alone[name]).max()
        assert np.abs(beside[name] - alone[name]).max() < bound * scale, name
    for name in channels:
        along = [dim for dim in beside[name].dims if "time" in dim]
        above = beside[f"{name}_max"] - beside[name].max(along)
        below = beside[name].min(along) - beside[f"{name}_min"]
        assert min(above.min(), below.min()) >= 0.0 and max(above.max(), below.max()) > 0.0, name


def test_a_stage_that_has_the_time_of_an_output_is_not_taken_for_it() -> None:
    # verner65 has one in the middle of a step, where every other output is.
    method = {"integrator": "verner65", "rtol": 1e-2, "maximum_step": 0.0625, "t_end": 1.0, "dt_out": 0.03125}
    keep = {"hook": Kept(channel="hook_load", interval=0.03125)}
    alone, beside = in_both(on_a_link, over={"seed": [1, 2, 3]}, keep=keep, **method)
    assert np.abs(beside.hook - alone.hook).max() < 1e-10 * np.abs(alone.hook).max()


def stopped(start: float) -> Scene:
    scene = pendulum(start=1.0)
    scene.replace("bob", angular_velocity=(0.0, start, 0.0), velocity=(0.0, 0.0, -start))
    scene.add_stop(joint="pin", minimum=-0.6, maximum=0.6, stiffness=200.0)
    return scene


def test_all_lanes_end_a_step_where_one_meets_a_kink() -> None:
    """Two of four swing against their stop."""
    runs, off = beside_and_alone([stopped(one) for one in (0.0, 3.0, 0.1, -3.5)], t_end=0.35, dt_out=0.05)
    assert max(off) < 1e-7
    assert all("kept_apart" not in run.lanes for run in runs)
    reached = [float(np.abs(run.result()["position"][:, 0, 2]).max()) for run in runs]
    assert [far > 0.6 for far in reached] == [False, True, False, True]


def test_drivers_move_all_lanes_and_strike_them() -> None:
    runs, off = beside_and_alone([struck(one) for one in (1.0, 2.0, 3.0, 4.0)], t_end=1.5, dt_out=0.25)
    assert all("kept_apart" not in run.lanes for run in runs)
    assert max(off) < 1e-7
    assert abs(float(runs[0].result()["velocity"][-1, 0, 0]) - 1.5) < 1e-9


def hoist(name: str, rate: float) -> Stage:
    return Stage(name=name, duration=3.0, commands={"hoist.rate": rate})


HOIST = [Stage(name="wait", duration=2.0), hoist("raise", -0.4), hoist("hold", 0.0)]
KEEP = {"hook": HOOK, "raised": "line_unstretched_length[stage=hold].min", "end": "stage[raise].end"}


@pytest.mark.parametrize("rung", ["elastic", "quasi-static"])
def test_stages_that_end_at_times_run_side_by_side_as_alone(rung: str) -> None:
    alone, beside = in_both(lift(rung=rung), stages=HOIST, over={"seed": [1, 2, 3, 4]}, keep=KEEP, **FINE)
    assert (beside.kept_apart == "").all()
    assert beside.attrs["side_by_side"] == "4 in 4 lanes"
    for name in KEEP:
        assert np.abs(beside[name] - alone[name]).max() < 1e-5 * np.abs(alone[name]).max(), name
    assert float(np.abs(alone.hook[0] - alone.hook[1]).max()) > 1e3


def test_members_whose_stages_end_at_their_own_times_meet_again() -> None:
    """Ends as the ship rolls: at another time in every sea."""
    leans = Until.channel("vessel_motion", motion="roll", maximum=-0.3)
    first = Stage(name="raise", until=leans, maximum_duration=60.0, commands={"hoist.rate": -0.1})
    stages = [first, Stage(name="hold", duration=4.0, commands={"hoist.rate": 0.0})]
    keep = {"end": KEEP["end"], "hook": "hook_load[hoist, stage=hold].max"}
    source = lift(rung="quasi-static")
    alone, beside = in_both(source, stages=stages, over={"seed": [1, 2, 3, 4]}, keep=keep, **FINE)
    ends = alone.end.to_numpy()
    assert len(set(ends.tolist())) == 4
    assert np.abs(beside.end - alone.end).max() < 1e-5
    assert np.abs(beside.hook - alone.hook).max() < 1e-5 * np.abs(alone.hook).max()
    told = sorted(beside.kept_apart.to_numpy().tolist())
    assert told[:3] == [""] * 3 and told[3].startswith("from t = ") and "no other lift is alike" in told[3]


PULL = [Stage(name="stand", duration=1.0),
        Stage(name="pull", duration=3.0, commands={"rail.displacement": Move(to=1.0, over=2.0)})]  # fmt: skip
CART = {"x": Kept(channel="position", names={"body": "cart", "axis": "x"}, interval=0.5)}


@pytest.mark.parametrize("given", [{"t_end": 3.0}, {"stages": PULL}])
def test_the_order_of_names_changes_nothing(given: Any) -> None:
    """To the bit, nor who is beside whom: masses in lanes of one kind of joint."""
    over = {"seed": [1, 2, 3], "mass": [9.0, 4.0], "kind": ["prismatic", "cylindrical"]}
    orders = [["seed", "mass", "kind"], ["kind", "mass", "seed"], ["mass", "kind", "seed"]]
    study = {"keep": CART, "lanes": 4, "dt_out": 0.1, "rtol": 1e-5, **given}
    found = [ensemble(cart, over={name: over[name] for name in order}, **study).dataset for order in orders]
    for other in found[1:]:
        assert np.array_equal(other.x.transpose(*found[0].x.dims), found[0].x)
    assert all((one.kept_apart == "").all() for one in found)


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
