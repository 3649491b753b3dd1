"""The constrained linear problem [M, -D^T; D, 0] [a; lambda] = [f; gamma] (paper eqs. 9 and 35)."""

from __future__ import annotations

import numpy as np

from .rotation import Array


def solve_full_rank(mass: Array, rows: Array, force: Array, gamma: Array) -> tuple[Array, Array]:
    """Pivoted LU of the whole system after scaling by the diagonal of the mass matrix and by row length."""
    n, m = len(mass), len(rows)
    s = 1.0 / np.sqrt(np.diagonal(mass))
    scaled = rows * s
    e = 1.0 / np.sqrt(np.einsum("ij,ij->i", scaled, scaled))
    scaled *= e[:, None]
    system = np.zeros((n + m, n + m))
    system[:n, :n] = mass * s * s[:, None]
    system[:n, n:] = -scaled.T
    system[n:, :n] = scaled
    solution = np.linalg.solve(system, np.concatenate([s * force, e * gamma]))
    return s * solution[:n], e * solution[n:]


def solve_redundant(
    mass: Array, rows: Array, force: Array, gamma: Array, rcond: float
) -> tuple[Array, Array]:
    """Least constraint (Gauss) by singular values: unique a; of all multipliers those of least norm (SI).

    Rows count as dependent below `rcond` times the largest singular value, with rows of unit length in the
    mass metric. A mechanism passing a singular position needs it well above the drift: a constraint error
    c splits the branches there by sqrt(c), and a solver that resolves the gap turns into the other branch.
    """
    factor = np.linalg.cholesky(mass)
    whitened = np.linalg.solve(factor, rows.T)
    e = 1.0 / np.linalg.norm(whitened, axis=0)
    free = np.linalg.solve(factor, force)
    u, sigma, vt = np.linalg.svd(whitened * e)
    count = int(np.sum(sigma > rcond * sigma[0]))
    u, sigma, null, vt = u[:, :count], sigma[:count], vt[count:], vt[:count]
    # whitened e = u sigma vt, so the constraint reads vt^T sigma u^T a = e gamma
    along = (vt @ (e * gamma)) / sigma - u.T @ free
    acceleration = np.linalg.solve(factor.T, free + u @ along)
    multipliers = e * (vt.T @ (along / sigma))
    kernel = (null * e).T
    if kernel.size:
        multipliers -= kernel @ np.linalg.lstsq(kernel, multipliers, rcond=None)[0]
    return acceleration, multipliers


def rank(mass: Array, rows: Array, rcond: float = 1e-10) -> int:
    """Number of independent rows, measured in the mass metric."""
    if not len(rows):
        return 0
    whitened = np.linalg.solve(np.linalg.cholesky(mass), rows.T)
    whitened /= np.linalg.norm(whitened, axis=0)
    sigma = np.linalg.svd(whitened, compute_uv=False)
    return int(np.sum(sigma > rcond * sigma[0]))
