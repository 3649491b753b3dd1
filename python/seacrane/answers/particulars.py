"""Particulars: the scene, its sea and the method, in words and units."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from seacrane.answers.reported_curves import POSES, hook_loads
from seacrane.description.crane_parts import tip_radius
from seacrane.description.description import GROUND, Description
from seacrane.description.loads import lines_of
from seacrane.description.roles import CraneRoles
from seacrane.description.suspension import Hung, hung_loads, suspensions
from seacrane.description.wet_parts import displaced_volume, immersed_parts, sources_in_water, waters_in
from seacrane.plotting.table import Table, format_value, table_of
from seacrane.result import Result
from seacrane.scene.rigging import NO_BOUND, STRONGEST

Rows = list[tuple[str, Any]]
SEA = {
    "spectrum": "spectrum",
    "hs": "significant wave height [m]",
    "tp": "peak period [s]",
    "gamma": "peak enhancement",
    "wave_direction_deg": "waves travel to [deg from forward towards port]",
    "sea": "wave systems",
}
STATED_SEA = {
    "realised_hs": "realised significant wave height [m]",
    "seed": "seed",
    "wave_components": "wave components",
    "repeat_period_s": "the realisation repeats after [s]",
}
VESSEL = {
    "database": "hydrodynamic database",
    "memory": "fluid memory",
    "memory_error": "largest share of a motion that its fit changes",
    "drift": "slow drift",
}
METHOD = {
    "rtol": "tolerance",
    "dt": "step [s]",
    "maximum_step": "largest step [s]",
    "spectral_radius": "spectral radius",
    "t_end": "end time [s]",
    "dt_out": "output interval [s]",
}
BOUNDS = {  # of a winch: unit, and from where on there is none
    "maximum_rate": ("m/s", NO_BOUND),
    "maximum_acceleration": ("m/s2", NO_BOUND),
    "lag": ("s of lag", np.inf),
    "maximum_tension": ("N", STRONGEST),
}


def lift_rows(result: Result) -> Rows:
    """Of a result that holds its scene: what carries, what hangs, and on what."""
    scene = result.scene
    if scene is None:
        return []
    if not scene.roles:
        return _in_water(scene)
    found = [("ship", words) for words in _ships(scene)]
    found += [("crane", words) for words in _cranes(result, scene)]
    for one in hung_loads(scene):
        found += [("wire", _wire(scene, one)), ("load", _load(scene, one))]
    found += [(f"{curve.name} [{curve.unit}]", _range(curve.values)) for curve in hook_loads(result)]
    return found + _in_water(scene)


def _in_water(scene: Description) -> Rows:
    """What parts keep water out of and compartments let in, and where coefficients are from."""
    parts, rows = immersed_parts(scene).values(), []
    for body in dict.fromkeys(part.body for part in parts):
        own = [part for part in parts if part.body == body]
        words = f"{body}, keeps {sum(map(displaced_volume, own)):.4g} m3 dry"
        holds = sum(one.area * one.height for one in waters_in(scene) if one.body == body)
        rows.append(("in water", f"{words}, holds {holds:.4g} m3 of water" if holds else words))
    return rows + [("coefficients in water", words) for words in sources_in_water(scene)]


def stage_table(result: Result) -> Table:
    """Stages as they were run, with the hook loads of each."""
    hooks = hook_loads(result)
    head = ("stage", "from [s]", "to [s]", "ended by", *(f"{one.name} [{one.unit}]" for one in hooks))
    rows = []
    for span in result.stages:
        within = result.stage(span.name)
        loads = [_range(one.values[within]) for one in hooks]
        rows.append((span.name, round(span.start, 2), round(span.end, 2), span.ended_by or "stopped", *loads))
    words = ["Of hook loads the least and the largest output of the stage."] if hooks else []
    return table_of(head, rows, remarks=words)


def _range(values: Any) -> str:
    known = values[np.isfinite(values)]
    return f"{known.min():.4g} to {known.max():.4g}" if known.size else ""


def _ships(scene: Description) -> Iterator[str]:
    for name, known in scene.provenance.items():
        if name not in scene.bodies:
            continue
        body, led = scene.bodies[name], known.motion is not None
        words = [known.database, f"moves by its {known.motion}" if led else f"{_tonnes(body.mass)}, floats"]
        yield f"{name}: {', '.join(word for word in words if word)}"


def _cranes(result: Result, scene: Description) -> Iterator[str]:
    for prefix, roles in scene.roles.items():
        words = [f"{prefix.strip()} on {_base(scene, roles)}".strip()]
        if roles.tip is not None and roles.slew is not None and set(POSES) <= set(result.channels):
            poses = ((result["position"][at], result["quaternion"][at]) for at in (0, -1))
            first, last = (float(tip_radius(scene, roles, *pose)) for pose in poses)
            height = result.place_of(*roles.tip)[:, 2]
            moves = abs(last - first) > 0.05 or abs(height[-1] - height[0]) > 0.05
            words.append(f"tip {first:.1f} m out and {height[0]:.1f} m up at the start")
            words += [f"{last:.1f} m and {height[-1]:.1f} m at the end"] if moves else []
        yield ", ".join(words)


def _base(scene: Description, roles: CraneRoles) -> str:
    """What the crane stands on: followed down from its slew drive."""
    above = {joint.second: joint.first for joint in scene.joints.values()}
    body = scene.joints[roles.slew[0]].first if roles.slew else GROUND
    while body not in scene.provenance and body in above:
        body = above.pop(body)
    return body


def _wire(scene: Description, hung: Hung) -> str:
    one = hung.suspension
    words = [one.name, one.rung if one.falls == 1 else f"{one.rung}, {one.falls} falls"]
    line = lines_of(scene.loads).get(min(one.parts)) if one.parts else None
    if line is not None:
        words += [f"EA {line.EA:.4g} N"] if line.EA else []
        words += [f"{line.length.evaluate(0.0)[0, 0]:.4g} m of rope"] if len(one.parts) == 1 else []
    if line is not None and line.winch:
        given = [(getattr(line, key), *bound) for key, bound in BOUNDS.items()]
        bounds = [f"{value:g} {unit}" for value, unit, none in given if 0.0 < value < none]
        words.append(" ".join(["winch", f"({', '.join(bounds)})" if bounds else ""]).strip())
    return ", ".join(words)


def _load(scene: Description, hung: Hung) -> str:
    body = scene.bodies[hung.load]
    words = [f"{hung.load}, {_tonnes(body.mass)}"]
    if np.any(body.size):
        words.append(" x ".join(f"{edge:g}" for edge in body.size) + " m")
    below = [one.name for one in suspensions(scene) if one.lower[0] == hung.load]
    slings = sum(name != hung.suspension.name for name in below)
    words += [f"{slings} slings"] if slings else []
    rigging = None if hung.weight is None else hung.weight / scene.gravity - body.mass
    words += [f"block and rigging {_tonnes(rigging)}"] if rigging and rigging > 1e-6 * body.mass else []
    return ", ".join(words)


def _tonnes(mass: float) -> str:
    return f"{mass / 1e3:,.4g} t" if mass < 1e7 else f"{mass / 1e3:,.0f} t"


def _rows(values: Mapping[str, Any], names: Mapping[str, str]) -> Rows:
    return [(text, _plain(values[name])) for name, text in names.items() if values.get(name) is not None]


def _plain(value: Any) -> Any:
    """Mappings, as of several vessels, in one line."""
    if isinstance(value, Mapping):
        return ", ".join(f"{key}: {format_value(_plain(one))}" for key, one in value.items())
    if isinstance(value, list):
        return [_plain(one) for one in value]
    return value


def _scene(result: Result, settings: Mapping[str, Any]) -> Rows:
    bodies, joints = result.coords.get("body", ()), result.coords.get("joint", ())
    hung = str(result.stats.get("payload", "")).splitlines()
    cranes = result.about.cranes
    cylinders = [f"{crane['prefix']}{name}" for crane in cranes for name in crane["cylinders"]]
    found: Rows = [("scene", str(result.stats["scene"]))]
    found += [("bodies", f"{len(bodies)}: {', '.join(bodies)}")] if bodies else []
    found += [("joints", f"{len(joints)}: {', '.join(joints)}")] if joints else []
    found += [("hangs on a link or wire", ", ".join(hung))] if hung else []
    found += [("cylinders", ", ".join(cylinders))] if cylinders else []
    found.append(("degrees of freedom", result.stats["degrees_of_freedom"]))
    return found + _rows(settings, VESSEL)


def _method(result: Result, settings: Mapping[str, Any]) -> Rows:
    chosen: Rows = [(name, result.stats[name]) for name in ("formulation", "integrator")]
    stop = [("recorded until [s]", float(result.time[-1]))] if result.interrupted else []
    return chosen + _rows(settings, METHOD) + stop + [("outputs", int(result.time.size))]


def particulars(result: Result) -> dict[str, Rows]:
    """The lift, the scene, its sea, the method and notes."""
    settings = result.settings
    return {
        "Lift": lift_rows(result),
        "Scene": _scene(result, settings),
        "Sea": _rows(settings, SEA) + _rows(result.stats, STATED_SEA),
        "Method": _method(result, settings),
        "Notes": [(str(name), json.dumps(_plain(one))) for name, one in settings.get("notes", {}).items()],
    }
