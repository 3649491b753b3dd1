"""Runs of a scene and of what is simpler, one after the other: what each costs and what it says."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from seacrane.errors import SceneError, SeacraneError
from seacrane.inputs.caller import silently
from seacrane.result import Result
from seacrane.scene.scene import Scene

Ask = Callable[[Any], float]
Run = Callable[[Scene], Any]


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


def reason(error: BaseException) -> str:
    """Why something did not run, on one line."""
    text = " ".join(str(error).split())
    return text if isinstance(error, SeacraneError) else f"{type(error).__name__}: {text}"
