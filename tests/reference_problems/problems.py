"""The comparisons: each runs a scene and tells how far it is from the problem's solution."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator
from functools import cache, partial
from typing import Any, NamedTuple

import numpy as np
from multibody_runs import CRANK, slider_crank
from test_vessel import moored, regular_wave, steady_state

from seacrane import Result, Scene, simulate
from seacrane.arrays import Array
from seacrane.hydro import shipped_database
from seacrane.inputs.frames import rotation_matrix

from . import andrews, bricard, cummins, four_bars, governor, pendulums, tops
from .planar import angles


class Comparison(NamedTuple):
    """`difference` is the largest over what was compared, `expected` the last value of the worst of it."""

    problem: str
    quantity: str
    source: str
    expected: float
    difference: float
    unit: str


def run(scene: Scene, t_end: float, dt_out: float, settings: dict[str, Any], *channels: str) -> Result:
    """Joints that hold a motion twice are part of some problems: no warning."""
    with warnings.catch_warnings(action="ignore", category=UserWarning):
        return simulate(scene, t_end=t_end, dt_out=dt_out, channels=list(channels), **settings)


def compared(problem: str, quantity: str, source: str, found: Any, expected: Any, unit: str) -> Comparison:
    found, expected = (np.asarray(a, dtype=float).reshape(len(a), -1) for a in (found, expected))
    apart = np.abs(found - expected)
    worst = int(np.argmax(apart.max(axis=0)))
    return Comparison(problem, quantity, source, float(expected[-1, worst]), float(apart.max()), unit)


def simple_pendulum(**settings: Any) -> Comparison:
    result = run(pendulums.scene(), 10.0, 0.05, settings, "position")
    found, expected = result["position"][:, 0, ::2], pendulums.place(result.time)
    return compared("simple pendulum", "place, 10 s", "elliptic functions", found, expected, "m")


def four_bar_row(loops: int = 2, *, planar: bool = True, **settings: Any) -> Comparison:
    result = run(four_bars.scene(loops, planar=planar), 10.0, 0.05, settings, "quaternion")
    found = 0.5 * np.pi - angles("xz", result["quaternion"])[:, 0]
    expected, _ = four_bars.turned(loops, result.time)
    name = f"{loops} four-bars" + ("" if planar else ", spatial joints")
    return compared(name, "angle of a post, 10 s", "elliptic functions", found, expected, "rad")


@cache
def solution_of(name: str) -> Array:
    """Computed once for all settings: at the outputs of the runs."""
    if name == "squeezer":
        return andrews.solution([0.0, andrews.END_TIME])
    if name == "governor":
        return governor.solution(np.linspace(0.0, 5.0, 51))[:, 1]
    mechanism, t_end, count, start = {
        "bricard": (bricard.mechanism(), 2.5, 21, (bricard.CUBE, 0.0)),
        "crank": (CRANK.mechanism(), 3.0, 61, (0.4, 6.0)),
    }[name]
    coordinate, _ = mechanism.simulate(np.linspace(0.0, t_end, count), *start)
    return mechanism.poses(coordinate)[0]


def squeezer(*, planar: bool = False, published: bool = False, **settings: Any) -> Comparison:
    result = run(andrews.scene(planar=planar), andrews.END_TIME, 1e-4, settings, "quaternion")
    found = andrews.problem_angles(result["quaternion"])[[0, -1]]
    expected = np.array([andrews.START, andrews.END]) if published else solution_of("squeezer")
    source = "IVP test set" if published else "its equations, SciPy"
    name = "Andrews' squeezer" + (", planar joints" if planar else "")
    return compared(name, "seven angles, 0.03 s", source, found, expected, "rad")


def bricard_loop(**settings: Any) -> Comparison:
    found = run(bricard.scene(), 2.5, 0.125, settings, "position")["position"]
    what, source = "places of five rods, 2.5 s", "closed form and SciPy"
    return compared("Bricard's loop", what, source, found, solution_of("bricard"), "m")


def flyball_governor(**settings: Any) -> Comparison:
    result = run(governor.scene(), 5.0, 0.1, settings, "position")
    found, source = result.select("position", body="slider")[:, 2], "Lagrange's equations, SciPy"
    return compared("flyball governor", "slider's height, 5 s", source, found, solution_of("governor"), "m")


def heavy_top(*, published: bool = False, **settings: Any) -> Comparison:
    result = run(tops.scene(), 2.0, 0.02, settings, "position")
    found, expected = result["position"][:, 0], tops.center(result.time)
    if published:
        found, expected = found[[0, -1]], np.array([[0.0, 1.0, 0.0], tops.PUBLISHED])
    source = "Kynema's verification" if published else "elliptic integrals"
    return compared("heavy top", "place, 2 s", source, found, expected, "m")


def wing_nut(**settings: Any) -> Comparison:
    result = run(tops.wing_nut(), 100.0, 0.25, settings, "quaternion", "angular_velocity")
    body = rotation_matrix(result["quaternion"][:, 0])
    found, expected = np.einsum("kji,kj->ki", body, result["angular_velocity"][:, 0]), tops.wing(result.time)
    return compared("Dzhanibekov's nut", "body rates, 100 s", "elliptic functions", found, expected, "rad/s")


def spatial_slider_crank(**settings: Any) -> Comparison:
    found = run(slider_crank(CRANK, 0.4, 6.0), 3.0, 0.05, settings, "position")["position"]
    what, source = "places of three bodies, 3 s", "one coordinate, SciPy"
    return compared("slider-crank", what, source, found, solution_of("crank"), "m")


def ship_in_a_wave(memory: str = "states", **settings: Any) -> Comparison:
    result = run(cummins.scene(memory), 60.0, 1.0, settings, "vessel_motion")
    size = np.abs(cummins.by_convolution()).max(axis=0)
    found, expected = result["vessel_motion"] / size, cummins.by_convolution() / size
    what, source = "six motions over their largest, 60 s", "direct convolution, NumPy"
    return compared(f"Cummins, memory by {memory}", what, source, found, expected, "")


def decays(label: str) -> list[Comparison]:
    name, source, turn = f"free decay in {label.split()[1]}", "roots of its equation", 2.0 * np.pi
    values = [np.array([a]) for a in cummins.decay(label)]
    periods, decrements = ([f(a) for a in values] for f in (
        lambda a: turn / a.imag, lambda a: -turn * a.real / a.imag))  # fmt: skip
    return [compared(name, "period", source, *periods, "s"),
            compared(name, "decrement", source, *decrements, "")]  # fmt: skip


def regular_wave_response() -> list[Comparison]:
    """Steady amplitudes of heave, roll and pitch in a regular wave, over that of the wave (rad/m for two)."""
    database, size = shipped_database(), 1e-4
    sea = regular_wave(database, omega=0.8, heading_deg=135.0, amplitude=size, phase=0.4)
    found, expected = (np.abs(a) / size for a in steady_state(database, moored(database), sea))
    what, source = "amplitude at 0.8 rad/s", "complex linear equations"
    return [
        compared(f"regular wave, {motion}", what, source, found[i : i + 1], expected[i : i + 1], unit)
        for i, motion, unit in ((2, "heave", ""), (3, "roll", "rad/m"), (4, "pitch", "rad/m"))
    ]


MECHANISMS: dict[str, Callable[..., Comparison]] = {
    "pendulum": simple_pendulum, "four-bars": four_bar_row,
    "four-bars spatial": partial(four_bar_row, planar=False), "squeezer": squeezer, "bricard": bricard_loop,
    "governor": flyball_governor, "top": heavy_top, "nut": wing_nut, "crank": spatial_slider_crank,
}  # fmt: skip


def mechanisms() -> Iterator[Comparison]:
    for formulation in ("redundant", "recursive"):
        for problem, settings in (
            (simple_pendulum, {"rtol": 1e-10}), (four_bar_row, {"integrator": "dop853", "rtol": 1e-10}),
            (squeezer, {"integrator": "verner76", "rtol": 1e-8}),
            (squeezer, {"published": True, "integrator": "verner76", "rtol": 1e-8}),
            (bricard_loop, {"integrator": "dop853", "rtol": 1e-9}),
            (flyball_governor, {"integrator": "dopri5", "rtol": 1e-6}),
            (heavy_top, {"integrator": "dop853", "rtol": 1e-9}),
            (heavy_top, {"published": True, "integrator": "dop853", "rtol": 1e-9}),
            (wing_nut, {"rtol": 1e-10}), (spatial_slider_crank, {"integrator": "dop853", "rtol": 1e-10})
        ):  # fmt: skip
            yield problem(formulation=formulation, **settings)


def ships() -> Iterator[Comparison]:
    for memory in ("states", "convolution"):
        yield ship_in_a_wave(memory, integrator="dop853", rtol=1e-11)
    for motion in ("heave", "roll", "pitch"):
        yield from decays(f"vessel {motion}")
    yield from regular_wave_response()
