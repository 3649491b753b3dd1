"""A derrick on a ship, part by part: hinge, cylinder, wire, slings, tag line; wind, a slack tank, a current.

Usage: python derrick.py [FOLDER FOR A PICTURE]
"""

import sys
from pathlib import Path

import numpy as np

from seacrane import Curve, Scene, shipped_database, simulate
from seacrane.scene import FlowCoefficients, Piston, Pump, Valve

BOOM, UP = 24.0, np.radians(60.0)  # m; over the deck, to port
HEEL = np.array([20.0, 8.0, 6.0])  # m, of the boom, on the ship
TIP = BOOM * np.array([0.0, np.cos(UP), np.sin(UP)])  # from the heel
PIN, FOOT, AREA = TIP / 3.0, np.array([0.0, 5.0, -3.0]), 0.05  # m, m, m2: of the cylinder, from the heel
BOOM_MASS, HOOK_MASS, MASS, SIZE = 8e3, 300.0, 12e3, np.array([6.0, 2.5, 2.5])  # kg, kg, kg, m
WIRE, OVER, TOP, EA = 9.0, 5.0, 1.25, 3e7  # m, m from the container's top to the hook, m, N of a sling
EYES = [(x, y, TOP) for x in (-2.5, 2.5) for y in (-1.0, 1.0)]  # m, on the container
WIND, DRAG, TAG = 15.0, 1.05, 400.0  # m/s, 1, N on the tag line
CURRENT, SWAY, SIDE = 0.8, 0.7, 600.0  # m/s, 1, m2
TANK = 2.5e6  # kg m

scene = Scene(name="derrick")
ship = shipped_database()
scene.add_vessel(ship, slack_moment=TANK)
across = FlowCoefficients(
    angle=np.radians([0, 90, 180]), x=np.array([0.1, 0, -0.1]), y=np.array([0, SWAY, 0]), yaw=np.zeros(3)
)
scene.add_current(
    across, speed=CURRENT, direction_deg=90.0, frontal_area=120.0, lateral_area=SIDE, length=115.0
)

lean = 0.5 * (UP - 0.5 * np.pi)
scene.add_body(
    "boom", mass=BOOM_MASS, size=(1.0, 1.0, BOOM), position=HEEL + 0.5 * TIP,
    quaternion=(np.cos(lean), np.sin(lean), 0.0, 0.0),
)  # fmt: skip
scene.add_joint("heel", kind="revolute", first="vessel", second="boom", point=HEEL, axis=(1.0, 0.0, 0.0))
scene.add_friction("heel", load=5e3, speed=1e-3)  # N m, rad/s
scene.add_channel(joint="heel", minimum=-0.3, maximum=0.3)

hook = HEEL + TIP - (0.0, 0.0, WIRE)
middle = hook - (0.0, 0.0, OVER + TOP)
weight, hung = MASS * scene.gravity, (MASS + HOOK_MASS) * scene.gravity
leg = float(np.linalg.norm((*EYES[0][:2], OVER)))
pull = 0.25 * weight * leg / OVER
scene.add_body("hook", mass=HOOK_MASS, size=(0.5, 0.5, 0.8), position=hook)
scene.add_body("container", mass=MASS, size=SIZE, position=middle)
scene.add_line(
    "wire", first="boom", second="hook", first_point=(0.0, 0.0, 0.5 * BOOM), EA=6e7, tension_at_start=hung,
    rung="quasi-static",
)  # fmt: skip
for i, eye in enumerate(EYES, start=1):
    scene.add_line(
        f"sling {i}", bodies=["hook", "container"], points=[(0, 0, 0), eye], EA=EA, tension_at_start=pull,
        rung="quasi-static",
    )  # fmt: skip
x, y, z = 0.5 * SIZE
corners = [(a, b, c) for c in (-z, z) for a, b in ((-x, -y), (x, -y), (x, y), (-x, y))]
sides = [(i, (i + 1) % 4, 4 + (i + 1) % 4, 4 + i) for i in range(4)] + [(3, 2, 1, 0), (4, 5, 6, 7)]
faces = [half for a, b, c, d in sides for half in ((a, b, c), (a, c, d))]
scene.add_mesh("container", vertices=corners, faces=faces)

apart = float(np.linalg.norm(PIN - FOOT))
scene.add_hydraulic_cylinder(  # after what it carries, which sets its pressures
    "luff", first="vessel", second="boom", first_point=HEEL + FOOT, second_point=(0.0, 0.0, -BOOM / 6.0),
    full_area=AREA, rod_side_area=0.02, retracted_length=apart - 2.0, stroke=4.0, pump=Pump(pressure=30e6),
    valve=Valve(rated_flow=2e-3), piston=Piston(viscous_friction=1e5),
    command=Curve.quintic(start_time=10.0, end_time=12.0, start=0.0, end=-0.4),
)  # fmt: skip
scene.add_wind(
    body="container",
    frontal_area=SIZE[1] * SIZE[2],
    lateral_area=SIZE[0] * SIZE[2],
    drag_coefficient=DRAG,
    speed=WIND,
)
scene.add_load(
    kind="span drag", name="air on the wire", first="boom", second="hook", first_point=(0.0, 0.0, 0.5 * BOOM),
    length=WIRE, diameter=0.03, density=1.226, coefficient=1.2, flow=(WIND, 0.0, 0.0),
)  # fmt: skip
scene.add_spring(  # the tag line, which keeps the container end on
    "tag line", first="vessel", second="container", first_point=middle - (18.0, 0.0, 0.0),
    second_point=(-x, 0.0, 0.0), stiffness=TAG / 5.0, natural_length=10.0,
)  # fmt: skip
scene.add_ballast()
result = simulate(
    scene, 30.0, start="rest", integrator="verner65",
    channels=["position", "hydraulic_force", "hydraulic_stroke", "line_tension", "load_force"],
)  # fmt: skip

level = (result["position"][0, 3, 0] - result["position"][0, 2, 0]) / (OVER + TOP)
arm = abs(PIN[1] * (PIN - FOOT)[2] - PIN[2] * (PIN - FOOT)[1]) / apart
drag = 0.5 * 1.226 * DRAG * SIZE[1] * SIZE[2] * WIND**2
rows = {
    "push of the cylinder, kN": (
        result["hydraulic_force"][0, 0] / 1e3, (0.5 * BOOM_MASS * scene.gravity + hung) * TIP[1] / arm / 1e3
    ),
    "pull of a sling, kN": (result.select("line_tension", line="sling 1")[0] / 1e3, pull / 1e3),
    "lean of the slings, deg": (np.degrees(level), np.degrees((drag - TAG) / weight)),
    "current on the ship, kN": (
        result.select("load_force", load="current", axis="y")[0] / 1e3, 0.5 * 1.025 * SWAY * SIDE * CURRENT**2
    ),
    "roll stiffness less by the tank, MN m": (
        (ship.restoring[3, 3] - scene.vessels["vessel"].restoring[3, 3]) / 1e6, scene.gravity * TANK / 1e6
    ),
}  # fmt: skip
print(f"{'at rest':38} {'here':>8} {'by hand':>8}")
for name, (here, hand) in rows.items():
    print(f"{name:38} {here:8.3f} {hand:8.3f}")
luffed = result["hydraulic_stroke"][-1, 0] - result["hydraulic_stroke"][0, 0]
print(f"{'luffed by the cylinder, m':38} {luffed:8.3f}")

if len(sys.argv) > 1:
    import matplotlib.pyplot as plt

    figure, (above, below) = plt.subplots(2, 1, figsize=(8.0, 5.0), sharex=True, layout="constrained")
    above.plot(result.time, result["hydraulic_stroke"][:, 0])
    above.set(ylabel="stroke [m]", title="The boom is luffed out")
    for i in range(len(EYES)):
        below.plot(
            result.time, result.select("line_tension", line=f"sling {i + 1}") / 1e3, label=f"sling {i + 1}"
        )
    below.set(xlabel="time [s]", ylabel="tension [kN]")
    below.legend(ncols=4)
    figure.savefig(Path(sys.argv[1]) / "derrick.png", dpi=110)
