"""Lower 20 t from a ship in waves to 50 m below the surface: winch and elastic wire, without water loads."""

import numpy as np

from seacrane import Scene, Stage, Until, shipped_database, simulate

MASS, EA, START, DEPTH, RATE = 20e3, 40e9 * 0.035**2, 5.0, 50.0, 0.5  # kg, N (35 mm), m, m, m/s

scene = Scene(name="subsea lowering")
scene.add_vessel(motion=shipped_database())
scene.add_sea(hs=2.0, tp=8.0, direction_deg=165.0, seed=3)
scene.add_crane(slew=-np.pi / 2, s1=1.0, s2=2.0)
tip = scene.place_of("tip")[2]
strain = MASS * scene.gravity / EA
first, deep = (tip - START) / (1.0 + strain), (tip + DEPTH) / (1.0 + strain)
scene.add_hoist("wire", mass=MASS, size=(3, 3, 2), length=tip - START, EA=EA, winch={"lag": 0.2})
lower = Stage(
    name="lower", until=Until.length("wire", minimum=deep), maximum_duration=300, commands={"wire.rate": RATE}
)
stop = Stage(name="stop", duration=30.0, commands={"wire.rate": 0.0})
result = simulate(scene, [lower, stop, Stage(name="hold", duration=200.0)], dt_out=0.1)

hold, late = result.stage("hold"), 0.5 + 0.2  # s: half of the second that a rate is reached in, and the lag
rise = result.select("tip_velocity", axis="z")[hold]
acceleration = np.gradient(rise, result.time[hold])
softness = (acceleration.std() / rise.std()) ** 2 * deep * MASS / EA  # of the wire: frequencies squared
height = result.place_of("load", (0.0, 0.0, 1.0))[hold, 2]  # of the hook
hook, stretch = result["line_tension"][hold], result["line_stretch"][hold]
for name, run, by_hand in (
    ("time to lower, s", result.stages[0].end, (deep - first) / RATE + late),
    ("load hangs at, m", height.mean(), -DEPTH - RATE * late),
    ("stretch of the wire, m", stretch.mean(), deep * strain),
    ("hook load varies by, kN", hook.std() / 1e3, MASS * acceleration.std() / (1 - softness) / 1e3),
):
    print(f"{name:24} {run:8.3f}, by hand {by_hand:8.3f}")
