"""Rods of fixed length in place of hydraulic cylinders, and the forces that they hold with."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.description.description import Description, Some
from seacrane.description.elements import add_joint
from seacrane.description.holding import decided
from seacrane.description.hydraulic_cylinders import hydraulic_cylinders
from seacrane.description.loads import without_compensation
from seacrane.description.places import ORIGIN, apart, placed

Array = NDArray[np.float64]
ENDS = ("first", "second", "first_point", "second_point")


def ends_of(cylinder: _core.HydraulicCylinder) -> dict[str, Any]:
    """Name, bodies and points of a cylinder."""
    return {key: getattr(cylinder, key) for key in ("name", *ENDS)}


def without_cylinders(scene: Some) -> Some:
    """The scene without its hydraulic cylinders, and without the compensators that they follow."""
    scene = decided(scene)
    there = hydraulic_cylinders(scene)
    loads = without_compensation(scene.loads)
    return scene.copy(loads={name: load for name, load in loads.items() if name not in there})


def add_rod(scene: Description, given: Mapping[str, Any], length: float | None = None) -> None:
    """Add a rod between the ends of a cylinder; its length (m) is that of the described pose by default."""
    ends = [(given[end], given.get(f"{end}_point", ORIGIN)) for end in ("first", "second")]
    first, second = (placed(scene, *end) for end in ends)
    if length is None:
        length = apart(scene, f"hydraulic cylinder {given['name']!r}", *ends)
    add_joint(
        scene, kind="distance", name=_rod(given["name"]), first=given["first"], second=given["second"],
        point=first, second_point=second, length=length,
    )  # fmt: skip


def rod_forces(scene: Description, model: _core.Model, state: _core.State) -> dict[str, float]:
    """N, positive pushes, of the rods in a scene at one of its states, by the cylinder."""
    run = _core.Simulation(
        model=model,
        start=_core.State(time=state.time, values=state.values, inputs=np.zeros(model.slots)),
        options=_core.RunOptions(integrator="rk4", output_times=[state.time], channels={"tension"}),
    )
    ties = [name for name, joint in scene.joints.items() if joint.kind == "distance"]
    tension = dict(zip(ties, run.channels()["tension"][0].tolist(), strict=True))
    return {_cylinder(name): -force for name, force in tension.items() if name == _rod(_cylinder(name))}


def _rod(cylinder: str) -> str:
    return f"{cylinder} held"


def _cylinder(rod: str) -> str:
    return rod.removesuffix(" held")
