"""A template goes from a ship's deck to a stop above the seabed: pulls, drag, resonance, by run and hand.

Usage: python subsea_lowering.py [FOLDER FOR A PICTURE]
"""

import sys
import warnings
from pathlib import Path

import numpy as np

from seacrane import (
    Curve,
    Move,
    Result,
    Scene,
    Stage,
    Until,
    equilibrium,
    natural_modes,
    shipped_database,
    simulate,
)
from seacrane.hydro import BoxPart
from seacrane.warnings import ScatteredWavesWarning

warnings.simplefilter("ignore", ScatteredWavesWarning)  # of the waves that the hull makes: docs/water.md
G, RHO, HS, TP, SEEDS = 9.80665, 1025.0, 1.5, 7.0, (1, 2)  # m/s2, kg/m3, m, s
MASS, BLOCK, SIZE, FILL, OPEN = 40e3, 3e3, (6.0, 4.0, 3.0), 0.2, 0.3  # kg, kg, m, shares
EA, SLING, ANGLE, SEABED = 1.5e8, 5e7, 60.0, 100.0  # N, N, deg, m
LAG, FILTER, WINCH = 0.1, 0.01, 0.2  # s, Hz, s: of heave compensation, and of the winch that it moves
LIFT, SPLASH, RATE, LAST, SOFT = 0.15, 0.25, 0.8, 0.2, 6.0  # m/s of the winch; s to change it
DECK, CLEAR, ABOVE, NEAR = 6.0, 3.0, 15.0, 3.0  # m over the ship's origin; over the deck; over the seabed
LEAST = 0.1  # of the least static pull
BODY = BoxPart(size=SIZE, strips=(3, 2), fill=FILL, perforation=OPEN)


def template(hs: float, seed: int, depth: float | None = None) -> Scene:
    """On deck behind the crane, slings and hook above it; or over the side, its underside so deep."""
    scene = Scene(name="subsea lowering", gravity=G)
    scene.add_vessel(motion=shipped_database())
    scene.add_sea(hs=hs, tp=TP, direction_deg=165.0, seed=seed)
    jib, head = scene.add_crane(slew=0.0 if depth is None else -np.pi / 2.0, s1=1.0, s2=2.0).tip
    scene.add_driver(joint="A", name="slew", curve=Curve.constant(value=0.0))
    place = {"on": "vessel", "height": DECK} if depth is None else {"height": -depth}
    scene.add_hoist(
        mass=MASS, size=SIZE, EA=EA, block_mass=BLOCK, slings={"angle_deg": ANGLE, "EA": SLING},
        winch={"lag": WINCH}, **place,
    )  # fmt: skip
    scene.add_heave_compensation(
        "active", body=jib, point=head, winch="hoist", lag=LAG, high_pass=FILTER
    )  # fmt: skip
    scene.add_immersed("load", parts=[BODY], density=RHO)
    return scene


def ramp(before: float, after: float) -> Curve:
    """From one rate of the winch to another, slowly: what is sudden shakes the wire more than waves do."""
    return Curve.quintic(start_time=0.0, end_time=SOFT, start=before, end=after)


def lowered(hs: float, seed: int = 1) -> Result:
    """From deck to the stop, in one call."""
    free = Until.channel("position", body="load", axis="z", minimum=DECK + 0.5 * SIZE[2] + CLEAR)
    stages = [
        Stage(name="lift off", until=free, maximum_duration=90.0, commands={"hoist.rate": -LIFT}),
        Stage(name="slew out", duration=60.0,
              commands={"hoist.rate": ramp(-LIFT, 0.0), "slew": Move(to=-np.pi / 2.0, over=50.0)}),
        Stage(name="to the waves", until=Until.depth("load", minimum=-2.5), maximum_duration=90.0,
              commands={"hoist.rate": ramp(0.0, SPLASH)}),
        Stage(name="splash zone", until=Until.depth("load", minimum=SIZE[2] + 4.0), maximum_duration=90.0),
        Stage(name="down", until=Until.depth("load", minimum=SEABED - ABOVE), maximum_duration=200.0,
              commands={"hoist.rate": ramp(SPLASH, RATE)}),
        Stage(name="compensate", duration=40.0, commands={"hoist.rate": ramp(RATE, 0.0)}, connect=["active"]),
        Stage(name="last metres", until=Until.depth("load", minimum=SEABED - NEAR), maximum_duration=90.0,
              commands={"hoist.rate": ramp(0.0, LAST)}),
        Stage(name="stop", duration=60.0, commands={"hoist.rate": ramp(LAST, 0.0)}),
    ]  # fmt: skip
    return simulate(template(hs, seed), stages, dt_out=0.1, start="rest")


def resonance(depth: float) -> tuple[float, float]:
    """Period (s) of heave on the wire, the underside so deep, by the program and by hand."""
    scene = template(0.0, 1, depth=depth)
    modes = natural_modes(scene)
    period = float(modes.natural_period[modes.find("load heave")])
    rope = equilibrium(scene).load_states["hoist.length"]
    steep = np.radians(ANGLE)
    sling = 0.5 * np.hypot(*SIZE[:2]) / np.cos(steep)  # m
    give = rope / EA + sling / (4.0 * SLING * np.sin(steep) ** 2)
    return period, float(2.0 * np.pi * np.sqrt((MASS + BLOCK + ADDED) * give))


PIECES = list(BODY.pieces(RHO))
ADDED = sum(piece.added_masses[-1, 2] for piece in PIECES)  # kg, deep down
DRAG = sum(piece.drag[2] for piece in PIECES)  # N s2/m2
AIR = (MASS + BLOCK) * G
WATER = AIR - RHO * G * FILL * np.prod(SIZE)

calm, waves = lowered(0.0), [lowered(HS, seed) for seed in SEEDS]
hook = calm.select("line_tension", line="hoist")
steady = {name: float(np.median(hook[calm.stage(name)])) for name in ("slew out", "down", "stop")}
hand = {"slew out": AIR, "down": WATER - DRAG * RATE**2, "stop": WATER}
for name, where in (("slew out", "in air"), ("down", f"going down by {RATE:g} m/s"), ("stop", "at the stop")):
    print(f"hook {where:21} {steady[name] / 1e3:6.1f} kN, by hand {hand[name] / 1e3:6.1f} kN")
print(f"its drag would carry it at {np.sqrt(WATER / DRAG):.2f} m/s, by hand: the wire is taut below that")
periods = {depth: resonance(depth) for depth in (10.0, 25.0, 50.0, 75.0, SEABED - NEAR)}
for depth, (found, by_hand) in periods.items():
    print(f"heave on the wire, {depth:3.0f} m deep   {found:5.3f} s, by hand {by_hand:5.3f} s")

lines = ["hoist", *(f"hoist sling {i}" for i in range(1, 5))]
floors: dict[str, float] = {}
for line in lines:
    static = float(np.median(calm.select("line_tension", line=line)[calm.stage("stop")]))
    floors[line] = LEAST * static / 1e3
    lowest = {}
    for run in waves:
        lifted = run.stage("slew out").start
        pull = run.select("line_tension", line=line)[lifted:]
        at = int(np.argmin(pull))
        lowest[float(pull[at])] = next(s.name for s in run.stages if run.time[lifted + at] <= s.end)
    least = min(lowest)
    said = "slack by the rule" if least < LEAST * static else "taut"
    print(f"{line:13} least {least / 1e3:6.1f} kN, over static under water {least / static:4.2f}, in "
          f"{lowest[least]!r}: {said}")  # fmt: skip
p = 2j * np.pi / TP
left = abs(1.0 - p / (p + 2.0 * np.pi * FILTER) / (1.0 + LAG * p) / (1.0 + WINCH * p))
for run, seed in zip(waves, SEEDS, strict=True):
    held = run.time > run.stages[-1].start + 2.0 * SOFT
    load, tip = (float(np.std(z)) for z in (run.select("position", body="load", axis="z")[held],
                                            run.place_of("tip")[held, 2]))  # fmt: skip
    print(f"stop, seed {seed}: the tip heaves by {tip:.3f} m (standard deviation), the load by {load:.3f} m, "
          f"by hand {left * tip:.3f} m")  # fmt: skip

if len(sys.argv) > 1:
    import matplotlib.pyplot as plt

    figure, (pull, slings, deep, period) = plt.subplots(4, figsize=(8.0, 11.0), layout="constrained")
    run = waves[0]
    for each, label in ((run, f"Hs {HS:g} m, first seed"), (calm, "calm")):
        pull.plot(each.time, each.select("line_tension", line="hoist") / 1e3, label=label)
        deep.plot(each.time, each.select("position", body="load", axis="z") - 0.5 * SIZE[2], label=label)
    for line in lines[1:]:
        slings.plot(run.time, run.select("line_tension", line=line) / 1e3, linewidth=0.8, label=line)
    for axes, line in ((pull, lines[0]), (slings, lines[1])):
        axes.axhline(floors[line], color="tab:red", linestyle="--", label="tenth of the static under water")
    for axes in (pull, slings, deep):
        for span in run.stages:
            axes.axvline(span.start, color="0.8", linewidth=0.8, zorder=0)
        axes.legend(fontsize="small", ncols=3)
    for span in run.stages:
        deep.text(span.start + 2.0, -SEABED, span.name, rotation=90, fontsize="x-small", va="bottom")
    pull.set_ylabel("hook load [kN]")
    slings.set_ylabel("slings [kN]")
    deep.axhline(0.0, color="tab:blue", linewidth=0.5)
    deep.axhline(-SEABED, color="tab:brown")
    deep.set(xlabel="time [s]", ylabel="underside over still water [m]")
    period.plot(list(periods), [found for found, _ in periods.values()], "o", label="natural_modes")
    period.plot(list(periods), [hand for _, hand in periods.values()], label="by hand")
    period.set(xlabel="depth of the underside [m]", ylabel="heave on the wire [s]", ylim=(0.0, None))
    period.legend(fontsize="small")
    figure.savefig(Path(sys.argv[1]) / "subsea_lowering.png", dpi=90)
