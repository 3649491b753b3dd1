"""Water on parts of a body, and in its compartments."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from seacrane import _core
from seacrane.description.description import Description, require
from seacrane.description.elements import put_load
from seacrane.errors import SceneError
from seacrane.hydro.parts.density import SEA_WATER, density_of
from seacrane.hydro.parts.mesh_part import part_from_mesh
from seacrane.hydro.parts.parts import PARTS, Compartment, Part
from seacrane.inputs.checked import name_of
from seacrane.inputs.frames import rotation_matrix
from seacrane.inputs.shown import shown
from seacrane.inputs.values import made_of, told_by

MAKERS: Mapping[str, Callable[..., Part]] = {**PARTS, "mesh": part_from_mesh}
FARTHEST = 10.0  # sizes of a body, or of a part, beyond which a part is not on it
LARGEST_LEAN = np.radians(60.0)


@told_by(_core.ImmersedPart)
def add_immersed(
    scene: Description, body: str, *, parts: Sequence[Part | Mapping[str, Any]] = (),
    inside: Compartment | Mapping[str, Any] | None = None, density: float = SEA_WATER,
    wave_factor: float = 1.0, name: str | None = None,
) -> list[_core.ImmersedPart]:  # fmt: skip
    """Let water act on parts of a body, buoyancy, added mass, slam and drag, and let it into the body.

    The water is that of the scene's sea, its waves and its current; without one it is still, its surface at
    z = 0. The added mass of a part is a mass, which depends on its depth: it is taken into the body's own
    before accelerations are solved for, so that light bodies of great added mass do not become unstable. What
    slam takes is the state "<part>.slam_loss" (J); parts touch the water at the events "<part>.touch", and go
    under at "<part>.awash".

    The volume of the water in a compartment is the state "<water>.volume" (m3), what is lost in the openings
    "<water>.flow_loss" (J), air that is shut in "<water>.air" (m3 at 101,325 Pa), in the channel
    `load_state`. It is full at the event "<water>.full", empty at "<water>.empty"; at "<water>.leans" its
    axis is 30 deg from vertical.

    Parameters
    ----------
    body : str
        Name of the body. Its weight stays as it is.
    parts : sequence
        `seacrane.hydro.BoxPart`, `PlatePart`, `CylinderPart`, `SpherePart` or `TablePart`, what
        `seacrane.hydro.part_from_mesh` makes, or tables {"kind": "box", ...} with their entries; of the kind
        "mesh" those of `part_from_mesh`.
    inside : Compartment, optional
        That water comes into, and leaves, through openings; or its keywords. The body's mass and weight are
        without it.
    wave_factor : float
        By which the waves of the sea are multiplied at parts and openings: what a hull beside makes of them.
        Before a wall it is 2, in a lee below 1. Beside a ship 1 is a `ScatteredWavesWarning`.
    name : str, optional
        Of the parts, "<name>.1", "<name>.2", ...; strips of one count on. Default: that of the body.

    Returns
    -------
    list of ImmersedPart
        One for each strip; none for a part of no size. Where its coefficients are from is its `source`.

    Raises
    ------
    SceneError
        For a body that is not there, or leans by more than 60 deg with a compartment, a part far from it, bad
        numbers, a density in t/m3; when compiled, for a compartment outside its parts, or no word on its air.

    Notes
    -----
    F = density V (Du/Dt + g e_z) - A (a - Du/Dt) - s A' h' v - drag, s = 1 on entry and 0 on exit, with V and
    A of the depth h of the part's lowest point. Half of |A' h'| v^2 is lost both ways: with the jet, and with
    the water that is left behind. Volumes of boxes and cylinders are exact at any attitude, edges rounded
    by a thousandth.

    Of a compartment V' = sum of C_d A_o sign(dh) sqrt(2 g |dh|), with dh the head of the undisturbed sea over
    an opening less that of the water inside, each zero where the opening is above it, less that of the air.
    The root is rounded off over a head of 1 mm. The water is a mass with the body, a rod along the axis up to
    its surface; along the axis only what the bottom less its openings carries, and the lid once it is full.
    So is its weight. What comes in takes -density V' (v - u); what leaves keeps its velocity. The outer
    shape's buoyancy is that of the parts, with fill=1 for a compartment.
    """
    owner = require(scene, "immersed parts", "body", body)
    what = f"immersed parts of {owner!r}"
    label = owner if name is None else name_of("immersed parts", name)
    density_of(what, density)
    if isinstance(parts, Mapping | str) or not isinstance(parts, Sequence) or not (parts or inside):
        raise SceneError.of(f"{what}: parts", f"is {shown(parts)}; give a list of parts of seacrane.hydro")
    made = [_part(what, one) for one in parts]
    whole = scene.bodies[owner]
    reach = float(np.sqrt(1.5 * np.trace(np.asarray(whole.inertia)) / whole.mass))  # of a box of that inertia
    for part in made:
        place = np.asarray(part.point, dtype=float)
        apart = float(np.linalg.norm(place - np.asarray(whole.center_of_mass)))
        size = max(2.0 * reach, part.extent)
        if apart > FARTHEST * size:
            raise SceneError(
                f"{what}: {part.kind} at {place.tolist()} m is {apart:.4g} m from the centre of mass, more "
                f"than {FARTHEST:g} times the size of body and part ({size:.4g} m); give metres in body "
                "coordinates"
            )
    out: list[_core.ImmersedPart] = []
    for number, part in enumerate(made, start=1):
        axes = np.asarray(part.axes, dtype=float)
        for piece in part.pieces(density):
            element = _core.ImmersedPart(
                name=f"{label}.{len(out) + 1}", body=owner, shape=piece.shape, axes=axes @ piece.turn,
                point=np.asarray(part.point, dtype=float) + axes @ piece.offset, size=piece.size,
                row=f"{label} part {number} row {piece.row + 1}" if piece.count > 1 else "",
                place=piece.place, count=piece.count, step=axes @ piece.step,
                fill=piece.fill, density=density, wave_factor=wave_factor, depths=piece.depths,
                added_masses=piece.added_masses, volumes=piece.volumes, drag=piece.drag, source=part.sources,
                slow_added_masses=piece.slow_added_masses,
            )  # fmt: skip
            out.append(put_load(scene, element))
    if inside is not None:
        water = made_of(what, "inside", Compartment, inside)
        _let_in(scene, what, owner, water, density=density, wave_factor=wave_factor)
    return out


def _part(what: str, given: Any) -> Part:
    if isinstance(given, Part):
        return given
    if not isinstance(given, Mapping):
        raise SceneError.of(f"{what}: parts", f"holds {shown(given)}; give parts of seacrane.hydro")
    entries = dict(given)
    kind = entries.pop("kind", None)
    if kind not in MAKERS:
        raise SceneError.of(f"{what}: kind", f"is {shown(kind)}; choose one of {', '.join(MAKERS)}")
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


def _let_in(scene: Description, what: str, body: str, inside: Compartment, **sea: float) -> None:
    """Add the water of a compartment; SceneError for a body that leans too far as described."""
    lean = float(np.arccos(np.clip(rotation_matrix(scene.bodies[body].quaternion)[2, 2], -1.0, 1.0)))
    if lean > LARGEST_LEAN:
        raise SceneError(
            f"{what}: z of the body, a compartment's axis, leans by {np.degrees(lean):.3g} deg as described; "
            f"levels are right up to {np.degrees(LARGEST_LEAN):.3g} deg; turn its axes so that z is upright"
        )
    given: dict[str, Any] = {**vars(inside), **sea, "body": body, "air": inside.air_above}
    holes, given["name"] = given.pop("openings"), name_of("entrapped water", inside.name, f"water in {body}")
    points = np.array([np.asarray(hole.point, dtype=float) for hole in holes])
    areas = [float(hole.area) for hole in holes]
    put_load(scene, _core.EntrappedWater(**given, opening_points=points, opening_areas=areas))
