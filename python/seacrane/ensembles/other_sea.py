"""The sea of a scene with another seed, height, period, direction or peak enhancement."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from typing import Any

import numpy as np

from seacrane.description.databases import database_of
from seacrane.description.provenance import SeaProvenance
from seacrane.description.waves import Waves
from seacrane.errors import SceneError
from seacrane.inputs.alike import alike
from seacrane.inputs.caller import keeping, recorded, say_again, silently
from seacrane.scene.realised_sea import COMPONENTS, described_sea, realised
from seacrane.scene.scene import Scene
from seacrane.scene.sea import own_cutoff, put
from seacrane.sea import SeaState, Spectrum, Spreading, WaveSystem, jonswap, pierson_moskowitz

WORDS = ("seed", "hs", "tp", "direction_deg", "gamma")
SAME = 1e-9  # relative
SAME_SETTINGS = ("current", "relative_bound", "evaluation", "stretching", "negligible")
SPECTRA: Mapping[str, Callable[..., Spectrum]] = {
    "JONSWAP": jonswap,
    "Pierson-Moskowitz": lambda *, hs, tp, gamma: pierson_moskowitz(hs=hs, tp=tp),
}


def with_sea(scene: Scene, given: Mapping[str, Any]) -> Scene:
    """A copy of the scene in another sea, all else of which is as it was; repeats are not looked for."""
    out = scene.copy()
    with keeping(out.warned):
        out.waves = other_sea(out, given)
    return out


def other_sea(scene: Scene, given: Mapping[str, Any]) -> Waves:
    """That sea alone; ships of the scene that follow RAOs are set moving in it."""
    seeds = OtherSeeds(scene, {word: value for word, value in given.items() if word != "seed"})
    return seeds.sea(given.get("seed"))


class OtherSeeds:
    """The seas of a scene, with other words but the seed, by seed: what these share is made once.

    Threads may share it. Raises SceneError for words that make no sea; warnings are given for each seed.
    """

    def __init__(self, scene: Scene, words: Mapping[str, Any]) -> None:
        assert scene.waves is not None
        self._scene, self._old = scene, scene.waves
        with silently(), recorded() as self._said:
            self._sea, self._made_from = _described(scene, words)
        same = {name: getattr(scene.waves, name) for name in SAME_SETTINGS}
        same |= dict.fromkeys(COMPONENTS, np.zeros(0))
        self._calm = Waves(hulls={}, depth=self._sea.depth, **same)
        self._bins = self._sea.bins()

    def sea(self, seed: Any = None) -> Waves:
        """The sea of a seed, by default that of the scene; ships that follow RAOs are set moving in it."""
        say_again(self._said)
        sea, made_from = self._sea, self._made_from
        if seed is not None:
            sea = SeaState(systems=sea.systems, seed=seed, depth=sea.depth, placement=sea.placement)
        if made_from.sea is not None:
            made_from = alike(made_from, sea=sea.description())
        found = realised(sea, made_from, self._bins, current=self._calm.current, look_for_repeats=False)
        waves = alike(self._calm, **found)
        for body, hull in self._old.hulls.items():
            waves = put(
                self._scene, waves, vessel=body, position=hull.position, heading=hull.heading,
                phase=hull.phase, cutoff=own_cutoff(self._old, hull), drift=hull.drift is not None,
            )  # fmt: skip
        return waves


def _described(scene: Scene, words: Mapping[str, Any]) -> tuple[SeaState, SeaProvenance]:
    """The sea of the scene with other words but the seed, not realised."""
    assert scene.waves is not None
    record, depth = scene.waves.provenance.sea, scene.waves.depth
    if record is not None:
        sea = SeaState(
            systems=[_system(system) for system in record["systems"]],
            seed=record["seed"],
            depth=float("inf") if record["depth"] is None else record["depth"],
            placement=record["placement"],
        )
        return described_sea(sea, {}, depth)
    settings = _settings(scene)
    if "gamma" not in words and settings["spectrum"] != "jonswap":
        settings.pop("gamma")
    return described_sea(None, settings | dict(words), depth)


def require_same_sea(scene: Scene, words: Collection[str]) -> None:
    """Raise SceneError unless the sea of the scene has these words, and is what is made again from them."""
    if scene.waves is None:
        raise SceneError(f"over: scene {scene.name!r} has no sea; add one, or vary something else")
    if not scene.waves.hulls:
        raise SceneError(
            f"over: the sea of scene {scene.name!r} loads no floating vessel; give a function "
            "that makes the scene"
        )
    others = [word for word in words if word != "seed"]
    if scene.waves.provenance.sea is not None and others:
        raise SceneError(
            f"over: the sea of scene {scene.name!r} is a SeaState, of which the seed can vary, and not "
            f"{', '.join(others)}; give a function that makes the scene"
        )
    made = other_sea(scene.copy(), {})
    arrays = ("omega", "amplitude", "phase", "direction")
    if not all(np.array_equal(getattr(made, name), getattr(scene.waves, name)) for name in arrays):
        raise SceneError(
            f"over: the sea of scene {scene.name!r} is not the one that its record describes, so it cannot "
            "be made again with another seed; give a function that makes the scene"
        )
    for body, hull in scene.waves.hulls.items():
        if not np.allclose(made.hulls[body].transfer, hull.transfer, rtol=SAME, atol=0.0):
            name = database_of(scene, body, "its sea").name
            raise SceneError(
                f"over: with database {name!r} the waves load vessel {body!r} otherwise than in scene "
                f"{scene.name!r}; give the vessel the database of its sea, or add its sea anew"
            )


def _settings(scene: Scene) -> dict[str, Any]:
    assert scene.waves is not None
    known = scene.waves.provenance
    if known.spectrum is None or known.seed is None:
        raise SceneError(
            f"over: the sea of scene {scene.name!r} is no single wave system of add_sea(hs=, tp=, ...), so "
            "its words cannot vary; give a function that makes the scene"
        )
    spread = known.spreading
    return {
        "spectrum": known.spectrum,
        "hs": known.hs,
        "tp": known.tp,
        "gamma": known.gamma,
        "direction_deg": known.wave_direction_deg,
        "spreading": None if spread is None else Spreading(**spread),
        "seed": known.seed,
        "count": known.wave_components,
    }


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
