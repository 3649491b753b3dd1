"""What is asked of a scene, and runs of it and of what is simpler: what each says and costs."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from seacrane.description.channels import unit_of
from seacrane.description.given import given_vessels
from seacrane.description.suspension import hung_loads
from seacrane.ensembles.kept import Kept
from seacrane.errors import SceneError
from seacrane.inputs.caller import silently
from seacrane.inputs.shown import shown
from seacrane.result import Result
from seacrane.scene.scene import Scene

Ask = Callable[[Any], float]
Run = Callable[[Scene], Any]


def usual(scene: Scene) -> dict[str, Any]:
    """The peak of each hook load, the heave of each load and the roll of a vessel."""
    out: dict[str, Any] = {}
    for hung in hung_loads(scene):
        one = hung.suspension
        if one.channel == one.name:
            out[f"hook_load[{one.name}].max"] = f"hook_load[{one.name}].max"
        else:
            out[f"hook load of {one.name}, N"] = partial(_lower_end, load=hung.load)
        out[f"position[{hung.load}, z].std"] = f"position[{hung.load}, z].std"
    if len(scene.vessels) == 1 and not given_vessels(scene):
        out["roll.std"] = "roll.std"
    return out


def _lower_end(result: Any, load: str) -> float:
    """The peak at the lower end of a line with mass, in however many segments."""
    names = [hung.suspension.channel for hung in hung_loads(result.scene) if hung.load == load]
    text = f"hook_load[{names[0]}].max"
    return _single(text, Kept.of_text(text))(result)


def asked(scene: Scene, keep: Mapping[str, Any] | None) -> tuple[dict[str, Ask], dict[str, str]]:
    """The functions that give the numbers that are asked, or the usual ones, and their units, by name."""
    found = usual(scene) if keep is None else keep
    if keep is None and not found:
        raise SceneError(
            f'required: nothing hangs or floats in scene {scene.name!r}; give keep={{"z": '
            '"position[<body>, z].max"}'
        )
    if not isinstance(found, Mapping) or not found:
        raise SceneError(f'required: keep is {shown(found)}; give {{"peak": "hook_load.max"}}')
    asks, units = {}, {}
    for name, what in found.items():
        kept = Kept.of_text(what) if isinstance(what, str) else what
        if isinstance(kept, Kept):
            asks[name], units[name] = _single(name, kept), unit_of(kept.channel, kept.names.values())
        elif callable(kept):
            asks[name], units[name] = kept, ""
        else:
            raise SceneError(f'required: {name!r} is {shown(what)}; give a text such as "hook_load.max"')
    return asks, units


def _single(name: str, kept: Kept) -> Ask:
    if kept.what == "series":
        raise SceneError(f"required: {name!r} is a series; ask for one number of it, such as its .max")

    def ask(result: Any) -> float:
        found = kept.of(result)
        values = found.values
        if values.size != 1:
            names = ", ".join(str(one) for along in found.coords.values() for one in along)
            raise SceneError(
                f"required: {name!r} is {values.size} numbers of a run, of {names}; ask for one of them"
            )
        return float(values.reshape(-1)[0])

    return ask


@dataclass(frozen=True, kw_only=True)
class Told:
    """What one run says, and its cost.

    Attributes
    ----------
    values : mapping of str to float
        By the name of what is asked.
    cpu_s : Processor time, s.
    evaluations : Of the equations of motion; 0 where what was run does not count them.
    """

    values: Mapping[str, float]
    cpu_s: float
    evaluations: int


@dataclass(kw_only=True)
class Bench:
    """Runs scenes and counts what that costs.

    Attributes
    ----------
    run : What is done with a scene.
    asked : mapping of str to callable
        Numbers of what it returns.
    runs : Made by now.
    """

    run: Run
    asked: Mapping[str, Ask]
    runs: int = 0

    def told(self, scene: Scene, run: Run | None = None) -> Told:
        """Of one run; what it warns of was told for the scene as it stands, or is a row's own."""
        with silently():
            begun = time.process_time()
            found = (self.run if run is None else run)(scene)
            cpu = time.process_time() - begun
        self.runs += 1
        if isinstance(found, Result) and found.interrupted:
            raise KeyboardInterrupt
        values = {name: self._number(name, ask, found) for name, ask in self.asked.items()}
        evaluations = int(found.stats["evaluations"]) if isinstance(found, Result) else 0
        return Told(values=values, cpu_s=cpu, evaluations=evaluations)

    def _number(self, name: str, ask: Ask, found: Any) -> float:
        try:
            value = float(ask(found))
        except KeyError as error:  # the part went with which the channel came
            raise SceneError(f"required: {name!r} is gone: {error.args[0]}") from error
        if not np.isfinite(value):
            raise SceneError(f"required: {name!r} is {value:g}; ask for a number that the scene has")
        return value

    def beside(self, full: Scene, other: Scene, times: int) -> tuple[Told, list[float], float]:
        """What the other says, its costs over the full one's in runs by turns, and the last one's share
        of evaluations.

        The first run of the other is not timed: it compiles, finds its rest, and tells whether it runs.
        """
        first = self.told(other)
        shares = []
        for _ in range(times):
            one, two = self.told(full), self.told(other)
            shares.append(two.cpu_s / max(one.cpu_s, 1e-9))
            counted = two.evaluations / one.evaluations if one.evaluations else np.nan
        return first, shares, counted
