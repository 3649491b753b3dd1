"""Two cranes of one ship hoist one long load: how they share it level, tilted, and in waves.

Usage: python tandem_lift.py [FOLDER FOR A PICTURE]
"""

import sys
from pathlib import Path

import numpy as np

from seacrane import Result, Scene, Stage, Until, equilibrium, shipped_database, simulate

MASS, LENGTH, HEIGHT, START = 60e3, 30.0, 3.0, 6.0  # kg, m, m of the load; m of its centre above the water
FEET = {"fore": 40.0, "aft": 16.0}  # m, along the ship
LUGS = {"fore": 10.0, "aft": -14.0}  # m, along the load from its centre of mass, on its top
EA, HOIST, MORE, RATE = 2e8, 6.0, 2.5, 0.2  # N; m by both winches, m more by the aft one; m/s
SHIP = shipped_database()


def lift(hs: float) -> Result:
    """Hoist with both winches, then with the aft one alone."""
    scene = Scene(name="tandem lift")
    scene.add_vessel(SHIP)
    across = MASS / 12.0 * (LENGTH**2 + HEIGHT**2)
    lengths = {}
    for name, x in FEET.items():
        pose = {"foot": (x, 10.0, 10.0), "slew": -np.pi / 2, "s1": 2.0, "s2": 1.0}
        crane = scene.add_crane(**pose, held=True, prefix=f"{name} ")
        body, point = crane.tip
        tip = scene.place_of(f"{name} tip")
        if not lengths:
            middle = (x - LUGS[name], tip[1], START)
            scene.add_body(name="load", mass=MASS, inertia=(2e5, across, across), position=middle)
        lengths[name] = tip[2] - START - 0.5 * HEIGHT
        scene.add_line(
            name=name, bodies=[body, "load"], points=[point, (LUGS[name], 0.0, 0.5 * HEIGHT)],
            EA=EA, length=lengths[name],
        )  # fmt: skip
        scene.add_winch(line=name, lag=0.5)
    scene.add_ballast()
    rest = equilibrium(scene)
    scene.add_sea(hs=hs, tp=7.0, direction_deg=160.0, seed=2)
    high = lengths["aft"] - HOIST
    stages = [
        Stage(name="hold", duration=20.0),
        Stage(name="both", until=Until.length("aft", maximum=high), maximum_duration=60.0,
              commands={"fore.rate": -RATE, "aft.rate": -RATE}),
        Stage(name="level", duration=60.0, commands={"fore.rate": 0.0, "aft.rate": 0.0}),
        Stage(name="aft", until=Until.length("aft", maximum=high - MORE), maximum_duration=60.0,
              commands={"aft.rate": -RATE}),
        Stage(name="tilted", duration=60.0, commands={"aft.rate": 0.0}),
    ]  # fmt: skip
    return simulate(scene, stages, start=rest, dt_out=0.1)


calm, waves = lift(0.0), lift(1.0)
span = LUGS["fore"] - LUGS["aft"]
weight = MASS * 9.80665

# At rest, by levers about the other lug. Tilted, the centre of mass swings out from below the lugs.
tilt = np.arcsin(MORE / span)
for stage, angle in (("level", 0.0), ("tilted", tilt)):
    part = calm.stage(stage)
    found = np.degrees(calm.select("euler_xyz", body="load", axis="y")[part].mean())
    print(f"{stage:6} tilt {found:6.3f} deg, by hand {np.degrees(angle):6.3f} deg")
    towards = 0.5 * HEIGHT * np.tan(angle)
    levers = {"fore": -LUGS["aft"] - towards, "aft": LUGS["fore"] + towards}
    for name, lever in levers.items():
        hook = calm.select("line_tension", line=name)[part].mean()
        print(f"       hook {name:4} {hook / 1e3:7.2f} kN, by hand {weight * lever / span / 1e3:7.2f} kN")

# In waves the lugs follow the heave of the tips, and the load swings: T1 + T2 = m (g + az) and, about its
# centre of mass, T1 x1 + T2 x2 = J alpha + m ax times the height of the lugs. The rest is of second order.
part = waves.stage("level")
time, speed = waves.time[part], waves.select("velocity", body="load")[part]
tips = [waves.select("tip_velocity", tip=f"{name} tip", axis="z")[part] for name in FEET]
fore, aft = np.gradient(tips, time, axis=1)
ahead, behind = LUGS["fore"], -LUGS["aft"]
az, alpha = (fore * behind + aft * ahead) / span, (fore - aft) / span
swing = MASS * np.gradient(speed[:, 0], time) * 0.5 * HEIGHT
moment = MASS / 12.0 * (LENGTH**2 + HEIGHT**2) * alpha + swing
for name, load in (("fore", MASS * az * behind + moment), ("aft", MASS * az * ahead - moment)):
    hook = waves.select("line_tension", line=name)[part]
    print(
        f"waves  hook {name:4} varies by {hook.std() / 1e3:.2f} kN, by hand {load.std() / span / 1e3:.2f} kN"
    )

if len(sys.argv) > 1:
    import matplotlib.pyplot as plt

    figure, (pull, lean) = plt.subplots(2, sharex=True, figsize=(8, 6), layout="constrained")
    for colour, name in (("C0", "fore"), ("C1", "aft")):
        share = weight * abs(LUGS["aft" if name == "fore" else "fore"]) / span / 1e3
        pull.plot(waves.time, waves.select("line_tension", line=name) / 1e3, colour, label=f"{name} hook")
        pull.axhline(share, color=colour, linestyle="--", linewidth=1, label=f"{name}, by the lever")
    lean.plot(waves.time, np.degrees(waves.select("euler_xyz", body="load", axis="y")), "C2", label="load")
    lean.axhline(
        np.degrees(tilt), color="C2", linestyle="--", linewidth=1, label=f"arcsin({MORE:g} m / {span:g} m)"
    )
    for stage in waves.stages:
        lean.axvline(stage.start, color="0.8", zorder=0)
        pull.axvline(stage.start, color="0.8", zorder=0)
        pull.annotate(stage.name, (stage.start, 1.0), xycoords=("data", "axes fraction"), xytext=(3, 3),
                      textcoords="offset points", fontsize="small")  # fmt: skip
    pull.set_ylabel("hook load [kN]")
    pull.legend(ncols=2, fontsize="small", loc="center right")
    lean.set(xlabel="time [s]", ylabel="tilt of the load, aft up [deg]")
    lean.legend(loc="center left")
    figure.savefig(Path(sys.argv[1]) / "tandem_lift.png", dpi=100)
