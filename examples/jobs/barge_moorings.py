"""A ship on four elastic lines with pre-tension: periods of surge, sway, yaw, and a current's pull."""

import numpy as np

from seacrane import Scene, equilibrium, natural_modes, shipped_database, statics

SHIP, EA, PULL, FORCE = shipped_database(), 4e7, 4e5, 1e5  # -, N, N of pre-tension, N sideways
ENDS = [(side * 50.0, beam * 10.0, side * 150.0, beam * 110.0) for side in (1, -1) for beam in (1, -1)]  # m

scene = Scene(name="four lines")
scene.add_vessel(SHIP, mooring=None)
stiffness = np.zeros((3, 3))  # by hand: of surge, sway and yaw
for i, (x, y, far, off) in enumerate(ENDS):
    ends = {"bodies": ["ground", "vessel"], "points": [(far, off, 0.0), (x, y, 0.0)]}
    scene.add_line(f"line {i + 1}", **ends, EA=EA, tension_at_start=PULL)
    span = np.array([far - x, off - y])
    along = span / np.linalg.norm(span)
    loose = np.linalg.norm(span) / (1 + PULL / EA)
    axial = np.outer(along, along)
    pulls = EA / loose * axial + PULL / np.linalg.norm(span) * (np.eye(2) - axial)
    arm = np.array([[1.0, 0.0, -y], [0.0, 1.0, x]])  # motion of the fairlead
    stiffness += arm.T @ pulls @ arm
    stiffness[2, 2] += PULL * along @ (x, y)
plane = np.ix_([0, 1, 5], [0, 1, 5])
inertia = SHIP.mass_matrix[plane] + SHIP.zero_frequency_added_mass[plane]
modes = natural_modes(scene, state=equilibrium(scene))
found = np.sort([modes.natural_period[modes.find(f"vessel {name}")] for name in ("surge", "sway", "yaw")])
by_hand = np.sort(2 * np.pi / np.sqrt(np.linalg.eigvals(np.linalg.solve(inertia, stiffness)).real))
for one, hand in zip(found, by_hand, strict=True):
    print(f"period {one:6.2f} s, by hand {hand:6.2f} s")
scene.add_force("vessel", name="current", force=(0, FORCE, 0))
rest = statics(scene)
for i, (_, beam, *_) in enumerate(ENDS, 1):
    tension = rest[f"line tension line {i}"].item()
    hand = PULL - np.sign(beam) * EA * np.sqrt(0.5) * FORCE / stiffness[1, 1] / loose
    print(f"line {i} carries {tension / 1e3:.1f} kN, by hand {hand / 1e3:.1f} kN")
