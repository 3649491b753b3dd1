"""A sea of several wave systems, made again from its record with another seed."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from seacrane.errors import SceneError
from seacrane.sea import SeaState, Spectrum, Spreading, WaveSystem, jonswap, pierson_moskowitz

SPECTRA: Mapping[str, Callable[..., Spectrum]] = {
    "JONSWAP": jonswap,
    "Pierson-Moskowitz": lambda *, hs, tp, gamma: pierson_moskowitz(hs=hs, tp=tp),
}


def sea_state_of(record: Mapping[str, Any], seed: Any) -> SeaState:
    """What `SeaState.description` tells, with a seed.

    Raises
    ------
    SceneError
        For a measured record, or a spectrum that its parts do not tell.
    """
    return SeaState(
        systems=[_system(system) for system in record["systems"]],
        seed=seed,
        depth=float("inf") if record["depth"] is None else record["depth"],
        placement=record["placement"],
    )


def _system(record: Mapping[str, Any]) -> WaveSystem:
    kind, parts, spread = record.get("spectrum", "record"), record.get("parts", ()), record.get("spreading")
    if kind not in SPECTRA or len(parts) != 1:
        raise SceneError(
            f"over: wave system {record['name']!r} of the sea is a {kind}, which cannot be made again from "
            "what is known of it; give a function that makes the scene"
        )
    return WaveSystem(
        spectrum=SPECTRA[kind](**parts[0]),
        direction_deg=record["direction_deg"],
        spreading=None if spread is None else Spreading(**spread),
        count=record["count"],
        name=record["name"],
    )
