"""Runs of one lift in different seas, stepped side by side in the lanes of vector registers."""

from __future__ import annotations

import importlib
from collections.abc import Callable, Mapping, Sequence
from functools import cache
from types import ModuleType

from seacrane import _core
from seacrane.errors import SceneError
from seacrane.inputs.shown import shown
from seacrane.run.run import Run

INSTRUCTIONS: Mapping[int, str] = {4: "avx2", 8: "avx512"}
"""What a processor must have for so many lanes."""
USUAL = 4  # alike on most machines
ALONE = "there is no other run beside it"
NO_LANES = "this processor, or this build, has no lanes"


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


def advance_side_by_side(runs: Sequence[Run], lanes: int, look: Callable[[float], None]) -> bool:
    """Step runs as far as they go side by side, those that differ apart, and note in each what came of it.

    Parameters
    ----------
    runs : No more than `lanes`, with one method and one end time.
    look : Called with the time now and then.

    Returns
    -------
    bool
        False when Ctrl-C stopped them.
    """
    module = module_of(lanes)
    if module is None:
        note_apart(runs, NO_LANES)
        return True
    for group in _alike(runs):
        if len(group) == 1:
            note_apart(group, _apart(group[0], next((run for run in runs if run is not group[0]), None)))
        elif not _advance_alike(group, module, lanes, look):
            return False
    return True


def _alike(runs: Sequence[Run]) -> list[list[Run]]:
    """Runs that can be stepped beside the first of their group, in the order of these."""
    groups: list[list[Run]] = []
    for run in runs:
        beside = next((group for group in groups if not _apart(group[0], run)), None)
        if beside is None:
            groups.append([run])
        else:
            beside.append(run)
    return groups


def _apart(one: Run, other: Run | None) -> str:
    """Why two runs are not stepped side by side; empty: they can be."""
    if other is None:
        return ALONE
    if one.t_end != other.t_end:
        return "the runs end at different times"
    return _core.kept_apart([other.core, one.core])


def _advance_alike(
    runs: Sequence[Run], module: ModuleType, lanes: int, look: Callable[[float], None]
) -> bool:
    for run in runs:
        run.lanes = {"lanes": lanes}
    reached = _core.advance_side_by_side([run.core for run in runs], module, runs[0].t_end, look)
    for run in runs:
        if reached and run.core.time < run.t_end:
            run.lanes["kept_apart"] = f"from t = {run.core.time:.6g} s on: {run.core.set_aside}"
    return reached


def note_apart(runs: Sequence[Run], why: str) -> None:
    """In the stats of runs: that they are stepped by themselves."""
    for run in runs:
        run.lanes = {"lanes": 1, "kept_apart": why}
