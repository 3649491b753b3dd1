"""Static cylinder forces: virtual work against free-body moments about F and C, and against energy."""

from __future__ import annotations

import numpy as np
import pytest

from seacrane._core import Body
from seacrane.arrays import Array
from seacrane.crane import Payload, load_crane
from seacrane.inputs.frames import rotation_matrix

G = 9.80665
CRANE = load_crane()
POSES = [(0.0, 0.0), (2.0, 2.0), (4.0, 4.0), (0.0, 5.0), (5.0, 0.0), (1.3, 3.7)]


def flat(point: Array) -> Array:
    """(outward, up) of a point in the crane-foot frame at slew angle 0."""
    return np.array([-point[0], point[2]])


def centre(body: Body) -> Array:
    return body.position + rotation_matrix(body.quaternion) @ body.center_of_mass


def cross(a: Array, b: Array) -> float:
    return float(a[0] * b[1] - a[1] * b[0])


def cylinder(
    foot: Array, head: Array, moment: float, jib_pivot: Array, barrel: Body, rod: Body
) -> tuple[float, Array]:
    """Free bodies of one cylinder and its jib: (force between barrel and rod, force on the jib at the head).

    `moment` is that of everything else on the jib about its pivot; the head's force must balance it.
    """
    axis = (head - foot) / np.linalg.norm(head - foot)
    normal = np.array([-axis[1], axis[0]])
    # Moments of the whole cylinder about its foot give the transverse force at the head.
    own = sum(cross(flat(centre(b)) - foot, np.array([0.0, -b.mass * G])) for b in (barrel, rod))
    transverse = own / np.linalg.norm(head - foot)
    # Moments of the jib about its pivot give the axial one.
    arm = head - jib_pivot
    axial = (-moment - transverse * cross(arm, normal)) / cross(arm, axis)
    # Forces on the rod along the axis: the barrel's push, its weight, the jib's answer at the head.
    push = axial + rod.mass * G * axis[1]
    return push, axial * axis + transverse * normal


def forces_by_hand(s1: float, s2: float, payload_mass: float) -> Array:
    b = {body.name: body for body in CRANE.parts(s1=s1, s2=s2).bodies}
    p = {k: flat(v) for k, v in CRANE.points(slew=0.0, s1=s1, s2=s2).items()}

    def weight(name: str, pivot: str) -> float:
        return cross(flat(centre(b[name])) - p[pivot], np.array([0.0, -b[name].mass * G]))

    hook = np.array([0.0, -payload_mass * G])
    knuckle_moment = weight("knuckle_jib", "F") + cross(p["tip"] - p["F"], hook)
    knuckle, _ = cylinder(p["E"], p["G"], knuckle_moment, p["F"], b["knuckle_barrel"], b["knuckle_rod"])
    # The jibs, the knuckle cylinder and the hook as one free body, about C.
    carried = ("main_jib", "knuckle_barrel", "knuckle_rod", "knuckle_jib")
    main_moment = sum(weight(name, "C") for name in carried) + cross(p["tip"] - p["C"], hook)
    main, _ = cylinder(p["B"], p["D"], main_moment, p["C"], b["main_barrel"], b["main_rod"])
    return np.array([main, knuckle])


@pytest.mark.parametrize(("s1", "s2"), POSES)
@pytest.mark.parametrize("payload_mass", [0.0, 10.0e3])
def test_virtual_work_equals_moments(s1: float, s2: float, payload_mass: float) -> None:
    got = CRANE.static_cylinder_forces(s1=s1, s2=s2, payload_mass=payload_mass)
    np.testing.assert_allclose(got, forces_by_hand(s1, s2, payload_mass), rtol=1e-11)


def potential(s1: float, s2: float, payload: Payload) -> float:
    parts = CRANE.parts(slew=0.4, s1=s1, s2=s2)
    bodies = [*parts.bodies, payload.under(parts.tip[1])]
    return G * sum(body.mass * float(centre(body)[2]) for body in bodies)


@pytest.mark.parametrize(("s1", "s2"), [(1.3, 3.7), (4.5, 0.5)])
def test_virtual_work_is_the_slope_of_potential_energy(s1: float, s2: float) -> None:
    load, h = Payload(), 1e-3
    slope = [
        (potential(s1 + h, s2, load) - potential(s1 - h, s2, load)) / (2.0 * h),
        (potential(s1, s2 + h, load) - potential(s1, s2 - h, load)) / (2.0 * h),
    ]
    foot, place = (33.0, 10.0, 10.0), {"slew": -0.9, "s1": s1, "s2": s2}
    bodies = CRANE.parts(foot=foot, **place).bodies
    mean = sum(body.mass * centre(body) for body in bodies) / sum(body.mass for body in bodies)
    np.testing.assert_allclose(CRANE.center_of_mass(foot=foot, **place), mean, atol=1e-11)
    got = CRANE.static_cylinder_forces(s1=s1, s2=s2, payload_mass=load.mass)
    np.testing.assert_allclose(got, slope, rtol=2e-6)
