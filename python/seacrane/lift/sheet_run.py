"""Run the sheet of a lift into its folder, or go on with it; hold a forecast and a hindcast against it."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

from seacrane.answers.report import answers_report
from seacrane.ensembles.members import Value, members_of
from seacrane.ensembles.merging import merge_parts
from seacrane.ensembles.price import Price, Priced, sum_of
from seacrane.ensembles.study_folder import STUDY
from seacrane.errors import SceneError
from seacrane.inputs.shown import shown
from seacrane.lift.build import refused_at
from seacrane.lift.check_keys import nearest, shipped_lift
from seacrane.lift.inner_keys import LIFTS
from seacrane.lift.lift import Lift
from seacrane.lift.sheet import Sheet
from seacrane.lift.sheet_keys import READ, SCATTER
from seacrane.lift.study_run import in_two_units, keys_in, made_folder, with_keys
from seacrane.lift.tables import TABLES
from seacrane.operability.availability import ScatterDiagram, availability
from seacrane.operability.go import go_or_no_go, start_of
from seacrane.operability.hindcast import WaveHindcast
from seacrane.operability.phase import Phase
from seacrane.operability.phase_sheet import phase_sheet
from seacrane.operability.phase_table import PhaseSheet
from seacrane.operability.windows import weather_windows
from seacrane.plotting.table import Answer
from seacrane.scene.scene import Scene

FILE, RUNS = "sheet.toml", "runs"
BESIDE_IT = ("forecast", "hindcast", "scatter")  # what it is held against
SEA = {  # keys whose values are those of the sheet
    spelling for key in TABLES["sea"].keys if key.name in ("hs", "tp", "direction_deg", "seed")
    for spelling in key.spellings
}  # fmt: skip
CSV, PAGE = WRITTEN = ("sheet.csv", "sheet.html")


@dataclass(frozen=True, kw_only=True)
class SheetRun:
    """What `run_sheet` found: answers by their titles, the sheet first."""

    sheet: PhaseSheet
    answers: Mapping[str, Answer]

    def __str__(self) -> str:
        return "\n\n".join(map(str, self.answers.values()))


def run_sheet(
    path: str | os.PathLike[str],
    folder: str | os.PathLike[str],
    *,
    executor: Executor | None = None,
    part: str | None = None,
    priced: Priced | None = None,
    progress: bool = False,
) -> SheetRun | None:
    """Make the sheet of a lift file in a folder; runs that are there are not run again.

    Writes `sheet.toml`, which is the lift, `sheet.csv`, `sheet.html`, and the runs. Of a `part`, such as
    "3/40", the runs of its seas alone, and returns None; `merge_sheet` makes the sheet of those of all parts.
    `priced` is told the price of all runs, once a few are there, and says whether to go on; else None.

    Raises
    ------
    FileFormatError
        With the line, for what is wrong in the file.
    SceneError
        If there is no [sheet], the runs of the folder are of another one, or a part has none.
    OSError
        If something cannot be written; runs that came back are kept.
    """
    lift = Lift.load(path)
    if lift.sheet is None:
        raise SceneError(f"{Path(path).name} has no [sheet]; add it")
    target = made_folder(folder, FILE, (RUNS, *WRITTEN))
    if not (target / FILE).exists():
        lift.save(target / FILE)
    asked = lift.sheet
    scenes = load_cases(lift, asked)
    made = partial(
        phase_sheet, scenes if asked.cases else scenes[""],
        phases=[_with_scene(one, asked) for one in asked.phases], criteria=asked.criteria,
        stages=lift.stages, store=target / RUNS, executor=executor, progress=progress,
        accuracy=lift.accuracy, method=lift.method, dt_out=lift.outputs.dt_out, part=part, **asked.given,
    )  # fmt: skip
    beside = _beside(asked) if part is None else {}  # a part may run where these files are not
    with refused_at(asked.entry):
        if priced is not None and not priced(_price(made)):
            return None
        sheet = made()
    lift.save(target / FILE)  # the runs are of it: those of another lift were refused
    if part is not None:
        if not stores_in(target):
            raise SceneError(f"part {part}: the sheet is known without runs; run it as one")
        return None
    return _answered(sheet, asked, target, beside)


def _price(made: Callable[..., PhaseSheet]) -> Price | None:
    """Of all runs of a sheet that are missing."""
    prices: list[Price] = []

    def told(price: Price | None) -> bool:
        prices.extend([] if price is None else [price])
        return False

    made(priced=told)
    return sum_of(prices)


def merge_sheet(parts: Sequence[str | os.PathLike[str]], folder: str | os.PathLike[str]) -> SheetRun | None:
    """Make the sheet of the folders of all its parts: that of one run, to the bit.

    Raises
    ------
    SceneError, FileFormatError, OSError
        As `merge_parts` and `run_sheet`, and where a part has runs of a phase or load case that others lack.
    """
    target = made_folder(folder, FILE, (RUNS, *WRITTEN))
    first, stores = _asked_in(parts[0]), stores_in(Path(parts[0]))
    for one in parts:
        if _asked_in(one) != first:
            raise SceneError(f"merge: {one} is of another sheet than {parts[0]}; give parts of one lift file")
        lacks = sorted({*stores} ^ {*stores_in(Path(one))})
        if lacks:
            raise SceneError(
                f"merge: {one} and {parts[0]} do not both have {', '.join(lacks)}; give the command of the "
                "part that was stopped again, which goes on with it"
            )
    for place in stores:
        (target / place).parent.mkdir(parents=True, exist_ok=True)
        merge_parts([Path(one) / place for one in parts], target / place)
    return run_sheet(Path(parts[0]) / FILE, target)


def _asked_in(folder: str | os.PathLike[str]) -> Mapping[str, Any]:
    """The [sheet] in the folder of a part, but for the files that it is held against."""
    path = Path(folder) / FILE
    if not path.is_file():
        raise SceneError(f"merge: {folder} is no folder of a sheet; give those of seacrane sheet --part")
    asked: Mapping[str, Any] = Lift.load(path).tables.get("sheet", {})
    return {name: told for name, told in asked.items() if name not in BESIDE_IT}


def stores_in(folder: Path) -> list[str]:
    """Stores of the runs in the folder of a sheet, as paths from it."""
    return sorted(str(one.parent.relative_to(folder)) for one in (folder / RUNS).rglob(STUDY))


def _beside(asked: Sheet) -> dict[str, tuple[Any, dict[str, Any]]]:
    """What a sheet is held against, read before anything runs, and what else is said of it."""
    found = {}
    for name in BESIDE_IT:
        given = dict(getattr(asked, name))
        if not given:
            continue
        load, keys = (ScatterDiagram.load, SCATTER) if name == "scatter" else (WaveHindcast.load, READ)
        file, read = given.pop("file"), {key.name: given.pop(key.name) for key in keys if key.name in given}
        with refused_at(asked.entry, name):
            try:
                series: Any = load(file, **read)
            except OSError as error:
                raise SceneError(f"{file} cannot be read ({error.strerror}); check the path") from error
            if name == "forecast":
                start_of(series, given.get("start"), given.get("issued"))
        found[name] = (series, given)
    return found


def _answered(
    sheet: PhaseSheet, asked: Sheet, target: Path, beside: Mapping[str, tuple[Any, dict[str, Any]]]
) -> SheetRun:
    """The sheet with what is held against it, written."""
    answers: dict[str, Answer] = {"Seas by phase": sheet}
    names = [phase.name for phase in sheet.phases]
    try:
        for case in sheet.cases:
            of = f" of {case}" if case else ""
            for name, (series, given) in beside.items():
                with refused_at(asked.entry, name):
                    if name == "forecast":
                        answers[f"Forecast{of}"] = go_or_no_go(series, sheet, case=case, **given)
                    elif name == "hindcast":
                        answers[f"Windows{of}"] = weather_windows(series, sheet, case=case, **given)
                    else:
                        answers |= {
                            f"Availability: {one}{of}": availability(sheet.table(one, case=case), series)
                            for one in names
                        }
    finally:  # whatever it is held against, the sheet is known
        sheet.to_csv(target / CSV)
        answers_report(f"{sheet.name}: seas by phase", answers).save(target / PAGE)
    return SheetRun(sheet=sheet, answers=answers)


def _with_scene(phase: Phase, asked: Sheet) -> Phase:
    """With the scene of its own lift."""
    path = asked.lifts.get(phase.name)
    if path is None:
        return phase
    return replace(phase, scene=Lift.load(shipped_lift(path) if path in LIFTS else path).scene())


def _told(value: Value) -> str:
    """A value in the name of a load case, so that others have other names."""
    return f"{value:.15g}" if isinstance(value, int | float) else value


def _tail(key: str, keys: Iterable[str]) -> str:
    """The last parts of a key that say which it is."""
    parts, others = key.split("."), [f".{one}" for one in keys if one != key]
    for place in reversed(range(1, len(parts))):
        tail = ".".join(parts[place:])
        bare = parts[place].isdigit() or parts[place].startswith("value")  # says not of what
        if not bare and not any(one.endswith(f".{tail}") for one in others):
            return tail
    return key


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
        if name.startswith("sea.") and name.rpartition(".")[2] in SEA:
            asked.entry.fail(f"cases: {name} is that of the seas of the sheet; leave it out", "cases")
    for name, first in in_two_units({name: keys[name] for name in asked.cases}):
        asked.entry.fail(f"cases: {name} is {first} in another unit; leave one of them out", "cases")
    found = {}
    with refused_at(asked.entry, "cases"):
        members = members_of(asked.cases)
        for number in range(len(members)):
            values = members.values(number)
            title = ", ".join(f"{_tail(name, values)} {_told(value)}" for name, value in values.items())
            found[title] = Lift(with_keys(tables, keys, values)).scene()
    return found
