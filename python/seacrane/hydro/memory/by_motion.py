"""`fit_by_motion`: the smallest passive memory that leaves the vessel's motions within a limit."""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING

import numpy as np

from seacrane.arrays import Array, Complex
from seacrane.hydro.data.hydro_data import AdditionalMatrices
from seacrane.hydro.data.hydro_group_data import Hydrodynamics, mass_of
from seacrane.hydro.data.memory_model import (
    PEAK_ALLOWANCE,
    RADIATION,
    FitRow,
    MemoryBlock,
    MemoryModel,
    MotionError,
    MotionFit,
)
from seacrane.hydro.memory.certificate import TYPICAL_VELOCITY, joint_passivity, largest_states, realise_pair
from seacrane.hydro.memory.coupled import CoupledData, CoupledProblem, Felt, first_guess
from seacrane.hydro.memory.identification import (
    IdentificationData,
    RationalFit,
    dissipation_limit,
    fit_lowest_order,
    judged_rows,
    memory_entries,
    motion_groups,
    symmetric,
    within,
)
from seacrane.hydro.memory.motion_judge import MotionJudge, motion_judge
from seacrane.hydro.memory.oscillators import (
    MotionData,
    MotionProblem,
    Oscillators,
    fit_to_motions,
)
from seacrane.hydro.memory.retardation import retardation_functions

if TYPE_CHECKING:
    from tqdm import tqdm

Pairs = list[tuple[int, int]]
Found = tuple[float, Oscillators, Array]  # error, model, emphasis of the motions

SHARE = 0.8  # of the limit that the radiation of one group may take
NEARLY = 0.95  # the same, of several hulls that have no other memory
UNFELT = 0.1  # of the limit: pairs that together change no motion by more are left out
MOST_MASSES = 6  # beyond one per motion; a group of many motions may have two for each
PATIENCE = 3  # orders in a row without gain, after which more masses are not tried
GAIN = 0.05  # of the error
SOME = 64  # pairs, of which one at a time is kept after all; of more, a share
EVEN = 64  # frequencies over the band, of several hulls
TRIED = (1.0, 1.15, 1.3, 1.5, 1.75, 2.0)  # numbers of masses of several hulls, over the least one
MOST_STEPS, IDLE, SMALL_GAIN = 40, 8, 0.02  # of a search: steps, those in a row that gain less of the error
NEAR = 4.0  # times the limit: errors from which on motions are emphasised by theirs
BEYOND_BAND = 1.3  # times its upper end: data further up are not looked at
MOST_INERTIA = 0.1  # of the vessel's, that an additional cause may add or take at once
ADDITIONAL_ORDERS = range(2, 11)


def fit_by_motion(
    *, database: Hydrodynamics, band: tuple[float, float], known: Array | None, limit: float,
    progress: bool = False,
) -> MemoryModel:  # fmt: skip
    """Radiation as damped oscillators per group of motions, other causes per pair; orders as `limit` allows.

    It is one of `MotionError.worst` over ``band`` (rad/s). ``known``: infinite-frequency added mass (6, 6),
    None: estimated. ``progress``: show a bar over the models of each group of motions.
    """
    from tqdm import tqdm

    judge = motion_judge(database, band)
    below = database.omega[database.omega < BEYOND_BAND * band[1]]
    about = judge.about_peaks[(judge.about_peaks > band[0]) & (judge.about_peaks < band[1])]
    grid = np.unique(np.concatenate([below, about]))
    kept, left_out = felt_pairs(database, judge, limit)
    blocks: list[MemoryBlock] = []
    infinite = judge.added_mass.mean(axis=0)  # of entries without memory
    if database.port_starboard_symmetric:
        places = np.arange(len(infinite))
        infinite = np.where(np.add.outer(places, places) % 2, 0.0, infinite)
    groups = motion_groups(kept)
    with tqdm(total=len(groups), desc="fluid memory", unit="group", disable=not progress) as bar:
        for group in groups:
            several = len({motion // 6 for motion in group}) > 1
            fit = (_Coupled if several else _Group)(judge, grid, band, known, group)
            whole = several and not database.additional
            masses = fit.lowest_order((NEARLY if whole else SHARE) * limit, bar)
            blocks.append(fit.block(masses))
            infinite[np.ix_(group, group)] = fit.infinite(masses)
            bar.update()
    if known is not None:
        infinite = known
    mass, stiffness = np.zeros_like(infinite), np.zeros_like(infinite)
    for part in database.additional:
        more, inertia, spring = _additional(database, part, judge, grid, band, 0.5 * limit)
        blocks += more
        mass, stiffness = mass + inertia, stiffness + spring
    memory = MemoryModel(
        blocks=tuple(blocks), added_mass=infinite, additional_added_mass=mass,
        additional_stiffness=stiffness, band=band, r2=0.0, rows=(),
        passivity=joint_passivity(blocks, database.damping, band),
    )  # fmt: skip
    floor = judge.error_of(retardation_functions(database=database)).worst
    motion = MotionFit(limit=limit, error=judge.error_of(memory), floor=floor, left_out=left_out)
    rows: list[FitRow] = []
    for cause in dict.fromkeys(block.cause for block in blocks):
        of = [block for block in blocks if block.cause == cause]
        pairs = [(int(j), int(k)) for block in of for j in block.outputs for k in block.inputs if j <= k]
        felt = [pair for pair in pairs if cause != RADIATION or pair in kept]
        rows += judged_rows(memory, database, cause, felt, -np.inf if motion.reached else np.inf)
    worst = min((min(row.r2_added_mass, row.r2_damping) for row in rows), default=1.0)
    return dataclasses.replace(memory, rows=tuple(rows), r2=max(worst, 0.0), motion=motion)


def felt_pairs(
    database: Hydrodynamics, judge: MotionJudge, limit: float
) -> tuple[Pairs, tuple[tuple[int, int], ...]]:
    """Pairs (j <= k) to fit, and those left out: forbidden by symmetry, undamped, or felt by no motion.

    A panel code's noise in a pair that the hull's shape makes zero is such a pair. A motion that radiates
    nothing has no memory.
    """
    added_mass, damping = symmetric(database.added_mass), symmetric(database.damping)
    pairs = [(min(pair), max(pair)) for pair in memory_entries(added_mass, damping, database.omega)]
    radiates = np.diagonal(damping, axis1=1, axis2=2).max(axis=0) > 0.0
    forbidden = [
        (j, k)
        for j, k in pairs
        if (database.port_starboard_symmetric and (j + k) % 2) or not (radiates[j] and radiates[k])
    ]
    others = [pair for pair in pairs if pair not in forbidden and pair[0] != pair[1]]
    felt = {pair: _felt(judge, pair) for pair in others}
    faint = sorted((pair for pair in others if felt[pair] < UNFELT * limit), key=lambda pair: felt[pair])
    while faint and judge.error(_without(judge, faint)).worst > UNFELT * limit:
        del faint[-max(1, len(faint) // SOME) :]
    left_out = sorted([*forbidden, *faint])
    return [pair for pair in pairs if pair not in left_out], tuple(left_out)


def _felt(judge: MotionJudge, pair: tuple[int, int]) -> float:
    """The error of leaving out the memory of a pair; of several hulls, with many pairs, the quick way."""
    if len(judge.moves) == 6:
        return judge.error(_without(judge, [pair])).worst
    return judge.error_of_pair(*pair, _lost(judge, pair)).worst


def _without(judge: MotionJudge, pairs: Pairs) -> Complex:
    """Change of impedance (n, 6, 6) if pairs had no damping and a constant added mass."""
    out = np.zeros(judge.damping.shape, dtype=complex)
    for j, k in pairs:
        out[:, j, k] = out[:, k, j] = _lost(judge, (j, k))
    return out


def _lost(judge: MotionJudge, pair: tuple[int, int]) -> Complex:
    """The same (n,) of one pair."""
    w, (j, k) = judge.omega, pair
    variation = judge.added_mass[:, j, k] - judge.added_mass[:, j, k].mean()
    return np.asarray(w**2 * variation - 1j * w * judge.damping[:, j, k])


class _Group:
    """One group of coupled motions: its data, and what a model of it does to its motions."""

    def __init__(
        self, judge: MotionJudge, omega: Array, band: tuple[float, float], known: Array | None,
        group: list[int],
    ) -> None:  # fmt: skip
        self.judge, self.group = judge, group
        a, b = (
            table(omega)[:, group][:, :, group] for table in (judge.table.added_mass, judge.table.damping)
        )
        self.scale = np.sqrt(np.maximum(b.max(axis=0).diagonal(), 1e-300))
        self.product = np.outer(self.scale, self.scale)
        self.omega, self.trusted = omega, within(omega, band)
        inner = None if known is None else known[np.ix_(group, group)] / self.product
        self.take(a / self.product, b / self.product, inner)

    def take(self, added_mass: Array, damping: Array, known: Array | None) -> None:
        """The data of the fit."""
        lever = self.judge.lever(self.omega, self.group) * self.product[np.triu_indices(len(self.group))]
        self.data = MotionData(
            omega=self.omega, added_mass=added_mass, damping=damping, trusted=self.trusted,
            added_mass_infinite=known, lever=lever,
        )  # fmt: skip

    def lowest_order(self, limit: float, bar: tqdm) -> Oscillators:
        """Model of the fewest masses that keeps the limit."""
        best: tuple[float, Oscillators] | None = None
        model: Oscillators | None = None
        idle = 0
        for _ in range(max(MOST_MASSES, 2 * len(self.group)) + 1):
            model = fit_to_motions(self.data, model)
            error = self.told(model, limit, bar).of(self.group)
            idle = 0 if best is None or error < (1.0 - GAIN) * best[0] else idle + 1
            if best is None or error < best[0]:
                best = (error, model)
            if error <= limit or idle == PATIENCE:
                break
        assert best is not None
        return best[1]

    def told(self, model: Oscillators, limit: float, bar: tqdm) -> MotionError:
        """The error of a model, shown in the bar."""
        errors = self._error(model)
        worst = 100.0 * errors.of(self.group)
        bar.set_postfix_str(f"{len(model.w)} masses, {worst:.2g} of {100.0 * limit:.2g} %")
        return errors

    def infinite(self, model: Oscillators) -> Array:
        """Infinite-frequency added mass (m, m) in SI units."""
        inner = MotionProblem(self.data, len(model.w)).infinite(model)
        return np.asarray(inner * self.product)

    def _error(self, model: Oscillators) -> MotionError:
        judge, w = self.judge, self.judge.omega[:, None, None]
        square = np.ix_(range(len(judge.omega)), self.group, self.group)
        misfit = model.transfer(judge.omega) * self.product - judge.damping[square]
        inertia = self.infinite(model) - judge.added_mass[square]
        out = np.zeros(judge.damping.shape, dtype=complex)
        out[square] = 1j * w * misfit - w**2 * inertia
        return judge.error(out)

    def block(self, model: Oscillators) -> MemoryBlock:
        """Block in SI units; its states carry the root of an energy, ``|x|^2 / 2`` in joule."""
        a, b = model.state_space()
        b = b * self.scale
        motions = np.array(self.group)
        return MemoryBlock(
            cause=RADIATION, outputs=motions, inputs=motions, A=a, B=b, C=b.T.copy(),
            D=np.zeros((len(motions), len(motions))),
            state_scale=largest_states(a, b * TYPICAL_VELOCITY[motions % 6]),
        )  # fmt: skip


class _Coupled(_Group):
    """One group of motions of several hulls."""

    def __init__(
        self, judge: MotionJudge, omega: Array, band: tuple[float, float], known: Array | None,
        group: list[int],
    ) -> None:  # fmt: skip
        even = np.linspace(*band, EVEN)
        spread = np.sort(np.concatenate([omega[~within(omega, band)], even]))
        super().__init__(judge, spread, band, known, group)

    def take(self, added_mass: Array, damping: Array, known: Array | None) -> None:
        left, right = self.judge.sides(self.omega, self.group)
        kernel = damping + 1j * self.omega[:, None, None] * added_mass
        self.felt = Felt(
            CoupledData(
                omega=self.omega, kernel=kernel, trusted=self.trusted, added_mass_infinite=known,
                left=left * self.scale, right=self.scale[:, None] * right,
            )
        )  # fmt: skip

    def lowest_order(self, limit: float, bar: tqdm) -> Oscillators:
        """Of some numbers of masses, each searched from its own guess, the first that keeps the limit.

        Of more than two hulls, a number that gains nothing over the one before is the last.
        """
        hulls = len({motion // 6 for motion in self.group})
        least = len(self.group) * (1.2 + 0.12 * hulls)
        best: Found | None = None
        for times in TRIED:
            found = self._searched(round(times * least), limit, bar)
            idle = hulls > 2 and best is not None and found[0] > (1.0 - GAIN) * best[0]
            if best is None or found[0] < best[0]:
                best = found
            if found[0] <= limit or idle:
                break
        assert best is not None
        self.felt.emphasise(best[2])
        return best[1]

    def _searched(self, masses: int, limit: float, bar: tqdm) -> Found:
        """A model that keeps the limit, or the best one of a search.

        Least squares make the mean error small. What counts is the largest: once that is near the limit,
        motions that err by more than others are emphasised.
        """
        emphasis = np.ones(len(self.group))
        self.felt.emphasise(emphasis)
        best: Found | None = None
        idle = 0
        problem = CoupledProblem(self.felt, masses)
        for count, model in enumerate(problem.steps(first_guess(self.felt.data, masses))):
            errors = self.told(model, limit, bar)
            error = errors.of(self.group)
            idle = 0 if best is None or error < (1.0 - SMALL_GAIN) * best[0] else idle + 1
            if best is None or error < best[0]:
                best = (error, model, emphasis)
            if error <= limit or idle == IDLE or count == MOST_STEPS:
                break
            if error < NEAR * limit and count % 3 == 0:
                share = np.maximum(errors.seas, errors.peaks / PEAK_ALLOWANCE)[self.group]
                emphasis = emphasis * np.maximum(share / np.sqrt(np.mean(share**2)), 0.3)
                emphasis /= emphasis.mean()
                self.felt.emphasise(emphasis)
        assert best is not None
        return best

    def infinite(self, model: Oscillators) -> Array:
        return np.asarray(self.felt.infinite_of(model) * self.product)


def _additional(
    database: Hydrodynamics, part: AdditionalMatrices, judge: MotionJudge, omega: Array,
    band: tuple[float, float], limit: float,
) -> tuple[list[MemoryBlock], Array, Array]:  # fmt: skip
    """Blocks, instantaneous added mass and static stiffness (6, 6) of one additional cause."""
    from scipy.interpolate import CubicSpline

    a, b = symmetric(part.added_mass), symmetric(part.damping)
    w = judge.omega
    inside = within(omega, band)
    at_grid, at_judge = ([CubicSpline(database.omega, table)(at) for table in (a, b)] for at in (omega, w))
    blocks: list[MemoryBlock] = []
    fits: dict[tuple[int, int], RationalFit] = {}
    mass, stiffness = np.zeros_like(a[0]), np.zeros_like(a[0])
    for j, k in memory_entries(a, b, database.omega):
        lever = judge.lever(omega, [j]) if j == k else judge.lever(omega, [j, k])[:, :, 1:2]
        data = IdentificationData(
            omega=omega[inside], added_mass=at_grid[0][inside, j, k], damping=at_grid[1][inside, j, k],
            trusted=np.ones(np.count_nonzero(inside), dtype=bool), added_mass_infinite=None,
            zero_at_origin=False, static_stiffness=True, dissipation_limit=dissipation_limit(fits, j, k),
            weight=np.linalg.norm(lever[inside], axis=(1, 2)),
        )  # fmt: skip
        most = MOST_INERTIA * float(np.sqrt(np.prod(np.diag(mass_of(database))[[j, k]])))

        def error(fit: RationalFit, j: int = j, k: int = k) -> float:
            model = 1j * w * fit.kernel(w) - w**2 * fit.added_mass_infinite + fit.static_stiffness
            given = 1j * w * at_judge[1][:, j, k] - w**2 * at_judge[0][:, j, k]
            out = np.zeros(judge.damping.shape, dtype=complex)
            out[:, j, k] = out[:, k, j] = model - given
            return judge.error(out).worst

        def light(fit: RationalFit, most: float = most) -> bool:
            return abs(fit.added_mass_infinite) <= most

        fit = fits[j, k] = fit_lowest_order(
            data, orders=ADDITIONAL_ORDERS, error=error, limit=limit, gain=GAIN, allowed=light
        )
        mass[j, k] = mass[k, j] = fit.added_mass_infinite
        stiffness[j, k] = stiffness[k, j] = fit.static_stiffness
        blocks += realise_pair(fit, j, k, part.cause)
    return blocks, mass, stiffness
