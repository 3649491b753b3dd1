"""Run a study into its folder, or go on with it."""

from __future__ import annotations

import os
from concurrent.futures import Executor
from pathlib import Path

from seacrane.ensembles.ensemble import Ensemble, ensemble
from seacrane.ensembles.other_sea import WORDS, require_same_sea
from seacrane.ensembles.study import Source, require_paths, stage_paths
from seacrane.errors import FileFormatError, SceneError
from seacrane.inputs.drafts import is_draft
from seacrane.lift.lift import Lift
from seacrane.lift.study import Study
from seacrane.lift.varied_keys import KeyPlace, LiftScenes, keys_in, with_keys

FILE, MEMBERS = "study.toml", "members"


def run_study(
    path: str | os.PathLike[str],
    folder: str | os.PathLike[str],
    *,
    executor: Executor | None = None,
    progress: bool = False,
) -> Ensemble:
    """Run the study of a lift file; what is in its folder is not run again.

    Parameters
    ----------
    path : Of a lift file with a [study].
    folder : Made if absent. It will hold the lift, complete, and the members as they come.
    executor : concurrent.futures.Executor, optional
    progress : Show a bar with the time left.

    Raises
    ------
    FileFormatError
        With the line, for what is wrong in the file or the lift that it names.
    SceneError
        If there is no [study], or the folder is that of another study, or of something else.
    SimulationError, WorkerVersionError, OSError
        As of `ensemble`; what came back before is kept.
    """
    lift, target = Lift.load(path), Path(folder)
    if lift.study is None:
        raise SceneError(f"{Path(path).name} has no [study]; `seacrane run` runs it once")
    source = _source(lift, lift.study)
    _claim(target)
    if not (target / FILE).exists():
        lift.save(target / FILE)
    done = ensemble(
        source, over=lift.study.over, keep=lift.study.keep, until=lift.study.until, accuracy=lift.accuracy,
        stages=lift.stages, start=lift.start, t_end=None if lift.stages else lift.t_end, method=lift.method,
        outputs=lift.outputs, executor=executor, store=target / MEMBERS, progress=progress,
    )  # fmt: skip
    lift.save(target / FILE)
    return done


def _source(lift: Lift, study: Study) -> Source:
    """The scene of the lift, or what makes scenes where keys of the lift vary."""
    scene = lift.scene()
    tables = {name: table for name, table in lift.tables.items() if name != "study"}
    axes = study.members.axes
    keys, of_stages = keys_in(tables), stage_paths(lift.stages)
    for name, values in axes.items():
        try:
            require_paths(scene, [name], WORDS, [*keys, *of_stages])
            for value in (values[0], values[-1]) if name in keys else ():
                Lift(with_keys(tables, keys, {name: value}))
        except (FileFormatError, SceneError) as error:
            study.fail_at(name, str(error))
    varied: dict[str, KeyPlace] = {name: keys[name] for name in axes if name in keys}
    if not varied:
        return scene
    words = [name for name in axes if name in WORDS]
    if words:
        try:
            require_same_sea(scene, words)
        except SceneError as error:
            study.fail_at(words[0], str(error))
    return LiftScenes(tables, varied)


def _claim(folder: Path) -> None:
    """Make the folder, or refuse one of something else."""
    if folder.exists() and not folder.is_dir():
        raise SceneError(f"{folder} is a file; give the name of a folder")
    folder.mkdir(parents=True, exist_ok=True)
    if not (folder / FILE).exists() and any(not is_draft(one) for one in folder.iterdir()):
        raise SceneError(f"{folder} holds something else than a study; give another folder")
