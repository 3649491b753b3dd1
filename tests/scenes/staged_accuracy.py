"""Random lifts in stages, and what an accuracy promises of each, judged by two other methods.

As a program: python tests/scenes/staged_accuracy.py [COUNT [FIRST [TABLE.csv]]].
"""

from __future__ import annotations

import csv
import sys
import warnings
from collections.abc import Callable, Sequence
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
from accuracy_scenes import AGREED, ENDS, said, told
from random_staged_lifts import hanging, random_stages
from stage_scenes import heaving, hoisting, lift_off, meeting, on_deck, swinging

from seacrane import Result, Scene, SeacraneError, Stage, Until, simulate
from seacrane.accuracy.asked import curve_apart, extremes_apart, matched
from seacrane.accuracy.quantities import quantities_of

SEED = 2033
CURVES = ("position", "line_tension")
ASKED = (*CURVES, "line_tension.max", "position.min", "event_times")
OTHERS = ("dop853", "verner65", "verner76")  # judges, the first two that the run did not take
DT_OUT = 0.2  # s

Lift = tuple[Scene, list[Stage]]


def in_water(rng: np.random.Generator) -> Lift:
    """Up and down through the water, onto the bed and off."""
    return hanging(), random_stages(int(rng.integers(10**6)))


def off_deck(rng: np.random.Generator) -> Lift:
    """A slack wire hauls in until it snaps taut and lifts the load off its seat."""
    scene = on_deck(length=float(rng.uniform(20.02, 20.2)), damping_ratio=float(rng.uniform(0.05, 0.3)))
    stages = lift_off()
    haul = {"hoist.rate": -float(rng.uniform(0.05, 0.5))}
    stages[1] = Stage(name="lift off", until=Until.release("on deck"), maximum_duration=60.0, commands=haul)
    return scene, stages[: int(rng.integers(3, 6))]


def swung(rng: np.random.Generator) -> Lift:
    """A load that swings on its winch, and stops on its way up and down."""
    scene = swinging()
    scene.replace("load", velocity=(float(rng.uniform(-1.0, 1.0)), float(rng.uniform(-1.0, 1.0)), 0.0))
    return scene, hoisting()


def met(rng: np.random.Generator) -> Lift:
    """Two bodies that are welded as they meet, and held by a wire from then on."""
    after = float(rng.uniform(0.2, 1.0))
    scene = meeting(velocity=float(rng.uniform(0.2, 1.0)), after=after)
    scene.add_line("tether", first="ground", first_point=(0, 0, 1.5), second="hook",
                   EA=float(10.0 ** rng.uniform(1.5, 3.0)), length=float(rng.uniform(1.4, 1.6)),
                   damping_ratio=0.1)  # fmt: skip
    return scene, [Stage(name="apart", duration=after), Stage(name="one", duration=3.0,
                                                              connect=["shackle", "tether"])]  # fmt: skip


def from_a_ship(rng: np.random.Generator) -> Lift:
    """Hoisted and lowered from a ship that heaves; in high seas the wire goes slack."""
    scene = heaving(float(rng.uniform(0.5, 4.0)), duration=150.0)
    rate = float(rng.uniform(0.1, 0.5))
    return scene, [
        Stage(name="hold", duration=float(rng.uniform(2.0, 8.0))),
        Stage(name="up", until=Until.length("wire", maximum=16.0), maximum_duration=60.0,
              commands={"wire.rate": -rate}),
        Stage(name="down", until=Until.length("wire", minimum=19.0), maximum_duration=60.0,
              commands={"wire.rate": rate}),
    ]  # fmt: skip


KINDS: tuple[Callable[[np.random.Generator], Lift], ...] = (in_water, off_deck, swung, met, from_a_ship)


def lift_of(number: int) -> Lift:
    return KINDS[number % len(KINDS)](np.random.default_rng([SEED, number]))


def word(number: int) -> SimpleNamespace:
    """What `accuracy=` promises on one lift, judged by two other methods at tighter tolerances."""
    with warnings.catch_warnings(action="ignore"):
        return _word(number)


def _word(number: int) -> SimpleNamespace:
    rng = np.random.default_rng([SEED, 1, number])
    quantity = ASKED[int(rng.integers(len(ASKED)))]
    part = float(10.0 ** rng.uniform(-4.5, -2.0))
    scene, stages = lift_of(number)
    rough = simulate(scene, stages, dt_out=DT_OUT, integrator="verner76", rtol=1e-06)
    limit = part * _size(scene, quantity, rough)
    kind = KINDS[number % len(KINDS)].__name__
    about: dict[str, Any] = {"number": number, "kind": kind, "quantity": quantity, "limit": limit}
    about |= {"other_course": False, "cost": 0.0}
    try:
        found = simulate(scene, stages, dt_out=DT_OUT, accuracy={quantity: limit})
    except SeacraneError as refused:
        return said(**about, end="refused", why=str(refused))
    stats = found.stats
    about |= {"told": float(stats[f"error_estimate_{quantity}"]), "other_course": "accuracy_course" in stats}
    about["cost"] = float(stats["accuracy_evaluations"]) / float(stats["evaluations"])  # of all runs
    one, other = _judges(scene, stages, found)
    extremes = bool(about["other_course"])
    apart = distance(scene, quantity, other, one, extremes=extremes)
    if apart > AGREED * limit or (matched(other, one).course and quantity in CURVES and not extremes):
        return said(**about, end="not judgeable", why=f"judges are {apart:.3g} apart")
    error = distance(scene, quantity, found, other, extremes=extremes)
    return said(**about, end="held" if error <= limit else "beyond", error=error)


def _judges(scene: Scene, stages: list[Stage], found: Result) -> tuple[Result, Result]:
    rtol = float(found.settings["rtol"])
    names = [name for name in OTHERS if name != found.stats["integrator"]]
    one, other = (simulate(scene, stages, dt_out=DT_OUT, integrator=name, rtol=min(part * rtol, most))
                  for name, part, most in zip(names, (0.1, 0.01), (1e-7, 1e-8), strict=False))  # fmt: skip
    return one, other


def _size(scene: Scene, quantity: str, result: Result) -> float:
    """Of its motion; of times 10 s."""
    measured = None if quantity == "event_times" else quantities_of(scene, None, [quantity])[quantity]
    return max(measured.motion(result), 0.01) if measured else 10.0


def distance(scene: Scene, quantity: str, one: Result, other: Result, *, extremes: bool) -> float:
    """By the definition of docs/trade.md; `extremes`: of a curve these alone."""
    matching = matched(one, other)
    if quantity == "event_times":
        return matching.shift
    measured = quantities_of(scene, None, [quantity])[quantity]
    mine, its = measured.values(one), measured.values(other)
    if quantity not in CURVES:
        return float(np.abs(mine - its).max())
    if extremes:
        return extremes_apart(mine, its)
    return curve_apart(one.time, mine, other.time, its, matching)


def table(words: Sequence[SimpleNamespace]) -> list[list[str]]:
    """Counts by kind of lift."""
    out = [["lifts", "number", *ENDS, "above their estimate", "of another course",
            "all runs over the returned one"]]  # fmt: skip
    for kind in (*(one.__name__.replace("_", " ") for one in KINDS), "all"):
        own = [one for one in words if kind in (one.kind.replace("_", " "), "all")]
        counts = [sum(one.end == end for one in own) for end in ENDS]
        low = sum(one.error > one.told for one in own if one.end in ("held", "beyond"))
        cost = float(np.median([one.cost for one in own if one.cost] or [0.0]))
        courses = sum(one.other_course for one in own)
        out.append([kind, *map(str, (len(own), *counts, low, courses)), f"{cost:.2f}"])
    return out


def main(count: int = 400, first: int = 0, file: str = "out/accuracy-of-staged-lifts.csv") -> int:
    """Judge so many and write the table; the exit status is 1 where more than 1 % are beyond."""
    words = []
    for number in range(first, first + count):
        words.append(word(number))
        if words[-1].end != "held":
            print(told(words[-1:]).splitlines()[-1], flush=True)
        if len(words) % 20 == 0 or len(words) == count:
            Path(file).parent.mkdir(parents=True, exist_ok=True)
            with Path(file).open("w", newline="", encoding="utf-8") as target:
                csv.writer(target, lineterminator="\n").writerows(table(words))
    print(told(words))
    return int(sum(one.end == "beyond" for one in words) > 0.01 * count)


if __name__ == "__main__":
    sys.exit(main(*(int(text) for text in sys.argv[1:3]), *sys.argv[3:]))
