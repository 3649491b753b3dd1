"""The methods that a trade measures, what is expected nearest the front first, while it can change it."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from seacrane._core import Integrator, integrators
from seacrane.accuracy.row import NOT_FINITE, STOPPED, Row, front
from seacrane.run.method import Method

COARSE = (1e-1, 1e-2, 1e-3, 1e-4)
MIDDLE = (*COARSE, 1e-5, 1e-6)
FINE = (*MIDDLE, 1e-7, 1e-8, 1e-9)
STEPS_OF_ORDER_1 = (0.1, 0.05, 0.02, 0.01, 0.005)  # s
STEPS = (0.2, 0.1, 0.05, 0.025, 0.0125)  # s
STEPS_IMPLICIT = (0.1, 0.05, 0.02)  # s
TIGHT = (
    Method(formulation="recursive", integrator="dop853", rtol=1e-12),
    Method(formulation="redundant", integrator="verner76", rtol=1e-12),
    Method(formulation="recursive", integrator="verner76", rtol=1e-12),
    Method(formulation="redundant", integrator="dop853", rtol=1e-12),
)
"""The reference and its check, which differ in equations and in method, so that their difference is its
error; the last two stand in for what does not run."""
FORMULATIONS = ("recursive", "redundant")
SCOUTS = (
    ("dopri5", 1e-6), ("tsit5", 1e-2), ("verner76", 1e-3), ("dopri5", 1e-3), ("verner65", 1e-5),
    ("bs32", 1e-2), ("dop853", 1e-4), ("rk4", 0.05), ("dopri5-stiff", 1e-3), ("semi-implicit-euler", 0.02),
    ("rosenbrock", 1e-3),
)  # fmt: skip
"""The default, then the first setting of each method that has ever been on a front, the likeliest first."""
SPREAD = 3.0  # by which an error may be off the order of its method
RISES = 1.5  # exponent of the tolerance that no error falls faster with


def measured_methods() -> Iterator[Method]:
    """All methods of the grid."""
    return methods(_values)


def _values(method: Integrator) -> tuple[float, ...]:
    """Tolerances or steps to try: no tighter than a method of this order, at this cost of a step, pays."""
    if method.setting == "dt":
        explicit = STEPS_OF_ORDER_1 if method.order == 1 else STEPS
        return STEPS_IMPLICIT if method.uses_jacobian else explicit
    if method.lowest_order < method.order:
        return MIDDLE
    if method.uses_jacobian:
        return COARSE
    return MIDDLE if method.order < 4 else FINE


def methods(
    values: Callable[[Integrator], Sequence[float]], *, formulations: Sequence[str] = FORMULATIONS
) -> Iterator[Method]:
    """Every formulation, integrator, and what `values` gives of its tolerances or steps (s)."""
    for formulation in formulations:
        for one in integrators():
            for value in values(one):
                yield method_of(one, value, formulation)


def method_of(integrator: Integrator, value: float, formulation: str) -> Method:
    """The method with a tolerance or a step, whichever sets the integrator's accuracy."""
    if integrator.setting == "dt":
        return Method(formulation=formulation, integrator=integrator.name, dt=value)
    return Method(formulation=formulation, integrator=integrator.name, rtol=value)


@dataclass(frozen=True, kw_only=True)
class Guess:
    """What a setting that was not measured may cost and err by, at best and as expected, over those known."""

    method: Method
    cost: float
    errors: Mapping[str, float]
    least_cost: float
    least_errors: Mapping[str, float]


class Ladders:
    """Settings of methods, each method's from loose to tight, and what was measured of them."""

    def __init__(
        self, methods: Iterable[Method], quantities: Sequence[str], floor: Mapping[str, float]
    ) -> None:
        self.quantities, self.floor = quantities, floor
        self.order = {one.name: one.order for one in integrators()}
        self.steps: dict[tuple[str, str], list[Method]] = {}
        for method in methods:
            self.steps.setdefault((method.formulation, method.integrator), []).append(method)
        for ladder in self.steps.values():
            ladder.sort(key=_setting, reverse=True)
        self.rows: dict[Method, Row] = {}
        self.scouts = list(self._scouts())

    def add(self, method: Method, row: Row) -> None:
        """What was measured; after one that does not reach its end the next tighter may."""
        self.rows[method] = row
        if row.verdict in (STOPPED, NOT_FINITE):
            ladder = self.steps[method.formulation, method.integrator]
            self.scouts += ladder[ladder.index(method) + 1 :][:1]

    def next(self) -> Method | None:
        """The setting to measure; None where none could change a front."""
        guesses = [guess for guess in self._guesses() if self._may_change(guess)]
        near = min(guesses, key=self._distance, default=None)
        self.scouts = [one for one in self.scouts if one not in self.rows]
        if near is not None and (self._distance(near) < 0.0 or not self.scouts):
            return near.method
        return self.scouts.pop(0) if self.scouts else None

    @property
    def open(self) -> int:
        """Settings that were not measured and may change the front."""
        waiting = sum(one not in self.rows for one in self.scouts)
        return waiting + sum(self._may_change(guess) for guess in self._guesses())

    def _scouts(self) -> Iterator[Method]:
        """The nearest setting on each ladder; other formulations after the first."""
        formulations = list(dict.fromkeys(formulation for formulation, _ in self.steps))
        for formulation in formulations[:1]:
            for name, value in SCOUTS:
                ladder = self.steps.get((formulation, name))
                if ladder:
                    yield min(ladder, key=lambda one: abs(math.log(_setting(one) / value)))

    def _guesses(self) -> Iterator[Guess]:
        for ladder in self.steps.values():
            known = [i for i, one in enumerate(ladder) if one in self.rows and self.rows[one].stable]
            for i, method in enumerate(ladder):
                if method not in self.rows and known:
                    yield self._guess(ladder, i, min(known, key=lambda j: abs(i - j)))

    def _guess(self, ladder: Sequence[Method], at: int, near: int) -> Guess:
        """From the nearest measured setting of the method, by its order."""
        method, row = ladder[at], self.rows[ladder[near]]
        finer = _setting(ladder[near]) / _setting(method)  # above 1: tighter
        order = max(self.order[method.integrator], 1)
        fixed = method.dt is not None
        power = order if fixed else 1.0
        cost = finer if fixed else finer ** (1.0 / order)
        least_cost = cost if fixed or finer < 1.0 else 1.0
        falls = finer ** -(power if fixed else RISES) if finer > 1.0 else 1.0
        return Guess(
            method=method,
            cost=row.cpu_s * cost,
            errors={q: row.error(q) * finer**-power for q in self.quantities},
            least_cost=row.cpu_s * least_cost,
            least_errors={q: row.error(q) * falls / SPREAD for q in self.quantities},
        )

    def _may_change(self, guess: Guess) -> bool:
        """Whether, at its best, no measured row beats it in some quantity."""
        cheaper = [row for row in self.rows.values() if row.stable and row.cpu_s <= guess.least_cost]
        beside = {q: max(guess.least_errors[q], self.floor[q]) for q in self.quantities}
        return any(not any(row.error(q) <= error for row in cheaper) for q, error in beside.items())

    def _distance(self, guess: Guess) -> float:
        """Logarithm of how far its expected cost is above the front, or beyond its tight end, in the nearest
        quantity."""
        return min(self._above(q, guess.cost, guess.errors[q]) for q in self.quantities)

    def _above(self, quantity: str, cost: float, error: float) -> float:
        rows = list(self.rows.values())
        on = [row for row, kept in zip(rows, front(rows, quantity), strict=True) if kept]
        as_good = [row.cpu_s for row in on if row.error(quantity) <= max(error, self.floor[quantity])]
        if not on:
            return 0.0
        return math.log(cost / (min(as_good) if as_good else max(row.cpu_s for row in on)))


def _setting(method: Method) -> float:
    return float((method.rtol if method.dt is None else method.dt) or 1.0)
