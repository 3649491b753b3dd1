"""A ship lifts 40 t off a feeder at heading 180, in 20 seas: peak of the hook load, and does it hit again?"""

import numpy as np

from seacrane import Scene, Stage, Until, ensemble, shipped_database
from seacrane.crane import load_crane
from seacrane.statistics import seed_extremes

MASS, EA, RATE, DECK, REACH, G = 40e3, 2e8, 0.5, 6.0, 28.0, 9.80665  # kg, N, m/s, m up, m to port, m/s2
SHIP = shipped_database()  # of both here; each may have its own

scene = Scene(name="feeder")
scene.add_vessel(SHIP, name="ship")
crane = load_crane("lattice_boom_100t")
scene.add_crane(crane, base="ship", foot=(20, 9, 8), coordinates={"slew": -np.pi / 2, "boom": 1.0})
scene.add_ballast()
x, y, _ = scene.place_of("tip")
scene.add_vessel(SHIP, name="feeder", position=(x, y, 0), heading_deg=180, mooring=60)
scene.add_hoist(mass=MASS, size=(6, 6, 6), on="feeder", height=DECK, EA=EA, slack=1.0, winch={"lag": 0.2})
scene.add_sea(vessel="ship", hs=1.2, tp=7.0, direction_deg=180.0)
scene.add_sea(vessel="feeder")
for i, at in enumerate(((3, 3, -3), (3, -3, -3), (-3, 3, -3), (-3, -3, -3))):
    scene.add_point(name=f"corner {i}", body="load", point=at)
box = {"body": "feeder", "center": (0, 0, DECK - 5), "size": (60, 18, 10)}
scene.add_channel("deck", points=[f"corner {i}" for i in range(4)], **box)
free = Until.release("load on feeder")
lift = Stage(name="lift", until=free, maximum_duration=60.0, commands={"hoist.rate": -RATE})


def by_hand(result):
    """Weight, and what a mass on a spring takes of the speed and the push of the deck at lift-off, N."""
    at = np.searchsorted(result.time, result.stages[1].end)
    k, rise = EA / result["line_unstretched_length"][at, 0], result.select("velocity", body="load", axis="z")
    push = MASS * np.gradient(rise, result.time)[at - 3]
    speed = RATE + result.select("tip_velocity", axis="z")[at] - rise[at]
    return MASS * G + np.hypot(push, speed * np.sqrt(k * MASS))


def gap(result):
    """Least clearance from half a second after lift-off on, m: below zero the load hits the deck again."""
    return result["clearance"][result.time > result.stages[1].end + 0.5].min()


lifts = ensemble(scene, stages=[Stage(name="wait", duration=60.0), lift, Stage(name="up", duration=25.0)],
                 over={"seed": range(20)}, dt_out=0.02, rtol=1e-4,
                 keep={"peak": "hook_load[hoist].max", "by_hand": by_hand, "gap": gap})  # fmt: skip
data, words = lifts.dataset, {"static": MASS * G / 1e3, "name": "hook load", "unit": "kN"}
print(seed_extremes(data.peak.to_numpy() / 1e3, duration=25.0, **words))
print(f"peaks are {float((data.by_hand / data.peak - 1).mean()):.1%} below those by hand without damping")
print(f"the load comes back to the deck in {int((data.gap < 0).sum())} of 20 seas")
