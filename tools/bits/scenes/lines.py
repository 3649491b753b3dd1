"""Lines, winches, sheaves and slings, in air and with mass."""

from __future__ import annotations

from typing import Any

import numpy as np

from bits.case import by, case
from bits.scenes.parts import G, heaving, ramp, waving, with_load
from seacrane import Curve, Scene

OVER = (0.0, 1.0, 0.0)


@case()
def tugger() -> Scene:
    """A load that swings on its hoist, held by a winch of a tension."""
    scene = with_load((1.0, 0.0, -19.9), mass=20e3)
    path = {"bodies": ["ground", "load"]}
    scene.add_line(name="hoist", points=np.zeros((2, 3)), EA=2e8, length=19.9, **path)
    scene.add_line(name="tugger", points=[(40, 0, -20), (0, 0, 0)], EA=5e6, length=38.9, **path)
    scene.add_winch(line="tugger", tension=1e4, tension_gain=7e-4, maximum_rate=1.5, dead_band=500.0, lag=0.1)
    return scene


@case(by("dopri5"), by("rk4", "redundant", dt=2.5e-3))
def drum_and_brake() -> Scene:
    scene = with_load((0, 0, -10.0), mass=5e3)
    scene.add_line(name="hoist", bodies=["ground", "load"], points=np.zeros((2, 3)), EA=2e6, length=9.8)
    scene.add_winch(
        line="hoist", rate=ramp(-0.3), lag=0.2, drum_inertia=2e3, drum_radius=0.5, maximum_tension=9e4,
        maximum_power=5e4, brake=ramp(1.0, begin=1.2, last=1.4), brake_capacity=8e4, brake_give=2e-3,
    )  # fmt: skip
    return scene


def arm() -> Scene:
    """A swinging arm that carries a block, and a load."""
    scene = Scene(name="reeved", gravity=G)
    scene.add_body(name="arm", mass=800.0, inertia=(50.0, 900.0, 900.0), position=(2.0, 0.0, 0.0))
    scene.add_joint(kind="revolute", name="pin", first="ground", second="arm", point=(0, 0, 0), axis=OVER)
    scene.add_actuator(joint="pin", stiffness=4e6, damping=3e5)
    scene.add_body(name="cleat", mass=50.0, inertia=(5.0, 5.0, 5.0), position=(3.5, 0.0, 0.2))
    scene.add_joint(kind="weld", name="bolts", first="arm", second="cleat", point=(3.5, 0, 0))
    scene.add_body(name="load", mass=1500.0, inertia=(200.0, 250.0, 300.0), position=(4.2, 0.3, -5.0))
    return scene


WINCH: dict[str, Any] = {
    "rate": Curve.harmonic(start_time=0.0, offset=0.0, amplitude=0.5, omega=2.1), "maximum_rate": 0.4,
    "maximum_acceleration": 0.6, "lag": 0.15,
}  # fmt: skip


@case()
def sheaves() -> Scene:
    """Sheaves that lean out of the line's plane, with friction; a cord by a table."""
    scene = arm()
    scene.add_line(
        name="hoist", bodies=["ground", "arm", "cleat", "load", "cleat"], EA=3e6, length=14.75,
        points=[(0.0, 0.0, 0.0), (-0.5, 0.0, 0.8), (0.3, 0.0, 0.1), (0.0, 0.0, 0.5), (0.9, 0.2, 0.1)],
        sheaves={"radii": [0, 0.2, 0.25, 0.2, 0], "efficiencies": [1, 0.98, 1, 0.96, 1],
        "frictions": [0, 0, 0.03, 0, 0],
        "axes": [(0, 0, 0), (0.0, 1.0, 0.1), (0.1, 1.0, 0.1), (0.2, -1.0, 0.1), (0, 0, 0)],
        "slip_speed": 0.05},
    )  # fmt: skip
    scene.add_winch(line="hoist", **WINCH)
    cord = {"strains": [0.0, 0.1, 0.3, 0.8], "tensions": [0.0, 300.0, 700.0, 3000.0], "length": 5.0}
    scene.add_line(name="cord", bodies=["ground", "load"], points=[(10.0, 3.0, -5.0), (0.5, 0, 0)], **cord)
    return scene


@case(by("dopri5"), by("bs32", "redundant"))
def quasi_static() -> Scene:
    """A stiff line over points of three bodies whose stretch follows its tension."""
    scene = arm()
    scene.add_line(
        name="hoist", bodies=["ground", "cleat", "load", "cleat"], EA=3e8, tension_at_start=7.3e3,
        points=[(0.0, 0.0, 2.0), (0.3, 0.0, 0.1), (0.0, 0.0, 0.5), (0.4, 0.2, 0.1)], rung="quasi-static",
    )  # fmt: skip
    scene.add_winch(line="hoist", rate=ramp(-0.1, last=1.7), lag=0.15)
    return scene


@case(by("dopri5"), by("rk4", "redundant", dt=5e-3), t_end=3.0)
def slings_that_go_slack() -> Scene:
    """A block on a wire, four slings to a load that is thrown up."""
    scene = with_load((0, 0, -17.5), mass=8e3, velocity=(0.5, 0.2, 0.6))
    scene.add_body(name="hook", mass=500.0, inertia=(50.0,) * 3, position=(0, 0, -12.0))
    scene.add_line(name="wire", bodies=["ground", "hook"], points=np.zeros((2, 3)), EA=5e6, length=11.8)
    corners = [(x, y, 0.5) for x in (-2.0, 2.0) for y in (-1.5, 1.5)]
    for i, corner in enumerate(corners, start=1):
        ends = {"bodies": ["hook", "load"], "points": [(0, 0, 0), corner]}
        scene.add_line(f"sling {i}", **ends, EA=3e6, mass=2e3)
    return scene


@case(by("dopri5"), by("cvode-bdf", "redundant"))
def with_mass_in_wind() -> Scene:
    """Segments with mass and drag below a tip that heaves."""
    scene = heaving()
    scene.add_body(name="load", mass=400.0, inertia=(90.0, 80.0, 70.0), position=(4.0, 0.0, -15.0))
    scene.add_line(
        name="wire", bodies=["ship", "load"], points=np.zeros((2, 3)), EA=2e5, length=15.4,
        wire={"mass_per_length": 10.0, "segments": 4, "diameter": 0.3, "flow": (12.0, 3.0, 0.0)},
        damping_ratio=0.05,
    )  # fmt: skip
    return scene


def wet(scene: Scene, length: Any) -> Scene:
    """A load on a line with mass through the surface."""
    scene.add_body(
        name="load", mass=400.0, inertia=(90.0, 80.0, 70.0), position=(8.0, 1.0, -3.0),
        velocity=(-1.0, 2.0, 1.0), angular_velocity=(0.4, -0.3, 0.6),
    )  # fmt: skip
    wire = {"mass_per_length": 40.0, "diameter": 0.25, "segments": 4, "medium": "sea"}
    scene.add_line("wire", "ground", "load", first_point=(0.0, 0.0, 5.0), second_point=(0.1, -0.2, 0.4),
                   EA=2e5, length=length, wire=wire)  # fmt: skip
    return scene


def waves() -> Scene:
    scene = Scene(name="waves", gravity=G)
    scene.add_sea(vessel=None, hs=1.5, tp=5.0, count=20, seed=3, direction_deg=30.0, gamma=2.0)
    return scene


@case(by("dopri5"), by("dop853", "redundant"))
def paid_out_in_waves() -> Scene:
    return wet(waves(), length=ramp(13.0, start=11.0, last=4.0))


@case()
def wound_by_a_winch() -> Scene:
    scene = wet(waves(), length=11.0)
    scene.add_winch(line="wire", rate=ramp(0.6), lag=0.2)
    return scene


@case(by("dopri5"), by("rosenbrock", rtol=1e-4))
def chain_on_the_seabed() -> Scene:
    """An end that sways above a chain that lies on the bottom."""
    scene = Scene(name="chain", gravity=G)
    scene.add_body(name="end", mass=1e3, inertia=(1e3,) * 3, position=(60.0, 0.0, 0.0))
    scene.add_joint(
        kind="prismatic", name="guide", first="ground", second="end", point=(60, 0, 0), axis=(1, 0, 0)
    )
    scene.add_driver(joint="guide", curve=waving(1.0, 1.2))
    bed = {"depth": 30.0, "stiffness": 5e4, "friction": 0.6, "damping_ratio": 0.4, "give": 0.05}
    scene.add_line(
        name="chain", bodies=["ground", "end"], points=[(0, 0, -30.0), (0, 0, 0)], EA=1e7, length=75.0,
        wire={"mass_per_length": 60.0, "segments": 6, "seabed": bed}, damping_ratio=0.1,
    )  # fmt: skip
    return scene
