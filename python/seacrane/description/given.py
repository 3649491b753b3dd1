"""Which vessels of a scene float, and which have a motion that is given: nothing acts back on those."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from seacrane import _core
from seacrane.description.waves import calm_water
from seacrane.errors import SceneError

USUAL_SIZE = (100.0, 20.0, 5.0)  # m, of a ship whose size nobody gave

if TYPE_CHECKING:
    from seacrane.description.description import Description, Some


def floating_bodies(scene: Description) -> set[str]:
    """Bodies whose weight their restoring carries; others with hydrodynamics weigh as any body."""
    return {vessel.body for vessel in scene.vessels.values() if vessel.floats}


def given_vessels(scene: Description) -> dict[str, str]:
    """Kind of motion by the body: "raos", "history" or "rest"."""
    found = {}
    for vessel in scene.vessels.values():
        known = scene.provenance.get(vessel.name)
        if known is not None and known.motion is not None:
            found[vessel.body] = known.motion
    return found


def given_drivers(scene: Description) -> list[str]:
    """Names of the drivers that move given vessels."""
    led = tuple(f"{body}.motion." for body in given_vessels(scene))
    return [name for name in scene.drivers if name.startswith(led)]


def led_by(scene: Some, curves: Mapping[str, _core.Curve]) -> Some:
    """The scene with other curves of some drivers, by their names."""
    out = scene.copy()
    for name, curve in curves.items():
        out.drivers[name] = _core.Driver(**scene.drivers[name].__getstate__() | {"curve": curve})
    return out


def given_at_rest(scene: Some) -> Some:
    """The scene with its given vessels where they are described."""
    return led_by(scene, dict.fromkeys(given_drivers(scene), _core.Curve.constant(value=0.0)))


def in_calm_water(scene: Some) -> Some:
    """The scene without waves, and so without the motion of given vessels; a current flows on."""
    return given_at_rest(scene).copy(waves=calm_water(scene.waves))


def shown_size(scene: Description, body: str) -> tuple[float, float, float]:
    """Length, breadth and draught, m, of the ship that the light body of a given vessel stands for."""
    known = next(scene.provenance[v.name] for v in scene.vessels.values() if v.body == body)
    return known.size or USUAL_SIZE


def require_described(scene: Description, end: float) -> None:
    """Refuse a run to `end` (s) that is longer than the given motion of a ship.

    Raises
    ------
    SceneError
    """
    for vessel in scene.vessels.values():
        known = scene.provenance.get(vessel.name)
        if known is None or known.duration is None or end <= known.duration:
            continue
        way_out = (
            "give a longer history" if known.motion == "history"
            else f"give duration={end:g} to add_vessel"
        )  # fmt: skip
        raise SceneError(
            f"vessel {vessel.name!r}: its given motion ends at {known.duration:.6g} s, and the run at "
            f"{end:.6g} s; {way_out}, or end the run earlier"
        )
