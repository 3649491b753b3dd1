"""The curves of a run that an engineer reports, in the units in which they are read."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from seacrane.arrays import Array
from seacrane.description.wet_parts import immersed_depths, immersed_parts, wet_names
from seacrane.errors import FileFormatError, SceneError
from seacrane.inputs.frames import AXES_NOTE, rotation_matrix
from seacrane.plotting.panel import Line, Panel, Sheet, draw
from seacrane.result import Result
from seacrane.result.history import marks_of, title_of
from seacrane.result.traces import NO_ENERGY, NO_MOTION, Bounded, Trace, beyond_rounding, traces
from seacrane.run.derived import swing_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

STANDARD_GRAVITY = 9.80665
TENSIONS = ("hook_load", "link_tension", "tension", "line_tension")
HOOK = "hook load"
CRANE = ("cylinder_force", "slew_torque")
LEADS = ("offlead", "sidelead")
GAPS = "clearance"
MOTIONS = ("heave", "roll", "pitch")
# What is shown under a crane's own names is not shown again under those of its parts.
SAME = {"tension": "link_tension"}
REPORTED = {"MN": (1e3, "kN"), "MN m": (1e3, "kN m")}
TONNES = {"N": 1e-3, "kN": 1.0, "MN": 1e3}  # times the weight of 1 t, from a load in that unit
POSES = ("position", "quaternion")
CHANNELS = (*TENSIONS, *CRANE, *LEADS, GAPS, *POSES, "vessel_motion")  # of which the curves are made
SI = {  # of units of a summary: the SI unit, and from that to it
    "kN": ("N", 1e-3), "kN m": ("N m", 1e-3), "t": ("N", 1e-3 / STANDARD_GRAVITY),
    "deg": ("rad", float(np.degrees(1.0))), "kJ": ("J", 1e-3),
}  # fmt: skip


@dataclass(frozen=True, kw_only=True, eq=False)
class Curve(Bounded):
    """One curve of a summary.

    Attributes
    ----------
    kind, label : What it is one of, such as "cylinder force", and which, where there are several.
    values, bounds : (n,) In the unit; least and largest since the output before, where the run keeps them.
    load : Whether it has a dynamic factor.
    pulls : Whether it is a tension, which may go slack.
    static : In the unit, where the run noted it.
    rung, suspension : Of what a load hangs on; of which a tension is, as channels name it.
    of_one_fall : Whether it is the tension of each of several falls.
    """

    kind: str
    label: str
    unit: str
    values: Array
    bounds: tuple[Array, Array] | None = None
    load: bool = False
    pulls: bool = False
    static: float | None = None
    rung: str = ""
    suspension: str = ""
    of_one_fall: bool = False

    @property
    def name(self) -> str:
        """Kind and label."""
        return f"{self.kind} {self.label}".rstrip()


def _scaled(factor: float, one: Trace) -> dict[str, Any]:
    """Values and bounds of a curve in another unit."""
    bounds = None if one.bounds is None else (factor * one.least, factor * one.largest)
    return {"values": factor * one.values, "bounds": bounds}


def reported_curves(result: Result) -> list[Curve]:
    """Tensions, cylinder forces, slew torques, depths in water, how loads hang, and the vessels' motions.

    Without what is zero up to rounding. Raises FileFormatError for notes that no run writes.
    """
    try:
        return _curves(result)
    except (LookupError, TypeError, ValueError, AttributeError) as error:
        raise FileFormatError(f"the result's notes are none that a run writes: {error}") from error


def hook_loads(result: Result) -> list[Curve]:
    """Those known of what hangs on cranes, or else by itself: not of slings and taglines beside them."""
    every = [one for one in reported_curves(result) if one.kind == HOOK]
    wanted = [one for one in every if one.rung] or every
    return [one for one in wanted if np.isfinite(one.values).any()]


def _curves(result: Result) -> list[Curve]:
    held = set(result.channels)
    hung = result.about.hung
    shown = {name for one in hung for name in one["parts"]}
    loads = [name for name in (*TENSIONS, *CRANE) if name in held and SAME.get(name) not in held]
    links = set(result.coords[result.dims["tension"][1]]) if "tension" in held else set()
    found = [
        _load(result, one)
        for name in loads
        for one in beyond_rounding(traces(result, name))
        if not (name in TENSIONS and shown & {*one.names, *(f"{part} line" for part in one.names)})
        and not (name == "hook_load" and one.names[0] in links)  # a link's is its tension
        and not (name == "link_tension" and shown)
        and not (name == "hook_load" and hung and _same(result, one))
    ]
    leads = [one for name in LEADS if name in held for one in beyond_rounding(traces(result, name))]
    gaps = traces(result, GAPS) if GAPS in held else []
    as_recorded = [
        Curve(kind=one.channel, label=one.label, unit=one.unit, **_scaled(1.0, one))
        for one in (*leads, *gaps)
    ]
    hoists = [curve for one in hung for curve in _hoist(result, one, hung)]
    return [*hoists, *found, *_water(result), *_offsets(result), *as_recorded, *_motions(result)]


def _hoist(result: Result, one: Mapping[str, Any], every: Sequence[Mapping[str, Any]]) -> list[Curve]:
    """Load on the hook, and tension of what it hangs on at the upper end: of a line in one of its falls."""
    cranes = [other for other in every if other["crane"] is not None]
    label = "" if one["crane"] is not None and len(cranes) == 1 else one["label"]
    lower, upper, hook = one["suspension"], one["top"], one["label"]
    weights = result.about.hanging_weight
    whole = [("hook_load", upper)] if weights.get(upper, (None, 0))[1] == 1 else []  # all falls together
    load = _first_of(result, ("hook_load", lower), ("link_tension", hook), ("tension", lower))
    pull = _first_of(result, ("end_tension", upper.rpartition(".")[0], "first"),
                     ("line_tension", upper.removesuffix(" line")), ("line_tension", upper),
                     ("link_tension", hook), ("tension", upper), *whole)  # fmt: skip
    found = []
    if load is not None:
        per_tonne = TONNES[load.unit] / STANDARD_GRAVITY
        found.append((HOOK, "t", _scaled(per_tonne, load), lower, weights.get(lower, (None, 1))))
    if pull is not None:
        factor, unit = REPORTED.get(pull.unit, (1.0, pull.unit))
        found.append(("hoist tension", unit, _scaled(factor, pull), upper, weights.get(upper, (None, 1))))
    return [
        Curve(kind=kind, label=label, unit=unit, **values, load=True, pulls=True, rung=one["rung"],
              suspension=name, of_one_fall=kind != HOOK, static=None if weight is None else
              weight * in_si(unit)[1] / (1 if kind == HOOK else falls))
        for kind, unit, values, name, (weight, falls) in found
    ]  # fmt: skip


def _first_of(result: Result, *wanted: tuple[str, ...]) -> Trace | None:
    """The first of these curves that was recorded, by channel and names, and is more than rounding."""
    for channel, *names in wanted:
        if channel in result.channels:
            every = traces(result, channel)
            for one in beyond_rounding(every):
                if one.names == tuple(names) or (not one.names and channel == "link_tension"):
                    return one
    return None


def _same(result: Result, hook: Trace) -> bool:
    """Whether this load of a sling or tagline is its tension, which has a row of its own."""
    tensions = traces(result, "line_tension") if "line_tension" in result.channels else []
    found = next((one for one in tensions if one.names == hook.names), None)
    if found is None:
        return False
    load, pull = TONNES[hook.unit] * hook.values, TONNES[found.unit] * found.values
    return bool(np.allclose(load, pull, rtol=1e-9, atol=1e-9 * np.nanmax(np.abs(pull)), equal_nan=True))


def in_si(unit: str) -> tuple[str, float]:
    """The SI unit of a unit of a summary, and the factor from that to it."""
    return SI.get(unit, (unit, 1.0))


def _load(result: Result, one: Trace) -> Curve:
    factor, unit = REPORTED.get(one.unit, (1.0, one.unit))
    if one.channel == "hook_load":
        factor, unit = TONNES[one.unit] / STANDARD_GRAVITY, "t"
    static = _hanging_weight(result, one) if one.channel in TENSIONS else None
    return Curve(
        kind=one.channel.replace("_", " "), label=one.label, unit=unit, **_scaled(factor, one),
        load=one.channel != "slew_torque",
        pulls=one.channel in TENSIONS,
        suspension=_suspension(result, one) if one.channel in TENSIONS else "",
        of_one_fall=one.channel == "line_tension",
        static=None if static is None else static * in_si(unit)[1],
    )  # fmt: skip


def _hanging_weight(result: Result, one: Trace) -> float | None:
    """The weight of the load on a rod, wire or line, N, as the run noted it; on one of its falls."""
    name, weights = _suspension(result, one), result.about.hanging_weight
    if name not in weights:
        return None
    weight, falls = weights[name]
    return float(weight) / (falls if one.channel == "line_tension" else 1)


def _suspension(result: Result, one: Trace) -> str:
    """A rod, wire or line by its name in the channels over `suspension`."""
    name = one.names[0] if one.names else ""
    beside = f"{name} line"
    known = result.coords.get("suspension", ())
    return beside if one.channel == "line_tension" and beside in known else name


def _water(result: Result) -> list[Curve]:
    """Of each body with parts in water: the depth of its lowest point, and what slam took so far."""
    scene = result.scene
    parts = {} if scene is None else immersed_parts(scene)
    if scene is None or not parts:
        return []
    arrays = {name: result[name] for name in POSES if name in result.channels}
    depths, bodies = immersed_depths(scene, arrays), dict.fromkeys(part.body for part in parts.values())
    found = [] if depths is None else [
        Curve(kind=f"{body} depth", label="", unit="m", values=depths[:, list(wet_names(scene)).index(body)])
        for body in bodies
    ]  # fmt: skip
    states = list(result.coords.get("state_name", ())) if "load_state" in result.channels else []
    for body in bodies:
        losses = [f"{name}.slam_loss" for name, part in parts.items() if part.body == body]
        if states and set(losses) <= set(states):
            lost = result["load_state"][:, [states.index(name) for name in losses]].sum(axis=1)
            if np.nanmax(np.abs(lost)) > NO_ENERGY:
                found.append(Curve(kind=f"{body} slam loss", label="", unit="kJ", values=1e-3 * lost))
    return found


def _offsets(result: Result) -> list[Curve]:
    """Offsets of loads from straight below where they hang: m along x and y, and the angle from vertical."""
    hung = result.about.hung if set(POSES) <= set(result.channels) else ()
    vectors = {one["load"]: _place(result, *one["to"]) - _place(result, *one["from"]) for one in hung}
    found = []
    for body, vector in vectors.items():
        found += [
            Curve(kind=f"{body} offset", label="x", unit="m", values=vector[:, 0]),
            Curve(kind=f"{body} offset", label="y", unit="m", values=vector[:, 1]),
            Curve(kind=f"{body} swing", label="", unit="deg", values=np.degrees(swing_of(vector))),
        ]
    return [one for one in found if np.nanmax(np.abs(one.values), initial=0.0) > NO_MOTION]


def _motions(result: Result) -> list[Curve]:
    if "vessel_motion" not in result.channels:
        return []
    every = [one for motion in MOTIONS for one in traces(result, "vessel_motion", motion=motion)]
    return [
        Curve(kind=one.names[0], label=" ".join(one.names[1:]), unit=one.unit, **_scaled(1.0, one))
        for one in beyond_rounding(every)
    ]


def _place(result: Result, body: str, point: Sequence[float]) -> Array:
    """The place of a point given from a body's centre of mass; of the ground as it is."""
    at = np.asarray(point, dtype=float)
    if body not in result.coords["body"]:
        return at
    turn = rotation_matrix(result.select("quaternion", body=body))
    return np.asarray(result.select("position", body=body) + turn @ at)


def plot_summary(result: Result) -> Figure:
    """Draw what `summary` tells in numbers, a panel for each kind and unit, with events and extremes marked.

    Raises SceneError if the run recorded nothing that a summary holds.
    """
    groups: dict[tuple[str, str], list[Curve]] = {}
    for one in reported_curves(result):
        groups.setdefault((one.kind, one.unit), []).append(one)
    if not groups:
        raise SceneError(
            f"a result with {', '.join(result.channels) or 'no channels'} has no load and no motion to "
            "draw; record link_tension, cylinder_force, position or vessel_motion"
        )
    lines = {key: [Line(label=one.label, values=one.values, colour=i) for i, one in enumerate(group)]
             for key, group in groups.items()}  # fmt: skip
    panels = [Panel(quantity=kind, unit=unit, lines=tuple(own)) for (kind, unit), own in lines.items()]
    return draw(Sheet(
        title=title_of(result),
        caption=f"Triangles mark the largest and the smallest value. {AXES_NOTE}",
        abscissa=result.time, panels=tuple(panels), columns=2 if len(panels) > 3 else 1,
        marks=marks_of(result), extremes=True,
    ))  # fmt: skip
