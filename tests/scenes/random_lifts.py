"""Random lifts over water, decks and seabeds, and the same lift told in another way: judges of a whole run.

As a program: python tests/scenes/random_lifts.py [COUNT] [FIRST SEED].
"""

from __future__ import annotations

import sys
import warnings
from collections import Counter
from dataclasses import dataclass, replace
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import Result, Run, Scene, SeacraneError, Stage, State, Until, shipped_database, simulate
from seacrane.arrays import Array
from seacrane.hydro import BoxPart, CylinderPart, Opening, PlatePart, SpherePart, two_barges
from seacrane.scene import Oil, Piston
from seacrane.sea.dispersion import wavenumber

G = 9.80665
HALF = 0.5
OIL = {"oil": Oil(modulus=1.2e9), "piston": Piston(viscous_friction=2e4, friction=0.0)}
SIDE = np.array([12.0, 4.0, 0.0])  # m, from the load to the post of its tugger


@dataclass(frozen=True, kw_only=True)
class View:
    """How a lift is told. By default as it was drawn."""

    turn_deg: float = 0.0  # about the vertical through the origin, after
    mirrored: bool = False  # port for starboard
    shift: tuple[float, float] = (0.0, 0.0)  # m
    later: float = 0.0  # s
    cut: bool = False  # the load is two bodies that are welded
    twice_half: bool = False  # every contact and side line is there twice, half as stiff
    other: bool = False  # by the other formulation

    @property
    def side(self) -> float:
        return -1.0 if self.mirrored else 1.0

    def own(self, point: Any) -> Array:
        """A point of a body that is mirrored with the rest."""
        return np.asarray(point, dtype=float) * (1.0, self.side, 1.0)

    def at(self, point: Any) -> Array:
        """A point of the inertial frame."""
        return np.asarray(self.own(point) @ self.rotation().T + (*self.shift, 0.0))

    def back(self, points: Array) -> Array:
        """Where the points of a run are in the lift as it was drawn."""
        return np.asarray(((points - (*self.shift, 0.0)) @ self.rotation()) * (1.0, self.side, 1.0))

    def rotation(self) -> Array:
        c, s = np.cos(np.radians(self.turn_deg)), np.sin(np.radians(self.turn_deg))
        return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


AS_DRAWN = View()
VIEWS = {"mirrored": View(mirrored=True), "turned": View(turn_deg=73.0),
         "shifted": View(shift=(310.0, -140.0)), "later": View(later=7.3), "cut in two": View(cut=True),
         "twice half": View(twice_half=True), "other": View(other=True),
         "all": View(mirrored=True, turn_deg=-141.0, shift=(-83.0, 47.0), later=3.1, cut=True,
                     twice_half=True, other=True)}  # fmt: skip


def fits(lift: SimpleNamespace, view: View) -> bool:
    """Whether the lift is the same in that view: given motions have a clock, a second ship lies to port,
    damping is that of one body, and friction holds as stiffly as the load's weight asks, whatever presses."""
    return not (
        (view.later and lift.base == "given")
        or (view.mirrored and lift.base == "pair")
        or (view.cut and lift.damping)
        or (view.twice_half and lift.deck is not None and lift.friction > 0.0)
    )


def drawn(seed: int) -> SimpleNamespace:
    """What a lift is, whatever the view."""
    rng = np.random.default_rng([4501, seed])

    def one_of(*names: Any) -> Any:
        return names[int(rng.integers(len(names)))]

    base = one_of("ground", "ground", "ship", "ship", "given", "pair")
    part = one_of("none", "box", "plate", "cylinder", "sphere")
    deck = float(rng.uniform(0.0, 3.0)) if rng.random() < 0.5 else None  # m above the water, below the load
    wet = base in ("ship", "given", "pair") or rng.random() < 0.5
    sea = {"hs": float(rng.uniform(0.3, 2.5)), "tp": float(rng.uniform(6.0, 12.0)),
           "direction_deg": float(rng.uniform(0.0, 360.0)), "seed": int(rng.integers(1, 99)), "count": 40,
           "spreading": one_of(None, 2.0)}  # fmt: skip
    kinds = rng.choice(["lower", "raise", "wait", "meet", "let go"], int(rng.integers(1, 5)))
    return SimpleNamespace(
        base=base, part=part, deck=deck, sea=sea if wet else None, slew=float(rng.uniform(-2.0, 2.0)),
        mass=float(rng.uniform(5e3, 4e4)), size=tuple(rng.uniform(1.5, 5.0, 3).tolist()),
        height=float((deck or 0.0) + rng.uniform(0.3, 2.0)),  # of the underside
        stiffness=float(10.0 ** rng.uniform(5.8, 7.2)), rung=one_of("elastic", "elastic", "quasi-static"),
        compartment=bool(part == "box" and rng.random() < 0.5),
        oil=bool(rng.random() < 0.25),  # in the crane's cylinders
        winch_lag=one_of(0.0, 0.3), surface=one_of("plane", "box"), friction=one_of(0.0, 0.3),
        tugger=one_of(0.0, 5e3),  # N, of its line at the start
        damping=bool(rng.random() < 0.3),  # of the load's swing, which knows one body
        stages=tuple((str(kind), float(rng.uniform(0.3, 1.2))) for kind in kinds),
        formulation=one_of("recursive", "redundant"),
        integrator=one_of("tsit5", "dop853", "dopri5", "cvode-bdf"),
    )  # fmt: skip


class Lift:
    """A drawn lift as a view tells it."""

    def __init__(self, lift: SimpleNamespace, view: View) -> None:
        self.lift, self.view = lift, view
        self.scene = Scene(name="random lift", gravity=G)
        self.base = {"ground": "ground", "pair": "crane vessel"}.get(lift.base, "vessel")
        self.heading = view.turn_deg
        for add in (self.add_sea, self.add_base, self.add_load, self.add_water, self.add_contacts):
            add()

    def add_sea(self) -> None:
        """The sea alone, its components turned, mirrored, and as they were `later` ago."""
        lift, view, scene = self.lift, self.view, self.scene
        if lift.sea is None:
            return
        waves = scene.add_sea(vessel=None, **lift.sea)
        assert waves is not None
        direction = view.side * waves.direction + np.radians(view.turn_deg)
        k = wavenumber(waves.omega, g=G, depth=waves.depth)
        along = k * (view.shift[0] * np.cos(direction) + view.shift[1] * np.sin(direction))
        scene.waves = replace(waves, direction=direction,
                              phase=waves.phase + along - waves.omega * view.later)  # fmt: skip

    def add_base(self) -> None:
        lift, view, scene = self.lift, self.view, self.scene
        x, y, _ = view.at((0.0, 0.0, 0.0))
        place: dict[str, Any] = {"position": (x, y, 0.0), "heading_deg": self.heading}
        if lift.base == "ship":
            scene.add_vessel(shipped_database(), **place)
        elif lift.base == "given":
            scene.add_vessel(motion=shipped_database(), ramp=2.0, duration=90.0, **place)
        elif lift.base == "pair":
            scene.add_vessel(two_barges(lid_damping=0.03), **place)
        for vessel in {"ground": (), "pair": ("crane vessel", "feeder")}.get(lift.base, ("vessel",)):
            scene.add_sea(vessel=vessel)
        if lift.base == "ground":
            foot, slew = view.at((0.0, 0.0, 8.0)), view.side * lift.slew + np.radians(view.turn_deg)
        else:
            foot, slew = view.own((20.0, -4.0, 8.0)), view.side * lift.slew
        hydraulics = {"main": OIL, "knuckle": OIL} if lift.oil else None
        scene.add_crane(base=self.base, foot=foot, slew=slew, s1=1.5, s2=1.5, hydraulics=hydraulics)

    def add_load(self) -> None:
        lift, view, scene = self.lift, self.view, self.scene
        lag = lift.winch_lag or (0.1 if lift.rung == "quasi-static" else 0.0)
        scene.add_hoist(mass=lift.mass, size=lift.size, height=lift.height, stiffness=lift.stiffness,
                        rung=lift.rung, winch={"lag": lag}, damping=lift.damping)  # fmt: skip
        load = scene.bodies["load"]
        if lift.base == "ground":  # whose axes do not turn with the lift, as those of a ship do
            turn = np.radians(HALF * view.turn_deg)
            scene.replace("load", quaternion=(np.cos(turn), 0.0, 0.0, np.sin(turn)))
        self.start = view.back(np.array(load.position))
        scene.add_point("middle", body="load")  # of the whole load, also where it is cut
        if view.cut:
            self.cut(0.4, np.array([0.1, 0.05, 0.1]) * lift.size)
        if lift.tugger:
            post, eye = view.at(self.start + SIDE), view.own((HALF * lift.size[0], 0.0, 0.0))
            for name, part in self.halves("tugger"):
                scene.add_line(name, "ground", "load", first_point=post, second_point=eye, EA=part * 1e6,
                               tension_at_start=part * lift.tugger)  # fmt: skip

    def cut(self, share: float, offset: Array) -> None:
        """Part of the load's mass becomes a body of its own; both together have its mass and inertia."""
        scene, whole, offset = self.scene, self.scene.bodies["load"], self.view.own(offset)
        small, rest = share * whole.mass, whole.mass - share * whole.mass
        other, inertia = -small / rest * offset, np.asarray(whole.inertia)
        part = 0.5 * share * inertia
        turned = sum(m * (r @ r * np.eye(3) - np.outer(r, r)) for m, r in ((small, offset), (rest, other)))
        place = {"position": np.array(whole.position), "quaternion": np.array(whole.quaternion)}
        scene.replace("load", mass=rest, inertia=inertia - part - turned, center_of_mass=other)
        scene.add_body("other part", mass=small, inertia=part, center_of_mass=offset, **place)
        scene.add_joint("cut", kind="weld", first="load", second="other part", point=place["position"])

    def halves(self, name: str) -> list[tuple[str, float]]:
        return [(f"{name} 1", HALF), (f"{name} 2", HALF)] if self.view.twice_half else [(name, 1.0)]

    def add_water(self) -> None:
        lift, scene = self.lift, self.scene
        length, breadth, height = lift.size
        parts = {"box": BoxPart(size=lift.size, strips=(2, 2), fill=0.2),
                 "plate": PlatePart(size=(length, breadth), thickness=0.1, point=(0.0, 0.0, -HALF * height)),
                 "cylinder": CylinderPart(length=length, diameter=min(breadth, height)),
                 "sphere": SpherePart(diameter=min(lift.size))}  # fmt: skip
        if lift.part in parts:
            scene.add_immersed("load", parts=[parts[lift.part]])
        if lift.compartment:
            openings = [Opening(area=0.02, point=(0.0, 0.0, end * 0.3 * height)) for end in (-1.0, 1.0)]
            inside = {"area": 0.3 * length * breadth, "height": 0.6 * height, "openings": openings}
            scene.add_immersed("load", inside=inside | {"point": (0.0, 0.0, -0.3 * height)})

    def add_contacts(self) -> None:
        lift, view, scene = self.lift, self.view, self.scene
        if lift.deck is None:
            return
        x, y, z = HALF * np.array(lift.size)
        feet = [view.own((a, b, -z)) for a in (-x, x) for b in (-y, y)]
        surface: dict[str, Any] = {"surface": lift.surface}
        place = np.array([self.start[0], self.start[1], lift.deck])
        if lift.surface == "box":
            surface["size"] = (4.0 * lift.size[0], 4.0 * lift.size[1], 1.0)
            place = place - (0.0, 0.0, 0.5)
        at = view.at(place) if lift.base == "ground" else view.own(place)
        for name, part in self.halves("feet"):
            scene.add_contact("load", points=feet, on=self.base, place=at, name=name, friction=lift.friction,
                              stiffness=25.0 * part * (lift.mass * G), **surface)  # fmt: skip

    def stages(self) -> list[Stage]:
        out, rate, gone = [], 0.0, False
        feet = [name for name, _ in self.halves("feet")] if self.lift.deck is not None else []
        for i, (kind, speed) in enumerate(self.lift.stages):
            what: dict[str, Any] = {"duration": 1.0 + 0.5 * speed}
            if kind == "let go" and self.lift.tugger and not gone:
                gone, what = True, {"duration": 0.7, "release": [one for one, _ in self.halves("tugger")]}
            elif kind == "meet" and feet:
                deep = Until.channel("point_position", point="middle", axis="z", maximum=-3.0)
                what, rate = {"until": [Until.contact(feet[0]), deep], "maximum_duration": 60.0}, speed
                what["commands"] = {"hoist.rate": rate}
            elif kind in ("lower", "raise") and speed != rate:
                rate = speed if kind == "lower" else -speed
                what = {"duration": 1.5, "commands": {"hoist.rate": rate}}
            out.append(Stage(name=f"{i} {kind}", **what))
        return out

    def run(self) -> Result:
        both = {"recursive": "redundant", "redundant": "recursive"}
        formulation = both[self.lift.formulation] if self.view.other else self.lift.formulation
        how: dict[str, Any] = {"formulation": formulation, "integrator": self.lift.integrator, "rtol": 1e-9}
        return simulate(self.scene, self.stages(), start=self.begun(), dt_out=0.05, **how)

    def begun(self) -> State | None:
        """As described, at the time of the view: a load that turns freely rests at any angle."""
        if not self.view.later:
            return None
        now = Run(self.scene, t_end=1.0).state
        same = {key: getattr(now, key) for key in ("values", "inputs", "closed", "parts")}
        return State(time=self.view.later, **same)


def center(result: Result) -> Array:
    """Centre of mass of the load, one body or two (n, 3)."""
    assert result.scene is not None
    bodies = result.scene.bodies
    parts = [name for name in ("load", "other part") if name in bodies]
    places, masses = [result.select("position", body=name) for name in parts], [bodies[n].mass for n in parts]
    return np.asarray(np.average(places, axis=0, weights=masses))


def difference(lift: SimpleNamespace, view: View, as_drawn: Result) -> dict[str, float]:
    """How far a view's run is from the lift as drawn: places in m, forces in shares of the largest."""
    told = Lift(lift, view).run()
    ends = [abs(a.end - b.end - view.later) for a, b in zip(told.stages, as_drawn.stages, strict=True)]
    out = {"ends": max(ends)}
    at = np.intersect1d(np.round(told.time - view.later, 6), np.round(as_drawn.time, 6))

    def picked(result: Result, begin: float) -> NDArray[np.intp]:
        return np.searchsorted(np.round(result.time - begin, 6), at)

    mine, its = picked(told, view.later), picked(as_drawn, 0.0)
    out["place"] = float(np.abs(view.back(center(told)[mine]) - center(as_drawn)[its]).max())
    pull = told.select("hook_load", suspension="hoist")[mine]
    pulled = as_drawn.select("hook_load", suspension="hoist")[its]
    return out | {"hook_load": float(np.abs(pull - pulled).max() / np.abs(pulled).max())}


BOUNDS = {"ends": 1e-4, "place": 1e-4, "hook_load": 1e-3}


def judged(seed: int) -> tuple[str, dict[str, str]]:
    """How the lift of a seed went, and by view what was wrong."""
    lift = drawn(seed)
    wrong = {}
    with warnings.catch_warnings(action="ignore"):
        try:
            as_drawn = Lift(lift, AS_DRAWN).run()
        except SeacraneError as error:
            return f"no run: {str(error)[:160]}", {}
        for name in (name for name, view in VIEWS.items() if fits(lift, view)):
            try:
                off = difference(lift, VIEWS[name], as_drawn)
            except SeacraneError as error:
                wrong[name] = str(error)[:300]
                continue
            if any(off[key] > bound for key, bound in BOUNDS.items()):
                wrong[name] = ", ".join(f"{key} {value:.2g}" for key, value in off.items())
    return "run", wrong


def main(count: int = 100, first: int = 0) -> int:
    how, bad = Counter[str](), 0
    for seed in range(first, first + count):
        went, wrong = judged(seed)
        how[went.split(":")[0]] += 1
        bad += bool(wrong)
        for name, what in ({went: ""} if went != "run" else wrong).items():
            print(f"{seed} {name} {what}", flush=True)
    print(f"{count} lifts, {dict(how)}, {bad} differ")
    return int(bad > 0)


if __name__ == "__main__":
    sys.exit(main(*map(int, sys.argv[1:])))
