"""Added mass of a closed mesh on a ladder of draughts, by Capytaine's panels.

They carry potentials ("direct"): on a sphere they err by a fifth of what sources do, on a cube by a third
more, at sharp edges by more still.

Two limits at the surface. A motion faster than all waves sees no pressure there (infinite frequency), one
slower than all sees a wall (zero frequency). At the first, added mass cannot fall with depth in any
direction: by Dirichlet's principle -A/2 is the least value of a functional over potentials that vanish at
the surface, and deeper water admits all of those before. A fall is an error of the panels.
"""

from __future__ import annotations

import hashlib
import json
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.errors import SceneError
from seacrane.hydro.data.packed import NOT_PACKED, packed, unpacked
from seacrane.hydro.hull.by_capytaine import import_capytaine
from seacrane.hydro.hull.hydrostatics import area_vectors, triangles_of
from seacrane.hydro.hull.panels import cut_panels
from seacrane.inputs.user_cache import keep_file, read_kept, user_cache
from seacrane.water.mesh_volume import MeshShape

Array = NDArray[np.float64]

VERSION = 3  # raised with every change of what is solved
KIND, SUFFIX = "added_mass", ".ladder"
AXES = ("Surge", "Sway", "Heave")
MOST_PANELS = 3000  # 16 bytes for each pair of them, two matrices: 0.3 GB
ON_SURFACE = 1e-7  # of the size
NO_AREA = 1e-14  # of the square of the size
RUNGS, CLUSTERED = 10, 1.5  # to awash; denser near touch
CLEARANCES = (0.04, 0.1, 0.25, 0.5, 1.0, 2.0)  # below awash, of the root of the plan's box
FIRST_FLAT = (0.02, 0.05)  # of the root of a flat bottom's area
MANY, LONGER = 2.0, 1.2  # times the panels asked for; steps towards them
SETTLED = 0.005  # of the unbounded value: what the surface may still take


@dataclass(frozen=True, kw_only=True, eq=False)
class PanelLadder:
    """Added mass over density, m3.

    Attributes
    ----------
    draughts : (n,) m, of the lowest point.
    added, low : (n, 3) along the axes, at infinite and at zero frequency.
    unbounded : (3, 3) without a surface.
    coarse : (3,) its diagonal with half the panels.
    panels : most that a draught took.
    code : the program and its version.
    """

    draughts: Array
    added: Array
    low: Array
    unbounded: Array
    coarse: Array
    panels: int
    code: str

    @property
    def error(self) -> float:
        """Largest change of the unbounded added mass with half the panels, over the largest of its axes."""
        fine = np.diag(self.unbounded)
        return float(np.max(np.abs(self.coarse - fine)) / fine.max())


def panel_ladder(what: str, shape: MeshShape, draughts: Array | None, panels: int) -> PanelLadder:
    """The ladder of a closed mesh; kept on disk.

    Parameters
    ----------
    what : The mesh, for messages.
    draughts : (n,) m; None: from touch down to where the surface no longer counts.
    panels : About how many a draught takes.

    Raises
    ------
    ImportError : without Capytaine, for what was not solved before.
    SceneError : too many triangles for a panel code.
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
    unbounded = surface.solved(None, np.inf)
    coarse = surface.solved(None, np.inf, share=0.5)
    rungs = default_draughts(surface.shape) if draughts is None else _with_touch(surface.shape, draughts)
    height = surface.shape.size[2]
    added: list[Array] = []
    for draught in rungs:
        added.append(surface.solved(float(draught), np.inf))
        left = np.diag(unbounded) - np.diag(added[-1])
        if draughts is None and draught > height and np.all(left <= SETTLED * np.diag(unbounded)):
            break
    used = rungs[: len(added)]
    low = [surface.solved(float(draught), 0.0) for draught in used]
    return PanelLadder(
        draughts=used, added=np.array([np.diag(one) for one in added]),
        low=np.array([np.diag(one) for one in low]), unbounded=unbounded, coarse=np.diag(coarse).copy(),
        panels=surface.most, code=surface.code,
    )  # fmt: skip


def default_draughts(shape: MeshShape) -> Array:
    """Draughts (n,): denser near touch, and on below awash."""
    long, wide, height = shape.size
    above = height * (np.arange(1, RUNGS + 1) / RUNGS) ** CLUSTERED
    first = _near_touch(shape)
    above = above[above > 1.2 * first.max(initial=0.0)]
    below = height + np.sqrt(long * wide) * np.array(CLEARANCES)
    return np.concatenate([first, above, below])


def _near_touch(shape: MeshShape) -> Array:
    """Draughts near touch, from which that of a flat bottom as it touches follows; none of another bottom."""
    first = np.sqrt(shape.flat) * np.array(FIRST_FLAT)
    return np.asarray(first[(first > 0.0) & (first < 0.9 * shape.size[2])])


def _with_touch(shape: MeshShape, draughts: Array) -> Array:
    """Draughts that were given, after those near touch."""
    first = _near_touch(shape)
    return np.concatenate([first[first < 0.9 * draughts[0]], draughts])


class _Panels:
    """A closed mesh, and what Capytaine makes of it at a draught."""

    def __init__(self, what: str, shape: MeshShape, panels: int) -> None:
        count = len(shape.triangles)
        if count > MOST_PANELS:
            raise SceneError(
                f"{what}: has {count} triangles, above the {MOST_PANELS} panels that are solved "
                "for; decimate it in the program that made it"
            )
        instead = "give a TablePart with added masses from elsewhere"
        self.capytaine = import_capytaine(f"{what}: its added mass", instead)
        self.what, self.shape, self.panels = what, shape, panels
        self.code, self.most = f"Capytaine {self.capytaine.__version__}", 0
        self.solver = self.capytaine.BEMSolver()

    def solved(self, draught: float | None, omega: float, share: float = 1.0) -> Array:
        """Added mass (3, 3) over density; without a draught, in a fluid without a surface."""
        surface = np.inf if draught is None else 0.0
        depth = 2.0 * self.shape.size[2] if draught is None else draught
        wet = self._wet(depth)
        panels = refined(wet, share * self.panels)
        self.most = max(self.most, len(panels))
        faces = np.arange(3 * len(panels)).reshape(-1, 3)[:, [0, 1, 2, 2]]
        mesh = self.capytaine.Mesh(vertices=panels.reshape(-1, 3), faces=faces)
        dofs = self.capytaine.rigid_body_dofs(only=AXES, rotation_center=(0.0, 0.0, 0.0))
        body = self.capytaine.FloatingBody(mesh=mesh, dofs=dofs)
        rows = [self._row(body, omega, surface, axis) for axis in AXES]
        return np.array(rows, dtype=float)

    def _row(self, body: Any, omega: float, surface: float, axis: str) -> list[float]:
        problem = self.capytaine.RadiationProblem(
            body=body, omega=omega, free_surface=surface, water_depth=np.inf, radiating_dof=axis, rho=1.0
        )
        masses = self.solver.solve(problem, method="direct", keep_details=False).added_masses
        return [float(masses[one]) for one in AXES]

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
