"""Scenes with less physics: another fluid memory, fewer waves, a locked crane, a prescribed vessel."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.channel_names import LINK
from seacrane.errors import SceneError
from seacrane.inverse import SIX, _hold, driven
from seacrane.scene import Scene
from seacrane.vessel import MEMORY, add_vessel

if TYPE_CHECKING:
    from seacrane.hydro import HydroDatabase

Array = NDArray[np.float64]
FULL, LOCKED, PRESCRIBED, WEIGHT, LINEAR = (
    "full", "crane locked", "vessel prescribed", "payload as weight", "frequency domain",
)  # fmt: skip
SHARES = (0.5, 0.25)  # of the wave components, the strongest
BOUND = 1e-4  # of a coarse wave table


@dataclass(frozen=True, kw_only=True)
class Variant:
    """A scene that differs from the full one in one thing."""

    memory: str
    waves: str
    rung: str
    scene: Scene


def memory_name(scene: Scene) -> str:
    """Kind of fluid memory of a scene."""
    return str(scene.notes.get("memory", "none" if not scene.vessels else "as described"))


def waves_name(scene: Scene) -> str:
    """How a scene evaluates its waves."""
    if scene.waves is None:
        return "none"
    return "exact" if not scene.waves.relative_bound else scene.waves.evaluation


def variants(scene: Scene, database: HydroDatabase | None, *, quick: bool) -> Iterator[Variant]:
    """Scenes with one thing changed: memory models, wave evaluations, rungs of coupling."""
    memory, waves = memory_name(scene), waves_name(scene)
    for kind in MEMORY if scene.vessels else ():
        if kind == memory or (quick and kind == "convolution"):
            continue
        if kind != "none" and database is None:
            continue
        yield Variant(memory=kind, waves=waves, rung=FULL, scene=with_memory(scene, kind, database))
    for name, changed in _wave_variants(scene, quick=quick):
        yield Variant(memory=memory, waves=name, rung=FULL, scene=changed)
    if scene.actuators:
        yield Variant(memory=memory, waves=waves, rung=LOCKED, scene=locked(scene))
        if scene.vessels:
            yield Variant(memory=memory, waves=waves, rung=PRESCRIBED, scene=scene)
    if hanging(scene):
        yield Variant(memory=memory, waves=waves, rung=WEIGHT, scene=scene)
    if scene.waves is not None and scene.vessels:
        yield Variant(memory=memory, waves=waves, rung=LINEAR, scene=scene)


def with_memory(scene: Scene, kind: str, database: HydroDatabase | None) -> Scene:
    """The scene with another fluid memory of its one vessel; the added mass is that of the memory's fit."""
    (vessel,) = scene.vessels.values()
    changes: dict[str, Any] = {"memory": []}
    if database is not None:
        fresh = Scene(name="memory", gravity=scene.gravity)
        add_vessel(fresh, database, name=vessel.body, memory=kind, kinematics=vessel.kinematics)
        (fitted,) = fresh.vessels.values()
        changes = {"memory": fitted.memory, "added_mass": fitted.added_mass}
    out = scene.copy()
    out.vessels[vessel.name] = _changed(vessel, **changes)
    out.notes["memory"] = kind
    return out


def _changed(vessel: _core.VesselHydrodynamics, **changes: Any) -> _core.VesselHydrodynamics:
    kept = ("name", "body", "added_mass", "linear_damping", "quadratic_damping", "restoring",
            "mooring_stiffness", "mooring_damping", "memory", "kinematics")  # fmt: skip
    return _core.VesselHydrodynamics(**{**{name: getattr(vessel, name) for name in kept}, **changes})


def _wave_variants(scene: Scene, *, quick: bool) -> Iterator[tuple[str, Scene]]:
    waves = scene.waves
    if waves is None:
        return
    if waves.force_by_heading is None:
        if waves_name(scene) != "exact":
            yield "exact", scene.copy(waves=replace(waves, evaluation="exact"))
        if not quick:
            coarse = replace(waves, evaluation="table", relative_bound=BOUND)
            yield f"table bound {BOUND:g}", scene.copy(waves=coarse)
    if waves.force_by_heading is None and waves.drift is None:
        for share in SHARES:
            count = int(np.ceil(share * len(waves.omega)))
            yield f"{count} of {len(waves.omega)} components", scene.copy(waves=strongest(waves, count))


def strongest(waves: Any, count: int) -> Any:
    """The sea of the components with the largest load on any motion, relative to that motion's largest."""
    load = np.abs(np.asarray(waves.transfer)) * np.abs(waves.amplitude)[:, None]
    largest = load.max(axis=0)
    share = (load / np.where(largest > 0.0, largest, 1.0)).max(axis=1)
    kept = np.sort(np.argsort(-share, kind="stable")[:count])
    parts = {
        name: np.asarray(getattr(waves, name))[kept] for name in ("omega", "amplitude", "phase", "direction")
    }
    return replace(waves, transfer=np.asarray(waves.transfer)[kept], **parts)


def locked(scene: Scene) -> Scene:
    """Every actuated coordinate held at its described value."""
    held = {
        name: _core.Curve.constant(value=float(actuator.reference.evaluate([0.0])[0, 0]))
        for name, actuator in scene.actuators.items()
    }
    return driven(scene, references=held)


def with_prescribed_vessel(scene: Scene, times: Array, motion: Array) -> Scene:
    """The vessel's six motions (n, 6) prescribed; nothing acts back on it.

    Raises
    ------
    SceneError
        For a scene of several vessels.
    """
    if len(scene.vessels) != 1:
        raise SceneError(f"scene {scene.name!r}: has {len(scene.vessels)} vessels; one is prescribed")
    from seacrane.curves import spline_curve

    (vessel,) = scene.vessels.values()
    out = scene.copy(waves=None)
    out.vessels[vessel.name] = _changed(vessel, memory=[])
    curves = {name: spline_curve(times=times, values=motion[:, i]) for i, name in enumerate(SIX)}
    _hold(out, vessel.body, curves)
    return out


def hanging(scene: Scene) -> bool:
    """Whether a payload hangs on a link and on nothing else."""
    if LINK not in scene.joints or scene.joints[LINK].kind != "distance":
        return False
    payload = scene.joints[LINK].second
    others = [joint for name, joint in scene.joints.items() if name != LINK]
    elements = [*scene.point_forces.values(), *scene.force_tables.values(), *scene.function_forces.values(),
                *scene.loads.values()]  # fmt: skip
    return not (
        any(payload in (joint.first, joint.second) for joint in others)
        or any(payload in (spring.first, spring.second) for spring in scene.springs.values())
        or any(getattr(element, "body", None) == payload for element in elements)
    )


def payload_as_weight(scene: Scene) -> Scene:
    """The payload replaced by its constant weight at the tip: neither swing nor inertia."""
    joint = scene.joints[LINK]
    out = scene.copy()
    payload = out.bodies.pop(joint.second)
    del out.joints[LINK]
    out.add_point_force(
        name="payload weight",
        body=joint.first,
        point=joint.first_frame.point,
        force=(0.0, 0.0, -payload.mass * scene.gravity),
    )
    return out
