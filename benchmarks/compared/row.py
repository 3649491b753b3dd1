"""What a comparison is: two things, how far they are apart, and the bound that is kept."""

from __future__ import annotations

from dataclasses import dataclass

HEAD = ("subject", "compared", "with", "largest difference", "bound", "test")


@dataclass(frozen=True, kw_only=True)
class Row:
    """One comparison.

    Attributes
    ----------
    subject : str
        Under which heading it stands.
    compared, reference : str
        What, and with what.
    difference : float
        The largest, in `unit`.
    unit : str
        "" for a ratio.
    limit : float or None
        That the difference may not exceed; None where the test named has its own.
    test : str
        File in `tests` that holds it.
    """

    subject: str
    compared: str
    reference: str
    difference: float
    unit: str
    limit: float | None
    test: str

    @property
    def cells(self) -> tuple[str, ...]:
        """In the order of HEAD."""
        return (
            self.subject,
            self.compared,
            self.reference,
            with_unit(self.difference, self.unit),
            "" if self.limit is None else with_unit(self.limit, self.unit),
            f"`tests/{self.test}`",
        )


def with_unit(value: float, unit: str) -> str:
    """Two digits and the unit; shares above a thousandth in per cent."""
    if unit == "" and 1e-3 <= abs(value) < 1.0:
        return f"{100.0 * value:.2g} %"
    return f"{value:.2g} {unit}".strip()
