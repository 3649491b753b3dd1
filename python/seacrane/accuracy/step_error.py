"""The error of a fixed step, told by two others where it falls as the order of the method says."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from seacrane.accuracy.case import Case
from seacrane.accuracy.quantities import channels_of, compare, motion_of, quantities_of
from seacrane.arrays import Array
from seacrane.errors import SceneError, SimulationError
from seacrane.inputs.keywords import named
from seacrane.run.advance import finished
from seacrane.run.method import Method, Shorthand, settled
from seacrane.run.outputs import Outputs
from seacrane.run.run import Run

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from seacrane import _core
    from seacrane.accuracy.quantities import Quantity
    from seacrane.scene.scene import Scene

CONFIRMED = 0.5  # of a difference: how far it may be from what the next longer step and the order make of it
ROUNDING = 1e-11  # of the motion: differences below it are rounding, and show no order
LONGER, SHORTER = (1.0, 2.0, 4.0), (0.25, 0.5, 1.0)
WILD = 10.0  # motions, that a run is off which is unstable; one that is sensitive is off by its motion
HALVINGS = 4  # of the interval in which the largest stable step lies: to 4 % of it


@dataclass(frozen=True, kw_only=True)
class StepError:
    """Error of one quantity at a fixed step.

    Attributes
    ----------
    unit : str
        Of `error`.
    error : float or None
        Largest over the outputs; None where the run is sensitive: its error does not fall as the method's
        order says, so that no step near the one asked for tells how wrong it is.
    order : float
        By which the differences of the three runs fall; NaN where none differ.
    method_order : int
        By which they should.
    stable_step : float or None
        Where twice or four times the step is unstable: about the largest at which this run is stable, s.
    """

    unit: str
    error: float | None
    order: float
    method_order: int
    stable_step: float | None = None

    @property
    def sensitive(self) -> bool:
        """Whether no error can be told."""
        return self.error is None

    def __str__(self) -> str:
        shown = f"order {self.order:.2g}, {self.method_order} by the method"
        if self.stable_step is not None:
            shown += f"; unstable with steps longer than {self.stable_step:.2g} s"
        return f"sensitive ({shown})" if self.error is None else f"{self.error:.3g} {self.unit} ({shown})"


@named
def step_error(
    scene: Scene,
    t_end: float = 100.0,
    *,
    method: Method | None = None,
    outputs: Outputs | None = None,
    quantities: Iterable[str] | None = None,
    start: _core.State | None = None,
    **shorthand: Unpack[Shorthand],
) -> dict[str, StepError]:
    """Error of a run with a fixed step h, from runs with h, 2 h and 4 h.

    The first two differ by (2^p - 1) times the error of the first, p the order of the method. That is
    believed where the second and third differ by 2^p times as much, at every output alike. Where a longer
    step is unstable, h is compared with h/2 and h/4, and the largest stable step is looked for.

    Parameters
    ----------
    t_end : float
        End time, s.
    method : Method
        With an integrator of fixed step, such as "rk4" or "generalized-alpha", and its step.
    outputs : Outputs, optional
        Errors are taken at its times; what is recorded follows from the quantities.
    quantities : iterable of str, optional
        As in `seacrane.trade`: named ones or channels; default: those that the scene has.
    start, **shorthand
        As `simulate`: ``step_error(scene, integrator="rk4", dt=0.01)``.

    Returns
    -------
    dict of str to StepError
        By quantity.

    Raises
    ------
    SceneError
        For a step that is no positive number, an integrator that chooses its own, an unknown quantity.
    SimulationError
        When the run with the step itself cannot continue.
    """
    method, outputs = settled(method, outputs, shorthand)
    if method.dt is None:
        raise SceneError("dt is None; give the positive step whose error is asked for")
    case = Case(scene=scene, t_end=t_end, start=start)
    measured = quantities_of(scene, case.model, quantities)
    return _Ladder(case, method, replace(outputs, channels=channels_of(measured)), measured).told()


@dataclass
class _Ladder:
    """Runs of one scene that differ in their step alone."""

    case: Case
    method: Method
    outputs: Outputs
    measured: dict[str, Quantity]
    order: int = 0

    def told(self) -> dict[str, StepError]:
        """By quantity; the step itself has to run."""
        asked = self.values(1.0)
        runs, good, bad = {1.0: asked}, 1.0, None
        for factor in LONGER[1:]:
            found = self.stable(factor, asked)
            if found is None:
                bad = factor
                break
            runs[factor], good = found, factor
        if bad is not None:
            runs |= {shorter: self.values(shorter) for shorter in SHORTER[:-1]}
        steps = LONGER if bad is None else SHORTER
        stable = None if bad is None else self.largest_stable(good, bad, asked) * float(self.method.dt or 0.0)
        return {
            name: _told(quantity, [runs[one][name] for one in steps], self.order, steps.index(1.0), stable)
            for name, quantity in self.measured.items()
        }

    def values(self, factor: float) -> dict[str, Array]:
        """The quantities of a run with so many times the step; SimulationError where it cannot go on."""
        tried = replace(self.method, dt=factor * float(self.method.dt or 0.0))
        run = self.case.begun(tried, self.outputs)
        assert isinstance(run, Run)
        if run.core.adaptive:
            raise SceneError(
                f"integrator {tried.integrator!r} chooses its own steps: give accuracy= to simulate()"
            )
        self.order = run.core.order
        result = finished(run)
        if result.interrupted:
            raise KeyboardInterrupt
        return {name: quantity.values(result) for name, quantity in self.measured.items()}

    def stable(self, factor: float, asked: Mapping[str, Array]) -> dict[str, Array] | None:
        """The quantities of a run with so many times the step; None where it cannot go on, or runs away."""
        try:
            found = self.values(factor)
        except SimulationError:
            return None
        for name, right in asked.items():
            if not compare(right, found[name]).largest <= WILD * motion_of(right):
                return None
        return found

    def largest_stable(self, good: float, bad: float, asked: Mapping[str, Array]) -> float:
        """Between a factor that is stable and one that is not."""
        for _ in range(HALVINGS):
            middle = math.sqrt(good * bad)
            if self.stable(middle, asked) is None:
                bad = middle
            else:
                good = middle
        return good


def _told(
    quantity: Quantity, values: Sequence[Array], order: int, asked: int, stable: float | None
) -> StepError:
    """`values` by step, the shortest first, and which of them is that of the step that was asked for."""
    error: float | None = None
    found = math.nan
    fine, coarse = values[1] - values[0], values[2] - values[1]
    small, large = (float(np.linalg.norm(one, axis=-1).max()) for one in (fine, coarse))
    if small > 0.0 and large > 0.0:
        found = math.log2(large / small)
    if max(small, large) <= ROUNDING * motion_of(values[0]):
        error = max(small, large)
    elif compare(2.0**order * fine, coarse).largest <= CONFIRMED * large:
        error = small / (2.0**order - 1.0) * 2.0 ** (order * asked)
    return StepError(unit=quantity.unit, error=error, order=found, method_order=order, stable_step=stable)
