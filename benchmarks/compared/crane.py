"""The crane by itself: statics and masses."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from test_crane_mass_properties import integrate
from test_crane_statics import CRANE, POSES, forces_by_hand, potential

from seacrane.crane import Payload

from .row import Row

SUBJECT = "Crane by itself"


def statics() -> Iterator[Row]:
    """Cylinder forces of rest."""
    worst = 0.0
    for s1, s2 in POSES:
        found = CRANE.static_cylinder_forces(s1=s1, s2=s2, payload_mass=10e3)
        by_hand = forces_by_hand(s1, s2, 10e3)
        worst = max(worst, float(np.abs(found / by_hand - 1.0).max()))
    yield Row(
        subject=SUBJECT, compared="static cylinder forces by virtual work, six poses",
        reference="moments about C and F of free bodies", difference=worst, unit="", limit=1e-11,
        test="cranes/test_crane_statics.py",
    )  # fmt: skip
    load, h = Payload(), 1e-3
    slope = [
        (potential(2.0 + h, 2.0, load) - potential(2.0 - h, 2.0, load)) / (2.0 * h),
        (potential(2.0, 2.0 + h, load) - potential(2.0, 2.0 - h, load)) / (2.0 * h),
    ]
    found = CRANE.static_cylinder_forces(s1=2.0, s2=2.0, payload_mass=load.mass)
    yield Row(
        subject=SUBJECT, compared="static cylinder forces at strokes of 2 m",
        reference="slope of the potential energy, differences", unit="", limit=2e-6,
        difference=float(np.abs(found / np.array(slope) - 1.0).max()), test="cranes/test_crane_statics.py",
    )  # fmt: skip


def masses() -> Iterator[Row]:
    """Inertia in closed form."""
    worst = 0.0
    for body in CRANE.data.bodies:
        found = body.properties.inertia
        _, _, expected = integrate(body.members)
        worst = max(worst, float(np.abs(found - expected).max() / np.abs(expected).max()))
    yield Row(
        subject=SUBJECT, compared="inertia of the eight bodies in closed form", unit="",
        reference="numerical integration over their members", difference=worst, limit=1e-9,
        test="cranes/test_crane_mass_properties.py",
    )  # fmt: skip
