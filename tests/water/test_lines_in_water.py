"""Lines with mass in water: buoyancy, added mass, drag, in still water, waves and current."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from wet_scenes import EXACT, RHO, G

from seacrane import Scene, _core, natural_modes, simulate
from seacrane.arrays import Array
from seacrane.description.elements import add_load
from seacrane.result import heavy_line_tension
from seacrane.sea import Current


def area(diameter: float) -> float:
    return np.pi / 4.0 * diameter**2


def with_ends(scene: Scene, places: Any, *, mass: float, velocities: Any = ((0, 0, 0), (0, 0, 0))) -> None:
    """Two free bodies, "one" and "two"."""
    for name, place, velocity in zip(("one", "two"), places, velocities, strict=True):
        scene.add_body(name=name, mass=mass, inertia=(mass,) * 3, position=place, velocity=velocity)


def wet_line(scene: Scene, length: float | None = None, **given: Any) -> None:
    """Between these bodies."""
    wire = {"mass_per_length": 20.0, "segments": 3, "diameter": 0.1, "density": RHO, "medium": "sea"} | given
    scene.add_line("line", "one", "two", EA=1e6, length=length, wire=wire)


def tossed(*, waves: bool = True) -> Scene:
    """A thick line that swings below the ground through the surface, a load at its end."""
    scene = Scene(name="tossed", gravity=G)
    if waves:
        current = Current(depth=[0.0, 10.0], speed=[0.8, 0.3], direction_deg=[20.0, 60.0])
        sea: dict[str, Any] = {"hs": 1.5, "tp": 5.0, "count": 20, "seed": 3, "direction_deg": 30.0}
        scene.add_sea(vessel=None, gamma=2.0, current=current, **sea)
    scene.add_body(name="load", mass=400.0, inertia=(90.0, 80.0, 70.0), position=(8.0, 1.0, -3.0),
                   velocity=(-1.0, 2.0, 1.0), angular_velocity=(0.4, -0.3, 0.6))  # fmt: skip
    scene.add_line("wire", "ground", "load", wire={"medium": "sea", "segments": 3, "mass_per_length": 40.0,
                   "diameter": 0.25, "drag_coefficient_along": 0.05}, first_point=(0.0, 0.0, 5.0),
                   second_point=(0.1, -0.2, 0.4), EA=2e5, length=11.5)  # fmt: skip
    return scene


def test_a_line_in_a_current_moves_as_one_that_is_towed_through_still_water(formulation: str) -> None:
    """Relativity of Galileo: added mass, its moment, slam and drag see the speed over the water alone."""
    u, runs = np.array([1.3, -0.6, 0.0]), []
    for flows in (True, False):
        scene = Scene(name="towed", gravity=G)
        if flows:
            speed, angle = float(np.hypot(*u[:2])), float(np.degrees(np.arctan2(u[1], u[0])))
            scene.add_sea(vessel=None, hs=0.0, current=Current(depth=0.0, speed=speed, direction_deg=angle))
        own = np.array([[0.5, 0.2, -2.0], [-0.4, 0.6, 1.0]]) - (0.0 if flows else u)
        with_ends(scene, [(0.0, 0.0, 1.0), (6.0, 2.0, -1.5)], mass=60.0, velocities=own)
        wet_line(scene, diameter=0.3, mass_per_length=60.0)
        runs.append(simulate(scene, 1.5, dt_out=0.1, formulation=formulation, **EXACT))
    carried, towed = runs
    moved = np.asarray(towed["position"]) + u * np.asarray(towed.time)[:, None, None]
    assert np.asarray(carried["position"]) == pytest.approx(moved, abs=1e-8)


@pytest.mark.parametrize("along", [(50.0, 0.0, 0.0), (0.0, 0.0, 50.0)], ids=["level", "upright"])
def test_a_line_that_sinks_takes_on_its_terminal_speed_as_its_equation_says(along: Any) -> None:
    """M' v' = W - k v^2 has v = V tanh(k V t / M'), V^2 = W / k; across M' holds the added mass."""
    scene = Scene(name="sinking", gravity=G)
    with_ends(scene, [(0.0, 0.0, -100.0), np.add((0.0, 0.0, -100.0), along)], mass=100.0)
    wet_line(scene, length=50.0, segments=1, drag_coefficient=1.1, drag_coefficient_along=0.02,
             added_mass_coefficient=0.9)  # fmt: skip
    result = simulate(scene, t_end=4.0, rtol=1e-9, channels=["velocity", "position"])
    water, upright = RHO * area(0.1) * 50.0, along[2] > 0.0
    mass = 200.0 + 20.0 * 50.0 + (0.0 if upright else 0.9 * water)
    weight = (1200.0 - water) * G
    drag = 0.5 * RHO * 0.1 * 50.0 * (np.pi * 0.02 if upright else 1.1)
    final = np.sqrt(weight / drag)
    expected = -final * np.tanh(drag * final * np.asarray(result.time) / mass)
    for end in ("one", "two"):
        speed = np.asarray(result.select("velocity", body=end, axis="z"))
        assert speed == pytest.approx(expected, rel=1e-6, abs=1e-6)


def test_a_rod_that_moves_askew_turns_by_the_moment_of_munk(formulation: str) -> None:
    """A neutral rod of two masses beside the equations of Kirchhoff in a plane: momentum is kept."""
    length, mass, diameter, angle = 4.0, 30.0, 0.2, 0.3
    scene, speed = Scene(name="askew", gravity=0.0), np.array([2.0, 0.0, 0.0])
    half = 0.5 * length * np.array([np.cos(angle), 0.0, np.sin(angle)])
    ends = [np.array([0.0, 0.0, -50.0]) + side * half for side in (-1.0, 1.0)]
    with_ends(scene, ends, mass=mass, velocities=[speed, speed])
    scene.add_joint(kind="distance", name="rod", first="one", second="two", point=ends[0],
                    second_point=ends[1])  # fmt: skip
    add_load(scene, _core.ImmersedSpan(
        name="water", first="one", second="two", density=RHO, diameter=diameter, length=length,
        drag_coefficient=0.0,
    ))  # fmt: skip
    added = RHO * area(diameter) * length

    def rate(t: float, y: Array) -> Array:
        """Of x, z, angle, and its rate; the momentum is that of the start."""
        along, across = np.array([np.cos(y[2]), np.sin(y[2])]), np.array([-np.sin(y[2]), np.cos(y[2])])
        slide, side = along @ momentum / (2.0 * mass), across @ momentum / (2.0 * mass + added)
        turning = -added * slide * side / ((2.0 * mass + added) * length**2 / 4.0)
        return np.array([*(slide * along + side * across), y[3], turning])

    across = np.array([-np.sin(angle), np.cos(angle)])
    momentum = 2.0 * mass * speed[[0, 2]] + added * across * (across @ speed[[0, 2]])
    result = simulate(scene, t_end=6.0, dt_out=0.1, channels=["position"], formulation=formulation, **EXACT)
    alone = solve_ivp(rate, (0.0, 6.0), [0.0, -50.0, angle, 0.0], t_eval=result.time, rtol=1e-12, atol=1e-12)
    one, two = (np.asarray(result.select("position", body=name)) for name in ("one", "two"))
    turned = np.unwrap(np.arctan2((two - one)[:, 2], (two - one)[:, 0]))
    assert turned == pytest.approx(alone.y[2], abs=1e-7)
    assert np.ptp(turned) > 1.0, "it turns broadside and beyond"
    assert 0.5 * (one + two)[:, [0, 2]] == pytest.approx(alone.y[:2].T, abs=1e-7)


def test_a_taut_wire_under_water_swings_by_its_mass_and_added_mass() -> None:
    """(pi / L) sqrt(T / (m + C_a density A)); of n segments 2 n / pi sin(pi / 2 n) of it."""
    length, pull, strain, diameter = 50.0, 1e4, 0.01, 0.06
    short = length / (1.0 + strain)
    found = []
    for n in (4, 8, 16):
        scene = Scene(name="taut", gravity=0.0)
        scene.add_body(name="end", mass=1e3, inertia=(1e3,) * 3, position=(length, 0.0, -20.0))
        scene.add_joint(kind="weld", name="bolts", first="ground", second="end")
        scene.add_line("line", "ground", "end", first_point=(0.0, 0.0, -20.0), second_point=(0.0, 0.0, 0.0),
                       EA=pull / strain, length=short, wire={"mass_per_length": 2.0, "segments": n,
                       "diameter": diameter, "medium": "sea", "density": RHO,
                       "added_mass_coefficient": 0.8})  # fmt: skip
        mass = (2.0 + 0.8 * RHO * area(diameter)) / (1.0 + strain)
        whole = np.pi / length * np.sqrt(pull / mass)
        chain = whole * 2.0 * n / np.pi * np.sin(0.5 * np.pi / n)
        omega = 2.0 * np.pi / natural_modes(scene).natural_period
        assert np.abs(omega - chain).min() < 1e-6 * chain
        found.append(whole - chain)
    assert np.log2(np.divide(found[:-1], found[1:])) == pytest.approx([2.0, 2.0], abs=0.05)


@pytest.mark.parametrize(("length", "period"), [(100.0, 1.04589), (3000.0, 6.34502)])
def test_a_load_on_a_long_wire_bounces_with_the_wire_s_own_mass(length: float, period: float) -> None:
    """x tan x = m L / M, x = omega L / c: with second order in the segments, 20 are within 2e-4. 25 kg/m and
    EA 4e8 N with 60 t below it, and 50 t of water that move up and down with those."""
    share = 25.0 * length / 110e3
    x = brentq(lambda x: x * np.tan(x) - share, 1e-6, 0.5 * np.pi - 1e-6, xtol=1e-14)
    exact = 2.0 * np.pi * length / (x * np.sqrt(4e8 / 25.0))
    assert exact == pytest.approx(period, abs=6e-6)
    errors, low = [], -20.0 - length * (1.0 + 60e3 * G / 4e8)
    for segments in (5, 10, 20):
        scene = Scene(name="long wire", gravity=G)
        scene.add_body(name="load", mass=60e3, inertia=(1e5,) * 3, position=(0.0, 0.0, low))
        scene.add_line("wire", "ground", "load", first_point=(0.0, 0.0, -20.0), second_point=(0.0, 0.0, 0.0),
                       EA=4e8, length=length, wire={"mass_per_length": 25.0, "segments": segments,
                       "diameter": 0.06, "medium": "sea"})  # fmt: skip
        add_load(scene, _core.ImmersedPart(
            name="water", body="load", shape="box", size=(1.0, 1.0, 1.0), fill=0.0, density=RHO,
            depths=[0.0, 2.0], added_masses=[(0.0, 0.0, 0.0), (0.0, 0.0, 50e3)],
        ))  # fmt: skip
        modes = natural_modes(scene)
        along = modes.energy_share[:, :, 2].sum(axis=1) > 0.99
        errors.append(float(modes.natural_period[along].max()) - exact)
    assert np.log2(np.divide(errors[:-1], errors[1:])) == pytest.approx([2.0, 2.0], abs=0.02)
    assert abs(errors[-1]) < 2e-4 * exact


def drawn_aside(speed: float, segments: int) -> float:
    """Offset (m) at rest of 400 kN on 1000 m of wire, 200 N/m in water, in a uniform current (m/s)."""
    diameter, length = 0.06, 1000.0
    scene = Scene(name="drawn aside", gravity=G)
    scene.add_sea(vessel=None, hs=0.0, current=Current(depth=0.0, speed=speed, direction_deg=0.0))
    scene.add_body(name="load", mass=400e3 / G, inertia=(1e5,) * 3, position=(0.0, 0.0, -20.0 - length))
    scene.add_line("wire", "ground", "load", first_point=(0.0, 0.0, -20.0), second_point=(0.0, 0.0, 0.0),
                   EA=4e10, length=length, wire={"mass_per_length": 200.0 / G + RHO * area(diameter),
                   "segments": segments, "diameter": diameter, "drag_coefficient": 1.2, "medium": "sea",
                   "density": RHO})  # fmt: skip
    push = 0.5 * RHO * 1.5 * 20.0
    add_load(scene, _core.ImmersedPart(
        name="drag", body="load", shape="box", size=(1.0, 1.0, 1.0), fill=0.0, density=RHO,
        depths=[0.0, 2.0], added_masses=np.zeros((2, 3)), drag=(push, push, push),
    ))  # fmt: skip
    still = simulate(scene, t_end=0.1, start="rest", channels=["position"])
    return float(np.asarray(still.select("position", body="load", axis="x"))[0])


@pytest.mark.warns("UnitWarning")  # far from any real one, so that its formula shows
def test_a_current_draws_a_long_wire_aside_as_its_integral_says() -> None:
    """(F + q s) / (W + w s) from the load up, in the limit of small angles; second order in the segments."""
    force, push = 0.5 * RHO * 1.5 * 20.0 * 0.25, 0.5 * RHO * 1.2 * 0.06 * 0.25
    s = np.linspace(0.0, 1000.0, 20001)
    aside = (force + push * s) / (400e3 + 200.0 * s)
    assert np.trapezoid(aside, s) == pytest.approx(16.513376, abs=2e-6)
    stretched = np.trapezoid(aside * (1.0 + (400e3 + 200.0 * s) / 4e10), s)
    errors = [drawn_aside(0.05, n) * 100.0 - stretched for n in (5, 10, 20)]
    assert np.log2(np.divide(errors[:-1], errors[1:])) == pytest.approx([2.0, 2.0], abs=0.05)
    assert abs(errors[-1]) < 1e-4 * stretched
    assert drawn_aside(0.5, 10) == pytest.approx(stretched, rel=1e-3)  # with the angles that it has


def test_a_wire_hangs_by_its_weight_less_the_water_that_it_displaces() -> None:
    """A load of 1 t on 60 m of wire from 20 m above the water."""
    scene = Scene(name="wet and dry", gravity=G)
    scene.add_body(name="load", mass=1e3, inertia=(1e3,) * 3, position=(0.0, 0.0, -40.0))
    scene.add_line("wire", "ground", "load", first_point=(0.0, 0.0, 20.0), second_point=(0.0, 0.0, 0.0),
                   wire={"medium": "sea", "mass_per_length": 30.0, "segments": 12, "diameter": 0.08},
                   length=60.0, EA=1e8)  # fmt: skip
    upper, lower = heavy_line_tension(simulate(scene, t_end=0.1, start="rest"), line="wire")[-1]
    assert upper == pytest.approx((1e3 + 30.0 * 60.0 - RHO * area(0.08) * 40.0) * G, rel=1e-5)
    assert lower == pytest.approx(1e3 * G, rel=1e-5)


@pytest.mark.parametrize(
    ("mass_per_length", "top", "end"), [(30.0, 3.0, -7.0), (1.0, -30.0, -40.0), (2.0, 3.0, -25.0)]
)
def test_a_slack_line_is_described_where_it_rests(mass_per_length: float, top: float, end: float) -> None:
    """Between two fixed points: through the surface, and below it heavier than water and lighter."""
    scene = Scene(name="slack", gravity=G)
    scene.add_body(name="end", mass=1e3, inertia=(1e3,) * 3, position=(40.0, 0.0, end))
    scene.add_joint(kind="weld", name="bolts", first="ground", second="end")
    scene.add_line("line", "ground", "end", first_point=(0.0, 0.0, top), second_point=(0.0, 0.0, 0.0), EA=1e6,
                   length=60.0, wire={"mass_per_length": mass_per_length, "segments": 12, "diameter": 0.08,
                   "medium": "sea", "density": RHO})  # fmt: skip
    floating = end == -25.0
    start: Any = "rest" if floating else None
    place = np.asarray(simulate(scene, t_end=1.0, rtol=1e-9, start=start)["position"])
    assert np.ptp(place, axis=0).max() < 1e-5
    inner = place[0, 1:-1, 2]  # of its masses
    if floating:
        assert (np.abs(inner) < 0.1).sum() >= 5
    else:
        assert (inner.max() > top + 1.0) == (mass_per_length < RHO * area(0.08)), "it floats up"


def test_a_span_between_bodies_that_move_as_one_has_its_water_too(formulation: str) -> None:
    """Two bodies that are welded, level and light: they rise by buoyancy over mass and added mass."""
    scene = Scene(name="raft", gravity=G)
    with_ends(scene, [(0.0, 0.0, -50.0), (4.0, 0.0, -50.0)], mass=30.0)
    scene.add_joint(kind="weld", name="glue", first="one", second="two")
    span = {"diameter": 0.2, "length": 4.0, "density": RHO, "drag_coefficient": 1.0}
    add_load(scene, _core.ImmersedSpan(name="water", first="one", second="two", **span))
    water = RHO * area(0.2) * 4.0
    result = simulate(scene, t_end=1.0, dt_out=0.1, channels=["velocity"], formulation=formulation, **EXACT)
    speed = np.asarray(result.select("velocity", body="two", axis="z"))
    drag, weight, mass = 0.5 * RHO * 0.2 * 4.0, (water - 60.0) * G, water + 60.0
    final = np.sqrt(weight / drag)
    assert speed == pytest.approx(final * np.tanh(drag * final * np.asarray(result.time) / mass), rel=1e-7)
