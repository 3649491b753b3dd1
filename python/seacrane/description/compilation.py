"""A description compiled into the core's model, and what closing its joints changed of it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.description.description import SETTINGS, Description
from seacrane.description.holding import with_holds
from seacrane.description.loads import lines_of, refuse_winch_of_segment
from seacrane.description.once import forgetting, once
from seacrane.description.places import start_pose
from seacrane.description.rungs import compiled_loads
from seacrane.description.waves import ByHeading, HullLoads, Waves, grid_of
from seacrane.description.wet_parts import (
    refuse_contradictions_in_water,
    refuse_outside_parts,
    refuse_unsaid_air,
)
from seacrane.errors import SceneError
from seacrane.inputs.caller import silently, warn_caller
from seacrane.inputs.checked import name_of, number_of, text_of
from seacrane.inputs.frames import rotation_matrix
from seacrane.warnings import AssemblyWarning, RedundantJointsWarning

Array = NDArray[np.float64]
LARGEST_MOVE = 0.01  # m times the scene's length scale: a tenth of the length that tolerances refer to
MOST_MOVE = 1.0  # m: however large the scale
LARGEST_TURN = 0.01  # rad: the angle that they refer to
LARGEST_SHARE = 0.01  # of a velocity that was described
NAMED = 3
Complex = NDArray[np.complex128]


def moves(scene: Description, model: _core.Model) -> list[tuple[str, float, float]]:
    """Bodies that assembly moved beyond 0.01 m (times the length scale) or 0.01 rad, most first.

    Returns
    -------
    list of (str, float, float)
        Name, m of the centre of mass (of the reference point of a vessel), rad.
    """
    found = model.assembly
    limit = min(LARGEST_MOVE * scene.length_scale, MOST_MOVE)
    if found["largest_translation_m"] <= limit and found["largest_rotation_rad"] <= LARGEST_TURN:
        return []
    out = []
    for name, body in scene.bodies.items():
        described = rotation_matrix(body.quaternion)
        centre, turn = start_pose(scene, model, name)
        moved = float(np.linalg.norm(centre[0] - body.position - described @ body.center_of_mass))
        turned = float(np.arccos(np.clip((np.trace(turn[0] @ described.T) - 1.0) / 2.0, -1.0, 1.0)))
        if moved > limit or turned > LARGEST_TURN:
            out.append((name, moved, turned))
    return sorted(out, key=lambda move: -max(move[1] / limit, move[2] / LARGEST_TURN))


def velocities(scene: Description, model: _core.Model) -> list[tuple[str, float, float]]:
    """Bodies described as moving whose velocity assembly changed by more than a hundredth of it.

    Returns
    -------
    list of (str, float, float)
        Name, and by how much: m/s of its origin, rad/s.
    """
    if model.assembly["largest_velocity_change"] == 0.0:
        return []
    out = []
    twists = np.asarray(model.initial_state)[model.twist_index(0) :][: 6 * len(scene.bodies)].reshape(-1, 6)
    floating = {vessel.body for vessel in scene.vessels.values()}
    for (name, body), twist in zip(scene.bodies.items(), twists, strict=True):
        lever = np.zeros(3) if name in floating else rotation_matrix(body.quaternion) @ body.center_of_mass
        speed, turning = _length(body.velocity), _length(body.angular_velocity)
        slower = _length(twist[:3] - np.cross(twist[3:], lever) - body.velocity)
        turned = _length(twist[3:] - body.angular_velocity)
        arm = 1.0 if turning == 0.0 else max(speed / turning, 1.0)
        if slower + arm * turned > LARGEST_SHARE * (speed + arm * turning) and speed + turning > 0.0:
            out.append((name, slower, turned))
    return out


def _length(vector: Array) -> float:
    return float(np.linalg.norm(vector))


def warn_of_moves(scene: Description, model: _core.Model) -> None:
    """Warn, at the user's line, of what `moves` and `velocities` find."""
    moved, changed = moves(scene, model), velocities(scene, model)
    if moved:
        named = [f"body {name!r} by {m:.4g} m and {rad:.4g} rad" for name, m, rad in moved]
        opened = [f"{name!r} by {gap:.4g}" for name, gap in model.assembly["open"]]
        warn_caller(
            f"scene {scene.name!r}: closing its joints moved {_few(named)} from where they are described; as "
            f"described these are open, m or rad: {_few(opened)}. Describe the bodies where they start, or "
            "let drivers start at the described pose (0 for a joint given by point and axis)",
            AssemblyWarning,
        )
    if changed:
        named = [f"body {name!r} by {v:.4g} m/s and {w:.4g} rad/s" for name, v, w in changed]
        warn_caller(
            f"scene {scene.name!r}: its joints do not allow the described velocities: {_few(named)} changed; "
            "give every body that moves along its velocity and angular velocity",
            AssemblyWarning,
        )


def _few(items: list[str]) -> str:
    more = len(items) - NAMED
    return ", ".join(items[:NAMED]) + (f" and {more} more" if more > 0 else "")


def without_negligible(waves: Waves) -> Waves:
    """The same sea without its smallest components.

    Components are left out, smallest first, while the magnitudes of all that are left out stay below
    `waves.negligible` times the sum of the magnitudes of all, in each of the six loads on every vessel, in
    the elevation and in the slow drift. The first two can then never differ by more, at any time; slow drift,
    a product of two sums, to first order. At least one component stays, and all do in a series made by FFT,
    which costs the same with fewer.

    Raises ValueError if `negligible` is no number from 0 to 0.1.
    """
    kept = kept_components(waves)
    if kept.all():
        return waves

    def some(table: ByHeading | None) -> ByHeading | None:
        return None if table is None else replace(table, values=np.asarray(table.values)[:, kept])

    def fewer(hull: HullLoads) -> HullLoads:
        return replace(
            hull, transfer=np.asarray(hull.transfer)[kept], force_by_heading=some(hull.force_by_heading),
            drift=None if hull.drift is None else np.asarray(hull.drift)[kept],
            drift_by_heading=some(hull.drift_by_heading),
        )  # fmt: skip

    return replace(
        waves, omega=np.asarray(waves.omega)[kept], amplitude=np.asarray(waves.amplitude)[kept],
        phase=np.asarray(waves.phase)[kept], direction=np.asarray(waves.direction)[kept],
        hulls={body: fewer(hull) for body, hull in waves.hulls.items()},
    )  # fmt: skip


def kept_components(waves: Waves) -> NDArray[np.bool_]:
    """Which components `without_negligible` keeps; all of them where one is not finite."""
    limit = number_of("negligible", waves.negligible)
    if not 0.0 <= limit <= 0.1:
        raise ValueError(f"negligible is {limit}; give a share from 0 to 0.1, such as 1e-9")
    kept = np.ones(np.size(waves.omega), dtype=bool)
    if waves.evaluation == "fft":
        return kept
    magnitudes = _magnitudes(waves)
    if len(magnitudes) < 2 or not np.isfinite(magnitudes).all():
        return kept
    whole = magnitudes.sum(axis=0)
    share = np.divide(magnitudes, whole, out=np.zeros_like(magnitudes), where=whole > 0.0)
    order = np.argsort(share.max(axis=1), kind="stable")
    left_out = np.cumsum(share[order], axis=0).max(axis=1)
    kept[order[: min(np.searchsorted(left_out, limit, side="right"), len(order) - 1)]] = False
    return kept


def _magnitudes(waves: Waves) -> Array:
    """What each component adds at most, (n, channels)."""
    amplitude = np.abs(np.asarray(waves.amplitude, dtype=float))[:, None]
    return np.hstack(
        [amplitude, *(part for hull in waves.hulls.values() for part in _loads(amplitude, hull))]
    )


def _loads(amplitude: Array, hull: HullLoads) -> list[Array]:
    columns = [amplitude * np.abs(np.asarray(hull.transfer))]
    # Slow drift multiplies two sums of sqrt(D) a: leaving out a share of one changes it by twice that share.
    if hull.drift is not None:
        columns.append(2.0 * amplitude * np.sqrt(np.abs(np.asarray(hull.drift))))
    if hull.force_by_heading is not None:
        columns.append(amplitude * np.abs(np.asarray(hull.force_by_heading.values)).max(axis=0))
    if hull.drift_by_heading is not None:
        columns.append(
            2.0 * amplitude * np.sqrt(np.abs(np.asarray(hull.drift_by_heading.values)).max(axis=0))
        )
    return columns


def compile_scene(scene: Description, *, merge: bool = True) -> _core.Model:
    """What `Scene.compile` does, without its look at what capsizes; its docstring says what is raised."""
    whole_period = scene.waves is not None and scene.waves.evaluation == "fft"  # tables of many megabytes
    return _compiled(scene, merge) if whole_period else _compiled_once(scene, merge)


def _compiled(scene: Description, merge: bool) -> _core.Model:
    scene = with_holds(scene)
    refuse_unsaid_air(scene)
    sea = None if scene.waves is None else pruned(scene.waves, prune=merge)
    for line in lines_of(scene.loads).values():
        if line.winch and not line.paid_out_by:
            refuse_winch_of_segment(line)
    settings: dict[str, Any] = {"wave_loads": []}
    for key in SETTINGS:
        settings[key] = number_of(f"scene {scene.name!r}: {key}", getattr(scene, key))
    if sea is not None:
        settings |= {"wave_loads": compiled_waves(sea), "sea": field_of(sea)}
    model = _core.compile(
        name=name_of("scene", scene.name),
        orientation=text_of(f"scene {scene.name!r}: orientation", scene.orientation), **settings,
        bodies=list(scene.bodies.values()), joints=list(scene.joints.values()),
        drivers=list(scene.drivers.values()), loads=compiled_loads(scene.all_loads()),
        vessels=list(scene.vessels.values()), groups=list(scene.groups.values()),
        coordinates=[(name, *place) for name, place in scene.recorded.items()],
        points=list(scene.points.values()), merge=merge,
    )  # fmt: skip
    refuse_contradictions_in_water(scene)
    refuse_outside_parts(scene)
    warn_of_moves(scene, model)
    if model.redundant:
        warn_caller(
            f"scene {scene.name!r}: constraints of {', '.join(model.redundant)} are redundant "
            f"({model.constraints - model.assembly['rank']} more than needed); motion is unique, these "
            "reactions are not: the minimum-norm ones are given",
            RedundantJointsWarning,
        )
    model.compiled_from = (forgetting(scene.copy()), merge)
    return model


_compiled_once = once(_compiled)


def compiled_in_sea(scene: Description, model: _core.Model) -> _core.Model:
    """The model of a scene, from that of the same scene in another sea: nothing but the sea is compiled.

    The scene belongs to the model from now on: it is not to be changed.

    Raises SceneError for a sea on other vessels than the model's, loads at another kind of position, or a sea
    of another depth than a seabed.
    """
    assert scene.waves is not None
    _, merge = model.compiled_from
    sea = pruned(scene.waves, prune=merge)
    out = model.in_sea(compiled_waves(sea), sea=field_of(sea))
    refuse_contradictions_in_water(scene)
    out.compiled_from = (scene, merge)
    return out


def compiled(scene: Description, merge: bool) -> _core.Model:
    """The model of a scene: how a pickled model comes back."""
    with silently():  # given when it was compiled first
        return compile_scene(scene, merge=merge)


def pruned(waves: Waves, *, prune: bool = True) -> Waves:
    """The sea without the components that are negligible; raises SceneError for values that make no sense."""
    with _told_of(f"waves on {_hulls_of(waves)}"):
        return without_negligible(waves) if prune else waves


@contextmanager
def _told_of(what: str) -> Iterator[None]:
    """Values that make no sense are a SceneError about the waves."""
    try:
        yield
    except (TypeError, ValueError) as error:
        raise SceneError(f"{what}: {error}") from error


def _hulls_of(waves: Waves) -> str:
    return ", ".join(map(repr, waves.hulls)) or "no vessel"


def field_of(waves: Waves) -> _core.SeaField:
    """What moving points see of a sea; raises SceneError for values that make no sense."""
    with _told_of(f"waves on {_hulls_of(waves)}"):
        return waves.field()


def compiled_waves(waves: Waves) -> list[_core.WaveLoads]:
    """The loads for the compiled core; raises SceneError for shapes or values that make no sense."""
    return [_loads_on(waves, text_of("waves: body", body)) for body in waves.hulls]


def _loads_on(waves: Waves, body: str) -> _core.WaveLoads:
    hull = waves.hulls[body]
    with _told_of(f"waves on {body!r}"):
        loads = _mean(waves, hull) if hull.force_by_heading is None else _positioned(waves, hull)
        return _core.WaveLoads(name=f"waves on {body}", body=body, **loads)


def _positioned(waves: Waves, hull: HullLoads) -> dict[str, Any]:
    force, drift = hull.force_by_heading, hull.drift_by_heading
    if force is None or (hull.drift is not None and drift is None):
        raise ValueError("drift at the actual position needs drift_by_heading")
    if waves.evaluation == "fft":
        raise ValueError("loads at the actual or slow position have no table; choose evaluation='exact'")
    slow: dict[str, Any] = {}
    if drift is not None:
        slow = {"drift_headings": np.asarray(drift.heading).tolist(), "drift": drift.values}
    positioned = _core.PositionedWaveLoad(
        waves.components(), headings=np.asarray(force.heading).tolist(), transfer=force.values,
        cutoff=hull.cutoff, **slow,
    )  # fmt: skip
    return {"positioned": positioned}


def _mean(waves: Waves, hull: HullLoads) -> dict[str, Any]:
    sea, position = waves.components(), hull.position
    loads: dict[str, Any] = {
        "exact": _core.ExactWaveLoad(sea, transfer=hull.transfer, position=position, elevation_point=position)
    }
    if hull.drift is not None:
        loads["drift"] = _core.DriftLoad(sea, coefficient=hull.drift, position=position)
    if waves.evaluation == "exact":
        return loads
    bound = waves.relative_bound
    if waves.evaluation == "fft":
        loads["table"] = wave_table(waves, hull, loads["exact"])
        if hull.drift is not None:
            loads["drift_table"] = drift_table(waves, hull, loads["drift"])
        return loads
    loads["table"] = _core.WaveTable(loads["exact"], relative_bound=bound)
    if hull.drift is not None:
        loads["drift_table"] = _core.DriftTable(loads["drift"], relative_bound=bound)
    return loads


def wave_table(waves: Waves, hull: HullLoads, load: _core.ExactWaveLoad) -> _core.WaveTable:
    """The first-order load's table over one period, within `waves.relative_bound`."""
    step, number = grid_of(np.asarray(waves.omega, dtype=float))
    count = _knot_count(step, number, _core.WaveTable.largest_step(load, relative_bound=waves.relative_bound))
    transfer = np.asarray(hull.transfer, dtype=complex)
    weight = np.column_stack([transfer, np.ones(len(number))]) * _phasors(hull, load)[:, None]
    knots = np.empty((count, 3, 7))
    for order in range(3):
        spectrum = np.zeros((count // 2 + 1, 7), dtype=complex)
        factor = (1j * step * number[:, None]) ** order
        np.add.at(spectrum, number, 0.5 * count * factor * weight)
        knots[:, order] = np.fft.irfft(spectrum, n=count, axis=0)
    return _core.WaveTable(load, relative_bound=waves.relative_bound, period=2.0 * np.pi / step, knots=knots)


def drift_table(waves: Waves, hull: HullLoads, load: _core.DriftLoad) -> _core.DriftTable:
    """The slow drift's table over one period: products of its envelopes' series and their derivatives."""
    step, number = grid_of(np.asarray(waves.omega, dtype=float))
    count = _knot_count(
        step, number, _core.DriftTable.largest_step(load, relative_bound=waves.relative_bound)
    )
    coefficient = np.asarray(hull.drift, dtype=float)
    weight = np.column_stack([coefficient, np.ones(len(number))]) * _phasors(hull, load)[:, None]
    series = []
    for order in range(3):
        spectrum = np.zeros((count, 7), dtype=complex)
        np.add.at(spectrum, number, count * (1j * step * number[:, None]) ** order * weight)
        series.append(np.fft.ifft(spectrum, axis=0))

    def product(a: int, b: int) -> Array:
        return np.asarray((series[a][:, 6:].conj() * series[b][:, :6]).real)

    knots = np.stack(
        [product(0, 0), product(1, 0) + product(0, 1), product(2, 0) + 2.0 * product(1, 1) + product(0, 2)],
        axis=1,
    )
    return _core.DriftTable(load, relative_bound=waves.relative_bound, period=2.0 * np.pi / step, knots=knots)


def _phasors(hull: HullLoads, load: _core.ExactWaveLoad | _core.DriftLoad) -> Complex:
    """a exp(i phase) where the loads are taken, shape (n,)."""
    sea, (x, y) = load.waves, hull.position
    along = x * np.cos(sea.direction) + y * np.sin(sea.direction)
    return np.asarray(sea.amplitude * np.exp(1j * (sea.phase - sea.wavenumber * along)))


def _knot_count(step: float, number: NDArray[np.int64], widest: float) -> int:
    """Knots of one period: enough for the bound and to tell all frequencies apart, of a fast length."""
    from scipy.fft import next_fast_len

    period = 2.0 * np.pi / step
    return int(next_fast_len(max(int(np.ceil(period / widest)), 2 * int(number.max()) + 2), real=True))
