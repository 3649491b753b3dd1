"""Scenes with less physics: another fluid memory, fewer waves, lines on another rung, a locked crane, a
prescribed vessel."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import lru_cache, partial
from typing import TYPE_CHECKING, Any, cast

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.analysis.inverse import SIX, driven, hold_vessel
from seacrane.description.crane_parts import hooks
from seacrane.description.curves import spline_curve
from seacrane.description.given import given_vessels
from seacrane.description.loads import bodies_of, lines_of, path_of
from seacrane.description.places import place_of
from seacrane.description.provenance import VesselProvenance
from seacrane.description.rungs import AUTO, ELASTIC, QUASI_STATIC, with_rungs
from seacrane.description.waves import HullLoads, calm_water
from seacrane.errors import SceneError
from seacrane.hydro import HydroDatabase, fit_memory
from seacrane.scene.scene import Scene

if TYPE_CHECKING:
    from seacrane.hydro.data.memory_model import MemoryModel

Array = NDArray[np.float64]
Build = Callable[[], Scene]
FULL, LOCKED, PRESCRIBED, WEIGHT, LINEAR = (
    "full", "crane locked", "vessel prescribed", "payload as weight", "frequency domain",
)  # fmt: skip
RIGID_LINES = "lines rigid"
LINE_RUNGS = (RIGID_LINES, f"lines {QUASI_STATIC}", f"lines {ELASTIC}")
SHARES = (0.5, 0.25)  # of the wave components, the strongest
BOUND = 1e-4  # of a coarse wave table
FITTED = {  # what fits of a kind are asked for, each level for more states, and what a vessel's own has
    "by-motion": ("limit", (0.05, 0.02, 0.01), 0.01),
    "per-pair": ("r2", (0.9, 0.95, 0.99, 0.999), 0.99),
}


def memory_name(scene: Scene) -> str:
    """Kind of fluid memory of a scene."""
    known = [scene.provenance.get(name, VesselProvenance()).memory for name in scene.vessels]
    kinds = [kind or "as described" for kind in known]
    return ", ".join(dict.fromkeys(kinds)) or "none"


def waves_name(scene: Scene) -> str:
    """How a scene evaluates its waves."""
    if scene.waves is None:
        return "none"
    return scene.waves.evaluation


def full_case(scene: Scene) -> dict[str, str]:
    """What tells rows of the scene as it is from others."""
    return {"memory": memory_name(scene), "waves": waves_name(scene), "rung": FULL}


def variants(scene: Scene, *, quick: bool) -> Iterator[tuple[dict[str, str], Build]]:
    """Scenes with one thing changed, by what tells their rows from others, each made when it is measured."""
    for what, made in (
        ("memory", _memory_variants(scene, quick=quick)),
        ("waves", _wave_variants(scene, quick=quick)),
        ("rung", line_variants(scene)),
        ("rung", _coupling_variants(scene)),
    ):
        for name, build in made:
            yield {**full_case(scene), what: name}, build


def _coupling_variants(scene: Scene) -> Iterator[tuple[str, Build]]:
    """Of crane, payload and vessel; motion and linear model of the full scene are found by a row itself."""
    if scene.actuators:
        yield LOCKED, partial(locked, scene)
        if len(scene.vessels) == 1 and not given_vessels(scene):
            yield PRESCRIBED, lambda: scene
    if hanging(scene):
        yield WEIGHT, partial(payload_as_weight, scene)
    if scene.waves is not None and scene.vessels and not given_vessels(scene):
        yield LINEAR, lambda: scene


def _memory_variants(scene: Scene, *, quick: bool) -> Iterator[tuple[str, Build]]:
    """None, convolution, and fits of each kind at several R2 or limits; `quick`: none alone."""
    memory = memory_name(scene)
    if len(scene.vessels) != 1 or given_vessels(scene):
        return
    database = _database(scene)
    for kind in ("none", "convolution"):
        if kind == memory or (kind != "none" and (quick or database is None)):
            continue
        yield kind, partial(with_memory, scene, kind)
    if quick or database is None:  # a fit costs more than many runs
        return
    for kind, (asked, levels, usual) in FITTED.items():
        for level in levels:
            if kind != memory or level != usual:
                yield f"{kind} {asked}={level:g}", partial(with_memory, scene, kind, level=level)


def full_memory_name(scene: Scene, name: str) -> str:
    """A fitted memory's name with its number of states for its R2 or limit: "per-pair:36"."""
    kind, _, level = name.partition(" ")
    if "=" not in level:
        return name
    (vessel,) = scene.vessels.values()
    blocks = cast("list[_core.StateSpaceBlock]", vessel.memory)
    return f"{kind}:{sum(block.a.shape[0] for block in blocks)}"


def _database(scene: Scene) -> HydroDatabase | None:
    """The database of the one vessel, where that is from one."""
    (vessel,) = scene.vessels.values()
    return vessel.database if isinstance(vessel.database, HydroDatabase) else None


def with_memory(scene: Scene, kind: str, *, level: float | None = None, vessel: str | None = None) -> Scene:
    """The scene with another fluid memory of one vessel; the added mass is that of the memory's fit.

    By an R2 or limit of the fit, else the database's own where it has one of that kind; of the only vessel,
    where none is named.
    """
    own = next(iter(scene.vessels.values())) if vessel is None else scene.vessels[vessel]
    changes: dict[str, Any] = {"memory": []}
    if isinstance(own.database, HydroDatabase):
        database = own.database
        if level is not None:
            database = replace(database, memory=_fit(database, kind, level))
        fresh = Scene(name="memory", gravity=scene.gravity)
        fresh.add_vessel(database, name=own.body, memory=kind, kinematics=own.kinematics)
        (fitted,) = fresh.vessels.values()
        changes = {"memory": fitted.memory, "added_mass": fitted.added_mass}
    out = scene.copy()
    out.replace(own.name, kind="vessel", **changes)
    known = scene.provenance.get(own.name, VesselProvenance())
    out.provenance[own.name] = replace(known, memory=kind)
    return out


@lru_cache(maxsize=16)
def _fit(database: HydroDatabase, kind: str, level: float) -> MemoryModel:
    asked: dict[str, Any] = {FITTED[kind][0]: level}
    return fit_memory(database=database, kind=kind, **asked)


def _wave_variants(scene: Scene, *, quick: bool) -> Iterator[tuple[str, Build]]:
    waves = scene.waves
    if waves is None:
        return
    if waves.has_tables():
        if waves_name(scene) != "exact":
            yield "exact", partial(scene.copy, waves=replace(waves, evaluation="exact"))
        if not quick:
            coarse = replace(waves, evaluation="table", relative_bound=BOUND)
            yield f"table bound {BOUND:g}", partial(scene.copy, waves=coarse)
    for share in SHARES if waves.hulls else ():
        count = int(np.ceil(share * len(waves.omega)))
        fewer = partial(scene.copy, waves=strongest(waves, count))
        yield f"{count} of {len(waves.omega)} components", fewer


def strongest(waves: Any, count: int) -> Any:
    """The sea of the components with the largest load on any motion, relative to that motion's largest.

    Where no hull floats in it, those with the largest velocity of the water.
    """
    tables = [np.asarray(hull.transfer) for hull in waves.hulls.values()]
    transfer = np.hstack(tables) if tables else np.asarray(waves.omega)[:, None]
    load = np.abs(transfer) * np.abs(waves.amplitude)[:, None]
    largest = load.max(axis=0)
    share = (load / np.where(largest > 0.0, largest, 1.0)).max(axis=1)
    kept = np.sort(np.argsort(-share, kind="stable")[:count])
    parts = {
        name: np.asarray(getattr(waves, name))[kept] for name in ("omega", "amplitude", "phase", "direction")
    }
    hulls = {body: _of_components(hull, kept) for body, hull in waves.hulls.items()}
    return replace(waves, hulls=hulls, **parts)


def _of_components(hull: HullLoads, kept: NDArray[np.intp]) -> HullLoads:
    """The loads of some components."""
    tables: dict[str, Any] = {
        name: None if table is None else replace(table, values=np.asarray(table.values)[:, kept])
        for name in ("force_by_heading", "drift_by_heading")
        for table in [getattr(hull, name)]
    }
    drift = None if hull.drift is None else np.asarray(hull.drift)[kept]
    return replace(hull, transfer=np.asarray(hull.transfer)[kept], drift=drift, **tables)


def line_variants(scene: Scene) -> Iterator[tuple[str, Build]]:
    """The rungs that the lines of a scene do not have already, each with what makes the scene."""
    lines = lines_of(scene.loads)
    own = {ELASTIC if line.rung == AUTO else line.rung for line in lines.values()}
    if not lines:
        return
    yield RIGID_LINES, partial(with_rigid_lines, scene)
    for rung, title in ((QUASI_STATIC, LINE_RUNGS[1]), (ELASTIC, LINE_RUNGS[2])):
        if own != {rung}:
            yield title, partial(with_rungs, scene, dict.fromkeys(lines, rung))


def with_rigid_lines(scene: Scene) -> Scene:
    """Every line replaced by a link as long as its path is described, which also pushes.

    Raises SceneError for a line over more than two points, or whose length changes.
    """
    out = scene.copy()
    for name, line in lines_of(scene.loads).items():
        if len(line.bodies) > 2:
            raise SceneError(f"line {name!r}: runs over {len(line.bodies)} points, and a rigid link over two")
        pieces = np.asarray(line.length.to_pieces()["coefficients"])
        if line.winch or pieces.reshape(-1, 6)[:, 1:].any() or len(pieces) > 1:
            raise SceneError(f"line {name!r}: its length changes, and that of a rigid link does not")
        (first, start), (second, end) = path_of(line)
        out.remove(name)
        out.add_joint(
            kind="distance", name=name, first=first, second=second,
            point=place_of(scene, body=first, point=start),
            second_point=place_of(scene, body=second, point=end),
        )  # fmt: skip
    return out


def locked(scene: Scene) -> Scene:
    """Every actuated coordinate held at its described value."""
    held = {
        name: _core.Curve.constant(value=float(actuator.reference.evaluate([0.0])[0, 0]))
        for name, actuator in scene.actuators.items()
    }
    return driven(scene, references=held)


def with_prescribed_vessel(scene: Scene, times: Array, motion: Array) -> Scene:
    """The vessel's six motions (n, 6) prescribed; nothing acts back on it.

    Raises SceneError for a scene of several vessels.
    """
    if len(scene.vessels) != 1:
        raise SceneError(f"scene {scene.name!r}: has {len(scene.vessels)} vessels; one is prescribed")
    (vessel,) = scene.vessels.values()
    out = scene.copy(waves=calm_water(scene.waves))
    out.replace(vessel.name, kind="vessel", memory=[])
    curves = {name: spline_curve(times=times, values=motion[:, i]) for i, name in enumerate(SIX)}
    hold_vessel(out, vessel.body, curves)
    return out


def hanging(scene: Scene) -> bool:
    """Whether there are payloads, and each hangs on its crane's link and on nothing else."""
    links = list(hooks(scene).values())
    return bool(links) and all(_hangs(scene, link) for link in links)


def _hangs(scene: Scene, link: str) -> bool:
    payload = scene.joints[link].second
    others = [joint for name, joint in scene.joints.items() if name != link]
    return not (
        any(payload in (joint.first, joint.second) for joint in others)
        or any(payload in bodies_of(load, scene.joints) for load in scene.all_loads())
    )


def payload_as_weight(scene: Scene) -> Scene:
    """Every payload replaced by its constant weight at the tip: neither swing nor inertia."""
    out = scene.copy()
    for label, link in hooks(scene).items():
        joint, payload = scene.joints[link], scene.bodies[scene.joints[link].second]
        out.remove(link, kind="joint")
        out.remove(payload.name, kind="body")
        out.add_force(
            joint.first,
            name=f"{label.removesuffix('hook')}payload weight",
            point=joint.first_frame.point,
            force=(0.0, 0.0, -payload.mass * scene.gravity),
        )
    return out
