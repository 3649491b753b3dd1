"""Tables at other places: straight lines, and cubic splines as weight matrices, which serve any number."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.arrays import Array
from seacrane.one_thread import one_thread


def spline_weights(knots: Array, query: Array, *, period: float | None = None) -> Array:
    """Weights (q, n) such that ``weights @ values`` is the cubic spline through ``values`` at ``query``.

    Parameters
    ----------
    knots : (n,) strictly increasing abscissae; for a periodic spline all within one period.
    query : (q,) abscissae inside the knots' range (anywhere for a periodic spline).
    period : length of the period; None gives a not-a-knot spline (a lower polynomial below four knots).

    Notes
    -----
    Second derivatives follow from continuity of the first (de Boor, A Practical Guide to Splines, ch. IV).
    """
    if period is not None:
        x = np.concatenate([knots[-1:] - period, knots, knots[:1] + period])
        where = knots[0] + np.mod(query - knots[0], period)
        curvature = _curvature(np.asarray(knots, float).tobytes(), period)
        n = len(knots)
        wrap = np.concatenate([[n - 1], np.arange(n), [0]])
        return _evaluate(x, where, wrap, curvature[wrap])
    if len(knots) < 4:
        return _polynomial_weights(knots, query)
    every = np.arange(len(knots))
    return _evaluate(knots, query, every, _curvature(np.asarray(knots, float).tobytes(), None))


def by_straight_lines(x: Array, table: Array, where: Array) -> Array:
    """Rows (q, ...) of a table (n, ...) over rising ``x`` at places (q,) within its range."""
    right = np.clip(np.searchsorted(x, where), 1, len(x) - 1)
    part = ((where - x[right - 1]) / (x[right] - x[right - 1])).reshape(-1, *[1] * (table.ndim - 1))
    return np.asarray((1.0 - part) * table[right - 1] + part * table[right])


def _evaluate(x: Array, query: Array, value: NDArray[np.intp], curvature: Array) -> Array:
    """Piecewise cubic from the columns of the knots' values, and the rows of their second derivatives."""
    i = np.searchsorted(x[1:-1], query, side="right")
    h = x[i + 1] - x[i]
    right = (query - x[i]) / h
    left = 1.0 - right
    bend_left = (left**3 - left) * h**2 / 6.0
    bend_right = (right**3 - right) * h**2 / 6.0
    return _core.spline_rows(
        knot=i, column=value, left=left, right=right, bend_left=bend_left, bend_right=bend_right,
        curvature=curvature,
    )  # fmt: skip


@lru_cache(maxsize=16)
@one_thread
def _curvature(knots: bytes, period: float | None) -> Array:
    """Matrix (n, n) from values to second derivatives; one sea after another asks for those of a database."""
    x = np.frombuffer(knots)
    out = _not_a_knot_curvature(x) if period is None else _periodic_curvature(x, period)
    out.setflags(write=False)
    return out


def _not_a_knot_curvature(x: Array) -> Array:
    """Matrix (n, n) from values to second derivatives with continuous third derivative next to both ends."""
    n = len(x)
    h = np.diff(x)
    left, right = np.zeros((n, n)), np.zeros((n, n))
    for i in range(1, n - 1):
        left[i, i - 1 : i + 2] = h[i - 1], 2.0 * (h[i - 1] + h[i]), h[i]
        right[i, i - 1 : i + 2] = 6.0 / h[i - 1], -6.0 / h[i - 1] - 6.0 / h[i], 6.0 / h[i]
    left[0, :3] = h[1], -h[0] - h[1], h[0]
    left[-1, -3:] = h[-1], -h[-1] - h[-2], h[-2]
    return np.asarray(np.linalg.solve(left, right))


def _periodic_curvature(x: Array, period: float) -> Array:
    """Matrix (n, n) from values to second derivatives of the periodic spline."""
    h = np.diff(np.append(x, x[0] + period))[:, None]
    before, own = np.roll(h, 1, axis=0), np.eye(len(x))
    last, following = np.roll(own, -1, axis=1), np.roll(own, 1, axis=1)
    left = 2.0 * (before + h) * own + before * last + h * following
    right = 6.0 / before * last + 6.0 / h * following - (6.0 / before + 6.0 / h) * own
    return np.asarray(np.linalg.solve(left, right))


def _polynomial_weights(x: Array, query: Array) -> Array:
    """Lagrange weights of the polynomial through one to three knots."""
    weights = np.ones((len(query), len(x)))
    for i in range(len(x)):
        for j in range(len(x)):
            if j != i:
                weights[:, i] *= (query - x[j]) / (x[i] - x[j])
    return weights
