"""What a comparison is: one quantity, its reference and where that comes from, and how far the engine is from
it."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Comparison:
    """`difference` is the largest over what was compared, in `unit`; `found` and `expected` one value of
    it."""

    problem: str
    quantity: str
    source: str
    setting: str
    found: float
    expected: float
    difference: float
    unit: str

    def row(self) -> tuple[str, ...]:
        """As the table shows it, in the order of HEAD."""
        values = (f"{self.found:.12g}", f"{self.expected:.12g}", f"{self.difference:.1e} {self.unit}".strip())
        return (self.problem, self.quantity, self.source, self.setting, *values)


HEAD = ("problem", "compared", "source", "setting", "here", "reference", "largest difference")
