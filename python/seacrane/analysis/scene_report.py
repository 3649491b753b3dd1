"""What a compiled scene holds, what was left out of it, and what one evaluation costs."""

from __future__ import annotations

from typing import Any

import numpy as np

from seacrane import _core
from seacrane.analysis.linearise import fastest_mode
from seacrane.description.compilation import compile_scene, moves
from seacrane.description.crane_parts import cylinders, hooks, payloads, slews
from seacrane.description.description import Description, all_loads
from seacrane.description.given import floating_bodies, given_vessels
from seacrane.description.holding import held_drives, with_holds
from seacrane.description.loads import kind_of, named
from seacrane.description.wet_parts import sources_in_water
from seacrane.plotting.table import Table, facts

Rows = list[tuple[str, Any]]
REPETITIONS = 500  # of each part when its cost is measured
LABELS = {  # of kinds of loads that are not called by their kind
    "function force": "C functions",
    "flow force": "wind and current",
    **dict.fromkeys(("limit", "friction", "soft stop"), "limits and friction"),
}
WORK_STATES = 2  # the work integral and its absolute counterpart


class SceneReport(dict[str, Rows]):
    """Sections of rows by their titles; prints as tables."""

    def tables(self) -> list[Table]:
        """Names beside values, one of each section."""
        return [facts(rows, title) for title, rows in self.items()]

    def __repr__(self) -> str:
        return "\n\n".join(map(str, self.tables()))

    def _repr_html_(self) -> str:
        return "".join(one._repr_html_() for one in self.tables())


def scene_report(scene: Description) -> SceneReport:
    """Compile a scene and tell what came out; SceneError if it does not compile.

    Sections "size", "elements", "merged", "assembly", "left out", "cost", "lines" of scenes with elastic
    lines and, for models small enough for a dense eigenvalue problem, "modes". Values are numbers, texts or
    lists of texts. Costs are nanoseconds per evaluation, measured meanwhile.
    """
    still = [
        f"{prefix}{label} ({joint})"
        for prefix, drives in held_drives(scene).items() for label, joint, _ in drives
    ]  # fmt: skip
    scene = with_holds(scene)
    model = compile_scene(scene)
    report = {
        "size": _size(scene, model),
        "elements": elements_of(scene) + _there([("held where described, as nothing acts on them", still)]),
        "merged": _merged(model),
        "assembly": _assembly(scene, model),
        "left out": _left_out(scene, model),
        "cost": _cost(model),
    }
    fastest = fastest_mode(model)
    modes = [] if fastest is None else [("fastest_mode_per_s", fastest)]
    asked = {"lines": _bounces(model), "modes": modes}
    return SceneReport(report | {title: rows for title, rows in asked.items() if rows})


def _size(scene: Description, model: _core.Model) -> Rows:
    bodies = len(model.bodies)
    pose = 7 if scene.orientation == "quaternion" else 6
    return [
        ("bodies", bodies),
        ("joints", len(scene.joints)),
        ("drivers", len(scene.drivers)),
        ("coordinates", model.coordinates),
        ("constraints", model.constraints),
        ("degrees_of_freedom", model.degrees_of_freedom),
        ("compiled_coordinates", model.merge["coordinates"]),
        ("compiled_constraints", model.merge["constraints"]),
        ("states", model.states),
        ("pose states", pose * bodies),
        ("velocity states", 6 * bodies),
        ("memory states", model.memory_states),
        ("history samples", model.history_samples),
        ("work states", WORK_STATES),
        ("input slots", model.slots),
        ("wave components", 0 if scene.waves is None else len(scene.waves.omega)),
        ("times where a curve has a kink", len(model.breakpoints)),
        ("orientation", scene.orientation),
        ("gravity [m/s2]", scene.gravity),
        ("Baumgarte frequency [1/s]", model.baumgarte),
    ]


def elements_of(scene: Description) -> Rows:
    """Kinds of element that a scene holds, and the elements of each with what they act on."""
    kinds: dict[str, list[str]] = {}
    for name, joint in scene.joints.items():
        kinds.setdefault(joint.kind, []).append(f"{name} ({joint.first} to {joint.second})")
    given, vessels = given_vessels(scene), scene.vessels.items()
    slewing = {label: joint for label, (joint, _) in slews(scene).items()}
    parts = slewing | cylinders(scene) | hooks(scene) | payloads(scene)
    return _there([
        ("bodies", list(scene.bodies)),
        *((f"{kind} joints", names) for kind, names in kinds.items()),
        ("drivers", [f"{name} ({_place(driver)})" for name, driver in scene.drivers.items()]),
        *_loads_by_kind(scene),
        ("coefficients in water", sources_in_water(scene)),
        ("vessels", [f"{name} ({v.body})" for name, v in vessels if v.body not in given]),
        ("vessels in one water", [f"{n} ({', '.join(group.vessels)})" for n, group in scene.groups.items()]),
        ("vessels of given motion", [f"{body} ({kind})" for body, kind in given.items()]),
        ("waves", [] if scene.waves is None else list(scene.waves.hulls)),
        ("crane parts", [f"{label} ({name})" for label, name in parts.items()]),
    ])  # fmt: skip


def _loads_by_kind(scene: Description) -> Rows:
    kinds: dict[str, list[str]] = {}
    for load in all_loads(scene):
        kind = kind_of(load)
        kinds.setdefault(LABELS.get(kind, f"{kind}s"), []).append(f"{load.name} ({_place(load)})")
    return list(kinds.items())


def _place(element: Any) -> str:
    """The joint and the coordinate, or the bodies, that an element acts on."""
    joint, coordinate = named(element, "joint"), named(element, "coordinate")
    if joint:
        return f"{joint[0]} {coordinate[0] or 'one way'}"
    return " to ".join(named(element, "body"))


def _merged(model: _core.Model) -> Rows:
    """Bodies that runs step as one, and the elements between them that drop out of the equations."""
    merge = model.merge
    return _there([
        *((f"moves as one with {carrier}", names) for carrier, names in merge["bodies"].items()),
        ("drivers that hold a joint still", merge["locked_by"]),
        ("drivers whose coordinate is no unknown (recursive form)", model.tree["driven"]),
        ("elements not stepped (reactions on output only)", merge["dropped"]),
    ])  # fmt: skip


def _there(rows: Rows) -> Rows:
    """Without rows that hold nothing."""
    return [(label, names) for label, names in rows if names]


def _assembly(scene: Description, model: _core.Model) -> Rows:
    found = model.assembly
    rows: Rows = [
        ("constraint residual as described [m or rad]", found["residual_before"]),
        ("constraint residual at the start [m or rad]", found["residual_after"]),
        ("constraint rate residual at the start [per s]", found["rate_residual_after"]),
        ("largest translation by assembly [m]", found["largest_translation_m"]),
        ("largest rotation by assembly [rad]", found["largest_rotation_rad"]),
        ("largest change of velocity [m/s or rad/s]", found["largest_velocity_change"]),
    ]
    if found["most_moved_body"]:
        rows.append(("body moved most", found["most_moved_body"]))
    moved = [f"{name}: {m:.4g} m, {rad:.4g} rad" for name, m, rad in moves(scene, model)]
    if moved:
        rows.append(("bodies moved by assembly", moved))
        rows.append(("open as described [m or rad]", [f"{name}: {gap:.4g}" for name, gap in found["open"]]))
    if model.constraints:
        rows.append(("rank of the constraints", found["rank"]))
        rows.append(("redundant constraints", model.constraints - found["rank"]))
        rows.append(("condition estimate (largest S_ii / d_i)", found["condition"]))
    if model.redundant:
        rows.append(("reactions not unique (minimum norm given)", list(model.redundant)))
    return rows


def _left_out(scene: Description, model: _core.Model) -> Rows:
    """What the scene does not have, and so neither stores nor steps."""
    floating = floating_bodies(scene)
    weightless = [n for n, body in scene.bodies.items() if not body.gravity or n in floating]
    absent = {
        **{kind: getattr(scene, kind) for kind in ("joints", "drivers", "actuators", "vessels")},
        "waves": scene.waves is not None,
        "fluid memory": model.memory_states or model.history_samples,
        "gravity": scene.gravity,
    }
    given = given_vessels(scene)
    afloat = {n: vessel for n, vessel in scene.vessels.items() if vessel.floats and vessel.body not in given}
    together = {name for group in scene.groups.values() if group.memory for name in group.vessels}
    no_memory = [name for name, vessel in afloat.items() if not vessel.memory and name not in together]
    undamped = [name for name, v in afloat.items() if v.linear_damping[3, 3] + v.quadratic_damping[3] == 0.0]
    offered, usual = model.channel_names(defaults_only=False), model.channel_names()
    return _there([
        ("absent", [name for name, present in absent.items() if not present]),
        ("bodies without weight of their own", [] if scene.gravity == 0.0 else weightless),
        ("joints that constrain nothing", [name for name, _, count, _ in model.elements if count == 0]),
        ("vessels without memory", no_memory),
        ("vessels without viscous roll damping", undamped),
        ("channels on request only", [name for name in offered if name not in usual]),
    ])  # fmt: skip


def _cost(model: _core.Model) -> Rows:
    evaluator = _core.Evaluator(model)
    parts = evaluator.time_parts(0.0, np.array(model.initial_state), REPETITIONS)
    return [(f"{name} [ns]", round(value, 1)) for name, value in parts.items()]


def _bounces(model: _core.Model) -> Rows:
    """How each line lets bounce what hangs on it at the start, see docs/lines.md."""
    words = "bounces in {:.4g} s, damped by {:.3g} % of critical, as {:.4g} kg on it"
    return [
        (name, words.format(2.0 * np.pi / omega, 100.0 * ratio, mass))
        for name, (mass, omega, ratio) in model.line_bounces.items()
    ]
