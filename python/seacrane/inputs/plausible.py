"""What a value most likely did not mean: each a warning by name, when it is given."""

from __future__ import annotations

import numpy as np

from seacrane.inputs.caller import warn_caller
from seacrane.inputs.checked import number_of
from seacrane.warnings import AngleUnitWarning, CompassDirectionWarning, DepthSignWarning, MassUnitWarning

TURN = 2.0 * np.pi
ROUND = np.radians(5.0)  # angles in a script are multiples of it
WHOLE = np.radians(1.0)  # and amplitudes of this
EXACT = 1e-9
COMPASS = 270.0  # deg: from here on a direction is rather a bearing; ours would be -90 to 0
LIGHTEST = 5.0  # kg/m3 of a payload's box; polystyrene has 10
HEAVIEST = 2.3e4  # kg/m3: osmium


def angle_of(what: str, value: float) -> float:
    """An angle in radians; warns where it is more than a turn."""
    if abs(value) > TURN:
        warn_caller(
            f"{what} is {value:.6g} rad, {abs(value) / TURN:.3g} turns; angles are radians: if these are "
            f"degrees, give numpy.radians({value:.6g})",
            AngleUnitWarning,
        )
    return value


def direction_of(what: str, value: float) -> float:
    """A direction in degrees; warns where it looks like radians, or like a compass bearing."""
    degrees = number_of(what, value)
    _warn_of_radians(what, degrees, ROUND)
    if COMPASS <= degrees < 360.0:
        warn_caller(
            f"{what} is {degrees:.6g} deg: where it goes to, from +x (forward) towards +y (port), which is "
            f"usually written {degrees - 360.0:.6g}. If it is a compass bearing from where it comes, give "
            "heading - bearing + 180, with the compass heading of +x",
            CompassDirectionWarning,
        )
    return degrees


def swing_of(what: str, value: float) -> float:
    """An amplitude in degrees; warns where it is a whole degree when read in radians."""
    degrees = number_of(what, value)
    _warn_of_radians(what, degrees, WHOLE)
    return degrees


def _warn_of_radians(what: str, degrees: float, step: float) -> None:
    """Warn of degrees that are a multiple of ``step`` (rad) when read in radians."""
    if 0.0 < abs(degrees) <= TURN and abs(degrees / step - round(degrees / step)) < EXACT:
        warn_caller(
            f"{what} is {degrees:.6g} deg, which is {np.degrees(degrees):.6g} deg in radians; names that end "
            f"in _deg take degrees: give {np.degrees(degrees):.6g}",
            AngleUnitWarning,
        )


def warn_of_air(lowest: float, crest: float) -> None:
    """Warn that the lowest point asked for is above the highest crest a sea can have, m."""
    warn_caller(
        f"wave kinematics: all points are above any wave, the lowest at z = {lowest:.6g} m, crests reach "
        f"{crest:.4g} m at most: all is air there. z points up: a depth of {lowest:.6g} m is z = "
        f"{-lowest:.6g}",
        DepthSignWarning,
    )


def warn_of_density(what: str, mass: float, volume: float) -> None:
    """Warn of a box lighter than foam, or heavier than any metal."""
    if mass > HEAVIEST * volume:
        warn_caller(
            f"{what}: mass is {mass:.6g} kg in {volume:.4g} m3, heavier than any metal; masses are kilograms "
            "and sizes metres: correct one of them",
            MassUnitWarning,
        )
    if mass < LIGHTEST * volume:
        warn_caller(
            f"{what}: mass is {mass:.6g} kg in {volume:.4g} m3, lighter than foam; masses are kilograms: if "
            f"these are tonnes, give {mass * 1e3:.6g}",
            MassUnitWarning,
        )
