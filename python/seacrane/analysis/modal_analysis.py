"""Natural periods, damping ratios and mode shapes about rest; frequencies over which a response is summed."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from seacrane import _core
from seacrane.analysis.linear_system import LinearModel, linear_model
from seacrane.analysis.stability import grows, growth_in_words, label_of
from seacrane.arrays import Array, Complex
from seacrane.description.description import Description
from seacrane.inputs.brief import brief
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.frames import MOTIONS
from seacrane.inputs.keywords import named
from seacrane.one_thread import one_thread
from seacrane.plotting.table import Table, table_of
from seacrane.sea.spreading import Spreading
from seacrane.warnings import UndampedModeWarning

if TYPE_CHECKING:
    from seacrane.hydro import HydroDatabase

MOST_ITERATIONS = 60
SETTLED = 1e-10  # relative change of a frequency between iterations
SAME = 1e-6  # relative distance of eigenvalues below which two iterations found one mode
STARTS = np.geomspace(0.02, 10.0, 10)  # rad/s
HALF = 0.5  # of a neutral direction
LEAST_SHARE = 0.01  # of a mode's energy
REACH = 2.0  # ratio of a mode's frequency to the start
PER_MODE = ("eigenvalues", "shapes", "energy_share", "mechanical_share", "state_vectors")
UNDAMPED = 1e-6  # damping ratio below which the variance of a resonance has no meaning
BROAD = 0.2  # damping ratio above which the even grid resolves a resonance
GRID = 1500  # frequencies over a band
GRID_OF_MODE = 120  # more on either side of each resonance
DIRECTIONS = 48


@dataclass(frozen=True, kw_only=True, eq=False)
class NaturalModes:
    """Free oscillations Re shape exp(eigenvalue t), slowest first.

    Attributes
    ----------
    eigenvalues : ndarray of complex, shape (k,)
        Of the oscillations, positive imaginary part, 1/s.
    shapes : ndarray of complex, shape (k, bodies, 6)
        Translation of each body's state point and rotation vector, inertial axes; the largest entry is 1.
    energy_share : ndarray, shape (k, bodies, 6)
        Of the kinetic energy, by body and motion; sums to 1 for each mode.
    mechanical_share : (k,) Participation of coordinates and speeds; the rest to 1 is that of memory states.
    real_eigenvalues, real_labels : Of what decays or grows without oscillation, 1/s; as `label`.
    neutral, neutral_shapes : Directions in which nothing brings the system back; orthonormal,
        (neutral, bodies, 6).
    vessels : Bodies that float.
    state_vectors : ndarray of complex, shape (k, n)
        Eigenvectors in x of the `LinearModel`, scaled as the shapes.
    """

    eigenvalues: Complex
    shapes: Complex
    energy_share: Array
    mechanical_share: Array
    real_eigenvalues: Array
    neutral: int
    state_vectors: Complex
    bodies: tuple[str, ...]
    real_labels: tuple[str, ...] = ()
    neutral_shapes: Array = field(default_factory=lambda: np.zeros((0, 0, 6)))
    vessels: tuple[str, ...] = ()

    __repr__ = brief

    @property
    def natural_period(self) -> Array:
        """2 pi / |eigenvalue|, s."""
        return np.asarray(2.0 * np.pi / np.abs(self.eigenvalues))

    @property
    def damped_period(self) -> Array:
        """2 pi / imaginary part, s: what a decay shows."""
        return np.asarray(2.0 * np.pi / self.eigenvalues.imag)

    @property
    def damping_ratio(self) -> Array:
        """Fraction of critical; negative for what grows."""
        return np.asarray(-self.eigenvalues.real / np.abs(self.eigenvalues))

    def label(self, mode: int) -> str:
        """Body and motion with most of the kinetic energy, as "vessel roll"."""
        return label_of(self.bodies, self.energy_share[mode])

    def find(self, label: str) -> int:
        """Index of the mode of that label with the largest mechanical share.

        Raises
        ------
        ValueError
            If no mode has the label.
        """
        labels = [self.label(i) for i in range(len(self.eigenvalues))]
        found = [i for i, name in enumerate(labels) if name == label]
        if not found:
            raise ValueError(f"no mode is {label!r}; there are {', '.join(sorted(set(labels)))}")
        return max(found, key=lambda i: float(self.mechanical_share[i]))

    def table(self, *, least_mechanical_share: float = 0.5) -> Table:
        """Rows of label, natural period (s), damping ratio and mechanical share, and of what grows.

        Modes below that share are those of the fluid memory, which no motion shows by itself. The six motions
        of each vessel are always there: by their own mode, whatever its share, or else with the reason.
        """
        labels = [self.label(i) for i in range(len(self.eigenvalues))]
        shown = {i for i, share in enumerate(self.mechanical_share) if share >= least_mechanical_share}
        motions = [f"{body} {motion}" for body in self.vessels for motion in MOTIONS]
        absent = {name: self._absent(name) for name in motions if not any(labels[i] == name for i in shown)}
        shown |= {self.find(name) for name, why in absent.items() if not why}
        rows: list[tuple[Any, ...]] = [self._row(labels[i], i) for i in sorted(shown)]
        rows += [(name, None, None, None, why) for name, why in absent.items() if why]
        rows += [
            (self.real_labels[i], None, None, None, growth_in_words(complex(self.real_eigenvalues[i])))
            for i in np.flatnonzero(grows(self.real_eigenvalues))
        ]
        return table_of(("mode", "period [s]", "damping [%]", "mechanical", ""), rows, form=".3f")

    def _row(self, label: str, mode: int) -> tuple[Any, ...]:
        numbers = (self.natural_period, 100.0 * self.damping_ratio, self.mechanical_share)
        words = growth_in_words(complex(self.eigenvalues[mode].real)) if grows(self.eigenvalues)[mode] else ""
        return (label, *(float(one[mode]) for one in numbers), words)

    def _absent(self, motion: str) -> str:
        """Why a vessel's motion has no mode of its own; empty if it has one."""
        body, way = motion.rsplit(" ", 1)
        at = self.bodies.index(body), MOTIONS.index(way)
        if len(self.neutral_shapes) and np.linalg.norm(self.neutral_shapes[:, at[0], at[1]]) > HALF:
            return "nothing brings it back"
        if any(self.label(i) == motion for i in range(len(self.eigenvalues))):
            return ""
        share = self.energy_share[:, at[0], at[1]]
        if not len(share) or share.max() < LEAST_SHARE:
            return "does not oscillate"
        mode = int(share.argmax())
        period = self.natural_period[mode]
        return f"in {self.label(mode)!r} of {period:.3f} s, {share[mode]:.0%} of its energy"


@named
@one_thread
def natural_modes(
    scene: Description | LinearModel,
    *,
    state: _core.State | None = None,
    memory: str = "scene",
    database: HydroDatabase | None = None,
) -> NaturalModes:
    """Natural modes of a scene with its references held, fluid memory included.

    Parameters
    ----------
    scene : Scene or LinearModel
    state : State, optional
        At rest; default ``equilibrium(scene)``. Not with a LinearModel.
    memory, database
        As `linear_model`; not with a LinearModel. With the memory of a database or of a convolution, each
        mode takes the matrices of its own damped frequency, those of the lowest one below the table.

    Raises
    ------
    SceneError
        As `linear_model`.
    """
    linear = scene
    if not isinstance(linear, LinearModel):
        linear = linear_model(linear, state=state, memory=memory, database=database)
    return _modes_by_frequency(linear) if linear.memories else _modes(linear)


def _modes_by_frequency(linear: LinearModel) -> NaturalModes:
    """Each mode with the matrices at its own frequency: iterations start at several, each with the modes near
    it, as matrices of one may overdamp the mode of another; those that arrive at the same count once."""
    found: list[tuple[NaturalModes, int]] = []
    slow = _modes(linear.at_frequency(float(STARTS[0])))
    for frequency in STARTS:
        modes = _modes(linear.at_frequency(frequency))
        for mode, value in enumerate(modes.eigenvalues):
            if not 1.0 / REACH < value.imag / frequency < REACH:
                continue
            settled, at = _settled(linear, modes, mode)
            value = settled.eigenvalues[at]
            if all(abs(value - other.eigenvalues[i]) > SAME * abs(value) for other, i in found):
                found.append((settled, at))
    found.sort(key=lambda each: abs(each[0].eigenvalues[each[1]]))
    kept: dict[str, Any] = {name: np.array([getattr(m, name)[i] for m, i in found]) for name in PER_MODE}
    return replace(slow, **kept) if found else slow


def _settled(linear: LinearModel, modes: NaturalModes, mode: int) -> tuple[NaturalModes, int]:
    """Modes with the matrices at the frequency of one of them, and its index: that of the same shape."""
    for _ in range(MOST_ITERATIONS):
        frequency = float(modes.eigenvalues[mode].imag)
        following = _modes(linear.at_frequency(frequency))
        if not len(following.eigenvalues):
            break
        old = modes.state_vectors[mode] / np.linalg.norm(modes.state_vectors[mode])
        size = np.linalg.norm(following.state_vectors, axis=1)
        mode = int(np.argmax(np.abs(following.state_vectors @ old.conj()) / size))
        modes = following
        if abs(float(modes.eigenvalues[mode].imag) - frequency) <= SETTLED * frequency:
            break
    return modes, mode


def _modes(linear: LinearModel) -> NaturalModes:
    """The modes of the state matrix."""
    dof, size, k = linear.degrees_of_freedom, len(linear.a), linear.neutral.shape[1]
    free = np.zeros((size, size - k))  # x but for the positions that nothing depends on, orthonormal
    free[:dof, : dof - k] = np.linalg.svd(linear.neutral)[0][:, k:] if k else np.eye(dof)
    free[dof:, dof - k :] = np.eye(size - dof)
    values, right = np.linalg.eig(free.T @ linear.a @ free)
    participation = np.abs(right * np.linalg.pinv(right).T)
    share = participation[: 2 * dof - k].sum(axis=0) / participation.sum(axis=0)
    # Rounding splits double real eigenvalues into pairs with tiny imaginary parts.
    least = 1e-7 * np.maximum(np.abs(values), 1.0)
    oscillating, real = np.flatnonzero(values.imag > least), np.flatnonzero(np.abs(values.imag) <= least)
    order = oscillating[np.argsort(np.abs(values[oscillating]))]
    real = real[np.argsort(values.real[real])]
    bodies = len(linear.bodies)
    vectors, motion = _shapes(linear, free, values[order], right[:, order])
    _, real_motion = _shapes(linear, free, values[real], right[:, real])
    energy, real_energy = (np.real(each.conj() * (each @ linear.mass.T)) for each in (motion, real_motion))
    return NaturalModes(
        eigenvalues=np.asarray(values[order], dtype=complex), shapes=motion.reshape(len(order), bodies, 6),
        energy_share=(energy / energy.sum(axis=1, keepdims=True)).reshape(len(order), bodies, 6),
        mechanical_share=share[order], real_eigenvalues=values.real[real],
        neutral=k, state_vectors=vectors, bodies=linear.bodies,
        real_labels=tuple(label_of(linear.bodies, row) for row in real_energy),
        neutral_shapes=(linear.basis @ linear.neutral).T.reshape(-1, bodies, 6),
        vessels=tuple(dict.fromkeys(vessel.body for vessel in linear.scene.vessels.values())),
    )  # fmt: skip


def _shapes(linear: LinearModel, free: Array, values: Complex, right: Complex) -> tuple[Complex, Complex]:
    """Eigenvectors in x and motions of the bodies, a row each, the largest entry of a motion being 1."""
    vectors: Complex = (free @ right).T.astype(np.complex128)
    dof = linear.degrees_of_freedom
    along = linear.neutral @ linear.neutral.T
    rate = np.where(values == 0.0, 1.0, values)
    vectors[:, :dof] += vectors[:, dof : 2 * dof] @ along / rate[:, None]
    motion: Complex = vectors[:, :dof] @ linear.basis.T
    largest = motion[np.arange(len(motion)), np.argmax(np.abs(motion), axis=1)]
    largest = np.where(largest == 0.0, 1.0, largest)
    return np.asarray(vectors / largest[:, None]), np.asarray(motion / largest[:, None])


def quadrature_frequencies(linear: LinearModel, low: float, high: float) -> Array:
    """Even over a band, rad/s, and about each resonance."""
    omega = np.unique(np.concatenate([np.linspace(low, high, GRID), about_resonances(linear, low, high)]))
    return omega[(omega >= low) & (omega <= high)]


def directions_of(spreading: Spreading | None, main: float) -> tuple[Array, Array]:
    """Directions (q,), rad, and their shares of the energy."""
    if spreading is None:
        return np.array([main]), np.ones(1)
    angles, shares = spreading.quadrature(DIRECTIONS)
    return np.asarray(main + angles), np.asarray(shares)


def weights_of(omega: Array) -> Array:
    """Weights of the trapezoidal rule."""
    steps = np.diff(omega)
    return np.asarray(0.5 * (np.append(steps, 0.0) + np.append(0.0, steps)))


def about_resonances(linear: LinearModel, low: float, high: float) -> Array:
    """Frequencies about each resonance, geometrically away from a tenth of its half width."""
    modes = natural_modes(linear)
    parts = [np.zeros(0)]
    for i, value in enumerate(modes.eigenvalues):
        if not low < value.imag < high or modes.damping_ratio[i] > BROAD:
            continue
        if modes.damping_ratio[i] < UNDAMPED:
            warn_caller(
                f"scene {linear.scene.name!r}: mode {modes.label(i)!r} at {value.imag:.4g} rad/s has a "
                f"damping ratio of {modes.damping_ratio[i]:.2g}: the variance of its resonance has no "
                "finite value; add damping",
                UndampedModeWarning,
            )
            continue
        width = abs(value.real)
        away = np.geomspace(0.1 * width, max(0.5 * value.imag, width), GRID_OF_MODE)
        parts.append(np.concatenate([value.imag - away, [value.imag], value.imag + away]))
    return np.concatenate(parts)
