"""`fit_passive`: radiation memory as one passive model with common poles per group of coupled motions."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from seacrane.hydro.data.hydro_data import HydroData
from seacrane.hydro.data.memory_model import RADIATION, FitRow, MemoryBlock
from seacrane.hydro.data.motion import motion_errors, motion_response
from seacrane.hydro.memory.identification import r_squared
from seacrane.hydro.memory.oscillators import GroupData, Oscillators, fit_oscillators
from seacrane.hydro.memory.realisation import TYPICAL_VELOCITY, largest_states

FloatArray = NDArray[np.float64]
Entries = list[tuple[int, int]]

MOST_MASSES = 7  # beyond one per motion
PATIENCE = 3  # orders in a row without gain, after which more masses are not tried
GAIN = 1e-3  # of the worst R2
WEAK_PAIR = 0.01  # of the geometric mean of the diagonals' peaks: judged by its effect on motions
WEAK_PAIR_MOTION = 0.01  # largest change of any motion that a weak pair may cause


def fit_passive(
    *,
    database: HydroData,
    added_mass: FloatArray,
    damping: FloatArray,
    entries: Iterable[tuple[int, int]],
    known: FloatArray | None,
    trusted: NDArray[np.bool_],
    r2: float,
) -> tuple[list[MemoryBlock], list[FitRow], FloatArray]:
    """One block per group of motions that ``entries`` couple; orders as low as ``r2`` allows.

    Parameters
    ----------
    database : for frequencies, and for the motions by which weak pairs are judged.
    added_mass, damping : (n, 6, 6), symmetric.
    entries : (j, k) with memory.
    known : (6, 6) infinite-frequency added mass, or None to estimate it.
    trusted : (n,) frequencies over which R2 is judged.
    r2 : that added mass and damping of every pair shall reach, weak pairs (peak of A's variation and B below
        1 % of the geometric mean of their diagonals' peaks) excepted: these shall not change any motion by
        more than 1 % of its largest.
    """
    pairs = sorted((min(pair), max(pair)) for pair in entries)
    blocks: list[MemoryBlock] = []
    rows: list[FitRow] = []
    infinite = np.zeros((6, 6))
    for group in motion_groups(pairs):
        inside = [pair for pair in pairs if pair[0] in group]
        fit = _GroupFit(database, added_mass, damping, group, inside, known, trusted)
        block, group_infinite, group_rows = fit.lowest_order(r2)
        blocks.append(block)
        rows += group_rows
        infinite[np.ix_(group, group)] = group_infinite
    return blocks, rows, infinite


def motion_groups(pairs: Entries) -> list[list[int]]:
    """Motions that hang together through ``pairs``, each group in increasing order."""
    groups: list[set[int]] = []
    for pair in pairs:
        touched = [group for group in groups if group & set(pair)]
        groups = [group for group in groups if group not in touched]
        groups.append(set(pair).union(*touched))
    return sorted(sorted(group) for group in groups)


class _GroupFit:
    """Data of one group, and the judgement of a model of it."""

    def __init__(
        self,
        database: HydroData,
        added_mass: FloatArray,
        damping: FloatArray,
        group: list[int],
        pairs: Entries,
        known: FloatArray | None,
        trusted: NDArray[np.bool_],
    ) -> None:
        self.database, self.group, self.trusted = database, group, trusted
        self.added_mass, self.damping = added_mass, damping
        square = np.ix_(range(len(database.omega)), group, group)
        a, b = added_mass[square], damping[square]
        self.scale = np.sqrt(np.maximum(b.max(axis=0).diagonal(), 1e-300))
        product = np.outer(self.scale, self.scale)
        inner = None if known is None else known[np.ix_(group, group)] / product
        self.data = GroupData(
            omega=database.omega,
            added_mass=a / product,
            damping=b / product,
            trusted=trusted,
            added_mass_infinite=inner,
        )
        size = np.ptp(a, axis=0) * float(np.mean(database.omega)) + np.abs(b).max(axis=0)
        diagonal = np.sqrt(size.diagonal())
        relative = size / np.maximum(np.outer(diagonal, diagonal), 1e-300)
        self.pairs = [(group.index(j), group.index(k)) for j, k in pairs]
        self.weak = {(j, k) for j, k in self.pairs if relative[j, k] < WEAK_PAIR}

    def lowest_order(self, r2: float) -> tuple[MemoryBlock, FloatArray, list[FitRow]]:
        """Block, infinite-frequency added mass (m, m) and rows of the lowest order that reaches ``r2``."""
        best: tuple[float, Oscillators, list[FitRow]] | None = None
        model: Oscillators | None = None
        idle = 0
        for _ in range(MOST_MASSES + 1):
            model = fit_oscillators(self.data, model)
            rows = self._rows(model, r2)
            worst = min(self._worst(row) for row in rows)
            idle = 0 if best is None or worst > best[0] + GAIN else idle + 1
            if best is None or worst > best[0]:
                best = (worst, model, rows)
            if all(row.accepted for row in rows):
                best = (worst, model, rows)
                break
            if idle == PATIENCE:
                break
        assert best is not None
        product = np.outer(self.scale, self.scale)
        return self._block(best[1]), self._infinite(best[1]) * product, best[2]

    def _worst(self, row: FitRow) -> float:
        """The smaller R2 of a pair; weak pairs do not count."""
        pair = (self.group.index(row.output), self.group.index(row.input))
        return 1.0 if pair in self.weak else min(row.r2_added_mass, row.r2_damping)

    def _infinite(self, model: Oscillators) -> FloatArray:
        """Infinite-frequency added mass (m, m) on the group's scale: known, or the weighted best."""
        if self.data.added_mass_infinite is not None:
            return self.data.added_mass_infinite
        omega = self.data.omega
        rest = self.data.added_mass - model.transfer(omega).imag / omega[:, None, None]
        return np.asarray(rest[self.trusted].mean(axis=0))

    def _rows(self, model: Oscillators, r2: float) -> list[FitRow]:
        omega, inside = self.data.omega, self.trusted
        kernel = model.transfer(omega)
        added_mass = self._infinite(model) + kernel.imag / omega[:, None, None]
        poles = np.linalg.eigvals(model.state_space()[0])
        rows = []
        for j, k in self.pairs:
            a = (self.data.added_mass[:, j, k], added_mass[:, j, k])
            b = (self.data.damping[:, j, k], kernel.real[:, j, k])
            in_band = (r_squared(a[0][inside], a[1][inside]), r_squared(b[0][inside], b[1][inside]))
            good = min(in_band) >= r2
            if (j, k) in self.weak and not good:
                good = self._motion_change(j, k, a[1], b[1]) <= WEAK_PAIR_MOTION
            rows.append(
                FitRow(
                    cause=RADIATION,
                    output=self.group[j],
                    input=self.group[k],
                    order=model.states,
                    r2_added_mass=in_band[0],
                    r2_damping=in_band[1],
                    r2_added_mass_all=r_squared(*a),
                    r2_damping_all=r_squared(*b),
                    slowest_decay=float(-poles.real.max()),
                    fastest_pole=float(np.abs(poles).max()),
                    accepted=good,
                )
            )
        return rows

    def _motion_change(self, j: int, k: int, added_mass: FloatArray, damping: FloatArray) -> float:
        """Largest change of any motion, by its largest, with one pair's data replaced by its fit."""
        a, b = self.added_mass.copy(), self.damping.copy()
        for part in self.database.additional:
            a += part.added_mass - part.restoring / self.database.omega[:, None, None] ** 2
            b += part.damping
        before = motion_response(self.database, added_mass=a, damping=b)
        factor = self.scale[j] * self.scale[k]
        for row, column in {(j, k), (k, j)}:
            at = (slice(None), self.group[row], self.group[column])
            a[at] += factor * (added_mass - self.data.added_mass[:, j, k])
            b[at] += factor * (damping - self.data.damping[:, j, k])
        after = motion_response(self.database, added_mass=a, damping=b)
        return float(motion_errors(self.database, after, before, inside=self.trusted).max())

    def _block(self, model: Oscillators) -> MemoryBlock:
        """Block in SI units; its states carry the root of an energy, ``|x|^2 / 2`` in joule."""
        a, b, c = model.state_space()
        b, c = b * self.scale, c * self.scale[:, None]
        return MemoryBlock(
            cause=RADIATION,
            outputs=np.array(self.group),
            inputs=np.array(self.group),
            A=a,
            B=b,
            C=c,
            D=np.zeros((len(self.group), len(self.group))),
            state_scale=largest_states(a, b * TYPICAL_VELOCITY[self.group]),
        )
