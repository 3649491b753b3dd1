"""A description compiled into the core's model."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.description.assembled import warn_of_moves
from seacrane.description.description import Description
from seacrane.description.holding import with_holds
from seacrane.description.loads import lines_of, refuse_winch_of_segment
from seacrane.description.once import forgetting, once
from seacrane.description.rungs import compiled_loads
from seacrane.description.water_contradicted import refuse_contradictions_in_water
from seacrane.description.wave_grid import grid_of
from seacrane.description.wave_selection import without_negligible
from seacrane.description.waves import HullLoads, Waves
from seacrane.description.wet_parts import refuse_outside_parts, refuse_unsaid_air
from seacrane.errors import SceneError
from seacrane.inputs.caller import silently, warn_caller
from seacrane.inputs.checked import name_of, number_of, text_of
from seacrane.warnings import RedundantJointsWarning

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


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
    model = _core.compile(
        name=name_of("scene", scene.name),
        gravity=number_of(f"scene {scene.name!r}: gravity", scene.gravity),
        orientation=text_of(f"scene {scene.name!r}: orientation", scene.orientation),
        baumgarte=number_of(f"scene {scene.name!r}: baumgarte", scene.baumgarte),
        length_scale=number_of(f"scene {scene.name!r}: length_scale", scene.length_scale),
        bodies=list(scene.bodies.values()),
        joints=list(scene.joints.values()),
        drivers=list(scene.drivers.values()),
        loads=compiled_loads(scene.all_loads()),
        vessels=list(scene.vessels.values()),
        groups=list(scene.groups.values()),
        wave_loads=[] if sea is None else compiled_waves(sea),
        coordinates=[(name, *place) for name, place in scene.recorded.items()],
        points=list(scene.points.values()),
        merge=merge,
        **({} if sea is None else {"sea": field_of(sea)}),
    )
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
    try:
        return without_negligible(waves) if prune else waves
    except (TypeError, ValueError) as error:
        raise SceneError(f"waves on {_hulls_of(waves)}: {error}") from error


def _hulls_of(waves: Waves) -> str:
    return ", ".join(map(repr, waves.hulls)) or "no vessel"


def field_of(waves: Waves) -> _core.SeaField:
    """What moving points see of a sea; raises SceneError for values that make no sense."""
    try:
        return waves.field()
    except (TypeError, ValueError) as error:
        raise SceneError(f"waves on {_hulls_of(waves)}: {error}") from error


def compiled_waves(waves: Waves) -> list[_core.WaveLoads]:
    """The loads for the compiled core; raises SceneError for shapes or values that make no sense."""
    return [_loads_on(waves, text_of("waves: body", body)) for body in waves.hulls]


def _loads_on(waves: Waves, body: str) -> _core.WaveLoads:
    hull = waves.hulls[body]
    try:
        loads = _mean(waves, hull) if hull.force_by_heading is None else _positioned(waves, hull)
    except (TypeError, ValueError) as error:
        raise SceneError(f"waves on {body!r}: {error}") from error
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
        waves.components(),
        headings=np.asarray(force.heading).tolist(),
        transfer=force.values,
        cutoff=hull.cutoff,
        **slow,
    )
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
