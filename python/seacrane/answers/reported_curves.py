"""The curves of a run that an engineer reports, in the units in which they are read."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from seacrane.errors import FileFormatError
from seacrane.inputs.frames import rotation_matrix
from seacrane.pictures.overview import payload_bodies
from seacrane.result import Result
from seacrane.result.traces import NO_MOTION, Trace, beyond_rounding, traces

Array = NDArray[np.float64]
STANDARD_GRAVITY = 9.80665
TENSIONS = ("hook_load", "link_tension", "tension", "line_tension")
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
SI = {"kN": 1e-3, "kN m": 1e-3, "t": 1e-3 / STANDARD_GRAVITY, "deg": float(np.degrees(1.0))}


@dataclass(frozen=True, kw_only=True, eq=False)
class Curve:
    """One curve of a summary.

    Attributes
    ----------
    kind : str
        What it is one of, such as "cylinder force".
    label : str
        Which one; empty where there is one only.
    unit : str
    values : ndarray, shape (n,)
        In the unit.
    load : bool
        Whether it has a dynamic factor.
    pulls : bool
        Whether it is a tension, which may go slack.
    static : float or None
        In the unit, where the run noted it.
    """

    kind: str
    label: str
    unit: str
    values: Array
    load: bool = False
    pulls: bool = False
    static: float | None = None

    @property
    def name(self) -> str:
        """Kind and label."""
        return f"{self.kind} {self.label}".rstrip()


def reported_curves(result: Result) -> list[Curve]:
    """Tensions, cylinder forces, slew torques, how loads hang, and the vessels' heave, roll and pitch.

    What was not recorded, or is zero up to rounding, is left out. Raises FileFormatError where a result holds
    notes that no run writes.
    """
    try:
        return _curves(result)
    except (LookupError, TypeError, ValueError, AttributeError) as error:
        raise FileFormatError(f"the result's notes are none that a run writes: {error}") from error


def _curves(result: Result) -> list[Curve]:
    held = set(result.channels)
    loads = [name for name in (*TENSIONS, *CRANE) if name in held and SAME.get(name) not in held]
    links = set(result.coords[result.dims["tension"][1]]) if "tension" in held else set()
    found = [
        _load(result, one)
        for name in loads
        for one in beyond_rounding(traces(result, name))
        if name != "hook_load" or one.names[0] not in links  # a link's is its tension
    ]
    leads = [
        Curve(kind=one.channel, label=one.label, unit=one.unit, values=one.values)
        for name in LEADS
        if name in held
        for one in beyond_rounding(traces(result, name))
    ]
    gaps = [
        Curve(kind=one.channel, label=one.label, unit=one.unit, values=one.values)
        for one in (traces(result, GAPS) if GAPS in held else [])
    ]
    return [*found, *_offsets(result), *leads, *gaps, *_motions(result)]


SI_UNITS = {"kN": "N", "kN m": "N m", "t": "N", "deg": "rad"}


def si_factor(unit: str) -> float:
    """From SI to a unit of a summary."""
    return SI.get(unit, 1.0)


def _load(result: Result, one: Trace) -> Curve:
    factor, unit = REPORTED.get(one.unit, (1.0, one.unit))
    if one.channel == "hook_load":
        factor, unit = TONNES[one.unit] / STANDARD_GRAVITY, "t"
    static = _hanging_weight(result, one) if one.channel in TENSIONS else None
    return Curve(
        kind=one.channel.replace("_", " "), label=one.label, unit=unit, values=factor * one.values,
        load=one.channel != "slew_torque",
        pulls=one.channel in TENSIONS,
        static=None if static is None else static * si_factor(unit),
    )  # fmt: skip


def _hanging_weight(result: Result, one: Trace) -> float | None:
    """Of the load on a link, N, as the run noted it."""
    weights, on_lines = result.about.hanging_weight, result.about.line_weight
    name = one.names[0] if one.names else ""
    if one.channel == "line_tension":
        weight = on_lines[name][0] / on_lines[name][1] if name in on_lines else None
    elif one.channel == "hook_load" and name in on_lines:
        weight = on_lines[name][0]
    elif one.channel in ("tension", "hook_load"):
        weight = weights.get(name)
    else:
        links = {f"{one['prefix']}hook": one["link"] for one in result.about.cranes if one["link"]}
        link = links.get(name) if one.names else next(iter(links.values()), None)
        weight = weights.get(link or "")
    return None if weight is None else float(weight)


def _offsets(result: Result) -> list[Curve]:
    """Of every load from straight below where it hangs: m along x and y, and the angle from vertical."""
    found = []
    for body, vector in hanging_vectors(result).items():
        curves = {
            ("offset", "x", "m"): vector[:, 0],
            ("offset", "y", "m"): vector[:, 1],
            ("swing", "", "deg"): np.degrees(swing(vector)),
        }
        found += [
            Curve(kind=f"{body} {what}", label=axis, unit=unit, values=values)
            for (what, axis, unit), values in curves.items()
            if np.nanmax(np.abs(values), initial=0.0) > NO_MOTION
        ]
    return found


def _motions(result: Result) -> list[Curve]:
    if "vessel_motion" not in result.channels:
        return []
    every = [one for motion in MOTIONS for one in traces(result, "vessel_motion", motion=motion)]
    return [
        Curve(kind=one.names[0], label=" ".join(one.names[1:]), unit=one.unit, values=one.values)
        for one in beyond_rounding(every)
    ]


def hanging_vectors(result: Result) -> dict[str, Array]:
    """From the upper to the lower end of the one link that each load hangs on, (n, 3), m, inertial axes.

    By body. Empty where the poses were not recorded, or a result notes no links.
    """
    if not set(POSES) <= set(result.channels):
        return {}
    links = result.about.outline.get("links", [])
    found = {}
    for body in payload_bodies(result):
        own = [link for link in links if link[2] == body]
        if len(own) == 1:
            first, first_point, _, point = own[0]
            found[body] = _place(result, body, point) - _place(result, first, first_point)
    return found


def swing(vector: Array) -> Array:
    """Angle (n,) of hanging vectors (n, 3) from straight down, rad."""
    return np.arctan2(np.hypot(vector[:, 0], vector[:, 1]), -vector[:, 2])


def _place(result: Result, body: str, point: Sequence[float]) -> Array:
    """Of a point given from a body's centre of mass; of the ground as it is."""
    at = np.asarray(point, dtype=float)
    if body not in result.coords["body"]:
        return at
    turn = rotation_matrix(result.select("quaternion", body=body))
    return np.asarray(result.select("position", body=body) + turn @ at)
