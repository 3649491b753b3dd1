"""Wind and current on bodies of a scene, by load coefficients."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.description.damping import AIR
from seacrane.description.description import Description
from seacrane.description.forces import add_load
from seacrane.errors import SceneError
from seacrane.inputs.brief import brief
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.checked import (
    curve_of,
    name_of,
    not_negative_of,
    number_of,
    shaped_of,
    text_of,
    vector_of,
)
from seacrane.inputs.keywords import named
from seacrane.inputs.plausible import direction_of
from seacrane.warnings import DoubleCountedDampingWarning
from seacrane.water.density import SEA_WATER

Array = NDArray[np.float64]
PORT_STARBOARD = np.array([1.0, -1.0, -1.0])  # of x, y, yaw
HORIZONTAL = [0, 1, 5]


@named
@dataclass(frozen=True, kw_only=True, eq=False)
class FlowCoefficients:
    """Load coefficients of wind or current over the angle of the flow relative to the vessel.

    Attributes
    ----------
    angle : ndarray, shape (n,)
        Where the relative flow goes, rad, from the bow (0: from astern) towards port (pi / 2: from
        starboard; pi: from ahead); increasing, at most pi / 2 apart. Angles within 0 to pi only stand for a
        symmetric vessel: port is mirrored to starboard.
    x, y, yaw : ndarray, shape (n,)
        C_x, C_y and C_n: forces forward and to port, moment towards port.

    Raises
    ------
    SceneError
        For shapes that differ, values that are not finite or a symmetric table with y or yaw not zero at 0
        or pi.
    """

    angle: Array
    x: Array
    y: Array
    yaw: Array

    __repr__ = brief

    def __post_init__(self) -> None:
        size = len(vector_of("flow coefficients: angle", self.angle))
        for key in ("angle", "x", "y", "yaw"):
            array = shaped_of(f"flow coefficients: {key}", getattr(self, key), (size,)).copy()
            if not np.all(np.isfinite(array)):
                raise SceneError(f"flow coefficients: {key} holds {array}; give finite numbers")
            array.setflags(write=False)
            object.__setattr__(self, key, array)

    def full_circle(self) -> tuple[Array, Array]:
        """Angles (m,) within [0, 2 pi) and C_x, C_y, C_n there (m, 3); new arrays."""
        angle, rows = np.array(self.angle), np.column_stack([self.x, self.y, self.yaw])
        if angle.size == 0 or angle.min() < -1e-12 or angle.max() > np.pi + 1e-12:
            return angle, rows
        on_axis = (angle < 1e-12) | (angle > np.pi - 1e-12)
        if np.any(rows[on_axis][:, 1:] != 0.0):
            raise SceneError(
                f"flow coefficients: y and yaw are {rows[on_axis][:, 1:].tolist()} along the vessel; they "
                "are zero on a symmetric one, else give angles all round"
            )
        mirrored = np.flatnonzero(~on_axis)[::-1]
        angle = np.concatenate([angle, 2.0 * np.pi - angle[mirrored]])
        return angle, np.concatenate([rows, rows[mirrored] * PORT_STARBOARD])


def add_wind(
    scene: Description,
    coefficients: FlowCoefficients,
    *,
    speed: float | _core.Curve,
    direction_deg: float,
    frontal_area: float,
    lateral_area: float,
    length: float,
    body: str = "vessel",
    point: Any = (0.0, 0.0, 0.0),
    density: float = AIR,
    name: str = "wind",
) -> _core.FlowForce:
    """Add wind on a body by coefficients (DNV-RP-C205; OCIMF, Mooring Equipment Guidelines).

    F_x = density / 2 C_x frontal_area V^2, F_y = density / 2 C_y lateral_area V^2, N = density / 2 C_n
    lateral_area length V^2, V the horizontal wind relative to `point` of the moving body, C at the angle of V
    in axes that follow its yaw. Heel follows from the height of `point`.

    Parameters
    ----------
    speed : float or Curve
        m/s at the height that the coefficients refer to; a curve for gusts, see `gust_curve`.
    direction_deg : float
        Where the wind blows *to*, deg from +x towards +y, as for waves.
    frontal_area, lateral_area, length : float
        m2, m2, m, as the coefficients define them.
    body, name : str
        A scene may hold several, with different names.
    point : array_like, shape (3,)
        Where the load acts, m, body coordinates; N is about it.
    density : float
        kg/m3.

    Raises
    ------
    SceneError
        For wrong values; what only the whole scene shows comes with `Scene.compile`.
    """
    angle, rows = coefficients.full_circle()
    what = f"flow force {name!r}"
    element = _core.FlowForce(
        name=name_of("flow force", name),
        body=text_of(f"{what}: body", body),
        point=shaped_of(f"{what}: point", point, (3,)),
        density=number_of(f"{what}: density", density),
        speed=curve_of(f"{what}: speed", speed),
        direction=float(np.radians(direction_of(f"{what}: direction_deg", direction_deg))),
        frontal_area=number_of(f"{what}: frontal_area", frontal_area),
        lateral_area=number_of(f"{what}: lateral_area", lateral_area),
        length=number_of(f"{what}: length", length),
        angles=angle.tolist(),
        coefficients=rows,
    )
    added: _core.FlowForce = add_load(scene, element)
    return added


def add_current(
    scene: Description,
    coefficients: FlowCoefficients,
    *,
    speed: float | _core.Curve | None = None,
    direction_deg: float | None = None,
    frontal_area: float,
    lateral_area: float,
    length: float,
    body: str = "vessel",
    point: Any = (0.0, 0.0, 0.0),
    density: float = SEA_WATER,
    name: str = "current",
    draught: float = 0.0,
) -> _core.FlowForce:
    """Add current on a vessel by coefficients: `add_wind` with water, areas below the waterline.

    The velocity relative to the water is that of `point`, so the load also damps surge and sway; a turning
    vessel is not slowed (no cross-flow drag along its length). Waves and fluid memory do not see the current.

    In a scene whose sea has a current (`add_sea`), leave out speed and direction: the load takes those of the
    sea, averaged from the surface to the draught, as they are when it is added.

    Parameters
    ----------
    speed, direction_deg
        As of `add_wind`; default: those of the sea's current.
    draught : float
        m, over which the sea's current is averaged; default 0: that at the surface.

    Raises
    ------
    SceneError
        For a speed or direction beside those of the sea, or none at all.

    Warns
    -----
    DoubleCountedDampingWarning
        The vessel has viscous damping in surge, sway or yaw already.
    """
    speed, direction_deg = _flow_of(scene, f"flow force {name!r}", speed, direction_deg, draught)
    element = add_wind(
        scene,
        coefficients=coefficients,
        speed=speed,
        direction_deg=direction_deg,
        frontal_area=frontal_area,
        lateral_area=lateral_area,
        length=length,
        body=body,
        point=point,
        density=density,
        name=name,
    )
    for vessel in scene.vessels.values():
        linear, quadratic = np.diag(vessel.linear_damping), np.asarray(vessel.quadratic_damping)
        if vessel.body == body and np.any(np.abs([*linear[HORIZONTAL], *quadratic[HORIZONTAL]]) > 0.0):
            warn_caller(
                f"flow force {name!r}: vessel {vessel.name!r} has viscous damping in surge, sway or yaw "
                f"(linear {linear[HORIZONTAL].tolist()}, quadratic {quadratic[HORIZONTAL].tolist()}), which "
                "the current load contains too; slow motions are damped twice. Set one of them to zero",
                DoubleCountedDampingWarning,
            )
    return element


def _flow_of(
    scene: Description,
    what: str,
    speed: float | _core.Curve | None,
    direction_deg: float | None,
    draught: float,
) -> tuple[float | _core.Curve, float]:
    """Speed and direction (deg) of a current: the sea's, or in a scene without one those given."""
    of_sea = None if scene.waves is None else scene.waves.current
    if of_sea is None:
        if speed is None or direction_deg is None:
            raise SceneError(f"{what}: has no speed or no direction_deg; give both, or add_sea a current")
        return speed, direction_deg
    if speed is not None or direction_deg is not None:
        raise SceneError(
            f"{what}: the sea has a current, and a scene has one; leave out speed and direction_deg"
        )
    return of_sea.mean(not_negative_of(f"{what}: draught", draught, "m"))
