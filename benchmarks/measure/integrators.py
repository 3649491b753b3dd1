"""Work and precision of every integrator on case 2, against a tight reference."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from seacrane import Method, cases
from seacrane._core import Integrator
from seacrane.accuracy.case import Case
from seacrane.accuracy.measured import Reference, measured, tight_reference
from seacrane.accuracy.methods import methods
from seacrane.accuracy.quantities import quantities_of
from seacrane.accuracy.row import Row
from seacrane.inputs.atomic import atomic_write

from .section import RESULTS, Section
from .sources import CRANE

T_END, DT_OUT = 100.0, 1.0  # s; few outputs, so that the methods' own cost shows
REPEATS = 2
PICTURE = "work_precision.png"
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


def work_precision() -> tuple[list[Row], Reference]:
    """Every tolerance or step of every integrator, and the reference that errors are told by."""
    case = Case(scene=cases.case2(), t_end=T_END, dt_out=DT_OUT)
    quantities = quantities_of(case.scene, case.model, [PAYLOAD, FORCE])

    truth = tight_reference(case, quantities, TIGHT)
    empty = [Row(case={"scene": "case2"}, method=one) for one in methods(_values, formulations=("auto",))]
    rows = [measured(case, row.method, quantities, truth, row, repeats=REPEATS) for row in empty]
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


def table() -> Iterator[list[Any]]:
    """The rows, and the picture beside the document."""
    rows, truth = work_precision()
    figure(rows, RESULTS.parent / PICTURE)
    fastest = min(row.cpu_s for row in rows if row.stable)
    first, second = (str(method) for method in truth.runs)
    yield [first, "the reference", *[None] * 6]
    yield [second, "from the reference", None, None, None, truth.uncertainty[PAYLOAD], None, None]
    for row in rows:
        told = [row.method.integrator, row.method.setting.replace("=", " ")]
        if not row.stable:
            yield [*told, *[None] * 5, _short(row.message)]
            continue
        cost = [1e3 * row.cpu_s, row.cpu_s / fastest, row.evaluations]
        yield [*told, *cost, row.error(PAYLOAD), row.error(FORCE), None]


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


SECTION = Section(
    title="Integrators: work and precision on case 2",
    text=(
        f"{T_END:g} s, outputs every {DT_OUT:g} s, best of {REPEATS}. Errors: largest distance of the "
        "payload and largest difference of a cylinder force from the reference, over all outputs. "
        "Exact Jacobians, which implicit "
        "methods take, are not counted as evaluations.\n\n![Payload error over evaluations and over CPU "
        f"time, per integrator]({PICTURE})"
    ),
    head=["integrator", "setting", "CPU, ms", "over fastest", "evaluations", "payload error, m",
          "cylinder force error, N", "stopped because"],
    rows=table,
    sources=CRANE,
)  # fmt: skip
