"""How fast a crane's tip moves up and down in five seas: linear model, runs of three hours, and by hand."""

from dataclasses import replace

import numpy as np

from seacrane import Scene, response_statistics, shipped_database, simulate
from seacrane.hydro import motion_response
from seacrane.sea import jonswap

SHIP, HEADING, START, END = shipped_database(), np.pi, 600.0, 11400.0  # -, rad, s, s
SEAS = ((1.0, 6.0), (1.5, 7.0), (2.0, 8.0), (2.5, 10.0), (3.0, 12.0))  # m, s
scene = Scene(name="tip")
scene.add_vessel(SHIP)
tip = scene.add_crane(slew=-np.pi / 2, s1=1.0, s2=2.0, held=True).tip
(ballast,) = scene.add_ballast().forces

# By hand: the crane's bodies are point masses on a rigid ship, and what carries them pulls at one point.
mass, restoring, g = SHIP.mass_matrix.copy(), SHIP.restoring.copy(), scene.gravity
bodies = [(scene.place_of(body=key, point=one.center_of_mass), one.mass) for key, one in scene.bodies.items()]
for (x, y, z), one in bodies[1:]:
    point = np.hstack([np.eye(3), [[0, z, -y], [-z, 0, x], [y, -x, 0]]])  # of a turning ship
    mass += one * point.T @ point
    restoring[[3, 4], [3, 4]] -= one * g * z
restoring[[3, 4], [3, 4]] += ballast.force[2] * ballast.point[2]
at, omega = np.abs(np.asarray(SHIP.heading) - HEADING).argmin(), np.asarray(SHIP.omega)
motion = motion_response(replace(SHIP, mass_matrix=mass, restoring=restoring))[at]
x, y, _ = scene.place_of("tip")
rate = np.abs(omega * (motion[:, 2] + y * motion[:, 3] - x * motion[:, 4]))  # m/s per m of wave
for hs, tp in SEAS:
    spectrum = jonswap(hs=hs, tp=tp)
    linear = response_statistics(scene, spectrum=spectrum, direction=HEADING, body=tip[0], point=tip[1])
    scene.waves = None
    scene.add_sea(hs=hs, tp=tp, direction_deg=180.0, count=300)
    run = simulate(scene, t_end=END, dt_out=0.5, channels=["tip_velocity"])
    std = run.curve("tip_velocity[z]")[run.time > START].std()
    hand = np.sqrt(np.trapezoid(rate**2 * spectrum.density(omega), omega))
    model = np.sqrt(linear.moments[2, 1])
    print(f"Hs {hs} m, Tp {tp:4} s: {2 * std:.3f} m/s, linear {2 * model:.3f}, by hand {2 * hand:.3f}")
