"""Wind, gusts and current on bodies of a scene, by load coefficients."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from seacrane import _core
from seacrane.arrays import Array
from seacrane.crane.parts import BOX_DRAG
from seacrane.description.curves import spline_curve
from seacrane.description.description import Description, require
from seacrane.description.elements import put_load
from seacrane.description.places import ORIGIN
from seacrane.errors import SceneError
from seacrane.hydro.parts.density import SEA_WATER
from seacrane.inputs.brief import brief
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.checked import name_of, not_negative_of, positive_of, shaped_of, vector_of
from seacrane.inputs.keywords import named
from seacrane.inputs.plausible import direction_of
from seacrane.inputs.values import told_by
from seacrane.scene.springs import add_spring
from seacrane.warnings import DoubleCountedDampingWarning

SLOWEST, FASTEST = 1.0 / 600.0, 0.5  # Hz: the spectrum is one of an hour's wind, fitted from 1/600 Hz on
FREQUENCY_STREAM, PHASE_STREAM = 2**32, 2**32 + 1  # of Philox; a sea counts its own up from 0
AIR = 1.226  # kg/m3 at 15 deg C, DNV-RP-C205
KNOTS = 36  # over the circle: a spline through them is a cosine to 3e-6
PORT_STARBOARD = np.array([1.0, -1.0, -1.0])  # of x, y, yaw
HORIZONTAL = [0, 1, 5]


def npd_spectrum(frequency: ArrayLike, *, mean_speed: float, height: float = 10.0) -> Array:
    """Spectrum of the wind speed, m2/s2/Hz, after the Norwegian Petroleum Directorate (ISO 19901-1, A.7).

    S(f) = 320 (U / 10)^2 (z / 10)^0.45 / (1 + g^n)^(5 / (3 n)), g = 172 f (z / 10)^(2/3) (U / 10)^(-3/4),
    n = 0.468, at frequencies f, Hz, with the one-hour mean speed U at 10 m, m/s, and the height z, m.
    """
    f, u, z = np.asarray(frequency, dtype=float), mean_speed / 10.0, height / 10.0
    scaled = 172.0 * f * z ** (2.0 / 3.0) * u**-0.75
    return np.asarray(320.0 * u**2 * z**0.45 / (1.0 + scaled**0.468) ** (5.0 / (3.0 * 0.468)))


def gust_curve(
    *, mean_speed: float, duration: float, height: float = 10.0, seed: int = 1, count: int = 200
) -> _core.Curve:
    """Wind speed over time: the mean and a realisation of the NPD spectrum from 1/600 to 0.5 Hz.

    Parameters
    ----------
    mean_speed : float
        One-hour mean at 10 m height, m/s; at other heights z it is multiplied by
        1 + 0.0573 sqrt(1 + 0.15 U) ln(z / 10).
    duration : float
        s; the curve holds its last speed afterwards.
    height : float
        m.
    seed, count : int
        Of phases and frequencies (one in each of `count` bins of equal ratio), by Philox as for waves, in
        streams of their own: wind and waves of one seed have nothing in common.

    Returns
    -------
    Curve
        m/s, through samples every 0.25 s.

    Raises
    ------
    SceneError
        For values that are not positive.
    """
    given = {"mean_speed": mean_speed, "duration": duration, "height": height, "count": count}
    for key, value in given.items():
        positive_of(f"gust: {key}", value)
    edges = np.geomspace(SLOWEST, FASTEST, count + 1)
    jitter, phase = (
        np.array([_core.philox_uniform(seed=seed, stream=stream, index=i) for i in range(count)])
        for stream in (FREQUENCY_STREAM, PHASE_STREAM)
    )
    frequency = edges[:-1] + jitter * np.diff(edges)
    density = npd_spectrum(frequency, mean_speed=mean_speed, height=height)
    amplitude = np.sqrt(2.0 * density * np.diff(edges))
    times = np.linspace(0.0, duration, max(6, int(np.ceil(4.0 * duration)) + 1))
    local = mean_speed * (1.0 + 0.0573 * np.sqrt(1.0 + 0.15 * mean_speed) * np.log(height / 10.0))
    speed = np.full(times.shape, local)
    for a, f, e in zip(amplitude, frequency, phase, strict=True):
        speed += a * np.cos(2.0 * np.pi * (f * times + e))
    return spline_curve(times=times, values=speed).then(
        time=duration, curve=_core.Curve.constant(value=float(speed[-1]))
    )


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
                raise SceneError.of(f"flow coefficients: {key}", f"holds {array}; give finite numbers")
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


@told_by(_core.FlowForce)
def add_wind(
    scene: Description, coefficients: FlowCoefficients | None = None, *, frontal_area: float,
    lateral_area: float, drag_coefficient: float | None = None, length: float | None = None,
    speed: float | _core.Curve | None = None, direction_deg: float | None = None, body: str = "vessel",
    point: Any = None, density: float = AIR, name: str | None = None,
) -> _core.FlowForce:  # fmt: skip
    """Add wind on a body by coefficients (DNV-RP-C205; OCIMF, Mooring Equipment Guidelines), or one of drag.

    F_x = density / 2 C_x frontal_area V^2, F_y = density / 2 C_y lateral_area V^2, N = density / 2 C_n
    lateral_area length V^2, V the horizontal wind relative to `point` of the moving body, C at the angle of V
    in axes that follow its yaw. Heel follows from the height of `point`.

    Without coefficients it is density / 2 drag_coefficient |V| (frontal_area V_x, lateral_area V_y): the drag
    of the air on a body that moves through it, still air by default. Vertical motion has none.

    Parameters
    ----------
    frontal_area, lateral_area : float
        m2, as the coefficients define them; else seen along the body's x axis and along its y axis.
    drag_coefficient : float
        In the place of coefficients; 0 is no drag. Default 1.05: a cube with a face to the flow (Hoerner
        1965).
    length : float
        m, as the coefficients define it. They need it, a speed and a direction.
    speed : float or Curve
        m/s at the height that the coefficients refer to; a curve for gusts, see `gust_curve`.
    direction_deg : float
        Where the wind blows *to*, deg from +x towards +y, as for waves.
    point : array_like, shape (3,)
        Where the load acts, m, body coordinates; N is about it. Default: the origin; of a drag the centre of
        mass.
    name : str
        Default: "wind"; of a drag the body's and " drag".

    Raises
    ------
    SceneError
        For wrong values; what only the whole scene shows comes with `Scene.compile`.
    """
    label = name_of("flow force", name, f"{body} drag" if coefficients is None else "wind")
    what = f"flow force {label!r}"
    if coefficients is None:
        dragged = scene.bodies[require(scene, what, "body", body)]
        point = dragged.center_of_mass if point is None else point
        coefficient = BOX_DRAG if drag_coefficient is None else drag_coefficient
        coefficient = not_negative_of(f"{what}: drag_coefficient", coefficient)
        angle = np.linspace(0.0, 2.0 * np.pi, KNOTS, endpoint=False)
        rows = coefficient * np.column_stack([np.cos(angle), np.sin(angle), np.zeros(KNOTS)])
    elif drag_coefficient is not None or None in (length, speed, direction_deg):
        raise SceneError(
            f"{what}: has coefficients; give their length, speed and direction_deg, and no drag_coefficient"
        )
    else:
        angle, rows = coefficients.full_circle()
    way = direction_of(f"{what}: direction_deg", direction_deg or 0.0)
    element = _core.FlowForce(
        name=label, body=body, point=ORIGIN if point is None else point, density=density,
        speed=0.0 if speed is None else speed, direction=float(np.radians(way)), frontal_area=frontal_area,
        lateral_area=lateral_area, length=length or 0.0, angles=angle.tolist(), coefficients=rows,
    )  # fmt: skip
    return put_load(scene, element)


def add_current(
    scene: Description, coefficients: FlowCoefficients, *, speed: float | _core.Curve | None = None,
    direction_deg: float | None = None, frontal_area: float, lateral_area: float, length: float,
    body: str = "vessel", point: Any = (0.0, 0.0, 0.0), density: float = SEA_WATER, name: str = "current",
    draught: float = 0.0,
) -> _core.FlowForce:  # fmt: skip
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
    given: dict[str, Any] = {key: one for key, one in locals().items() if key != "draught"}
    given["speed"], given["direction_deg"] = _flow_of(
        scene, f"flow force {name!r}", speed, direction_deg, draught
    )
    element = add_wind(**given)
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
    scene: Description, what: str, speed: float | _core.Curve | None, direction_deg: float | None,
    draught: float,
) -> tuple[float | _core.Curve, float]:  # fmt: skip
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


def damp_load(
    scene: Description, body: str, size: Any, tip: tuple[str, Any], *, ratio: float, drag: float
) -> None:
    """The small damping of a box that hangs below a tip, body and point: of its swing, and drag of air."""
    if ratio > 0.0:
        add_spring(scene, f"{body} swing", first=tip[0], first_point=tip[1], second=body, damping_ratio=ratio)
    x, y, z = map(float, size)
    if drag > 0.0 and max(x, y, z) > 0.0:
        add_wind(scene, body=body, frontal_area=y * z, lateral_area=x * z, drag_coefficient=drag)
