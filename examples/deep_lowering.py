"""A manifold goes from a ship's deck to the seabed, 1,500 m down, on a wire with mass: by run and hand.

Usage: python deep_lowering.py [FOLDER FOR A PICTURE]
"""

import sys
import warnings
from itertools import pairwise
from pathlib import Path

import numpy as np
from scipy.optimize import brentq
from scipy.special import erf

from seacrane import Curve, Move, Result, Scene, Stage, Until, natural_modes, shipped_database, simulate
from seacrane.hydro import BoxPart
from seacrane.result import heavy_line_tension
from seacrane.warnings import ScatteredWavesWarning, StiffWarning

warnings.simplefilter("ignore", ScatteredWavesWarning)  # of the waves that the hull makes: docs/water.md
G, RHO, HS, TP = 9.80665, 1025.0, 1.5, 7.0  # m/s2, kg/m3, m, s
MASS, SIZE, FILL, OPEN = 120e3, (8.0, 6.0, 4.0), 0.15, 0.2  # kg, m, shares
EA, WIRE, DIAMETER, SEGMENTS = 1.5e8, 20.0, 0.06, 6  # N, kg/m, m
LAG, FILTER, WINCH = 0.1, 0.01, 0.2  # s, Hz, s: of heave compensation, and of the winch that it moves
LIFT, SPLASH, RATE, LAST = 0.15, 0.25, 1.2, 0.2  # m/s of the winch
SOFT, DEEP = (
    6.0,
    30.0,
)  # s to change its rate, on a short wire and on a long one, which else swings up and down
DECK, CLEAR, SEABED, ABOVE, NEAR = 6.0, 3.0, 1500.0, 35.0, 3.0  # m
LEAST = 0.1  # of the least static pull
BODY = BoxPart(size=SIZE, strips=(2, 2), fill=FILL, perforation=OPEN)
PIECES = list(BODY.pieces(RHO))
ADDED = sum(piece.added_masses[-1, 2] for piece in PIECES)  # kg, deep down
DRAG = sum(piece.drag[2] for piece in PIECES)  # N s2/m2
LOAD = (MASS - RHO * FILL * np.prod(SIZE)) * G  # N, in water
ROPE = (WIRE - RHO * np.pi / 4.0 * DIAMETER**2) * G  # N/m, in water


def manifold(hs: float = 0.0, depth: float | None = None) -> Scene:
    """On deck behind the crane; or over the side, its underside so deep."""
    scene = Scene(name="deep lowering", gravity=G)
    scene.add_vessel(motion=shipped_database(), duration=1800.0)
    scene.add_sea(hs=hs, tp=TP, direction_deg=165.0, seed=1)
    jib, head = scene.add_crane(slew=0.0 if depth is None else -np.pi / 2.0, s1=1.0, s2=2.0).tip
    scene.add_driver(joint="A", name="slew", curve=Curve.constant(value=0.0))
    place = {"on": "vessel", "height": DECK} if depth is None else {"height": -depth}
    scene.add_hoist(
        "wire", mass=MASS, size=SIZE, EA=EA, winch={"lag": WINCH}, **place,
        wire={"mass_per_length": WIRE, "segments": SEGMENTS, "diameter": DIAMETER, "medium": "sea"},
    )  # fmt: skip
    scene.add_heave_compensation("active", body=jib, point=head, winch="wire", lag=LAG, high_pass=FILTER)
    scene.add_immersed("load", parts=[BODY], density=RHO)
    return scene


def ramp(before: float, after: float, over: float = SOFT) -> Curve:
    """From one rate of the winch to another, slowly."""
    return Curve.quintic(start_time=0.0, end_time=over, start=before, end=after)


def lowered(hs: float) -> Result:
    """From deck to the stop, in one call."""
    free = Until.channel("position", body="load", axis="z", minimum=DECK + 0.5 * SIZE[2] + CLEAR)
    stages = [
        Stage(name="lift off", until=free, maximum_duration=90.0, commands={"wire.rate": -LIFT}),
        Stage(name="slew out", duration=60.0,
              commands={"wire.rate": ramp(-LIFT, 0.0), "slew": Move(to=-np.pi / 2.0, over=50.0)}),
        Stage(name="to the waves", until=Until.depth("load", minimum=-2.5), maximum_duration=90.0,
              commands={"wire.rate": ramp(0.0, SPLASH)}),
        Stage(name="splash zone", until=Until.depth("load", minimum=SIZE[2] + 4.0), maximum_duration=90.0),
        Stage(name="down", until=Until.depth("load", minimum=SEABED - ABOVE), maximum_duration=1500.0,
              commands={"wire.rate": ramp(SPLASH, RATE, over=2.0 * DEEP)}),
        Stage(name="compensate", duration=60.0, commands={"wire.rate": ramp(RATE, 0.0, over=DEEP)},
              connect=["active"]),
        Stage(name="last metres", until=Until.depth("load", minimum=SEABED - NEAR - 0.5 * LAST * DEEP),
              maximum_duration=150.0, commands={"wire.rate": ramp(0.0, LAST, over=DEEP)}),
        Stage(name="stop", duration=150.0, commands={"wire.rate": ramp(LAST, 0.0, over=DEEP)}),
    ]  # fmt: skip
    return simulate(manifold(hs), stages, dt_out=0.25, start="rest")


def by_hand(depth: float) -> float:
    """Period (s) of the load on its wire: a bar of the wire's mass with the load's at its end."""
    length = TIP + depth - SIZE[2]
    x = brentq(lambda x: x * np.tan(x) - WIRE * length / (MASS + ADDED), 1e-9, 0.5 * np.pi - 1e-9)
    return float(2.0 * np.pi * length / (x * np.sqrt(EA / WIRE)))


def found(depth: float) -> float:
    """The same by the program."""
    modes = natural_modes(manifold(depth=depth))
    return float(modes.natural_period[modes.find("load heave")])


def static(depth: float) -> float:
    """Pull at the tip, N, by hand."""
    return LOAD + ROPE * (depth - SIZE[2]) + WIRE * G * TIP


def response(omega: np.ndarray, heave: np.ndarray, depth: float, speed: float) -> float:
    """Standard deviation of the load's heave, m, by hand: a bar with a damper at its end.

    `heave` is that of its upper end at each omega, and drag is linear by its mean slope 2 b E|v|, v Gaussian
    about speed.
    """
    length = TIP + depth - SIZE[2]
    phase, impedance, deviation = omega * length / np.sqrt(EA / WIRE), omega * np.sqrt(EA * WIRE), 0.1
    for _ in range(60):
        ratio = speed / deviation
        mean = speed * erf(ratio / np.sqrt(2.0)) + deviation * np.sqrt(2.0 / np.pi) * np.exp(-0.5 * ratio**2)
        end = omega**2 * (MASS + ADDED) - 2j * omega * DRAG * mean
        gain = impedance / (impedance * np.cos(phase) - end * np.sin(phase))
        deviation = 0.5 * (deviation + np.linalg.norm(omega * np.abs(gain) * heave))
    return float(np.linalg.norm(np.abs(gain) * heave))


def waves_of(series: np.ndarray, step: float) -> tuple[np.ndarray, np.ndarray]:
    """Frequencies of a series, rad/s, and amplitudes whose squares sum to its variance."""
    own = np.abs(np.fft.rfft(series - series.mean())[1:]) * np.sqrt(2.0) / series.size
    return 2.0 * np.pi * np.fft.rfftfreq(series.size, step)[1:], own


warnings.simplefilter("ignore", StiffWarning)  # a wire of a few metres is stiff, and soon is longer
TIP = float(manifold(depth=100.0).place_of("tip")[2])  # m over still water
calm, waves = lowered(0.0), lowered(HS)
pulls = {name: heavy_line_tension(run, line="wire") for name, run in (("calm", calm), ("waves", waves))}
deep = {name: 0.5 * SIZE[2] - run.select("position", body="load", axis="z")
        for name, run in (("calm", calm), ("waves", waves))}  # fmt: skip
for where, hand in (("slew out", (MASS + WIRE * (TIP - DECK - SIZE[2] - CLEAR)) * G),
                    ("stop", static(SEABED - NEAR))):  # fmt: skip
    pull = float(np.mean(pulls["calm"][calm.stage(where), 0]))
    print(f"{where}: pull at the tip {pull / 1e3:6.1f} kN, by hand {hand / 1e3:6.1f} kN")
lifted = waves.stage("slew out").start
least = pulls["waves"][lifted:].min(axis=0) / LOAD
for name, share in zip(("tip", "load"), least, strict=True):
    said = "taut" if share > LEAST else "slack by the rule"
    print(f"least pull at the {name} {share:4.2f} of the static at the load under water: {said}")

depths = np.array([100.0, 300.0, 600.0, 900.0, 1200.0, 1500.0])
periods = np.array([(found(each), by_hand(each)) for each in depths])
for each, (own, hand) in zip(depths, periods, strict=True):
    print(f"{each:6.0f} m: heave on the wire {own:5.2f} s, by hand {hand:5.2f} s")

step = float(waves.time[1] - waves.time[0])
tip = waves.place_of("tip")[:, 2]
edges = np.linspace(100.0, SEABED - ABOVE, 11)
middles = 0.5 * (edges[1:] + edges[:-1])
ran, hand = [], []
for one, two in pairwise(edges):
    within = np.flatnonzero((deep["waves"] >= one) & (deep["waves"] < two))
    time, own = waves.time[within], deep["waves"][within]
    steady = np.polynomial.Polynomial.fit(time, own, 2)
    omega, heave = waves_of(tip[within], step)
    ran.append(np.std(own - steady(time)) / np.std(tip[within]))
    hand.append(response(omega, heave, 0.5 * (one + two), RATE) / np.linalg.norm(heave))
for each, one, two in zip(middles, ran, hand, strict=True):
    print(f"{each:6.0f} m: heave of the load over that of the tip {one:4.2f}, by hand {two:4.2f}")
still = waves.time > waves.stages[-1].start + DEEP
omega, heave = waves_of(tip[still], step)
p = 1j * omega
left = np.abs(1.0 - p / (p + 2.0 * np.pi * FILTER) / (1.0 + LAG * p) / (1.0 + WINCH * p))
print(f"stop: the tip heaves by {np.linalg.norm(heave):.3f} m (standard deviation), the load by "
      f"{np.std(deep['waves'][still]):.3f} m, by hand {response(omega, left * heave, SEABED, 0.0):.3f} m, "
      f"without compensation {response(omega, heave, SEABED, 0.0):.3f} m")  # fmt: skip

if len(sys.argv) > 1:
    import matplotlib.pyplot as plt

    figure, (way, pull, rise, period) = plt.subplots(4, figsize=(8.0, 11.0), layout="constrained")
    way.plot(waves.time, -deep["waves"])
    way.axhline(-SEABED, color="tab:brown")
    for span in waves.stages:
        way.axvline(span.start, color="0.8", linewidth=0.8, zorder=0)
    for name in ("splash zone", "compensate", "stop"):
        at = waves.time[waves.stage(name).start]
        way.text(at, -SEABED / 2.0, name, rotation=90, fontsize="small", ha="right", va="center")
    way.set(xlabel="time [s]", ylabel="underside over still water [m]")
    for name, label in (("waves", f"Hs {HS:g} m, Tp {TP:g} s"), ("calm", "calm")):
        pull.plot(deep[name], pulls[name][:, 0] / 1e3, linewidth=0.8, label=f"at the tip, {label}")
        pull.plot(deep[name], pulls[name][:, 1] / 1e3, linewidth=0.8, label=f"at the load, {label}")
    pull.plot(depths, [static(each) / 1e3 for each in depths], "k.", label="at the tip, at rest, by hand")
    pull.axhline(LEAST * LOAD / 1e3, color="tab:red", linestyle="--", label="tenth of the least static")
    pull.set_ylabel("pull [kN]")
    rise.plot(middles, ran, "o", label="run")
    rise.plot(middles, hand, label="by hand, drag made linear")
    rise.set_ylabel("heave of the load over the tip's")
    period.plot(depths, periods[:, 0], "o", label="natural_modes")
    period.plot(depths, periods[:, 1], label="by hand, x tan x")
    period.axhline(TP, color="0.6", linestyle=":", label="peak of the sea")
    period.set(xlabel="depth of the underside [m]", ylabel="heave on the wire [s]", ylim=(0.0, None))
    for axes in (pull, rise, period):
        axes.legend(fontsize="small", ncols=2)
    figure.savefig(Path(sys.argv[1]) / "deep_lowering.png", dpi=90)
