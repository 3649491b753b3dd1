"""Ikeda's roll damping: limits, published numbers, and the decay that it makes of a roll."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from seacrane import Scene, SceneError, simulate
from seacrane.hydro import MainParticulars, ikeda_roll_damping, shipped_database
from seacrane.hydro.hull.ikeda import bilge_keels, eddy, friction, friction_at_speed, lift
from seacrane.hydro.hull.shipped_hull import shipped_hull

Array = NDArray[np.float64]
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


def test_slow_and_small_the_friction_is_that_of_an_oscillating_plate() -> None:
    """Stokes: rho S sqrt(w nu / 2) per rate, at the radius squared. Kato's fit is 11 % above it."""
    values: dict[str, float] = {"radius": 2.0, "surface": 100.0, "omega": 0.5, "rho": 1025.0}
    found = friction(**values, amplitude=1e-6, viscosity=1.19e-6)
    plate = 1025.0 * 100.0 * np.sqrt(0.5 * 1.19e-6 / 2.0) * 2.0**2
    assert found / plate == pytest.approx(0.787 * np.sqrt(2.0), rel=2e-3)


PLATE: dict[str, float] = {
    "radius": 9.0, "surface": 9000.0, "amplitude": 0.2, "omega": 0.4, "rho": 1025.0, "viscosity": 1.19e-6,
}  # fmt: skip


def himeno(
    *, radius: float, surface: float, amplitude: float, omega: float, rho: float, viscosity: float
) -> float:
    """Friction, N m s/rad."""
    turbulent = 1.0 + 0.00814 * (radius**2 * amplitude**2 * omega / viscosity) ** 0.386
    return float(0.787 * rho * surface * radius**2 * np.sqrt(omega * viscosity) * turbulent)


def test_friction_in_the_form_of_himeno() -> None:
    """0.787 rho S r^2 sqrt(w nu) (1 + 0.00814 (r^2 phi^2 w / nu)^0.386): rounded, the same."""
    assert friction(**PLATE) == pytest.approx(himeno(**PLATE), rel=2e-3)


def test_the_authors_program_has_this_sum() -> None:
    """Total of Kawahara, Maekawa and Ikeda's program, less its waves and its friction, which is laminar."""
    found = ikeda_roll_damping(SHIP, **CALL)
    assert (found.eddy + found.bilge_keels) / UNIT == pytest.approx(OF_AUTHORS, rel=1e-10)


def test_lift_and_friction_of_a_container_ship_at_speed() -> None:
    """S175 of another program, which takes kappa = 0.1 in steps after Himeno: 1 m/s, period 20 s."""
    assert lift(**S175, rho=1025.0) == pytest.approx(LIFT_OF_S175, rel=1e-6)
    assert friction_at_speed(1.0, 2.0 * np.pi / 20.0, 175.0) == pytest.approx(753901.66 / 701580.94, rel=1e-7)


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
    """Of one section all along: by the simple formulas and by Ikeda's own equations."""
    swing: dict[str, float] = {"amplitude": float(np.radians(degrees)), "frequency": 0.5}
    cb, cm, bd, og = 0.8, 0.98, 3.0, -0.2
    radius = np.sqrt((1.0 - cm) * bd / (1.0 - 0.25 * np.pi) / 2.0)
    simple = bilge_keels(cb=cb, cm=cm, bd=bd, og=og, breadth=breadth, length=0.3, **swing)
    direct = 0.3 * direct_bilge_keels(cm=cm, bd=bd, og=og, breadth=breadth, radius=radius, **swing) * cm / cb
    return simple, direct


@pytest.mark.parametrize("breadth", [0.02, 0.03])
@pytest.mark.parametrize("degrees", [5.0, 10.0, 15.0])
def test_the_simple_bilge_keels_follow_ikedas_own(breadth: float, degrees: float) -> None:
    """Of one section all along, Cb = Cm is outside the fit; a full ship at its end is within 30 %."""
    simple, direct = both_bilge_keels(breadth, degrees)
    assert simple == pytest.approx(direct, rel=0.3)


def test_without_bilge_keels_there_is_none_of_them() -> None:
    bare = CALL | {"bilge_keel_length": 0.0, "bilge_keel_breadth": 0.0}
    with_keels, without = ikeda_roll_damping(SHIP, **CALL), ikeda_roll_damping(SHIP, **bare)
    assert without.bilge_keels == 0.0 and without.lift == 0.0
    assert (without.friction, without.eddy) == (with_keels.friction, with_keels.eddy)
    assert without.total < with_keels.total


def test_speed_carries_eddies_away_and_brings_lift() -> None:
    slow, fast = (ikeda_roll_damping(SHIP, speed=speed, **CALL) for speed in (1.0, 10.0))
    still = ikeda_roll_damping(SHIP, **CALL)
    assert fast.eddy < slow.eddy < still.eddy
    assert fast.lift == pytest.approx(10.0 * slow.lift)
    assert fast.friction > slow.friction > still.friction


@pytest.mark.parametrize("share", [1.0, 0.5])
def test_the_pair_does_the_work_of_the_method(share: float) -> None:
    pair = ikeda_roll_damping(SHIP, **CALL)
    method = ikeda_roll_damping(SHIP, **(CALL | {"amplitude_deg": share * 10.0})).total
    rate = share * np.radians(10.0) * CALL["omega"]
    assert pair.linear + 8.0 / (3.0 * np.pi) * rate * pair.quadratic == pytest.approx(method)


def test_particulars_of_a_hull() -> None:
    hull = shipped_hull()
    found = MainParticulars.of(hull)
    assert found.block_coefficient == pytest.approx(hull.hydrostatics.volume / (115.0 * 25.0 * 6.4), rel=1e-3)
    assert found.block_coefficient < found.midship_coefficient <= 1.0
    assert (found.length, found.breadth, found.draught) == pytest.approx((115.0, 25.0, 6.4), rel=1e-3)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"ship": {"block_coefficient": 0.45}}, "block_coefficient is 0.45; the formulas hold from 0.5"),
        ({"ship": {"midship_coefficient": 0.88}}, "midship_coefficient is 0.88"),
        ({"ship": {"draught": 25.0}}, "breadth / draught is 2"),
        ({"axis_height": 20.0}, "roll axis / draught is -1.6"),
        ({"omega": 0.7}, "omega sqrt"),
        ({"omega": 0.0}, "omega is 0"),
        ({"bilge_keel_breadth": 4.0}, "bilge_keel_breadth / breadth is 0.08"),
        ({"bilge_keel_length": 150.0}, "bilge_keel_length / length is 0.5"),
        ({"bilge_keel_length": 0.0}, "give both, or none"),
        ({"amplitude_deg": 25.0}, "amplitude_deg is 25"),
        ({"speed": -1.0}, "speed is -1"),
        ({"ship": {"block_coefficient": 0.85}}, "eddies come out"),
        ({"ship": {"length": 0.0}}, "length is 0"),
    ],
)
def test_outside_the_method_it_is_refused(changes: dict[str, Any], words: str) -> None:
    ship, call = changes.get("ship", {}), {key: value for key, value in changes.items() if key != "ship"}
    with pytest.raises(SceneError, match=words):
        ikeda_roll_damping(replace(SHIP, **ship), **(CALL | call))


def rolling(linear: float, quadratic: float) -> tuple[Array, Array, float, float]:
    """Time, roll (rad) of a free decay from 8 deg, inertia and stiffness; a body that can only roll."""
    inertia, stiffness = 4e9, 1e9
    scene = Scene(name="decay", gravity=0.0)
    scene.add_body(name="hull", mass=1e7, inertia=[inertia, 1e10, 1e10], quaternion=_turned(8.0))
    restoring, damping = np.zeros((6, 6)), np.zeros((6, 6))
    restoring[3, 3], damping[3, 3] = stiffness, linear
    scene.add_vessel(
        body="hull", added_mass=np.zeros((6, 6)), linear_damping=damping, restoring=restoring,
        quadratic_damping=[0, 0, 0, quadratic, 0, 0],
    )  # fmt: skip
    run = simulate(scene, t_end=120.0, dt_out=0.05)
    return run.time, run["vessel_motion"][:, 3], inertia, stiffness


def _turned(degrees: float) -> tuple[float, float, float, float]:
    half = 0.5 * np.radians(degrees)
    return float(np.cos(half)), float(np.sin(half)), 0.0, 0.0


def crests(roll: Array) -> Array:
    """Amplitudes of all half periods, by parabolas."""
    size = np.abs(roll)
    at = np.flatnonzero((size[1:-1] > size[:-2]) & (size[1:-1] >= size[2:])) + 1
    before, top, after = size[at - 1], size[at], size[at + 1]
    return np.asarray(top + (after - before) ** 2 / (8.0 * (2.0 * top - before - after)))


def decrements(damping: float) -> tuple[list[float], float]:
    """Of each half period of a free decay, and in closed form."""
    _, roll, inertia, stiffness = rolling(damping, 0.0)
    ratio = damping / (2.0 * np.sqrt(inertia * stiffness))
    closed = float(np.pi * ratio / np.sqrt(1.0 - ratio**2))
    return [float(np.log(one / two)) for one, two in pairwise(crests(roll))], closed


def test_equivalent_linear_damping_makes_its_logarithmic_decrement() -> None:
    measured, decrement = decrements(1e8)
    assert measured == pytest.approx([decrement] * len(measured), rel=2e-3)


def test_the_pair_makes_the_decay_of_its_energy() -> None:
    """d phi / d n = -(pi / 2 w I) (b1 phi + 8 / (3 pi) w b2 phi^2) over half periods n, integrated."""
    linear, quadratic = 3e7, 8e8
    _, roll, inertia, stiffness = rolling(linear, quadratic)
    measured = crests(roll)
    omega = np.sqrt(stiffness / inertia)
    b1, b2 = np.pi / (2 * omega * inertia) * np.array([linear, 8.0 / (3.0 * np.pi) * omega * quadratic])
    n = np.arange(len(measured))
    decay = np.exp(-b1 * n)
    closed = b1 * measured[0] * decay / (b1 + b2 * measured[0] * (1.0 - decay))
    assert measured == pytest.approx(closed, rel=0.01)


def test_a_database_takes_the_pair_in_place_of_its_own() -> None:
    database = shipped_database()
    pair = database.with_roll_damping(linear=2e7, quadratic=3e8)
    assert pair.linear_damping[3, 3] == 2e7 and pair.quadratic_damping[3] == 3e8
    share = database.with_roll_damping(fraction=0.05)
    assert database.with_roll_damping(linear=1e6, fraction=0.05).linear_damping[3, 3] == pytest.approx(
        share.linear_damping[3, 3] + 1e6
    )
    others = np.ones((6, 6), dtype=bool)
    others[3, 3] = False
    assert np.array_equal(pair.linear_damping[others], database.linear_damping[others])
    scene = Scene()
    scene.add_vessel(pair, memory="none")
    assert scene.vessels["vessel"].quadratic_damping[3] == 3e8
    with pytest.raises(SceneError, match="quadratic is -1"):
        database.with_roll_damping(quadratic=-1.0)


def test_a_dimensionless_eddy_does_not_know_the_bilge_keels() -> None:
    values: dict[str, float] = {"cb": 0.6, "cm": 0.95, "bd": 3.0, "og": -0.5, "frequency": 0.5}
    assert eddy(**values, amplitude=0.2) == pytest.approx(2.0 * eddy(**values, amplitude=0.1))
