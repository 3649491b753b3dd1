"""A sea with no vessel in it yet, from plain arguments or a `SeaState`."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.description.provenance import SeaProvenance
from seacrane.description.waves import Waves
from seacrane.errors import SceneError
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.checked import number_of, text_of
from seacrane.sea import Current, SeaState, Spreading, WaveSystem, cos_2s, jonswap
from seacrane.warnings import BlockedWavesWarning, UnitWarning

DEFAULTS: dict[str, Any] = {
    "tp": 8.0,
    "gamma": 3.3,
    "spectrum": "jonswap",
    "direction_deg": 135.0,
    "spreading": None,
    "seed": 1,
    "count": 200,
}
USUAL_PERIODS = (0.5, 40.0)  # s, of peaks, those of wave basins included
SPECTRA = ("jonswap", "pierson-moskowitz", "torsethaugen")


def realised_sea(
    sea: SeaState | None, given: dict[str, Any], depth: float, *, current: Current | None = None,
    look_for_repeats: bool = True,
) -> Waves:  # fmt: skip
    """A sea with no vessel in it yet, of that depth where it is not a SeaState.

    Looking for repeats takes longer than all the rest; without, its provenance does not tell them.

    Raises SceneError for arguments that make no sea.
    """
    if sea is None:
        chosen = DEFAULTS | given
        if "gamma" in given and chosen["spectrum"] != "jonswap":
            raise SceneError(f"gamma: {chosen['spectrum']!r} has no free peak enhancement; leave gamma out")
        sea, made_from = _one_system(**chosen, depth=depth)
    elif isinstance(sea, SeaState):
        made_from = SeaProvenance(sea=sea.description())
    else:
        raise SceneError(f"sea is {sea!r}; give a SeaState")
    realised = sea.realise()
    waves = realised.waves
    several = {system.name: system.hs for system in realised.systems} if len(realised.systems) > 1 else None
    kept = _not_stopped(waves, current)
    return Waves(
        omega=np.array(waves.omega)[kept],
        amplitude=np.array(waves.amplitude)[kept],
        phase=np.array(waves.phase)[kept],
        direction=np.array(waves.direction)[kept],
        hulls={},
        depth=sea.depth,
        current=current,
        provenance=replace(
            made_from,
            realised_hs_of_systems=several,
            seed=sea.seed,
            realised_hs=float(realised.hs),
            wave_components=len(waves.omega),
            repeat_period_s=float(realised.repeat.time) if look_for_repeats else None,
            repeat_found=int(realised.repeat.found) if look_for_repeats else None,
        ),
    )


def _not_stopped(waves: _core.WaveComponents, current: Current | None) -> NDArray[np.bool_]:
    """Which components travel on a current; the energy of the others is told."""
    kept = np.ones(len(waves.omega), dtype=bool)
    if current is None:
        return kept
    on_current = current.core().wavenumber(
        omega=waves.omega, direction=waves.direction, depth=waves.depth, gravity=waves.gravity
    )
    kept = ~np.isnan(on_current)
    energy = np.array(waves.amplitude) ** 2
    if not kept.any():
        raise SceneError("sea: the current stops all its waves; give a slower one, or longer waves")
    if energy[~kept].any():
        warn_caller(
            f"sea: the current stops waves above {np.min(np.array(waves.omega)[~kept]):.4g} rad/s that come "
            f"against it, {energy[~kept].sum() / energy.sum():.2%} of the energy; they are left out",
            BlockedWavesWarning,
        )
    return kept


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
) -> tuple[SeaState, SeaProvenance]:
    """The sea of plain arguments, and what it was made from."""
    _warn_of_period(number_of("sea: tp", tp))
    density = spectrum_named(spectrum, number_of("sea: hs", hs), number_of("sea: tp", tp), gamma)
    if spreading is not None and not isinstance(spreading, Spreading):
        spreading = cos_2s(spreading)
    system = WaveSystem(spectrum=density, direction_deg=direction_deg, spreading=spreading, count=count)
    made_from = SeaProvenance(
        spectrum=spectrum,
        hs=float(hs),
        tp=float(tp),
        gamma=density.gamma,
        wave_direction_deg=float(direction_deg),
        spreading=None if spreading is None else {"kind": spreading.kind, "exponent": spreading.exponent},
    )
    return SeaState(systems=[system], seed=seed, depth=depth), made_from


def _warn_of_period(tp: float) -> None:
    least, most = USUAL_PERIODS
    if tp > 0.0 and not least <= tp <= most:
        warn_caller(
            f"sea: tp is {tp:.6g} s, and seas have {least:g} to {most:g} s: a slip in its unit? Give it in s",
            UnitWarning,
        )


def spectrum_named(name: str, hs: float, tp: float, gamma: float | Literal["dnv"]) -> _core.Spectrum:
    """One of SPECTRA; only "jonswap" takes gamma. Raises SceneError."""
    if text_of("sea: spectrum", name) == "jonswap":
        return jonswap(hs=hs, tp=tp, gamma=gamma)
    if name == "pierson-moskowitz":
        return _core.pierson_moskowitz(hs=hs, tp=tp)
    if name == "torsethaugen":
        return _core.torsethaugen(hs=hs, tp=tp)
    raise SceneError(
        f"spectrum {name!r} is unknown; choose 'jonswap', 'pierson-moskowitz' or 'torsethaugen', "
        "or give a SeaState"
    )
