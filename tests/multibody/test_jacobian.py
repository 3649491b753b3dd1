"""Exact Jacobians against differences, over all kinds of elements, and their use."""

from __future__ import annotations

import ctypes
from typing import Any

import numpy as np
import pytest
from joint_examples import own_arguments
from linear_scenes import reference_vessel
from multibody_runs import quaternion_about

from seacrane import FlowCoefficients, Scene, _core, cases, equilibrium, linear_model, simulate
from seacrane.analysis.linearise import jacobian
from seacrane.analysis.reduced_coordinates import Terms
from seacrane.arrays import Array

# Assembly makes consistent what some scenes describe roughly, on purpose.
pytestmark = pytest.mark.filterwarnings("ignore::seacrane.warnings.AssemblyWarning")


def differences(evaluator: _core.Evaluator, t: float, y: Array, scale: Array, *, step: float) -> Array:
    """Five-point differences: error step^4 / 30 of the fifth derivative."""

    def at(i: int, k: int) -> Array:
        moved = y.copy()
        moved[i] += k * step * scale[i]
        return evaluator.derivative(t, moved)

    columns = [
        (8.0 * (at(i, 1) - at(i, -1)) - (at(i, 2) - at(i, -2))) / (12.0 * step * scale[i])
        for i in range(y.size)
    ]
    return np.array(columns).T


def largest_error(model: _core.Model, t: float, y: Array, *, step: float, kinks: bool = False) -> float:
    """Largest error of an entry, over the largest of its row, columns in typical magnitudes.

    With `kinks` the absolute work is left out: its rate sums magnitudes of powers that pass zero here.
    Rows below 1e-3 (of bodies held in place) count as that large: what differences show there is rounding.
    """
    evaluator = _core.Evaluator(model)
    scale = np.array(model.scale)
    scale[~np.isfinite(scale)] = 1.0
    exact = evaluator.jacobian(t, y) * scale
    by_differences = differences(evaluator, t, y, scale, step=step) * scale
    size = np.maximum(np.max(np.abs(by_differences), axis=1, keepdims=True), 1e-3)
    error = np.abs(exact - by_differences) / size
    return float(np.max(error[:-1] if kinks else error))


def moving(model: _core.Model, seed: int, *, on_constraints: bool = True, size: float = 0.1) -> Array:
    """The start with random changes of every state; quaternions of any length."""
    y = np.array(model.initial_state)
    scale = np.array(model.scale)
    change = size * np.random.default_rng(seed).uniform(-1.0, 1.0, y.size)
    y += np.where(np.isfinite(scale), scale, 1.0) * change
    return _core.Evaluator(model).project(0.0, y) if on_constraints else y


@ctypes.CFUNCTYPE(None, ctypes.c_double, *[ctypes.POINTER(ctypes.c_double)] * 3)
def _swirl(t: float, state: Any, parameters: Any, wrench: Any) -> None:
    """A nonlinear spring, a drag and a moment that depends on attitude."""
    for i in range(3):
        wrench[i] = -(state[i] ** 3) - parameters[0] * state[7 + i] * abs(state[7 + i])
        wrench[3 + i] = state[4 + i] - 0.3 * state[10 + i]


def mixture(seed: int, **settings: Any) -> Scene:
    """A random tree of all kinds of joints with all kinds of loads, two drivers and a loop's closing link."""
    random = np.random.default_rng(seed)
    scene = Scene(name="mixture", **settings)
    kinds = ["revolute", "prismatic", "cylindrical", "universal", "spherical", "planar", "weld"]
    names = ["ground"]
    for i, kind in enumerate(kinds):
        name, point = f"body {i}", random.uniform(-1.0, 1.0, 3)
        scene.add_body(
            name=name, mass=random.uniform(1.0, 3.0), inertia=random.uniform(0.8, 1.2, 3),
            position=point + random.uniform(-0.5, 0.5, 3),
            quaternion=quaternion_about(random.uniform(-1.0, 1.0, 3), random.uniform(-1.0, 1.0)),
            center_of_mass=random.uniform(-0.2, 0.2, 3)
        )  # fmt: skip
        axis = random.uniform(-1.0, 1.0, 3)
        own = own_arguments(
            kind, lambda axis=axis: np.cross(axis, random.uniform(-1.0, 1.0, 3)), lambda: None
        )
        axes: dict[str, Any] = {} if kind in ("spherical", "weld") else {"axis": axis} | own
        parent = names[int(random.integers(len(names)))]
        scene.add_joint(kind=kind, name=f"joint {i}", first=parent, second=name, point=point, **axes)
        names.append(name)
    scene.add_body(name="load", mass=1.5, inertia=(0.4, 0.5, 0.6), position=(2.0, 1.5, -2.0))
    points: dict[str, Any] = {"point": (0.0, 0.0, 0.0), "second_point": (2.0, 1.5, -2.0)}
    scene.add_joint(kind="distance", name="line", first="ground", second="load", length=None, **points)
    scene.add_actuator(name="turn", joint="joint 0", stiffness=30.0, damping=4.0, reference=0.4)
    scene.add_driver(name="slide", joint="joint 1", curve=_core.Curve.quintic(
        start_time=-1.0, end_time=2.0, start=0.0, end=0.6))  # fmt: skip
    spring: dict[str, Any] = {"stiffness": 40.0, "natural_length": 1.0, "damping": 2.0}
    scene.add_spring(name="spring", first="body 2", second="load", second_point=(0.1, 0.2, 0.3), **spring)
    tension: dict[str, Any] = {"lengths": [0.1, 1.0, 9.0], "forces": [0.0, 20.0, 50.0]}
    scene.add_spring(name="table", first="body 3", second="body 6", **tension)
    scene.add_force("body 4", name="push", force=(3, 1, 2), point=(0.2, 0.1, 0), body_axes=True)
    gust = [[0.0] * 6, [5.0, 1.0, 2.0, 0.3, 0.2, 0.1]]
    scene.add_force("body 5", name="gust", times=[-1.0, 1.0], force=gust)
    angle = np.radians([0.0, 45.0, 90.0, 135.0, 180.0])
    flow = FlowCoefficients(
        angle=angle, x=np.cos(angle), y=np.sin(angle) * [0, 1, 1, 1, 0],
        yaw=0.1 * np.sin(2 * angle) * [0, 1, 1, 1, 0]
    )  # fmt: skip
    areas: dict[str, Any] = {"frontal_area": 2.0, "lateral_area": 3.0, "length": 2.0}
    top = (0.0, 0.0, 0.4)
    scene.add_wind(coefficients=flow, speed=6.0, direction_deg=30.0, body="load", point=top, **areas)
    scene.add_force("load", name="swirl", force=_swirl, parameters=[0.7])
    return scene


@pytest.mark.parametrize("orientation", ["quaternion", "euler_xyz"])
@pytest.mark.parametrize("on_constraints", [True, False])
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_all_kinds_of_elements(seed: int, on_constraints: bool, orientation: str) -> None:
    baumgarte = 0.0 if seed == 1 else 2.0
    model = mixture(seed, orientation=orientation, baumgarte=baumgarte).compile()
    y = moving(model, seed, on_constraints=on_constraints)
    assert largest_error(model, 0.3, y, step=3e-4, kinks=on_constraints) < 1e-7


SEAS: list[dict[str, Any]] = [
    {"memory": "per-pair"}, {"memory": "by-motion"}, {"memory": "none"}, {"memory": "convolution"},
    {"phase": "actual", "count": 20}, {"phase": "slow", "count": 20},
    {"phase": "slow", "count": 20, "memory": "convolution"}
]  # fmt: skip


@pytest.mark.parametrize("options", SEAS, ids=str)
@pytest.mark.parametrize("on_constraints", [True, False])
def test_case2(options: dict[str, Any], on_constraints: bool) -> None:
    model = cases.case2(**options).compile()
    y = moving(model, 5, on_constraints=on_constraints, size=0.02)
    assert largest_error(model, 7.0, y, step=1e-3, kinks=on_constraints) < 1e-6


@pytest.mark.parametrize("orientation", ["quaternion", "euler_xyz"])
def test_vessel_with_all_its_terms(orientation: str) -> None:
    random = np.random.default_rng(4)
    scene = Scene(orientation=orientation)
    scene.add_body(name="hull", mass=40.0, inertia=(5.0, 6.0, 7.0), center_of_mass=(0.1, 0.2, 0.3))
    matrix = random.uniform(-1.0, 1.0, (6, 6))
    scene.add_vessel(
        body="hull", added_mass=30.0 * np.eye(6) + matrix + matrix.T,
        linear_damping=random.uniform(-1.0, 1.0, (6, 6)), quadratic_damping=random.uniform(5.0, 9.0, 6),
        restoring=np.diag([0.0, 0.0, 90.0, 70.0, 60.0, 0.0]), mooring_stiffness=(3.0, 4.0, 5.0),
        mooring_damping=(1.0, 2.0, 3.0)
    )  # fmt: skip
    model = scene.compile()
    y = moving(model, 6, on_constraints=False, size=1.0)
    assert largest_error(model, 0.0, y, step=1e-4) < 1e-7


def test_eigenvalues_of_a_vessel_are_those_of_its_matrices_and_linearisation_takes_them() -> None:
    scene = cases.vessel(hs=0.0)
    model = scene.compile()
    kept = np.isfinite(model.scale)
    exact = _core.Evaluator(model).jacobian(0.0, model.initial_state)[np.ix_(kept, kept)]
    for found in (np.linalg.eigvals(exact), np.linalg.eigvals(linear_model(scene).a)):
        for value in reference_vessel(scene).eigenvalues():
            assert np.min(np.abs(found - value)) < 1e-10 * max(1.0, abs(value))
    np.testing.assert_array_equal(jacobian(model), exact)


def test_linear_model_agrees_with_differences(monkeypatch: pytest.MonkeyPatch) -> None:
    scene = cases.case2(hs=0.0)
    rest = equilibrium(scene, time=50.0)
    exact = linear_model(scene, state=rest).a
    monkeypatch.setattr(Terms, "exact_rates", lambda *_: None)
    other = linear_model(scene, state=rest).a
    np.testing.assert_allclose(exact, other, rtol=1e-6, atol=1e-6)


@pytest.mark.parametrize(
    ("integrator", "formulation"),
    [("rosenbrock", "recursive"), ("cvode-bdf", "redundant"), ("ida", "redundant")],
)
def test_implicit_methods_use_it(integrator: str, formulation: str) -> None:
    scene = cases.case2(count=20)
    settings: dict[str, Any] = {"t_end": 2.0, "dt_out": 1.0, "formulation": formulation}
    run = simulate(scene, integrator=integrator, rtol=1e-5, **settings)
    reference = simulate(scene, integrator="dop853", rtol=1e-9, **settings)
    stats: dict[str, Any] = dict(run.stats)
    assert stats["jacobians"] > 0
    assert stats["evaluations"] - stats["newton_iterations"] < stats["jacobians"] * stats["states"]
    error = np.abs(run.channels["position"] - reference.channels["position"])
    assert np.max(error) < 2e-3


@pytest.mark.filterwarnings("ignore:.*redundant")
def test_what_has_none_says_so_and_is_linearised_by_differences() -> None:
    paper = cases.vessel(hs=0.0, kinematics="paper").compile()
    assert np.all(np.isfinite(jacobian(paper)))
    door = Scene()
    door.add_body(name="door", mass=2.0, inertia=(0.3, 0.4, 0.5), position=(0.5, 0.0, 0.0))
    for height in (0.0, 1.0):
        ends = {"first": "ground", "second": "door", "point": (0, 0, height), "axis": (0, 0, 1)}
        door.add_joint(kind="revolute", name=f"hinge {height}", **ends)
    for model, formulation, words in (
        (paper, "redundant", "no exact Jacobian.*kinematics .paper."),
        (door.compile(), "redundant", "rows depend on each other"),
        (mixture(1).compile(), "recursive", "formulation .recursive."),
    ):
        with pytest.raises(ValueError, match=words):
            _core.Evaluator(model, formulation).jacobian(0.0, model.initial_state)
