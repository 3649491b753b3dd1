"""`HydroData`: the frequency-domain hydrodynamics of one vessel as plain values, in one convention."""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.hydro.data.drift_coefficients import DriftCoefficients
from seacrane.hydro.data.memory_model import MemoryModel
from seacrane.inputs.brief import brief
from seacrane.inputs.checked import require_unmasked

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

MOTION_RAO_LIMIT = (1e-3, 1e-3, 1e-5, 1e-3, 1e-5, 1e-3)
_SHAPES = {
    "omega": "n",
    "heading": "m",
    "added_mass": "nij",
    "damping": "nij",
    "infinite_frequency_added_mass": "ij",
    "zero_frequency_added_mass": "ij",
    "mass_matrix": "ij",
    "force": "mni",
    "motion_rao": "mni",
    "motion_rao_limit": "i",
    "motion_rao_floor": "i",
    "linear_damping": "ij",
    "quadratic_damping": "i",
    "linear": "n",
    "quadratic": "n",
    "linearised": "mn",
}


@dataclass(frozen=True, kw_only=True, eq=False)
class AdditionalMatrices:
    """Frequency-dependent terms that are not radiation, kept apart by cause (roll tanks, for example).

    ``added_mass``, ``damping``, ``restoring`` are (n, 6, 6) at the database's frequencies.
    """

    cause: str
    added_mass: FloatArray
    damping: FloatArray
    restoring: FloatArray

    __repr__ = brief


@dataclass(frozen=True, kw_only=True, eq=False)
class RollDamping:
    """Roll damping of a file that tabulates it by frequency.

    ``linear`` (n,) in N m s/rad, ``quadratic`` (n,) in N m s2/rad2, ``linearised`` (m, n) in N m s/rad: what
    the quadratic part amounts to at the wave amplitude ``linearised_amplitude`` (m; None when not known).
    """

    linear: FloatArray
    quadratic: FloatArray
    linearised: FloatArray
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
    restoring, mass_matrix : (6, 6).
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
    omega: FloatArray
    heading: FloatArray
    added_mass: FloatArray
    damping: FloatArray
    restoring: FloatArray
    mass_matrix: FloatArray
    force: ComplexArray
    length: float
    breadth: float
    draught: float
    origin: str
    source: str
    rho: float = 1025.0
    g: float = 9.81
    depth: float = float("inf")
    speed: float = 0.0
    infinite_frequency_added_mass: FloatArray | None = None
    zero_frequency_added_mass: FloatArray | None = None
    motion_rao: ComplexArray | None = None
    motion_rao_limit: FloatArray = field(default_factory=lambda: np.array(MOTION_RAO_LIMIT))
    motion_rao_floor: FloatArray = field(default_factory=lambda: np.full(6, 1e-4))
    linear_damping: FloatArray = field(default_factory=lambda: np.zeros((6, 6)))
    quadratic_damping: FloatArray = field(default_factory=lambda: np.zeros(6))
    roll_damping: RollDamping | None = None
    additional: tuple[AdditionalMatrices, ...] = ()
    trusted_band: tuple[float, float] | None = None
    port_starboard_symmetric: bool = True
    memory: MemoryModel | None = None
    drift: DriftCoefficients | None = None

    def __post_init__(self) -> None:
        n, m = np.size(self.omega), np.size(self.heading)
        for part in (self, self.roll_damping, *self.additional):
            if part is not None:
                freeze(part, n, m, self.name, restoring="ij" if part is self else "nij")
        check_increasing(self.name, "omega", self.omega, low=0.0, high=np.inf)
        check_increasing(self.name, "heading", self.heading, low=-1e-12, high=2.0 * np.pi)
        for name in ("rho", "g", "depth", "length", "breadth", "draught"):
            value = float(getattr(self, name))
            if not value > 0.0:
                raise ValueError(f"database {self.name!r}: {name} is {value}; give a positive number")
        if not np.isfinite(self.speed):
            raise ValueError(f"database {self.name!r}: speed is {self.speed}; give a finite number in m/s")
        if np.any(np.linalg.eigvalsh(0.5 * (self.mass_matrix + self.mass_matrix.T)) <= 0.0):
            raise ValueError(
                f"database {self.name!r}: the mass matrix is not positive definite; check mass and inertia"
            )
        if self.trusted_band is not None and not 0.0 <= self.trusted_band[0] < self.trusted_band[1]:
            raise ValueError(
                f"database {self.name!r}: trusted_band {self.trusted_band} is not (low, high) in rad/s"
            )


def freeze(part: Any, n: int, m: int, name: str, *, restoring: str) -> None:
    """Replace every array of ``part`` by a finite, read-only copy of the right shape and type.

    ``restoring`` says in letters what shape that matrix has there: "ij", or "nij" where it has frequencies.
    """
    sizes = {"n": n, "m": m, "i": 6, "j": 6}
    for entry in fields(part):
        value = getattr(part, entry.name)
        letters = _SHAPES.get(entry.name)
        if entry.name == "restoring":
            letters = restoring
        if letters is None or value is None:
            continue
        require_unmasked(f"database {name!r}: {entry.name}", value)
        wanted = tuple(sizes[letter] for letter in letters)
        array = np.array(value, dtype=complex if letters == "mni" else float)
        if array.shape != wanted:
            raise ValueError(f"database {name!r}: {entry.name} has shape {array.shape}; {wanted} is needed")
        if not np.all(np.isfinite(array)):
            where = tuple(int(i) for i in np.argwhere(~np.isfinite(array))[0])
            raise ValueError(
                f"database {name!r}: {entry.name}{list(where)} is {array[where]}; give finite numbers"
            )
        array.setflags(write=False)
        object.__setattr__(part, entry.name, array)


def check_increasing(name: str, what: str, values: FloatArray, *, low: float, high: float) -> None:
    """Raise unless ``values`` are strictly increasing and inside (low, high)."""
    if values.size == 0:
        raise ValueError(f"database {name!r}: {what} is empty; give at least one value")
    steps = np.flatnonzero(np.diff(values) <= 0.0)
    if steps.size:
        i = int(steps[0])
        raise ValueError(
            f"database {name!r}: {what} is not strictly increasing: {values[i]:.6g} then {values[i + 1]:.6g} "
            "at index "
            f"{i + 1}; sort it and drop duplicates"
        )
    if not (values[0] > low and values[-1] < high):
        raise ValueError(
            f"database {name!r}: {what} spans {values[0]:.6g} to {values[-1]:.6g}, outside ({low}, {high})"
        )
