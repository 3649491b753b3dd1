"""A crane vessel lifts 60 t off a feeder barge beside it: re-hits, hook, and the ships' own waves.

Usage: python feeder_lift_two_ships.py [FOLDER FOR A PICTURE]
"""

import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np

from seacrane import Outputs, Result, Scene, Stage, State, Until, ensemble, linear_model, simulate
from seacrane.analysis import LinearModel, response_summed
from seacrane.answers import contact_hits
from seacrane.crane import load_crane
from seacrane.hydro import two_barges

MASS, SIZE, DECK, EA, SLACK = 60e3, (8.0, 6.0, 5.0), 2.5, 3e8, 2.5  # kg, m, m over the water, N, m
HS, TP, DIRECTION, GRAVITY = 1.0, 8.0, -120.0, 9.81  # m, s, deg, m/s2
SHOWN = 3  # the sea of the picture
FEET = [(x, y, -0.5 * SIZE[2]) for x in (-3.5, 3.5) for y in (-2.5, 2.5)]
WATERS = {"each as if alone": None, "lid of 0.01 in the gap": 0.01, "lid of 0.03 in the gap": 0.03}
LIFT = [
    Stage(name="wait", duration=20.0),
    Stage(
        name="lift off", until=Until.clear("feet", minimum=2.0), maximum_duration=60.0,
        commands={"hoist.rate": -0.4},
    ),
    Stage(name="hoist", duration=10.0),
]  # fmt: skip
RECORDED = Outputs(
    dt_out=0.02, channels=("contact_press", "contact_least_gap", "line_tension", "position", "vessel_motion")
)


def feeder_lift(lid_damping: float | None, seed: int = 1) -> Scene:
    """The load on the feeder's deck below the crane's tip, its wire slack."""
    scene = Scene(name="feeder lift", gravity=GRAVITY)
    scene.add_vessel(two_barges(lid_damping=lid_damping), mooring=60.0)
    crane = load_crane("lattice_boom_100t")
    scene.add_crane(
        crane, base="crane vessel", foot=(0.0, 6.0, 3.0), coordinates={"slew": -0.5 * np.pi, "boom": 1.176}
    )
    scene.add_ballast(vessel="crane vessel")
    scene.add_hoist(
        mass=MASS, size=SIZE, on="feeder", height=DECK, slack=SLACK, EA=EA, damping=False,
        feet={"points": FEET, "friction": 0.4, "name": "feet"},
        winch={"maximum_acceleration": 0.5, "lag": 0.2},
    )  # fmt: skip
    for vessel in scene.vessels:
        scene.add_sea(vessel=vessel, hs=HS, tp=TP, direction_deg=DIRECTION, seed=seed)
    return scene


def swaying(model: LinearModel) -> Callable[[Scene], State]:
    """Start in the steady state of the linear model, so that no sea begins at once."""
    return lambda scene: model.full_state(
        response_summed(model, body="feeder", waves=scene.waves).state_at(0.0)
    )


def rehits(result: Result) -> int:
    """How often a foot comes back to the deck."""
    return sum(hit.number > 0 for hit in contact_hits(result, "feet"))


def hardest(result: Result) -> float:
    """Largest peak of these over a foot's share of the weight."""
    return max((hit.dynamic_factor for hit in contact_hits(result, "feet") if hit.number > 0), default=0.0)


def main() -> None:
    """One lift in each water, then twelve seas."""
    runs = {}
    keep = {"rehits": rehits, "hardest": hardest, "hook": "line_tension[hoist].max"}
    for water, lid in WATERS.items():
        scene = feeder_lift(lid, seed=SHOWN)
        start = swaying(linear_model(scene, vessel="feeder"))
        runs[water] = simulate(scene, LIFT, start=start(scene), outputs=RECORDED, rtol=0.001)
        seas = ensemble(
            scene,
            over={"seed": range(1, 13)},
            keep=keep,
            stages=LIFT,
            start=start,
            outputs=RECORDED,
            rtol=1e-3,
        )
        told = seas.dataset
        print(
            f"{water}: deck hit again in {int((told.rehits > 0).sum())} of {told.seed.size} seas, "
            f"{float(told.rehits.mean()):.1f} hits a lift, peaks to {float(told.hardest.max()):.2f} times a "
            f"foot's share; hook {float(told.hook.mean()) / MASS / GRAVITY:.2f} weights at most on average, "
            f"{float(told.hook.max()) / MASS / GRAVITY:.2f} in the worst"
        )
    if len(sys.argv) > 1:
        draw(runs, Path(sys.argv[1]))


def draw(runs: dict[str, Result], folder: Path) -> None:
    """Deck below the load, forces of feet and hook, in the three waters."""
    import matplotlib.pyplot as plt

    figure, rows = plt.subplots(3, 1, figsize=(8.0, 7.5), sharex=True, layout="constrained")
    weight = MASS * GRAVITY
    for water, result in runs.items():
        roll = np.degrees(result.select("vessel_motion", vessel="feeder", motion="roll"))
        curves = (roll, result["contact_press"].sum(axis=1) / weight, result["line_tension"][:, 0] / weight)
        for row, curve in zip(rows, curves, strict=True):
            row.plot(
                result.time,
                curve,
                "--" if water.startswith("lid of 0.03") else "-",
                linewidth=0.9,
                label=water,
            )
    for row, label in zip(
        rows, ("roll of the feeder [deg]", "all feet [weights]", "hook [weights]"), strict=True
    ):
        row.set(ylabel=label)
        row.grid(alpha=0.3)
    rows[-1].set(xlabel="time [s]")
    figure.legend(*rows[0].get_legend_handles_labels(), ncols=3, loc="outside upper center")
    figure.savefig(folder / "feeder_lift_two_ships.png", dpi=110)


if __name__ == "__main__":
    main()
