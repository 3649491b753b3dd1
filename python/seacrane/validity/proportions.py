"""Values that do not fit others of a scene: strains, speeds, volumes, periods that no machine has."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.description.description import GROUND
from seacrane.description.given import floating_bodies, given_vessels
from seacrane.description.joint_coordinates import ANGLES
from seacrane.description.loads import whole_of
from seacrane.description.places import placed
from seacrane.description.rungs import WITH_MASS
from seacrane.description.suspension import line_weights, suspensions, weights_on
from seacrane.description.welded import borne_mass, welded_mass, with_mass
from seacrane.description.wet_parts import displaced_volume, immersed_parts

if TYPE_CHECKING:
    from seacrane.description.description import Description

Array = NDArray[np.float64]
FAST_WATER = 5.0  # m/s
FASTEST_SLIDE, FASTEST_TURN = 50.0, 30.0  # m/s, rad/s: of what a driver moves
LEAST_ADDED_MASS = 5e-3  # over the mass of what floats
WATER = 500.0  # kg/m3: fluids that are heavier
LIGHT = 8.0  # times a body's mass: water that its parts displace; of foam 10
WIRES = 100.0, 4e4  # kg/m3 over the section by the diameter: fibre ropes 600, steel 6,000, chains 25,000
SOUND = 60.0, 3e4  # m/s along a line: nylon 1,000, chain 2,000, steel 4,000; models are often softer
HEAVIEST_LINE = 50.0  # times what hangs on it
LARGEST_STRAIN = 0.3  # at rest, of lines of one EA: nylon


@dataclass(frozen=True)
class Proportion:
    """What a value makes with others: its usual range, and how to say it."""

    field: str
    makes: str  # "a strain of {:.3g}"
    value: float
    least: float
    most: float
    unit: str

    @property
    def beyond(self) -> bool:
        return self.value != 0.0 and not self.least <= abs(self.value) <= self.most

    def text(self, given: Any) -> str:
        usual = f"{self.least:.3g} to {self.most:.3g}" if self.least else f"at most {self.most:.3g}"
        shown = f" of {given:.6g} {self.unit}" if isinstance(given, float) else ""
        return (
            f"{self.field}{shown} makes {self.makes.format(self.value)}, and usual is {usual}: a slip in the "
            f"unit, of it or of what it is compared with? It is in {self.unit}"
        )


def disproportions(scene: Description, times: Array, *, described: bool) -> Iterator[str]:
    """One message for each value that does not fit; `times` (n,) s of the run, `described`: as it starts."""
    around = _Around(scene, times, described)
    for kind, element, look in _looks(scene):
        for one in look(around, element):
            if one.beyond:
                yield f"{kind} {element.name!r}: {one.text(getattr(element, one.field, None))}"


def _looks(scene: Description) -> Iterator[tuple[str, Any, Callable[..., Iterator[Proportion]]]]:
    for vessel in scene.vessels.values():
        yield "vessel", vessel, _vessel
    for driver in scene.drivers.values():
        yield "driver", driver, _driver
    for element in scene.all_loads():
        if type(element) in _OF_LOADS:
            kind, look = _OF_LOADS[type(element)]
            yield kind, element, look


class _Around:
    """What elements are compared with: the scene as described."""

    def __init__(self, scene: Description, times: Array, described: bool) -> None:
        self.described = described
        self.scene, self.times, self.hung = scene, times, line_weights(scene)
        weights = weights_on(scene)
        self.on_chains = {  # N at the upper end and at the lower one, by the first segment of lines with mass
            one.top: (weights[one.top][0], weights[one.channel][0])
            for one in suspensions(scene) if one.rung == WITH_MASS and one.channel in weights
        }  # fmt: skip
        self.led = set(given_vessels(scene))  # whose light bodies stand for ships
        self.parts: dict[str, list[_core.ImmersedPart]] = {}  # by the body
        for part in immersed_parts(scene).values():
            self.parts.setdefault(part.body, []).append(part)

    def distance(self, element: Any) -> float:
        """Between the two points of an element, m."""
        ends = (element.first, element.first_point), (element.second, element.second_point)
        return float(np.linalg.norm(placed(self.scene, *ends[1]) - placed(self.scene, *ends[0])))

    def mass(self, *bodies: str) -> float:
        """The smallest of these bodies', kg; infinite of the ground, and of a ship whose motion is given."""
        there = with_mass(self.scene, *bodies)
        return min((self.scene.bodies[body].mass for body in there), default=math.inf)

    def weight(self, *bodies: str) -> float:
        return self.mass(*bodies) * abs(self.scene.gravity)

    def afloat(self, contact: _core.Contact) -> bool:
        """Whether a contact is between ships, which press sideways, and none stands on the other."""
        ships = floating_bodies(self.scene) | self.led
        return contact.body in ships and contact.on in {*ships, GROUND}

    def as_weight(self, field: str, force: float, unit: str, on: str = "") -> Proportion:
        """A force over the weight of all bodies; one on a ship whose motion is given has none to compare."""
        bodies = self.scene.bodies.values() if on not in self.led else ()
        heaviest = sum(body.mass for body in bodies) * abs(self.scene.gravity)
        makes = "{:.3g} times the weight of all bodies"
        return Proportion(field, makes, _over(force, heaviest), 0.0, 100.0, unit)

    def largest(self, curve: _core.Curve) -> float:
        return float(np.abs(curve.evaluate(self.times)[:, 0]).max())


def _line(around: _Around, line: _core.Line) -> Iterator[Proportion]:
    """What it carries counts where nothing else does: a tugger's ship says nothing of the tugger."""
    weight, falls = around.hung.get(line.name, (0.0, 1))
    mass = _over(weight, abs(around.scene.gravity))
    places = np.array([placed(around.scene, *end) for end in zip(line.bodies, line.points, strict=True)])
    path = float(np.linalg.norm(np.diff(places, axis=0), axis=1).sum())
    start = float(line.length.evaluate(around.times[:1])[0, 0])
    if len(line.tensions):
        share = _over(line.tensions[-1] * falls, weight)
        yield Proportion("tensions", "{:.3g} times the weight on it", share, 1e-2, 500.0, "N")
    else:
        stretched = _over(path, start) - 1.0 if around.described else 0.0
        strain = max(stretched, _over(weight, falls * line.EA), 0.0)
        yield Proportion("EA", "a strain of {:.3g} at rest", strain, 0.0, LARGEST_STRAIN, "N")
    if line.name == f"{whole_of(line.name, line)}.1":  # of all segments of one with mass
        speed = math.sqrt(max(_over(line.EA * start, line.mass), 0.0))
        yield Proportion("EA", "{:.3g} m/s of sound along it", speed, *SOUND, "N")
        whole, below = around.on_chains.get(line.name, (0.0, 0.0))
        yield Proportion("EA", "a strain of {:.3g} at rest", _over(whole, line.EA), 0.0, LARGEST_STRAIN, "N")
        share = _over(whole - below, below)
        yield Proportion("mass", "all of it {:.3g} times the mass on it", share, 0.0, HEAVIEST_LINE, "kg")
    share = _over(line.mass, mass)
    yield Proportion("mass", "{:.3g} times the mass on the line", share, 1.0 / 300.0, 300.0, "kg")
    if not line.winch:
        return
    held = around.largest(line.tension)
    yield Proportion("tension", "a strain of {:.3g}", _over(held, line.EA), 1e-5, 0.5, "N")
    speed = line.tension_gain * held
    yield Proportion("tension_gain", "{:.3g} m/s by the tension held", speed, 1e-2, 100.0, "m/s/N")
    share = _over(line.dead_band, held)
    yield Proportion("dead_band", "{:.3g} of the tension held", share, 1e-4, 2.0, "N")
    share = _over(line.drum_inertia, line.drum_radius**2 * mass)
    yield Proportion("drum_inertia", "{:.3g} times the mass on the line", share, 1e-3, 100.0, "kg m2")


def _gas_spring(around: _Around, gas: _core.GasSpring) -> Iterator[Proportion]:
    distance, weight = around.distance(gas), around.weight(gas.first, gas.second)
    yield Proportion("volume", "{:.3g} m of stroke", _over(gas.volume, gas.area), 0.02, 1000.0, "m3")
    yield Proportion("length", "{:.3g} times the distance", _over(gas.length, distance), 0.05, 20.0, "m")
    for key in ("minimum", "maximum"):
        bound = getattr(gas, key)
        if bound < 1e7:
            yield Proportion(key, "{:.3g} times the length", _over(bound, gas.length), 0.02, 50.0, "m")
    given = _over(weight, gas.stop_stiffness * gas.length)
    yield Proportion("stop_stiffness", "it give by {:.3g} of the length", given, 0.0, 1.0, "N/m")
    mass = around.mass(gas.first, gas.second)
    stiffness = _over(gas.exponent * gas.pressure * gas.area**2, gas.volume)
    yield _damped("damping", gas.damping, stiffness, mass, "N s/m")
    yield _damped("quadratic_damping", gas.quadratic_damping, stiffness, mass, "N s2/m2")


def _over(value: float, other: float) -> float:
    """The ratio; 0, which is never told, where there is nothing to compare with."""
    return value / other if other != 0.0 and math.isfinite(other) and math.isfinite(value) else 0.0


def _damped(field: str, damping: float, stiffness: float, mass: float, unit: str) -> Proportion:
    """Over critical; quadratic damping at 1 m/s."""
    critical = 2.0 * math.sqrt(max(stiffness, 0.0) * mass)
    ratio = _over(damping, critical)
    return Proportion(field, "{:.3g} of critical damping", ratio, 0.0, 30.0, unit)


def _hydraulic(around: _Around, oil: _core.HydraulicCylinder) -> Iterator[Proportion]:
    areas = {"": oil.full_area, "_rod": oil.rod_side_area}
    yield Proportion(
        "rod_side_area", "{:.3g} of the full area", _over(areas["_rod"], areas[""]), 0.02, 1.0, "m2"
    )
    for side, area in areas.items():
        hose = _over(getattr(oil, f"hose_volume{side}"), area * oil.stroke)
        yield Proportion(f"hose_volume{side}", "{:.3g} times the swept volume", hose, 1e-3, 30.0, "m3")
        pressure = getattr(oil, f"pressure{side}")
        yield Proportion(f"pressure{side}", "{:.3g} Pa, absolute", pressure, 5e4, 2e8, "Pa")
    for key in ("rated_flow", "rated_flow_rod", "makeup_flow", "relief_flow", "counterbalance_flow",
                "accumulator_flow"):  # fmt: skip
        speed = _over(getattr(oil, key), areas[""])
        yield Proportion(key, "{:.3g} m/s of the piston", speed, 1e-3, 30.0, "m3/s")
    gas = _over(oil.accumulator_volume, areas[""] * oil.stroke)
    yield Proportion("accumulator_volume", "{:.3g} times the swept volume", gas, 5e-3, 100.0, "m3")
    hole = _over(oil.rupture_area, areas[""])
    yield Proportion("rupture_area", "{:.3g} times the piston's area", hole, 1e-4, 1.0, "m2")
    highest = max(oil.pump_pressure, oil.pressure, oil.pressure_rod)
    force = highest * areas[""]
    for key in ("internal_leakage", "external_leakage"):
        speed = _over(getattr(oil, key) * highest, areas[""])
        yield Proportion(key, "{:.3g} m/s of the piston", speed, 0.0, 0.1, "m3/s/Pa")
    yield Proportion("friction", "{:.3g} of the cylinder's force", _over(oil.friction, force), 0.0, 1.0, "N")
    drag = _over(oil.viscous_friction, force)
    yield Proportion("viscous_friction", "{:.3g} of its force at 1 m/s", drag, 0.0, 3.0, "N s/m")
    given = _over(force, oil.stop_stiffness * oil.stroke)
    yield Proportion("stop_stiffness", "the ends give by {:.3g} of the stroke", given, 0.0, 0.1, "N/m")
    if oil.gain > 0.0:
        share = _over(around.largest(oil.reference), oil.stroke)
        yield Proportion("reference", "{:.3g} of the stroke", share, 0.0, 1.5, "m")


def _flow(around: _Around, flow: _core.FlowForce) -> Iterator[Proportion]:
    height = _over(flow.lateral_area, flow.length)
    yield Proportion("lateral_area", "a height of {:.3g} m", height, 0.05, 200.0, "m2")
    share = _over(flow.frontal_area, flow.lateral_area)
    yield Proportion("frontal_area", "{:.3g} of the lateral area", share, 5e-3, 50.0, "m2")
    yield from _fluid(flow.density, around.largest(flow.speed), "speed")


def _fluid(density: float, speed: float, field: str) -> Iterator[Proportion]:
    if density > WATER:
        yield Proportion(field, "water at {:.3g} m/s", speed, 0.0, FAST_WATER, "m/s")


def _wet_span(around: _Around, span: _core.ImmersedSpan | _core.WoundSpan) -> Iterator[Proportion]:
    start = float(span.length.evaluate(around.times[:1])[0, 0])
    share = _over(start, around.distance(span))
    yield Proportion("length", "{:.3g} times the span", share, 0.05, 20.0, "m")


def _span(around: _Around, span: _core.SpanDrag) -> Iterator[Proportion]:
    distance = around.distance(span)
    yield Proportion("length", "{:.3g} times the span", _over(span.length, distance), 0.05, 20.0, "m")
    yield from _fluid(span.density, float(np.linalg.norm(span.flow)), "flow")


def _seabed(around: _Around, bed: _core.SeabedNode) -> Iterator[Proportion]:
    """A seabed gives by millimetres to metres under what lies on it."""
    weight = around.weight(bed.body)
    yield Proportion("stiffness", "{:.3g} m by the weight", _over(weight, bed.stiffness), 1e-4, 2.0, "N/m")
    if bed.friction > 0.0:
        away = np.asarray(bed.anchor) - placed(around.scene, bed.body, bed.point)
        aside = float(np.linalg.norm(away[:2]))
        yield Proportion("anchor", "{:.3g} m from its point", aside, 0.0, 100.0, "m")
        share = _over(bed.load, weight)
        yield Proportion("load", "{:.3g} times the weight on it", share, 1e-2, 100.0, "N")


def _immersed_span(around: _Around, span: _core.ImmersedSpan) -> Iterator[Proportion]:
    """Beside the segment of a line with mass that it is the water of: what its section is made of."""
    yield from _wet_span(around, span)
    line = around.scene.loads.get(span.name.removesuffix(" water"))
    section = math.pi / 4.0 * span.diameter**2
    if not isinstance(line, _core.Line) or not section or line.name != f"{whole_of(line.name, line)}.1":
        return
    start = float(span.length.evaluate(around.times[:1])[0, 0])
    density = _over(line.mass, section * start)
    yield Proportion("diameter", "{:.3g} kg/m3 of its mass per length", density, *WIRES, "m")


def _part(around: _Around, part: _core.ImmersedPart) -> Iterator[Proportion]:
    """Its size counts beside that of the body, its coefficients beside those of a plate of its size."""
    if part.body in around.led:
        return
    own = around.parts[part.body]
    if own[0] is part:
        water = part.density * sum(displaced_volume(one) for one in own)
        share = _over(water, welded_mass(around.scene, part.body))
        yield Proportion("size", "all parts displace {:.3g} times the body's mass", share, 0.0, LIGHT, "m")
    body, sizes = around.scene.bodies[part.body], np.sort(part.size)
    reach = 2.0 * math.sqrt(1.5 * float(np.trace(np.asarray(body.inertia))) / body.mass)  # of a box with it
    longest, face = float(sizes[2]), float(sizes[1] * sizes[2])
    if part.shape == "disc":  # all that it has is that of its size
        return
    if part.place == 0:
        whole = max(longest, part.count * float(np.linalg.norm(part.step)))
        yield Proportion("size", "{:.3g} times the body's size", _over(whole, reach), 3e-3, 20.0, "m")
    share = _over(float(np.linalg.norm(part.step)), longest)
    yield Proportion("step", "{:.3g} times the size of a strip", share, 4e-3, 20.0, "m")
    share = _over(part.depths[-1], longest)
    yield Proportion("depths", "{:.3g} times the size", share, 0.02, 200.0, "m")
    plate = part.density * face * float(sizes[1])
    share = _over(float(part.added_masses[-1].max()), plate)
    yield Proportion("added_masses", "{:.3g} times a plate's of this size", share, 4e-3, 50.0, "kg")
    if len(part.slow_added_masses):
        share = _over(float(part.slow_added_masses[-1].max()), float(part.added_masses[-1].max()))
        yield Proportion("slow_added_masses", "{:.3g} times added_masses, deep down", share, 0.2, 5.0, "kg")
    share = _over(float(np.max(part.drag)), 0.5 * part.density * face)
    yield Proportion("drag", "a drag coefficient of {:.3g}", share, 5e-3, 100.0, "N s2/m2")
    if len(part.volumes):
        share = _over(part.volumes[-1], float(np.prod(sizes)))
        yield Proportion("volumes", "{:.3g} of the box around it", share, 1e-3, 1.5, "m3")


def _compartment(around: _Around, water: _core.EntrappedWater) -> Iterator[Proportion]:
    mass = around.scene.bodies[water.body].mass
    for field, unit in (("area", "m2"), ("height", "m")):
        share = _over(water.density * water.area * water.height, mass)
        yield Proportion(field, "{:.3g} times the body's mass of water", share, 1e-4, 50.0, unit)
    share = _over(float(np.sum(water.opening_areas)), water.area)
    yield Proportion("opening_areas", "{:.3g} of the section open", share, 1e-4, 12.0, "m2")


def _contact(around: _Around, contact: _core.Contact) -> Iterator[Proportion]:
    """Each point counts with its share of the lighter body."""
    count, ends = len(contact.points), (contact.body, contact.on)
    mass = min(borne_mass(around.scene, *pair) for pair in (ends, ends[::-1])) / count
    weight = mass * abs(around.scene.gravity)
    if len(contact.forces):
        deepest = float(contact.compressions[-1])
        yield Proportion("compressions", "a depth of {:.3g} m", deepest, 2e-3, 10.0, "m")
        share = _over(float(contact.forces[-1]), weight)
        yield Proportion("forces", "{:.3g} times the weight on a point", share, 0.02, 500.0, "N")
    else:
        sunk, most = _over(weight, contact.stiffness), 100.0 if around.afloat(contact) else 1.0
        yield Proportion("stiffness", "{:.3g} m of compression at rest", sunk, 2e-5, most, "N/m")
    if contact.friction > 0.0:
        give = _over(contact.friction * weight, contact.shear_stiffness)
        yield Proportion("shear_stiffness", "{:.3g} m before a point slides", give, 5e-6, 0.3, "N/m")
        ratio = _damped("shear_damping", contact.shear_damping, contact.shear_stiffness, mass, "N s/m")
        yield replace(ratio, least=2e-3)
    owner = around.scene.bodies.get(contact.body)
    if owner is None or contact.body in around.led:
        return
    reach = math.sqrt(1.5 * float(np.trace(np.asarray(owner.inertia))) / owner.mass)  # of a box with it
    levers = np.linalg.norm(np.asarray(contact.points) - np.asarray(owner.center_of_mass), axis=1)
    yield Proportion("points", "{:.3g} times the body's size", _over(levers.max(), reach), 3e-3, 100.0, "m")
    point = placed(around.scene, contact.body, contact.points[0])
    apart = float(np.linalg.norm(placed(around.scene, contact.on, contact.place) - point))
    yield Proportion("place", "a surface {:.3g} m away", apart, 0.0, 3000.0, "m")


def _pendulum(around: _Around, swing: _core.PendulumDamping) -> Iterator[Proportion]:
    mass = around.mass(swing.second)
    share = _over(swing.mass, mass)
    yield Proportion("mass", "{:.3g} times the mass that swings", share, 1.0 / 300.0, 300.0, "kg")


def _spring(around: _Around, spring: _core.Spring) -> Iterator[Proportion]:
    distance, mass = around.distance(spring), around.mass(spring.first, spring.second)
    weight = around.weight(spring.first, spring.second)
    if distance > 0.0 and distance < 1e5:
        longest = float(np.max(spring.lengths)) if len(spring.lengths) else spring.natural_length
        field = "lengths" if len(spring.lengths) else "natural_length"
        yield Proportion(field, "{:.3g} times the distance", _over(longest, distance), 1.0 / 30.0, 30.0, "m")
    if len(spring.forces):
        share = _over(float(np.abs(spring.forces).max()), weight)
        yield Proportion("forces", "{:.3g} times the lighter body's weight", share, 1e-2, 300.0, "N")
    yield _damped("damping", spring.damping, spring.stiffness, mass, "N s/m")


def _pushed(around: _Around, force: _core.PointForce) -> Iterator[Proportion]:
    yield around.as_weight("force", float(np.linalg.norm(force.force)), "N", force.body)


def _tabled(around: _Around, table: _core.ForceTable) -> Iterator[Proportion]:
    largest = float(np.abs(np.asarray(table.wrenches)[:, :3]).max())
    yield around.as_weight("wrenches", largest, "N, N m", table.body)


def _actuator(around: _Around, actuator: _core.Actuator) -> Iterator[Proportion]:
    if actuator.coordinate not in ANGLES:
        yield around.as_weight("feed_forward", around.largest(actuator.feed_forward), "N or N m")


def _driver(around: _Around, driver: _core.Driver) -> Iterator[Proportion]:
    rate = float(np.abs(driver.curve.evaluate(around.times)[:, 1]).max())
    if driver.coordinate in ANGLES:
        yield Proportion("curve", "{:.3g} rad/s", rate, 0.0, FASTEST_TURN, "rad")
    else:
        yield Proportion("curve", "{:.3g} m/s", rate, 0.0, FASTEST_SLIDE, "m")


def _vessel(around: _Around, vessel: _core.VesselHydrodynamics) -> Iterator[Proportion]:
    body = around.scene.bodies[vessel.body]
    added, restoring = np.diag(vessel.added_mass), np.diag(vessel.restoring)
    heavy = np.array([body.mass] * 3 + list(np.diag(body.inertia)))
    own = float(np.max(added[:3])) / body.mass
    least = LEAST_ADDED_MASS if vessel.floats else 0.0
    yield Proportion("added_mass", "{:.3g} times the body's mass", own, least, 50.0, "kg, kg m, kg m2")
    spun = float(np.max(added[3:] / heavy[3:]))
    yield Proportion("added_mass", "{:.3g} times its inertia", spun, 0.0, 100.0, "kg, kg m, kg m2")
    for at, name in ((2, "heave"), (3, "roll"), (4, "pitch")):
        period, makes = _period(heavy[at] + added[at], restoring[at]), f"a period of {name} of {{:.3g}} s"
        yield Proportion("restoring", makes, period, 0.7, 150.0, "N/m, N, N m")
    moored = np.diag([*vessel.mooring_stiffness])
    for i, at in enumerate((0, 1, 5)):
        period = _period(heavy[at] + added[at], moored[i, i])
        yield Proportion("mooring_stiffness", "a period of {:.3g} s", period, 7.0, 3000.0, "N/m, N m/rad")
        yield _damped("mooring_damping", vessel.mooring_damping[i], moored[i, i], heavy[at] + added[at],
                      "N s/m, N m s/rad")  # fmt: skip
    for at in (2, 3, 4):
        yield _damped("linear_damping", vessel.linear_damping[at, at], restoring[at], heavy[at] + added[at],
                      "N s/m, N s, N m s")  # fmt: skip


def _period(inertia: float, stiffness: float) -> float:
    return 2.0 * math.pi * math.sqrt(inertia / stiffness) if stiffness > 0.0 < inertia else 0.0


_OF_LOADS: Mapping[type, tuple[str, Callable[..., Iterator[Proportion]]]] = {
    _core.Line: ("line", _line),
    _core.GasSpring: ("gas spring", _gas_spring),
    _core.HydraulicCylinder: ("hydraulic cylinder", _hydraulic),
    _core.FlowForce: ("flow force", _flow),
    _core.SpanDrag: ("span drag", _span),
    _core.ImmersedSpan: ("immersed span", _immersed_span),
    _core.ImmersedPart: ("immersed part", _part),
    _core.EntrappedWater: ("entrapped water", _compartment),
    _core.Contact: ("contact", _contact),
    _core.WoundSpan: ("wound span", _wet_span),
    _core.SeabedNode: ("seabed node", _seabed),
    _core.PendulumDamping: ("pendulum damping", _pendulum),
    _core.Spring: ("spring", _spring),
    _core.Actuator: ("actuator", _actuator),
    _core.PointForce: ("point force", _pushed),
    _core.ForceTable: ("force table", _tabled),
}
