"""Integrators: SciPy's formulas, agreement on case 2, what a method needs, names told in one place."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import pytest
from kink_scenes import sprung
from scipy.integrate._ivp.rk import DOP853, RK23, RK45, RungeKutta, rk_step
from test_integrator_orders import payload_error, run

from seacrane import Run, Scene, SceneError, _core, cases, simulate
from seacrane.analysis import Evaluator

# Assembly makes consistent what some scenes describe roughly, on purpose.
pytestmark = pytest.mark.filterwarnings("ignore::seacrane.warnings.AssemblyWarning")


@pytest.mark.parametrize("integrator", [m.name for m in _core.integrators() if m.setting == "rtol"])
def test_error_falls_with_the_tolerance(integrator: str) -> None:
    errors = [payload_error(run(integrator=integrator, rtol=rtol)) for rtol in (1e-4, 1e-6)]
    assert errors[1] < 0.2 * errors[0], errors
    assert errors[1] < 1e-4, errors


def on_balls(speed: float, *heights: float) -> Scene:
    """A body without weight that turns about its ball joints: its centre stays on a circle, at 0.5 m."""
    scene, spin = Scene(name="ball", gravity=0.0), {"angular_velocity": (0, speed, 0)}
    scene.add_body(name="body", mass=1.0, inertia=[1 / 12] * 3, center_of_mass=(0.5, 0, 0), **spin)
    for z in heights:
        scene.add_joint(f"ball {z}", kind="spherical", first="ground", second="body", point=(0, 0, z))
    return scene


def test_errors_of_ida_on_a_turning_body_fall_with_the_tolerance() -> None:
    """Order 1 damps a steady rotation by as much in every step, which its error estimate does not see."""
    errors, steps = [], []
    for rtol in (1e-4, 1e-6, 1e-8):
        result = simulate(on_balls(8.0, 0), t_end=5.0, integrator="ida", rtol=rtol)
        errors.append(np.abs(result["position"][:, 0, 0] - 0.5 * np.cos(8.0 * result.time)).max())
        steps.append(int(result.stats["steps"]))
        assert np.abs(result["energy_balance"]).max() < 1e3 * rtol
    assert errors[0] < 5e-3 and errors[1] < 1e-4 and errors[2] < 1e-6
    assert max(steps) < 10_000


@pytest.mark.parametrize("integrator, method", [("bs32", RK23), ("dopri5", RK45), ("dop853", DOP853)])
def test_steps_and_dense_output_equal_those_of_scipy(integrator: str, method: type[RungeKutta]) -> None:
    """The same pair from SciPy's coefficients, on the same derivative: equal to rounding."""
    scene = Scene(gravity=9.81)  # a free body: no constraint, no projection
    flight = {"velocity": (1.0, 2.0, 3.0), "angular_velocity": (0.3, 2.0, 0.2)}
    scene.add_body(name="block", mass=2.0, inertia=np.diag([1.0, 2.0, 2.5]), **flight)
    model = scene.compile()
    h, steps, n = 1 / 64, 16, 5  # short enough for the choice of the first step to be maximum_step
    own = Run(scene, model=model, t_end=h * steps, dt_out=h / n, integrator=integrator, rtol=0.1,
              maximum_step=h, formulation="redundant",
              channels=["position", "velocity", "angular_velocity"])  # fmt: skip
    start = y = np.array(own.core.state.values)
    own.advance(h * steps)
    assert own.core.statistics()["steps"] == steps
    evaluate = Evaluator(model).derivative
    f, k = evaluate(0.0, y), np.empty((method.n_stages + 1, y.size))
    for i in range(steps):
        y, f = rk_step(evaluate, i * h, y, f, h, method.A[:, : method.n_stages], method.B, method.C, k)
    np.testing.assert_allclose(own.core.state.values, y, rtol=1e-13, atol=1e-13)
    if integrator == "dopri5":
        return  # has a dense output of its own order
    solver = method(evaluate, 0.0, start, h, first_step=h, max_step=h, rtol=0.1, atol=1e3)
    solver.step()
    theirs = solver.dense_output()(np.linspace(0.0, h, n + 1)).T
    out = own.core.channels()
    places = {"position": slice(0, 3), "velocity": slice(7, 10), "angular_velocity": slice(10, 13)}
    for name, columns in places.items():
        np.testing.assert_allclose(out[name][: n + 1, 0], theirs[:, columns], rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize("orientation", ["quaternion", "euler_xyz"])
def test_semi_implicit_euler_turns_by_the_exponential(orientation: str) -> None:
    scene = Scene(gravity=0.0, orientation=orientation)
    scene.add_body(name="top", mass=1.0, inertia=np.diag([1.0, 2.0, 3.0]), position=(0.0, 0.0, 0.0),
                   angular_velocity=(0.0, 0.0, 2.0))  # fmt: skip
    turn = Run(scene, t_end=1.0, dt_out=1.0, integrator="semi-implicit-euler", dt=0.25,
               channels=["quaternion"])  # fmt: skip
    turn.advance(1.0)
    found = turn.core.channels()["quaternion"][-1, 0]
    np.testing.assert_allclose(found, [np.cos(1.0), 0.0, 0.0, np.sin(1.0)], rtol=0.0, atol=1e-14)


@cache
def afloat(t_end: float = 5.0, **settings: Any) -> np.ndarray:
    """Where the payload of case 2 ends, in waves by exact sum: the table's third derivative jumps."""
    how = {"dt_out": t_end, "channels": ["position"]} | settings
    out = simulate(cases.case2(evaluation="exact"), t_end, **how)
    return np.asarray(out.select("position", body="payload")[-1])


@pytest.mark.parametrize("integrator, settings, limit", [
    ("semi-implicit-euler", {"dt": 2e-3}, 2e-3),
    ("generalized-alpha", {"dt": 1e-2}, 2e-3),
    ("rk-low-storage", {"dt": 5e-2}, 1e-5),
    ("rosenbrock", {"rtol": 1e-5}, 1e-3),
    *((name, {"rtol": 1e-7}, 1e-6) for name in ("tsit5", "verner65", "verner76")),
    ("dop853", {"rtol": 1e-12}, 1e-11),
    *((name, {"rtol": 1e-6}, 1e-5) for name in ("cvode-bdf", "ida")),
])  # fmt: skip
def test_methods_agree_on_case_2_afloat(integrator: str, settings: dict[str, float], limit: float) -> None:
    assert np.linalg.norm(afloat(integrator=integrator, **settings) - afloat(rtol=1e-12)) < limit


@pytest.mark.parametrize("integrator, order", [("rk4", 4), ("tsit5", 5)])
def test_one_step_methods_reach_their_order_on_case_2_afloat(integrator: str, order: int) -> None:
    # A tolerance that never rejects leaves the step to maximum_step.
    settings = [{"dt": h} if integrator == "rk4" else {"rtol": 0.1, "maximum_step": h} for h in (0.05, 0.025)]
    truth = afloat(10.0, rtol=1e-12)
    errors = [np.linalg.norm(afloat(10.0, integrator=integrator, **one) - truth) for one in settings]
    # From above: the next term of the error is still felt at these steps.
    assert order - 0.15 < np.log2(errors[0] / errors[1]) < order + 0.7, errors


@pytest.mark.parametrize("radius", [0.9, 0.2])
def test_spectral_radius_is_what_a_step_leaves_of_a_motion_far_too_fast(radius: float) -> None:
    """All three roots of the step tend to -radius [Chung, Hulbert 1993]: their product, of the recurrence."""
    step = 0.1
    result = simulate(
        sprung(1e3, rest=1e-3), t_end=12 * step, dt_out=step, dt=step, integrator="generalized-alpha",
        spectral_radius=radius, channels=["position"],
    )  # fmt: skip
    x = np.asarray(result["position"])[:, 0, 0] - 1e-3
    rows = np.array([x[k : k + 3] for k in range(3, 9)])
    size = np.abs(rows).max(axis=1)
    product = np.linalg.lstsq(rows / size[:, None], x[6:12] / size, rcond=None)[0][0]
    assert abs(product) ** (1 / 3) == pytest.approx(radius, rel=1e-2)
    assert result.settings["spectral_radius"] == radius


@pytest.mark.parametrize(
    ("scene", "settings", "words"),
    [
        (sprung(1.0), {"integrator": "dopri5", "spectral_radius": 0.5}, "spectral_radius.*dopri5"),
        (sprung(1.0), {"integrator": "generalized-alpha", "spectral_radius": 1.5}, "spectral_radius is"),
        (on_balls(1.0, 0, 1), {"integrator": "ida"}, "'ida'.*ball 0, ball 1 are redundant"),
    ],
)  # fmt: skip
@pytest.mark.filterwarnings("ignore:.*redundant")
def test_what_a_method_cannot_do_is_refused(scene: Scene, settings: dict[str, Any], words: str) -> None:
    with pytest.raises(SceneError, match=words):
        simulate(scene, t_end=1.0, **settings)
