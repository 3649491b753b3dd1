"""A sea and its loads on the vessels of a scene."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.description.scene import Scene
from seacrane.description.waves import HullLoads, Waves
from seacrane.errors import SceneError
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.checked import flag_of, number_of, shaped_of
from seacrane.inputs.frames import heading_of
from seacrane.inputs.plausible import direction_of
from seacrane.scene.wind_current_drift import add_drift, require_depth, use_actual_position, use_slow_position
from seacrane.sea import SeaState, Spreading, WaveSystem, cos_2s, jonswap

if TYPE_CHECKING:
    from seacrane.hydro import HydroDatabase

DEFAULTS: dict[str, Any] = {
    "hs": 2.0,
    "tp": 8.0,
    "gamma": 3.3,
    "spectrum": "jonswap",
    "direction_deg": 135.0,
    "spreading": None,
    "seed": 1,
    "count": 200,
}
AT_ONCE = 4096  # components whose transfer is interpolated together, to bound the memory it takes


MOST_WITHOUT_LOAD = 0.02  # of the variance of a load
NOTES = ("sea", "spectrum", "hs", "tp", "gamma", "wave_direction_deg", "spreading", "realised_hs_of_systems",
         "waves_relative_bound", "wave_phase", "drift")  # fmt: skip


class WavesWithoutLoadWarning(UserWarning):
    """Waves above the frequencies of a database carry no load that matters: motions come out too small."""


def add_sea(
    scene: Scene,
    database: HydroDatabase,
    *,
    vessel: str = "vessel",
    hs: float | None = None,
    tp: float | None = None,
    gamma: float | Literal["dnv"] | None = None,
    spectrum: str | None = None,
    direction_deg: float | None = None,
    spreading: float | Spreading | None = None,
    seed: int | None = None,
    count: int | None = None,
    sea: SeaState | None = None,
    position: Any = None,
    heading_deg: float | None = None,
    relative_bound: float | None = None,
    evaluation: str | None = None,
    phase: Literal["mean", "slow", "actual"] = "mean",
    drift: bool = False,
) -> None:
    """Add a sea and its force-RAO loads on a vessel, or put one more vessel into the sea that is there.

    A scene has one sea, with phases from the origin of the inertial frame. For every further vessel call it
    again, with the same sea or without any argument of it.

    Parameters
    ----------
    scene : Scene
    database : HydroDatabase
        Whose force transfer is used, at the direction of every component.
    vessel : str
        Body of the vessel.
    hs, tp : float
        Significant wave height (default 2 m; 0 leaves the sea out) and peak period (8 s).
    gamma : float or "dnv"
        Peak enhancement of JONSWAP, 1 to 7 (3.3), or by DNV-RP-C205.
    spectrum : str
        "jonswap" (default), "pierson-moskowitz" or "torsethaugen".
    direction_deg : float
        Mean direction of travel, deg from +x (following sea) towards +y (port); default 135.
    spreading : float or Spreading
        Short-crested sea: s of cos^(2 s)(angle / 2), or `seacrane.sea.cos_n(...)`; default: long-crested.
    seed, count : int
        Of the realisation (1, 200 components); see `seacrane.sea.realise_waves`.
    sea : SeaState
        In place of all of these from hs on: any spectra, several wave systems, measured waves.
    position : array_like, shape (2,)
        Where the vessel's loads are taken, (x, y), m, inertial frame; default: where its body starts.
    heading_deg : float
        At which heading, deg from +x towards +y; default: that of its body at the start.
    relative_bound : float
        Error bound of the load table over the sum of component magnitudes (1e-9); 0: exact sum in every
        evaluation.
    evaluation : str
        "table" (default), "fft" (needs components of uniform placement) or "exact"; see `seacrane.Waves`.
    phase : str
        "mean": loads at that position and heading. "slow": at the slow part of those of the moment, see
        `seacrane.use_slow_position`. "actual": at those of the moment, see `seacrane.use_actual_position`.
    drift : bool
        Adds Newman's slow drift, see `seacrane.add_drift`; components beyond its coefficients take those of
        the nearest.

    The sea is as deep as the database, or as `sea` says. It keeps all its components: loads at frequencies
    that the database does not hold follow from `HydroDatabase.force_at` with ``outside="limits"``.

    Raises
    ------
    SceneError
        For a value out of range, `sea` beside what it replaces, a second sea, a vessel that is not there, or
        a sea whose waves have another length at its depth than at the database's.

    Warns
    -----
    SteepSeaWarning
        A sea steeper than any that stands.
    WavesWithoutLoadWarning
        More than 2 % of the variance of a load is that of waves above the database's frequencies.
    """
    arguments = {"hs": hs, "tp": tp, "gamma": gamma, "spectrum": spectrum, "direction_deg": direction_deg,
                 "spreading": spreading, "seed": seed, "count": count}  # fmt: skip
    given = {name: value for name, value in arguments.items() if value is not None}
    if phase not in ("mean", "slow", "actual"):
        raise SceneError(f"sea: phase is {phase!r}; choose 'mean', 'slow' or 'actual'")
    flag_of("sea: drift", drift)
    if sea is not None and given:
        raise SceneError(f"sea: given beside {', '.join(given)}; put these into the SeaState")
    if sea is None and given.get("hs") == 0.0:
        scene.waves = None
        _forget(scene)
        return
    waves, notes = _sea_of(scene, database, vessel, sea, given)
    waves = _evaluated(waves, relative_bound=relative_bound, evaluation=evaluation)
    require_depth(waves, database, vessel)
    place, heading = _pose(scene, vessel, position, heading_deg)
    transfer = _transfer(database, waves.omega, waves.direction - heading)
    hull = HullLoads(transfer=transfer, position=place, heading=heading)
    if scene.waves is None:
        _forget(scene)
    information = _with_shares(waves, database, vessel, hull)
    scene.waves = replace(waves, hulls={**waves.hulls, vessel: hull}, information=information)
    if drift:
        add_drift(scene, database, vessel=vessel, outside="hold")
    if phase == "actual":
        use_actual_position(scene, database, vessel=vessel)
    if phase == "slow":
        use_slow_position(scene, database, vessel=vessel)
    scene.notes.update(notes, waves_relative_bound=waves.relative_bound)


def _forget(scene: Scene) -> None:
    """Take the notes of a sea that is gone out of the scene."""
    for name in NOTES:
        scene.notes.pop(name, None)


def _sea_of(
    scene: Scene, database: HydroDatabase, vessel: str, sea: SeaState | None, given: dict[str, Any]
) -> tuple[Waves, dict[str, Any]]:
    """The sea asked for with the notes on it; in a scene that has a sea, that one, if it is no other."""
    there = scene.waves
    if there is not None and sea is None and not given:
        return there, {}
    asked, notes = _realised(sea, given, database.depth if there is None else there.depth)
    if there is None:
        return asked, notes
    arrays = ("omega", "amplitude", "phase", "direction", "depth")
    if not all(np.array_equal(getattr(there, name), getattr(asked, name)) for name in arrays):
        raise SceneError(
            f"sea: vessel {vessel!r} is given another sea than {', '.join(map(repr, there.hulls))} has, and "
            "a scene has one; leave out what describes it to put the vessel into that sea, put several wave "
            "systems into one SeaState, or set scene.waves = None before a new sea"
        )
    return there, {}


def _realised(sea: SeaState | None, given: dict[str, Any], depth: float) -> tuple[Waves, dict[str, Any]]:
    """A sea with no vessel in it yet, of that depth where it is not a SeaState, and the notes on it."""
    if sea is None:
        chosen = DEFAULTS | given
        if "gamma" in given and chosen["spectrum"] != "jonswap":
            raise SceneError(f"gamma: {chosen['spectrum']!r} has no free peak enhancement; leave gamma out")
        sea, notes = _one_system(**chosen, depth=depth)
    elif isinstance(sea, SeaState):
        notes = {"sea": sea.description()}
    else:
        raise SceneError(f"sea is {sea!r}; give a SeaState")
    realised = sea.realise()
    waves = realised.waves
    if len(realised.systems) > 1:
        notes["realised_hs_of_systems"] = {system.name: system.hs for system in realised.systems}
    return Waves(
        omega=np.array(waves.omega),
        amplitude=np.array(waves.amplitude),
        phase=np.array(waves.phase),
        direction=np.array(waves.direction),
        hulls={},
        depth=sea.depth,
        information={
            "seed": sea.seed,
            "realised_hs": realised.hs,
            "wave_components": len(waves.omega),
            "repeat_period_s": float(realised.repeat.time),
            "repeat_found": int(realised.repeat.found),
        },
    ), notes


def _evaluated(waves: Waves, **given: Any) -> Waves:
    """With the settings given; vessels of one sea share them."""
    given = {name: value for name, value in given.items() if value is not None}
    for name, value in given.items():
        if waves.hulls and value != getattr(waves, name):
            raise SceneError(
                f"sea: {name} is {value!r}, that of {', '.join(map(repr, waves.hulls))} is "
                f"{getattr(waves, name)!r}; vessels in one sea share it, leave it out"
            )
    return replace(waves, **given)


def _pose(
    scene: Scene, vessel: str, position: Any, heading_deg: float | None
) -> tuple[tuple[float, float], float]:
    """Where a vessel's loads are taken: (x, y) and heading, as its body starts where they are not given."""
    body = scene.bodies.get(vessel)
    if body is None:
        known = ", ".join(repr(v.body) for v in scene.vessels.values()) or "none"
        raise SceneError(f"sea: there is no vessel {vessel!r}, the scene has {known}; call add_vessel first")
    x, y = body.position[:2] if position is None else shaped_of("sea: position", position, (2,))
    heading = heading_of(body.quaternion)
    if heading_deg is not None:
        heading = float(np.radians(direction_of("sea: heading_deg", heading_deg)))
    if not np.isfinite([x, y, heading]).all():
        raise SceneError(
            f"sea: loads of {vessel!r} are taken at x, y, heading {x}, {y}, {heading}; give finite ones"
        )
    return (float(x), float(y)), heading


def _one_system(
    *,
    hs: float,
    tp: float,
    gamma: float | Literal["dnv"],
    spectrum: str,
    direction_deg: float,
    spreading: float | Spreading | None,
    seed: int,
    count: int,
    depth: float,
) -> tuple[SeaState, dict[str, Any]]:
    """The sea of plain arguments, and the notes on it."""
    density = _spectrum(spectrum, number_of("sea: hs", hs), number_of("sea: tp", tp), gamma)
    if spreading is not None and not isinstance(spreading, Spreading):
        spreading = cos_2s(spreading)
    system = WaveSystem(spectrum=density, direction_deg=direction_deg, spreading=spreading, count=count)
    notes = {"spectrum": spectrum, "hs": hs, "tp": tp, "gamma": density.gamma,
             "wave_direction_deg": direction_deg}  # fmt: skip
    if spreading is not None:
        notes["spreading"] = {"kind": spreading.kind, "exponent": spreading.exponent}
    return SeaState(systems=[system], seed=seed, depth=depth), notes


def _spectrum(name: str, hs: float, tp: float, gamma: float | Literal["dnv"]) -> _core.Spectrum:
    if name == "jonswap":
        return jonswap(hs=hs, tp=tp, gamma=gamma)
    if name == "pierson-moskowitz":
        return _core.pierson_moskowitz(hs=hs, tp=tp)
    if name == "torsethaugen":
        return _core.torsethaugen(hs=hs, tp=tp)
    raise SceneError(
        f"spectrum {name!r} is unknown; choose 'jonswap', 'pierson-moskowitz' or 'torsethaugen', "
        "or give a SeaState"
    )


def _with_shares(waves: Waves, database: HydroDatabase, vessel: str, hull: HullLoads) -> dict[str, Any]:
    """What is reported of the sea, with what of it puts no load on a vessel; of several the largest."""
    from seacrane.hydro.data.beyond_band import without_load

    left_out = without_load(
        database,
        omega=waves.omega,
        amplitude=waves.amplitude,
        direction=waves.direction - hull.heading,
        force=hull.transfer,
    )
    if left_out.variance > MOST_WITHOUT_LOAD:
        warn_caller(
            f"waves on {vessel!r}: those above {database.omega[-1]:.4g} rad/s, where database "
            f"{database.name!r} ends, put no load on it: {left_out.energy:.2%} of the energy of the waves, "
            f"and about {left_out.variance:.1%} of the variance of its {left_out.load} load. Compute the "
            "database to higher frequencies, or take its motions in this sea for too small",
            WavesWithoutLoadWarning,
        )
    shares = {"wave_energy_without_load": left_out.energy, "load_variance_without_load": left_out.variance}
    known = waves.information
    return {**known, **{name: max(share, known.get(name, 0.0)) for name, share in shares.items()}}


def _transfer(
    database: HydroDatabase, omega: NDArray[np.float64], direction: NDArray[np.float64]
) -> NDArray[np.complex128]:
    starts = range(0, omega.size, AT_ONCE)
    rows = [
        database.force_at(omega[i : i + AT_ONCE], direction[i : i + AT_ONCE], outside="limits")
        for i in starts
    ]
    return np.concatenate(rows).astype(complex).reshape(-1, 6)
