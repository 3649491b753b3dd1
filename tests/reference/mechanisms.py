"""Mechanisms with one degree of freedom in one coordinate, and the 3D slider-crank.

With generalised inertia m(q) = sum m p'.p' + w'.J w' (' by q) the motion obeys m q'' + 1/2 dm/dq qdot^2 =
Q - dV/dq.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from .classic import Link, integrate
from .jets import Jet
from .rotation import Array

JetVector = list[Jet]


@dataclass(frozen=True)
class Moving:
    """One body along q: centre of mass p, and rotation by the body's axes."""

    mass: float
    inertia: Array
    p: JetVector
    axes: list[JetVector]

    def terms(self) -> tuple[float, float, Array, Array, Array]:
        """(m(q), 1/2 dm/dq, p, p', w) with the inertia given in body axes."""
        p, p1, p2 = (np.array([getattr(c, k) for c in self.p]) for k in ("f", "d", "dd"))
        r, r1, r2 = (np.array([[getattr(c, k) for c in a] for a in self.axes]).T for k in ("f", "d", "dd"))
        spin, spin_rate = r.T @ r1, r1.T @ r1 + r.T @ r2  # S(w) in body axes and its derivative by q
        w = np.array([spin[2, 1], spin[0, 2], spin[1, 0]])
        antisymmetric = 0.5 * (spin_rate - spin_rate.T)
        w1 = np.array([antisymmetric[2, 1], antisymmetric[0, 2], antisymmetric[1, 0]])
        momentum = self.inertia @ w
        return (
            float(self.mass * p1 @ p1 + w @ momentum), float(self.mass * p1 @ p2 + w1 @ momentum), p, p1,
            r @ w
        )  # fmt: skip


@dataclass(frozen=True)
class SingleCoordinate:
    """Given by the motion of its bodies along one coordinate, under gravity and a constant load on it."""

    kinematics: Callable[[Jet], list[Moving]]
    gravity: Array
    load: float = 0.0

    def simulate(self, times: ArrayLike, q: float, rate: float) -> tuple[Array, Array]:
        """Coordinate and rate (k)."""
        y = integrate(lambda _, s: [s[1], self.acceleration(s[0], s[1])], [q, rate], times)
        return y[:, 0], y[:, 1]

    def acceleration(self, q: float, rate: float) -> float:
        inertia = slope = force = 0.0
        for body in self.kinematics(Jet(q, 1.0)):
            m, half_slope, _, p1, _ = body.terms()
            inertia, slope = inertia + m, slope + half_slope
            force += body.mass * float(self.gravity @ p1)
        return (self.load + force - slope * rate * rate) / inertia

    def poses(self, q: ArrayLike) -> tuple[Array, Array]:
        """Centres of mass (k, bodies, 3) and rotation matrices (k, bodies, 3, 3)."""
        states = [self.kinematics(Jet(float(value), 1.0)) for value in np.asarray(q, dtype=float)]
        positions = [[[c.f for c in body.p] for body in state] for state in states]
        rotations = [[[[c.f for c in a] for a in body.axes] for body in state] for state in states]
        return np.array(positions), np.array(rotations).transpose(0, 1, 3, 2)


def add(a: JetVector, b: JetVector) -> JetVector:
    return [x + y for x, y in zip(a, b, strict=True)]


def scale(a: JetVector, factor: Jet | float) -> JetVector:
    return [x * factor for x in a]


def inner(a: JetVector, b: JetVector) -> Jet:
    return sum((x * y for x, y in zip(a, b, strict=True)), Jet(0.0))


def outer_product(a: JetVector, b: JetVector) -> JetVector:
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def fixed(values: Sequence[float] | Array) -> JetVector:
    return [Jet(float(v)) for v in values]


@dataclass(frozen=True)
class SliderCrank:
    """Crank on the x axis, rod on a spherical joint, universal joint on a slider along x.

    The crank pin is at (0, a cos q, a sin q) + pivot; the slider's point at (s, 0, 0). The rod's body axes:
    its direction e from pin to slider, n = (y axis x e)/|.|, e x n. The universal joint's axes are the y axis
    (on the slider) and n (on the rod). Rod centre of mass: midpoint.
    """

    crank: Link
    pivot: tuple[float, float, float]
    rod_mass: float
    rod_length: float
    rod_inertia: tuple[float, float, float]
    slider_mass: float

    def kinematics(self, q: Jet) -> list[Moving]:
        """Crank, rod, slider; the crank's body axes are x, then along the crank, then their product."""
        c, s, zero = q.cos(), q.sin(), Jet(0.0)
        along = [zero, c, s]
        pivot = fixed(self.pivot)
        pin = add(pivot, scale(along, self.crank.length))
        reach = self.rod_length**2 - pin[1] * pin[1] - pin[2] * pin[2]
        end = [pin[0] + reach.sqrt(), zero, zero]
        e = scale(add(end, scale(pin, -1.0)), 1.0 / self.rod_length)
        n = outer_product(fixed([0.0, 1.0, 0.0]), e)
        n = scale(n, inner(n, n).sqrt().reciprocal())
        crank_axes = [fixed([1.0, 0.0, 0.0]), along, [zero, -s, c]]
        return [
            Moving(self.crank.mass, np.diag([self.crank.inertia] * 3),
                   add(pivot, scale(along, self.crank.center)), crank_axes),
            Moving(self.rod_mass, np.diag(self.rod_inertia), scale(add(pin, end), 0.5),
                   [e, n, outer_product(e, n)]),
            Moving(self.slider_mass, np.eye(3), end, [fixed(row) for row in np.eye(3)]),
        ]  # fmt: skip

    def mechanism(self, gravity: Sequence[float] = (0.0, 0.0, -9.81), load: float = 0.0) -> SingleCoordinate:
        return SingleCoordinate(self.kinematics, np.asarray(gravity, dtype=float), load)
