"""Strip theory against the panel method on the shipped hull: what a motion differs by, sea by sea."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from seacrane import Scene, linear_model, response_statistics
from seacrane.hydro import shipped_database
from seacrane.inputs.frames import MOTIONS
from seacrane.sea import jonswap

from .section import Section

PERIODS, HEADINGS_DEG = (6, 7, 8, 9, 10, 12, 14, 16), (0, 45, 90, 135, 180)  # s


def strip_against_panels() -> Iterator[list[str]]:
    """Largest difference of a motion over the headings, by the largest motion of the panel method there."""
    sys.path.append(str(Path(__file__).resolve().parents[2] / "tools"))
    from compare_strip_panel import strip_database

    warnings.simplefilter("ignore")
    panel, strip = shipped_database(), strip_database()
    models = []
    for database in (panel, strip):
        scene = Scene(name=database.name)
        scene.add_vessel(database, memory="convolution")
        models.append(linear_model(scene, memory="database", database=database))
    for tp in PERIODS:
        sea = jonswap(hs=2.0, tp=tp)
        found = np.array(
            [
                [
                    response_statistics(linear, spectrum=sea, direction=np.radians(h), body="vessel").std
                    for h in HEADINGS_DEG
                ]
                for linear in models
            ]
        )
        off = 100.0 * (np.abs(found[1] - found[0]) / found[0].max(axis=0)).max(axis=0)
        below = sea.energy(minimum_omega=panel.omega[0], maximum_omega=strip.trusted_band[0]) / sea.moment(0)
        yield [f"{tp}", f"{100.0 * below:.0f}", *(f"{value:.0f}" for value in off)]


SECTION = Section(
    title="Strip theory against panels",
    name="strip-motions-by-period",
    text=(
        "The shipped hull by both methods, the matrices of the databases themselves: largest difference of "
        "a motion over five headings, in per cent of the motion at the heading where it is largest. \"Below "
        "band\" is the share of the waves' energy below the band that strip theory is trusted in, in per "
        "cent."
    ),
    head=["Tp s", "below band", *MOTIONS],
    rows=strip_against_panels,
    sources=("cpp/seacrane/strip", "python/seacrane/hydro", "python/seacrane/analysis",
             "python/seacrane/data", "tools/compare_strip_panel.py"),
)  # fmt: skip
