"""Statistics of records and of the maxima of seeds: closed forms, coverage by simulation, warnings."""

from __future__ import annotations

import warnings
from functools import cache, partial
from typing import Any

import numpy as np
import pytest
from scipy.stats import genpareto, gumbel_r

import seacrane as sc
from seacrane import Result, SceneError
from seacrane.arrays import Array
from seacrane.result.about import ALWAYS_STATED
from seacrane.statistics.record import start_differs
from seacrane.statistics.seeds import anderson_darling, gumbel_fit, standard_fits
from seacrane.statistics.tail import Tail, extremal_index, peaks_over_threshold
from seacrane.warnings import RepeatingSeaWarning

THREE_HOURS, STEP = 10800.0, 0.5
NARROW, BROAD = (0.8, 0.06), (0.8, 0.25)  # peak and width, rad/s


@cache
def records(count: int, band: tuple[float, float] = NARROW, duration: float = THREE_HOURS) -> Array:
    """Gaussian records of unit standard deviation, each half of a periodic one twice as long."""
    random = np.random.default_rng(17)
    values = int(duration / STEP)
    omega = 2.0 * np.pi * np.fft.rfftfreq(2 * values, STEP)
    density = np.exp(-0.5 * ((omega - band[0]) / band[1]) ** 2) * (omega > 0.0)
    parts = random.normal(size=(2, count, omega.size)) * np.sqrt(density / density.sum()) * values
    return np.fft.irfft(parts[0] + 1j * parts[1], axis=1)[:, :values]


def result_of(values: Array, **stats: Any) -> Result:
    time = STEP * np.arange(values.size)
    stated = {**dict.fromkeys(ALWAYS_STATED, 0), "scene": "lift", **stats}
    return Result.from_arrays(time=time, arrays={"link_tension": 1e3 * values}, coords={}, stats=stated)


def gumbel(count: int, size: int, seed: int = 3) -> Array:
    return np.random.default_rng(seed).gumbel(loc=10.0, scale=0.7, size=(size, count))


@pytest.mark.parametrize("cycles", [20.0, 1375.0])
def test_the_gaussian_maximum_is_that_of_independent_crests(cycles: float) -> None:
    found = sc.statistics.gaussian_maximum(std=2.0, rate=cycles / 3600.0, exposure=3600.0, mean=5.0)
    draws = np.random.default_rng(1).exponential(size=200_000)  # crossings of the maximum: exponential
    largest = 5.0 + 2.0 * np.sqrt(2.0 * np.log(np.maximum(1.0, cycles / draws)))
    assert found.mpm.value == pytest.approx(5.0 + 2.0 * np.sqrt(2.0 * np.log(cycles)), rel=1e-12)
    assert found.mean.value == pytest.approx(largest.mean(), abs=5e-3)
    assert found.p90.value == pytest.approx(np.quantile(largest, 0.9), abs=2e-2)


def test_crests_of_a_narrow_band_come_in_clumps() -> None:
    """sqrt(2 ln N) is 4 % above the mode of 400 maxima; clumps account for it."""
    maxima = records(400).max(axis=1)
    with pytest.warns(sc.warnings.PoorFitWarning):  # the square of a Gaussian maximum is nearer to Gumbel's
        mode = sc.statistics.seed_extremes(maxima, duration=THREE_HOURS).gumbel.mpm.value
    process = {"std": 1.0, "rate": 0.8 / (2.0 * np.pi)}
    single = sc.statistics.gaussian_maximum(**process).mpm.value
    clumped = sc.statistics.gaussian_maximum(**process, bandwidth=0.06 / np.hypot(0.8, 0.06)).mpm.value
    assert single == pytest.approx(3.80, abs=5e-3)
    assert mode == pytest.approx(3.65, abs=0.05)
    assert clumped == pytest.approx(mode, rel=0.015)
    assert sc.statistics.seed_extremes(maxima**2, duration=THREE_HOURS).fit_probability > 0.05


def test_a_broad_band_agrees_with_its_closed_forms() -> None:
    """And crests of a narrow one with Rayleigh's."""
    runs = records(60, BROAD)
    found = sc.statistics.record_extremes(runs[0], interval=STEP)
    rate, width = np.hypot(*BROAD) / (2.0 * np.pi), BROAD[1] / np.hypot(*BROAD)
    assert found.spectrum.crossing_rate == pytest.approx(rate, rel=0.02)
    assert found.crossing_rate == pytest.approx(rate, rel=0.03)
    assert found.spectrum.bandwidth == pytest.approx(width, rel=0.05)
    assert found.significant == pytest.approx(2.0, rel=0.05)
    mean = sc.statistics.gaussian_maximum(std=1.0, rate=rate, bandwidth=width).mean.value
    assert runs.max(axis=1).mean() == pytest.approx(mean, abs=3.0 * 0.33 / np.sqrt(60))
    found = sc.statistics.record_extremes(records(8, (0.8, 0.02)).ravel()[: 4 * 21600], interval=STEP)
    levels = np.array([0.5, 1.0, 2.0])
    np.testing.assert_allclose(found.exceedance(levels), np.exp(-0.5 * levels**2), atol=0.03)
    assert abs(found.skewness) < 0.1
    assert found.period == pytest.approx(2.0 * np.pi / 0.8, rel=0.01)


def test_intervals_of_one_gaussian_record_cover_its_level() -> None:
    inside = 0
    for values in records(400)[:60]:
        with warnings.catch_warnings(action="ignore"):
            mpm = sc.statistics.record_extremes(values, interval=STEP, tail="exponential").gaussian.mpm
        inside += mpm.low < 3.80 < mpm.high
    assert inside >= 53  # of 60; 57 expected


def test_the_spectrum_of_white_noise_is_flat_within_its_interval() -> None:
    values = np.random.default_rng(2).normal(size=8192)
    found = sc.statistics.spectrum_estimate(values, interval=0.1)
    low, high = found.interval()
    inside = (low < 0.1 / np.pi) & (0.1 / np.pi < high)
    assert inside[2:-1].mean() > 0.9
    assert found.std == pytest.approx(1.0, rel=0.05)
    scatter = found.density[2:-1].std() / found.density[2:-1].mean()
    assert 2.0 / scatter**2 == pytest.approx(found.degrees_of_freedom, rel=0.3)


def test_degrees_of_freedom_of_the_variance() -> None:
    """By the closed form of a Gaussian spectrum: T 2 sqrt(pi) s / pi; and by the scatter over records."""
    runs = records(400)
    spectra = [sc.statistics.spectrum_estimate(values, interval=STEP) for values in runs[:10]]
    found = np.mean([spectrum.variance_degrees for spectrum in spectra])
    assert found == pytest.approx(THREE_HOURS * 2.0 * 0.06 / np.sqrt(np.pi), rel=0.1)
    assert found == pytest.approx(2.0 / runs.var(axis=1).var(), rel=0.2)


def test_the_fit_is_of_largest_likelihood_and_its_test_rejects_as_often_as_it_says() -> None:
    (one,) = gumbel(25, 1)
    assert tuple(map(float, gumbel_fit(one))) == pytest.approx(gumbel_r.fit(one), rel=1e-5)
    for sample, low, high in ((gumbel(30, 400), 0.02, 0.09), (-gumbel(30, 400), 0.5, 1.0)):
        worse = standard_fits(30)[2][None, :] > anderson_darling(sample, *gumbel_fit(sample))[:, None]
        assert low <= (worse.mean(axis=1) < 0.05).mean() <= high


@pytest.mark.parametrize("count", [5, 20])
@pytest.mark.parametrize(("number", "reduced"), [("mpm", 0.0), ("mean", np.euler_gamma), ("p90", 2.2504)])
def test_intervals_cover_what_they_say(count: int, number: str, reduced: float) -> None:
    inside = []
    for sample in gumbel(count, 300):
        with warnings.catch_warnings(action="ignore"):
            found = getattr(sc.statistics.seed_extremes(sample, duration=1.0, exposure=6.0).gumbel, number)
        inside.append(found.low < 10.0 + 0.7 * (reduced + np.log(6.0)) < found.high)
    assert np.mean(inside) == pytest.approx(0.95, abs=0.04)


@pytest.mark.filterwarnings("ignore::seacrane.warnings.PoorFitWarning")
def test_as_many_seeds_as_needed_reach_the_half_width() -> None:
    few = sc.statistics.seed_extremes(gumbel(400, 1)[0], duration=1.0)
    for number in ("mpm", "mean", "p90"):
        samples = gumbel(few.seeds_needed(0.03, number=number), 9, seed=9)
        found = [
            sc.statistics.seed_extremes(one, duration=1.0).relative_half_width(number) for one in samples
        ]
        assert np.median(found) == pytest.approx(0.03, rel=0.2)


def test_another_exposure_is_the_maximum_of_so_many_records() -> None:
    parts = gumbel(6 * 1000, 1)[0]
    short = sc.statistics.seed_extremes(parts, duration=1800.0, exposure=THREE_HOURS)
    long = sc.statistics.seed_extremes(parts.reshape(1000, 6).max(axis=1), duration=THREE_HOURS)
    for number in ("mpm", "mean", "p90"):
        exact = getattr(long.gumbel, number)
        assert exact.low < getattr(short.gumbel, number).value < exact.high
        assert getattr(short.empirical, number).value == pytest.approx(exact.value, rel=0.01)
    with pytest.warns(sc.warnings.FewSeedsWarning, match="5 seeds"):
        few = sc.statistics.seed_extremes(gumbel(5, 1)[0], duration=THREE_HOURS).empirical
    assert few.p90.high == np.inf  # ranks bound nothing beyond the maxima
    assert few.mean.low < few.mean.value < few.mean.high


@pytest.mark.parametrize(("kind", "shape"), [("exponential", 0.0), ("pareto", -0.15)])
def test_a_known_tail_is_found(kind: str, shape: float) -> None:
    excess = np.random.default_rng(4).exponential(size=4000)
    crests = 3.0 + (excess if shape == 0.0 else np.expm1(shape * excess) / shape)
    tail = peaks_over_threshold(crests, duration=40_000.0, kind=kind)
    assert tail.chosen
    assert tail.accepted
    assert tail.extremal_index == pytest.approx(1.0, abs=0.05)
    assert tail.shape == pytest.approx(shape, abs=0.08)
    levels = tail.threshold + tail.scale * np.array([0.0, 1.0, 3.0])
    above = genpareto.sf(levels - tail.threshold, tail.shape, scale=tail.scale)
    assert tail.crossings(levels, 100.0) == pytest.approx(100.0 * tail.rate * above)
    count = 0.1 * THREE_HOURS
    level = 3.0 + (np.log(count) if shape == 0.0 else ((count / 0.105) ** shape - 1.0) / shape)
    found = tail.maximum(THREE_HOURS)
    estimate = found.mpm if shape == 0.0 else found.p90
    assert estimate.low < level < estimate.high
    assert estimate.value == pytest.approx(level, rel=0.07)


def test_crests_that_come_together_count_once() -> None:
    alone = np.random.default_rng(6).exponential(size=3000)
    places = np.flatnonzero(np.repeat(alone, 4) > 3.0)
    assert extremal_index(places) == pytest.approx(0.25, abs=0.05)
    tail = peaks_over_threshold(np.repeat(alone, 4), duration=1.0, threshold=3.0)
    assert tail.peaks.size == pytest.approx((alone > 3.0).sum(), rel=0.15)


def test_good_fits_are_accepted_nine_times_of_ten() -> None:
    random = np.random.default_rng(7)
    for kind in ("exponential", "pareto"):
        samples = (random.exponential(size=60) for _ in range(200))
        tails = [peaks_over_threshold(one, duration=60.0, threshold=0.0, kind=kind) for one in samples]
        accepted = [tail.accepted for tail in tails if isinstance(tail, Tail)]
        assert np.mean(accepted) == pytest.approx(0.9, abs=0.06)


def test_extremes_of_a_result_and_of_several() -> None:
    runs = [result_of(50.0 + values) for values in records(400)[:12]]
    one = sc.extremes(runs[0], channel="link_tension", exposure=1800.0)
    assert isinstance(one, sc.statistics.RecordExtremes)
    assert one.unit == "N"
    assert one.gaussian.exposure == 1800.0
    assert one.dynamic_factor == pytest.approx(1.0 + 3.2 / 50.0, abs=0.02)
    several = sc.extremes(runs, channel="link_tension", half_width=0.2)
    assert isinstance(several, sc.statistics.SeedExtremes)
    assert several.maxima.max() == max(float(run["link_tension"].max()) for run in runs)
    assert several.dynamic_factor == pytest.approx(several.gumbel.mpm.value / several.static)
    low = sc.extremes(runs, channel="link_tension", smallest=True)
    assert -low.maximum.mpm.value == pytest.approx(5e4 - 3.6e3, rel=0.02)
    with pytest.warns(sc.warnings.FewSeedsWarning, match="about"):
        sc.extremes(runs, channel="link_tension", half_width=0.02)


def test_figures_hold_the_numbers_they_show() -> None:
    one = sc.statistics.record_extremes(records(400)[2], interval=STEP)
    sheet = one.sheet()
    assert sheet.marks["most probable maximum"][0] == one.maximum.mpm.value
    assert sheet.panels[0].lines[0].values[0] == pytest.approx(one.crests.size, rel=0.02)
    several = sc.statistics.seed_extremes(gumbel(20, 1)[0], duration=1.0)
    fitted = several.sheet().panels[0].lines[1].values
    assert np.interp(0.0, fitted, several.maxima) == pytest.approx(several.location, abs=1e-9)
    assert sc.pictures.plot_extremes(several).axes


def test_a_start_that_differs_is_named_and_can_be_left_out() -> None:
    values = records(400)[0].copy()
    assert start_differs(values[:300], 20.0) is None
    assert sum(bool(start_differs(steady, 1375.0)) for steady in records(400)) <= 6
    values[:2000] += 3.0 * np.exp(-np.arange(2000) / 700.0)
    with pytest.warns(sc.warnings.StartTransientWarning, match="after="):
        sc.extremes(result_of(values), channel="link_tension")
    sc.extremes(result_of(values), channel="link_tension", after=2500.0)


def test_a_sea_that_repeats_is_named() -> None:
    for found in (1, 0):  # 0: searched for, and there is none
        result = result_of(records(400)[1], repeat_period_s=600.0, repeat_found=found)
        with warnings.catch_warnings(record=True, action="always", category=RepeatingSeaWarning) as told:
            sc.extremes(result, channel="link_tension")
        assert sum(one.category is RepeatingSeaWarning for one in told) == found


record = partial(sc.statistics.record_extremes, interval=0.5)
seeds = partial(sc.statistics.seed_extremes, duration=1.0)
CASES: list[tuple[Any, Any, dict[str, Any], str]] = [
    (record, np.ones(100), {}, "does not vary"),
    (record, [*range(99), np.nan], {}, "finite"),
    (record, None, {"threshold": 9.0}, "threshold=9"),
    (seeds, [1.0, 2.0], {}, "at least 3"),
    (seeds, [1.0, 1.0, 1.0], {}, "different"),
    (seeds, [1.0, np.inf, 2.0], {}, "failed seeds"),
    (sc.extremes, result_of(np.ones(500)), {"channel": "link_tension", "after": 1e5}, "64"),
]


@pytest.mark.filterwarnings("ignore::seacrane.warnings.SceneWarning")
@pytest.mark.parametrize(("call", "values", "given", "words"), CASES)
def test_bad_input_is_named(call: Any, values: Any, given: dict[str, Any], words: str) -> None:
    with pytest.raises(SceneError, match=words):
        call(records(400)[0] if values is None else values, **given)
