"""Changed scenes: another fluid memory, fewer waves, a locked crane, other coefficients in water."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import lru_cache
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.analysis.inverse import driven
from seacrane.description.loads import changed
from seacrane.description.provenance import VesselProvenance
from seacrane.description.waves import HullLoads
from seacrane.errors import SceneError
from seacrane.hydro import HydroDatabase, fit_memory
from seacrane.inputs.checked import number_of
from seacrane.inputs.shown import shown
from seacrane.scene.scene import Scene

FEWER = (0.5, 0.25)  # of the wave components, the strongest
BOUND = 1e-4  # of a coarse wave table
FITTED = {"by-motion": "limit", "per-pair": "r2"}  # what the level of a fit is
SPAN = "line"
# Shares by which coefficients of a shape are uncertain: usual for lifts, and unverified.
SHARES: Mapping[str, Mapping[str, float]] = MappingProxyType(
    {
        "box": {"added_mass": 0.3, "drag": 0.5},
        "cylinder": {"added_mass": 0.2, "drag": 0.3},
        "sphere": {"added_mass": 0.2, "drag": 0.5},
        "table": {"added_mass": 0.3, "drag": 0.5},
        SPAN: {"added_mass": 0.2, "drag": 0.3},
    }
)
DESCRIBED, SLOW = "as described", "added mass at zero frequency"
CASES = {
    "less added mass": ("added_mass", -1.0),
    "more added mass": ("added_mass", 1.0),
    "less drag": ("drag", -1.0),
    "more drag": ("drag", 1.0),
}
_fit = lru_cache(maxsize=16)(fit_memory)


def memory_name(scene: Scene) -> str:
    """Kind of fluid memory of a scene."""
    known = [scene.provenance.get(name, VesselProvenance()).memory for name in scene.vessels]
    kinds = [kind or "as described" for kind in known]
    return ", ".join(dict.fromkeys(kinds)) or "none"


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
            database = replace(database, memory=_fit(database=database, kind=kind, **{FITTED[kind]: level}))
        fresh = Scene(name="memory", gravity=scene.gravity)
        fresh.add_vessel(database, name=own.body, memory=kind, kinematics=own.kinematics)
        (fitted,) = fresh.vessels.values()
        changes = {"memory": fitted.memory, "added_mass": fitted.added_mass}
    out = scene.copy()
    out.replace(own.name, kind="vessel", **changes)
    known = scene.provenance.get(own.name, VesselProvenance())
    out.provenance[own.name] = replace(known, memory=kind)
    return out


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


def locked(scene: Scene) -> Scene:
    """Every actuated coordinate held at its described value."""
    held = {
        name: _core.Curve.constant(value=float(actuator.reference.evaluate([0.0])[0, 0]))
        for name, actuator in scene.actuators.items()
    }
    return driven(scene, references=held)


def shapes_in(scene: Scene) -> list[str]:
    """Of what is in water, each once."""
    found = (_shape(load) for load in scene.loads.values())
    return list(dict.fromkeys(shape for shape in found if shape))


def _shape(load: Any) -> str:
    if isinstance(load, _core.ImmersedPart):
        return "cylinder" if load.shape == "disc" else str(load.shape)  # its ends
    return SPAN if isinstance(load, _core.ImmersedSpan) else ""


def scattered(scene: Scene, case: str, *, shares: Mapping[str, Mapping[str, float]] | None = None) -> Scene:
    """The scene with more or less added mass or drag of all parts and lines in water.

    Parameters
    ----------
    case : str
        "less added mass", "more added mass", "less drag" or "more drag"; "as described"; or "added mass at
        zero frequency" of parts that know it (spheres, meshes), as far as it is not above that of an
        unbounded fluid: what a load has that rides slow waves at the surface.
    shares : mapping of str to mapping of str to float, optional
        By how much, by shape ("box", "cylinder", "sphere", "table", "line"; plates are boxes):
        ``{"box": {"added_mass": 0.2, "drag": 0.3}}`` in place of the defaults, which are 20 to 30 % of added
        mass and 30 to 50 % of drag, unverified.

    Raises
    ------
    SceneError
        For another case, a scene with nothing in water, or shares that are none.
    """
    if case not in (known := (DESCRIBED, SLOW, *CASES)):
        raise SceneError(f"scattered: case is {shown(case)}; choose from {', '.join(known)}")
    if not shapes_in(scene):
        raise SceneError(f"scene {scene.name!r}: has nothing in water; add_immersed parts first")
    used, out = _shares(shares), scene.copy()
    for name, load in scene.loads.items():
        if not (shape := _shape(load)):
            continue
        if case in CASES:
            coefficient, sign = CASES[case]
            out.loads[name] = _times(load, coefficient, 1.0 + sign * used[shape][coefficient])
        elif case == SLOW and shape != SPAN and len(load.slow_added_masses):
            masses = np.asarray(load.slow_added_masses)  # slam asks for what never falls with depth
            out.loads[name] = changed(load, added_masses=np.minimum.accumulate(masses[::-1])[::-1])
    return out


def _shares(given: Any) -> dict[str, dict[str, float]]:
    """The defaults with what is given in their place."""
    out = {shape: dict(one) for shape, one in SHARES.items()}
    for shape, one in ({} if given is None else given).items():
        if shape not in out or not set(one) <= set(out[shape]):
            raise SceneError(
                f"shares: {shown(shape)} has {shown(one)}; give 'added_mass' and 'drag' of {', '.join(out)}"
            )
        for name, value in one.items():
            if not 0.0 <= number_of(f"shares: {shape}: {name}", value) <= 1.0:
                raise SceneError(f"shares: {shape}: {name} is {value:g}; give a share from 0 to 1")
        out[shape] |= one
    return out


def _times(load: Any, coefficient: str, factor: float) -> Any:
    """A part or a span with one of its coefficients times a factor."""
    if isinstance(load, _core.ImmersedPart):
        name = {"added_mass": "added_masses", "drag": "drag"}[coefficient]
        return changed(load, **{name: factor * np.asarray(getattr(load, name))})
    names = {
        "added_mass": ("added_mass_coefficient",),
        "drag": ("drag_coefficient", "drag_coefficient_along"),
    }[coefficient]
    return changed(load, **{name: factor * getattr(load, name) for name in names})
