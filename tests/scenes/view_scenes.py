"""Scenes and short runs that the tests of `view` show."""

from __future__ import annotations

import warnings
from functools import cache

import numpy as np
import pytest

from seacrane import Curve, Result, Scene, cases, simulate
from seacrane.crane import Payload
from seacrane.hydro import shipped_database
from seacrane.warnings import BallastWarning, LargeSwingWarning

HTML_NAME = "</script><b onclick=alert(1)>&amp; barge"


@cache
def case2() -> Result:
    """The paper's lift."""
    with pytest.warns(LargeSwingWarning):
        return simulate(cases.case2(), 60.0)


@cache
def alone() -> Result:
    """A vessel in waves."""
    return simulate(cases.vessel(hs=4.0, tp=10.0), 20.0)


@cache
def pair() -> Result:
    """Two vessels in one sea, one of them by its matrices and with markup for a name."""
    database = shipped_database()
    scene = Scene(name="<i>two vessels</i>")
    scene.add_vessel(database)
    scene.add_vessel(database, name=HTML_NAME, position=(-15, 45, 0), heading_deg=12.0, memory="none")
    scene.add_sea(hs=2.5, tp=8.0, seed=3, count=120)
    scene.add_sea(vessel=HTML_NAME)
    scene.add_crane(base="vessel", payload=Payload(mass=20e3))
    scene.provenance.pop(HTML_NAME)
    for joint in ("A", "main_cylinder", "knuckle_cylinder"):
        scene.add_driver(name=joint, joint=joint, curve=Curve.constant(value=0.0))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", BallastWarning)  # no one would carry out this lift
        return simulate(scene, 20.0)


def angle_between(first: np.ndarray, second: np.ndarray) -> float:
    """Largest angle between unit quaternions, rad."""
    cosine = np.abs(np.sum(first * second, axis=-1)).clip(0.0, 1.0)
    return float(2.0 * np.arccos(cosine).max())
