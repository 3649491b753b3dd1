"""Poses of a crane as values of its joint coordinates, and a scene that is led through them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.analysis.inverse import driven
from seacrane.description.crane_parts import luffing_ropes
from seacrane.description.description import Description, Some
from seacrane.description.elements import add_driver
from seacrane.description.hydraulic_cylinders import with_ideal_cylinders
from seacrane.description.places import ANGLES
from seacrane.description.roles import CraneRoles
from seacrane.description.waves import calm_water
from seacrane.errors import SceneError
from seacrane.inputs.checked import numbers_of

Array = NDArray[np.float64]
Place = tuple[str, str]
TURNING, SLIDING = 0.1, 0.2  # rad/s and m/s, at which a scene is led from pose to pose


def crane_of(scene: Description, prefix: str | None) -> CraneRoles:
    """The crane of a prefix, or the only one; SceneError where that is not clear."""
    if prefix is None and len(scene.roles) == 1:
        return next(iter(scene.roles.values()))
    known = ", ".join(map(repr, scene.roles)) or "none"
    if prefix is None:
        fix = "name one as crane" if scene.roles else "add one by add_crane, or tell its parts by add_roles"
        raise SceneError(f"scene {scene.name!r}: its cranes have prefixes {known}; {fix}")
    if prefix not in scene.roles:
        raise SceneError(f"crane {prefix!r}: is not in the scene, whose cranes have prefixes {known}")
    return scene.roles[prefix]


def places_of(roles: CraneRoles) -> dict[str, Place]:
    """Joint and coordinate of the slew drive, as "slew", and of every luff and cylinder by its label."""
    found = {} if roles.slew is None else {"slew": roles.slew}
    return (
        found
        | dict(roles.luffs)
        | {label: (joint, "displacement") for label, joint in roles.cylinders.items()}
    )


def drive_name(place: Place) -> str:
    """The name of the driver that holds a coordinate in a posed scene."""
    return f"{'.'.join(place)} posed"


def posed(scene: Some, places: Mapping[str, Place], path: Mapping[str, _core.Curve]) -> Some:
    """The scene without waves, all drives held, and the cranes' coordinates led along curves of time.

    Parameters
    ----------
    places : mapping of str to (str, str)
        Every coordinate of its cranes.
    path : mapping of str to Curve
        Some of them from their described value 0 on; the others are held.
    """
    out = driven(with_ideal_cylinders(scene)).copy(waves=calm_water(scene.waves))
    for rope in luffing_ropes(scene).values():  # its hinge is led; what it carries is told from the moment
        out.loads.pop(rope.name, None)
    still = _core.Curve.constant(value=0.0)
    for name, driver in list(out.drivers.items()):
        if (driver.joint, driver.coordinate) in places.values():
            del out.drivers[name]
    for label, (joint, coordinate) in places.items():
        curve = path.get(label, still)
        add_driver(out, joint=joint, coordinate=coordinate, curve=curve, name=drive_name((joint, coordinate)))
    return out


def path_through(
    places: Mapping[str, Place], poses: Sequence[Mapping[str, float]]
) -> tuple[dict[str, _core.Curve], Array]:
    """Curves from the described pose through others, slowly and in straight lines; and the times of these."""
    labels = list(dict.fromkeys(label for pose in poses for label in pose))
    values = np.array([[0.0] * len(labels), *([pose[label] for label in labels] for pose in poses)])
    speed = np.array([TURNING if places[label][1] in ANGLES else SLIDING for label in labels])
    spans = np.max(np.abs(np.diff(values, axis=0)) / speed, axis=1, initial=0.0)
    times = np.concatenate([[0.0], np.cumsum(spans)])
    curves = {label: _polyline(times, column) for label, column in zip(labels, values.T, strict=True)}
    return curves, times[1:]


def _polyline(times: Array, values: Array) -> _core.Curve:
    at, first = np.unique(times, return_index=True)
    if at.size == 1:
        return _core.Curve.constant(value=float(values[0]))
    return _core.Curve.table(at, values[first])


def values_of(what: str, given: Any) -> Array:
    """One finite number or a row of them; SceneError for anything else."""
    values = np.atleast_1d(numbers_of(what, given))
    if values.ndim != 1 or not values.size or not np.all(np.isfinite(values)):
        raise SceneError(f"{what} has shape {values.shape}; give a finite number, or a row of them")
    return values
