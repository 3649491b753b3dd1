"""Rest states on hydraulic cylinders: rods of the strokes asked for, and the pressures of their forces."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from seacrane import _core
from seacrane.analysis.inverse import channels_at
from seacrane.analysis.taut_lines import pose_of
from seacrane.arrays import Array
from seacrane.description.compilation import compile_scene
from seacrane.description.description import Description, Some
from seacrane.description.elements import add_joint
from seacrane.description.holding import decided
from seacrane.description.hydraulic_cylinders import holding_pressures, hydraulic_cylinders
from seacrane.description.loads import without_compensation
from seacrane.description.places import ORIGIN, apart, placed
from seacrane.errors import SceneError
from seacrane.inputs.caller import silently
from seacrane.warnings import AssemblyWarning

STEP = 0.05  # m, of rods on their way to other lengths: projection takes only small steps
Search = Callable[[Some, float, Array], _core.State]
ENDS = ("first", "second", "first_point", "second_point")
ROD = " held"  # after the name of a cylinder, that of its rod


def rest_on_oil(scene: Some, time: float, values: Array, search: Search[Some]) -> _core.State:
    """State at rest of a held scene with hydraulic cylinders, which stand where their spools are shut.

    With a gain that is where the reference and the command lead, without one where they stand: oil neither
    comes nor goes. Leakage is left out. The side that is not pushed keeps its pressure. `search` finds the
    rest of a scene without cylinders from a state of it. Raises SceneError for a spool that is held open, and
    a stroke beyond an end.
    """
    model = compile_scene(scene)
    cylinders = hydraulic_cylinders(scene)
    now = {name: _stroke(scene, model, one, values) for name, one in cylinders.items()}
    wanted = {name: _rest_stroke(one, time, now[name]) for name, one in cylinders.items()}
    with silently(AssemblyWarning):  # the described pose is another one, and that is meant
        rods, values = _led(scene, time, values, now, wanted)
        found, on_rods = search(rods, time, values), compile_scene(rods)
    force = rod_forces(rods, on_rods, found)
    on_oil = compile_scene(scene)
    out = carried_over(np.asarray(found.values), on_rods, on_oil)
    places = {name: place for name, _, place, *_ in on_oil.load_states}
    for name, one in cylinders.items():
        for state, value in _oil(one, force[name]).items():
            if f"{name}.{state}" in places:
                out[places[f"{name}.{state}"]] = value
    parts = _core.initial_state(on_oil).parts
    return _core.State(time=time, values=out, inputs=np.zeros(on_oil.slots), parts=parts)


def _led(
    scene: Some, time: float, values: Array, now: Mapping[str, float], wanted: Mapping[str, float]
) -> tuple[Some, Array]:
    """The scene on rods of the wanted strokes (m), and its state led there from the present ones."""
    model, bare, cylinders = compile_scene(scene), without_cylinders(scene), hydraulic_cylinders(scene)
    away = max(abs(wanted[name] - now[name]) for name in cylinders)
    for share in np.linspace(0.0, 1.0, int(np.ceil(away / STEP)) + 1):
        rods = bare.copy(joints=dict(bare.joints))
        for name, one in cylinders.items():
            stroke = now[name] + share * (wanted[name] - now[name])
            add_rod(rods, ends_of(one), one.retracted_length + stroke)
        on_rods = compile_scene(rods)
        values = _core.Evaluator(on_rods).project(time, carried_over(values, model, on_rods))
        model = on_rods
    return rods, values


def carried_over(values: Array, before: _core.Model, after: _core.Model) -> Array:
    """Poses, and states of loads that both have, in a state at rest of another model of the same bodies."""
    out = np.array(after.initial_state)
    out[: after.twist_index(0)] = values[: before.twist_index(0)]
    old = {name: place for name, _, place, *_ in before.load_states}
    out[after.twist_index(0) :] = 0.0
    for name, _, place, start, *_ in after.load_states:
        out[place] = values[old[name]] if name in old else start
    return out


def _stroke(scene: Some, model: _core.Model, one: _core.HydraulicCylinder, values: Array) -> float:
    ends = []
    for body, point in ((one.first, one.first_point), (one.second, one.second_point)):
        origin, turn = pose_of(scene, model, body, values)
        ends.append(origin + turn @ np.asarray(point))
    return float(np.linalg.norm(ends[1] - ends[0])) - one.retracted_length


def _rest_stroke(one: _core.HydraulicCylinder, time: float, stands: float) -> float:
    what = f"hydraulic cylinder {one.name!r}"
    command, reference = (float(curve.evaluate([time])[0, 0]) for curve in (one.command, one.reference))
    if one.gain == 0.0:
        if abs(command) > one.overlap:
            raise SceneError(
                f"{what}: is not at rest at t = {time:g} s, with its spool at {command:g} and no gain; "
                "give it a gain, or a command that ends at 0"
            )
        return stands
    stroke = reference + command / one.gain
    if not 0.0 <= stroke <= one.stroke:
        raise SceneError(
            f"{what}: is asked for a stroke of {stroke:.6g} m at t = {time:g} s, and it has 0 to "
            f"{one.stroke:g} m; correct its reference"
        )
    return stroke


def _oil(one: _core.HydraulicCylinder, force: float) -> Mapping[str, float]:
    """States of a cylinder that holds a force (N); an empty accumulator has all of its gas (m3)."""
    full, rod = holding_pressures(one, force)
    found = {"pressure": full, "pressure_rod": rod, "spool": 0.0}
    if one.accumulator_volume != 0.0:
        squeezed = max(full / one.accumulator_pressure, 1.0)
        found["gas_volume"] = float(one.accumulator_volume * squeezed ** (-1.0 / one.accumulator_exponent))
    return found


def ends_of(cylinder: _core.HydraulicCylinder) -> dict[str, Any]:
    """Name, bodies and points of a cylinder."""
    return {key: getattr(cylinder, key) for key in ("name", *ENDS)}


def without_cylinders(scene: Some) -> Some:
    """The scene without its hydraulic cylinders, and without the compensators that they follow."""
    scene = decided(scene)
    there = hydraulic_cylinders(scene)
    loads = without_compensation(scene.loads)
    return scene.copy(loads={name: load for name, load in loads.items() if name not in there})


def add_rod(scene: Description, given: Mapping[str, Any], length: float | None = None) -> None:
    """Add a rod between the ends of a cylinder; its length (m) is that of the described pose by default."""
    ends = [(given[end], given.get(f"{end}_point", ORIGIN)) for end in ("first", "second")]
    first, second = (placed(scene, *end) for end in ends)
    if length is None:
        length = apart(scene, f"hydraulic cylinder {given['name']!r}", *ends)
    add_joint(
        scene, kind="distance", name=f"{given['name']}{ROD}", first=given["first"], second=given["second"],
        point=first, second_point=second, length=length,
    )  # fmt: skip


def rod_forces(scene: Description, model: _core.Model, state: _core.State) -> dict[str, float]:
    """N, positive pushes, of the rods in a scene at one of its states, by the cylinder."""
    pulls = channels_at(model, {"tension"}, state.time, np.array(state.values))["tension"].tolist()
    ties = [name for name, joint in scene.joints.items() if joint.kind == "distance"]
    return {
        name.removesuffix(ROD): -pull for name, pull in zip(ties, pulls, strict=True) if name.endswith(ROD)
    }
