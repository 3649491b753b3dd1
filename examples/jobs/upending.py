"""Upend a 60 t pile of 50 m between a crane and a gantry: who carries what at each angle?"""

import numpy as np

from seacrane import Move, Scene, Stage, simulate
from seacrane.crane import load_crane

MASS, LONG, WIDE, EA, TOP, LOW = 60e3, 50.0, 3.0, 1.5e8, 40.0, 8.0  # kg, m, m, N, m: trolley, lug of the tail
HEAD, TAIL, ANGLES = np.array([22.0, 0.0]), np.array([-18.0, 1.5]), (0, 15, 30, 45, 60, 75, 85)  # m, m, deg
scene = Scene(name="upending")
crane = load_crane("lattice_boom_100t")
jib, head = scene.add_crane(crane, base="ground", foot=(0, 0, 0), coordinates={"boom": 1.2}).tip
x, y, z = scene.place_of("tip")


def by_hand(angle: float) -> np.ndarray:
    """Of a pile at an angle (deg): pull of the tail, lengths of both wires, trolley, height of the centre."""
    c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    (ahead, up), (behind, down) = (np.array([[c, -s], [s, c]]) @ lug for lug in (HEAD, TAIL))
    pulls = MASS * scene.gravity / (ahead - behind) * np.array([-behind, ahead])  # moments about the lugs
    wires = np.array([z - LOW + down - up, TOP - LOW]) / (1 + pulls / EA)
    return np.array([pulls[1], *wires, x - ahead + behind, LOW - down])


_, *wires, rail, height = by_hand(0)
scene.add_body(name="trolley", mass=5e3, size=(2, 2, 1), position=(rail, y, TOP))
scene.add_joint(kind="prismatic", name="rail", first="ground", second="trolley", axis=(1, 0, 0))
scene.add_driver(joint="rail", curve=0.0)
scene.add_body(name="pile", mass=MASS, size=(LONG, WIDE, WIDE), position=(x - HEAD[0], y, height))
short, long = wires
hung = ("head", jib, head, HEAD, short), ("tail", "trolley", (0, 0, 0), TAIL, long)
for name, body, at, (a, b), length in hung:
    scene.add_line(name, bodies=[body, "pile"], points=[at, (a, 0, b)], EA=EA, length=length)
scene.add_spring(name="air", first="ground", second="pile", first_point=(x, y, z), damping_ratio=0.05)
names, stages = ("head.length", "tail.length", "rail.displacement"), [Stage(name="0", duration=40.0)]
for angle in ANGLES[1:]:
    to = zip(names, by_hand(angle)[1:4] - (0, 0, rail), strict=True)
    stages.append(Stage(name=str(angle), duration=300.0, commands={k: Move(to=v, over=240.0) for k, v in to}))
result = simulate(scene, [*stages, Stage(name="let go", duration=120.0, release=["tail"])], dt_out=0.5)
for name, hand in ((str(angle), by_hand(angle)[0] / 1e3) for angle in ANGLES):
    pull = result.select("line_tension", line="tail")[result.stage(name)][-60:].mean() / 1e3
    print(f"at {name:>2} deg the tail carries {pull:6.2f} kN, by hand {hand:6.2f} kN")
alone = result.select("line_tension", line="head")[-100:].mean() / 1e3
print(f"alone the head carries {alone:.2f} kN, by hand {MASS * scene.gravity / 1e3:.2f} kN")
