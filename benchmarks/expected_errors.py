"""Fits the rule by which `accuracy=` chooses a first setting, and its margin: run it when the engine changes.

    python benchmarks/expected_errors.py [--scenes 100]

On random ships, cranes and chains of pendulums over 40 s, and hoists on oil over 8 s, errors of the methods
that `accuracy=` takes are `factor` tolerance^`power` times a scale of the quantity. Factors, powers, scales
and the margin on the ratio of two such errors go to `seacrane/data/expected_errors.json`, which
`seacrane/accuracy/expected.py` reads; what that promises is measured by `measure/promises.py`.
"""

from __future__ import annotations

import argparse
import json
import sys
import warnings
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[1]
sys.path.extend(map(str, [ROOT / "tests", *(ROOT / "tests").glob("*/")]))

from accuracy_scenes import on_oil  # noqa: E402
from trade_scenes import random_scene  # noqa: E402

from seacrane import Scene, SeacraneError, simulate  # noqa: E402
from seacrane.accuracy.expected import FORCE, LOWER, scale_of, weight_of  # noqa: E402
from seacrane.accuracy.quantities import compare, quantities_of  # noqa: E402

TARGET = ROOT / "python/seacrane/data/expected_errors.json"
DECADES = {
    "bs32": (2, 2.5, 3),
    "tsit5": (2, 2.5, 3, 3.5, 4, 4.5, 5),
    "verner76": (4, 5, 6, 7, 8, 9),
}
OF_OIL = {"dopri5-stiff": (2, 3, 4, 5, 6), "cvode-bdf": (4, 5, 6)}
ROUNDED = 1e-12  # of the motion: errors below it are rounding
KNOWN = ("m", 0.05)  # the scale that the factors go with
COVERED = 0.99  # of the ratios, by the margin
FOR_KINKS = 1.2  # over that: these scenes have none, and few that have some need more
SEED = 2036


@dataclass(frozen=True, kw_only=True)
class Error:
    """Of a quantity in a run; `scale` names what its scale is of."""

    scene: int
    name: str
    scale: str
    method: str
    rtol: float
    error: float


def errors_of(number: int, *, oil: bool) -> Iterator[Error]:
    """Of every method and tolerance on one scene; forces over the weight that they carry."""
    rng = np.random.default_rng([SEED, number, oil])
    scene: Scene = on_oil(rng) if oil else random_scene(rng)
    t_end = 8.0 if oil else 40.0
    measured = quantities_of(scene, scene.compile(), ["position"] if oil else None)
    try:
        truth = simulate(scene, t_end, dt_out=0.1, integrator="verner76", rtol=1e-11 if oil else 1e-12)
    except SeacraneError:
        return
    for method, decades in (OF_OIL if oil else DECADES).items():
        for decade in decades:
            try:
                found = simulate(scene, t_end, dt_out=0.1, integrator=method, rtol=10.0**-decade)
            except SeacraneError:
                continue
            for name, one in measured.items():
                error = compare(one.values(truth), one.values(found)).largest
                if error > ROUNDED * one.motion(truth):
                    scale = scale_of(one)
                    over = weight_of(scene, one) if scale == FORCE else 1.0
                    yield Error(
                        scene=number,
                        name=name,
                        scale=scale,
                        method=method,
                        rtol=10.0**-decade,
                        error=error / over,
                    )


def fitted(
    errors: Sequence[Error], scales: dict[str, float]
) -> tuple[dict[str, list[float]], dict[str, float]]:
    """Factor and power by method, and scales that are not known, by least squares on the logarithms."""
    methods = list(dict.fromkeys(one.method for one in errors))
    free = [key for key in dict.fromkeys(one.scale for one in errors) if key not in scales]
    left = np.zeros((len(errors), 2 * len(methods) + len(free)))
    right = np.empty(len(errors))
    for row, one in enumerate(errors):
        place = 2 * methods.index(one.method)
        left[row, place : place + 2] = 1.0, np.log(one.rtol)
        if one.scale in free:
            left[row, 2 * len(methods) + free.index(one.scale)] = 1.0
        right[row] = np.log(one.error / scales.get(one.scale, 1.0))
    found = np.linalg.lstsq(left, right, rcond=None)[0]
    rule = {
        name: [_rounded(np.exp(found[2 * i])), _rounded(found[2 * i + 1])] for i, name in enumerate(methods)
    }
    more = {key: _rounded(np.exp(found[2 * len(methods) + i])) for i, key in enumerate(free)}
    return rule, scales | more


def margin(errors: Sequence[Error], rule: dict[str, list[float]]) -> float:
    """What ratios of errors of a method and of its probe are at most, over what the rule makes of them."""
    loosest = 10.0 ** -min(min(decades) for decades in DECADES.values())
    probes = {(one.scene, one.name, one.method): one for one in errors if one.rtol == loosest}
    found = []
    for one in errors:
        probe = probes.get((one.scene, one.name, LOWER.get(one.method, "")))
        if probe is not None:
            expected = [rule[e.method][0] * e.rtol ** rule[e.method][1] for e in (one, probe)]
            found.append(one.error / probe.error * expected[1] / expected[0])
    return _rounded(FOR_KINKS * float(np.quantile(found, COVERED)))


def _rounded(value: float) -> float:
    return float(f"{value:.3g}")


def main() -> None:
    """Measure, fit, write, print."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--scenes", type=int, default=100)
    options = parser.parse_args()
    warnings.simplefilter("ignore")
    errors = [one for number in range(options.scenes) for one in errors_of(number, oil=False)]
    rule, scales = fitted(errors, dict([KNOWN]))
    of_oil = [one for number in range(options.scenes // 2) for one in errors_of(number, oil=True)]
    stiff, _ = fitted(of_oil, scales)
    data = {"errors": rule | stiff, "scales": scales, "margin": margin(errors, rule)}
    TARGET.write_text(json.dumps(data, indent=1) + "\n", encoding="utf-8")
    print(TARGET.read_text(encoding="utf-8"))


if __name__ == "__main__":
    main()
