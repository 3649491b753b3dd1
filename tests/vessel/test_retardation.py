"""Retardation functions of a database: against a closed form, against the database, and bad settings."""

from __future__ import annotations

import warnings
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from seacrane.hydro import retardation_functions, shipped_database, vessel_parameters
from seacrane.hydro.memory.retardation import cosine_transform, transform
from seacrane.warnings import MemoryFitWarning

Array = NDArray[np.float64]
DECAY, RINGING = 0.35, 0.9  # 1/s, of the closed-form kernel


def closed_form(tau: Array) -> Array:
    """exp(-a t) (cos b t - a/b sin b t), whose transform is s / ((s + a)^2 + b^2)."""
    return np.exp(-DECAY * tau) * (np.cos(RINGING * tau) - DECAY / RINGING * np.sin(RINGING * tau))


def closed_form_transform(omega: Array) -> NDArray[np.complex128]:
    s = 1j * omega
    return np.asarray(s / ((s + DECAY) ** 2 + RINGING**2))


def test_kernel_of_sampled_damping_converges_to_the_closed_form() -> None:
    """B of a known kernel, sampled finer and to higher frequencies: at the limit what is left is rounding."""
    tau = np.linspace(0.0, 25.0, 251)
    errors = []
    for spacing, end in ((0.1, 6.0), (0.05, 12.0), (0.025, 24.0)):
        omega = spacing * np.arange(1, round(end / spacing) + 1)
        damping = closed_form_transform(omega).real[:, None, None]
        found = cosine_transform(omega, damping, tau)[0][:, 0, 0]
        errors.append(float(np.max(np.abs(found - closed_form(tau)))))
    assert errors[0] < 1e-2
    assert errors[1] < errors[0] / 4.0
    assert errors[2] < errors[1] / 4.0


def test_transform_returns_the_closed_form() -> None:
    step, omega = 0.05, np.linspace(0.1, 4.0, 40)
    kernel = closed_form(step * np.arange(1201))[:, None, None]
    found = transform(kernel, step, omega)[:, 0, 0]
    np.testing.assert_allclose(found, closed_form_transform(omega), atol=1e-6)


def test_database_comes_back_from_its_retardation_functions() -> None:
    """Damping to 0.1 %; added mass as far as the data obey Kramers-Kronig; A_inf near the panel code's."""
    database = shipped_database()
    model = retardation_functions(database=database)
    assert model.error_damping.max() < 1e-3
    assert model.error_added_mass.max() < 0.05
    low, high = model.band
    inside = (database.omega >= low) & (database.omega <= high)
    added_mass, damping = model.frequency_response(database.omega)
    for j in range(1, 6):
        spread = np.std(database.damping[inside, j, j])
        misfit = np.sqrt(np.mean((damping - database.damping)[inside, j, j] ** 2))
        assert misfit / spread == pytest.approx(model.error_damping[j, j], rel=1e-9)
        assert np.abs(added_mass - database.added_mass)[inside, j, j].max() < 0.05 * np.ptp(
            database.added_mass[inside, j, j]
        )
    assert database.infinite_frequency_added_mass is not None
    ratio = np.diag(model.added_mass) / np.diag(database.infinite_frequency_added_mass)
    np.testing.assert_allclose(ratio[1:], 1.0, atol=0.02)


def test_steps_and_durations_are_checked() -> None:
    database = shipped_database()
    for arguments, text in (
        ({"step": 0.0}, "step is 0.0 s"),
        ({"duration": -1.0}, "duration is -1.0 s"),
        ({"step": float("nan")}, "step is nan s"),
        ({"step": 1e-6}, "samples"),
        ({"step": 1.2}, "half a period"),
    ):
        with pytest.raises(ValueError, match=text):
            retardation_functions(database=database, **arguments)
    with pytest.raises(ValueError, match="holds 5 frequencies"):
        retardation_functions(database=replace(database, trusted_band=(0.5, 0.7)))


def test_a_kernel_cut_too_short_is_warned_about() -> None:
    database = shipped_database()
    short = retardation_functions(database=database, duration=6.0)
    with pytest.warns(MemoryFitWarning, match=r"of 6 s .* with an error of 0\.\d+ of its standard deviation"):
        vessel_parameters(database, memory=short)
    with warnings.catch_warnings():
        warnings.simplefilter("error", MemoryFitWarning)
        vessel_parameters(database, memory=retardation_functions(database=database))
