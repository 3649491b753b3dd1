"""A description compiled into the core's model, and what closing its joints changed of it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.arrays import Array
from seacrane.description.description import SETTINGS, Description, all_loads
from seacrane.description.holding import with_holds
from seacrane.description.loads import changed, lines_of, refuse_winch_of_segment
from seacrane.description.once import forgetting, once
from seacrane.description.places import start_pose
from seacrane.description.rungs import AUTO, ELASTIC
from seacrane.description.waves import ByHeading, HullLoads, Waves
from seacrane.description.wet_parts import (
    refuse_contradictions_in_water,
    refuse_outside_parts,
    refuse_seabeds,
    refuse_unsaid_air,
)
from seacrane.errors import SceneError
from seacrane.inputs.alike import alike
from seacrane.inputs.caller import silently, warn_caller
from seacrane.inputs.checked import name_of, number_of, text_of
from seacrane.inputs.frames import rotation_matrix
from seacrane.inputs.read_only import ReadOnly
from seacrane.warnings import AssemblyWarning, RedundantJointsWarning

LARGEST_MOVE = 0.01  # m times the scene's length scale: a tenth of the length that tolerances refer to
MOST_MOVE = 1.0  # m: however large the scale
LARGEST_TURN = 0.01  # rad: the angle that they refer to
LARGEST_SHARE = 0.01  # of a velocity that was described
NAMED = 3
LOADED = ("transfer", "force_by_heading", "drift", "drift_by_heading")  # of a hull, over the components


def moves(scene: Description, model: _core.Model) -> list[tuple[str, float, float]]:
    """Bodies that assembly moved beyond 0.01 m (times the length scale) or 0.01 rad, most first, each with
    m of its centre of mass (of the reference point of a vessel) and rad."""
    found = model.assembly
    limit = min(LARGEST_MOVE * scene.length_scale, MOST_MOVE)
    if found["largest_translation_m"] <= limit and found["largest_rotation_rad"] <= LARGEST_TURN:
        return []
    out = []
    for name, body in scene.bodies.items():
        described = rotation_matrix(body.quaternion)
        centre, turn = start_pose(scene, model, name)
        moved = _length(centre[0] - body.position - described @ body.center_of_mass)
        turned = float(np.arccos(np.clip((np.trace(turn[0] @ described.T) - 1.0) / 2.0, -1.0, 1.0)))
        if moved > limit or turned > LARGEST_TURN:
            out.append((name, moved, turned))
    return sorted(out, key=lambda move: -max(move[1] / limit, move[2] / LARGEST_TURN))


def velocities(scene: Description, model: _core.Model) -> list[tuple[str, float, float]]:
    """Bodies described as moving whose velocity assembly changed by more than a hundredth of it, and by how
    much: m/s of the origin, rad/s."""
    if model.assembly["largest_velocity_change"] == 0.0:
        return []
    out = []
    twists = np.asarray(model.initial_state)[model.twist_index(0) :][: 6 * len(scene.bodies)].reshape(-1, 6)
    floating = {vessel.body for vessel in scene.vessels.values()}
    for (name, body), twist in zip(scene.bodies.items(), twists, strict=True):
        lever = np.zeros(3) if name in floating else rotation_matrix(body.quaternion) @ body.center_of_mass
        speed, turning = _length(body.velocity), _length(body.angular_velocity)
        slower = _length(twist[:3] - np.cross(twist[3:], lever) - body.velocity)
        turned = _length(twist[3:] - body.angular_velocity)
        arm = 1.0 if turning == 0.0 else max(speed / turning, 1.0)
        if slower + arm * turned > LARGEST_SHARE * (speed + arm * turning) and speed + turning > 0.0:
            out.append((name, slower, turned))
    return out


def _length(vector: Array) -> float:
    return float(np.linalg.norm(vector))


def warn_of_moves(scene: Description, model: _core.Model) -> None:
    """Warn, at the user's line, of what `moves` and `velocities` find."""
    moved, changed = moves(scene, model), velocities(scene, model)
    if moved:
        named = [f"body {name!r} by {m:.4g} m and {rad:.4g} rad" for name, m, rad in moved]
        opened = [f"{name!r} by {gap:.4g}" for name, gap in model.assembly["open"]]
        warn_caller(
            f"scene {scene.name!r}: closing its joints moved {_few(named)} from where they are described; as "
            f"described these are open, m or rad: {_few(opened)}. Describe the bodies where they start, or "
            "let drivers start at the described pose (0 for a joint given by point and axis)",
            AssemblyWarning,
        )
    if changed:
        named = [f"body {name!r} by {v:.4g} m/s and {w:.4g} rad/s" for name, v, w in changed]
        warn_caller(
            f"scene {scene.name!r}: its joints do not allow the described velocities: {_few(named)} changed; "
            "give every body that moves along its velocity and angular velocity",
            AssemblyWarning,
        )


def _few(items: list[str]) -> str:
    more = len(items) - NAMED
    return ", ".join(items[:NAMED]) + (f" and {more} more" if more > 0 else "")


def without_negligible(waves: Waves) -> Waves:
    """The same sea without its smallest components.

    Components are left out, smallest first, while the magnitudes of all that are left out stay below
    `waves.negligible` times the sum of the magnitudes of all, in each of the six loads on every vessel, in
    the elevation and in the slow drift. The first two can then never differ by more, at any time; slow drift,
    a product of two sums, to first order. At least one component stays.

    Raises ValueError if `negligible` is no number from 0 to 0.1.
    """
    kept = kept_components(waves)
    if kept.all():
        return waves
    (places,) = kept.nonzero()

    def fewer(owner: Any, *keys: str) -> dict[str, Any]:
        held = {key: one for key in keys if (one := getattr(owner, key)) is not None}
        return {
            key: alike(one, values=np.asarray(one.values).take(places, axis=1)) if isinstance(one, ByHeading)
            else np.asarray(one).take(places, axis=0)
            for key, one in held.items()
        }  # fmt: skip

    hulls = {body: alike(hull, **fewer(hull, *LOADED)) for body, hull in waves.hulls.items()}
    return alike(waves, **fewer(waves, "omega", "amplitude", "phase", "direction"), hulls=ReadOnly(hulls))


def kept_components(waves: Waves) -> NDArray[np.bool_]:
    """Which components `without_negligible` keeps; all of them where one is not finite."""
    limit = number_of("negligible", waves.negligible)
    if not 0.0 <= limit <= 0.1:
        raise ValueError(f"negligible is {limit}; give a share from 0 to 0.1, such as 1e-9")
    return _core.without_smallest(_magnitudes(waves), limit)


def _magnitudes(waves: Waves) -> Array:
    """What each component adds at most, (n, channels)."""
    amplitude = np.abs(np.asarray(waves.amplitude, dtype=float))[:, None]
    columns = [amplitude]
    for hull in waves.hulls.values():
        force, drift = hull.force_by_heading, hull.drift_by_heading
        columns.append(amplitude * np.abs(np.asarray(hull.transfer)))
        # Slow drift multiplies two sums of sqrt(D) a: leaving out a share of one changes it by twice that.
        if hull.drift is not None:
            columns.append(2.0 * amplitude * np.sqrt(np.abs(np.asarray(hull.drift))))
        if force is not None:
            columns.append(amplitude * np.abs(np.asarray(force.values)).max(axis=0))
        if drift is not None:
            columns.append(2.0 * amplitude * np.sqrt(np.abs(np.asarray(drift.values)).max(axis=0)))
    return np.concatenate(columns, axis=1)


def compile_scene(scene: Description, *, merge: bool = True) -> _core.Model:
    """What `Scene.compile` does, without its look at what capsizes; its docstring says what is raised."""
    return _compiled(scene, merge)


@once
def _compiled(scene: Description, merge: bool) -> _core.Model:
    scene = with_holds(scene)
    refuse_unsaid_air(scene)
    sea = None if scene.waves is None else pruned(scene.waves, prune=merge)
    for line in lines_of(scene.loads).values():
        if line.winch and not line.paid_out_by:
            refuse_winch_of_segment(line)
    loads = [  # the core knows no "auto"
        changed(load, rung=ELASTIC) if isinstance(load, _core.Line) and load.rung == AUTO else load
        for load in all_loads(scene)
    ]
    settings: dict[str, Any] = {
        key: number_of(f"scene {scene.name!r}: {key}", getattr(scene, key)) for key in SETTINGS
    }
    settings |= {"wave_loads": []} if sea is None else water_of(sea)
    model = _core.compile(
        name=name_of("scene", scene.name),
        orientation=text_of(f"scene {scene.name!r}: orientation", scene.orientation), **settings,
        bodies=list(scene.bodies.values()), joints=list(scene.joints.values()),
        drivers=list(scene.drivers.values()), loads=loads, vessels=list(scene.vessels.values()),
        groups=list(scene.groups.values()),
        coordinates=[(name, *place) for name, place in scene.recorded.items()],
        points=list(scene.points.values()), merge=merge,
    )  # fmt: skip
    refuse_contradictions_in_water(scene)
    refuse_outside_parts(scene)
    warn_of_moves(scene, model)
    if model.redundant:
        warn_caller(
            f"scene {scene.name!r}: constraints of {', '.join(model.redundant)} are redundant "
            f"({model.constraints - model.assembly['rank']} more than needed); motion is unique, these "
            "reactions are not: the minimum-norm ones are given",
            RedundantJointsWarning,
        )
    model.compiled_from = (forgetting(scene.copy()), merge)
    return model


def compiled_in_sea(scene: Description, model: _core.Model) -> _core.Model:
    """The model of a scene, which belongs to it from now on, from that of the same scene in another sea.

    SceneError for a sea on other vessels than the model's, loads at another kind of position, or a sea of
    another depth than a seabed.
    """
    assert scene.waves is not None
    _, merge = model.compiled_from
    out = model.in_sea(**water_of(pruned(scene.waves, prune=merge)))
    refuse_seabeds(scene)
    out.compiled_from = (scene, merge)
    return out


def compiled(scene: Description, merge: bool) -> _core.Model:
    """The model of a scene: how a pickled model comes back."""
    with silently():  # given when it was compiled first
        return compile_scene(scene, merge=merge)


def pruned(waves: Waves, *, prune: bool = True) -> Waves:
    """The sea without the components that are negligible; raises SceneError for values that make no sense."""
    with _told_of(*waves.hulls):
        return without_negligible(waves) if prune else waves


@contextmanager
def _told_of(*bodies: str) -> Iterator[None]:
    """Values that make no sense are a SceneError about the waves."""
    try:
        yield
    except (TypeError, ValueError) as error:
        raise SceneError(f"waves on {', '.join(map(repr, bodies)) or 'no vessel'}: {error}") from error


def field_of(waves: Waves, components: _core.WaveComponents | None = None) -> _core.SeaField:
    """What moving points see of a sea; raises SceneError for values that make no sense."""
    with _told_of(*waves.hulls):
        return _core.SeaField(components or waves.components(), stretching=waves.stretching)


def water_of(waves: Waves) -> dict[str, Any]:
    """A sea and its loads for the compiled core; SceneError for shapes or values that make no sense."""
    found = []
    with _told_of(*waves.hulls):
        sea = waves.components()
    for body, hull in waves.hulls.items():
        name = f"waves on {text_of('waves: body', body)}"
        with _told_of(body):
            loads = (_mean if hull.force_by_heading is None else _positioned)(waves, hull, sea)
            found.append(_core.WaveLoads(name=name, body=body, **loads))
    return {"wave_loads": found, "sea": field_of(waves, sea)}


def _positioned(waves: Waves, hull: HullLoads, sea: _core.WaveComponents) -> dict[str, Any]:
    force, drift = hull.force_by_heading, hull.drift_by_heading
    if force is None or (hull.drift is not None and drift is None):
        raise ValueError("drift at the actual position needs drift_by_heading")
    slow: dict[str, Any] = {}
    if drift is not None:
        slow = {"drift_headings": np.asarray(drift.heading).tolist(), "drift": drift.values}
    positioned = _core.PositionedWaveLoad(
        sea, headings=np.asarray(force.heading).tolist(), transfer=force.values,
        cutoff=hull.cutoff, **slow,
    )  # fmt: skip
    return {"positioned": positioned}


def _mean(waves: Waves, hull: HullLoads, sea: _core.WaveComponents) -> dict[str, Any]:
    position, bound = hull.position, waves.relative_bound
    exact = _core.ExactWaveLoad(sea, transfer=hull.transfer, position=position, elevation_point=position)
    loads: dict[str, Any] = {"exact": exact}
    if waves.evaluation == "table":
        loads["table"] = _core.WaveTable(exact, relative_bound=bound)
    if hull.drift is not None:
        loads["drift"] = drift = _core.DriftLoad(sea, coefficient=hull.drift, position=position)
        if waves.evaluation == "table":
            loads["drift_table"] = _core.DriftTable(drift, relative_bound=bound)
    return loads
