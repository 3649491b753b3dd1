"""What a result says about its run: version, settings, sizes, counters, and what events tell."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.analysis.after_run import Finding
from seacrane.description.description import Description
from seacrane.description.hydraulic_cylinders import hydraulic_cylinders
from seacrane.description.once import once
from seacrane.description.outline import bounds_of, hung_notes, outline_of
from seacrane.description.provenance import SEA_SETTINGS, VesselProvenance
from seacrane.description.suspension import hung_loads, static_weights
from seacrane.description.waves import Waves
from seacrane.errors import SceneError
from seacrane.inputs.plain_data import plain_data, plain_notes
from seacrane.result.about import About, Event
from seacrane.run.method import Method
from seacrane.run.outputs import Outputs
from seacrane.scene.scene import Scene
from seacrane.version import __version__
from seacrane.warnings import BoilingOilWarning, ThroughSeatWarning

OPTIONAL = ("dt", "maximum_step", "spectral_radius", "energy_limit")
Channels = Mapping[str, NDArray[np.float64]]
SIDES = {"vapour": "full", "vapour_rod": "rod"}  # by what its event is called
VOIDS = "hydraulic_void"


def settings_of(scene: Scene, t_end: float, method: Method, outputs: Outputs) -> dict[str, Any]:
    """The settings of a run by the words of `simulate`; a word that is absent was left to its default."""
    given = {word: getattr(method, word) for word in OPTIONAL}
    notes = plain_notes(scene.name, scene.notes)
    return {
        "t_end": t_end,
        "dt_out": outputs.dt_out,
        "rtol": method.used_rtol,
        **{word: value for word, value in given.items() if value is not None},
        "orientation": scene.orientation,
        "baumgarte": scene.baumgarte,
        **origin_settings(scene),
        **({"notes": notes} if notes else {}),
    }


@once
def about_of(scene: Scene) -> About:
    """What a result notes of a scene; of its settings nothing. SceneError for what no file could hold."""
    about = About(
        limit_states=tuple(scene.limit_states.values()), outline=outline_of(scene), bounds=bounds_of(scene),
        cranes=plain_data("cranes", [*scene.roles.values()]), hung=hung_notes(scene),
        hanging_weight=static_weights(scene),
    )  # fmt: skip
    try:
        about.to_attributes()
    except ValueError as error:
        raise SceneError(f"scene {scene.name!r}: {error}") from error
    return about


@once
def lasting_stats(scene: Scene, model: _core.Model, formulation: str, method: Method) -> Mapping[str, Any]:
    """What `Result.stats` say of a run before it begins, whatever its sea; what is missing stands as None."""
    recursive = formulation == "recursive"
    return {
        "seacrane_version": __version__,
        "scene": scene.name,
        "payload": "\n".join(dict.fromkeys(one.load for one in hung_loads(scene))) or None,
        "formulation": formulation,
        "integrator": method.integrator,
        "simulated_s": None,
        "coordinates": model.coordinates,
        "constraints": model.constraints,
        "degrees_of_freedom": model.degrees_of_freedom,
        "compiled_coordinates": model.tree["speeds"] if recursive else model.merge["coordinates"],
        "compiled_constraints": model.tree["loop_rows"] if recursive else model.merge["constraints"],
        "memory_states": model.memory_states,
        "history_samples": model.history_samples,
    }


@once
def origin_settings(scene: Description) -> Mapping[str, Any]:
    """Settings of vessels and sea, by the names of a result's settings; by body where several vessels differ.

    Raises SceneError for a value that is not plain data.
    """
    found: dict[str, dict[str, Any]] = {}
    for vessel in scene.vessels.values():
        known = scene.provenance.get(vessel.name, VesselProvenance())
        band = None if known.omega is None else list(known.omega)
        values: dict[str, Any] = {"database": known.database, "database_omega": band, "memory": known.memory}
        values |= {"memory_error": known.memory_error, "given_motion": known.motion}
        values |= {"given_record": known.record}
        for key, value in {**values, "kinematics": vessel.kinematics}.items():
            found.setdefault(key, {})[vessel.body] = value
    hulls = {} if scene.waves is None else scene.waves.hulls
    for body, hull in hulls.items():
        if hull.phase != "mean":
            found.setdefault("wave_phase", {})[body] = hull.phase
        if hull.drift is not None:
            found.setdefault("drift", {})[body] = "newman"
    told: dict[str, Any] = {}
    for key, by_body in found.items():
        first, *others = by_body.values()
        if any(other != first for other in others):
            told[key] = by_body
        elif first is not None:
            told[key] = first
    return sea_settings(scene, plain_data(f"scene {scene.name!r}: provenance", told))


def sea_settings(scene: Description, others: Mapping[str, Any]) -> dict[str, Any]:
    """Settings with those of the scene's sea in the place of another's; raises as `origin_settings`."""
    out = {word: value for word, value in others.items() if word not in SEA_SETTINGS}
    if scene.waves is None:
        return out
    return out | dict(plain_data(f"scene {scene.name!r}: provenance", told_of(scene.waves)))


def told_of(waves: Waves) -> dict[str, Any]:
    """What a sea was made from."""
    return {**waves.provenance.settings(), "waves_relative_bound": waves.relative_bound}


def event_findings(scene: Description, events: Sequence[Event], channels: Channels) -> Iterator[Finding]:
    """Every chamber that reached its vapour pressure, and every seat that what left it went through, once.

    How large the void grew is told where it was recorded.
    """
    times: dict[tuple[str, bool], list[float]] = {}
    for event in events:
        times.setdefault((event.name, event.kind == "through"), []).append(event.time)
    for number, (name, one) in enumerate(hydraulic_cylinders(scene).items()):
        for chamber, (bound, side) in enumerate(SIDES.items()):
            if (f"{name}.{bound}", False) not in times:
                continue
            first, *again = times[f"{name}.{bound}", False]
            often = f", and {len(again)} time(s) more" if again else ""
            size = ""
            if VOIDS in channels:
                size = f", of up to {1e3 * channels[VOIDS][:, number, chamber].max():.3g} l"
            yield (
                BoilingOilWarning,
                f"hydraulic cylinder {name!r}: the oil of its {side} side boils at t = {first:.6g} s"
                f"{often}: a void opens{size}, at the vapour pressure of {one.vapour_pressure:.4g} Pa, and "
                "holds no load. Give makeup_flow or a higher tank_pressure, or move slower; refuse_void=True "
                "ends a run here",
            )
    for name in [name for name, through in times if through]:
        first, *again = times[name, True]
        load = scene.joints[scene.loads[name].joint].second
        yield (
            ThroughSeatWarning,
            f"seat {name!r}: {load!r} had left it, and goes below its plane at t = {first:.6g} s"
            f"{f' and {len(again)} more time(s)' if again else ''}: it would hit the deck "
            "there, and a seat that let go holds nothing, so that loads from then on are too small. Lift "
            "faster or at a better moment, or take the run as failed; see docs/events.md",
        )


def ruptures(scene: Description, start: float, now: float) -> list[Event]:
    """Events of hoses that burst from `start` (s) on and before `now` (s).

    A hose that bursts at `now` is left to the run that continues from there.
    """
    return [
        Event(time=cylinder.rupture_time, name=f"{name}.rupture", kind="limit")
        for name, cylinder in hydraulic_cylinders(scene).items()
        if cylinder.rupture_area > 0.0 and start <= cylinder.rupture_time < now
    ]
