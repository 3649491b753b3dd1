"""What `accuracy=` costs and promises, and which setting to take without it: random lifts, each judged."""

from __future__ import annotations

import sys
import warnings
from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from seacrane import Result, Scene, SeacraneError, simulate
from seacrane.accuracy.asked import curve_apart, matched
from seacrane.accuracy.quantities import Quantity, quantities_of
from seacrane.description.loads import any_stiff, lines_of
from seacrane.run.method import Method

from .section import Section
from .sources import CRANE

ROOT = Path(__file__).resolve().parents[2]
sys.path.extend(map(str, [ROOT / "tests", *sorted((ROOT / "tests").glob("*/"))]))

KINDS = ("ship or chain", "hoist", "oil", "stages")
SETTINGS = {
    "tsit5": (2, 3, 3.5, 4, 4.5, 5),
    "dopri5": (3, 4, 5, 6),
    "verner65": (4, 5, 6),
    "verner76": (4, 5, 6, 7),
    "dopri5-stiff": (3, 4, 5),
}
DEFAULT = (Method().integrator, Method().used_rtol)
LIFTS, SCENES, STAGED = 120, 120, 120
WITHIN, SHARE = 1e-3, 0.99  # of the range; of the lifts
SURE = 1e-5  # of the range, within which two references agree
SEED = 2035


@dataclass(frozen=True, kw_only=True)
class Tried:
    """A setting on a lift: the largest error over the range of its quantity; infinite where it fails."""

    lift: int
    kind: str
    integrator: str
    rtol: float
    evaluations: int
    of_range: float


@dataclass(frozen=True, kw_only=True)
class Lift:
    """What is run, and what is measured of it."""

    kind: str
    scene: Scene
    quantities: dict[str, Quantity]
    stages: Sequence[Any] = ()

    @classmethod
    def of(cls, number: int) -> Lift:
        """Ships and chains, hoists and oil, and lifts in stages, in turns."""
        from accuracy_scenes import scene_of
        from staged_accuracy import lift_of
        from trade_scenes import random_scene

        rng = np.random.default_rng([SEED, number])
        stages: Sequence[Any] = ()
        if number % 3 == 0:
            kind, scene = KINDS[0], random_scene(rng)
        elif number % 3 == 1:
            scene, _ = scene_of(number // 3, seed=SEED)
            kind = KINDS[2] if any_stiff(scene.loads) else KINDS[1]
        else:
            kind, (scene, stages) = KINDS[3], lift_of(number // 3 + 1000)
        names = ["position", *(["line_tension"] if lines_of(scene.loads) else [])]
        measured = quantities_of(
            scene, scene.compile() if not stages else None, None if kind == KINDS[0] else names
        )
        return cls(kind=kind, scene=scene, quantities=measured, stages=stages)

    def run(self, integrator: str, rtol: float) -> Result:
        how: dict[str, Any] = {"integrator": integrator, "rtol": rtol}
        if self.stages:
            return simulate(self.scene, self.stages, dt_out=0.2, **how)
        return simulate(self.scene, 40.0 if self.kind == KINDS[0] else 8.0, dt_out=0.1, **how)

    def errors(self, truth: Result, found: Result) -> dict[str, float]:
        matching = matched(found, truth)
        return {
            name: curve_apart(found.time, one.values(found), truth.time, one.values(truth), matching)
            for name, one in self.quantities.items()
        }


def _tried(number: int) -> Iterator[Tried]:
    """Every setting on one lift; none where references differ."""
    lift = Lift.of(number)
    try:
        truth, judge = (lift.run(name, 1e-10) for name in ("verner76", "dop853"))
    except SeacraneError:
        return
    ranges = {name: max(one.motion(truth), 1e-6) for name, one in lift.quantities.items()}
    if max(e / ranges[n] for n, e in lift.errors(truth, judge).items()) > SURE:
        return
    for integrator, decades in SETTINGS.items():
        if integrator == "dopri5-stiff" and lift.kind != "oil":
            continue
        for decade in decades:
            about: dict[str, Any] = {
                "lift": number, "kind": lift.kind, "integrator": integrator, "rtol": 10.0**-decade
            }  # fmt: skip
            try:
                found = lift.run(integrator, 10.0**-decade)
            except SeacraneError:
                yield Tried(**about, evaluations=0, of_range=np.inf)
                continue
            worst = max(e / ranges[n] for n, e in lift.errors(truth, found).items())
            yield Tried(**about, evaluations=int(found.stats["evaluations"]), of_range=worst)


def take_this() -> Iterator[list[Any]]:
    """Of each kind the cheapest setting that holds in the first third and in the others, and the default."""
    warnings.simplefilter("ignore")
    every = [one for number in range(LIFTS) for one in _tried(number)]
    usual = {one.lift: one.evaluations for one in every if (one.integrator, one.rtol) == DEFAULT}
    for kind in (*KINDS, "all"):
        groups: dict[tuple[str, float], list[Tried]] = defaultdict(list)
        for one in every:
            if kind in (one.kind, "all") and not (kind == "all" and one.integrator == "dopri5-stiff"):
                groups[one.integrator, one.rtol].append(one)
        rows = {setting: _judged(own, usual) for setting, own in groups.items()}
        if DEFAULT not in rows:
            continue
        good = [setting for setting, (first, others, _) in rows.items() if min(first, others) >= SHARE]
        best = min(good, key=lambda setting: rows[setting][2], default=DEFAULT)
        for setting in dict.fromkeys((best, DEFAULT)):
            first, others, cost = rows[setting]
            yield [kind, f"`{setting[0]}`", f"{setting[1]:.2g}", len(groups[setting]),
                   f"{100 * first:.0f} %", f"{100 * others:.1f} %", cost]  # fmt: skip


def _judged(own: Sequence[Tried], usual: dict[int, int]) -> tuple[float, float, float]:
    """Shares within, of the first third of lifts and of the others; evaluations over those of the default."""
    first = [one.of_range <= WITHIN for one in own if one.lift < LIFTS // 3]
    others = [one.of_range <= WITHIN for one in own if one.lift >= LIFTS // 3]
    costs = [one.evaluations / usual[one.lift] for one in own if one.evaluations]
    return float(np.mean(first)), float(np.mean(others)), float(np.exp(np.mean(np.log(costs))))


def cost_of_accuracy() -> Iterator[list[Any]]:
    """What accuracies cost and promise on random scenes, by decade of the limit over the motion."""
    from trade_scenes import promise

    warnings.simplefilter("ignore")
    rng = np.random.default_rng(SEED)
    found = [promise(rng, t_end=40.0) for _ in range(SCENES)]
    groups = {"all": found}
    for decade in range(-7, -2):
        low, high = 10.0**decade, 10.0 ** (decade + 1)
        groups[f"1e{decade} to 1e{decade + 1}"] = [p for p in found if low <= p.part < high]
    for name, group in ((name, group) for name, group in groups.items() if group):
        held = [f"{100 * np.mean([holds(p) for p in group]):.1f} %" for holds in _claims().values()]
        costs = [p.cost_of_run for p in group], [p.cost_of_all for p in group]
        yield [name, len(group), *held, *(float(np.quantile(one, q)) for one in costs for q in (0.5, 0.95))]


def _claims() -> dict[str, Any]:
    from trade_scenes import CLAIMS

    return dict(CLAIMS)


def staged() -> list[list[str]]:
    """What an accuracy promises of lifts in stages, judged by two other methods."""
    from staged_accuracy import table, word

    return table([word(number) for number in range(STAGED)])[1:]


TAKE_THIS = Section(
    title="Which setting to take",
    name="take-this",
    text=(
        f"{LIFTS} random lifts: ships and chains of pendulums over 40 s, hoists with kinks, stops and oil "
        "over 8 s, lifts in stages. Of each kind the cheapest setting with every error within 0.1 % of its "
        "quantity's range in 99 % of the first third, which chooses, and of the others, which judge, beside "
        "the default; evaluations over those of the default. Implicit methods, whose evaluations count no "
        "Jacobians, were not tried."
    ),
    head=["lifts", "integrator", "`rtol`", "number", "within, first third", "within, others", "evaluations"],
    rows=take_this,
    sources=(*CRANE, "cpp/seacrane/elements/loads", "tests/scenes/*_scenes.py"),
)
COST = Section(
    title="Cost of accuracy",
    text=(
        f"`simulate(accuracy=...)` on {SCENES} random ships, cranes and chains over 40 s, judged by "
        "`verner76` at 1e-12: whether the error held, and evaluations over those of the cheapest of a grid "
        "of settings that holds, by the limit over the motion."
    ),
    head=["limit over motion", "scenes", "error within the limit", "error within the estimate",
          "returned run within twice the cheapest", "all runs within twice the cheapest", "run, median",
          "run, 95 %", "all runs, median", "all, 95 %"],
    rows=cost_of_accuracy,
    sources=(*CRANE, "python/seacrane/accuracy", "python/seacrane/data/expected_errors.json"),
)  # fmt: skip
OF_STAGES = Section(
    title="Accuracy of staged lifts",
    text=(
        f"`simulate(scene, stages, accuracy=...)` on {STAGED} random lifts: through the water and onto the "
        "bed, off a seat by a slack wire, swinging, welded as two bodies meet, from a ship that heaves. Each "
        "is judged by two other methods at tighter tolerances; not judgeable where these are a tenth of the "
        "limit apart. `make campaign NAME=stages` judges 400."
    ),
    head=["lifts", "number", "held", "beyond", "refused", "not judgeable", "above their estimate",
          "of another course", "all runs over the returned one"],
    rows=staged,
    sources=(*CRANE, "cpp/seacrane/elements/loads", "python/seacrane/accuracy",
             "tests/scenes/staged_accuracy.py"),
)  # fmt: skip
