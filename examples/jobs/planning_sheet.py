"""A planning sheet: heel, three-hour factor of the hook load, allowable seas, and their windows in a year.

By hand the hook load follows the tip of the linear model, with Rayleigh's maximum, and windows are counted
in a loop over the hours.
"""

import numpy as np

import seacrane as sc
from seacrane.operability import AlphaFactor, WaveHindcast
from seacrane.sea import jonswap

MASS, START, HOURS, HS, TP, FACTOR = 50e3, 600.0, 12, 1.5, 7.0, 1.1  # kg, s, h, m, s, of the hook load
scene = sc.Scene(name="planning sheet")
scene.add_vessel(sc.shipped_database())
tip = scene.add_crane(slew=-np.pi / 2, s1=1.0, s2=2.0).tip
scene.add_ballast()  # upright without the load
scene.add_hoist(mass=MASS, size=(4, 4, 3), length=20.0, EA=4e8, rung="quasi-static")
weight, rest = MASS * scene.gravity, sc.statics(scene)
arm = scene.place_of("tip")[1]
heel = -np.degrees(MASS * arm / rest["GM"].item() / scene.bodies["vessel"].mass)
print(f"heel {np.degrees(rest['heel'].item()):.2f} deg, by hand {heel:.2f} deg")

scene.add_sea(hs=HS, tp=TP, direction_deg=180.0, count=300)
run = sc.simulate(scene, t_end=START + 10800.0, start="rest", dt_out=0.5, channels=["hook_load"])
factor = sc.extremes(run, channel="hook_load", suspension="hoist", after=START).maximum.mpm.value / weight
sea = {"spectrum": jonswap(hs=HS, tp=TP), "direction": np.pi}
speed, push = np.sqrt(sc.response_statistics(scene, **sea, body=tip[0], point=tip[1]).moments[2, 1:])
hand = 1.0 + push / scene.gravity * np.sqrt(2 * np.log(10800.0 / (2 * np.pi) * push / speed))
print(f"three-hour factor {factor:.3f}, by hand {hand:.3f}")

hook = sc.Criterion(channel="hook_load", maximum=FACTOR * weight)
roll = sc.Criterion(channel="vessel_motion", names={"motion": "roll"}, maximum=np.radians(2.0), motion=True)
grid = {
    "tp": [5.0, 8.0, 11.0, 14.0],
    "direction_deg": [90.0, 135.0, 180.0],
    "hs": [4.0],
    "hours": float(HOURS),
}
alpha = AlphaFactor(values=0.8, source="made up")
print(table := sc.allowable_hs(scene, criteria=[hook, roll], **grid, domain="frequency", alpha=alpha))
time = np.arange("2025-01", "2026-01", dtype="datetime64[h]")
noise = np.random.default_rng(1).normal(size=time.size + 47)
level = np.exp(0.5 * np.convolve(noise, np.ones(48) / np.sqrt(48), "valid"))  # of storms that last days
hs, tp = 1.2 * level, 5.0 + 2.0 * level
windows = sc.weather_windows(WaveHindcast(time=time, hs=hs, tp=tp, source="made up"), table)
calm = [h <= 0.8 * limit for h, limit in zip(hs, table.at(tp), strict=True)]
hand = sum(all(calm[i : i + HOURS]) for i in range(len(calm) - HOURS + 1)) / len(calm)
print(f"may start in {windows.may_start_percent:.2f} % of the year, by hand {100 * hand:.2f} %")
