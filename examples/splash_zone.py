"""A template goes through the waves on a ship's crane: least pull in hook and slings, by a run and by hand.

Usage: python splash_zone.py [FOLDER FOR A PICTURE]

By hand is the simplified method of DNV-RP-N103 as others quote it: unverified. So is its rule for slack.
"""

import sys
import warnings
from pathlib import Path

import numpy as np

from seacrane import Result, Scene, Stage, Until, shipped_database, simulate
from seacrane.answers import Draught, simplified_method
from seacrane.hydro import BoxPart, PlatePart
from seacrane.warnings import ScatteredWavesWarning

warnings.simplefilter("ignore", ScatteredWavesWarning)  # of the waves that the hull makes: docs/water.md
G, RHO, HS, TP = 9.80665, 1025.0, 1.5, 6.0  # m/s2, kg/m3, m, s
TZ, SEEDS = TP / 1.287, range(1, 4)  # s, of a JONSWAP spectrum with gamma 3.3; passages through the surface
MASS, BLOCK, SIZE, MAT, LEG = 40e3, 1.5e3, (6.0, 4.0, 3.0), (1.5, 1.2), 0.2  # kg, kg, m, m, m
FILL, OPEN, C_S, C_D = 0.2, 0.3, 5.0, 2.5  # shares of the volume that keeps water out, of faces that are open
EA, SLING, ABOVE, BELOW, RATE = 3e8, 1e8, 2.5, 2.0, 0.25  # N, N, m (start), m (end, over the top), m/s
LEAST = 0.1  # of the least static pull


def parts() -> list[BoxPart | PlatePart]:
    """An open frame, and mud mats on short legs below its corners."""
    corners = [(x, y, -0.5 * SIZE[2] - LEG) for x in (-2.2, 2.2) for y in (-1.3, 1.3)]
    mats = [PlatePart(size=MAT, thickness=0.02, slam=C_S, drag=C_D, point=at) for at in corners]
    return [BoxPart(size=SIZE, strips=(3, 2), fill=FILL, perforation=OPEN, slam=C_S, drag=C_D), *mats]


def template(hs: float, seed: int) -> Scene:
    """Above the waves, on four slings."""
    scene = Scene(name="splash zone", gravity=G)
    scene.add_vessel(motion=shipped_database())
    scene.add_sea(hs=hs, tp=TP, direction_deg=165.0, seed=seed)
    scene.add_crane(slew=-np.pi / 2, s1=1.0, s2=2.0)
    scene.add_hoist(
        mass=MASS, size=SIZE, height=ABOVE, EA=EA, block_mass=BLOCK, winch={"lag": 0.2},
        slings={"angle_deg": 60.0, "EA": SLING},
    )  # fmt: skip
    scene.add_immersed("load", parts=parts(), density=RHO)
    scene.add_limit_state("slack", minimum=LEAST)
    return scene


def lowered(hs: float, seed: int = 1) -> Result:
    """By the winch, from above the waves to below them."""
    under = Until.channel("position", body="load", axis="z", maximum=-0.5 * SIZE[2] - BELOW)
    stages = [
        Stage(name="above", duration=20.0),
        Stage(name="lower", until=under, maximum_duration=90.0, commands={"hoist.rate": RATE}),
        Stage(name="below", duration=20.0, commands={"hoist.rate": 0.0}),
    ]
    return simulate(template(hs, seed), stages, dt_out=0.05)


def at_draught(name: str, draught: float) -> Draught:
    """What the water meets with the frame wet so deep, m."""
    wet = np.clip(draught / SIZE[2], 0.0, 1.0)
    water = [piece for part in parts() for piece in part.pieces(RHO)]
    touches = draught < 0.1 * SIZE[2]
    return Draught(
        name=name,
        depth=draught - 0.5 * wet * SIZE[2],  # of the centre of what is wet
        volume=wet * FILL * np.prod(SIZE),
        added_mass=sum(np.interp(draught, piece.depths, piece.added_masses[:, 2]) for piece in water),
        drag_area=0.0 if touches else sum(2.0 * piece.drag[2] / RHO for piece in water),
        slam_area=C_S * (SIZE[0] * SIZE[1] + 4.0 * np.prod(MAT)) if touches else 0.0,
        water_plane=FILL * SIZE[0] * SIZE[1] if draught <= SIZE[2] else 0.0,
    )


calm, waves = lowered(0.0), [lowered(HS, seed) for seed in SEEDS]
lines = ["hoist", *(f"hoist sling {i}" for i in range(1, 5))]
floors, worst = {}, {}
for line in lines:
    static = float(calm.select("line_tension", line=line)[calm.stage("below")].mean())
    margins = [float(run.select("slack_margin", weighed=line).min()) for run in waves]
    floors[line], worst[line] = LEAST * static / 1e3, int(np.argmin(margins))
    lowest = float(waves[worst[line]].select("line_tension", line=line).min())
    print(f"run, {line:13} least {lowest / 1e3:6.1f} kN, static below {static / 1e3:6.1f} kN: slack margin "
          f"{min(margins):5.2f}, {'slack by the rule' if min(margins) < LEAST else 'taut'}")  # fmt: skip

heave, speed, rise = 0.0, 0.0, 0.0  # of the tip, largest of all runs
for run in waves:
    rate = run.select("tip_velocity", axis="z")
    heave = max(heave, np.ptp(run.place_of("tip")[:, 2]) / 2.0)
    speed, rise = max(speed, np.abs(rate).max()), max(rise, np.abs(np.gradient(rate, run.time)).max())
hand = {"bottom touches": 0.0, "half under": 0.5, "top touches": 1.0, "under": 1.0 + BELOW / SIZE[2]}
by_hand = simplified_method(
    mass=MASS + BLOCK, draughts=[at_draught(name, share * SIZE[2]) for name, share in hand.items()],
    hs=HS, tz=TZ, lowering_speed=RATE, tip_heave=heave, tip_speed=speed, tip_acceleration=rise, density=RHO,
)  # fmt: skip
for row in by_hand:
    forces = f"static {row.static / 1e3:6.1f} kN, water {row.hydrodynamic / 1e3:6.1f} kN"
    print(f"simplified, {row.name:14} {forces}: {row.margin:5.2f}")

if len(sys.argv) > 1:
    import matplotlib.pyplot as plt

    figure, (pull, slings, deep) = plt.subplots(3, sharex=True, figsize=(8.0, 8.0), layout="constrained")
    for run, label in ((waves[worst["hoist"]], f"Hs {HS:g} m, seed of the least"), (calm, "calm")):
        pull.plot(run.time, run.select("line_tension", line="hoist") / 1e3, label=label)
        deep.plot(run.time, run.select("position", body="load", axis="z") - 0.5 * SIZE[2], label=label)
    for line in lines[1:]:
        run = waves[worst[line]]
        slings.plot(run.time, run.select("line_tension", line=line) / 1e3, linewidth=0.8, label=line)
    for axes, line in ((pull, lines[0]), (slings, lines[1])):
        axes.axhline(floors[line], color="tab:red", linestyle="--", label="tenth of the least static")
        axes.legend(fontsize="small", ncols=3)
    pull.set_ylabel("hook load [kN]")
    slings.set_ylabel("slings [kN]")
    deep.set(xlabel="time [s]", ylabel="underside over still water [m]")
    deep.axhline(0.0, color="0.6", linewidth=0.8)
    figure.savefig(Path(sys.argv[1]) / "splash_zone.png", dpi=100)
