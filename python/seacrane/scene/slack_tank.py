"""add_slack_tank(): a tank whose free surface takes stability from a vessel."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from seacrane.description.description import Description
from seacrane.description.given import given_vessels
from seacrane.description.provenance import VesselProvenance
from seacrane.description.vessel_hydrodynamics import VesselHydrodynamics
from seacrane.errors import SceneError
from seacrane.inputs.checked import number_of


def add_slack_tank(
    scene: Description, *, moment: float, trim_moment: float = 0.0, vessel: str | None = None
) -> VesselHydrodynamics:
    """Take the free surface of a slack tank from a vessel's stability, by its moment.

    C44 becomes less by g moment, and GM by moment over the displacement. The tank's weight is not added: it
    is that of the database's condition. Several tanks add up; `statics` tells GM with and without them.

    Parameters
    ----------
    moment : float
        Free-surface moment rho i, kg m: the density of what is in the tank times the second moment of its
        surface about the longitudinal axis, l b^3 / 12 of a rectangle. 1 t m is 1000.
    trim_moment : float
        Likewise about the transverse axis, for C55.
    vessel : str, optional
        Default: the only one.

    Returns
    -------
    VesselHydrodynamics
        In the place of the one before.

    Raises
    ------
    SceneError
        For a moment below zero or above what the vessel's restoring holds, and a vessel that is not there.
    """
    given = given_vessels(scene)
    floating = {name: one for name, one in scene.vessels.items() if one.body not in given}
    chosen = {name: one for name, one in floating.items() if vessel in (None, one.body)}
    if len(chosen) != 1:
        known = ", ".join(repr(one.body) for one in floating.values()) or "none"
        raise SceneError(
            f"slack tank: vessel is {vessel!r}, and the vessels afloat are {known}; name one of them"
        )
    name, afloat = next(iter(chosen.items()))
    restoring = np.array(afloat.restoring)
    taken = []
    for key, value, motion in (("moment", moment, 3), ("trim_moment", trim_moment, 4)):
        taken.append(scene.gravity * number_of(f"slack tank: {key}", value))
        if not 0.0 <= taken[-1] < max(restoring[motion, motion], 1e-300):
            raise SceneError(
                f"slack tank: {key} is {value:g} kg m, and the restoring of vessel {name!r} is that of "
                f"{restoring[motion, motion] / scene.gravity:.6g} kg m; give a moment from 0 to below that"
            )
    restoring[[3, 4], [3, 4]] -= taken
    changed = VesselHydrodynamics(**{**afloat.__getstate__(), "restoring": restoring})
    scene.vessels[name] = changed
    source = scene.provenance.get(name, VesselProvenance())
    before = source.slack_tanks or (0.0, 0.0)
    scene.provenance[name] = replace(source, slack_tanks=(before[0] + taken[0], before[1] + taken[1]))
    return changed
