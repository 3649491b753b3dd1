"""Two hulls in one water: against Capytaine's own motions, point sources, and RM3 by three panel codes."""

from __future__ import annotations

import tempfile
import warnings
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import test_hydro_group_capytaine as pairs
from scipy.special import hankel2
from test_hydro_group_rm3 import OMEGA, TABLE, three_codes

from seacrane.hydro import HydroGroup

from .row import Row

RM3 = "RM3 of two bodies"
WORDS = {
    ("added_mass", (2, 2)): "added mass of the float in heave",
    ("damping", (2, 2)): "damping of the float in heave",
    ("added_mass", (8, 2)): "added mass that couples the spar to the float's heave",
    ("damping", (8, 2)): "damping that couples the spar to the float's heave",
    ("added_mass", (8, 8)): "added mass of the spar's thin plate in heave",
}


def capytaine() -> Iterator[Row]:
    """Coupled motions of two hulls, and what far hulls feel of each other."""
    with tempfile.TemporaryDirectory() as name, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        folder = Path(name)
        mine, theirs = pairs.both_motions(folder)
        yield Row(
            subject="Hydrodynamics",
            compared="two hulls beside each other: coupled motions from matrices as read",
            reference="Capytaine's own motions",
            difference=float(np.abs(mine - theirs).max() / np.abs(theirs).max()),
            unit="",
            limit=1e-6,
            test="hydro/test_hydro_group_capytaine.py",
        )
        turned = pairs.turned_twice(folder)[1]
        off = []
        for distance in pairs.DISTANCES:
            group = pairs.apart(distance, folder)
            closed = turned * hankel2(0, group.omega[1] ** 2 / group.g * distance)
            off.append(abs(pairs.coupling_of(group)[1] / closed - 1.0))
        yield Row(
            subject="Hydrodynamics",
            compared="two hemispheres 0.1 to 3 km apart: coupling in heave, Capytaine's panels",
            reference="waves of point sources, exp(2 i d) H0(k R)",
            difference=float(max(off)),
            unit="",
            limit=0.03,
            test="hydro/test_hydro_group_capytaine.py",
        )


def codes(shared: Path) -> Iterator[Row]:
    """RM3: how far Capytaine and NEMOH are from WAMIT, entry by entry."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        groups = three_codes(shared / "rm3")
    reference = groups.pop("wamit")
    for (table, entry), words in WORDS.items():
        value = _value(reference, table, entry)
        worst = max(abs(_value(group, table, entry) / value - 1.0) for group in groups.values())
        yield Row(
            subject="Hydrodynamics",
            compared=f"{RM3}: {words} at 1 rad/s, Capytaine and NEMOH",
            reference="WAMIT",
            difference=worst,
            unit="",
            limit=TABLE[table][entry][1],
            test="hydro/test_hydro_group_rm3.py",
        )


def _value(group: HydroGroup, table: str, entry: tuple[int, int]) -> float:
    at = int(np.abs(group.omega - OMEGA).argmin())
    return float(getattr(group, table)[at][entry])
