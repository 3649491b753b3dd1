"""`passivity_certificate`: proof, at all frequencies at once, that a memory model delivers no energy.

A model ``K(s) = D + C (s I - A)^-1 B`` is passive where A is stable and ``Phi(i w) = K(i w) + K(i w)^H``
has no negative eigenvalue at any w. ``Phi`` of a retardation function vanishes at w = 0 and at infinity,
where the usual Hamiltonian test (Boyd, Balakrishnan & Kabamba 1989, doi 10.1007/BF02551385) is singular. Both
zeros are divided out first: with ``a`` = 1 rad/s, ``A' = A`` and ``C' = C``::

    (w^2 + a^2)^2 / w^2 Phi(i w)  =  Phi'(i w),   B' = -A^-2 (a^2 I - A^2)^2 B,   D' = -C A B

which holds if ``K(0) = 0`` and C B and C A^-2 B are symmetric (were they not, Phi would be indefinite near
infinity or zero). Eigenvalues of Phi' change sign only at imaginary eigenvalues of its Hamiltonian matrix.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from seacrane.arrays import Array
from seacrane.errors import PassivityError
from seacrane.hydro.data.memory_model import (
    RADIATION,
    MemoryBlock,
    MemoryModel,
    Passivity,
    states_at,
    transfer,
)
from seacrane.hydro.memory.identification import RationalFit
from seacrane.one_thread import one_thread

SYMMETRY = 1e-8
NEAR_AXIS = 1e-4  # of 1 + |eigenvalue|: generous, as every candidate is followed up by a sample


@dataclass(frozen=True, kw_only=True)
class PassivityCertificate:
    """What is proven about the memory of one cause.

    Attributes
    ----------
    passive : whether the model is proven passive, by the pencil test.
    energy : whether the identity is an energy of every block: ``A + A^T <= 0`` and ``B = C^T``, so that
        ``|x|^2 / 2`` (J) never grows by more than the work done on it. A proof of its own; models that are
        passive without being written in energy coordinates do not have it.
    margin : smallest eigenvalue over a dense grid (its sign is proven between the samples), and at zero and
        infinite frequency, of
        ``(w^2 + a^2)^2 / w^2 Re K(i w)`` (a = 1 rad/s; without the factor of a zero that the model does not
        have), each motion scaled by the square root of its largest damping.
    crossings : rad/s where an eigenvalue of Re K changes sign.
    reason : in words.
    """

    passive: bool
    energy: bool
    margin: float
    crossings: tuple[float, ...] = ()
    reason: str


@one_thread
def passivity_certificate(model: MemoryModel, *, cause: str = RADIATION) -> PassivityCertificate:
    """Prove, or refute, that all blocks of one ``cause`` together are passive.

    Raises
    ------
    ValueError : the model has no block of that cause.
    """
    blocks = [block for block in model.blocks if block.cause == cause]
    if not blocks:
        known = ", ".join(sorted({block.cause for block in model.blocks})) or "none"
        raise ValueError(f"the memory model has no block of cause {cause!r}; it has: {known}")
    return certify(blocks)


def require_passive(model: MemoryModel) -> PassivityCertificate:
    """The certificate of a model's radiation blocks, or `PassivityError` where they are not passive."""
    certificate = passivity_certificate(model)
    if not certificate.passive:
        raise PassivityError(
            f"the radiation memory is not passive: {certificate.reason}. It can feed energy into a motion; "
            "use fit_memory(kind='by-motion')"
        )
    return certificate


@one_thread
def certify(blocks: Sequence[MemoryBlock]) -> PassivityCertificate:
    """`passivity_certificate` of a sequence of blocks whose loads add up."""
    a, b, c, d = _side_by_side(blocks)
    verdict = partial(PassivityCertificate, energy=all(is_energy_form(block) for block in blocks))
    unstable = float(np.linalg.eigvals(a).real.max())
    if unstable >= 0.0:
        return verdict(passive=False, margin=-np.inf, reason=f"a pole grows with {unstable:.3g} 1/s")
    static = d - c @ np.linalg.solve(a, b)
    origin = bool(np.abs(static).max() < SYMMETRY * max(np.abs(c @ b).max(), np.abs(d).max()))
    infinity = not np.any(d)
    slope = c @ np.linalg.solve(a, np.linalg.solve(a, b))
    for zero, leading, where in ((infinity, c @ b, "infinite"), (origin, slope, "zero")):
        if zero and np.abs(leading - leading.T).max() > SYMMETRY * np.abs(leading).max():
            reason = f"it is not symmetric towards {where} frequency, so that its damping is indefinite there"
            return verdict(passive=False, margin=-np.inf, reason=reason)
    shaped = b - np.linalg.solve(a, np.linalg.solve(a, b)) if origin else b
    if infinity:  # both zeros are divided out: B' and D'
        d, shaped = -c @ a @ shaped, shaped - a @ (a @ shaped)
    feed = d + d.T
    least = float(np.linalg.eigvalsh(feed)[0])
    if least <= 0.0:
        reason = f"its damping is not positive towards infinite frequency ({least:.3g})"
        return verdict(passive=False, margin=least / 2.0, reason=reason)
    return verdict(**_examine(a, shaped, c, feed))


@one_thread
def is_energy_form(block: MemoryBlock) -> bool:
    """Whether P = I certifies a block: B = C^T exactly, A + A^T <= 0 to rounding, D + D^T >= 0."""
    same = np.array_equal(block.inputs, block.outputs) and np.array_equal(block.B, block.C.T)
    if not same or not len(block.A):
        return False
    growth = np.linalg.eigvalsh(block.A + block.A.T)[-1]
    through = np.linalg.eigvalsh(block.D + block.D.T)[0]
    return bool(growth <= 1e-12 * np.abs(block.A).max() and through >= 0.0)


def _side_by_side(blocks: Sequence[MemoryBlock]) -> tuple[Array, Array, Array, Array]:
    """A, B, C, D of all blocks over the motions they touch, each motion and state scaled to order one."""
    count = sum(len(block.A) for block in blocks)
    m = 1 + max(int(max(block.outputs.max(), block.inputs.max())) for block in blocks)
    a, b, c, d = np.zeros((count, count)), np.zeros((count, m)), np.zeros((m, count)), np.zeros((m, m))
    start = 0
    for block in blocks:
        rows = slice(start, start + len(block.A))
        a[rows, rows] = block.A
        b[rows, block.inputs] = block.B
        c[block.outputs, rows] = block.C
        d[np.ix_(block.outputs, block.inputs)] += block.D
        start += len(block.A)
    omega = np.geomspace(1e-2, 1e2, 200)
    damping = transfer(a, b, c, d, omega).real
    peak = np.sqrt(np.abs(np.diagonal(damping, axis1=1, axis2=2)).max(axis=0))
    used = np.flatnonzero(np.any(b, axis=0) | np.any(c, axis=1) | np.any(d, axis=0) | np.any(d, axis=1))
    peak[peak == 0.0] = 1.0
    b, c, d = (b / peak)[:, used], (c / peak[:, None])[used], (d / np.outer(peak, peak))[np.ix_(used, used)]
    size = np.sqrt(np.linalg.norm(b, axis=1).mean() / max(np.linalg.norm(c, axis=0).mean(), 1e-300)) or 1.0
    return a, b / size, c * size, d


def _examine(a: Array, b: Array, c: Array, feed: Array) -> dict[str, Any]:
    """Samples between all frequencies near which the Hamiltonian matrix has imaginary eigenvalues, where
    alone a sign could change, and on a grid for the margin."""
    inner = a - b @ np.linalg.solve(feed, c)
    hamiltonian = np.block(
        [[inner, -b @ np.linalg.solve(feed, b.T)], [c.T @ np.linalg.solve(feed, c), -inner.T]]
    )
    values = np.linalg.eigvals(hamiltonian)
    at = np.sort(np.abs(values.imag[np.abs(values.real) < NEAR_AXIS * (1.0 + np.abs(values))]))
    ends = np.concatenate([[0.0], at, [1e4 * (1.0 + np.abs(np.linalg.eigvals(a)).max())]])
    middles = 0.5 * (ends[1:] + ends[:-1])
    omega = np.unique(np.concatenate([[0.0], at, middles, np.geomspace(1e-4, 1e4, 2001)]))
    kernel = transfer(a, b, c, 0.5 * feed, omega)
    lowest = np.linalg.eigvalsh(0.5 * (kernel + kernel.conj().swapaxes(1, 2)))[:, 0]
    margin = float(min(lowest.min(), 0.5 * np.linalg.eigvalsh(feed)[0]))
    if margin > 0.0:
        reason = "no eigenvalue of its damping changes sign"
        return {"passive": True, "margin": margin, "reason": reason}
    signs = np.flatnonzero((lowest[1:] > 0.0) != (lowest[:-1] > 0.0))
    crossings = tuple(float(0.5 * (omega[i] + omega[i + 1])) for i in signs)
    reason = f"its damping has a negative eigenvalue at {omega[lowest.argmin()]:.3g} rad/s"
    return {"passive": False, "margin": margin, "reason": reason, "crossings": crossings}


def smallest_damping(blocks: Sequence[MemoryBlock], damping: Array, omega: Array) -> tuple[float, float]:
    """Smallest eigenvalue of the radiation blocks' damping together at ``omega`` (n,), and where, rad/s.

    Scaled by the largest diagonals of the data's ``damping``. No pair's own fit keeps it positive.
    """
    peak = np.sqrt(np.maximum(np.diagonal(damping, axis1=1, axis2=2).max(axis=0), 1e-300))
    active = peak > 1e-6 * peak.max()
    total = np.zeros((len(omega), *damping.shape[1:]))
    for block in blocks if np.any(damping) else ():
        if block.cause == RADIATION:
            total[:, block.outputs[:, None], block.inputs] += block.transfer(omega).real
    scaled = (0.5 * (total + total.swapaxes(1, 2)) / np.outer(peak, peak))[:, active][:, :, active]
    lowest = np.linalg.eigvalsh(scaled)[:, 0]
    where = int(lowest.argmin())
    return float(lowest[where]), float(omega[where])


def joint_passivity(blocks: Sequence[MemoryBlock], damping: Array, band: tuple[float, float]) -> Passivity:
    """`smallest_damping` from 1e-3 to 1e3 rad/s, and over ``band``."""
    minimum, at = smallest_damping(blocks, damping, np.geomspace(1e-3, 1e3, 4001))
    in_band, in_band_at = smallest_damping(blocks, damping, np.linspace(*band, 1001))
    return Passivity(minimum=minimum, omega=at, in_band=in_band, in_band_omega=in_band_at)


TYPICAL_VELOCITY = np.array([0.1, 0.1, 0.1, 0.01, 0.01, 0.01])
MOST_STATES = 12  # of parts that share a block: each block costs its motions besides, each state the others


def realise(numerator: Array, denominator: Array, *, output: int, input: int, cause: str) -> MemoryBlock:
    """Memory block of a strictly proper, stable ``numerator / denominator`` (highest power first).

    The companion form is balanced (equal, diagonal Gramians: Moore 1981), then all states are multiplied by
    the norm of the output row, which makes a state as large as the load it stands for.

    Raises ValueError: a pole with a real part that is not negative.
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
        cause=cause, outputs=np.array([output]), inputs=np.array([input]), A=a, B=b, C=c,
        D=np.zeros((1, 1)), state_scale=largest_states(a, b) * TYPICAL_VELOCITY[input],
    )  # fmt: skip


def realise_pair(fit: RationalFit, j: int, k: int, cause: str) -> list[MemoryBlock]:
    """Blocks (j, k) and (k, j) of one fit."""
    return [
        realise(fit.numerator, fit.denominator, output=output, input=input_, cause=cause)
        for output, input_ in dict.fromkeys([(j, k), (k, j)])
    ]


@one_thread
def largest_states(a: Array, b: Array) -> Array:
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
