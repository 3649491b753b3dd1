"""Whether ensembles that stop when it is enough cover the truth, and what control variates save.

``python benchmarks/measure/certainty.py [--publish] [--only PART]`` writes ``until-enough.csv`` and
``control-variates.csv`` to ``out/bench/results``; with ``--publish`` to ``benchmarks/results``.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "benchmarks"))

from measure.table import write  # noqa: E402
from seacrane import Kept, Scene, ensemble  # noqa: E402
from seacrane.crane import Payload  # noqa: E402
from seacrane.ensembles import HookLoadControl, LinearControl  # noqa: E402
from seacrane.ensembles.growing import BATCH  # noqa: E402
from seacrane.ensembles.targets import WIDENED, Target  # noqa: E402
from seacrane.hydro import shipped_database  # noqa: E402
from seacrane.statistics import controlled_mean  # noqa: E402
from seacrane.statistics.estimate import P90_REDUCED  # noqa: E402

ENSEMBLES, MOST = 2000, 2000
GROWING = (
    ("mpm", 0.05, 0.02), ("mpm", 0.07, 0.02), ("mpm", 0.15, 0.02), ("mpm", 0.15, 0.05), ("mpm", 0.3, 0.05),
    ("mean", 0.07, 0.02), ("p90", 0.07, 0.02),
)  # fmt: skip
SEEDS, CONTROLS, T_END, START = 60, 5000, 300.0, 30.0
HEIGHTS = (0.5, 1.5, 3.0)
CONTROLLED: tuple[tuple[str, str, dict[str, str], str, str | None], ...] = (
    ("swing", "position", {"body": "payload", "axis": "y"}, "motion", "position[payload, y]"),
    ("hook_load", "hook_load", {"suspension": "link"}, "acceleration", "acceleration[payload, z]"),
    ("hook_load", "hook_load", {"suspension": "link"}, "hook load", None),
)
TRUTH = {"mpm": 0.0, "mean": float(np.euler_gamma), "p90": P90_REDUCED}


def until_enough() -> Iterator[tuple[str, ...]]:
    """Coverage of stopped ensembles of Gumbel maxima, with the intervals as they are and widened."""
    for number, scale, asked in GROWING:
        cells = [number, f"{scale:g}", f"{100.0 * asked:g}"]
        truth = 1.0 + scale * TRUTH[number]
        for widened in (1.0, WIDENED):
            random, inside, seeds = np.random.default_rng(7), [], []
            target = Target(variable="x", number=number, half_width=asked, gumbel=True)
            for _ in range(ENSEMBLES):
                maxima = random.gumbel(1.0, scale, MOST)
                for count in range(BATCH, MOST + 1, BATCH):
                    found = target.estimate(maxima[:count])
                    half = found.half_width * widened / WIDENED
                    if half <= asked * found.value:
                        break
                middle = 0.5 * (found.high + found.low)
                inside.append(abs(truth - middle) <= half)
                seeds.append(count)
            cells += [f"{100.0 * np.mean(inside):.1f}", f"{np.mean(seeds):.0f}"]
        yield tuple(cells)


def lift() -> Scene:
    """A load of 20 t that a crane holds over the side."""
    scene = Scene(name="over the side")
    scene.add_vessel(shipped_database(), memory="passive")
    scene.add_sea(hs=1.0, tp=8.0, direction_deg=150.0)
    payload = Payload(mass=2e4, link_length=8.0)
    scene.add_crane(foot=(33.0, 10.0, 10.0), slew=-1.0, s1=1.0, s2=1.5, payload=payload, held=True)
    scene.add_ballast(heel_deg=0.0)
    return scene


def control_variates() -> Iterator[tuple[str, ...]]:
    """Means of largest values of runs, plain and with the linear response to the same waves."""
    scene = lift()
    keep = {
        name: Kept(channel=channel, what="maximum", names=at, after=START)
        for name, channel, at, *_ in CONTROLLED
    }
    seeds = range(1, SEEDS + 1)
    runs = {
        hs: ensemble(
            scene, over={"seed": seeds, "hs": [hs]}, keep=keep, t_end=T_END, rtol=1e-3,
            dt_out=0.5, integrator="tsit5",
        ).dataset.sel(hs=hs)
        for hs in HEIGHTS
    }  # fmt: skip
    given: dict[str, Any] = {"t_end": T_END, "after": START, "dt_out": 0.5}
    for name, _, _, words, motion in CONTROLLED:
        for hs in HEIGHTS:
            control: LinearControl | HookLoadControl
            if motion is None:
                control = HookLoadControl(scene, words={"hs": hs}, **given)
            else:
                control = LinearControl(scene, motion, words={"hs": hs}, **given)
            begin = time.process_time()
            many = control.extremes(range(1_000_001, 1_000_001 + CONTROLS))
            cost = 1e3 * (time.process_time() - begin) / CONTROLS
            own = control.extremes(seeds)
            found = controlled_mean(runs[hs][name], controls=own, many_controls=many)
            yield (
                name, words, f"{hs:g}", str(found.seeds), str(found.controls), f"{found.correlation:.2f}",
                f"{found.largest_gain:.1f}", f"{found.gain:.1f}" if found.used else "off",
                f"{found.plain.half_width:.3g}", f"{found.estimate.half_width:.3g}", f"{cost:.1f}",
            )  # fmt: skip


def main() -> None:
    """Write the tables."""
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--publish", action="store_true")
    arguments.add_argument("--only", choices=PARTS)
    chosen = arguments.parse_args()
    folder = ROOT / "benchmarks" / "results" if chosen.publish else ROOT / "out" / "bench" / "results"
    for name, (head, rows) in PARTS.items():
        if chosen.only in (None, name):
            write(folder / f"{name}.csv", head, list(rows()))


PARTS = {
    "until-enough": (
        ("number", "scatter", "asked, %", "covered, %", "seeds", "widened: covered, %", "widened: seeds"),
        until_enough,
    ),
    "control-variates": (
        (
            "largest", "control", "Hs, m", "seeds", "controls", "correlation", "1 / (1 - rho^2)", "gain",
            "plain +-", "controlled +-", "a control, ms",
        ),
        control_variates,
    ),
}  # fmt: skip


if __name__ == "__main__":
    main()
