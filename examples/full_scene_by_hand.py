"""A vessel, a knuckle-boom crane and its payload in waves, assembled body by body and joint by joint.

Points are in the inertial frame, which is the vessel's at the start: x forward, y to port, z up, m. Every
body starts with its axes along it, its origin at its centre of mass.

Usage: python full_scene_by_hand.py [FOLDER FOR A PICTURE]
"""

import sys
from pathlib import Path

import numpy as np

from seacrane import Curve, Scene, balance, simulate
from seacrane.analysis import reflected_inertia
from seacrane.hydro import shipped_database

y = 10.0  # m, of the crane's plane
foot, A, B, C = (33.0, y, 10.0), (33.0, y, 16.5), (28.8, y, 21.1), (32.0, y, 27.8)
D, E, F, G = (24.3, y, 28.3), (17.9, y, 31.8), (10.0, y, 36.8), (11.5, y, 34.1)
tip, load = (14.6, y, 22.4), (14.6, y, 14.4)

scene = Scene(name="by hand")
scene.add_vessel(shipped_database())
scene.add_sea(hs=2.0, tp=8.0, direction_deg=135.0, seed=1)


def beam(name: str, mass: float, start, end, width: float) -> None:
    """Add a uniform square beam: its inertia follows from its length along `end - start` and its width."""
    along = np.subtract(end, start)
    length, one = np.linalg.norm(along), np.eye(3)
    across = one - np.outer(along, along) / length**2
    inertia = mass / 12.0 * (length**2 * across + width**2 * (2.0 * one - across))
    scene.add_body(name=name, mass=mass, inertia=inertia, position=np.add(start, end) / 2.0)


def part(start, end, fraction: float) -> np.ndarray:
    """The point between two others."""
    return np.array(start) + fraction * np.subtract(end, start)


beam("tower", 100e3, foot, A, 4.5)
beam("king", 115e3, A, C, 4.0)
beam("main_barrel", 15e3, B, part(B, D, 0.85), 1.0)
beam("main_rod", 10e3, part(B, D, 0.15), D, 0.5)
beam("main_jib", 78e3, C, F, 2.5)
beam("knuckle_barrel", 13.8e3, E, part(E, G, 0.85), 1.0)
beam("knuckle_rod", 9.2e3, part(E, G, 0.15), G, 0.5)
beam("knuckle_jib", 49e3, F, tip, 2.0)
scene.add_body(name="payload", mass=10e3, inertia=[40e3, 40e3, 60e3], position=load)

across = (0.0, 1.0, 0.0)  # the axis of everything that turns in the crane's plane
scene.add_joint(kind="weld", name="deck", first="vessel", second="tower", point=foot)
scene.add_joint(kind="revolute", name="A", first="tower", second="king", point=A, axis=(0, 0, 1))
scene.add_joint(kind="revolute", name="C", first="king", second="main_jib", point=C, axis=across)
scene.add_joint(kind="revolute", name="F", first="main_jib", second="knuckle_jib", point=F, axis=across)
for name, base, driven, low, high in (
    ("main", "king", "main_jib", B, D),
    ("knuckle", "main_jib", "knuckle_jib", E, G),
):
    axis = np.subtract(high, low)
    barrel, rod = f"{name}_barrel", f"{name}_rod"
    scene.add_joint(kind="universal", name=f"{name}_foot", first=base, second=barrel, point=low,
                    axis=across, second_axis=np.cross(across, axis))  # fmt: skip
    scene.add_joint(kind="prismatic", name=f"{name}_cylinder", first=barrel, second=rod, point=low, axis=axis)
    scene.add_joint(kind="spherical", name=f"{name}_head", first=rod, second=driven, point=high)
scene.add_joint(
    kind="distance", name="link", first="knuckle_jib", second="payload", point=tip, second_point=load
)

scene.add_roles(  # which parts the channels of a crane are made of
    slew="A", cylinders={"main": "main_cylinder", "knuckle": "knuckle_cylinder"}, link="link"
)

motions = {"slew": ("A", -np.pi / 2), "main": ("main_cylinder", 2.0), "knuckle": ("knuckle_cylinder", 2.0)}
for name, (joint, _) in motions.items():
    scene.add_channel(joint=joint)
    scene.add_actuator(name=name, joint=joint)
rest, felt = balance(scene), reflected_inertia(scene)
for name, (_, end) in motions.items():
    scene.replace(
        name, kind="actuator", stiffness=25.0 * felt[name], damping=8.0 * felt[name],
        feed_forward=rest.loads[name],
        reference=Curve.quintic(start_time=0.0, end_time=45.0, start=0.0, end=end),
    )  # fmt: skip
under = (*rest.weight_center[:2], 0.0)
scene.add_force("vessel", name="ballast", point=under, force=(0, 0, rest.weight))

result = simulate(scene, t_end=60.0)
size = dict(scene.report()["size"])
print(f"{size['coordinates']} coordinates, {size['constraints']} constraints, {size['states']} states")
for name in ("main", "knuckle"):
    print(f"{name} cylinder at rest  {rest.loads[name] / 1e3:.0f} kN")
print(f"mean heel after the swing-out  {np.degrees(result['vessel_motion'][-100:, 3].mean()):.2f} deg")
print(
    f"link tension  {result['link_tension'].min() / 1e3:.1f} to {result['link_tension'].max() / 1e3:.1f} kN"
)
print(f"joints stay closed to  {result['constraint_error'].max():.1e} m or rad")

if len(sys.argv) > 1:
    import matplotlib.pyplot as plt

    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4))
    path = result.select("position", body="payload")
    left.plot(path[:, 0], path[:, 1])
    left.set(xlabel="x [m]", ylabel="y [m]", title="payload from above", aspect="equal")
    right.plot(result.time, np.degrees(result["vessel_motion"][:, 3]))
    right.set(xlabel="time [s]", ylabel="[deg]", title="roll")
    figure.savefig(Path(sys.argv[1]) / "full_scene_by_hand.png")
