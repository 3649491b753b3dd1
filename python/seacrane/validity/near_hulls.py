"""Parts of a load beside a ship in a sea: the waves that she scatters and makes are not in their water."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.description.given import floating_bodies
from seacrane.description.once import once
from seacrane.description.outline import size_of_ship
from seacrane.description.places import placed
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.frames import rotation_matrix
from seacrane.validity.hull_range import peak_of
from seacrane.warnings import ScatteredWavesWarning

if TYPE_CHECKING:
    from seacrane.description.description import Description

Array = NDArray[np.float64]
DEEP = np.pi  # of wavenumber times depth: 4 % of the wave are left


@once
def warn_of_parts_near_hulls(scene: Description) -> None:
    """Warn, once for each ship, of the part that starts nearest to its side, within its breadth."""
    if scene.waves is None or not np.any(scene.waves.amplitude):
        return
    ships = floating_bodies(scene)
    parts = [
        one for one in scene.loads.values() if isinstance(one, _core.ImmersedPart) and one.wave_factor == 1.0
    ]
    places = {one.name: placed(scene, one.body, one.point) for one in parts if one.body not in ships}
    deepest = -DEEP / peak_of(scene).wavenumber if places else 0.0
    places = {name: place for name, place in places.items() if place[2] > deepest}
    for ship in sorted(ships) if places else ():
        length, breadth = size_of_ship(scene, ship)
        away = {name: _beside(scene.bodies[ship], place, length, breadth) for name, place in places.items()}
        nearest = min(away, key=lambda name: away[name])
        if away[nearest] < breadth:
            warn_caller(
                f"immersed part {nearest!r}: starts {away[nearest]:.3g} m from the side of {ship!r}, within "
                f"its breadth of {breadth:.3g} m, in a sea. The water that it feels has neither the waves "
                "that the hull scatters nor those that it makes: before a wall waves are twice as high, in a "
                "lee lower. Give wave_factor what this hull makes of them",
                ScatteredWavesWarning,
            )


def _beside(hull: _core.Body, place: Array, length: float, breadth: float) -> float:
    """Horizontal distance of a place from the box of a hull, m; 0 within it."""
    x, y, _ = rotation_matrix(hull.quaternion).T @ (place - np.asarray(hull.position))
    return float(np.hypot(max(abs(x) - 0.5 * length, 0.0), max(abs(y) - 0.5 * breadth, 0.0)))
