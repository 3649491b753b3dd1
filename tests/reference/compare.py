"""Largest differences between a reference run and another one, quantity by quantity."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from .rotation import Array

BY_BODY = ("position", "velocity", "angular_velocity")
BY_JOINT = ("reaction_force", "reaction_moment")


def differences(
    reference: Mapping[str, Any],
    other: Mapping[str, Any],
    *,
    bodies: Sequence[str],
    joints: Sequence[str] = (),
) -> dict[str, float]:
    """Largest absolute difference of every quantity that both hold, bodies and joints matched by name.

    Parameters
    ----------
    reference : result of `simulate`.
    other : arrays named as in `simulate`, on the same times, with the given order of bodies and joints.

    Returns
    -------
    dict of quantity to difference; `attitude` is the angle between the orientations, rad.

    Raises
    ------
    ValueError if the times differ, a name is missing, or the two have nothing in common.
    """
    times = np.asarray(other["time"], dtype=float)
    if times.shape != reference["time"].shape or np.max(np.abs(times - reference["time"])) > 1e-9:
        raise ValueError("the two runs hold different times; ask both for the same output times")
    body_slots = slots(reference["names"]["body"], bodies)
    out: dict[str, float] = {}
    for name in BY_BODY:
        if name in other:
            out[name] = largest(reference[name] - np.asarray(other[name])[:, body_slots])
    if "quaternion" in other:
        out["attitude"] = attitude(reference["quaternion"], np.asarray(other["quaternion"])[:, body_slots])
    if joints:
        joint_slots = slots(reference["names"]["joint"], joints)
        for name in BY_JOINT:
            if name in other:
                out[name] = largest(reference[name] - np.asarray(other[name])[:, joint_slots])
    if "vessel_motion" in other and "vessel_motion" in reference:
        out["vessel_motion"] = largest(reference["vessel_motion"] - np.asarray(other["vessel_motion"]))
    if not out:
        raise ValueError(f"nothing to compare: the other run holds {sorted(other)}")
    return out


def slots(wanted: Sequence[str], names: Sequence[str]) -> list[int]:
    """Positions of the wanted names."""
    missing = [name for name in wanted if name not in names]
    if missing:
        raise ValueError(f"names {missing} are missing from {list(names)}")
    return [list(names).index(name) for name in wanted]


def largest(difference: Array) -> float:
    """Largest absolute entry; a value that is not finite counts as infinite."""
    return float(np.max(np.abs(np.nan_to_num(difference, nan=np.inf)))) if difference.size else 0.0


def attitude(a: Array, b: Array) -> float:
    """Largest angle between unit quaternions, whatever their signs, rad."""
    apart = np.minimum(np.linalg.norm(a - b, axis=-1), np.linalg.norm(a + b, axis=-1))
    return float(4.0 * np.max(np.arcsin(np.minimum(0.5 * apart, 1.0))))
