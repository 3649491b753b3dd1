"""Method: how a scene is stepped."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from seacrane import _core
from seacrane.errors import SceneError
from seacrane.inputs.checked import number_of
from seacrane.inputs.keywords import named

DEFAULT_INTEGRATOR, DEFAULT_TOLERANCE = "dopri5", 1e-6
LARGEST_TOLERANCE = 0.1
FORMULATIONS = ("auto", "recursive", "redundant")


@named
@dataclass(frozen=True, kw_only=True)
class Method:
    """How a scene is stepped: integrator, tolerance or step, formulation. What is None is the default.

    Attributes
    ----------
    integrator : str
        One of `seacrane.integrator_names()`; docs/integrators.md says what each is for.
    rtol : float, optional
        Local error per step over the scale of each state (0.1 m, 0.01 rad, 0.1 m/s, 0.01 rad/s; lengths
        times `scene.length_scale`): absolute, so that results do not depend on where the origin is. Methods
        of fixed step take it where they iterate, and to tell which kinks of curves end a step. Default 1e-6.
    dt : float, optional
        Step of fixed-step methods, s; default: the method's own.
    formulation : str
        "redundant": six velocities per body and multipliers, the paper's. "recursive": the same motion in
        the coordinates of a tree of bodies, cylinder loops in closed form, other loops by a small block of
        constraints; several times faster. "auto" (default) takes it where it leaves no constraints, or where
        the redundant one would be solved densely at far more cost, and the integrator allows.
    maximum_step : float, optional
        Longest step, s; default: no limit.
    spectral_radius : float, optional
        What is left after a step of "generalized-alpha" of a motion far too fast for it: 1 damps nothing, 0
        all in one step; default 0.8. Other integrators have none.
    energy_limit : float, optional
        Stops the run at the first output where `energy_balance` exceeds this share of the absolute work and
        the largest kinetic energy until then; default: never. Not for the paper's kinematics.

    Raises
    ------
    SceneError
        For a value that makes no sense, by its name.
    """

    integrator: str = DEFAULT_INTEGRATOR
    rtol: float | None = None
    dt: float | None = None
    formulation: str = "auto"
    maximum_step: float | None = None
    spectral_radius: float | None = None
    energy_limit: float | None = None

    def __post_init__(self) -> None:
        if not isinstance(self.integrator, str):
            names = ", ".join(_core.integrator_names())
            raise SceneError(f"integrator is {self.integrator!r}; choose one of {names}")
        if self.formulation not in FORMULATIONS:
            raise SceneError(f"formulation {self.formulation!r} is unknown; choose {', '.join(FORMULATIONS)}")
        for name, check in CHECKS.items():
            value = getattr(self, name)
            object.__setattr__(self, name, None if value is None else check(name, value))

    @property
    def used_rtol(self) -> float:
        """The tolerance, or the default one."""
        return DEFAULT_TOLERANCE if self.rtol is None else self.rtol

    @property
    def setting(self) -> str:
        """The step and the tolerance that were given, in words."""
        given = (("dt", self.dt), ("rtol", self.rtol))
        return " ".join(f"{word}={value:g}" for word, value in given if value is not None)

    @property
    def name(self) -> str:
        """Formulation, integrator and setting, in words."""
        return " ".join(part for part in (self.formulation, self.integrator, self.setting) if part)


def tolerance_of(name: str, value: Any) -> float:
    """A tolerance; raises SceneError."""
    tolerance = number_of(name, value)
    if not 0.0 < tolerance <= LARGEST_TOLERANCE:
        raise SceneError(f"{name} is {tolerance:g}; give a positive number up to 0.1, e.g. 1e-6")
    return tolerance


def step_of(name: str, value: Any) -> float:
    """A step length, s; raises SceneError."""
    step = number_of(name, value)
    if not (math.isfinite(step) and step > 0.0):
        raise SceneError(f"{name} is {step} s; give a finite positive number, or leave it out")
    return step


def energy_limit_of(name: str, value: Any) -> float:
    """A share of the energy; raises SceneError."""
    limit = number_of(name, value)
    if not limit > 0.0:
        raise SceneError(f"{name} is {limit}; give a positive number, such as 1e-3")
    return limit


CHECKS = {
    "rtol": tolerance_of,
    "dt": step_of,
    "maximum_step": step_of,
    "spectral_radius": number_of,
    "energy_limit": energy_limit_of,
}
