"""This engine against an older build of it, in runs that take turns.

    python benchmarks/against.py --other /path/to/older/package --label 0.1.0 [--publish]

`--other` is what PYTHONPATH has to be for `import seacrane` to find the older one, its compiled module
included. Each turn measures one of the two in a process of its own, in CPU time of its thread. The best of
all turns counts, so that other work on the machine matters least. Prints the table; with `--publish` it is
written to `benchmarks/results`.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
CASES = ("case1", "case2", "case3")
QUICK = {"integrator": "tsit5", "rtol": 1e-2, "formulation": "recursive"}
TIGHT = {"integrator": "dopri5", "rtol": 1e-6, "formulation": "recursive"}
T_END = 100.0  # s
DENSE = 0.02  # s between outputs, to see what one costs
EVALUATIONS, STEP = 2_000, 25e-3  # s, between evaluations, as on average in a run of case 2


def measured() -> dict[str, float]:
    """Of the package that is found here: ns of evaluations, ms of runs of case 2, us of an output.

    It calls what every version has: `cases`, `Scene.compile`, `Evaluator` and `Run`.
    """
    from seacrane import cases

    out: dict[str, float] = {}
    for name in CASES:
        model = getattr(cases, name)().compile()
        for formulation in ("recursive", "redundant"):
            out[f"one evaluation of {name}, {formulation}, ns"] = _evaluation_ns(model, formulation)
    scene = cases.case2()
    model = scene.compile()
    out["100 s of case 2, tsit5 1e-2, `position` every 1 s, ms"] = _run_ms(
        scene, model, dt_out=1.0, channels=["position"], **QUICK
    )
    out["100 s of case 2, dopri5 1e-6, all channels every 0.1 s, ms"] = _run_ms(
        scene, model, dt_out=0.1, **TIGHT
    )
    few, many = (_run_ms(scene, model, dt_out=dt, channels=["position"], **QUICK) for dt in (T_END, DENSE))
    out["one output of `position`, us"] = 1e3 * (many - few) / (T_END / DENSE - 1)
    return out


def _evaluation_ns(model: Any, formulation: str) -> float:
    import seacrane
    from seacrane import analysis

    Evaluator = getattr(analysis, "Evaluator", None) or seacrane.Evaluator  # at the top until 0.2
    evaluator, state = Evaluator(model, formulation), model.initial_state
    evaluator.repeat(0.0, state, EVALUATIONS // 10, STEP)
    return 1e9 * _best_s(lambda: evaluator.repeat(0.0, state, EVALUATIONS, STEP), 8) / EVALUATIONS


def _run_ms(scene: Any, model: Any, **settings: Any) -> float:
    """Of the loop."""
    from seacrane import Run

    runs = [Run(scene, t_end=T_END, model=model, **settings) for _ in range(3)]
    return 1e3 * _best_s(lambda: runs.pop().advance(T_END), len(runs))


def _best_s(function: Callable[[], object], repeats: int) -> float:
    """Shortest CPU time of the thread."""
    times = []
    for _ in range(repeats):
        start = time.thread_time()
        function()
        times.append(time.thread_time() - start)
    return min(times)


def turn(package: str) -> dict[str, float]:
    """One measurement of a package in a process of its own; ends this one where that fails."""
    found = os.pathsep.join(str(Path(one).resolve()) for one in package.split(os.pathsep))
    env = os.environ | {"PYTHONPATH": found, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    done = subprocess.run(
        [sys.executable, __file__, "--measure"], env=env, capture_output=True, text=True, check=False
    )
    if done.returncode:
        sys.exit(f"measuring with PYTHONPATH={found} failed:\n{done.stderr}")
    told = json.loads(done.stdout)
    if not any(Path(told["package"]).is_relative_to(one) for one in found.split(os.pathsep)):
        sys.exit(f"PYTHONPATH={found} has no seacrane: {told['package']} was found in its place")
    return dict(told["measured"])


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--measure", action="store_true", help="print what this package takes, for a turn")
    parser.add_argument("--other", help="PYTHONPATH of the older package")
    parser.add_argument("--here", default=str(HERE.parent / "python"), help="PYTHONPATH of this one")
    parser.add_argument("--label", default="before", help="what the older one is called")
    parser.add_argument("--turns", type=int, default=7)
    options = parser.parse_args()
    if options.measure:
        import seacrane

        print(json.dumps({"package": seacrane.__file__, "measured": measured()}))
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
    return 0


if __name__ == "__main__":
    sys.exit(main())
