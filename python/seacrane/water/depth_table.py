"""Added mass over the depth of a part, from solutions on a ladder of draughts: pile-up, ramp, both limits."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from seacrane.water.added_mass import ROUNDING, ramp
from seacrane.water.mesh_volume import MeshShape
from seacrane.water.panel_added_mass import PanelLadder
from seacrane.water.parts import RAMP_KNOTS

Array = NDArray[np.float64]

VOLUME_KNOTS = 32
BESIDE_KINK = 1e-3  # of the height
APART = 1e-5  # of the height: the least between two depths


@dataclass(frozen=True, kw_only=True, eq=False)
class DepthTable:
    """Added mass over density (m3) over depth, from a ladder.

    Attributes
    ----------
    rungs : (n,) depths of the ladder, m, from 0 to where the fluid is unbounded.
    added, low : (n, 3) at the rungs, m3, before pile-up and ramp.
    over : m, of the ramp of a flat bottom; 0 without.
    mended : largest change of added mass so that it grows, over the largest of all.
    """

    height: float
    wetting: float
    over: float
    mended: float
    rungs: Array
    added: Array
    low: Array

    @staticmethod
    def of(ladder: PanelLadder, shape: MeshShape, *, wetting: float, slam: float) -> DepthTable:
        """Of a ladder of a mesh; wetting and C_S as of `from_mesh`."""
        size, flat = shape.size, shape.flat
        last, root = float(ladder.draughts[-1]), float(np.sqrt(size[0] * size[1]))
        rungs = np.concatenate([[0.0], ladder.draughts, [last + max(last - size[2], root)]])
        deep = np.diag(ladder.unbounded)
        touch = at_touch(ladder.draughts, ladder.added, flat)
        solved = np.concatenate([touch[None], ladder.added, deep[None]])
        grown = np.maximum.accumulate(np.clip(solved, 0.0, deep), axis=0)
        slow = at_touch(ladder.draughts, ladder.low, flat)
        return DepthTable(
            height=float(size[2]), wetting=wetting, rungs=rungs, added=grown,
            over=2.0 * touch[2] / (slam * flat) if flat > 0.0 else 0.0,
            mended=float(np.max(np.abs(grown - solved)) / deep.max()),
            low=np.concatenate([slow[None], ladder.low, deep[None]]),
        )  # fmt: skip

    def depths(self, kinks: Array) -> Array:
        """Depths for splines through volumes and added masses, beside kinks of the volume too."""
        wetted = self.rungs[self.rungs <= self.height] / self.wetting
        beside = BESIDE_KINK * self.height
        ends = np.array([self.height / self.wetting, self.height])
        found = [
            self.rungs, wetted, np.linspace(0.0, self.height, VOLUME_KNOTS + 1), ends, kinks, kinks - beside,
            kinks + beside,
        ]  # fmt: skip
        if self.over > 0.0:
            found.append(np.linspace(0.0, (1.0 + ROUNDING) * self.over, RAMP_KNOTS + 1))
        depths = np.unique(np.concatenate(found))
        depths = depths[(depths >= 0.0) & (depths <= self.rungs[-1])]
        apart = np.diff(depths, prepend=-np.inf) > APART * self.height
        return np.asarray(depths[apart])

    def fast(self, depths: Array) -> Array:
        """At infinite frequency: that of the section as it is wetted, a flat bottom's over its ramp."""
        piled = np.minimum(self.wetting * depths, np.maximum(depths, self.height))
        out = between(self.rungs, self.added, piled)
        if self.over > 0.0:
            out[:, 2] += self.added[0, 2] * (ramp(depths, self.over) - 1.0)
        return np.maximum.accumulate(np.maximum(out, 0.0), axis=0)

    def slow(self, depths: Array) -> Array:
        """At zero frequency, without pile-up."""
        return between(self.rungs, self.low, depths)

    def slower(self) -> Array:
        """What a slow motion has over what a fast one has, at half its height, along the axes."""
        half = np.array([0.5 * self.height])
        fast = between(self.rungs, self.added, half)[0]
        return np.asarray(self.slow(half)[0] / np.maximum(fast, 1e-12 * fast.max()))


def between(rungs: Array, values: Array, depths: Array) -> Array:
    """Values (n, 3) at rungs (n,) by a monotone spline, at depths (m,): (m, 3)."""
    from scipy.interpolate import PchipInterpolator

    return np.asarray(PchipInterpolator(rungs, values)(depths))


def at_touch(draughts: Array, values: Array, flat: float) -> Array:
    """Added mass (3,) as the bottom touches: half of a plate's across a flat one, else none.

    The sides add as depth times the logarithm of depth, as of a plate with a thin edge.
    """
    out = np.zeros(3)
    if flat > 0.0:
        x = draughts[:2] * np.log(np.sqrt(flat) * np.e / draughts[:2])
        first, second = values[0, 2], values[min(1, len(values) - 1), 2]
        near = len(x) > 1 and 0.0 < x[0] < x[1] and draughts[1] < np.sqrt(flat)
        out[2] = first - (second - first) * x[0] / (x[1] - x[0]) if near else first
    return np.maximum(out, 0.0)
