"""Which formulation costs less where loops are left to rows: an estimate of operations per evaluation."""

from __future__ import annotations

from seacrane import _core

# Multiplications, each about as many as a count of the loops of the core gives.
PER_BODY = 2000.0  # kinematics, inertia and loads, in either form
PER_RESPONSE = 150.0  # of one body to one row of a loop
EIGENVECTORS = 9.0  # times the rows cubed, where rows depend on each other
LOST_DIGITS = 1e5  # S_ii / d_i beyond which the redundant form is solved by a dense LU, as in the core
# An evaluation of the redundant form must be this much dearer before it is left: where a mechanism folds, it
# can take a hundred times fewer steps.
MARGIN = 50.0


def recursive_pays(model: _core.Model) -> bool:
    """Whether the redundant form would be solved densely and the recursive one costs far less.

    Dense: constraints that depend on each other, or masses so different that the sparse factors lose their
    digits. One such joint makes all of the scene dense, so a chain pays for a door on two hinges beside it;
    the recursive form keeps its tree and solves the rows of its loops alone.
    """
    dependent = model.assembly["rank"] < model.constraints
    if not dependent and not model.assembly["condition"] > LOST_DIGITS:
        return False
    bodies, rows = model.merge["coordinates"] / 6.0, float(model.merge["constraints"])
    loops = float(model.tree["loop_rows"])
    unknowns = 6.0 * bodies + rows
    dense = PER_BODY * bodies + 2.0 / 3.0 * unknowns**3
    tree = PER_BODY * bodies + PER_RESPONSE * bodies * loops + loops**3 / 3.0
    if dependent:
        dense += EIGENVECTORS * rows**3
        tree += PER_RESPONSE * bodies * loops + EIGENVECTORS * loops**3
    return bool(dense > MARGIN * tree)
