"""A hose of the main cylinder bursts under a load: how fast it comes down, what a load-holding valve does.

Usage: python hydraulic_knuckle_boom.py [FOLDER FOR A PICTURE]
"""

import sys
import warnings
from pathlib import Path

import numpy as np

from seacrane import Curve, Scene, simulate
from seacrane.crane import Payload
from seacrane.scene import Counterbalance, Piston, Pump, Relief, Rupture, Valve
from seacrane.warnings import BoilingOilWarning

BURST, END = 20.0, 40.0  # s
HOLE, DISCHARGE, DENSITY = np.pi / 4.0 * 0.02**2, 0.6, 870.0  # m2: 20 mm; -, kg/m3
OPEN = Curve.quintic(start_time=2.0, end_time=4.0, start=0.0, end=0.2)  # spool of the main cylinder
SPOOL = OPEN.then(time=14.0, curve=Curve.quintic(start_time=14.0, end_time=16.0, start=0.2, end=0.0))
LOAD = Payload(mass=50e3)
OIL = {
    "pump": Pump(pressure=32e6, makeup_flow=0.05), "relief": Relief(pressure=35e6, flow=0.05),
    "valve": Valve(rated_flow=0.03, rated_drop=1e6, spool_lag=0.03), "piston": Piston(viscous_friction=2e6),
}  # fmt: skip
HOLDING = {"counterbalance": Counterbalance(pressure=30e6, flow=0.05)}


def lift(**valves: Counterbalance) -> Scene:
    """50 t that the crane lifts by its main cylinder, whose hose bursts after that."""
    scene = Scene(name="hose burst")
    main = OIL | {"command": SPOOL, "rupture": Rupture(time=BURST, area=HOLE)} | valves
    scene.add_crane(
        base="ground", s1=2.0, s2=3.0, payload=LOAD, held=True, hydraulics={"main": main, "knuckle": OIL}
    )
    scene.add_point(name="load", body="payload")
    return scene


warnings.simplefilter("ignore", BoilingOilWarning)  # the rod side of a cylinder whose hose has burst
runs = {
    name: simulate(lift(**valves), t_end=END, dt_out=0.05, rtol=1e-5)
    for name, valves in (("hose at the cylinder", {}), ("behind a load-holding valve", HOLDING))
}
time = next(iter(runs.values())).time
area = lift().loads["main_cylinder"].full_area
print(f"{'':28} {'pressure':>10} {'comes in by':>12} {'by the orifice':>15} {'load falls':>11}")
for name, result in runs.items():
    stroke = result.select("hydraulic_stroke", hydraulic_cylinder="main_cylinder")
    pressure = result.select("hydraulic_pressure", hydraulic_cylinder="main_cylinder", chamber="full")
    height = result.select("position", body="payload", axis="z")
    late = (time > BURST + 8.0) & (time < BURST + 16.0)
    speed = -np.polyfit(time[late], stroke[late], 1)[0]
    orifice = DISCHARGE * HOLE / area * np.mean(np.sqrt(2.0 * (pressure[late] - 1e5) / DENSITY))
    fallen = height[time < BURST][-1] - height[-1]
    rate = f"{1e3 * orifice:11.2f} mm/s" if "holding" not in name else f"{'closed':>15}"
    print(
        f"{name:28} {np.mean(pressure[late]) / 1e5:6.1f} bar {1e3 * speed:7.2f} mm/s {rate} {fallen:9.3f} m"
    )

lifting = next(iter(runs.values()))
flow = lifting["hydraulic_pump_flow"].sum(axis=1)
power = (OIL["pump"].pressure - 1e5) * flow
before = time < BURST
print(
    f"pump over the lift: at most {6e4 * flow[before].max():.0f} l/min and "
    f"{power[before].max() / 1e3:.0f} kW, {np.trapezoid(power[before], time[before]) / 1e6:.2f} MJ in all"
)

if len(sys.argv) > 1:
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(3, 1, sharex=True, figsize=(7.0, 7.5))
    for name, result in runs.items():
        cylinder = {"hydraulic_cylinder": "main_cylinder"}
        axes[0].plot(time, result.select("hydraulic_stroke", **cylinder), label=name)
        pressure = result.select("hydraulic_pressure", **cylinder, chamber="full")
        axes[1].plot(time, pressure / 1e5, label=name)
        axes[2].plot(time, 6e4 * result.select("hydraulic_spill", **cylinder), label=name)
    for axis, label in zip(
        axes, ("stroke [m]", "pressure, full side [bar]", "lost oil [l/min]"), strict=True
    ):
        axis.axvline(BURST, color="0.6", linestyle=":")
        axis.set_ylabel(label)
    axes[0].legend()
    axes[2].set_xlabel("time [s]")
    figure.savefig(Path(sys.argv[1]) / "hydraulic_knuckle_boom.png", bbox_inches="tight")
