"""The water between two hulls: how wide it is, and where it resonates; and what only looks like it.

Piston mode of the water in a gap of width b between hulls of draught d, with H = 1.5 times the overall width
(Molin 2001, J. Fluid Mech. 430, 27-50, for a moon pool; quoted, not read)::

    w^2 = g / (d + b / pi (3 / 2 + ln(H / 2 b)))

Longer modes of the gap lie above it, up to the first wave across it, ``w^2 = pi g / b``. Irregular
frequencies are no resonance of the water outside: they are those of the water *inside* a hull that is zero
on its sides, ``w^2 = g k coth(k T)``, ``k^2 = (i pi / L)^2 + (j pi / B)^2`` for a box. They stay where they
are with another gap.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from seacrane.arrays import Array
from seacrane.hydro.data.hydro_group_data import GroupBody, HydroGroupData, mass_of, mass_scales
from seacrane.hydro.data.interpolation import by_straight_lines
from seacrane.hydro.memory.identification import symmetric
from seacrane.inputs.brief import brief
from seacrane.sea.dispersion import wavenumber

OVERALL = 1.5  # H by the overall width
NEAR = 0.08  # of a frequency: by as much do boxes and coarse panels miss one
BESIDE = 0.07  # of a frequency: where a narrow peak is over
STANDS_OUT = 1.5  # times the damping there
FELT = 1e-4  # least damping, by inertia times frequency
LEAST = 0.02  # of an entry's largest value
SAME = 0.04  # of a frequency: peaks of several motions at one resonance
FIRST_MODES = 3
LONGEST_SIZE = 0.1  # of 1 / k: hulls this broad and this deep are lifted as by a rising water level
BISECTIONS = 40


@dataclass(frozen=True, kw_only=True)
class Gap:
    """The water between two hulls: ``width`` m, and ``piston`` rad/s by Molin's formula."""

    first: str
    second: str
    width: float
    piston: float
    across: float


@dataclass(frozen=True, kw_only=True)
class Spike:
    """A frequency, rad/s, at which the damping has a narrow peak, and what explains it: "gap", "irregular"
    or "unexplained".

    ``of`` names the gap ("a-b") or the hull, ``expected`` (rad/s) is the formula's frequency; nan: none.
    """

    omega: float
    cause: str
    of: str
    expected: float


def piston_frequency(*, draught: float, gap: float, width: float, g: float = 9.81) -> float:
    """Angular frequency (rad/s) of the piston mode of the water between two hulls.

    Parameters
    ----------
    draught, gap, width : m, of the hulls, between them, and over both.
    g : m/s2.

    Raises
    ------
    ValueError : a length that is not positive, or a gap as wide as the whole.
    """
    if not (draught > 0.0 and 0.0 < gap < width and g > 0.0):
        raise ValueError(
            f"piston frequency: draught {draught:g} m, gap {gap:g} m, width over both {width:g} m; give "
            "positive ones, the width the largest"
        )
    length = draught + gap / np.pi * (1.5 + np.log(OVERALL * width / (2.0 * gap)))
    return float(np.sqrt(g / length))


def clearance(first: GroupBody, second: GroupBody) -> tuple[float, float]:
    """Width of the water between two boxes, and over all across it, m; the width is negative where they
    overlap.

    The widest strip between them that is parallel to a side of one of the boxes (separating axes).
    """
    best, corners = (-np.inf, np.inf), []
    for body in (first, second):
        c, s = np.cos(body.heading), np.sin(body.heading)
        half = 0.5 * np.array([[1, 1], [1, -1], [-1, -1], [-1, 1]]) * (body.length, body.breadth)
        corners.append(half @ np.array([[c, s], [-s, c]]) + body.position[:2])
    for angle in (first.heading, first.heading + np.pi / 2, second.heading, second.heading + np.pi / 2):
        axis = np.array([np.cos(angle), np.sin(angle)])
        p, q = (points @ axis for points in corners)
        width = max(p.min(), q.min()) - min(p.max(), q.max())
        best = max(best, (float(width), float(max(p.max(), q.max()) - min(p.min(), q.min()))))
    return best


def gaps(group: HydroGroupData) -> list[Gap]:
    """The gaps narrower than the hulls beside them; hulls around each other have none here."""
    found = []
    for a, b in combinations(group.bodies, 2):
        width, overall = clearance(a, b)
        if 0.0 < width < min(a.breadth, b.breadth):
            draught = 0.5 * (a.draught + b.draught)
            piston = piston_frequency(draught=draught, gap=width, width=overall, g=group.g)
            across = float(np.sqrt(np.pi * group.g / width))
            found.append(Gap(first=a.name, second=b.name, width=width, piston=piston, across=across))
    return found


def irregular_frequencies(body: GroupBody, g: float) -> Array:
    """First irregular frequencies (rad/s), rising, of the body's box."""
    i, j = np.mgrid[1 : 1 + FIRST_MODES, 1 : 1 + FIRST_MODES].reshape(2, -1)
    k = np.pi * np.hypot(i / body.length, j / body.breadth)
    return np.sort(np.sqrt(g * k / np.tanh(k * body.draught)))


def radiating(group: HydroGroupData) -> NDArray[np.bool_]:
    """Motions (6 k,) that radiate anything: yaw of a round body does not, and a file holds noise there."""
    peak = np.diagonal(group.damping, axis1=1, axis2=2).max(axis=0)
    return np.asarray(peak > FELT * float(np.mean(group.omega)) * mass_scales(group))


def spikes(group: HydroGroupData) -> list[Spike]:
    """Narrow peaks of the hulls' own damping, each with the nearest explanation.

    Narrow is a peak that is half as high again as the damping 7 % of its frequency away on either side; the
    damping of a hull by itself has none. Peaks next to each other count once, at the one that stands out.
    """
    own = np.diagonal(group.damping, axis1=1, axis2=2)
    size = np.maximum(own.max(axis=0), 1e-300)
    left, right = (
        np.array([np.interp(group.omega * (1.0 + away), group.omega, column) for column in own.T]).T
        for away in (-BESIDE, BESIDE)
    )
    beside = np.maximum(left, right)
    height = own / np.maximum(beside, LEAST * size)
    top = np.zeros(own.shape, dtype=bool)
    top[1:-1] = (own[1:-1] >= own[:-2]) & (own[1:-1] > own[2:]) & (own[1:-1] > LEAST * size)
    top &= radiating(group)
    most = np.where(top & (height > STANDS_OUT), height, 0.0).max(axis=1)
    found: list[int] = []
    for i in np.argsort(-most, kind="stable"):
        if most[i] > 0.0 and all(abs(group.omega[i] / group.omega[k] - 1.0) > SAME for k in found):
            found.append(int(i))
    return [_explained(group, float(group.omega[i])) for i in sorted(found)]


def _explained(group: HydroGroupData, omega: float) -> Spike:
    """The nearest irregular frequency or piston mode, within what boxes miss; else a longer mode of a gap."""
    known = [
        (abs(expected / omega - 1.0), "irregular", body.name, float(expected))
        for body in group.bodies
        for expected in irregular_frequencies(body, group.g)
    ]
    between = gaps(group)
    known += [
        (abs(gap.piston / omega - 1.0), "gap", f"{gap.first}-{gap.second}", gap.piston) for gap in between
    ]
    off, cause, of, expected = min(known)
    if off > NEAR:
        longer = [f"{gap.first}-{gap.second}" for gap in between if gap.piston < omega < gap.across]
        cause, of, expected = "gap" if longer else "unexplained", longer[0] if longer else "", np.nan
    return Spike(omega=omega, cause=cause, of=of, expected=expected)


def long_wave_lift(group: HydroGroupData) -> Array | None:
    """C33 (k,) of each body by the vertical force of the group's longest wave, N/m.

    Bodies held in water that rises by 1 m are bodies that all move down, ``F = C33 - w^2 sum A``. None where
    that wave is not much longer than they are broad and deep.
    """
    k = float(wavenumber(group.omega[:1], g=group.g, depth=group.depth)[0])
    if k * max(max(body.breadth, body.draught) for body in group.bodies) > LONGEST_SIZE:
        return None
    inertia = group.omega[0] ** 2 * group.added_mass[0, 2::6, 2::6].sum(axis=1)
    return np.asarray(np.abs(group.force[:, 0, 2::6] + inertia).mean(axis=0))


@dataclass(frozen=True, kw_only=True, eq=False)
class GroupMode:
    """A natural mode of a group.

    Attributes
    ----------
    omega : rad/s. period : s.
    damping_ratio : of critical, by radiation and linear damping at that frequency.
    shape : (6 k,) motions, m and rad, read-only, the largest of ``shape`` times half the lengths being 1.
    """

    omega: float
    damping_ratio: float
    shape: Array

    __repr__ = brief

    @property
    def period(self) -> float:
        """Natural period, s."""
        return 2.0 * np.pi / self.omega


def natural_modes_of(group: HydroGroupData) -> tuple[GroupMode, ...]:
    """Modes of all hulls together without damping, within the frequencies, by rising frequency.

    A mode that water in a gap makes is among them. Motions that nothing restores have none. An eigenvalue of
    ``C - w^2 (M + A(w))``, symmetric, falls through zero there; A is a straight line between frequencies.
    """
    dynamic = _dynamic(group, group.omega)
    # Motions that move the ends of a hull alike: 1 for translations, 1 over half the length for rotations.
    size = np.concatenate([np.repeat([1.0, 2.0 / body.length], 3) for body in group.bodies])
    scaled = np.linalg.eigvalsh(dynamic * np.outer(size, size))
    modes = []
    for i in range(len(group.omega) - 1):
        for place in np.flatnonzero((scaled[i] > 0.0) & (scaled[i + 1] <= 0.0)):
            modes.append(_mode(group, group.omega[i : i + 2].tolist(), int(place), size))
    return tuple(sorted(modes, key=lambda mode: mode.omega))


def _mode(group: HydroGroupData, between: list[float], place: int, size: Array) -> GroupMode:
    low, high = between
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + high)
        value = np.linalg.eigvalsh(_dynamic(group, np.array([middle]))[0] * np.outer(size, size))[place]
        low, high = (middle, high) if value > 0.0 else (low, middle)
    omega = 0.5 * (low + high)
    at = np.array([omega])
    vector = np.linalg.eigh(_dynamic(group, at)[0] * np.outer(size, size))[1][:, place]
    shape = vector * size / vector[np.abs(vector).argmax()]
    inertia = mass_of(group) + symmetric(by_straight_lines(group.omega, group.added_mass, at)[0])
    damping = group.linear_damping + by_straight_lines(group.omega, group.damping, at)[0]
    ratio = (shape @ damping @ shape) / (2.0 * omega * (shape @ inertia @ shape))
    shape.setflags(write=False)
    return GroupMode(omega=omega, damping_ratio=float(ratio), shape=shape)


def _dynamic(group: HydroGroupData, omega: Array) -> Array:
    inertia = mass_of(group) + symmetric(by_straight_lines(group.omega, group.added_mass, omega))
    return np.asarray(symmetric(group.restoring) - omega[:, None, None] ** 2 * inertia)
