"""Water in compartments where nothing flows any more: their law of flow has no slope that leads there."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.description.description import Description

Array = NDArray[np.float64]
HALVINGS = 60  # of a volume, until its last digit
MOST_AIR = 1e3  # times the compartment, at one atmosphere


def leveled(scene: Description, model: _core.Model, *, time: float) -> Callable[[Array], Array]:
    """Takes a state to that with the same poses in which no compartment takes or gives water.

    What flows is the root of a head: Newton's method on it steps from one side to the other by as much. So
    volumes go first, by bisection, with the air that is shut in above. One through whose openings nothing
    flows stays.
    """
    waters = {name: load for name, load in scene.loads.items() if isinstance(load, _core.EntrappedWater)}
    places = {name: place for name, _, place, *_ in model.load_states}
    evaluator = _core.Evaluator(model)

    def flow(values: Array, place: int, volume: float) -> float:
        y = np.array(values)
        y[place] = volume
        return float(evaluator.derivative(time, y)[place])

    def found(values: Array) -> Array:
        out = np.array(values)
        for name, water in waters.items():
            whole, place = water.area * water.height, places[f"{name}.volume"]
            out[place] = _settled(partial(flow, out, place), out[place], whole)
            if water.air == "shut":
                air = places[f"{name}.air"]
                out[air] = _settled(partial(flow, out, air), out[air], MOST_AIR * whole)
                out[place] = _settled(partial(flow, out, place), out[place], whole)
        return out

    return found if waters else np.array


def _settled(flow: Callable[[float], float], volume: float, whole: float) -> float:
    """The volume nearest to a first one at which the flow ends."""
    now = flow(volume)
    if now == 0.0:
        return volume
    flows, still = volume, whole if now > 0.0 else 0.0
    for _ in range(HALVINGS):
        middle = 0.5 * (flows + still)
        if flow(middle) * now > 0.0:
            flows = middle
        else:
            still = middle
    return still
