"""Particulars: the scene, its sea and the method, in words and units."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

from seacrane.answers.lift_particulars import lift_rows, stage_table
from seacrane.answers.section import Section
from seacrane.plotting.table import facts, format_value
from seacrane.result import Result

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
    chosen: Rows = [
        ("formulation", result.stats["formulation"]),
        ("integrator", result.stats["integrator"]),
    ]
    stop = [("recorded until [s]", float(result.time[-1]))] if result.interrupted else []
    return chosen + _rows(settings, METHOD) + stop + [("outputs", int(result.time.size))]


def _notes(settings: Mapping[str, Any]) -> Rows:
    notes = settings.get("notes", {})
    return [(str(name), json.dumps(_plain(value))) for name, value in notes.items()]


def _html(result: Result) -> str:
    settings = result.settings
    groups = {
        "Lift": lift_rows(result),
        "Scene": _scene(result, settings),
        "Sea": _rows(settings, SEA) + _rows(result.stats, STATED_SEA),
        "Method": _method(result, settings),
        "Notes": _notes(settings),
    }
    blocks = [f"<div><h3>{name}</h3>{facts(rows).html()}</div>" for name, rows in groups.items() if rows]
    below = f"<h3>Stages</h3>{stage_table(result).html()}" if result.stages else ""
    return f'<div class="columns">{"".join(blocks)}</div>{below}'


PARTICULARS: Section[Result] = Section("Particulars", _html)
