"""A sea and its loads on a vessel, in a scene."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from seacrane import _core
from seacrane.errors import SceneError
from seacrane.scene import Scene
from seacrane.waves import Waves

if TYPE_CHECKING:
    from seacrane.hydro import HydroDatabase


def _spectrum(name: str, hs: float, tp: float, gamma: float) -> _core.Spectrum:
    if name == "jonswap":
        return _core.jonswap(hs=hs, tp=tp, gamma=gamma)
    if name == "pierson-moskowitz":
        return _core.pierson_moskowitz(hs=hs, tp=tp)
    raise SceneError(f"spectrum {name!r} is unknown; choose 'jonswap' or 'pierson-moskowitz'")


def add_sea(
    scene: Scene,
    database: HydroDatabase,
    *,
    vessel: str = "vessel",
    hs: float = 2.0,
    tp: float = 8.0,
    gamma: float = 3.3,
    spectrum: str = "jonswap",
    direction_deg: float = 135.0,
    seed: int = 1,
    count: int = 200,
    relative_bound: float = 1e-9,
) -> None:
    """Add a long-crested sea and its force-RAO loads on the vessel, phase at the mean position.

    Parameters
    ----------
    scene : Scene
    database : HydroDatabase
        Whose force transfer is used.
    vessel : str
        Body of the vessel.
    hs, tp, gamma : float
        Significant wave height (m), peak period (s), peakedness of JONSWAP; hs = 0 leaves the sea out.
    spectrum : str
        "jonswap" or "pierson-moskowitz".
    direction_deg : float
        Direction of travel, deg from +x (following sea) towards +y (port).
    seed, count : int
        Of the realisation; see `seacrane._core.realise_waves`.
    relative_bound : float
        Error bound of the load table over the sum of component magnitudes; 0: exact sum in every evaluation.
    """
    if hs == 0.0:
        scene.waves = None
        return
    density = _spectrum(spectrum, hs, tp, gamma)
    heading = float(np.radians(direction_deg))
    components = _core.realise_waves(density, seed=seed, direction=heading, count=count)
    omega = np.array(components.omega)
    repeat = components.repeat_period()
    scene.waves = Waves(
        body=vessel,
        omega=omega,
        amplitude=np.array(components.amplitude),
        phase=np.array(components.phase),
        direction=np.array(components.direction),
        transfer=np.asarray(database.force_at(omega, heading), dtype=complex).reshape(-1, 6),
        relative_bound=relative_bound,
        information={
            "seed": seed,
            "realised_hs": float(components.realised_hs),
            "wave_components": int(omega.size),
            "repeat_period_s": float(repeat.time),
            "repeat_found": int(repeat.found),
        },
    )
    sea = {"spectrum": spectrum, "hs": hs, "tp": tp, "gamma": gamma, "wave_direction_deg": direction_deg}
    scene.notes.update(sea, waves_relative_bound=relative_bound)
