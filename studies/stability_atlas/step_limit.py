"""The longest stable step of every fixed-step and explicit method, found by bisection and as predicted.

Predicted: the largest h for which |R(h lambda)| <= 1 for every eigenvalue lambda of the linearised scene, R
being the stability polynomial of the method's tableau [Hairer, Wanner, Solving Ordinary Differential
Equations II, IV.2]; for the semi-implicit method, from the spectral radius of one linear step. Found: the
scene at rest, pushed by a hair, either settles or does not.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import astuple, dataclass, fields, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.polynomial import Polynomial
from numpy.typing import NDArray

from seacrane import Run, Scene, SceneError, SimulationError, _core, cases
from seacrane._core import integrator as integrator_of
from seacrane._core import integrators
from seacrane.accuracy.methods import method_of
from seacrane.analysis.linear_system import LinearModel, linear_model
from seacrane.analysis.rest_state import held
from seacrane.plotting.panel import save_table
from stability_atlas.crane_axes import held_crane, stiffened

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PUSH, GROWTH = 1e-8, 1e4  # of the velocities, in units of their scale; more growth than that is instability
STEPS = 800  # of one trial
START = 20  # steps that a pair may need to reach its longest
MARGIN = np.log(GROWTH) / STEPS  # per step: slower growth than this does not show in a trial
NEAR = 1.005  # ratio at which bisection ends
LOOSE = 0.1  # tolerance at which a pair takes the longest step it may
LONGEST = 10.0  # s; beyond, no limit is looked for
SEMI_IMPLICIT = "semi-implicit-euler"
QUICK = (SEMI_IMPLICIT, "rk4", "dopri5", "tsit5")


@dataclass(frozen=True, kw_only=True)
class StepLimit:
    """One row: times in s, the fastest eigenvalue in 1/s; infinite where no limit was found up to 10 s."""

    scene: str
    formulation: str
    integrator: str
    fastest: float
    predicted: float
    found: float


def _crane(factor: float) -> Scene:
    scene = held_crane()
    stiffened(scene, factor)
    return scene


def _afloat() -> Scene:
    """Case 2 in calm water, its references held at the start."""
    return held(cases.case2(hs=0.0))


SCENES: dict[str, Callable[[], Scene]] = {
    "crane on the ground": lambda: _crane(1.0),
    "gains x 100": lambda: _crane(100.0),
    "case 2 at rest": _afloat,
}


def step_limits(*, quick: bool = False) -> Iterator[StepLimit]:
    """Limits of every scene, formulation and method; `quick`: one scene and four methods."""
    names = QUICK if quick else _methods()
    for title, make in list(SCENES.items())[: 1 if quick else None]:
        scene = make()
        linear = linear_model(scene)
        eigenvalues = np.asarray(np.linalg.eigvals(linear.a), dtype=np.complex128)
        for name in names:
            predicted = predicted_limit(name, linear, eigenvalues)
            for formulation in ("recursive", "redundant"):
                try:
                    found = found_limit(scene, linear, formulation, name, predicted)
                except SceneError:  # a method that this scene or formulation does not have
                    continue
                yield StepLimit(
                    scene=title, formulation=formulation, integrator=name,
                    fastest=float(np.abs(eigenvalues).max()), predicted=predicted, found=found,
                )  # fmt: skip


def _methods() -> list[str]:
    """Methods of fixed step, and those of the core's own whose stability is known from a tableau."""
    return [m.name for m in integrators() if m.setting == "dt" or _core.stability_polynomial(m.name)]


def predicted_limit(integrator: str, linear: LinearModel, eigenvalues: NDArray[np.complex128]) -> float:
    """The longest step (s) that damps all modes; NaN for a method without a tableau of its own here."""
    if integrator == SEMI_IMPLICIT:
        return _first_growth(lambda h: _semi_implicit_radius(linear, h))
    coefficients = _core.stability_polynomial(integrator)
    if not coefficients:
        return float("nan")
    polynomial = Polynomial(coefficients)
    return _first_growth(lambda h: float(np.abs(polynomial(h * eigenvalues)).max()))


def _semi_implicit_radius(linear: LinearModel, h: float) -> float:
    """Largest eigenvalue of one step: speeds and memory from the old state, coordinates with new speeds."""
    n = linear.degrees_of_freedom
    step = np.eye(len(linear.a)) + h * linear.a
    step[:n] = np.eye(len(linear.a))[:n] + h * step[n : 2 * n]
    return float(np.abs(np.linalg.eigvals(step)).max())


def _first_growth(radius: Callable[[float], float]) -> float:
    """The step at which the radius first exceeds 1 by what a trial can show."""
    stable = 1e-6
    for h in np.geomspace(1e-6, LONGEST, 1000):
        if radius(h) > 1.0 + MARGIN:
            return _bisect(lambda step: radius(step) <= 1.0 + MARGIN, stable, float(h), 1.0 + 1e-6)
        stable = float(h)
    return float("inf")


def _bisect(is_stable: Callable[[float], bool], low: float, high: float, near: float) -> float:
    while high / low > near:
        middle = np.sqrt(low * high)
        low, high = (middle, high) if is_stable(middle) else (low, middle)
    return float(np.sqrt(low * high))


def found_limit(
    scene: Scene, linear: LinearModel, formulation: str, integrator: str, predicted: float
) -> float:
    """The longest stable step (s) by bisection; the search does not start from the prediction alone."""
    model = scene.compile()

    def is_stable(h: float) -> bool:
        return _settles(scene, model, linear, formulation, integrator, h)

    high = 0.5 * predicted if np.isfinite(predicted) else 0.01
    low = 0.0
    while is_stable(high):
        low, high = high, 1.5 * high
        if high > LONGEST:
            return float("inf")
    while low == 0.0:
        if is_stable(high / 1.5):
            low = high / 1.5
        else:
            high /= 1.5
    return _bisect(is_stable, low, high, NEAR)


def _settles(
    scene: Scene, model: _core.Model, linear: LinearModel, formulation: str, integrator: str, h: float
) -> bool:
    rest, scale = np.array(linear.state.values), np.array(model.scale)
    counts = np.isfinite(scale)
    pushed = rest.copy()
    at = np.array([model.twist_index(body) + k for body in range(len(model.bodies)) for k in range(6)])
    pushed[at] += PUSH * scale[at] * np.random.default_rng(1).normal(size=at.size)
    start = _core.State(time=0.0, values=pushed, inputs=linear.state.inputs)
    known = integrator_of(integrator)
    steps = STEPS if not known.residual_form else STEPS // 5
    method = method_of(known, h if known.setting == "dt" else LOOSE, formulation)
    if known.setting == "rtol":
        method = replace(method, maximum_step=h)
    run = Run(scene, steps * h, method=method, start=start, model=model, dt_out=steps * h,
              channels=["position"])  # fmt: skip
    try:
        run.advance(steps * h)
    except SimulationError:
        return False
    taken = run.core.statistics()
    if taken["rejected_steps"] or taken["steps"] > 1.02 * steps + START:  # the step size control came to help
        return False
    moved = np.abs(np.array(run.core.state.values) - rest)[counts] / scale[counts]
    return bool(moved.max() < GROWTH * PUSH)


def write_step_limits(path: Path, limits: list[StepLimit]) -> None:
    """As a table."""
    rows = [[*astuple(row), row.found / row.predicted] for row in limits]
    save_table([*(field.name for field in fields(StepLimit)), "found/predicted"], rows, path)


def step_limit_figure(limits: list[StepLimit]) -> Figure:
    """Found over predicted, both logarithmic, one mark per scene and formulation."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(11.0, 5.0), layout="constrained")
    axes = figure.subplots()
    names = list(dict.fromkeys(row.integrator for row in limits))
    marks = {"recursive": "o", "redundant": "x"}
    scenes = list(dict.fromkeys(row.scene for row in limits))
    for row in limits:
        k = scenes.index(row.scene)
        x = names.index(row.integrator) + 0.22 * (k - 1)
        label = f"{row.scene}, {row.formulation}"
        if np.isfinite(row.found):
            axes.semilogy(x, row.found, marks[row.formulation], color=f"C{k}", label=label)
        else:
            axes.semilogy(x, LONGEST, "^", color=f"C{k}", label=f"{row.scene}: none up to {LONGEST:g} s")
        if np.isfinite(row.predicted):
            axes.hlines(row.predicted, x - 0.1, x + 0.1, color="black", linewidth=1.2, label="predicted")
    axes.set_xticks(range(len(names)), names, rotation=40, ha="right")
    axes.set_ylabel("longest stable step [s]")
    axes.set_title("Stability limit of the step: found by bisection (marks) and predicted (bars)")
    handles = dict(zip(*reversed(axes.get_legend_handles_labels()), strict=True))
    figure.legend(handles.values(), handles.keys(), loc="outside right upper", fontsize=8)
    axes.grid(alpha=0.3)
    return figure
