"""A manifold goes down to 1,500 m on a wire with mass: pulls and resonance over depth, by run and hand.

Usage: python deep_lowering.py [FOLDER FOR A PICTURE]
"""

import sys
import warnings
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from scipy.optimize import brentq
from scipy.special import erf

from seacrane import Curve, Result, Scene, natural_modes, shipped_database, simulate
from seacrane.result import heavy_line_tension
from seacrane.warnings import QuasiStaticLineWarning, StiffWarning
from seacrane.water import BoxPart

G, RHO, HS, TP = 9.80665, 1025.0, 1.5, 7.0  # m/s2, kg/m3, m, s
MASS, SIZE, FILL, OPEN = 120e3, (8.0, 6.0, 4.0), 0.15, 0.2  # kg, m, shares
EA, WIRE, DIAMETER, SEGMENTS = 1.5e8, 20.0, 0.06, 6  # N, kg/m, m
FIRST, LAST, RATE, WAIT = 100.0, 1500.0, 1.2, 60.0  # m, m, m/s on the average, s before and after
LEAST = 0.1  # of the least static pull
BODY = BoxPart(size=SIZE, strips=(2, 2), fill=FILL, perforation=OPEN)
PIECES = list(BODY.pieces(RHO))
ADDED = sum(piece.added_masses[-1, 2] for piece in PIECES)  # kg, deep down
DRAG = sum(piece.drag[2] for piece in PIECES)  # N s2/m2
LOAD = (MASS - RHO * FILL * np.prod(SIZE)) * G  # N, in water
ROPE = (WIRE - RHO * np.pi / 4.0 * DIAMETER**2) * G  # N/m, in water
DOWN = (LAST - FIRST) / RATE  # s


def paid_out(length: float) -> Curve:
    """From a length on, by the way down, fastest in the middle of it."""
    return Curve.quintic(start_time=WAIT, end_time=WAIT + DOWN, start=length, end=length + LAST - FIRST)


def hung(depth: float, hs: float = 0.0, lowers: bool = False, rung: Any = "elastic") -> Scene:
    """From the crane of a ship, its top so deep."""
    scene = Scene(name="deep lowering", gravity=G)
    scene.add_given_vessel(shipped_database(), duration=DOWN + 2.0 * WAIT)
    scene.add_sea(hs=hs, tp=TP, direction_deg=165.0, seed=1)
    jib, head = scene.add_crane(slew=-np.pi / 2.0, s1=1.0, s2=2.0).tip
    x, y, z = scene.place_of("tip")
    top = np.array([x, y, -depth])
    scene.add_body(name="load", mass=MASS, size=SIZE, position=top - [0.0, 0.0, 0.5 * SIZE[2]])
    scene.add_immersed("load", parts=[BODY], density=RHO)
    weight = LOAD + ROPE * depth + WIRE * G * z
    length = (z + depth) / (1.0 + 0.5 * (LOAD + weight) / EA)
    scene.add_line(
        "wire", jib, "load", first_point=head, rung="with mass", EA=EA, mass_per_length=WIRE,
        segments=SEGMENTS, segment_rung=rung,
        diameter=DIAMETER, medium="sea", length=paid_out(length) if lowers else length,
    )  # fmt: skip
    return scene


def lowered(hs: float) -> Result:
    """The whole way in one call, from rest; without waves nothing runs along the wire."""
    rung = "elastic" if hs else "quasi-static"
    return simulate(
        hung(FIRST, hs, lowers=True, rung=rung), t_end=DOWN + 2.0 * WAIT, dt_out=0.25, start="rest"
    )


def by_hand(depth: float) -> float:
    """Period (s) of the load on its wire: a bar of the wire's mass with the load's at its end."""
    scene = hung(depth)
    length = scene.place_of("tip")[2] + depth
    ratio = WIRE * length / (MASS + ADDED)
    x = brentq(lambda x: x * np.tan(x) - ratio, 1e-9, 0.5 * np.pi - 1e-9)
    return float(2.0 * np.pi * length / (x * np.sqrt(EA / WIRE)))


def found(depth: float) -> float:
    """The same by the program."""
    modes = natural_modes(hung(depth))
    return float(modes.natural_period[modes.find("load heave")])


def static(depth: float) -> float:
    """Pull at the tip, N, by hand."""
    return LOAD + ROPE * depth + WIRE * G * hung(depth).place_of("tip")[2]


def response(omega: np.ndarray, heave: np.ndarray, depth: float, speed: float) -> float:
    """Standard deviation of the load's heave over that of the tip, by hand: a bar with a damper at its end.

    `heave` is the tip's at each omega, and drag is linear by its mean slope 2 b E|v|, v Gaussian about speed.
    """
    length = hung(depth).place_of("tip")[2] + depth
    phase, impedance, deviation = omega * length / np.sqrt(EA / WIRE), omega * np.sqrt(EA * WIRE), 0.1
    for _ in range(60):
        ratio = speed / deviation
        mean = speed * erf(ratio / np.sqrt(2.0)) + deviation * np.sqrt(2.0 / np.pi) * np.exp(-0.5 * ratio**2)
        end = omega**2 * (MASS + ADDED) - 2j * omega * DRAG * mean
        gain = impedance / (impedance * np.cos(phase) - end * np.sin(phase))
        deviation = 0.5 * (deviation + np.linalg.norm(omega * np.abs(gain) * heave))
    return float(np.linalg.norm(np.abs(gain) * heave) / np.linalg.norm(heave))


for category in (StiffWarning, QuasiStaticLineWarning):  # both are meant, see above
    warnings.simplefilter("ignore", category)
calm, waves = lowered(0.0), lowered(HS)
time = calm.time
depth = -calm.select("position", body="load", axis="z") - 0.5 * SIZE[2]
pulls = {name: heavy_line_tension(run, line="wire") for name, run in (("calm", calm), ("waves", waves))}
for at in (0.5 * WAIT, time[-1]):
    i = int(np.argmin(np.abs(time - at)))
    print(f"{depth[i]:6.0f} m: pull at the tip {pulls['calm'][i, 0] / 1e3:6.1f} kN, by hand "
          f"{static(depth[i]) / 1e3:6.1f} kN")  # fmt: skip
least = pulls["waves"].min(axis=0) / np.array([static(FIRST), LOAD])
for name, share in zip(("tip", "load"), least, strict=True):
    said = "taut" if share > LEAST else "slack by the rule"
    print(f"least pull at the {name} {share:4.2f} of its least static: {said}")

depths = np.array([100.0, 300.0, 600.0, 900.0, 1200.0, 1500.0])
periods = np.array([(found(each), by_hand(each)) for each in depths])
for each, (own, hand) in zip(depths, periods, strict=True):
    print(f"{each:6.0f} m: heave on the wire {own:5.2f} s, by hand {hand:5.2f} s")

tip = waves.place_of("tip")[:, 2] - calm.place_of("tip")[:, 2]
load = waves.select("position", body="load", axis="z") - calm.select("position", body="load", axis="z")
heave = (
    np.abs(np.fft.rfft(tip)[1:]) * np.sqrt(2.0) / tip.size
)  # of each wave, so that squares sum to the variance
omega = 2.0 * np.pi * np.fft.rfftfreq(tip.size, time[1] - time[0])[1:]
edges = np.linspace(0.0, LAST, 11)
middles = 0.5 * (edges[1:] + edges[:-1])
within = [(depth >= a) & (depth < b) for a, b in pairwise(edges)]
ran = np.array([np.std(load[one]) / np.std(tip[one]) for one in within])
speeds = [float(np.mean(np.abs(np.gradient(depth, time)[one]))) for one in within]
hand = np.array([response(omega, heave, *one) for one in zip(middles, speeds, strict=True)])
for each, one, two in zip(middles, ran, hand, strict=True):
    print(f"{each:6.0f} m: heave of the load over that of the tip {one:4.2f}, by hand {two:4.2f}")

if len(sys.argv) > 1:
    import matplotlib.pyplot as plt

    figure, (pull, rise, period) = plt.subplots(3, figsize=(8.0, 9.0), layout="constrained")
    for name, label in (("waves", f"Hs {HS:g} m, Tp {TP:g} s"), ("calm", "calm")):
        pull.plot(depth, pulls[name][:, 0] / 1e3, linewidth=0.8, label=f"at the tip, {label}")
        pull.plot(depth, pulls[name][:, 1] / 1e3, linewidth=0.8, label=f"at the load, {label}")
    pull.plot(depths, [static(each) / 1e3 for each in depths], "k.", label="at the tip, at rest, by hand")
    pull.axhline(LEAST * LOAD / 1e3, color="tab:red", linestyle="--", label="tenth of the least static")
    pull.set_ylabel("pull [kN]")
    rise.plot(middles, ran, "o", label="run")
    rise.plot(middles, hand, label="by hand, drag made linear")
    rise.set_ylabel("heave of the load over the tip's")
    period.plot(depths, periods[:, 0], "o", label="natural_modes")
    period.plot(depths, periods[:, 1], label="by hand, x tan x")
    period.axhline(TP, color="0.6", linestyle=":", label="peak of the sea")
    period.set(xlabel="depth of the load's top [m]", ylabel="heave on the wire [s]", ylim=(0.0, None))
    for axes in (pull, rise, period):
        axes.legend(fontsize="small", ncols=2)
    figure.savefig(Path(sys.argv[1]) / "deep_lowering.png", dpi=90)
