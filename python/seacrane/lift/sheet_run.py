"""Run the sheet of a lift into its folder, or go on with it; hold a forecast and a hindcast against it."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from seacrane.answers.report import answers_report
from seacrane.ensembles.members import Value, members_of
from seacrane.ensembles.object_store import folder_of
from seacrane.errors import SceneError
from seacrane.inputs.shown import shown
from seacrane.lift.build import refused_at
from seacrane.lift.check_keys import nearest, shipped_lift
from seacrane.lift.inner_keys import LIFTS
from seacrane.lift.lift import Lift
from seacrane.lift.sheet import Sheet
from seacrane.lift.sheet_keys import READ
from seacrane.lift.study_run import in_two_units, keys_in, with_keys
from seacrane.operability.go import go_or_no_go
from seacrane.operability.hindcast import WaveHindcast
from seacrane.operability.phase import Phase
from seacrane.operability.phase_sheet import phase_sheet
from seacrane.operability.phase_table import PhaseSheet
from seacrane.operability.windows import weather_windows
from seacrane.plotting.table import Answer
from seacrane.scene.scene import Scene

RUNS = "runs"


@dataclass(frozen=True, kw_only=True)
class SheetRun:
    """What `run_sheet` found: answers by their titles, the sheet first."""

    sheet: PhaseSheet
    answers: Mapping[str, Answer]


def run_sheet(
    path: str | os.PathLike[str],
    folder: str | os.PathLike[str],
    *,
    executor: Executor | None = None,
    progress: bool = False,
) -> SheetRun:
    """Make the sheet of a lift file in a folder; runs that are there are not run again.

    Writes `sheet.csv`, `sheet.html`, and the runs.

    Raises
    ------
    FileFormatError
        With the line, for what is wrong in the file.
    SceneError
        If there is no [sheet], or the runs of the folder are of another one.
    OSError
        If something cannot be written; runs that came back are kept.
    """
    lift, target = Lift.load(path), folder_of("out", folder)
    if lift.sheet is None:
        raise SceneError(f"{Path(path).name} has no [sheet]; add it")
    target.mkdir(parents=True, exist_ok=True)
    asked = lift.sheet
    scenes = load_cases(lift, asked)
    with refused_at(asked.entry):
        sheet = phase_sheet(
            scenes if asked.cases else scenes[""], phases=[_with_scene(one, asked) for one in asked.phases],
            criteria=asked.criteria, stages=lift.stages, store=target / RUNS, executor=executor,
            progress=progress, accuracy=lift.accuracy, method=lift.method, dt_out=lift.outputs.dt_out,
            **asked.given,
        )  # fmt: skip
    answers: dict[str, Answer] = {"Seas by phase": sheet}
    for case in sheet.cases:
        of = f" of {case}" if case else ""
        if asked.forecast:
            with refused_at(asked.entry, "forecast"):
                answers[f"Forecast{of}"] = _held(go_or_no_go, sheet, case, **asked.forecast)
        if asked.hindcast:
            with refused_at(asked.entry, "hindcast"):
                answers[f"Windows{of}"] = _held(weather_windows, sheet, case, **asked.hindcast)
    sheet.to_csv(target / "sheet.csv")
    answers_report(f"{sheet.name}: seas by phase", answers).save(target / "sheet.html")
    return SheetRun(sheet=sheet, answers=answers)


def _held(call: Callable[..., Answer], sheet: PhaseSheet, case: str, *, file: str, **given: Any) -> Answer:
    """The answer of a call about the sea states of a file, read as its keys say."""
    read = {key.name: given.pop(key.name) for key in READ if key.name in given}
    return call(WaveHindcast.load(file, **read), sheet, case=case, **given)


def _with_scene(phase: Phase, asked: Sheet) -> Phase:
    """With the scene of its own lift."""
    path = asked.lifts.get(phase.name)
    if path is None:
        return phase
    return replace(phase, scene=Lift.load(shipped_lift(path) if path in LIFTS else path).scene())


def _told(value: Value) -> str:
    """A value in the name of a load case, so that others have other names."""
    return f"{value:.15g}" if isinstance(value, int | float) else value


def load_cases(lift: Lift, asked: Sheet) -> dict[str, Scene]:
    """The scene of the lift, or one for each combination of values of its keys, by what they are."""
    if not asked.cases:
        return {"": lift.scene()}
    tables = {name: table for name, table in lift.tables.items() if name != "sheet"}
    keys = keys_in(tables)
    for name in asked.cases:
        if name not in keys:
            asked.entry.fail(
                f"cases: {shown(name)} is no key of the lift; {nearest(name, tuple(keys))}", "cases"
            )
    for name, first in in_two_units({name: keys[name] for name in asked.cases}):
        asked.entry.fail(f"cases: {name} is {first} in another unit; leave one of them out", "cases")
    found = {}
    with refused_at(asked.entry, "cases"):
        members = members_of(asked.cases)
        for number in range(len(members)):
            values = members.values(number)
            title = ", ".join(f"{name.rpartition('.')[2]} {_told(value)}" for name, value in values.items())
            found[title] = Lift(with_keys(tables, keys, values)).scene()
    return found
