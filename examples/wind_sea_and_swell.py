"""A short-crested wind sea with swell from the side: what each does to the vessel, and how the surface looks.

Usage: python wind_sea_and_swell.py [FOLDER FOR A PICTURE]
"""

import sys
from pathlib import Path

import numpy as np

from seacrane import Scene, SeaState, WaveSystem, linear_model
from seacrane.analysis import response_summed
from seacrane.hydro import shipped_database
from seacrane.sea import cos_2s, jonswap

wind = WaveSystem(
    spectrum=jonswap(hs=1.8, tp=6.5, gamma="dnv"), direction_deg=180.0, spreading=cos_2s(6.0), name="wind sea"
)
swell = WaveSystem(
    spectrum=jonswap(hs=1.0, tp=13.0, gamma=5.0), direction_deg=250.0, spreading=cos_2s(40.0), name="swell"
)
head_on = WaveSystem(spectrum=wind.spectrum, direction_deg=180.0, name="wind sea, long-crested")

scene = Scene(name="vessel")
scene.add_vessel(shipped_database())
linear = linear_model(scene)
print("standard deviation over infinite time         heave [m]  roll [deg]  pitch [deg]")
for systems in ([head_on], [wind], [swell], [wind, swell]):
    scene.waves = None  # a scene has one sea at a time
    scene.add_sea(sea=SeaState(systems=systems, seed=1))
    std = response_summed(linear, waves=scene.waves, body="vessel").std
    name = " + ".join(system.name for system in systems)
    print(f"{name:44}{std[2]:11.3f}{np.degrees(std[3]):12.3f}{np.degrees(std[4]):13.3f}")

sea = SeaState(systems=[wind, swell], seed=1).realise()
print(f"Hs {sea.hs:.3f} m, Tz {sea.tz:.2f} s, {len(sea.waves)} components:", end=" ")
print(", ".join(f"{system.name} {system.hs:.3f} m" for system in sea.systems))
under = scene.sea_at(points={f"{z:g} m": (0.0, 0.0, -z) for z in (1.0, 10.0, 30.0)}, times=[10.0]).velocity[0]
print("speed of the water 1, 10 and 30 m below, m/s:", np.round(np.linalg.norm(under, axis=1), 3))

if len(sys.argv) > 1:
    import matplotlib.pyplot as plt

    omega = np.linspace(0.2, 2.5, 500)
    figure, (left, right) = plt.subplots(1, 2, figsize=(11.0, 4.5), width_ratios=(1.0, 1.15))
    for system in (wind, swell):
        left.plot(omega, system.spectrum.density(omega), label=system.name)
    left.set(xlabel="frequency [rad/s]", ylabel="spectrum [m$^2$ s/rad]", xlim=(0.2, 2.5), ylim=(0.0, None))
    left.legend()
    place = np.linspace(-250.0, 250.0, 161)
    surface = sea.waves.elevation(0.0, x=place, y=place[:, None])
    image = right.pcolormesh(place, place, surface, cmap="RdBu_r", vmin=-2.0, vmax=2.0, shading="gouraud")
    for system in (wind, swell):
        along = np.array([np.cos(np.radians(system.direction_deg)), np.sin(np.radians(system.direction_deg))])
        right.annotate("", xytext=(0.0, 0.0), xy=150.0 * along, arrowprops={"color": "black", "width": 1.0})
        right.text(
            *(200.0 * along), system.name, ha="center", va="center", bbox={"color": "white", "alpha": 0.8}
        )
    right.set(xlabel="x [m]", ylabel="y [m]", aspect="equal")
    figure.colorbar(image, ax=right, label="elevation [m]")
    figure.tight_layout()
    figure.savefig(Path(sys.argv[1]) / "wind_sea_and_swell.png", dpi=130)
