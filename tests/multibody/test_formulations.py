"""The recursive formulation against the redundant one: random scenes at a state, runs, and handing over."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
import pytest
from multibody_runs import CRANK, add_crane, slider_crank, swing_out
from random_loops import nearly_flat, shape_of
from random_scenes import Shape, build, moving
from reference_problems import bricard
from scipy.spatial.transform import Rotation
from test_redundant_joints import bars, chain

from seacrane import Frame, Model, Run, Scene, SceneError, _core, cases, simulate
from seacrane.analysis import Evaluator
from seacrane.arrays import Array

# Assembly makes consistent what some scenes describe roughly, on purpose.
pytestmark = pytest.mark.filterwarnings("ignore::seacrane.warnings.AssemblyWarning")

AGREEMENT = 1e-9  # of the largest like quantity
EPS = float(np.finfo(float).eps)
NEARLY_DEPENDENT = (1e-10, 3e-3)  # smallest over largest singular value of the rows


def compiled(scene: Scene) -> Model:
    with warnings.catch_warnings(action="ignore", category=UserWarning):
        return scene.compile()


class Comparison:
    """Both formulations at a state. Accelerations in the mass metric, by the largest term of eq (9)."""

    def __init__(self, model: Model, state: Array) -> None:
        terms = Evaluator(model, "redundant").terms(0.0, state)
        recursive = Evaluator(model, "recursive")
        found = np.asarray(recursive.accelerations(0.0, state)).ravel()
        root = np.linalg.cholesky(terms["mass"])
        forces = np.linalg.solve(root, terms["mass"] @ found - terms["load"])
        like = max(
            np.abs(root.T @ terms["acceleration"]).max(), np.abs(np.linalg.solve(root, terms["load"])).max()
        )  # fmt: skip
        self.acceleration = float(np.abs(root.T @ (found - terms["acceleration"])).max() / like)
        self.shape = self.condition = 1.0
        self.nearly_dependent = False
        self.reaction = 0.0
        if len(terms["jacobian"]):
            loads = np.linalg.solve(root, terms["jacobian"].T)
            size = np.linalg.norm(loads, axis=0)
            values = np.linalg.svd(loads / size, compute_uv=False)
            rows = terms["jacobian"] / np.linalg.norm(terms["jacobian"], axis=1)[:, None]
            ratios = np.linalg.svd(rows, compute_uv=False)
            ratios /= ratios[0]
            self.shape = float(ratios[-1]) if len(rows) <= rows.shape[1] else 0.0
            low, high = NEARLY_DEPENDENT
            self.nearly_dependent = bool(((low < ratios) & (ratios < high)).any())
            # Of the rows that do not depend on others.
            self.condition = float(values[0] / values[values > 1e-12 * values[0]][-1]) ** 2
            expected = terms["multipliers"] * size
            multipliers = np.linalg.lstsq(loads / size, forces, rcond=None)[0]
            self.reaction = float(np.abs(multipliers - expected).max() / max(np.abs(expected).max(), like))
        self.recursive_condition = recursive.condition(0.0, state)

    @property
    def bound(self) -> float:
        """Loosened in proportion to what the formulations say of themselves, where that is worse."""
        return max(AGREEMENT, EPS * self.condition, EPS * self.recursive_condition)


def check(shape: Shape) -> Comparison:
    """Between the limits a row counts as dependent in one formulation and not yet in the other.

    Where rows hold a motion twice reactions are not unique, and accelerations are compared."""
    model = compiled(build(shape))
    found = Comparison(model, moving(model, shape.seed))
    if not found.nearly_dependent:
        assert found.acceleration < found.bound, (found.acceleration, found.bound)
        if found.shape > NEARLY_DEPENDENT[1]:
            assert found.reaction < found.bound, (found.reaction, found.bound)
    return found


# Trees: every joint type as a branch, written in either order, on the ground, a floating body or a vessel.
# Struts: cylinders with the universal joint at either end, one close to its dead centre. Loops: more joints
# than a tree has, rows that hold a motion twice.
FAMILIES: dict[str, dict[str, int]] = {"trees": {}, "struts": {"most": 4, "struts": 2}, "loops": {"loops": 2}}


@pytest.mark.parametrize("family", FAMILIES)
@pytest.mark.parametrize(
    "seeds",
    [range(120), pytest.param(range(120, 4000), marks=pytest.mark.slow("thousands of random scenes"))],
    ids=["hundreds", "thousands"],
)
def test_random_scenes(family: str, seeds: range) -> None:
    compared = sum(not check(shape_of(seed, **FAMILIES[family])).nearly_dependent for seed in seeds)
    assert compared > 0.95 * len(seeds)


@pytest.mark.parametrize("planar", [False, True])
@pytest.mark.parametrize("turned", [1.0, 0.01])
def test_loops_close_to_where_they_fold_flat(turned: float, planar: bool) -> None:
    for seed in range(6):
        model = compiled(nearly_flat(seed, turned, planar=planar))
        found = Comparison(model, moving(model, seed))
        assert found.acceleration < (AGREEMENT if planar else found.bound), seed
        assert planar or found.reaction < found.bound, seed


def door() -> Scene:
    """A plate on one hinge, with a knob on a link."""
    scene = Scene(name="door")
    scene.add_body(name="plate", mass=30.0, inertia=(10.0, 12.0, 3.0), position=(0.5, 0.0, 0.0))
    scene.add_body(name="knob", mass=1.0, inertia=(0.1, 0.1, 0.1), position=(1.0, 0.3, -0.4))
    scene.add_joint(kind="revolute", name="hinge", first="ground", second="plate", axis=(0.2, 1.0, 0.1),
                    point=(0.0, 0.0, 0.0))  # fmt: skip
    scene.add_joint(kind="distance", name="link", first="plate", second="knob", point=(1.0, 0.0, 0.0),
                    second_point=(1.0, 0.3, -0.4))  # fmt: skip
    return scene


def crank() -> Scene:
    """Rows for one joint of a spatial slider-crank, and an actuator."""
    scene = slider_crank(CRANK, 0.4, 6.0)
    scene.add_actuator(joint="shaft", feed_forward=3.0, damping=1.0)
    return scene


def afloat() -> Scene:
    """The crane with its payload on a body that floats free in space, all actuators at work."""
    scene = Scene(name="afloat", gravity=0.0)
    scene.add_body(name="base", mass=3e6, inertia=(5e8, 5e8, 5e8), angular_velocity=(0.02, 0.03, 0.01))
    add_crane(scene, base="base", payload=True, references=swing_out(4.0))
    return scene


MECHANISMS: dict[str, Callable[[], Scene]] = {"door": door, "crank": crank, "afloat": afloat}


def run(scene: Scene, t_end: float, formulation: str, **settings: Any) -> dict[str, Any]:
    channels = ["position", "quaternion", "velocity", "constraint_error", "energy_balance", "absolute_work"]
    going = Run(scene, t_end=t_end, dt_out=t_end / 10, formulation=formulation, channels=channels, **settings)
    going.advance(t_end)
    return dict(going.core.channels()) | {"state": going.core.state}


def apart(a: dict[str, Any], b: dict[str, Any]) -> float:
    return float(max(np.abs(a[k] - b[k]).max() for k in ("position", "quaternion")))


# Tolerance or step at which a method's own error is below the agreement asked for.
TIGHT: dict[str, dict[str, float]] = {
    "bs32": {"rtol": 1e-3, "maximum_step": 2e-4}, "rk4": {"dt": 1e-3}, "rk-low-storage": {"dt": 1e-3},
    "cvode-bdf": {"rtol": 1e-9}, "rosenbrock": {"rtol": 1e-9}
}  # fmt: skip
METHODS = [m.name for m in _core.integrators() if m.order > 1 and not m.residual_form]


RUNS = [("crank", m) for m in METHODS] + [("door", "dopri5"), ("afloat", "rk4")]


@pytest.mark.parametrize(("mechanism", "integrator"), RUNS)
def test_runs_agree_with_every_integrator(mechanism: str, integrator: str) -> None:
    low = integrator in ("bs32", "rosenbrock", "cvode-bdf")
    t_end = 0.1 if low else 1.0
    scene = MECHANISMS[mechanism]()
    found = run(scene, t_end, "recursive", integrator=integrator, **TIGHT.get(integrator, {"rtol": 1e-10}))
    expected = reference(mechanism, t_end)
    assert np.ptp(expected["position"], axis=0).max() > 1e-3
    assert apart(found, expected) < (1e-7 if integrator == "cvode-bdf" else 1e-8)


@cache
def reference(mechanism: str, t_end: float) -> dict[str, Any]:
    """The redundant formulation to rounding, and another method for the integrators' sake."""
    return run(MECHANISMS[mechanism](), t_end, "redundant", integrator="dop853", rtol=1e-12)


@pytest.mark.parametrize("order", [("redundant", "recursive"), ("recursive", "redundant")])
@pytest.mark.parametrize("mechanism", ["crank", "afloat"])
def test_a_state_hands_over_from_one_formulation_to_the_other(mechanism: str, order: tuple[str, str]) -> None:
    scene = MECHANISMS[mechanism]()
    first = run(scene, 0.5, order[0], rtol=1e-11)
    second = run(scene, 1.0, order[1], rtol=1e-11, start=first["state"])
    whole = run(scene, 1.0, order[0], rtol=1e-11)
    assert np.abs(second["position"][-1] - whole["position"][-1]).max() < 1e-8
    # The state is handed over without loss; q and -q are one rotation.
    model = scene.compile()
    there = Run(scene, t_end=1.0, formulation=order[1], start=first["state"]).core.state
    given, taken = np.array(first["state"].values), np.array(there.values)
    for body in range(len(scene.bodies)):
        at = model.pose_index(body) + 3
        taken[at : at + 4] *= np.sign(taken[at : at + 4] @ given[at : at + 4])
    np.testing.assert_allclose(taken, given, rtol=0.0, atol=1e-12 * np.abs(given).max())


@pytest.mark.parametrize("case", [cases.case1, cases.case2, cases.case3])
def test_cases_agree_in_every_channel(case: Callable[[], Scene]) -> None:
    found, expected = (
        simulate(case(), t_end=5.0, dt_out=0.5, rtol=1e-9, formulation=kind)
        for kind in ("recursive", "redundant")
    )
    assert found.stats["compiled_constraints"] == 0
    checks = {"constraint_error_before_projection", "constraint_error", "constraint_rate_error"}
    assert set(found.channels) == set(expected.channels)
    for channel in set(found.channels) - checks - {"energy_balance"}:
        a, b = found[channel], expected[channel]
        # The work sums |power|, whose kinks no method resolves to its tolerance.
        bound = 1e-4 if channel == "absolute_work" else 1e-6
        assert np.abs(a - b).max() <= bound * max(np.abs(b).max(), 1.0), channel
    assert np.abs(found["position"] - expected["position"]).max() < 1e-7
    for result in (found, expected):
        assert np.abs(result["energy_balance"]).max() < 1e-7 * result["absolute_work"][-1]
        assert result["constraint_error"].max() < 1e-11


def welded() -> Scene:
    """Nothing in it can move."""
    scene = Scene(name="welded")
    scene.add_body(name="block", mass=1.0, inertia=(1.0, 1.0, 1.0))
    scene.add_joint(kind="weld", name="seam", first="ground", second="block", point=(0.0, 0.0, 0.0))
    return scene


@pytest.mark.parametrize(
    ("scene", "integrator", "reason"),
    [
        (lambda: cases.vessel(kinematics="paper"), "dopri5", "kinematics 'paper'.*choose 'redundant'"),
        (cases.vessel, "ida", "integrator 'ida'.*choose 'redundant'"),
        (cases.vessel, "generalized-alpha", "'generalized-alpha'.*choose 'redundant'"),
        (lambda: crank().copy(baumgarte=5.0), "dopri5", "Baumgarte"),
        (welded, "dopri5", "nothing to move"),
    ],
)
def test_combinations_that_do_not_exist_are_refused_and_never_replaced(
    scene: Callable[[], Scene], integrator: str, reason: str
) -> None:
    with pytest.raises(SceneError, match=reason):
        simulate(scene(), t_end=0.1, formulation="recursive", integrator=integrator)
    assert simulate(scene(), t_end=0.1, integrator=integrator).stats["formulation"] == "redundant"


def hanging_chain(links: int, load: float) -> Scene:
    """A load on its last link, and a bob on a rod beside it."""
    scene = chain(links, lean=0.6)
    end = links * np.array([np.sin(0.6), 0.0, -np.cos(0.6)])
    scene.add_body(name="load", mass=load, inertia=[load] * 3, position=end)
    scene.add_joint(kind="spherical", name="hook", first=f"link {links - 1}", second="load", point=end)
    scene.add_body(name="bob", mass=1.0, inertia=[1.0] * 3, position=(50, 0, -3))
    rod = {"first": "ground", "second": "bob", "point": (50, 0, 0), "second_point": (50, 0, -3)}
    scene.add_joint(kind="distance", name="rod", **rod)
    return scene


# In the last the recursive form saves little in an evaluation, and takes many times the steps at a fold.
@pytest.mark.filterwarnings("ignore::UserWarning")
@pytest.mark.parametrize(
    ("scene", "expected"),
    [
        (door(), "recursive"), (crank(), "redundant"), (hanging_chain(30, 2e6), "recursive"),
        (chain(30, lean=0.6), "recursive"), (bars(3), "redundant"), (bricard.scene(), "redundant"),
    ],
)  # fmt: skip
def test_auto_takes_the_formulation_that_the_scene_allows(scene: Scene, expected: str) -> None:
    assert Run(scene, t_end=1.0).formulation == expected


def test_the_own_axes_of_a_rod_do_not_matter(formulation: str) -> None:
    """The parts of a cylinder turn as one, or each by a rotation of its own: the same motion either way."""

    def payload(turn: Rotation) -> Array:
        scene, axes = cases.case2(), turn.as_matrix()
        rod = scene.bodies["main_rod"]
        start = Rotation.from_quat(np.roll(rod.quaternion, -1)) * turn
        scene.replace(
            "main_rod",
            kind="body",
            quaternion=np.roll(start.as_quat(), 1),
            inertia=axes.T @ rod.inertia @ axes,
            center_of_mass=axes.T @ rod.center_of_mass,
        )
        for joint in list(scene.joints.values()):
            for side in ("first", "second"):
                if getattr(joint, side) == "main_rod":
                    frame = getattr(joint, f"{side}_frame")
                    own = Frame(point=axes.T @ frame.point, axes=axes.T @ frame.axes)
                    scene.replace(joint.name, kind="joint", **{f"{side}_frame": own})
        result = simulate(scene, t_end=10.0, formulation=formulation, rtol=1e-8, dt_out=1.0)
        return result.select("position", body="payload")

    apart = payload(Rotation.from_euler("xyz", [0.3, -1.1, 2.0])) - payload(Rotation.identity())
    assert np.abs(apart).max() < 1e-7
