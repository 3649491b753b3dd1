"""Loops that held strokes lock are one body: counts, equal motion and forces, what stays apart."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from test_merge import FORMULATIONS, recorded

from seacrane import Curve, Run, Scene, SeacraneError, _core, shipped_database, simulate

Array = NDArray[np.float64]

ROPE = {"EA": 2e8, "rung": "elastic"}
PARTS = [f"{jib}_{part}" for jib in ("main", "knuckle") for part in ("jib", "barrel", "rod")]
CRANE = sorted(["tower", "king", *PARTS])


def lift(**crane: Any) -> Scene:
    """A held crane on the shipped hull, with 40 t on a line that swings."""
    scene = Scene(name="held")
    scene.add_vessel(shipped_database())
    scene.add_crane(slew=-1.0, s1=1.5, s2=1.0, **crane)
    scene.add_hoist(mass=40e3, size=(4.0, 4.0, 3.0), length=12.0, **ROPE)
    scene.replace("load", velocity=(0.4, 0.2, 0.0))
    scene.add_sea(hs=1.5, tp=7.0, direction_deg=150.0, seed=2)
    return scene


def test_a_held_crane_is_one_body_with_its_ship_and_held_strokes_leave_the_slew_that_moves() -> None:
    model = lift().compile()
    assert sorted(model.merge["bodies"]["vessel"]) == CRANE
    assert (model.merge["coordinates"], model.merge["constraints"]) == (12, 0)
    assert len(model.merge["locked_by"]) == 3
    assert model.tree["loop_rows"] == 0
    scene = lift(held=False)
    for joint in ("main_cylinder", "knuckle_cylinder"):
        scene.add_driver(joint, curve=0.0)
    scene.add_driver("A", curve=Curve.quintic(start_time=1.0, end_time=9.0, start=0.0, end=0.5))
    model = scene.compile()
    assert sorted(model.merge["bodies"]["king"]) == [name for name in CRANE if name not in ("king", "tower")]
    assert model.merge["bodies"]["vessel"] == ["tower"]
    assert model.merge["coordinates"] - model.merge["constraints"] == 12


@pytest.mark.warns("BallastWarning")
@pytest.mark.parametrize("formulation", FORMULATIONS)
def test_a_run_at_a_fixed_step_is_that_of_the_joints(formulation: str) -> None:
    """Of the largest of their kind, with the minimum norm of what is redundant."""
    how = {"t_end": 4.0, "dt_out": 0.5, "integrator": "rk4", "dt": 0.002}
    merged = recorded(lift(), merge=True, formulation=formulation, **how)
    full = recorded(lift(), merge=False, formulation="redundant", **how)
    loads = ("acceleration", "reaction_force", "reaction_moment", "driver_force", "line_tension")
    for name in ("position", "velocity", *loads):
        scale = np.abs(full[name]).max()
        assert scale > 0.0
        assert np.abs(merged[name] - full[name]).max() < 1e-8 * scale, name
        assert name not in loads or np.abs(merged[name][0] - full[name][0]).max() < 1e-10 * scale, name
    work = np.abs(full["absolute_work"]).max()
    assert np.abs(merged["energy_balance"]).max() < 1e-6 * work


CRANK_END, ROCKER_FOOT = 2.0 * np.array([np.cos(1.1), np.sin(1.1)]), np.array([6.0, 0.0])  # x, z, m
ROCKER = 4.0  # m


def elbow(coupler: float, side: float) -> Array:
    """Where coupler and rocker meet, on either side of the line between their other ends."""
    far = float(np.linalg.norm(ROCKER_FOOT - CRANK_END))
    unit = (ROCKER_FOOT - CRANK_END) / far
    along = (coupler**2 - ROCKER**2 + far**2) / (2.0 * far)
    up = np.sqrt(max(coupler**2 - along**2, 0.0))
    return CRANK_END + along * unit + side * up * np.array([-unit[1], unit[0]])


def four_bar(*, coupler: float = 5.0, held: bool = True) -> Scene:
    """A crank of 2 m whose angle may be held, a coupler, a rocker of 4 m, 6 m of ground, and a bob."""
    scene = Scene(name="four bar")
    corners = [np.zeros(2), CRANK_END, elbow(coupler, 1.0), ROCKER_FOOT]
    for name, first, second in zip(("crank", "coupler", "rocker"), corners, corners[1:], strict=False):
        x, z = 0.5 * (first + second)
        scene.add_body(name, mass=10.0, inertia=(1.0, 1.0, 1.0), position=(x, 0.0, z))
    for i, ends in enumerate(pairwise(("ground", "crank", "coupler", "rocker", "ground"))):
        point = (corners[i][0], 0.0, corners[i][1])
        scene.add_joint(
            f"pin {i}", kind="revolute", first=ends[0], second=ends[1], point=point, axis=(0.0, 1.0, 0.0)
        )
    if held:
        scene.add_driver("pin 0", curve=0.0)
    x, z = corners[2]
    scene.add_body("bob", mass=5.0, inertia=(1.0, 1.0, 1.0), position=(x, 0.0, z - 3.0))
    scene.add_joint("hang", kind="spherical", first="rocker", second="bob", point=(x, 0.0, z))
    return scene


@pytest.mark.filterwarnings("ignore")
def test_a_four_bar_is_rigid_under_a_held_crank_but_not_at_a_dead_centre() -> None:
    """Coupler and rocker in line: there the loop yields to first order, though the crank is held."""
    assert four_bar().compile().merge["bodies"] == {"ground": ["crank", "coupler", "rocker"]}
    assert four_bar(held=False).compile().merge["bodies"] == {}
    merged = four_bar(coupler=float(np.linalg.norm(ROCKER_FOOT - CRANK_END)) - ROCKER).compile().merge
    assert merged["bodies"] == {"ground": ["crank"]}


@pytest.mark.warns("RedundantJointsWarning")
def test_a_state_that_closes_in_the_other_way_is_refused_by_name() -> None:
    """Coupler and rocker folded to the other side of the line between their ends."""
    scene = four_bar()
    model = scene.compile()
    values = np.array(model.initial_state)
    near, far = elbow(5.0, 1.0), elbow(5.0, -1.0)
    for name, held in (("coupler", CRANK_END), ("rocker", ROCKER_FOOT)):
        turn = float(np.subtract(*(np.arctan2(*(end - held)[::-1]) for end in (near, far))))
        at = model.pose_index(list(model.bodies).index(name))
        x, z = 0.5 * (held + far)
        values[at : at + 7] = x, 0.0, z, np.cos(0.5 * turn), 0.0, np.sin(0.5 * turn), 0.0
    at = model.pose_index(list(model.bodies).index("bob"))
    values[at : at + 3] = far[0], 0.0, far[1] - 3.0
    start = _core.State(
        time=0.0, values=values, inputs=np.zeros(model.slots), parts=list(_core.initial_state(model).parts)
    )
    with pytest.raises(SeacraneError, match=r"body '(coupler|rocker)' is .* m from where it is held"):
        simulate(scene, 1.0, start=start)
    run = Run(scene, t_end=0.1, model=scene.compile(merge=False), start=start)
    run.advance(0.1)


def test_a_load_on_a_seat_lifts_off_when_the_joints_say() -> None:
    """Limits make a model for each set; nothing moves in the first, and the crane is ground in the second."""
    found = []
    for merge in (True, False):
        scene = Scene(name="on deck")
        scene.add_crane(base="ground", s1=1.5, s2=1.0)
        scene.add_hoist(mass=2e4, size=(4.0, 4.0, 3.0), on="ground", winch={"lag": 0.1, "rate": -0.1}, **ROPE)
        run = Run(scene, t_end=3.0, model=scene.compile(merge=merge), rtol=1e-9)
        run.advance(3.0)
        ((lifted, _, kind, *_),) = run.core.events()
        assert kind == "release" and lifted > 0.1
        found.append([lifted, *run.core.channels()["line_tension"][-1]])
    assert found[0] == pytest.approx(found[1], rel=1e-6)
