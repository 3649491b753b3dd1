"""This engine against an older build of it, in runs that take turns.

    python benchmarks/against.py --other /path/to/older/package --label 0.1.0 [--publish]

`--other` is what PYTHONPATH has to be for `import seacrane` to find the older one. Each turn measures one of
the two in a process of its own, in CPU time of its thread. The best of all turns counts, so that other work
on the machine matters least. Prints the table; with `--publish` it is written to `benchmarks/results`.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
CASES = ("case1", "case2", "case3")
QUICK = {"integrator": "tsit5", "rtol": 1e-2, "formulation": "recursive"}
TIGHT = {"integrator": "dopri5", "rtol": 1e-6, "formulation": "recursive"}
T_END = 100.0  # s


def measured() -> dict[str, float]:
    """Of the package that is found here: ns of evaluations, ms of runs of case 2, us of an output."""
    from measure.timing import evaluation_ns, timed_run

    from seacrane import cases

    out: dict[str, float] = {}
    for name in CASES:
        model = getattr(cases, name)().compile()
        for formulation in ("recursive", "redundant"):
            key = f"one evaluation of {name}, {formulation}, ns"
            out[key] = evaluation_ns(model, repeats=8, count=2_000, formulation=formulation)
    scene = cases.case2()
    model = scene.compile()

    def run(dt_out: float, channels: list[str] | None, settings: dict[str, Any]) -> float:
        done = timed_run(
            scene, model=model, repeats=3, t_end=T_END, dt_out=dt_out, channels=channels, **settings
        )
        return 1e3 * done.cpu

    out["100 s of case 2, tsit5 1e-2, `position` every 1 s, ms"] = run(1.0, ["position"], QUICK)
    out["100 s of case 2, dopri5 1e-6, all channels every 0.1 s, ms"] = run(0.1, None, TIGHT)
    few, many = (run(dt, ["position"], QUICK) for dt in (T_END, 0.02))
    out["one output of `position`, us"] = 1e3 * (many - few) / (T_END / 0.02 - 1)
    return out


def turn(package: str) -> dict[str, float]:
    """One measurement of a package in a process of its own."""
    path = os.pathsep.join([package, str(HERE)])
    env = os.environ | {"PYTHONPATH": path, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    done = subprocess.run(
        [sys.executable, __file__, "--measure"], env=env, capture_output=True, text=True, check=True
    )
    return dict(json.loads(done.stdout))


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--measure", action="store_true", help="print what this package takes, for a turn")
    parser.add_argument("--other", help="PYTHONPATH of the older package")
    parser.add_argument("--here", default=str(HERE.parent / "python"), help="PYTHONPATH of this one")
    parser.add_argument("--label", default="before", help="what the older one is called")
    parser.add_argument("--turns", type=int, default=7)
    parser.add_argument("--publish", action="store_true", help="write into benchmarks/results")
    options = parser.parse_args()
    if options.measure:
        print(json.dumps(measured()))
        return 0
    if options.other is None:
        parser.error("give --other, the PYTHONPATH of the older package")
    best: dict[str, dict[str, float]] = {}
    for _ in range(options.turns):
        for package in (options.other, options.here):
            kept = best.setdefault(package, {})
            for name, value in turn(package).items():
                kept[name] = min(value, kept.get(name, value))
    from measure.section import Section

    before, now = best[options.other], best[options.here]
    section = Section(
        title="Against an older engine",
        text=f"CPU time, best of {options.turns} turns of each.",
        head=["what", options.label, "now", "times faster"],
        rows=[[name, before[name], now[name], before[name] / now[name]] for name in now],
    )
    print(section.markdown())
    if options.publish:
        section.save(HERE / "results")
    return 0


if __name__ == "__main__":
    sys.exit(main())
