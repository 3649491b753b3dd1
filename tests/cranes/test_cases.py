"""The three lift cases: counting, drift, energy, heel, balance, and driven simulation."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from seacrane import Result, Run, Scene, balance, cases, simulate
from seacrane.analysis import Evaluator, driven
from seacrane.crane import FOOT, KnuckleBoomCrane, Payload
from seacrane.inputs.frames import rotation_matrix
from seacrane.scene import spline_curve
from seacrane.warnings import LargeSwingWarning

Array = NDArray[np.float64]
G = 9.80665
CASES: dict[str, Callable[..., Scene]] = {"case1": cases.case1, "case2": cases.case2, "case3": cases.case3}
JOINT_ENDS = {  # first, second body of every joint, from the paper's topology
    "deck": ("vessel", "tower"), "A": ("tower", "king"), "B": ("king", "main_barrel"),
    "C": ("king", "main_jib"), "D": ("main_rod", "main_jib"), "E": ("main_jib", "knuckle_barrel"),
    "F": ("main_jib", "knuckle_jib"), "G": ("knuckle_rod", "knuckle_jib"),
    "main_cylinder": ("main_barrel", "main_rod"), "knuckle_cylinder": ("knuckle_barrel", "knuckle_rod"),
    "link": ("knuckle_jib", "payload"),
}  # fmt: skip


@pytest.fixture(scope="module")
def runs() -> dict[str, Result]:
    with pytest.warns(LargeSwingWarning):  # of case 1
        return {name: simulate(case()) for name, case in CASES.items()}


def mass_scaled_singular_values(terms: dict[str, Array]) -> Array:
    """Of D M^-1/2, rows of unit length, M block by block from the engine's mass matrix."""
    values, vectors = np.linalg.eigh(terms["mass"])
    scaled = terms["jacobian"] @ vectors / np.sqrt(values)
    scaled /= np.linalg.norm(scaled, axis=1, keepdims=True)
    return np.asarray(np.linalg.svd(scaled, compute_uv=False))


def states_along(scene: Scene, times: list[float]) -> list[tuple[float, Array]]:
    run = Run(scene, t_end=times[-1], dt_out=times[-1], channels=[])
    out = [(run.start.time, np.array(run.start.values))]
    for time in times:
        run.advance(time)
        out.append((time, np.array(run.core.state.values)))
    return out


def test_case2_has_60_coordinates_46_constraints_and_14_freedoms_and_keeps_its_equations() -> None:
    """Rank by NumPy along the motion; M a - D^T lambda = load and D a = gamma solved to rounding."""
    scene = cases.case2()
    model = scene.compile()
    evaluator = Evaluator(model)
    assert len(scene.bodies) == 10
    for time, state in states_along(scene, [10.0, 20.0, 30.0, 45.0, 60.0]):
        terms = evaluator.terms(time, state)
        assert terms["jacobian"].shape == (46, 60) == (model.constraints, model.coordinates)
        values = mass_scaled_singular_values(terms)
        assert values[-1] > 1e-3 * values[0]
        assert 60 - np.linalg.matrix_rank(terms["jacobian"]) == 14 == model.degrees_of_freedom
        pull = terms["jacobian"].T @ terms["multipliers"]
        load = terms["mass"] @ terms["acceleration"] - pull - terms["load"]
        assert np.max(np.abs(load)) < 1e-10 * np.max(np.abs(terms["load"]))
        assert np.max(np.abs(terms["jacobian"] @ terms["acceleration"] - terms["gamma"])) < 1e-10
    scene.add_joint(kind="revolute", name="A again", first="tower", second="king",
                    point=KnuckleBoomCrane.load().joints(foot=FOOT)[1].point)  # fmt: skip
    with pytest.warns(UserWarning, match="A again"):
        model = scene.compile()
    assert (model.constraints, model.degrees_of_freedom) == (51, 14)


@pytest.mark.parametrize("name", CASES)
def test_constraints_stay_closed_and_so_does_the_energy_balance(runs: dict[str, Result], name: str) -> None:
    run = runs[name]
    assert run.time[-1] == 100.0 and len(run.time) == 1001
    assert np.max(run["constraint_error"]) < 1e-9
    assert np.max(run["constraint_rate_error"]) < 1e-9
    assert np.max(run["constraint_error_before_projection"]) == 0.0  # tree coordinates leave nothing open
    assert np.max(np.abs(run["energy_balance"])) < 1e-6 * run["absolute_work"][-1]
    assert run["absolute_work"][-1] > 1e8


def test_projection_closes_what_steps_of_the_redundant_form_open() -> None:
    run = simulate(cases.case2(), formulation="redundant", t_end=10.0)
    assert 0.0 < np.max(run["constraint_error_before_projection"]) < 1e-5
    assert np.max(run["constraint_error"]) < 1e-9


def still(scene: Scene) -> Scene:
    """The case with its references held at their start."""
    actuators = dict(scene.actuators)
    scene.actuators.clear()
    for name, a in actuators.items():
        scene.add_actuator(name=name, joint=a.joint, stiffness=a.stiffness, damping=a.damping,
                           feed_forward=float(a.feed_forward.evaluate([0.0])[0, 0]))  # fmt: skip
    return scene


@pytest.mark.parametrize("name", CASES)
def test_at_rest_in_calm_water_it_stays_and_the_deck_carries_its_weight(name: str) -> None:
    run = simulate(still(CASES[name](hs=0.0)), rtol=1e-10)
    assert np.max(np.abs(run["vessel_motion"])) < 1e-10
    assert np.max(np.ptp(run["position"], axis=0)) < 1e-8
    assert np.max(np.abs(run["velocity"])) < 1e-8
    if name == "case1":
        return
    crane = KnuckleBoomCrane.load()
    tip = crane.geometry.tip(slew=0.0, s1=0.0, s2=0.0)
    force, moment = (run.select(f"reaction_{what}", joint="deck")[0] for what in ("force", "moment"))
    np.testing.assert_allclose(force, [0.0, 0.0, (crane.mass + 10e3) * G], atol=1e-3)
    assert run["link_tension"][0] == pytest.approx(10e3 * G, rel=1e-9)
    arm = (crane.center_of_mass() - np.array(FOOT)) * crane.mass + tip * 10e3
    np.testing.assert_allclose(moment, [arm[1] * G, -arm[0] * G, 0.0], atol=1e-2)


@pytest.mark.parametrize("payload", [None, Payload()])
def test_balance_equals_weight_and_moments_by_hand(payload: Payload | None) -> None:
    """Vessel wrench about {0}: the weight up, and its moment at the common centre of mass."""
    scene = cases.case2(payload=payload) if payload else cases.case1()
    del scene.point_forces["balance"]
    held = balance(scene)
    crane = KnuckleBoomCrane.load()
    weight, moment = crane.mass * G, crane.mass * G * crane.center_of_mass()
    if payload:
        tip = np.array(FOOT) + crane.geometry.tip(slew=0.0, s1=0.0, s2=0.0)
        weight, moment = weight + payload.mass * G, moment + payload.mass * G * tip
    assert held.vessel_wrench is not None
    expected = [0.0, 0.0, weight, moment[1], -moment[0], 0.0]
    np.testing.assert_allclose(held.vessel_wrench, expected, rtol=1e-9, atol=1e-2)
    assert held.weight == pytest.approx(weight, rel=1e-12)
    forces = crane.static_cylinder_forces(s1=0.0, s2=0.0, payload_mass=payload.mass if payload else 0.0)
    np.testing.assert_allclose([held.loads["main"], held.loads["knuckle"]], forces, rtol=1e-9)
    assert abs(held.loads["slew"]) < 1e-3


def loads_on_bodies(scene: Scene, run: Result) -> tuple[Array, Array]:
    """Force and moment about the centre of mass (n, bodies, 3): weight, reactions, actuators."""
    bodies, joints = list(run.coords["body"]), list(run.coords["joint"])
    position = run["position"]
    force, moment = np.zeros_like(position), np.zeros_like(position)
    for k, name in enumerate(bodies):
        if name != "vessel":
            force[:, k, 2] -= scene.bodies[name].mass * scene.gravity

    def apply(joint: str, f: Array, couple: Array, point: Array) -> None:
        first, second = (bodies.index(body) for body in JOINT_ENDS[joint])
        for body, sign in ((second, 1.0), (first, -1.0)):
            force[:, body] += sign * f
            moment[:, body] += sign * (couple + np.cross(point - position[:, body], f))

    rotation = rotation_matrix(run["quaternion"])
    for i, joint in enumerate(joints):
        side = 0 if joint.endswith("_cylinder") else 1
        described = scene.joints[joint]
        frame = (described.first_frame, described.second_frame)[side]
        body = bodies.index(JOINT_ENDS[joint][side])
        arm = frame.point - scene.bodies[bodies[body]].center_of_mass
        point = position[:, body] + rotation[:, body] @ arm
        apply(joint, run["reaction_force"][:, i], run["reaction_moment"][:, i], point)
    for i, actuator in enumerate(scene.actuators.values()):
        first = bodies.index(JOINT_ENDS[actuator.joint][0])
        frame = scene.joints[actuator.joint].first_frame
        axis = rotation[:, first] @ frame.axes[:, 2]
        load = run["actuator_force"][:, i, None] * axis
        arm = frame.point - scene.bodies[bodies[first]].center_of_mass
        point = position[:, first] + rotation[:, first] @ arm
        slew = actuator.joint == "A"
        apply(actuator.joint, 0.0 * load if slew else load, load if slew else 0.0 * load, point)
    return force, moment


def test_every_body_is_in_balance_in_waves_and_the_deck_takes_their_inertia() -> None:
    """m a and J alpha + omega x J omega equal weight, reactions and actuators, from recorded channels."""
    scene = cases.case2(hs=4.0)
    channels = [*scene.compile().channel_names(), "acceleration", "angular_acceleration"]
    with pytest.warns(LargeSwingWarning):
        run = simulate(scene, t_end=60.0, dt_out=1.0, channels=channels)
    force, moment = loads_on_bodies(scene, run)
    rotation = rotation_matrix(run["quaternion"])
    passed, total = np.zeros((run.time.size, 3)), 0.0
    for k, name in enumerate(run.coords["body"]):
        if name == "vessel":
            continue
        body = scene.bodies[name]
        inertia = rotation[:, k] @ body.inertia @ rotation[:, k].transpose(0, 2, 1)
        w, alpha = run["angular_velocity"][:, k], run["angular_acceleration"][:, k]
        spin = np.einsum("tij,tj->ti", inertia, w)
        rate = np.einsum("tij,tj->ti", inertia, alpha) + np.cross(w, spin)
        weight = body.mass * G
        np.testing.assert_allclose(force[:, k], body.mass * run["acceleration"][:, k], atol=1e-7 * weight)
        np.testing.assert_allclose(moment[:, k] - rate, 0.0, atol=1e-6 * weight)
        assert np.max(np.abs(run["acceleration"][:, k])) > 0.1
        passed += body.mass * (run["acceleration"][:, k] + [0.0, 0.0, G])
        total += weight
    np.testing.assert_allclose(run.select("reaction_force", joint="deck"), passed, atol=1e-8 * total)


def test_driven_forces_put_back_return_the_motion() -> None:
    """Forces that the motion needs in waves, fed forward at the same gains, give the same motion."""
    scene = cases.case2(hs=4.0)
    wanted = simulate(driven(scene), t_end=30.0, dt_out=0.02, rtol=1e-10)
    loads = {"slew": wanted["slew_torque"], "main": wanted.select("cylinder_force", cylinder="main"),
             "knuckle": wanted.select("cylinder_force", cylinder="knuckle")}  # fmt: skip
    free = scene.copy(actuators={})
    for name, a in scene.actuators.items():
        free.add_actuator(
            name=name, joint=a.joint, stiffness=a.stiffness, damping=a.damping, reference=a.reference,
            feed_forward=spline_curve(times=wanted.time, values=loads[name]),
        )  # fmt: skip
    got = simulate(free, t_end=30.0, dt_out=0.02, rtol=1e-10)
    assert np.max(np.abs(got["position"] - wanted["position"])) < 1e-6
    assert np.max(np.abs(got["stroke"] - wanted["stroke"])) < 1e-7
    plain = simulate(scene, t_end=30.0, dt_out=0.02)
    assert np.max(np.abs(plain["stroke"] - wanted["stroke"])) > 1e-3
