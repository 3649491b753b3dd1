"""Points of contacts that start inside a surface, or are inside where a stage connects them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.description.given import beside_surface, borne_mass, elastic_force, welded_mass, with_mass
from seacrane.description.line_path import described_poses
from seacrane.errors import SceneError
from seacrane.inputs.caller import warn_caller
from seacrane.warnings import ContactStartWarning

if TYPE_CHECKING:
    from seacrane.description.description import Description

Array = NDArray[np.float64]
DEEP = 0.1  # m, as the core has it of what is described
CRUSHED = 10.0  # times the weight on a point, likewise
SHOT = 1.0  # m/s2, away from a surface: a tenth of the weight


def warn_of_contact_starts(scene: Description) -> None:
    """Warn of bodies that surfaces press away at once, as a scene is described."""
    contacts = [one for one in scene.loads.values() if isinstance(one, _core.Contact)]
    if not contacts:
        return
    pose = described_poses(scene)
    places = {one.name: [beside_surface(one, i, pose) for i in range(len(one.points))] for one in contacts}
    for body in with_mass(scene, *dict.fromkeys(one.body for one in contacts)):
        mass = welded_mass(scene, body)
        of_body = [one for one in contacts if one.body == body]
        total = np.array([0.0, 0.0, -mass * scene.gravity if scene.bodies[body].gravity else 0.0])
        for one in of_body:
            total += sum((elastic_force(one, -gap) * way for gap, way in places[one.name]), np.zeros(3))
        for one in of_body:
            _warn_of_shot(one, places[one.name], total / mass)


def _warn_of_shot(contact: _core.Contact, places: list[tuple[float, Array]], acceleration: Array) -> None:
    """Warn of the deepest point, where the body is pressed away from the surface there."""
    depth, way, point = max((-gap, tuple(way), i) for i, (gap, way) in enumerate(places))
    away = float(acceleration @ way)
    if depth <= 0.0 or away <= SHOT:
        return
    warn_caller(
        f"contact {contact.name!r}: point {point + 1} of {contact.body!r} starts {depth:.4g} m inside the "
        f"surface of {contact.on!r}, which presses the body away with {away:.3g} m/s2 at once: move the body "
        "out, or correct the place of the surface",
        ContactStartWarning,
    )


def check_contact_connected(
    title: str, scene: Description, name: str, measured: Mapping[str, Array], time: float
) -> None:
    """Refuse a contact that a stage connects at `time` (s) with a point deep inside."""
    contacts = {key: one for key, one in scene.loads.items() if isinstance(one, _core.Contact)}
    contact, count = contacts[name], len(contacts[name].points)
    before = sum(len(contacts[key].points) for key in list(contacts)[: list(contacts).index(name)])
    gaps = np.ravel(measured["contact_gap"])[before : before + count]
    worst = int(np.argmin(gaps))
    force = elastic_force(contact, -float(gaps[worst]))
    share = borne_mass(scene, contact.body, contact.on) * scene.gravity / count
    if -gaps[worst] <= DEEP or force <= CRUSHED * share:
        return
    raise SceneError(
        f"{title}: contact {name!r} connects with point {worst + 1} of {contact.body!r} "
        f"{-gaps[worst]:.4g} m inside {contact.on!r} at t = {time:.6g} s, where it is pressed out with "
        f"{force:.4g} N; connect it before the point is inside, or correct the place of the surface"
    )
