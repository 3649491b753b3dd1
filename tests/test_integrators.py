"""Every integrator: its order on a constrained crane, SciPy's formulas, names told in one place."""

from __future__ import annotations

import re
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.integrate._ivp.rk import DOP853, RK23, RK45, RungeKutta, rk_step
from test_convergence import T_END, exact, payload_error, run, slopes

from seacrane import Evaluator, Run, Scene, cases, integrator_names

FIXED = {"semi-implicit-euler": (1, 1 / 512), "rk-low-storage": (4, 1 / 32)}
FIXED |= {"generalized-alpha": (2, 1 / 128), "generalized-alpha-index2": (2, 1 / 128)}
PAIRS = {"heun21": (2, 1 / 64), "bs32": (3, 1 / 32), "rk43": (4, 1 / 32), "tsit5": (5, 1 / 16)}
PAIRS |= {"verner65": (6, 1 / 8), "verner76": (7, 1 / 16), "dop853": (8, 1 / 5), "rosenbrock": (3, 1 / 64)}


@pytest.mark.parametrize("integrator", FIXED)
def test_fixed_step_methods_have_their_order_on_the_payload(integrator: str) -> None:
    order, step = FIXED[integrator]
    steps = [step, step / 2, step / 4]
    # The tolerance ends Newton's iteration of generalized-alpha and says when a derivative is kept.
    found = slopes(steps, [payload_error(run(integrator=integrator, dt=h, rtol=1e-10)) for h in steps])
    assert order - 0.25 < found[-1] < order + 0.6, found


@pytest.mark.parametrize("integrator", PAIRS)
def test_pairs_have_their_order_on_the_payload(integrator: str) -> None:
    order, step = PAIRS[integrator]
    steps = [step, step / 2]
    # A tolerance that every step meets leaves max_step as the step.
    runs = [run(integrator=integrator, rtol=0.1, max_step=h) for h in steps]
    for h, out in zip(steps, runs, strict=True):
        assert T_END / h <= out["stats"]["steps"] <= T_END / h + 4
    found = slopes(steps, [payload_error(out) for out in runs])
    assert order - 0.4 < found[0] < order + 1.6, found


@pytest.mark.parametrize("integrator", ["heun21", "bs32", "rk43", "tsit5", "verner65", "verner76", "dop853",
                                        "rosenbrock", "ark-dirk", "ark-imex"])  # fmt: skip
def test_error_falls_with_the_tolerance(integrator: str) -> None:
    errors = [payload_error(run(integrator=integrator, rtol=rtol)) for rtol in (1e-4, 1e-6)]
    assert errors[1] < 0.2 * errors[0], errors
    assert errors[1] < 1e-4, errors


def tumbling() -> Scene:
    """A free body that tumbles: no constraint, no projection, an exact copy of SciPy's problem."""
    scene = Scene(gravity=9.81)
    scene.add_body(
        name="block", mass=2.0, inertia=np.diag([1.0, 2.0, 2.5]), position=(0.0, 0.0, 0.0),
        velocity=(1.0, 2.0, 3.0), angular_velocity=(0.3, 2.0, 0.2),
    )  # fmt: skip
    return scene


@pytest.mark.parametrize("integrator, method", [("bs32", RK23), ("dopri5", RK45), ("dop853", DOP853)])
def test_steps_equal_those_of_scipy(integrator: str, method: type[RungeKutta]) -> None:
    """The same pair from SciPy's coefficients, on the same derivative: equal to rounding."""
    scene = tumbling()
    model = scene.compile()
    h, steps = 1 / 64, 16  # short enough for the choice of the first step to be max_step
    own = Run(scene, model=model, t_end=h * steps, dt_out=h, integrator=integrator, rtol=0.1, max_step=h,
              formulation="redundant")  # fmt: skip
    y = np.array(own.core.state.values)
    own.advance(h * steps)
    assert own.core.statistics()["steps"] == steps
    evaluate = Evaluator(model).derivative
    f, k = evaluate(0.0, y), np.empty((method.n_stages + 1, y.size))
    for i in range(steps):
        y, f = rk_step(evaluate, i * h, y, f, h, method.A[:, : method.n_stages], method.B, method.C, k)
    np.testing.assert_allclose(own.core.state.values, y, rtol=1e-13, atol=1e-13)


@pytest.mark.parametrize("integrator, method", [("bs32", RK23), ("dop853", DOP853)])
def test_dense_output_equals_that_of_scipy(integrator: str, method: type[RungeKutta]) -> None:
    scene = tumbling()
    model = scene.compile()
    h, n = 1 / 64, 5
    own = Run(scene, model=model, t_end=h, dt_out=h / n, integrator=integrator, rtol=0.1, max_step=h,
              channels=["position", "velocity", "angular_velocity"])  # fmt: skip
    y = np.array(own.core.state.values)
    solver = method(Evaluator(model).derivative, 0.0, y, h, first_step=h, max_step=h, rtol=0.1, atol=1e3)
    solver.step()
    own.advance(h)
    assert own.core.statistics()["steps"] == 1
    theirs = solver.dense_output()(np.linspace(0.0, h, n + 1)).T
    out = own.core.channels()
    places = {"position": slice(0, 3), "velocity": slice(7, 10), "angular_velocity": slice(10, 13)}
    for name, columns in places.items():
        np.testing.assert_allclose(out[name][:, 0], theirs[:, columns], rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize("orientation", ["quaternion", "euler_xyz"])
def test_semi_implicit_euler_turns_by_the_exponential(orientation: str) -> None:
    """At constant angular velocity about a principal axis the rotation is exact whatever the step."""
    scene = Scene(gravity=0.0, orientation=orientation)
    scene.add_body(name="top", mass=1.0, inertia=np.diag([1.0, 2.0, 3.0]), position=(0.0, 0.0, 0.0),
                   angular_velocity=(0.0, 0.0, 2.0))  # fmt: skip
    turn = Run(scene, t_end=1.0, dt_out=1.0, integrator="semi-implicit-euler", dt=0.25,
               channels=["quaternion"])  # fmt: skip
    turn.advance(1.0)
    found = turn.core.channels()["quaternion"][-1, 0]
    np.testing.assert_allclose(found, [np.cos(1.0), 0.0, 0.0, np.sin(1.0)], rtol=0.0, atol=1e-14)


@lru_cache(maxsize=1)
def afloat() -> tuple[Scene, Any]:
    scene = cases.case2(relative_bound=0.0)
    return scene, scene.compile()


def afloat_payload(**settings: Any) -> np.ndarray:
    scene, model = afloat()
    out = Run(scene, t_end=5.0, dt_out=5.0, model=model, channels=["position"], **settings)
    out.advance(5.0)
    return np.asarray(out.core.channels()["position"][-1, list(scene.bodies).index("payload")])


@pytest.mark.parametrize("integrator, settings, limit", [
    ("semi-implicit-euler", {"dt": 2e-3}, 2e-3),
    ("generalized-alpha", {"dt": 1e-2}, 2e-3),
    ("rk-low-storage", {"dt": 5e-2}, 1e-5),
    ("heun21", {"rtol": 1e-5}, 1e-3),
    ("rosenbrock", {"rtol": 1e-5}, 1e-3),
    ("ark-imex", {"rtol": 1e-5}, 1e-3),
    ("tsit5", {"rtol": 1e-7}, 1e-6),
    ("verner65", {"rtol": 1e-7}, 1e-6),
    ("verner76", {"rtol": 1e-7}, 1e-6),
    ("dop853", {"rtol": 1e-7}, 1e-6),
])  # fmt: skip
def test_methods_agree_on_case_2_afloat(integrator: str, settings: dict[str, float], limit: float) -> None:
    """Memory states, waves, controllers and constraints together."""
    reference = afloat_payload(rtol=1e-11)
    assert np.linalg.norm(afloat_payload(integrator=integrator, **settings) - reference) < limit


def test_the_reference_of_the_orders_stands() -> None:
    assert np.linalg.norm(run(integrator="dop853", rtol=1e-12)["position"][-1, -1] - exact()) < 1e-9


def test_the_design_lists_every_integrator() -> None:
    text = (Path(__file__).parents[1] / "docs" / "design.md").read_text(encoding="utf-8")
    table = text[text.index("| name | kind | order |") :].split("\n\n")[0]
    listed = re.findall(r"^\| `([^`]+)`", table, re.MULTILINE)
    assert sorted(listed) == sorted(integrator_names())
