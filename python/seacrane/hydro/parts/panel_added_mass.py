"""A closed mesh as a volume, and its added mass on a ladder of draughts, by Capytaine's panels.

The volume below a level is exact, by the divergence theorem over clipped triangles. Panels carry potentials
("direct"): on a sphere they err by a fifth of what sources do, on a cube by a third more, at sharp edges by
more still.

Two limits at the surface. A motion faster than all waves sees no pressure there (infinite frequency), one
slower than all sees a wall (zero frequency). At the first, added mass cannot fall with depth in any
direction: by Dirichlet's principle -A/2 is the least value of a functional over potentials that vanish at
the surface, and deeper water admits all of those before. A fall is an error of the panels.
"""

from __future__ import annotations

import hashlib
import json
import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from seacrane.arrays import Array
from seacrane.errors import SceneError
from seacrane.hydro.data.packed import NOT_PACKED, packed, unpacked
from seacrane.hydro.hull.panels import area_vectors, closed_below, cut_panels, triangles_of
from seacrane.hydro.hull.solution import import_capytaine
from seacrane.hydro.parts.panel_workers import INSTEAD, PanelWorkers
from seacrane.inputs.checked import numbers_of, positive_of
from seacrane.inputs.mesh_files import MOST_TRIANGLES, READERS
from seacrane.inputs.shown import shown
from seacrane.inputs.user_cache import keep_file, read_kept, user_cache

VERSION = 4  # raised with every change of what is solved
KIND, SUFFIX = "added_mass", ".ladder"
MOST_PANELS = 3000  # 16 bytes for each pair of them, two matrices: 0.3 GB
ON_SURFACE = 1e-7  # of the size
NO_AREA = 1e-14  # of the square of the size
RUNGS, CLUSTERED = 10, 1.5  # to awash; denser near touch
CLEARANCES = (0.04, 0.1, 0.25, 0.5, 1.0, 2.0)  # below awash, of the root of the plan's box
FIRST_FLAT = (0.02, 0.05)  # of the root of a flat bottom's area
MANY, LONGER = 2.0, 1.2  # times the panels asked for; steps towards them
SETTLED = 0.005  # of the unbounded value: what the surface may still take
FLAT = 1e-3  # of the size: what lies within it of one level is flat
MOST_FLATS = 12  # levels at which a volume may change its slope
LARGEST, SMALLEST = 300.0, 0.01  # m, of what hangs on a crane
NO_VOLUME = 1e-9  # of the cube of the size


@dataclass(frozen=True, kw_only=True, eq=False)
class MeshShape:
    """A closed mesh with the centre of its volume over the origin, its lowest point at z = 0; m."""

    triangles: Array  # (n, 3, 3), anticlockwise from outside
    size: Array  # (3,), its extent
    center: Array  # (3,), half its height above its lowest point, in the coordinates that it was given in
    flat: float  # area of what is flat at its lowest level, m2
    kinks: Array  # (k,), levels of its largest horizontal faces

    @staticmethod
    def of(triangles: Array) -> MeshShape:
        """Of the mesh as it is given."""
        corners = triangles.reshape(-1, 3)
        size, low = np.ptp(corners, axis=0), float(corners[:, 2].min())
        middle = corners.mean(axis=0)
        near = triangles - middle
        parts = np.einsum("ij,ij->i", near[:, 0], np.cross(near[:, 1], near[:, 2]))
        x, y, _ = middle + parts @ near.sum(axis=1) / (4.0 * parts.sum())
        moved = triangles - np.array([x, y, low])
        areas = area_vectors(moved)[:, 2]
        flat = (moved[..., 2] <= FLAT * size.max()).all(axis=1)
        level = np.ptp(moved[..., 2], axis=1) <= 1e-9 * size[2]
        at, which = np.unique(np.round(moved[level][:, 0, 2], 9), return_inverse=True)
        across = np.bincount(which.ravel(), weights=np.abs(areas[level]), minlength=len(at))
        return MeshShape(
            triangles=moved, size=size, center=np.array([x, y, low + 0.5 * size[2]]),
            flat=max(0.0, -float(areas[flat].sum())), kinks=np.sort(at[np.argsort(-across)[:MOST_FLATS]]),
        )  # fmt: skip


def volumes_below(triangles: Array, levels: Array) -> Array:
    """Volume (m,) of a closed mesh (n, 3, 3) below each level (m,), m3.

    The flux of (0, 0, z - level) through what of the surface is wet; there is none through the lid that the
    level is. Over a triangle it is n_z times the integral of the depth where that is positive.
    """
    rise = area_vectors(triangles)[:, 2]
    counted = rise != 0.0
    rise = rise[counted]
    heights = -np.sort(-triangles[counted][..., 2], axis=1)  # the highest corner first
    out = np.array([-float(rise @ _mean_depths(level - heights)) for level in levels])
    return np.maximum.accumulate(np.maximum(out, 0.0))  # rounding alone makes it fall


def _mean_depths(corners: Array) -> Array:
    """Mean over triangles of the depth where it is positive, from increasing depths (n, 3) of corners."""
    least, middle, most = corners.T
    with np.errstate(divide="ignore", invalid="ignore"):
        low = most**2 / ((most - least) * (most - middle)) * most / 3.0  # one corner is wet
        dry = least**2 / ((middle - least) * (most - least)) * least / 3.0  # one corner is dry
    mean = corners.mean(axis=1)
    return np.select([least >= 0.0, middle > 0.0, most > 0.0], [mean, mean - dry, low], 0.0)


def closed_mesh(mesh: Any, scale: Any) -> tuple[str, Array]:
    """What messages call a mesh, and its triangles (n, 3, 3), m, anticlockwise from outside; errors as of
    `seacrane.hydro.part_from_mesh`."""
    what, triangles = _triangles_of(mesh)
    factor = positive_of(f"{what}: scale", scale)
    with np.errstate(over="ignore", invalid="ignore"):
        triangles = factor * triangles
        size = float(np.ptp(triangles.reshape(-1, 3), axis=0).max())
    if not SMALLEST <= size <= LARGEST:
        raise SceneError(
            f"{what}: is {size:.4g} m large with scale={factor:g}, and loads have {SMALLEST:g} to "
            f"{LARGEST:g} m; if it is in mm give scale={1e-3 * factor:g}"
        )
    try:
        triangles = closed_below(what, triangles, np.inf, "")
    except ValueError as error:
        raise SceneError(str(error)) from None
    return what, _outwards(what, triangles, size)


def _triangles_of(mesh: Any) -> tuple[str, Array]:
    if isinstance(mesh, str | os.PathLike):
        path = Path(mesh)
        reader = READERS.get(path.suffix.lower())
        if reader is None:
            raise SceneError.of("mesh: file", f"is {shown(path.name)}; give {', '.join(READERS)}")
        return f"mesh {path.name!r}", np.asarray(reader(path, most=MOST_TRIANGLES), dtype=float)
    what = "mesh of triangles"
    triangles = numbers_of(what, mesh)
    if triangles.ndim != 3 or triangles.shape[1:] != (3, 3) or not len(triangles):
        raise SceneError(f"{what}: has shape {triangles.shape}; give a file, or (n, 3, 3) in m")
    if len(triangles) > MOST_TRIANGLES:
        raise SceneError(f"{what}: has {len(triangles)} triangles, above {MOST_TRIANGLES}; decimate it")
    if not np.isfinite(triangles).all():
        raise SceneError(f"{what}: holds a coordinate that is not finite; repair it")
    return what, triangles


def _outwards(what: str, triangles: Array, size: float) -> Array:
    """The triangles, once their faces point outwards."""
    near = triangles - triangles[:1, :1]
    volume = float(np.einsum("ij,ij->", near[:, 0], np.cross(near[:, 1], near[:, 2]))) / 6.0
    if volume < -NO_VOLUME * size**3:
        raise SceneError(
            f"{what}: encloses {volume:.4g} m3, so its faces point inwards; reverse the order of the "
            "vertices of each triangle"
        )
    if not volume > NO_VOLUME * size**3:
        raise SceneError(f"{what}: encloses {volume:.4g} m3, which is nothing; give one closed outer skin")
    return triangles


@dataclass(frozen=True, kw_only=True, eq=False)
class PanelLadder:
    """Added mass over density, m3."""

    draughts: Array  # (n,), m, of the lowest point
    added: Array  # (n, 3), along the axes, at infinite frequency
    low: Array  # the same at zero frequency
    unbounded: Array  # (3, 3), without a surface
    error: float  # largest change of its diagonal with half the panels, over the largest of its axes
    panels: int  # most that a draught took
    code: str  # the program and its version


def panel_ladder(what: str, shape: MeshShape, draughts: Array | None, panels: int) -> PanelLadder:
    """The ladder of a closed mesh, kept on disk; without draughts (n,), m, from touch down to where the
    surface no longer counts.

    ImportError without Capytaine, for what was not solved before; SceneError for too many triangles.
    """
    folder, name = user_cache(KIND), f"{_digest(shape.triangles, draughts, panels)}{SUFFIX}"
    if folder is not None:
        try:
            kept: PanelLadder = unpacked(read_kept(folder / name), (PanelLadder,))
        except (OSError, *NOT_PACKED):
            pass
        else:
            return kept
    made = _solved(_Panels(what, shape, panels), draughts)
    keep_file(folder, name, packed(made))
    return made


def _digest(triangles: Array, draughts: Array | None, panels: int) -> str:
    """Of all that a ladder depends on but the program's version, which it tells itself."""
    asked = None if draughts is None else draughts.tolist()
    parts = hashlib.sha256(json.dumps([VERSION, panels, asked, triangles.shape]).encode())
    parts.update(np.ascontiguousarray(triangles, dtype="<f8").tobytes())
    return parts.hexdigest()


def _solved(surface: _Panels, draughts: Array | None) -> PanelLadder:
    """Both limits of a draught and of those after it are asked for before the first is waited for."""
    rungs, height = _rungs(surface.shape, draughts), surface.shape.size[2]
    whole, half = surface.panels_at(None), surface.panels_at(None, 0.5)
    wet = [surface.panels_at(float(draught)) for draught in rungs]
    added: list[Array] = []
    with PanelWorkers(surface.what, max(map(len, [whole, *wet]))) as workers:
        unbounded, coarse = workers.ask(whole, np.inf, np.inf), workers.ask(half, np.inf, np.inf)
        asked = [(workers.ask(one, 0.0, np.inf), workers.ask(one, 0.0, 0.0)) for one in wet]
        deep = unbounded()
        least = np.diag(deep)
        for draught, (fast, _) in zip(rungs, asked, strict=True):
            added.append(np.diag(fast()))
            if draughts is None and draught > height and np.all(least - added[-1] <= SETTLED * least):
                break
        low = [np.diag(slow()) for _, slow in asked[: len(added)]]
        rough = np.diag(coarse())
    used = [whole, half, *wet[: len(added)]]
    return PanelLadder(
        draughts=rungs[: len(added)], added=np.array(added), low=np.array(low), unbounded=deep,
        error=float(np.max(np.abs(rough - least)) / least.max()), panels=max(map(len, used)),
        code=surface.code,
    )  # fmt: skip


def _rungs(shape: MeshShape, given: Array | None) -> Array:
    """Draughts (n,): those given, or denser near touch and on below awash.

    Before them those near the touch of a flat bottom, from which its added mass there follows.
    """
    long, wide, height = shape.size
    first = np.sqrt(shape.flat) * np.array(FIRST_FLAT)
    first = first[(first > 0.0) & (first < 0.9 * height)]
    if given is not None:
        return np.concatenate([first[first < 0.9 * given[0]], given])
    above = height * (np.arange(1, RUNGS + 1) / RUNGS) ** CLUSTERED
    above = above[above > 1.2 * first.max(initial=0.0)]
    below = height + np.sqrt(long * wide) * np.array(CLEARANCES)
    return np.concatenate([first, above, below])


class _Panels:
    """A closed mesh, and the panels of it that are solved for at a draught."""

    def __init__(self, what: str, shape: MeshShape, panels: int) -> None:
        count = len(shape.triangles)
        if count > MOST_PANELS:
            raise SceneError(
                f"{what}: has {count} triangles, above the {MOST_PANELS} panels that are solved "
                "for; decimate it in the program that made it"
            )
        capytaine = import_capytaine(f"{what}: its added mass", INSTEAD)
        self.what, self.shape, self.panels = what, shape, panels
        self.code = f"Capytaine {capytaine.__version__}"

    def panels_at(self, draught: float | None, share: float = 1.0) -> Array:
        """Panels (n, 3, 3) of what is wet at a draught, m; of all of it, deep below, without one."""
        wet = self._wet(2.0 * self.shape.size[2] if draught is None else draught)
        return refined(wet, share * self.panels)

    def _wet(self, draught: float) -> Array:
        """Triangles of what is below the surface z = 0 at a draught."""
        size = float(self.shape.size.max())
        lowered = self.shape.triangles[:, [0, 1, 2, 2]] - np.array([0.0, 0.0, draught])
        cut = triangles_of(cut_panels(lowered, axis=2, side=-1, tolerance=ON_SURFACE * size))
        wet: Array = cut[np.linalg.norm(area_vectors(cut), axis=1) > NO_AREA * size**2]
        if len(wet) == 0:
            raise SceneError(
                f"{self.what}: draught {draught:.4g} m wets nothing of it; leave it out of draughts"
            )
        return wet


def refined(triangles: Array, count: float) -> Array:
    """Triangles cut in halves across their longest edge, until about `count` are as long as wide.

    Narrow ones, which cannot be, are left longer, so that they do not become many more.
    """
    area = np.linalg.norm(area_vectors(triangles), axis=1).sum()
    longest = 2.4 * np.sqrt(area / count)  # halves of right-angled ones with two equal sides, on the mean
    while True:
        panels = _no_longer_than(triangles, longest)
        if len(panels) <= MANY * count or len(panels) == len(triangles):
            return panels
        longest *= LONGER


def _no_longer_than(triangles: Array, longest: float) -> Array:
    done: list[Array] = []
    while len(triangles):
        edges = np.linalg.norm(np.roll(triangles, -1, axis=1) - triangles, axis=2)
        long = edges.max(axis=1) > longest
        done.append(triangles[~long])
        triangles, at = triangles[long], edges[long].argmax(axis=1)
        a, b, c = (triangles[np.arange(len(at)), (at + k) % 3] for k in range(3))
        middle = 0.5 * (a + b)
        triangles = np.concatenate([np.stack([a, middle, c], axis=1), np.stack([middle, b, c], axis=1)])
    return np.concatenate(done)
