"""A plausible scene for each kind of element, in which any one of its numbers may be replaced."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np

from seacrane import Curve, Scene, _core
from seacrane.description.elements import add_load
from seacrane.description.waves import Waves
from seacrane.hydro import BoxPart

MASS, G = 2e4, 9.80665
INERTIA = np.diag([3e4, 3e4, 3e4])


@dataclass(frozen=True)
class Sample:
    """An element with its numbers, the scene around it, and what else describes it."""

    kind: type
    numbers: Mapping[str, Any]
    start: Callable[[], Scene]
    fixed: Mapping[str, Any] = field(default_factory=dict)
    add: Callable[..., Any] | None = None  # to the scene; a load by itself

    def scene(self, numbers: Mapping[str, Any]) -> Scene:
        made, given = self.start(), {**self.fixed, **numbers}
        if self.add is None:
            add_load(made, self.kind(name="one", **given))
        else:
            self.add(made, **given)
        return made

    def slipped(self, key: str, factor: float) -> Scene:
        """The scene with one number a thousand times too large, or too small."""
        return self.scene({**self.numbers, key: scaled(self.numbers[key], factor)})


def scaled(value: Any, factor: float) -> Any:
    if isinstance(value, Curve):
        (amplitude, _, _), *_ = value.to_pieces()["cosines"]
        return swing(amplitude * factor)
    return (np.asarray(value, dtype=float) * factor).tolist()


def swing(amplitude: float) -> Curve:
    """From zero, with the largest rate."""
    return Curve.harmonic(start_time=0.0, offset=0.0, amplitude=amplitude, omega=1.0, phase=-np.pi / 2)


def with_load(position: Any = (0.0, 0.0, -15.0), **body: Any) -> Scene:
    scene = Scene(name="sample")
    scene.add_body(**{"name": "load", "mass": MASS, "inertia": INERTIA, "position": position} | body)
    return scene


def at(height: float, **body: Any) -> Callable[[], Scene]:
    return partial(with_load, (0.0, 0.0, height), **body)


def on_rail(kind: str = "prismatic", **body: Any) -> Scene:
    scene = with_load((0.0, 0.0, 1.5), **body)
    axis = {"axis": (0, 0, 1)} if kind == "prismatic" else {"axis": (0, 1, 0)}
    scene.add_joint("rail", kind=kind, first="ground", second="load", **axis)
    return scene


def at_the_surface() -> Scene:
    """A load on a wire with its middle in the surface of a sea of one wave."""
    scene, one = with_load((0.0, 0.0, 0.0)), np.ones(1)
    scene.waves = Waves(omega=one, amplitude=0.3 * one, phase=0.0 * one, direction=0.0 * one, hulls={})
    scene.add_line(name="wire", bodies=["ground", "load"], points=[(0, 0, 20), (0, 0, 1)], EA=5e7,
                   tension_at_start=0.5 * MASS * G)  # fmt: skip
    return scene


def beside_a_part() -> Scene:
    scene = at_the_surface()
    scene.add_immersed("load", parts=[BoxPart(size=(2.0, 1.6, 2.0), point=(0.3, 0, 0))])
    return scene


def over_a_boat() -> Scene:
    scene = with_load()
    length = 15.0 / (1 + MASS * G / 5e7)
    wire = {"points": np.zeros((2, 3)), "EA": 5e7, "length": length, "winch": True, "lag": 0.2}
    add_load(scene, _core.Line(name="wire", bodies=["ground", "load"], **wire))
    scene.add_body("boat", mass=1e5, inertia=np.diag([1e6] * 3), gravity=False)
    return scene


def on_a_ball() -> Scene:
    scene = with_load((0.0, 0.0, -10.0))
    scene.add_joint("hook", kind="spherical", first="ground", second="load")
    return scene


def a_ship() -> Scene:
    scene = Scene(name="sample")
    scene.add_body("ship", mass=1e7, inertia=np.diag([1e9, 8e9, 8e9]))
    return scene


def weighed(scene: Scene, **numbers: Any) -> None:
    scene.add_body("load", **numbers)
    scene.add_line("wire", bodies=["ground", "load"], points=np.zeros((2, 3)), EA=5e7, length=15.0)


def sheaved(scene: Scene, **given: Any) -> None:
    words = given.keys() & {"radii", "axes", "efficiencies", "frictions", "slip_speed"}
    scene.add_line(sheaves={word: given.pop(word) for word in words}, **given)


def linked(scene: Scene, length: float, **points: Any) -> None:
    frames = {f"{end}_frame": _core.Frame(point=points[f"{end} point"]) for end in ("first", "second")}
    scene.add_joint("link", kind="distance", first="ground", second="load", length=length, **frames)


AREA = 0.02
WIRE = {"points": [(0.5, 0.0, 0.0), (0.5, 0.0, 1.0)], "EA": 5e7, "length": 14.0 / (1.0 + MASS * G / 5e7)}
HUNG = {"bodies": ["ground", "load"]}
WOUND = {**HUNG, **WIRE, "winch": True}
LOAD, BETWEEN = {"body": "load"}, {"first": "ground", "second": "load"}
SHEAVE = {
    "name": "wire", "bodies": ["ground", "ground", "load"], "tension_at_start": MASS * G, "EA": 5e7,
    "points": [(0, -20, 0), (0, 0, 0), (0, 0.5, 1)], "axes": [(0, 0, 0), (-1, 0, 0), (0, 0, 0)],
}  # fmt: skip
CORD = {**HUNG, **WIRE, "EA": 4e5 / 0.3, "length": 11.5}
# Just above the top of a box of the ground that is 4 m over its origin.
FEET = {**LOAD, "on": "ground", "stiffness": 0.5 * MASS * G / 0.01, "place": (0.0, 0.0, 4.0)}
RAIL = {"joint": "rail", "coordinate": "displacement"}
CIRCLE = {**LOAD, "angles": np.linspace(0.0, 1.5 * np.pi, 4)}
DRAG = [(1, 0, 0), (0, 0.8, 0), (-1, 0, 0), (0, -0.8, 0)]
ENDS = {"first_point": (0.0, 0.0, 2.0), "second_point": (0.0, 0.0, 1.0)}
MASSES = [(0, 0, 0), (1e3, 1e3, 1e4), (8e3, 9e3, 2e4), (8e3, 9e3, 4e4)]
SAMPLES: Mapping[str, Sample] = {
    "line": Sample(_core.Line, {**WIRE, "damping_ratio": 0.02, "mass": MASS}, with_load, HUNG),
    "quasi-static line": Sample(_core.Line, {"settling": 0.2}, with_load, {**HUNG, **WIRE,
        "rung": "quasi-static"}),
    "cord": Sample(_core.Line, {"strains": [0.0, 0.15, 0.3], "tensions": [0.0, 1e5, 4e5]}, with_load, CORD),
    "sheaved line": Sample(_core.Line, {"radii": [0.0, 0.5, 0.0], "efficiencies": [1.0, 0.98, 1.0],
        "slip_speed": 0.01}, with_load, SHEAVE, sheaved),
    "rubbing line": Sample(_core.Line, {"frictions": [0.0, 0.1, 0.0]}, with_load, {**SHEAVE,
        "radii": [0.0, 0.5, 0.0]}, sheaved),
    "winch": Sample(_core.Line, {"rate": -0.1, "maximum_rate": 0.5, "maximum_acceleration": 0.5, "lag": 0.2,
        "minimum_length": 2.0, "maximum_length": 60.0}, with_load, WOUND),
    "tensioned winch": Sample(_core.Line, {"tension": MASS * G, "tension_gain": 2e-6, "dead_band": 1e4},
        with_load, {**WOUND, "lag": 0.2}),
    "drum": Sample(_core.Line, {"drum_inertia": 2e3, "drum_radius": 0.5, "maximum_tension": 4e5,
        "maximum_power": 2e5, "brake_capacity": 5e5, "brake_give": 1e-3}, with_load, {**WOUND, "lag": 0.2,
        "rate": -0.05}),
    "brake": Sample(_core.Line, {"brake": 1.0}, with_load, {**WOUND, "lag": 0.2, "drum_inertia": 2e3,
        "drum_radius": 0.5, "brake_capacity": 5e5}),
    "gas spring": Sample(_core.GasSpring, {**ENDS, "area": 0.05, "pressure": 3.92e6, "volume": 0.2,
        "length": 11.0, "exponent": 1.4, "damping": 1e4, "quadratic_damping": 1e4, "minimum": 9.0,
        "maximum": 12.5, "stop_stiffness": 1e7}, at(-10.0), BETWEEN),
    "hydraulic cylinder": Sample(_core.HydraulicCylinder, {"first_point": (0.0, 0.0, -1.0),
        "second_point": (0.0, 0.0, -1.0), "full_area": AREA, "rod_side_area": 0.6 * AREA,
        "retracted_length": 1.0, "stroke": 1.0, "pressure": 1.1e7, "pressure_rod": 2e6, "hose_volume": 1e-3,
        "hose_volume_rod": 1e-3, "oil_modulus": 1.5e9, "hose_modulus": 1.5e8, "cylinder_modulus": 3.15e10,
        "air": 0.01, "vapour_pressure": 2e3, "pump_pressure": 2e7, "tank_pressure": 1e5, "rated_flow": 2e-3,
        "rated_flow_rod": 2e-3, "rated_drop": 3.5e6, "laminar_drop": 2e5, "overlap": 0.03,
        "spool_lag": 4.5e-3, "makeup_flow": 2e-3, "relief_pressure": 2.5e7, "relief_pressure_rod": 2.5e7,
        "relief_flow": 2e-3, "relief_override": 1e6, "counterbalance_pressure": 2.2e7,
        "counterbalance_pressure_rod": 2.2e7, "counterbalance_flow": 2e-3, "counterbalance_range": 5e6,
        "pilot_ratio": 4.0, "command": 0.1, "reference": 0.5, "gain": 5.0, "rate_gain": 10.0,
        "internal_leakage": 1e-12, "external_leakage": 1e-13, "viscous_friction": 1e4, "friction": 2e3,
        "friction_speed": 0.01, "stop_stiffness": 1e9, "accumulator_volume": 0.02,
        "accumulator_pressure": 8e6, "accumulator_flow": 2e-3, "accumulator_exponent": 1.4,
        "rupture_time": 0.15, "rupture_area": 1e-4, "discharge_coefficient": 0.6, "oil_density": 870.0},
        on_rail, BETWEEN),
    "heave compensator": Sample(_core.HeaveCompensator, {"point": (1.0, 0.0, 0.0), "gain": 0.95, "ratio": 1.0,
        "high_pass": 0.03, "lag": 0.1, "lag_order": 2.0, "actuator_frequency": 2.0, "actuator_damping": 0.7,
        "maximum_rate": 2.0, "maximum_stroke": 3.0, "settling": 0.2, "direction": (0.0, 0.0, 1.0)},
        over_a_boat, {"body": "boat", "winch": "wire"}),
    "wind": Sample(_core.FlowForce, {"point": (1.0, 0.0, 0.0), "density": 1.225, "speed": 12.0,
        "direction": 0.5, "frontal_area": 20.0, "lateral_area": 30.0, "length": 6.0, "coefficients": DRAG},
        partial(on_rail, gravity=False), CIRCLE),
    "current": Sample(_core.FlowForce, {"density": 1025.0, "speed": 1.0}, partial(on_rail, gravity=False),
        {**CIRCLE, "direction": 0.5, "frontal_area": 20.0, "lateral_area": 30.0, "length": 6.0,
        "coefficients": DRAG}),
    "span drag": Sample(_core.SpanDrag, {**ENDS, "density": 1.225, "diameter": 0.05, "length": 11.0,
        "coefficient": 1.2, "flow": (8.0, 0.0, 0.0)}, at(-10.0), BETWEEN),
    "immersed part": Sample(_core.ImmersedPart, {"point": (0.5, 0.0, -0.5), "axes": np.eye(3).tolist(),
        "size": (4.0, 3.0, 2.0), "fill": 0.5, "density": 1025.0, "depths": (0.0, 0.5, 2.0, 4.0),
        "added_masses": MASSES, "drag": (6e3, 8e3, 1.2e4), "place": 1.0, "count": 2.0,
        "step": (4.0, 0.0, 0.0), "wave_factor": 1.2,
        "slow_added_masses": [(0, 0, 0), (1e3, 1e3, 1.8e4), (8e3, 9e3, 3e4), (8e3, 9e3, 4e4)]},
        at_the_surface, {**LOAD, "shape": "box", "row": "strips"}),
    "immersed table": Sample(_core.ImmersedPart, {"size": (4.0, 3.0, 2.0), "depths": (0.0, 0.5, 2.0, 4.0),
        "volumes": (0.0, 4.0, 14.0, 14.0), "added_masses": MASSES}, at_the_surface, {**LOAD, "shape": "table",
        "density": 1025.0}),
    "entrapped water": Sample(_core.EntrappedWater, {"point": (0.3, 0.0, -1.0), "area": 3.0, "height": 2.0,
        "opening_points": [(0.3, 0.0, -1.0)], "opening_areas": [0.1], "exponent": 1.2,
        "air_pressure": 101325.0, "discharge_coefficient": 0.6, "initial": 1.5, "density": 1025.0,
        "wave_factor": 1.2}, beside_a_part, {**LOAD, "air": "shut"}),
    "contact": Sample(_core.Contact, {"points": [(1.0, 0.0, -0.8), (-1.0, 0.0, -0.8)],
        "place": (0.0, 0.0, 4.0), "size": (6.0, 5.0, 0.4), "axes": np.eye(3).tolist(), "edge": 0.05,
        "stiffness": 0.5 * MASS * G / 0.01, "damping": 1.0, "friction": 0.3,
        "shear_stiffness": 150.0 * MASS * G, "shear_damping": 20.0 * MASS, "hold": 1e-3}, at(5.0), {**FEET,
        "surface": "box"}),
    "fender": Sample(_core.Contact, {"compressions": (0.0, 0.1, 0.3),
        "forces": (0.0, 0.2 * MASS * G, MASS * G)}, at(5.0), {**FEET, "points": [(0.0, 0.0, -0.8)]}),
    "immersed span": Sample(_core.ImmersedSpan, {**ENDS, "density": 1025.0, "diameter": 0.05, "length": 11.0,
        "added_mass_coefficient": 1.0, "drag_coefficient": 1.2, "drag_coefficient_along": 0.01}, at(-10.0),
        BETWEEN),
    "wound span": Sample(_core.WoundSpan, {**ENDS, "mass_per_length": 20.0, "length": 11.0,
        "below_first": 1.0, "below_second": 0.5}, at(-10.0), BETWEEN),
    "seabed node": Sample(_core.SeabedNode, {"point": (0.5, 0.0, -0.5), "depth": 10.6, "stiffness": 1e6,
        "damping": 0.5, "friction": 0.5, "load": MASS * 9.81, "give": 0.05, "anchor": (0.6, 0.0, -10.5)},
        at(-10.0), LOAD),
    "pendulum damping": Sample(_core.PendulumDamping, {**ENDS, "ratio": 0.01, "mass": MASS}, on_a_ball,
        BETWEEN),
    "spring": Sample(_core.Spring, {**ENDS, "stiffness": 1e6, "damping": 2e4, "natural_length": 10.8},
        at(-10.0), BETWEEN),
    "spring with a table": Sample(_core.Spring, {"lengths": [9.0, 10.0, 12.0], "forces": [0.0, 2e5, 8e5]},
        at(-10.0), BETWEEN),
    "soft stop": Sample(_core.SoftStop, {"minimum": -1.0, "maximum": 1.0, "stiffness": 1e7, "damping": 0.5},
        on_rail, RAIL),
    "friction": Sample(_core.Friction, {"load": 5e4, "speed": 0.01}, on_rail, RAIL),
    "end stop": Sample(_core.Limit, {"minimum": -1.0, "maximum": 1.0, "restitution": 0.2,
        "sticking_speed": 1e-3}, partial(on_rail, gravity=False), {"joint": "rail", "name": "stop"},
        Scene.add_stop),
    "point force": Sample(_core.PointForce, {"point": (1.0, 0.0, 0.0), "force": (0.0, 0.0, 2e5)},
        at(-15.0, gravity=False), LOAD),
    "force table": Sample(_core.ForceTable, {"point": (1.0, 0.0, 0.0), "times": [0.0, 1.0, 2.0],
        "wrenches": [[0.0] * 6, [2e5] * 6, [0.0] * 6]}, at(-15.0, gravity=False), LOAD),
    "actuator": Sample(_core.Actuator, {"stiffness": 1e6, "damping": 2e5, "feed_forward": MASS * G,
        "reference": 0.1}, on_rail, {"joint": "rail"}, Scene.add_actuator),
    "driver": Sample(_core.Driver, {"curve": swing(0.5)}, on_rail, {"joint": "rail"}, Scene.add_driver),
    "driver of an angle": Sample(_core.Driver, {"curve": swing(0.3)}, partial(on_rail, "revolute"),
        {"joint": "rail"}, Scene.add_driver),
    "body": Sample(_core.Body, {"mass": MASS, "inertia": INERTIA, "position": (0.0, 0.0, -15.0),
        "center_of_mass": (0.0, 0.0, -1.0), "velocity": (0.2, 0.0, 0.0), "angular_velocity": (0.0, 0.0, 0.2),
        "size": (2.0, 2.0, 3.0)}, partial(Scene, name="sample"), {}, weighed),
    "link": Sample(_core.Joint, {"length": 8.0, "first point": (0.0, 0.0, 1.0),
        "second point": (0.0, 0.0, 3.0)}, at(-10.0), {}, linked),
    "vessel": Sample(_core.VesselHydrodynamics, {"added_mass": np.diag([5e5, 6e6, 1e7, 3e8, 6e9, 4e9]),
        "linear_damping": np.diag([1e4, 1e5, 5e6, 1e8, 4e9, 1e8]),
        "quadratic_damping": [1e4, 1e5, 1e5, 1e9, 1e10, 1e10],
        "restoring": np.diag([0, 0, 2e7, 4e8, 1.2e10, 0]), "mooring_stiffness": [1e4, 1.6e4, 1e7],
        "mooring_damping": [5e4, 1e5, 1e8]}, a_ship, {"body": "ship"}, Scene.add_vessel),
    "point": Sample(_core.Point, {"point": (1.0, 0.0, 0.5)}, with_load, {**LOAD, "name": "mark"},
        Scene.add_point),
}  # fmt: skip
