"""Dynamic factors and hoisting speeds of crane codes beside what was simulated, each with its source."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import isnan
from typing import ClassVar, Protocol, TypeVar

import numpy as np

from seacrane.description.description import STANDARD_GRAVITY
from seacrane.errors import SceneError
from seacrane.inputs.checked import not_negative_of, number_of, positive_of
from seacrane.inputs.keywords import named
from seacrane.inputs.shown import shown
from seacrane.plotting.table import Column, Named, Rows, Table, Verdict, format_value

SECOND_HAND = "second-hand, unverified"
EN = f"EN 13852-1:2013 ({SECOND_HAND})"
API = f"API Spec 2C, 7th ed. ({SECOND_HAND})"
FOOT = 0.3048  # m
DECKS: Mapping[str, tuple[float, float]] = {  # v_D = a H / (H + b), m/s
    "fixed": (0.0, 1.0), "barge": (4.0, 7.0), "supply vessel": (6.0, 8.0),
}  # fmt: skip
REEVING = {True: 0.50, False: 0.28}  # K_H at rated capacity, by whether there is a single fall


class Compared(Named, Protocol):
    """A number of a code that may stand beside a simulated one."""

    @property
    def ratio(self) -> float: ...


One = TypeVar("One", bound=Compared)


def ratio_of(simulated: float, code: float) -> float:
    """Simulated over the code's, which may be nothing."""
    return simulated / code if code else simulated * float("inf")


@dataclass(frozen=True, kw_only=True, repr=False)
class Beside(Rows[One]):
    """Numbers of a code beside simulated ones.

    Attributes
    ----------
    rows : tuple
    title : str
    """

    title: str
    what: ClassVar[str]
    what_of_run: ClassVar[str]

    @property
    def exceeded(self) -> tuple[str, ...]:
        """What a simulation is above: a number of a code bounds nothing."""
        return tuple(row.name for row in self.rows if row.ratio > 1.0)

    def unit_of(self, name: str) -> str:
        """Of what may be simulated in the row of a name, SI; of a margin none."""
        return str(getattr(self[name], "unit", ""))

    def _beside(self, axis: Column, *columns: Column, remarks: Sequence[str] = ()) -> Table:
        """What is exceeded is said first, in print, on a page and in files."""
        above = f"SIMULATED ABOVE THE {self.what}: {', '.join(self.exceeded)}. " if self.exceeded else ""
        known = [None if isnan(row.ratio) else row.ratio > 1.0 for row in self.rows]
        first = Column(name="exceeded", values=[format_value(one) for one in known], printed=False)
        return Table(axes=[axis], columns=[first, *columns], title=f"{above}{self.title}", remarks=remarks)

    def _ratio(self) -> Column:
        """Bad where it is exceeded."""
        values = [row.ratio for row in self.rows]
        told = [Verdict(format_value(one, ".2f"), False if one > 1.0 else None) for one in values]
        return Column(name="ratio", values=values, read=("", told))


@dataclass(frozen=True, kw_only=True)
class CodeRow:
    """One number of a code.

    Attributes
    ----------
    name, unit, formula, inputs, source : As of a row of `lift_sheet`.
    value : By the code, SI.
    simulated : The same of a simulation, or NaN.
    """

    name: str
    value: float
    unit: str = ""
    formula: str = ""
    inputs: str = ""
    source: str = ""
    simulated: float = float("nan")

    @property
    def ratio(self) -> float:
        """Simulated over the code's."""
        return ratio_of(self.simulated, self.value)


@dataclass(frozen=True, kw_only=True, repr=False)
class CodeFactors(Beside[CodeRow]):
    """Factors and speeds of crane codes beside simulated ones. Made by `code_factors`; prints as a table."""

    what, what_of_run = "CODE", "maximum"

    def _shown(self) -> Table:
        return self._beside(
            self.names("row", head=""), self.column("value", head="code"), self.column("simulated"),
            self._ratio(), self.column("unit", head="unit"), self.column("formula"),
            self.column("inputs", head="with"), self.column("source"),
        )  # fmt: skip


def deck_speed(hs: float, deck: str) -> float:
    """v_D of EN 13852-1, m/s: of a deck that is "fixed", or that of a "barge" or a "supply vessel"."""
    if not isinstance(deck, str) or deck not in DECKS:
        raise SceneError(f"deck is {shown(deck)}; choose from {', '.join(DECKS)}")
    a, b = DECKS[deck]
    return a * hs / (hs + b)


def api_hoisting_speed(hs: float) -> float:
    """Least steady hoisting speed of API Spec 2C, m/s, off a supply vessel."""
    feet = hs / FOOT
    return FOOT * (0.033 + 0.098 * feet if feet <= 6.0 else 0.067 * (feet + 3.3))


@named
def code_factors(
    *,
    hs: float,
    mass: float,
    stiffness: float,
    deck: str = "supply vessel",
    falls: int = 1,
    tip_speed: float = 0.0,
    hoisting_speed: float | None = None,
    simulated: Mapping[str, float] | None = None,
) -> CodeFactors:
    """Dynamic factor, hoisting speed, off-lead and side-lead of an off-board lift by crane codes.

    The texts of the codes could not be read: formulas are as others quote them, and each row says so. Of API
    Spec 2C that is the least hoisting speed alone: nobody who may be cited quotes its v_D, v_C and off-lead.

    Parameters
    ----------
    hs : float
        Significant wave height, m.
    mass, stiffness : float
        Of the load, kg; vertical at the hook, N/m, as `statics` has it ("hook stiffness").
    deck : str
        From which the load is lifted: "fixed", "barge" or "supply vessel".
    falls : int
        Of the hoist.
    tip_speed : float
        v_C, of the crane's tip by the motion of its base, m/s.
    hoisting_speed : float, optional
        v_L, of the hook, m/s; default: the least one of EN 13852-1, v_H.
    simulated : mapping of str to float, optional
        Numbers of a simulation by the names of rows, SI.

    Raises
    ------
    SceneError
        For values that make no sense, or a simulated number of no row.
    """
    height, weight = not_negative_of("hs", hs, "m"), positive_of("mass", mass, "kg")
    k, v_c = positive_of("stiffness", stiffness, "N/m"), not_negative_of("tip_speed", tip_speed, "m/s")
    if positive_of("falls", falls) % 1.0:
        raise SceneError(f"falls is {shown(falls)}; give a whole number")
    v_d, k_h = deck_speed(height, deck), REEVING[falls == 1]
    both = float(np.hypot(v_d, v_c))
    v_h = k_h * both
    v_l = v_h if hoisting_speed is None else not_negative_of("hoisting_speed", hoisting_speed, "m/s")
    relative = 0.5 * v_l + both
    a, b = DECKS[deck]
    rows = [
        CodeRow(name="deck speed", value=v_d, unit="m/s", formula="v_D = a H / (H + b)",
                inputs=f"H {height:g} m, a {a:g}, b {b:g}: {deck}", source=EN),
        CodeRow(name="hoisting speed", value=v_h, unit="m/s", formula="v_H = K_H sqrt(v_D^2 + v_C^2)",
                inputs=f"K_H {k_h:g}, v_C {v_c:g} m/s", source=EN),
        CodeRow(name="hoisting speed, API", value=api_hoisting_speed(height), unit="m/s",
                formula="0.033 + 0.098 H to 6 ft, then 0.067 (H + 3.3), ft and ft/s",
                inputs=f"H {height / FOOT:.3g} ft", source=API),
        CodeRow(name="relative speed", value=relative, unit="m/s",
                formula="v_r = v_L / 2 + sqrt(v_D^2 + v_C^2)", inputs=f"v_L {v_l:.3g} m/s", source=EN),
        CodeRow(name="dynamic factor", value=1.0 + relative / STANDARD_GRAVITY * float(np.sqrt(k / weight)),
                formula="psi = 1 + v_r / g sqrt(k / m)", inputs=f"k {k:.4g} N/m, m {weight:.5g} kg",
                source=EN),
        CodeRow(name="offlead", value=2.5 + 1.5 * height, unit="m", formula="2.5 + 1.5 H", source=EN),
        CodeRow(name="sidelead", value=0.5 * (2.5 + 1.5 * height), unit="m", formula="half of it", source=EN),
    ]  # fmt: skip
    beside = simulated_of("row", simulated, [row.name for row in rows])
    made = (replace(row, simulated=beside[row.name]) for row in rows)
    return CodeFactors(rows=tuple(made), title=f"Off-board lift by codes, Hs {height:g} m")


def simulated_of(what: str, given: Mapping[str, float] | None, names: Sequence[str]) -> dict[str, float]:
    """Numbers of a simulation by all names, NaN where there is none; SceneError for another name."""
    given = {} if given is None else given
    if not isinstance(given, Mapping):
        raise SceneError(f"simulated is {shown(given)}; give numbers by the names of rows")
    for name in given:
        if name not in names:
            raise SceneError(f"simulated: there is no {what} {shown(name)}; give {', '.join(names)}")
    return {name: number_of(f"simulated: {name}", given.get(name, float("nan"))) for name in names}
