"""Give the answers that a lift file asks for, of one run or of seeds, into a folder."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Iterable, Mapping
from concurrent.futures import Executor
from dataclasses import replace
from pathlib import Path
from typing import Any

from seacrane.answers.report import answers_report
from seacrane.ensembles.ensemble import ensemble
from seacrane.ensembles.object_store import folder_of
from seacrane.errors import FileFormatError, SceneError
from seacrane.lift.answer_keys import ANSWERS
from seacrane.lift.asked_answers import Asked
from seacrane.lift.build import refused_at
from seacrane.lift.lift import Lift
from seacrane.plotting.table import Answer
from seacrane.result.result import Result
from seacrane.scene.scene import Scene
from seacrane.simulation import simulate

RUN, RUNS = "answers_run.nc", "runs"


def run_answers(
    path: str | os.PathLike[str],
    folder: str | os.PathLike[str],
    *,
    executor: Executor | None = None,
    progress: bool = False,
) -> Mapping[str, Answer]:
    """Give the answers that a lift file asks for, by their titles; those that a simulation exceeds first.

    Writes `answers.html`, a CSV file of each table, the run as `answers_run.nc`, and the runs over seeds;
    what is there of them is not run again. Where an answer is refused, the others are written before.

    Raises
    ------
    FileFormatError
        With the line, for what is wrong in the file.
    SceneError
        If it asks for none, or the runs of the folder are of another lift.
    SimulationError, OSError
        As of `simulate` and `ensemble`.
    """
    lift, target = Lift.load(path), folder_of("out", folder)
    if not lift.answers:
        raise SceneError(f"{Path(path).name} asks for no answer; add one of {', '.join(ANSWERS)} as a table")
    scene = lift.scene()
    for one in lift.answers:
        one.require(scene)
    target.mkdir(parents=True, exist_ok=True)
    result = _run_of(lift, scene, target / RUN, progress=progress)
    found: dict[str, Answer] = {}
    refused: list[FileFormatError] = []
    for stem, one in _by_stem(lift.answers).items():
        try:
            if one.over:
                answer = _of_seeds(lift, scene, one, target / RUNS / stem, executor, progress=progress)
            else:
                answer = one.of(scene, result)
        except FileFormatError as error:
            refused.append(error)
            continue
        found[stem] = answer
        answer.to_csv(target / f"{stem}.csv")
        for table in answer._shown().below:
            table.to_csv(target / f"{stem}_{table.axes[0].name}.csv")
    first = sorted(found, key=lambda stem: not getattr(found[stem], "exceeded", ()))
    told = {stem.replace("_", " ").capitalize(): found[stem] for stem in first}
    if told:
        answers_report(f"{scene.name}: answers", told).save(target / "answers.html")
    if refused:
        raise refused[0]
    return told


def _by_stem(answers: Iterable[Asked]) -> dict[str, Asked]:
    """By the names of their files: of tables of one name that are not the first with their number."""
    seen: Counter[str] = Counter()
    found = {}
    for one in answers:
        name = one.entry.table.name
        seen[name] += 1
        found[f"{name}_{seen[name]}" if seen[name] > 1 else name] = one
    return found


def _run_of(lift: Lift, scene: Scene, path: Path, *, progress: bool) -> Result | None:
    """The run of the lift with the channels that answers take; None where none takes it.

    What a file has of the same run is gone on with; stages begin anew.
    """
    wanted = [one for one in lift.answers if one.takes_run]
    if not wanted:
        return None
    channels = tuple(dict.fromkeys(name for one in wanted for name in one.channels))
    span = lift.stages or lift.t_end
    how: dict[str, Any] = {
        "start": lift.start, "method": lift.method, "accuracy": lift.accuracy, "progress": progress,
        "outputs": replace(lift.outputs, channels=channels),
    }  # fmt: skip
    try:
        goes_on = not lift.stages and lift.accuracy is None
        done = simulate(scene, span, to=path, resume=goes_on, overwrite=not goes_on, **how)
    except (SceneError, FileFormatError, FileNotFoundError):  # none, or one of another lift or longer
        done = simulate(scene, span, to=path, overwrite=True, **how)
    if done.interrupted:
        raise KeyboardInterrupt
    try:
        result = done.load()
    except FileFormatError:  # a channel is no number, which its file is not read with, and answers tell
        result = simulate(scene, span, **how)
    return result


def _of_seeds(
    lift: Lift, scene: Scene, asked: Asked, store: Path, executor: Executor | None, *, progress: bool
) -> Answer:
    """The answer of runs in several seas, which are kept in a store."""
    store.mkdir(parents=True, exist_ok=True)
    with refused_at(asked.entry):
        done = ensemble(
            scene, over=asked.over, keep={"kept": asked.keep()}, stages=lift.stages, start=lift.start,
            t_end=None if lift.stages else lift.t_end, method=lift.method, accuracy=lift.accuracy,
            outputs=replace(lift.outputs, channels=asked.channels), executor=executor, store=store,
            progress=progress,
        )  # fmt: skip
        if "kept" not in done.dataset:
            raise SceneError(f"every run has failed: {next(iter(done.failures.values()))}")
        return asked.call.make(done.dataset["kept"])
