"""Oscillators behind the motions of several hulls: those of each hull, joined, and more for what is between.

A wave from one hull reaches the other later, so that their coupling takes many masses. A search over all
dampers among them would take long: only those within a hull's own model are searched, and every coupling to
a motion.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from seacrane.hydro.memory.oscillator_motions import MotionData, MotionProblem
from seacrane.hydro.memory.oscillators import FLOOR, LOWEST_FREQUENCY, Oscillators
from seacrane.one_thread import one_thread

FloatArray = NDArray[np.float64]
Parts = list[tuple[list[int], Oscillators]]  # of some of a group's motions, by their place in it

MORE = 6  # masses added at a time
SEARCH = 40  # evaluations for each lot
APART = 1.08  # ratio of the frequencies of masses added together
FAINT = 0.01  # least damping of a new mass, of the group's scale


@one_thread
def joined(data: MotionData, parts: Parts) -> Oscillators:
    """Best fit with the masses of all parts, beginning where no part feels another."""
    masses = sum(len(part.w) for _, part in parts)
    dampers, coupling = np.zeros((masses, masses)), np.zeros((masses, data.group.damping.shape[1]))
    start = 0
    for motions, part in parts:
        own = slice(start, start + len(part.w))
        dampers[own, own], coupling[own, motions] = part.dampers, part.coupling
        start = own.stop
    return _searched(
        data,
        Oscillators(w=np.concatenate([part.w for _, part in parts]), dampers=dampers, coupling=coupling),
    )


@one_thread
def with_more(data: MotionData, lower: Oscillators) -> Oscillators:
    """Best fit with some masses more, coupled to what the damping lacks most at as many frequencies."""
    group = data.group
    missing = group.damping - lower.transfer(group.omega).real
    values, vectors = np.linalg.eigh(missing)
    high = group.omega[group.trusted][-1]
    inside = (group.omega >= LOWEST_FREQUENCY) & (group.omega <= high)
    model = lower
    chosen: list[float] = []
    for i in np.argsort(-np.where(inside, values[:, -1], -np.inf)):
        w = float(group.omega[i])
        if len(chosen) == MORE or not inside[i]:
            break
        if all(max(w / other, other / w) > APART for other in chosen):
            chosen.append(w)
            row = vectors[i, :, -1] * np.sqrt(max(values[i, -1], FAINT) * 0.15 * w)
            model = _with_mass(model, w, 0.15 * w + FLOOR, row)
    return _searched(data, model)


def _with_mass(model: Oscillators, w: float, damper: float, coupling: FloatArray) -> Oscillators:
    n = len(model.w)
    dampers = np.zeros((n + 1, n + 1))
    dampers[:n, :n], dampers[n, n] = model.dampers, damper
    return Oscillators(
        w=np.append(model.w, w), dampers=dampers, coupling=np.vstack([model.coupling, coupling])
    )


def _searched(data: MotionData, guess: Oscillators) -> Oscillators:
    rows, columns = np.nonzero(np.tril(guess.dampers))
    problem = MotionProblem(data, len(guess.w), (rows, columns))
    return problem.oscillators(problem.search(problem.pack(guess), SEARCH)[0])
