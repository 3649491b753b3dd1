"""`HydroDatabase`: the frequency-domain hydrodynamics of one vessel, in one convention."""

from __future__ import annotations

from dataclasses import dataclass, field
from os import PathLike
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seacrane.errors import SceneError
from seacrane.hydro.database.arrays import check_increasing, freeze
from seacrane.hydro.database.beyond_band import with_limits
from seacrane.hydro.database.data_warnings import LARGEST_HEADING_GAP
from seacrane.hydro.database.drift import DriftCoefficients
from seacrane.hydro.database.heading_circle import PORT_STARBOARD, both_sides, largest_gap
from seacrane.hydro.database.interpolation import spline_weights
from seacrane.hydro.memory.model import MemoryModel

if TYPE_CHECKING:
    from collections.abc import Sequence

    import xarray
    from matplotlib.figure import Figure

    from seacrane.hydro.database.check import CheckRow
    from seacrane.hydro.database.selection import Choice

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

__all__ = ["MOTIONS", "PORT_STARBOARD", "AdditionalMatrices", "HydroDatabase", "RollDamping"]

MOTIONS = ("surge", "sway", "heave", "roll", "pitch", "yaw")
MOTION_RAO_LIMIT = (1e-3, 1e-3, 1e-5, 1e-3, 1e-5, 1e-3)


@dataclass(frozen=True, kw_only=True, eq=False)
class AdditionalMatrices:
    """Frequency-dependent terms that are not radiation, kept apart by cause (roll tanks, for example).

    ``added_mass``, ``damping``, ``restoring`` are (n, 6, 6) at the database's frequencies.
    """

    cause: str
    added_mass: FloatArray
    damping: FloatArray
    restoring: FloatArray


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


@dataclass(frozen=True, kw_only=True, eq=False)
class HydroDatabase:
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

    def force_at(
        self, omega: ArrayLike, heading: ArrayLike, *, outside: Literal["error", "limits"] = "error"
    ) -> ComplexArray:
        """Complex wave excitation per metre of amplitude, by cubic splines in frequency and heading.

        Parameters
        ----------
        omega, heading : rad/s and rad, broadcast against each other; headings wrap, and are mirrored where
            the vessel is port-starboard symmetric.
        outside : what to do with frequencies beyond the database: ``"error"``, or ``"limits"``: below it the
            force tends to the hydrostatic one of a long wave, above it there is none.

        Returns
        -------
        (..., 6) N/m and N m/m, a new array.

        Raises
        ------
        SceneError : a frequency outside the range (unless ``outside="limits"``), a value that is not finite,
            or a heading in a gap of more than 45 degrees between the database's headings.
        """
        if outside not in ("error", "limits"):
            raise SceneError(f"database {self.name!r}: outside is {outside!r}; choose 'error' or 'limits'")
        wanted_omega, wanted_heading = np.broadcast_arrays(
            np.asarray(omega, float), np.asarray(heading, float)
        )
        shape = wanted_omega.shape
        w, b = wanted_omega.ravel(), wanted_heading.ravel()
        if not (np.all(np.isfinite(w)) and np.all(np.isfinite(b))):
            raise SceneError(f"database {self.name!r}: frequencies and headings must be finite numbers")
        slack = 1e-9 * self.omega[-1]
        beyond = (w < self.omega[0] - slack) | (w > self.omega[-1] + slack)
        if outside == "error" and np.any(beyond):
            raise SceneError(
                f"database {self.name!r}: omega = {w[beyond][0]:.6g} rad/s is outside {self.omega[0]:.6g} to "
                f"{self.omega[-1]:.6g} rad/s; ask within it, or pass outside='limits'"
            )
        in_frequency = spline_weights(self.omega, np.clip(w, self.omega[0], self.omega[-1]))
        circle, table = self.full_circle()
        in_heading = self._heading_weights(circle, b)
        by_heading = (in_heading @ table.reshape(len(circle), -1)).reshape(len(b), len(self.omega), 6)
        force = np.einsum("qn,qnd->qd", in_frequency, by_heading)
        return with_limits(self, w, force).reshape(*shape, 6)

    def full_circle(self) -> tuple[FloatArray, ComplexArray]:
        """Headings (k,) within [0, 2 pi), the mirrored ones added, and their forces (k, n, 6); new arrays."""
        if not self.port_starboard_symmetric:
            return self.heading.copy(), self.force.copy()
        heading, source, mirrored = both_sides(self.heading)
        parity = np.where(mirrored[:, None], PORT_STARBOARD, 1.0)
        return heading, self.force[source] * parity[:, None, :]

    def _heading_weights(self, circle: FloatArray, heading: FloatArray) -> FloatArray:
        """Weights (q, k) of the periodic spline over the headings; stored headings are exact in any case."""
        gap = largest_gap(circle)
        if gap <= LARGEST_HEADING_GAP + 1e-9:
            return spline_weights(circle, heading, period=2.0 * np.pi)
        distance = np.abs(np.angle(np.exp(1j * (heading[:, None] - circle))))
        nearest = distance.argmin(axis=1)
        off = distance[np.arange(len(heading)), nearest] > 1e-6
        if np.any(off):
            raise SceneError(
                f"database {self.name!r}: heading {np.degrees(heading[off][0]):.6g} deg is not among the "
                f"stored ones, whose largest gap is {np.degrees(gap):.3g} deg; above 45 deg "
                "nothing is interpolated"
            )
        return np.asarray(np.eye(len(circle))[nearest])

    def at(self, point: ArrayLike, *, phase_origin: bool = True, net_lift: float = 0.0) -> HydroDatabase:
        """The same vessel about another reference point; nothing is fitted or interpolated anew.

        Matrices, forces, motions, limits of the added mass, restoring, drift and the memory model (with the
        same states) are moved exactly. Damping tabulated by frequency acts on roll alone and stays; the time
        domain takes it at the uncoupled roll frequency, which is another one about another point.

        Parameters
        ----------
        point : (3,) the new point in m from the present one, vessel's axes. Off the centreline the headings
            of both sides are written out, as no side of that point mirrors the other.
        phase_origin : whether waves have zero phase at the new point from now on, as everything that takes a
            database expects: forces and motions are multiplied by ``exp(+i k (x cos b + y sin b))`` with the
            wavenumber of the database's depth. False keeps the phases of waves at the old point, which
            `origin` then says: for comparison with other codes.
        net_lift : N, buoyancy minus weight at rest. Zero for a vessel that floats by itself: its restoring
            moves like any matrix. Else C44, C55, C46 and C56 gain what that load does as it turns with the
            ship.

        Warns
        -----
        seacrane.hydro.QuadraticDampingWarning : quadratic damping of a translation cannot be moved.

        Raises
        ------
        ValueError : the point is not three finite numbers.
        """
        from seacrane.hydro.database.transform import moved_database

        return moved_database(self, point, phase_origin=phase_origin, net_lift=net_lift)

    def mirror(self) -> HydroDatabase:
        """The vessel with port and starboard exchanged: sway, roll, yaw and headings change their signs.

        Memory and drift are mirrored too. Mirroring twice gives the database back; for a symmetric vessel
        the mirrored headings are the other side of the same `full_circle`.
        """
        from seacrane.hydro.database.transform import mirrored_database

        return mirrored_database(self)

    def select(
        self,
        *,
        omega: Choice = None,
        heading: Choice = None,
        every: int = 1,
        every_heading: int = 1,
    ) -> HydroDatabase:
        """Some of the frequencies and headings, with the stored values as they are.

        Parameters
        ----------
        omega : a tuple (low, high) in rad/s, ends included; or indices: a list, an integer array, a slice.
        heading : a tuple (low, high) in rad, which may cross 2 pi (-0.5, 0.5); or indices.
        every, every_heading : keep every n-th of what is selected.

        Returns
        -------
        HydroDatabase : the trusted band is cut to the frequencies left. A memory model is kept while all
            frequencies are, and dropped with the first one: it belongs to all the data it was fitted to.
            Drift coefficients have frequencies and headings of their own, and stay.

        Raises
        ------
        ValueError : nothing is left, nothing of the trusted band is left, or a choice is no range or index.
        """
        from seacrane.hydro.database.selection import selected_database

        return selected_database(self, omega, heading, every, every_heading)

    def plot(self, what: str | Sequence[str] | None = None) -> dict[str, Figure]:
        """Figures by name: added_mass, damping, retardation, wave_force, motion; needs matplotlib.

        Parameters
        ----------
        what : a name or several; None draws all. Fitted curves are those of `memory`, where there is one.

        Returns
        -------
        dict of matplotlib.figure.Figure : they belong to no window; ``savefig`` writes one.

        Raises
        ------
        ValueError : a name that is not among the figures.
        """
        from seacrane.figures.hydro import hydro_figures

        return hydro_figures(database=self, what=what)

    def check(self) -> list[CheckRow]:
        """Self-check: closure, symmetry, damping, natural periods, memory; see `check_database`."""
        from seacrane.hydro.database.check import check_database

        return check_database(self)

    def save(self, path: str | PathLike[str]) -> None:
        """Write everything, the memory model included, to a NetCDF file, atomically and without loss."""
        from seacrane.hydro.readers.netcdf import save_database

        save_database(self, path)

    @staticmethod
    def load(path: str | PathLike[str]) -> HydroDatabase:
        """Read a file written by `save`.

        Raises
        ------
        seacrane.errors.FileFormatError : the file is not one of ours, or is damaged.
        """
        from seacrane.hydro.readers.netcdf import load_database_file

        return load_database_file(path)

    def to_xarray(self) -> xarray.Dataset:
        """The arrays as a labelled dataset (copies), complex values kept complex; needs xarray."""
        from seacrane.hydro.readers.netcdf import to_xarray

        return to_xarray(self)
