"""The paper's form of the vessel's equations against the default: motions and forces of the cases."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import Result, cases, simulate

from .section import Section
from .sources import CRANE

Array = NDArray[np.float64]
SCENES = {"vessel alone": cases.vessel, "case 1": cases.case1, "case 2": cases.case2, "case 3": cases.case3}
T_END = 100.0  # s
FORCES = ("cylinder_force", "slew_torque", "link_tension")
UNIT = np.array([1.0, 1.0, 1.0, *3 * (np.degrees(1.0),)])  # m and deg


def paper_form() -> Iterator[list[Any]]:
    """Largest and root mean square differences of the vessel's motions, and largest ones of the forces."""
    for name, case in SCENES.items():
        ours, paper = (
            simulate(case(**form), t_end=T_END, dt_out=0.5, rtol=1e-8)
            for form in ({}, {"kinematics": "paper"})
        )
        difference = paper["vessel_motion"] - ours["vessel_motion"]
        forces = list(_forces(ours, paper)) if name != "vessel alone" else [""] * 4
        yield [name, "largest", *_texts(np.abs(difference).max(axis=0) * UNIT), *forces]
        yield [name, "rms over rms", *_texts(_rms(difference) / _rms(ours["vessel_motion"])), *[""] * 4]


def _texts(values: Array) -> list[str]:
    return [f"{value:.2g}" for value in values]


def _rms(values: Array) -> Array:
    return np.asarray(np.sqrt(np.mean(np.square(values), axis=0)))


def _forces(ours: Result, paper: Result) -> Iterator[Any]:
    for name in FORCES:
        if name not in ours:
            yield ""
            continue
        one, other = (np.reshape(result[name], (result.time.size, -1)) for result in (ours, paper))
        for k in range(one.shape[1]):
            difference, size = np.abs(other[:, k] - one[:, k]).max(), np.abs(one[:, k]).max()
            yield f"{float(f'{difference / 1e3:.2g}'):g} ({size / 1e3:.0f})"


SECTION = Section(
    title="The paper's form",
    text=(
        f"The paper's form of the vessel's equations against the default: {T_END:g} s in the paper's sea, "
        "the same waves, rtol 1e-8. Largest differences of the motions in m and deg, and of the forces in "
        "kN and kN m with the largest value in brackets; then root mean squares over those of the motion."
    ),
    head=["scene", "difference", "surge", "sway", "heave", "roll", "pitch", "yaw", "main cylinder",
          "knuckle cylinder", "slew torque", "link"],
    rows=paper_form,
    sources=CRANE,
)  # fmt: skip
