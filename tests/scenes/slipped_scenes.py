"""A plausible scene for each kind of element, in which any one of its numbers may be replaced."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from seacrane import Curve, Scene, _core
from seacrane.description.forces import add_load
from seacrane.description.waves import Waves
from seacrane.water import BoxPart

MASS, G = 2e4, 9.80665
INERTIA = np.diag([3e4, 3e4, 3e4])


@dataclass(frozen=True, kw_only=True)
class Sample:
    """An element with its numbers, and the scene around it."""

    kind: type
    numbers: Mapping[str, Any]
    scene: Callable[[Mapping[str, Any]], Scene]

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


def at_the_surface() -> Scene:
    """A load on a wire with its middle in the surface of a sea of one wave."""
    scene = with_load((0.0, 0.0, 0.0))
    one = np.ones(1)
    scene.waves = Waves(omega=one, amplitude=0.3 * one, phase=0.0 * one, direction=0.0 * one, hulls={})
    scene.add_line(name="wire", bodies=["ground", "load"], points=[(0, 0, 20), (0, 0, 1)], EA=5e7,
                   tension_at_start=0.5 * MASS * G)  # fmt: skip
    return scene


def immersed(**numbers: Any) -> Scene:
    scene = at_the_surface()
    add_load(scene, _core.ImmersedPart(name="part", body="load", **numbers))
    return scene


def filled(**numbers: Any) -> Scene:
    scene = at_the_surface()
    scene.add_immersed("load", parts=[BoxPart(size=(2.0, 1.6, 2.0), point=(0.3, 0.0, 0.0))])
    add_load(scene, _core.EntrappedWater(name="water", body="load", air="shut", **numbers))
    return scene


def on_feet(numbers: Mapping[str, Any], **more: Any) -> Scene:
    """A load just above the top of a box of the ground that is 4 m over its origin."""
    scene = with_load((0.0, 0.0, 5.0))
    rest = {"stiffness": 0.5 * MASS * G / 0.01, "place": (0.0, 0.0, 4.0)}
    add_load(scene, _core.Contact(name="feet", body="load", on="ground", **{**rest, **more, **numbers}))
    return scene


def on_a_seabed(**numbers: Any) -> Scene:
    scene = with_load((0.0, 0.0, -10.0))
    add_load(scene, _core.SeabedNode(name="bed", body="load", **numbers))
    return scene


def hung(numbers: Mapping[str, Any], **more: Any) -> Scene:
    scene = with_load()
    add_load(scene, _core.Line(name="wire", bodies=["ground", "load"], **{**more, **numbers}))
    return scene


def over_a_sheave(numbers: Mapping[str, Any]) -> Scene:
    scene = with_load((0.0, 0.0, -15.0))
    line = {
        "points": [(0, -20, 0), (0, 0, 0), (0, 0.5, 1)],
        "EA": 5e7,
        "axes": [(0, 0, 0), (-1, 0, 0), (0, 0, 0)],
    }
    scene.add_line(
        name="wire", bodies=["ground", "ground", "load"], tension_at_start=MASS * G, **line, **numbers
    )
    return scene


def on_rail(kind: str = "prismatic", **body: Any) -> Scene:
    scene = with_load((0.0, 0.0, 1.5), **body)
    axis = {"axis": (0, 0, 1)} if kind == "prismatic" else {"axis": (0, 1, 0)}
    scene.add_joint(kind=kind, name="rail", first="ground", second="load", **axis)
    return scene


def held_by(kind: type, numbers: Mapping[str, Any], **more: Any) -> Scene:
    scene = on_rail()
    add_load(scene, kind(name="held", **more, **numbers))
    return scene


def limited(numbers: Mapping[str, Any]) -> Scene:
    scene = on_rail(gravity=False)
    scene.add_end_stop(joint="rail", name="stop", **numbers)
    return scene


def compensated(numbers: Mapping[str, Any]) -> Scene:
    scene = hung(
        {
            "points": np.zeros((2, 3)),
            "EA": 5e7,
            "length": 15.0 / (1 + MASS * G / 5e7),
            "winch": True,
            "lag": 0.2,
        }
    )
    scene.add_body(name="boat", mass=1e5, inertia=np.diag([1e6] * 3), gravity=False)
    add_load(scene, _core.HeaveCompensator(name="ahc", body="boat", winch="wire", **numbers))
    return scene


def blown(numbers: Mapping[str, Any]) -> Scene:
    scene = on_rail(gravity=False)
    circle, drag = np.linspace(0.0, 1.5 * np.pi, 4), [(1, 0, 0), (0, 0.8, 0), (-1, 0, 0), (0, -0.8, 0)]
    add_load(
        scene,
        _core.FlowForce(name="wind", body="load", angles=circle, **{"coefficients": drag} | dict(numbers)),
    )
    return scene


def between(kind: type, numbers: Mapping[str, Any], **more: Any) -> Scene:
    scene = with_load((0.0, 0.0, -10.0))
    add_load(scene, kind(name="one", first="ground", second="load", **more, **numbers))
    return scene


def sprung(numbers: Mapping[str, Any]) -> Scene:
    scene = with_load((0.0, 0.0, -10.0))
    scene.add_spring(name="one", first="ground", second="load", **numbers)
    return scene


def swinging(numbers: Mapping[str, Any]) -> Scene:
    scene = with_load((0.0, 0.0, -10.0))
    scene.add_joint(kind="spherical", name="hook", first="ground", second="load")
    add_load(scene, _core.PendulumDamping(name="one", first="ground", second="load", **numbers))
    return scene


def actuated(numbers: Mapping[str, Any]) -> Scene:
    scene = on_rail()
    scene.add_actuator(joint="rail", **numbers)
    return scene


def driven(numbers: Mapping[str, Any]) -> Scene:
    scene = on_rail()
    scene.add_driver(joint="rail", **numbers)
    return scene


def turned(numbers: Mapping[str, Any]) -> Scene:
    scene = on_rail("revolute")
    scene.add_driver(joint="rail", **numbers)
    return scene


def pushed(numbers: Mapping[str, Any]) -> Scene:
    scene = with_load(gravity=False)
    scene.add_point_force(name="pull", body="load", **numbers)
    return scene


def tabled(numbers: Mapping[str, Any]) -> Scene:
    scene = with_load(gravity=False)
    scene.add_force_table(
        name="pull", body="load", **{"loads" if k == "wrenches" else k: v for k, v in numbers.items()}
    )
    return scene


def weighed(numbers: Mapping[str, Any]) -> Scene:
    scene = Scene(name="sample")
    scene.add_body(name="load", **numbers)
    scene.add_line(name="wire", bodies=["ground", "load"], points=np.zeros((2, 3)), EA=5e7, length=15.0)
    return scene


def linked(numbers: Mapping[str, Any]) -> Scene:
    scene = with_load((0.0, 0.0, -10.0))
    frames = {
        f"{end}_frame": _core.Frame(point=numbers[f"{end} point"], axes=np.eye(3))
        for end in ("first", "second")
    }
    scene.add_joint(
        kind="distance", name="link", first="ground", second="load", length=numbers["length"], **frames
    )
    return scene


def afloat(numbers: Mapping[str, Any]) -> Scene:
    scene = Scene(name="sample")
    scene.add_body(name="ship", mass=1e7, inertia=np.diag([1e9, 8e9, 8e9]))
    scene.add_vessel(body="ship", **numbers)
    return scene


def marked(numbers: Mapping[str, Any]) -> Scene:
    scene = with_load(gravity=False)
    scene.add_point(name="mark", body="load", **numbers)
    return scene


def raised(numbers: Mapping[str, Any]) -> Scene:
    return held_by(_core.HydraulicCylinder, numbers, first="ground", second="load")


AREA = 0.02
WIRE = {
    "points": [(0.5, 0.0, 0.0), (0.5, 0.0, 1.0)],
    "EA": 5e7,
    "length": 14.0 / (1.0 + MASS * G / 5e7),
}
SAMPLES: Mapping[str, Sample] = {
    "line": Sample(kind=_core.Line, numbers={**WIRE, "damping_ratio": 0.02, "mass": MASS}, scene=hung),
    "quasi-static line": Sample(
        kind=_core.Line, numbers={"settling": 0.2}, scene=lambda n: hung(n, **WIRE, rung="quasi-static")
    ),
    "cord": Sample(
        kind=_core.Line,
        numbers={"strains": [0.0, 0.15, 0.3], "tensions": [0.0, 1e5, 4e5]},
        scene=lambda n: hung(n, **{**WIRE, "EA": 4e5 / 0.3, "length": 11.5}),
    ),
    "sheaved line": Sample(
        kind=_core.Line,
        numbers={"radii": [0.0, 0.5, 0.0], "efficiencies": [1.0, 0.98, 1.0], "slip_speed": 0.01},
        scene=over_a_sheave,
    ),
    "rubbing line": Sample(
        kind=_core.Line,
        numbers={"frictions": [0.0, 0.1, 0.0]},
        scene=lambda n: over_a_sheave({"radii": [0.0, 0.5, 0.0], **n}),
    ),
    "winch": Sample(
        kind=_core.Line,
        numbers={
            "rate": -0.1, "maximum_rate": 0.5, "maximum_acceleration": 0.5, "lag": 0.2, "minimum_length": 2.0,
        },
        scene=lambda n: hung(n, **WIRE, winch=True),
    ),
    "tensioned winch": Sample(
        kind=_core.Line,
        numbers={"tension": MASS * G, "tension_gain": 2e-6, "dead_band": 1e4},
        scene=lambda n: hung(n, **WIRE, winch=True, lag=0.2),
    ),
    "drum": Sample(
        kind=_core.Line,
        numbers={
            "drum_inertia": 2e3, "drum_radius": 0.5, "maximum_tension": 4e5, "maximum_power": 2e5,
            "brake_capacity": 5e5, "brake_give": 1e-3,
        },
        scene=lambda n: hung(n, **WIRE, winch=True, lag=0.2, rate=-0.05),
    ),
    "brake": Sample(
        kind=_core.Line,
        numbers={"brake": 1.0},
        scene=lambda n: hung(
            n, **WIRE, winch=True, lag=0.2, drum_inertia=2e3, drum_radius=0.5, brake_capacity=5e5
        ),
    ),
    "gas spring": Sample(
        kind=_core.GasSpring,
        numbers={
            "first_point": (0.0, 0.0, 2.0), "second_point": (0.0, 0.0, 1.0), "area": 0.05, "pressure": 3.92e6,
            "volume": 0.2, "length": 11.0, "exponent": 1.4, "damping": 1e4, "quadratic_damping": 1e4,
            "minimum": 9.0, "maximum": 12.5, "stop_stiffness": 1e7,
        },
        scene=lambda n: between(_core.GasSpring, n),
    ),
    "hydraulic cylinder": Sample(
        kind=_core.HydraulicCylinder,
        numbers={
            "first_point": (0.0, 0.0, -1.0), "second_point": (0.0, 0.0, -1.0), "full_area": AREA,
            "rod_side_area": 0.6 * AREA, "retracted_length": 1.0, "stroke": 1.0, "pressure": 1.1e7,
            "pressure_rod": 2e6, "hose_volume": 1e-3, "hose_volume_rod": 1e-3, "oil_modulus": 1.5e9,
            "hose_modulus": 1.5e8, "cylinder_modulus": 3.15e10, "air": 0.01, "vapour_pressure": 2e3,
            "pump_pressure": 2e7, "tank_pressure": 1e5, "rated_flow": 2e-3, "rated_flow_rod": 2e-3,
            "rated_drop": 3.5e6, "laminar_drop": 2e5, "overlap": 0.03, "spool_lag": 4.5e-3,
            "makeup_flow": 2e-3, "relief_pressure": 2.5e7, "relief_pressure_rod": 2.5e7, "relief_flow": 2e-3,
            "relief_override": 1e6, "counterbalance_pressure": 2.2e7, "counterbalance_pressure_rod": 2.2e7,
            "counterbalance_flow": 2e-3, "counterbalance_range": 5e6, "pilot_ratio": 4.0, "command": 0.1,
            "reference": 0.5, "gain": 5.0, "rate_gain": 10.0, "internal_leakage": 1e-12,
            "external_leakage": 1e-13, "viscous_friction": 1e4, "friction": 2e3, "friction_speed": 0.01,
            "stop_stiffness": 1e9, "accumulator_volume": 0.02, "accumulator_pressure": 8e6,
            "accumulator_flow": 2e-3, "accumulator_exponent": 1.4, "rupture_time": 0.15, "rupture_area": 1e-4,
            "discharge_coefficient": 0.6, "oil_density": 870.0,
        },
        scene=raised,
    ),
    "heave compensator": Sample(
        kind=_core.HeaveCompensator,
        numbers={
            "point": (1.0, 0.0, 0.0), "gain": 0.95, "ratio": 1.0, "high_pass": 0.03, "lag": 0.1,
            "lag_order": 2.0, "actuator_frequency": 2.0, "actuator_damping": 0.7, "maximum_rate": 2.0,
            "maximum_stroke": 3.0, "settling": 0.2, "direction": (0.0, 0.0, 1.0),
        },
        scene=compensated,
    ),
    "wind": Sample(
        kind=_core.FlowForce,
        numbers={
            "point": (1.0, 0.0, 0.0), "density": 1.225, "speed": 12.0, "direction": 0.5, "frontal_area": 20.0,
            "lateral_area": 30.0, "length": 6.0,
            "coefficients": [(1, 0, 0), (0, 0.8, 0), (-1, 0, 0), (0, -0.8, 0)],
        },
        scene=blown,
    ),
    "current": Sample(
        kind=_core.FlowForce,
        numbers={"density": 1025.0, "speed": 1.0},
        scene=lambda n: blown(
            {"direction": 0.5, "frontal_area": 20.0, "lateral_area": 30.0, "length": 6.0, **n}
        ),
    ),
    "span drag": Sample(
        kind=_core.SpanDrag,
        numbers={
            "first_point": (0.0, 0.0, 2.0), "second_point": (0.0, 0.0, 1.0), "density": 1.225,
            "diameter": 0.05, "length": 11.0, "coefficient": 1.2, "flow": (8.0, 0.0, 0.0),
        },
        scene=lambda n: between(_core.SpanDrag, n),
    ),
    "immersed part": Sample(
        kind=_core.ImmersedPart,
        numbers={
            "point": (0.5, 0.0, -0.5), "axes": np.eye(3).tolist(), "size": (4.0, 3.0, 2.0), "fill": 0.5,
            "density": 1025.0, "depths": (0.0, 0.5, 2.0, 4.0),
            "added_masses": [(0, 0, 0), (1e3, 1e3, 1e4), (8e3, 9e3, 2e4), (8e3, 9e3, 4e4)],
            "drag": (6e3, 8e3, 1.2e4), "place": 1.0, "count": 2.0, "step": (4.0, 0.0, 0.0),
            "wave_factor": 1.2,
            "slow_added_masses": [(0, 0, 0), (1e3, 1e3, 1.8e4), (8e3, 9e3, 3e4), (8e3, 9e3, 4e4)],
        },
        scene=lambda n: immersed(shape="box", row="strips", **n),
    ),
    "immersed table": Sample(
        kind=_core.ImmersedPart,
        numbers={
            "size": (4.0, 3.0, 2.0), "depths": (0.0, 0.5, 2.0, 4.0), "volumes": (0.0, 4.0, 14.0, 14.0),
            "added_masses": [(0, 0, 0), (1e3, 1e3, 1e4), (8e3, 9e3, 2e4), (8e3, 9e3, 4e4)],
        },
        scene=lambda n: immersed(shape="table", density=1025.0, **n),
    ),
    "entrapped water": Sample(
        kind=_core.EntrappedWater,
        numbers={
            "point": (0.3, 0.0, -1.0), "area": 3.0, "height": 2.0, "opening_points": [(0.3, 0.0, -1.0)],
            "opening_areas": [0.1], "exponent": 1.2, "air_pressure": 101325.0, "discharge_coefficient": 0.6,
            "initial": 1.5, "density": 1025.0, "wave_factor": 1.2,
        },
        scene=lambda n: filled(**n),
    ),
    "contact": Sample(
        kind=_core.Contact,
        numbers={
            "points": [(1.0, 0.0, -0.8), (-1.0, 0.0, -0.8)], "place": (0.0, 0.0, 4.0),
            "size": (6.0, 5.0, 0.4), "axes": np.eye(3).tolist(), "edge": 0.05,
            "stiffness": 0.5 * MASS * G / 0.01, "damping": 1.0, "friction": 0.3,
            "shear_stiffness": 150.0 * MASS * G, "shear_damping": 20.0 * MASS, "hold": 1e-3,
        },
        scene=lambda n: on_feet(n, surface="box"),
    ),
    "fender": Sample(
        kind=_core.Contact,
        numbers={"compressions": (0.0, 0.1, 0.3), "forces": (0.0, 0.2 * MASS * G, MASS * G)},
        scene=lambda n: on_feet(n, points=[(0.0, 0.0, -0.8)]),
    ),
    "immersed span": Sample(
        kind=_core.ImmersedSpan,
        numbers={
            "first_point": (0.0, 0.0, 2.0), "second_point": (0.0, 0.0, 1.0), "density": 1025.0,
            "diameter": 0.05, "length": 11.0, "added_mass_coefficient": 1.0, "drag_coefficient": 1.2,
            "drag_coefficient_along": 0.01,
        },
        scene=lambda n: between(_core.ImmersedSpan, n),
    ),
    "wound span": Sample(
        kind=_core.WoundSpan,
        numbers={
            "first_point": (0.0, 0.0, 2.0), "second_point": (0.0, 0.0, 1.0), "mass_per_length": 20.0,
            "length": 11.0, "below_first": 1.0, "below_second": 0.5,
        },
        scene=lambda n: between(_core.WoundSpan, n),
    ),
    "seabed node": Sample(
        kind=_core.SeabedNode,
        numbers={
            "point": (0.5, 0.0, -0.5), "depth": 10.6, "stiffness": 1e6, "damping": 0.5, "friction": 0.5,
            "load": MASS * 9.81, "give": 0.05, "anchor": (0.6, 0.0, -10.5),
        },
        scene=lambda n: on_a_seabed(**n),
    ),
    "pendulum damping": Sample(
        kind=_core.PendulumDamping,
        numbers={
            "first_point": (0.0, 0.0, 2.0), "second_point": (0.0, 0.0, 1.0), "ratio": 0.01, "mass": MASS,
        },
        scene=swinging,
    ),
    "spring": Sample(
        kind=_core.Spring,
        numbers={
            "first_point": (0.0, 0.0, 2.0), "second_point": (0.0, 0.0, 1.0), "stiffness": 1e6, "damping": 2e4,
            "natural_length": 10.8,
        },
        scene=sprung,
    ),
    "spring with a table": Sample(
        kind=_core.Spring,
        numbers={"lengths": [9.0, 10.0, 12.0], "forces": [0.0, 2e5, 8e5]},
        scene=sprung,
    ),
    "soft stop": Sample(
        kind=_core.SoftStop,
        numbers={"minimum": -1.0, "maximum": 1.0, "stiffness": 1e7, "damping": 0.5},
        scene=lambda n: held_by(_core.SoftStop, n, joint="rail", coordinate="displacement"),
    ),
    "friction": Sample(
        kind=_core.Friction,
        numbers={"load": 5e4, "speed": 0.01},
        scene=lambda n: held_by(_core.Friction, n, joint="rail", coordinate="displacement"),
    ),
    "end stop": Sample(
        kind=_core.Limit,
        numbers={"minimum": -1.0, "maximum": 1.0, "restitution": 0.2, "sticking_speed": 1e-3},
        scene=limited,
    ),
    "point force": Sample(
        kind=_core.PointForce, numbers={"point": (1.0, 0.0, 0.0), "force": (0.0, 0.0, 2e5)}, scene=pushed
    ),
    "force table": Sample(
        kind=_core.ForceTable,
        numbers={
            "point": (1.0, 0.0, 0.0), "times": [0.0, 1.0, 2.0], "wrenches": [[0.0] * 6, [2e5] * 6, [0.0] * 6],
        },
        scene=tabled,
    ),
    "actuator": Sample(
        kind=_core.Actuator,
        numbers={"stiffness": 1e6, "damping": 2e5, "feed_forward": MASS * G, "reference": 0.1},
        scene=actuated,
    ),
    "driver": Sample(
        kind=_core.Driver,
        numbers={"curve": swing(0.5)},
        scene=driven,
    ),
    "driver of an angle": Sample(
        kind=_core.Driver,
        numbers={"curve": swing(0.3)},
        scene=turned,
    ),
    "body": Sample(
        kind=_core.Body,
        numbers={
            "mass": MASS, "inertia": INERTIA, "position": (0.0, 0.0, -15.0),
            "center_of_mass": (0.0, 0.0, -1.0), "velocity": (0.2, 0.0, 0.0),
            "angular_velocity": (0.0, 0.0, 0.2), "size": (2.0, 2.0, 3.0),
        },
        scene=weighed,
    ),
    "link": Sample(
        kind=_core.Joint,
        numbers={"length": 8.0, "first point": (0.0, 0.0, 1.0), "second point": (0.0, 0.0, 3.0)},
        scene=linked,
    ),
    "vessel": Sample(
        kind=_core.VesselHydrodynamics,
        numbers={
            "added_mass": np.diag([5e5, 6e6, 1e7, 3e8, 6e9, 4e9]),
            "linear_damping": np.diag([1e4, 1e5, 5e6, 1e8, 4e9, 1e8]),
            "quadratic_damping": [1e4, 1e5, 1e5, 1e9, 1e10, 1e10],
            "restoring": np.diag([0, 0, 2e7, 4e8, 1.2e10, 0]),
            "mooring_stiffness": [1e4, 1.6e4, 1e7], "mooring_damping": [5e4, 1e5, 1e8],
        },
        scene=afloat,
    ),
    "point": Sample(kind=_core.Point, numbers={"point": (1.0, 0.0, 0.5)}, scene=marked),
}  # fmt: skip
