"""Andrews' squeezer: a planar mechanism of three loops, built so that no joint holds a motion twice.

A planar loop of four hinges has three constraints too many. Here one hinge of each loop is a ball joint and
one may slide along its axis: the motion is the same, and every reaction is unique. The final angles are those
of the Test Set for IVP Solvers (University of Bari), a common benchmark of solvers for constrained motion.

Usage: python andrews_squeezer.py [FOLDER FOR A PICTURE]
"""

import sys
from pathlib import Path

import numpy as np

from seacrane import Scene, simulate

PUBLISHED = 15.81077119629904, -15.75637105984298, 0.04082224013073101  # beta, Theta, gamma after 0.03 s
beta, gamma, phi, delta, omega, epsilon = (
    -0.0617138900142764, 0.4552798191630701, 0.2226683901658859, 0.4873649795438426, -0.2226683901658859,
    1.2305474445498212,
)  # fmt: skip
a, b, c = np.array([-0.06934, -0.00227]), np.array([-0.03635, 0.03273]), np.array([0.014, 0.072])


def along(angle):
    return np.array([np.cos(angle), np.sin(angle)])


pin = 0.007 * along(beta)  # crank and rod
middle = pin - 0.028 * along(beta)  # where the rod meets the other three
elbow, knee = a + 0.04 * along(delta), a + 0.04 * along(epsilon - np.pi / 2)

scene = Scene(name="squeezer", gravity=0.0)
for name, mass, inertia, origin, angle, centre in (
    ("crank", 0.04325, 2.194e-6, (0, 0), beta, (0.00092, 0)),
    ("rod", 0.00365, 4.410e-7, pin, beta, (-0.0115, 0)),
    ("arm", 0.02373, 5.255e-6, b, gamma, (0.01874, 0.01043)),
    ("left link", 0.00706, 5.667e-7, elbow, phi + delta, (0, -0.00579)),
    ("left lever", 0.07050, 1.169e-5, a, delta, (0.02308, 0.00916)),
    ("right link", 0.00706, 5.667e-7, knee, omega + epsilon, (0.00579, 0)),
    ("right lever", 0.05498, 1.912e-5, a, epsilon, (0.01228, 0.00449)),
):
    scene.add_body(
        name=name, mass=mass, inertia=[inertia] * 3, position=(*origin, 0), center_of_mass=(*centre, 0),
        quaternion=(np.cos(angle / 2), 0, 0, np.sin(angle / 2)),
    )  # fmt: skip
for kind, first, second, point in (
    ("revolute", "ground", "crank", (0, 0)),
    ("revolute", "crank", "rod", pin),
    ("spherical", "rod", "arm", middle),
    ("spherical", "rod", "left link", middle),
    ("spherical", "rod", "right link", middle),
    ("revolute", "left lever", "left link", elbow),
    ("revolute", "right lever", "right link", knee),
    ("cylindrical", "ground", "arm", b),
    ("cylindrical", "ground", "left lever", a),
    ("cylindrical", "ground", "right lever", a),
):
    axis = {} if kind == "spherical" else {"axis": (0, 0, 1)}
    scene.add_joint(
        kind=kind, name=f"{first}-{second}", first=first, second=second, point=(*point, 0), **axis
    )
scene.add_spring(
    name="spring", first="ground", second="arm", first_point=(*c, 0), second_point=(0.02, -0.018, 0),
    stiffness=4530.0, natural_length=0.07785,
)  # fmt: skip
scene.add_actuator(joint="ground-crank", feed_forward=0.033)

result = simulate(scene, t_end=0.03, dt_out=1e-4, rtol=1e-7)
quaternion = result["quaternion"]
crank, rod, arm = 2 * np.unwrap(np.arctan2(quaternion[:, :3, 3], quaternion[:, :3, 0]), axis=0).T
for name, angle, published in zip(
    ("crank", "rod against crank", "arm"), (crank, rod - crank, arm), PUBLISHED, strict=True
):
    print(f"{name:18} {angle[-1]:14.9f} rad (published {published:.9f})")
print(f"constraint error   {result['constraint_error'].max():.1e} m or rad")

if len(sys.argv) > 1:
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots()
    axes.plot(1e3 * result.time, crank, label="crank")
    axes.plot(1e3 * result.time, 10 * arm, label="10 x arm")
    axes.set(xlabel="time [ms]", ylabel="angle [rad]")
    axes.legend()
    figure.savefig(Path(sys.argv[1]) / "andrews_squeezer.png")
