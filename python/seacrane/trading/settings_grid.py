"""The numerical settings that a trade measures: formulation, integrator, and tolerance or step."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from seacrane import _core
from seacrane.errors import SeacraneError
from seacrane.run.method import Method

if TYPE_CHECKING:
    from seacrane.scene.scene import Scene

FORMULATIONS = ("recursive", "redundant")
COARSE = (1e-1, 1e-2, 1e-3, 1e-4)
MIDDLE = (*COARSE, 1e-5, 1e-6)
FINE = (*MIDDLE, 1e-7, 1e-8, 1e-9)
TOLERANCES: dict[str, tuple[float, ...]] = {
    "heun21": COARSE,
    "bs32": MIDDLE,
    "rk43": FINE,
    "dopri5": FINE,
    "tsit5": FINE,
    "verner65": FINE,
    "verner76": FINE,
    "dop853": FINE,
    "rosenbrock": COARSE,
    "ark-erk": MIDDLE,
    "ark-dirk": COARSE,
    "ark-imex": COARSE,
    "cvode-adams": MIDDLE,
    "cvode-bdf": MIDDLE,
    "ida": MIDDLE,
}
STEPS: dict[str, tuple[float, ...]] = {  # s
    "semi-implicit-euler": (0.1, 0.05, 0.02, 0.01, 0.005),
    "rk4": (0.2, 0.1, 0.05, 0.025, 0.0125),
    "rk-low-storage": (0.2, 0.1, 0.05, 0.025),
    "generalized-alpha": (0.1, 0.05, 0.02),
    "generalized-alpha-index2": (0.1, 0.05, 0.02),
}
OTHER_STEPS = (0.1, 0.05, 0.025)  # s, of a method that neither list knows
TRIAL = 0.2  # s of simulated time that tell whether a method takes its steps from dt
QUICK_INTEGRATORS = ("tsit5", "dop853", "rk4", "semi-implicit-euler")


def settings(scene: Scene, *, quick: bool) -> Iterator[Method]:
    """All settings of the grid; `quick` takes every third tolerance of a few integrators."""
    names = QUICK_INTEGRATORS if quick else _core.integrator_names()
    sizes = [(name, *_sizes(scene, name)) for name in names]
    for formulation in FORMULATIONS:
        for name, size, values in sizes:
            for value in values[1::3] if quick else values:
                yield Method(formulation=formulation, integrator=name, **{size: value})


def _sizes(scene: Scene, name: str) -> tuple[str, tuple[float, ...]]:
    """What an integrator's accuracy is set by, and the values to try."""
    if name in TOLERANCES:
        return "rtol", TOLERANCES[name]
    if name in STEPS:
        return "dt", STEPS[name]
    return ("dt", OTHER_STEPS) if _takes_dt(scene, name) else ("rtol", MIDDLE)


def _takes_dt(scene: Scene, name: str) -> bool:
    """Whether half the step makes more steps; False for a method that refuses the scene."""
    from seacrane.run.simulation import simulate

    try:
        runs = [
            simulate(
                scene, t_end=TRIAL, dt_out=TRIAL, integrator=name, dt=TRIAL / parts, channels=["position"]
            )
            for parts in (4, 8)
        ]
    except SeacraneError:
        return False
    return bool(runs[0].stats["steps"] != runs[1].stats["steps"])


TIGHT = (
    Method(formulation="recursive", integrator="dop853", rtol=1e-12),
    Method(formulation="recursive", integrator="verner76", rtol=1e-12),
    Method(formulation="redundant", integrator="dop853", rtol=1e-12),
    Method(formulation="redundant", integrator="verner76", rtol=1e-12),
)
"""The reference's runs; they differ in equations and in method, so that their difference is its error."""

PHYSICS = Method(formulation="auto", integrator="dop853", rtol=1e-8)
"""Numerics of the physics rungs: an error far below what leaving physics out brings."""
