"""Runs and lifts in different seas, stepped side by side in the lanes of vector registers."""

from __future__ import annotations

import importlib
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import cache
from types import ModuleType
from typing import Any

from seacrane import _core
from seacrane.errors import SceneError
from seacrane.inputs.shown import shown
from seacrane.run.run import Run

INSTRUCTIONS: Mapping[int, str] = {4: "avx2", 8: "avx512"}
"""What a processor must have for so many lanes."""
USUAL = 4  # alike on most machines
ALONE = "there is no other run beside it"
NO_LANES = "this processor, or this build, has no lanes"
SINCE = "from t = "
NOBODY = "no other lift is alike at that time"


@cache
def module_of(lanes: int) -> ModuleType | None:
    """The module for so many lanes; None where the processor or the build has none."""
    name = INSTRUCTIONS[lanes]
    if not _core.has_instructions(name):
        return None
    try:
        return importlib.import_module(f"seacrane._lanes_{name}")
    except ModuleNotFoundError:
        return None


def lanes_of(given: int | None) -> int:
    """How many lanes a call asks for; None: the usual number, or 1 where there are none.

    Raises SceneError for another number than 1 and those that lanes exist for.
    """
    if given is None:
        return 1 if module_of(USUAL) is None else USUAL
    if isinstance(given, bool) or given not in (1, *INSTRUCTIONS):
        raise SceneError(f"lanes is {shown(given)}; give 1, 4 or 8, or None for what this processor has")
    return given


def advance_side_by_side(runs: Iterable[Run], lanes: int, look: Callable[[float], None]) -> bool:
    """Step runs as far as they go side by side, each as a lift of one run; as `LiftsInLanes`."""
    return LiftsInLanes([iter([run]) for run in runs], lanes, look).advance()


def note_apart(runs: Iterable[Run], why: str) -> None:
    """In the stats of runs: that they are stepped by themselves."""
    for run in runs:
        run.lanes = {"lanes": 1, "kept_apart": why}


class LiftsInLanes:
    """Brings lifts to their ends, always those forward that are furthest behind in time.

    Lifts whose runs share what lanes share, at one time, go side by side: to where a run of one of them is
    over, or to where another one joins. What comes of it depends on these lifts alone; each run notes it.

    Parameters
    ----------
    lifts : iterables of Run
        One for each lift, no more than `lanes`: its runs, each at its start. Asked for the next one, a lift
        steps what is left of the run by itself.
    lanes : int
    look : callable
        Called with the time now and then.
    """

    def __init__(self, lifts: Iterable[Iterator[Run]], lanes: int, look: Callable[[float], None]) -> None:
        self._lifts, self._lanes, self._look = list(lifts), lanes, look
        self._module = module_of(lanes)
        self._models: list[_core.Model] = []  # one of each kind
        self._kinds: dict[int, int] = {}
        self._runs: dict[int, Run] = {}  # of lifts that wait to be stepped
        self._last: dict[int, Run] = {}  # of all lifts

    def advance(self) -> bool:
        """Bring all to their ends; False when Ctrl-C stopped them."""
        for lift in range(len(self._lifts)):
            self._ask(lift)
        while self._runs:
            now = min(run.core.time for run in self._runs.values())
            kind = next(self._kinds[lift] for lift, run in self._runs.items() if run.core.time == now)
            alike = {lift: run for lift, run in self._runs.items() if self._kinds[lift] == kind}
            here = {lift: run for lift, run in alike.items() if run.core.time == now}
            first = next(iter(here.values())).core  # runs of one model may still stand on different sides
            here = {lift: run for lift, run in here.items() if not _core.kept_apart([first, run.core])}
            stop = min(run.t_end for run in here.values())
            stop = min([stop, *(run.core.time for run in alike.values() if run.core.time > now)])
            going = self._beside(here, stop) if len(here) > 1 else self._alone(*here.popitem(), stop)
            if not going:
                return False
        return True

    def _ask(self, lift: int) -> None:
        """The next run of a lift that lanes can take; others are stepped as they come."""
        self._runs.pop(lift, None)
        for run in self._lifts[lift]:
            why = NO_LANES if self._module is None else _core.kept_apart([run.core])
            if not why:
                self._runs[lift] = self._last[lift] = run
                self._kinds[lift] = self._kind(run.model)
                return
            note_apart([run], why)

    def _kind(self, model: _core.Model) -> int:
        """The number of what lanes share in this model."""
        for number, known in enumerate(self._models):
            if not _core.lanes_differ(known, model):
                return number
        self._models.append(model)
        return len(self._models) - 1

    def _beside(self, here: Mapping[int, Run], stop: float) -> bool:
        assert self._module is not None
        for run in here.values():
            run.lanes = {"lanes": self._lanes}
        cores = [run.core for run in here.values()]
        if not _core.advance_side_by_side(cores, self._module, stop, self._look):
            return False
        for lift, run in here.items():
            if run.core.time < stop:
                _note_alone(run, run.core.set_aside)
            if run.core.time < stop or stop >= run.t_end:
                self._ask(lift)
        return True

    def _alone(self, lift: int, run: Run, stop: float) -> bool:
        """Up to where another may join: where it is, or where one of another kind is over."""
        now = run.core.time
        _note_alone(run, self._why_alone(run))
        stop = min([stop, *(other.t_end for other in self._runs.values() if other.t_end > now)])
        if stop >= run.t_end:
            self._ask(lift)
            return True
        try:
            return run.advance(stop, self._look)
        except Exception:  # the lift meets it again as it steps what is left, and tells it as its own
            self._ask(lift)
            return True

    def _why_alone(self, run: Run) -> str:
        if len(self._lifts) == 1:
            return ALONE
        now, every = run.core.time, self._last.values()
        others = [one.core for one in every if one is not run and one.core.time == now]
        return (_core.kept_apart([others[0], run.core]) if others else "") or NOBODY


def _note_alone(run: Run, why: str) -> None:
    now, lanes = run.core.time, run.lanes.get("lanes", 1)
    begun = "" if now <= run.start.time else f"{SINCE}{now:.6g} s on: "
    run.lanes = {"lanes": lanes, "kept_apart": f"{begun}{why}"}


def joined_lanes(pieces: Iterable[Mapping[str, Any]]) -> dict[str, Any]:
    """What stats of runs one after the other say of lanes, as of one run."""
    told = [one for one in pieces if "lanes" in one]
    if not told:
        return {}
    reasons = list(dict.fromkeys(str(one.get("kept_apart", "")) for one in told))
    out: dict[str, Any] = {"lanes": max(int(one["lanes"]) for one in told)}
    if reasons != [""]:
        why = next(why for why in reasons if why)
        out["kept_apart"] = why if len(reasons) == 1 or why.startswith(SINCE) else f"in part: {why}"
    return out
