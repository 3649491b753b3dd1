"""Hulls: hydrostatics and strip theory."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from test_hull_hydrostatics import SHIP, from_mesh, values, wigley_mesh, wigley_offsets, wigley_values
from test_strip_sections import CIRCLE, DEEP, FULL, multipole_error

from seacrane.hydro import Hull

from .row import Row

SUBJECT = "Hydrodynamics"
SECTIONS = {"semicircle": CIRCLE, "full Lewis form": FULL, "deep Lewis form": DEEP}


def hydrostatics() -> Iterator[Row]:
    """A hull whose integrals are known."""
    exact = wigley_values()
    hulls = {
        "offsets": Hull.from_offsets(wigley_offsets(*SHIP, 24)),
        "a mesh": from_mesh(wigley_mesh(*SHIP, 24)),
    }
    for source, hull in hulls.items():
        worst = float(np.abs(values(hull.hydrostatics) / exact - 1.0).max())
        yield Row(
            subject=SUBJECT, compared=f"hydrostatics of a Wigley hull from {source}, 24 stations",
            reference="closed forms", difference=worst, unit="", limit=6e-3,
            test="hydro/test_hull_hydrostatics.py",
        )  # fmt: skip


def sections() -> Iterator[Row]:
    """Added mass and damping of sections, share of the peak over frequency."""
    for name, section in SECTIONS.items():
        yield Row(
            subject=SUBJECT, compared=f"strip theory: added mass and damping of a {name}",
            reference="multipoles (Ursell, Tasai)", difference=multipole_error(section), unit="", limit=0.01,
            test="hydro/test_strip_sections.py",
        )  # fmt: skip
