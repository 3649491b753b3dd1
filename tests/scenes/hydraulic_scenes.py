"""A load on a hydraulic cylinder, and its equations written down again for SciPy."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from seacrane import Curve, Scene
from seacrane.arrays import Array
from seacrane.description.hydraulic_cylinders import VALUES
from seacrane.inputs.values import flat
from seacrane.scene import Chamber, Oil, Piston, Pump, Valve

G = 9.80665
MASS = 1000.0  # kg
BORE, ROD = 0.08, 0.035  # m
FULL, RING = np.pi / 4.0 * BORE**2, np.pi / 4.0 * (BORE**2 - ROD**2)
RETRACTED, STROKE, START = 1.05, 0.6, 0.3  # m
HOLDING = MASS * G
# Rahikainen et al., Multibody Syst. Dyn. 2020, as Chrono's hydraulic crane has them.
VALVE = Valve(
    rated_flow=24e-3 / 60.0, rated_drop=3.5e6, laminar_drop=2e5, spool_lag=1.0 / (2.0 * np.pi * 35.0)
)
PUMP = Pump(pressure=7.6e6)
PARTS: dict[str, Any] = {
    "full_area": FULL, "rod_side_area": RING, "retracted_length": RETRACTED, "stroke": STROKE, "valve": VALVE,
    "chamber": Chamber(hose_volume=31.4e-6), "rod_chamber": Chamber(hose_volume=78.5e-6), "oil": Oil(),
    "pump": PUMP, "piston": Piston(viscous_friction=1e5),
}  # fmt: skip
SET = flat("ram", PARTS, VALUES)
OF_CRANE = Valve(rated_flow=0.05, rated_drop=1e6, spool_lag=0.03, gain=0.8)
OIL: dict[str, Any] = {"pump": Pump(pressure=32e6), "valve": OF_CRANE, "piston": Piston(viscous_friction=2e6)}


def raised(*, mass: float = MASS, above: bool = True, velocity: float = 0.0, **settings: Any) -> Scene:
    """A mass that a vertical cylinder holds up, or that hangs on one."""
    sign = 1.0 if above else -1.0
    scene = Scene(name="on a cylinder")
    place = (0.0, 0.0, sign * (RETRACTED + START))
    scene.add_body("load", mass=mass, inertia=(10.0,) * 3, position=place, velocity=(0, 0, velocity))
    scene.add_joint("guide", kind="prismatic", first="ground", second="load", point=(0, 0, 0), axis=(0, 0, 1))
    scene.add_hydraulic_cylinder("ram", first="ground", second="load", **PARTS | settings)
    return scene


def closed_stiffness(stroke: float) -> float:
    """Of both chambers with their valves shut, N/m."""
    stiffness = 0.0
    for area, swept, hose in (
        (FULL, FULL * stroke, SET["hose_volume"]), (RING, RING * (STROKE - stroke), SET["hose_volume_rod"]),
    ):  # fmt: skip
        whole = (swept + hose) / SET["oil_modulus"]
        stiffness += area**2 / (whole + swept / SET["cylinder_modulus"] + hose / SET["hose_modulus"])
    return stiffness


def lifted(**settings: Any) -> Scene:
    """The spool opens, holds, closes and opens the other way."""
    up = Curve.quintic(start_time=0.1, end_time=0.3, start=0.0, end=0.6)
    shut = up.then(time=0.8, curve=Curve.quintic(start_time=0.8, end_time=0.9, start=0.6, end=0.0))
    down = shut.then(time=1.2, curve=Curve.quintic(start_time=1.2, end_time=1.4, start=0.0, end=-0.5))
    return raised(command=down, **settings)


def command(t: float) -> float:
    """That of `lifted`."""
    for start, end, low, high in ((1.2, 1.4, 0.0, -0.5), (0.8, 0.9, 0.6, 0.0), (0.1, 0.3, 0.0, 0.6)):
        if t >= start:
            x = min((t - start) / (end - start), 1.0)
            return low + (high - low) * x**3 * (10.0 - 15.0 * x + 6.0 * x * x)
    return 0.0


def own_solution(times: Array, pressures: tuple[float, float], **more: Any) -> Array:
    """Stroke, speed, both pressures and the spool of `lifted`, shape (5, n), by Radau."""
    given = flat("ram", PARTS | more, VALUES)
    conductance = given["rated_flow"] / np.sqrt(given["rated_drop"])

    def through(drop: float) -> float:
        return drop / (drop**2 + given["laminar_drop"] ** 2) ** 0.25

    def opened(travel: float) -> float:
        return max(travel - given["overlap"], 0.0) / (1.0 - given["overlap"])

    def modulus(swept: float, hose: float) -> float:
        whole = swept + hose
        return 1.0 / (
            1.0 / given["oil_modulus"]
            + swept / whole / given["cylinder_modulus"]
            + hose / whole / given["hose_modulus"]
        )

    def rates(t: float, x: Array) -> list[float]:
        s, v, p1, p2, u = x
        supply, tank = given["pump_pressure"], given["tank_pressure"]
        q1 = conductance * (opened(u) * through(supply - p1) + opened(-u) * through(tank - p1))
        q2 = conductance * (opened(-u) * through(supply - p2) + opened(u) * through(tank - p2))
        past = given["internal_leakage"] * (p1 - p2)
        q1 -= past + given["external_leakage"] * (p1 - tank)
        q2 += past - given["external_leakage"] * (p2 - tank)
        swept1, swept2 = FULL * s, RING * (STROKE - s)
        b1, b2 = modulus(swept1, given["hose_volume"]), modulus(swept2, given["hose_volume_rod"])
        force = p1 * FULL - p2 * RING - given["viscous_friction"] * v
        return [v, force / MASS - G, b1 / (swept1 + given["hose_volume"]) * (q1 - FULL * v),
                b2 / (swept2 + given["hose_volume_rod"]) * (q2 + RING * v),
                (command(t) - u) / given["spool_lag"]]  # fmt: skip

    found, x = [], np.array([START, 0.0, *pressures, 0.0])
    corners = [0.0, 0.1, 0.3, 0.8, 0.9, 1.2, 1.4, float(times[-1])]
    for begin, end in pairwise(corners):
        inside = times[(times >= begin) & (times < end)]
        part = solve_ivp(rates, (begin, end), x, method="Radau", t_eval=[*inside, end], rtol=1e-10,
                         atol=[1e-12, 1e-12, 1e-4, 1e-4, 1e-12])  # fmt: skip
        found.append(part.y[:, :-1])
        x = part.y[:, -1]
    return np.hstack([*found, x[:, None]])
