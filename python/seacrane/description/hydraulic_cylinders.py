"""Hydraulic cylinders: what they are made of, and what follows from where and how they stand."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from seacrane import _core
from seacrane.description.description import Description, Some
from seacrane.description.elements import add_actuator, put_load
from seacrane.description.holding import decided
from seacrane.description.places import ORIGIN, apart
from seacrane.errors import SceneError
from seacrane.inputs.checked import number_of, positive_of, text_of
from seacrane.inputs.values import flat, value

NEVER = 1e7  # s
HOSE = 0.05  # of the swept volume, where no hose volume is given
BACK_PRESSURE = 0.1  # of the pump's, in the chamber that carries nothing
ATMOSPHERE = 1e5  # Pa
NEAR = 1e-6  # m
FASTEST = 100.0  # m/s, of a piston: a flow that moves it faster is in other units
LARGEST_HOSE = 100.0  # times the swept volume, likewise


@value(_core.HydraulicCylinder)
class Chamber:
    """The full side or the rod side of a cylinder.

    Without a pressure it has that which holds the scene at rest as described, a tenth of the pump's where it
    carries nothing. Without a hose volume it has 5 % of the swept volume.
    """

    pressure: float | None = None  # Pa
    hose_volume: float | None = None  # m3


@value(_core.HydraulicCylinder, "oil", "modulus", "density")
class Oil:
    """Oil, and what gives with it. Where it boils is an event, and a `BoilingOilWarning`."""

    modulus: float = 1.5e9  # Pa
    hose_modulus: float = 1.5e8  # Pa
    cylinder_modulus: float = 3.15e10  # Pa
    density: float = 870.0  # kg/m3
    air: float = 0.0
    vapour_pressure: float = 2e3  # Pa
    refuse_void: bool = False


@value(_core.HydraulicCylinder)
class Valve:
    """The valve whose spool opens the way from pump and to tank; without a rated flow there is none."""

    rated_flow: float = 0.0  # m3/s
    rated_flow_rod: float = 0.0  # m3/s
    rated_drop: float = 3.5e6  # Pa
    laminar_drop: float = 2e5  # Pa
    overlap: float = 0.0
    spool_lag: float = 4.547e-3  # s
    gain: float = 0.0  # 1/m
    rate_gain: float = 0.0  # s/m


@value(_core.HydraulicCylinder, "pump", "pressure", "check")
class Pump:
    """Where oil comes from, and goes to."""

    pressure: float = 0.0  # Pa
    tank_pressure: float = 1e5  # Pa
    makeup_flow: float = 0.0  # m3/s
    check: bool = False


@value(_core.HydraulicCylinder, "relief")
class Relief:
    """Relief valves."""

    pressure: float = 0.0  # Pa
    pressure_rod: float = 0.0  # Pa
    flow: float = 0.0  # m3/s
    override: float = 1e6  # Pa


@value(_core.HydraulicCylinder, "counterbalance", "pressure", "pressure_rod", "flow", "range")
class Counterbalance:
    """Load-holding valves."""

    pressure: float = 0.0  # Pa
    pressure_rod: float = 0.0  # Pa
    flow: float = 0.0  # m3/s
    range: float = 5e6  # Pa
    pilot_ratio: float = 4.0


@value(_core.HydraulicCylinder, "accumulator")
class Accumulator:
    """A gas accumulator on the full side."""

    volume: float = 0.0  # m3
    pressure: float = 0.0  # Pa
    flow: float = 0.0  # m3/s
    exponent: float = 1.4


@value(_core.HydraulicCylinder)
class Piston:
    """What a piston and its seals do."""

    viscous_friction: float = 0.0  # N s/m
    friction: float = 0.0  # N
    friction_speed: float = 0.01  # m/s
    internal_leakage: float = 0.0  # m3/s/Pa
    external_leakage: float = 0.0  # m3/s/Pa
    stop_stiffness: float = 1e9  # N/m


@value(_core.HydraulicCylinder, "rupture", "time", "area", rod_side="rod_side_ruptures")
class Rupture:
    """A hose that bursts."""

    time: float = NEVER  # s
    area: float = 0.0  # m2
    rod_side: bool = False
    discharge_coefficient: float = 0.6


VALUES: dict[str, type[Any]] = {
    "chamber": Chamber, "rod_chamber": Chamber, "oil": Oil, "valve": Valve, "pump": Pump, "relief": Relief,
    "counterbalance": Counterbalance, "accumulator": Accumulator, "piston": Piston, "rupture": Rupture,
}  # fmt: skip


def hydraulic_cylinders(scene: Description) -> dict[str, _core.HydraulicCylinder]:
    """By name."""
    return {name: load for name, load in scene.loads.items() if isinstance(load, _core.HydraulicCylinder)}


def slide_of(scene: Description, cylinder: _core.HydraulicCylinder) -> str | None:
    """The prismatic joint along which a cylinder pushes: that of the bodies that it joins."""
    ends = cylinder.first, cylinder.second
    slides = (one for one in scene.joints.values() if one.kind == "prismatic")
    return next((joint.name for joint in slides if (joint.first, joint.second) == ends), None)


def with_ideal_cylinders(scene: Some) -> Some:
    """The scene with an actuator of the same name in place of each cylinder that has a joint to act on."""
    scene = decided(scene)
    found = hydraulic_cylinders(scene)
    slides = {name: slide for name, one in found.items() if (slide := slide_of(scene, one)) is not None}
    out = scene.copy(loads={name: load for name, load in scene.loads.items() if name not in slides})
    out.actuators = dict(scene.actuators)
    for name, slide in slides.items():
        add_actuator(out, name=name, joint=slide)
    return out


def what_of(given: Mapping[str, Any]) -> str:
    """How messages name a cylinder."""
    return f"hydraulic cylinder {text_of('hydraulic cylinder: name', given['name'])!r}"


def place_cylinder(
    scene: Description, keywords: Mapping[str, Any], holding: Callable[[], float]
) -> _core.HydraulicCylinder:
    """Add a cylinder by keywords of `add_hydraulic_cylinder`; what is None or absent is filled in.

    `holding` tells the force that it holds, N. Raises SceneError if the points are not within the stroke.
    """
    what = what_of(keywords)
    settings = flat(what, keywords, VALUES)
    settings.setdefault("reference", _stroke(scene, what, settings))
    stroke = _number(what, settings, "stroke")
    for volume, area in (("hose_volume", "full_area"), ("hose_volume_rod", "rod_side_area")):
        settings.setdefault(volume, HOSE * (_number(what, settings, area) * stroke))
    _check_units(what, settings)
    if not {"pressure", "pressure_rod"} <= settings.keys():
        settings |= _pressures(what, holding(), settings)
    return put_load(scene, _core.HydraulicCylinder(**settings))


def _number(what: str, settings: Mapping[str, Any], key: str, usual: float = 0.0) -> float:
    return number_of(f"{what}: {key}", settings.get(key, usual))


def _check_units(what: str, settings: dict[str, Any]) -> None:
    """SceneError for flows and volumes that are most likely in l/min and l."""
    full, stroke = _number(what, settings, "full_area"), _number(what, settings, "stroke")
    for key in ("rated_flow", "rated_flow_rod"):
        flow = _number(what, settings, key)
        if flow > FASTEST * full > 0.0:
            raise SceneError.of(
                f"{what}: {key}",
                f"is {flow:g} m3/s, which moves the piston by {flow / full:.3g} m/s; give "
                f"m3/s: {flow:g} l/min are {flow / 6e4:.3g}",
            )
    for key in ("hose_volume", "hose_volume_rod"):
        volume = _number(what, settings, key)
        if volume > LARGEST_HOSE * full * stroke > 0.0:
            raise SceneError.of(
                f"{what}: {key}",
                f"is {volume:g} m3, and the piston sweeps {full * stroke:.3g} m3; give m3: {volume:g} l are "
                f"{1e-3 * volume:.3g}",
            )


def _stroke(scene: Description, what: str, settings: dict[str, Any]) -> float:
    """At which the cylinder stands as described, m."""
    ends = ((settings[end], settings.get(f"{end}_point", ORIGIN)) for end in ("first", "second"))
    length = apart(scene, what, *ends)
    shortest = _number(what, settings, "retracted_length")
    longest = shortest + _number(what, settings, "stroke")
    if not shortest - NEAR <= length <= longest + NEAR:
        raise SceneError(
            f"{what}: its points are {length:.6g} m apart as described, and it is {shortest:g} to "
            f"{longest:g} m long; correct retracted_length, stroke or the points"
        )
    return min(max(length - shortest, 0.0), longest - shortest)


def holding_pressures(cylinder: _core.HydraulicCylinder, force: float) -> tuple[float, float]:
    """The pressures of full side and rod side, Pa, by which a cylinder holds another force (N): the rod
    side's as it is described, unless the full side's would fall below the tank's."""
    keys = ("full_area", "rod_side_area", "tank_pressure", "pump_pressure")
    settings = {key: getattr(cylinder, key) for key in keys}
    full = (force + cylinder.pressure_rod * cylinder.rod_side_area) / cylinder.full_area
    if full >= cylinder.tank_pressure:
        return full, cylinder.pressure_rod
    found = _pressures(f"hydraulic cylinder {cylinder.name!r}", force, settings)
    return found["pressure"], found["pressure_rod"]


def _pressures(what: str, force: float, settings: dict[str, Any]) -> dict[str, float]:
    """Of both chambers, Pa, that hold a force: the one that carries nothing has the back pressure."""
    full, ring = (
        positive_of(f"{what}: {area}", settings[area], "m2") for area in ("full_area", "rod_side_area")
    )
    tank = _number(what, settings, "tank_pressure", ATMOSPHERE)
    back = max(tank, BACK_PRESSURE * _number(what, settings, "pump_pressure"))
    if "pressure" in settings:
        given = _number(what, settings, "pressure")
        if given > 0.0 and not given * full > force:
            raise SceneError.of(
                f"{what}: pressure",
                f"is {given:g} Pa, which cannot hold the {force:.4g} N that it carries; "
                f"give more than {force / full:.4g} Pa, or leave it out",
            )
        return {"pressure_rod": (given * full - force) / ring}
    at_rod = _number(what, settings, "pressure_rod", back)
    at_full = (force + at_rod * ring) / full
    if "pressure_rod" in settings or at_full >= back:
        return {"pressure": at_full, "pressure_rod": at_rod}
    return {"pressure": back, "pressure_rod": (back * full - force) / ring}
