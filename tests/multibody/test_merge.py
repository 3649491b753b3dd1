"""Bodies that move as one are stepped as one, locked loops too: counts, equal motion, what stays apart."""

from __future__ import annotations

import ctypes
from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from seacrane import Curve, Run, Scene, SeacraneError, _core, cases, shipped_database, simulate
from seacrane.arrays import Array
from seacrane.scene.wind_current import FlowCoefficients

# Assembly makes consistent what some scenes describe roughly, on purpose.
pytestmark = pytest.mark.filterwarnings("ignore::seacrane.warnings.AssemblyWarning")

TURNED = np.array([0.8, 0.2, -0.4, 0.4])  # unit quaternion
FORCE = ctypes.CFUNCTYPE(None, ctypes.c_double, *[ctypes.POINTER(ctypes.c_double)] * 3)


@FORCE
def fin(_t: float, state: Any, _parameters: Any, wrench: Any) -> None:
    """Depends on the described body's own point, velocity and orientation."""
    wrench[0] = -0.3 * state[7] + state[4]
    wrench[1] = 2.0 * state[5]
    wrench[2] = -0.5 * state[2]
    wrench[4] = 0.4 * state[3] - 0.1 * state[10]


def recorded(scene: Scene, *, merge: bool, t_end: float = 2.0, **settings: Any) -> dict[str, Any]:
    model = scene.compile(merge=merge)
    settings = {"rtol": 1e-10, "dt_out": 0.25} | settings
    run = Run(scene, t_end=t_end, model=model, channels=model.channel_names(defaults_only=False), **settings)
    run.advance(t_end)
    return dict(run.core.channels())


MOTION = ("position", "velocity", "angular_velocity", "acceleration")


def compare(scene: Scene, bound: float, **settings: Any) -> None:
    """Runs with and without merging agree within `bound` of the largest value of each channel."""
    merged, full = recorded(scene, merge=True, **settings), recorded(scene, merge=False, **settings)
    assert set(merged) == set(full)
    for name in (*MOTION, "reaction_force", "reaction_moment"):
        scale = np.abs(full[name]).max()
        assert scale > 0.0, name
        assert np.abs(merged[name] - full[name]).max() <= bound * scale, name
    work = 1.0 + np.abs(full["absolute_work"]).max()
    assert np.abs(merged["energy_balance"] - full["energy_balance"]).max() <= 10.0 * bound * work
    # Kinks where a power changes sign, outside the error norm.
    assert np.abs(merged["absolute_work"] - full["absolute_work"]).max() <= 1e-5 * work


def askew(**settings: Any) -> Scene:
    """A floating body, two others welded on at odd angles, and a bob hinged to one of them."""
    scene = Scene(gravity=9.81, **settings)
    drift = {"velocity": (0.4, 0.0, 0.1)}
    scene.add_body(name="a", mass=4.0, inertia=[0.5, 0.7, 0.9], **drift)
    place = {"position": (1.0, 0.3, 0.2), "quaternion": TURNED, "center_of_mass": (0.1, -0.2, 0.05)}
    scene.add_body(name="b", mass=2.0, inertia=[0.3, 0.4, 0.5], **place, **drift)
    scene.add_body(name="c", mass=1.0, inertia=[0.2] * 3, position=(1.0, 1.1, -0.3), gravity=False, **drift)
    scene.add_body(name="bob", mass=1.5, inertia=[0.1] * 3, position=(2.0, 1.0, -0.3), **drift)
    scene.add_joint(kind="weld", name="ab", first="a", second="b", point=(0.7, 0.1, 0.0))
    scene.add_joint(kind="weld", name="cb", first="c", second="b", point=(1.0, 0.7, 0.0))
    pin = {"point": (1.4, 1.0, -0.3), "axis": (0.2, 1.0, 0.3)}
    scene.add_joint(kind="revolute", name="pin", first="c", second="bob", **pin)
    return scene


def with_loads(scene: Scene) -> Scene:
    """Every kind of load on the bodies welded on."""
    scene.add_force("b", name="thrust", point=(0.1, 0.2, 0.3), force=(3, -2, 9), body_axes=True)
    scene.add_force("c", name="lift", point=(0.0, 0.2, 0.0), force=(0.0, 0.0, 60.0))
    scene.add_spring(name="line", first="b", second="bob", stiffness=40.0, damping=2.0, natural_length=0.5)
    scene.add_spring(name="inner", first="a", second="c", stiffness=400.0, damping=5.0, natural_length=0.5)
    scene.add_actuator(name="motor", joint="pin", stiffness=5.0, damping=0.5)
    loads = [[1.0, 0.0, 2.0, 0.0, 0.5, 0.0], [0.0, 3.0, 1.0, 0.2, 0.0, 0.0]]
    scene.add_force("b", name="table", times=[0.0, 3.0], force=loads, point=(0.0, 0.1, 0.3))
    scene.add_force("b", name="fin", force=fin)
    angle = np.linspace(-np.pi, np.pi, 13)[:-1]
    wind = FlowCoefficients(
        angle=angle, x=np.cos(angle), y=np.sin(angle), yaw=0.1 * np.sin(2.0 * angle) + 0.05 * np.sin(angle)
    )
    sizes = {"frontal_area": 0.5, "lateral_area": 0.8, "length": 1.5}
    scene.add_wind(coefficients=wind, speed=6.0, direction_deg=40.0, body="b", point=(0, 0.2, 0.1), **sizes)
    return scene


@pytest.mark.parametrize(
    ("formulation", "orientation"), [("redundant", "euler_xyz"), ("recursive", "quaternion")]
)
def test_every_load_on_welded_bodies_acts_as_before(formulation: str, orientation: str) -> None:
    scene = with_loads(askew(orientation=orientation))
    compare(scene, 2e-8, formulation=formulation, t_end=1.0)


def test_accelerations_at_a_moving_state_agree_to_rounding(formulation: str) -> None:
    scene = with_loads(askew())
    full = scene.compile(merge=False)
    y = np.array(full.initial_state)
    random = np.random.default_rng(3)
    for body in range(4):
        y[full.twist_index(body) : full.twist_index(body) + 6] += random.normal(size=6)
    y = _core.Evaluator(full).project(0.0, y)
    expected = _core.Evaluator(full, "redundant").accelerations(0.3, y)
    found = _core.Evaluator(scene.compile(), formulation).accelerations(0.3, y)
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-12 * np.abs(expected).max())


@pytest.mark.parametrize(("formulation", "memory"), [("redundant", "convolution"), ("recursive", "per-pair")])
def test_case_2_holds_all_reactions_and_steps_a_body_less(formulation: str, memory: str) -> None:
    scene = cases.case2(count=20, memory=memory)
    model = scene.compile()
    assert (model.merge["coordinates"], model.merge["constraints"]) == (54, 40)
    assert model.merge["bodies"] == {"vessel": ["tower"]}
    assert model.merge["dropped"] == ["deck"]
    expected = _core.Evaluator(scene.compile(merge=False)).accelerations(0.0, model.initial_state)
    found = _core.Evaluator(model, formulation).accelerations(0.0, model.initial_state)
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-9 * np.abs(expected).max())
    compare(scene, 1e-6, formulation=formulation, t_end=3.0, rtol=1e-9, dt_out=0.5)


def arm(curve: _core.Curve) -> Scene:
    """A pendulum below a turntable and a slide whose drivers follow `curve`."""
    scene = Scene(gravity=9.81)
    scene.add_body(name="table", mass=5.0, inertia=[1.0, 2.0, 3.0])
    scene.add_body(name="slide", mass=2.0, inertia=[0.3, 0.2, 0.1], position=(1.0, 0.2, 0.0))
    scene.add_body(name="bob", mass=1.0, inertia=[0.1] * 3, position=(1.5, 0.2, -0.5))
    scene.add_joint(kind="revolute", name="slew", first="ground", second="table", axis=(0.0, 0.6, 0.8))
    scene.add_joint(kind="prismatic", name="rail", first="slide", second="table", axis=(1.0, 0.4, 0.2))
    pin = {"point": (1.0, 0.2, 0.0), "axis": (0.0, 1.0, 0.0)}
    scene.add_joint(kind="revolute", name="pin", first="slide", second="bob", **pin)
    scene.add_driver(name="hold slew", joint="slew", curve=curve)
    scene.add_driver(name="hold rail", joint="rail", curve=curve)
    scene.add_actuator(name="brake", joint="slew", stiffness=3.0, damping=1.0)
    return scene


def test_joints_held_still_are_locked(formulation: str) -> None:
    scene = arm(Curve.constant(value=0.3))
    model = scene.compile()
    assert model.merge["bodies"] == {"ground": ["table", "slide"]}
    assert sorted(model.merge["locked_by"]) == ["hold rail", "hold slew"]
    assert sorted(model.merge["dropped"]) == ["hold rail", "hold slew", "rail", "slew"]
    assert model.merge["coordinates"] - model.merge["constraints"] == 1
    compare(scene, 1e-8, formulation=formulation)


def test_what_stays_apart() -> None:
    """Vessels and the ground; what drivers move; what cannot move at all; all bodies of the paper's form."""
    quay, block = Scene(gravity=0.0), Scene()
    for i, name in enumerate(("one", "mast", "two", "quay")):
        quay.add_body(name=name, mass=1.0, inertia=[1.0] * 3, position=(2.0 * i, 0.0, 0.0))
    for name in ("one", "two"):
        quay.add_vessel(body=name, restoring=np.diag([0, 0, 1.0, 1.0, 1.0, 0]))
    for a, b in (("mast", "one"), ("mast", "two"), ("ground", "quay"), ("quay", "two")):
        quay.add_joint(kind="weld", name=f"{a}-{b}", first=a, second=b)
    merge = quay.compile().merge
    assert merge["bodies"] == {"one": ["mast"], "ground": ["quay"]}
    assert merge["dropped"] == ["mast-one", "ground-quay"]
    block.add_body(name="block", mass=1.0, inertia=[1.0] * 3)
    block.add_joint(kind="weld", name="base", first="ground", second="block")
    moving = Curve.constant(value=0.3).then(time=1.0, curve=Curve.constant(value=0.4))
    swinging, paper = Curve.harmonic(amplitude=0.1, omega=2.0), cases.case2(count=5, kinematics="paper")
    for scene in (arm(moving), arm(swinging), block, paper):
        merge = scene.compile().merge
        assert (merge["bodies"], merge["dropped"], merge["locked_by"]) == ({}, [], [])


def test_inputs_and_restarts_reach_the_merged_bodies() -> None:
    scene = with_loads(askew())
    ends = []
    for merge in (True, False):
        model = scene.compile(merge=merge)
        run = Run(scene, t_end=0.5, model=model, rtol=1e-10)
        run.advance(0.5)
        run = Run(scene, t_end=1.5, model=model, rtol=1e-10, start=run.core.state)
        run.set_inputs({"thrust.force": (5.0, 1.0, -2.0), "motor.force": 1.5})
        run.advance(1.5)
        ends.append(np.array(run.core.state.values)[:-1])  # without the absolute work
    np.testing.assert_allclose(ends[0], ends[1], rtol=0.0, atol=1e-7)


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
    scene = lift(held=False)
    for joint in ("main_cylinder", "knuckle_cylinder"):
        scene.add_driver(joint, curve=0.0)
    scene.add_driver("A", curve=Curve.quintic(start_time=1.0, end_time=9.0, start=0.0, end=0.5))
    model = scene.compile()
    assert sorted(model.merge["bodies"]["king"]) == [name for name in CRANE if name not in ("king", "tower")]
    assert model.merge["bodies"]["vessel"] == ["tower"]
    assert model.merge["coordinates"] - model.merge["constraints"] == 12


@pytest.mark.warns("BallastWarning")
def test_a_run_at_a_fixed_step_is_that_of_the_joints(formulation: str) -> None:
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
    Run(scene, t_end=0.1, model=scene.compile(merge=False), start=start).advance(0.1)
