"""The error of a fixed step, told by two longer ones where it falls as the order of the method says."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from seacrane.accuracy.quantities import compare, quantities_of
from seacrane.errors import SceneError, SimulationError
from seacrane.inputs.keywords import named
from seacrane.run.advance import finished
from seacrane.run.method import Method
from seacrane.run.outputs import Outputs
from seacrane.run.run import Run
from seacrane.run.shorthand import Shorthand, settled

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from seacrane import _core
    from seacrane.accuracy.quantities import Quantity
    from seacrane.scene.scene import Scene

Array = NDArray[np.float64]
CONFIRMED = 0.5  # of a difference: how far it may be from what the next longer step and the order make of it
ROUNDING = 1e-11  # of the motion: differences below it are rounding, and show no order


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
        By which the differences of the three runs fall; NaN where one of them failed, or none differ.
    method_order : int
        By which they should.
    """

    unit: str
    error: float | None
    order: float
    method_order: int

    @property
    def sensitive(self) -> bool:
        """Whether no error can be told."""
        return self.error is None

    def __str__(self) -> str:
        shown = f"order {self.order:.2g}, {self.method_order} by the method"
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
    believed where the second and third differ by 2^p times as much, at every output alike.

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
    model = scene.compile()
    measured = quantities_of(scene, model, quantities)
    channels = sorted({channel for quantity in measured.values() for channel in quantity.channels})
    recorded = replace(outputs, channels=channels)
    runs: list[dict[str, Array]] = []
    order = 0
    for longer in (1.0, 2.0, 4.0):
        tried = replace(method, dt=longer * method.dt)
        run = Run(scene, t_end, method=tried, outputs=recorded, start=start, model=model)
        if run.core.adaptive:
            raise SceneError(
                f"integrator {method.integrator!r} chooses its own steps: give accuracy= to simulate()"
            )
        order = run.core.order
        try:
            result = finished(run)
        except SimulationError:
            if not runs:
                raise
            break
        if result.interrupted:
            raise KeyboardInterrupt
        runs.append({name: quantity.values(result) for name, quantity in measured.items()})
    return {name: _told(quantity, [run[name] for run in runs], order) for name, quantity in measured.items()}


def _told(quantity: Quantity, values: list[Array], order: int) -> StepError:
    """`values` by step, the shortest first; fewer than three where a longer one failed."""
    error: float | None = None
    found = math.nan
    if len(values) == 3:
        fine, coarse = values[1] - values[0], values[2] - values[1]
        nothing = np.zeros_like(fine)
        small, large = compare(nothing, fine).largest, compare(nothing, coarse).largest
        motion = compare(values[0][:1].repeat(len(values[0]), axis=0), values[0]).largest
        if small > 0.0 and large > 0.0:
            found = math.log2(large / small)
        if max(small, large) <= ROUNDING * motion:
            error = max(small, large)
        elif compare(2.0**order * fine, coarse).largest <= CONFIRMED * large:
            error = small / (2.0**order - 1.0)
    return StepError(unit=quantity.unit, error=error, order=found, method_order=order)
