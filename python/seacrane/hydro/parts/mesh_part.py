"""`part_from_mesh`: a part of a load by tables that a closed mesh and a panel code make."""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from seacrane.arrays import Array
from seacrane.errors import SceneError
from seacrane.hydro.parts.added_mass import RAMP_KNOTS, ROUNDING, perforation_factor, ramp
from seacrane.hydro.parts.density import SEA_WATER, density_of
from seacrane.hydro.parts.flat_parts import LEAST_SLAM, MOST_PERFORATION, Piece, check_slam, share_of
from seacrane.hydro.parts.panel_added_mass import (
    MOST_PANELS,
    MeshShape,
    PanelLadder,
    closed_mesh,
    panel_ladder,
    volumes_below,
)
from seacrane.hydro.parts.parts import TablePart
from seacrane.inputs.brief import brief
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.checked import number_of, shaped_of, text_of, vector_of
from seacrane.inputs.shown import shown
from seacrane.warnings import MeshConvergenceWarning

MOST_DRAUGHTS, FEWEST_PANELS = 60, 50
MOST_WETTING = 2.0  # that of a circle as it touches (Wagner)
LARGEST_ERROR = 0.05  # of panels, which is not warned of
VOLUME_KNOTS = 32
BESIDE_KINK = 1e-3  # of the height
APART = 1e-5  # of the height: the least between two depths


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class MeshPart(TablePart):
    """What `part_from_mesh` makes: a table of added mass that a fast motion feels, with that of a slow one.

    Parameters
    ----------
    height, depths, volumes, added_masses, drag_area, point, axes, source
        As of `TablePart`; arrays are read-only.
    size : array_like, shape (3,)
        m, its extent along its axes, over which waves are averaged.
    low_frequency_added_masses : array_like, shape (n, 3)
        kg at the depths, along its axes, at zero frequency: what a load feels that rides waves much longer
        than itself. The engine takes `added_masses`, those at infinite frequency. Both meet far below.
    mended : float
        Largest change of added mass so that it grows with depth, over the largest unbounded one.
    panel_error : float
        Largest change of the unbounded added mass with half the panels, over the largest of its axes.
    density : float
        kg/m3, of the water for which masses are in kg; in other water they are in proportion.
    """

    size: Any
    low_frequency_added_masses: Any
    mended: float
    panel_error: float
    density: float

    __repr__ = brief

    def __post_init__(self) -> None:
        super().__post_init__()
        for name in ("size", "depths", "volumes", "added_masses", "low_frequency_added_masses"):
            array = np.array(getattr(self, name), dtype=float)
            array.setflags(write=False)
            object.__setattr__(self, name, array)
        shaped_of("table: size", self.size, (3,))
        shaped_of("table: low_frequency_added_masses", self.low_frequency_added_masses, (len(self.depths), 3))
        density_of("table", self.density)

    @property
    def extent(self) -> float:
        return float(np.max(self.size))

    def pieces(self, density: float) -> Iterator[Piece]:
        for piece in super().pieces(density):
            ratio = density / self.density
            yield replace(
                piece, size=np.array(self.size), added_masses=ratio * piece.added_masses,
                slow_added_masses=ratio * np.asarray(self.low_frequency_added_masses),
            )  # fmt: skip


def part_from_mesh(
    mesh: str | os.PathLike[str] | ArrayLike, *, scale: float = 1.0, draughts: ArrayLike | None = None,
    wetting: float = 1.0, slam: float | None = None, perforation: float = 0.0,
    drag_area: ArrayLike = (0.0, 0.0, 0.0), panels: int = 400, source: str = "",
    point: ArrayLike = (0.0, 0.0, 0.0),
    axes: ArrayLike = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)), density: float = SEA_WATER,
) -> MeshPart:  # fmt: skip
    """A part of a load from a closed mesh: volume over depth exactly, added mass over depth by Capytaine.

    The tables are those of the mesh as it is drawn, z upwards, and hold at whatever attitude. Buoyancy and
    added mass act at half its height, above or below the centre of its volume. What turning adds to its
    inertia is left out. Solutions are kept on disk by the content of mesh and draughts.

    Parameters
    ----------
    mesh : path-like or array_like, shape (n, 3, 3)
        STL or glTF (its y up becomes z up), or triangles: vertices, anticlockwise from outside, in m.
    scale : float
        By which coordinates are multiplied to be m, such as 1e-3 for a file in mm.
    draughts : array_like, shape (n,), optional
        m, of its lowest point, increasing, at which added mass is solved for, from touch to its top or below
        it. Default: denser near touch, and on until the surface no longer counts. Below the last, the
        unbounded value follows; before them, two near the touch of a flat bottom.
    wetting : float
        How much deeper the section is wetted than the undisturbed surface, up to its top, by the water that
        piles up beside it: pi/2 of a wedge (H. Wagner, ZAMM 12 (1932) 193), 2 of a circle as it touches. 1:
        none, as in a panel code: slam comes too softly.
    slam : float, optional
        C_S of a flat bottom, at least 5, which is its default: as of `BoxPart`.
    perforation : float
        Share of its faces that is open, 0 to 0.5: takes from its added mass as from that of `BoxPart`.
    drag_area : array_like, shape (3,)
        C_D times area along its axes, m2.
    panels : int
        About how many a draught takes; time grows with their square.
    source : str
        Of what is given here; what was computed is told after it.
    point, axes : array_like, shape (3,) and (3, 3)
        Where the mesh's origin is, m, and its axes (columns), in body coordinates.
    density : float
        kg/m3, of the water for which `added_masses` is in kg.

    Returns
    -------
    MeshPart

    Raises
    ------
    SceneError
        For an open mesh, one whose faces point inwards, one in mm, one with more triangles than are solved
        for, bad numbers, draughts that are not positive and increasing, and a density in t/m3.
    FileFormatError
        For a file that is damaged, too large, or of another kind; without trimesh (`seacrane[mesh]`).
    ImportError
        Without Capytaine: pip install 'seacrane[hydro]'. What was solved before needs none.

    Warns
    -----
    MeshConvergenceWarning
        Added mass changes by more than 5 % with half the panels, or was mended by as much.

    Notes
    -----
    V = sum of n_z times the integral of the depth over each wet triangle. Added mass at infinite frequency,
    with a surface without pressure, never falls with depth; where the solution does, the panels err.
    """
    what, triangles = closed_mesh(mesh, scale)
    hit = _checked(what, wetting, slam, perforation, panels)
    water, own = density_of(what, density), text_of(f"{what}: source", source, "")
    origin, turn = shaped_of(f"{what}: point", point, (3,)), shaped_of(f"{what}: axes", axes, (3, 3))
    shape = MeshShape.of(triangles)
    rungs = _draughts_of(what, draughts, float(shape.size[2]))
    if slam is not None and shape.flat <= 0.0:
        raise SceneError.of(
            f"{what}: slam", f"is {slam:g}, and nothing of its bottom is flat; give wetting instead"
        )
    ladder = panel_ladder(what, shape, rungs, int(panels))
    table = _DepthTable(ladder, shape, wetting=float(wetting), slam=hit)
    depths, kept = table.depths(shape.kinks), water * perforation_factor(float(perforation))
    part = MeshPart(
        height=float(shape.size[2]), size=shape.size, depths=depths, drag_area=drag_area, density=water,
        volumes=volumes_below(shape.triangles, depths), added_masses=kept * table.fast(depths),
        low_frequency_added_masses=kept * table.slow(depths), mended=table.mended,
        panel_error=ladder.error, point=origin + turn @ shape.center, axes=turn,
        source=_source(own, what, ladder, table, hit),
    )  # fmt: skip
    _warn(what, part)
    return part


def _checked(what: str, wetting: Any, slam: Any, perforation: Any, panels: Any) -> float:
    """C_S, once all numbers are what they must be."""
    if not 1.0 <= number_of(f"{what}: wetting", wetting) <= MOST_WETTING:
        raise SceneError.of(
            f"{what}: wetting",
            f"is {wetting:g}; give 1, without pile-up, to {MOST_WETTING:g}, such as pi/2 of a wedge",
        )
    check_slam(what, LEAST_SLAM if slam is None else slam, LEAST_SLAM)
    share_of(f"{what}: perforation", perforation, MOST_PERFORATION)
    whole = isinstance(panels, int | np.integer) and not isinstance(panels, bool)
    if not whole or not FEWEST_PANELS <= int(panels) <= MOST_PANELS:
        raise SceneError.of(
            f"{what}: panels",
            f"is {shown(panels)}; give a whole number from {FEWEST_PANELS} to {MOST_PANELS}",
        )
    return LEAST_SLAM if slam is None else float(slam)


def _draughts_of(what: str, draughts: Any, height: float) -> Array | None:
    if draughts is None:
        return None
    values = np.array(vector_of(f"{what}: draughts", draughts))
    rising = np.all(np.diff(values, prepend=0.0) > 0.0) and np.all(np.isfinite(values))
    if not (rising and 1 <= len(values) <= MOST_DRAUGHTS and values[-1] >= height * (1.0 - 1e-9)):
        raise SceneError.of(
            f"{what}: draughts",
            f"is {shown(draughts)}; give 1 to {MOST_DRAUGHTS} depths of its lowest point, m, above zero and "
            f"increasing, on to {height:g}, where its top goes under, or below",
        )
    return values


def _source(given: str, what: str, ladder: PanelLadder, table: _DepthTable, slam: float) -> str:
    """Where the numbers of a part are from, and how far they can be trusted."""
    crossed = np.abs(ladder.unbounded - np.diag(np.diag(ladder.unbounded))).max()
    share = crossed / np.diag(ladder.unbounded).max()
    slower = ", ".join(f"{one:.2f}" for one in table.slower())
    parts = [
        given,
        f"{what}, {ladder.code}, infinite frequency, {ladder.panels} panels at most (half of them: "
        f"{ladder.error:.1%}; mended by {table.mended:.1%})",
        f"at zero frequency {slower} times that at half its height",
        f"wetting {table.wetting:.4g}",
        f"C_S {slam:g}: DNV-RP-N103 (unverified)" if table.over > 0.0 else "",
        f"couplings of its axes up to {share:.1%} left out" if share > 0.02 else "",
    ]
    return "; ".join(part for part in parts if part)


def _warn(what: str, part: MeshPart) -> None:
    for error, cause in (
        (part.panel_error, "changes by {:.1%} with half the panels"),
        (part.mended, "had to be mended by {:.1%} so that it grows with depth"),
    ):
        if error > LARGEST_ERROR:
            warn_caller(
                f"{what}: its added mass {cause.format(error)}; give more panels (panels=), or a mesh "
                "without thin walls and gaps",
                MeshConvergenceWarning,
            )


class _DepthTable:
    """Added mass over density (m3) over depth, from a ladder of a mesh; wetting, C_S as of `part_from_mesh`.

    `added` and `low` (n, 3) are those at the `rungs` (n,), m, from 0 to where the fluid is unbounded, before
    pile-up and ramp; `over` is the ramp of a flat bottom, m.
    """

    def __init__(self, ladder: PanelLadder, shape: MeshShape, *, wetting: float, slam: float) -> None:
        size, flat = shape.size, shape.flat
        last, root = float(ladder.draughts[-1]), float(np.sqrt(size[0] * size[1]))
        self.height, self.wetting = float(size[2]), wetting
        self.rungs = np.concatenate([[0.0], ladder.draughts, [last + max(last - size[2], root)]])
        deep = np.diag(ladder.unbounded)
        touch = at_touch(ladder.draughts, ladder.added, flat)
        solved = np.concatenate([touch[None], ladder.added, deep[None]])
        self.added = np.maximum.accumulate(np.clip(solved, 0.0, deep), axis=0)
        self.over = 2.0 * touch[2] / (slam * flat) if flat > 0.0 else 0.0
        self.mended = float(np.max(np.abs(self.added - solved)) / deep.max())
        slow = at_touch(ladder.draughts, ladder.low, flat)
        self.low = np.concatenate([slow[None], ladder.low, deep[None]])

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
    """Added mass (3,) as the bottom touches: half of a plate's across a flat one, else none. The sides add as
    depth times the logarithm of depth, as of a plate with a thin edge."""
    out = np.zeros(3)
    if flat > 0.0:
        x = draughts[:2] * np.log(np.sqrt(flat) * np.e / draughts[:2])
        first, second = values[0, 2], values[min(1, len(values) - 1), 2]
        near = len(x) > 1 and 0.0 < x[0] < x[1] and draughts[1] < np.sqrt(flat)
        out[2] = first - (second - first) * x[0] / (x[1] - x[0]) if near else first
    return np.maximum(out, 0.0)
