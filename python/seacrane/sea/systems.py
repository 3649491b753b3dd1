"""A sea of several wave systems (wind sea, swell, a measured record) and its realisation."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import accumulate
from typing import Any

import numpy as np

from seacrane import _core
from seacrane.arrays import Array
from seacrane.errors import SceneError
from seacrane.inputs.checked import finite_of, number_of, text_of
from seacrane.inputs.keywords import named
from seacrane.inputs.plausible import direction_of
from seacrane.inputs.shown import shown
from seacrane.sea.measured import MeasuredWaves
from seacrane.sea.spectra import warn_if_breaking
from seacrane.sea.spreading import Spreading

GOLDEN = 0.5 * (np.sqrt(5.0) - 1.0)
MOST_COMPONENTS = 1_000_000
DIRECTION_STREAM = 2  # of the three Philox streams of each system


@named
@dataclass(frozen=True, kw_only=True)
class WaveSystem:
    """Waves of one spectrum about one direction.

    Attributes
    ----------
    direction_deg : float
        Mean direction of travel, deg from +x (following sea) towards +y (port).
    spreading : Spreading, optional
        Short-crested waves: `cos_2s` or `cos_n`. Default: long-crested.
    count : int
        Number of components, 1 to 1,000,000.
    minimum_omega, maximum_omega : float, optional
        Range of frequencies, rad/s; default: `Spectrum.default_range`.

    Raises
    ------
    SceneError
        For a value of the wrong type or out of range.

    Warns
    -----
    SteepSeaWarning
        Above the steepness at which real waves break.
    AngleUnitWarning, CompassDirectionWarning
        A direction that looks like radians, or like a compass bearing.
    """

    spectrum: _core.Spectrum
    direction_deg: float
    spreading: Spreading | None = None
    count: int = 200
    minimum_omega: float | None = None
    maximum_omega: float | None = None
    name: str = "waves"

    def __post_init__(self) -> None:
        what = f"wave system {text_of('wave system: name', self.name)!r}"
        whole = type(self.count) is int or isinstance(self.count, np.integer)
        for key, sound, fix in (
            ("spectrum", isinstance(self.spectrum, _core.Spectrum), "give a Spectrum, such as jonswap(...)"),
            ("spreading", isinstance(self.spreading, Spreading | None), "give cos_2s(...) or cos_n(...)"),
            ("count", whole and 1 <= self.count <= MOST_COMPONENTS,
             f"give a whole number from 1 to {MOST_COMPONENTS:,}"),
        ):  # fmt: skip
            if not sound:
                raise SceneError.of(f"{what}: {key}", f"is {shown(getattr(self, key))}; {fix}")
        angle = f"{what}: direction_deg"
        finite_of(angle, direction_of(angle, self.direction_deg), "deg")
        warn_if_breaking(what, self.spectrum)

    def bins(self, placement: str) -> _core.WaveBins:
        """Of which each seed makes long-crested components."""
        return _core.WaveBins(
            self.spectrum, count=self.count, minimum_omega=self.minimum_omega,
            maximum_omega=self.maximum_omega, placement=placement,
        )  # fmt: skip


@dataclass(frozen=True, kw_only=True)
class RealisedSystem:
    """One wave system of a realised sea: its components are `components`, a slice of the sea's arrays."""

    name: str
    components: slice
    m0: float

    @property
    def hs(self) -> float:
        """4 sqrt(m0), m."""
        return float(4.0 * np.sqrt(self.m0))

    @property
    def count(self) -> int:
        """Number of components."""
        return int(self.components.stop - self.components.start)


@dataclass(frozen=True, kw_only=True, eq=False)
class RealisedSea:
    """The waves of a sea, and what they amount to (from the amplitudes, without sampling scatter).

    Attributes
    ----------
    waves : WaveComponents
        All systems, one after another.
    """

    waves: _core.WaveComponents
    systems: tuple[RealisedSystem, ...]

    @cached_property
    def repeat(self) -> _core.RepeatPeriod:
        """First return of the autocorrelation to 0.99, searched up to three hours when it is asked for."""
        return self.waves.repeat_period()

    @property
    def m0(self) -> float:
        """Variance of the elevation, m2."""
        return float(self.waves.m0)

    @property
    def hs(self) -> float:
        """4 sqrt(m0), m."""
        return float(self.waves.realised_hs)

    @property
    def tz(self) -> float:
        """Mean zero-upcrossing period, s."""
        return float(self.waves.mean_period)


@named
@dataclass(frozen=True, kw_only=True, eq=False)
class SeaState:
    """A sea as the sum of wave systems, independent of each other; immutable.

    Attributes
    ----------
    systems : sequence of WaveSystem or MeasuredWaves
        Wind sea, swells, a measured record; at least one.
    seed : int
        0 to 2^64 - 1. System j takes its random numbers from the Philox streams 3 j, 3 j + 1 and 3 j + 2
        (frequencies, phases, directions), so that another system more or less changes none of the others.
    depth : float
        Water depth, m; infinity for deep water.
    placement : str
        Of the frequencies in their bins: "jittered", or "uniform" for an FFT; see `realise_waves`.

    Raises
    ------
    SceneError
        Without a system, for something that is none, or a value out of range.
    """

    systems: Sequence[WaveSystem | MeasuredWaves]
    seed: int = 1
    depth: float = float("inf")
    placement: str = "jittered"

    def __post_init__(self) -> None:
        given = self.systems
        if isinstance(given, (str, bytes)) or not isinstance(given, Iterable):
            raise SceneError.of(
                "sea state: systems", f"is {given!r}; give a list of WaveSystem or MeasuredWaves"
            )
        systems = tuple(given)
        if not systems:
            raise SceneError("sea state: has no wave system; give at least one, or leave the sea out")
        for one in systems:
            if not isinstance(one, (WaveSystem, MeasuredWaves)):
                raise SceneError(f"sea state: {one!r} is no wave system; give WaveSystem or MeasuredWaves")
        whole = isinstance(self.seed, (int, np.integer))
        for key, sound, fix in (
            (
                "depth",
                number_of("sea state: depth", self.depth) > 0.0,
                "give one above zero in m, or inf",
            ),
            ("placement", self.placement in ("jittered", "uniform"), "give 'jittered' or 'uniform'"),
            ("seed", whole and 0 <= self.seed < 2**64, "give a whole number from 0 to 2^64 - 1"),
        ):
            if not sound:
                raise SceneError.of(f"sea state: {key}", f"is {shown(getattr(self, key))}; {fix}")
        object.__setattr__(self, "systems", systems)

    def realise(self) -> RealisedSea:
        """The waves of all systems; the same description gives the same waves.

        A short-crested system has one direction for each frequency: several would be phase-locked, and
        the variance of such a sea depends on the place (Jefferys 1987). The directions are quantiles of the
        spreading at steps of the golden ratio from a random start, so that every band of frequencies holds
        the whole distribution of directions.
        """
        return self.realised(self.bins())

    def bins(self) -> tuple[_core.WaveBins | None, ...]:
        """What the seas of all seeds share, by system; None of measured waves."""
        return tuple(
            None if isinstance(system, MeasuredWaves) else system.bins(self.placement)
            for system in self.systems
        )

    def realised(self, bins: Sequence[_core.WaveBins | None]) -> RealisedSea:
        """As `realise`, with the bins of this sea or of the same one with another seed."""
        systems = zip(self.systems, bins, strict=True)
        parts = [self._waves_of(j, system, own) for j, (system, own) in enumerate(systems)]
        ends = accumulate(len(part) for part in parts)
        realised = tuple(
            RealisedSystem(name=system.name, components=slice(end - len(part), end), m0=part.m0)
            for system, part, end in zip(self.systems, parts, ends, strict=True)
        )
        if len(parts) == 1:
            return RealisedSea(waves=parts[0], systems=realised)
        arrays: dict[str, Any] = {
            name: np.concatenate([getattr(part, name) for part in parts])
            for name in ("omega", "amplitude", "phase", "direction")
        }
        return RealisedSea(waves=_core.WaveComponents(**arrays, depth=self.depth), systems=realised)

    def _waves_of(
        self, j: int, system: WaveSystem | MeasuredWaves, bins: _core.WaveBins | None
    ) -> _core.WaveComponents:
        mean = float(np.radians(system.direction_deg))
        if isinstance(system, MeasuredWaves):
            directions = mean + self._angles(j, system.count, system.spreading)
            return system.waves(direction=directions, depth=self.depth)
        assert bins is not None
        plain = bins.realise(seed=self.seed, system=j, direction=mean, depth=self.depth)
        if system.spreading is None:
            return plain
        return _core.WaveComponents(
            omega=plain.omega, amplitude=plain.amplitude, phase=plain.phase, depth=self.depth,
            direction=mean + self._angles(j, len(plain), system.spreading),
        )  # fmt: skip

    def _angles(self, j: int, count: int, spreading: Spreading | None) -> Array:
        if spreading is None:
            return np.zeros(count)
        start = _core.philox_uniform(seed=self.seed, stream=3 * j + DIRECTION_STREAM, index=0)
        return spreading.quantile(np.mod(start + GOLDEN * np.arange(count), 1.0))

    def description(self) -> dict[str, Any]:
        """The sea in plain data, for notes and files: depth None is deep water, a record its size."""
        return {
            "seed": self.seed, "depth": None if np.isinf(self.depth) else float(self.depth),
            "placement": self.placement, "systems": [_described(system) for system in self.systems],
        }  # fmt: skip


def _described(system: WaveSystem | MeasuredWaves) -> dict[str, Any]:
    spread = system.spreading
    out: dict[str, Any] = {"name": system.name, "direction_deg": float(system.direction_deg)}
    if spread is not None:
        out["spreading"] = {"kind": spread.kind, "exponent": spread.exponent}
    if isinstance(system, MeasuredWaves):
        return out | {
            "record": {"samples": int(system.time.size), "step": system.step},
            "count": system.count,
        }
    parts = [{"hs": p.hs, "tp": p.tp, "gamma": p.gamma} for p in system.spectrum.parts()]
    return out | {"spectrum": system.spectrum.name, "parts": parts, "count": int(system.count)}
