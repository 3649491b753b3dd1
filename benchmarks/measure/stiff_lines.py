"""What a stiff line costs: rungs of the line and methods on case 2."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import Scene, cases
from seacrane.accuracy.case import Case, timed
from seacrane.run.method import Method

from .section import Section
from .sources import CRANE, LINE

Array = NDArray[np.float64]

T_END, DT_OUT = 100.0, 0.2  # s
STIFFNESSES = (1e7, 1e8, 1e9, 1e10, 1e11)  # N
STIFFEST_IMPLICIT = 1e8  # N: beyond it implicit methods take minutes
REPEATS = 3
WEIGHT, LINK = 1e4 * 9.80665, 8.0  # N, m
TIGHT = Method(integrator="dop853", rtol=1e-8)
RIGID = Method(integrator="dopri5", rtol=1e-4)
IMPLICIT = (
    Method(integrator="rosenbrock", rtol=1e-3),
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


def stiff_lines() -> Iterator[list[Any]]:
    """Cost and error of every rung and sensible method over EA; the rigid link first."""
    rigid = run_of(cases.case2(), RIGID, repeats=REPEATS)
    yield ["", "rigid link", f"{RIGID.integrator} {RIGID.rtol:g}", rigid.evaluations, 1, 1, None, None]
    for stiffness in STIFFNESSES:
        truth = run_of(lifted(stiffness, "elastic"), TIGHT, repeats=1)
        for stretch, method in _tried(stiffness):
            ran = run_of(
                lifted(stiffness, stretch), method, repeats=1 if method.integrator != "dopri5" else REPEATS
            )
            yield [
                power_of_ten(stiffness), stretch, f"{method.integrator} {method.rtol:g}", ran.evaluations,
                ran.evaluations / rigid.evaluations, ran.cpu_ms / rigid.cpu_ms,
                1e3 * float(np.linalg.norm(ran.payload - truth.payload, axis=1).max()),
                100.0 * float(np.abs(ran.tension - truth.tension).max() / np.ptp(truth.tension)),
            ]  # fmt: skip


def _tried(stiffness: float) -> Iterator[tuple[str, Method]]:
    yield "quasi-static", RIGID
    yield "elastic", Method(integrator="dopri5", rtol=1e-3)
    if stiffness <= STIFFEST_IMPLICIT:
        for method in IMPLICIT:
            yield "elastic", method


def run_of(scene: Scene, method: Method, *, repeats: int) -> Ran:
    """Of the payload and the line."""
    case = Case(scene=scene, t_end=T_END, dt_out=DT_OUT)
    has_line = "link" in scene.loads
    done = timed(case, method, ["position", "line_tension" if has_line else "tension"], repeats=repeats)
    channels = done.result().channels
    return Ran(
        payload=channels["position"][:, list(scene.bodies).index("payload")],
        tension=channels["line_tension"][:, 0] if has_line else np.zeros(0),
        evaluations=int(done.stats["evaluations"]),
        cpu_ms=1e3 * done.cpu_s,
    )


def power_of_ten(stiffness: float) -> str:
    """As 1e8."""
    return f"1e{round(np.log10(stiffness))}"


SECTION = Section(
    title="Stiff lines",
    text=(
        f"{T_END:g} s of case 2, its link of {LINK:g} m replaced by a line of EA, 2 % damped. Errors are "
        "those of the payload's place and of the tension (of its range) against the elastic line solved "
        f"tightly (`{TIGHT.integrator}`, {TIGHT.rtol:g}); costs are over those of the rigid link."
    ),
    head=["EA, N", "stretch", "method", "evaluations", "evaluations over rigid", "CPU over rigid",
          "payload error, mm", "tension error, %"],
    rows=stiff_lines,
    sources=(*CRANE, *LINE),
)  # fmt: skip
