"""What a snatch of a stiff line costs: its fast mode is resolved for a few periods."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from seacrane import Method, Run, Scene

from .section import Section
from .sources import LINE, RUN, STEPS
from .stiff_lines import STIFFNESSES, power_of_ten

MASS, GRAVITY, LENGTH = 2e4, 9.80665, 10.0  # kg, m/s2, m
SPEED, SLACK = 1.0, 0.02  # m/s at which it snatches, m that it is slack before
RATIO = 0.02  # of critical damping
PERIODS = 5  # after the snatch
DT_OUT = 400  # to a period
METHODS = (
    Method(integrator="dopri5", rtol=1e-4),
    Method(integrator="verner76", rtol=1e-4),
    Method(integrator="rosenbrock", rtol=1e-3),
    Method(integrator="cvode-bdf", rtol=1e-4),
)


def dropped(stiffness: float | None) -> Scene:
    """A load that falls into its slack line, or into a rigid wire with the restitution of one."""
    scene = Scene(name="dropped")
    place = (0.0, 0.0, -LENGTH + SLACK)
    speed = np.sqrt(SPEED**2 - 2.0 * GRAVITY * SLACK)
    scene.add_body(
        name="load", mass=MASS, inertia=(1e4, 1e4, 1e4), position=place, velocity=(0.0, 0.0, -speed)
    )
    if stiffness is None:
        scene.add_joint(
            kind="distance", name="rope", first="ground", second="load", point=(0, 0, 0),
            second_point=place, length=LENGTH,
        )  # fmt: skip
        scene.add_line(
            joint="rope", rung="rigid", restitution=np.exp(-np.pi * RATIO / np.sqrt(1.0 - RATIO**2))
        )
    else:
        scene.add_line(
            name="rope", bodies=["ground", "load"], points=np.zeros((2, 3)), EA=stiffness,
            length=LENGTH, damping_ratio=RATIO,
        )  # fmt: skip
    return scene


def snatch_cost() -> Iterator[list[Any]]:
    """Evaluations of the first periods from the snatch on, over EA and for a few methods."""
    begin = (SPEED - np.sqrt(SPEED**2 - 2.0 * GRAVITY * SLACK)) / GRAVITY
    weight = MASS * GRAVITY
    for stiffness in STIFFNESSES:
        k = stiffness / LENGTH
        period = 2.0 * np.pi / np.sqrt(k / MASS)
        expected = weight + np.sqrt(weight**2 + k * MASS * SPEED**2)
        for method in METHODS:
            run = Run(
                dropped(stiffness), begin + PERIODS * period, method=method, dt_out=period / DT_OUT,
                channels=["line_tension"],
            )  # fmt: skip
            run.advance(begin)
            before = int(run.core.statistics()["evaluations"])
            run.advance(run.t_end)
            counted = run.core.statistics()
            through = int(counted["evaluations"]) - before
            peak = float(run.core.channels()["line_tension"].max())
            yield [
                power_of_ten(stiffness), f"{method.integrator} {method.rtol:g}", 1e3 * period, through,
                int(counted["jacobians"]), through / PERIODS, 1e-3 * peak, 100.0 * (peak / expected - 1.0),
            ]  # fmt: skip
    run = Run(dropped(None), 1.0, method=METHODS[0], dt_out=0.1)
    run.advance(1.0)
    evaluations = int(run.core.statistics()["evaluations"])
    yield ["rigid, an impact", f"{METHODS[0].integrator} {METHODS[0].rtol:g}", None, evaluations, *[None] * 4]


SECTION = Section(
    title="Cost of a snatch",
    text=(
        f"{MASS / 1e3:g} t that meet the end of {LENGTH:g} m of slack line at {SPEED:g} m/s, {100 * RATIO:g} "
        f"% damped: evaluations in {PERIODS} periods of the line from there on, whatever the rest of the run "
        "costs. The peak of the tension is over m g + sqrt((m g)^2 + k m v^2), which is that without "
        "damping. The wire of rung 'rigid' takes the same instant as an impact; its evaluations are those "
        "of 1 s."
    ),
    head=["EA, N", "method", "period, ms", "evaluations", "Jacobians", "evaluations per period", "peak, kN",
          "off the closed form, %"],
    rows=snatch_cost,
    sources=(*STEPS, *RUN, *LINE),
)  # fmt: skip
