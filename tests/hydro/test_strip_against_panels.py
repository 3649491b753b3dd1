"""A section against a three-dimensional panel code: what a barge gains in the middle when it grows longer."""

from __future__ import annotations

import itertools
import logging
from typing import Any

import numpy as np
import pytest

from seacrane import _core

HALF, DRAUGHT, RHO, G = 12.5, 6.4, 1025.0, 9.81
OMEGA = (0.8, 1.3)
MOTIONS = ("Sway", "Heave", "Roll")


def barge(length: float) -> Any:
    """Mesh of a box barge, panels 3.2 m long and finer towards the edges of the section."""
    capytaine = pytest.importorskip("capytaine", reason="capytaine absent: pip install .[hydro]")
    z = -0.5 * DRAUGHT * (1.0 - np.cos(np.pi * np.linspace(0.0, 1.0, 6)))
    y = HALF * np.sin(0.5 * np.pi * np.linspace(-1.0, 1.0, 17))
    x = np.linspace(-0.5, 0.5, round(length / 3.2) + 1) * length
    girth = [(HALF, v) for v in z] + [(v, -DRAUGHT) for v in y[-2:0:-1]] + [(-HALF, v) for v in z[::-1]]
    panels = [
        [(a, *p), (b, *p), (b, *q), (a, *q)]
        for a, b in itertools.pairwise(x)
        for p, q in itertools.pairwise(girth)
    ]
    for end, order in ((x[0], 1), (x[-1], -1)):
        for a, b in itertools.pairwise(y):
            for c, d in itertools.pairwise(z):
                panels.append([(end, a, c), (end, a, d), (end, b, d), (end, b, c)][::-order])
    vertices = np.array(panels).reshape(-1, 3)
    mesh = capytaine.Mesh(vertices=vertices, faces=np.arange(len(vertices)).reshape(-1, 4))
    assert mesh.volume == pytest.approx(2.0 * HALF * DRAUGHT * length)  # all normals point outward
    return capytaine.FloatingBody(
        mesh=mesh,
        lid_mesh=mesh.generate_lid(faces_max_radius=2.2),
        dofs=capytaine.rigid_body_dofs(rotation_center=(0, 0, 0)),
    )


def added_mass_and_damping(length: float) -> Any:
    """Diagonal terms (omega, motion, 2) by Capytaine."""
    capytaine = pytest.importorskip("capytaine", reason="capytaine absent: pip install .[hydro]")
    body, solver = barge(length), capytaine.BEMSolver()

    def solve(omega: float, motion: str) -> tuple[float, float]:
        problem = capytaine.RadiationProblem(
            body=body, omega=omega, radiating_dof=motion, rho=RHO, g=G, water_depth=np.inf
        )
        result = solver.solve(problem)
        return result.added_masses[motion], result.radiation_dampings[motion]

    return np.array([[solve(omega, motion) for motion in MOTIONS] for omega in OMEGA])


@pytest.mark.slow("panels")
def test_longer_barge_gains_sections() -> None:
    logging.getLogger("capytaine").setLevel(logging.ERROR)
    gained = (added_mass_and_damping(288.0) - added_mass_and_damping(192.0)) / 96.0
    points = np.array([[HALF, 0.0], [HALF, -DRAUGHT], [0.0, -DRAUGHT]])
    section = _core.section_radiation(points=points, omega=OMEGA, rho=RHO, g=G, panels=120)
    for name, index, limits in (
        ("added_mass", 0, (0.02, 0.01, 0.01)),
        ("damping", 1, (0.02, 0.07, 0.07)),  # the gain in damping still feels the ends
    ):
        ratio = gained[:, :, index] / np.diagonal(section[name], axis1=1, axis2=2)
        assert (np.abs(ratio - 1.0) < limits).all(), (name, ratio)
