"""State-space realisation of a rational function, and a block as several that do not feel each other."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from seacrane.hydro.data.memory_model import MemoryBlock
from seacrane.hydro.memory.identification import RationalFit
from seacrane.one_thread import one_thread

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]
TYPICAL_VELOCITY = np.array([0.1, 0.1, 0.1, 0.01, 0.01, 0.01])
MOST_STATES = 12  # of parts that share a block: each block costs its motions besides, each state the others


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
    values, vectors = np.linalg.eigh(0.5 * (reach + reach.T))
    left = vectors * np.sqrt(np.maximum(values, 0.0))
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


def realise_pair(fit: RationalFit, j: int, k: int, cause: str) -> list[MemoryBlock]:
    """Blocks (j, k) and (k, j) of one fit."""
    return [
        realise(fit.numerator, fit.denominator, output=output, input=input_, cause=cause)
        for output, input_ in dict.fromkeys([(j, k), (k, j)])
    ]


def states_at(a: FloatArray, b: FloatArray, omega: FloatArray) -> ComplexArray:
    """``(i omega - A)^-1 B`` (n, states, inputs) at ``omega`` (n,)."""
    resolvent = 1j * omega[:, None, None] * np.eye(len(a)) - a
    inputs = np.broadcast_to(b.astype(complex), (len(omega), *b.shape))
    return np.asarray(np.linalg.solve(resolvent, inputs))


@one_thread
def largest_states(a: FloatArray, b: FloatArray) -> FloatArray:
    """Largest amplitude of every state under a unit harmonic input of any frequency."""
    return np.asarray(np.abs(states_at(a, b, np.geomspace(1e-2, 1e2, 400))).max(axis=(0, 2)))


def independent_blocks(block: MemoryBlock) -> list[MemoryBlock]:
    """Blocks that make the same loads together: A falls apart where no state feels another.

    The passive model of a group is one block of oscillators, of which few share a damper. A block costs the
    square of its states, so that small parts share one, first fit by size.
    """
    from scipy.sparse.csgraph import connected_components

    count, part_of = connected_components(block.A != 0.0, directed=False)
    sizes = np.bincount(part_of, minlength=count)
    shared: list[list[int]] = []
    for part in np.argsort(-sizes, kind="stable"):
        for parts in shared:
            if sizes[parts].sum() + sizes[part] <= MOST_STATES:
                parts.append(part)
                break
        else:
            shared.append([part])
    blocks = []
    for place, parts in enumerate(shared):
        own = np.flatnonzero(np.isin(part_of, parts))
        direct = block.D if place == 0 else np.zeros_like(block.D)
        blocks.append(
            replace(
                block, A=block.A[np.ix_(own, own)], B=block.B[own], C=block.C[:, own], D=direct,
                state_scale=block.state_scale[own],
            )
        )  # fmt: skip
    return blocks
