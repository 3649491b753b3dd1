"""How far a hull's hydrodynamics still depend on its mesh."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from seacrane.hydro.hull.hull import Hull
from seacrane.hydro.hull.solution import HullSolution
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.frames import MOTIONS
from seacrane.warnings import MeshConvergenceWarning

FloatArray = NDArray[np.float64]

LARGEST_CHANGE = 0.05  # of the largest of an entry
FEWEST = 8  # panels along the length and around, of the coarse mesh


def coarser(hull: Hull) -> Hull:
    """The hull with about half the panels, even ones."""
    size = np.sqrt(2.0) * hull.panel_size
    girth = 0.5 * (hull.breadth + 2.0 * hull.draught)
    return hull.remeshed(
        stations=max(FEWEST, round(hull.length / size)), girth=max(FEWEST // 2, round(girth / size))
    )


def convergence_told(
    hull: Hull, solution: HullSolution, solve: Callable[[Hull], HullSolution], inside: NDArray[np.bool_]
) -> str:
    """What changes with half the panels, as the end of a database's `source`.

    ``solve`` solves the coarse hull at the same frequencies, of which those ``inside`` (n,) count.

    Warns
    -----
    MeshConvergenceWarning : an entry on the diagonal changes by more than 5 % of its largest.
    """
    coarse = coarser(hull)
    other = solve(coarse)
    changes = {
        f"{symbol}{i + 1}{i + 1}": _change(getattr(solution, name), getattr(other, name), i, inside)
        for symbol, name in (("A", "added_mass"), ("B", "damping"))
        for i in range(len(MOTIONS))
    }
    entry, worst = max(changes.items(), key=lambda pair: pair[1])
    told = f"; with {len(coarse.panels)} in place of {len(hull.panels)} panels {entry} changes by {worst:.2%}"
    if worst > LARGEST_CHANGE:
        large = ", ".join(f"{name} {value:.1%}" for name, value in changes.items() if value > LARGEST_CHANGE)
        warn_caller(
            f"hull {hull.name!r}: with {len(coarse.panels)} in place of {len(hull.panels)} panels these "
            f"change, by their largest: {large}. Mesh it finer: hull.remeshed(stations=..., girth=...)",
            MeshConvergenceWarning,
        )
    return told


def _change(fine: FloatArray, coarse: FloatArray, i: int, inside: NDArray[np.bool_]) -> float:
    """Largest difference of a diagonal entry over its largest; zero where it is negligible."""
    mine, theirs = fine[inside, i, i], coarse[inside, i, i]
    largest = float(np.abs(mine).max())
    return float(np.abs(mine - theirs).max()) / largest if largest > 0.0 else 0.0
