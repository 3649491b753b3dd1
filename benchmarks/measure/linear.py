"""The linear model of a scene: its natural periods, how far it holds, and what it costs."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from seacrane import cases, equilibrium, linear_model, motion_rao, natural_modes, simulate
from seacrane.analysis import NaturalModes, response_summed
from seacrane.analysis.rest_state import held

from .section import Section
from .timing import best_seconds, timed_run

Array = NDArray[np.float64]
MODES = {
    "surge (mooring)": "vessel surge",
    "sway (mooring)": "vessel sway",
    "yaw (mooring)": "vessel yaw",
    "roll": "vessel roll",
    "heave": "vessel heave",
    "pitch": "vessel pitch",
    "payload swings fore and aft": "payload surge",
    "payload swings athwart": "payload sway",
    "payload pitches on its link": "payload pitch",
    "payload rolls on its link": "payload roll",
}
SWUNG_OUT = 50.0  # s: the references are at rest from 45 s on
HEIGHTS = (0.02, 0.05, 0.1, 0.2, 0.5)  # Hs, m
COMPONENTS, T_END, DT_OUT = 60, 60.0, 0.5


def natural_periods() -> Section:
    """Periods and damping of the vessel alone, and of case 2 before and after the swing-out."""
    case2 = cases.case2(hs=0.0)
    found = [
        natural_modes(cases.vessel(hs=0.0)),
        natural_modes(linear_model(case2)),
        natural_modes(linear_model(case2, state=equilibrium(case2, time=SWUNG_OUT))),
    ]
    rows = [
        [name, *(value for modes in found for value in _mode(modes, label))] for name, label in MODES.items()
    ]
    crane = [_modes_of(modes, "knuckle_jib") for modes in found]
    for k, name in enumerate(("crane, softest", "crane, next")):
        rows.append([name, *(value for modes in crane for value in (modes[k] if modes else (None, None)))])
    return Section(
        title="Natural periods",
        text=(
            "The vessel alone, and case 2 at its start and at rest after the swing-out: periods 2 pi / "
            "|eigenvalue| in s, damping in per cent of critical."
        ),
        head=[
            "mode",
            "vessel: period",
            "damping",
            "start: period",
            "damping",
            "swung out: period",
            "damping",
        ],
        rows=rows,
    )


def _mode(modes: NaturalModes, label: str) -> tuple[float | None, float | None]:
    """Period and damping of the mode that lives least in the memory; None where there is none."""
    of_label = [i for i in range(len(modes.eigenvalues)) if modes.label(i) == label]
    if not of_label:
        return None, None
    i = max(of_label, key=lambda i: modes.mechanical_share[i])
    return float(modes.natural_period[i]), 100.0 * float(modes.damping_ratio[i])


def _modes_of(modes: NaturalModes, body: str) -> list[tuple[float, float]]:
    """Of one body, slowest first."""
    found = [
        (float(modes.natural_period[i]), 100.0 * float(modes.damping_ratio[i]))
        for i in range(len(modes.eigenvalues))
        if modes.label(i).startswith(body) and modes.mechanical_share[i] > 0.9
    ]
    return sorted(found, reverse=True)


def linear_against_runs(heights: tuple[float, ...] = HEIGHTS) -> Section:
    """Standard deviation of the difference between a run and the summed response, by wave height."""
    rows = [[f"{hs:g}", *_differences(hs)] for hs in heights]
    return Section(
        title="Linear model against runs",
        text=(
            f"Case 2 with its references held, {COMPONENTS} wave components, {T_END:g} s from the steady "
            "response: standard deviation of the difference between run and linear model, in per cent of the "
            "motion's."
        ),
        head=[
            "Hs, m",
            *("surge", "sway", "heave", "roll", "pitch", "yaw"),
            "payload x",
            "payload y",
            "payload z",
        ],
        rows=rows,
    )


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


def cost(*, repeats: int) -> Section:
    """CPU time of a linear model and of what is read from it, beside that of a run."""
    omega = np.linspace(0.3, 2.5, 1000)
    rows = []
    for name, scene, body in (("vessel", cases.vessel(), "vessel"), ("case2", cases.case2(), "payload")):
        linear = linear_model(scene)
        calls: list[Callable[[], object]] = [
            lambda scene=scene: linear_model(scene),
            lambda linear=linear: natural_modes(linear),
            lambda linear=linear, body=body: motion_rao(linear, omega=omega, direction=np.pi, body=body),
        ]
        times = [1e3 * best_seconds(call, repeats=repeats) for call in calls]
        run = timed_run(scene, repeats=repeats, t_end=100.0)
        rows.append([name, int(linear.a.shape[0]), *times, 1e3 * run.cpu])
    return Section(
        title="Linear models",
        text=(
            "CPU time in ms of the linear model about the state of rest, its modes, and the RAO of a body at "
            f"{omega.size} frequencies, beside that of a run of 100 s. Best of {repeats}."
        ),
        head=["scene", "states", "linear model", "modes", "RAO", "run of 100 s"],
        rows=rows,
    )
