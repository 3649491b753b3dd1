"""Scenes and references that the tests of the linear model share."""

from __future__ import annotations

import numpy as np
from reference.linear_vessel import LinearVessel
from reference.vessel import MemoryModel

from seacrane import Scene, cases
from seacrane.analysis.rest_state import held
from seacrane.crane import Payload
from seacrane.hydro import shipped_database, vessel_parameters
from seacrane.hydro.data.rigid_mass import rigid_mass_matrix


def reference_vessel(scene: Scene) -> LinearVessel:
    """The vessel alone from its matrices, without any linearisation."""
    p, element = vessel_parameters(shipped_database()), scene.vessels["vessel"]
    damping, restoring = np.array(element.linear_damping), np.array(element.restoring)
    for k, i in enumerate((0, 1, 5)):
        damping[i, i] += element.mooring_damping[k]
        restoring[i, i] += element.mooring_stiffness[k]
    blocks = [
        {"inputs": b.inputs, "outputs": b.outputs, "A": b.a, "B": b.b, "C": b.c, "D": b.d}
        for b in element.memory
    ]
    mass = rigid_mass_matrix(p.mass, p.center_of_mass, p.inertia) + np.array(element.added_mass)
    return LinearVessel(mass, damping, restoring, MemoryModel.from_record({"blocks": blocks}))


def rod(scene: Scene, name: str, first: str, top: float, *, angle: float = 0.0, damping: float = 0.0) -> None:
    """A uniform rod of 2 m and 3 kg hanging from a hinge about y at height `top`."""
    direction = np.array([-np.sin(angle), 0.0, -np.cos(angle)])
    scene.add_body(name, mass=3.0, inertia=(1.0, 1.0, 0.01), position=np.array([0.0, 0.0, top]) + direction,
                   quaternion=(np.cos(angle / 2.0), 0.0, np.sin(angle / 2.0), 0.0))  # fmt: skip
    point = (0.0, 0.0, top)
    scene.add_joint(f"{name}.hinge", kind="revolute", first=first, second=name, point=point, axis=(0, 1, 0))
    if damping:
        scene.add_actuator(f"{name}.hinge", damping=damping)


def crane_with_payload() -> Scene:
    """The crane on the ground with its payload, held by the controllers of the cases."""
    scene = Scene(name="crane on the ground")
    scene.add_crane(base="ground", payload=Payload())
    scene.actuators.update(held(cases.case2(hs=0.0)).actuators)
    return scene
