"""Bricard's loop of six perpendicular hinges along a cube's edges: mobile, though rows count otherwise.

Data: IFToMM Library of Computational Benchmark Problems, A04 (Gonzalez et al., Multibody System Dynamics 16,
2006): rods of 1 m, 1 kg and a section of 0.1 m x 0.1 m, let go from the cube. Its orientation to the weight
is ours: the first edge is held, weight acts along -z.

By symmetry odd hinges turn to theta, even ones to phi, with (1 + cos theta)(1 + cos phi) = 1 (both 90 deg in
the cube). x = tan(theta / 2) and y = tan(phi / 2) then lie on (1 + x^2)(1 + y^2) = 4, a closed curve around
the origin, of which the polar angle is a coordinate without singular positions.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from reference.jets import Jet
from reference.mechanisms import JetVector, Moving, SingleCoordinate, add, fixed, inner, scale

from seacrane import Scene
from seacrane.arrays import Array

GRAVITY = 9.81
VERTICES = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [1, 1, 1], [0, 1, 1], [0, 0, 1]], dtype=float)
AXES = np.array([[0, 1, 0], [0, 0, 1], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 0, 0]], dtype=float)
CUBE = 0.25 * np.pi  # polar angle of the cube
# How a hinge's turning (of the later rod over the earlier one) goes with theta or phi.
SIGNS = (-1.0, 1.0, 1.0, -1.0, 1.0, 1.0)


def inertia(i: int) -> Array:
    """About its middle of the rod from vertex i on, axes of the cube."""
    along = np.abs(VERTICES[(i + 1) % 6] - VERTICES[i])
    return np.diag(along * 0.1**2 / 6.0 + (1.0 - along) * (1.0 + 0.1**2) / 12.0)


def scene(*, last: str = "revolute") -> Scene:
    """Rods 1 to 5; the edge from vertex 0 to 1 is the ground's. `last` is the kind of hinge 0."""
    out = Scene(name="bricard", gravity=GRAVITY)
    bodies = ["ground"]
    for i in range(1, 6):
        middle = 0.5 * (VERTICES[i] + VERTICES[(i + 1) % 6])
        out.add_body(name=f"rod {i}", mass=1.0, inertia=inertia(i), position=middle)
        bodies.append(f"rod {i}")
    for i in range(6):
        ends = {"first": bodies[i - 1], "second": bodies[i], "point": VERTICES[i], "axis": AXES[i]}
        out.add_joint(kind=last if i == 0 else "revolute", name=f"hinge {i}", **ends)
    return out


def turn(axis: Array, cosine: Jet, sine: Jet) -> list[JetVector]:
    """Rows of the rotation about a coordinate axis."""
    k = int(np.argmax(np.abs(axis)))
    i, j = (k + 1) % 3, (k + 2) % 3
    out = [[Jet(1.0 if m == n else 0.0) for n in range(3)] for m in range(3)]
    out[i][i], out[j][j] = cosine, cosine
    out[i][j], out[j][i] = -sine, sine
    return out


def product(a: list[JetVector], b: list[JetVector]) -> list[JetVector]:
    columns = [list(column) for column in zip(*b, strict=True)]
    return [[inner(row, column) for column in columns] for row in a]


def hinges(psi: Jet) -> list[tuple[Jet, Jet]]:
    """cos and sin of what each hinge has turned since the cube."""
    c, s = psi.cos(), psi.sin()
    double = s * c * 2.0
    square = (double * double * 3.0 + 1.0).sqrt()
    radius = ((square + 1.0).reciprocal() * 6.0).sqrt()
    turned = []
    for half in (radius * c, radius * s):  # x and y
        share = (half * half + 1.0).reciprocal()
        turned.append(((1.0 - half * half) * share, half * share * 2.0))
    out = []
    for i, sign in enumerate(SIGNS):
        cosine, sine = turned[(i + 1) % 2]
        out.append((sine, cosine * -sign))
    return out


def chain(psi: Jet) -> tuple[list[list[JetVector]], list[JetVector]]:
    """Rotations of rods 1 to 5 (rows) and the places of vertices 1 to 6, the last of which is vertex 0."""
    rotation = [fixed(row) for row in np.eye(3)]
    places, rotations = [fixed(VERTICES[1])], []
    for i in range(1, 6):
        rotation = product(rotation, turn(AXES[i], *hinges(psi)[i]))
        edge = fixed(VERTICES[(i + 1) % 6] - VERTICES[i])
        places.append(add(places[-1], [inner(row, edge) for row in rotation]))
        rotations.append(rotation)
    return rotations, places


def mechanism() -> SingleCoordinate:
    def kinematics(psi: Jet) -> list[Moving]:
        rotations, places = chain(psi)
        middles = [scale(add(a, b), 0.5) for a, b in pairwise(places)]
        axes = [[list(column) for column in zip(*rotation, strict=True)] for rotation in rotations]
        return [Moving(1.0, inertia(i), middles[i - 1], axes[i - 1]) for i in range(1, 6)]

    return SingleCoordinate(kinematics, np.array([0.0, 0.0, -GRAVITY]))
