"""Half sections of a panelled hull, by slicing it across."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from seacrane.hydro.hull.hydrostatics import triangles_of
from seacrane.hydro.hull.mesh import merged_points
from seacrane.hydro.hull.panels import cut_panels

FloatArray = NDArray[np.float64]

ON_PLANE = 1e-7  # of the length: closer points are one, or on the waterline, or on the centre line
NEXT_TO_PLANE = 10.0  # of that: vertices this close to a slice are on it, so that their edges meet there


@dataclass(frozen=True, kw_only=True, eq=False)
class Slice:
    """Half section (p, 2) of y and z in m, waterline to keel, and the area (m2) of the half that hangs apart.

    ``section`` is three points at the origin where nothing pierces the surface. ``apart`` is the area of what
    is wholly under water: a bulb ahead of the stem, a pod.
    """

    section: FloatArray
    apart: float


def slices(name: str, panels: FloatArray, x: FloatArray) -> list[Slice]:
    """Slices of a symmetric wetted surface (n, 4, 3) at the stations ``x`` (s,) in m.

    Stations on the foremost and aftmost point give the hull's ends.

    Raises
    ------
    ValueError : a section that pierces the surface more than once on each side (several hulls), or whose
        outline does not close.
    """
    length = float(np.ptp(panels[..., 0]))
    tolerance = ON_PLANE * length
    port = triangles_of(cut_panels(panels, axis=1, side=1, tolerance=tolerance))
    middle = 0.5 * float(panels[..., 0].min() + panels[..., 0].max())
    return [_slice(name, port, float(station), station < middle, tolerance) for station in x]


def _slice(name: str, triangles: FloatArray, x: float, aft: bool, tolerance: float) -> Slice:
    """One slice; vertices on the plane count to the nearer end, so that the end itself is a section."""
    chains = _chains(name, x, _segments(triangles, x, aft, tolerance), tolerance)
    piercing = [_downwards(c) for c in chains if max(c[0, 1], c[-1, 1]) >= -tolerance]
    piercing = [c for c in piercing if c[:, 1].min() < -tolerance]  # else: a bottom that just comes up
    apart = sum(_half_area(c) for c in chains if max(c[0, 1], c[-1, 1]) < -tolerance)
    if not piercing:
        return Slice(section=np.zeros((3, 2)), apart=apart)
    if len(piercing) > 1 or piercing[0][-1, 0] > tolerance:
        raise ValueError(
            f"hull {name!r}: the section at x = {x:.6g} m meets the waterline more than once on each side, "
            "or does not end on the centre line; strip theory and remeshing take one hull: use "
            "method='capytaine' with the mesh as it is"
        )
    section = piercing[0]
    section[0, 1] = section[-1, 0] = 0.0
    if len(section) == 2:
        section = np.array([section[0], section.mean(axis=0), section[1]])
    return Slice(section=np.column_stack([np.maximum(section[:, 0], 0.0), section[:, 1]]), apart=apart)


def _segments(triangles: FloatArray, x: float, aft: bool, tolerance: float) -> FloatArray:
    """Directed segments (m, 2, 2) of y, z in which the triangles meet the plane."""
    distance = triangles[..., 0] - x
    distance[np.abs(distance) <= NEXT_TO_PLANE * tolerance] = 0.0
    ahead = distance > 0.0 if aft else distance >= 0.0
    cut = ahead.any(axis=1) & ~ahead.all(axis=1)
    t, d, front = triangles[cut], distance[cut], ahead[cut]
    out = np.empty((len(t), 2, 2))
    for i in range(3):
        j = (i + 1) % 3
        for slot, leaves in ((0, front[:, i] & ~front[:, j]), (1, ~front[:, i] & front[:, j])):
            share = d[leaves, i] / (d[leaves, i] - d[leaves, j])
            a, b = t[leaves, i, 1:], t[leaves, j, 1:]
            out[leaves, slot] = a + share[:, None] * (b - a)
    return out


def _chains(name: str, x: float, segments: FloatArray, tolerance: float) -> list[FloatArray]:
    """Segments joined end to start; a closed chain repeats its first point."""
    if len(segments) == 0:
        return []
    labels = merged_points(segments.reshape(-1, 2), tolerance).reshape(-1, 2)
    real = labels[:, 0] != labels[:, 1]
    labels, segments = labels[real], segments[real]
    following = {int(start): i for i, start in enumerate(labels[:, 0])}
    if len(following) < len(labels):
        raise ValueError(
            f"hull {name!r}: the outline of the section at x = {x:.6g} m touches itself; repair the surface "
            "there"
        )
    ends = set(labels[:, 1].tolist())
    heads = [i for start, i in following.items() if start not in ends]
    chains = []
    while following:
        i = heads.pop() if heads else next(iter(following.values()))
        chain = [segments[i, 0]]
        while (found := following.pop(int(labels[i, 0]), None)) is not None:
            chain.append(segments[found, 1])
            if (after := following.get(int(labels[found, 1]))) is None:
                break
            i = after
        chains.append(np.array(chain))
    return chains


def _downwards(chain: FloatArray) -> FloatArray:
    """The chain from its end on the waterline."""
    return chain if chain[0, 1] >= chain[-1, 1] else chain[::-1].copy()


def _half_area(chain: FloatArray) -> float:
    """Area (m2) between a chain and the centre line."""
    y, z = np.append(chain[:, 0], 0.0), np.append(chain[:, 1], chain[-1, 1])
    y, z = np.append(y, 0.0), np.append(z, chain[0, 1])
    return float(0.5 * abs(np.sum(y * np.roll(z, -1) - z * np.roll(y, -1))))
