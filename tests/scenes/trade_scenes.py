"""Random scenes and what an accuracy promises on them, for the tests of `simulate(accuracy=...)`."""

from __future__ import annotations

import math
from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import numpy as np
from ensemble_studies import pendulum as pendulum

from seacrane import Scene, cases, simulate
from seacrane.accuracy.quantities import Quantity, compare, quantities_of
from seacrane.accuracy.row import Row
from seacrane.accuracy.trade_study import Spending
from seacrane.crane import Payload

GRID: dict[str, list[dict[str, float]]] = {  # each from loose to tight
    "tsit5": [{"rtol": 10.0**-k} for k in range(1, 10)],
    "bs32": [{"rtol": 10.0**-k} for k in range(1, 4)],
    "rk4": [{"dt": step} for step in (0.2, 0.1, 0.05, 0.025)],
    "dopri5": [{"rtol": 10.0**-k} for k in range(1, 10, 2)],
    "verner65": [{"rtol": 10.0**-k} for k in range(1, 10)],
    "verner76": [{"rtol": 10.0**-k} for k in range(2, 11, 2)],
    "dop853": [{"rtol": 10.0**-k} for k in range(2, 11, 2)],
}


# Of what was asked for, promised and found, and the cost over that of the cheapest grid point that passes.
CLAIMS: dict[str, Callable[[SimpleNamespace], bool]] = {
    "error within the limit": lambda p: p.error <= p.limit,
    "error within the estimate": lambda p: p.error <= p.estimate,
    "returned run within twice the cheapest": lambda p: p.cost_of_run <= 2.0,
    "all runs within twice the cheapest": lambda p: p.cost_of_all <= 2.0,
}


def shares(found: list[SimpleNamespace]) -> dict[str, float]:
    """How often each claim holds."""
    return {claim: float(np.mean([holds(p) for p in found])) for claim, holds in CLAIMS.items()}


def summary(found: list[SimpleNamespace]) -> str:
    """Shares and median costs, by decade of the limit over the motion."""
    decades = [math.floor(math.log10(p.part)) for p in found]
    groups = {f"1e{d} to 1e{d + 1}": [p for p, own in zip(found, decades, strict=True) if own == d]
              for d in sorted(set(decades))}  # fmt: skip
    medians = {name: np.median([(p.cost_of_run, p.cost_of_all) for p in group], axis=0)
               for name, group in (groups | {"all": found}).items()}  # fmt: skip
    return "\n".join(f"{name}: {shares(groups.get(name, found))}, costs {medians[name]}" for name in medians)


def random_scene(rng: np.random.Generator) -> Scene:
    """A lift case or the vessel alone in a random sea, with a random payload; or a chain of pendulums."""
    kind = rng.choice(["case1", "case2", "case2", "case3", "vessel", "chain"])
    if kind == "chain":
        return random_chain(rng)
    options = {"hs": float(rng.uniform(0.5, 4.0)), "tp": float(rng.uniform(7.5, 14.0)),
               "wave_direction_deg": float(rng.uniform(0.0, 360.0)), "seed": int(rng.integers(1, 10**6)),
               "memory": str(rng.choice(["per-pair", "by-motion"]))}  # fmt: skip
    if kind == "case2":
        mass, length = float(10.0 ** rng.uniform(3.0, 4.7)), float(rng.uniform(4.0, 15.0))
        options["payload"] = Payload(mass=mass, link_length=length)
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
        name, inertia = f"rod{i}", mass * length**2 / 12.0
        scene.add_body(name, mass=mass, inertia=(inertia,) * 3, position=end + along / 2)
        scene.add_joint(f"pin{i}", kind="revolute", first=before, second=name, point=end, axis=axis)
        before, end = name, end + along
    return scene


def thrown() -> Scene:
    """Two bodies on pins that turn over: the smallest differences grow to all of the motion."""
    scene = pendulum()
    scene.add_body(name="second", mass=2.0, inertia=(0.1, 0.1, 0.1), position=(1.0, 0.0, 1.0))
    scene.add_joint(kind="revolute", name="p2", first="bob", second="second", point=(1, 0, 0), axis=(0, 1, 0))
    return scene


def promise(rng: np.random.Generator, *, t_end: float, grid: bool = True) -> SimpleNamespace:
    """Ask for a random accuracy of a random quantity, and compare with a tight run and, for cost, a grid."""
    scene = random_scene(rng)
    offered = quantities_of(scene, scene.compile(), None)
    quantity = offered[str(rng.choice(list(offered)))]
    span = {"t_end": t_end, "channels": list(quantity.channels)}
    truth = quantity.values(simulate(scene, integrator="verner76", rtol=1e-12, **span))
    size = float(np.abs(truth - truth[0]).max())
    part = 10.0 ** rng.uniform(-7.0, -2.0)
    result = simulate(scene, accuracy={quantity.name: part * size}, **span)
    cheapest = _cheapest(scene, quantity, truth, part * size, span) if grid else math.nan
    return SimpleNamespace(what=f"{scene.name} {quantity.name}", part=part, limit=part * size,
                           estimate=float(result.stats[f"error_estimate_{quantity.name}"]),
                           error=compare(truth, quantity.values(result)).largest,
                           runs=int(result.stats["accuracy_runs"]),
                           cost_of_run=int(result.stats["evaluations"]) / cheapest,
                           cost_of_all=int(result.stats["accuracy_evaluations"]) / cheapest)  # fmt: skip


def _cheapest(scene: Scene, quantity: Quantity, truth: Any, limit: float, span: dict[str, Any]) -> float:
    """Evaluations of the cheapest grid point within the limit: of each method the loosest that passes."""
    least = math.inf
    for name, sizes in GRID.items():
        for size in sizes:
            run = simulate(scene, integrator=name, **size, **span)
            cost = int(run.stats["evaluations"])
            if cost >= least:
                break
            if compare(truth, quantity.values(run)).largest <= limit:
                least = cost
                break
    return least


def a_run_each(spending: Spending, row: Row, around_s: float = 0.0) -> None:
    """Every row counts as one run: what a budget has room for does not depend on the machine."""
    spending.spent_s += spending.unit_s
