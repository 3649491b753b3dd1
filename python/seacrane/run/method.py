"""One choice of the numerics, as the trade and the stability atlas run them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True, kw_only=True)
class Method:
    """Formulation, integrator, and tolerance or step; those that are 0 are left to `simulate`."""

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
        """Keyword arguments of `simulate`."""
        size = {"rtol": self.rtol} if self.rtol else {"dt": self.dt} if self.dt else {}
        return {"formulation": self.formulation, "integrator": self.integrator, **size}
