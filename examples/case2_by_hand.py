"""Case 2 assembled body by body: vessel, eight crane bodies, payload, controlled cylinders and a sea.

Nothing here comes from `seacrane.cases`; at the end its case 2 is run too, and the two must agree.

Usage: python case2_by_hand.py [FOLDER FOR A PICTURE]
       seacrane run case2_by_hand.py --out DIR
"""

import sys
import warnings
from pathlib import Path

import numpy as np

from seacrane import Curve, Scene, balance, cases, simulate
from seacrane.analysis import feed_forward, reflected_inertia
from seacrane.crane import Payload, load_crane
from seacrane.hydro import shipped_database
from seacrane.inputs.frames import rotation_matrix
from seacrane.warnings import LargeSwingWarning

CRANE = load_crane()  # the numbers of the crane data file, with centres of mass and inertias
PAYLOAD = Payload(mass=10e3, size=(6.0, 6.0, 4.0), link_length=8.0)
FOOT = (33.0, 10.0, 10.0)  # m, in the vessel: forward, to port, up
DRIVES = {"slew": "A", "main": "main_cylinder", "knuckle": "knuckle_cylinder"}
TARGETS = {"slew": -np.pi / 2, "main": 2.0, "knuckle": 2.0}  # rad, m, m
MOVE_END = 45.0  # s


def add_bodies(scene: Scene, **pose: float) -> None:
    """The crane's eight bodies and the hanging payload, where they stand in a pose of the crane."""
    parts = CRANE.parts(foot=FOOT, **pose)
    for body in [*parts.bodies, PAYLOAD.under(parts.tip[1])]:
        scene.add_body(
            name=body.name,
            mass=body.mass,
            inertia=body.inertia,
            center_of_mass=body.center_of_mass,
            position=body.position,
            quaternion=body.quaternion,
        )


def add_joints(scene: Scene, base: str, **pose: float) -> None:
    """Slew bearing, jib pivots, the two cylinder loops and the link, at the same pose."""
    p = {name: point + FOOT for name, point in CRANE.points(**pose).items()}
    pivot = (-np.sin(pose["slew"]), np.cos(pose["slew"]), 0.0)  # all jib pivots are parallel
    main, knuckle = p["D"] - p["B"], p["G"] - p["E"]  # the cylinders' lines
    hook = p["tip"] - [0.0, 0.0, PAYLOAD.link_length]

    def joint(name: str, kind: str, first: str, second: str, point: str, **axes: object) -> None:
        scene.add_joint(name=name, kind=kind, first=first, second=second, point=p[point], **axes)

    scene.add_joint(name="deck", kind="weld", first=base, second="tower", point=FOOT)
    joint("A", "revolute", "tower", "king", "A", axis=(0, 0, 1))
    joint("B", "universal", "king", "main_barrel", "B", axis=pivot, second_axis=np.cross(main, pivot))
    joint("C", "revolute", "king", "main_jib", "C", axis=pivot)
    joint("D", "spherical", "main_rod", "main_jib", "D")
    joint(
        "E", "universal", "main_jib", "knuckle_barrel", "E", axis=pivot, second_axis=np.cross(knuckle, pivot)
    )
    joint("F", "revolute", "main_jib", "knuckle_jib", "F", axis=pivot)
    joint("G", "spherical", "knuckle_rod", "knuckle_jib", "G")
    joint("main_cylinder", "prismatic", "main_barrel", "main_rod", "B", axis=main)
    joint("knuckle_cylinder", "prismatic", "knuckle_barrel", "knuckle_rod", "E", axis=knuckle)
    joint("link", "distance", "knuckle_jib", "payload", "tip", second_point=hook, length=PAYLOAD.link_length)


def inertias() -> dict[str, float]:
    """What each drive feels at the end of the swing-out, the others locked, on a fixed base."""
    pose = {"slew": TARGETS["slew"], "s1": TARGETS["main"], "s2": TARGETS["knuckle"]}
    scene = Scene(name="end of the swing-out")
    add_bodies(scene, **pose)
    add_joints(scene, "ground", **pose)
    for name, joint in DRIVES.items():
        scene.add_actuator(name=name, joint=joint)
    return reflected_inertia(scene)


def scene() -> Scene:
    """Vessel, crane, payload, sea; drives by state feedback around the loads that hold each pose at rest."""
    out = Scene(name="case2_by_hand")
    out.add_vessel(shipped_database(), name="vessel", memory="per-pair")
    out.add_sea(hs=2.0, tp=8.0, direction_deg=135.0, seed=1)
    start = {"slew": 0.0, "s1": 0.0, "s2": 0.0}
    add_bodies(out, **start)
    add_joints(out, "vessel", **start)
    out.add_roles(slew="A", cylinders={name: DRIVES[name] for name in ("main", "knuckle")}, link="link")
    for name, joint in DRIVES.items():
        out.add_channel(joint=joint)
        out.add_actuator(name=name, joint=joint)

    held = balance(out)  # loads that keep it at rest
    x, y, _ = held.weight_center
    out.add_force("vessel", name="balance", point=(x, y, 0.0), force=(0.0, 0.0, held.weight))
    moves = {
        name: Curve.quintic(start_time=0.0, end_time=MOVE_END, start=0.0, end=target)
        for name, target in TARGETS.items()
    }
    loads = feed_forward(out, references=moves, times=np.linspace(0.0, MOVE_END, 10))
    out.actuators.clear()
    frequency, damping = 2 * np.pi * 0.8, 0.8
    for name, inertia in inertias().items():
        out.add_actuator(
            name=name,
            joint=DRIVES[name],
            stiffness=inertia * frequency**2,
            damping=2 * damping * frequency * inertia,
            feed_forward=loads[name],
            reference=moves[name],
        )
    return out


def main() -> None:
    """Print the records as numbers, simulate, compare with case 2."""
    full = scene()
    print("body                mass [t]   centre of mass in the vessel [m]")
    for name, body in full.bodies.items():
        x, y, z = body.position + rotation_matrix(body.quaternion) @ body.center_of_mass
        print(f"{name:18} {body.mass / 1e3:9.1f}   {x:7.2f} {y:7.2f} {z:7.2f}")
    for name, drive in full.actuators.items():
        first, last = drive.feed_forward.evaluate([0.0, MOVE_END])[:, 0]
        print(
            f"{name:8} stiffness {drive.stiffness:.4g}, damping {drive.damping:.4g}, "
            f"feed-forward {first:.4g} to {last:.4g}"
        )

    warnings.simplefilter("ignore", LargeSwingWarning)  # the paper's load hangs without damping: known
    by_hand, ready_made = simulate(full), simulate(cases.case2())
    apart = np.abs(by_hand["position"] - ready_made["position"]).max()
    print(f"largest difference from case 2 in 100 s: {apart:.1e} m")
    if not apart < 1e-6:
        raise SystemExit("the scene made by hand is not case 2")

    if len(sys.argv) > 1:
        import matplotlib.pyplot as plt

        figure, axes = plt.subplots()
        payload = by_hand["position"][:, by_hand.coords["body"].index("payload")]
        axes.plot(by_hand.time, payload - payload[0], label=["x, forward", "y, to port", "z, up"])
        axes.set(xlabel="time [s]", ylabel="payload, from its start [m]")
        axes.legend()
        figure.savefig(Path(sys.argv[1]) / "case2_by_hand.png")


if __name__ == "__main__":
    main()
