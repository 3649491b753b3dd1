"""Loads that are no lines, one after another on as little as they need."""

from __future__ import annotations

import ctypes
import sys
from pathlib import Path

import numpy as np

from bits.case import by, case
from bits.scenes.parts import HULL_IN_FLOW, G, guided, heaving, ramp, thrown, with_load
from seacrane import Curve, Scene
from seacrane import scene as of
from seacrane.lift.tables import ONE_CALL
from seacrane.scene import gust_curve

sys.path.append(str(Path(__file__).parents[3] / "tests" / "scenes"))

from slipped_scenes import SAMPLES

BDF, IDA = by("cvode-bdf", "redundant"), by("ida", "redundant")
POINTERS = [ctypes.POINTER(ctypes.c_double)] * 3
FOUR_LITRES_OF_OIL = {
    "full_area": 5e-3, "rod_side_area": 4e-3, "retracted_length": 1.05, "stroke": 0.6,
    "chamber": of.Chamber(hose_volume=3e-5), "rod_chamber": of.Chamber(hose_volume=8e-5),
    "pump": of.Pump(pressure=7.6e6), "valve": of.Valve(rated_flow=4e-4, overlap=0.02),
    "piston": of.Piston(viscous_friction=1e5, internal_leakage=1e-13),
    "counterbalance": of.Counterbalance(pressure=4e6, flow=2e-4),
}  # fmt: skip


@case(by("dopri5"), BDF)
def actuator() -> Scene:
    scene = guided()
    scene.add_actuator(
        joint="rail", name="ram", stiffness=5e4, damping=4e3, reference=ramp(0.4), feed_forward=300.0
    )
    return scene


@case(by("tsit5"), by("rk-low-storage", "redundant", dt=0.02))
def point_force() -> Scene:
    scene = thrown()
    scene.add_force("load", name="push", force=(300.0, 20.0, 9e3), point=(0, 0.5, 0))
    scene.add_force("load", name="jet", force=(0, 500.0, 0), point=(1.0, 0, 0), body_axes=True)
    return scene


@case(by("bs32", rtol=1e-5), by("semi-implicit-euler", "redundant", dt=2e-3))
def spring() -> Scene:
    scene = thrown()
    ends = {"first": "ground", "second": "load", "second_point": (0.2, 0.1, 0.3)}
    scene.add_spring(
        name="soft", stiffness=2e4, damping=300.0, natural_length=1.5, first_point=(0, 0, 3), **ends
    )
    scene.add_spring(
        name="table", lengths=[1.0, 2.0, 4.0], forces=[0.0, 1e4, 8e4], first_point=(3, 0, 0), **ends
    )
    return scene


@case(by("verner65"), IDA)
def force_table() -> Scene:
    scene = thrown(gravity=0.0)
    loads = np.outer([0.0, 1.0, -0.5, 0.3], [900.0, -400.0, 200.0, 90.0, 60.0, -30.0])
    scene.add_force("load", name="gust", times=[0.1, 0.6, 1.1, 1.7], force=loads)
    return scene


@ctypes.CFUNCTYPE(None, ctypes.c_double, *POINTERS)
def swirl(t: float, state: object, parameters: object, wrench: object) -> None:
    """A spring to the origin, a drag, and a moment that grows."""
    for i in range(3):
        wrench[i] = -parameters[0] * state[i] - parameters[1] * state[7 + i]  # type: ignore[index]
    wrench[5] = 100.0 * t  # type: ignore[index]


@case(by("dopri5"), by("rk4", "redundant", dt=0.02))
def function_force() -> Scene:
    scene = thrown(gravity=0.0)
    scene.add_force("load", name="swirl", force=swirl, parameters=[8e3, 200.0])
    return scene


@case()
def flow_force() -> Scene:
    scene = thrown()
    areas = {"frontal_area": 40.0, "lateral_area": 90.0, "length": 12.0, "body": "load"}
    gust = gust_curve(mean_speed=12, duration=10, seed=3)
    scene.add_wind(coefficients=HULL_IN_FLOW, speed=gust, direction_deg=60, point=(0, 0, 0.5), **areas)
    scene.add_current(coefficients=HULL_IN_FLOW, speed=0.5, direction_deg=-20, **areas)
    scene.add_wind(body="load", frontal_area=2, lateral_area=3, drag_coefficient=0.8, name="air")
    return scene


@case(by("dop853", rtol=1e-8), BDF)
def friction() -> Scene:
    scene = guided(velocity=(1.0, 0, 0))
    scene.add_spring(name="back", first="ground", second="load", stiffness=2e4)
    scene.add_friction(joint="rail", load=2e3, speed=0.02)
    return scene


@case(by("dopri5"), by("rosenbrock"))
def soft_stop() -> Scene:
    scene = guided(velocity=(1.0, 0, 0))
    scene.add_stop(joint="rail", minimum=-0.2, maximum=0.3, stiffness=4e5, damping=0.4)
    return scene


@case(by("dopri5"), by("cvode-bdf", "redundant"))
def gas_spring() -> Scene:
    scene = guided(axis=(0, 0, 1), position=(0, 0, -4.2))
    gas = of.Gas(area=0.01, length=4.0, force=2e4, stiffness=6e3, exponent=1.3)
    stops = of.Stops(minimum=1.0, maximum=7.0)
    scene.add_spring(name="phc", first="ground", second="load", damping=500.0, gas=gas, stops=stops)
    return scene


@case(by("verner76"), by("generalized-alpha", "redundant", dt=0.01, spectral_radius=0.8))
def pendulum_damping() -> Scene:
    scene = with_load((2.0, 0.3, -7.7), velocity=(0, 0.6, 0))
    ends = {"first": "ground", "second": "load"}
    scene.add_joint(kind="distance", name="rod", point=(0, 0, 0), second_point=(2.0, 0.3, -7.7), **ends)
    scene.add_spring(name="swing", damping_ratio=0.03, **ends)
    return scene


@case(by("dopri5-stiff", rtol=1e-5), by("cvode-bdf", rtol=1e-5), t_end=1.5)
def hydraulic_cylinder() -> Scene:
    up = ramp(0.6, begin=0.1, last=0.3)
    spool = up.then(time=0.8, curve=Curve.quintic(start_time=0.8, end_time=0.9, start=0.6, end=0.0))
    scene = guided(axis=(0, 0, 1), position=(0.0, 0.0, 1.35), mass=1e3)
    ends = {"first": "ground", "second": "load"}
    scene.add_hydraulic_cylinder(name="ram", **ends, **FOUR_LITRES_OF_OIL, command=spool)
    return scene


@case(t_end=4.0, dt_out=0.1)
def heave_compensator() -> Scene:
    """A load on a winch below a ship that heaves."""
    scene = heaving()
    stretch = 2e3 * G * 15.0 / 5e7
    scene.add_body(name="load", mass=2e3, inertia=(500.0,) * 3, position=(0.0, 0.0, 5.0 - stretch))
    path = {"bodies": ["ship", "load"], "points": [(0, 0, 20.0), (0, 0, 0)]}
    scene.add_line(name="hoist", **path, EA=5e7, length=15.0, damping_ratio=0.05)
    scene.add_winch(line="hoist", lag=0.1)
    steered = {"high_pass": 0.03, "lag": 0.2, "lag_order": 2}
    steered["drive"] = of.Drive(frequency=1.5, maximum_rate=0.3)
    scene.add_heave_compensation(name="ahc", body="ship", point=(0, 0, 20.0), winch="hoist", **steered)
    return scene


for one in ONE_CALL:  # those that have no scene above
    if one.name not in globals():
        sample = SAMPLES[one.name.replace("_", " ")]
        case(name=one.name)(lambda sample=sample: sample.scene(sample.numbers))
