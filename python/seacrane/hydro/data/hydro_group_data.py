"""`HydroGroupData`: the linear hydrodynamics of several hulls in one water as plain values."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from seacrane.arrays import Array, Complex
from seacrane.errors import SceneError
from seacrane.hydro.data.frozen import freeze, require_band, require_definite, require_grid, require_positive
from seacrane.hydro.data.hydro_data import AdditionalMatrices, HydroData, RollDamping
from seacrane.hydro.data.memory_model import MemoryModel
from seacrane.inputs.brief import brief

SHAPES = {
    "position": (3,),
    "mass_matrix": (6, 6),
    "restoring": (6, 6),
    "linear_damping": (6, 6),
    "quadratic_damping": (6,),
}


@dataclass(frozen=True, kw_only=True, eq=False)
class GroupBody:
    """One hull of a `HydroGroup`; immutable, every array read-only.

    Attributes
    ----------
    name : its name in the group.
    position : (3,) m, its reference point from the group's origin, which is on the still waterline.
    heading : rad, of its x axis, from the group's x axis towards its y axis.
    mass_matrix, restoring, linear_damping : (6, 6), of this hull alone, about its reference point and in its
        own axes (x forward, y port, z up); no mass matrix where the source holds none.
    quadratic_damping : (6,) coefficients of v |v| beside radiation.
    length, breadth, draught : m.
    """

    name: str
    position: Array
    mass_matrix: Array | None = None
    restoring: Array
    length: float
    breadth: float
    draught: float
    heading: float = 0.0
    linear_damping: Array = field(default_factory=lambda: np.zeros((6, 6)))
    quadratic_damping: Array = field(default_factory=lambda: np.zeros(6))

    __repr__ = brief

    def __post_init__(self) -> None:
        if not self.name:
            raise ValueError("a body of a group has no name; give each hull one of its own")
        what = f"body {self.name!r}"
        freeze(self, what, SHAPES)
        require_positive(self, what, "length", "breadth", "draught")
        if not np.isfinite(self.heading):
            raise ValueError(f"{what}: heading is {self.heading}; give a finite angle in rad")
        require_definite(what, self.mass_matrix)


def _of_bodies(name: str) -> cached_property[Array]:
    """What `GroupBody` holds, of all bodies."""

    def whole(group: HydroGroupData) -> Array:
        """Of all bodies, (6 k,) or (6 k, 6 k) block by block: water at rest couples no hulls."""
        parts = [getattr(body, name) for body in group.bodies]
        out = np.concatenate(parts) if parts[0].ndim == 1 else np.zeros((6 * len(parts),) * 2)
        for i, part in enumerate(parts):
            if part.ndim == 2:
                out[6 * i : 6 * i + 6, 6 * i : 6 * i + 6] = part
        out.setflags(write=False)
        return out

    return cached_property(whole)


@dataclass(frozen=True, kw_only=True, eq=False)
class HydroGroupData:
    """Linear hydrodynamics of k hulls that feel each other's waves; immutable, every array read-only.

    Motion ``6 i + j`` is motion j (surge to yaw) of body i, about its own reference point and in its own
    axes, turned with its heading. ``exp(+i omega t)``; ``heading`` is the direction that waves travel to,
    from the group's x axis towards its y axis; they have zero phase at the group's origin. SI, radians.
    Valid while the hulls keep their places and headings to each other, at zero speed.

    Attributes
    ----------
    bodies : of each hull, what is its own (`GroupBody`).
    omega, heading, rho, g, depth, trusted_band, origin, source, name : as of `HydroDatabase`, one for all.
    added_mass, damping : (n, 6 k, 6 k) radiation: block (i, j) is the load on body i for motions of body j.
    infinite_frequency_added_mass, zero_frequency_added_mass : (6 k, 6 k), or None when not known.
    force : (m, n, 6 k) complex wave excitation per metre of amplitude, with the shielding of all hulls.
    port_starboard_symmetric : whether headings may be mirrored: every hull lies on the group's x axis.
    lid_damping : share of omega / g of a damping lid in the gap that the source computed with; None when it
        does not say.
    memory : fitted radiation memory of all motions, or None.
    """

    name: str
    bodies: tuple[GroupBody, ...]
    omega: Array
    heading: Array
    added_mass: Array
    damping: Array
    force: Complex
    source: str
    origin: str = "origin of the meshes, on the still waterline"
    rho: float = 1025.0
    g: float = 9.81
    depth: float = float("inf")
    infinite_frequency_added_mass: Array | None = None
    zero_frequency_added_mass: Array | None = None
    trusted_band: tuple[float, float] | None = None
    port_starboard_symmetric: bool = False
    lid_damping: float | None = None
    memory: MemoryModel | None = None

    speed: ClassVar[float] = 0.0
    roll_damping: ClassVar[RollDamping | None] = None
    additional: ClassVar[tuple[AdditionalMatrices, ...]] = ()

    def __post_init__(self) -> None:
        what = f"group {self.name!r}"
        object.__setattr__(self, "bodies", tuple(self.bodies))
        if len(self.bodies) < 2 or len(set(self.names)) < len(self.bodies):
            raise ValueError(
                f"{what}: bodies are named {', '.join(self.names) or 'nothing'}; give two or more, each "
                "with a name of its own"
            )
        n, m, k = np.size(self.omega), np.size(self.heading), 6 * len(self.bodies)
        matrices = {"added_mass": (n, k, k), "damping": (n, k, k)}
        limits = dict.fromkeys(("infinite_frequency_added_mass", "zero_frequency_added_mass"), (k, k))
        freeze(self, what, {"omega": (n,), "heading": (m,), **matrices, **limits, "force": (m, n, k)})
        require_grid(what, self.omega, self.heading)
        require_positive(self, what, "rho", "g", "depth")
        require_band(what, self.trusted_band)
        if self.memory is not None and self.memory.added_mass.shape != (k, k):
            raise ValueError(
                f"{what}: its memory has {len(self.memory.added_mass)} motions, the group {k}; fit one with "
                "fit_memory(database=group)"
            )

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the bodies, in the order of the motions."""
        return tuple(body.name for body in self.bodies)

    @property
    def mass_matrix(self) -> Array | None:
        """(6 k, 6 k), or None where that of a body is not known."""
        known = all(body.mass_matrix is not None for body in self.bodies)
        return self._mass_matrix if known else None

    _mass_matrix = _of_bodies("mass_matrix")
    restoring = _of_bodies("restoring")
    linear_damping = _of_bodies("linear_damping")
    quadratic_damping = _of_bodies("quadratic_damping")

    def place(self, name: str) -> slice:
        """Where the six motions of a body stand among all.

        Raises
        ------
        KeyError : no body of that name.
        """
        if name not in self.names:
            raise KeyError(f"group {self.name!r} has no body {name!r}; it has {', '.join(self.names)}")
        start = 6 * self.names.index(name)
        return slice(start, start + 6)


Hydrodynamics = HydroData | HydroGroupData  # of one hull, or of several: the same equations, of other size

USUAL_RADII = np.array([0.36, 0.25, 0.25])  # of gyration of ships, over breadth, length and length


def mass_of(database: Hydrodynamics) -> Array:
    """The mass matrix, (6, 6) or (6 k, 6 k), asked for where the source holds none.

    Raises SceneError: names the source and the bodies, and what gives their masses.
    """
    if database.mass_matrix is not None:
        return database.mass_matrix
    bodies = database.bodies if isinstance(database, HydroGroupData) else ()
    of = ", ".join(body.name for body in bodies if body.mass_matrix is None)
    fix = (
        ", of each body by name"
        if bodies
        else ", mass_matrix in [vessel] of a lift file, or a file that holds it, which `seacrane hydro PATH "
        "--mass T X Y Z RX RY RZ --write ship.nc` writes"
    )
    raise SceneError.of(
        f"database {database.name!r}: mass_matrix",
        f"is not known{of and f' of {of}'}: {database.source[:200]} holds none; give load_database(path, "
        f"mass_matrix=...), (6, 6) in SI about the file's reference point{fix}",
    )


def mass_scales(database: Hydrodynamics) -> Array:
    """Diagonal of the mass matrix; where there is none, that of what the boxes displace, as a scale alone."""
    bodies = database.bodies if isinstance(database, HydroGroupData) else (database,)
    return np.concatenate([_mass_scales(body, database.rho) for body in bodies])


def _mass_scales(body: HydroData | GroupBody, rho: float) -> Array:
    if body.mass_matrix is not None:
        return np.diag(body.mass_matrix)
    radii = USUAL_RADII * (body.breadth, body.length, body.length)
    return np.asarray(rho * body.length * body.breadth * body.draught * np.append(np.ones(3), radii**2))


def in_trusted_band(database: Hydrodynamics, omega: Array | None = None) -> NDArray[np.bool_]:
    """Which of ``omega`` (rad/s, any shape; None: the database's) lie in it; all where there is no band."""
    low, high = database.trusted_band or (0.0, np.inf)
    omega = database.omega if omega is None else omega
    return np.asarray((omega >= low - 1e-9) & (omega <= high + 1e-9))
