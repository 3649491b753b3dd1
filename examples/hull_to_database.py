"""From the offsets of a barge to hydrostatics, a hydrodynamic database, and its motions in a sea.

Usage: python hull_to_database.py [FOLDER FOR A PICTURE]
"""

import sys
import warnings
from pathlib import Path

import numpy as np

from seacrane import Scene, response_statistics
from seacrane.hydro import Hull, OffsetTable, hydro_from_hull, natural_frequency
from seacrane.sea import jonswap
from seacrane.warnings import BelowBandWarning

# Half sections, deck to keel (y, z in m above the keel), of a 90 x 24 m barge with raked ends.
box = [(12.0, 6.0), (12.0, 1.5), (10.5, 0.0), (0.0, 0.0)]
rake = [(12.0, 6.0), (12.0, 5.5), (10.5, 4.0), (0.0, 4.0)]
stations = [-45.0, -30.0, 30.0, 45.0]
table = OffsetTable(x=stations, sections=(rake, box, box, rake), name="barge")
hull = Hull.from_offsets(table, draught=4.5).at_centre_of_buoyancy()
statics = hull.hydrostatics
print(f"volume {statics.volume:.0f} m3, wetted surface {statics.wetted_surface:.0f} m2")
print(f"GM {statics.metacentric_height(5.0):.2f} m with the centre of gravity 5 m above the waterline")

database = hydro_from_hull(hull, center_of_gravity=[0.0, 0.0, 5.0], roll_damping_fraction=0.05)
for motion, name in ((2, "heave"), (3, "roll"), (4, "pitch")):
    frequency = natural_frequency(database, motion)
    if frequency is not None:
        print(f"natural period in {name:5} {2.0 * np.pi / frequency:5.2f} s")

# Strip theory radiates too much in waves longer than the barge: for a decision take method="capytaine" above.
warnings.simplefilter("ignore", BelowBandWarning)
scene = Scene(name="barge")
scene.add_vessel(database)
print("\nHs 2 m, Tp 8 s: significant double amplitudes")
for degrees in (180.0, 135.0, 90.0):
    found = response_statistics(
        scene, spectrum=jonswap(hs=2.0, tp=8.0), direction=np.radians(degrees), body="vessel"
    ).significant_double_amplitude
    roll, pitch = np.degrees(found[3:5])
    print(f"{degrees:5.0f} deg: heave {found[2]:.2f} m, roll {roll:.2f} deg, pitch {pitch:.2f} deg")

if len(sys.argv) > 1:
    import matplotlib.pyplot as plt

    figure, (left, right) = plt.subplots(1, 2, figsize=(9.0, 3.6), layout="constrained")
    for station in hull.sections(np.linspace(*hull.extent[:, 0], 13)):
        y, z = station.section.T
        left.plot(np.append(y, -y[::-1]), np.append(z, z[::-1]), color="black", linewidth=0.8)
    left.set(xlabel="y [m]", ylabel="z [m]", aspect="equal")
    for motion, name in ((1, "sway"), (2, "heave")):
        right.plot(database.omega, database.damping[:, motion, motion], label=name)
    right.set(xlabel="frequency [rad/s]", ylabel="damping [kg/s]")
    right.legend()
    figure.savefig(Path(sys.argv[1]) / "hull_to_database.png")
