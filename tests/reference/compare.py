"""Largest differences between a reference run and another one, quantity by quantity."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from .rotation import Array

BY_BODY = ("position", "velocity", "angular_velocity")
BY_JOINT = ("reaction_force", "reaction_moment")


def differences(
    reference: Mapping[str, Any], other: Mapping[str, Any], *, bodies: Sequence[str],
    joints: Sequence[str] = (),
) -> dict[str, float]:  # fmt: skip
    """Of every quantity that `other` holds; bodies and joints, in `other`'s order, are matched by name.
    `attitude` is the angle between the orientations, rad."""
    np.testing.assert_allclose(other["time"], reference["time"], rtol=0.0, atol=1e-9)
    out: dict[str, float] = {}
    for kind, names, order in (("body", BY_BODY, bodies), ("joint", BY_JOINT, joints)):
        if order:
            slots = [list(order).index(name) for name in reference["names"][kind]]
            for name in set(names) & set(other):
                out[name] = largest(reference[name] - np.asarray(other[name])[:, slots])
    if "quaternion" in other:
        slots = [list(bodies).index(name) for name in reference["names"]["body"]]
        out["attitude"] = attitude(reference["quaternion"], np.asarray(other["quaternion"])[:, slots])
    if "vessel_motion" in other:
        out["vessel_motion"] = largest(reference["vessel_motion"] - np.asarray(other["vessel_motion"]))
    return out


def largest(difference: Array) -> float:
    """Largest absolute entry; a value that is not finite counts as infinite."""
    return float(np.max(np.abs(np.nan_to_num(difference, nan=np.inf))))


def attitude(a: Array, b: Array) -> float:
    """Largest angle between unit quaternions, whatever their signs, rad."""
    apart = np.minimum(np.linalg.norm(a - b, axis=-1), np.linalg.norm(a + b, axis=-1))
    return float(4.0 * np.max(np.arcsin(np.minimum(0.5 * apart, 1.0))))
