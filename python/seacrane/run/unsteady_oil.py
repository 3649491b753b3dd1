"""Hydraulic cylinders whose control makes what they carry swing by itself."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.analysis.linearise import LARGEST, jacobian
from seacrane.description.description import Description
from seacrane.description.hydraulic_cylinders import hydraulic_cylinders
from seacrane.one_thread import one_thread
from seacrane.validity.after_run import Finding
from seacrane.warnings import UnsteadyOilWarning

Array = NDArray[np.float64]
OPEN = 1e-3  # of the spool's travel, to both sides of the overlap
UNDAMPED = 1e-3  # of critical damping, negative: less is not told
SLOWEST = 0.1  # rad/s: slower modes are those of drifting vessels
HALVINGS = 8  # of the gain, until it is steady
MARGIN = 0.5  # of that gain, which is told
RESTLESS = 0.5  # m/s2: what would set out faster is not at rest


@one_thread
def unsteady_oil(scene: Description, model: _core.Model, states: Sequence[_core.State]) -> list[Finding]:
    """Cylinders whose valve feeds a mode, at rest in the pose of the first state whose loads are in balance.

    Away from rest a linear model tells of the motion that is under way, and not of what it comes to; where no
    state is at rest nothing is told. A valve has two slopes, one on each side of its middle; their mean
    counts, at the edge of the overlap. A spool without lag is left out, as are modes that grow by less
    than `UNDAMPED`.
    """
    cylinders = {
        name: one
        for name, one in hydraulic_cylinders(scene).items()
        if one.gain > 0.0 and one.spool_lag > 0.0 and one.rated_flow > 0.0
    }
    if not cylinders or model.states > LARGEST:
        return []
    spools = {
        name: place for name, _, place, *_ in model.load_states if name.removesuffix(".spool") in cylinders
    }
    start = next((one for one in states if _unrest(scene, model, one) < RESTLESS), None)
    if start is None:
        return []
    matrix = _mean_jacobian(model, start, [spools[f"{name}.spool"] for name in cylinders], cylinders)
    if not np.all(np.isfinite(matrix)):
        return []
    rows = {name: _row(model, spools[f"{name}.spool"]) for name in cylinders}
    return [
        (UnsteadyOilWarning, text)
        for name, one in cylinders.items()
        for text in _told(name, one, matrix, rows)
    ]


def _stopped(model: _core.Model, state: _core.State) -> Array:
    """Its values without speeds and what follows from them."""
    values = np.array(state.values)
    values[model.twist_index(0) : min(place for _, _, place, *_ in model.load_states)] = 0.0
    return values


def _unrest(scene: Description, model: _core.Model, state: _core.State) -> float:
    """The largest acceleration, m/s2, with which what cylinders join would set out from its pose."""
    joined = {end for one in hydraulic_cylinders(scene).values() for end in (one.first, one.second)}
    terms = _core.Evaluator(model).terms(state.time, _stopped(model, state))
    accelerations = np.abs(terms["acceleration"]).reshape(-1, 6)[:, :3].max(axis=1)
    return float(max(a for body, a in zip(model.bodies, accelerations, strict=True) if body in joined))


def _mean_jacobian(
    model: _core.Model, start: _core.State, places: list[int], cylinders: dict[str, _core.HydraulicCylinder]
) -> Array:
    """The mean Jacobian of both sides of the valves' middle."""
    found = []
    for side in (-1.0, 1.0):
        values = _stopped(model, start)
        for place, one in zip(places, cylinders.values(), strict=True):
            values[place] = side * (one.overlap + OPEN)
        found.append(jacobian(model, state=values, time=start.time))
    return np.asarray(0.5 * (found[0] + found[1]))


def _row(model: _core.Model, place: int) -> int:
    """The row of a state in the Jacobian."""
    return int(np.searchsorted(np.flatnonzero(np.isfinite(np.array(model.scale))), place))


def _told(name: str, one: _core.HydraulicCylinder, matrix: Array, rows: dict[str, int]) -> Iterator[str]:
    """What is told of a cylinder that is not steady, the others with a gain of zero."""

    def modes(share: float) -> Array:
        out = np.array(matrix)
        for other, row in rows.items():
            lag = out[row, row]
            out[row] *= share if other == name else 0.0
            out[row, row] = lag
        return np.asarray(np.linalg.eigvals(out))

    shut = modes(0.0)
    worst = _fed(modes(1.0), shut)
    if worst is None:
        return
    steady = 1.0
    for _ in range(HALVINGS):
        steady *= 0.5
        if _fed(modes(steady), shut) is None:
            break
    damping = 100.0 * worst.real / abs(worst)
    yield (
        f"hydraulic cylinder {name!r}: with its gain of {one.gain:g} 1/m a mode of {worst.imag:.3g} rad/s "
        f"grows by {damping:.2g} % of critical damping, until its valve is open all the way. Give a lower "
        f"gain, such as {MARGIN * steady * one.gain:.2g} 1/m, and let rate_gain lead, or more "
        "viscous_friction"
    )


def _fed(modes: Array, shut: Array) -> complex | None:
    """The mode that grows most, and more than its like with a shut valve; None if none does."""
    likes = shut[np.argmin(np.abs(modes[:, None] - shut), axis=1)]
    least = UNDAMPED * np.abs(modes)
    growing = modes[(modes.imag > SLOWEST) & (modes.real > least) & ((modes - likes).real > least)]
    return complex(growing[int(np.argmax(growing.real))]) if growing.size else None
