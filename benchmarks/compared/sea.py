"""Seas and slow drift."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from scipy.integrate import quad
from test_drift import TIMES, double_sum, sea

from seacrane import _core, cases
from seacrane.sea import jonswap

from .row import Row

SUBJECT = "Seas"


def spectrum() -> Iterator[Row]:
    """Area of the spectrum, and of its realisation."""
    wave = jonswap(hs=2.0, tp=8.0)
    area = quad(lambda w: float(wave.density(w)), 1e-3, 20.0, limit=400, points=[0.7, 0.8, 1.0])[0]
    yield Row(
        subject=SUBJECT, compared="significant height of the JONSWAP spectrum by its area",
        reference="the height asked for", difference=abs(2.0 * np.sqrt(area) - 1.0), unit="", limit=1e-3,
        test="sea/test_sea_spectra.py",
    )  # fmt: skip
    waves = cases.vessel().waves
    assert waves is not None
    realised = 4.0 * np.sqrt(0.5 * np.sum(np.square(waves.amplitude)))
    yield Row(
        subject=SUBJECT, compared="significant height of the cases' 200 components",
        reference="the height asked for, 2 m", difference=abs(float(realised) / 2.0 - 1.0), unit="",
        limit=0.02, test="sea/test_sea_statistics.py",
    )  # fmt: skip


def drift() -> Iterator[Row]:
    """Newman's approximation as two sums."""
    waves, coefficient = sea()
    load = _core.DriftLoad(waves, coefficient=coefficient, position=(20.0, -3.0))
    scale = np.sum(waves.amplitude) * np.array(waves.amplitude) @ np.abs(coefficient)
    worst = max(
        float((np.abs(load.evaluate(t) - double_sum(waves, coefficient, t, 20.0, -3.0)) / scale).max())
        for t in TIMES
    )
    yield Row(
        subject=SUBJECT, compared="slow drift by two sums, over the sum of magnitudes",
        reference="Newman's double sum", difference=worst, unit="", limit=1e-12, test="vessel/test_drift.py",
    )  # fmt: skip
