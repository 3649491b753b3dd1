"""State-space realisation of a rational function: balanced, then scaled to the size of its output."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from seacrane.hydro.data.memory_model import MemoryBlock
from seacrane.one_thread import one_thread

FloatArray = NDArray[np.float64]

TYPICAL_VELOCITY = np.array([0.1, 0.1, 0.1, 0.01, 0.01, 0.01])


def realise(
    numerator: FloatArray, denominator: FloatArray, *, output: int, input: int, cause: str
) -> MemoryBlock:
    """Memory block of a strictly proper, stable ``numerator / denominator`` (highest power first).

    The companion form is balanced (equal, diagonal Gramians: Moore 1981), then all states are multiplied by
    the norm of the output row, which makes a state as large as the load it stands for.

    Raises
    ------
    ValueError : a pole with a real part that is not negative.
    """
    from scipy.linalg import solve_continuous_lyapunov

    order = len(denominator) - 1
    poles = np.roots(denominator)
    if np.any(poles.real >= 0.0):
        raise ValueError(
            f"memory block {output + 1}{input + 1}: unstable pole {poles[np.argmax(poles.real)]:.4g} 1/s"
        )
    gain = float(np.abs(numerator).max()) or 1.0
    a = np.zeros((order, order))
    a[0] = -denominator[1:] / denominator[0]
    a[1:, :-1] = np.eye(order - 1)
    b = np.eye(order, 1)
    c = numerator[None, :] / denominator[0] / gain
    with one_thread:
        reach = solve_continuous_lyapunov(a, -b @ b.T)
        observe = solve_continuous_lyapunov(a.T, -c.T @ c)
    left = _square_root(reach)
    rotation, hankel, _ = np.linalg.svd(left.T @ observe @ left)
    transform = left @ rotation / np.sqrt(np.sqrt(hankel))
    inverse = np.linalg.inv(transform)
    a, b, c = inverse @ a @ transform, inverse @ b, c @ transform * gain
    size = float(np.linalg.norm(c))
    b, c = b * size, c / size
    return MemoryBlock(
        cause=cause,
        outputs=np.array([output]),
        inputs=np.array([input]),
        A=a,
        B=b,
        C=c,
        D=np.zeros((1, 1)),
        state_scale=largest_states(a, b) * TYPICAL_VELOCITY[input],
    )


def _square_root(gramian: FloatArray) -> FloatArray:
    """Matrix L with L L^T the symmetric, positive semi-definite ``gramian``."""
    values, vectors = np.linalg.eigh(0.5 * (gramian + gramian.T))
    return np.asarray(vectors * np.sqrt(np.maximum(values, 0.0)))


@one_thread
def largest_states(a: FloatArray, b: FloatArray) -> FloatArray:
    """Largest amplitude of every state under a unit harmonic input of any frequency."""
    omega = np.geomspace(1e-2, 1e2, 400)
    resolvent = 1j * omega[:, None, None] * np.eye(len(a)) - a
    states = np.linalg.solve(resolvent, np.broadcast_to(b.astype(complex), (len(omega), *b.shape)))
    return np.asarray(np.abs(states).max(axis=(0, 2)))
