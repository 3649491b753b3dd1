"""add_immersed(): water on parts of a body."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.description.description import Description
from seacrane.description.forces import add_load
from seacrane.errors import SceneError
from seacrane.inputs.checked import name_of, not_negative_of
from seacrane.inputs.shown import shown
from seacrane.water.density import SEA_WATER, density_of
from seacrane.water.mesh_part import from_mesh
from seacrane.water.parts import PARTS, BoxPart, CylinderPart, Part, PlatePart, SpherePart, TablePart

Array = NDArray[np.float64]

MAKERS: Mapping[str, Callable[..., Part]] = {**PARTS, "mesh": from_mesh}
FARTHEST = 10.0  # sizes of a body, or of a part, beyond which a part is not on it


def add_immersed(
    scene: Description, body: str, *, parts: Sequence[Part | Mapping[str, Any]],
    density: float = SEA_WATER, wave_factor: float = 1.0, name: str | None = None,
) -> list[_core.ImmersedPart]:  # fmt: skip
    """Let water act on parts of a body: buoyancy, added mass, slam and drag of what is below the surface.

    The water is that of the scene's sea, its waves and its current; without one it is still, its surface at
    z = 0. The added mass of a part is a mass, which depends on its depth:
    it is taken into the body's own before accelerations are solved for, so that light bodies of great added
    mass do not become unstable. What slam takes is the state "<part>.slam_loss" (J); parts touch the water
    at the events "<part>.touch", and go under at "<part>.awash".

    Parameters
    ----------
    body : str
        Name of the body. Its weight stays as it is.
    parts : sequence
        `seacrane.water.BoxPart`, `PlatePart`, `CylinderPart`, `SpherePart` or `TablePart`, what
        `seacrane.water.from_mesh` makes, or tables {"kind": "box", ...} with their entries; of the kind
        "mesh" those of `from_mesh`.
    density : float
        kg/m3, of the water.
    wave_factor : float
        By which the waves of the sea are multiplied at the parts: what a hull beside makes of them. Before a
        wall it is 2, in a lee below 1. Beside a ship 1 is a `ScatteredWavesWarning`.
    name : str, optional
        Of the parts, "<name>.1", "<name>.2", ...; strips of one count on. Default: that of the body.

    Returns
    -------
    list of ImmersedPart
        One for each strip; none for a part of no size. Where its coefficients are from is its `source`.

    Raises
    ------
    SceneError
        For a body that is not there, a part far from it, bad numbers, and a density that is in t/m3.

    Notes
    -----
    F = density V (Du/Dt + g e_z) - A (a - Du/Dt) - s A' h' v - drag, s = 1 on entry and 0 on exit, with V and
    A of the depth h of the part's lowest point. Half of |A' h'| v^2 is lost both ways: with the jet, and with
    the water that is left behind. Volumes of boxes and cylinders are exact at any attitude, edges rounded
    by a thousandth.
    """
    owner = name_of("immersed parts", body)
    if owner not in scene.bodies:
        raise SceneError(f"immersed parts: there is no body {owner!r}; add it first")
    what = f"immersed parts of {owner!r}"
    label = owner if name is None else name_of("immersed parts", name)
    density_of(what, density)
    waves = not_negative_of(f"{what}: wave_factor", wave_factor)
    if isinstance(parts, Mapping | str) or not isinstance(parts, Sequence) or not parts:
        raise SceneError(f"{what}: parts is {shown(parts)}; give a list of parts of seacrane.water")
    made = [_part(what, one) for one in parts]
    for part in made:
        _check_place(what, scene.bodies[owner], part)
    out: list[_core.ImmersedPart] = []
    for number, part in enumerate(made, start=1):
        axes = np.asarray(part.axes, dtype=float)
        for piece in part.pieces(density):
            element = _core.ImmersedPart(
                name=f"{label}.{len(out) + 1}", body=owner, shape=piece.shape, axes=axes @ piece.turn,
                point=np.asarray(part.point, dtype=float) + axes @ piece.offset, size=piece.size,
                row=f"{label} part {number} row {piece.row + 1}" if piece.count > 1 else "",
                place=piece.place, count=piece.count, step=axes @ piece.step,
                fill=piece.fill, density=density, wave_factor=waves, depths=piece.depths,
                added_masses=piece.added_masses, volumes=piece.volumes, drag=piece.drag, source=part.sources,
                slow_added_masses=piece.slow_added_masses,
            )  # fmt: skip
            out.append(add_load(scene, element))
    return out


def _part(what: str, given: Any) -> Part:
    if isinstance(given, BoxPart | PlatePart | CylinderPart | SpherePart | TablePart):
        return given
    if not isinstance(given, Mapping):
        raise SceneError(f"{what}: parts holds {shown(given)}; give parts of seacrane.water")
    entries = dict(given)
    kind = entries.pop("kind", None)
    if kind not in MAKERS:
        raise SceneError(f"{what}: kind is {shown(kind)}; choose one of {', '.join(MAKERS)}")
    if "strips" in entries:  # numbers of a file
        given = entries["strips"]
        strips = [
            int(one) if isinstance(one, float) and one.is_integer() else one
            for one in (given if isinstance(given, Sequence) else [given])
        ]
        entries["strips"] = strips[0] if len(strips) == 1 else tuple(strips)
    try:
        return MAKERS[kind](**entries)
    except TypeError as error:
        raise SceneError(f"{what}: {error}") from None


def _check_place(what: str, body: _core.Body, part: Part) -> None:
    """Refuse a part that cannot be on its body: a slip in the unit, or in the body."""
    reach = float(np.sqrt(1.5 * np.trace(np.asarray(body.inertia)) / body.mass))  # of a box with that inertia
    point = np.asarray(part.point, dtype=float)
    apart = float(np.linalg.norm(point - np.asarray(body.center_of_mass)))
    size = max(2.0 * reach, part.extent)
    if apart > FARTHEST * size:
        raise SceneError(
            f"{what}: {part.kind} at {point.tolist()} m is {apart:.4g} m from the centre of mass, more than "
            f"{FARTHEST:g} times the size of body and part ({size:.4g} m); give metres in body coordinates"
        )
