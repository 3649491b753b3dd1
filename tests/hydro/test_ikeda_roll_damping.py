"""Ikeda's roll damping of ships and eddies of one section: limits, published numbers, decays of a roll."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from seacrane import Scene, SceneError, simulate
from seacrane.arrays import Array
from seacrane.hydro import (
    MainParticulars,
    ikeda_roll_damping,
    natural_frequency,
    section_eddy_damping,
    shipped_database,
)  # fmt: skip
from seacrane.hydro.hull.hull import shipped_hull
from seacrane.hydro.hull.ikeda import bilge_keels, eddy, eddy_coefficient, friction, friction_at_speed, lift

SHIP = MainParticulars(
    length=300.0, breadth=50.0, draught=12.5, block_coefficient=0.65, midship_coefficient=0.98
)
CALL: dict[str, Any] = {
    "amplitude_deg": 10.0, "omega": 0.6 / np.sqrt(50.0 / 2.0 / 9.81), "axis_height": 2.5,
    "bilge_keel_length": 60.0, "bilge_keel_breadth": 1.25,
}  # fmt: skip
OF_AUTHORS = 0.010156148773301035 - 0.0034935358308644145 - 1.4879808625735649e-5
S175: dict[str, float] = {
    "length": 175.0, "draught": 9.5, "speed": 1.0, "og": -0.02,
    "slope": 2.0 * np.pi * 9.5 / 175.0 + 0.1 * (4.1 * 25.4 / 175.0 - 0.045),
}  # fmt: skip
LIFT_OF_S175 = 4595742.29
UNIT = 1025.0 * 0.65 * 300.0 * 50.0**3 * 12.5 * np.sqrt(2.0 * 9.81 / 50.0)  # rho V B^2 sqrt(2 g / B)


def test_friction_is_that_of_an_oscillating_plate_and_of_himeno() -> None:
    """Stokes: rho S sqrt(w nu / 2) per rate, at the radius squared. Kato's fit is 11 % above it."""
    values: dict[str, float] = {"radius": 2.0, "surface": 100.0, "omega": 0.5, "rho": 1025.0}
    found = friction(**values, amplitude=1e-6, viscosity=1.19e-6)
    plate = 1025.0 * 100.0 * np.sqrt(0.5 * 1.19e-6 / 2.0) * 2.0**2
    assert found / plate == pytest.approx(0.787 * np.sqrt(2.0), rel=2e-3)
    assert friction(**PLATE) == pytest.approx(himeno(**PLATE), rel=2e-3)  # rounded, the same


PLATE: dict[str, float] = {
    "radius": 9.0, "surface": 9000.0, "amplitude": 0.2, "omega": 0.4, "rho": 1025.0, "viscosity": 1.19e-6,
}  # fmt: skip


def himeno(
    *, radius: float, surface: float, amplitude: float, omega: float, rho: float, viscosity: float
) -> float:
    """Friction, N m s/rad: 0.787 rho S r^2 sqrt(w nu) (1 + 0.00814 (r^2 phi^2 w / nu)^0.386)."""
    turbulent = 1.0 + 0.00814 * (radius**2 * amplitude**2 * omega / viscosity) ** 0.386
    return float(0.787 * rho * surface * radius**2 * np.sqrt(omega * viscosity) * turbulent)


def test_other_programs_have_these_numbers() -> None:
    """Total of Kawahara, Maekawa and Ikeda's program, less its waves and its friction, which is laminar.

    S175 of another program, which takes kappa = 0.1 in steps after Himeno: 1 m/s, period 20 s.
    """
    found = ikeda_roll_damping(SHIP, **CALL)
    assert (found.eddy + found.bilge_keels) / UNIT == pytest.approx(OF_AUTHORS, rel=1e-10)
    assert lift(**S175, rho=1025.0) == pytest.approx(LIFT_OF_S175, rel=1e-6)
    assert friction_at_speed(1.0, 2.0 * np.pi / 20.0, 175.0) == pytest.approx(753901.66 / 701580.94, rel=1e-7)
    values: dict[str, float] = {"cb": 0.6, "cm": 0.95, "bd": 3.0, "og": -0.5, "frequency": 0.5}
    assert eddy(**values, amplitude=0.2) == pytest.approx(2.0 * eddy(**values, amplitude=0.1))


def direct_bilge_keels(
    *, cm: float, bd: float, og: float, breadth: float, amplitude: float, frequency: float, radius: float
) -> float:
    """Ikeda's own equations per share of the length, by draught; hull pressure included (Himeno 1981).

    Without dimensions as in the simple formulas, for Cb = Cm, a hull of one section.
    """
    half, keel = 0.5 * bd, breadth * bd  # by draught
    corner = (1.0 - np.sqrt(0.5)) * radius
    arm = np.hypot(half - corner, 1.0 - og - corner)
    f = 1.0 + 0.3 * np.exp(-160.0 * (1.0 - cm))
    swing = np.pi * arm * amplitude * f
    drag = 22.5 * keel / swing + 2.4
    normal = 8.0 / (3.0 * np.pi) * arm**3 * amplitude * keel * f**2 * drag
    reach = 0.3 * np.pi * f * arm * amplitude + 1.95 * keel
    m1, m2 = radius, og
    m3, m4 = 1.0 - m1 - m2, half - m1
    below = (half - 0.215 * m1) * (1.0 - 0.215 * m1)
    m5 = (0.414 * half + 0.0651 * m1**2 - (0.382 * half + 0.0106) * m1) / below
    m6 = (0.414 * half + 0.0651 * m1**2 - (0.382 + 0.0106 * half) * m1) / below
    m7 = max(reach - 0.25 * np.pi * m1, 0.0)
    m8 = m7 + 0.414 * m1 if m7 > 0.0 else m7 + 1.414 * (1.0 - np.cos(reach / m1)) * m1
    a0 = (m3 + m4) * m8 - m7**2
    b0 = m2**2 / (3.0 * (half - 0.215 * m1)) + (1.0 - m1) ** 2 * (2.0 * m3 - m2) / (6.0 * (1.0 - 0.215 * m1))
    b0 += m1 * (m3 * m5 + m4 * m6)
    pressure = a0 * (22.5 * keel / swing + 1.2) + b0 * 1.2
    on_hull = 4.0 / (3.0 * np.pi) * arm**2 * amplitude * f**2 * pressure
    return float((normal + on_hull) * frequency / (cm * bd**3))


def both_bilge_keels(breadth: float, degrees: float) -> tuple[float, float]:
    swing: dict[str, float] = {"amplitude": float(np.radians(degrees)), "frequency": 0.5}
    cb, cm, bd, og = 0.8, 0.98, 3.0, -0.2
    radius = np.sqrt((1.0 - cm) * bd / (1.0 - 0.25 * np.pi) / 2.0)
    simple = bilge_keels(cb=cb, cm=cm, bd=bd, og=og, breadth=breadth, length=0.3, **swing)
    direct = 0.3 * direct_bilge_keels(cm=cm, bd=bd, og=og, breadth=breadth, radius=radius, **swing) * cm / cb
    return simple, direct


def test_the_simple_bilge_keels_follow_ikedas_own() -> None:
    """Of one section all along, Cb = Cm is outside the fit; a full ship at its end is within 30 %."""
    for breadth in (0.02, 0.03):
        for degrees in (5.0, 10.0, 15.0):
            simple, direct = both_bilge_keels(breadth, degrees)
            assert simple == pytest.approx(direct, rel=0.3)


def test_without_bilge_keels_at_speed_and_the_pair_that_does_the_work() -> None:
    bare = CALL | {"bilge_keel_length": 0.0, "bilge_keel_breadth": 0.0}
    still, without = ikeda_roll_damping(SHIP, **CALL), ikeda_roll_damping(SHIP, **bare)
    assert without.bilge_keels == 0.0 and without.lift == 0.0
    assert (without.friction, without.eddy) == (still.friction, still.eddy)
    slow, fast = (ikeda_roll_damping(SHIP, speed=speed, **CALL) for speed in (1.0, 10.0))
    assert fast.eddy < slow.eddy < still.eddy  # carried away
    assert fast.lift == pytest.approx(10.0 * slow.lift)
    assert fast.friction > slow.friction > still.friction
    for share in (1.0, 0.5):
        method = ikeda_roll_damping(SHIP, **(CALL | {"amplitude_deg": share * 10.0})).total
        rate = share * np.radians(10.0) * CALL["omega"]
        assert still.linear + 8.0 / (3.0 * np.pi) * rate * still.quadratic == pytest.approx(method)
    hull = shipped_hull()
    found = MainParticulars.of(hull)
    assert found.block_coefficient == pytest.approx(hull.hydrostatics.volume / (115.0 * 25.0 * 6.4), rel=1e-3)
    assert found.block_coefficient < found.midship_coefficient <= 1.0
    assert (found.length, found.breadth, found.draught) == pytest.approx((115.0, 25.0, 6.4), rel=1e-3)


def test_outside_the_method_it_is_refused() -> None:
    for ship, call, words in (
        ({"midship_coefficient": 0.88}, {}, "midship_coef"), ({}, {"axis_height": 20.0}, "draught is -1.6"),
        ({}, {"omega": 0.7}, "omega sqrt"), ({}, {"bilge_keel_breadth": 4.0}, "breadth is 0.08"),
    ):  # fmt: skip
        with pytest.raises(SceneError, match=words):
            ikeda_roll_damping(replace(SHIP, **ship), **(CALL | call))


def rolling(linear: float, quadratic: float) -> tuple[Array, Array, float, float]:
    """Time, roll (rad) of a free decay from 8 deg, inertia and stiffness; a body that can only roll."""
    inertia, stiffness, half = 4e9, 1e9, 0.5 * np.radians(8.0)
    scene = Scene(name="decay", gravity=0.0)
    turned = (float(np.cos(half)), float(np.sin(half)), 0.0, 0.0)
    scene.add_body(name="hull", mass=1e7, inertia=[inertia, 1e10, 1e10], quaternion=turned)
    restoring, damping = np.zeros((2, 6, 6))
    restoring[3, 3], damping[3, 3] = stiffness, linear
    scene.add_vessel(
        body="hull", added_mass=np.zeros((6, 6)), linear_damping=damping, restoring=restoring,
        quadratic_damping=[0, 0, 0, quadratic, 0, 0],
    )  # fmt: skip
    run = simulate(scene, t_end=120.0, dt_out=0.05)
    return run.time, run["vessel_motion"][:, 3], inertia, stiffness


def crests(roll: Array) -> Array:
    size = np.abs(roll)
    at = np.flatnonzero((size[1:-1] > size[:-2]) & (size[1:-1] >= size[2:])) + 1
    before, top, after = size[at - 1], size[at], size[at + 1]
    return np.asarray(top + (after - before) ** 2 / (8.0 * (2.0 * top - before - after)))


def decrements(damping: float) -> tuple[list[float], float]:
    _, roll, inertia, stiffness = rolling(damping, 0.0)
    ratio = damping / (2.0 * np.sqrt(inertia * stiffness))
    closed = float(np.pi * ratio / np.sqrt(1.0 - ratio**2))
    return [float(np.log(one / two)) for one, two in pairwise(crests(roll))], closed


def test_free_decays_of_linear_damping_and_of_the_pair() -> None:
    """d phi / d n = -(pi / 2 w I) (b1 phi + 8 / (3 pi) w b2 phi^2) over half periods n, integrated."""
    measured, decrement = decrements(1e8)
    assert measured == pytest.approx([decrement] * len(measured), rel=2e-3)
    linear, quadratic = 3e7, 8e8
    _, roll, inertia, stiffness = rolling(linear, quadratic)
    measured, omega = crests(roll), np.sqrt(stiffness / inertia)
    b1, b2 = np.pi / (2 * omega * inertia) * np.array([linear, 8.0 / (3.0 * np.pi) * omega * quadratic])
    decay = np.exp(-b1 * np.arange(len(measured)))
    closed = b1 * measured[0] * decay / (b1 + b2 * measured[0] * (1.0 - decay))
    assert measured == pytest.approx(closed, rel=0.01)


def test_a_database_takes_the_pair_in_place_of_its_own() -> None:
    database = shipped_database()
    pair = database.with_roll_damping(linear=2e7, quadratic=3e8)
    assert pair.linear_damping[3, 3] == 2e7 and pair.quadratic_damping[3] == 3e8
    share, both = (
        database.with_roll_damping(linear=one, fraction=0.05).linear_damping[3, 3] for one in (0.0, 1e6)
    )
    assert both == pytest.approx(share + 1e6)
    critical = 2.0 * database.restoring[3, 3] / natural_frequency(database, 3)  # 2 sqrt(C (I + A)) = 2 C / w
    assert share == pytest.approx(0.05 * critical, rel=3e-3)
    scene = Scene()
    scene.add_vessel(pair, memory="none")
    assert scene.vessels["vessel"].quadratic_damping[3] == 3e8


BOX: dict[str, Any] = {
    "breadth": 0.28, "draught": 0.112, "area_coefficient": 1.0, "amplitude_deg": 10.0, "omega": 5.0,
}  # fmt: skip


def test_work_is_quadratic_and_grows_with_the_fourth_power_of_size() -> None:
    one = section_eddy_damping(**BOX)
    for changes, factor in (
        ({"amplitude_deg": 20.0}, 2.0), ({"omega": 10.0, "rho": 2050.0}, 4.0),
        ({"breadth": 0.56, "draught": 0.224}, 16.0),
    ):  # fmt: skip
        assert section_eddy_damping(**(BOX | changes)) == pytest.approx(factor * one)
    round_one = eddy_coefficient(half=1.0, area=0.25 * np.pi, depth=0.0, radius=1.0)
    assert abs(round_one) < 0.01 * eddy_coefficient(half=1.0, area=1.0, depth=0.0, radius=0.0)
    bilge = BOX | {"area_coefficient": 0.99}
    sizes = [section_eddy_damping(**(bilge | {"bilge_radius": radius})) for radius in (0.0, 0.02, 0.04)]
    assert sizes[0] > sizes[1] > sizes[2] > 0.0


def test_numbers_of_the_method() -> None:
    """By a second writing of the same equations, over full Lewis coefficients."""
    for half, area, radius, expected in (
        (1.25, 1.0, 0.0, 7.111), (1.25, 0.995, 0.02 / 0.112, 0.9410), (0.772, 0.541, 0.7720, 0.3078),
    ):  # fmt: skip
        found = eddy_coefficient(half=half, area=area, depth=0.0, radius=radius)
        assert found == pytest.approx(expected, rel=2e-3)
