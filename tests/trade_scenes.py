"""Random scenes and what an accuracy promises on them, for the tests of `simulate(accuracy=...)`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from seacrane import Scene, cases, simulate
from seacrane.crane import Payload
from seacrane.trading.quantities import Quantity, compare, quantities_of

GRID: list[tuple[str, dict[str, float]]] = [
    *(("tsit5", {"rtol": 10.0**-k}) for k in range(1, 10)),
    *(("dopri5", {"rtol": 10.0**-k}) for k in range(1, 10, 2)),
    *(("bs32", {"rtol": 10.0**-k}) for k in range(1, 4)),
    *(("rk4", {"dt": step}) for step in (0.2, 0.1, 0.05, 0.025)),
    *(("verner76", {"rtol": 10.0**-k}) for k in range(2, 11, 2)),
    *(("dop853", {"rtol": 10.0**-k}) for k in range(2, 11, 2)),
]


@dataclass(frozen=True)
class Promise:
    """What was asked for, promised and found, and the cost over that of the cheapest passing grid point."""

    what: str
    limit: float
    estimate: float
    error: float
    cost_of_run: float
    cost_of_all: float


def random_scene(rng: np.random.Generator) -> Scene:
    """A lift case or the vessel alone in a random sea, with a random payload; or a chain of pendulums."""
    kind = rng.choice(["case1", "case2", "case2", "case3", "vessel", "chain"])
    if kind == "chain":
        return random_chain(rng)
    options: dict[str, Any] = {
        "hs": float(rng.uniform(0.5, 4.0)),
        "tp": float(rng.uniform(7.5, 14.0)),
        "wave_direction_deg": float(rng.uniform(0.0, 360.0)),
        "seed": int(rng.integers(1, 10**6)),
        "memory": str(rng.choice(["per-pair", "passive"])),
    }
    if kind == "case2":
        options["payload"] = Payload(
            mass=float(10.0 ** rng.uniform(3.0, 4.7)), link_length=float(rng.uniform(4.0, 15.0))
        )
    scene: Scene = getattr(cases, str(kind))(**options)
    return scene


def random_chain(rng: np.random.Generator) -> Scene:
    """One to three rods on revolute joints about random horizontal axes, released at random angles."""
    scene = Scene(name="chain")
    before, end = "ground", np.zeros(3)
    for i in range(int(rng.integers(1, 4))):
        swing, turn = rng.uniform(-0.3, 0.3), rng.uniform(0.0, 2.0 * np.pi)
        length, mass = rng.uniform(1.0, 6.0), 10.0 ** rng.uniform(1.0, 3.0)
        axis = np.array([np.cos(turn), np.sin(turn), 0.0])
        along = length * np.array([-np.sin(swing) * axis[1], np.sin(swing) * axis[0], -np.cos(swing)])
        inertia = mass * length**2 / 12.0
        scene.add_body(
            name=f"rod{i}", mass=mass, inertia=(inertia, inertia, inertia), position=end + along / 2
        )
        scene.add_joint(kind="revolute", name=f"pin{i}", first=before, second=f"rod{i}", point=end, axis=axis)
        before, end = f"rod{i}", end + along
    return scene


def promise(rng: np.random.Generator, *, t_end: float, grid: bool = True) -> Promise:
    """Ask for a random accuracy of a random quantity, and compare with a tight run and, for cost, a grid."""
    scene = random_scene(rng)
    offered = quantities_of(scene, scene.compile(), None)
    quantity = offered[str(rng.choice(list(offered)))]
    span: dict[str, Any] = {"t_end": t_end, "channels": list(quantity.channels)}
    truth = quantity.values(simulate(scene, integrator="verner76", rtol=1e-12, **span))
    size = float(np.abs(truth - truth[0]).max())
    limit = size * 10.0 ** rng.uniform(-7.0, -2.0)
    result = simulate(scene, accuracy={quantity.name: limit}, **span)
    measured = _grid(scene, quantity, truth, span) if grid else [(1, 0.0)]
    cheapest = min(cost for cost, error in measured if error <= limit)
    return Promise(
        what=f"{scene.name} {quantity.name}",
        limit=limit,
        estimate=float(result.stats[f"error_estimate_{quantity.name}"]),
        error=compare(truth, quantity.values(result)).largest,
        cost_of_run=int(result.stats["evaluations"]) / cheapest,
        cost_of_all=int(result.stats["accuracy_evaluations"]) / cheapest,
    )


def _grid(scene: Scene, quantity: Quantity, truth: Any, span: dict[str, Any]) -> list[tuple[int, float]]:
    """Evaluations and error of every grid point."""
    runs = [simulate(scene, integrator=name, **size, **span) for name, size in GRID]
    return [(int(run.stats["evaluations"]), compare(truth, quantity.values(run)).largest) for run in runs]
