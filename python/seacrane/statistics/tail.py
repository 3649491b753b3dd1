"""Peaks over a threshold: clusters of crests, and the distribution of their excess."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from seacrane.arrays import Array
from seacrane.errors import SceneError
from seacrane.inputs.checked import number_of
from seacrane.inputs.shown import shown
from seacrane.statistics.estimate import EULER, P90_COUNT, TAILS, Estimate, Maximum

CANDIDATES = np.linspace(0.85, 0.98, 14)  # shares of the crests below a threshold that is tried
FEWEST_PEAKS = 20
ACCEPTED = {"exponential": 1.062, "pareto": 0.95}  # Anderson-Darling distance that one fit of ten exceeds
STEEPEST = 0.45  # shape parameters of Pareto's beyond which nothing is believed
DRAWS = 500
SEED = 20250102


@dataclass(frozen=True, kw_only=True, eq=False)
class Tail:
    """Clusters of crests above a threshold and the distribution fitted to their peaks.

    Attributes
    ----------
    kind : str
        "exponential", or "pareto" (generalised).
    threshold : float
        Unit of the record.
    chosen : bool
        Whether the threshold was chosen here: the lowest with an acceptable fit.
    peaks : ndarray, shape (k,)
        The largest crest of each cluster, ascending.
    extremal_index : float
        Clusters over crests above the threshold: 1 where these come one by one.
    scale, shape : float
        Of the excess; `shape` is 0 for an exponential tail, below 0 for one that ends.
    rate : float
        Clusters per second.
    distance : float
        Anderson and Darling's, of the fit.
    accepted : bool
        Whether it is below what one good fit of ten exceeds.
    """

    kind: str
    threshold: float
    chosen: bool
    peaks: Array
    extremal_index: float
    scale: float
    shape: float
    rate: float
    distance: float
    accepted: bool

    def crossings(self, levels: Array, exposure: float) -> Array:
        """Mean number of clusters above levels (at least the threshold) in an exposure time, s."""
        excess = np.asarray(levels, dtype=float) - self.threshold
        if abs(self.shape) < 1e-9:
            return np.asarray(self.rate * exposure * np.exp(-excess / self.scale))
        room = np.maximum(0.0, 1.0 + self.shape * excess / self.scale)
        return np.asarray(self.rate * exposure * np.power(room, -1.0 / self.shape))

    def maximum(self, exposure: float) -> Maximum:
        """The largest value in an exposure time (s), with intervals by a parametric bootstrap."""
        drawn = _bootstrap(self)
        found = _numbers(self.rate * exposure, self.scale, self.shape)
        spread = _numbers(drawn[0] / self.peaks.size * self.rate * exposure, drawn[1], drawn[2])
        estimates = {}
        for name, value in found.items():
            low, high = np.quantile(self.threshold + spread[name], TAILS)
            estimates[name] = Estimate(value=float(self.threshold + value), low=float(low), high=float(high))
        return Maximum(**estimates, exposure=exposure)


def _numbers(count: Array | float, scale: Array | float, shape: Array | float) -> dict[str, Array]:
    """Excess of the most probable maximum, mean and P90 of the largest of `count` clusters on average."""
    from scipy.special import gamma

    counts, scales = np.asarray(count, dtype=float), np.asarray(scale, dtype=float)
    bent = np.asarray(shape, dtype=float)
    curved = np.abs(bent) > 1e-9
    safe = np.where(curved, bent, 1.0)

    def level(share: Array | float, straight: float, factor: Array | float) -> Array:
        power = ((counts / share) ** safe * factor - 1.0) / safe
        return scales * np.where(curved, power, np.log(counts) + straight)

    return {
        "mpm": level(1.0 + np.maximum(bent, -0.99), 0.0, 1.0),
        "mean": level(1.0, EULER, gamma(1.0 - np.where(curved, safe, 0.0))),
        "p90": level(P90_COUNT, -np.log(P90_COUNT), 1.0),
    }


def _bootstrap(tail: Tail) -> tuple[Array, Array, Array]:
    """Numbers of clusters, scales and shapes fitted to samples of the tail."""
    random = np.random.Generator(np.random.Philox(SEED))
    counts = np.maximum(FEWEST_PEAKS // 2, random.poisson(tail.peaks.size, size=DRAWS))
    fits = []
    for count in counts.tolist():
        excess = random.exponential(size=count)
        if abs(tail.shape) > 1e-9:
            excess = np.expm1(tail.shape * excess) / tail.shape
        fits.append(_fitted(tail.kind, tail.scale * excess))
    scale, shape = np.array(fits).T
    return counts.astype(float), scale, shape


def peaks_over_threshold(
    crests: Array, *, duration: float, threshold: float | None = None, kind: str = "pareto"
) -> Tail | None:
    """Fit the tail of the crests of one record.

    One (n,) for each cycle, in the order of time; its duration is in s. Without a threshold the lowest of the
    85 % to 98 % quantiles of the crests is taken at which the fit is acceptable. None where fewer than 20
    clusters lie above any threshold tried.
    """
    if kind not in ACCEPTED:
        raise SceneError(f"tail={shown(kind)}: choose from {', '.join(ACCEPTED)}")
    given = None if threshold is None else number_of("threshold", threshold)
    levels = np.quantile(crests, CANDIDATES) if given is None and crests.size else np.array([given])
    found = None
    for level in levels.tolist():
        tail = _above(crests, duration, level, kind, chosen=given is None) if crests.size else None
        found = tail or found
        if tail is not None and tail.accepted:
            break
    if found is None and given is not None:
        raise SceneError(
            f"threshold={given:g}: fewer than {FEWEST_PEAKS} clusters of crests lie above it; lower it"
        )
    return found


def _above(crests: Array, duration: float, threshold: float, kind: str, *, chosen: bool) -> Tail | None:
    places = np.flatnonzero(crests > threshold)
    if places.size < FEWEST_PEAKS:
        return None
    index = extremal_index(places)
    peaks = _cluster_peaks(crests, places, index)
    if peaks.size < FEWEST_PEAKS:
        return None
    scale, shape = _fitted(kind, peaks - threshold)
    distance = _distance(peaks - threshold, scale, shape)
    return Tail(
        kind=kind, threshold=threshold, chosen=chosen, peaks=peaks, extremal_index=index, scale=scale,
        shape=shape, rate=peaks.size / duration, distance=distance, accepted=distance <= ACCEPTED[kind],
    )  # fmt: skip


def extremal_index(places: NDArray[np.intp]) -> float:
    """Share of exceedances that begin a cluster, by the times between them (Ferro and Segers, 2003)."""
    gaps = np.diff(places).astype(float)
    if gaps.max() <= 2.0:
        return float(min(1.0, 2.0 * gaps.sum() ** 2 / (gaps.size * (gaps**2).sum())))
    return float(min(1.0, 2.0 * (gaps - 1.0).sum() ** 2 / (gaps.size * ((gaps - 1.0) * (gaps - 2.0)).sum())))


def _cluster_peaks(crests: Array, places: NDArray[np.intp], index: float) -> Array:
    """The largest crest of each cluster, ascending; the longest gaps part as many as the index tells."""
    parts = int(index * places.size)
    gaps = np.diff(places)
    longest = np.sort(gaps)[::-1][parts] if parts < gaps.size else 0
    starts = np.concatenate([[0], 1 + np.flatnonzero(gaps > longest)])
    return np.sort(np.maximum.reduceat(crests[places], starts))


def _fitted(kind: str, excess: Array) -> tuple[float, float]:
    """Scale and shape by maximum likelihood; generalised Pareto's by Grimshaw's one unknown."""
    if kind == "exponential":
        return float(excess.mean()), 0.0
    from scipy.optimize import minimize_scalar

    scaled = excess / excess.mean()

    def shape_of(ratio: float) -> float:
        return float(np.log1p(ratio * scaled).mean())

    def cost(ratio: float) -> float:
        shape = shape_of(ratio)
        if abs(ratio) < 1e-9:
            return 1.0
        if shape * ratio <= 0.0 or abs(shape) > STEEPEST:
            return 1e9
        return float(np.log(shape / ratio) + shape + 1.0)

    lowest = -(1.0 - 1e-9) / scaled.max()
    best = min(
        (minimize_scalar(cost, bounds=ends, method="bounded") for ends in ((lowest, -1e-7), (1e-7, 2.0))),
        key=lambda found: float(found.fun),
    )
    if best.fun >= 1.0:
        return float(excess.mean()), 0.0
    shape = shape_of(float(best.x))
    return float(shape / best.x * excess.mean()), shape


def _distance(excess: Array, scale: float, shape: float) -> float:
    """Anderson and Darling's distance of ascending excesses from a tail; Stephens' correction for few."""
    ratio = excess / scale
    reduced = ratio if abs(shape) < 1e-9 else np.log1p(np.maximum(shape * ratio, -1.0 + 1e-12)) / shape
    log_above, log_below = -reduced, np.log(np.maximum(-np.expm1(-reduced), 1e-300))
    odd = 2.0 * np.arange(1, excess.size + 1) - 1.0
    square = -excess.size - float((odd * (log_below + log_above[::-1])).mean())
    return square * (1.0 + 0.6 / excess.size) if shape == 0.0 else square
