"""100 t is lost off a winch's wire to port: how the ship rolls back, and what the crane's cylinder held."""

import numpy as np

from seacrane import Scene, Stage, natural_modes, shipped_database, simulate, statics
from seacrane.crane import load_crane
from seacrane.scene import Oil, Piston, Pump, Valve

MASS, HEEL, POSE = 100e3, -3.0, {"s1": 1.5, "s2": 3.0}  # kg, deg, m
PUMP, SEALS = Pump(pressure=32e6), Piston(viscous_friction=2e6)
OIL = {"pump": PUMP, "valve": Valve(rated_flow=0.03, rated_drop=1e6), "oil": Oil(air=0.002), "piston": SEALS}


def ship(load: float) -> Scene:
    """Ship and crane, at a heel with the load, upright without one."""
    scene = Scene(name="loss of load")
    scene.add_vessel(shipped_database())
    scene.add_crane(slew=-np.pi / 2, **POSE, hydraulics={"main": OIL, "knuckle": OIL})
    if load:
        scene.add_hoist(mass=load, size=(5, 5, 5), length=12.0, EA=1e9)
    scene.add_ballast(heel_deg=HEEL if load else 0.0)
    scene.hold_pressures()
    return scene


scene, bare = ship(MASS), ship(0.0)
stages = [Stage(name="hang", duration=20.0), Stage(name="lost", duration=60.0, release=["hoist"])]
result = simulate(scene, stages, start="rest", dt_out=0.02, integrator="rosenbrock")
roll, lost = np.degrees(result.curve("roll")), result.stage("lost")
peak = roll[lost].argmax()

mode = (modes := natural_modes(bare)).find("vessel roll")
oil, arm = scene.loads["main_cylinder"], result.place_of("tip")[0, 1]  # m to port, at the heel
back = np.degrees(MASS * arm / (statics(bare)["GM"].item() * bare.bodies["vessel"].mass))
swings = np.exp(-np.pi * modes.damping_ratio[mode])  # of what is left after half a period
main, _ = load_crane().static_cylinder_forces(**POSE, payload_mass=MASS)
rod = 0.1 * PUMP.pressure * oil.rod_side_area  # what the side that carries nothing has
pressure = result.select("hydraulic_pressure", hydraulic_cylinder="main_cylinder", chamber="full")[0]
for name, run, by_hand in (
    ("first peak of roll, deg", roll[lost][peak], HEEL + back * (1 + swings)),
    ("reached after, s", result.time[lost][peak] - 20.0, modes.damped_period[mode] / 2),
    ("mean of the last 15 s, deg", roll[-750:].mean(), HEEL + back),
    ("main cylinder before, bar", pressure / 1e5, (main + rod) / oil.full_area / 1e5),
):
    print(f"{name:27} {run:7.2f}, by hand {by_hand:7.2f}")
