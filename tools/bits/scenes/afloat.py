"""Ships: free in waves by each kind of memory, given, moored, and two in one water."""

from __future__ import annotations

import numpy as np

from bits.case import by, case
from bits.scenes.parts import HULL_IN_FLOW, G
from seacrane import MotionHistory, MotionRaos, Scene, SeaState, WaveSystem, cases, shipped_database
from seacrane.hydro import two_barges
from seacrane.sea import cos_2s, jonswap

SEA = {"hs": 2.0, "tp": 8.0, "seed": 1, "count": 60}
SECONDS = (by("rk4", "redundant", dt=0.05), by("bs32", "redundant"))

for memory, second in zip(("per-pair", "convolution"), SECONDS, strict=True):
    case(by("dopri5"), second, t_end=8.0, dt_out=0.2, name=f"memory_{memory}")(
        lambda memory=memory: cases.vessel(memory=memory, **SEA)
    )


@case(by("dopri5"), by("rk4", dt=0.05), t_end=8.0, dt_out=0.2)
def memory_by_motion_in_two_seas() -> Scene:
    """Short-crested wind sea and swell, wind and current on the hull."""
    areas = {"frontal_area": 400.0, "lateral_area": 1200.0, "length": 115.0}
    short, long = jonswap(hs=1.8, tp=6.5, gamma="dnv"), jonswap(hs=1.0, tp=13.0, gamma=5.0)
    wind = WaveSystem(spectrum=short, direction_deg=180.0, spreading=cos_2s(6.0), name="wind sea")
    swell = WaveSystem(spectrum=long, direction_deg=250.0, name="swell")
    scene = Scene(name="two seas", gravity=G)
    scene.add_vessel(shipped_database())
    scene.add_sea(sea=SeaState(systems=[wind, swell], seed=1))
    scene.add_wind(coefficients=HULL_IN_FLOW, speed=12.0, direction_deg=90.0, **areas)
    scene.add_current(coefficients=HULL_IN_FLOW, speed=0.5, direction_deg=0.0, **areas)
    return scene


@case(by("dopri5"), by("tsit5", "redundant"), t_end=5.0, dt_out=0.1)
def given_by_raos() -> Scene:
    """A load below a barge that moves by its RAOs."""
    omega = [0.3, 0.5, 0.7, 0.9, 1.1, 1.4, 1.8, 2.4]
    heave = [0.98, 0.92, 0.80, 0.60, 0.38, 0.15, 0.02, 0.0]
    raos = MotionRaos(omega=omega, heading=[np.pi], values=np.outer(heave, [0, 0, 1, 0, -0.02j, 0])[None])
    scene = Scene(name="given", gravity=G)
    scene.add_vessel(motion=raos, name="barge", duration=60.0)
    scene.add_sea(vessel="barge", hs=2.0, tp=9.0, direction_deg=180.0, seed=4)
    load = (30.0, 20.0, 22.0)
    scene.add_body(name="load", mass=50e3, inertia=(1e5,) * 3, position=load)
    rod = {"point": (30.0, 20.0, 25.0), "second_point": load}
    scene.add_joint(kind="distance", name="wire", first="barge", second="load", **rod)
    scene.add_point(name="edge", body="barge", point=(30.0, 10.0, 3.0))
    scene.add_point(name="below", body="load", point=(0, 0, -1.0))
    scene.add_channel("over the edge", expression="below.z in barge - edge.z in barge")
    scene.add_channel("deck", points="below", body="barge", center=(0, 0, 0), size=(90, 18, 10))
    scene.add_channel(name="drop", expression="edge.z - below.z")
    return scene


@case(by("dopri5"), by("rk4", dt=0.02), t_end=5.0, dt_out=0.1)
def given_by_a_record() -> Scene:
    time = np.arange(0.0, 20.0, 0.25)
    motion = np.outer(np.sin(0.7 * time), [0, 0, 0.5, 0.03, 0.01, 0]) + np.outer(
        np.cos(0.5 * time), [0.2, 0, 0, 0, 0, 0.01]
    )
    scene = Scene(name="record", gravity=G)
    scene.add_vessel(motion=MotionHistory(time=time, motion=motion), ramp=2.0)
    scene.add_crane(slew=-np.pi / 2.0, s1=1.0, s2=2.0)
    scene.add_hoist(mass=20e3, size=(1.6, 1.6, 1.2), length=12.0, stiffness=4e6)
    return scene


@case(by("dopri5"), by("rk4", "redundant", dt=0.05), t_end=6.0, dt_out=0.2)
def moored_by_lines() -> Scene:
    scene = Scene(name="moored", gravity=G)
    scene.add_vessel(shipped_database(), mooring=None, memory="none")
    for x, y in ((1, 1), (1, -1), (-1, 1), (-1, -1)):
        ends = {
            "bodies": ["ground", "vessel"],
            "points": [(x * 150.0, y * 110.0, 0.0), (x * 50.0, y * 10.0, 0.0)],
        }
        scene.add_line(f"line {x} {y}", **ends, EA=4e7, tension_at_start=4e5)
    scene.add_sea(direction_deg=120.0, **SEA)
    return scene


@case(by("dopri5", rtol=1e-5), by("rk4", "redundant", dt=0.05), t_end=5.0, dt_out=0.2)
def two_ships_in_one_sea() -> Scene:
    """Each as if alone, the second turned."""
    scene = Scene(name="two ships", gravity=G)
    scene.add_vessel(shipped_database(), memory="none")
    scene.add_vessel(
        shipped_database(), name="feeder", position=(-15.0, 45.0, 0.0), heading_deg=170.0, memory="none"
    )
    scene.add_sea(direction_deg=150.0, **SEA)
    scene.add_sea(vessel="feeder")
    return scene


@case(by("dopri5", rtol=1e-4), by("rk4", "redundant", dt=0.05), t_end=4.0, dt_out=0.2)
def group_in_one_water() -> Scene:
    """Two barges that feel each other's motions and waves."""
    scene = Scene(name="group", gravity=9.81)
    scene.add_vessel(two_barges(lid_damping=0.01), mooring=60.0)
    for vessel in scene.vessels:
        scene.add_sea(vessel=vessel, hs=1.0, tp=8.0, direction_deg=-120.0, seed=1, count=40)
    return scene
