"""Values that do not fit others of a scene: strains, speeds, volumes, periods that no machine has."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from seacrane import _core
from seacrane.arrays import Array
from seacrane.description.description import GROUND
from seacrane.description.given import borne_mass, floating_bodies, given_vessels, welded_mass, with_mass
from seacrane.description.loads import named, whole_of
from seacrane.description.places import ANGLES, placed
from seacrane.description.rungs import WITH_MASS
from seacrane.description.suspension import line_weights, suspensions, weights_on
from seacrane.description.vessel_hydrodynamics import VesselHydrodynamics
from seacrane.description.wet_parts import displaced_volume, immersed_parts

if TYPE_CHECKING:
    from seacrane.description.description import Description

Made = tuple[str, str, float, float, float, float]  # a field, what it makes, over what, and usual bounds
FAST_WATER = 5.0  # m/s
FASTEST = {True: ("{} rad/s", 30.0), False: ("{} m/s", 50.0)}  # what a driver moves: of angles, of strokes
LEAST_ADDED_MASS = 5e-3  # over the mass of what floats
WATER = 500.0  # kg/m3: fluids that are heavier
LIGHT = 8.0  # times a body's mass: water that its parts displace; of foam 10
WIRES = 100.0, 4e4  # kg/m3 over the section by the diameter: fibre ropes 600, steel 6,000, chains 25,000
SOUND = 60.0, 3e4  # m/s along a line: nylon 1,000, chain 2,000, steel 4,000; models are often softer
HEAVIEST_LINE = 50.0  # times what hangs on it
LARGEST_STRAIN = 0.3  # at rest, of lines of one EA: nylon
FLOWS = ("rated_flow", "rated_flow_rod", "makeup_flow", "relief_flow", "counterbalance_flow",
         "accumulator_flow")  # fmt: skip


def disproportions(around: Around, element: Any) -> Iterator[str]:
    """One message for each value of an element that does not fit: by its own proportions, and those here."""
    look = _MADE_BY.get(type(element))
    made = [*_own(around, element), *(look(around, element) if look else ())]
    units = {field.name: field.unit for field in type(element).FIELDS}
    for field, makes, size, over, least, most in made:
        value = _over(size, over)
        if value == 0.0 or least <= abs(value) <= most:
            continue
        usual = f"{least:.3g} to {most:.3g}" if least else f"at most {most:.3g}"
        given = getattr(element, field)
        shown = f" of {given:.6g} {units[field]}" if isinstance(given, float) else ""
        yield (
            f"{field}{shown} makes {makes.format(f'{value:.3g}')}, and usual is {usual}: a slip in the unit, "
            f"of it or of what it is compared with? It is in {units[field]}"
        )


class Around:
    """What elements are compared with: the scene as described, at `times` (n,) s of its run.

    `described`: it starts so, with lines as long as they begin.
    """

    def __init__(self, scene: Description, times: Array, *, described: bool) -> None:
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

    def beside(self, element: Any, what: str) -> float:
        """What a number of a load is compared with, in the words of `proportion.hpp`."""
        if what == "distance":
            return self.distance(element)
        last = named(element, "body")[-1]
        if what == "mass" or not with_mass(self.scene, last):
            return self.mass(last)
        return float(np.linalg.eigvalsh(np.asarray(self.scene.bodies[last].inertia))[0])

    def mass(self, *bodies: str) -> float:
        """The smallest of these bodies', kg; infinite of the ground, and of a ship whose motion is given."""
        there = with_mass(self.scene, *bodies)
        return min((self.scene.bodies[body].mass for body in there), default=math.inf)

    def weight(self, *bodies: str) -> float:
        """Of the lightest of these bodies, N."""
        return self.mass(*bodies) * abs(self.scene.gravity)

    def afloat(self, contact: _core.Contact) -> bool:
        """Whether a contact is between ships, which press sideways, and none stands on the other."""
        ships = floating_bodies(self.scene) | self.led
        return contact.body in ships and contact.on in {*ships, GROUND}

    def as_weight(self, field: str, force: float, on: str = "") -> Made:
        """A force over the weight of all bodies; one on a ship whose motion is given has none to compare."""
        bodies = self.scene.bodies.values() if on not in self.led else ()
        heaviest = sum(body.mass for body in bodies) * abs(self.scene.gravity)
        return field, "{} times the weight of all bodies", force, heaviest, 0.0, 100.0

    def largest(self, curve: _core.Curve) -> float:
        """The largest magnitude of a curve in the run."""
        return float(np.abs(curve.evaluate(self.times)[:, 0]).max())

    def at_start(self, curve: _core.Curve) -> float:
        """A curve where the run starts."""
        return float(curve.evaluate(self.times[:1])[0, 0])


def _own(around: Around, element: Any) -> Iterator[Made]:
    """What the header of a load says of its numbers, beside what it acts on."""
    for field, beside, makes, least, most in getattr(type(element), "PROPORTIONS", ()):
        yield field, makes, getattr(element, field), around.beside(element, beside), least, most


def _over(value: float, other: float) -> float:
    """The ratio; 0, which is never told, where there is nothing to compare with."""
    return value / other if other != 0.0 and math.isfinite(other) and math.isfinite(value) else 0.0


def _damped(field: str, damping: float, stiffness: float, mass: float, least: float = 0.0) -> Made:
    """Over critical; quadratic damping at 1 m/s."""
    critical = 2.0 * math.sqrt(max(stiffness, 0.0) * mass)
    return field, "{} of critical damping", damping, critical, least, 30.0


def _period(inertia: float, stiffness: float) -> float:
    return 2.0 * math.pi * math.sqrt(inertia / stiffness) if stiffness > 0.0 < inertia else 0.0


def _half_box(body: _core.Body) -> float:
    """Half the diagonal of a box with a body's mass and inertia, m."""
    return math.sqrt(1.5 * float(np.trace(np.asarray(body.inertia))) / body.mass)


def _line(around: Around, line: _core.Line) -> Iterator[Made]:
    """What it carries counts where nothing else does: a tugger's ship says nothing of the tugger."""
    weight, falls = around.hung.get(line.name, (0.0, 1))
    mass = _over(weight, abs(around.scene.gravity))
    places = np.array([placed(around.scene, *end) for end in zip(line.bodies, line.points, strict=True)])
    path = float(np.linalg.norm(np.diff(places, axis=0), axis=1).sum())
    start = around.at_start(line.length)
    if len(line.tensions):
        yield "tensions", "{} times the weight on it", line.tensions[-1] * falls, weight, 1e-2, 500.0
    else:
        stretched = _over(path, start) - 1.0 if around.described else 0.0
        strain = max(stretched, _over(weight, falls * line.EA), 0.0)
        yield "EA", "a strain of {} at rest", strain, 1.0, 0.0, LARGEST_STRAIN
    if line.name == f"{whole_of(line.name, line)}.1":  # of all segments of one with mass
        whole, below = around.on_chains.get(line.name, (0.0, 0.0))
        sound = math.sqrt(max(_over(line.EA * start, line.mass), 0.0))
        yield "EA", "{} m/s of sound along it", sound, 1.0, *SOUND
        yield "EA", "a strain of {} at rest", whole, line.EA, 0.0, LARGEST_STRAIN
        yield "mass", "all of it {} times the mass on it", whole - below, below, 0.0, HEAVIEST_LINE
    yield "mass", "{} times the mass on the line", line.mass, mass, 1.0 / 300.0, 300.0
    if not line.winch:
        return
    held = around.largest(line.tension)
    yield "tension", "a strain of {}", held, line.EA, 1e-5, 0.5
    yield "tension_gain", "{} m/s by the tension held", line.tension_gain * held, 1.0, 1e-2, 100.0
    yield "dead_band", "{} of the tension held", line.dead_band, held, 1e-4, 2.0
    drum = line.drum_radius**2 * mass
    yield "drum_inertia", "{} times the mass on the line", line.drum_inertia, drum, 1e-3, 100.0


def _gas_spring(around: Around, gas: _core.GasSpring) -> Iterator[Made]:
    ends = gas.first, gas.second
    yield "volume", "{} m of stroke", gas.volume, gas.area, 0.02, 1000.0
    for key in ("minimum", "maximum"):
        if getattr(gas, key) < 1e7:
            yield key, "{} times the length", getattr(gas, key), gas.length, 0.02, 50.0
    stop = gas.stop_stiffness * gas.length
    yield "stop_stiffness", "it give by {} of the length", around.weight(*ends), stop, 0.0, 1.0
    stiffness = _over(gas.exponent * gas.pressure * gas.area**2, gas.volume)
    for key in ("damping", "quadratic_damping"):
        yield _damped(key, getattr(gas, key), stiffness, around.mass(*ends))


def _hydraulic(around: Around, oil: _core.HydraulicCylinder) -> Iterator[Made]:
    full, swept = oil.full_area, oil.full_area * oil.stroke
    yield "rod_side_area", "{} of the full area", oil.rod_side_area, full, 0.02, 1.0
    for side, area in {"": full, "_rod": oil.rod_side_area}.items():
        hose = getattr(oil, f"hose_volume{side}")
        yield f"hose_volume{side}", "{} times the swept volume", hose, area * oil.stroke, 1e-3, 30.0
        yield f"pressure{side}", "{} Pa, absolute", getattr(oil, f"pressure{side}"), 1.0, 5e4, 2e8
    for key in FLOWS:
        yield key, "{} m/s of the piston", getattr(oil, key), full, 1e-3, 30.0
    yield "accumulator_volume", "{} times the swept volume", oil.accumulator_volume, swept, 5e-3, 100.0
    yield "rupture_area", "{} times the piston's area", oil.rupture_area, full, 1e-4, 1.0
    highest = max(oil.pump_pressure, oil.pressure, oil.pressure_rod)
    force = highest * full
    for key in ("internal_leakage", "external_leakage"):
        yield key, "{} m/s of the piston", getattr(oil, key) * highest, full, 0.0, 0.1
    yield "friction", "{} of the cylinder's force", oil.friction, force, 0.0, 1.0
    yield "viscous_friction", "{} of its force at 1 m/s", oil.viscous_friction, force, 0.0, 3.0
    stop = oil.stop_stiffness * oil.stroke
    yield "stop_stiffness", "the ends give by {} of the stroke", force, stop, 0.0, 0.1
    if oil.gain > 0.0:
        yield "reference", "{} of the stroke", around.largest(oil.reference), oil.stroke, 0.0, 1.5


def _flow(around: Around, flow: _core.FlowForce) -> Iterator[Made]:
    yield "lateral_area", "a height of {} m", flow.lateral_area, flow.length, 0.05, 200.0
    yield "frontal_area", "{} of the lateral area", flow.frontal_area, flow.lateral_area, 5e-3, 50.0
    if flow.density > WATER:
        yield "speed", "water at {} m/s", around.largest(flow.speed), 1.0, 0.0, FAST_WATER


def _span(around: Around, span: _core.SpanDrag) -> Iterator[Made]:
    if span.density > WATER:
        yield "flow", "water at {} m/s", float(np.linalg.norm(span.flow)), 1.0, 0.0, FAST_WATER


def _wet_span(around: Around, span: Any) -> Iterator[Made]:
    """Beside the segment of a line with mass that it is the water of: what its section is made of."""
    start = around.at_start(span.length)
    yield "length", "{} times the span", start, around.distance(span), 0.05, 20.0
    line = around.scene.loads.get(span.name.removesuffix(" water"))
    if isinstance(line, _core.Line) and line.name == f"{whole_of(line.name, line)}.1":
        volume = math.pi / 4.0 * span.diameter**2 * start
        yield "diameter", "{} kg/m3 of its mass per length", line.mass, volume, *WIRES


def _seabed(around: Around, bed: _core.SeabedNode) -> Iterator[Made]:
    """A seabed gives by millimetres to metres under what lies on it."""
    weight = around.weight(bed.body)
    yield "stiffness", "{} m by the weight", weight, bed.stiffness, 1e-4, 2.0
    if bed.friction > 0.0:
        away = np.asarray(bed.anchor) - placed(around.scene, bed.body, bed.point)
        yield "anchor", "{} m from its point", float(np.linalg.norm(away[:2])), 1.0, 0.0, 100.0
        yield "load", "{} times the weight on it", bed.load, weight, 1e-2, 100.0


def _part(around: Around, part: _core.ImmersedPart) -> Iterator[Made]:
    """Its size counts beside that of the body, its coefficients beside those of a plate of its size."""
    if part.body in around.led:
        return
    own = around.parts[part.body]
    if own[0] is part:
        water = part.density * sum(displaced_volume(one) for one in own)
        mass = welded_mass(around.scene, part.body)
        yield "size", "all parts displace {} times the body's mass", water, mass, 0.0, LIGHT
    if part.shape == "disc":  # all that it has is that of its size
        return
    sizes, step = np.sort(part.size), float(np.linalg.norm(part.step))
    longest, face = float(sizes[2]), float(sizes[1] * sizes[2])
    if part.place == 0:
        whole, reach = max(longest, part.count * step), 2.0 * _half_box(around.scene.bodies[part.body])
        yield "size", "{} times the body's size", whole, reach, 3e-3, 20.0
    yield "step", "{} times the size of a strip", step, longest, 4e-3, 20.0
    yield "depths", "{} times the size", part.depths[-1], longest, 0.02, 200.0
    plate, added = part.density * face * float(sizes[1]), float(part.added_masses[-1].max())
    yield "added_masses", "{} times a plate's of this size", added, plate, 4e-3, 50.0
    if len(part.slow_added_masses):
        slow = float(part.slow_added_masses[-1].max())
        yield "slow_added_masses", "{} times added_masses, deep down", slow, added, 0.2, 5.0
    yield "drag", "a drag coefficient of {}", float(np.max(part.drag)), 0.5 * part.density * face, 5e-3, 100.0
    if len(part.volumes):
        yield "volumes", "{} of the box around it", part.volumes[-1], float(np.prod(sizes)), 1e-3, 1.5


def _compartment(around: Around, water: _core.EntrappedWater) -> Iterator[Made]:
    mass, held = around.scene.bodies[water.body].mass, water.density * water.area * water.height
    for field in ("area", "height"):
        yield field, "{} times the body's mass of water", held, mass, 1e-4, 50.0
    opening = float(np.sum(water.opening_areas))
    yield "opening_areas", "{} of the section open", opening, water.area, 1e-4, 12.0


def _contact(around: Around, contact: _core.Contact) -> Iterator[Made]:
    """Each point counts with its share of the lighter body."""
    count, ends = len(contact.points), (contact.body, contact.on)
    mass = min(borne_mass(around.scene, *pair) for pair in (ends, ends[::-1])) / count
    weight = mass * abs(around.scene.gravity)
    if len(contact.forces):
        yield "compressions", "a depth of {} m", float(contact.compressions[-1]), 1.0, 2e-3, 10.0
        yield "forces", "{} times the weight on a point", float(contact.forces[-1]), weight, 0.02, 500.0
    else:
        most = 100.0 if around.afloat(contact) else 1.0
        yield "stiffness", "{} m of compression at rest", weight, contact.stiffness, 2e-5, most
    if contact.friction > 0.0:
        shear = contact.shear_stiffness
        yield "shear_stiffness", "{} m before a point slides", contact.friction * weight, shear, 5e-6, 0.3
        yield _damped("shear_damping", contact.shear_damping, shear, mass, least=2e-3)
    owner = around.scene.bodies.get(contact.body)
    if owner is None or contact.body in around.led:
        return
    levers = np.linalg.norm(np.asarray(contact.points) - np.asarray(owner.center_of_mass), axis=1)
    yield "points", "{} times the body's size", levers.max(), _half_box(owner), 3e-3, 100.0
    point = placed(around.scene, contact.body, contact.points[0])
    apart = float(np.linalg.norm(placed(around.scene, contact.on, contact.place) - point))
    yield "place", "a surface {} m away", apart, 1.0, 0.0, 3000.0


def _spring(around: Around, spring: _core.Spring) -> Iterator[Made]:
    distance, bodies = around.distance(spring), (spring.first, spring.second)
    if 0.0 < distance < 1e5:
        longest = float(np.max(spring.lengths)) if len(spring.lengths) else spring.natural_length
        field = "lengths" if len(spring.lengths) else "natural_length"
        yield field, "{} times the distance", longest, distance, 1.0 / 30.0, 30.0
    if len(spring.forces):
        largest = float(np.abs(spring.forces).max())
        yield "forces", "{} times the lighter body's weight", largest, around.weight(*bodies), 1e-2, 300.0
    yield _damped("damping", spring.damping, spring.stiffness, around.mass(*bodies))


def _pushed(around: Around, force: _core.PointForce | _core.ForceTable | _core.Actuator) -> Iterator[Made]:
    match force:
        case _core.PointForce():
            yield around.as_weight("force", float(np.linalg.norm(force.force)), force.body)
        case _core.ForceTable():
            largest = float(np.abs(np.asarray(force.wrenches)[:, :3]).max())
            yield around.as_weight("wrenches", largest, force.body)
        case _core.Actuator() if force.coordinate not in ANGLES:
            yield around.as_weight("feed_forward", around.largest(force.feed_forward))


def _driver(around: Around, driver: _core.Driver) -> Iterator[Made]:
    makes, fastest = FASTEST[driver.coordinate in ANGLES]
    rate = float(np.abs(driver.curve.evaluate(around.times)[:, 1]).max())
    yield "curve", makes, rate, 1.0, 0.0, fastest


def _vessel(around: Around, vessel: VesselHydrodynamics) -> Iterator[Made]:
    body = around.scene.bodies[vessel.body]
    added, restoring = np.diag(vessel.added_mass), np.diag(vessel.restoring)
    heavy = np.array([body.mass] * 3 + list(np.diag(body.inertia)))
    least = LEAST_ADDED_MASS if vessel.floats else 0.0
    yield "added_mass", "{} times the body's mass", float(np.max(added[:3])), body.mass, least, 50.0
    yield "added_mass", "{} times its inertia", float(np.max(added[3:] / heavy[3:])), 1.0, 0.0, 100.0
    for at, name in ((2, "heave"), (3, "roll"), (4, "pitch")):
        period = _period(heavy[at] + added[at], restoring[at])
        yield "restoring", f"a period of {name} of {{}} s", period, 1.0, 0.7, 150.0
        yield _damped("linear_damping", vessel.linear_damping[at, at], restoring[at], heavy[at] + added[at])
    for i, at in enumerate((0, 1, 5)):
        inertia, moored = heavy[at] + added[at], vessel.mooring_stiffness[i]
        yield "mooring_stiffness", "a period of {} s", _period(inertia, moored), 1.0, 7.0, 3000.0
        yield _damped("mooring_damping", vessel.mooring_damping[i], moored, inertia)


_MADE_BY: Mapping[type, Callable[[Around, Any], Iterator[Made]]] = {
    VesselHydrodynamics: _vessel,
    _core.Driver: _driver,
    _core.Line: _line,
    _core.GasSpring: _gas_spring,
    _core.HydraulicCylinder: _hydraulic,
    _core.FlowForce: _flow,
    _core.SpanDrag: _span,
    _core.ImmersedSpan: _wet_span,
    _core.ImmersedPart: _part,
    _core.EntrappedWater: _compartment,
    _core.Contact: _contact,
    _core.WoundSpan: _wet_span,
    _core.SeabedNode: _seabed,
    _core.Spring: _spring,
    _core.Actuator: _pushed,
    _core.PointForce: _pushed,
    _core.ForceTable: _pushed,
}
