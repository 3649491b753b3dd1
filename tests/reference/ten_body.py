"""Records of a ten-body knuckle-boom crane on a vessel with two cylinder loops and a payload.

The topology is the paper's; masses follow its list, the geometry is this file's own (any plausible one
serves). The crane stands at (33, 10, 10) m from the vessel's reference point, jibs pointing aft at the start.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from .rotation import Array

BASE = np.array([33.0, 10.0, 10.0])
AFT = np.array([-1.0, 0.0, 0.0])
UP = np.array([0.0, 0.0, 1.0])
PIVOT_AXIS = [0.0, 1.0, 0.0]
MAIN_ANGLE, KNUCKLE_ANGLE = math.radians(18.0), math.radians(-70.0)
MAIN_LENGTH, KNUCKLE_LENGTH, LINK = 23.0, 14.5, 8.0


def direction(angle: float) -> Array:
    """Unit vector at an elevation angle in the crane's plane."""
    return np.asarray(math.cos(angle) * AFT + math.sin(angle) * UP)


def normal(angle: float) -> Array:
    """Unit vector a quarter turn above `direction`."""
    return direction(angle + 0.5 * math.pi)


def rod_inertia(mass: float, length: float, radius: float, along: Array) -> list[list[float]]:
    """Solid cylinder about its centre, its axis along a unit vector."""
    across, axial = mass * (length**2 / 12.0 + radius**2 / 4.0), 0.5 * mass * radius**2
    tensor = across * np.eye(3) + (axial - across) * np.outer(along, along)
    return [[float(value) for value in row] for row in tensor]


def body(name: str, mass: float, start: Array, end: Array, radius: float) -> dict[str, Any]:
    """Cylinder between two points, body axes parallel to the inertial ones at the start."""
    length = float(np.linalg.norm(end - start))
    return {
        "name": name,
        "mass": mass,
        "inertia": rod_inertia(mass, length, radius, (end - start) / length),
        "position": (0.5 * (start + end)).tolist(),
        "quaternion": [1.0, 0.0, 0.0, 0.0],
    }


def points() -> dict[str, Array]:
    """Joint points A to G, the tip, and the slew axis at the start, inertial frame."""
    a = BASE + 8.0 * UP
    c = BASE + 17.0 * UP + 1.0 * AFT
    main, knuckle = direction(MAIN_ANGLE), direction(KNUCKLE_ANGLE)
    f = c + MAIN_LENGTH * main
    return {
        "deck": BASE,
        "A": a,
        "B": BASE + 9.0 * UP + 2.5 * AFT,
        "C": c,
        "D": c + 10.0 * main - 1.0 * normal(MAIN_ANGLE),
        "E": c + 13.0 * main - 1.5 * normal(MAIN_ANGLE),
        "F": f,
        "G": f + 3.5 * knuckle - 2.0 * normal(KNUCKLE_ANGLE),
        "tip": f + KNUCKLE_LENGTH * knuckle,
    }


def crane_bodies(p: dict[str, Array]) -> list[dict[str, Any]]:
    """Bodies 1 to 8."""
    out = [
        body("tower", 100e3, p["deck"], p["A"], 2.2),
        body("king", 115e3, p["A"], BASE + 17.0 * UP, 2.0),
    ]
    for name, low, high, mass in (("main", "B", "D", 24e3), ("knuckle", "E", "G", 22e3)):
        along = p[high] - p[low]
        out.append(body(f"{name}_barrel", 0.6 * mass, p[low], p[low] + 0.6 * along, 0.45))
        out.append(body(f"{name}_rod", 0.4 * mass, p[low] + 0.4 * along, p[high], 0.3))
    out.insert(4, body("main_jib", 79e3, p["C"], p["F"], 1.1))
    out.append(body("knuckle_jib", 50e3, p["F"], p["tip"], 0.9))
    return out


def crane_joints(p: dict[str, Array], base: str | None) -> list[dict[str, Any]]:
    """Weld, A to G and the two cylinders; `base` is the body under the tower (None: the ground)."""

    def joint(kind: str, name: str, first: str | None, second: str, at: str, **more: Any) -> dict[str, Any]:
        point = {"point": p[at].tolist()}
        return {"kind": kind, "name": name, "first": first, "second": second, **point, **more}

    out = [
        joint("weld", "deck", base, "tower", "deck"),
        joint("revolute", "A", "tower", "king", "A", axis=[0.0, 0.0, 1.0]),
        joint("revolute", "C", "king", "main_jib", "C", axis=PIVOT_AXIS),
        joint("revolute", "F", "main_jib", "knuckle_jib", "F", axis=PIVOT_AXIS),
    ]
    for name, carrier, load, low, high in (
        ("main", "king", "main_jib", "B", "D"),
        ("knuckle", "main_jib", "knuckle_jib", "E", "G"),
    ):
        along = (p[high] - p[low]) / np.linalg.norm(p[high] - p[low])
        across = np.cross(PIVOT_AXIS, along)
        out += [
            joint(
                "universal", low, carrier, f"{name}_barrel", low, axis=PIVOT_AXIS, second_axis=across.tolist()
            ),
            joint("spherical", high, f"{name}_rod", load, high),
            joint("prismatic", f"{name}_cylinder", f"{name}_barrel", f"{name}_rod", low, axis=along.tolist()),
        ]
    return out


def payload_records(p: dict[str, Array]) -> tuple[dict[str, Any], dict[str, Any]]:
    """Box 6 x 6 x 4 m of 10 t and the link to the centroid of its top."""
    top = p["tip"] - LINK * UP
    box = {
        "name": "payload",
        "mass": 10e3,
        "inertia": np.diag([10e3 / 12 * 52.0, 10e3 / 12 * 52.0, 10e3 / 12 * 72.0]).tolist(),
        "position": (top - 2.0 * UP).tolist(),
        "quaternion": [1.0, 0.0, 0.0, 0.0],
    }
    link = {
        "kind": "distance",
        "name": "link",
        "first": "knuckle_jib",
        "second": "payload",
        "point": p["tip"].tolist(),
        "second_point": top.tolist(),
    }
    return box, link


def vessel_records() -> tuple[dict[str, Any], dict[str, Any]]:
    """Hull body and its hydrodynamics: round numbers of the paper's vessel, reference point at the origin."""
    mass, g, gm_t, gm_l, z_g = 14e6, 9.81, 3.0, 150.0, 1.0
    hull = {
        "name": "vessel",
        "mass": mass,
        "inertia": (mass * np.diag([9.0, 28.75, 28.75]) ** 2).tolist(),
        "position": [0.0, 0.0, z_g],
        "quaternion": [1.0, 0.0, 0.0, 0.0],
    }
    added = np.diag([0.06, 0.6, 1.0, 0.0, 0.0, 0.0]) * mass
    added[3, 3], added[4, 4], added[5, 5] = 2.5e8, 1.1e10, 7e9
    added[1, 3] = added[3, 1] = 1.5e7
    added[1, 5] = added[5, 1] = 3e7
    added[2, 4] = added[4, 2] = 8e7
    restoring = np.zeros((6, 6))
    restoring[2, 2], restoring[3, 3], restoring[4, 4] = 2.4e7, mass * g * gm_t, mass * g * gm_l
    restoring[2, 4] = restoring[4, 2] = -6e7
    damping = np.diag([1e4, 1e5, 0.0, 0.1 * math.sqrt(restoring[3, 3] * (mass * 81.0 + 2.5e8)), 0.0, 1e8])
    rate = 2.0 * math.pi / 200.0
    inertia = np.array([mass * 1.06, mass * 1.6, mass * 28.75**2 + 7e9])
    vessel = {
        "body": "vessel",
        "reference_point": [0.0, 0.0, 0.0],
        "added_mass": added.tolist(),
        "damping": damping.tolist(),
        "restoring": restoring.tolist(),
        "quadratic_roll_damping": 1e8,
        "station_keeping": {
            "stiffness": (inertia * rate**2).tolist(),
            "damping": (0.2 * inertia * rate).tolist(),
        },
        "memory": memory_record(),
        "waves": wave_record(),
    }
    return hull, vessel


def memory_record() -> dict[str, Any]:
    """Passive pairs of states K(t) = k exp(-a t) (cos b t - (a/b) sin b t), whose damping is never
    negative.
    """
    blocks = []
    decay, frequency = 0.35, 0.9
    a = np.array([[-decay, frequency], [-frequency, -decay]])
    for motion, strength in ((1, 4e6), (2, 7e6), (3, 8e7), (4, 5e9), (5, 2e9)):
        c = strength * np.array([1.0, -decay / frequency])
        blocks.append(
            {"inputs": [motion], "outputs": [motion], "A": a.tolist(), "B": [[1.0], [0.0]], "C": [c.tolist()]}
        )
    return {"blocks": blocks}


def wave_record(count: int = 40, seed: int = 7) -> dict[str, Any]:
    """A sea of `count` components with smooth made-up force amplitudes; phases from a fixed seed."""
    omega = np.linspace(0.3, 2.0, count) + 0.01 * np.sin(np.arange(count) * 1.7)
    phase = np.random.default_rng(seed).uniform(0.0, 2.0 * np.pi, count)
    shape = 0.25 * np.exp(-(((omega - 0.8) / 0.3) ** 2)) * np.exp(1j * phase)
    scale = np.array([4e5, 2e6, 6e6, 4e6, 1.5e8, 5e7]) * np.exp(1j * np.array([1.6, 1.5, 0.0, 1.4, 1.7, 0.3]))
    force = shape[:, None] * scale * np.exp(-omega[:, None])
    return {"omega": omega.tolist(), "force_real": force.real.tolist(), "force_imag": force.imag.tolist()}


def records(*, payload: bool = True, vessel: bool = True, case: int | None = None) -> dict[str, Any]:
    """Scene without actuators; with a case number (1 to 3), balanced and controlled as the paper
    describes.
    """
    p = points()
    bodies, joints = crane_bodies(p), crane_joints(p, "vessel" if vessel else None)
    out: dict[str, Any] = {"gravity": [0.0, 0.0, -9.81]}
    if vessel:
        hull, hydrodynamics = vessel_records()
        bodies.insert(0, hull)
        out["vessel"] = hydrodynamics
    if payload:
        box, link = payload_records(p)
        bodies.append(box)
        joints.append(link)
    out |= {"bodies": bodies, "joints": joints}
    return out if case is None else controlled(out, case)


def balance(scene: dict[str, Any]) -> dict[str, float]:
    """Driver loads that hold the scene at rest: slew torque, cylinder forces and the six of a vessel."""
    from .system import System

    names: list[tuple[str, str | None]] = [("A", None), ("main_cylinder", None), ("knuckle_cylinder", None)]
    held = dict(scene)
    if "vessel" in scene:
        free = {"kind": "free", "name": "sea", "first": None, "second": "vessel", "point": [0.0, 0.0, 0.0]}
        held["joints"] = [*scene["joints"], free]
        names += [("sea", m) for m in ("surge", "sway", "heave", "roll", "pitch", "yaw")]
        held["vessel"] = {k: v for k, v in scene["vessel"].items() if k != "waves"}
    held["drivers"] = [{"joint": j, "motion": m, "reference": 0.0} for j, m in names]
    system = System.from_records(held)
    e = system.evaluate(0.0, system.start, np.zeros(system.memory_states))
    return dict(zip(system.driver_names, system.driver_loads(e).tolist(), strict=True))


def controlled(scene: dict[str, Any], case: int) -> dict[str, Any]:
    """Add balancing loads and state feedback; the gains are round numbers, not the engine's rule."""
    loads = balance(scene)
    out = dict(scene)
    if "vessel" in scene:
        lift = loads["sea.heave"]
        # a vertical force at (x, y, 0) has the moment (y, -x) lift about the reference point
        point = [-loads["sea.pitch"] / lift, loads["sea.roll"] / lift, 0.0]
        out["point_forces"] = [{"body": "vessel", "point": point, "force": [0.0, 0.0, lift]}]
    moving = {"kind": "quintic", "start": 0.0, "t_start": 0.0, "t_end": 45.0}
    slew = {**moving, "end": -0.5 * math.pi}
    stroke: dict[str, Any] = {**moving, "end": 4.0 if case == 3 else 2.0}
    if case == 3:
        oscillation = {"kind": "cosine", "mean": 3.0, "amplitude": 1.0, "period": 5.0}
        stroke = {"kind": "sequence", "switch": [50.0], "pieces": [stroke, oscillation]}
    natural, ratio = 2.0 * math.pi * 0.8, 0.8
    out["actuators"] = [
        {
            "joint": name,
            "stiffness": inertia * natural**2,
            "damping": 2.0 * ratio * inertia * natural,
            "feedforward": loads[name],
            "reference": curve,
        }
        for name, inertia, curve in (
            ("A", 9e7, slew),
            ("main_cylinder", 3e6, stroke),
            ("knuckle_cylinder", 1.2e6, stroke),
        )
    ]
    return out
