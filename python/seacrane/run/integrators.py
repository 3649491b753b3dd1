"""The list of integrators, with what the program needs to know of each: the core's own."""

from __future__ import annotations

from seacrane._core import Integrator, integrator, integrators

__all__ = ["Integrator", "integrator", "integrators"]
