"""The linear model of a scene against runs: in which sea they part."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import cases, linear_model, simulate
from seacrane.analysis import response_summed
from seacrane.analysis.rest_state import held

from .section import Section
from .sources import CRANE

Array = NDArray[np.float64]
HEIGHTS = (0.02, 0.05, 0.1, 0.2, 0.5)  # Hs, m
COMPONENTS, T_END, DT_OUT = 60, 60.0, 0.5


def linear_against_runs() -> Iterator[list[Any]]:
    """Standard deviation of the difference between a run and the summed response, by wave height."""
    yield from ([f"{hs:g}", *_differences(hs)] for hs in HEIGHTS)


def _differences(hs: float) -> list[float]:
    linear = linear_model(cases.case2(hs=hs, count=COMPONENTS))
    scene = held(linear.scene)
    scene.waves = linear.scene.waves
    vessel, payload = (response_summed(linear, body=body) for body in ("vessel", "payload"))
    run = simulate(
        scene, t_end=T_END, dt_out=DT_OUT, rtol=1e-9, start=linear.full_state(vessel.state_at(0.0)),
        channels=["vessel_motion", "position"],
    )  # fmt: skip
    position = run["position"][:, list(scene.bodies).index("payload")]
    pairs = ((run["vessel_motion"], vessel.at(run.time)), (position, payload.at(run.time)[:, :3]))
    return [100.0 * float(share) for pair in pairs for share in _relative(*pair)]


def _relative(found: Array, expected: Array) -> Array:
    return np.asarray(np.std(found - expected, axis=0) / np.std(expected, axis=0))


SECTION = Section(
    title="Linear model against runs",
    text=(
        f"Case 2 with its references held, {COMPONENTS} wave components, {T_END:g} s from the steady "
        "response: standard deviation of the difference between run and linear model, in per cent of the "
        "motion's."
    ),
    head=["Hs, m", "surge", "sway", "heave", "roll", "pitch", "yaw", "payload x", "payload y", "payload z"],
    rows=linear_against_runs,
    sources=(*CRANE, "python/seacrane/analysis"),
)
