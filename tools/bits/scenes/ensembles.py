"""Ensembles, each alone and in four lanes."""

from __future__ import annotations

from bits.case import by, case
from bits.scenes.parts import G, ramp, with_load
from seacrane import Kept, Scene, Stage, cases

LANES = tuple(by("dopri5", lanes=lanes) for lanes in (1, 4))
FIXED = tuple(by("rk4", dt=0.02, lanes=lanes) for lanes in (1, 4))
TRACK = Kept(channel="position", names={"body": "load"}, interval=0.5)


@case(
    *LANES, *FIXED, t_end=4.0, dt_out=0.1, over={"seed": [1, 2, 3, 4], "hs": [1.5, 2.0]},
    keep={"track": "position[payload]", "pull": "link_tension.max"},
)  # fmt: skip
def seas_of_case2() -> Scene:
    return cases.case2()


@case(
    *LANES, t_end=3.0, dt_out=0.1, over={"bodies.load.mass": [1800.0, 2200.0], "loads.hoist.EA": [1e6, 2e6]},
    keep={"track": TRACK, "hook": "hook_load.max", "swing": "position[load, x].std"},
)  # fmt: skip
def masses_and_wires() -> Scene:
    scene = with_load((1.0, 0.3, -10.0))
    scene.add_line(name="hoist", bodies=["ground", "load"], points=[(0, 0, 0), (0, 0, 0)], EA=1e6, length=9.9)
    scene.add_winch(line="hoist", rate=ramp(-0.3), lag=0.2)
    return scene


def hoisted() -> list[Stage]:
    return [
        Stage(name="raise", duration=1.5, commands={"hoist.rate": -0.4}),
        Stage(name="hold", duration=1.0, commands={"hoist.rate": 0.0}),
    ]


@case(
    *LANES, dt_out=0.1, stages=hoisted, over={"seed": [1, 2, 3, 4]},
    keep={"hook": "hook_load[stage=raise].max", "end": "stage[raise].end", "track": TRACK},
)  # fmt: skip
def seas_of_a_lift_in_stages() -> Scene:
    scene = Scene(name="hoisting", gravity=G)
    scene.add_vessel(cases.shipped_database(), memory="none")
    scene.add_crane(slew=-1.2, s1=1.4, s2=1.0)
    scene.add_hoist(
        mass=60e3, size=(4.0, 4.0, 4.0), length=14.0, EA=4e8, winch={"lag": 0.3, "maximum_rate": 1.0}
    )
    scene.add_sea(hs=1.5, tp=7.0, direction_deg=150.0, seed=1, count=30)
    return scene
