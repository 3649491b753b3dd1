"""What closing the joints changed of a description: bodies moved and velocities, told when it matters."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.description.joint_coordinates import Jointed, start_pose
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.frames import rotation_matrix
from seacrane.warnings import AssemblyWarning

Array = NDArray[np.float64]
LARGEST_MOVE = 0.01  # m times the scene's length scale: a tenth of the length that tolerances refer to
MOST_MOVE = 1.0  # m: however large the scale
LARGEST_TURN = 0.01  # rad: the angle that they refer to
LARGEST_SHARE = 0.01  # of a velocity that was described
NAMED = 3


def moves(scene: Jointed, model: _core.Model) -> list[tuple[str, float, float]]:
    """Bodies that assembly moved beyond 0.01 m (times the length scale) or 0.01 rad, most first.

    Returns
    -------
    list of (str, float, float)
        Name, m of the centre of mass (of the reference point of a vessel), rad.
    """
    found = model.assembly
    limit = min(LARGEST_MOVE * scene.length_scale, MOST_MOVE)
    if found["largest_translation_m"] <= limit and found["largest_rotation_rad"] <= LARGEST_TURN:
        return []
    out = []
    for name, body in scene.bodies.items():
        described = rotation_matrix(body.quaternion)
        centre, turn = start_pose(scene, model, name)
        moved = float(np.linalg.norm(centre[0] - body.position - described @ body.center_of_mass))
        turned = float(np.arccos(np.clip((np.trace(turn[0] @ described.T) - 1.0) / 2.0, -1.0, 1.0)))
        if moved > limit or turned > LARGEST_TURN:
            out.append((name, moved, turned))
    return sorted(out, key=lambda move: -max(move[1] / limit, move[2] / LARGEST_TURN))


def velocities(scene: Jointed, model: _core.Model) -> list[tuple[str, float, float]]:
    """Bodies described as moving whose velocity assembly changed by more than a hundredth of it.

    Returns
    -------
    list of (str, float, float)
        Name, and by how much: m/s of its origin, rad/s.
    """
    if model.assembly["largest_velocity_change"] == 0.0:
        return []
    out = []
    twists = np.asarray(model.initial_state)[model.twist_index(0) :][: 6 * len(scene.bodies)].reshape(-1, 6)
    floating = {vessel.body for vessel in scene.vessels.values()}
    for (name, body), twist in zip(scene.bodies.items(), twists, strict=True):
        lever = np.zeros(3) if name in floating else rotation_matrix(body.quaternion) @ body.center_of_mass
        speed, turning = _length(body.velocity), _length(body.angular_velocity)
        slower = _length(twist[:3] - np.cross(twist[3:], lever) - body.velocity)
        turned = _length(twist[3:] - body.angular_velocity)
        arm = 1.0 if turning == 0.0 else max(speed / turning, 1.0)
        if slower + arm * turned > LARGEST_SHARE * (speed + arm * turning) and speed + turning > 0.0:
            out.append((name, slower, turned))
    return out


def _length(vector: Array) -> float:
    return float(np.linalg.norm(vector))


def warn_of_moves(scene: Jointed, model: _core.Model) -> None:
    """Warn, at the user's line, of what `moves` and `velocities` find."""
    moved, changed = moves(scene, model), velocities(scene, model)
    if moved:
        named = [f"body {name!r} by {m:.4g} m and {rad:.4g} rad" for name, m, rad in moved]
        opened = [f"{name!r} by {gap:.4g}" for name, gap in model.assembly["open"]]
        warn_caller(
            f"scene {scene.name!r}: closing its joints moved {_few(named)} from where they are described; as "
            f"described these are open, m or rad: {_few(opened)}. Describe the bodies where they start, or "
            "let drivers start at the described pose (0 for a joint given by point and axis)",
            AssemblyWarning,
        )
    if changed:
        named = [f"body {name!r} by {v:.4g} m/s and {w:.4g} rad/s" for name, v, w in changed]
        warn_caller(
            f"scene {scene.name!r}: its joints do not allow the described velocities: {_few(named)} changed; "
            "give every body that moves along its velocity and angular velocity",
            AssemblyWarning,
        )


def _few(items: list[str]) -> str:
    more = len(items) - NAMED
    return ", ".join(items[:NAMED]) + (f" and {more} more" if more > 0 else "")
