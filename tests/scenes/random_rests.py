"""Random scenes whose rest is looked for: lines, winches, taglines, oil, ships and their ballast."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from hydraulic_scenes import OF_CRANE, OIL, PARTS

from seacrane import Scene
from seacrane.arrays import Array
from seacrane.scene import Chamber, Counterbalance, Piston, Tank

G = 9.80665
SHIP = "vessel"
AHEAD = np.array([1.0, 0.0, 0.0])


class Builder:
    """One scene from a seed."""

    def __init__(self, seed: int) -> None:
        self.rng = np.random.default_rng(seed)
        self.scene, self.base = Scene(name=f"rest {seed}"), "ground"
        self.moored = True
        if self.chance(0.5):
            self.add_ship()
        self.tip, self.head = self.holder()
        self.hang()
        if self.chance(0.5):
            self.tug()
        if self.chance(0.3):
            self.hang_below()
        if self.chance(0.3) and self.moored:  # a steady force on the load, as of wind
            push = self.scene.bodies["load"].mass * G * self.between(0.0, 0.05)
            force = push * np.array([np.cos(1.0), np.sin(1.0), 0.0])
            self.scene.add_force("load", name="gust", point=(0, 0, 0.2), force=force)
        if self.base == SHIP:
            self.ballast()

    def chance(self, share: float) -> bool:
        return bool(self.rng.random() < share)

    def between(self, low: float, high: float) -> float:
        return float(self.rng.uniform(low, high))

    def magnitude(self, low: float, high: float) -> float:
        return float(np.exp(self.rng.uniform(np.log(low), np.log(high))))

    def add_ship(self) -> None:
        """A box: 5,000 to 50,000 t with 1 to 6 m of GM."""
        mass, length = self.magnitude(5e6, 5e7), self.between(60.0, 160.0)
        breadth = length / self.between(4.0, 6.0)
        weight, plane = mass * G, 1025.0 * G * length * breadth
        inertia = mass * np.array([(0.35 * breadth) ** 2, (0.25 * length) ** 2, (0.25 * length) ** 2])
        self.scene.add_body(SHIP, mass=mass, inertia=inertia, gravity=False)
        heavy = np.concatenate([[0.1 * mass, mass, mass], 0.5 * inertia])
        stiff = np.array([0.0, 0.0, plane, weight * self.between(1.0, 6.0), weight * 1.2 * length, 0.0])
        moored = np.concatenate([heavy[:2] + mass, heavy[5:] + inertia[2:]]) * (2.0 * np.pi / 200.0) ** 2
        self.moored = self.chance(0.8)
        self.scene.add_vessel(body=SHIP, added_mass=np.diag(heavy), restoring=np.diag(stiff),
                              linear_damping=np.diag(0.05 * np.sqrt(np.maximum(stiff, 1.0) * (heavy + mass))),
                              mooring_stiffness=moored if self.moored else np.zeros(3),
                              mooring_damping=0.2 * np.sqrt(moored * mass))  # fmt: skip
        self.base, self.breadth = SHIP, breadth

    def holder(self) -> tuple[str, Array]:
        """Body and point from which all hangs: the base, a crane held or on oil, or an arm on a cylinder."""
        kind = self.rng.choice(["base", "held crane", "oil crane", "arm"], p=[0.35, 0.2, 0.2, 0.25])
        if kind == "base":
            point = np.array([self.between(-20.0, 20.0), self.between(-20.0, 20.0), self.between(20.0, 60.0)])
            return self.base, point
        if kind == "arm":
            return self.arm()
        hydraulics = {"main": self.oil(), "knuckle": self.oil()} if kind == "oil crane" else None
        roles = self.scene.add_crane(base=self.base, foot=(5.0, 0.0, 5.0), slew=self.between(-3.0, 3.0),
                                     s1=self.between(1.0, 2.5), s2=self.between(1.0, 3.0), held=True,
                                     hydraulics=hydraulics)  # fmt: skip
        return roles.tip[0], np.asarray(roles.tip[1])

    def oil(self) -> dict[str, Any]:
        piston = Piston(viscous_friction=self.magnitude(2e5, 5e6))
        out = OIL | {"piston": piston}
        if self.chance(0.2):
            out |= {"valve": replace(OF_CRANE, overlap=0.02)}
        if self.chance(0.1):
            out |= {"piston": replace(piston, internal_leakage=1e-13)}
        if self.chance(0.2):
            out |= {"counterbalance": Counterbalance(pressure=35e6, flow=0.02)}
        return out

    def arm(self) -> tuple[str, Array]:
        """A boom on a hinge, lifted by a hydraulic cylinder below it."""
        foot, reach = np.array([0.0, 0.0, 25.0]), self.between(8.0, 20.0)
        mass = self.magnitude(2e3, 2e4)
        self.scene.add_body("arm", mass=mass, inertia=np.diag([0.01, 1.0, 1.0]) * mass * reach**2 / 12.0,
                            position=foot + 0.5 * reach * AHEAD)  # fmt: skip
        self.scene.add_joint("hinge", kind="revolute", first=self.base, second="arm", point=foot,
                             axis=(0, 1, 0))  # fmt: skip
        low, high = foot + np.array([1.0, 0.0, -4.0]), foot + 0.4 * reach * AHEAD
        apart = float(np.linalg.norm(high - low))
        size = {"full_area": 0.3, "rod_side_area": 0.15, "stroke": 3.0,
                "chamber": Chamber(hose_volume=0.05, pressure=2e7),
                "rod_chamber": Chamber(hose_volume=0.05, pressure=1e6)}  # fmt: skip
        oil = PARTS | self.oil() | size | {"retracted_length": apart - self.between(0.5, 2.5)}
        self.scene.add_hydraulic_cylinder("ram", first=self.base, second="arm", first_point=low,
                                          second_point=[-0.1 * reach, 0.0, 0.0], **oil)  # fmt: skip
        return "arm", np.array([0.5 * reach, 0.0, 0.0])

    def hang(self) -> None:
        """A load on a line of some falls, too long, too short or as it is, perhaps on a winch."""
        mass, drop = self.magnitude(2e3, 2e5), self.between(5.0, 15.0)
        place = np.asarray(self.scene.place_of(body=self.tip, point=self.head)) - [0.0, 0.0, drop]
        if self.chance(0.3):
            place = place + np.array([self.between(-2.0, 2.0), self.between(-2.0, 2.0), 0.0])
        size = self.between(1.0, 4.0)
        self.scene.add_body("load", mass=mass, inertia=mass * size**2 * self.rng.uniform(0.15, 0.25, 3),
                            position=place)  # fmt: skip
        falls = int(self.rng.integers(1, 4))
        bodies = ([self.tip, "load"] * 2)[: falls + 1]
        top = np.array([0.0, 0.0, 0.5 * size * self.chance(0.7)])
        points = [self.head if body == self.tip else top for body in bodies]
        points = [np.asarray(p) + 0.3 * (i > 1) * AHEAD for i, p in enumerate(points)]
        stiffness = mass * G / self.magnitude(5e-4, 5e-3)
        given = {"tension_at_start": mass * G / falls}
        if self.chance(0.5):
            given = {"length": falls * (drop - top[2]) * self.between(0.95, 1.08)}
        if self.chance(0.15) and falls == 1:
            self.scene.add_line(name="hoist", bodies=bodies, points=points, EA=stiffness, wire={"segments": 4,
                                "mass_per_length": self.between(5.0, 40.0)},
                                length=(drop - top[2]) * self.between(0.99, 1.009))  # fmt: skip
            return
        self.scene.add_line(name="hoist", bodies=bodies, points=points, EA=stiffness,
                            damping_ratio=self.between(0.0, 0.1), **given)  # fmt: skip
        if self.chance(0.5):
            self.wind("hoist")

    def wind(self, line: str) -> None:
        """A winch at a stand: by itself, with a lag, or with a drum on its motor or its brake."""
        given = {}
        if self.chance(0.6):
            given = {"lag": self.between(0.1, 0.5), "maximum_acceleration": 0.5}
            if self.chance(0.5):
                given |= {"drum_inertia": self.magnitude(500.0, 5e4), "drum_radius": 0.5}
                if self.chance(0.4):
                    given |= {"brake": 1.0, "brake_capacity": 1e7, "brake_give": 0.01}
        self.scene.add_winch(line, maximum_rate=self.between(0.2, 2.0), **given)

    def tug(self) -> None:
        """Taglines to the base: fixed, or on tuggers that hold a tension; slack at first or not."""
        place, weight = np.asarray(self.scene.bodies["load"].position), self.scene.bodies["load"].mass * G
        origin = np.asarray(self.scene.bodies[SHIP].position) if self.base == SHIP else np.zeros(3)
        for i in range(int(self.rng.integers(1, 4))):
            way = self.between(0.0, 2.0 * np.pi)
            far = np.array([np.cos(way), np.sin(way), self.between(-0.2, 0.3)]) * self.between(8.0, 30.0)
            arm = np.array([np.cos(way), np.sin(way), 0.0]) * self.between(0.0, 2.0) * self.chance(0.6)
            fixed = self.chance(0.3)
            bounds = (0.9, 1.02) if fixed else (0.97, 1.03)
            length = float(np.linalg.norm(far - arm)) * self.between(*bounds)
            stiffness = 2.0 * weight if fixed else self.magnitude(5e4, 5e6)
            self.scene.add_line(f"tug {i}", bodies=[self.base, "load"], points=[place + far - origin, arm],
                                EA=stiffness, length=length)  # fmt: skip
            if not fixed:
                self.hold(f"tug {i}", weight)

    def hold(self, line: str, weight: float) -> None:
        """A winch that holds a tension."""
        tension, given = weight * self.magnitude(0.005, 0.1), {}
        if self.chance(0.5):
            given["lag"] = self.between(0.05, 0.3)
        if self.chance(0.3):
            given["dead_band"] = 0.05 * tension
        self.scene.add_winch(line, tension=tension, tension_gain=self.magnitude(0.05, 0.5) / tension,
                             maximum_rate=self.between(0.3, 2.0), **given)  # fmt: skip

    def hang_below(self) -> None:
        """A second load below the first, on slings."""
        above = self.scene.bodies["load"]
        mass, drop = above.mass * self.between(0.1, 1.0), self.between(4.0, 10.0)
        half = self.between(0.5, 2.0)
        place = np.asarray(above.position) - [0.0, 0.0, drop]
        self.scene.add_body("below", mass=mass, inertia=mass * half**2 * np.array([0.5, 0.5, 0.6]),
                            position=place)  # fmt: skip
        for i, (x, y) in enumerate([(-1, -1), (-1, 1), (1, -1), (1, 1)][: int(self.rng.integers(2, 5))]):
            corner = half * np.array([x, y, 0.3])
            reach = float(np.linalg.norm(corner * (1, 1, -1) + (0.0, 0.0, drop)))
            self.scene.add_line(f"sling {i}", "load", "below", second_point=corner, EA=mass * G / 2e-3,
                                length=reach * self.between(0.98, 1.02))  # fmt: skip

    def ballast(self) -> None:
        kind, b = self.rng.choice(["none", "force", "tanks", "heel"]), self.breadth
        if kind == "force":
            self.scene.add_ballast()
        elif kind == "heel":
            self.scene.add_ballast(heel_deg=self.between(-4.0, 4.0))
        elif kind == "tanks":
            points = [(x * b, y * b, 0.0) for x in (-1.5, 1.5) for y in (-0.45, 0.45)]
            tanks = {str(point): Tank(point=point, capacity=1e8, content=5e7) for point in points}
            self.scene.add_ballast(tanks=tanks)
