"""Three hours of one sea state: significant and largest hook load and motions, beside linear statistics."""

import numpy as np

from seacrane import Scene, response_statistics, shipped_database, simulate, summary
from seacrane.crane import Payload
from seacrane.sea import jonswap

MASS, HS, TP, START, END = 50e3, 1.5, 7.0, 600.0, 600.0 + 3.0 * 3600.0  # kg, m, s, s, s

scene = Scene(name="three hours")
scene.add_vessel(shipped_database())
load = Payload(mass=MASS, link_length=25.0)
crane = scene.add_crane(slew=-np.pi / 2, s1=1.0, s2=2.0, payload=load, held=True)
scene.add_ballast()
scene.add_sea(hs=HS, tp=TP, direction_deg=180.0, count=300)
result = simulate(scene, t_end=END, dt_out=0.5)  # a loose tolerance would feed the load's rocking
print(summary(result, after=START))

sea = {"spectrum": jonswap(hs=HS, tp=TP), "direction": np.pi}  # by hand: the linear model
heave = response_statistics(scene, **sea, body=crane.tip[0], point=crane.tip[1])
motion = response_statistics(scene, **sea, body="vessel")
turns = np.degrees(motion.std)
for name, values, std in (
    (
        "hook load, kN",
        result["link_tension"] / 1e3,
        MASS * np.sqrt(heave.moments[2, 2]) / 1e3,
    ),  # m times heave''
    ("heave, m", result.select("vessel_motion", motion="heave"), motion.std[2]),
    ("pitch, deg", np.degrees(result.select("vessel_motion", motion="pitch")), turns[4]),
):
    above = (values - values[result.time > START].mean())[result.time > START]
    waves = np.split(above, np.flatnonzero((above[:-1] < 0.0) & (above[1:] >= 0.0)) + 1)[1:-1]
    crests = np.sort([wave.max() for wave in waves])
    told = crests[-len(crests) // 3 :].mean(), 2.0 * std, crests[-1], std * np.sqrt(2.0 * np.log(len(crests)))
    print("{:14} significant {:6.3f}, by hand {:6.3f}; largest {:6.3f}, by hand {:6.3f}".format(name, *told))
