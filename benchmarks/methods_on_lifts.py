"""Errors and costs of methods on random lifts: what to take, and what `accuracy=` costs.

    python benchmarks/methods_on_lifts.py [--lifts 300] [--promises 200] [--publish]

Lifts are ships and chains of pendulums over 40 s, hoists with kinks, stops and oil over 8 s, and lifts in
stages, in turns. Writes to out/methods, with --publish to benchmarks/results:

- methods-on-lifts.csv: of each setting the share of lifts with every error within 0.1 % of its quantity's
  range, and evaluations over those of the default, by kind; the first third chooses, the others judge.
- take-this.csv: of each kind the cheapest setting that holds in the first third and in the others, beside the
  default.
- cost-of-accuracy.csv: what `simulate(accuracy=...)` costs over the cheapest of a grid of settings.
"""

from __future__ import annotations

import argparse
import sys
import warnings
from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from measure.section import significant
from measure.table import write

ROOT = Path(__file__).resolve().parents[1]
sys.path.extend(map(str, [ROOT / "tests", *(ROOT / "tests").glob("*/")]))

from accuracy_scenes import scene_of  # noqa: E402
from staged_accuracy import lift_of  # noqa: E402
from trade_scenes import CLAIMS, promise, random_scene  # noqa: E402

from seacrane import Result, Scene, SeacraneError, simulate, simulate_stages  # noqa: E402
from seacrane.accuracy.matching import curve_apart, matched  # noqa: E402
from seacrane.accuracy.quantities import Quantity, quantities_of  # noqa: E402
from seacrane.description.loads import any_stiff, lines_of  # noqa: E402
from seacrane.run.method import Method  # noqa: E402

KINDS = ("ship or chain", "hoist", "oil", "stages")
SETTINGS = {
    "bs32": (2, 3),
    "tsit5": (2, 2.5, 3, 3.5, 4, 4.5, 5, 6),
    "dopri5": (2, 3, 4, 5, 6, 7),
    "verner65": (3, 4, 5, 6),
    "verner76": (3, 4, 5, 6, 7, 8),
    "dopri5-stiff": (2, 3, 4, 5, 6),
    "cvode-bdf": (4, 5, 6),
}
FOR_OIL = ("dopri5-stiff", "cvode-bdf")
DEFAULT = (Method().integrator, Method().used_rtol)
WITHIN = 1e-3  # of the range
SHARE = 0.99
SURE = 1e-5  # of the range, within which two references agree
SEED = 2035


@dataclass(frozen=True, kw_only=True)
class Row:
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
        rng = np.random.default_rng([SEED, number])
        stages: Sequence[Any] = ()
        if number % 3 == 0:
            kind, scene = KINDS[0], random_scene(rng)
        elif number % 3 == 1:
            scene, _ = scene_of(number // 3, seed=SEED)
            kind = KINDS[2] if any_stiff(scene.loads) else KINDS[1]
        else:
            kind, (scene, stages) = KINDS[3], lift_of(number // 3 + 1000)
        names = (
            None if kind == KINDS[0] else ["position", *(["line_tension"] if lines_of(scene.loads) else [])]
        )
        measured = quantities_of(scene, scene.compile() if not stages else None, names)
        return cls(kind=kind, scene=scene, quantities=measured, stages=stages)

    def run(self, integrator: str, rtol: float) -> Result:
        how: dict[str, Any] = {"integrator": integrator, "rtol": rtol}
        if self.stages:
            return simulate_stages(self.scene, self.stages, dt_out=0.2, **how)
        return simulate(self.scene, 40.0 if self.kind == KINDS[0] else 8.0, dt_out=0.1, **how)

    def errors(self, truth: Result, found: Result) -> dict[str, float]:
        matching = matched(found, truth)
        return {
            name: curve_apart(found.time, one.values(found), truth.time, one.values(truth), matching)
            for name, one in self.quantities.items()
        }


def rows_of(number: int) -> Iterator[Row]:
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
        if integrator in FOR_OIL and lift.kind != "oil":
            continue
        for decade in decades:
            about: dict[str, Any] = {
                "lift": number, "kind": lift.kind, "integrator": integrator, "rtol": 10.0**-decade
            }  # fmt: skip
            try:
                found = lift.run(integrator, 10.0**-decade)
            except SeacraneError:
                yield Row(**about, evaluations=0, of_range=np.inf)
                continue
            errors = lift.errors(truth, found)
            yield Row(
                **about, evaluations=int(found.stats["evaluations"]),
                of_range=max(e / ranges[n] for n, e in errors.items()),
            )  # fmt: skip


def table(rows: Sequence[Row], count: int) -> list[list[str]]:
    """Of each setting share within and cost, by kind, where a third chose and the others judge."""
    usual = {row.lift: row.evaluations for row in rows if (row.integrator, row.rtol) == DEFAULT}
    out = []
    for kind in (*KINDS, "all"):
        groups: dict[tuple[str, float], list[Row]] = defaultdict(list)
        for row in rows:
            if (
                kind in (row.kind, "all")
                and row.lift in usual
                and not (kind == "all" and row.integrator in FOR_OIL)
            ):
                groups[row.integrator, row.rtol].append(row)
        lines = []
        for (integrator, rtol), own in groups.items():
            first = [row.of_range <= WITHIN for row in own if row.lift < count // 3]
            others = [row.of_range <= WITHIN for row in own if row.lift >= count // 3]
            costs = [row.evaluations / usual[row.lift] for row in own if row.evaluations]
            cost = float(np.exp(np.mean(np.log(costs))))
            lines.append((cost, integrator, rtol, float(np.mean(first)), float(np.mean(others)), len(own)))
        for cost, integrator, rtol, chosen, judged, lifts in sorted(lines):
            out.append([
                kind, f"`{integrator}`", f"{rtol:.2g}", str(lifts), f"{100 * chosen:.0f} %",
                f"{100 * judged:.1f} %", significant(cost),
            ])  # fmt: skip
    return out


def taken(lines: Sequence[Sequence[str]]) -> list[list[str]]:
    """Of each kind the cheapest setting that holds in the first third and in the others, and the default.

    Without implicit methods, whose evaluations count no Jacobians: `cvode-bdf` takes as long as the default.
    """
    usual = [f"`{DEFAULT[0]}`", f"{DEFAULT[1]:.2g}"]
    out = []
    for kind in (*KINDS, "all"):
        own = [list(line) for line in lines if line[0] == kind]
        shares = [[float(line[i].rstrip(" %")) for i in (4, 5)] for line in own]
        good = [line for line, held in zip(own, shares, strict=True) if min(held) >= 100.0 * SHARE]
        good = [line for line in good if line[1] != "`cvode-bdf`"]
        found = [min(good, key=lambda line: float(line[6])), *(line for line in own if line[1:3] == usual)]
        out += [list(line) for line in dict.fromkeys(map(tuple, found))]
    return out


def cost_table(count: int) -> list[list[str]]:
    """What accuracies cost and promise on random scenes, by decade of the limit over the motion."""
    rng = np.random.default_rng(SEED)
    found = [promise(rng, t_end=40.0) for _ in range(count)]
    groups = {"all": found}
    for decade in range(-7, -2):
        low, high = 10.0**decade, 10.0 ** (decade + 1)
        groups[f"1e{decade} to 1e{decade + 1}"] = [p for p in found if low <= p.part < high]
    out = []
    for name, group in groups.items():
        held = [f"{100 * np.mean([holds(p) for p in group]):.1f} %" for holds in CLAIMS.values()]
        costs = [p.cost_of_run for p in group], [p.cost_of_all for p in group]
        told = [significant(float(np.quantile(one, q))) for one in costs for q in (0.5, 0.95)]
        out.append([name, str(len(group)), *held, *told])
    return out


def save(lines: Sequence[Sequence[str]], folder: Path) -> None:
    """The table, and what to take of it."""
    head = ["lifts", "integrator", "`rtol`", "number", "within, first third", "within, others", "evaluations"]
    write(folder / "methods-on-lifts.csv", head, lines)
    write(folder / "take-this.csv", head, taken(lines))


def main() -> None:
    """Measure, print, write."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--lifts", type=int, default=300, help="of which a third chooses")
    parser.add_argument("--promises", type=int, default=200, help="random scenes of what accuracies cost")
    parser.add_argument(
        "--publish", action="store_true", help="write what the package and the documents read"
    )
    options = parser.parse_args()
    folder = ROOT / ("benchmarks/results" if options.publish else "out/methods")
    warnings.simplefilter("ignore")
    if options.lifts:
        rows: list[Row] = []
        for number in range(options.lifts):
            rows += rows_of(number)
            print(f"lift {number}", end="\r", flush=True)
        save(table(rows, options.lifts), folder)
    if options.promises:
        head = [
            "limit over motion",
            "scenes",
            *CLAIMS,
            "run, median",
            "run, 95 %",
            "all runs, median",
            "all, 95 %",
        ]
        write(folder / "cost-of-accuracy.csv", head, cost_table(options.promises))


if __name__ == "__main__":
    main()
