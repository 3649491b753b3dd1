"""Feed-forward: the loads that hold actuators at rest along their references, as curves of time."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from seacrane import _core
from seacrane.analysis.inverse import actuator_loads, driven
from seacrane.analysis.rest_state import held, rest_states
from seacrane.arrays import Array
from seacrane.description.description import Description
from seacrane.description.waves import calm_water
from seacrane.errors import SceneError
from seacrane.inputs.checked import number_of, vector_of
from seacrane.inputs.shown import shown

SAME_POSE = 9  # decimals of m and rad
AT_REST = 1e-6  # m/s, m/s2, rad/s, rad/s2


def quasi_static_loads(
    scene: Description, *, times: Any, references: Mapping[str, _core.Curve] | None = None
) -> dict[str, Array]:
    """Loads that hold every actuator at rest where its reference is at each time.

    The whole scene is in static equilibrium at each pose, without waves: the vessel with its heel and trim,
    what hangs. Poses that come back are solved once.

    Parameters
    ----------
    times : array_like, shape (n,)
        s, zero or later, increasing.
    references : mapping of str to Curve, optional
        By actuator name, instead of the actuators' own references.

    Returns
    -------
    dict of str to ndarray, shape (n,)
        By actuator name: N (cylinders, positive pushes) or N m.

    Raises
    ------
    SceneError
        If times are not such, or there is no rest state at one of them.
    """
    instants = np.array(vector_of("quasi-static loads: times", times), dtype=float)
    if instants.size == 0 or not np.all(np.isfinite(instants)) or instants[0] < 0.0:
        raise SceneError(f"quasi-static loads: times are {shown(times)}; give finite ones, zero or later")
    if np.any(np.diff(instants) <= 0.0):
        raise SceneError("quasi-static loads: times do not increase; give them in order, each once")
    if not scene.actuators:
        raise SceneError(f"scene {scene.name!r}: has no actuator to hold; add_actuator first")
    out = driven(scene, references=references).copy(waves=calm_water(scene.waves))
    solved = _first_of_each_pose(out, instants)
    found = {
        state.time: actuator_loads(scene, held(out, time=state.time), state)
        for state in rest_states(out, times=np.unique(solved).tolist())
    }
    rows = np.array([found[time] for time in solved.tolist()])
    return {name: rows[:, i].copy() for i, name in enumerate(scene.actuators)}


def _first_of_each_pose(scene: Description, times: Array) -> Array:
    """For each time the first one at which the drivers are where they are then."""
    if scene.force_tables or scene.loads:  # which may change while the pose does not
        return times
    poses = np.stack([driver.curve.evaluate(times)[:, 0] for driver in scene.drivers.values()], axis=1)
    _, first, pose = np.unique(np.round(poses, SAME_POSE), axis=0, return_index=True, return_inverse=True)
    return np.asarray(times[first[pose.ravel()]])


def feed_forward(
    scene: Description,
    *,
    times: Any,
    references: Mapping[str, _core.Curve] | None = None,
    period: float | None = None,
) -> dict[str, _core.Curve]:
    """Quasi-static loads along the references as curves, continuous to their fourth derivative.

    Quintic splines through `quasi_static_loads` at the times given, at rest at both ends and held beyond
    them. As an actuator's `feed_forward` they leave its stiffness nothing to carry at rest, so that it ends
    where its reference ends.

    Parameters
    ----------
    times, references
        As of `quasi_static_loads`: from the start of the first motion to the end of the last one; a dozen for
        one smooth move.
    period : float, optional
        s: references that swing for ever, over the last period of `times` as later. The loads then continue
        as their mean and first harmonic over it, in place of the last value.

    Returns
    -------
    dict of str to Curve
        By actuator name, N or N m. Continuous to the second derivative at both ends.

    Raises
    ------
    SceneError
        As `quasi_static_loads`, or if a reference still moves at the first or the last time.
    """
    loads = quasi_static_loads(scene, times=times, references=references)
    instants = np.asarray(times, dtype=float)
    if instants.size < 2:
        raise SceneError("feed-forward: one time makes no curve; give two or more")
    chosen = {name: actuator.reference for name, actuator in scene.actuators.items()} | dict(references or {})
    for time in instants[[0, -1] if period is None else [0]].tolist():
        for name, curve in chosen.items():
            _, rate, acceleration = curve.evaluate([time])[0]
            if max(abs(rate), abs(acceleration)) > AT_REST:
                raise SceneError(
                    f"feed-forward: reference of actuator {name!r} moves at t = {time:.6g} s (rate "
                    f"{rate:.3g}, acceleration {acceleration:.3g}); give times from rest to rest, or the "
                    "period of a swing"
                )

    def end(load: Array) -> _core.Curve:
        if period is None:
            return _core.Curve.constant(value=float(load[-1]))
        return _first_harmonic(instants, load, period)

    return {name: _joined(instants, load, end(load)) for name, load in loads.items()}


def _first_harmonic(times: Array, load: Array, period: float) -> _core.Curve:
    """Mean and first harmonic over the last period, from the last time on."""
    length = number_of("feed-forward: period", period)
    last = times > times[-1] - length * (1.0 - 1e-9)
    if not (0.0 < length <= times[-1] - times[0]) or np.count_nonzero(last) < 4:
        raise SceneError(
            f"feed-forward: the last period of {length:g} s holds {np.count_nonzero(last)} of the times, "
            f"from {times[0]:g} to {times[-1]:g} s; give four of them or more within it"
        )
    omega = 2.0 * np.pi / length
    angle = omega * (times[last] - times[-1])
    columns = np.column_stack([np.ones_like(angle), np.cos(angle), np.sin(angle)])
    mean, cosine, sine = np.linalg.lstsq(columns, load[last], rcond=None)[0]
    return _core.Curve.harmonic(
        start_time=float(times[-1]), offset=float(mean), amplitude=float(np.hypot(cosine, sine)),
        omega=omega, phase=float(np.arctan2(-sine, cosine)),
    )  # fmt: skip


def _joined(times: Array, load: Array, end: _core.Curve) -> _core.Curve:
    """The spline from rest to a curve that takes over at the last time."""
    from scipy.interpolate import PPoly, make_interp_spline

    value, rate, acceleration = end.evaluate([times[-1]])[0]
    through = np.append(load[:-1], value)
    ends = ([(1, 0.0), (2, 0.0)], [(1, rate), (2, acceleration)])
    pieces = PPoly.from_spline(make_interp_spline(times, through, k=5, bc_type=ends))
    kept = np.diff(pieces.x) > 0.0
    starts, coefficients = pieces.x[:-1][kept].tolist(), pieces.c[::-1].T[kept].tolist()
    curve = _core.Curve.pieces(starts=starts, coefficients=coefficients)
    return curve.then(time=float(times[-1]), curve=end)
