"""Wave spectra by other parameters than the core's: gamma by rule, mean periods, tables; breaking."""

from __future__ import annotations

import math
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from seacrane import _core
from seacrane.errors import SceneError
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.checked import number_of, numbers_of, positive_of
from seacrane.warnings import SteepSeaWarning

# Peak period over mean periods of x^-5 exp(-5/4 x^-4), from its moments in closed form.
PEAK_OVER_TZ = (1.25 * math.pi) ** 0.25
PEAK_OVER_T1 = 1.25**0.25 * math.gamma(0.75)


def jonswap(*, hs: float, tp: float, gamma: float | Literal["dnv"] = 3.3) -> _core.Spectrum:
    """JONSWAP spectrum.

    Parameters
    ----------
    hs : float
        Significant wave height, m.
    tp : float
        Peak period, s.
    gamma : float or "dnv"
        Peak enhancement, 1 to 7; "dnv": from hs and tp by DNV-RP-C205, see `dnv_gamma`.

    Raises
    ------
    SceneError
        A parameter is not finite or out of range.

    Notes
    -----
    Hasselmann et al., Deutsche Hydrographische Zeitschrift A8 (12), 1973. Normalised by quadrature.
    """
    hs, tp = number_of("JONSWAP spectrum: hs", hs), number_of("JONSWAP spectrum: tp", tp)
    if isinstance(gamma, str):
        if gamma != "dnv":
            raise SceneError.of("JONSWAP spectrum: gamma", f"is {gamma!r}; give a number or 'dnv'")
        gamma = _core.dnv_gamma(hs=hs, tp=tp)
    return _core.jonswap(hs=hs, tp=tp, gamma=number_of("JONSWAP spectrum: gamma", gamma))


def bretschneider(
    *, hs: float, tp: float | None = None, tz: float | None = None, t1: float | None = None
) -> _core.Spectrum:
    """Bretschneider's spectrum, the two-parameter one of ITTC and ISSC: Pierson-Moskowitz by any period.

    Parameters
    ----------
    hs : float
        Significant wave height, m.
    tp, tz, t1 : float
        One of: peak period; mean zero-upcrossing period 2 pi sqrt(m0 / m2) = tp / 1.408; mean period
        2 pi m0 / m1 = tp / 1.296; s.

    Raises
    ------
    SceneError
        Not exactly one period, or a parameter that is not finite or not above zero.
    """
    given = {"tp": (tp, 1.0), "tz": (tz, PEAK_OVER_TZ), "t1": (t1, PEAK_OVER_T1)}
    periods = {name: pair for name, pair in given.items() if pair[0] is not None}
    if len(periods) != 1:
        raise SceneError(
            f"Bretschneider spectrum: periods given are {sorted(periods)}; give one of tp, tz, t1"
        )
    ((name, (period, factor)),) = periods.items()
    tp = factor * positive_of(f"Bretschneider spectrum: {name}", period, "s")
    return _core.pierson_moskowitz(hs=hs, tp=tp)


def tabulated_spectrum(
    *, density: ArrayLike, omega: ArrayLike | None = None, frequency: ArrayLike | None = None
) -> _core.Spectrum:
    """Spectrum from a table, linear between its points and zero outside; its energy is that of the polygon.

    Parameters
    ----------
    density : array_like, shape (n,)
        S(omega) in m2 s/rad beside `omega`, S(f) in m2/Hz beside `frequency`; zero or more.
    omega, frequency : array_like, shape (n,)
        One of: rad/s; Hz. Increasing from zero or more.

    Raises
    ------
    SceneError
        Not exactly one of the two, or a value that is out of range, naming it.
    """
    if (omega is None) == (frequency is None):
        raise SceneError("tabulated spectrum: give either omega (rad/s) or frequency (Hz)")
    values = numbers_of("tabulated spectrum: density", density)
    if omega is not None:
        return _core.tabulated_density(omega=numbers_of("tabulated spectrum: omega", omega), density=values)
    hertz = numbers_of("tabulated spectrum: frequency", frequency)
    return _core.tabulated_density(omega=2.0 * np.pi * hertz, density=values / (2.0 * np.pi))


def steepness_limit(tp: float) -> float:
    """Largest mean steepness hs / (g tp^2 / 2 pi) of a real sea, by DNV-RP-C205.

    1/15 for tp up to 8 s, 1/25 from 15 s on, linear between them.
    """
    return float(np.interp(tp, [8.0, 15.0], [1.0 / 15.0, 1.0 / 25.0]))


def warn_if_breaking(name: str, spectrum: _core.Spectrum) -> None:
    """SteepSeaWarning for a spectrum above `steepness_limit`."""
    limit, steepness = steepness_limit(spectrum.tp), spectrum.steepness()
    if steepness > limit:
        warn_caller(
            f"{name}: hs {spectrum.hs:.4g} m at tp {spectrum.tp:.4g} s has a steepness of "
            f"1/{1.0 / steepness:.3g}, above 1/{1.0 / limit:.3g} (DNV-RP-C205): such waves break, and linear "
            "ones overstate crests and loads; lower hs or lengthen tp",
            SteepSeaWarning,
        )
