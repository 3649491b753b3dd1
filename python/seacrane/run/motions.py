"""Relative motions of points, angles of bodies, hook speeds and wire paid out, out of the core's channels."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from seacrane.description.channels import DERIVED
from seacrane.description.loads import lines_of, winches_of
from seacrane.description.places import relative_motion, velocity_of
from seacrane.description.suspension import lower_ends
from seacrane.inputs.frames import rotation_matrix

if TYPE_CHECKING:
    from seacrane.description.description import Description

Array = NDArray[np.float64]
LENGTH = "line_unstretched_length"


def motions(
    scene: Description, arrays: Mapping[str, Array], asked: Collection[str] | None
) -> dict[str, Array]:
    """The channels of this file that are asked for (None: all) and whose parts the core recorded."""
    made = {
        "relative_position": (bool(scene.relatives), _relative_positions),
        "relative_velocity": (bool(scene.relatives), _relative_velocities),
        "heel": (bool(scene.bodies), _heel),
        "trim": (bool(scene.bodies), _trim),
        "yaw": (bool(scene.bodies), _yaw),
        "hook_speed": (bool(lower_ends(scene)), _hook_speeds),
        "wire_paid_out": (bool(winches_of(scene.loads)), _paid_out),
        "wire_spare": (bool(winches_of(scene.loads)), _spare),
    }
    return {
        name: make(scene, arrays)
        for name, (there, make) in made.items()
        if there and (asked is None or name in asked) and all(one in arrays for one in _parts(name))
    }


def _parts(name: str) -> tuple[str, ...]:
    return DERIVED[name].made_of


def _relative_positions(scene: Description, arrays: Mapping[str, Array]) -> Array:
    return _relative(scene, arrays, velocity=False)


def _relative_velocities(scene: Description, arrays: Mapping[str, Array]) -> Array:
    return _relative(scene, arrays, velocity=True)


def _relative(scene: Description, arrays: Mapping[str, Array], *, velocity: bool) -> Array:
    return np.stack(
        [
            relative_motion(scene, arrays, one.point, one.to, one.axes, velocity=velocity)
            for one in scene.relatives.values()
        ],
        axis=1,
    )


def _heel(_: Description, arrays: Mapping[str, Array]) -> Array:
    turn = rotation_matrix(arrays["quaternion"])
    return np.asarray(np.arctan2(turn[..., 2, 1], turn[..., 2, 2]))


def _trim(_: Description, arrays: Mapping[str, Array]) -> Array:
    return np.asarray(np.arcsin(np.clip(-rotation_matrix(arrays["quaternion"])[..., 2, 0], -1.0, 1.0)))


def _yaw(_: Description, arrays: Mapping[str, Array]) -> Array:
    turn = rotation_matrix(arrays["quaternion"])
    return np.asarray(np.arctan2(turn[..., 1, 0], turn[..., 0, 0]))


def _hook_speeds(scene: Description, arrays: Mapping[str, Array]) -> Array:
    return np.stack([velocity_of(scene, arrays, *end)[:, 2] for end in lower_ends(scene)], axis=1)


def _paid_out(scene: Description, arrays: Mapping[str, Array]) -> Array:
    return _lengths(scene, arrays, [float(one.length.evaluate([0.0])[0, 0]) / one.share
                                    for one in winches_of(scene.loads).values()])  # fmt: skip


def _spare(scene: Description, arrays: Mapping[str, Array]) -> Array:
    return _lengths(scene, arrays, [one.minimum_length for one in winches_of(scene.loads).values()])


def _lengths(scene: Description, arrays: Mapping[str, Array], over: list[float]) -> Array:
    """Unstretched lengths of the lines on winches over given ones, m."""
    lines, wound = list(lines_of(scene.loads)), winches_of(scene.loads).values()
    own = arrays[LENGTH][:, [lines.index(one.name) for one in wound]] / [one.share for one in wound]
    return np.asarray(own - over)
