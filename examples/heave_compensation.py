"""What is left of a ship's heave at the hook: uncompensated, by winch, by knuckle cylinder, on gas.

Usage: python heave_compensation.py [FOLDER FOR A PICTURE]
"""

import sys
from pathlib import Path

import numpy as np

from seacrane import Curve, MotionRaos, Scene, simulate
from seacrane.analysis import reflected_inertia
from seacrane.crane import FOOT, load_crane
from seacrane.scene import Gas, Stops

LENGTH, DRAUGHT, BREADTH = 115.0, 6.0, 22.0  # m, a box
MASS, EA, DURATION, START = 50e3, 1e8, 160.0, 60.0  # kg, N, s, s
ROPE, LONG = 6.0, 40.0  # m; a soft spring feels the load swing, and a long rope swings slower than the waves
HOOK, HIGH_PASS, LAGS = 3e3, 0.01, np.arange(0.0, 0.61, 0.1)  # kg, Hz, s
LOOP, DAMPING, PERIOD, OIL = 2.0 * np.pi * 2.0, 0.8, 25.0, 0.25  # rad/s, -, s, -: cylinder's loop; gas spring
POSE = {"slew": -np.pi / 2, "s1": 3.0, "s2": 3.8}  # where the knuckle cylinder moves the tip up and down

omega = np.arange(0.2, 3.01, 0.05)
k = omega**2 / 9.81
half, depth = 0.5 * k * LENGTH, np.exp(-0.5 * k * DRAUGHT)
ship_heave = depth * np.sin(half) / half
ship_pitch = 3.0 * k * depth * (np.sin(half) - half * np.cos(half)) / half**3
none = 0.0 * k
motions = np.stack([none, none, ship_heave, none, -1j * ship_pitch, none], axis=1)
raos = MotionRaos(omega=omega, heading=[np.pi], values=[motions], name="box")
CRANE = load_crane()
TIP = FOOT + CRANE.tip(**POSE)


def lift(*, controlled: bool = False, gas: bool = False) -> Scene:
    """50 t below the crane of a ship in waves; one may control the knuckle cylinder, or hang it on gas."""
    scene = Scene(name="heave compensation")
    scene.add_vessel(motion=raos, duration=DURATION, size=(LENGTH, BREADTH, DRAUGHT))
    scene.add_sea(vessel="vessel", hs=1.5, tp=9.0, direction_deg=180.0, seed=2)
    jib, head = scene.add_crane(**POSE).tip
    for joint in ("A", "main_cylinder"):
        scene.add_driver(joint=joint, curve=Curve.constant(value=0.0))
    if controlled:
        scene.add_actuator(joint="knuckle_cylinder")
    else:
        scene.add_driver(joint="knuckle_cylinder", curve=Curve.constant(value=0.0))
    rope = LONG if gas else ROPE
    weight = (MASS + HOOK * gas) * scene.gravity
    hook = TIP - [0.0, 0.0, rope * (1.0 + weight / EA)]
    scene.add_body(name="load", mass=MASS, inertia=(1e5, 1e5, 1e5), position=hook - [0, 0, 3.0 * gas])
    end, point = "load", (0.0, 0.0, 0.0)
    if gas:
        scene.add_body(name="hook", mass=HOOK, inertia=(500.0, 500.0, 500.0), position=hook)
        k = MASS * (2.0 * np.pi / PERIOD) ** 2
        gas, stops = Gas(area=0.05, force=MASS * scene.gravity, stiffness=k), Stops(minimum=1.0, maximum=5.0)
        damping = 2.0 * OIL * np.sqrt(k * MASS)
        scene.add_spring("passive", first="hook", second="load", gas=gas, damping=damping, stops=stops)
        end = "hook"
    scene.add_line(name="hoist", bodies=[jib, end], points=[head, point], EA=EA, length=rope)
    scene.add_winch(line="hoist")
    if controlled:
        (felt,) = reflected_inertia(scene).values()
        _, held = CRANE.static_cylinder_forces(s1=POSE["s1"], s2=POSE["s2"], payload_mass=MASS)
        scene.replace(
            "knuckle_cylinder", kind="actuator", feed_forward=held, stiffness=felt * LOOP**2,
            damping=2.0 * DAMPING * felt * LOOP,
        )  # fmt: skip
    return scene


def left(scene: Scene) -> float:
    """Standard deviation of the load's height, m."""
    result = simulate(scene, t_end=DURATION, dt_out=0.2, rtol=1e-4)
    return float(np.std(result.select("position", body="load", axis="z")[result.time > START]))


def by_hand(residual: object) -> float:
    """The same of the tip's heave by the RAOs, times what compensation leaves of each wave."""
    sea = lift().waves.components()
    at_tip = raos.at(sea.omega, sea.direction) @ [0.0, 0.0, 1.0, TIP[1], -TIP[0], 0.0]
    height = at_tip * sea.amplitude * np.exp(1j * np.array(sea.phase)) * residual(1j * sea.omega)
    time = np.arange(START, DURATION, 0.2)
    return float(np.std((np.exp(1j * np.outer(time, sea.omega)) @ height).real))


def active(lag: float) -> object:
    """1 - H of the filter and the lag."""
    corner = 2.0 * np.pi * HIGH_PASS
    return lambda p: 1.0 - p / (p + corner) / (1.0 + lag * p)


def passive(p: complex) -> complex:
    """A mass on a spring and a damper."""
    own = 2.0 * np.pi / PERIOD
    return (2.0 * OIL * own * p + own**2) / (p**2 + 2.0 * OIL * own * p + own**2)


jib, head = lift().roles[""].tip
rows = [("none", left(lift()), by_hand(lambda p: 1.0 + 0.0 * p))]
rows.append(("passive", left(lift(gas=True)), by_hand(passive)))
curves: dict[str, list[float]] = {"winch": [], "cylinder": [], "by hand": []}
for lag in LAGS:
    on_winch, on_cylinder = lift(), lift(controlled=True)
    settings, ram = {"lag": lag, "high_pass": HIGH_PASS}, "knuckle_cylinder"
    on_winch.add_heave_compensation(name="active", body=jib, point=head, winch="hoist", **settings)
    on_cylinder.add_heave_compensation("active", body="vessel", point=TIP, actuator=ram, **settings)
    found = left(on_winch), left(on_cylinder), by_hand(active(lag))
    for values, value in zip(curves.values(), found, strict=True):
        values.append(value)
    rows += [
        (f"winch, lag {lag:.1f} s", found[0], found[2]),
        (f"cylinder, lag {lag:.1f} s", found[1], found[2]),
    ]
for name, run, hand in rows:
    print(f"{name:20} load heaves by {run:6.4f} m, by hand {hand:6.4f} m (standard deviation)")

if len(sys.argv) > 1:
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots()
    for name, style in (("winch", "o"), ("cylinder", "s"), ("by hand", "-")):
        axes.plot(LAGS, curves[name], style, label=f"active, {name}", markerfacecolor="none")
    for (name, run, hand), colour in zip(rows[:2], ("tab:red", "tab:purple"), strict=True):
        axes.axhline(hand, color=colour, label=f"{name}, by hand")
        axes.plot(0.0, run, "D", color=colour, label=name)
    axes.set(xlabel="lag [s]", ylabel="heave of the load, standard deviation [m]", ylim=(0.0, None))
    axes.legend()
    figure.savefig(Path(sys.argv[1]) / "heave_compensation.png", bbox_inches="tight")
