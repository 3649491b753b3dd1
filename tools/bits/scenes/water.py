"""Loads in the water: parts that go through the surface, and water that they hold."""

from __future__ import annotations

import numpy as np

from bits.case import by, case
from bits.scenes.parts import G, with_load
from seacrane import Scene
from seacrane.hydro import BoxPart, Compartment, CylinderPart, Opening, PlatePart, SpherePart
from seacrane.sea import Current


def into_waves() -> Scene:
    """A load that falls on a wire through the surface."""
    scene = with_load((0, 0, 1.2), mass=9e3, velocity=(0.2, 0, -1.0))
    current = Current(depth=0.0, speed=0.8, direction_deg=20.0)
    scene.add_sea(
        vessel=None, hs=1.0, tp=5.0, count=20, seed=3, direction_deg=30.0, gamma=2.0, current=current
    )
    scene.add_line(
        name="hoist", bodies=["ground", "load"], points=[(0, 0, 20.0), (0, 0, 1.0)], EA=2e6,
        tension_at_start=9e3 * G,
    )  # fmt: skip
    scene.add_winch(line="hoist", rate=0.8)
    return scene


@case(by("dopri5"), by("cvode-bdf", "redundant"))
def immersed_parts() -> Scene:
    scene = into_waves()
    scene.add_immersed(
        "load",
        parts=[
            BoxPart(size=(4, 2, 2), strips=(2, 1), fill=0.3, perforation=0.2, slam=5.0),
            PlatePart(size=(1.5, 1.2), thickness=0.02, slam=5.0, point=(-1.5, 0, -1.2)),
            SpherePart(diameter=0.8, point=(0, 0.6, -1.4)),
            CylinderPart(diameter=0.5, length=2.0, point=(1.5, 0, -1.3)),
        ],
        wave_factor=1.2,
    )
    return scene


@case(by("dopri5"), by("rosenbrock", rtol=1e-4))
def entrapped_water() -> Scene:
    """A suction anchor that fills as it goes down, with a skirt in the water."""
    scene = into_waves()
    holes = [Opening(point=(0, 0, -1.5), area=0.8), Opening(point=(0.5, 0, 1.5), area=0.05)]
    inside = Compartment(name="inside", area=np.pi, height=3.0, point=(0, 0, -1.5), openings=holes)
    scene.add_immersed("load", parts=[BoxPart(size=(2, 2, 3))], inside=inside)
    return scene


@case(by("dopri5"), by("rk4", "redundant", dt=0.01))
def seen_by_few() -> Scene:
    """Strips that go through the surface of a sea of 200 components, drawn along it from region to region."""
    scene = with_load((0, 0, 0.8), mass=60e3, velocity=(4.0, 0, -0.5))
    scene.add_sea(vessel=None, hs=1.5, tp=6.0, seed=5, direction_deg=20.0)
    scene.add_line(
        name="hoist", bodies=["ground", "load"], points=[(0, 0, 30.0), (0, 0, 1.0)], EA=4e6,
        tension_at_start=50e3 * G,
    )  # fmt: skip
    scene.add_immersed("load", parts=[BoxPart(size=(8, 3, 2), strips=(6, 1), fill=0.2, slam=5.0)])
    return scene
