"""What a stiff line costs: rungs of the line and methods on case 2."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import Scene, cases
from seacrane.run.method import Method
from seacrane.trading.case import Case
from seacrane.trading.measured_case import timed

from .section import Section

Array = NDArray[np.float64]

T_END, DT_OUT = 100.0, 0.2  # s
STIFFNESSES = (1e7, 1e8, 1e9, 1e10, 1e11)  # N
STIFFEST_IMPLICIT = 1e8  # N: beyond it implicit methods take minutes
WEIGHT, LINK = 1e4 * 9.80665, 8.0  # N, m
TIGHT = Method(integrator="dop853", rtol=1e-8)
RIGID = Method(integrator="dopri5", rtol=1e-4)
IMPLICIT = (
    Method(integrator="rosenbrock", rtol=1e-3),
    Method(integrator="ark-dirk", rtol=1e-3),
    Method(integrator="cvode-bdf", rtol=1e-4),
)


@dataclass(frozen=True, kw_only=True)
class Ran:
    """A run of case 2: its payload's path, the tension of its line, and what it cost."""

    payload: Array
    tension: Array
    evaluations: int
    cpu_ms: float


def lifted(stiffness: float, stretch: str) -> Scene:
    """Case 2 with a line in the place of its link, as long under the payload's weight."""
    scene = cases.case2()
    link = scene.joints["link"]
    scene.remove("link")
    scene.add_line(
        name="link",
        bodies=[link.first, link.second],
        points=[link.first_frame.point, link.second_frame.point],
        EA=stiffness,
        length=LINK / (1.0 + WEIGHT / stiffness),
        rung=stretch,
    )
    return scene


def stiff_lines(*, repeats: int) -> Section:
    """Cost and error of every rung and sensible method over EA."""
    rigid = run_of(cases.case2(), RIGID, repeats=repeats)
    rows: list[list[Any]] = []
    for stiffness in STIFFNESSES:
        truth = run_of(lifted(stiffness, "elastic"), TIGHT, repeats=1)
        for stretch, method in _tried(stiffness):
            ran = run_of(
                lifted(stiffness, stretch), method, repeats=1 if method.integrator != "dopri5" else repeats
            )
            rows.append(
                [
                    power_of_ten(stiffness),
                    stretch,
                    f"{method.integrator} {method.rtol:g}",
                    ran.evaluations,
                    ran.evaluations / rigid.evaluations,
                    ran.cpu_ms / rigid.cpu_ms,
                    1e3 * float(np.linalg.norm(ran.payload - truth.payload, axis=1).max()),
                    100.0 * float(np.abs(ran.tension - truth.tension).max() / np.ptp(truth.tension)),
                ]
            )
    return Section(
        title="Stiff lines",
        text=(
            f"{T_END:g} s of case 2, its link of {LINK:g} m replaced by a line of EA, 2 % damped. "
            "Errors are those of the payload's place and of the tension (of its range) against the elastic "
            f"line solved tightly (`{TIGHT.integrator}`, {TIGHT.rtol:g}); costs are over those "
            f"of the rigid link with `{RIGID.integrator}`, {RIGID.rtol:g}: "
            f"{rigid.evaluations} evaluations."
        ),
        head=[
            "EA, N",
            "stretch",
            "method",
            "evaluations",
            "evaluations over rigid",
            "CPU over rigid",
            "payload error, mm",
            "tension error, %",
        ],
        rows=rows,
    )


def _tried(stiffness: float) -> Iterator[tuple[str, Method]]:
    yield "quasi-static", RIGID
    yield "elastic", Method(integrator="dopri5", rtol=1e-3)
    if stiffness <= STIFFEST_IMPLICIT:
        for method in IMPLICIT:
            yield "elastic", method


def run_of(scene: Scene, method: Method, *, repeats: int, t_end: float = T_END) -> Ran:
    case = Case(scene=scene, t_end=t_end, dt_out=DT_OUT)
    has_line = "link" in scene.loads
    done = timed(case, method, ["position", "line_tension" if has_line else "tension"], repeats=repeats)
    if done.stopped is not None:
        raise done.stopped
    channels = done.channels()
    return Ran(
        payload=channels["position"][:, list(scene.bodies).index("payload")],
        tension=channels["line_tension"][:, 0] if has_line else np.zeros(0),
        evaluations=int(done.counted["evaluations"]),
        cpu_ms=1e3 * done.cpu_s,
    )


def path_of(stiffness: float, t_end: float) -> Array:
    """Places of the payload on an elastic line, solved tightly."""
    return run_of(lifted(stiffness, "elastic"), TIGHT, repeats=1, t_end=t_end).payload


def power_of_ten(stiffness: float) -> str:
    """As 1e8."""
    return f"1e{round(np.log10(stiffness))}"
