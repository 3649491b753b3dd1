"""A hose of the main cylinder bursts under 50 t on a ship in waves: how fast does it come in, by the hole?"""

import warnings

import numpy as np

from seacrane import Scene, shipped_database, simulate
from seacrane.scene import Counterbalance, Piston, Pump, Rupture, Valve
from seacrane.warnings import BoilingOilWarning

BURST, END, DISCHARGE, DENSITY = 20.0, 40.0, 0.6, 870.0  # s, s, -, kg/m3
PUMP, VALVE = Pump(pressure=32e6, makeup_flow=0.05), Valve(rated_flow=0.03, rated_drop=1e6)
OIL = {"pump": PUMP, "valve": VALVE, "piston": Piston(viscous_friction=2e6)}
HOLDING = Counterbalance(pressure=30e6, flow=0.05)
warnings.simplefilter("ignore", BoilingOilWarning)  # of the rod side, which is sucked empty


def lift(hole: float, valve: Counterbalance | None) -> Scene:
    """A hole (m2) in the hose of the main cylinder."""
    main = OIL | {"rupture": Rupture(time=BURST, area=hole), "counterbalance": valve}
    scene = Scene(name="hose burst")
    scene.add_vessel(shipped_database())
    scene.add_crane(slew=-np.pi / 2, s1=2.0, s2=2.5, hydraulics={"main": main, "knuckle": OIL})
    scene.add_hoist(mass=50e3, size=(4, 4, 4), length=10.0, EA=4e8)
    scene.add_ballast()
    scene.hold_pressures()
    scene.add_sea(hs=1.5, tp=7.0, direction_deg=180.0)
    return scene


for diameter, valve in ((0.01, None), (0.02, None), (0.03, None), (0.03, HOLDING)):
    scene = lift(hole := np.pi / 4 * diameter**2, valve)
    result = simulate(scene, t_end=END, start="rest", dt_out=0.05, rtol=1e-5)
    late = (result.time > BURST + 1.0) & (result.time < BURST + 8.0)
    stroke = result.curve("hydraulic_stroke[main_cylinder]")[late]
    pressure = result.curve("hydraulic_pressure[main_cylinder, full]")[late]
    speed, area = -np.polyfit(result.time[late], stroke, 1)[0], scene.loads["main_cylinder"].full_area
    hand = 0.0 if valve else DISCHARGE * hole / area * np.sqrt(2 * (pressure - 1e5) / DENSITY).mean()
    name = f"{1e3 * diameter:.0f} mm{', behind a load-holding valve' if valve else ''}"
    print(f"hole of {name}: {1e3 * speed:.1f} mm/s, by hand {1e3 * hand:.1f} mm/s")
