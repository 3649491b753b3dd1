"""The numerical settings that an atlas runs: formulation, integrator, and tolerance or step."""

from __future__ import annotations

from collections.abc import Iterator

from seacrane import _core
from seacrane.run.method import Method
from seacrane.run.simulation import RESIDUAL_INTEGRATORS

FORMULATIONS = ("recursive", "redundant")
STEPS: dict[str, tuple[float, ...]] = {  # s
    "semi-implicit-euler": (0.02, 0.005),
    "rk4": (0.02, 0.005),
    "rk4-exact-memory": (0.02,),
    "rk-low-storage": (0.02,),
    "generalized-alpha": (0.02,),
    "generalized-alpha-index2": (0.02,),
    "ark-mri": (0.02,),
}
TOLERANCES: dict[str, tuple[float, ...]] = {
    "heun21": (1e-3,),
    "bs32": (1e-3,),
    "rk43": (1e-6,),
    "dopri5": (1e-3, 1e-6, 1e-9),
    "verner65": (1e-6,),
    "rosenbrock": (1e-3,),
    "ark-erk": (1e-6,),
    "ark-dirk": (1e-6,),
    "ark-imex": (1e-3,),
    "cvode-adams": (1e-6,),
    "ida": (1e-6,),
}
OTHER_TOLERANCES = (1e-3, 1e-6)  # of a method that neither list knows


DEFAULT = Method(formulation="auto", integrator="dopri5")

QUICK = (
    DEFAULT,
    Method(formulation="recursive", integrator="tsit5", rtol=1e-3),
    Method(formulation="redundant", integrator="dop853", rtol=1e-9),
    Method(formulation="redundant", integrator="rk4", dt=0.02),
    Method(formulation="recursive", integrator="semi-implicit-euler", dt=0.005),
    Method(formulation="redundant", integrator="cvode-bdf", rtol=1e-6),
)


def every() -> Iterator[Method]:
    """The default, then each formulation, integrator, and tolerance or step.

    What a formulation does not have at all is left out: methods of the residual form solve the redundant
    equations only.
    """
    yield DEFAULT
    for formulation in FORMULATIONS:
        for name in _core.integrator_names():
            if formulation == "recursive" and name in RESIDUAL_INTEGRATORS:
                continue
            for dt in STEPS.get(name, ()):
                yield Method(formulation=formulation, integrator=name, dt=dt)
            for rtol in () if name in STEPS else TOLERANCES.get(name, OTHER_TOLERANCES):
                yield Method(formulation=formulation, integrator=name, rtol=rtol)
