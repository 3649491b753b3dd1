"""Work and precision of every integrator on case 2, against a tight reference."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from seacrane import Method, cases
from seacrane._core import Integrator, integrators
from seacrane.accuracy.quantities import quantities_of
from seacrane.inputs.atomic import atomic_write
from seacrane.trading.case import Case
from seacrane.trading.measured_case import channels_of, measured, timed
from seacrane.trading.methods import methods
from seacrane.trading.reference import Reference, reference
from seacrane.trading.row import Row
from seacrane.trading.row_file import RowFile, completed

from .section import Section

Array = NDArray[np.float64]

T_END, DT_OUT = 100.0, 1.0  # s; few outputs, so that the methods' own cost shows
PAYLOAD, FORCE = "payload_position", "cylinder_force"
TOLERANCES = (1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8)
IMPLICIT_TOLERANCES = (1e-3, 1e-4, 1e-5)
STEPS_OF_ORDER_1 = (0.02, 0.01, 0.005, 0.002)  # s
STEPS = (0.25, 0.2, 0.1, 0.05, 0.025, 0.0125)  # s
STEPS_IMPLICIT = (0.05, 0.025, 0.01)  # s
TIGHT = (
    Method(integrator="dopri5", rtol=1e-11),
    Method(integrator="verner76", rtol=1e-11),
)


def work_precision(*, repeats: int) -> tuple[list[Row], Reference]:
    """Every tolerance or step of every integrator, and the reference that errors are told by."""
    case = Case(scene=cases.case2(), t_end=T_END, dt_out=DT_OUT)
    quantities = quantities_of(case.scene, case.model, [PAYLOAD, FORCE])

    def values(method: Method) -> Mapping[str, Array] | str:
        done = timed(case, method, channels_of(quantities))
        if done.stopped is not None:
            return str(done.stopped)
        result = done.result()
        return {name: quantity.values(result) for name, quantity in quantities.items()}

    truth = reference(values, TIGHT)
    tried = methods(_values, formulations=("auto",))
    empty = {row.key: row for row in (Row(case={"scene": "case2"}, method=method) for method in tried)}
    rows = completed(
        empty,
        RowFile(None, {}),
        lambda keys: (
            (key, measured(case, empty[key].method, quantities, truth, empty[key], repeats=repeats))
            for key in keys
        ),
        title="work and precision",
        progress=False,
    )
    return rows, truth


def _values(method: Integrator) -> tuple[float, ...]:
    """Steps or tolerances: none tighter than a method of this order and cost of a step is run with."""
    if method.setting == "dt":
        explicit = STEPS_OF_ORDER_1 if method.order == 1 else STEPS
        return STEPS_IMPLICIT if method.uses_jacobian else explicit
    if method.uses_jacobian:
        return IMPLICIT_TOLERANCES if method.lowest_order == method.order else TOLERANCES[:-1]
    return TOLERANCES[:4] if method.order < 4 else TOLERANCES


def _short(text: str) -> str:
    return text if len(text) <= 90 else f"{text[:87]}..."


def table(rows: Sequence[Row], truth: Reference, *, repeats: int) -> Section:
    """The rows as a table."""
    fastest = min(row.cpu_s for row in rows if row.stable)
    cells = [
        [
            row.method.integrator,
            row.method.setting.replace("=", " "),
            1e3 * row.cpu_s if row.stable else None,
            row.cpu_s / fastest if row.stable else None,
            row.evaluations if row.stable else None,
            row.error(PAYLOAD) if row.stable else None,
            row.error(FORCE) if row.stable else None,
            _short(row.message),
        ]
        for row in rows
    ]
    first, second = truth.runs
    exact = ", ".join(method.name for method in integrators() if method.uses_jacobian)
    return Section(
        title="Integrators: work and precision on case 2",
        text=(
            f"100 s, outputs every {DT_OUT:g} s, best of {repeats}. Errors: largest distance of the payload "
            f"and largest difference of a cylinder force from {first}, over all outputs; {second} differs "
            f"from that reference by {truth.uncertainty[PAYLOAD]:.1e} m. cvode-adams cannot project and uses "
            "Baumgarte stabilisation. Exact Jacobians are not counted as evaluations; these take them: "
            f"{exact}."
        ),
        head=["integrator", "setting", "CPU, ms", "over fastest", "evaluations",
              "payload error, m", "cylinder force error, N", "stopped because"],
        rows=cells,
    )  # fmt: skip


def figure(rows: Sequence[Row], path: Path) -> None:
    """Work-precision diagram: payload error over evaluations and over CPU time."""
    from matplotlib.figure import Figure
    from matplotlib.ticker import NullFormatter

    picture = Figure(figsize=(10.4, 3.8), layout="constrained")
    axes = picture.subplots(1, 2, sharey=True)
    stable = [row for row in rows if row.stable]
    for axis, attribute, factor, label in (
        (axes[0], "evaluations", 1.0, "evaluations"),
        (axes[1], "cpu_s", 1e3, "CPU time, ms"),
    ):
        for number, name in enumerate(dict.fromkeys(row.method.integrator for row in stable)):
            run = [row for row in stable if row.method.integrator == name]
            cost = [factor * getattr(row, attribute) for row in run]
            axis.loglog(
                cost, [row.error(PAYLOAD) for row in run], "o-" if number < 10 else "s:", ms=4, label=name
            )
        axis.set_xlabel(label)
        axis.xaxis.set_minor_formatter(NullFormatter())
        axis.grid(True, which="both", alpha=0.3)
    axes[0].set_ylabel("largest error of the payload's position, m")
    picture.legend(*axes[1].get_legend_handles_labels(), loc="outside right upper", fontsize=7)
    picture.suptitle("Case 2, 100 s: work and precision", fontsize=10)
    with atomic_write(path) as draft:
        picture.savefig(draft, dpi=130, format="png")
