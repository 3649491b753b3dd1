"""What acts on a vessel beside first-order waves at its mean position: drift, wind, current."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.description.scene import Scene
from seacrane.description.waves import ByHeading, Waves
from seacrane.errors import SceneError
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.checked import curve_of, name_of, number_of, shaped_of, text_of, vector_of
from seacrane.inputs.plausible import direction_of

if TYPE_CHECKING:
    from seacrane.hydro import HydroDatabase

Array = NDArray[np.float64]
AIR = 1.226  # kg/m3 at 15 deg C, DNV-RP-C205
SEA_WATER = 1025.0  # kg/m3
PORT_STARBOARD = np.array([1.0, -1.0, -1.0])  # of x, y, yaw
HORIZONTAL = [0, 1, 5]
SLOW_SHARE = 0.2  # of the peak frequency: motions below are slow
LEAST_DIFFERENCE = 0.01  # of a wavenumber, between the depths of a sea and of a database


class DoubleCountedDampingWarning(UserWarning):
    """Current coefficients and damping of the vessel both slow its drift: its motions come out too small."""


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
    scene: Scene,
    *,
    coefficients: FlowCoefficients,
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
    scene : Scene
    coefficients : FlowCoefficients
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

    Returns
    -------
    FlowForce

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
    added: _core.FlowForce = scene.add_load(element)
    return added


def add_current(
    scene: Scene,
    *,
    coefficients: FlowCoefficients,
    speed: float | _core.Curve,
    direction_deg: float,
    frontal_area: float,
    lateral_area: float,
    length: float,
    body: str = "vessel",
    point: Any = (0.0, 0.0, 0.0),
    density: float = SEA_WATER,
    name: str = "current",
) -> _core.FlowForce:
    """Add current on a vessel by coefficients: `add_wind` with water, areas below the waterline.

    The velocity relative to the water is that of `point`, so the load also damps surge and sway; a turning
    vessel is not slowed (no cross-flow drag along its length). Waves and fluid memory do not see the current.

    Warns
    -----
    DoubleCountedDampingWarning
        The vessel has viscous damping in surge, sway or yaw already.
    """
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


def use_actual_position(scene: Scene, database: HydroDatabase, *, vessel: str | None = None) -> None:
    """Take wave loads at the vessel's position and heading of the moment instead of the mean ones.

    Phases follow the vessel (a moving one meets the encounter frequency), and force RAOs its heading
    relative to the waves, by the same splines as `HydroDatabase.force_at`. All components are summed in every
    evaluation. Call it after `add_sea`.

    Parameters
    ----------
    scene : Scene
    database : HydroDatabase
    vessel : str, optional
        Body of the vessel; default: the only one in the sea.

    Raises
    ------
    SceneError
        Without a sea, for a vessel that is not in it, for a database of another depth, or if its headings do
        not cover the circle.
    """
    scene.waves = _with_headings(_sea_of(scene, "loads at the actual position"), database, vessel, cutoff=0.0)
    scene.notes.update(wave_phase="actual")


def use_slow_position(
    scene: Scene, database: HydroDatabase, *, vessel: str | None = None, cutoff: float | None = None
) -> None:
    """Take wave loads at the slow part of the vessel's position and heading.

    First-order loads belong to the position about which a hull oscillates: at that of the moment its motion
    in the waves is counted a second time. The fast part of surge, sway and yaw, that above the cut-off, is
    kept as nine states of the vessel: each motion through the high-pass filter
    s^2 (s + 2 w) / (s^3 + 2 w s^2 + 2 w^2 s + w^3), w the cut-off, from zero at the start. What is left
    follows a steady drift without lag, and keeps 2 (w / omega)^2 of a motion at omega far above w. Otherwise
    as `use_actual_position`, at the same cost. Call it after `add_sea`.

    Parameters
    ----------
    scene : Scene
    database : HydroDatabase
    vessel : str, optional
        Body of the vessel; default: the only one in the sea.
    cutoff : float
        rad/s, between slow drift and waves; default: a fifth of the frequency at the sea's peak.

    Raises
    ------
    SceneError
        As `use_actual_position`, or for a cut-off that is not positive.
    """
    from seacrane.validity.hull_range import peak_frequency

    waves = _sea_of(scene, "loads at the slow position")
    cutoff = SLOW_SHARE * peak_frequency(waves) if cutoff is None else number_of("sea: cutoff", cutoff)
    if not (np.isfinite(cutoff) and cutoff > 0.0):
        raise SceneError(f"sea: cutoff is {cutoff} rad/s; give a frequency between slow drift and waves")
    scene.waves = _with_headings(waves, database, vessel, cutoff=cutoff)
    scene.notes.update(wave_phase="slow")


def _with_headings(waves: Waves, database: HydroDatabase, vessel: str | None, *, cutoff: float) -> Waves:
    """The sea with loads of all headings on a vessel."""
    force, drift = force_by_heading(database, waves.omega), None
    if waves.hull(vessel).drift is not None:
        drift = _drift_by_heading(database, waves.omega, "hold")  # add_drift has judged the range
    require_depth(waves, database, waves.body_of(vessel))
    return waves.changed(vessel, force_by_heading=force, drift_by_heading=drift, cutoff=cutoff)


def force_by_heading(database: HydroDatabase, omega: Array) -> ByHeading:
    """Force RAOs at some frequencies for all headings of the database.

    Parameters
    ----------
    database : HydroDatabase
    omega : ndarray, shape (n,)
        rad/s; beyond the database's as `HydroDatabase.force_at` with ``outside="limits"``.

    Returns
    -------
    ByHeading
        N/m and N m/m.

    Raises
    ------
    SceneError
        If the headings do not cover the circle.
    """
    from seacrane.hydro.data.excitation import with_limits
    from seacrane.hydro.data.interpolation import spline_weights

    heading, table = database.full_circle()
    if np.diff(np.append(heading, heading[0] + 2.0 * np.pi)).max() > np.pi / 4.0 + 1e-9:
        raise SceneError(
            f"database {database.name!r}: headings {np.degrees(heading).round(3).tolist()} deg leave gaps "
            "above 45 deg; a vessel that turns needs them all round"
        )
    weights = spline_weights(database.omega, np.clip(omega, database.omega[0], database.omega[-1]))
    values = np.stack([weights @ at_heading for at_heading in table])
    return ByHeading(heading=heading, values=with_limits(database, omega, values))


def add_drift(
    scene: Scene,
    database: HydroDatabase,
    *,
    vessel: str | None = None,
    outside: Literal["error", "hold"] = "error",
) -> None:
    """Add the slowly varying wave drift load from mean drift coefficients, by Newman's approximation.

    F(t) = sum_ik a_i a_k (D_i + D_k) / 2 cos(theta_i - theta_k) with the coefficients D of the database at
    each component's frequency and heading: difference frequencies only, mean sum a^2 D. Good for the slow
    motions of a moored vessel; it leaves out the second-order potential (which matters in shallow water) and
    the change of drift with the vessel's speed (wave drift damping). Call it after `add_sea`.

    Parameters
    ----------
    scene : Scene
    database : HydroDatabase
        With `drift`.
    vessel : str, optional
        Body of the vessel; default: the only one in the sea.
    outside : str
        "error", or "hold": components beyond the frequencies of the coefficients take those of the nearest.

    Raises
    ------
    SceneError
        Without a sea or without drift coefficients, for a vessel that is not in the sea, for a database of
        another depth, or for components outside the coefficients' frequencies or in a gap of more than 45 deg
        between headings.
    """
    waves = _sea_of(scene, "drift")
    hull, by_heading = waves.hull(vessel), None
    if hull.force_by_heading is not None:
        by_heading = _drift_by_heading(database, waves.omega, outside)
    drift = _drift_at(database, waves.omega, waves.direction - hull.heading, outside)
    require_depth(waves, database, waves.body_of(vessel))
    scene.waves = waves.changed(vessel, drift=drift, drift_by_heading=by_heading)
    scene.notes.update(drift="newman")


def require_depth(waves: Waves, database: HydroDatabase, vessel: str) -> None:
    """Refuse a database computed at a depth where the waves of a sea have another length than in that sea."""
    from seacrane.sea.dispersion import wavenumber

    there, computed = (
        wavenumber(waves.omega, g=database.g, depth=depth) for depth in (waves.depth, database.depth)
    )
    difference = float(np.max(np.abs(there / computed - 1.0)))
    if difference > LEAST_DIFFERENCE:
        raise SceneError(
            f"sea of vessel {vessel!r}: it is {waves.depth:g} m deep, the forces of database "
            f"{database.name!r} are for {database.depth:g} m, and wavenumbers differ by up to "
            f"{difference:.0%}; take SeaState(depth={database.depth:g}), or a database of the sea's depth"
        )


def _sea_of(scene: Scene, what: str) -> Waves:
    if scene.waves is None:
        raise SceneError(f"scene {scene.name!r}: {what} needs a sea; call add_sea first")
    return scene.waves


def _circle_of(database: HydroDatabase, omega: Array, outside: str) -> tuple[Array, Array]:
    """Headings all round (m,) and the coefficients there at the frequencies asked for (m, n, 6)."""
    from seacrane.hydro.data.heading_circle import PORT_STARBOARD as SIGNS
    from seacrane.hydro.data.interpolation import spline_weights

    drift = getattr(database, "drift", None)
    if drift is None:
        raise SceneError(f"database {database.name!r}: has no drift coefficients; read a set that holds them")
    low, high = drift.omega[0] * (1.0 - 1e-9), drift.omega[-1] * (1.0 + 1e-9)
    beyond = omega[(omega < low) | (omega > high)]
    if outside not in ("error", "hold"):
        raise SceneError(f"drift: outside is {outside!r}; choose 'error' or 'hold'")
    if outside == "error" and beyond.size:
        raise SceneError(
            f"database {database.name!r}: omega = {beyond[0]:.6g} rad/s is outside the drift coefficients' "
            f"{drift.omega[0]:.6g} to {drift.omega[-1]:.6g} rad/s; narrow the sea's band, or pass "
            "outside='hold' to add_drift"
        )
    weights = spline_weights(drift.omega, np.clip(omega, drift.omega[0], drift.omega[-1]))
    heading, values = drift.heading, np.einsum("qn,mnd->mqd", weights, drift.coefficient)
    if database.port_starboard_symmetric:
        mirrored = np.mod(-heading, 2.0 * np.pi)
        new = np.abs(np.angle(np.exp(1j * (mirrored[:, None] - heading)))).min(axis=1) > 1e-6
        heading = np.concatenate([heading, mirrored[new]])
        values = np.concatenate([values, values[new] * SIGNS])
    order = np.argsort(heading)
    return heading[order], values[order]


def _drift_by_heading(database: HydroDatabase, omega: Array, outside: str) -> ByHeading:
    heading, values = _circle_of(database, omega, outside)
    return ByHeading(heading=heading, values=values)


def _drift_at(database: HydroDatabase, omega: Array, direction: Array, outside: str) -> Array:
    """Coefficients of every component, shape (n, 6)."""
    from seacrane.hydro.data.interpolation import spline_weights

    heading, values = _circle_of(database, omega, outside)
    distance = np.abs(np.angle(np.exp(1j * (direction[:, None] - heading))))
    if np.diff(np.append(heading, heading[0] + 2.0 * np.pi)).max() <= np.pi / 4.0 + 1e-9:
        weights = spline_weights(heading, direction, period=2.0 * np.pi)
    elif np.all(distance.min(axis=1) < 1e-6):
        weights = np.eye(len(heading))[distance.argmin(axis=1)]
    else:
        raise SceneError(
            f"database {database.name!r}: drift coefficients at headings "
            f"{np.degrees(heading).round(3).tolist()} deg say nothing about all directions of this sea; gaps "
            "above 45 deg are not interpolated"
        )
    return np.asarray(np.einsum("nm,mnd->nd", weights, values))
