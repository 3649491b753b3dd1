"""A ring crane of one's own, from its data file: its luffing rope, its load chart, luffing by the winch."""

from pathlib import Path

import numpy as np

from seacrane import Scene, Stage, load_chart, simulate, statics
from seacrane.crane import load_crane

BOOM, OWN, FALLS, LIMIT, MASS, TIME = 70.0, 100e3, 20, 250e3, 100e3, 120.0  # m, kg, -, N, kg, s
HINGE, MAST, DATA = np.array([9.0, 4.0]), np.array([-12.0, 40.0]), Path(__file__).with_name("ring_crane.toml")


def ring(angle: float, mass: float = MASS) -> Scene:
    """Its boom at an angle (deg), a load on 20 m of wire."""
    scene = Scene(name="ring crane")
    scene.add_crane(load_crane(DATA), base="ground", foot=(0, 0, 0), coordinates={"boom": np.radians(angle)})
    scene.add_hoist(mass=mass, size=(5, 5, 5), length=20.0, rung="rigid")
    return scene


def by_hand(angle: float, mass: float = MASS) -> tuple[float, float]:
    """Tension of one fall (N) by moments about the hinge, and the length of its span, m."""
    along = np.array([np.cos(np.radians(angle)), np.sin(np.radians(angle))])
    span = MAST - HINGE - BOOM * along
    arm = BOOM * abs(along[0] * span[1] - along[1] * span[0]) / np.linalg.norm(span)
    return 9.80665 * (mass + OWN / 2) * BOOM * along[0] / arm / FALLS, float(np.linalg.norm(span))


for angle in (30, 50, 60, 75):
    tension = statics(ring(angle))["rope tension boom"].item()
    print(f"{angle} deg: a fall carries {tension / 1e3:6.2f} kN, by hand {by_hand(angle)[0] / 1e3:6.2f} kN")
chart = load_chart(ring(60), radii=[25.0, 45.0, 65.0, 75.0], limits={"rope tension boom": LIMIT})
for radius, allowable in zip(chart.radii, np.ravel(chart.allowable), strict=True):
    empty, one = (by_hand(np.degrees(np.arccos((radius - 9) / BOOM)), kg)[0] for kg in (0.0, 1.0))
    print(f"{radius:.0f} m: {allowable / 1e3:7.2f} t, by hand {(LIMIT - empty) / (one - empty) / 1e3:7.2f} t")
scene, low, high = ring(60), by_hand(60)[1], by_hand(70)[1]
scene.add_winch("luffing rope", lag=0.3, maximum_rate=3.0)
luff = {"luffing rope.rate": -FALLS * (low - high) / TIME}
stages = [Stage(name="hold", duration=10.0), Stage(name="luff", duration=TIME + 1.0, commands=luff)]
stages += [Stage(name="stop", duration=60.0, commands={"luffing rope.rate": 0.0})]
result = simulate(scene, stages, start="rest")
tip, rope = result.place_of("tip"), result.select("line_tension", line="luffing rope") / 1e3
for name, at in (("before", slice(0, 50)), ("after ", slice(-100, None))):
    angle = np.degrees(np.arctan2(tip[at, 2] - HINGE[1], -tip[at, 0] - HINGE[0])).mean()
    hand = by_hand(angle)[0] / 1e3
    print(f"{name} luffing, {angle:.2f} deg: a fall {rope[at].mean():.2f} kN, by hand {hand:.2f} kN")
