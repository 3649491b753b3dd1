"""What a stiff line costs with every method: evaluations and errors on case 2, up to a cap."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from seacrane import Method, Run, SeacraneError, cases
from seacrane._core import Integrator, integrators
from seacrane.run.outputs import Outputs

from .section import Section
from .stiff_lines import (
    DT_OUT,
    LINK,
    RIGID,
    STIFFNESSES,
    T_END,
    TIGHT,
    WEIGHT,
    Ran,
    lifted,
    power_of_ten,
    run_of,
)

MOST_EVALUATIONS = 200_000
TOLERANCE, TOLERANCE_IMPLICIT = 1e-4, 1e-3
STEP, STEP_OF_ORDER_1, STEP_IMPLICIT = 0.05, 0.005, 0.02  # s, at the longest
OF_STABLE = 0.5  # of the longest stable step with the line's mode


class TooMany(Exception):
    """More evaluations than the cap."""


def line_methods(*, most: int = MOST_EVALUATIONS) -> Section:
    """Every method of the core on every EA and rung; what needs more than the cap is told so."""
    rigid = run_of(cases.case2(), RIGID, repeats=1).evaluations
    rows: list[list[Any]] = []
    for stiffness in STIFFNESSES:
        truth = run_of(lifted(stiffness, "elastic"), TIGHT, repeats=1)
        for stretch in ("quasi-static", "elastic"):
            for integrator in integrators():
                method = _method(integrator, stiffness if stretch == "elastic" else 0.0)
                cells = list(_cells(stiffness, stretch, method, truth, rigid, most))
                rows.append([power_of_ten(stiffness), stretch, f"{integrator.name} {method.setting}", *cells])
    return Section(
        title="Stiff lines by every method",
        text=(
            f"As above, every method at one setting: `rtol` {TOLERANCE:g}, {TOLERANCE_IMPLICIT:g} of "
            "implicit "
            f"methods. Of fixed steps it is the shorter of {STEP:g} s ({STEP_OF_ORDER_1:g} s of order 1, "
            f"{STEP_IMPLICIT:g} s of implicit ones) and half of what is stable. Evaluations do not count "
            f"Jacobians. Runs of more than {most} evaluations were left out."
        ),
        head=[
            "EA, N",
            "stretch",
            "method",
            "evaluations",
            "evaluations over rigid",
            "Jacobians",
            "payload error, mm",
            "tension error, %",
            "left out because",
        ],
        rows=rows,
    )


def _method(integrator: Integrator, stiffness: float) -> Method:
    if integrator.setting == "rtol":
        tolerance = TOLERANCE_IMPLICIT if integrator.uses_jacobian else TOLERANCE
        return Method(integrator=integrator.name, rtol=tolerance)
    usual = STEP_OF_ORDER_1 if integrator.order == 1 else STEP
    step = STEP_IMPLICIT if integrator.uses_jacobian else usual
    if integrator.stable_up_to and stiffness > 0.0:
        omega = np.sqrt(stiffness / LINK / (WEIGHT / 9.80665))
        step = min(step, OF_STABLE * integrator.stable_up_to / omega)
    return Method(integrator=integrator.name, dt=float(f"{step:.2g}"))


def _cells(
    stiffness: float, stretch: str, method: Method, truth: Ran, rigid: int, most: int
) -> Iterator[Any]:
    """Evaluations, over those of the rigid link, Jacobians, errors, and why there are none."""
    try:
        ran, jacobians = _ran(stiffness, stretch, method, most)
    except (SeacraneError, TooMany) as error:
        yield from (None, None, None, None, None, " ".join(str(error).split()))
        return
    yield ran.evaluations
    yield ran.evaluations / rigid
    yield jacobians
    yield 1e3 * float(np.linalg.norm(ran.payload - truth.payload, axis=1).max())
    yield 100.0 * float(np.abs(ran.tension - truth.tension).max() / np.ptp(truth.tension))
    yield ""


def _ran(stiffness: float, stretch: str, method: Method, most: int) -> tuple[Ran, int]:
    """The run and its Jacobians; TooMany as soon as it has taken more evaluations."""
    scene = lifted(stiffness, stretch)
    if method.dt is not None and T_END / method.dt > most:
        raise TooMany(f"more than {most} evaluations")
    outputs = Outputs(dt_out=DT_OUT, channels=["position", "line_tension"])
    run = Run(scene, T_END, method=method, outputs=outputs)

    def look(_: float) -> None:
        if run.core.statistics()["evaluations"] > most:
            raise TooMany(f"more than {most} evaluations")

    run.advance(T_END, look)
    look(T_END)
    channels, counted = run.core.channels(), run.core.statistics()
    ran = Ran(
        payload=channels["position"][:, list(scene.bodies).index("payload")],
        tension=channels["line_tension"][:, 0],
        evaluations=int(counted["evaluations"]),
        cpu_ms=0.0,
    )
    return ran, int(counted["jacobians"])
