"""Hydrodynamics of a hull by strip theory (Salvesen, Tuck and Faltinsen 1970), in the compiled core."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.hydro.hull.hull import Hull
from seacrane.hydro.hull.solution import HullSolution
from seacrane.inputs.caller import warn_caller
from seacrane.warnings import SubmergedPartWarning

FloatArray = NDArray[np.float64]

HANGING = 1e-6  # of the volume
PANELS = 40  # on each half section
PANELS_PER_WAVE = 8.0


def strip_solution(
    hull: Hull,
    *,
    omega: FloatArray,
    heading: FloatArray,
    rho: float,
    g: float,
    speed: float = 0.0,
    stations: int = 41,
) -> HullSolution:
    """Radiation and excitation from even stations, both ends included.

    The trusted band begins where the wave is as long as the ship (longer waves do not see strips) and ends
    where it is eight panels of the largest section long.

    Warns
    -----
    SubmergedPartWarning : a bulb ahead of the stem, or the like.

    Raises
    ------
    ValueError : fewer than five stations, or a section that is not one outline from waterline to keel.
    """
    if stations < 5:
        raise ValueError(f"hull {hull.name!r}: {stations} stations; give 5 or more, 20 to 40 for a ship")
    x = np.linspace(hull.extent[0, 0], hull.extent[1, 0], stations)
    cut = hull.sections(x)
    hanging = 2.0 * float(np.trapezoid([s.apart for s in cut], x)) / hull.hydrostatics.volume
    if hanging > HANGING:
        warn_caller(
            f"hull {hull.name!r}: {100.0 * hanging:.2g} % of the volume hangs apart under water (a bulb "
            "ahead of the stem, a pod) and is left out by strip theory: its added mass and wave force are "
            "missing. Use method='capytaine' to have them",
            SubmergedPartWarning,
        )
    solved = _core.strip_theory(
        x=x,
        sections=[s.section for s in cut],
        omega=omega,
        heading=heading,
        speed=speed,
        rho=rho,
        g=g,
        panels=PANELS,
    )
    girth = max(float(np.hypot(*np.diff(s.section, axis=0).T).sum()) for s in cut)
    waves = np.array([hull.length, PANELS_PER_WAVE * girth / PANELS])
    low, high = np.sqrt(2.0 * np.pi * g / waves).tolist()
    return HullSolution(
        added_mass=solved["added_mass"],
        damping=solved["damping"],
        added_mass_zero=None,
        added_mass_infinite=solved["infinite_frequency_added_mass"],
        force=solved["force"],
        method=f"strip theory, {stations} stations, surge without radiation",
        trusted_band=(low, high),
    )
