"""Wave components too small to matter, left out when a scene is compiled."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from seacrane.description.waves import ByHeading, HullLoads, Waves
from seacrane.inputs.checked import number_of

Array = NDArray[np.float64]


def without_negligible(waves: Waves) -> Waves:
    """The same sea without its smallest components.

    Components are left out, smallest first, while the magnitudes of all that are left out stay below
    `waves.negligible` times the sum of the magnitudes of all, in each of the six loads on every vessel, in
    the elevation and in the slow drift. The first two can then never differ by more, at any time; slow drift,
    a product of two sums, to first order. At least one component stays, and all do in a series made by FFT,
    which costs the same with fewer.

    Raises ValueError if `negligible` is no number from 0 to 0.1.
    """
    kept = kept_components(waves)
    if kept.all():
        return waves

    def some(table: ByHeading | None) -> ByHeading | None:
        return None if table is None else replace(table, values=np.asarray(table.values)[:, kept])

    def fewer(hull: HullLoads) -> HullLoads:
        return replace(
            hull,
            transfer=np.asarray(hull.transfer)[kept],
            force_by_heading=some(hull.force_by_heading),
            drift=None if hull.drift is None else np.asarray(hull.drift)[kept],
            drift_by_heading=some(hull.drift_by_heading),
        )

    return replace(
        waves,
        omega=np.asarray(waves.omega)[kept],
        amplitude=np.asarray(waves.amplitude)[kept],
        phase=np.asarray(waves.phase)[kept],
        direction=np.asarray(waves.direction)[kept],
        hulls={body: fewer(hull) for body, hull in waves.hulls.items()},
    )


def kept_components(waves: Waves) -> NDArray[np.bool_]:
    """Which components `without_negligible` keeps; all of them where one is not finite."""
    limit = number_of("negligible", waves.negligible)
    if not 0.0 <= limit <= 0.1:
        raise ValueError(f"negligible is {limit}; give a share from 0 to 0.1, such as 1e-9")
    kept = np.ones(np.size(waves.omega), dtype=bool)
    if waves.evaluation == "fft":
        return kept
    magnitudes = _magnitudes(waves)
    if len(magnitudes) < 2 or not np.isfinite(magnitudes).all():
        return kept
    whole = magnitudes.sum(axis=0)
    share = np.divide(magnitudes, whole, out=np.zeros_like(magnitudes), where=whole > 0.0)
    order = np.argsort(share.max(axis=1), kind="stable")
    left_out = np.cumsum(share[order], axis=0).max(axis=1)
    kept[order[: min(np.searchsorted(left_out, limit, side="right"), len(order) - 1)]] = False
    return kept


def _magnitudes(waves: Waves) -> Array:
    """What each component adds at most, (n, channels)."""
    amplitude = np.abs(np.asarray(waves.amplitude, dtype=float))[:, None]
    return np.hstack(
        [amplitude, *(part for hull in waves.hulls.values() for part in _loads(amplitude, hull))]
    )


def _loads(amplitude: Array, hull: HullLoads) -> list[Array]:
    columns = [amplitude * np.abs(np.asarray(hull.transfer))]
    # Slow drift multiplies two sums of sqrt(D) a: leaving out a share of one changes it by twice that share.
    if hull.drift is not None:
        columns.append(2.0 * amplitude * np.sqrt(np.abs(np.asarray(hull.drift))))
    if hull.force_by_heading is not None:
        columns.append(amplitude * np.abs(np.asarray(hull.force_by_heading.values)).max(axis=0))
    if hull.drift_by_heading is not None:
        columns.append(
            2.0 * amplitude * np.sqrt(np.abs(np.asarray(hull.drift_by_heading.values)).max(axis=0))
        )
    return columns
