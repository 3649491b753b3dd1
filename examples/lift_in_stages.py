"""A lift in stages: 20 t go from a heaving barge to a platform, and each stage ends when its work is done.

Usage: python lift_in_stages.py [FOLDER FOR A PICTURE]
"""

import sys
from pathlib import Path

import numpy as np

from seacrane import Curve, Move, Scene, Stage, Until, simulate
from seacrane.crane import FOOT, load_crane

G, MASS, DECK, PLATFORM = 9.80665, 20e3, 2.0, 8.0  # m/s2, kg, m, m

scene = Scene(name="lift in stages", gravity=G)
jib, head = scene.add_crane(base="ground", s1=1.5, s2=1.0).tip
for joint, name in (("A", "slew"), ("main_cylinder", "main"), ("knuckle_cylinder", "knuckle")):
    scene.add_driver(joint=joint, name=name, curve=Curve.constant(value=0.0))
x, y, tip = FOOT + load_crane().tip(slew=0.0, s1=1.5, s2=1.0)
scene.add_body(name="barge", mass=1e6, inertia=(1e8, 1e8, 1e8), position=(x, y, 0.0))
scene.add_joint(kind="prismatic", name="heave", first="ground", second="barge")
scene.add_driver(joint="heave", curve=Curve.harmonic(amplitude=0.2, omega=0.8, phase=-np.pi / 2.0))
scene.add_body(name="load", mass=MASS, inertia=(5e4, 5e4, 5e4), position=(x, y, DECK))
scene.add_joint(kind="weld", name="on barge", first="barge", second="load")
scene.add_stop(joint="on barge")  # a weld that lets go
scene.add_line(
    name="hoist", bodies=[jib, "load"], points=[head, (0.0, 0.0, 0.0)],
    EA=5e7, length=tip - DECK + 0.25,
)  # fmt: skip
scene.add_winch(line="hoist", maximum_acceleration=0.5, lag=0.2)
scene.add_joint(kind="free", name="above platform", first="ground", second="load")
scene.add_stop(joint="above platform", coordinate="z", minimum=PLATFORM - DECK, name="platform")

high = Until.channel("position", body="load", axis="z", minimum=PLATFORM + 4.0)
stages = [
    Stage(name="hold", duration=8.0),
    Stage(
        name="lift off",
        until=Until.release("on barge"),
        maximum_duration=60.0,
        commands={"hoist.rate": -0.1},
    ),
    Stage(name="raise", until=high, maximum_duration=60.0, commands={"hoist.rate": -0.6}),
    Stage(name="slew", duration=50.0, commands={"hoist.rate": 0.0, "slew": Move(to=np.pi / 2.0, over=45.0)}),
    Stage(name="lower", until=Until.contact("platform"), maximum_duration=60.0, connect=["above platform"],
          commands={"hoist.rate": 0.3}),
    Stage(name="slacken", until=Until.tension("hoist", maximum=0.0), maximum_duration=20.0),
    Stage(name="let go", duration=3.0, release=["hoist"]),
]  # fmt: skip
result = simulate(scene, stages, rtol=1e-05)

hook = result.select("line_tension", line="hoist") / 1e3
for span in result.stages:
    part = result.stage(span.name)
    print(f"{span.name:9} {span.start:6.2f} to {span.end:6.2f} s, hook {hook[part].min():6.1f} to "
          f"{hook[part].max():6.1f} kN, ended by {span.ended_by}")  # fmt: skip
(landing,) = (event for event in result.events if event.kind == "contact")
print(f"weight {MASS * G / 1e3:.1f} kN, largest hook load {hook.max() / MASS / G * 1e3:.3f} times that")
print(f"lands at {landing.speed:.3f} m/s with {landing.energy_lost / 1e3:.2f} kJ")

if len(sys.argv) > 1:
    wanted = ("line_tension", "limit_force", "line_unstretched_length")
    result.plot(*wanted).savefig(Path(sys.argv[1]) / "lift_in_stages.png", dpi=100)
