"""Eddy damping of section models in a tank, read from figures of Ikeda (1978)."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
from measured_numbers import columns
from measured_row import Array, MeasuredRow, Source

from seacrane import SceneError
from seacrane.hydro import MainParticulars, ikeda_roll_damping, section_eddy_damping

SOURCE = Source(
    title="Eddies of sections",
    repository=(
        "martinlarsalbert/Prediction-of-roll-motion-using-fully-nonlinear-potential-flow-and-Ikedas-method"
    ),
    commit="cce8abde16a15a2ae45008e48b1bba9f4aeaaad4",
    licence="MIT; data CC BY 4.0",
    about="tank: eddy damping of ten section models, Ikeda (1978), Alexandersson (2021)",
)
RHO, G = 1000.0, 9.81
ROUND = 0.893  # area coefficient of model H, a nearly round section that makes hardly any eddies


def rows(folder: Path) -> Iterator[MeasuredRow]:
    tank = columns(folder / "sections.csv")
    measured, ours = tank["B_E0_HAT"], eddies(tank)
    row, round_one = np.arange(1.0, measured.size + 1.0), tank["sigma"] == ROUND
    for kept, words, expected in ((~round_one, "nine models", 0.4), (round_one, "model H", None)):
        yield MeasuredRow(
            picture="measured_ikeda", panel="eddy damping of sections", compared=f"eddies, {words}",
            by="section_eddy_damping", x="row of the set", y="B$_E$ / (rho V B$^2$) sqrt(B / 2 g)",
            at=row[kept], measured=measured[kept], ours=ours[kept], of="value", points=(row, measured),
            line=(row, ours), repeats=scatter(tank), expected=expected, joined=False, logarithmic=True,
        )  # fmt: skip


def eddies(tank: dict[str, Array]) -> Array:
    """Of every row, as the set counts them."""
    names = ("beam", "T", "sigma", "phi_a", "omega_hat", "OG/d", "R", "L_pp", "Disp")
    found = []
    for b, d, area, swing, frequency, depth, radius, length, volume in zip(
        *(tank[name] for name in names), strict=True
    ):
        unit = np.sqrt(b / (2.0 * G))
        per_metre = section_eddy_damping(
            breadth=b, draught=d, area_coefficient=area, amplitude_deg=float(np.degrees(swing)),
            omega=frequency / unit, axis_height=-depth * d, rho=RHO,
            bilge_radius=None if np.isnan(radius) else radius,
        )  # fmt: skip
        found.append(per_metre * length / (RHO * volume * b**2) * unit)
    return np.array(found)


def scatter(tank: dict[str, Array]) -> float:
    """How far two rows of one model are from their mean, which theory has for both: the largest."""
    pairs = [tank["C_r"][tank["sigma"] == one] for one in np.unique(tank["sigma"])]
    return max(float(np.ptp(pair) / pair.sum()) for pair in pairs if pair.size == 2)


def refusals(tank: dict[str, Array]) -> list[str]:
    """What the formulas for whole ships say to each section, as if a ship had it from end to end."""
    told = []
    for k in range(tank["beam"].size):
        ship = MainParticulars(
            length=float(tank["L_pp"][k]), breadth=float(tank["beam"][k]), draught=float(tank["T"][k]),
            block_coefficient=float(tank["sigma"][k]), midship_coefficient=float(tank["sigma"][k]),
        )  # fmt: skip
        omega = float(tank["omega_hat"][k] / np.sqrt(tank["beam"][k] / (2.0 * G)))
        try:
            ikeda_roll_damping(ship, amplitude_deg=float(np.degrees(tank["phi_a"][k])), omega=omega)
        except SceneError as error:
            told.append(str(error))
    return told
