"""`MemoryModel`: linear state-space models of the fluid's memory, as blocks from velocities to loads."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seacrane.arrays import Array, Complex
from seacrane.hydro.data.frozen import freeze
from seacrane.inputs.brief import brief
from seacrane.one_thread import one_thread

RADIATION = "radiation"
MODEL_MATRICES = ("added_mass", "additional_added_mass", "additional_stiffness")
AT_ONCE = 64  # frequencies
PEAK_ALLOWANCE = 5.0  # a resonant peak may be off by this many times what a sea may


@dataclass(frozen=True, kw_only=True, eq=False)
class MemoryBlock:
    """One model ``x' = A x + B v``, ``mu = C x + D v``; the load on the vessel is ``-mu``.

    ``v`` holds the velocities (m/s, rad/s) of the motions ``inputs``, ``mu`` the loads (N, N m) along the
    motions ``outputs``, both counted from 0 (surge) to 5 (yaw), and on over the hulls of a group. States are
    scaled to the size of the output; ``state_scale`` (k,) is the largest amplitude each state takes when the
    inputs oscillate with 0.1 m/s (translations) or 0.01 rad/s (rotations) at any one frequency: a basis for
    absolute tolerances.
    """

    cause: str
    outputs: NDArray[np.int64]
    inputs: NDArray[np.int64]
    A: Array
    B: Array
    C: Array
    D: Array
    state_scale: Array

    __repr__ = brief

    def __post_init__(self) -> None:
        k, p, m = len(self.A), len(self.outputs), len(self.inputs)
        matrices = {"A": (k, k), "B": (k, m), "C": (p, k), "D": (p, m), "state_scale": (k,)}
        freeze(self, f"memory block {self.cause!r}", {"outputs": (p,), "inputs": (m,), **matrices})
        if np.any(np.concatenate([self.outputs, self.inputs]) < 0):
            raise ValueError(f"memory block {self.cause!r}: outputs and inputs count motions from 0")

    @property
    @one_thread
    def poles(self) -> Complex:
        """Eigenvalues of A, rad/s."""
        return np.asarray(np.linalg.eigvals(self.A), dtype=complex)

    @one_thread
    def transfer(self, omega: Array) -> Complex:
        """``C (i omega - A)^-1 B + D`` at ``omega`` (n,), as (n, outputs, inputs)."""
        return transfer(self.A, self.B, self.C, self.D, omega)


def states_at(a: Array, b: Array, omega: Array) -> Complex:
    """``(i omega - A)^-1 B`` (n, states, inputs) at ``omega`` (n,)."""
    inputs = np.broadcast_to(b.astype(complex), (len(omega), *b.shape))
    return np.asarray(np.linalg.solve(1j * omega[:, None, None] * np.eye(len(a)) - a, inputs))


def transfer(a: Array, b: Array, c: Array, d: Array, omega: Array) -> Complex:
    """``C (i omega - A)^-1 B + D``, a few frequencies at a time: many states take gigabytes for all."""
    pieces = np.array_split(omega, max(1, len(omega) // AT_ONCE))
    return np.concatenate([c @ states_at(a, b, piece) + d for piece in pieces])


@dataclass(frozen=True, kw_only=True)
class FitRow:
    """How well one entry's model follows the data: R2 over the trusted band, and over all frequencies."""

    cause: str
    output: int
    input: int
    order: int
    r2_added_mass: float
    r2_damping: float
    r2_added_mass_all: float
    r2_damping_all: float
    slowest_decay: float
    fastest_pole: float
    accepted: bool


@dataclass(frozen=True, kw_only=True)
class Passivity:
    """Smallest eigenvalue of the fitted damping matrix, scaled by the square roots of the largest diagonals.

    Negative values mean that the joint model can feed energy into some motion at ``omega`` (rad/s).
    ``in_band`` is the same over the trusted band alone.
    """

    minimum: float
    omega: float
    in_band: float
    in_band_omega: float


@dataclass(frozen=True, kw_only=True, eq=False)
class MotionError:
    """What a memory changes of a vessel's motions, against the data's own added mass and damping.

    Attributes
    ----------
    seas : (6,), or (6 k,) of a group of k hulls: standard deviation of the difference of each motion over
        that of the motion, in the worst heading and the worst sea of Tp 5 to 18 s (`peak_periods` of hulls
        below 60 m).
    peaks : of the same shape: complex difference of heave, roll and pitch over their value, at the largest of
        the band; zero for the others.
    """

    seas: Array
    peaks: Array

    def __post_init__(self) -> None:
        for name in ("seas", "peaks"):
            array = np.array(getattr(self, name), dtype=float)
            if not array.size or array.shape != (6 * (array.size // 6),) or not np.all(array >= 0.0):
                raise ValueError(f"motion error: {name} must be six numbers of zero or more for each hull")
            array.setflags(write=False)
            object.__setattr__(self, name, array)

    @property
    def worst(self) -> float:
        """What a limit is compared with: the largest of `seas` and of a fifth of `peaks`."""
        return self.of(range(len(self.seas)))

    def of(self, motions: Iterable[int]) -> float:
        """The memory model of some motions."""
        chosen = list(motions)
        return float(max(self.seas[chosen].max(), self.peaks[chosen].max() / PEAK_ALLOWANCE))


@dataclass(frozen=True, kw_only=True, eq=False)
class MotionFit:
    """How a model fitted by motion meets its limit.

    Attributes
    ----------
    limit : asked of `MotionError.worst`.
    error : reached.
    floor : `MotionError.worst` of the database's own convolution, into which nothing is fitted.
    left_out : pairs (j, k), counted from 0, whose memory no motion feels, symmetry forbids, or of a motion
        without damping.
    """

    limit: float
    error: MotionError
    floor: float
    left_out: tuple[tuple[int, int], ...]

    @property
    def reached(self) -> bool:
        """Whether the limit is kept."""
        return self.error.worst <= self.limit

    @property
    def obstacle(self) -> str:
        """What keeps a better fit away."""
        if self.floor > 0.5 * self.limit:
            return (
                "its data break the Kramers-Kronig relation, so that even their convolution is "
                f"{self.floor:.2g} off"
            )
        return "more states gain nothing"


@dataclass(frozen=True, kw_only=True, eq=False)
class MemoryModel:
    """Radiation memory (and that of additional causes) as state-space blocks.

    Matrices are (6, 6), or (6 k, 6 k) of a group of k hulls.

    Attributes
    ----------
    blocks : the models; their loads add up.
    added_mass : infinite-frequency added mass that belongs to the radiation blocks.
    additional_added_mass, additional_stiffness : instantaneous parts of the additional causes.
    band : (low, high) rad/s over which the fits were judged.
    r2 : the R2 asked for.
    rows : quality of each fit.
    passivity : of the radiation blocks together.
    motion : of a model fitted by motion, how near the motions are; None for others.
    """

    blocks: tuple[MemoryBlock, ...]
    added_mass: Array
    additional_added_mass: Array
    additional_stiffness: Array
    band: tuple[float, float]
    r2: float
    rows: tuple[FitRow, ...]
    passivity: Passivity
    motion: MotionFit | None = None

    __repr__ = brief

    def __post_init__(self) -> None:
        size = 6 * max(1, len(self.added_mass) // 6)
        freeze(self, "memory model", dict.fromkeys(MODEL_MATRICES, (size, size)))
        for block in self.blocks:
            if max(block.outputs.max(initial=0), block.inputs.max(initial=0)) >= size:
                raise ValueError(
                    f"memory block {block.cause!r}: outputs and inputs count motions from 0 to {size - 1}"
                )

    @property
    def motions(self) -> int:
        """Six, or six for each hull of a group."""
        return len(self.added_mass)

    @property
    def states(self) -> int:
        """Number of states of all blocks."""
        return sum(len(block.A) for block in self.blocks)

    @one_thread
    def transfer(self, omega: ArrayLike, *, cause: str = RADIATION) -> Complex:
        """Retardation function ``K(i omega)`` of one cause at ``omega`` (n,), as (n, m, m) complex, of
        m motions."""
        w = np.atleast_1d(np.asarray(omega, dtype=float))
        total = np.zeros((len(w), self.motions, self.motions), dtype=complex)
        for block in self.blocks:
            if block.cause == cause:
                total[:, block.outputs[:, None], block.inputs] += block.transfer(w)
        return total

    def impulse_response(self, time: ArrayLike, *, cause: str = RADIATION) -> Array:
        """Retardation function ``K(t) = C exp(A t) B`` of one cause at ``time`` (n,) in s, as (n, m, m).

        What passes through D without delay is left out: it is an impulse at zero.
        """
        from scipy.linalg import expm

        t = np.atleast_1d(np.asarray(time, dtype=float))
        total = np.zeros((len(t), self.motions, self.motions))
        for block in self.blocks:
            if block.cause == cause and len(block.A):
                with one_thread:
                    states = expm(block.A * t[:, None, None]) @ block.B
                total[:, block.outputs[:, None], block.inputs] += block.C @ states
        return total

    def frequency_response(self, omega: ArrayLike) -> tuple[Array, Array]:
        """Fitted radiation added mass and damping, each (n, m, m), at positive ``omega`` (n,)."""
        w = np.atleast_1d(np.asarray(omega, dtype=float))
        kernel = self.transfer(w)
        return self.added_mass + kernel.imag / w[:, None, None], kernel.real

    def additional_response(self, omega: ArrayLike) -> tuple[Array, Array]:
        """Fitted added mass and damping (n, m, m) of all other causes, stiffness counted as added mass."""
        w = np.atleast_1d(np.asarray(omega, dtype=float))[:, None, None]
        kernel = np.zeros((len(w), self.motions, self.motions), dtype=complex)
        for cause in {block.cause for block in self.blocks} - {RADIATION}:
            kernel += self.transfer(w[:, 0, 0], cause=cause)
        added_mass = self.additional_added_mass + kernel.imag / w - self.additional_stiffness / w**2
        return added_mass, kernel.real
