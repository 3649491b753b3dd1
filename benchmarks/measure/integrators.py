"""Work and precision of every integrator on case 2, against a tight reference."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import Model, Scene, SimulationError, _core, cases

from .section import Section
from .timing import Timed, timed_run

Array = NDArray[np.float64]

T_END, DT_OUT = 100.0, 1.0  # s; few outputs, so that the methods' own cost shows
TOLERANCES = (1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8)
IMPLICIT_TOLERANCES = (1e-3, 1e-4, 1e-5)
STEPS_OF_ORDER_1 = (0.02, 0.01, 0.005, 0.002)  # s
STEPS = (0.25, 0.2, 0.1, 0.05, 0.025, 0.0125)  # s
STEPS_IMPLICIT = (0.05, 0.025, 0.01)  # s
REFERENCE = {"integrator": "dopri5", "rtol": 1e-11}
CHECK = {"integrator": "verner76", "rtol": 1e-11}


@dataclass(frozen=True, kw_only=True)
class Point:
    """One run: CPU time (s), largest error of the payload's position (m) and of the cylinder forces (N)."""

    integrator: str
    setting: str
    cpu: float | None = None
    evaluations: int | None = None
    position_error: float | None = None
    force_error: float | None = None
    reason: str = ""


def _measure(scene: Scene, model: Model, repeats: int, **settings: Any) -> tuple[Timed, Array, Array]:
    """The run, its payload positions (n, 3) and its cylinder forces (n, 2)."""
    run = timed_run(
        scene, model=model, repeats=repeats, t_end=T_END, dt_out=DT_OUT,
        channels=["position", "actuator_force"], **settings,
    )  # fmt: skip
    actuators = list(scene.actuators)
    cylinders = [actuators.index(name) for name in ("main", "knuckle")]
    payload = list(scene.bodies).index("payload")
    return run, run.channels["position"][:, payload], run.channels["actuator_force"][:, cylinders]


def settings(method: _core.Integrator) -> tuple[float, ...]:
    """Steps or tolerances: none tighter than a method of this order and cost of a step is run with."""
    if method.setting == "dt":
        explicit = STEPS_OF_ORDER_1 if method.order == 1 else STEPS
        return STEPS_IMPLICIT if method.uses_jacobian else explicit
    if method.uses_jacobian:
        return IMPLICIT_TOLERANCES if method.lowest_order == method.order else TOLERANCES[:-1]
    return TOLERANCES[:4] if method.order < 4 else TOLERANCES


def work_precision(*, repeats: int) -> tuple[list[Point], float]:
    """Every setting of every integrator, and the reference's own uncertainty in position, m."""
    scene = cases.case2()
    model = scene.compile()
    _, position, force = _measure(scene, model, 1, **REFERENCE)
    _, check, _ = _measure(scene, model, 1, **CHECK)
    points = []
    for method in _core.integrators():
        for value in settings(method):
            integrator, setting = method.name, {method.setting: value}
            label = f"{method.setting} {value:g}"
            try:
                run, p, f = _measure(scene, model, repeats, integrator=integrator, **setting)
            except SimulationError as error:
                points.append(Point(integrator=integrator, setting=label, reason=_short(error)))
                continue
            points.append(
                Point(
                    integrator=integrator,
                    setting=label,
                    cpu=run.cpu,
                    evaluations=run.counters["evaluations"],
                    position_error=float(np.max(np.abs(p - position))),
                    force_error=float(np.max(np.abs(f - force))),
                )
            )
    return points, float(np.max(np.abs(check - position)))


def _short(error: SimulationError) -> str:
    text = " ".join(str(error).split())
    return text if len(text) <= 90 else f"{text[:87]}..."


def table(points: list[Point], uncertainty: float, *, repeats: int) -> Section:
    """The points as a table."""
    implicit = ", ".join(method.name for method in _core.integrators() if method.uses_jacobian)
    fastest = min(point.cpu for point in points if point.cpu is not None)
    rows = [
        [
            point.integrator,
            point.setting,
            None if point.cpu is None else 1e3 * point.cpu,
            None if point.cpu is None else point.cpu / fastest,
            point.evaluations,
            point.position_error,
            point.force_error,
            point.reason,
        ]
        for point in points
    ]
    return Section(
        title="Integrators: work and precision on case 2",
        text=(
            f"100 s, outputs every {DT_OUT:g} s, best of {repeats}. Errors: largest difference of the "
            "payload's position and of the cylinder forces from dopri5 at rtol 1e-11, over all outputs; "
            f"verner76 at rtol 1e-11 differs from that reference by {uncertainty:.1e} m. cvode-adams cannot "
            "project and uses Baumgarte stabilisation. Exact Jacobians are not counted as evaluations; these "
            f"take them: {implicit}."
        ),
        head=["integrator", "setting", "CPU, ms", "over fastest", "evaluations",
              "payload error, m", "cylinder force error, N", "stopped because"],
        rows=rows,
    )  # fmt: skip


def figure(points: list[Point], path: Path) -> None:
    """Work-precision diagram: payload error over evaluations and over CPU time."""
    from matplotlib.figure import Figure
    from matplotlib.ticker import NullFormatter

    from seacrane.files.atomic import atomic_write

    picture = Figure(figsize=(9.0, 3.8), layout="constrained")
    axes = picture.subplots(1, 2, sharey=True)
    for axis, attribute, factor, label in (
        (axes[0], "evaluations", 1.0, "evaluations"),
        (axes[1], "cpu", 1e3, "CPU time, ms"),
    ):
        for name in _core.integrator_names():
            run = [point for point in points if point.integrator == name and point.cpu is not None]
            cost = [factor * getattr(point, attribute) for point in run]
            if run:
                axis.loglog(cost, [point.position_error for point in run], "o-", ms=4, label=name)
        axis.set_xlabel(label)
        axis.xaxis.set_minor_formatter(NullFormatter())
        axis.grid(True, which="both", alpha=0.3)
    axes[0].set_ylabel("largest error of the payload's position, m")
    axes[1].legend(fontsize=6, ncols=2)
    picture.suptitle("Case 2, 100 s: work and precision", fontsize=10)
    with atomic_write(path) as draft:
        picture.savefig(draft, dpi=130, format="png")
