"""A sea and its loads on a vessel, in a scene."""

from __future__ import annotations

import math
import warnings
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.checked import flag_of, number_of
from seacrane.environment import add_drift, use_actual_position
from seacrane.errors import SceneError
from seacrane.scene import Scene
from seacrane.sea import SeaState, Spreading, WaveSystem, cos_2s, jonswap
from seacrane.waves import Waves

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


class DepthMismatchWarning(UserWarning):
    """Waves of one water depth act through forces computed for another: both are wrong in shallow water."""


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
    relative_bound: float = 1e-9,
    evaluation: str = "table",
    phase: Literal["mean", "actual"] = "mean",
    drift: bool = False,
) -> None:
    """Add a sea and its force-RAO loads on the vessel.

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
    relative_bound : float
        Error bound of the load table over the sum of component magnitudes; 0: exact sum in every evaluation.
    evaluation : str
        "table", "fft" (needs components of uniform placement) or "exact"; see `seacrane.Waves`.
    phase : str
        "mean": loads at the vessel's mean position and heading. "actual": at those of the moment, see
        `seacrane.use_actual_position`.
    drift : bool
        Adds Newman's slow drift, see `seacrane.add_drift`.

    Raises
    ------
    SceneError
        For a value out of range, or `sea` beside what it replaces; ValueError for a frequency outside the
        database.

    Warns
    -----
    SteepSeaWarning
        A sea steeper than any that stands.
    DepthMismatchWarning
        A `sea` of another water depth than the database.
    """
    arguments = {"hs": hs, "tp": tp, "gamma": gamma, "spectrum": spectrum, "direction_deg": direction_deg,
                 "spreading": spreading, "seed": seed, "count": count}  # fmt: skip
    given = {name: value for name, value in arguments.items() if value is not None}
    if phase not in ("mean", "actual"):
        raise SceneError(f"sea: phase is {phase!r}; choose 'mean' or 'actual'")
    flag_of("sea: drift", drift)
    if sea is not None:
        if given:
            raise SceneError(f"sea: given beside {', '.join(given)}; put these into the SeaState")
        if not isinstance(sea, SeaState):
            raise SceneError(f"sea is {sea!r}; give a SeaState")
        _check_depth(sea, database)
        notes: dict[str, Any] = {"sea": sea.description()}
    else:
        chosen = DEFAULTS | given
        if chosen["hs"] == 0.0:
            scene.waves = None
            return
        if gamma is not None and chosen["spectrum"] != "jonswap":
            raise SceneError(f"gamma: {chosen['spectrum']!r} has no free peak enhancement; leave gamma out")
        sea, notes = _one_system(**chosen)
    realised = sea.realise()
    waves = realised.waves
    omega, direction = np.array(waves.omega), np.array(waves.direction)
    scene.waves = Waves(
        body=vessel,
        omega=omega,
        amplitude=np.array(waves.amplitude),
        phase=np.array(waves.phase),
        direction=direction,
        transfer=_transfer(database, omega, direction),
        relative_bound=relative_bound,
        depth=sea.depth,
        evaluation=evaluation,
        information={
            "seed": sea.seed,
            "realised_hs": realised.hs,
            "wave_components": int(omega.size),
            "repeat_period_s": float(realised.repeat.time),
            "repeat_found": int(realised.repeat.found),
        },
    )
    if drift:
        add_drift(scene, database)
    if phase == "actual":
        use_actual_position(scene, database)
    if len(realised.systems) > 1:
        notes["realised_hs_of_systems"] = {system.name: system.hs for system in realised.systems}
    scene.notes.update(notes, waves_relative_bound=relative_bound)


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
    return SeaState(systems=[system], seed=seed), notes


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


def _check_depth(sea: SeaState, database: HydroDatabase) -> None:
    if not math.isclose(sea.depth, database.depth, rel_tol=0.01):
        warnings.warn(
            f"database {database.name!r}: forces are for a depth of {database.depth:g} m, the sea is "
            f"{sea.depth:g} m deep: where waves feel the bottom, loads and wavelengths disagree; set "
            "SeaState(depth=...) to the database's",
            DepthMismatchWarning,
            stacklevel=3,
        )


def _transfer(
    database: HydroDatabase, omega: NDArray[np.float64], direction: NDArray[np.float64]
) -> NDArray[np.complex128]:
    starts = range(0, omega.size, AT_ONCE)
    rows = [database.force_at(omega[i : i + AT_ONCE], direction[i : i + AT_ONCE]) for i in starts]
    return np.concatenate(rows).astype(complex).reshape(-1, 6)
