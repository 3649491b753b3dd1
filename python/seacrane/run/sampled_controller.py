"""Python controllers, called between integration steps."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.errors import SceneError, SimulationError
from seacrane.inputs.checked import positive_of
from seacrane.inputs.keywords import named

Array = NDArray[np.float64]
Snapshot = Mapping[str, Array]


@named
@dataclass(frozen=True, kw_only=True)
class SampledController:
    """A Python controller called at its own period, between integration steps.

    Attributes
    ----------
    period : float
        s.
    function : callable
        function(time, measured) -> {input: value}: `measured` maps channel names to arrays of the present
        instant, inputs are "<actuator>.force" (N or N m), "<actuator>.reference" (m or rad),
        "<actuator>.reference_rate" (m/s or rad/s; 0 unless set: then damping holds against a reference that
        moves), "<line>.rate" of a winch (m/s) and "<point force>.force" (3 values, N). Inputs are held until
        the next call.
    """

    period: float
    function: Callable[[float, Snapshot], Mapping[str, Any]]

    def __post_init__(self) -> None:
        positive_of("controller: period", self.period, "s")
        if not callable(self.function):
            raise SceneError(f"controller: function is {self.function!r}; give a function(time, measured)")


def checked_controllers(controllers: Any) -> list[SampledController]:
    """The controllers as a list."""
    given = list(controllers) if isinstance(controllers, Iterable) else [controllers]
    for controller in given:
        if not isinstance(controller, SampledController):
            raise SceneError(f"controllers holds {controller!r}; give a list of seacrane.SampledController")
    return given


def called_at(
    controller: SampledController, now: float, measure: Callable[[], Snapshot]
) -> Mapping[str, Any]:
    """The inputs it returns; SimulationError when it raises, or returns something else."""
    try:
        inputs = controller.function(now, measure())
    except (Exception, SystemExit) as error:  # sys.exit() would take the outputs along
        raise SimulationError(
            f"controller: raised {type(error).__name__} at t = {now:.6g} s: {error}"
        ) from error
    if not isinstance(inputs, Mapping):
        raise SimulationError(f"controller: returned {inputs!r} at t = {now:.6g} s; return {{input: value}}")
    return inputs


def only_setter(
    inputs: Mapping[str, Any], controller: SampledController, setters: dict[str, SampledController]
) -> None:
    """Note who sets each input; SimulationError where another controller of the run has set it before."""
    for name in inputs:
        other = setters.setdefault(name, controller)
        if other is not controller:
            raise SimulationError(
                f"controller: {_called(controller)} sets input {name!r}, which {_called(other)} sets too: "
                "the last would win; let one controller return their sum, or give each an actuator of its own"
            )


def _called(controller: SampledController) -> str:
    return repr(getattr(controller.function, "__qualname__", controller.function))


def next_call(controller: SampledController, now: float, start: float) -> float:
    """When it is due after `now`, s."""
    with np.errstate(over="ignore"):
        after = start + controller.period * (np.round((now - start) / controller.period) + 1.0)
    if not after > now:
        raise SceneError(
            f"controller: period is {controller.period} s, below the resolution of time; make it longer"
        )
    return float(after)
