"""What the place of a crane and the stiffness of a tugger do to a swing, seed by seed in the same waves.

Usage: python design_study.py [FOLDER FOR A PICTURE]
"""

import sys
from pathlib import Path

import numpy as np

from seacrane import Scene, ensemble, shipped_database
from seacrane.crane import Payload

DESIGN = {"foot_x": (33.0, 2.0), "tugger": (10e3, 1e3)}  # value and step: m, N/m
FAR = 20.0  # m, from the tugger's winch to the load
SEEDS = range(1, 13)


def lift(*, seed: int, foot_x: float, tugger: float) -> Scene:
    """A load of 20 t over the side; a tugger pulls it aft with 20 kN."""
    scene = Scene(name="design")
    scene.add_vessel(shipped_database())
    scene.add_sea(hs=1.0, tp=9.0, direction_deg=150.0, seed=seed, count=60)
    payload = Payload(mass=20e3, link_length=8.0)
    scene.add_crane(foot=(foot_x, 10.0, 10.0), slew=-1.57, s1=1.0, s2=1.5, payload=payload, held=True)
    x, y, z = scene.bodies["payload"].position
    scene.add_spring(
        name="tugger", first="vessel", second="payload", first_point=(x - FAR, y, z), stiffness=tugger,
        damping=2e3, natural_length=FAR - 20e3 / tugger,
    )  # fmt: skip
    scene.add_ballast(heel_deg=0.0)
    return scene


def swing(result):
    """Largest angle of the link from its mean, to either side of the boom, in the last 100 s, deg."""
    angle = np.degrees(result["sidelead"][result.time >= 20.0])
    return abs(angle - angle.mean()).max()


middle = {name: value for name, (value, _) in DESIGN.items()}
sides = [{**middle, name: value + side * step} for name, (value, step) in DESIGN.items() for side in (-1, 1)]
runs = ensemble(
    lift, over=[{"seed": seed, **design} for seed in SEEDS for design in (middle, *sides)],
    keep={"swing": swing}, t_end=120.0, dt_out=0.25, rtol=1e-2, integrator="tsit5", channels=["sidelead"],
)  # fmt: skip
swings = runs.dataset["swing"].to_numpy().reshape(len(SEEDS), 1 + len(sides))
print(f"mean largest swing: {swings[:, 0].mean():.3g} deg, of {len(SEEDS)} seeds")
changes = {}
for i, (name, (_, step)) in enumerate(DESIGN.items()):
    less, more = swings[:, 1 + 2 * i], swings[:, 2 + 2 * i]
    half = 0.5 * (more - less)  # per step; in the same waves chance drops out of it
    error = 2.2 * half.std(ddof=1) / np.sqrt(len(SEEDS))  # 95 %, by Student's t of 11
    saved = (more.var() + less.var()) / (more - less).var()
    changes[name] = (half.mean(), error)
    print(
        f"{name} {step:+g}: {half.mean():+.3g} +- {error:.2g} deg, other seeds take {saved:.2g} times as many"
    )

if len(sys.argv) > 1:
    import matplotlib.pyplot as plt

    for place, (change, error) in enumerate(changes.values()):
        plt.errorbar(place, change, yerr=error, fmt="o", capsize=6)
    labels = [
        f"crane {DESIGN['foot_x'][1]:g} m forward",
        f"tugger {DESIGN['tugger'][1] / 1e3:g} kN/m stiffer",
    ]
    plt.xticks(range(len(labels)), labels)
    plt.xlim(-0.5, len(labels) - 0.5)
    plt.axhline(0.0, color="0.5")
    plt.ylabel("change of the mean largest swing [deg]")
    plt.savefig(Path(sys.argv[1]) / "design_study.png")
