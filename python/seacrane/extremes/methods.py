"""The numerical settings that an atlas runs: formulation, integrator, and tolerance or step."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from seacrane import _core
from seacrane.simulation import RESIDUAL_INTEGRATORS

FORMULATIONS = ("recursive", "redundant")
STEPPED = ("semi-implicit-euler", "rk4", "rk4-exact-memory", "rk-low-storage", "generalized-alpha",
           "generalized-alpha-index2", "ark-mri")  # fmt: skip
STEPS = (0.02, 0.005)  # s
COARSE_RTOL, FINE_RTOL = (1e-3, 1e-6), (1e-3, 1e-6, 1e-9)
HIGH_ORDER = ("dopri5", "tsit5", "verner65", "verner76", "dop853")


@dataclass(frozen=True, kw_only=True)
class Method:
    """One choice of the numerics; `rtol` and `dt` are 0 where they are left to `simulate`."""

    formulation: str
    integrator: str
    rtol: float = 0.0
    dt: float = 0.0

    @property
    def setting(self) -> str:
        """The tolerance or the step, in words."""
        return f"rtol={self.rtol:g}" if self.rtol else f"dt={self.dt:g}" if self.dt else ""

    @property
    def name(self) -> str:
        """All of it, in words."""
        return " ".join(part for part in (self.formulation, self.integrator, self.setting) if part)

    def arguments(self) -> dict[str, Any]:
        """Keyword arguments of `Run`."""
        size = {"rtol": self.rtol} if self.rtol else {"dt": self.dt} if self.dt else {}
        return {"formulation": self.formulation, "integrator": self.integrator, **size}


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
            if name in STEPPED:
                for dt in STEPS:
                    yield Method(formulation=formulation, integrator=name, dt=dt)
                continue
            for rtol in FINE_RTOL if name in HIGH_ORDER else COARSE_RTOL:
                yield Method(formulation=formulation, integrator=name, rtol=rtol)
