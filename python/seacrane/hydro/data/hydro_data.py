"""`HydroData`: the frequency-domain hydrodynamics of one vessel as plain values, in one convention."""

from __future__ import annotations

from dataclasses import dataclass, field, fields

import numpy as np

from seacrane.arrays import Array, Complex
from seacrane.hydro.data.frozen import freeze, require_band, require_definite, require_grid, require_positive
from seacrane.hydro.data.memory_model import MemoryModel
from seacrane.inputs.brief import brief

MOTION_RAO_LIMIT = (1e-3, 1e-3, 1e-5, 1e-3, 1e-5, 1e-3)
MASS, DAMPING = "kg, kg m, kg m2", "N s/m, N s, N m s"
ARRAYS = {  # axes, as `axes_of` tells them, and units
    "omega": ("n", "rad/s"),
    "heading": ("m", "rad"),
    "added_mass": ("nij", MASS),
    "damping": ("nij", DAMPING),
    "infinite_frequency_added_mass": ("ij", MASS),
    "zero_frequency_added_mass": ("ij", MASS),
    "restoring": ("ij", "N/m, N, N m"),
    "mass_matrix": ("ij", MASS),
    "linear_damping": ("ij", DAMPING),
    "quadratic_damping": ("i", "N s2/m2, N m s2"),
    "force": ("mni", "N/m, N m/m"),
    "motion_rao": ("mni", "m/m, rad/m"),
    "motion_rao_limit": ("i", "1"),
    "motion_rao_floor": ("i", "1"),
    "linear": ("n", "N m s"),
    "quadratic": ("n", "N m s2"),
    "linearised": ("mn", "N m s"),
    "coefficient": ("mni", "N/m2, N m/m2"),
}


@dataclass(frozen=True, kw_only=True, eq=False)
class DriftCoefficients:
    """Mean second-order load per squared wave amplitude; axes, headings and point as in `HydroDatabase`.

    The mean load of a wave of amplitude a is ``coefficient a^2``. With Newman's approximation (1974, Second
    Order Slowly Varying Forces on Vessels in Irregular Waves) it also gives the slow loads of several waves.

    Attributes
    ----------
    heading : (m,) direction waves travel to, rad, increasing, within [0, 2 pi).
    omega : (n,) wave frequency (not encounter frequency), rad/s, increasing, positive.
    coefficient : (m, n, 6) N/m2 and N m/m2; motions the source does not give are zero.

    Raises
    ------
    ValueError : a wrong shape, a value that is not finite, headings or frequencies that do not rise.
    """

    heading: Array
    omega: Array
    coefficient: Array

    __repr__ = brief

    def __post_init__(self) -> None:
        m, n = np.size(self.heading), np.size(self.omega)
        freeze(self, "drift coefficients", {"heading": (m,), "omega": (n,), "coefficient": (m, n, 6)})
        require_grid("drift coefficients", self.omega, self.heading)


@dataclass(frozen=True, kw_only=True, eq=False)
class AdditionalMatrices:
    """Frequency-dependent terms that are not radiation, kept apart by cause (roll tanks, for example).

    ``added_mass``, ``damping``, ``restoring`` are (n, 6, 6) at the database's frequencies.
    """

    cause: str
    added_mass: Array
    damping: Array
    restoring: Array

    __repr__ = brief


@dataclass(frozen=True, kw_only=True, eq=False)
class RollDamping:
    """Roll damping of a file that tabulates it by frequency.

    ``linear`` (n,) in N m s/rad, ``quadratic`` (n,) in N m s2/rad2, ``linearised`` (m, n) in N m s/rad: what
    the quadratic part amounts to at the wave amplitude ``linearised_amplitude`` (m; None when not known).
    """

    linear: Array
    quadratic: Array
    linearised: Array
    linearised_amplitude: float | None = None

    __repr__ = brief


@dataclass(frozen=True, kw_only=True, eq=False)
class HydroData:
    """Frequency-domain hydrodynamics of one vessel; immutable, every array read-only.

    Convention: x forward, y port, z up; all matrices, forces and motions about the reference point that
    ``origin`` describes, which is also where the incident wave has zero phase; ``exp(+i omega t)``;
    ``heading`` is the direction waves travel to, from +x towards +y. Forces per metre of wave amplitude (N/m,
    N m/m). SI, radians.

    Attributes
    ----------
    omega : (n,) frequencies in rad/s, increasing and positive.
    heading : (m,) in rad, increasing, within [0, 2 pi).
    added_mass, damping : (n, 6, 6) radiation only.
    infinite_frequency_added_mass, zero_frequency_added_mass : (6, 6), or None when not known.
    restoring : (6, 6).
    mass_matrix : (6, 6), or None where the source holds none: what needs one asks for it (`mass_of`).
    force : (m, n, 6) complex wave excitation.
    motion_rao : (m, n, 6) complex motions as the source gives them, or None.
    motion_rao_limit : (6,) how far motions solved from A, B, C and the forces may be from `motion_rao`, by
        the largest motion: what the digits and the methods of the source allow. Where its reader states
        nothing, 1e-5 in heave and pitch, 1e-3 in the rest.
    motion_rao_floor : (6,) share of its largest over all headings below which a motion of the source is
        noise.
    linear_damping : (6, 6) damping beside radiation, the same at all frequencies.
    quadratic_damping : (6,) coefficients of v |v| beside radiation.
    roll_damping : roll damping tabulated by frequency, or None.
    additional : further matrices by cause.
    rho, g, depth : kg/m3, m/s2, m (inf: deep).
    speed : forward speed in m/s. Where it is not zero, `added_mass`, `damping`, `additional` and the linear
        and quadratic `roll_damping` are functions of the encounter frequency, given at the values of `omega`;
        forces, motions and everything else stay by wave frequency. The time domain takes zero speed only.
    length, breadth, draught : m.
    trusted_band : (low, high) in rad/s between which the source vouches for its numbers.
    port_starboard_symmetric : whether headings may be mirrored.
    memory : fitted radiation memory, or None.
    drift : mean second-order wave loads, or None.
    origin, source, name : text.
    """

    name: str
    omega: Array
    heading: Array
    added_mass: Array
    damping: Array
    restoring: Array
    mass_matrix: Array | None = None
    force: Complex
    length: float
    breadth: float
    draught: float
    origin: str
    source: str
    rho: float = 1025.0
    g: float = 9.81
    depth: float = float("inf")
    speed: float = 0.0
    infinite_frequency_added_mass: Array | None = None
    zero_frequency_added_mass: Array | None = None
    motion_rao: Complex | None = None
    motion_rao_limit: Array = field(default_factory=lambda: np.array(MOTION_RAO_LIMIT))
    motion_rao_floor: Array = field(default_factory=lambda: np.full(6, 1e-4))
    linear_damping: Array = field(default_factory=lambda: np.zeros((6, 6)))
    quadratic_damping: Array = field(default_factory=lambda: np.zeros(6))
    roll_damping: RollDamping | None = None
    additional: tuple[AdditionalMatrices, ...] = ()
    trusted_band: tuple[float, float] | None = None
    port_starboard_symmetric: bool = True
    memory: MemoryModel | None = None
    drift: DriftCoefficients | None = None

    def __post_init__(self) -> None:
        what = f"database {self.name!r}"
        sizes = {"n": np.size(self.omega), "m": np.size(self.heading), "i": 6, "j": 6}
        for part in (self, self.roll_damping, *self.additional):
            if part is not None:
                shapes = {name: tuple(sizes[axis] for axis in axes) for name, axes in axes_of(part).items()}
                freeze(part, what, shapes)
        require_grid(what, self.omega, self.heading)
        require_positive(self, what, "rho", "g", "depth", "length", "breadth", "draught")
        if not np.isfinite(self.speed):
            raise ValueError(f"{what}: speed is {self.speed}; give a finite number in m/s")
        require_definite(what, self.mass_matrix)
        require_band(what, self.trusted_band)


Part = HydroData | RollDamping | AdditionalMatrices | DriftCoefficients


def axes_of(part: Part) -> dict[str, str]:
    """Axes of each array: n frequencies, m headings, i motions that a load is on, j motions that make it."""
    names = {entry.name for entry in fields(part)}
    found = {name: axes for name, (axes, _) in ARRAYS.items() if name in names}
    return found | {"restoring": "nij"} if isinstance(part, AdditionalMatrices) else found
