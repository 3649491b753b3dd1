"""What moves a scene, by its frequencies: its sea, and the curves that it follows."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.description.description import Description

Array = NDArray[np.float64]
NODES, WEIGHTS = np.polynomial.legendre.leggauss(4)  # exact for the squares of cubics
LEAST = 1e-9  # of the largest weight of a frequency


def excitations(scene: Description, *, start: float, end: float) -> Iterator[tuple[str, Array, Array]]:
    """Each source that moves the scene between two times (s): its name, frequencies (rad/s) and weights.

    A weight is the square of an acceleration, in a unit of the source's own.
    """
    if scene.waves is not None:
        yield "the sea", *_sea(scene.waves)
    for name, curve, derivative in _curves(scene):
        omega = curve_frequency(curve, derivative, start=start, end=end)
        if omega > 0.0:
            yield name, np.array([omega]), np.ones(1)


def _sea(waves: Any) -> tuple[Array, Array]:
    """Components by their loads, which are the accelerations of a vessel but for its mass."""
    amplitude = np.abs(np.asarray(waves.amplitude))
    weights = np.zeros(amplitude.size)
    for hull in waves.hulls.values():
        load = np.abs(np.asarray(hull.transfer)) * amplitude[:, None]
        largest = load.max(axis=0)
        weights += ((load / np.where(largest > 0.0, largest, 1.0)) ** 2).sum(axis=1)
    omega = np.asarray(waves.omega, dtype=float)
    return omega, weights if weights.any() else amplitude**2 * omega**4


def _curves(scene: Description) -> Iterator[tuple[str, _core.Curve, int]]:
    """All curves of a scene, each with the derivative that is an acceleration of what follows, or a force."""
    for element in (*scene.drivers.values(), *scene.all_loads()):
        for name, value in element.__getstate__().items():
            for curve in value if isinstance(value, list) else [value]:
                if isinstance(curve, _core.Curve):
                    yield f"the {name} of {element.name!r}", curve, _derivative(element, name)


def _derivative(element: Any, name: str) -> int:
    if isinstance(element, _core.Line):
        return {"length": 2, "rate": 1}.get(name, 0)
    return 2 if name in ("curve", "reference") else 0


def curve_frequency(curve: _core.Curve, derivative: int, *, start: float, end: float) -> float:
    """The frequency (rad/s) of a derivative of a curve: rate over size, by their mean squares in that time.

    That of the fastest cosine where there is one; 0 where the derivative is zero or steady.
    """
    parts = curve.to_pieces()
    begins = np.asarray(parts["starts"], dtype=float)
    powers = np.asarray(parts["coefficients"], dtype=float).reshape(-1, 6)
    low = np.clip(begins, start, end)
    high = np.clip(np.append(begins[1:], np.inf), start, end)
    low[0] = min(max(begins[0], start), end)
    times = 0.5 * (high + low)[:, None] + 0.5 * (high - low)[:, None] * NODES - begins[:, None]
    share = 0.5 * (high - low)[:, None] * WEIGHTS
    size, rate = (float((share * _nth(powers, n, times) ** 2).sum()) for n in (derivative, derivative + 1))
    cosines = np.asarray(parts["cosines"], dtype=float).reshape(-1, 3)
    waving = [abs(omega) for amplitude, omega, _ in cosines[: begins.size] if amplitude != 0.0]
    return float(max([np.sqrt(rate / size) if size > 0.0 else 0.0, *waving]))


def _nth(powers: Array, order: int, times: Array) -> Array:
    """The derivative of each row's polynomial at its times."""
    out = np.zeros_like(times)
    for exponent in range(powers.shape[1] - 1, order - 1, -1):
        factor = float(np.prod(np.arange(exponent - order + 1, exponent + 1)))
        out = out * times + factor * powers[:, exponent, None]
    return out
