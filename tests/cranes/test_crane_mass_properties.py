"""Closed-form inertias of tubes and boxes against numerical integration over their volume."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from seacrane.arrays import Array
from seacrane.crane import Box, Tube, load_crane
from seacrane.crane.mass_properties import combine

NODES, WEIGHTS = np.polynomial.legendre.leggauss(4)  # exact for the polynomials met here


def interval(low: float, high: float) -> tuple[Array, Array]:
    return (low + high) / 2.0 + (high - low) / 2.0 * NODES, (high - low) / 2.0 * WEIGHTS


def box_section(width: float, depth: float) -> tuple[Array, Array]:
    """Points (across, normal) of a rectangle and their share of its area."""
    y, wy = interval(-width / 2.0, width / 2.0)
    n, wn = interval(-depth / 2.0, depth / 2.0)
    points = np.array([(a, b) for a in y for b in n])
    return points, np.array([a * b for a in wy for b in wn])


def section(member: Tube | Box) -> tuple[Array, Array]:
    if isinstance(member, Tube):
        r, wr = interval(member.inner_diameter / 2.0, member.outer_diameter / 2.0)
        angles = np.arange(16) * math.tau / 16.0  # the trapezium rule is exact for low harmonics
        points = np.array([(q * math.cos(a), q * math.sin(a)) for q in r for a in angles])
        return points, np.array([w * q * math.tau / 16.0 for q, w in zip(r, wr, strict=True) for _ in angles])
    points, weights = box_section(member.width, member.depth)
    if member.wall > 0.0:
        hole, taken = box_section(member.width - 2.0 * member.wall, member.depth - 2.0 * member.wall)
        points, weights = np.vstack([points, hole]), np.concatenate([weights, -taken])
    return points, weights


def cloud(member: Tube | Box) -> tuple[Array, Array]:
    """Quadrature points of a member in the plane across y, and their masses."""
    start, end = np.array(member.start), np.array(member.end)
    axis = (end - start) / np.linalg.norm(end - start)
    normal = np.array([axis[2], 0.0, -axis[0]])
    along, w_along = interval(0.0, float(np.linalg.norm(end - start)))
    flat, w_flat = section(member)
    points, masses = [], []
    for x, wx in zip(along, w_along, strict=True):
        for (across, height), wf in zip(flat, w_flat, strict=True):
            points.append(start + x * axis + height * normal + np.array([0.0, across, 0.0]))
            masses.append(wx * wf)
    weights = np.array(masses)
    return np.array(points), weights * (member.mass / weights.sum())


def integrate(members: tuple[Tube | Box, ...]) -> tuple[float, Array, Array]:
    parts = [cloud(member) for member in members]
    points, masses = np.vstack([p for p, _ in parts]), np.concatenate([m for _, m in parts])
    mass = float(masses.sum())
    centre = masses @ points / mass
    arms = points - centre
    second = np.einsum("i,ij,ik->jk", masses, arms, arms)
    return mass, centre, np.trace(second) * np.eye(3) - second


CRANE = load_crane()
SHAPES = (
    Tube(
        name="t", mass=7.0, start=(1.0, 0.0, 2.0), end=(4.0, 0.0, 3.0), outer_diameter=2.0, inner_diameter=1.2
    ),
    Box(name="b", mass=5.0, start=(-1.0, 0.0, 0.5), end=(2.0, 0.0, -3.0), width=1.5, depth=0.7, wall=0.0),
    Box(name="h", mass=4.0, start=(0.0, 0.0, 0.0), end=(6.0, 0.0, 1.0), width=1.5, depth=2.5, wall=0.2),
)


PARTS = [(combine([shape]), (shape,)) for shape in SHAPES]
PARTS += [(body.properties, body.members) for body in CRANE.data.bodies]


@pytest.mark.parametrize(("got", "members"), PARTS)
def test_shapes_and_bodies_of_the_crane_against_quadrature(got: Any, members: Any) -> None:
    mass, centre, inertia = integrate(members)
    assert got.mass == pytest.approx(mass, rel=1e-12)
    np.testing.assert_allclose(got.center_of_mass, centre, atol=1e-10)
    np.testing.assert_allclose(got.inertia, inertia, rtol=1e-10, atol=1e-9 * np.trace(inertia))
