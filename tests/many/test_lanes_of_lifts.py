"""Ordinary lifts side by side: loads lane by lane, parameters that differ, kinks, drivers."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from ensemble_studies import pendulum
from hydraulic_scenes import raised
from marks import needs_lanes

from seacrane import Curve, Kept, Run, Scene, _core, ensemble, shipped_database
from seacrane.run.lanes import advance_side_by_side, module_of

pytestmark = [
    needs_lanes,
    pytest.mark.filterwarnings("ignore::UserWarning"),
]


def lift(*, seed: int = 1, mass: float = 60e3, EA: float = 4e8, rung: str = "elastic", **winch: Any) -> Scene:
    """The ordinary lift: shipped hull, held crane, a load on a winch's wire, wind on it."""
    scene = Scene(name="ordinary")
    scene.add_vessel(shipped_database())
    scene.add_crane(slew=-1.2, s1=1.4, s2=1.0)
    winch = {"lag": 0.3, "maximum_rate": 1.0} | winch
    scene.add_hoist(mass=mass, size=(4.0, 4.0, 4.0), length=14.0, EA=EA, rung=rung, winch=winch)
    scene.add_sea(hs=1.5, tp=7.0, direction_deg=150.0, seed=seed, count=40)
    return scene


def compensated(*, seed: int) -> Scene:
    scene = lift(seed=seed)
    scene.add_heave_compensation("ahc", body="vessel", point=(10.0, 15.0, 20.0), winch="hoist", lag=0.1)
    return scene


def many_loads(*, seed: int) -> Scene:
    """A pendulum with a load of most kinds."""
    scene = pendulum(start=1.0 + 0.0 * seed)
    scene.add_body(name="weight", mass=3.0, inertia=(0.1, 0.2, 0.1), position=(2.0, 0.5, -1.0))
    scene.add_spring("table", first="bob", second="weight", lengths=[0.5, 1.0, 3.0], forces=[0.0, 4.0, 9.0])
    scene.add_gas_spring(
        "gas", first="ground", second="weight", area=1e-3, pressure=4e4, volume=0.1, length=3.0, exponent=1.3,
        damping=2.0, minimum=0.2, maximum=5.0,
    )  # fmt: skip
    scene.add_friction("pin", load=0.4, speed=0.02)
    scene.add_soft_stop(joint="pin", minimum=-2.0, maximum=2.0, stiffness=50.0)
    scene.add_air_drag("weight", frontal_area=0.3, lateral_area=0.5)
    scene.add_line(
        name="whip", bodies=["ground", "bob", "weight"], points=[(0, 0, 4), (0, 0, 0), (0, 0, 0)], EA=3e3,
        length=5.0, radii=[0, 0.1, 0], axes=[(0, 0, 0), (0, 1, 0), (0, 0, 0)], efficiencies=[1, 0.98, 1],
    )  # fmt: skip
    return scene


KINDS: dict[str, Callable[..., Scene]] = {
    "elastic": lift,
    "quasi-static": lambda seed: lift(seed=seed, rung="quasi-static"),
    "compensated": compensated,
    "many loads": many_loads,
    "hydraulics": lambda seed: raised(mass=1000.0),
}


def worst(scenes: list[Scene], spread: float) -> float:
    """Of rates at random states, over the largest of each lane."""
    evaluator = _core.LaneEvaluator(module_of(4), [scene.compile() for scene in scenes])
    start, rng = evaluator.start(), np.random.default_rng(1)
    off = 0.0
    for t in (0.0, 0.7, 4.1):
        state = start + spread * rng.normal(size=start.shape)
        alone = evaluator.scalar_derivative(t, state)
        apart = np.abs((evaluator.derivative(t, state) - alone) / np.abs(alone).max(axis=1)[:, None])
        off = max(off, float(apart.max()))
    return off


@pytest.mark.parametrize("kind", KINDS)
def test_an_evaluation_is_that_of_each_lane(kind: str) -> None:
    assert worst([KINDS[kind](seed=seed) for seed in range(1, 5)], 1e-4) < 1e-10


@pytest.mark.parametrize(
    "over", [{"mass": (40e3, 50e3, 60e3, 70e3)}, {"EA": (2e8, 3e8, 4e8, 5e8)}, {"lag": (0.1, 0.2, 0.3, 0.4)}]
)
@pytest.mark.parametrize("rung", ["elastic", "quasi-static"])
def test_lanes_may_differ_in_masses_and_loads(over: dict[str, tuple[float, ...]], rung: str) -> None:
    ((name, values),) = over.items()
    scenes = [lift(rung=rung, **{name: value}) for value in values]
    runs = [Run(scene, 1.0, formulation="recursive", rtol=1e-3) for scene in scenes]
    assert _core.kept_apart([run.core for run in runs]) == ""
    assert worst(scenes, 1e-4) < 1e-10


@pytest.mark.parametrize("kind", ["elastic", "quasi-static", "compensated"])
def test_seeds_of_an_ordinary_lift_run_side_by_side_as_alone(kind: str) -> None:
    study = {"over": {"seed": [1, 2, 3, 4]}, "t_end": 8.0, "rtol": 1e-8, "dt_out": 1.0}
    study["keep"] = {"hook": Kept(channel="hook_load", interval=1.0)}
    alone, beside = (ensemble(KINDS[kind], lanes=lanes, **study).dataset for lanes in (1, 4))
    assert (beside.kept_apart == "").all()
    assert np.abs(beside.hook - alone.hook).max() < 1e-5 * np.abs(alone.hook).max()


def stopped(start: float, stiffness: float = 200.0) -> Scene:
    scene = pendulum(start=1.0)
    scene.replace("bob", angular_velocity=(0.0, start, 0.0), velocity=(0.0, 0.0, -start))
    scene.add_soft_stop(joint="pin", minimum=-0.6, maximum=0.6, stiffness=stiffness)
    return scene


def test_all_lanes_end_a_step_where_one_meets_a_kink() -> None:
    """Two of four swing against their stop."""
    given = {"t_end": 0.35, "rtol": 1e-9, "formulation": "recursive", "dt_out": 0.05}
    starts = (0.0, 3.0, 0.1, -3.5)
    runs, alone = ([Run(stopped(one), **given) for one in starts] for _ in range(2))
    assert advance_side_by_side(runs, 4, lambda _: None)
    for run, one in zip(runs, alone, strict=True):
        one.advance(0.35)
        assert np.abs(run.result()["position"] - one.result()["position"]).max() < 1e-7
    assert all("kept_apart" not in run.lanes for run in runs)
    reached = [float(np.abs(run.result()["position"][:, 0, 2]).max()) for run in runs]
    assert [far > 0.6 for far in reached] == [False, True, False, True]


def struck(bob: float) -> Scene:
    scene = Scene(name="struck")
    scene.add_body("cart", mass=3.0, inertia=(1.0, 1.0, 1.0))
    scene.add_joint("rail", kind="prismatic", first="ground", second="cart", axis=(1.0, 0.0, 0.0))
    runs = Curve.table([0.5, 4.0], [0.0, 5.25], between="linear")
    scene.add_driver("rail", curve=Curve.constant(value=0.0).then(time=0.5, curve=runs))
    scene.add_body("bob", mass=bob, inertia=(0.3, 0.3, 0.3), position=(0.2, 0.0, -1.0))
    scene.add_joint("pin", kind="revolute", first="cart", second="bob", point=(0, 0, 0), axis=(0, 1, 0))
    return scene


def test_drivers_move_all_lanes_and_strike_them() -> None:
    given = {"t_end": 1.5, "rtol": 1e-9, "formulation": "recursive", "dt_out": 0.25}
    runs, alone = ([Run(struck(one), **given) for one in (1.0, 2.0, 3.0, 4.0)] for _ in range(2))
    assert advance_side_by_side(runs, 4, lambda _: None)
    assert all("kept_apart" not in run.lanes for run in runs)
    for run, one in zip(runs, alone, strict=True):
        one.advance(1.5)
        for name in ("position", "velocity"):
            assert np.abs(run.result()[name] - one.result()[name]).max() < 1e-7
    assert abs(float(runs[0].result()["velocity"][-1, 0, 0]) - 1.5) < 1e-9
