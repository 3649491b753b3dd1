"""How far a fluid memory moves a vessel's motions: in seas, and at the peak of each resonance."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from seacrane.arrays import Array, Complex
from seacrane.hydro.data.hydro_group_data import Hydrodynamics, HydroGroupData, mass_of
from seacrane.hydro.data.memory_model import MemoryModel, MotionError
from seacrane.hydro.memory.identification import symmetric, within
from seacrane.hydro.memory.retardation import RetardationModel

SHORTEST, LONGEST, SEAS = 5.0, 18.0, 9  # peak periods of the seas of a ship, s, and how many
SHIP, MODELLED = 60.0, 115.0  # m: a ship's least length, and what a shorter hull may be a model of
PEAK_ENHANCEMENT = 3.3
GRID = 160  # frequencies over the band, beside those of the database
ABOUT_PEAK = np.array([-3.0, -2.0, -1.2, -0.6, -0.25, 0.0, 0.25, 0.6, 1.2, 2.0, 3.0])  # half widths
SPRING_PERIOD, SPRING_DAMPING = 200.0, 0.1  # s and share of critical, of `Scene.add_vessel`
RESONANT = (2, 3, 4)
MANY = 12  # motions; of more, an impedance is factored once for all headings and not for each
FAINT = 1e-4  # share of the largest motion below which a motion is not there


class _Table:
    """Splines of a database over the frequency."""

    def __init__(self, database: Hydrodynamics) -> None:
        from scipy.interpolate import CubicSpline

        def spline(values: Array | Complex, axis: int = 0) -> CubicSpline:
            return CubicSpline(database.omega, values, axis=axis)

        self.database = database
        self.added_mass = spline(symmetric(database.added_mass))
        self.damping = spline(symmetric(database.damping))
        w = database.omega[:, None, None]
        additional = np.zeros(database.added_mass.shape, dtype=complex)
        for part in database.additional:
            additional = additional + (-(w**2) * part.added_mass + 1j * w * part.damping + part.restoring)
        self.additional = spline(additional)
        self.force = spline(database.force, 1)
        roll = database.roll_damping
        self.roll = None if roll is None else spline(roll.linear + roll.linearised, 1)


class _Solved:
    """Impedance and motions of a database at some frequencies."""

    def __init__(self, table: _Table, omega: Array) -> None:
        database = table.database
        self.table, self.omega = table, omega
        w = omega[:, None, None]
        self.added_mass, self.damping = table.added_mass(omega), table.damping(omega)
        self.additional, self.force = table.additional(omega), table.force(omega)
        self.memory = -(w**2) * self.added_mass + 1j * w * self.damping + self.additional
        mass = mass_of(database)
        nothing = np.zeros(mass.shape)
        self.static = sum((part.restoring[0] for part in database.additional), nothing)
        held = np.isin(np.arange(len(nothing)) % 6, (0, 1, 5))
        heavy = np.where(held, np.diag(mass + self.added_mass[-1]), 0.0)
        spring = 2.0 * np.pi / SPRING_PERIOD
        still = -(w**2) * mass + 1j * w * database.linear_damping + database.restoring
        still = still + np.diag(heavy) * (spring**2 + 2j * w * SPRING_DAMPING * spring)
        if table.roll is None:
            self.impedance = still + self.memory
        else:
            whole = np.broadcast_to(still + self.memory, (len(database.heading), *self.memory.shape)).copy()
            whole[:, :, 3, 3] += 1j * omega * table.roll(omega)
            self.impedance = whole
        self.motion = np.linalg.solve(self.impedance, self.force[..., None])[..., 0]
        middle = self.impedance if self.impedance.ndim == 3 else self.impedance.mean(axis=0)
        self.receptance = np.linalg.inv(middle)

    def peak_frequencies(self) -> list[tuple[float, float]]:
        """Frequency and half width over it of the resonances of heave, roll and pitch."""
        found = []
        for i in resonant_motions(len(self.static)):
            size = np.abs(self.receptance[:, i, i])
            at = int(size.argmax())
            if not 0 < at < len(size) - 1:
                continue
            dynamic = 1.0 / self.receptance[at, i, i]
            slope = abs((1.0 / self.receptance[at + 1, i, i] - 1.0 / self.receptance[at - 1, i, i]).real)
            width = abs(dynamic.imag) * (self.omega[at + 1] - self.omega[at - 1]) / max(slope, 1e-300)
            found.append((float(self.omega[at]), float(np.clip(width / self.omega[at], 1e-3, 0.2))))
        return found


class MotionJudge(_Solved):
    """The motions of a database or a group, with springs and viscous damping, and the seas that weigh them.

    Attributes
    ----------
    omega : (n,) frequencies within the band, rad/s.
    added_mass, damping : (n, 6, 6) radiation, made symmetric.
    motion : (m, n, 6) per metre of wave amplitude.
    moves : (6,) bool, what is more than noise. variance : (seas, 6) of each motion at its largest heading.

    Of a group of k hulls 6 stands for 6 k.
    about_peaks : frequencies about each resonance, rad/s.
    periods : (seas,) peak periods, s.
    """

    def __init__(self, database: Hydrodynamics, band: tuple[float, float]) -> None:
        table = _Table(database)
        peaks = _Solved(table, np.linspace(*band, 4 * GRID)).peak_frequencies()
        inner = database.omega[within(database.omega, band)]
        self.about_peaks = np.concatenate([[w * (1.0 + z * ABOUT_PEAK)] for w, z in peaks] or [[]]).ravel()
        every = np.concatenate([inner, np.linspace(*band, GRID), self.about_peaks])
        super().__init__(table, np.unique(np.clip(every, *band)))
        self.periods = peak_periods(length_of(database))
        self.weights = _sea_energies(self.omega, self.periods)
        variance = np.einsum("sn,mni->smi", self.weights, np.abs(self.motion) ** 2).max(axis=1)
        size = np.abs(self.motion).max(axis=(0, 1))
        rotation = np.arange(len(size)) % 6 > 2
        self.moves = size > FAINT * np.where(rotation, size[rotation].max(), size[~rotation].max())
        self.variance = np.maximum(variance, 1e-300)

    def error(self, difference: Complex) -> MotionError:
        """The error of a difference (n, 6, 6) of impedance, the model's less the data's."""
        impedance = self.impedance + difference
        if impedance.ndim == 3 and len(self.moves) > MANY:
            changed = np.moveaxis(np.linalg.solve(impedance, np.moveaxis(self.force, 0, 2)), 2, 0)
        else:
            changed = np.linalg.solve(impedance, self.force[..., None])[..., 0]
        return self._of_motions(changed - self.motion)

    def error_of_pair(self, j: int, k: int, difference: Complex) -> MotionError:
        """The error of a difference (n,) of the impedance of a pair of a group, by Woodbury's formula."""
        pair = [j, k]
        coupled = difference[:, None, None] * np.eye(2)[::-1]
        lost = np.eye(2) + coupled @ self.receptance[:, pair][:, :, pair]
        pushed = np.linalg.solve(lost, coupled @ np.moveaxis(self.motion[:, :, pair], 0, 2))
        return self._of_motions(-np.moveaxis(self.receptance[:, :, pair] @ pushed, 2, 0))

    def _of_motions(self, change: Complex) -> MotionError:
        apart = np.abs(change)
        variance = np.einsum("sn,mni->smi", self.weights, apart**2)
        share = np.sqrt(variance.max(axis=1) / self.variance)
        seas = np.where(self.moves, share, 0.0).max(axis=0)
        peaks = np.zeros(len(self.moves))
        for i in resonant_motions(len(peaks)):
            if self.moves[i]:
                heading, at = np.unravel_index(int(np.abs(self.motion[..., i]).argmax()), apart.shape[:2])
                peaks[i] = apart[heading, at, i] / np.abs(self.motion[heading, at, i])
        return MotionError(seas=seas, peaks=peaks)

    def error_of(self, model: MemoryModel | RetardationModel) -> MotionError:
        """The error of a memory model of all causes."""
        w = self.omega[:, None, None]
        added_mass, damping = model.frequency_response(self.omega)
        more_mass, more_damping = model.additional_response(self.omega)
        fitted = -(w**2) * (added_mass + more_mass) + 1j * w * (damping + more_damping)
        return self.error(fitted + self.static - self.memory)

    def sides(self, omega: Array, group: list[int]) -> tuple[Complex, Complex]:
        """What a misfit of the kernel of a group's motions at ``omega`` (n,) moves, weighted.

        A misfit dK of the retardation functions moves the motions X by -H i w dK X, to first order:
        ``left @ (i w dK) @ right``, (n, p, p) and (n, p, headings). Squares are summed over motions, headings
        and seas, each over the variance of the motion; zero out of the band.
        """
        solved = _Solved(self.table, omega)
        inside = within(omega, (self.omega[0], self.omega[-1]))
        energies = _sea_energies(omega, self.periods) * inside
        weight = energies.T @ np.where(self.moves, 1.0 / self.variance, 0.0)
        square = np.ix_(range(len(omega)), group, group)
        left = solved.receptance[square] * np.sqrt(weight[:, group])[:, :, None]
        return left, np.linalg.qr(np.moveaxis(solved.motion[:, :, group], 1, 0))[1].swapaxes(1, 2)

    def lever(self, omega: Array, group: list[int]) -> Complex:
        """The same (n, p, p) by the misfit of the p pairs of a group."""
        left, headings = self.sides(omega, group)
        columns = []
        for j, k in zip(*np.triu_indices(len(group)), strict=True):
            column = left[:, :, j, None] * headings[:, k, None, :]
            if j != k:
                column = column + left[:, :, k, None] * headings[:, j, None, :]
            columns.append(column.reshape(len(omega), -1))
        moved = 1j * omega[:, None, None] * np.stack(columns, axis=2)
        pairs = len(columns)
        short = max(0, pairs - moved.shape[1])
        return np.asarray(np.linalg.qr(np.pad(moved, ((0, 0), (0, short), (0, 0))))[1][:, :pairs])


@lru_cache(maxsize=8)
def motion_judge(database: Hydrodynamics, band: tuple[float, float]) -> MotionJudge:
    """One for each database and band of a process."""
    return MotionJudge(database, band)


def resonant_motions(count: int) -> list[int]:
    """Heave, roll and pitch of each hull, of ``count`` motions."""
    return [i for i in range(count) if i % 6 in RESONANT]


def peak_periods(length: float) -> Array:
    """Peak periods of the seas (s) that a hull of a length (m) meets: 5 to 18 s for ships.

    A shorter hull may be a boat or a buoy in the sea, or the model of a ship in waves to scale: the periods
    go from those of such a model up to those in which it follows the waves, by Froude's law. Steps are as
    those of a ship.
    """
    if length >= SHIP:
        return np.geomspace(SHORTEST, LONGEST, SEAS)
    low, high = SHORTEST * np.sqrt(length / MODELLED), LONGEST * np.sqrt(length / SHIP)
    step = np.log(LONGEST / SHORTEST) / (SEAS - 1)
    return np.geomspace(low, high, 1 + int(np.ceil(np.log(high / low) / step)))


def length_of(database: Hydrodynamics) -> float:
    """Of the hull, or of the longest of a group, m."""
    if isinstance(database, HydroGroupData):
        return max(body.length for body in database.bodies)
    return database.length


def _sea_energies(omega: Array, periods: Array) -> Array:
    """Energy (seas, n) of every sea (JONSWAP) at every frequency, on a scale of its own."""
    peak = 2.0 * np.pi / periods[:, None]
    width = np.where(omega <= peak, 0.07, 0.09)
    near = np.exp(-0.5 * ((omega - peak) / (width * peak)) ** 2)
    shape = omega**-5.0 * np.exp(-1.25 * (peak / omega) ** 4) * PEAK_ENHANCEMENT**near
    return np.asarray(shape * np.gradient(omega))
