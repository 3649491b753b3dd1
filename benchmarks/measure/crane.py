"""Reach, lever arms and static cylinder forces of the shipped crane."""

from __future__ import annotations

import numpy as np

from seacrane.crane import KnuckleBoomCrane

from .section import Section

STROKES = ((0.0, 0.0), (2.0, 2.0), (4.0, 4.0), (0.0, 5.0), (5.0, 0.0))  # m
PAYLOAD = 10e3  # kg


def shipped_crane() -> Section:
    """A row for each pair of strokes."""
    crane = KnuckleBoomCrane.load()
    rows = []
    for s1, s2 in STROKES:
        tip = crane.geometry.points(slew=0.0, s1=s1, s2=s2)["tip"]
        arms = crane.geometry.lever_arms(s1=s1, s2=s2)
        forces = [
            force / 1e3
            for mass in (0.0, PAYLOAD)
            for force in crane.static_cylinder_forces(s1=s1, s2=s2, payload_mass=mass)
        ]
        lengths = (float(np.hypot(tip[0], tip[1])), float(tip[2]), *arms)
        rows.append([f"{s1:g}, {s2:g}", *(f"{x:.2f}" for x in lengths), *(f"{x:.0f}" for x in forces)])
    return Section(
        title="The shipped crane",
        text=(
            "Outreach and height of the tip above the deck, lever arms of the main and the knuckle cylinder, "
            f"and their static forces with an empty hook and with {PAYLOAD / 1e3:g} t, positive for a push."
        ),
        head=["strokes, m", "outreach, m", "tip, m", "main arm, m", "knuckle arm, m", "main, kN",
              "knuckle, kN", "main with load, kN", "knuckle with load, kN"],
        rows=rows,
    )  # fmt: skip
