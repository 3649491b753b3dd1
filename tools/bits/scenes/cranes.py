"""The paper's cases, and cranes: on land and afloat, driven, on oil and on ropes."""

from __future__ import annotations

import numpy as np

from bits.case import by, case
from bits.scenes.parts import G, ramp, waving
from seacrane import Payload, Scene, cases, shipped_database
from seacrane.crane import load_crane
from seacrane.scene import Piston, Pump, Rupture, Valve

OUT = -np.pi / 2.0
OIL = {
    "pump": Pump(pressure=32e6), "valve": Valve(rated_flow=0.03, rated_drop=1e6),
    "piston": Piston(viscous_friction=2e6),
}  # fmt: skip

for name, second in (
    ("case1", by("rk4", "redundant", dt=0.02)),
    ("case2", by("ida", "redundant")),
    ("case3", by("cvode-bdf", "redundant")),
):
    case(by("dopri5"), second, t_end=5.0, dt_out=0.1, name=name)(lambda name=name: getattr(cases, name)())


@case(by("dopri5", "redundant"), by("rk4", "redundant", dt=0.02), t_end=5.0, dt_out=0.1)
def case2_by_its_paper() -> Scene:
    return cases.case2(kinematics="paper", memory="none", feed_forward="start")


@case(by("dopri5"), by("rk4", "redundant", dt=0.02), t_end=3.0, dt_out=0.1)
def driven_on_land() -> Scene:
    """A crane led by drivers, its load on a rod."""
    scene = Scene(name="crane", gravity=G)
    scene.add_crane(base="ground", payload=Payload(mass=10e3))
    for joint, end in (("A", -0.3), ("main_cylinder", 0.1), ("knuckle_cylinder", 0.1)):
        scene.add_driver(joint=joint, name=joint, curve=ramp(end, last=2.5))
    return scene


@case(by("dopri5"), by("rk4", dt=0.01), t_end=3.0, dt_out=0.1)
def hoist_on_four_falls() -> Scene:
    scene = Scene(name="hoist", gravity=G)
    scene.add_vessel(motion="rest")
    scene.add_crane(slew=OUT, s1=1.0, s2=2.0, held=True)
    wire = {"falls": 4, "EA": 6e7, "block_mass": 2e3, "winch": {"rate": ramp(-0.5), "maximum_rate": 1.0}}
    slings = {"angle_deg": 60.0, "EA": 1e8}
    scene.add_hoist(mass=50e3, size=(6, 4, 4), length=20.0, slings=slings, **wire)
    return scene


@case(by("dopri5"), by("tsit5"), t_end=3.0, dt_out=0.1)
def luffing_rope() -> Scene:
    """A lattice boom on its rope, which a winch hauls in."""
    scene = Scene(name="lattice", gravity=G)
    load = Payload(mass=60e3, size=(4.0, 4.0, 3.0), link_length=20.0)
    crane = load_crane("lattice_boom_100t")
    scene.add_crane(crane, base="ground", coordinates={"boom": 0.8}, payload=load, held=True)
    scene.add_winch("luffing rope", rate=ramp(-1.0), lag=0.3)
    return scene


@case(by("dopri5-stiff", rtol=1e-5), by("rosenbrock", rtol=1e-4), t_end=2.0, start="rest")
def on_oil_in_waves() -> Scene:
    """Cylinders of oil that hold a load over the side; a hose bursts."""
    burst = {
        "rupture": Rupture(time=1.0, area=3e-4, discharge_coefficient=0.6),
        "pump": Pump(pressure=32e6, makeup_flow=0.05),
    }
    scene = Scene(name="oil", gravity=G)
    scene.add_vessel(shipped_database(), memory="none")
    scene.add_crane(slew=OUT, s1=2.0, s2=2.5, hydraulics={"main": OIL | burst, "knuckle": OIL})
    scene.add_hoist(mass=50e3, size=(4, 4, 4), length=10.0, EA=4e8)
    scene.add_ballast()
    scene.hold_pressures()
    scene.add_sea(hs=1.5, tp=7.0, direction_deg=180.0, count=50)
    return scene


@case(by("dopri5", rtol=1e-5), by("rk4", dt=0.01), t_end=3.0, dt_out=0.1)
def compensated_by_a_cylinder() -> Scene:
    scene = Scene(name="compensated", gravity=G)
    scene.add_body(name="ship", mass=1e6, inertia=(1e7, 1e8, 1e8))
    scene.add_joint(kind="prismatic", name="sea", first="ground", second="ship", axis=(0, 0, 1))
    scene.add_driver(joint="sea", curve=waving(0.3, 0.9))
    jib, head = scene.add_crane(base="ship", slew=OUT, s1=3.0, s2=3.8).tip
    tip = scene.place_of("tip")
    scene.add_body(name="load", mass=20e3, inertia=(1e4,) * 3, position=np.asarray(tip) - [0.0, 0.0, 12.0])
    scene.add_line(name="hoist", bodies=[jib, "load"], points=[head, (0, 0, 0)], EA=4e8, length=12.0)
    scene.add_actuator(joint="knuckle_cylinder", stiffness=3e7, damping=4e6, feed_forward=-1e6)
    scene.add_heave_compensation(
        name="ahc", body="ship", point=tip, actuator="knuckle_cylinder", lag=0.1, high_pass=0.03
    )
    return scene
