"""Parts of bodies in the water, as `add_immersed` described them: what they displace, how deep they are."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

import numpy as np

from seacrane import _core
from seacrane.arrays import Array
from seacrane.description.description import Description
from seacrane.description.given import floating_bodies, given_vessels, welded_to
from seacrane.description.once import once_in_any_sea
from seacrane.description.places import place_in, placed, position_of
from seacrane.errors import SceneError
from seacrane.inputs.frames import rotation_matrix
from seacrane.sea.dispersion import wavenumber

SLACK = 0.01  # of sizes and volumes, between a compartment and what is around it
STATIONS = 9  # along a compartment
LARGEST_DIFFERENCE = 0.05  # of a sea's wavenumbers, weighed by energy, between two depths
LEVEL = 0.999  # cosine of a seabed's normal with the vertical


def immersed_parts(scene: Description) -> dict[str, _core.ImmersedPart]:
    """By name."""
    return {name: load for name, load in scene.loads.items() if isinstance(load, _core.ImmersedPart)}


def waters_in(scene: Description) -> list[_core.EntrappedWater]:
    """Compartments that water comes into."""
    return [load for load in scene.loads.values() if isinstance(load, _core.EntrappedWater)]


def wet_bodies(scene: Description) -> set[str]:
    """Bodies with parts in water, or with compartments."""
    parts = {part.body for part in immersed_parts(scene).values()}
    return parts | {water.body for water in waters_in(scene)}


def sources_in_water(scene: Description) -> list[str]:
    """Where the coefficients of parts are from, once for each body."""
    parts = immersed_parts(scene).values()
    return list(dict.fromkeys(f"{part.body}: {part.source or 'unverified'}" for part in parts))


def displaced_volume(part: _core.ImmersedPart) -> float:
    """m3 that a part keeps water out of, where it is under water."""
    size = np.asarray(part.size, dtype=float)
    volumes = {
        "box": np.prod(size), "cylinder": np.pi / 4.0 * size[0] * size[1] ** 2, "disc": 0.0,
        "sphere": np.pi / 6.0 * size[0] ** 3,
    }  # fmt: skip
    whole = volumes.get(part.shape)
    return float(part.fill * (np.asarray(part.volumes)[-1] if whole is None else whole))


def buoyancy_of(scene: Description, bodies: Iterable[str]) -> float:
    """N on bodies that are under water."""
    held = set(bodies)
    parts = [part for part in immersed_parts(scene).values() if part.body in held]
    return scene.gravity * sum(part.density * displaced_volume(part) for part in parts)


def water_in(scene: Description, bodies: Iterable[str]) -> float:
    """N, the weight of the water in the compartments of bodies that are under water: at the least."""
    held = set(bodies)
    return scene.gravity * sum(_least_water(one) for one in waters_in(scene) if one.body in held)


def _least_water(one: _core.EntrappedWater) -> float:
    """kg in a compartment under water: what air that is shut in leaves of it at first."""
    return float(one.density * (one.initial if one.air == "shut" else one.area * one.height))


def refuse_unsaid_air(scene: Description) -> None:
    """Refuse a compartment of which neither an opening in its lid nor a word tells where its air goes."""
    for one in waters_in(scene):
        if not one.air:
            raise SceneError(
                f"entrapped water {one.name!r}: no opening is in its lid, {one.height:.6g} m over its bottom,"
                " and nothing says where its air goes; give air='shut' and exponent=1.0 to 1.4 for a lid that"
                " is shut, air='free' for air that comes and goes, or an opening in the lid"
            )


def refuse_outside_parts(scene: Description) -> None:
    """Refuse a compartment that parts of its body, or of what is welded to it, do not keep water out of."""
    for body in dict.fromkeys(water.body for water in waters_in(scene)):
        waters = [one for one in waters_in(scene) if one.body == body]
        holds, rigid = sum(one.area * one.height for one in waters), welded_to(scene, body)
        parts = [part for part in immersed_parts(scene).values() if part.body in rigid]
        keeps = sum(map(displaced_volume, parts))
        own = [part for part in parts if part.body == body]
        outside = [one for one in waters if len(own) == len(parts) and not _within(one, own)]
        if outside or holds > (1.0 + SLACK) * keeps:
            raise SceneError(
                f"entrapped water {(outside or waters)[0].name!r} is outside the parts of {body!r}: these "
                f"displace {keeps:.6g} m3, and {holds:.6g} m3 come in; give `add_immersed` the outer shape "
                "there, with fill=1, so that the water in it is not weighed as if it were lifted into air"
            )


def _within(water: _core.EntrappedWater, parts: Iterable[_core.ImmersedPart]) -> bool:
    """Whether the axis of a compartment is in the boxes around parts."""
    heights = water.height * np.linspace(SLACK, 1.0 - SLACK, STATIONS)
    axis = np.asarray(water.point) + heights[:, None] * np.array([0.0, 0.0, 1.0])
    inside = np.zeros(STATIONS, dtype=bool)
    for part in parts:
        local = (axis - np.asarray(part.point)) @ np.asarray(part.axes)
        half = (0.5 + SLACK) * np.asarray(part.size)
        inside |= np.all(np.abs(local) <= np.where(half > 0.0, half, np.inf), axis=1)
    return bool(inside.all())


def half_height(part: _core.ImmersedPart, turn: Array) -> Array:
    """From the centre of a part down to its lowest point, m (...), with its axes in columns (..., 3, 3)."""
    size, up = np.asarray(part.size, dtype=float), np.abs(turn[..., 2, :])
    if part.shape == "box":
        return np.asarray(0.5 * up @ size)
    if part.shape in ("cylinder", "disc"):
        across = np.sqrt(np.maximum(1.0 - up[..., 0] ** 2, 0.0))
        length = size[0] if part.shape == "cylinder" else 0.0
        return np.asarray(0.5 * (length * up[..., 0] + size[1] * across))
    return np.full(turn.shape[:-2], 0.5 * size[2])


def _heights(
    scene: Description, arrays: Mapping[str, Array], part: _core.ImmersedPart
) -> tuple[Array, Array]:
    """Of the centre of a part over z = 0, and from its lowest point to there, m, (time,)."""
    turn = rotation_matrix(arrays["quaternion"][:, place_in(scene, part.body)]) @ np.asarray(part.axes)
    return position_of(scene, arrays, part.body, part.point)[:, 2], half_height(part, turn)


def carried_by_water(scene: Description, arrays: Mapping[str, Array], bodies: Iterable[str]) -> Array:
    """N on bodies of parts that are wholly below z = 0, less the water in compartments there, (time,)."""
    held = set(bodies)
    total = np.zeros(len(arrays["position"]))
    for part in immersed_parts(scene).values():
        if part.body in held:
            height, half = _heights(scene, arrays, part)
            total += np.where(height + half < 0.0, scene.gravity * part.density * displaced_volume(part), 0.0)
    for one in waters_in(scene):
        if one.body in held:
            top = np.asarray(one.point) + np.array([0.0, 0.0, one.height])
            under = position_of(scene, arrays, one.body, top)[:, 2] < 0.0
            total -= np.where(under, scene.gravity * _least_water(one), 0.0)
    return total


@once_in_any_sea
def wet_names(scene: Description) -> Mapping[str, tuple[str, ...]]:
    """Names along `immersed`: bodies with parts, each with the names of these; then the parts."""
    parts = immersed_parts(scene)
    found: dict[str, tuple[str, ...]] = {}
    for name, part in parts.items():
        found[part.body] = (*found.get(part.body, ()), name)
    return found | {name: (name,) for name in parts if name not in found}


def immersed_depths(scene: Description, arrays: Mapping[str, Array]) -> Array | None:
    """Depths of lowest points below z = 0, m, (time, immersed); None without parts, or without poses."""
    parts = immersed_parts(scene)
    if not parts or not {"position", "quaternion"} <= set(arrays):
        return None
    heights = {name: _heights(scene, arrays, part) for name, part in parts.items()}
    depths = {name: half - height for name, (height, half) in heights.items()}
    return np.stack([np.max([depths[one] for one in of], axis=0) for of in wet_names(scene).values()], axis=1)


def starts_wet(scene: Description, part: _core.ImmersedPart) -> tuple[float, float]:
    """How deep the top and the lowest point of a part are below z = 0 as described, m."""
    turn = rotation_matrix(scene.bodies[part.body].quaternion) @ np.asarray(part.axes)
    depth, half = -float(placed(scene, part.body, part.point)[2]), float(half_height(part, turn))
    return depth - half, depth + half


def refuse_contradictions_in_water(scene: Description) -> None:
    """SceneError for parts of hulls that float, and for a sea of another depth than a seabed."""
    hulls = floating_bodies(scene) - set(given_vessels(scene))  # which go as they are given
    for part in immersed_parts(scene).values() if hulls else ():
        if part.body in hulls and displaced_volume(part) > 0.0 and starts_wet(scene, part)[1] > 0.0:
            raise SceneError(
                f"immersed part {part.name!r}: displaces {displaced_volume(part):.4g} m3 as a part of "
                f"{part.body!r}, which floats by its restoring: what the hull displaces is in that already. "
                "Take it without volume for its drag and added mass alone (a box with fill=0, a table with "
                "volumes of 0), or put what is no part of that hull on a body of its own, welded to it"
            )
    refuse_seabeds(scene)


def refuse_seabeds(scene: Description) -> None:
    """SceneError for a sea of another depth than a seabed."""
    waves, seabeds = scene.waves, {depth: what for what, depth in _seabeds(scene)}
    if not seabeds or waves is None or not np.any(waves.amplitude):
        return
    energy = np.abs(np.asarray(waves.amplitude)) ** 2
    omega = np.asarray(waves.omega, dtype=float)
    known = wavenumber(omega, g=scene.gravity, depth=waves.depth)
    for depth, what in seabeds.items():
        there = wavenumber(omega, g=scene.gravity, depth=depth)
        difference = float((energy * np.abs(there / known - 1.0)).sum() / energy.sum())
        if difference > LARGEST_DIFFERENCE:
            sea = "of infinite depth" if np.isinf(waves.depth) else f"{waves.depth:g} m deep"
            raise SceneError(
                f"{what}: lies {depth:g} m below z = 0, and the sea is {sea}: wavenumbers differ by "
                f"{difference:.0%}. Give the sea the depth of the place (SeaState(depth={depth:g}), with a "
                "database of that depth where a vessel has one)"
            )


def _seabeds(scene: Description) -> Iterator[tuple[str, float]]:
    """Level planes of the ground below z = 0, with their depths, m."""
    for name, load in scene.loads.items():
        if isinstance(load, _core.SeabedNode):
            yield f"seabed of {name.removesuffix(' seabed')!r}", float(load.depth)
        elif isinstance(load, _core.Contact) and load.surface == "plane" and load.on not in scene.bodies:
            level, depth = np.asarray(load.axes)[2, 2] > LEVEL, -float(load.place[2])
            if level and depth > 0.0:
                yield f"contact {name!r}", depth
