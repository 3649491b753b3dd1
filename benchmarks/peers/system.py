"""The ten-body system that every engine holds exactly: case 2 without memory, in ten cosines per motion.

Added mass: a rigid body of ten inertia parameters cannot hold a full 6 x 6 matrix, so every engine gets the
same entrained water instead: a mass of A33 at the hull's centre of mass with the moments A44, A55, A55 about
it (A66 beside A55 would be no mass distribution), without weight. All else (geometry, masses, gains,
restoring, station keeping, wave forces) is case 2.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from measure.records import scene_records

from seacrane import Scene, cases
from seacrane.inputs.frames import rotation_matrix

Array = NDArray[np.float64]

T_END, DT_OUT = 100.0, 1.0  # s
COMPONENTS = 10
COORDINATES = (
    "surge", "sway", "heave", "yaw", "pitch", "roll", "A", "B1", "B2", "main_cylinder", "C", "E1", "E2",
    "knuckle_cylinder", "F", "link1", "link2", "payload_yaw", "payload_pitch", "payload_roll",
)  # fmt: skip


def ten_body_scene(evaluation: str = "exact") -> Scene:
    """Case 2 with the entrained water as part of the hull's inertia, its feed-forward that of the start."""
    original = cases.case2(memory="none", count=COMPONENTS, evaluation=evaluation, feed_forward="start")
    (vessel,) = original.vessels.values()
    hull, added = original.bodies[vessel.body], np.asarray(vessel.added_mass)
    scene = original.copy(bodies={}, vessels={})
    scene.add_body(
        name=hull.name,
        mass=hull.mass + added[2, 2],
        inertia=hull.inertia + np.diag(np.diag(added)[[3, 4, 4]]),
        center_of_mass=hull.center_of_mass,
    )
    scene.bodies.update({name: body for name, body in original.bodies.items() if name != hull.name})
    scene.add_vessel(
        body=hull.name,
        added_mass=np.zeros((6, 6)),
        linear_damping=vessel.linear_damping,
        quadratic_damping=vessel.quadratic_damping,
        restoring=vessel.restoring,
        mooring_stiffness=vessel.mooring_stiffness,
        mooring_damping=vessel.mooring_damping,
        memory=[],
        kinematics=vessel.kinematics,
    )
    # By its own loads still; its added mass is the hull's.
    bare = scene.vessels[hull.name].__getstate__()
    scene.vessels[hull.name] = type(vessel)(**bare | {"database": vessel.database})
    return scene


def tree_data(scene: Scene) -> dict[str, Array]:
    """Named arrays of the same scene as a tree in the coordinates above, axes parallel to the inertial ones.

    `body NAME`: mass, centre of mass (3), inertia about it (9), at the start. `point NAME` and `axis NAME` of
    joints. The rest are the loads.
    """
    records = scene_records(scene)
    data: dict[str, Any] = {"gravity": [scene.gravity]}
    for body in records["bodies"]:
        turn = rotation_matrix(np.asarray(body["quaternion"]))
        inertia = turn @ np.asarray(body["inertia"]) @ turn.T
        data[f"body {body['name']}"] = [body["mass"], *body["position"], *inertia.ravel()]
    for joint in records["joints"]:
        for key in ("point", "axis", "second_axis", "second_point"):
            if key in joint:
                data[f"{key} {joint['name']}"] = joint[key]
    for actuator in records["actuators"]:
        curve = actuator["reference"]
        data[f"actuator {actuator['joint']}"] = [
            actuator["stiffness"], actuator["damping"], actuator["feedforward"],
            curve["t_start"], curve["t_end"], curve["start"], curve["end"],
        ]  # fmt: skip
    vessel, (force,) = records["vessel"], records["point_forces"]
    if np.any(vessel["added_mass"]) or vessel["quadratic_roll_damping"] or np.any(force["force"][:2]):
        raise ValueError("tree_data holds neither added mass, quadratic damping, nor horizontal forces")
    data |= {"lift": [force["force"][2], *force["point"]]}
    data |= {key: np.ravel(vessel[key]) for key in ("damping", "restoring")}
    data |= {f"mooring {key}": value for key, value in vessel["station_keeping"].items()}
    data |= {f"wave {key}": np.ravel(value) for key, value in vessel["waves"].items()}
    return {key: np.asarray(value, dtype=float) for key, value in data.items()}


def write_tree(scene: Scene, path: Path) -> None:
    """One line per array: key, tab, count, values; for the drivers."""
    lines = (
        f"{key}\t{values.size} " + " ".join(repr(float(value)) for value in values)
        for key, values in tree_data(scene).items()
    )
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
